//! `snell check`: every mistake of scenes, and no ray.

use super::args::{MessageArgs, SceneArgs};
use super::frames::{self, Frames};
use super::messages::Messages;
use super::sequence;
use super::session::Session;
use super::{Exit, note};
use crate::load::MeshImport;
use clap::Args;
use std::path::PathBuf;

/// Arguments of `snell check`.
#[derive(Args, Debug)]
pub struct CheckArgs {
    /// The scenes; `-` is standard input
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// Check these frames, each with `param frame: int` set to its number: `0..48`, `0..=47` or `17`
    #[arg(long, value_name = "A..B", value_parser = frames::parse, allow_hyphen_values = true)]
    frames: Option<Frames>,
    /// Say of each mesh what it holds and what became of it
    #[arg(short, long, conflicts_with = "quiet")]
    verbose: bool,
    #[command(flatten)]
    scene_args: SceneArgs,
    #[command(flatten)]
    messages: MessageArgs,
}

/// Checks each scene on its own.
pub fn run(args: &CheckArgs) -> Exit {
    let mut messages = Messages::new(&args.messages, true);
    let mut exit = Exit::Done;
    for scene in &args.scenes {
        let mut session = match Session::open(scene, &args.scene_args) {
            Ok(session) => session,
            Err(reason) => {
                exit = messages.fail(reason);
                continue;
            }
        };
        let found = match args.frames {
            Some(frames) => sequence::check(&mut session, frames, &args.scene_args, &mut messages),
            None => check(&mut session, &mut messages, args.verbose),
        };
        if exit != Exit::Usage && found != Exit::Done {
            exit = found;
        }
    }
    messages.finish();
    exit
}

/// Checks a scene as it is.
fn check(session: &mut Session, messages: &mut Messages<'_>, verbose: bool) -> Exit {
    let imports = session.inspect();
    if verbose {
        imports.iter().for_each(tell);
    }
    let good = session.is_good();
    session.report(messages);
    if good { Exit::Done } else { Exit::SceneWrong }
}

/// Says what was read of a mesh file, and what became of the rest.
fn tell(mesh: &MeshImport) {
    let part = mesh.part.as_ref().map_or(String::new(), |part| format!(", part `{part}`"));
    let (triangles, materials) = (mesh.triangle_count, mesh.material_count);
    let count = |n: usize, one: &str| format!("{n} {one}{}", if n == 1 { "" } else { "s" });
    let (triangles, materials) = (count(triangles, "triangle"), count(materials, "material"));
    note(format_args!("`{}`{part}: {triangles}, {materials}\n", mesh.name));
    mesh.lines.iter().for_each(|line| note(format_args!("  {line}\n")));
}
