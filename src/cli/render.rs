//! `snell render`: from a scene to a picture.

use super::args::{self, MessageArgs, Method, SceneArgs};
use super::frames::{self, Frames};
use super::layers;
use super::lossy::{self, Loss};
use super::pilot::BYTES_PER_PIXEL;
use super::progress::Bar;
use super::sequence;
use super::session::Session;
use super::summary::Summary;
use super::{Exit, fail, interrupt, note};
use crate::check::Checked;
use crate::ir;
use crate::lower::Lowered;
use crate::output::{Display, Exposure, Format, Frame, Target, Tone};
use crate::plan::{Plan, Wanted, Wish};
use crate::render::film::Region;
use crate::render::{Outcome, Settings, Stop, StoppedBy};
use clap::Args;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Arguments of `snell render`.
#[derive(Args, Debug)]
pub struct RenderArgs {
    /// The scene; `-` is standard input
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// Write the picture here: .png, .exr, .hdr or .ppm; may be repeated [default: the scene's name with .png]. With
    /// `--frames`, `{frame:04}` in it stands for the number with at least four digits; without, `.0017` goes before the
    /// extension
    #[arg(short, long = "output", value_name = "FILE")]
    outputs: Vec<PathBuf>,
    /// Render these frames, each with `param frame: int` set to its number: `0..48`, `0..=47` or `17`. All are checked
    /// before the first is rendered
    #[arg(long, value_name = "A..B", value_parser = frames::parse, allow_hyphen_values = true)]
    frames: Option<Frames>,
    #[command(flatten)]
    pub(super) scene_args: SceneArgs,
    /// Look through this camera
    #[arg(long, value_name = "NAME")]
    camera: Option<String>,
    /// How light is simulated [default: as the scene says]
    #[arg(long, value_name = "METHOD")]
    method: Option<Method>,
    /// Stop after this many passes, one camera sample a pixel each
    #[arg(long, visible_alias = "spp", value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    passes: Option<u32>,
    /// Stop after this time, such as `90s` or `5min`, whichever stop comes first
    #[arg(long, value_name = "TIME", value_parser = args::seconds, allow_hyphen_values = true)]
    time: Option<f64>,
    /// Stop when the picture's relative error is below this, such as `1%`
    #[arg(long, value_name = "SHARE", value_parser = args::share, allow_hyphen_values = true)]
    error: Option<f64>,
    /// The size of the picture in pixels, such as `640x480`
    #[arg(long, value_name = "WxH", value_parser = args::size, allow_hyphen_values = true)]
    size: Option<(u32, u32)>,
    /// Render only this part: column and row of its upper left corner, width and height
    #[arg(long, value_name = "X,Y,W,H", value_parser = crop)]
    crop: Option<Region>,
    /// How many threads [default: one a core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    /// The seed of all random numbers
    #[arg(long, value_name = "N", value_parser = args::seed, allow_hyphen_values = true)]
    seed: Option<u64>,
    /// What an .exr holds beside colour, its standard error and the number of samples; may be repeated, `all` or `none`
    /// [default: albedo,normal,depth]
    #[arg(long, value_name = "LAYER", value_delimiter = ',')]
    layers: Vec<layers::Choice>,
    /// Simulate these effects: `auto` for those that the scene calls for, `all`, `+NAME` for one more, `-NAME` for one
    /// less; with commas between
    #[arg(long, value_name = "WORDS", value_delimiter = ',', value_parser = Wanted::parse, allow_hyphen_values = true)]
    effects: Vec<Wanted>,
    /// Leave out what `--effects` says though the scene calls for it; the picture says so
    #[arg(long)]
    lossy: bool,
    /// Write all that the closing words say, and more, as JSON
    #[arg(long, value_name = "FILE.json")]
    report: Option<PathBuf>,
    #[command(flatten)]
    pub(super) messages: MessageArgs,
}

/// Passes of a scene that does not say when to stop.
pub const DEFAULT_PASSES: u32 = 64;

/// Renders a scene, or each frame of it.
pub fn run(args: &RenderArgs) -> Exit {
    let mut session = match Session::open(&args.scene, &args.scene_args) {
        Ok(session) => session,
        Err(reason) => return fail(reason),
    };
    if let Err(reason) = args.report.as_deref().map_or(Ok(()), writable) {
        return fail(reason);
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(usize::from(args.threads.unwrap_or(0))).build();
    let pool = match pool {
        Ok(pool) => pool,
        Err(error) => return fail(format_args!("threads cannot be started: {error}")),
    };
    match args.frames {
        Some(frames) => sequence::render(args, &mut session, frames, &pool),
        None => {
            // What can be wrong with the command is said before any work is done.
            let rendered = open_targets(&output_names(args))
                .map_err(fail)
                .and_then(|targets| one(args, &mut session, targets, &pool));
            rendered.map_or_else(|exit| exit, |rendered| conclude(args, &rendered))
        }
    }
}

/// A picture that was made, and all that is known about it.
pub struct Rendered {
    scene: String,
    files: Vec<String>,
    ready: Ready,
    outcome: Outcome,
}

impl Rendered {
    fn summary(&self) -> Summary<'_> {
        Summary {
            scene: &self.scene,
            files: &self.files,
            plan: &self.ready.plan,
            method: &self.ready.lowered.method,
            outcome: &self.outcome,
            settings: &self.ready.settings,
            scene_hash: &self.ready.scene_hash,
            loss: self.ready.loss.as_ref(),
            compile_seconds: self.ready.compile_seconds,
            build_seconds: self.ready.build_seconds,
        }
    }

    /// All of it on one line.
    pub fn line(&self) -> String {
        self.summary().line()
    }

    /// For programs.
    pub fn json(&self) -> serde_json::Value {
        self.summary().json()
    }

    /// Whether someone asked to stop before it was done.
    pub fn is_interrupted(&self) -> bool {
        self.outcome.stopped_by == StoppedBy::Cancelled
    }
}

/// Compiles and renders a scene once. What goes wrong is said; the error is how the command ends then.
pub fn one(
    args: &RenderArgs,
    session: &mut Session,
    mut targets: Vec<Target>,
    pool: &rayon::ThreadPool,
) -> Result<Rendered, Exit> {
    let start = Instant::now();
    let ready = session.compile().and_then(|checked| {
        let camera = session.camera(&checked, args.camera.as_deref())?.clone();
        pool.install(|| make_ready(checked, camera, args, session, start))
    });
    let good = session.is_good();
    if args.frames.is_none() || !good {
        session.report_alone(&args.messages); // warnings of frames were told when they were checked
    }
    let ready = ready.filter(|_| good).ok_or(Exit::SceneWrong)?;
    ready.reason_not_to_start(args, &targets).map_err(fail)?;

    interrupt::listen();
    let bar = Bar::new(ready.settings.stop, args.messages.quiet);
    let outcome = pool.install(|| crate::render::render(&ready.lowered.world, &ready.settings, &bar));
    bar.finish();

    let mut rendered = Rendered { scene: session.name.clone(), files: Vec::new(), ready, outcome };
    if rendered.outcome.stats.passes == 0 && rendered.outcome.stopped_by == StoppedBy::Time {
        return Err(fail(
            "time was up among the photons of the first pass, and nothing was written; allow more time or fewer photons",
        ));
    }
    // Of nothing seen, no picture is better than a black one.
    if rendered.outcome.stats.passes > 0 {
        let paths: Result<Vec<PathBuf>, _> = write(&mut targets, args, &rendered)
            .and_then(|()| targets.into_iter().map(Target::finish).collect());
        rendered.files = paths.map_err(fail)?.iter().map(|path| path.display().to_string()).collect();
    }
    Ok(rendered)
}

/// A scene ready to be rendered.
struct Ready {
    plan: Plan,
    lowered: Lowered,
    camera: ir::Camera,
    settings: Settings,
    /// What the scene's texts and parameters amount to.
    scene_hash: String,
    /// Every file that the scene is made of.
    inputs: Vec<PathBuf>,
    /// Whether display values lose their fraction.
    floor: bool,
    /// Why effects cannot be left out as the command says.
    refusal: Option<String>,
    /// What is left out.
    loss: Option<Loss>,
    compile_seconds: f64,
    build_seconds: f64,
}

fn make_ready(
    checked: Checked,
    mut camera: ir::Camera,
    args: &RenderArgs,
    session: &mut Session,
    start: Instant,
) -> Option<Ready> {
    if let Some(size) = args.size {
        camera.film.size.value = size;
    }
    let compiled = start.elapsed().as_secs_f64();
    let loaded = crate::load::load(&checked, &session.sources, &session.files, &mut session.problems)?;
    if !session.is_good() {
        return None;
    }
    let mut plan = crate::plan::plan(&loaded, Some(&camera), wish(args.method));
    let left_out = plan.want(&args.effects);
    let refusal = lossy::refusal(&left_out, &plan, &camera, args.lossy, &session.sources);
    crate::plan::warn(&plan, &loaded, &mut session.problems);
    let lowered = crate::lower::lower(&loaded, &plan, &camera, &session.files, &mut session.problems)?;
    let build_seconds = start.elapsed().as_secs_f64() - compiled;
    let settings =
        Settings { crop: crop_of(args, &camera), ..settings(args, &checked.render, &plan, &lowered) };
    let texts = session.sources.files().iter().map(|file| file.path.clone());
    let inputs = texts.chain(loaded.files.iter().cloned()).collect();
    let floor = plan.method == ir::Method::Classic && checked.render.classic.floor;
    let loss = if refusal.is_some() || left_out.is_empty() {
        None
    } else {
        Loss::measure(&left_out, &loaded, &plan, &camera, session)
    };
    let (scene_hash, compile_seconds) = (session.fingerprint(), compiled);
    Some(Ready {
        plan,
        lowered,
        camera,
        settings,
        scene_hash,
        inputs,
        floor,
        refusal,
        loss,
        compile_seconds,
        build_seconds,
    })
}

/// The method that the command asks for.
pub fn wish(method: Option<Method>) -> Wish {
    match method {
        None => Wish::Scene,
        Some(Method::Auto) => Wish::Auto,
        Some(Method::Pt) => Wish::Method(ir::Method::Pt),
        Some(Method::Ppm) => Wish::Method(ir::Method::Ppm),
        Some(Method::Hybrid) => Wish::Method(ir::Method::Hybrid),
        Some(Method::Classic) => Wish::Method(ir::Method::Classic),
    }
}

/// A stop flag replaces the scene's stop.
fn settings(args: &RenderArgs, render: &ir::Render, plan: &Plan, lowered: &Lowered) -> Settings {
    let flags = Stop { passes: args.passes, seconds: args.time, error: args.error };
    let written = Stop {
        passes: render.stop.passes.map(|passes| passes.value),
        seconds: render.stop.seconds.map(|seconds| seconds.value),
        error: render.stop.error.map(|error| error.value),
    };
    let stop = [flags, written].into_iter().find(|stop| *stop != Stop::default());
    let passes = if plan.is_exact { 1 } else { DEFAULT_PASSES };
    Settings {
        method: lowered.method,
        max_depth: plan.depth,
        seed: args.seed.or(render.seed.map(|seed| seed.value)).unwrap_or(0),
        stop: stop.unwrap_or(Stop { passes: Some(passes), ..Stop::default() }),
        crop: args.crop,
    }
}

/// What is rendered of the picture: the command line goes before the scene.
fn crop_of(args: &RenderArgs, camera: &ir::Camera) -> Option<Region> {
    let written = camera.film.crop_in_pixels();
    args.crop.or_else(|| written.map(|[x, y, width, height]| Region { x, y, width, height }))
}

impl Ready {
    /// Why rendering would be in vain: an output that would replace an input, a crop outside the picture, or more memory
    /// than there is.
    fn reason_not_to_start(&self, args: &RenderArgs, targets: &[Target]) -> Result<(), String> {
        if let Some(refusal) = &self.refusal {
            return Err(refusal.clone());
        }
        if let Some(path) = overwritten(args, targets, &self.inputs) {
            return Err(format!("the scene reads `{}`: write elsewhere with `-o`", path.display()));
        }
        if !args.layers.is_empty() && !holds_layers(targets) {
            return Err("layers need a file that can hold them: add `-o NAME.exr`".to_owned());
        }
        let (width, height) = self.camera.film.size.value;
        let picture = Region { x: 0, y: 0, width, height };
        let region = self.settings.crop.map_or(picture, |crop| crop.clipped(&picture));
        if region.area() == 0 {
            return Err(format!("the crop lies outside the picture, which has {width} x {height} pixels"));
        }
        let needed = region.area() as u64 * BYTES_PER_PIXEL;
        match available_memory() {
            Some(free) if needed > free => Err(format!(
                "{} x {} pixels need about {} GB of memory, and {} GB are free: use `--size`, or render parts with `--crop`",
                region.width,
                region.height,
                needed >> 30,
                free >> 30,
            )),
            _ => Ok(()),
        }
    }
}

/// How a film's pictures are shown; `floor` says whether display values lose their fraction.
pub fn display(film: &ir::Film, floor: bool) -> Display {
    Display {
        exposure: match film.exposure.value {
            ir::Exposure::Ev(ev) => Exposure::Ev(ev as f32),
            ir::Exposure::Auto => Exposure::Auto,
        },
        tone: match film.tone.value {
            ir::Tone::Srgb => Tone::Srgb,
            ir::Tone::Linear => Tone::Linear,
            ir::Tone::Reinhard => Tone::Reinhard,
            ir::Tone::Agx => Tone::Agx,
        },
        floor,
    }
}

/// Where the pictures go: what `-o` says, or the scene's name.
pub fn output_names(args: &RenderArgs) -> Vec<PathBuf> {
    let default = || match args.scene.to_str() {
        Some("-") => PathBuf::from("out.png"),
        _ => args.scene.with_extension("png"),
    };
    if args.outputs.is_empty() { vec![default()] } else { args.outputs.clone() }
}

/// Makes sure that the pictures can be written.
///
/// # Errors
/// Why one cannot, in a sentence.
pub fn open_targets(paths: &[PathBuf]) -> Result<Vec<Target>, String> {
    if paths.iter().any(|path| path.as_os_str() == "-") {
        return Err("a picture does not go to standard output: name a file with `-o`".to_owned());
    }
    paths.iter().map(|path| Target::open(path).map_err(|error| error.to_string())).collect()
}

/// The memory that can be had without swapping, in bytes, where the system says.
fn available_memory() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok().map(|kilobytes| kilobytes << 10)
}

/// The output that would replace a file of the scene.
fn overwritten<'a>(args: &'a RenderArgs, targets: &'a [Target], inputs: &[PathBuf]) -> Option<&'a Path> {
    let inputs: Vec<PathBuf> = inputs.iter().filter_map(|path| path.canonicalize().ok()).collect();
    let outputs = targets.iter().map(Target::path).chain(args.report.as_deref());
    outputs.into_iter().find(|path| path.canonicalize().is_ok_and(|path| inputs.contains(&path)))
}

fn writable(report: &Path) -> Result<(), String> {
    let folder = report.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let shown = report.display();
    match () {
        () if report.is_dir() => Err(format!("`{shown}` cannot be written: it is a folder")),
        () if !folder.is_dir() => Err(format!("`{shown}` cannot be written: there is no folder for it")),
        () => Ok(()),
    }
}

fn write(
    targets: &mut [Target],
    args: &RenderArgs,
    rendered: &Rendered,
) -> Result<(), crate::output::OutputError> {
    let (outcome, ready) = (&rendered.outcome, &rendered.ready);
    let display = display(&ready.camera.film, ready.floor);
    let mut facts = rendered.summary().facts();
    facts.extend(display.facts());
    let wanted = if holds_layers(targets) { layers::chosen(&args.layers) } else { Vec::new() };
    let planes = layers::planes(&wanted, &ready.lowered.world, ready.settings.seed, outcome);
    let region = outcome.film.region();
    let variance = outcome.film.variance().unwrap_or_default();
    let frame = Frame {
        width: region.width,
        height: region.height,
        radiance: outcome.film.mean(),
        planes,
        standard_error: variance.iter().map(|pixel| pixel.map(f32::sqrt)).collect(),
        sample_counts: vec![outcome.stats.passes; region.area()],
        facts,
    };
    targets.iter_mut().try_for_each(|target| target.write(&frame, &display))
}

/// Whether any of the files can hold more than colours.
fn holds_layers(targets: &[Target]) -> bool {
    targets.iter().any(|target| target.format() == Format::Exr)
}

fn conclude(args: &RenderArgs, rendered: &Rendered) -> Exit {
    let summary = rendered.summary();
    if !args.messages.quiet {
        note(summary.human());
    }
    if let Err(error) = write_report(args, &summary.json()) {
        return fail(error);
    }
    if rendered.is_interrupted() { Exit::Interrupted } else { Exit::Done }
}

/// Writes the facts where `--report` says.
///
/// # Errors
/// When the file cannot be written.
pub fn write_report(args: &RenderArgs, facts: &serde_json::Value) -> Result<(), crate::output::OutputError> {
    match &args.report {
        Some(path) => crate::output::replace(path, format!("{facts:#}\n").as_bytes()),
        None => Ok(()),
    }
}

/// `X,Y,W,H`.
fn crop(text: &str) -> Result<Region, String> {
    let numbers: Option<Vec<u32>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[x, y, width, height]) if width > 0 && height > 0 => Ok(Region { x, y, width, height }),
        _ => Err("write X,Y,WIDTH,HEIGHT in pixels, such as `100,50,64,64`".to_owned()),
    }
}
