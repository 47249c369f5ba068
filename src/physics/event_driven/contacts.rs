//! What a meeting does: which law, which balls, and how they go on.

use super::EventDriven;
use super::lasting::TOUCH_M;
use super::predict::Changed;
use super::segment::Course;
use super::sweep::Meeting;
use super::terrain::Feature;
use crate::ball::BallPlace;
use crate::mesh::Surface;
use crate::physics::laws::choice::{self, MultiContact};
use crate::physics::laws::cluster::{self, Touch};
use crate::physics::laws::mathavan_2014::Bed;
use crate::physics::laws::{Impact, Mover, ball_face, cushion};
use crate::physics::{Contact as Law, PhysicsError, tolerance};
use crate::units::Seconds;
use glam::DVec3;
use smallvec::SmallVec;

/// A feature that a ball touches besides the one that it meets.
pub(super) type Touched = SmallVec<[(Feature, DVec3); 2]>;

impl EventDriven {
    /// Other features that a ball touches and closes on at `at`, but for one that it meets, and for
    /// those with the normals in `but`.
    fn also_touched(
        &self,
        at: Seconds,
        index: usize,
        met: Option<Feature>,
        but: &[DVec3],
        mover: &Mover,
    ) -> Touched {
        let body = &self.bodies[index];
        let centre = body.segment.position_at(at);
        let mut touched = Touched::new();
        let main = self.terrain.main_patch();
        let on_main = body.held.len() == 1 && body.held[0] == main || met == Some(main);
        let reach = body.ball.radius_m + TOUCH_M;
        for (feature, normal, _) in self.terrain.near_but(centre, reach, on_main) {
            let apart =
                but.iter().all(|other| other.dot(normal) < 1.0 - tolerance::SAME_NORMAL * 1e3);
            let closes = mover.velocity.dot(normal) < -tolerance::CLOSING_M_S;
            let held = body.held.iter().any(|held| self.terrain.belongs(feature, *held));
            if apart && closes && !held {
                touched.push((feature, normal));
            }
        }
        touched
    }

    /// A ball meets the terrain.
    pub(super) fn meet(
        &mut self,
        at: Seconds,
        index: usize,
        meeting: &Meeting,
    ) -> Result<(), PhysicsError> {
        self.check_finite(at, index)?;
        let Meeting { feature, normal, .. } = *meeting;
        let surface = self.terrain.surface(feature);
        match surface {
            Surface::PocketBottom(pocket) => {
                self.take_out(at, index, BallPlace::Pocketed, Some(pocket));
                return Ok(());
            }
            Surface::Floor => {
                self.take_out(at, index, BallPlace::OffTable, None);
                return Ok(());
            }
            _ => {}
        }
        self.work.contacts += 1;
        if self.bodies[index].segment.course == Course::Lasting {
            self.bodies[index].brushed = Some((feature, at));
        }
        let members = self.cluster_of(at, &[index]);
        let mut mover = self.bodies[index].mover(at);
        let before = mover;
        let approach = -mover.velocity.dot(normal);
        let material = match surface {
            Surface::Cushion(_) => self.parameters.cushion_at(approach),
            _ => self.parameters.surface(surface),
        };
        let least = self.parameters.exact.hop_below(material.restitution, normal.z);
        let slow = material.restitution * approach < least
            || matches!(surface, Surface::Cushion(_)) && approach < tolerance::STICKY_M_S;
        let law = if slow { Law { restitution: 0.0, ..material } } else { material };
        let support = self.support(index, at);
        let mut known: SmallVec<[DVec3; 2]> = SmallVec::from_slice(&[normal]);
        known.extend(support.map(|(normal, _)| normal));
        let also = self.also_touched(at, index, Some(feature), &known, &mover);

        if members.len() > 1 {
            let met: Touched = std::iter::once((feature, normal)).chain(also).collect();
            self.resolve_cluster(at, &members, index, &met);
            return Ok(());
        }
        let mut loss_j = 0.0;
        match (support, &also[..]) {
            (None, []) => {
                let Impact { impulse, loss_j: lost, .. } =
                    ball_face::bounce(&mut mover, normal, law.restitution, law.friction);
                self.ledger.momentum.table += impulse;
                loss_j += lost;
            }
            (Some((carrier, cloth)), []) => {
                let (own, bed) = match surface {
                    Surface::Cushion(_) => choice::cushion_and_bed_directly(
                        &mut mover,
                        normal,
                        carrier,
                        law,
                        cloth,
                        &self.parameters,
                    ),
                    _ => cushion::bounce_directly(&mut mover, normal, carrier, law, cloth),
                };
                self.ledger.momentum.table += own.impulse + bed.impulse;
                self.ledger.cloth_j += bed.loss_j;
                loss_j += own.loss_j;
            }
            (support, also) => {
                let mut touches: SmallVec<[Touch; 6]> = SmallVec::new();
                touches.push(Touch::new(0, None, normal, law));
                for (feature, normal) in also {
                    let law = self.parameters.surface(self.terrain.surface(*feature));
                    let touch = Touch::new(0, None, *normal, law);
                    touches.push(Touch { sticky_m_s: tolerance::STICKY_M_S, ..touch });
                }
                if let Some((normal, law)) = support {
                    touches.push(Touch { carries: true, ..Touch::new(0, None, normal, law) });
                }
                cluster::resolve(core::slice::from_mut(&mut mover), &mut touches);
                for touch in &touches {
                    self.ledger.momentum.table += touch.impulse;
                    loss_j += touch.loss_j;
                }
            }
        }
        match surface {
            Surface::Cushion(_) => self.ledger.cushion_j += loss_j,
            _ => self.ledger.face_j += loss_j,
        }

        let radius = self.bodies[index].ball.radius_m;
        let point = self.bodies[index].segment.position_at(at) - normal * radius;
        let met = std::iter::once((feature, normal)).chain(also.iter().copied());
        for (feature, normal) in met {
            if let Surface::Cushion(rail) = self.terrain.surface(feature) {
                self.tell_cushion(at, index, rail, point, -before.velocity.dot(normal));
            }
        }
        self.rebound(at, index, &mover, meeting, approach, law.restitution);
        Ok(())
    }

    /// How a ball goes on after it has met the terrain alone.
    fn rebound(
        &mut self,
        at: Seconds,
        index: usize,
        mover: &Mover,
        meeting: &Meeting,
        approach: f64,
        restitution: f64,
    ) {
        let (feature, normal) = (meeting.feature, meeting.normal);
        // Hops on one surface are a series that ends by itself, unless a spring presses.
        let hops = self.bodies[index].held.is_empty()
            && self.bodies[index].ball.spring.is_none()
            && self.bodies[index].met.replace(feature) == Some(feature);
        let busy = !hops && self.is_busy(at, index);
        let radius = self.bodies[index].ball.radius_m;
        let gravity = self.parameters.gravity_m_s2;
        let carries = normal.z > 1e-9 && self.bodies[index].ball.flags.gravity && gravity > 0.0;
        let lands = restitution == 0.0 && carries && self.bodies[index].held.is_empty();
        if busy {
            self.begin_lasting_with(at, index, mover, DVec3::ZERO);
        } else if lands && self.flat_normal(feature, DVec3::ZERO).is_some() {
            // It lies on the surface exactly, whatever rounding says.
            let centre = self.bodies[index].segment.position_at(at);
            let height = match feature {
                Feature::Plane(plane) => {
                    (centre - self.terrain.planes[plane as usize].point).dot(normal)
                }
                Feature::Patch(patch) => {
                    let patch = &self.terrain.patches[patch as usize];
                    (patch.normal.dot(centre) - patch.offset).abs()
                }
                Feature::Edge(_) | Feature::Corner(_) => radius,
            };
            // The rest of the series of hops: 2 v / (g (1 − e)), v the next rebound.
            let real = self.parameters.surface(self.terrain.surface(feature)).restitution;
            let hops_s = if real < 1.0 && real > 0.0 {
                2.0 * real * approach / (gravity * normal.z * (1.0 - real))
            } else {
                0.0
            };
            self.bodies[index].held = SmallVec::from_slice(&[feature]);
            self.go_on(at, index, mover, normal * (radius - height), hops_s);
        } else if lands {
            self.begin_lasting_with(at, index, mover, DVec3::ZERO);
        } else {
            let shift = self.way_out(at, (index, DVec3::ZERO), normal, feature);
            self.go_on(at, index, mover, shift, 0.0);
        }
        self.predict(at, &[index]);
        if self.bodies[index].in_play() {
            self.sinks_for_good(at, index);
        }
        self.wake_neighbours(at, &[index]);
    }

    /// Out of a surface into which a ball, moved by a shift, was pressed; along what carries it, so
    /// that no energy appears.
    pub(super) fn way_out(
        &self,
        at: Seconds,
        (index, shift): (usize, DVec3),
        normal: DVec3,
        feature: Feature,
    ) -> DVec3 {
        let body = &self.bodies[index];
        let centre = body.segment.position_at(at) + shift;
        let distance = match feature {
            Feature::Plane(plane) => {
                (centre - self.terrain.planes[plane as usize].point).dot(normal)
            }
            Feature::Patch(patch) => {
                let patch = &self.terrain.patches[patch as usize];
                (patch.normal.dot(centre) - patch.offset).abs()
            }
            Feature::Edge(edge) => {
                let edge = &self.terrain.edges[edge as usize];
                let offset = centre - edge.from;
                (offset - edge.along * offset.dot(edge.along)).length()
            }
            Feature::Corner(corner) => centre.distance(self.terrain.corners[corner as usize].point),
        };
        let depth = body.ball.radius_m - distance;
        let level = normal.with_z(0.0);
        let square = level.length_squared();
        if depth <= tolerance::PUSH_OUT_M || square < 0.25 {
            return DVec3::ZERO;
        }
        level * (depth / square)
    }

    /// Counts a contact; whether there were too many of them in too short a time.
    pub(super) fn is_busy(&mut self, at: Seconds, index: usize) -> bool {
        let body = &mut self.bodies[index];
        if at - body.busy.0 > tolerance::BUSY_S {
            body.busy = (at, 0);
        }
        body.busy.1 += 1;
        let weighs = body.ball.flags.gravity && self.parameters.gravity_m_s2 > 0.0;
        body.busy.1 > tolerance::BUSY_CONTACTS && (weighs || body.ball.spring.is_some())
    }

    /// Two balls meet.
    pub(super) fn collide(
        &mut self,
        at: Seconds,
        one: usize,
        two: usize,
    ) -> Result<(), PhysicsError> {
        let (a, b) = (one.min(two), one.max(two));
        self.check_finite(at, a)?;
        self.check_finite(at, b)?;
        if self.is_other_look(at, a, b) {
            return self.look_again(at, [a, b]);
        }
        // Pair by pair, as other programs do: the others wait their turn.
        let members = match self.parameters.multi_contact {
            MultiContact::Pairwise => Changed::from_slice(&[a, b]),
            MultiContact::Rounds | MultiContact::Hertz => self.cluster_of(at, &[a, b]),
        };
        let (movers, normal) = self.pair(at, a, b);
        let beside = [(a, &movers.0), (b, &movers.1)].into_iter().any(|(index, mover)| {
            // What a ball might be pressed against counts, wherever it moves now.
            let pushed = Mover { velocity: if index == a { normal } else { -normal }, ..*mover };
            !self.also_touched(at, index, None, &[], &pushed).is_empty()
        });
        if members.len() > 2 || beside {
            self.resolve_cluster(at, &members, a, &Touched::new());
            return Ok(());
        }

        self.work.contacts += 1;
        self.bodies[a].met = None;
        self.bodies[b].met = None;
        let (mut p, mut q) = movers;
        let approach = -(p.surface_velocity(normal) - q.surface_velocity(-normal)).dot(normal);
        let slip = p.surface_velocity(normal) - q.surface_velocity(-normal);
        let law = self.parameters.ball_at((slip + normal * approach).length());
        let slow = approach < tolerance::STICKY_M_S;
        let law = if slow { Law { restitution: 0.0, ..law } } else { law };
        let beds = [a, b].map(|index| {
            let (normal, cloth) = self.support(index, at)?;
            Some(Bed { normal, friction: cloth.friction })
        });
        let (impact, cloth) = choice::pair(&mut p, &mut q, normal, beds, law, &self.parameters);
        self.ledger.ball_ball_j += impact.loss_j;
        for bed in cloth {
            self.ledger.cloth_j += bed.loss_j;
            self.ledger.momentum.table += bed.impulse;
        }
        for (index, mover) in [(a, &mut p), (b, &mut q)] {
            self.hold_up(at, index, mover);
        }
        let point = self.bodies[a].segment.position_at(at) - normal * self.bodies[a].ball.radius_m;
        self.tell_collision(at, a, b, point, approach);
        let shifts = self.part(at, (a, DVec3::ZERO), (b, DVec3::ZERO), normal);
        let busy = self.is_busy(at, a) | self.is_busy(at, b);
        for (index, mover, shift) in [(a, &p, shifts.0), (b, &q, shifts.1)] {
            if busy && self.pressed(at, index) {
                self.begin_lasting_with(at, index, mover, shift);
            } else {
                self.go_on(at, index, mover, shift, 0.0);
            }
        }
        self.predict(at, &[a, b]);
        self.wake_neighbours(at, &[a, b]);
        Ok(())
    }

    /// Whether a ball leans on another, so that micro-impacts would never end: gravity presses.
    pub(super) fn pressed(&self, at: Seconds, index: usize) -> bool {
        let body = &self.bodies[index];
        let centre = body.segment.position_at(at);
        self.bodies.iter().enumerate().any(|(other, it)| {
            let line = centre - it.segment.position_at(at);
            other != index
                && it.solid()
                && line.z.abs() > 1e-4
                && line.length() - body.ball.radius_m - it.ball.radius_m <= 10.0 * TOUCH_M
        })
    }

    fn pair(&self, at: Seconds, a: usize, b: usize) -> ((Mover, Mover), DVec3) {
        let (one, two) = (&self.bodies[a], &self.bodies[b]);
        let line = one.segment.position_at(at) - two.segment.position_at(at);
        ((one.mover(at), two.mover(at)), line.normalize_or(DVec3::X))
    }

    /// What carries a ball takes what would press it in, without restitution and, at this short a
    /// contact, without friction.
    fn hold_up(&mut self, at: Seconds, index: usize, mover: &mut Mover) {
        let Some((normal, _)) = self.support(index, at) else { return };
        let into = mover.velocity.dot(normal);
        if into < 0.0 && mover.inverse_mass > 0.0 {
            mover.velocity -= normal * into;
            self.ledger.face_j += 0.5 * into * into / mover.inverse_mass;
            self.ledger.momentum.table -= normal * (into / mover.inverse_mass);
        }
    }

    /// How two balls, each moved by a shift, part that were pressed together: each by its share, on
    /// the level so that no energy appears.
    pub(super) fn part(
        &self,
        at: Seconds,
        (a, from_a): (usize, DVec3),
        (b, from_b): (usize, DVec3),
        normal: DVec3,
    ) -> (DVec3, DVec3) {
        let (one, two) = (&self.bodies[a], &self.bodies[b]);
        let there = two.segment.position_at(at) + from_b;
        let distance = (one.segment.position_at(at) + from_a).distance(there);
        let depth = one.ball.radius_m + two.ball.radius_m - distance;
        let level = normal.with_z(0.0);
        let square = level.length_squared();
        let (p, q) = (one.mover(at).inverse_mass, two.mover(at).inverse_mass);
        if depth <= tolerance::PUSH_OUT_M || square < 0.25 || p + q == 0.0 {
            return (DVec3::ZERO, DVec3::ZERO);
        }
        let out = level * (depth / square / (p + q));
        (out * p, out * -q)
    }

    /// A state that is no number is an error with its place.
    pub(super) fn check_finite(&self, at: Seconds, index: usize) -> Result<(), PhysicsError> {
        let body = &self.bodies[index];
        let s = &body.segment;
        let (position, velocity) = (s.position_at(at), s.velocity_at(at));
        let spin = s.angular_velocity_at(at) * 1e-3;
        // One sum tells that all is well; NaN fails it.
        let all = position.abs() + velocity.abs() + spin.abs();
        if all.x + all.y + all.z < 1e9 {
            return Ok(());
        }
        for (term, value) in
            [("position", position), ("velocity", velocity), ("angular velocity", spin)]
        {
            if !(value.is_finite() && value.abs().max_element() < 1e9) {
                return Err(PhysicsError::NonFinite { ball: body.ball.id, time_s: at, term });
            }
        }
        Ok(())
    }
}
