//! A short burst of noise: cloth, leather, a tip that slips.

use crate::sound::chance::Chance;
use crate::sound::filter::Filter;
use crate::sound::level::pascal;
use crate::sound::parameters::Band;
use core::f32::consts::{FRAC_1_SQRT_2, LN_10};

/// Noise in a band that rises and dies away.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Burst {
    start: u32,
    end: u32,
    low_cut: Filter,
    high_cut: Filter,
    level: f32,
    /// Root mean square when it is loudest [Pa].
    loudest_pa: f32,
    /// Of the rise, from 0 to 1 [per sample].
    rise: f32,
    fall: f32,
    risen: f32,
    fallen: f32,
}

impl Burst {
    /// The noise of `band`, `gain` times, that begins at sample `start`.
    pub(super) fn new(band: &Band, gain: f32, start: f32, rate_hz: f32) -> Self {
        let start = start.max(0.0) as u32;
        let rise = (band.rise_s * rate_hz).max(1.0);
        // Behind 60 dB it is over.
        let fall = (band.t60_s * rate_hz).max(1.0);
        // White noise of variance 1/3 that passed the band, to 1.
        let width = ((band.high_hz - band.low_hz) / (0.5 * rate_hz)).clamp(1e-6, 1.0);
        let loudest_pa = gain * pascal(band.level_db);
        Burst {
            start,
            end: start.saturating_add((rise + fall) as u32),
            low_cut: Filter::new(band.low_hz, FRAC_1_SQRT_2, rate_hz),
            high_cut: Filter::new(band.high_hz, FRAC_1_SQRT_2, rate_hz),
            level: loudest_pa / (width / 3.0).sqrt(),
            loudest_pa,
            rise: 1.0 / rise,
            fall: libm::expf(-3.0 * LN_10 / fall),
            risen: 0.0,
            fallen: 1.0,
        }
    }

    pub(super) fn end(&self) -> u32 {
        self.end
    }

    /// The sample `at`.
    pub(super) fn next(&mut self, at: u32, chance: &mut Chance) -> f32 {
        if at < self.start || self.end <= at {
            return 0.0;
        }
        let noise = self.high_cut.next(self.low_cut.next(chance.noise()).high).low;
        if self.risen < 1.0 {
            self.risen = (self.risen + self.rise).min(1.0);
        } else {
            self.fallen *= self.fall;
        }
        self.level * self.risen * self.fallen * noise
    }

    /// How loud it is, or will be.
    pub(super) fn loudness(&self, at: u32) -> f32 {
        if at < self.end { self.loudest_pa * self.fallen } else { 0.0 }
    }
}
