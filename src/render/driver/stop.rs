//! When a render stops.
//!
//! To stop as soon as an estimate happens to be low would favour pictures that underrate their error (Kirk & Arvo
//! 1991). So the error is looked at after 16 passes and then at doublings only, and each look says how many passes the
//! target takes; where that is less than another doubling, so many are made and looked at once more, though never less than a
//! tenth.

use super::{Film, Stop, StoppedBy};
use crate::render::film::ErrorEstimate;

/// The first pass after which the error is looked at.
const FIRST_LOOK: u32 = 16;

/// How late a time stop may be: a second, or 1 % of long renders.
const MOST_LATE: (f64, f64) = (1.0, 0.01);

/// Decides before each pass whether it is made.
pub struct Stopping {
    stop: Stop,
    /// The number of passes after which the error is looked at next.
    next_look: u32,
}

impl Stopping {
    /// For a render that begins.
    pub fn new(stop: Stop) -> Self {
        Self { stop, next_look: FIRST_LOOK }
    }

    /// Whether the film is good enough, or time is up.
    pub fn reason(&mut self, film: &Film, seconds: f64) -> Option<StoppedBy> {
        let passes = film.passes();
        let unset = self.stop == Stop::default();
        if self.stop.passes.is_some_and(|most| passes >= most) || unset && passes >= 1 {
            return Some(StoppedBy::Passes);
        }
        if self.stop.seconds.is_some_and(|most| is_late(most, passes, seconds)) {
            return Some(StoppedBy::Time);
        }
        let target = self.stop.error.filter(|_| passes >= self.next_look)?;
        let estimate = film.error()?;
        if estimate.high() <= target {
            return Some(StoppedBy::Error);
        }
        self.next_look = next_look(passes, &estimate, target);
        None
    }

    /// Whether so much time has passed that a pass under way is late.
    pub fn is_overdue(&self, seconds: f64) -> bool {
        let (least, share) = MOST_LATE;
        self.stop.seconds.is_some_and(|most| seconds > most + least.max(share * most))
    }
}

/// Whether the next pass would end later than allowed, if it takes as long as the others did.
fn is_late(most: f64, passes: u32, seconds: f64) -> bool {
    let next_ends = seconds * f64::from(passes + 1) / f64::from(passes.max(1));
    let (least, share) = MOST_LATE;
    passes >= 1 && (seconds >= most || next_ends > most + 0.5 * least.max(share * most))
}

/// As many passes as the target takes, but at least a tenth more than there are and at most twice as many.
fn next_look(passes: u32, estimate: &ErrorEstimate, target: f64) -> u32 {
    let needed = f64::from(passes) * estimate.effort_to(target);
    let (least, most) = (passes.saturating_add(passes.div_ceil(10)), passes.saturating_mul(2));
    (needed.ceil() as u32).clamp(least, most)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pass_that_would_end_late_is_not_begun() {
        assert!(!is_late(12.0, 0, 0.0), "the first is always made");
        assert!(is_late(12.0, 2, 10.0), "the third would end after 15 s");
        assert!(!is_late(12.0, 100, 11.9));
        assert!(is_late(12.0, 100, 12.0));
        assert!(!is_late(1000.0, 100, 995.0), "1 % of a long render is not late");
    }

    #[test]
    fn the_next_look_is_where_the_target_is_expected() {
        let interval = Some((0.018, 0.022));
        let estimate = ErrorEstimate { error: 0.02, interval, trimmed: 0.02, steady: 1.0, blur: None };
        assert_eq!(next_look(64, &estimate, 0.02), 78); // 64 · 1.1²
        assert_eq!(next_look(64, &estimate, 0.001), 128);
        assert_eq!(next_look(64, &estimate, 0.0215), 71);
    }
}
