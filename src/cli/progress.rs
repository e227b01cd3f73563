//! The progress bar: passes, error so far, time left. Only on a terminal; elsewhere a line now and then.

use super::{interrupt, note};
use crate::render::{Monitor, Progress, Stop};
use indicatif::{ProgressBar, ProgressStyle};
use std::cell::Cell;
use std::io::IsTerminal;
use std::sync::Mutex;
use std::time::Duration;

/// Where no terminal shows a bar, a line is written this often at first, and then at each doubling.
const FIRST_LINE_AFTER: f64 = 10.0;

/// Shows how far a render has come.
pub struct Bar {
    bar: Option<ProgressBar>,
    stop: Stop,
    next_line: Mutex<Cell<f64>>,
    quiet: bool,
}

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
        Self { bar, stop, next_line: Mutex::new(Cell::new(FIRST_LINE_AFTER)), quiet }
    }

    /// Takes the bar off the terminal.
    pub fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }

    /// The share of the work that is done, by whichever stop comes first.
    fn done(&self, progress: &Progress<'_>, error: Option<f64>) -> f64 {
        let passes = progress.film.passes();
        let by_passes = self.stop.passes.map(|most| f64::from(passes) / f64::from(most));
        let by_time = self.stop.seconds.map(|most| progress.seconds / most);
        // The squared error falls as 1 / passes.
        let by_error = self.stop.error.zip(error).map(|(target, error)| (target / error) * (target / error));
        [by_passes, by_time, by_error].into_iter().flatten().fold(0.0, f64::max).min(1.0)
    }
}

impl Monitor for Bar {
    fn pass_done(&self, progress: &Progress<'_>) {
        if self.quiet {
            return;
        }
        let passes = progress.film.passes();
        let next_line = self.next_line.lock().expect("nothing panics while it holds the lock");
        let line_due = self.bar.is_none() && progress.seconds >= next_line.get();
        // The estimate walks over all pixels, so it is made anew only at doublings, or for a line.
        let look = passes.is_power_of_two() || line_due;
        let error = look.then(|| progress.film.error()).flatten().map(|estimate| estimate.error);
        let done = self.done(progress, error);
        let left = if done > 0.0 { progress.seconds * (1.0 - done) / done } else { f64::INFINITY };
        let mut text = format!("pass {passes}, {} left", duration(left));
        if let Some(error) = error {
            text += &format!(", error {}", percent(error));
        }
        match &self.bar {
            Some(bar) => {
                bar.set_position((done * 1000.0) as u64);
                if look || self.stop.error.is_none() {
                    bar.set_message(text);
                }
            }
            None if line_due => {
                next_line.set(progress.seconds * 2.0);
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
