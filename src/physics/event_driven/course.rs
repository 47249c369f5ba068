//! How a ball goes on: what holds it, and which closed form continues its motion.

use super::EventDriven;
use super::lasting::TOUCH_M;
use super::motion::{self, Start};
use super::segment::{Course, Segment};
use super::terrain::Feature;
use crate::physics::laws::Mover;
use crate::physics::{Contact as Law, PhysicsError, tolerance};
use crate::units::Seconds;
use glam::DVec3;
use smallvec::SmallVec;

/// How far a ball that turns about a rim is put over it [m].
const OVER_M: f64 = 1e-9;

impl EventDriven {
    /// Finds what a ball lies on when its world begins, or when it is put down.
    pub(super) fn lay_down(&mut self, index: usize) {
        let at = self.done;
        let body = &self.bodies[index];
        let weighs = body.ball.flags.gravity && body.ball.flags.integrate;
        if !body.in_play() {
            let (position, orientation) = (body.segment.position, body.segment.orientation);
            self.bodies[index].segment = Segment::still(at, position, orientation);
            return;
        }
        let (segment, radius) = (body.segment, body.ball.radius_m);
        let mut leans = false;
        let mut carriers: SmallVec<[Feature; 2]> = SmallVec::new();
        if weighs && body.ball.flags.collide && self.parameters.gravity_m_s2 > 0.0 {
            let reach = radius + tolerance::START_OVERLAP_M;
            for (feature, normal, distance) in self.terrain.near(segment.position, reach) {
                // What falls on it or leaves it does not lie on it.
                if normal.z > 1e-9
                    && segment.velocity.dot(normal).abs() <= self.parameters.exact.hop_m_s
                {
                    carriers.push(feature);
                    // It lies on the first exactly.
                    if carriers.len() == 1 {
                        self.bodies[index].segment.position += normal * (radius - distance);
                    }
                }
            }
            leans = self.bodies.iter().enumerate().any(|(other, it)| {
                let line = segment.position - it.segment.position;
                other != index
                    && it.solid()
                    && line.z > 1e-6
                    && line.length() - radius - it.ball.radius_m <= TOUCH_M
            });
        }
        let flat = |feature: &Feature| matches!(feature, Feature::Plane(_) | Feature::Patch(_));
        let simple = carriers.len() == 1 && flat(&carriers[0]) && !leans;
        let stuck = (carriers.len() + usize::from(leans) > 0) && !simple;
        self.bodies[index].held = if simple { carriers } else { SmallVec::new() };
        let mover = self.bodies[index].mover(at);
        if stuck {
            self.begins.push(index);
        } else {
            self.go_on(at, index, &mover, DVec3::ZERO, 0.0);
        }
    }

    /// Normal of a flat feature on the side of a ball's centre.
    pub(super) fn flat_normal(&self, feature: Feature, centre: DVec3) -> Option<DVec3> {
        match feature {
            Feature::Plane(plane) => Some(self.terrain.planes[plane as usize].normal),
            Feature::Patch(patch) => {
                let patch = &self.terrain.patches[patch as usize];
                let above = patch.normal.dot(centre) >= patch.offset;
                Some(if above { patch.normal } else { -patch.normal })
            }
            Feature::Edge(_) | Feature::Corner(_) => None,
        }
    }

    /// What carries a ball, as a law sees it: normal and material.
    pub(super) fn support(&self, index: usize, at: Seconds) -> Option<(DVec3, Law)> {
        let body = &self.bodies[index];
        let [feature] = body.held[..] else { return None };
        let normal = self.flat_normal(feature, body.segment.position_at(at))?;
        Some((normal, self.parameters.surface(self.terrain.surface(feature))))
    }

    /// A ball goes on from here as `mover` says, by what holds it.
    pub(super) fn go_on(
        &mut self,
        at: Seconds,
        index: usize,
        mover: &Mover,
        shift: DVec3,
        hops_s: Seconds,
    ) {
        self.watch_rails(index, at);
        self.close_segment(at, index);
        let body = &self.bodies[index];
        let from = &body.segment;
        let mut start = Segment {
            start_s: at,
            position: from.position_at(at) + shift,
            velocity: mover.velocity,
            angular_velocity: mover.angular_velocity,
            orientation: from.orientation_at(at),
            ..*from
        };
        if !body.ball.flags.integrate {
            start.velocity = DVec3::ZERO;
            start.angular_velocity = DVec3::ZERO;
        }
        // Out of what it was pressed into; what that lifts it, it pays.
        let lift_j = body.ball.mass_kg * self.parameters.gravity_m_s2 * shift.z;
        if shift.z != 0.0 && body.ball.flags.gravity && body.ball.flags.integrate {
            let kinetic = mover.kinetic_j();
            let factor = if kinetic > lift_j { (1.0 - lift_j / kinetic).sqrt() } else { 0.0 };
            let factor = factor.min(1.0);
            self.ledger.integration_j += lift_j - (1.0 - factor * factor) * kinetic;
            self.ledger.momentum.table += start.velocity * ((factor - 1.0) * body.ball.mass_kg);
            start.velocity *= factor;
            start.angular_velocity *= factor;
        }
        if body.held.is_empty() {
            let next = motion::free(&start, &body.ball, &self.parameters);
            self.turn_into(index, next);
            return;
        }
        let Some((normal, law)) = self.support(index, at) else {
            self.bodies[index].turn_into(Segment { course: Course::Lasting, swing: None, ..start });
            self.begins.push(index);
            return;
        };
        let lift = start.velocity.dot(normal);
        let least = self.parameters.exact.hop_below(law.restitution, normal.z);
        if self.parameters.flight && lift > least {
            self.bodies[index].held.clear();
            let next = motion::free(&start, &self.bodies[index].ball, &self.parameters);
            self.turn_into(index, next);
            return;
        }
        if lift != 0.0 {
            start.velocity -= normal * lift;
            let mass = body.ball.mass_kg;
            self.ledger.face_j += 0.5 * mass * lift * lift;
            self.ledger.momentum.table -= normal * (lift * mass);
        }
        let start = Start { segment: start, normal, friction: law.friction, hops_s };
        let body = &self.bodies[index];
        match motion::carried(&start, &body.ball, &self.parameters) {
            Some(next) => {
                self.book_slip(index, &start.segment, &next);
                self.turn_into(index, next);
            }
            None => {
                self.bodies[index].turn_into(Segment {
                    course: Course::Lasting,
                    swing: None,
                    ..start.segment
                });
                self.begins.push(index);
            }
        }
    }

    pub(super) fn turn_into(&mut self, index: usize, next: Segment) {
        self.bodies[index].leans = false;
        self.bodies[index].turn_into(next);
        self.note_track(index);
    }

    /// Books what the last of the slip cost when a ball begins to roll, or stops.
    pub(super) fn book_slip(&mut self, index: usize, from: &Segment, to: &Segment) {
        let ball = &self.bodies[index].ball;
        if !ball.flags.integrate {
            return;
        }
        let kinetic = |s: &Segment| {
            0.5 * ball.mass_kg * s.velocity.length_squared()
                + 0.5 * ball.inertia_kg_m2() * s.angular_velocity.length_squared()
        };
        self.ledger.cloth_j += kinetic(from) - kinetic(to);
        self.ledger.momentum.table += (to.velocity - from.velocity) * ball.mass_kg;
    }

    /// The law of a ball's motion has ended by itself.
    pub(super) fn follow(&mut self, at: Seconds, index: usize) -> Result<(), PhysicsError> {
        self.check_finite(at, index)?;
        self.watch_rails(index, at);
        self.close_segment(at, index);
        let body = &self.bodies[index];
        let from = body.segment;
        let state = Segment {
            start_s: at,
            position: from.position_at(at),
            velocity: from.velocity_at(at),
            angular_velocity: from.angular_velocity_at(at),
            orientation: from.orientation_at(at),
            ..from
        };
        let (normal, law) =
            self.support(index, at).unwrap_or((DVec3::Z, Law { restitution: 0.0, friction: 0.0 }));
        let start = Start { segment: state, normal, friction: law.friction, hops_s: 0.0 };
        match motion::after(&from, &start, &body.ball, &self.parameters) {
            Some(next) => {
                self.book_slip(index, &state, &next);
                self.turn_into(index, next);
            }
            None => {
                self.bodies[index].turn_into(Segment {
                    course: Course::Lasting,
                    swing: None,
                    ..state
                });
                self.begins.push(index);
            }
        }
        self.predict(at, &[index]);
        Ok(())
    }

    /// The foot of a carried ball crosses the edge of what carries it.
    pub(super) fn leave(
        &mut self,
        at: Seconds,
        index: usize,
        feature: Feature,
    ) -> Result<(), PhysicsError> {
        self.check_finite(at, index)?;
        let mover = self.bodies[index].mover(at);
        let [Feature::Patch(patch)] = self.bodies[index].held[..] else { return Ok(()) };
        let Feature::Edge(number) = feature else { return Ok(()) };
        let terrain = self.terrain.clone();
        let edge = &terrain.edges[number as usize];
        let across = edge.sides.iter().find(|(side, _)| *side != patch);
        if let (true, Some((other, _))) = (edge.flat, across) {
            self.bodies[index].held = SmallVec::from_slice(&[Feature::Patch(*other)]);
            self.go_on(at, index, &mover, DVec3::ZERO, 0.0);
            self.predict(at, &[index]);
            return Ok(());
        }
        // Over the rim: fast enough it flies at once, v² ≥ g R; else it turns about the edge.
        let inwards =
            edge.sides.iter().find(|(side, _)| *side == patch).map(|(_, inwards)| *inwards);
        let outwards = -inwards.unwrap_or(DVec3::ZERO).dot(mover.velocity);
        let normal = self.bodies[index].segment.normal;
        let into = self.parameters.gravity_m_s2 * normal.z;
        self.bodies[index].held.clear();
        if outwards * outwards >= into * self.bodies[index].ball.radius_m {
            self.go_on(at, index, &mover, DVec3::ZERO, 0.0);
        } else {
            // Over the edge by more than rounding, or the patch would seem to carry it still. On
            // the level: what a slope adds or takes on this way would be energy from nowhere.
            let level = inwards.unwrap_or(DVec3::ZERO).with_z(0.0);
            let over = level.normalize_or_zero() * -OVER_M;
            self.begin_lasting_with(at, index, &mover, over);
        }
        self.predict(at, &[index]);
        Ok(())
    }
}
