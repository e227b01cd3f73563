//! `snell plan`: what a scene calls for, and why.

use super::args::{MessageArgs, SceneArgs};
use super::session::Session;
use super::{Exit, fail, print};
use crate::plan::{Effect, Plan};
use clap::Args;
use std::fmt::Write;
use std::path::PathBuf;

/// Arguments of `snell plan`.
#[derive(Args, Debug)]
pub struct PlanArgs {
    /// The scene; `-` is standard input
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// Look through this camera
    #[arg(long, value_name = "NAME")]
    camera: Option<String>,
    #[command(flatten)]
    scene_args: SceneArgs,
    #[command(flatten)]
    messages: MessageArgs,
}

/// Prints the plan of a scene.
pub fn run(args: &PlanArgs) -> Exit {
    let mut session = match Session::open(&args.scene, &args.scene_args) {
        Ok(session) => session,
        Err(reason) => return fail(reason),
    };
    let checked = session.compile();
    let text = checked.as_ref().and_then(|checked| {
        let camera = session.camera(checked, args.camera.as_deref());
        let loaded = crate::load::load(checked, &session.sources, &session.files, &mut session.problems)?;
        if session.problems.has_errors() {
            return None; // what follows from a mistake is not worth a warning
        }
        let plan = crate::plan::plan(&loaded, camera, None);
        crate::plan::warn(&plan, &loaded, &mut session.problems);
        Some(table(&plan, &session))
    });
    let good = session.is_good();
    session.report_alone(&args.messages);
    match text {
        Some(text) if good => {
            print(text);
            Exit::Done
        }
        _ => Exit::SceneWrong,
    }
}

fn table(plan: &Plan, session: &Session) -> String {
    let mut out = String::new();
    let method = match plan.method {
        crate::ir::Method::Pt => "path tracing",
        crate::ir::Method::Ppm => "progressive photon mapping",
        crate::ir::Method::Hybrid => "path tracing with caustics from photons (hybrid)",
        crate::ir::Method::Classic => "recursive ray tracing",
    };
    let _ = writeln!(out, "method: {method}, {}\n", plan.why);
    for effect in Effect::ALL {
        let used = plan.effects.iter().find(|used| used.effect == effect);
        let why = used.map_or("not called for".to_owned(), |used| {
            let place = session.sources.location(used.span).map_or(String::new(), |place| place.to_string());
            let others = used.count - 1;
            if others == 0 { place } else { format!("{place} and {others} more") }
        });
        let _ = writeln!(out, "{:<13} {why}", effect.name());
    }
    out
}
