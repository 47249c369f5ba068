//! The way of a sound that stays where it is, to both ears.

use super::bus::Lane;
use super::head::{Arrival, Shadow};
use super::surroundings::Surroundings;

/// Frames that are mixed in one go at most: where all slow changes are decided, so that the frame
/// of a decision does not depend on how the stream is cut.
pub const BLOCK: usize = 64;
/// Samples before a run that the fractional delay looks back at.
pub const BACK: usize = 3;

/// The samples of a source: `BACK` old ones and up to `BLOCK` new ones.
pub type Run = [f32; BACK + BLOCK];

/// The way to one ear: a delay, a factor and the shadow of the head.
#[derive(Debug, Clone, Copy)]
pub struct EarPath {
    /// Whole frames of the delay, but for the one in `taps`.
    delay: u64,
    /// The gain and a delay of one to two frames (Lagrange, third order), newest sample first.
    taps: [f32; BACK + 1],
    shadow: Shadow,
}

impl EarPath {
    /// Nothing has gone this way yet. `gain` comes on top of the arrival's own.
    pub fn new(arrival: &Arrival, gain: f32, around: &Surroundings) -> EarPath {
        let frames = around.delay(arrival.path_m).max(1.0);
        let whole = frames.floor();
        let taps = lagrange(frames - whole).map(|tap| tap * gain * arrival.gain);
        EarPath {
            delay: whole as u64 - 1,
            taps,
            shadow: Shadow::new(arrival.alpha, around.rate_hz),
        }
    }

    /// What this ear hears of the first `out.len()` new samples of a run, but for the delay.
    pub fn hear(&mut self, run: &Run, out: &mut [f32]) {
        let [t0, t1, t2, t3] = self.taps;
        for (y, x) in out.iter_mut().zip(run.windows(BACK + 1)) {
            *y = t0 * x[3] + t1 * x[2] + t2 * x[1] + t3 * x[0];
        }
        self.shadow.apply(out);
    }

    /// Hands on what was heard from frame `at` on.
    pub fn deliver(&self, lane: &mut Lane, at: u64, heard: &[f32]) {
        lane.add(at + self.delay, heard, 1.0);
    }
}

/// Weights of the samples 0, 1, 2, 3 frames ago for a delay of 1 + `fraction` frames: the cubic
/// through the four of them (Laakso et al. 1996, eq. 42).
pub fn lagrange(fraction: f32) -> [f32; 4] {
    let (d, e, f, g) = (fraction + 1.0, fraction, fraction - 1.0, fraction - 2.0);
    [-e * f * g / 6.0, d * f * g / 2.0, -d * e * g / 2.0, d * e * f / 6.0]
}
