//! The sampled spring wall: a stylus pressed against a spring whose force is computed at a rate and
//! held in between.
//!
//! A mass m with friction b meets a wall of stiffness K at x > 0. The force −K x is that of the
//! last sample, so that it lags by half a period on the average and gives energy on the way out.
//! Colgate and Schenkel (1997): passive in any hand if K < 2 b / T. While it is pressed in, the
//! pair (x, v) of a sample follows from the last by a matrix; it swings up once an eigenvalue
//! leaves the unit circle.

use crate::units::Seconds;

/// A rate with its limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallRow {
    /// Samples per second [Hz].
    pub rate_hz: f64,
    /// Stiffness from which on a stylus let go against the wall swings up, found on the motion
    /// itself [N/m].
    pub measured_n_m: f64,
    /// The same from the eigenvalues of a sample [N/m].
    pub theory_n_m: f64,
    /// Up to here the wall is passive in any hand (Colgate and Schenkel 1997) [N/m].
    pub passive_n_m: f64,
}

/// Apparent mass of a stylus's tip [kg] and its friction [N s/m]: a small desktop device.
const MASS_KG: f64 = 0.045;
const FRICTION_NS_M: f64 = 0.5;
/// Rates [Hz].
const RATES_HZ: [f64; 6] = [100.0, 250.0, 500.0, 1000.0, 2000.0, 4000.0];

/// All rates.
pub fn wall_rows() -> Vec<WallRow> {
    RATES_HZ
        .iter()
        .map(|rate_hz| {
            let period = 1.0 / rate_hz;
            WallRow {
                rate_hz: *rate_hz,
                measured_n_m: limit(|stiffness| swings_up(stiffness, period)),
                theory_n_m: limit(|stiffness| radius(stiffness, period) > 1.0),
                passive_n_m: 2.0 * FRICTION_NS_M / period,
            }
        })
        .collect()
}

/// The smallest stiffness that fails, by halving.
fn limit(fails: impl Fn(f64) -> bool) -> f64 {
    let (mut holds, mut breaks) = (1.0, 1e7);
    while breaks / holds > 1.0005 {
        let middle = f64::sqrt(holds * breaks);
        if fails(middle) { breaks = middle } else { holds = middle }
    }
    f64::sqrt(holds * breaks)
}

/// One period under a constant force, in closed form: m v′ = F − b v.
fn sample(stiffness: f64, period: Seconds, x: f64, v: f64) -> (f64, f64) {
    let force = -stiffness * x;
    let (rate, end) = (FRICTION_NS_M / MASS_KG, force / FRICTION_NS_M);
    let kept = libm::exp(-rate * period);
    (x + end * period + (v - end) * (1.0 - kept) / rate, end + (v - end) * kept)
}

/// Whether a stylus that is pressed in swings wider in the last quarter of the time than in the one
/// before.
fn swings_up(stiffness: f64, period: Seconds) -> bool {
    let (mut x, mut v) = (1e-3, 0.0);
    let (mut third, mut fourth) = (0.0_f64, 0.0_f64);
    const SAMPLES: u32 = 20_000;
    for at in 0..SAMPLES {
        (x, v) = sample(stiffness, period, x, v);
        let size = x.abs() + v.abs() * period;
        if !(size < 1e6) {
            return true;
        }
        match 4 * at / SAMPLES {
            2 => third = third.max(size),
            3 => fourth = fourth.max(size),
            _ => {}
        }
    }
    fourth > third && fourth > 1e-12
}

/// Largest eigenvalue of a sample.
fn radius(stiffness: f64, period: Seconds) -> f64 {
    let ((a, c), (b, d)) =
        (sample(stiffness, period, 1.0, 0.0), sample(stiffness, period, 0.0, 1.0));
    super::springs::largest_eigenvalue([[a, b], [c, d]])
}
