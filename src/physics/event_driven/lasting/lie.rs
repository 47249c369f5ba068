//! Laying a ball exactly on what it touches.

use super::{Contacts, PARTS_M_S, TOUCH_M};
use crate::physics::event_driven::EventDriven;
use crate::physics::event_driven::segment::Course;
use crate::physics::event_driven::terrain::Feature;
use crate::physics::laws::Mover;
use crate::physics::spring;
use glam::DVec3;

impl EventDriven {
    /// What a ball touches; lays it on that exactly and turns its velocity along it.
    pub(super) fn lie_on(&mut self, index: usize) -> Contacts {
        let body = &self.bodies[index];
        let (radius, mut centre) = (body.ball.radius_m, body.segment.position);
        let mut velocity = body.segment.velocity;
        let parts = |(_, normal, _): &(Feature, DVec3, f64), v: DVec3| v.dot(*normal) > PARTS_M_S;
        let reach = radius + 4.0 * TOUCH_M;
        let mut contacts: Contacts = self.terrain.near(centre, reach);
        contacts.retain(|contact| !parts(contact, velocity));
        centre += onto(&contacts, radius);
        if contacts.len() > 1 {
            // Moving out of one may move into another.
            for (_, normal, distance) in self.terrain.near(centre, radius) {
                centre += normal * (radius - distance).max(0.0);
            }
        }
        centre = self.beside_others(index, centre);
        let body = &self.bodies[index];
        if let [(_, normal, _)] = contacts[..] {
            // Along the surface, if gravity or a spring holds it there.
            let s = &body.segment;
            let pull = body.ball.spring.as_ref().map_or(DVec3::ZERO, |own| {
                let (x, w) = (s.orientation, s.angular_velocity);
                spring::acceleration(&body.ball, own, centre, velocity, x, w).0
            });
            let weight = DVec3::NEG_Z * self.parameters.gravity_m_s2;
            let kick = (weight + pull).dot(normal) * self.parameters.exact.lasting_step_s;
            let out = velocity.dot(normal);
            if out + kick < 0.0 {
                let along = velocity - normal * out;
                velocity = along.normalize_or_zero() * velocity.length();
            } else {
                contacts.clear();
            }
        } else {
            for (_, normal, _) in &contacts {
                velocity -= *normal * velocity.dot(*normal).min(0.0);
            }
        }

        // The energy that friction has left, for a ball that leans on nothing but the terrain.
        let body = &self.bodies[index];
        let (mass, g) = (body.ball.mass_kg, self.parameters.gravity_m_s2);
        let before = Mover::new(&body.ball, body.segment.velocity, body.segment.angular_velocity);
        // It rises no more than its motion can pay for.
        let rise = centre - body.segment.position;
        let cost = mass * g * rise.z;
        if cost > before.kinetic_j() {
            centre = body.segment.position + rise * (before.kinetic_j() / cost);
        }
        let kinetic = Mover { velocity, ..before }.kinetic_j();
        let wanted = body.target_j - mass * g * centre.z;
        let mut factor = 1.0;
        if kinetic > 1e-12 && wanted.is_finite() {
            let ratio = (wanted / kinetic).clamp(0.0, 1.0 + 1e-2);
            factor = if contacts.len() == 1 { ratio.sqrt() } else { ratio.min(1.0).sqrt() };
        } else if wanted.is_infinite() {
            // At the start nothing may be gained.
            let had = before.kinetic_j() + mass * g * body.segment.position.z;
            let ratio = ((had - mass * g * centre.z) / kinetic.max(1e-300)).clamp(0.0, 1.0);
            factor = ratio.sqrt();
        }
        let spin = body.segment.angular_velocity * factor;
        velocity *= factor;
        let after = Mover { velocity, angular_velocity: spin, ..before };
        self.ledger.integration_j += after.kinetic_j() - before.kinetic_j()
            + mass * g * (centre.z - body.segment.position.z);
        self.ledger.momentum.table += mass * (velocity - before.velocity);
        let body = &mut self.bodies[index];
        body.segment.position = centre;
        body.segment.velocity = velocity;
        body.segment.angular_velocity = spin;
        contacts
    }

    /// Where a ball is laid that should be at `centre`, so that it is not laid into another: that
    /// is a micrometre or two, and the surface waits. On one that it stands on it lies all the
    /// same.
    fn beside_others(&self, index: usize, mut centre: DVec3) -> DVec3 {
        let body = &self.bodies[index];
        let (at, from) = (body.segment.start_s, body.segment.position);
        for (other, path) in self.paths.iter().enumerate() {
            let reach = path.radius_m + body.ball.radius_m;
            let near = centre.distance(self.centre_at(other, at)) <= reach;
            if other == index || !path.solid || !near {
                continue;
            }
            let segment = &self.bodies[other].segment;
            let there = segment.position_at(at);
            let line = centre - there;
            let carries = line.z * line.z > 0.75 * line.length_squared();
            let into = from.distance(there).min(reach) - line.length();
            if into > 0.0 && !(carries && segment.course == Course::Lasting) {
                centre += line.normalize_or_zero() * into;
            }
        }
        centre
    }
}

/// How often the contacts of a ball are gone through to lay it on all of them.
const ROUNDS: usize = 4;

/// The shift that lays a ball of this radius [m] on all that it touches. Two that face nearly the
/// same way ask for the same shift, once.
fn onto(contacts: &Contacts, radius_m: f64) -> DVec3 {
    let mut shift = DVec3::ZERO;
    let rounds = if contacts.len() > 1 { ROUNDS } else { 1 };
    for _ in 0..rounds {
        for (_, normal, distance) in contacts {
            shift += *normal * (radius_m - distance - normal.dot(shift));
        }
    }
    shift
}
