//! How likely a stroke that errs still does what it shall, in closed form.
//!
//! A stroke's direction errs by its azimuth and, through squirt, by where the tip meets the ball
//! sideways. A ball that is met turns the error into one of its own way, larger by
//! `A = d/(2 R cos β)` for a way d to the ghost and a cut β: from
//! `sin β = (distance from the ball's middle to the way) / 2 R`.

use crate::ai::noise::StrokeNoise;

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// Turn of the cue ball away from the side that the tip hits, per offset over radius [rad]:
/// 0.091 by simulation with a level cue; a butt that is raised by 3° makes the ball swerve back a
/// little.
const SQUIRT_RAD: f64 = 0.085;
/// Even a perfect arm is reckoned to err by this [rad], so that its shots have an order.
const AZIMUTH_LEAST_RAD: f64 = 0.01 * DEGREE;
/// Error of a ball's way that each cushion adds, as what is reckoned about it is coarse [rad].
pub(super) const CUSHION_RAD: f64 = 0.4 * DEGREE;
/// Error that throw adds to the way of a ball that another touches from the start [rad].
pub(super) const FROZEN_RAD: f64 = 2.0 * DEGREE;

/// Error of a ball's way off another, as throw is reckoned coarsely [rad].
pub(super) const THROW_RAD: f64 = 0.5 * DEGREE;
/// Error of the cue ball's way off a ball: it slides along the tangent only without follow or draw
/// [rad].
pub(super) const CAROM_RAD: f64 = 2.0 * DEGREE;

/// Standard deviation of the cue ball's direction [rad].
pub(super) fn cue_ball_sigma_rad(noise: &StrokeNoise, ball_radius_m: f64) -> f64 {
    let squirt = SQUIRT_RAD * noise.offset_m / ball_radius_m;
    let azimuth = noise.azimuth_rad.max(AZIMUTH_LEAST_RAD);
    (azimuth * azimuth + squirt * squirt).sqrt()
}

/// How many times as far as the way of the ball that meets it a ball's way turns, to the other
/// side: `d/(2 R cos β)`.
///
/// Throw takes a part of that at small cuts, and thin cuts lose speed by the error as well: the
/// factor 0.86 + 0.2 β/60° makes the chances of simulated pots.
pub(super) fn gain(to_ghost_m: f64, cut_rad: f64, ball_radius_m: f64) -> f64 {
    /// So that a touching ball has a finite window [m].
    const LEAST_M: f64 = 0.001;
    let geometric = to_ghost_m.max(LEAST_M) / (2.0 * ball_radius_m * libm::cos(cut_rad).max(0.02));
    geometric * (0.86 + 0.2 * cut_rad.abs() / (60.0 * DEGREE))
}

/// Probability that a normally distributed error lies from `least` (negative) to `most`.
///
/// 2 Φ(w/σ) − 1 for a window that reaches equally far to both sides.
pub(super) fn within(sigma: f64, least: f64, most: f64) -> f64 {
    if most <= least {
        return 0.0;
    }
    normal_below(most / sigma) - normal_below(least / sigma)
}

/// Φ: probability that a standard normally distributed number is below `x`.
fn normal_below(x: f64) -> f64 {
    0.5 * libm::erfc(-x * std::f64::consts::FRAC_1_SQRT_2)
}

/// Root of the sum of two squares.
pub(super) fn both(a: f64, b: f64) -> f64 {
    (a * a + b * b).sqrt()
}
