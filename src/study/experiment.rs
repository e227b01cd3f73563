//! One run of a method, measured at every doubling of its passes.

use super::clock::{Clock, Seconds};
use super::curve::TimeOf;
use super::{Metrics, flip, measure};
use crate::math::Rgb;
use crate::output::Picture;
use crate::render::{Monitor, Progress, Settings, Stop, World, render};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

/// How far a picture was from the reference after some passes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Point {
    /// Passes so far.
    pub passes: u32,
    /// Time so far, without that for measuring.
    pub seconds: Seconds,
    /// The distance from the reference.
    pub metrics: Metrics,
    /// The error that the render itself estimated, noise and blur together, as √relMSE, and its interval.
    pub estimate: Option<(f64, Option<(f64, f64)>)>,
}

/// A run with one seed.
#[derive(Clone, PartialEq, Debug)]
pub struct Run {
    /// The seed.
    pub seed: u64,
    /// At passes 1, 2, 4, ….
    pub points: Vec<Point>,
}

/// What to compare with, and how pictures are shown.
pub struct Reference {
    /// The truth, as far as it is known.
    pub picture: Picture,
    /// relMSE that its own noise amounts to; `None` when the file does not tell.
    pub noise: Option<f64>,
    /// What brings radiance to the display.
    pub factor: f32,
}

/// How long a run goes on.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Length {
    /// As many doublings as fit into this time, by this clock.
    Seconds(f64, TimeOf),
    /// Exactly so many passes, a power of two.
    Passes(u32),
}

/// A run and its pictures.
pub struct Measured {
    /// The numbers.
    pub run: Run,
    /// The mean radiance at each of its points.
    pub pictures: Vec<Vec<Rgb>>,
}

/// Renders once, and measures at every doubling. `None` when `cancelled` says so before the end.
pub fn measure_run(
    world: &World,
    settings: &Settings,
    length: Length,
    reference: &Reference,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Option<Measured> {
    let watcher = Watcher::new(length, cancelled);
    let passes = match length {
        Length::Passes(passes) => passes,
        Length::Seconds(..) => u32::MAX,
    };
    let stop = Stop { passes: Some(passes), ..Stop::default() };
    render(world, &Settings { stop, ..*settings }, &watcher);
    if cancelled() {
        return None;
    }
    let seen = watcher.state.into_inner().expect("nothing panics while it holds the lock").seen;
    let (mut points, mut pictures) = (Vec::new(), Vec::new());
    for seen in seen {
        let picture = Picture { radiance: seen.mean, ..frame_like(&reference.picture) };
        let metrics = measure(&picture, &reference.picture, reference.factor, flip::PIXELS_PER_DEGREE);
        points.push(Point { passes: seen.passes, seconds: seen.seconds, metrics, estimate: seen.estimate });
        pictures.push(picture.radiance);
    }
    Some(Measured { run: Run { seed: settings.seed, points }, pictures })
}

/// A picture of the same size without pixels.
pub fn frame_like(picture: &Picture) -> Picture {
    Picture::new(picture.width, picture.height, Vec::new())
}

/// Keeps the film at every doubling.
struct Watcher<'a> {
    clock: Clock,
    length: Length,
    cancelled: &'a (dyn Fn() -> bool + Sync),
    finished: AtomicBool,
    state: Mutex<State>,
}

#[derive(Default)]
struct State {
    seen: Vec<Seen>,
    /// Time spent here, which is not the render's.
    aside: Seconds,
}

struct Seen {
    passes: u32,
    seconds: Seconds,
    mean: Vec<Rgb>,
    estimate: Option<(f64, Option<(f64, f64)>)>,
}

impl<'a> Watcher<'a> {
    fn new(length: Length, cancelled: &'a (dyn Fn() -> bool + Sync)) -> Self {
        let (finished, state) = (AtomicBool::new(false), Mutex::default());
        Self { clock: Clock::start(), length, cancelled, finished, state }
    }
}

impl Monitor for Watcher<'_> {
    fn pass_done(&self, progress: &Progress<'_>) {
        let passes = progress.film.passes();
        if !passes.is_power_of_two() {
            return;
        }
        let now = self.clock.seconds();
        let mut state = self.state.lock().expect("nothing panics while it holds the lock");
        let seconds = now.since(state.aside);
        let estimate = progress.film.error().map(|estimate| (estimate.total(), estimate.total_interval()));
        state.seen.push(Seen { passes, seconds, mean: progress.film.mean(), estimate });
        state.aside = state.aside.plus(self.clock.seconds().since(now));
        // The next doubling takes as long again.
        if matches!(self.length, Length::Seconds(most, time) if 2.0 * time.pick(seconds) > 1.25 * most) {
            self.finished.store(true, Ordering::Relaxed);
        }
    }

    fn cancelled(&self) -> bool {
        self.finished.load(Ordering::Relaxed) || (self.cancelled)()
    }
}
