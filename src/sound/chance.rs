//! The chance in sounds: variation and noise, from a seed.

use rand::Rng;
use rand_pcg::Pcg32;

/// A seeded generator; what it gives depends on nothing else.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Chance(Pcg32);

impl Chance {
    /// `stream` keeps apart what is drawn for different ends from one seed.
    pub(super) fn new(seed: u32, stream: u64) -> Self {
        // Neighbouring seeds must not give neighbouring first numbers: the state is spread by an
        // odd constant (Knuth 1998, section 6.4, the golden ratio of 64 bits).
        Chance(Pcg32::new(u64::from(seed).wrapping_mul(0x9e37_79b9_7f4a_7c15), stream))
    }

    /// Evenly from 0 to below 1.
    pub(super) fn unit(&mut self) -> f32 {
        // 24 bits are all that an f32 holds evenly.
        (self.0.next_u32() >> 8) as f32 * (1.0 / 16_777_216.0)
    }

    /// Evenly from -1 to below 1: white noise of variance 1/3.
    pub(super) fn noise(&mut self) -> f32 {
        2.0 * self.unit() - 1.0
    }

    /// Evenly from `low` to below `high`.
    pub(super) fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }

    /// A factor, evenly in decibels from -`spread_db` to `spread_db`.
    pub(super) fn level(&mut self, spread_db: f32) -> f32 {
        super::level::factor(spread_db * self.noise())
    }
}
