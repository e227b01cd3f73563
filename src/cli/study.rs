//! `snell study`: what accuracy costs in time, measured on a scene.

mod measure;
mod prepare;
mod sweep;
mod truth;
mod variant;

use super::args::{self, MessageArgs, Method, SceneArgs};
use super::session::{self, Session};
use super::{Exit, fail, interrupt, note, print};
use crate::output::{self, Format};
use crate::study::curve::{Curve, TimeOf};
use crate::study::findings::Study;
use crate::study::record::Folder;
use crate::study::{page, table};
use clap::{Args, ValueEnum};
use measure::Known;
use prepare::Prepared;
use std::path::{Path, PathBuf};
use sweep::Sweep;
use truth::Truth;

/// Arguments of `snell study`.
#[derive(Args, Debug)]
pub struct StudyArgs {
    /// The scene; `-` is standard input
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// Write the page here, and a .csv, a .json and a plot as .svg beside it [default: the scene's name with .study.html]
    #[arg(short, long = "output", value_name = "FILE.html")]
    output: Option<PathBuf>,
    /// Vary method, photons, k, radius, shrink, depth, sampler, filter, tolerance or spp: `method=pt,ppm`; may be
    /// repeated, and then every combination is measured
    #[arg(long = "sweep", value_name = "KEY=VALUES", value_parser = sweep::parse)]
    sweeps: Vec<Sweep>,
    /// How many runs of each variant, each with another seed
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(2..=1000))]
    seeds: u32,
    /// How long each run may take, by the clock that counts
    #[arg(long, value_name = "TIME", default_value = "4s", value_parser = args::seconds)]
    time: f64,
    /// Compare with this picture, an .exr or .hdr of the same size [default: a long render with another seed]
    #[arg(long, value_name = "FILE")]
    against: Option<PathBuf>,
    /// The method of the reference [default: what suits the scene]
    #[arg(long, value_name = "METHOD", default_value = "auto")]
    reference_method: Method,
    /// How long the reference may take on the wall [default: 16 times as long as a run]
    #[arg(long, value_name = "TIME", value_parser = args::seconds)]
    reference_time: Option<f64>,
    /// Which time counts: that of all cores together, or what you wait for
    #[arg(long, value_name = "CLOCK", default_value = "cpu")]
    clock: ClockArg,
    /// Forget what was measured before
    #[arg(long)]
    fresh: bool,
    /// Look through this camera
    #[arg(long, value_name = "NAME")]
    camera: Option<String>,
    /// The size of the picture in pixels, such as `320x240`
    #[arg(long, value_name = "WxH", value_parser = args::size)]
    size: Option<(u32, u32)>,
    /// How many threads [default: one a core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=4096))]
    threads: Option<u16>,
    /// What is printed at the end
    #[arg(long, value_name = "FORM", default_value = "human")]
    format: Form,
    #[command(flatten)]
    scene_args: SceneArgs,
    #[command(flatten)]
    messages: MessageArgs,
}

/// Which time counts.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
enum ClockArg {
    /// What you wait for.
    Wall,
    /// What all cores together spend: steadier on a busy machine.
    Cpu,
}

impl ClockArg {
    const fn time(self) -> TimeOf {
        match self {
            Self::Wall => TimeOf::Wall,
            Self::Cpu => TimeOf::Cpu,
        }
    }

    /// What its seconds are called.
    const fn unit(self) -> &'static str {
        match self {
            Self::Wall => "seconds",
            Self::Cpu => "core seconds",
        }
    }
}

/// What is printed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
enum Form {
    Human,
    Markdown,
    Csv,
    Json,
}

/// Measures a scene and writes the report.
pub fn run(args: &StudyArgs) -> Exit {
    let session = Session::open(&args.scene, &args.scene_args);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(usize::from(args.threads.unwrap_or(0))).build();
    match (session, pool) {
        (Ok(mut session), Ok(pool)) => pool.install(|| study(args, &mut session)).unwrap_or_else(|exit| exit),
        (Err(reason), _) => fail(reason),
        (_, Err(error)) => fail(format_args!("threads cannot be started: {error}")),
    }
}

fn study(args: &StudyArgs, session: &mut Session) -> Result<Exit, Exit> {
    let report = report_name(args)?;
    let prepared = prepare::prepare(args, session)?;
    if let Some(exact) = prepared.variants.iter().find(|ready| ready.plan.is_exact) {
        return Err(fail(format_args!(
            "{} draws nothing at random here: one pass is all there is, and more time changes nothing",
            exact.name
        )));
    }
    interrupt::listen();
    let folder = Folder::open(report.with_extension("study")).map_err(fail)?;
    let truths = truth::references(args, &prepared, &folder)?;
    let known = measure::measure_all(args, &prepared, &truths, &folder)?;
    let Some((study, pictures)) = conclude(args, session, &prepared, &truths, &known, &folder) else {
        note("interrupted before two runs were done; the same command goes on from here\n");
        return Err(Exit::Interrupted);
    };
    let reference = &truths[0].reference;
    let shown = prepared.shown(reference.factor).develop(&reference.picture.radiance);
    let png = output::encode_display(Format::Png, prepared.size, &shown).map_err(fail)?;
    write(&report, &study, &page::html(&study, &pictures, &png))?;
    match args.format {
        Form::Human => print(table::text(&study, session::result_width())),
        Form::Markdown => print(table::markdown(&study)),
        Form::Csv => print(table::csv(&study)),
        Form::Json => print(json(&study)),
    }
    say(args, format_args!("{}, with .csv, .json and .svg beside it\n", report.display()));
    if interrupt::asked() {
        note("interrupted: the report is of what was measured; the same command goes on from here\n");
        return Ok(Exit::Interrupted);
    }
    Ok(Exit::Done)
}

/// Where the report goes, after a look whether it can.
fn report_name(args: &StudyArgs) -> Result<PathBuf, Exit> {
    let default = || match args.scene.to_str() {
        Some("-") => PathBuf::from("study.html"),
        _ => args.scene.with_extension("study.html"),
    };
    let path = args.output.clone().unwrap_or_else(default);
    let is_html = path.extension().is_some_and(|extension| extension == "html");
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    match () {
        () if !is_html => {
            Err(fail(format_args!("`{}`: a report is a page, such as `report.html`", path.display())))
        }
        () if !folder.is_dir() => Err(fail(format_args!("there is no folder `{}`", folder.display()))),
        () => Ok(path),
    }
}

/// What there is to tell, with the pictures of each curve. `None` before any variant has two runs: one has no spread.
fn conclude(
    args: &StudyArgs,
    session: &Session,
    prepared: &Prepared,
    truths: &[Truth],
    all: &[Known],
    folder: &Folder,
) -> Option<(Study, Vec<page::Pictures>)> {
    let (mut curves, mut pictures) = (Vec::new(), Vec::new());
    for (ready, Known { key, record }) in prepared.variants.iter().zip(all) {
        if record.runs.len() < 2 {
            continue;
        }
        let reference = &truths[ready.judge].reference;
        let curve = Curve::new(ready.name.clone(), ready.has_photons(), record, reference, args.clock.time());
        pictures.push(measure::kept_pictures(folder, key, curve.steps.len()));
        curves.push(curve);
    }
    let more = if truths.len() > 1 { " So is the reference of each other filter." } else { "" };
    let noises = truths.iter().filter_map(|truth| truth.reference.noise);
    let study = Study {
        scene: session.name.clone(),
        size: prepared.size,
        reference: format!("{}{more}", truths[0].words),
        reference_noise: noises.reduce(f64::max),
        time_unit: args.clock.unit(),
        curves,
        command: command_line(),
    };
    (!study.curves.is_empty()).then_some((study, pictures))
}

/// Writes the report in all its forms.
fn write(report: &Path, study: &Study, page: &str) -> Result<(), Exit> {
    let (csv, json, svg) = (table::csv(study), json(study), page::error_plot_alone(study));
    for (extension, text) in [("html", page), ("csv", &csv), ("json", &json), ("svg", &svg)] {
        output::replace(&report.with_extension(extension), text.as_bytes()).map_err(fail)?;
    }
    Ok(())
}

fn json(study: &Study) -> String {
    format!("{:#}\n", table::json(study))
}

fn say(args: &StudyArgs, text: impl std::fmt::Display) {
    if !args.messages.quiet {
        note(text);
    }
}

/// The command as it was typed, so that it can be typed again.
fn command_line() -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_=.,/:+%@".contains(c);
    let words = std::env::args().skip(1).map(|word| match word.chars().all(plain) {
        true => word,
        false => format!("'{}'", word.replace('\'', "'\\''")),
    });
    std::iter::once("snell".to_owned()).chain(words).collect::<Vec<_>>().join(" ")
}
