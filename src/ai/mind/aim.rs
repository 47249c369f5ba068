//! Where to aim so that a ball goes where it shall: squirt, curve and throw found by simulation.

use super::race::Prospects;
use super::world::World;
use super::{Mind, Outcome, trial};
use crate::ai::geometry::{signed_angle, turned as rotated};
use crate::ai::hold;
use crate::ai::ideas::Idea;
use crate::ai::settings::Level;
use crate::ai::speed::{BALL_PER_TIP_SPEED, arrival_speed};
use crate::cue::Aim;

/// Good enough [rad]: 0.3 mm at the other end of the table.
const CLOSE_RAD: f64 = 1.2e-4;
/// Strokes that are tried for it.
const ROUNDS: usize = 6;
/// The first ball's way turns at least so much with the stroke, and against it.
const SLOPE_LEAST: f64 = 0.3;
/// Azimuths that are scanned where no ball's way is wanted: this far to either side [rad], in so
/// many steps.
const SCAN_RAD: f64 = 1.5 * std::f64::consts::PI / 180.0;
const SCAN_STEPS: usize = 12;
/// Simulations of a scan.
pub const SCAN: u32 = SCAN_STEPS as u32 + 2;

/// How hard and where on the ball.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// Speed of a level tip [m/s].
    pub speed_m_s: f64,
    /// Contact point to the right, in ball radii.
    pub side: f64,
    /// The same upwards.
    pub height: f64,
}

/// The cue along an idea's direction, and the tip's speed [m/s]; none if it cannot be held so.
pub fn along(mind: &Mind, world: &World, idea: &Idea, touch: Touch) -> Option<(Aim, f64)> {
    let cue = world.view.cue_ball?;
    let azimuth_rad = libm::atan2(idea.direction.y, idea.direction.x);
    let height_offset = idea.height_offset + touch.height;
    let level = Aim { azimuth_rad, elevation_rad: 0.0, side_offset: touch.side, height_offset };
    let over_rail = mind.table.clearance_elevation(cue, &level);
    let elevation_rad = hold::elevation(&world.view, cue, &level, over_rail)?;
    let aim = Aim { elevation_rad, ..level }.limited();
    Some((aim, hold::tip_speed(touch.speed_m_s, elevation_rad)))
}

/// The same turned until the first ball goes where the idea wants it; none if it cannot be met so.
fn turned(world: &World, mind: &Mind, idea: &Idea, mut aim: Aim, speed_m_s: f64) -> Option<Aim> {
    let (wanted, first) = (idea.first_way?, idea.first?);
    let error = |aim| {
        let way = world.first_way(aim, speed_m_s, first)?;
        Some(signed_angle(wanted, way))
    };
    let lever = idea.to_ball_m / (2.0 * mind.ball_radius_m * libm::cos(idea.cut_rad).max(0.2));
    let mut slope = (1.0 - lever).min(-SLOPE_LEAST);
    let mut off = error(aim)?;
    for _ in 1..ROUNDS {
        if off.abs() < CLOSE_RAD {
            break;
        }
        let next = Aim { azimuth_rad: aim.azimuth_rad - off / slope, ..aim };
        let Some(new_off) = error(next) else { break };
        let found = (new_off - off) / (next.azimuth_rad - aim.azimuth_rad);
        if found.is_finite() {
            slope = found.min(-SLOPE_LEAST);
        }
        if off.abs() <= new_off.abs() {
            break;
        }
        (aim, off) = (next, new_off);
    }
    Some(aim)
}

/// The azimuth by the learned throw: geometry, turned away from the cut by f of cut and speed.
fn by_table(world: &World, mind: &Mind, idea: &Idea, aim: Aim, speed_m_s: f64) -> Option<Aim> {
    let (way, cue) = (idea.first_way?, world.view.cue_ball?);
    let ball = world.view.position(idea.first?)?;
    let start_m_s = BALL_PER_TIP_SPEED * speed_m_s;
    let ball_speed_m_s = arrival_speed(start_m_s, idea.to_ball_m);
    let mut direction = idea.direction;
    // The ghost depends on the cut, which depends a little on the ghost.
    for _ in 0..3 {
        let cut_rad = signed_angle(direction, way);
        let factor = mind.throw.factor(cut_rad, ball_speed_m_s);
        let ghost = ball - 2.0 * mind.ball_radius_m * rotated(way, factor * cut_rad);
        direction = (ghost - cue).try_normalize()?;
    }
    Some(Aim { azimuth_rad: libm::atan2(direction.y, direction.x), ..aim })
}

/// The best noise-free outcome of an idea with this touch: aimed by the first ball's way, or in
/// the middle of the azimuths that work.
pub fn best(mind: &Mind, world: &World, idea: &Idea, touch: Touch) -> Outcome {
    let Some((aim, speed_m_s)) = along(mind, world, idea, touch) else { return Outcome::default() };
    let exactly = |aim| trial::exactly(mind, world, idea, aim, speed_m_s);
    if idea.first_way.is_some() {
        let aimed = match mind.level {
            Level::Champion => turned(world, mind, idea, aim, speed_m_s),
            Level::Club | Level::Paper => by_table(world, mind, idea, aim, speed_m_s),
        };
        let Some(aim) = aimed else {
            return Outcome { aim, speed_m_s, simulations: 1, ..Outcome::default() };
        };
        let outcome = exactly(aim);
        if outcome.success || !is_worth_a_scan(idea) {
            return outcome;
        }
        let scanned = scanned(aim, exactly);
        return Outcome { simulations: SCAN, ..scanned };
    }
    if is_worth_a_scan(idea) { scanned(aim, exactly) } else { exactly(aim) }
}

/// The best an idea is worth with any of these touches, where one works, and the shots that were
/// simulated for it. Speeds are over the least one, heights in ball radii.
pub fn worth(
    mind: &Mind,
    world: &World,
    idea: &Idea,
    speeds: &[f64],
    heights: &[f64],
    prospects: &Prospects,
) -> (Option<f64>, u32) {
    let (mut best, mut simulations) = (None, 0);
    for factor in speeds {
        for height in heights {
            let speed_m_s = factor * idea.speed_least_m_s;
            let touch = Touch { speed_m_s, side: 0.0, height: *height };
            let outcome = self::best(mind, world, idea, touch);
            simulations += outcome.simulations;
            if outcome.success {
                let worth = prospects.of_idea(idea, outcome.value);
                best = Some(best.map_or(worth, |known: f64| known.max(worth)));
            }
        }
    }
    (best, simulations)
}

/// Where geometry alone is too rough.
pub fn is_worth_a_scan(idea: &Idea) -> bool {
    use crate::ai::ideas::IdeaKind::{Bank, Carom, Combination, Kick};
    matches!(idea.kind, Bank | Carom | Combination | Kick)
}

/// The middle of the longest run of azimuths that work; if none does, straight on.
fn scanned(aim: Aim, exactly: impl Fn(Aim) -> Outcome) -> Outcome {
    let step = |n: usize| SCAN_RAD * (2.0 * n as f64 / SCAN_STEPS as f64 - 1.0);
    let tried: Vec<Outcome> = (0..=SCAN_STEPS)
        .map(|n| exactly(Aim { azimuth_rad: aim.azimuth_rad + step(n), ..aim }))
        .collect();
    let (mut best, mut begin) = (0..0, 0);
    for n in 0..=tried.len() {
        if n == tried.len() || !tried[n].success {
            if best.len() < n - begin {
                best = begin..n;
            }
            begin = n + 1;
        }
    }
    let simulations = tried.len() as u32;
    let middle = if best.is_empty() { SCAN_STEPS / 2 } else { (best.start + best.end - 1) / 2 };
    Outcome { simulations, ..tried[middle] }
}
