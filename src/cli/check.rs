//! `snell check`: every mistake of scenes, and no ray.

use super::args::{MessageArgs, SceneArgs};
use super::frames::{self, Frames};
use super::sequence;
use super::session::Session;
use super::{Exit, fail};
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
    #[command(flatten)]
    scene_args: SceneArgs,
    #[command(flatten)]
    messages: MessageArgs,
}

/// Checks each scene on its own.
pub fn run(args: &CheckArgs) -> Exit {
    let mut exit = Exit::Done;
    for scene in &args.scenes {
        let mut session = match Session::open(scene, &args.scene_args) {
            Ok(session) => session,
            Err(reason) => {
                exit = fail(reason);
                continue;
            }
        };
        let found = match args.frames {
            Some(frames) => sequence::check(&mut session, frames, &args.scene_args, &args.messages),
            None => check(&mut session, &args.messages),
        };
        if exit != Exit::Usage && found != Exit::Done {
            exit = found;
        }
    }
    exit
}

fn check(session: &mut Session, messages: &MessageArgs) -> Exit {
    session.inspect();
    let good = session.is_good();
    session.report(messages, true);
    if good { Exit::Done } else { Exit::SceneWrong }
}
