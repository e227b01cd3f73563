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
    let path =
        if args.name.extension().is_some() { args.name.clone() } else { args.name.with_extension("snell") };
    let made = OpenOptions::new().write(true).create_new(true).open(&path);
    if let Err(error) = made.and_then(|mut file| file.write_all(FIRST_SCENE.as_bytes())) {
        return match error.kind() {
            std::io::ErrorKind::AlreadyExists => fail(format_args!("`{}` is already there", path.display())),
            _ => fail(format_args!("`{}` cannot be written: {error}", path.display())),
        };
    }
    note(format_args!("made {}; render it with `snell render {}`\n", path.display(), path.display()));
    Exit::Done
}
