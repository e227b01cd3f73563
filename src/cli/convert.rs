//! `snell convert`: from an arsenal.txt scene to a `.snell` scene.

use super::args::{Deny, MessageArgs};
use super::messages::Messages;
use super::session;
use super::{Exit, fail, note, print};
use crate::convert::{Basis, Conversion, Dialect, DiskFinder, Lights, Options, report};
use crate::output;
use crate::source::SourceMap;
use clap::{Args, ValueEnum};
use serde_json::json;
use std::path::{Path, PathBuf};

/// Arguments of `snell convert`.
#[derive(Args, Debug)]
pub struct ConvertArgs {
    /// The scene to convert; `-` is standard input
    #[arg(value_name = "IN.txt")]
    input: PathBuf,
    /// Write the scene here instead of to standard output
    #[arg(short, long, value_name = "OUT.snell")]
    output: Option<PathBuf>,
    /// The dialect, instead of the one that the file seems to be in
    #[arg(long, value_name = "DIALECT", value_parser = dialect)]
    dialect: Option<Dialect>,
    /// Treat everything that is not understood as an error
    #[arg(long)]
    strict: bool,
    /// Treat warnings as errors
    #[arg(long, value_name = "WHAT")]
    deny: Option<Deny>,
    /// How the camera's basis is made where `up` leans
    #[arg(long, value_name = "HOW")]
    basis: Option<BasisArg>,
    /// What to do with the `Lights` block
    #[arg(long, value_name = "WHAT", default_value = "auto")]
    lights: LightsArg,
    /// Look for meshes and pictures here too; may be repeated
    #[arg(long = "asset-dir", value_name = "DIR")]
    asset_dirs: Vec<PathBuf>,
    /// Write what became of each word as JSON
    #[arg(long, value_name = "FILE.json")]
    report: Option<PathBuf>,
    /// Say what became of each word
    #[arg(short, long)]
    verbose: bool,
    #[command(flatten)]
    messages: MessageArgs,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum BasisArg {
    /// As it comes out of the cross product (the course's framework of 2020).
    Raw,
    /// Normalised (from 2021 on).
    Orthonormal,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum LightsArg {
    /// Keep it where programs of the dialect use it.
    Auto,
    /// Keep it.
    Keep,
    /// Leave it out.
    Drop,
}

/// Converts a scene.
pub fn run(args: &ConvertArgs) -> Exit {
    let name = args.input.file_name().map_or("scene".into(), |name| name.to_string_lossy().into_owned());
    let text = match session::read_text(&args.input) {
        Ok(text) => text,
        Err(reason) => return fail(reason),
    };
    let mut sources = SourceMap::default();
    if sources.add(args.input.display().to_string(), args.input.clone(), text.as_str().into()).is_none() {
        return fail("the scene is too large");
    }
    let options = Options {
        dialect: args.dialect,
        strict: args.strict,
        basis: args.basis.map(|basis| match basis {
            BasisArg::Raw => Basis::Raw,
            BasisArg::Orthonormal => Basis::Orthonormal,
        }),
        lights: match args.lights {
            LightsArg::Auto => Lights::Auto,
            LightsArg::Keep => Lights::Keep,
            LightsArg::Drop => Lights::Drop,
        },
    };
    let finder = DiskFinder::new(&args.input, args.asset_dirs.clone());
    let mut conversion = crate::convert::convert(&text, &name, &options, Some(&finder));
    if args.deny.is_some() && !conversion.problems.is_empty() {
        conversion.snell = None; // as after an error, nothing is written
    }
    let written = write(args, &text, &conversion);

    let mut problems = crate::diag::Problems::default();
    for problem in conversion.problems {
        problems.push(problem);
    }
    let mut messages = Messages::new(&args.messages, false);
    messages.show(problems.into_report(&sources), args.deny);
    messages.finish();
    match (written, conversion.snell) {
        (Err(reason), _) => fail(reason),
        (Ok(()), None) => Exit::SceneWrong,
        (Ok(()), Some(snell)) => {
            if args.output.is_none() {
                print(snell);
            }
            Exit::Done
        }
    }
}

/// Writes the files that were asked for, and says what was done.
fn write(args: &ConvertArgs, text: &str, conversion: &Conversion) -> Result<(), String> {
    if let (Some(path), Some(snell)) = (&args.output, &conversion.snell) {
        output::replace(path, snell.as_bytes()).map_err(|error| error.to_string())?;
    }
    if let Some(path) = &args.report {
        let json = format!("{:#}\n", as_json(text, conversion));
        output::replace(path, json.as_bytes()).map_err(|error| error.to_string())?;
    }
    if args.verbose {
        note(report::render(text, &conversion.report));
    } else if !args.messages.quiet && conversion.snell.is_some() {
        let to = args.output.as_deref().unwrap_or(Path::new("standard output")).display();
        let detection = &conversion.detection;
        note(format_args!(
            "{} → {to}: dialect {}, because {}\n",
            args.input.display(),
            detection.dialect.id(),
            detection.reason
        ));
        note(format_args!("  {}\n", report::summary(&conversion.report)));
    }
    Ok(())
}

fn as_json(text: &str, conversion: &Conversion) -> serde_json::Value {
    let mut line = 1;
    let mut seen = 0;
    let fates = conversion.report.iter().map(|fate| {
        line += text[seen..fate.span.start].bytes().filter(|&byte| byte == b'\n').count();
        seen = fate.span.start;
        let (outcome, detail) = fate.outcome.parts();
        json!({ "line": line, "start": fate.span.start, "end": fate.span.end,
                "text": &text[fate.span.clone()], "fate": outcome, "detail": detail })
    });
    json!({
        "dialect": conversion.detection.dialect.id(),
        "reason": conversion.detection.reason,
        "tokens": fates.collect::<Vec<_>>(),
    })
}

fn dialect(text: &str) -> Result<Dialect, String> {
    let known = Dialect::ALL.iter().find(|dialect| dialect.id().eq_ignore_ascii_case(text));
    known.copied().ok_or_else(|| {
        let names: Vec<&str> = Dialect::ALL.iter().map(|dialect| dialect.id()).collect();
        format!("the dialects are {}", names.join(", "))
    })
}
