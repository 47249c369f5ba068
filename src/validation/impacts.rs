//! Two balls that touch: one impact, and what both balls do until they roll.

use super::error::{Trouble, unsupported};
use super::observed::{Observations, Observed, angle_between, degrees};
use super::setup::Setup;
use super::world::{curve, mover};
use crate::physics::Contact;
use crate::physics::laws::mathavan_2014::{self, Bed};
use crate::physics::laws::paper_2009::{self, Friction};
use crate::physics::laws::{Impact, Mover, ball_ball, cloth};
use glam::DVec3;

/// The paper's time step [s]; its friction is a force during one of them.
const STEP_2009_S: f64 = 0.004;
/// Below this cut there is no side to which throw could go [rad].
const NO_CUT: f64 = 1e-9;

/// Both balls before and after, and what happened between them.
struct Collision {
    before: [Mover; 2],
    after: [Mover; 2],
    /// From ball 1 to ball 2.
    line: DVec3,
    impact: Impact,
}

fn collide(setup: &Setup<'_>) -> Result<Collision, Trouble> {
    let [one, two] = setup.pair()?;
    let line = (two.position_m - one.position_m).normalize_or(DVec3::X);
    let before = [mover(&one), mover(&two)];
    let [mut a, mut b] = before;
    let law = Contact {
        restitution: setup.number_or_zero("e_ball")?,
        friction: setup.number_or_zero("mu_ball")?,
    };
    let coulomb = |a: &mut Mover, b: &mut Mover, friction: f64| {
        ball_ball::collide(a, b, -line, law.restitution, friction)
    };
    let impact = match setup.law {
        // A closed contact is one without restitution and friction.
        "default" | "constant_friction" | "closed_contact" => coulomb(&mut a, &mut b, law.friction),
        "speed_dependent_friction" => {
            let slip = a.surface_velocity(-line) - b.surface_velocity(line);
            let slip = slip - line * slip.dot(line);
            coulomb(&mut a, &mut b, curve(setup)?.at(slip.length()))
        }
        "mathavan_2014" => {
            let bed = Bed { normal: DVec3::Z, friction: setup.number_or_zero("mu_slide")? };
            mathavan_2014::collide(&mut a, &mut b, -line, [Some(bed); 2], law).0
        }
        "clamp_2009" => clamp(&mut a, &mut b, -line, law),
        law => return unsupported(format!("law {law} has no meaning for two balls")),
    };
    Ok(Collision { before, after: [a, b], line, impact })
}

/// The paper's reflection and friction: each ball against the other as if that were fixed.
pub(super) fn clamp(a: &mut Mover, b: &mut Mover, normal: DVec3, law: Contact) -> Impact {
    let slip = a.surface_velocity(normal) - b.surface_velocity(-normal);
    let across = slip - normal * slip.dot(normal);
    let before = a.kinetic_j() + b.kinetic_j();
    let (ua, ub) = paper_2009::reflect(a, b, normal, law.restitution);
    let kick = |ball: &Mover, normal: DVec3, change: f64, slip: DVec3| {
        let force = change.abs() / (ball.inverse_mass * STEP_2009_S);
        let friction = Friction { sliding: law.friction, static_: law.friction };
        paper_2009::friction(ball, normal, slip, force, friction, STEP_2009_S)
    };
    let (change_a, change_b) = (ua - a.velocity.dot(normal), ub - b.velocity.dot(normal));
    let on_a = kick(a, normal, change_a, across);
    let on_b = kick(b, -normal, change_b, -across);
    let impulse = (normal * change_a + on_a.0) / a.inverse_mass;
    a.velocity += normal * change_a + on_a.0;
    a.angular_velocity += on_a.1;
    b.velocity += normal * change_b + on_b.0;
    b.angular_velocity += on_b.1;
    let lost = before - a.kinetic_j() - b.kinetic_j();
    let left = a.surface_velocity(normal) - b.surface_velocity(-normal);
    let left = (left - normal * left.dot(normal)).dot(across);
    Impact { impulse, sticks: left <= 0.0, loss_j: lost }
}

pub(super) fn observe(setup: &Setup<'_>) -> Result<Observations, Trouble> {
    let Collision { before, after, line, impact } = collide(setup)?;
    let mut seen = Observations::default();
    seen.set("velocity_m_s", after.map(|ball| ball.velocity).to_vec());
    seen.set("angular_velocity_rad_s", after.map(|ball| ball.angular_velocity).to_vec());
    seen.set("stick", impact.sticks);
    seen.set("energy_lost_J", impact.loss_j);
    let along = impact.impulse.dot(line);
    seen.set("normal_impulse_Ns", along.abs());
    seen.set("tangential_impulse_Ns", (impact.impulse - line * along).length());
    seen.set("speed_m_s", after.map(|ball| ball.velocity.length()).to_vec());

    let [v1, v2] = after.map(|ball| ball.velocity);
    seen.set("separation_angle_deg", degrees(angle_between(v1, v2)));
    seen.set("direction_1_deg", degrees(libm::atan2(v1.y, v1.x)));
    seen.set("direction_1_from_line_deg", degrees(angle_between(v1, line)));

    // Seen from above; positive is from the line towards the cue ball's path, and clockwise for a
    // straight shot.
    let turn = |from: DVec3, to: DVec3| {
        libm::atan2(from.x * to.y - from.y * to.x, from.x * to.x + from.y * to.y)
    };
    let cut = turn(before[0].velocity - before[1].velocity, line);
    let clockwise = -turn(line, v2 - before[1].velocity);
    let throw = if cut < -NO_CUT { -clockwise } else { clockwise };
    seen.set("throw_deg", degrees(throw));
    if cut.abs() > NO_CUT {
        let ratio = throw / cut.abs();
        seen.set("throw_over_cut", ratio);
        // The learner commands the cut (1 + f) times the one that it wants.
        seen.set("learner_f", 1.0 / (1.0 - ratio) - 1.0);
    }

    let momentum = |balls: &[Mover; 2]| -> DVec3 {
        balls.iter().map(|ball| ball.velocity / ball.inverse_mass).sum()
    };
    let kinetic = |balls: &[Mover; 2]| balls.iter().map(Mover::kinetic_j).sum::<f64>();
    let total = momentum(&after);
    let mass: f64 = after.iter().map(|ball| 1.0 / ball.inverse_mass).sum();
    seen.set("momentum_kg_m_s", total);
    seen.set("centre_of_mass_velocity_m_s", total / mass);
    let parts = |balls: &[Mover; 2]| (balls[1].velocity - balls[0].velocity).dot(line);
    let approach = -parts(&before);
    seen.maybe("restitution", (approach > 0.0).then(|| parts(&after) / approach));
    let scale: f64 = before.iter().map(|ball| ball.velocity.length() / ball.inverse_mass).sum();
    let error = (total - momentum(&before)).length();
    seen.maybe("max_momentum_rel_error", (scale > 0.0).then(|| error / scale));
    let start = kinetic(&before);
    let error = (kinetic(&after) + impact.loss_j - start).abs();
    seen.maybe("max_energy_rel_error", (start > 0.0).then(|| error / start));
    Ok(seen)
}

pub(super) fn observe_roll(setup: &Setup<'_>) -> Result<Observations, Trouble> {
    let collision = collide(setup)?;
    let (friction, gravity) = (setup.number_or_zero("mu_slide")?, setup.gravity()?);
    let into = collision.before[0].velocity;
    let mut speeds = Vec::new();
    let mut turns: Vec<f64> = Vec::new();
    for ball in &collision.after {
        let Some(roll) = until_it_rolls(ball, friction, gravity) else {
            return unsupported("without friction on the cloth no ball ever rolls");
        };
        speeds.push(roll.velocity.length());
        let turn = libm::atan2(
            into.x * roll.velocity.y - into.y * roll.velocity.x,
            into.x * roll.velocity.x + into.y * roll.velocity.y,
        );
        turns.push(degrees(turn.abs()));
    }
    let mut seen = Observations::default();
    seen.set("roll_speed_m_s", speeds);
    seen.set("roll_deflection_deg", Observed::from(turns));
    Ok(seen)
}

/// A ball that has begun to roll.
pub(super) struct Roll {
    pub time_s: f64,
    pub displacement: DVec3,
    pub velocity: DVec3,
    pub angular_velocity: DVec3,
}

/// Slides a ball on z = 0 by the closed law of the cloth; what would lift it is left out, since
/// hops do not change where it ends. None if nothing ever stops the slip.
pub(super) fn until_it_rolls(ball: &Mover, friction: f64, gravity: f64) -> Option<Roll> {
    let velocity = ball.velocity.with_z(0.0);
    let inertia_factor = ball.inverse_mass / (ball.inverse_inertia * ball.radius_m.powi(2));
    let spin = ball.angular_velocity;
    let slip = cloth::slip_velocity(velocity, spin, ball.radius_m, DVec3::Z).length();
    let deceleration = friction * gravity;
    if slip == 0.0 {
        let displacement = DVec3::ZERO;
        return Some(Roll { time_s: 0.0, displacement, velocity, angular_velocity: spin });
    }
    if deceleration <= 0.0 {
        return None;
    }
    let time_s = cloth::sliding_time(slip, friction, gravity, inertia_factor);
    let radius = ball.radius_m;
    let (end, angular_velocity) =
        cloth::slide(velocity, spin, radius, inertia_factor, deceleration, time_s);
    let displacement = (velocity + end) * (0.5 * time_s);
    Some(Roll { time_s, displacement, velocity: end, angular_velocity })
}
