//! How hard to strike: closed forms of a ball's way over the cloth, with a margin.
//!
//! A ball that starts without spin slides with the deceleration μ_s g until 5/7 of its speed are
//! left, then rolls with μ_r g (Leckie and Greenspan 2005).

use crate::ball::POOL_MASS_KG;
use crate::cue::CUE_MASS_KG;
use rand::RngExt;

/// Sliding friction of ball on cloth that the player reckons with.
const SLIDING_FRICTION: f64 = 0.2;
/// Rolling resistance of the cloth that the player reckons with.
const ROLLING_RESISTANCE: f64 = 0.01;
/// Gravity [m/s²].
const GRAVITY_M_S2: f64 = 9.81;
/// Restitution between balls.
const BALL_RESTITUTION: f64 = 0.95;
/// Restitution of a leather tip.
const TIP_RESTITUTION: f64 = 0.75;

/// Speed of the cue ball over the tip's before a middle hit: (1 + e) M / (M + m).
pub const BALL_PER_TIP_SPEED: f64 =
    (1.0 + TIP_RESTITUTION) * CUE_MASS_KG / (CUE_MASS_KG + POOL_MASS_KG);

/// Slowest tip [m/s]: a ball needs to get to a rail.
const TIP_SPEED_MIN_M_S: f64 = 0.7;
/// Fastest tip of a normal stroke [m/s].
const TIP_SPEED_MAX_M_S: f64 = 4.5;
/// Slowest speed at which an object ball shall come to its pocket [m/s].
const ARRIVAL_M_S: f64 = 0.5;
/// The same where nothing shall be pocketed but a rail must be reached [m/s].
const RAIL_ARRIVAL_M_S: f64 = 0.3;
/// Part of the reckoned speed of a cushion that is left after it.
const CUSHION_RESTITUTION: f64 = 0.7;

/// Speed that a ball without spin must start with to be at `arrival_m_s` after `distance_m` [m/s].
///
/// Still sliding: v² = v_a² + 2 μ_s g d. Rolling by then, with 12 v²/(49 μ_s g) slid:
/// v² = (v_a² + 2 μ_r g d) / (25/49 + 24 μ_r/(49 μ_s)).
pub fn launch_speed(distance_m: f64, arrival_m_s: f64) -> f64 {
    let arrival_sq = arrival_m_s * arrival_m_s;
    let sliding = (arrival_sq + 2.0 * SLIDING_FRICTION * GRAVITY_M_S2 * distance_m).sqrt();
    if arrival_m_s >= 5.0 / 7.0 * sliding {
        return sliding;
    }
    let rolled = arrival_sq + 2.0 * ROLLING_RESISTANCE * GRAVITY_M_S2 * distance_m;
    (rolled / (25.0 / 49.0 + 24.0 / 49.0 * ROLLING_RESISTANCE / SLIDING_FRICTION)).sqrt()
}

/// Speed of a ball without spin that starts with `start_m_s`, after `distance_m` [m/s]: what
/// [`launch_speed`] turns round; 0 if it does not come so far.
pub fn arrival_speed(start_m_s: f64, distance_m: f64) -> f64 {
    let start_sq = start_m_s * start_m_s;
    let slides_m = 12.0 / 49.0 * start_sq / (SLIDING_FRICTION * GRAVITY_M_S2);
    let left_sq = if distance_m <= slides_m {
        start_sq - 2.0 * SLIDING_FRICTION * GRAVITY_M_S2 * distance_m
    } else {
        25.0 / 49.0 * start_sq - 2.0 * ROLLING_RESISTANCE * GRAVITY_M_S2 * (distance_m - slides_m)
    };
    left_sq.max(0.0).sqrt()
}

/// Tip speed that just brings an object ball to its pocket [m/s]: `to_ball_m` for the cue ball,
/// a cut of `cut_rad`, then `to_pocket_m` for the object ball.
///
/// The object ball takes (1 + e)/2 · cos β of the cue ball's speed.
pub fn pot_tip_speed(to_ball_m: f64, cut_rad: f64, to_pocket_m: f64) -> f64 {
    let object = launch_speed(to_pocket_m, ARRIVAL_M_S);
    at_cut(to_ball_m, cut_rad, object)
}

/// The player's random stroke strength for a pot: a band above what is needed, wider for short
/// ways, where there is more to spare (paper, section 5.4.2) [m/s].
pub(super) fn pot_strength(
    to_ball_m: f64,
    cut_rad: f64,
    to_pocket_m: f64,
    rng: &mut impl rand::Rng,
) -> f64 {
    let spare = 0.2 + 0.3 / (1.0 + to_ball_m + to_pocket_m);
    let factor = rng.random_range(1.1..1.1 + spare);
    limited(factor * pot_tip_speed(to_ball_m, cut_rad, to_pocket_m))
}

/// Stroke strength that drives a ball to some rail after `to_ball_m` and `cushions` [m/s].
pub(super) fn contact_strength(
    to_ball_m: f64,
    cushions: i32,
    to_rail_m: f64,
    rng: &mut impl rand::Rng,
) -> f64 {
    let object = launch_speed(to_rail_m, RAIL_ARRIVAL_M_S);
    let lost = (0..cushions).fold(1.0, |left, _| left * CUSHION_RESTITUTION);
    limited(rng.random_range(1.1..1.4) * at_cut(to_ball_m, 0.0, object) / lost)
}

/// Stroke strength of a break [m/s]: the cue ball leaves at about 8 m/s.
pub(super) fn break_strength(rng: &mut impl rand::Rng) -> f64 {
    rng.random_range(7.7..8.3) / BALL_PER_TIP_SPEED
}

fn at_cut(to_ball_m: f64, cut_rad: f64, object_m_s: f64) -> f64 {
    launch_speed(to_ball_m, before_meeting(cut_rad, object_m_s)) / BALL_PER_TIP_SPEED
}

/// Speed of a ball that meets another at a cut so that this leaves at `object_m_s` [m/s].
pub(super) fn before_meeting(cut_rad: f64, object_m_s: f64) -> f64 {
    let shared = 0.5 * (1.0 + BALL_RESTITUTION) * libm::cos(cut_rad).max(0.05);
    object_m_s / shared
}

/// Part of a rolling ball's speed that a cushion leaves, whatever its angle.
const CUSHION_SHARE: f64 = 0.8;

/// Speed that a ball must start with to be at `arrival_m_s` at the end of its way [m/s], whose
/// parts `legs_m` are joined by cushions. After a cushion it rolls.
pub(super) fn launch_by_cushions(legs_m: &[f64], arrival_m_s: f64) -> f64 {
    let Some((first, after)) = legs_m.split_first() else { return arrival_m_s };
    let bounced = after.iter().rev().fold(arrival_m_s, |speed, leg| {
        (speed * speed + 2.0 * ROLLING_RESISTANCE * GRAVITY_M_S2 * leg).sqrt() / CUSHION_SHARE
    });
    launch_speed(*first, bounced)
}

/// Speed that a ball must start with to fall at the end of its way [m/s].
pub(super) fn launch_to_pocket(legs_m: &[f64]) -> f64 {
    launch_by_cushions(legs_m, ARRIVAL_M_S)
}

fn limited(speed_m_s: f64) -> f64 {
    speed_m_s.clamp(TIP_SPEED_MIN_M_S, TIP_SPEED_MAX_M_S)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Speed after `distance` by small steps of the same two laws.
    fn speed_after(start: f64, distance: f64) -> f64 {
        let (mut v, mut x, h) = (start, 0.0, 1e-5);
        while x < distance && v > 0.0 {
            let friction =
                if v > 5.0 / 7.0 * start { SLIDING_FRICTION } else { ROLLING_RESISTANCE };
            v -= friction * GRAVITY_M_S2 * h;
            x += v * h;
        }
        v
    }

    #[test]
    fn a_ball_arrives_with_the_speed_it_was_launched_for() {
        for (distance, arrival) in [(0.05, 2.0), (0.3, 0.5), (1.0, 0.5), (2.5, 1.5), (0.01, 0.5)] {
            let found = speed_after(launch_speed(distance, arrival), distance);
            assert!((found - arrival).abs() < 2e-3, "{distance} m, {arrival} m/s: {found}");
            let back = arrival_speed(launch_speed(distance, arrival), distance);
            assert!((back - arrival).abs() < 1e-9, "{distance} m, {arrival} m/s: {back}");
        }
    }
}
