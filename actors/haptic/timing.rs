//! How late the servo's thread wakes and how long it works, counted while it runs.
//!
//! One thread counts, anybody looks: nothing here waits or allocates after it was made.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

/// Steps per power of two: a value is known to 1/32 of itself.
const STEPS: u64 = 32;
/// Where steps begin to grow [ns].
const FINE: u64 = STEPS;
const BUCKETS: usize = (64 - 5) * STEPS as usize + STEPS as usize;

/// A wake later than this is told apart [ns].
const LATE_NS: u64 = 100_000;
/// More processor time in one tick than this is too much: half a period [ns].
pub const OVERRUN_NS: u64 = 500_000;

/// How often values of each size were seen.
#[derive(Debug)]
pub struct Histogram {
    buckets: Box<[AtomicU64]>,
    most: AtomicU64,
}

impl Default for Histogram {
    fn default() -> Self {
        let buckets = (0..BUCKETS).map(|_| AtomicU64::new(0)).collect();
        Histogram { buckets, most: AtomicU64::new(0) }
    }
}

fn bucket(value: u64) -> usize {
    if value < FINE {
        return value as usize;
    }
    let power = u64::from(value.ilog2() - FINE.ilog2());
    ((power + 1) * STEPS + (value >> power) - FINE) as usize
}

/// The largest value of a bucket.
fn top(bucket: usize) -> u64 {
    let bucket = bucket as u64;
    if bucket < FINE {
        return bucket;
    }
    let (power, step) = (bucket / STEPS - 1, bucket % STEPS);
    ((FINE + step + 1) << power).wrapping_sub(1)
}

impl Histogram {
    /// Counts a value. Only one thread does.
    pub fn note(&self, value: u64) {
        if let Some(count) = self.buckets.get(bucket(value)) {
            count.fetch_add(1, Ordering::Relaxed);
        }
        self.most.fetch_max(value, Ordering::Relaxed);
    }

    /// How many were counted.
    pub fn count(&self) -> u64 {
        self.buckets.iter().map(|count| count.load(Ordering::Relaxed)).sum()
    }

    /// The value that a share of all does not exceed, rounded up by at most 1/32; 0 if there are
    /// none.
    pub fn quantile(&self, share: f64) -> u64 {
        let wanted = (share.clamp(0.0, 1.0) * self.count() as f64).ceil() as u64;
        let mut seen = 0;
        for (i, count) in self.buckets.iter().enumerate() {
            seen += count.load(Ordering::Relaxed);
            if seen >= wanted.max(1) {
                return top(i).min(self.most());
            }
        }
        self.most()
    }

    /// The largest value.
    pub fn most(&self) -> u64 {
        self.most.load(Ordering::Relaxed)
    }
}

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
    fn every_value_lies_in_its_bucket() {
        let mut value = 1_u64;
        while value < u64::MAX / 3 {
            for near in [value - 1, value, value + 1] {
                let bucket = bucket(near);
                assert!(bucket < BUCKETS && top(bucket) >= near);
                assert!(bucket == 0 || top(bucket - 1) < near);
                assert!(top(bucket) - near <= near / STEPS);
            }
            value = value * 3 / 2 + 1;
        }
        assert!(bucket(u64::MAX) < BUCKETS);
    }

    #[test]
    fn quantiles_are_those_of_what_was_counted() {
        let histogram = Histogram::default();
        assert_eq!(histogram.quantile(0.5), 0);
        for value in 1..=1000 {
            histogram.note(value);
        }
        for (share, exact) in [(0.001, 1.0), (0.5, 500.0), (0.99, 990.0), (1.0, 1000.0)] {
            let found = histogram.quantile(share) as f64;
            assert!(exact <= found && found <= exact * (1.0 + 1.0 / 32.0), "{share}: {found}");
        }
        assert_eq!([histogram.count(), histogram.most()], [1000, 1000]);
    }

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
