//! Snell: a scene language with a compiler that shows every mistake, and a renderer that shows its error.
//!
//! A scene travels one way: text → [`syntax`] → [`resolve`] → [`check`] → [`load`] → [`plan`] → [`lower`] → [`render`] →
//! [`output`]. Each of these is a module with one verb; the language half has never heard of a ray, the engine half never
//! of a span, and they meet in [`lower`].
//!
//! [`compile`] runs the first three. `examples/library.rs` goes all the way from a text in memory to pixels.

pub mod allow;
pub mod asset;
pub mod check;
pub mod cli;
pub mod convert;
pub mod diag;
pub mod explain;
pub mod format;
pub mod ir;
pub mod load;
pub mod lower;
pub mod math;
pub mod output;
pub mod plan;
pub mod reference;
pub mod render;
pub mod resolve;
pub mod schema;
pub mod source;
pub mod study;
pub mod syntax;

use check::Checked;
use diag::Problems;
use resolve::{Limits, Setting};
use source::{FileId, Files, SourceMap, Spanned};

/// From the text of `main`, which `sources` holds, to a scene that makes sense.
///
/// `sets` are parameters with their values as text, such as `("f_stop", "f/8")`. Every mistake of every file goes to
/// `problems`. `None`: so much is wrong that nothing is left to look at. What comes out is still looked at by
/// [`load::load`] when `problems` has errors, for more mistakes, but never rendered.
pub fn compile(
    sources: &mut SourceMap,
    files: &dyn Files,
    main: FileId,
    sets: &[(String, String)],
    problems: &mut Problems,
) -> Option<Checked> {
    compile_within(sources, files, main, sets, &Limits::default(), problems)
}

/// [`compile`], with other limits on what the scene may ask for.
pub fn compile_within(
    sources: &mut SourceMap,
    files: &dyn Files,
    main: FileId,
    sets: &[(String, String)],
    limits: &Limits,
    problems: &mut Problems,
) -> Option<Checked> {
    let ast = syntax::parse(sources, files, main, problems); // what was written, includes read
    let settings: Vec<Setting> = sets.iter().filter_map(|set| setting(set, sources, problems)).collect();
    // What it means: names bound, units applied.
    let scene = resolve::resolve_within(&ast, sources, &settings, limits, problems);
    let checked = check::check(scene, problems); // that it makes sense as a whole
    allow::check(problems); // that what it silences are warnings
    checked
}

/// A value from the command line, as a text of its own that reports can point into.
fn setting(
    (name, value): &(String, String),
    sources: &mut SourceMap,
    problems: &mut Problems,
) -> Option<Setting> {
    let value = syntax::parse_expression(sources, value, &format!("--set {name}"), problems)?;
    Some(Setting { name: Spanned::new(name.clone(), value.span), value })
}
