//! Text → ast: what was written, includes read, every syntax error noted.

mod angles;
pub mod ast;
mod balance;
mod block;
pub mod dump;
mod edit;
mod error;
mod expr;
mod file;
mod foreign;
mod grammar;
mod item;
mod literal;
mod load;
mod lower;
mod plausible;
mod repair;
mod scan;
mod spell;
mod stray;
mod text;
mod token;

use crate::diag::Problems;
use crate::source::{FileId, Files, SourceMap};
use std::path::PathBuf;

pub use error::SyntaxError;
pub use foreign::spelled_out;

/// Reads the main file and all that it includes and imports, each file once.
///
/// Every mistake is noted in `problems` and leaves a poisoned node in the tree.
pub fn parse(
    sources: &mut SourceMap,
    files: &dyn Files,
    main: FileId,
    problems: &mut Problems,
) -> ast::Program {
    load::Loader::new(sources, files, problems).program(main)
}

/// Reads one file without those that it names: enough to format it.
pub fn parse_file(sources: &SourceMap, id: FileId, problems: &mut Problems) -> ast::File {
    let file = sources.file(id);
    let mut no_files = |_: &lower::Request| None;
    let items = load::items(&file.text, file.base, &mut no_files, problems);
    ast::File { source: id, items }
}

/// Reads one expression, such as the `8` of `--set f_stop=8`; `name` stands for a file in reports.
///
/// `None`, and a report, when the text is not one expression.
pub fn parse_expression(
    sources: &mut SourceMap,
    text: &str,
    name: &str,
    problems: &mut Problems,
) -> Option<ast::Expr> {
    let id = sources.add(name.to_owned(), PathBuf::new(), text.into())?;
    let mut no_files = |_: &lower::Request| None;
    let base = sources.file(id).base;
    let repaired = repair::repair(text, base).map_err(|error| problems.push(error)).ok()?;
    let mut lower = lower::Lower::new(repaired.as_text(text, base), &mut no_files);
    let value = lower.alone();
    let errors = lower.finish(repaired.errors.clone(), &repaired.guesses);
    let is_sound = errors.is_empty();
    errors.into_iter().for_each(|error| problems.push(error));
    value.filter(|_| is_sound)
}
