//! Closed forms: where a ball is at a time, known without any method.

use crate::ball::POOL_RADIUS_M;
use crate::physics::{Parameters, spring};
use crate::units::Seconds;
use glam::DVec3;

/// A ball on endless level cloth: it slides on a parabola until its slip is gone, then rolls
/// straight until it stops. Moved by [m] after `t`.
pub(super) fn on_cloth(v: DVec3, spin: DVec3, law: &Parameters, t: Seconds) -> DVec3 {
    let slip = v + spin.cross(DVec3::NEG_Z * POOL_RADIUS_M);
    let slip = slip.with_z(0.0);
    let grip = law.cloth.friction * law.gravity_m_s2;
    let slides_s = if grip > 0.0 { 2.0 * slip.length() / (7.0 * grip) } else { f64::INFINITY };
    let kick = -grip * slip.normalize_or_zero();
    let slid = t.min(slides_s);
    let moved = v * slid + 0.5 * slid * slid * kick;
    if t <= slides_s {
        return moved;
    }
    let rolling = v + slides_s * kick;
    let slows = law.rolling_resistance * law.gravity_m_s2;
    let rolls_s = if slows > 0.0 { rolling.length() / slows } else { f64::INFINITY };
    let rolled = (t - slides_s).min(rolls_s);
    moved + rolling * rolled - 0.5 * rolled * rolled * slows * rolling.normalize_or_zero()
}

/// Height over the ground [m] of a ball that was dropped from `height_m` and keeps the share
/// `restitution` of its speed in each bounce.
pub(super) fn bounce(height_m: f64, restitution: f64, gravity_m_s2: f64, t: Seconds) -> f64 {
    let falls_s = (2.0 * height_m / gravity_m_s2).sqrt();
    if t <= falls_s {
        return height_m - 0.5 * gravity_m_s2 * t * t;
    }
    let mut since = t - falls_s;
    let mut up = restitution * gravity_m_s2 * falls_s;
    // Bounces that are shorter than this are below any rounding of the height.
    while up > 1e-9 {
        let lasts_s = 2.0 * up / gravity_m_s2;
        if since < lasts_s {
            return since * (up - 0.5 * gravity_m_s2 * since);
        }
        since -= lasts_s;
        up *= restitution;
    }
    0.0
}

/// Where a damped spring has carried what was displaced by `x` and moved with `v`.
pub(super) fn on_spring(omega: f64, damping_ratio: f64, x: DVec3, v: DVec3, t: Seconds) -> DVec3 {
    let [row, _] = spring::propagator(omega, damping_ratio, t);
    row[0] * x + row[1] * v
}

/// Places [m] of balls of one mass in a line that meet without loss. They hand their speeds on, so
/// that without their diameters they go through each other like rays, and keep their order.
pub(super) fn in_line(places: &[f64], speeds: &[f64], diameter: f64, t: Seconds) -> Vec<f64> {
    let width = |place: usize| place as f64 * diameter;
    let rays = places.iter().zip(speeds).enumerate();
    let mut ends: Vec<f64> = rays.map(|(i, (x, v))| x - width(i) + v * t).collect();
    ends.sort_by(f64::total_cmp);
    ends.iter().enumerate().map(|(i, x)| x + width(i)).collect()
}
