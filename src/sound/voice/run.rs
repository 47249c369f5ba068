//! A ball that runs through the gully: a rolling ball whose speed is known beforehand.

use crate::sound::parameters::{BALL_RADIUS_M, GULLY_ROLLING, GULLY_SPEEDS_M_S};
use crate::sound::rolling::RollingVoice;

/// The speed is told once in so many samples.
const BLOCK: u32 = 64;

/// A ball on its way through the gully, faster and faster.
#[derive(Debug, Clone)]
pub(super) struct Run {
    rolling: RollingVoice,
    /// When it ends [samples].
    until: u32,
    gain: f32,
}

impl Run {
    /// Lasts until sample `until`.
    pub(super) fn new(seed: u32, until: u32, gain: f32, rate_hz: f32) -> Run {
        let rolling = RollingVoice::over(&GULLY_ROLLING, BALL_RADIUS_M, seed, rate_hz);
        Run { rolling, until, gain }
    }

    /// The sample `at`.
    pub(super) fn next(&mut self, at: u32) -> f32 {
        if at.is_multiple_of(BLOCK) {
            let [begin, end] = GULLY_SPEEDS_M_S;
            let part = at as f32 / self.until as f32;
            let speed = if part < 1.0 { begin + (end - begin) * part } else { 0.0 };
            self.rolling.set(speed, 0.0);
        }
        self.gain * self.rolling.next()
    }

    /// About the loudest that is to come [Pa].
    pub(super) fn loudness(&self) -> f32 {
        self.gain * self.rolling.loudness()
    }
}
