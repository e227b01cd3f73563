//! What each object costs: the time of the paths that meet it, the rays that leave it, the noise of what is seen of it.
//!
//! A ledger belongs to one thread, on which a whole render then runs. The time between two vertices of a path goes to the
//! object of the first: it is spent on scattering there, on looking for light from there, and on the ray that leaves. One
//! path in [`TIMED`] is timed, as clocks cost time themselves; what a look at the clock takes is no part of what it tells.
//!
//! The sum of all accounts is the time of the render, but for what the system did meanwhile. An account is no forecast:
//! without an object, rays that it stopped go on and meet what is behind it.

use super::shape::SourceId;
use crate::math::Rgb;
use rustc_hash::FxHashMap;
use std::cell::RefCell;
use std::time::Instant;

/// One path in so many is timed. Groups of pixels have 16 paths, the first of which prepares what all of them need: with an
/// odd number each comes its turn.
pub const TIMED: u64 = 5;
/// One vertex in so many of a photon ends a stretch of time that may be found to be interrupted.
const PHOTON_STRETCH: u64 = 16;
/// So many rays to what others found are timed together, for one alone takes hardly longer than a look at the clock.
const SHARED_STRETCH: usize = 16;
/// No vertex takes longer than this, in nanoseconds: the system ran something else meanwhile.
const LONGEST: u64 = 500_000;

thread_local! {
    static LEDGER: RefCell<Option<Ledger>> = const { RefCell::new(None) };
}

/// The books of one thread.
#[derive(Default)]
pub struct Ledger {
    /// Of the camera: its rays, and the film.
    pub camera: Account,
    /// Nanoseconds that went to none: the system ran something else.
    pub interrupted: Account,
    /// Of photons, on their way. All of it is timed.
    pub photons: Account,
    /// Of the map of photons: all of it, with what the system did meanwhile.
    pub map: Account,
    /// Of the film, likewise.
    pub film: Account,
    /// By [`SourceId`].
    pub objects: Vec<Account>,
    samples: Vec<Sample>,
    paths: u64,
    whose: Option<Whose>,
    /// When its turn began, of paths that are timed.
    since: Option<Instant>,
    is_timed: bool,
    /// Who asked for a part of what others found, since the clock was looked at.
    sharers: Vec<SourceId>,
    /// Stretches of sharing, groups of paths, vertices of photons so far.
    stretches: u64,
    groups: u64,
    photon_vertices: u64,
    /// How often the clock was looked at, and the nanoseconds that it takes.
    looks: u64,
    nanos_a_look: f64,
}

/// Costs of one of them.
#[derive(Clone, Copy, Default)]
pub struct Account {
    /// Nanoseconds of the paths that were timed.
    pub nanos: u64,
    /// Rays: those that leave it to go on, and those that look for light.
    pub rays: u64,
    /// The sum of the squared distances of samples from the mean of their pixels, of what is seen first.
    pub noise: f64,
}

/// Whose time is running.
#[derive(Clone, Copy)]
enum Whose {
    Camera,
    Photons,
    Map,
    Film,
    Object(SourceId),
    /// Those of [`Ledger::sharers`], in equal parts.
    Sharers,
}

/// A path from the camera.
#[derive(Default)]
struct Sample {
    pixel: u64,
    first: Option<SourceId>,
    luminance: f32,
}

/// Opens the books of this thread.
pub fn open() {
    LEDGER.set(Some(Ledger { nanos_a_look: nanos_a_look(), ..Ledger::default() }));
}

/// What a look at the clock takes, in nanoseconds: in the quickest of a few series, which nothing interrupts.
fn nanos_a_look() -> f64 {
    const LOOKS: u32 = 64;
    let series = |_| {
        let start = Instant::now();
        let mut last = start;
        for _ in 0..LOOKS {
            last = Instant::now();
        }
        last.duration_since(start).as_nanos() as f64 / f64::from(LOOKS)
    };
    (0..32).map(series).fold(f64::INFINITY, f64::min)
}

/// Closes the books of this thread.
pub fn close() -> Option<Ledger> {
    let mut ledger = LEDGER.take()?;
    ledger.share_noise();
    Some(ledger)
}

/// Photons are on their way; nothing is.
pub fn photons(are_flying: bool) {
    write(|ledger| {
        ledger.is_timed = true;
        ledger.switch(are_flying.then_some(Whose::Photons));
    });
}

/// A pass is added to the film; it is done.
pub fn film(is_written: bool) {
    write(|ledger| {
        ledger.is_timed = true;
        ledger.switch(is_written.then_some(Whose::Film));
    });
}

/// The rays of a group of pixels are made.
pub fn begin_group() {
    write(|ledger| {
        ledger.is_timed = ledger.groups.is_multiple_of(TIMED);
        ledger.groups += 1;
        ledger.switch(Some(Whose::Camera));
    });
}

/// A path leaves the camera.
pub fn begin_path() {
    write(|ledger| {
        ledger.is_timed = ledger.paths.is_multiple_of(TIMED);
        ledger.paths += 1;
        ledger.samples.push(Sample::default());
        ledger.camera.rays += 1;
        ledger.switch(Some(Whose::Camera));
    });
}

/// A ray has met an object.
pub fn arrive(object: SourceId) {
    write(|ledger| {
        if let Some(Whose::Photons) = ledger.whose {
            ledger.photon_vertices += 1;
            if ledger.photon_vertices.is_multiple_of(PHOTON_STRETCH) {
                ledger.switch(Some(Whose::Photons));
            }
            return;
        }
        if let Some(sample) = ledger.samples.last_mut() {
            sample.first.get_or_insert(object);
        }
        ledger.account(object).rays += 1;
        ledger.switch(Some(Whose::Object(object)));
    });
}

/// A ray looks for light.
pub fn look() {
    write(|ledger| {
        if let Some(Whose::Object(object)) = ledger.whose {
            ledger.account(object).rays += 1;
        }
    });
}

/// All paths are done, and an object asks for a part of what one of them has found.
pub fn share(object: SourceId) {
    write(|ledger| {
        let goes_on = matches!(ledger.whose, Some(Whose::Sharers)) && ledger.sharers.len() < SHARED_STRETCH;
        if !goes_on {
            ledger.is_timed = ledger.stretches.is_multiple_of(TIMED);
            ledger.stretches += 1;
            ledger.switch(Some(Whose::Sharers));
        }
        ledger.account(object).rays += 1;
        ledger.sharers.push(object);
    });
}

/// The last paths have ended: each for a pixel, with its radiance.
pub fn end_paths(seen: &[(u64, Rgb)]) {
    write(|ledger| {
        // What is left to do of them, until the next ones begin.
        ledger.switch(Some(Whose::Camera));
        let first = ledger.samples.len().saturating_sub(seen.len());
        for (sample, &(pixel, radiance)) in ledger.samples[first..].iter_mut().zip(seen) {
            (sample.pixel, sample.luminance) = (pixel, radiance.luminance());
        }
    });
}

fn write(entry: impl FnOnce(&mut Ledger)) {
    LEDGER.with_borrow_mut(|ledger| {
        if let Some(ledger) = ledger {
            entry(ledger);
        }
    });
}

impl Ledger {
    /// Seconds of an account of paths: those that were timed stand for all.
    pub fn seconds(&self, account: &Account) -> f64 {
        let timed = self.paths.div_ceil(TIMED).max(1);
        account.nanos as f64 * 1e-9 * (self.paths as f64 / timed as f64)
    }

    /// Seconds that went into looking at the clock.
    pub fn clock_seconds(&self) -> f64 {
        self.looks as f64 * self.nanos_a_look * 1e-9
    }

    fn account(&mut self, SourceId(id): SourceId) -> &mut Account {
        let id = id as usize;
        if self.objects.len() <= id {
            self.objects.resize_with(id + 1, Account::default);
        }
        &mut self.objects[id]
    }

    /// Books the time since the last entry, if that was timed, and begins to count for `next`.
    fn switch(&mut self, next: Option<Whose>) {
        let now = (self.is_timed || self.since.is_some()).then(Instant::now);
        self.looks += u64::from(now.is_some());
        if let (Some(whose), Some(since), Some(now)) = (self.whose, self.since, now) {
            let nanos = now.duration_since(since).as_nanos() as u64;
            // The map, made when the last photon has landed, and the film are one piece of work.
            let whose = match whose {
                Whose::Photons if next.is_none() => Whose::Map,
                whose => whose,
            };
            let is_own = matches!(whose, Whose::Map | Whose::Film) || nanos < LONGEST;
            self.book(whose, is_own, nanos.saturating_sub(self.nanos_a_look as u64));
        }
        self.sharers.clear();
        (self.whose, self.since) = (next, now.filter(|_| self.is_timed));
    }

    fn book(&mut self, whose: Whose, is_own: bool, nanos: u64) {
        match whose {
            _ if !is_own => self.interrupted.nanos += nanos,
            Whose::Camera => self.camera.nanos += nanos,
            Whose::Photons => self.photons.nanos += nanos,
            Whose::Map => self.map.nanos += nanos,
            Whose::Film => self.film.nanos += nanos,
            Whose::Object(object) => self.account(object).nanos += nanos,
            Whose::Sharers => {
                let sharers = std::mem::take(&mut self.sharers);
                let part = nanos / sharers.len().max(1) as u64;
                sharers.iter().for_each(|&object| self.account(object).nanos += part);
                self.sharers = sharers;
            }
        }
    }

    fn share_noise(&mut self) {
        let mut sums: FxHashMap<u64, (f64, f64)> = FxHashMap::default();
        for sample in &self.samples {
            let (sum, count) = sums.entry(sample.pixel).or_default();
            (*sum, *count) = (*sum + f64::from(sample.luminance), *count + 1.0);
        }
        for Sample { pixel, first, luminance } in std::mem::take(&mut self.samples) {
            let (sum, count) = sums[&pixel];
            let noise = (f64::from(luminance) - sum / count).powi(2);
            match first {
                Some(object) => self.account(object).noise += noise,
                None => self.camera.noise += noise,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_stretch_of_a_timed_path_is_booked_and_no_other_path_is() {
        const STRETCH: std::time::Duration = std::time::Duration::from_micros(50);
        open();
        for _ in 0..2 * TIMED {
            begin_path();
            arrive(SourceId(0));
            let start = Instant::now();
            while start.elapsed() < STRETCH {}
        }
        for _ in 0..SHARED_STRETCH {
            share(SourceId(1));
        }
        end_paths(&[]);
        let ledger = close().expect("it was opened here");
        // Of two paths, or of none if the system ran something else meanwhile.
        let booked = ledger.objects[0].nanos + ledger.interrupted.nanos;
        assert!(booked >= 2 * 45_000, "{booked}");
        assert_eq!((ledger.looks, ledger.objects[1].rays), (2 * 3 + 2, SHARED_STRETCH as u64));
    }

    #[test]
    fn rays_and_noise_go_to_whom_a_path_is_with() {
        open();
        for path in 0..2 * TIMED {
            begin_path();
            arrive(SourceId(1));
            look();
            arrive(SourceId(0));
            end_paths(&[(path % 2, Rgb::gray(path as f32))]);
        }
        let ledger = close().expect("it was opened here");
        assert_eq!((ledger.objects[1].rays, ledger.objects[0].rays), (4 * TIMED, 2 * TIMED));
        // Of each pixel the samples are 0, 2, 4, 6, 8 and 1, 3, 5, 7, 9: each lies 4, 2, 0, 2, 4 from its mean. Luminances are
        // rounded.
        assert!((ledger.objects[1].noise - 80.0).abs() < 1e-4 && ledger.objects[0].noise == 0.0);
        assert!(close().is_none());
    }
}
