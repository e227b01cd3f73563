//! The command line: a file per command, nothing else.
//!
//! Standard output carries results only; diagnostics, progress and summaries go to standard error.

mod args;
mod by_line;
mod check;
mod compare;
mod convert;
mod convert_mesh;
mod doc;
mod explain;
mod fmt;
mod frames;
mod interrupt;
mod layers;
mod lossy;
mod messages;
mod new;
mod pilot;
mod plan;
mod plan_page;
mod progress;
mod render;
mod replay;
mod sequence;
mod session;
mod study;
mod summary;
mod tone;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// A scene language that shows every mistake, and a renderer that shows its error.
#[derive(Parser, Debug)]
#[command(name = "snell", version, max_term_width = 100)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand, Debug)]
enum Command {
    /// Render a scene to a picture
    Render(render::RenderArgs),
    /// Report every mistake of scenes, without shooting a ray
    Check(check::CheckArgs),
    /// Bring scenes into canonical form, in place
    Fmt(fmt::FmtArgs),
    /// Show what a scene calls for: its effects, why, and the method
    Plan(plan::PlanArgs),
    /// Show a picture of radiance with another exposure or tone curve
    Tone(tone::ToneArgs),
    /// Measure how far a picture is from another, and whether noise explains it
    Compare(compare::CompareArgs),
    /// Measure what accuracy costs in time: error against seconds, as a table and a page with plots
    Study(study::StudyArgs),
    /// Turn a mesh file or an arsenal.txt scene into a .snell scene
    Convert(convert::ConvertArgs),
    /// Explain a word of the language, or list what a scene defines
    Doc(doc::DocArgs),
    /// Say what a diagnostic code means, and what to do
    Explain(explain::ExplainArgs),
    /// Start a first scene to edit
    New(new::NewArgs),
}

/// How a command ended.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Exit {
    /// All is well.
    Done,
    /// The scene is wrong.
    SceneWrong,
    /// A picture is further from the truth than allowed.
    OverLimit,
    /// Wrong usage, or a file that cannot be read or written.
    Usage,
    /// Interrupted; what there was has been written.
    Interrupted,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        match exit {
            Exit::Done => Self::SUCCESS,
            Exit::SceneWrong | Exit::OverLimit => Self::from(1),
            Exit::Usage => Self::from(2),
            Exit::Interrupted => Self::from(130),
        }
    }
}

/// Runs the command that the process was started with.
pub fn run() -> ExitCode {
    let exit = match Cli::parse().command {
        Command::Render(args) => render::run(&args),
        Command::Check(args) => check::run(&args),
        Command::Fmt(args) => fmt::run(&args),
        Command::Plan(args) => plan::run(&args),
        Command::Tone(args) => tone::run(&args),
        Command::Compare(args) => compare::run(&args),
        Command::Study(args) => study::run(&args),
        Command::Convert(args) => convert::run(&args),
        Command::Doc(args) => doc::run(&args),
        Command::Explain(args) => explain::run(&args),
        Command::New(args) => new::run(&args),
    };
    exit.into()
}

/// Says why a command cannot go on.
fn fail(reason: impl std::fmt::Display) -> Exit {
    note(format_args!("error: {reason}\n"));
    Exit::Usage
}

/// A bar of a height in [0, 1], as one character.
fn spark(height: f64) -> char {
    const BARS: [char; 8] = ['▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];
    BARS[((height * 8.0) as usize).min(7)]
}

/// Writes to standard error. A pipe closed early is no reason to stop.
fn note(text: impl std::fmt::Display) {
    use std::io::Write;
    let _ = write!(std::io::stderr().lock(), "{text}");
}

/// Writes a result to standard output, or ends the program with 2 where that fails, on a full disk for instance.
///
/// A pipe closed early is no reason to complain: whoever read it has enough.
fn print(text: impl std::fmt::Display) {
    use std::io::Write;
    let mut out = std::io::stdout().lock();
    match write!(out, "{text}").and_then(|()| out.flush()) {
        // Who closes a pipe has read enough.
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            note(format_args!("error: standard output cannot be written to: {error}\n"));
            std::process::exit(2)
        }
        _ => {}
    }
}
