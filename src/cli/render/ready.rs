//! What the command line and the scene say together: a world with its settings, and whether it makes sense to begin.

use super::files::holds_layers;
use super::{DEFAULT_PASSES, RenderArgs};
use crate::check::Checked;
use crate::cli::args::Method;
use crate::cli::lossy::{self, Loss};
use crate::cli::pilot::BYTES_PER_PIXEL;
use crate::cli::session::Session;
use crate::ir;
use crate::lower::Lowered;
use crate::output::{Display, Exposure, Target, Tone};
use crate::plan::{Plan, Wish};
use crate::render::film::Region;
use crate::render::{Settings, Stop};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// A scene ready to be rendered.
pub struct Ready {
    pub plan: Plan,
    pub lowered: Lowered,
    pub camera: ir::Camera,
    pub settings: Settings,
    /// What the scene's texts and parameters amount to.
    pub scene_hash: String,
    /// Every file that the scene is made of.
    inputs: Vec<PathBuf>,
    /// Whether display values lose their fraction.
    pub floor: bool,
    /// Why effects cannot be left out as the command says.
    refusal: Option<String>,
    /// What is left out.
    pub loss: Option<Loss>,
    pub compile_seconds: f64,
    pub build_seconds: f64,
}

/// Loads what the scene names, plans, and builds the world. `None` when that cannot be; what is wrong is noted.
pub fn make_ready(
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
    let settings = Settings::new(lowered.method, plan.depth, passes);
    Settings {
        seed: args.seed.or(render.seed.map(|seed| seed.value)).unwrap_or(settings.seed),
        stop: stop.unwrap_or(settings.stop),
        crop: args.crop,
        ..settings
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
    ///
    /// # Errors
    /// The reason, in a sentence.
    pub fn reason_not_to_start(&self, args: &RenderArgs, targets: &[Target]) -> Result<(), String> {
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
