//! One ball above the table plane: flights, landings, and what comes after.

use super::error::{Trouble, unsupported};
use super::observed::Observations;
use super::probe::{LONGEST_S, LOOK_S, Probe};
use super::setup::Setup;
use super::world::World;
use crate::ball::{BallState, Motion};
use crate::physics::{PhysicsSettings, SolverKind};
use crate::units::Seconds;
use glam::DVec3;

/// Impacts that are followed one by one at most.
const IMPACTS_MAX: usize = 10_000;
/// A ball that is no higher lies on the table [m].
const LIES_M: f64 = 1e-6;
/// Times between two looks [s].
const SHORTEST_S: Seconds = 1e-6;
/// A ball whose velocity is off that of free fall by more than this has met something [m/s].
const MET_M_S: f64 = 1e-9;
/// The same for a stepper, whose velocity stands still within a step: in what gravity gives in one.
const MET_STEPS: f64 = 2.5;

/// A landing.
struct Impact {
    time: Seconds,
    before: DVec3,
    after: BallState,
    /// Height of the next top over the height at rest [m]; none if there is no next flight.
    apex_m: Option<f64>,
}

pub(super) fn observe(
    setup: &Setup<'_>,
    keys: &[&str],
    solver: SolverKind,
) -> Result<Observations, Trouble> {
    let entry = setup.ball()?;
    let mut world = World::new(setup, core::slice::from_ref(&entry), solver)?.bed();
    let (gravity, landing) = (world.parameters.gravity_m_s2, world.parameters.cushion);
    let slides = world.parameters.cloth.friction;
    if gravity <= 0.0 {
        return unsupported("without gravity no ball lands");
    }
    world.parameters.cloth = landing;
    let (start, radius) = (entry.position_m, entry.radius_m);
    let mut seen = Observations::default();

    let mut probe = Probe::new(world.simulation()?);
    let flies = entry.velocity_m_s.z > 0.0 || entry.position_m.z > radius;
    if flies
        && let Some((time, top)) = probe.clone().until(LONGEST_S, |_, s| s.velocity.z <= 0.0)?
    {
        seen.set("t_first_apex_s", time);
        seen.set("first_apex_z_m", top.position.z);
    }
    let slack = match solver {
        SolverKind::FixedStep => MET_STEPS * gravity * PhysicsSettings::default().step_ms / 1000.0,
        #[allow(unreachable_patterns)]
        _ => MET_M_S,
    };
    let impacts = land(&mut probe, gravity, radius, entry.velocity_m_s, slack)?;
    seen.set("impact_time_s", impacts.iter().map(|i| i.time).collect::<Vec<_>>());
    let ways: Vec<DVec3> = impacts.iter().map(|i| i.after.position - start).collect();
    seen.set("impact_displacement_m", ways);
    seen.set("velocity_before_impact_m_s", impacts.iter().map(|i| i.before).collect::<Vec<_>>());
    let after: Vec<DVec3> = impacts.iter().map(|i| i.after.velocity).collect();
    seen.set("velocity_after_impact_m_s", after);
    let spins: Vec<DVec3> = impacts.iter().map(|i| i.after.angular_velocity).collect();
    seen.set("angular_velocity_after_impact_rad_s", spins);
    let stick = |i: &Impact| {
        let skin = i.after.velocity + radius * i.after.angular_velocity.cross(DVec3::NEG_Z);
        skin.with_z(0.0).length() < 1e-9
    };
    seen.set("stick", impacts.iter().map(stick).collect::<Vec<_>>());
    let tops: Vec<f64> = impacts.iter().filter_map(|i| i.apex_m).collect();
    if let Some(least) = setup.maybe("count_apex_above_m")? {
        let count = tops.iter().filter(|top| **top > least).count();
        seen.set("apexes_above", super::observed::Observed::Count(count as u64));
    }

    // The series of hops has no last one. A solver that lays the ball down leaves the rest, which
    // is known in closed form: time 2 v/(g (1 − e)), path v²/(g (1 − e²)), v the next rebound.
    let e = landing.restitution;
    let down = probe.until(LONGEST_S, |_, state| state.motion != Motion::Airborne)?;
    let last = impacts.last();
    if let (Some((time, state)), Some(last)) = (down, last) {
        let rebound = -e * last.before.z;
        let cut = last.apex_m.is_none() && rebound > 0.0 && e < 1.0;
        let left_out = cut && time - last.time < rebound / gravity;
        let rest = if left_out { 2.0 * rebound / (gravity * (1.0 - e)) } else { 0.0 };
        seen.set("t_total_s", time + rest);
        let way = state.position - start + state.velocity.with_z(0.0) * rest;
        seen.set("total_displacement_m", way);
        seen.set("final_velocity_m_s", state.velocity.with_z(0.0));
        seen.set("final_z_m", state.position.z);
        let tail = if cut { rebound * rebound / (gravity * (1.0 - e * e)) } else { 0.0 };
        let rise = (entry.velocity_m_s.z.max(0.0)).powi(2) / gravity;
        let fall = (start.z - radius).max(0.0);
        seen.set("path_total_m", rise + fall + 2.0 * tops.iter().sum::<f64>() + tail);
    }
    seen.set("apex_height_m", tops);
    if keys.iter().any(|key| key.starts_with("roll")) {
        let carried = probe.state()?;
        world.parameters.cloth.friction = slides;
        let mut probe = if slides == landing.friction {
            probe
        } else {
            // Landing and sliding differ: from here on the cloth is the other one.
            world.balls[0].1 = BallState { orientation: glam::DQuat::IDENTITY, ..carried };
            Probe::new(world.simulation()?)
        };
        let rolls = |_: Seconds, state: &BallState| {
            !matches!(state.motion, Motion::Sliding | Motion::Airborne)
        };
        if let Some((_, state)) = probe.until(LONGEST_S, rolls)? {
            seen.set("roll_velocity_m_s", state.velocity);
            seen.set("roll_angular_velocity_rad_s", state.angular_velocity);
        }
    }
    Ok(seen)
}

/// Follows the hops of a ball, impact by impact, until it stays down.
fn land(
    probe: &mut Probe,
    gravity: f64,
    radius: f64,
    velocity: DVec3,
    slack: f64,
) -> Result<Vec<Impact>, Trouble> {
    let mut impacts = Vec::new();
    // A ball that lies and moves into the table meets it at once.
    let lies = (probe.state()?.position.z - radius).abs() < LIES_M;
    if lies && velocity.z < 0.0 {
        let mut after = probe.state()?;
        if after.velocity.z < 0.0 {
            let met = probe.until(LONGEST_S, |_, state| state.velocity.z >= 0.0)?;
            let Some((_, state)) = met else { return Ok(impacts) };
            after = state;
        }
        let time = probe.simulation.now_s();
        impacts.push(Impact { time, before: velocity, after, apex_m: None });
    }
    while impacts.len() < IMPACTS_MAX {
        let (from, at) = (probe.state()?, probe.simulation.now_s());
        // What has landed and does not rise is down, whatever its motion is called; what hangs in
        // the air for a moment is not.
        let lies = (from.position.z - radius).abs() < LIES_M;
        let down = (from.motion != Motion::Airborne && lies) || !impacts.is_empty();
        if down && from.velocity.z <= 0.0 {
            break;
        }
        // Looked at often enough that a hop is not jumped over.
        if let Some(last) = impacts.last() {
            probe.look_s = (0.25 * last.after.velocity.z / gravity).clamp(SHORTEST_S, LOOK_S);
        }
        if let Some(last) = impacts.last_mut()
            && let Some((_, top)) = probe.until(LONGEST_S, |_, s| s.velocity.z <= 0.0)?
        {
            last.apex_m = Some(top.position.z - radius).filter(|height| *height > 0.0);
        }
        let fall = |time: Seconds| from.velocity.z - gravity * (time - at);
        let hit = |time: Seconds, state: &BallState| state.velocity.z > fall(time) + slack;
        let Some((time, after)) = probe.until(LONGEST_S, hit)? else { break };
        let before = from.velocity.with_z(fall(time));
        impacts.push(Impact { time, before, after, apex_m: None });
    }
    probe.look_s = LOOK_S;
    Ok(impacts)
}
