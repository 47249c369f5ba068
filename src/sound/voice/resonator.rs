//! A body that rings at one frequency after it was struck.

use crate::sound::filter::TINY;
use core::f32::consts::{FRAC_1_PI, TAU};

/// One damped mode, as a complex number that turns and shrinks: exact for blows at samples, at any
/// rate and down to the lowest frequencies.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Resonator {
    turn: [f32; 2],
    state: [f32; 2],
    /// On both parts of the state; they make the answer to a constant force zero.
    out: [f32; 2],
}

impl Resonator {
    /// A mode of `frequency_hz` that falls by 60 dB in `t60_s`; a blow of 1 gives it `level`.
    pub(super) fn new(frequency_hz: f32, t60_s: f32, level: f32, rate_hz: f32) -> Self {
        let shrink = libm::expf(-core::f32::consts::LN_10 * 3.0 / (t60_s * rate_hz));
        let angle = TAU * frequency_hz / rate_hz;
        let turn = [shrink * libm::cosf(angle), shrink * libm::sinf(angle)];
        // The sum of the answer to one blow is out · (1/(1 - turn)).
        let (re, im) = (1.0 - turn[0], turn[1]);
        Resonator { turn, state: [0.0; 2], out: [level, -level * re / im] }
    }

    /// The next sample, with `blow` struck in it.
    pub(super) fn next(&mut self, blow: f32) -> f32 {
        let [re, im] = self.state;
        let [cos, sin] = self.turn;
        self.state = [re * cos - im * sin + blow + TINY, re * sin + im * cos];
        self.out[0] * self.state[0] + self.out[1] * self.state[1]
    }

    /// About what a blow of 1 gives that lasts for `length` samples: the envelope of the spectrum
    /// of half a sine.
    pub(super) fn answer(&self, length: f32) -> f32 {
        let [re, im] = self.turn;
        // |1 - turn| is about the angle per sample.
        let angle = ((1.0 - re) * (1.0 - re) + im * im).sqrt();
        let half_periods = angle * length * FRAC_1_PI;
        self.out[0] / (half_periods * half_periods).max(1.0)
    }

    /// How loud it is.
    pub(super) fn loudness(&self) -> f32 {
        self.out[0] * self.state[0].abs().max(self.state[1].abs())
    }
}
