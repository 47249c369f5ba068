//! The paper's time step: what it does to a spring, a falling ball, an overlap, a contact normal.

use super::error::{Trouble, unsupported};
use super::observed::{Observations, angle_between, degrees};
use super::setup::Setup;
use crate::ball::{Ball, BallFlags, BallPlace, BallState, Motion, Spring};
use crate::events::{FactKind, FactSet};
use crate::ids::{BallId, Rail};
use crate::mesh::Surface;
use crate::physics::{
    Contact, Integrator, Parameters, PhysicsSettings, Profile, Simulation, SolverKind, roots,
};
use crate::table::{Plane, Table};
use core::f64::consts::TAU;
use glam::{DQuat, DVec3};

/// Longest step that the stepper takes [s].
const STEP_MAX_S: f64 = 0.05;

/// One ball under the stepper, alone or above the plane z = 0.
fn stepper(
    ball: Ball,
    position: DVec3,
    velocity: DVec3,
    step_s: f64,
    change: impl FnOnce(&mut PhysicsSettings, &mut Parameters, &mut Table),
) -> Result<Simulation, Trouble> {
    let state = BallState {
        id: ball.id,
        position,
        velocity,
        angular_velocity: DVec3::ZERO,
        orientation: DQuat::IDENTITY,
        motion: Motion::Rest,
        place: BallPlace::OnTable,
    };
    let mut settings = PhysicsSettings {
        solver: SolverKind::FixedStep,
        step_ms: step_s * 1000.0,
        ..PhysicsSettings::default()
    };
    let mut parameters = Parameters { gravity_m_s2: 0.0, ..Parameters::pool() };
    let mut table = Table::default();
    change(&mut settings, &mut parameters, &mut table);
    Ok(Simulation::with_parameters(&table, vec![(ball, state)], &settings, parameters)?)
}

/// The state of the only ball after one step.
fn after_one_step(mut simulation: Simulation, step_s: f64) -> Result<BallState, Trouble> {
    simulation.advance(step_s, FactSet::NONE, &mut Vec::new())?;
    let state = simulation.sample(BallId(0), step_s);
    state.ok_or_else(|| Trouble::Failed("the ball is gone".into()))
}

fn step_of(setup: &Setup<'_>) -> Result<f64, Trouble> {
    let step = setup.positive("T_s")?;
    if (1e-8..=STEP_MAX_S).contains(&step) {
        Ok(step)
    } else {
        unsupported("the stepper takes steps from 1e-8 to 0.05 s")
    }
}

pub(super) fn spring(setup: &Setup<'_>) -> Result<Observations, Trouble> {
    let (mass, step) = (setup.positive("mass_kg")?, step_of(setup)?);
    let stiffness = setup.positive("k_N_m")?;
    // The step is linear: two starts give its matrix, whose trace is 2 cos(Ω h).
    let trace = |stiffness_n_m: f64| -> Result<f64, Trouble> {
        let ball = Ball {
            mass_kg: mass,
            flags: BallFlags { gravity: false, ..BallFlags::default() },
            spring: Some(Spring { stiffness_n_m, ..Spring::default() }),
            ..Ball::pool(BallId(0))
        };
        let run = |x: f64, v: f64| {
            let start = stepper(ball.clone(), DVec3::X * x, DVec3::X * v, step, |_, _, _| ())?;
            after_one_step(start, step)
        };
        Ok(run(1.0, 0.0)?.position.x + run(0.0, 1.0)?.velocity.x)
    };
    let mut seen = Observations::default();
    let (mut low, mut high) = (0.0, 1.0);
    while trace(high)? > -2.0 && high < 1e18 {
        high *= 2.0;
    }
    loop {
        let middle = 0.5 * (low + high);
        if !(low < middle && middle < high) {
            break;
        }
        if trace(middle)? >= -2.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    seen.set("k_limit_N_m", low);
    let half = 0.5 * trace(stiffness)?;
    seen.maybe("freq_hz", (half.abs() <= 1.0).then(|| libm::acos(half) / (TAU * step)));
    seen.set("exact_freq_hz", (stiffness / mass).sqrt() / TAU);
    Ok(seen)
}

pub(super) fn figures(setup: &Setup<'_>) -> Result<Observations, Trouble> {
    let (step, speed) = (step_of(setup)?, setup.positive("speed_m_s")?);
    let gravity = setup.gravity()?;
    let ball = Ball::pool(BallId(0));
    let travel = after_one_step(
        stepper(ball.clone(), DVec3::ZERO, DVec3::X * speed, step, |_, _, _| ())?,
        step,
    )?;
    let fall = |integrator| -> Result<f64, Trouble> {
        let start = stepper(ball.clone(), DVec3::ZERO, DVec3::ZERO, step, |settings, laws, _| {
            settings.integrator = integrator;
            laws.gravity_m_s2 = gravity;
        })?;
        Ok(-after_one_step(start, step)?.position.z)
    };
    let mut seen = Observations::default();
    seen.set("travel_per_step_m", travel.position.x);
    // Velocity first, then position: two sums. Half of that is what really falls.
    seen.set("free_fall_two_sums_m", fall(Integrator::EulerCromer)?);
    seen.set("free_fall_per_step_m", fall(Integrator::Verlet)?);
    seen.set("tunnelling_radius_m", 0.5 * travel.position.x);
    Ok(seen)
}

/// Lets a ball enter a wall by the penetration asked for, under the paper's profile.
pub(super) fn push_out(setup: &Setup<'_>) -> Result<Observations, Trouble> {
    let (depth, speed) = (setup.positive("penetration_m")?, setup.positive("normal_speed_m_s")?);
    let damping = setup.number("damping")?;
    // Half of the step's way is inside.
    let step = 2.0 * depth / speed;
    if step > STEP_MAX_S {
        return unsupported("so slow a ball would need a step above 0.05 s");
    }
    let ball = Ball { radius_m: 10.0 * depth, ..Ball::pool(BallId(0)) };
    let height = ball.radius_m + speed * step - depth;
    let radius_m = ball.radius_m;
    let start =
        stepper(ball, DVec3::Z * height, DVec3::NEG_Z * speed, step, |settings, laws, table| {
            settings.profile = Profile::Paper2009;
            laws.cushion = Contact { restitution: damping, friction: 0.0 };
            let surface = Surface::Cushion(Rail::Head);
            table.planes.push(Plane { point: DVec3::ZERO, normal: DVec3::Z, surface });
        })?;
    let mut simulation = start;
    let mut facts = Vec::new();
    simulation.advance(step, FactSet::NONE, &mut facts)?;
    let state = simulation.sample(BallId(0), step);
    let hit = facts.iter().find(|fact| matches!(fact.kind, FactKind::CushionHit { .. }));
    let mut seen = Observations::default();
    seen.maybe("height_after_m", state.map(|state| state.position.z - radius_m));
    seen.maybe("time_in_wall_s", hit.map(|fact| step - fact.time_s));
    Ok(seen)
}

/// The contact normal of a ball that is noticed `tau` after it touched another one at a cut,
/// against the true one.
pub(super) fn late_detection(setup: &Setup<'_>) -> Result<Observations, Trouble> {
    let (radius, speed) = (setup.positive("R_m")?, setup.positive("speed_m_s")?);
    let (step, cut) = (setup.positive("T_s")?, setup.number("cut_deg")?);
    if !(0.0..90.0).contains(&cut) {
        return Err(setup.error("cut_deg", "is no cut", "write 0 to 90 degrees").into());
    }
    let (sin, cos) = libm::sincos(cut * (core::f64::consts::PI / 180.0));
    let velocity = DVec3::X * speed;
    let other = DVec3::new(cos, sin, 0.0) * (2.0 * radius);
    let error = |tau: f64| degrees(angle_between(other - velocity * tau, other));

    let mut seen = Observations::default();
    seen.set("max_normal_error_deg", error(step));
    // Simpson's rule.
    let parts = 2000_u32;
    let sum: f64 = (0..=parts)
        .map(|k| {
            let weight = if k == 0 || k == parts { 1.0 } else { f64::from(2 + 2 * (k % 2)) };
            weight * error(step * f64::from(k) / f64::from(parts))
        })
        .sum();
    seen.set("mean_normal_error_deg", sum / (3.0 * f64::from(parts)));
    // Back-dated: the time of contact is computed from where the balls were before.
    let apart = -other - velocity * step;
    let touched = roots::straight(apart, velocity, 2.0 * radius, 2.0 * step, 0.0);
    let back = touched.map(|time| degrees(angle_between(-(apart + velocity * time), other)));
    seen.maybe("normal_error_back_dated_deg", back);
    Ok(seen)
}
