//! A look ahead: a few passes over a small picture tell what the whole one takes, and what each effect adds to it.

use super::session::Session;
use crate::diag::Problems;
use crate::ir::Camera;
use crate::load::Loaded;
use crate::lower::Lowered;
use crate::plan::{Effect, Plan, Wanted};
use crate::render::ledger::{self, Ledger};
use crate::render::{Outcome, Settings, render};
use crate::source::Span;
use crate::study::clock::{Clock, Seconds};

/// The longer side of a small picture, in pixels.
const SIDE: u32 = 160;
/// How often each way is tried; they take turns, so that what else the machine does burdens all alike.
const ROUNDS: u64 = 4;
/// How many times as many passes are booked as timed.
const BOOKED: u32 = 6;
/// What a render takes at least that is compared with one without something, in seconds of processor time.
const COMPARED_SECONDS: f64 = 0.3;
/// How often these take turns.
const TURNS: u32 = 6;
/// Passes of a small picture that takes less time than this are made more of, in seconds of processor time.
const LEAST_SECONDS: f64 = 0.15;

/// What a whole picture takes.
pub struct Outlook {
    /// Seconds to load, decode and build.
    pub build_seconds: f64,
    /// Processor seconds of a pass: for what all camera paths share, and for these.
    pub photon_seconds: f64,
    pub camera_seconds: f64,
    /// Rays for each camera path.
    pub rays_per_path: f64,
    /// Photons that a pass keeps.
    pub stored_photons: u64,
    /// Bytes of this process once the world is built, where the system says.
    pub world_bytes: Option<u64>,
    /// Bytes of film and photons.
    pub film_bytes: u64,
    pub photon_bytes: u64,
}

/// What an effect adds to the time of a render.
#[derive(Clone, Copy)]
pub struct Price {
    /// The share of the whole time that it takes; of one that is absent, by how much it would make it longer.
    pub share: f64,
    /// Half the distance between the dearest and the cheapest of the rounds.
    pub spread: f64,
}

/// What was booked, and the seconds of processor time that it all took.
pub struct Books {
    pub ledger: Ledger,
    pub seconds: f64,
    /// How much of the time on the wall that is.
    pub own: f64,
    /// How many times as many camera paths the whole picture has.
    pub larger: f64,
}

/// The camera with a picture of at most [`SIDE`] pixels, at the same aspect.
pub fn small(camera: &Camera) -> Camera {
    let mut small = camera.clone();
    let (width, height) = camera.film.size.value;
    let scale = (f64::from(SIDE) / f64::from(width.max(height))).min(1.0);
    let side = |pixels: u32| (f64::from(pixels) * scale).ceil() as u32;
    small.film.size.value = (side(width), side(height));
    small
}

/// The number of its pixels.
fn area(camera: &Camera) -> f64 {
    let (width, height) = camera.film.size.value;
    f64::from(width) * f64::from(height)
}

/// Some passes over a picture.
pub fn passes(lowered: &Lowered, plan: &Plan, passes: u32, seed: u64) -> Outcome {
    let settings = Settings { seed, ..Settings::new(lowered.method, plan.depth, passes) };
    render(&lowered.world, &settings, &())
}

/// What the film and its copies take for a pixel, in bytes: eight streams of three sums, the mean, its error, the file.
pub const BYTES_PER_PIXEL: u64 = 8 * 24 + 64;
/// A photon, its place in the tree and in the list that it was made in.
const BYTES_PER_PHOTON: u64 = 128;

/// Ways to render the same small picture, each ready.
pub struct Pilot<'a> {
    plan: &'a Plan,
    camera: &'a Camera,
    lowered: Lowered,
    build_seconds: f64,
    world_bytes: Option<u64>,
    /// Processor seconds of a pass of the small picture.
    pass_seconds: f64,
    passes: u32,
    /// A single thread, for all that is booked or compared.
    alone: Option<rayon::ThreadPool>,
}

impl<'a> Pilot<'a> {
    /// Builds the world. `None` when it cannot be.
    pub fn new(
        loaded: &Loaded<'_>,
        plan: &'a Plan,
        camera: &'a Camera,
        session: &mut Session,
    ) -> Option<Self> {
        let clock = Clock::start();
        let lowered =
            crate::lower::lower(loaded, plan, &small(camera), &session.files, &mut session.problems)?;
        let build_seconds = clock.seconds().cpu;
        let world_bytes = resident_bytes();
        let mut pilot = Self {
            plan,
            camera,
            lowered,
            build_seconds,
            world_bytes,
            pass_seconds: 1.0,
            passes: 1,
            alone: None,
        };
        pilot.pass_seconds = pilot.seconds(&pilot.lowered, 0);
        pilot.passes = (LEAST_SECONDS / pilot.pass_seconds).ceil().clamp(1.0, 64.0) as u32;
        Some(pilot)
    }

    fn seconds(&self, lowered: &Lowered, seed: u64) -> f64 {
        let clock = Clock::start();
        passes(lowered, self.plan, self.passes, seed);
        clock.seconds().cpu
    }

    /// What the whole picture takes.
    pub fn outlook(&self) -> Outlook {
        let clock = Clock::start();
        let stats = passes(&self.lowered, self.plan, self.passes, 1).stats;
        let cpu = clock.seconds().cpu;
        // The clock of the processor, shared out as that on the wall.
        let wall = (stats.prepare_seconds + stats.camera_seconds).max(f64::MIN_POSITIVE);
        let passes = f64::from(self.passes);
        let stored_photons = stats.counters.stored_photons / u64::from(self.passes);
        Outlook {
            build_seconds: self.build_seconds,
            photon_seconds: cpu * stats.prepare_seconds / wall / passes,
            camera_seconds: cpu * stats.camera_seconds / wall / passes * self.larger(),
            rays_per_path: stats.counters.rays as f64 / stats.samples.max(1) as f64,
            stored_photons,
            world_bytes: self.world_bytes,
            film_bytes: area(self.camera) as u64 * BYTES_PER_PIXEL,
            photon_bytes: stored_photons * BYTES_PER_PHOTON,
        }
    }

    /// How many times as many pixels the whole picture has.
    fn larger(&self) -> f64 {
        area(self.camera) / area(&small(self.camera))
    }

    /// The camera of the whole picture.
    pub fn camera(&self) -> &Camera {
        self.camera
    }

    /// Where each object was written.
    pub fn spans(&self) -> &[Span] {
        &self.lowered.sources
    }

    /// What each object costs, booked on one thread. `None` when no thread can be started.
    pub fn books(&mut self) -> Option<Books> {
        self.alone = Some(rayon::ThreadPoolBuilder::new().num_threads(1).build().ok()?);
        self.lowered.world.is_watched = true;
        let larger = self.larger();
        let (lowered, plan, count) = (&self.lowered, self.plan, self.passes * BOOKED);
        let books = self.alone.as_ref()?.install(|| {
            ledger::open();
            let clock = Clock::start();
            passes(lowered, plan, count, 2);
            let Seconds { cpu, wall } = clock.seconds();
            Some(Books { ledger: ledger::close()?, seconds: cpu, own: cpu / wall, larger })
        });
        self.lowered.world.is_watched = false;
        books
    }

    /// The share of the time that the whole picture takes less, for each of these scenes that are to be like this one but for
    /// something. All are rendered in turns.
    pub fn savings(&self, others: &[(Lowered, Plan)]) -> Vec<Price> {
        let mut savings: Vec<Vec<f64>> = vec![Vec::new(); others.len()];
        for _ in 0..TURNS {
            let own = self.whole_seconds(&self.lowered, self.plan);
            for (savings, (lowered, plan)) in savings.iter_mut().zip(others) {
                savings.push(1.0 - self.whole_seconds(lowered, plan) / own);
            }
        }
        savings.into_iter().map(median).collect()
    }

    /// Another scene as a small picture, for [`Pilot::savings`].
    pub fn lowered(&self, scene: &Loaded<'_>, plan: &Plan, session: &Session) -> Option<Lowered> {
        crate::lower::lower(scene, plan, &small(self.camera), &session.files, &mut Problems::default())
    }

    /// Processor seconds that some passes over the whole picture take, by a small one.
    fn whole_seconds(&self, lowered: &Lowered, plan: &Plan) -> f64 {
        let clock = Clock::start();
        let count = (COMPARED_SECONDS / self.pass_seconds).ceil().clamp(1.0, 256.0) as u32;
        let run = || passes(lowered, plan, count, 3).stats;
        let stats = self.alone.as_ref().map_or_else(run, |pool| pool.install(run));
        let cpu = clock.seconds().cpu;
        let wall = (stats.prepare_seconds + stats.camera_seconds).max(f64::MIN_POSITIVE);
        cpu * (stats.prepare_seconds + stats.camera_seconds * self.larger()) / wall
    }

    /// The price of each effect that can be switched: off where the scene calls for it, on where it does not.
    pub fn prices(&self, loaded: &Loaded<'_>, session: &mut Session) -> Vec<(Effect, Price)> {
        let mut prices = Vec::new();
        for effect in Effect::ALL {
            let is_on = self.plan.simulates(effect);
            let can = effect.without().is_some()
                && crate::lower::can_leave_out(effect, self.plan, self.camera).is_ok();
            if !can {
                continue;
            }
            let mut other = self.plan.clone();
            other.want(&[if is_on { Wanted::Without(effect) } else { Wanted::With(effect) }]);
            let small = small(self.camera);
            let switched = crate::lower::lower(loaded, &other, &small, &session.files, &mut session.problems);
            prices.extend(switched.map(|switched| (effect, self.price(is_on, &switched))));
        }
        prices
    }

    /// What it would add to simulate everything that the scene does not call for, too.
    pub fn all_on(&self, loaded: &Loaded<'_>, session: &mut Session) -> Option<Price> {
        let mut all = self.plan.clone();
        all.want(&[Wanted::All]);
        let small = small(self.camera);
        let switched = crate::lower::lower(loaded, &all, &small, &session.files, &mut session.problems)?;
        Some(self.price(false, &switched))
    }

    /// Renders both ways in turns. `is_on`: the other way is the one with less.
    fn price(&self, is_on: bool, switched: &Lowered) -> Price {
        let share = |seed| {
            let (own, other) = (self.seconds(&self.lowered, seed), self.seconds(switched, seed));
            if is_on { (own - other) / own } else { (other - own) / own }
        };
        median((0..ROUNDS).map(share).collect())
    }
}

/// The middle of an even number of shares, and how far they spread.
fn median(mut shares: Vec<f64>) -> Price {
    shares.sort_by(f64::total_cmp);
    let middle = shares.len() / 2;
    let spread = (shares[shares.len() - 1] - shares[0]) / 2.0;
    Price { share: (shares[middle - 1] + shares[middle]) / 2.0, spread }
}

/// The memory that this process holds, in bytes, where the system says.
fn resident_bytes() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok().map(|kilobytes| kilobytes << 10)
}
