//! A cue hits one resting ball, and the ball slides until it rolls.

use super::error::{Trouble, unsupported};
use super::impacts::until_it_rolls;
use super::observed::{Observations, Observed, angle_between, degrees};
use super::setup::Setup;
use super::shapes::CueEntry;
use super::world::mover;
use crate::physics::laws::cue_ball::{Cue, cue_contact};
use crate::physics::laws::{Mover, cue_axis};
use crate::physics::{Contact, Parameters};
use glam::DVec3;

pub(super) fn observe(setup: &Setup<'_>, keys: &[&str]) -> Result<Observations, Trouble> {
    let (entry, stroke) = (setup.ball()?, setup.cue()?);
    let start = mover(&entry);
    let mut ball = start;
    let from_centre = stroke.contact_from_centre_m;
    let reach = from_centre.length();
    if (reach - entry.radius_m).abs() > 1e-6 * entry.radius_m {
        let problem = format!("contact_from_centre_m is {reach} m long");
        let fix = "it must be as long as the ball's radius";
        return Err(setup.error("cue", problem, fix).into());
    }
    let normal = -from_centre / reach;
    let direction = stroke.direction;
    if direction.dot(normal) <= 0.0 {
        let fix = "let the cue point towards the ball";
        return Err(setup.error("cue", "the cue moves away from the ball", fix).into());
    }

    let mut seen = Observations::default();
    if keys.iter().any(|key| key.starts_with("miscue")) {
        miscue(&stroke, &mut seen);
    }
    let mut cue = cue(setup, &stroke)?;
    let before_j = 0.5 * cue.mass_kg * cue.velocity.length_squared();
    match (setup.law, stroke.impulse_ns) {
        ("default", None) => drop(cue_contact(&mut ball, &mut cue, normal)),
        ("impulse_along_cue_axis", None) => {
            cue_axis::along_axis(&mut ball, &mut cue, normal);
        }
        ("end_mass_squirt", None) => drop(cue_axis::with_end_mass(&mut ball, &mut cue, normal)),
        ("impulse_along_cue_axis", Some(impulse)) => ball.push(normal, direction * impulse),
        ("table_absorbs_vertical", impulse) => {
            let impulse = match impulse {
                Some(impulse) => direction * impulse,
                None => cue_axis::along_axis(&mut start.clone(), &mut cue, normal).impulse,
            };
            ball.push(normal, impulse);
            ball.velocity.z = start.velocity.z;
        }
        (law, _) => return unsupported(format!("law {law} has no meaning for this stroke")),
    }

    seen.set("velocity_m_s", ball.velocity);
    seen.set("angular_velocity_rad_s", ball.angular_velocity);
    seen.set("cue_speed_after_m_s", cue.velocity.dot(direction));
    seen.maybe(
        "energy_fraction_to_ball",
        (before_j > 0.0).then(|| (ball.kinetic_j() - start.kinetic_j()) / before_j),
    );
    let speed = ball.velocity.length();
    let spin = ball.angular_velocity.length() * ball.radius_m;
    seen.maybe("R_spin_over_speed", (speed > 0.0).then(|| spin / speed));
    // Positive: the ball leaves to the left of the shaft, seen from above.
    let squirt = libm::atan2(
        direction.x * ball.velocity.y - direction.y * ball.velocity.x,
        direction.x * ball.velocity.x + direction.y * ball.velocity.y,
    );
    seen.set("squirt_deg", degrees(squirt));
    if direction.z < 0.0 {
        // From where the ball touches the table, a radius below its centre.
        let along = (from_centre.z + ball.radius_m) / -direction.z;
        let hit = from_centre + direction * along;
        seen.set("axis_hits_table_at_m", Observed::Vector(vec![hit.x, hit.y]));
    }
    if keys.iter().any(|key| key.contains("roll") || key.contains("stun")) {
        slide(setup, &ball, &mut seen)?;
    }
    Ok(seen)
}

fn cue(setup: &Setup<'_>, stroke: &CueEntry) -> Result<Cue, Trouble> {
    let pool = Parameters::pool();
    let mass_kg = stroke.mass_kg.unwrap_or(pool.cue_mass_kg);
    let end_mass_kg = stroke.end_mass_kg.unwrap_or(pool.cue_end_mass_kg);
    if !(mass_kg > 0.0 && end_mass_kg > 0.0) {
        return Err(setup.error("cue", "a mass is not positive", "write positive masses").into());
    }
    Ok(Cue {
        velocity: stroke.direction * stroke.speed_m_s.unwrap_or(0.0),
        direction: stroke.direction,
        mass_kg,
        end_mass_kg,
        contact: Contact {
            restitution: stroke.e_tip.unwrap_or(pool.tip.restitution),
            friction: stroke.mu_tip.unwrap_or(pool.tip.friction),
        },
    })
}

/// The largest offset at which the tip's friction still gives an impulse along the shaft, by
/// halving.
fn miscue(stroke: &CueEntry, seen: &mut Observations) {
    let friction = stroke.mu_tip.unwrap_or(Parameters::pool().tip.friction);
    let direction = stroke.direction;
    let across = direction.any_orthonormal_vector();
    let normal = |offset: f64| direction * (1.0 - offset * offset).sqrt() - across * offset;
    let (mut low, mut high) = (0.0, 1.0);
    loop {
        let middle = 0.5 * (low + high);
        if !(low < middle && middle < high) {
            break;
        }
        if cue_axis::holds(normal(middle), direction, friction) {
            low = middle;
        } else {
            high = middle;
        }
    }
    seen.set("miscue_offset_over_R", low);
    seen.set("miscue_normal_angle_deg", degrees(angle_between(normal(low), direction)));
}

fn slide(setup: &Setup<'_>, ball: &Mover, seen: &mut Observations) -> Result<(), Trouble> {
    let (friction, gravity) = (setup.number_or_zero("mu_slide")?, setup.gravity()?);
    let Some(roll) = until_it_rolls(ball, friction, gravity) else {
        return unsupported("without friction on the cloth no ball ever rolls");
    };
    seen.set("t_roll_s", roll.time_s);
    seen.set("roll_displacement_m", roll.displacement);
    seen.set("roll_velocity_m_s", roll.velocity);
    seen.set("roll_angular_velocity_rad_s", roll.angular_velocity);
    // The spin about the horizontal axis changes evenly; it has died when its part along what it
    // was is gone.
    let flat = |spin: DVec3| spin.with_z(0.0);
    let from = flat(ball.angular_velocity).length_squared();
    let to = flat(roll.angular_velocity).dot(flat(ball.angular_velocity));
    if to <= 0.0 && from > 0.0 {
        seen.set("t_stun_s", roll.time_s * from / (from - to));
    }
    Ok(())
}
