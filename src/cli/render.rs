//! `snell render`: from a scene to a picture.

mod files;
mod ready;

use super::args::{self, MessageArgs, Method, SceneArgs};
use super::frames::{self, Frames};
use super::layers;
use super::progress::Bar;
use super::replay;
use super::sequence;
use super::session::Session;
use super::summary::Summary;
use super::{Exit, fail, interrupt, note};
use crate::output::Target;
use crate::plan::Wanted;
use crate::render::film::Region;
use crate::render::{Outcome, StoppedBy};
use clap::Args;
pub use files::{open_targets, output_names, write_report};
pub use ready::{Ready, display, wish};
use std::path::PathBuf;
use std::time::Instant;

/// Arguments of `snell render`.
#[derive(Args, Debug)]
pub struct RenderArgs {
    /// The scene; `-` is standard input
    #[arg(value_name = "SCENE")]
    pub(super) scene: PathBuf,
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
    pub(super) camera: Option<String>,
    /// How light is simulated [default: as the scene says]
    #[arg(long, value_name = "METHOD")]
    pub(super) method: Option<Method>,
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
    pub(super) size: Option<(u32, u32)>,
    /// Render only this part: column and row of its upper left corner, width and height
    #[arg(long, value_name = "X,Y,W,H", value_parser = crop)]
    crop: Option<Region>,
    /// Render nothing but trace this pixel, column and row: every vertex of its paths with the lines of what they met
    #[arg(long, value_name = "X,Y", value_parser = pixel, conflicts_with_all = ["frames", "outputs", "report", "crop"])]
    pixel: Option<[u32; 2]>,
    /// Of the pixel, trace only this sample, counted from 0 as passes are
    #[arg(long, value_name = "N", requires = "pixel", value_parser = clap::value_parser!(u32).range(..u32::MAX as i64))]
    pub(super) sample: Option<u32>,
    /// How many threads [default: one a core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=4096))]
    threads: Option<u16>,
    /// The seed of all random numbers
    #[arg(long, value_name = "N", value_parser = args::seed, allow_hyphen_values = true)]
    pub(super) seed: Option<u64>,
    /// What an .exr holds beside colour, its standard errors and the number of samples; may be repeated, `all` or `none`
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
    if let Err(reason) = args.report.as_deref().map_or(Ok(()), files::writable) {
        return fail(reason);
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(usize::from(args.threads.unwrap_or(0))).build();
    let pool = match pool {
        Ok(pool) => pool,
        Err(error) => return fail(format_args!("threads cannot be started: {error}")),
    };
    if let Some(pixel) = args.pixel {
        return replay::run(args, &mut session, pixel, &pool);
    }
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
    /// The command that renders it, but for what the picture does not depend on.
    command: String,
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
            command: &self.command,
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
    let ready = compile(args, session, pool)?;
    ready.reason_not_to_start(args, &targets).map_err(fail)?;

    interrupt::listen();
    let bar = Bar::new(ready.settings.stop, args.messages.quiet);
    let outcome = pool.install(|| crate::render::render(&ready.lowered.world, &ready.settings, &bar));
    bar.finish();

    let (scene, command) = (session.name.clone(), replay::command(args));
    let mut rendered = Rendered { scene, command, files: Vec::new(), ready, outcome };
    if rendered.outcome.stats.passes == 0 && rendered.outcome.stopped_by == StoppedBy::Time {
        return Err(fail(
            "time was up among the photons of the first pass, and nothing was written; allow more time or fewer photons",
        ));
    }
    // Of nothing seen, no picture is better than a black one.
    if rendered.outcome.stats.passes > 0 {
        let paths: Result<Vec<PathBuf>, _> = files::write(&mut targets, args, &rendered)
            .and_then(|()| targets.into_iter().map(Target::finish).collect());
        rendered.files = paths.map_err(fail)?.iter().map(|path| path.display().to_string()).collect();
    }
    Ok(rendered)
}

/// Compiles a scene and builds its world. What goes wrong is said.
pub(super) fn compile(
    args: &RenderArgs,
    session: &mut Session,
    pool: &rayon::ThreadPool,
) -> Result<Ready, Exit> {
    let start = Instant::now();
    let ready = session.compile().and_then(|checked| {
        let camera = session.camera(&checked, args.camera.as_deref())?.clone();
        pool.install(|| ready::make_ready(checked, camera, args, session, start))
    });
    let good = session.is_good();
    if args.frames.is_none() || !good {
        session.report_alone(&args.messages); // warnings of frames were told when they were checked
    }
    ready.filter(|_| good).ok_or(Exit::SceneWrong)
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

/// `X,Y`.
fn pixel(text: &str) -> Result<[u32; 2], String> {
    let place =
        text.split_once(',').and_then(|(x, y)| Some([x.trim().parse().ok()?, y.trim().parse().ok()?]));
    place.ok_or_else(|| "write COLUMN,ROW from the upper left corner, such as `120,45`".to_owned())
}

/// `X,Y,W,H`.
fn crop(text: &str) -> Result<Region, String> {
    let numbers: Option<Vec<u32>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[x, y, width, height]) if width > 0 && height > 0 => Ok(Region { x, y, width, height }),
        _ => Err("write X,Y,WIDTH,HEIGHT in pixels, such as `100,50,64,64`".to_owned()),
    }
}
