//! `snell doc`: the reference of the language, and what a scene defines.

use super::args::{MessageArgs, SceneArgs};
use super::session::{self, Session};
use super::{Exit, fail, print};
use crate::diag::did_you_mean;
use crate::reference;
use clap::Args;
use std::path::{Path, PathBuf};

/// Arguments of `snell doc`.
#[derive(Args, Debug)]
pub struct DocArgs {
    /// A block, field, function, unit, type or word, such as `sphere`, `light rect`, `radius`, `noise`; or a scene
    #[arg(value_name = "WORD")]
    words: Vec<String>,
    /// Print the whole reference as Markdown
    #[arg(long, conflicts_with = "words")]
    markdown: bool,
    /// Look for the scene's files here too; may be repeated
    #[arg(long = "asset-dir", value_name = "DIR")]
    asset_dirs: Vec<PathBuf>,
    /// Let the scene name files outside its folder
    #[arg(long)]
    allow_outside: bool,
    #[command(flatten)]
    messages: MessageArgs,
}

/// Prints what is asked for.
pub fn run(args: &DocArgs) -> Exit {
    let width = session::result_width();
    let word = args.words.join(" ");
    let is_scene = || word.ends_with(".snell") || word == "-" || Path::new(&word).is_file();
    match word.as_str() {
        _ if args.markdown => print(reference::markdown()),
        "" => print(reference::overview(width)),
        _ if !reference::lookup(&word).is_empty() => print_entries(&word, width),
        _ if is_scene() => return scene(&word, args, width),
        _ => return unknown(&word),
    }
    Exit::Done
}

fn print_entries(word: &str, width: usize) {
    let entries: Vec<String> =
        reference::lookup(word).iter().map(|entry| reference::entry(entry, width)).collect();
    print(entries.join("\n\n"));
}

/// Lists what a scene defines.
fn scene(path: &str, args: &DocArgs, width: usize) -> Exit {
    let (asset_dirs, allow_outside) = (args.asset_dirs.clone(), args.allow_outside);
    let scene_args = SceneArgs { asset_dirs, allow_outside, ..SceneArgs::default() };
    let mut session = match Session::open(Path::new(path), &scene_args) {
        Ok(session) => session,
        Err(reason) => return fail(reason),
    };
    let offers = session.survey();
    let good = session.is_good();
    print(reference::offers(&offers, &session.sources, width));
    session.report_alone(&args.messages);
    if good { Exit::Done } else { Exit::SceneWrong }
}

fn unknown(word: &str) -> Exit {
    let near = did_you_mean(word, reference::names());
    let help = near.unwrap_or_else(|| "`snell doc` without a word shows all there is".to_owned());
    fail(format_args!("nothing in the language is called `{word}`: {help}"))
}
