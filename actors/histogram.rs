//! How often values of each size were seen: counted by one thread, looked at by anybody.
//!
//! Nothing here waits or allocates after it was made, so that real-time threads may count.

use std::sync::atomic::{AtomicU64, Ordering};

/// Steps per power of two: a value is known to 1/32 of itself.
const STEPS: u64 = 32;
/// Where steps begin to grow [ns].
const FINE: u64 = STEPS;
const BUCKETS: usize = (64 - 5) * STEPS as usize + STEPS as usize;

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
}
