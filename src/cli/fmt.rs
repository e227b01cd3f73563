//! `snell fmt`: scenes in canonical form.

use super::args::MessageArgs;
use super::messages::Messages;
use super::{Exit, fail, note, print, session};
use crate::diag::Problems;
use crate::output;
use crate::source::SourceMap;
use clap::Args;
use std::path::{Path, PathBuf};

/// Arguments of `snell fmt`.
#[derive(Args, Debug)]
pub struct FmtArgs {
    /// The scenes; `-` formats standard input to standard output
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// Change nothing; say which scenes are not in canonical form
    #[arg(long)]
    check: bool,
    #[command(flatten)]
    messages: MessageArgs,
}

/// Formats each scene. One with syntax errors is left alone.
pub fn run(args: &FmtArgs) -> Exit {
    let mut messages = Messages::new(&args.messages, false);
    let exits = args.scenes.iter().map(|scene| format(scene, args, &mut messages));
    let worst = |worst, exit| if worst == Exit::Done || exit == Exit::Usage { exit } else { worst };
    let exit = exits.fold(Exit::Done, worst);
    messages.finish();
    exit
}

fn format(scene: &Path, args: &FmtArgs, messages: &mut Messages<'_>) -> Exit {
    let text = match session::read_text(scene) {
        Ok(text) => text,
        Err(reason) => return messages.fail(reason),
    };
    let mut sources = SourceMap::default();
    let Some(id) = sources.add(scene.display().to_string(), scene.to_owned(), text.as_str().into()) else {
        return messages.fail(format!("`{}` is too large", scene.display()));
    };
    let mut problems = Problems::default();
    let formatted = crate::format::format(&sources, id, &mut problems);
    messages.show(problems.into_report(&sources), None);
    let Some(formatted) = formatted else { return Exit::SceneWrong };
    match scene.to_str() {
        _ if args.check && formatted == text => Exit::Done,
        _ if args.check => {
            note(format_args!("{} is not in canonical form\n", scene.display()));
            Exit::SceneWrong
        }
        Some("-") => {
            print(formatted);
            Exit::Done
        }
        _ if formatted == text => Exit::Done,
        _ => output::replace(scene, formatted.as_bytes()).map_or_else(fail, |()| Exit::Done),
    }
}
