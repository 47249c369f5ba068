//! How late the servo's thread wakes and how long it works, counted while it runs.
//!
//! One thread counts, anybody looks: nothing here waits or allocates after it was made.

use crate::histogram::Histogram;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

/// A wake later than this is told apart [ns].
const LATE_NS: u64 = 100_000;
/// More processor time in one tick than this is too much: half a period [ns].
pub const OVERRUN_NS: u64 = 500_000;

/// Everything that is counted about the thread.
#[derive(Debug, Default)]
pub struct Timing {
    /// From a deadline to the wake [ns].
    pub lateness: Histogram,
    /// Processor time of a tick [ns].
    pub work: Histogram,
    late: AtomicU64,
    missed: AtomicU64,
    overruns: AtomicU64,
    lost_samples: AtomicU64,
    lost_buttons: AtomicU64,
    lost_rows: AtomicU64,
}

impl Timing {
    /// Counts a tick.
    pub fn note(&self, late_ns: u64, work: Duration, missed: u64) {
        let work_ns = u64::try_from(work.as_nanos()).unwrap_or(u64::MAX);
        self.lateness.note(late_ns);
        self.work.note(work_ns);
        add(&self.late, u64::from(late_ns > LATE_NS));
        add(&self.missed, missed);
        add(&self.overruns, u64::from(work_ns > OVERRUN_NS));
    }

    /// A sample found its ring full.
    pub fn lose_sample(&self) {
        add(&self.lost_samples, 1);
    }

    /// A row of telemetry found its ring full.
    pub fn lose_row(&self) {
        add(&self.lost_rows, 1);
    }

    /// A button found its ring full.
    pub fn lose_button(&self) {
        add(&self.lost_buttons, 1);
    }

    /// Ticks.
    pub fn ticks(&self) -> u64 {
        self.lateness.count()
    }

    /// Wakes later than 100 µs.
    pub fn late(&self) -> u64 {
        self.late.load(Ordering::Relaxed)
    }

    /// Deadlines without a tick.
    pub fn missed(&self) -> u64 {
        self.missed.load(Ordering::Relaxed)
    }

    /// Ticks that used more than half a period of processor time.
    pub fn overruns(&self) -> u64 {
        self.overruns.load(Ordering::Relaxed)
    }

    /// Samples that nobody took in time.
    pub fn lost_samples(&self) -> u64 {
        self.lost_samples.load(Ordering::Relaxed)
    }

    /// Rows of telemetry that nobody took in time.
    pub fn lost_rows(&self) -> u64 {
        self.lost_rows.load(Ordering::Relaxed)
    }

    /// Button edges that nobody took in time.
    pub fn lost_buttons(&self) -> u64 {
        self.lost_buttons.load(Ordering::Relaxed)
    }
}

fn add(counter: &AtomicU64, n: u64) {
    if n > 0 {
        counter.fetch_add(n, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn late_wakes_and_overruns_are_told_apart() {
        let timing = Timing::default();
        timing.note(100_000, Duration::from_micros(500), 0);
        timing.note(100_001, Duration::from_micros(501), 2);
        assert_eq!(
            [timing.ticks(), timing.late(), timing.missed(), timing.overruns()],
            [2, 1, 2, 1]
        );
    }
}
