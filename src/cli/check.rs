//! `snell check`: every mistake of scenes, and no ray.

use super::Exit;
use super::args::{MessageArgs, SceneArgs};
use super::messages::Messages;
use super::session::Session;
use clap::Args;
use std::path::PathBuf;

/// Arguments of `snell check`.
#[derive(Args, Debug)]
pub struct CheckArgs {
    /// The scenes; `-` is standard input
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,
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
        check(&mut session);
        if !session.is_good() && exit == Exit::Done {
            exit = Exit::SceneWrong;
        }
        session.report(&mut messages);
    }
    messages.finish();
    exit
}

/// All that can be said of a scene without shooting a ray.
fn check(session: &mut Session) {
    let Some(checked) = session.compile() else { return };
    let loaded = crate::load::load(&checked, &session.sources, &session.files, &mut session.problems);
    if let Some(loaded) = loaded.filter(|_| !session.problems.has_errors()) {
        let plan = crate::plan::plan(&loaded, checked.cameras.first(), None);
        crate::plan::warn(&plan, &loaded, &mut session.problems);
        // What a file of definitions silences is given where they are placed.
        if !checked.is_empty() {
            crate::allow::doubt_idle(&session.sources, &mut session.problems);
        }
    }
}
