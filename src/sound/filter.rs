//! Filters of second order, as sounds need them.

use core::f32::consts::PI;

/// The highest frequency that a filter is set to, as a fraction of the rate; above it the bilinear
/// transform leaves nothing of its shape.
const HIGHEST: f32 = 0.45;

/// Far below anything heard, far above the smallest normal number: keeps the tails of filters out
/// of the denormal numbers, which some processors add a hundred times slower.
pub(super) const TINY: f32 = 1e-20;

/// A filter of second order with low-pass, band-pass and high-pass outputs.
///
/// State variable filter by the trapezoidal rule: two integrators, stable for every setting, also
/// when it changes from sample to sample, and exact in `f32` at low frequencies, where the direct
/// forms are not (Zavalishin 2012, chapter 4).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Filter {
    damping: f32,
    a: [f32; 3],
    state: [f32; 2],
}

/// What comes out of a [`Filter`].
#[derive(Debug, Clone, Copy)]
pub(super) struct Passed {
    pub(super) low: f32,
    /// ω₀ s / (s² + ω₀ s/Q + ω₀²): Q at the centre.
    pub(super) band: f32,
    pub(super) high: f32,
}

impl Filter {
    /// `corner_hz`: ω₀/2π; `quality`: Q, 0.707 for the flattest low-pass.
    pub(super) fn new(corner_hz: f32, quality: f32, rate_hz: f32) -> Self {
        let mut filter = Filter::default();
        filter.set(corner_hz, quality, rate_hz);
        filter
    }

    /// Moves the corner; what rings in it goes on ringing.
    pub(super) fn set(&mut self, corner_hz: f32, quality: f32, rate_hz: f32) {
        let g = libm::tanf(PI * (corner_hz / rate_hz).min(HIGHEST));
        self.damping = 1.0 / quality;
        let a1 = 1.0 / (1.0 + g * (g + self.damping));
        self.a = [a1, g * a1, g * g * a1];
    }

    /// The next sample.
    pub(super) fn next(&mut self, input: f32) -> Passed {
        let [a1, a2, a3] = self.a;
        let [s1, s2] = self.state;
        let v3 = input - s2;
        let band = a1 * s1 + a2 * v3;
        let low = s2 + a2 * s1 + a3 * v3;
        self.state = [2.0 * band - s1, 2.0 * low - s2];
        Passed { low, band, high: input - self.damping * band - low }
    }

    /// Forgets what rings.
    pub(super) fn rest(&mut self) {
        self.state = [0.0; 2];
    }
}
