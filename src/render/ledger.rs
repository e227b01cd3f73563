//! What each object costs: the time of the paths that meet it, the rays that leave it, the noise of what is seen of it.
//!
//! A ledger belongs to one thread, on which a whole render then runs. The time between two vertices of a path goes to the
//! object of the first: it is spent on scattering there, on looking for light from there, and on the ray that leaves. One
//! path in [`TIMED`] is timed, as clocks cost time themselves.

use super::shape::SourceId;
use crate::math::Rgb;
use rustc_hash::FxHashMap;
use std::cell::RefCell;
use std::time::Instant;

/// One path in so many is timed.
pub const TIMED: u64 = 4;
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
    /// Nanoseconds that went to neither: the system ran something else.
    pub interrupted: Account,
    /// Of photons, from their lights to the map.
    pub photons: Account,
    /// By [`SourceId`].
    pub objects: Vec<Account>,
    samples: Vec<Sample>,
    paths: u64,
    whose: Option<Whose>,
    /// When its turn began, of paths that are timed.
    since: Option<Instant>,
    is_timed: bool,
    /// How often something was shared.
    shared: u64,
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
    Object(SourceId),
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
    LEDGER.set(Some(Ledger::default()));
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
            return;
        }
        if let Some(sample) = ledger.samples.last_mut() {
            sample.first.get_or_insert(object);
        }
        ledger.account(Whose::Object(object)).rays += 1;
        ledger.switch(Some(Whose::Object(object)));
    });
}

/// A ray looks for light.
pub fn look() {
    write(|ledger| {
        if let Some(whose @ Whose::Object(_)) = ledger.whose {
            ledger.account(whose).rays += 1;
        }
    });
}

/// All paths are done, and an object asks for a part of what one of them has found.
pub fn share(object: SourceId) {
    write(|ledger| {
        ledger.is_timed = ledger.shared.is_multiple_of(TIMED);
        ledger.shared += 1;
        ledger.switch(Some(Whose::Object(object)));
    });
}

/// The last paths have ended: each for a pixel, with its radiance.
pub fn end_paths(seen: &[(u64, Rgb)]) {
    write(|ledger| {
        ledger.switch(None);
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

    fn account(&mut self, whose: Whose) -> &mut Account {
        match whose {
            Whose::Camera => &mut self.camera,
            Whose::Photons => &mut self.photons,
            Whose::Object(SourceId(id)) => {
                let id = id as usize;
                if self.objects.len() <= id {
                    self.objects.resize_with(id + 1, Account::default);
                }
                &mut self.objects[id]
            }
        }
    }

    /// Books the time since the last entry, and begins to count for `next`.
    fn switch(&mut self, next: Option<Whose>) {
        let now = self.is_timed.then(Instant::now);
        if let (Some(whose), Some(since), Some(now)) = (self.whose, self.since, now) {
            let nanos = now.duration_since(since).as_nanos() as u64;
            let is_own = nanos < LONGEST || matches!(whose, Whose::Photons);
            let account = if is_own { self.account(whose) } else { &mut self.interrupted };
            account.nanos += nanos;
        }
        (self.whose, self.since) = (next, now);
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
            self.account(first.map_or(Whose::Camera, Whose::Object)).noise += noise;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
        // Of each pixel the samples are 0, 2, 4, 6 and 1, 3, 5, 7: each lies 3, 1, 1, 3 from its mean. Luminances are rounded.
        assert!((ledger.objects[1].noise - 40.0).abs() < 1e-4 && ledger.objects[0].noise == 0.0);
        assert!(close().is_none());
    }
}
