//! The way of a sound that stays where it is, to both ears.

use super::head::{Arrival, Shadow};
use super::line::Line;
use super::surroundings::Surroundings;

/// Frames that are mixed in one go at most: where all slow changes are decided, so that the frame
/// of a decision does not depend on how the stream is cut.
pub const BLOCK: usize = 64;
/// Samples before a run that the fractional delay looks back at.
pub const BACK: usize = 3;

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

    /// Frames from a sound's beginning to where it is first heard.
    pub fn delay(&self) -> u64 {
        self.delay
    }

    /// What this ear hears of a line whose sound began at frame `at`, from frame `from` on: up to a
    /// block of frames. Before the sound comes, `out` stays as it is.
    pub fn hear(&mut self, line: &mut Line, at: u64, from: u64, out: &mut [f32]) {
        let silent = (at + self.delay).saturating_sub(from).min(out.len() as u64) as usize;
        let out = &mut out[silent..];
        let mut run = [0.0; BACK + BLOCK];
        let run = &mut run[..BACK + out.len()];
        line.copy((from + silent as u64).wrapping_sub(self.delay + BACK as u64), run);
        let [t0, t1, t2, t3] = self.taps;
        for (y, x) in out.iter_mut().zip(run.windows(BACK + 1)) {
            *y = t0 * x[3] + t1 * x[2] + t2 * x[1] + t3 * x[0];
        }
        self.shadow.apply(out);
    }
}

/// Weights of the samples 0, 1, 2, 3 frames ago for a delay of 1 + `fraction` frames: the cubic
/// through the four of them (Laakso et al. 1996, eq. 42).
pub fn lagrange(fraction: f32) -> [f32; 4] {
    let (d, e, f, g) = (fraction + 1.0, fraction, fraction - 1.0, fraction - 2.0);
    [-e * f * g / 6.0, d * f * g / 2.0, -d * e * g / 2.0, d * e * f / 6.0]
}
