//! `snell new`: a first scene to edit.

use super::{Exit, fail, note};
use clap::Args;
use std::fs::OpenOptions;
use std::io::Write;
use std::path::PathBuf;

/// Arguments of `snell new`.
#[derive(Args, Debug)]
pub struct NewArgs {
    /// The file to make; `.snell` is added where it is missing
    name: PathBuf,
}

/// The scene that everyone starts with.
const FIRST_SCENE: &str = include_str!("first.snell");

/// Writes the first scene, unless the file is already there.
pub fn run(args: &NewArgs) -> Exit {
    let mut path = args.name.clone();
    if path.extension().is_none_or(|extension| extension != "snell") {
        path.as_mut_os_string().push(".snell");
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    if let Some(folder) = folder.filter(|folder| !folder.is_dir()) {
        return fail(format_args!("there is no folder `{}`", folder.display()));
    }
    let made = OpenOptions::new().write(true).create_new(true).open(&path);
    if let Err(error) = made.and_then(|mut file| file.write_all(FIRST_SCENE.as_bytes())) {
        return match error.kind() {
            std::io::ErrorKind::AlreadyExists => fail(format_args!("`{}` is already there", path.display())),
            _ => fail(format_args!("`{}` cannot be written: {error}", path.display())),
        };
    }
    let shown = path.display().to_string();
    let quoted = if shown.contains(char::is_whitespace) { format!("'{shown}'") } else { shown };
    note(format_args!("made {quoted}; render it with: snell render {quoted}\n"));
    Exit::Done
}
