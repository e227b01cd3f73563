//! The driver: pass after pass until it is time to stop.
//!
//! A pass is one camera sample a pixel. Its tiles are computed by all threads and merged in their order, so that the
//! film holds the same bits for any number of threads, and it always holds whole passes.

mod layers;
mod replay;
mod stop;

use super::camera::CameraRay;
use super::effects::Effects;
use super::film::{ErrorEstimate, Film, Region, Tile};
use super::integrator::{
    Classic, ClassicSettings, Counters, Integrator, Pass, PathTracer, PhotonMapper, Witness,
};
use super::ledger;
use super::sampler::{Dim, Sampler, Sampling};
use super::world::World;
use crate::math::{Rgb, Vec2};
pub use layers::{Layers, layers};
use rayon::prelude::*;
pub use replay::{Replay, replay};
use std::time::Instant;
use stop::Stopping;

/// The way light is simulated.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Method {
    /// Path tracing.
    Pt,
    /// Progressive photon mapping.
    Ppm(PpmSettings),
    /// Path tracing, with caustics from photons.
    Hybrid(HybridSettings),
    /// Recursive ray tracing.
    Classic(ClassicSettings),
}

/// Settings of progressive photon mapping.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PpmSettings {
    /// Photons emitted in each pass.
    pub photon_count: u32,
    /// The most photons gathered at a point.
    pub k: u32,
    /// The largest radius of the first pass, in metres.
    pub radius: f32,
    /// The share α of photons kept as the radius shrinks, in (0, 1) (Knaus & Zwicker 2011).
    pub shrink: f64,
}

/// Settings of the caustics beside path tracing.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct HybridSettings {
    /// Photons emitted in each pass.
    pub photon_count: u32,
    /// The most photons gathered at a point: a bound on the time it takes, where light is dense.
    pub k: u32,
    /// The largest radius of the first pass.
    pub radius: GatherRadius,
    /// The share α of photons kept as the radius shrinks, in (0, 1) (Knaus & Zwicker 2011).
    pub shrink: f64,
}

/// How far photons are gathered.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum GatherRadius {
    /// Equally far everywhere, in metres.
    Meters(f32),
    /// In widths of what a pixel covers at the point.
    Pixels(f32),
}

/// When to stop: at whichever comes first. If none is set, after one pass.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Stop {
    /// After so many passes.
    pub passes: Option<u32>,
    /// After so many seconds. A pass that would end late is not begun, and one that turns out to is dropped; but the first
    /// one's camera paths are finished, if its photons were in time.
    pub seconds: Option<f64>,
    /// When the error of the picture is below this, by the upper end of its interval.
    pub error: Option<f64>,
}

/// Everything about a render but the world.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Settings {
    /// The way light is simulated.
    pub method: Method,
    /// The most vertices of a path, the one on the light included and the camera not.
    pub max_depth: u32,
    /// Another seed, other noise.
    pub seed: u64,
    /// How samples are spread.
    pub sampling: Sampling,
    /// When to stop.
    pub stop: Stop,
    /// The part of the picture to render; all of it by default.
    pub crop: Option<Region>,
}

impl Settings {
    /// So many passes over a whole picture, with Sobol points and seed 0.
    pub fn new(method: Method, max_depth: u32, passes: u32) -> Self {
        let stop = Stop { passes: Some(passes), ..Stop::default() };
        Self { method, max_depth, seed: 0, sampling: Sampling::Sobol, stop, crop: None }
    }
}

/// Watches a render. Called from the thread that renders, but for `cancelled`, which all threads call.
pub trait Monitor: Sync {
    /// A pass was added to the film.
    fn pass_done(&self, progress: &Progress);

    /// Whether to stop at once; the pass under way is dropped whole. Once so, always so.
    fn cancelled(&self) -> bool {
        false
    }
}

/// Watches nothing.
impl Monitor for () {
    fn pass_done(&self, _: &Progress) {}
}

/// How far a render has come.
pub struct Progress<'a> {
    /// What was seen so far.
    pub film: &'a Film,
    /// Seconds since the first pass began.
    pub seconds: f64,
    /// What was done.
    pub counters: Counters,
}

/// What a render did.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Stats {
    /// Whole passes in the film.
    pub passes: u32,
    /// Camera samples in the film.
    pub samples: u64,
    /// Rays and photons.
    pub counters: Counters,
    /// Samples that were infinite, negative, or not a number; they count as 0.
    pub bad_samples: u64,
    /// Seconds spent on what passes share, such as photon maps.
    pub prepare_seconds: f64,
    /// Seconds spent on camera paths.
    pub camera_seconds: f64,
    /// Seconds from the first pass to the end.
    pub seconds: f64,
}

/// Why a render ended.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum StoppedBy {
    /// All passes were done.
    Passes,
    /// Time was up.
    Time,
    /// The error was low enough.
    Error,
    /// The monitor asked for it.
    Cancelled,
}

/// A finished render.
pub struct Outcome {
    /// The picture.
    pub film: Film,
    /// What was done.
    pub stats: Stats,
    /// Why it ended.
    pub stopped_by: StoppedBy,
    /// The error of the picture; `None` below two passes.
    pub error: Option<ErrorEstimate>,
    /// Seconds of a thread spent on each pixel's camera paths.
    pixel_seconds: Vec<f64>,
}

impl Outcome {
    /// Seconds of a thread spent on each pixel's camera paths, top row first: an even share of what its tile of 16 × 16
    /// pixels took. Unlike all else, no two renders agree on it.
    pub fn pixel_seconds(&self) -> Vec<f32> {
        self.pixel_seconds.iter().map(|&seconds| seconds as f32).collect()
    }
}

/// Renders a world. Runs on the current rayon pool.
pub fn render(world: &World, settings: &Settings, monitor: &dyn Monitor) -> Outcome {
    match settings.method {
        Method::Pt => run(PathTracer::new(world, settings.max_depth), world, settings, monitor),
        Method::Hybrid(hybrid) => {
            run(PathTracer::with_caustics(world, hybrid, settings.max_depth), world, settings, monitor)
        }
        Method::Classic(classic) => {
            run(Classic::new(world, classic, settings.max_depth), world, settings, monitor)
        }
        Method::Ppm(ppm) => run(PhotonMapper::new(world, ppm, settings.max_depth), world, settings, monitor),
    }
}

/// Tiles of 16 × 16 pixels: many enough to balance threads, large enough to keep nearby paths together. They are whole
/// groups of pixels, wherever those lie in a pass.
const TILE_SIDE: u32 = 16;

fn run<I: Integrator>(
    mut integrator: I,
    world: &World,
    settings: &Settings,
    monitor: &dyn Monitor,
) -> Outcome {
    let start = Instant::now();
    let picture = Region { x: 0, y: 0, width: world.camera.width(), height: world.camera.height() };
    let region = settings.crop.map_or(picture, |crop| crop.clipped(&picture));
    let mut film = Film::new(region);
    let mut stats = Stats::default();
    let mut pixel_seconds = vec![0.0; region.area()];
    let mut stopping = Stopping::new(settings.stop);
    let stopped_by = loop {
        if let Some(reason) = stopping.reason(&film, start.elapsed().as_secs_f64()) {
            break reason;
        }
        let pass = Pass { index: film.passes(), seed: settings.seed, sampling: settings.sampling };

        let prepare = Instant::now();
        let is_late = || stopping.is_overdue(start.elapsed().as_secs_f64());
        if world.is_watched {
            ledger::photons(true);
        }
        integrator.begin_pass(pass, &mut stats.counters, &|| monitor.cancelled() || is_late());
        if world.is_watched {
            ledger::photons(false);
        }
        stats.prepare_seconds += prepare.elapsed().as_secs_f64();

        let camera = Instant::now();
        let may_be_late = pass.index == 0 && !is_late();
        let stops = || monitor.cancelled() || !may_be_late && is_late();
        let shift = pass.grid_shift(integrator.group_side());
        let tiles: Vec<_> = region.tiles(TILE_SIDE, shift).collect();
        let Some(done) = render_tiles(&integrator, world, &tiles, pass, &stops) else {
            break if monitor.cancelled() { StoppedBy::Cancelled } else { StoppedBy::Time };
        };
        stats.camera_seconds += camera.elapsed().as_secs_f64();

        for Done { tile, counters, seconds } in &done {
            stats.counters += *counters;
            let share = seconds / tile.region.area() as f64;
            let indices = tile.region.pixels().filter_map(|pixel| region.index_of(pixel));
            indices.for_each(|i| pixel_seconds[i] += share);
        }
        let samples: Vec<Tile> = done.into_iter().map(|done| done.tile).collect();
        if world.is_watched {
            ledger::film(true);
        }
        film.add_blurred_pass(&samples, integrator.blur());
        if world.is_watched {
            ledger::film(false);
        }
        let seconds = start.elapsed().as_secs_f64();
        monitor.pass_done(&Progress { film: &film, seconds, counters: stats.counters });
    };
    stats.passes = film.passes();
    stats.samples = u64::from(film.passes()) * region.area() as u64;
    stats.bad_samples = film.bad_count();
    stats.seconds = start.elapsed().as_secs_f64();
    Outcome { error: film.error(), film, stats, stopped_by, pixel_seconds }
}

/// A tile of a pass, and what it took.
struct Done {
    tile: Tile,
    counters: Counters,
    seconds: f64,
}

/// All tiles of a pass, in their order; `None` when it `stops` before they are done.
fn render_tiles<I: Integrator>(
    integrator: &I,
    world: &World,
    tiles: &[Region],
    pass: Pass,
    stops: &(dyn Fn() -> bool + Sync),
) -> Option<Vec<Done>> {
    tiles.par_iter().map(|&tile| (!stops()).then(|| render_tile(integrator, world, tile, pass))).collect()
}

/// One sample for every pixel of a tile.
///
/// Groups of pixels are traced whole where they reach beyond it, so that a part of a picture has the bits of the whole.
fn render_tile<I: Integrator>(integrator: &I, world: &World, region: Region, pass: Pass) -> Done {
    let start = Instant::now();
    let mut counters = Counters::default();
    let mut samples = vec![Rgb::BLACK; region.area()];
    for group in groups(integrator, region, pass) {
        for (pixel, sample) in render_group(integrator, world, group, pass, None, &mut counters, &mut ()) {
            if let Some(index) = region.index_of(pixel) {
                samples[index] = sample;
            }
        }
    }
    Done { tile: Tile { region, samples }, counters, seconds: start.elapsed().as_secs_f64() }
}

/// The groups that hold the pixels of a region; all of it is one where pixels have nothing to do with each other.
fn groups<I: Integrator>(integrator: &I, region: Region, pass: Pass) -> Vec<Region> {
    match integrator.group_side() {
        1 => vec![region],
        side => region.squares(side, pass.grid_shift(side)).collect(),
    }
}

/// What a pass sees through the pixels of a group for which the lens lets a ray through; not a number where that is no
/// radiance. How it comes about for one of them is `told` to `witness`.
fn render_group<I: Integrator>(
    integrator: &I,
    world: &World,
    group: Region,
    pass: Pass,
    told: Option<[u32; 2]>,
    counters: &mut Counters,
    witness: &mut impl Witness,
) -> Vec<([u32; 2], Rgb)> {
    let picture = Region { x: 0, y: 0, width: world.camera.width(), height: world.camera.height() };
    let (mut pixels, mut cameras) = (Vec::new(), Vec::new());
    if world.is_watched {
        ledger::begin_group();
    }
    for pixel in group.clipped(&picture).pixels() {
        let (sampler, ray) = camera_ray(world, pass, pixel, integrator.is_of_a_moment());
        if let Some(CameraRay { ray, weight }) = ray {
            pixels.push((pixel, weight));
            cameras.push((ray, sampler));
        }
    }
    let told = told.and_then(|told| pixels.iter().position(|(pixel, _)| *pixel == told));
    let radiances = integrator.radiances(&cameras, told, counters, witness);
    if world.is_watched {
        let seen = pixels.iter().zip(&radiances).map(|((pixel, _), radiance)| (number(*pixel), *radiance));
        ledger::end_paths(&seen.collect::<Vec<_>>());
    }
    // What is no radiance stays none, whatever it weighs: the film counts it.
    let sample = |radiance: Rgb, weight| {
        if radiance.is_valid() { radiance * weight } else { Rgb::gray(f32::NAN) }
    };
    pixels.into_iter().zip(radiances).map(|((pixel, weight), seen)| (pixel, sample(seen, weight))).collect()
}

/// The ray of a pixel in a pass, if its lens lets one through, and the numbers of its path. It leaves at the pass's moment,
/// or at one of its own.
fn camera_ray(
    world: &World,
    pass: Pass,
    pixel: [u32; 2],
    is_of_a_moment: bool,
) -> (Sampler, Option<CameraRay>) {
    let sampler = pass.camera_sampler(number(pixel));
    let blurs = world.effects.has(Effects::LENS_BLUR);
    let u_lens = if blurs { sampler.get_2d(Dim::Lens) } else { Vec2::ZERO };
    let mut ray = world.camera.ray(pixel, sampler.get_2d(Dim::Filter), u_lens);
    if let (true, Some(camera)) = (world.effects.has(Effects::TEXTURE_FILTERING), &mut ray) {
        let (width, angle) = world.camera.cone();
        camera.ray = camera.ray.as_cone(width, angle);
    }
    if !world.effects.has(Effects::MOTION) {
        return (sampler, ray);
    }
    let time = if is_of_a_moment { pass.moment(world) } else { sampler.get_1d(Dim::Time) };
    (sampler, ray.map(|camera| world.camera.at(camera, time)))
}

/// Another number for each pixel.
fn number([x, y]: [u32; 2]) -> u64 {
    u64::from(y) << 32 | u64::from(x)
}
