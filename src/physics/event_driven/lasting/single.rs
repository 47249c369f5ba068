//! A ball that nothing unusual holds any more, or a single contact alone.

use super::Contacts;
use crate::physics::event_driven::EventDriven;
use crate::physics::event_driven::motion::{self, Start};
use crate::physics::event_driven::pivot::{Base, Pivot};
use crate::physics::event_driven::segment::{Course, Segment};
use crate::physics::event_driven::terrain::Feature;
use crate::physics::laws::Mover;
use crate::units::Seconds;
use glam::DVec3;
use smallvec::SmallVec;

impl EventDriven {
    /// Lets a ball go on by closed forms, if there are any for what holds it.
    pub(super) fn leave_lasting(&mut self, index: usize, contacts: &Contacts) -> bool {
        let segment = self.bodies[index].segment;
        match contacts[..] {
            [] => {
                self.bodies[index].held.clear();
                let next = motion::free(&segment, &self.bodies[index].ball, &self.parameters);
                self.turn_into(index, next);
                true
            }
            [(feature @ (Feature::Plane(_) | Feature::Patch(_)), normal, _)] => {
                let law = self.parameters.surface(self.terrain.surface(feature));
                let start = Start { segment, normal, friction: law.friction, hops_s: 0.0 };
                let ball = &self.bodies[index].ball;
                let Some(next) = motion::carried(&start, ball, &self.parameters) else {
                    return false;
                };
                self.bodies[index].held = SmallVec::from_slice(&[feature]);
                self.book_slip(index, &segment, &next);
                self.turn_into(index, next);
                true
            }
            [(feature @ Feature::Edge(_), normal, _)] => {
                let body = &self.bodies[index];
                let pivot = self.pivot(feature, normal);
                let radius = body.ball.radius_m;
                let leaves = pivot.press(segment.position, segment.velocity, radius) <= 0.0;
                if leaves {
                    let next = motion::free(&segment, &body.ball, &self.parameters);
                    self.bodies[index].held.clear();
                    self.turn_into(index, next);
                }
                leaves
            }
            _ => false,
        }
    }

    fn pivot(&self, feature: Feature, normal: DVec3) -> Pivot {
        let base = match feature {
            Feature::Edge(edge) => {
                let edge = &self.terrain.edges[edge as usize];
                Base::Edge { from: edge.from, along: edge.along, length_m: edge.length_m }
            }
            _ => Base::Slope { normal },
        };
        let surface = self.terrain.surface(feature);
        let law = self.parameters.carrying(self.parameters.surface(surface).friction);
        Pivot { base, law, gravity_m_s2: self.parameters.gravity_m_s2 }
    }

    /// The next piece of a ball that touches a single edge or slope and nothing else.
    pub(super) fn single_contact(
        &mut self,
        at: Seconds,
        index: usize,
        contacts: &Contacts,
    ) -> bool {
        let [(feature, normal, _)] = contacts[..] else { return false };
        let body = &self.bodies[index];
        let flags = &body.ball.flags;
        let weighs = flags.gravity && flags.integrate;
        if !weighs || body.ball.spring.is_some() || matches!(feature, Feature::Corner(_)) {
            return false;
        }
        let from = body.segment;
        let start = Mover::new(&body.ball, from.velocity, from.angular_velocity);
        let pivot = self.pivot(feature, normal);
        // What it brushes is looked at again soon.
        let brushes = body.brushes(at).filter(|other| *other != feature);
        let longest = match brushes {
            Some(_) => self.parameters.exact.lasting_step_s,
            None => f64::INFINITY,
        };
        let Some(step) = pivot.step(from.position, &start, longest) else { return false };
        let height_j = body.ball.mass_kg * self.parameters.gravity_m_s2 * from.position.z;
        let body = &mut self.bodies[index];
        body.target_j = start.kinetic_j() + height_j - step.loss_j;
        body.held = core::iter::once(feature).chain(brushes).collect();
        body.quiet_since = at;
        body.leans = false;
        let rate = 1.0 / step.length_s;
        body.turn_into(Segment {
            end_s: at + step.length_s,
            acceleration: (step.end.velocity - from.velocity) * rate,
            angular_acceleration: (step.end.angular_velocity - from.angular_velocity) * rate,
            normal,
            spin_deceleration: 0.0,
            course: Course::Lasting,
            ..from
        });
        self.note_track(index);
        true
    }
}
