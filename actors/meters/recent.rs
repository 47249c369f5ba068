//! The last values of something: noted by one thread, looked at by another, without waiting.

use hapticbillard::quantile::nearest_rank;
use hapticbillard::renderer::Spread;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

/// The last durations.
#[derive(Debug)]
pub struct Recent {
    values_ns: Box<[AtomicU64]>,
    noted: AtomicU64,
}

impl Recent {
    /// Room for so many; the oldest gives way.
    pub fn of(length: usize) -> Self {
        let values_ns = (0..length.max(1)).map(|_| AtomicU64::new(0)).collect();
        Recent { values_ns, noted: AtomicU64::new(0) }
    }

    /// Notes one. Only one thread does.
    pub fn note(&self, value: Duration) {
        let noted = self.noted.load(Ordering::Relaxed);
        let place = (noted % self.values_ns.len() as u64) as usize;
        let value_ns = u64::try_from(value.as_nanos()).unwrap_or(u64::MAX);
        self.values_ns[place].store(value_ns, Ordering::Relaxed);
        self.noted.store(noted + 1, Ordering::Release);
    }

    /// How many were noted since the start.
    pub fn noted(&self) -> u64 {
        self.noted.load(Ordering::Acquire)
    }

    /// Half of the last ones, 99 of 100 and all are not longer; none if none was noted.
    pub fn spread(&self) -> Option<Spread> {
        let filled = self.noted().min(self.values_ns.len() as u64) as usize;
        let values = self.values_ns[..filled].iter();
        let mut values: Vec<u64> = values.map(|value| value.load(Ordering::Relaxed)).collect();
        values.sort_unstable();
        let at = |share: f64| Some(nearest_rank(&values, share)? as f64 * 1e-9);
        Some(Spread { median_s: at(0.5)?, p99_s: at(0.99)?, most_s: at(1.0)? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_last_values_count() {
        let recent = Recent::of(100);
        assert_eq!(recent.spread(), None);
        recent.note(Duration::from_secs(9));
        assert_eq!(recent.spread().unwrap().median_s, 9.0);
        for seconds in 1..=100 {
            recent.note(Duration::from_secs(seconds));
        }
        let expected = Spread { median_s: 50.0, p99_s: 99.0, most_s: 100.0 };
        assert_eq!((recent.spread(), recent.noted()), (Some(expected), 101));
    }
}
