//! `snell study`: what accuracy costs in time, measured on a scene.

use super::args::{self, MessageArgs, Method, SceneArgs};
use super::progress::{duration, percent};
use super::render::{display, wish};
use super::session::{self, Fingerprint, Session};
use super::sweep::{self, Sweep, Variant};
use super::{Exit, fail, interrupt, note, print};
use crate::ir;
use crate::load::Loaded;
use crate::lower::Lowered;
use crate::math::Rgb;
use crate::output::{self, Display, Exposure, Format, Picture};
use crate::plan::Plan;
use crate::render::{Settings, Stop};
use crate::study::curve::{Curve, TimeOf};
use crate::study::experiment::{Length, Reference, frame_like, measure_run};
use crate::study::findings::Study;
use crate::study::metrics::{self, Relative};
use crate::study::page::{self, Pictures};
use crate::study::record::{Folder, Record, write_exr};
use crate::study::{heat, table};
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};

/// Arguments of `snell study`.
#[derive(Args, Debug)]
pub struct StudyArgs {
    /// The scene; `-` is standard input
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// Write the page here, and a .csv, a .json and a plot as .svg beside it [default: the scene's name with .study.html]
    #[arg(short, long = "output", value_name = "FILE.html")]
    output: Option<PathBuf>,
    /// Vary method, photons, k, radius, shrink, depth or spp: `method=pt,ppm`; may be repeated, and then every
    /// combination is measured
    #[arg(long = "sweep", value_name = "KEY=VALUES", value_parser = sweep::parse)]
    sweeps: Vec<Sweep>,
    /// How many runs of each variant, each with another seed
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(2..=1000))]
    seeds: u32,
    /// How long each run may take
    #[arg(long, value_name = "TIME", default_value = "4s", value_parser = args::seconds)]
    time: f64,
    /// Compare with this picture, an .exr or .hdr of the same size [default: a long render with another seed]
    #[arg(long, value_name = "FILE")]
    against: Option<PathBuf>,
    /// The method of the reference [default: what suits the scene]
    #[arg(long, value_name = "METHOD", default_value = "auto")]
    reference_method: Method,
    /// How long the reference may take [default: 16 times as long as a run]
    #[arg(long, value_name = "TIME", value_parser = args::seconds)]
    reference_time: Option<f64>,
    /// Which time counts
    #[arg(long, value_name = "CLOCK", default_value = "wall")]
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
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
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

/// What is printed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
enum Form {
    Human,
    Markdown,
    Csv,
    Json,
}

/// The seed of references; runs have 1, 2, 3, ….
const REFERENCE_SEED: u64 = 0x7275_7468;

/// How many times as long as a run the reference takes: its noise is then a sixteenth.
const REFERENCE_TIMES: f64 = 16.0;

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
    let prepared = prepare(args, session);
    let good = session.is_good();
    session.report_alone(&args.messages);
    let Some(prepared) = prepared.filter(|_| good) else { return Err(Exit::SceneWrong) };
    if let Some(exact) = prepared.variants.iter().find(|ready| ready.plan.is_exact) {
        return Err(fail(format_args!(
            "{} draws nothing at random here: one pass is all there is, and more time changes nothing",
            exact.name
        )));
    }
    interrupt::listen();
    let folder = Folder::open(report.with_extension("study")).map_err(fail)?;
    let reference = reference(args, &prepared, &folder)?;
    let records = measure_all(args, &prepared, &reference, &folder)?;
    conclude(args, session, &prepared, &reference, &records, &report)
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

/// A variant, ready for rays.
struct Ready {
    name: String,
    plan: Plan,
    lowered: Lowered,
}

/// All that is rendered.
struct Prepared {
    variants: Vec<Ready>,
    /// What makes the reference, unless one is given.
    reference: Option<Ready>,
    size: (u32, u32),
    display: Display,
    /// Scene, files, camera and size.
    scene_key: String,
}

fn prepare(args: &StudyArgs, session: &mut Session) -> Option<Prepared> {
    let checked = session.compile()?;
    let mut camera = session.camera(&checked, args.camera.as_deref())?.clone();
    if let Some(size) = args.size {
        camera.film.size.value = size;
    }
    let loaded = crate::load::load(&checked, &session.sources, &session.files, &mut session.problems)?;
    if !session.is_good() {
        return None;
    }
    let mut variants: Vec<Ready> = Vec::new();
    for variant in sweep::variants(&args.sweeps) {
        let ready = make_ready(&variant, variant.method(), &loaded, &camera, session)?;
        // Without photons, variants that differ in their number are the same.
        if variants.iter().all(|known| known.name != ready.name) {
            crate::plan::warn(&ready.plan, &loaded, &mut session.problems);
            variants.push(ready);
        }
    }
    let reference = match &args.against {
        Some(_) => None,
        None => {
            Some(make_ready(&Variant::default(), Some(args.reference_method), &loaded, &camera, session)?)
        }
    };
    let mut key = Fingerprint::default();
    key.add(session.fingerprint().as_bytes());
    for path in &loaded.files {
        key.add(&std::fs::read(path).unwrap_or_default());
    }
    key.add(format!("{:?} {:?}", args.camera, camera.film.size.value).as_bytes());
    Some(Prepared {
        variants,
        reference,
        size: camera.film.size.value,
        display: display(&camera.film, false),
        scene_key: key.to_string(),
    })
}

fn make_ready(
    variant: &Variant,
    method: Option<Method>,
    loaded: &Loaded<'_>,
    camera: &ir::Camera,
    session: &mut Session,
) -> Option<Ready> {
    let mut plan = crate::plan::plan(loaded, Some(camera), wish(method));
    variant.apply(&mut plan);
    let name = variant.name(plan.method);
    let lowered = crate::lower::lower(loaded, &plan, camera, &session.files, &mut session.problems)?;
    Some(Ready { name, plan, lowered })
}

impl Ready {
    fn settings(&self, seed: u64, stop: Stop) -> Settings {
        Settings { method: self.lowered.method, max_depth: self.plan.depth, seed, stop, crop: None }
    }

    /// What its measurements are kept under: other settings, another name.
    fn key(&self, parts: &[&str]) -> String {
        let mut hash = Fingerprint::default();
        parts.iter().for_each(|part| hash.add(part.as_bytes()));
        hash.add(
            format!("{} {:?} {}", env!("CARGO_PKG_VERSION"), self.lowered.method, self.plan.depth).as_bytes(),
        );
        let word = |c: char| if c.is_ascii_alphanumeric() { c } else { '-' };
        format!("{}-{hash}", self.name.chars().map(word).collect::<String>())
    }
}

/// The truth with what is known of it.
struct Truth {
    reference: Reference,
    /// In a sentence.
    words: String,
    key: String,
}

fn reference(args: &StudyArgs, prepared: &Prepared, folder: &Folder) -> Result<Truth, Exit> {
    let (picture, words) = match (&args.against, &prepared.reference) {
        (Some(path), _) => (given(path, prepared.size)?, format!("`{}`, given.", path.display())),
        (None, Some(ready)) => made(args, prepared, ready, folder)?,
        (None, None) => unreachable!("without a given reference one is prepared"),
    };
    let relative = Relative::to(picture.mean_luminance());
    let noise = picture.standard_error.as_ref().map(|errors| {
        let terms = errors.iter().zip(&picture.radiance).map(|(&e, &r)| relative.of_standard_error(e, r));
        metrics::mean(&terms.collect::<Vec<_>>())
    });
    let mut key = Fingerprint::default();
    let numbers = picture.radiance.iter().flat_map(|pixel| pixel.to_array()).flat_map(f32::to_le_bytes);
    key.add(&numbers.collect::<Vec<u8>>());
    let factor = prepared.display.exposure.factor(&picture.radiance);
    Ok(Truth { reference: Reference { picture, noise, factor }, words, key: key.to_string() })
}

fn given(path: &Path, (width, height): (u32, u32)) -> Result<Picture, Exit> {
    let bytes = session::read_bytes(path).map_err(fail)?;
    let picture = output::decode(path, &bytes).map_err(fail)?;
    if picture.is_display {
        return Err(fail(format_args!(
            "`{}` holds display values: a reference holds radiance, as .exr and .hdr do",
            path.display()
        )));
    }
    if (picture.width, picture.height) != (width, height) {
        return Err(fail(format_args!(
            "`{}` has {} × {} pixels and the scene {width} × {height}: use `--size {}x{}`",
            path.display(),
            picture.width,
            picture.height,
            picture.width,
            picture.height,
        )));
    }
    Ok(picture)
}

/// A reference of its own, or the one that was made before.
fn made(
    args: &StudyArgs,
    prepared: &Prepared,
    ready: &Ready,
    folder: &Folder,
) -> Result<(Picture, String), Exit> {
    let seconds = args.reference_time.unwrap_or(args.time * REFERENCE_TIMES);
    let passes = args.reference_time.map_or(sweep::passes(&args.sweeps), |_| None);
    let passes = passes.map(|passes| passes.next_power_of_two().saturating_mul(REFERENCE_TIMES as u32));
    let stop = match passes {
        Some(passes) => Stop { passes: Some(passes), ..Stop::default() },
        None => Stop { seconds: Some(seconds), ..Stop::default() },
    };
    let path =
        folder.file(&format!("{}.reference.exr", ready.key(&[&prepared.scene_key, &format!("{stop:?}")])));
    let known = output::read(&path).ok().filter(|_| !args.fresh);
    let picture = match known {
        Some(picture) => picture,
        None => {
            let wait = passes.map_or(duration(seconds), |passes| format!("{passes} passes"));
            say(args, format_args!("reference: {}, {wait}\n", ready.name));
            let picture = render_reference(ready, stop)?;
            write_exr(&path, &picture).map_err(fail)?;
            picture
        }
    };
    let passes = picture.fact("passes").unwrap_or("?");
    let seed = picture.fact("seed").unwrap_or("?");
    let blur = match ready.plan.method {
        ir::Method::Ppm => " It is made of photons itself: what blur it has is not seen.",
        _ => "",
    };
    let words =
        format!("Made by {} with {passes} passes and seed {seed}, which no run has.{blur}", ready.name);
    Ok((picture, words))
}

fn render_reference(ready: &Ready, stop: Stop) -> Result<Picture, Exit> {
    struct Watch;
    impl crate::render::Monitor for Watch {
        fn pass_done(&self, _: &crate::render::Progress<'_>) {}
        fn cancelled(&self) -> bool {
            interrupt::asked()
        }
    }
    let outcome = crate::render::render(&ready.lowered.world, &ready.settings(REFERENCE_SEED, stop), &Watch);
    if interrupt::asked() {
        return Err(Exit::Interrupted);
    }
    let region = outcome.film.region();
    let variance = outcome.film.variance();
    let facts = [("passes", u64::from(outcome.stats.passes)), ("seed", REFERENCE_SEED)];
    Ok(Picture {
        width: region.width,
        height: region.height,
        radiance: outcome.film.mean(),
        standard_error: variance.map(|variance| variance.iter().map(|v| v.map(f32::sqrt)).collect()),
        is_display: false,
        facts: facts.map(|(name, value)| (name.to_owned(), value.to_string())).to_vec(),
    })
}

/// Measures what is not known yet: a run of every variant, then the next seed, so that an interrupted study is even.
fn measure_all(
    args: &StudyArgs,
    prepared: &Prepared,
    truth: &Truth,
    folder: &Folder,
) -> Result<Vec<(String, Record)>, Exit> {
    let length = match sweep::passes(&args.sweeps) {
        Some(passes) => Length::Passes(passes.next_power_of_two()),
        None => Length::Seconds(args.time),
    };
    let key = |ready: &Ready| ready.key(&[&prepared.scene_key, &truth.key, &format!("{length:?}")]);
    let read = |ready: &Ready| {
        let key = key(ready);
        let record = if args.fresh { Record::default() } else { folder.read(&key) };
        (key, record)
    };
    let mut records: Vec<(String, Record)> = prepared.variants.iter().map(read).collect();
    let known: usize = records.iter().map(|(_, record)| record.runs.len().min(args.seeds as usize)).sum();
    let all = args.seeds as usize * records.len();
    if known > 0 {
        say(args, format_args!("{known} of {all} runs were measured before and are kept\n"));
    }
    let mut done = known;
    for count in 0..args.seeds as usize {
        for (ready, (key, record)) in prepared.variants.iter().zip(&mut records) {
            if record.runs.len() > count {
                continue;
            }
            let seed = count as u64 + 1;
            // The first run says how many passes fit into the time; the others make as many.
            let length = record.runs.first().and_then(|run| run.points.last());
            let length = length.map_or(length_of(args), |last| Length::Passes(last.passes));
            let settings = ready.settings(seed, Stop::default());
            let run =
                measure_run(&ready.lowered.world, &settings, length, &truth.reference, &interrupt::asked);
            let Some(run) = run else { return Ok(records) };
            done += 1;
            if let Some(last) = run.run.points.last() {
                let (passes, error) = (last.passes, percent(last.metrics.rel_mse.sqrt()));
                let (time, name) = (duration(last.seconds.wall), &ready.name);
                say(
                    args,
                    format_args!("run {done} of {all}: {name}, {passes} passes in {time}, error {error}\n"),
                );
            }
            if count == 0 {
                keep_pictures(folder, key, prepared, truth, &run.pictures).map_err(fail)?;
            }
            record.add(run);
            folder.write(key, record, &truth.reference.picture).map_err(fail)?;
        }
    }
    Ok(records)
}

fn length_of(args: &StudyArgs) -> Length {
    match sweep::passes(&args.sweeps) {
        Some(passes) => Length::Passes(passes.next_power_of_two()),
        None => Length::Seconds(args.time),
    }
}

/// Keeps the pictures of the first run and where they are wrong.
fn keep_pictures(
    folder: &Folder,
    key: &str,
    prepared: &Prepared,
    truth: &Truth,
    pictures: &[Vec<Rgb>],
) -> Result<(), String> {
    let reference = &truth.reference.picture;
    for (i, radiance) in pictures.iter().enumerate() {
        let picture = Picture { radiance: radiance.clone(), ..frame_like(reference) };
        let errors = metrics::relative_errors(&picture, reference);
        let map: Vec<[u8; 3]> =
            errors.into_iter().map(|square| heat::color_of_error(square.sqrt())).collect();
        let shown = shown(prepared, truth).develop(radiance);
        for (pixels, name) in [(shown, picture_file(key, i)), (map, map_file(key, i))] {
            let bytes = output::encode_display(Format::Png, prepared.size, &pixels);
            let bytes = bytes.map_err(|error| error.to_string())?;
            output::replace(&folder.file(&name), &bytes).map_err(|error| error.to_string())?;
        }
    }
    Ok(())
}

fn picture_file(key: &str, step: usize) -> String {
    format!("{key}.{}.png", 1_u64 << step)
}

fn map_file(key: &str, step: usize) -> String {
    format!("{key}.{}.error.png", 1_u64 << step)
}

/// The scene's own look, with the exposure of the reference for all.
fn shown(prepared: &Prepared, truth: &Truth) -> Display {
    Display { exposure: Exposure::Ev(truth.reference.factor.log2()), ..prepared.display }
}

/// Writes the report of what there is.
fn conclude(
    args: &StudyArgs,
    session: &Session,
    prepared: &Prepared,
    truth: &Truth,
    records: &[(String, Record)],
    report: &Path,
) -> Result<Exit, Exit> {
    let folder = Folder::open(report.with_extension("study")).map_err(fail)?;
    let noise = truth.reference.noise.unwrap_or(0.0);
    let (time, time_unit) = match args.clock {
        ClockArg::Wall => (TimeOf::Wall, "seconds"),
        ClockArg::Cpu => (TimeOf::Cpu, "core seconds"),
    };
    let (mut curves, mut pictures) = (Vec::new(), Vec::new());
    for (ready, (key, record)) in prepared.variants.iter().zip(records) {
        if record.runs.len() < 2 {
            continue; // one run has no spread
        }
        let curve = Curve::new(ready.name.clone(), record, &truth.reference.picture, noise, time);
        let file = |name: String| std::fs::read(folder.file(&name)).unwrap_or_default();
        let steps = 0..curve.steps.len();
        let steps = steps.map(|i| (file(picture_file(key, i)), file(map_file(key, i)))).collect();
        pictures.push(Pictures { steps });
        curves.push(curve);
    }
    if curves.is_empty() {
        note("interrupted before two runs were done; the same command goes on from here\n");
        return Err(Exit::Interrupted);
    }
    let study = Study {
        scene: session.name.clone(),
        size: prepared.size,
        reference: truth.words.clone(),
        reference_noise: truth.reference.noise,
        time_unit,
        curves,
        command: command_line(),
    };
    let png = output::encode_display(
        Format::Png,
        prepared.size,
        &shown(prepared, truth).develop(&truth.reference.picture.radiance),
    );
    let page = page::html(&study, &pictures, &png.map_err(fail)?);
    let json = format!("{:#}\n", table::json(&study));
    for (extension, text) in [
        ("html", page),
        ("csv", table::csv(&study)),
        ("json", json.clone()),
        ("svg", page::error_plot_alone(&study)),
    ] {
        output::replace(&report.with_extension(extension), text.as_bytes()).map_err(fail)?;
    }
    match args.format {
        Form::Human => print(table::text(&study, session::result_width())),
        Form::Markdown => print(table::markdown(&study)),
        Form::Csv => print(table::csv(&study)),
        Form::Json => print(json),
    }
    say(args, format_args!("{}, with .csv, .json and .svg beside it\n", report.display()));
    if interrupt::asked() {
        note("interrupted: the report is of what was measured; the same command goes on from here\n");
        return Ok(Exit::Interrupted);
    }
    Ok(Exit::Done)
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
