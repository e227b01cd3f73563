//! Time as the user waits for it, and as the processor spends it.

use cpu_time::ProcessTime;
use std::time::Instant;

/// Seconds since a moment.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Seconds {
    /// On the wall.
    pub wall: f64,
    /// Of all threads of this process together, those that have ended too; that of the wall where the system does not tell.
    pub cpu: f64,
}

impl Seconds {
    /// The time between `earlier` and this.
    pub fn since(self, earlier: Self) -> Self {
        Self { wall: self.wall - earlier.wall, cpu: self.cpu - earlier.cpu }
    }

    /// Both times together.
    pub fn plus(self, other: Self) -> Self {
        Self { wall: self.wall + other.wall, cpu: self.cpu + other.cpu }
    }
}

/// A running clock.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    start: Instant,
    cpu_start: Option<f64>,
}

impl Clock {
    /// Starts a clock.
    pub fn start() -> Self {
        Self { start: Instant::now(), cpu_start: process_seconds() }
    }

    /// The time since then.
    pub fn seconds(&self) -> Seconds {
        let wall = self.start.elapsed().as_secs_f64();
        let cpu = process_seconds().zip(self.cpu_start).map_or(wall, |(now, start)| now - start);
        Seconds { wall, cpu }
    }
}

/// The processor time of all threads that this process has, and of those that it had.
fn process_seconds() -> Option<f64> {
    ProcessTime::try_now().ok().map(|time| time.as_duration().as_secs_f64())
}

#[cfg(test)]
mod tests {
    use super::*;
    use cpu_time::ThreadTime;
    use std::time::Duration;

    #[test]
    fn work_takes_time_on_both() {
        let clock = Clock::start();
        let mut sum = 0.0_f64;
        while clock.seconds().wall < 0.05 {
            sum += (0..1000).map(f64::from).map(f64::sqrt).sum::<f64>();
        }
        let seconds = clock.seconds();
        assert!(sum > 0.0 && seconds.wall >= 0.05 && seconds.cpu > 0.0, "{seconds:?}");
    }

    #[test]
    fn a_thread_that_has_ended_leaves_its_time() {
        const WORK: Duration = Duration::from_millis(20);
        let clock = Clock::start();
        let work = || {
            let start = ThreadTime::now();
            while start.elapsed() < WORK {
                std::hint::spin_loop();
            }
        };
        std::thread::spawn(work).join().expect("it only waits");
        assert!(clock.seconds().cpu >= WORK.as_secs_f64(), "{:?}", clock.seconds());
    }
}
