//! A ball that touches walls and moves into them: one impact, all walls together.

use super::error::{Trouble, unsupported};
use super::observed::{Observations, angle_between, degrees};
use super::setup::Setup;
use super::world::mover;
use crate::physics::laws::cluster::{self, Touch};
use crate::physics::laws::mathavan_2014::Bed;
use crate::physics::laws::{Impact, Mover, ball_face, cushion, han_2005, mathavan_2010};
use crate::physics::{Contact, tolerance};
use glam::DVec3;

pub(super) fn observe(setup: &Setup<'_>) -> Result<Observations, Trouble> {
    let entry = setup.ball()?;
    let walls = setup.walls()?;
    let Some(first) = walls.first() else {
        return Err(setup.error("walls", "is empty", "list at least one wall").into());
    };
    let normal = first.normal;
    let before = mover(&entry);
    let mut ball = before;
    let mut wall = Contact {
        restitution: setup.number_or_zero("e_wall")?,
        friction: setup.number_or_zero("mu_wall")?,
    };
    if setup.law == "han_2005_restitution" {
        wall.restitution = han_2005::restitution(-before.velocity.dot(normal));
    }
    // A ball that lies on z = 0 is on a bed if the setup speaks of cloth.
    let cloth = setup.maybe("mu_slide")?;
    let lies = (entry.position_m.z - entry.radius_m).abs() <= tolerance::SUPPORT_M;
    let level = |normal: DVec3| normal.z > 1.0 - tolerance::COPLANAR;
    let bed = cloth.filter(|_| lies && walls.iter().all(|wall| !level(wall.normal)));
    let impact = match (setup.law, bed) {
        ("mathavan_2010", _) => {
            let bed = Bed { normal: DVec3::Z, friction: cloth.unwrap_or(0.0) };
            mathavan_2010::bounce(&mut ball, normal, bed, wall).0
        }
        ("single_contact", _) => {
            ball_face::bounce(&mut ball, normal, wall.restitution, wall.friction)
        }
        ("default" | "constant_friction" | "han_2005_restitution", bed) => {
            let cloth = bed.map(|friction| Contact { restitution: 0.0, friction });
            joint(&mut ball, &walls.iter().map(|w| w.normal).collect::<Vec<_>>(), wall, cloth)
        }
        (law, _) => return unsupported(format!("law {law} has no meaning for a wall")),
    };

    let mut seen = Observations::default();
    seen.set("velocity_m_s", ball.velocity);
    seen.set("angular_velocity_rad_s", ball.angular_velocity);
    seen.set("stick", impact.sticks);
    let lost = before.kinetic_j() - ball.kinetic_j();
    seen.set("energy_lost_J", lost);
    seen.maybe(
        "energy_lost_fraction",
        (before.kinetic_j() > 0.0).then(|| lost / before.kinetic_j()),
    );
    let along = impact.impulse.dot(normal);
    seen.set("normal_impulse_Ns", along);
    seen.set("tangential_impulse_Ns", (impact.impulse - normal * along).length());
    seen.set("rebound_angle_deg", degrees(angle_between(ball.velocity, normal)));
    let away = normal.with_z(0.0).normalize_or_zero();
    seen.set("rebound_speed_m_s", ball.velocity.dot(away));
    seen.set("contact_elevation_deg", degrees(libm::asin((-normal.z).clamp(-1.0, 1.0))));
    Ok(seen)
}

/// All walls together, and the bed if there is one; returns what the first wall did.
fn joint(ball: &mut Mover, normals: &[DVec3], wall: Contact, cloth: Option<Contact>) -> Impact {
    match (normals, cloth) {
        ([normal], None) => ball_face::bounce(ball, *normal, wall.restitution, wall.friction),
        ([normal], Some(cloth)) => cushion::bounce(ball, *normal, DVec3::Z, wall, cloth).0,
        (normals, cloth) => {
            let mut touches: Vec<Touch> =
                normals.iter().map(|normal| Touch::new(0, None, *normal, wall)).collect();
            touches.extend(
                cloth.map(|cloth| Touch { carries: true, ..Touch::new(0, None, DVec3::Z, cloth) }),
            );
            cluster::resolve(core::slice::from_mut(ball), &mut touches);
            let Touch { normal, impulse, loss_j, .. } = touches[0];
            let slip = ball.surface_velocity(normal);
            let slip = slip - normal * slip.dot(normal);
            Impact { impulse, sticks: slip.length() < 1e-9, loss_j }
        }
    }
}
