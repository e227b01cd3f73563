//! `--frames` of `check` and `render`: the same scene, once for each frame.

use super::args::SceneArgs;
use super::frames::{self, Frames};
use super::messages::Messages;
use super::render::{self, RenderArgs, Rendered};
use super::session::Session;
use super::{Exit, fail, interrupt, note};
use std::collections::HashSet;
use std::path::PathBuf;

/// Checks every frame. What is wrong in several frames is told once.
pub fn check(session: &mut Session, frames: Frames, args: &SceneArgs, messages: &mut Messages<'_>) -> Exit {
    if let Err(reason) = frames::check_parameter(session, &args.sets) {
        return fail(reason);
    }
    let mut seen = HashSet::new();
    let mut exit = Exit::Done;
    for frame in frames.iter() {
        if !check_frame(session, frame, messages, &mut seen) {
            exit = Exit::SceneWrong;
        }
    }
    exit
}

/// Checks a frame, and says whether it may be rendered.
fn check_frame(
    session: &Session,
    frame: i64,
    messages: &mut Messages<'_>,
    seen: &mut HashSet<(String, usize, String)>,
) -> bool {
    let mut session = session.with_set(frames::PARAMETER, &frame.to_string());
    session.inspect();
    let good = session.is_good();
    session
        .problems
        .retain(|problem| seen.insert((problem.code(), problem.offset(), problem.error.to_string())));
    let args = messages.args();
    let is_silent = args.is_for_programs() || args.quiet && good;
    if !session.problems.list().is_empty() && !is_silent {
        note(format_args!("in frame {frame}:\n"));
    }
    session.report(messages);
    good
}

/// Renders every frame, after all of them were found to be right: a mistake in the last costs no time of the first.
pub fn render(args: &RenderArgs, session: &mut Session, frames: Frames, pool: &rayon::ThreadPool) -> Exit {
    let outputs = match frames::outputs(&render::output_names(args), frames) {
        Ok(outputs) => outputs,
        Err(reason) => return fail(reason),
    };
    let mut messages = Messages::new(&args.messages, false);
    let found = check(session, frames, &args.scene_args, &mut messages);
    messages.finish();
    if found != Exit::Done {
        return found;
    }
    interrupt::listen();
    let mut reports = Vec::new();
    for (done, (frame, paths)) in outputs.iter().enumerate() {
        let rendered = match render_frame(args, session, *frame, paths, pool) {
            Ok(rendered) => rendered,
            Err(exit) => return exit,
        };
        if !args.messages.quiet {
            note(format_args!("frame {frame} ({} of {}): {}\n", done + 1, frames.count(), rendered.line()));
        }
        let mut json = rendered.json();
        json["frame"] = (*frame).into();
        reports.push(json);
        if let Err(error) = render::write_report(args, &serde_json::Value::Array(reports.clone())) {
            return fail(error);
        }
        if rendered.is_interrupted() || interrupt::asked() {
            return Exit::Interrupted;
        }
    }
    Exit::Done
}

fn render_frame(
    args: &RenderArgs,
    session: &Session,
    frame: i64,
    paths: &[PathBuf],
    pool: &rayon::ThreadPool,
) -> Result<Rendered, Exit> {
    let targets = render::open_targets(paths).map_err(fail)?;
    let mut session = session.with_set(frames::PARAMETER, &frame.to_string());
    render::one(args, &mut session, targets, pool)
}
