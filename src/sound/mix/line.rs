//! Delay lines and sums.

use super::path::{BLOCK, lagrange};

/// The last frames of one channel, in a ring; any frame number will do, for the ring takes it
/// modulo its length.
#[derive(Debug, Clone)]
pub struct Line {
    ring: Box<[f32]>,
}

impl Line {
    /// Silence, that holds `frames` at least.
    pub fn new(frames: usize) -> Line {
        Line { ring: vec![0.0; frames.next_power_of_two()].into_boxed_slice() }
    }

    /// Silence again.
    pub fn clear(&mut self) {
        self.ring.fill(0.0);
    }

    /// Where `n` frames from `at` lie: two runs, the second one at the beginning of the ring.
    fn runs(&mut self, at: u64, n: usize) -> (&mut [f32], &mut [f32]) {
        let start = at as usize & (self.ring.len() - 1);
        let (low, high) = self.ring.split_at_mut(start);
        let first = n.min(high.len());
        let second = (n - first).min(low.len());
        (&mut high[..first], &mut low[..second])
    }

    /// Runs `each` over pairs of frames of the line, from `at` on, and of `samples`.
    fn pair(&mut self, at: u64, samples: &mut [f32], each: impl Fn(&mut f32, &mut f32)) {
        let (first, second) = self.runs(at, samples.len());
        let (head, tail) = samples.split_at_mut(first.len());
        first.iter_mut().zip(head).for_each(|(own, x)| each(own, x));
        second.iter_mut().zip(tail).for_each(|(own, x)| each(own, x));
    }

    /// Sets the frames from `at` on.
    pub fn write(&mut self, at: u64, samples: &mut [f32]) {
        self.pair(at, samples, |own, x| *own = *x);
    }

    /// The frames from `at` on.
    pub fn copy(&mut self, at: u64, out: &mut [f32]) {
        self.pair(at, out, |own, x| *x = *own);
    }

    /// Adds `gain` times the frames from `at` on to `sum`.
    pub fn add_to(&mut self, at: u64, sum: &mut [f32], gain: f32) {
        self.pair(at, sum, |own, x| *x += gain * *own);
    }

    /// Adds to the frames from `at` on.
    pub fn add(&mut self, at: u64, samples: &mut [f32]) {
        self.pair(at, samples, |own, x| *own += *x);
    }

    /// Moves the frames from `at` on out of the line, and adds them to `sum`.
    pub fn take(&mut self, at: u64, sum: &mut [f32]) {
        self.pair(at, sum, |own, x| *x += std::mem::take(own));
    }

    /// What was there `delay` frames before frame `now`; 2 at least.
    pub fn read(&self, now: u64, delay: f32) -> f32 {
        let mask = self.ring.len() - 1;
        let whole = delay as usize;
        let taps = lagrange(delay - whole as f32);
        let newest = (now as usize).wrapping_sub(whole).wrapping_add(1);
        taps.iter()
            .enumerate()
            .map(|(back, tap)| tap * self.ring[newest.wrapping_sub(back) & mask])
            .sum()
    }
}

/// Up to a block of frames of all that is heard, each channel a sum in a fixed order.
#[derive(Debug, Clone)]
pub struct Sums {
    /// Straight to the left and the right ear [Pa].
    pub direct: [[f32; BLOCK]; 2],
    /// By way of one wall [Pa].
    pub reflected: [[f32; BLOCK]; 2],
    /// Into the room, as at 1 m from the source [Pa].
    pub send: [f32; BLOCK],
}

impl Sums {
    /// Nothing yet.
    pub const SILENCE: Sums =
        Sums { direct: [[0.0; BLOCK]; 2], reflected: [[0.0; BLOCK]; 2], send: [0.0; BLOCK] };

    /// All of its channels.
    pub fn channels(&mut self) -> [&mut [f32; BLOCK]; 5] {
        let ([left, right], [early_left, early_right]) =
            (self.direct.each_mut(), self.reflected.each_mut());
        [left, right, early_left, early_right, &mut self.send]
    }
}
