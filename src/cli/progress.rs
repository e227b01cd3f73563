//! The progress bar: passes, error so far, time left. Only on a terminal; elsewhere a line now and then.

use super::{interrupt, note};
use crate::render::film::ErrorEstimate;
use crate::render::{Monitor, Progress, Stop};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::sync::Mutex;
use std::time::Duration;

/// Where no terminal shows a bar, a line is written this often at first, and then at each doubling.
const FIRST_LINE_AFTER: f64 = 10.0;

/// Shows how far a render has come.
pub struct Bar {
    bar: Option<ProgressBar>,
    stop: Stop,
    state: Mutex<State>,
    quiet: bool,
}

/// What was said last.
struct State {
    /// Seconds after which the next line is due where no terminal is.
    next_line: f64,
    /// The last estimate of the error, and the passes it was made after.
    estimate: Option<(u32, ErrorEstimate)>,
}

/// The first pass after which a look at the error is worth its time; then at doublings.
const FIRST_LOOK: u32 = 4;

impl Bar {
    /// A bar for a render that stops by `stop`.
    pub fn new(stop: Stop, quiet: bool) -> Self {
        let bar = (!quiet && std::io::stderr().is_terminal()).then(|| {
            let style = ProgressStyle::with_template("{bar:30.cyan/dim} {percent:>3}%  {msg}")
                .expect("the template is well formed");
            let bar = ProgressBar::new(1000).with_style(style.progress_chars("━╸─"));
            bar.enable_steady_tick(Duration::from_millis(200));
            bar
        });
        let state = State { next_line: FIRST_LINE_AFTER, estimate: None };
        Self { bar, stop, state: Mutex::new(state), quiet }
    }

    /// Takes the bar off the terminal.
    pub fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// How many times what is foretold of an error is left, in four of five renders.
const FORETOLD: (f64, f64) = (0.7, 1.5);

/// The seconds left until the first of the stops, as an interval that narrows as they become fewer; `None` before anything is
/// known.
fn left(
    stop: &Stop,
    passes: u32,
    seconds: f64,
    estimate: Option<(u32, ErrorEstimate)>,
) -> Option<(f64, f64)> {
    let per_pass = seconds / f64::from(passes.max(1));
    let until = |needed: f64| ((needed - f64::from(passes)) * per_pass).max(0.0);
    let by_passes = stop.passes.map(|most| until(f64::from(most))).map(|s| (s, s));
    let by_time = stop.seconds.map(|most| (most - seconds).max(0.0)).map(|s| (s, s));
    let by_error = stop.error.zip(estimate).map(|(target, (at, estimate))| {
        let left = until(f64::from(at) * estimate.effort_to(target));
        let (least, most) = FORETOLD;
        (least * left, most * left)
    });
    let all = [by_passes, by_time, by_error].into_iter().flatten();
    all.reduce(|a, b| (a.0.min(b.0), a.1.min(b.1)))
}

/// A time left for people: `about 40 s left`, `30 s to 50 s left`.
fn left_text(left: Option<(f64, f64)>) -> String {
    match left.map(|(low, high)| (duration(low), duration(high))) {
        None => "unknown time left".to_owned(),
        Some((low, high)) if low == high => format!("{high} left"),
        Some((low, high)) => format!("{low} to {high} left"),
    }
}

impl Monitor for Bar {
    fn pass_done(&self, progress: &Progress<'_>) {
        if self.quiet {
            return;
        }
        let passes = progress.film.passes();
        let mut state = self.state.lock().expect("nothing panics while it holds the lock");
        let line_due = self.bar.is_none() && progress.seconds >= state.next_line;
        // The estimate walks over all pixels, so it is made anew only at doublings, or for a line.
        let doubled = self.bar.is_some() && passes.is_power_of_two() && passes >= FIRST_LOOK;
        if (doubled || line_due)
            && let Some(estimate) = progress.film.error()
        {
            state.estimate = Some((passes, estimate));
        }
        let left = left(&self.stop, passes, progress.seconds, state.estimate);
        let done = left.map_or(0.0, |(low, high)| progress.seconds / (progress.seconds + 0.5 * (low + high)));
        let mut text = format!("pass {passes}, {}", left_text(left));
        if let Some((at, estimate)) = state.estimate {
            let age = if at == passes { String::new() } else { format!(" at pass {at}") };
            text += &format!(", error {}{age}", percent(estimate.total()));
        }
        match &self.bar {
            Some(bar) => {
                bar.set_position((done * 1000.0) as u64);
                bar.set_message(text);
            }
            None if line_due => {
                state.next_line = progress.seconds * 2.0;
                note(format_args!("{:3.0}%  {text}\n", done * 100.0));
            }
            None => {}
        }
    }

    fn cancelled(&self) -> bool {
        interrupt::asked()
    }
}

/// A time for people: `0.42 s`, `12 s`, `3 min 20 s`, `2 h 5 min`.
pub fn duration(seconds: f64) -> String {
    match seconds {
        s if !s.is_finite() => "unknown time".to_owned(),
        s if s < 9.95 => format!("{s:.2} s"),
        s if s < 99.5 => format!("{s:.0} s"),
        s if s < 3570.0 => {
            let whole = s.round() as u64;
            format!("{} min {} s", whole / 60, whole % 60)
        }
        s => {
            let minutes = (s / 60.0).round() as u64;
            format!("{} h {} min", minutes / 60, minutes % 60)
        }
    }
}

/// A share for people: `1.3 %`, `0.042 %`.
pub fn percent(share: f64) -> String {
    let percent = share * 100.0;
    match percent {
        p if p >= 9.95 => format!("{p:.0} %"),
        p if p >= 0.095 => format!("{p:.1} %"),
        p => format!("{p:.3} %"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_left_is_to_the_first_stop_and_narrows() {
        let estimate = |spread: f64| {
            let interval = Some((0.02 / spread, 0.02 * spread));
            Some((100, ErrorEstimate { error: 0.02, interval, trimmed: 0.02, steady: 1.0, blur: None }))
        };
        let by_error = Stop { error: Some(0.01), ..Stop::default() };
        let (low, high) = left(&by_error, 100, 10.0, estimate(1.1)).unwrap();
        assert!(low < 30.0 && 30.0 < high, "four times the passes are needed: {low} to {high}");
        let (_, farther) = left(&by_error, 100, 10.0, estimate(1.3)).unwrap();
        assert!(farther > high, "the upper end of a wider interval has farther to fall");
        let later = ErrorEstimate {
            error: 0.02 / 3.0_f64.sqrt(),
            interval: Some((0.0105, 0.0127)),
            ..estimate(1.1).unwrap().1
        };
        let (late_low, late_high) = left(&by_error, 300, 30.0, Some((300, later))).unwrap();
        assert!(late_high - late_low < 0.6 * (high - low), "{late_low} to {late_high} after {low} to {high}");
        let or_time = Stop { seconds: Some(15.0), ..by_error };
        assert_eq!(left(&or_time, 100, 10.0, estimate(1.1)), Some((5.0, 5.0)));
        let passes = Stop { passes: Some(400), ..Stop::default() };
        assert_eq!(left(&passes, 100, 10.0, None), Some((30.0, 30.0)));
        assert_eq!(left(&by_error, 3, 10.0, None), None);
    }
}
