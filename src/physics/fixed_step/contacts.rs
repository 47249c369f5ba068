//! What a contact of the step does: which law, which balls, and what is told of it.

use super::FixedStep;
use super::body::{Path, Support};
use super::sweep::{Contact, Partner};
use crate::ball::BallPlace;
use crate::cue::CuePose;
use crate::events::{FactKind, TouchedBy};
use crate::mesh::Surface;
use crate::physics::laws::choice;
use crate::physics::laws::cluster::{self, Touch};
use crate::physics::laws::cue_ball::{Cue, cue_contact};
use crate::physics::laws::mathavan_2014::Bed;
use crate::physics::laws::{Impact, Mover, ball_face, cushion};
use crate::physics::{Contact as Law, Integrator, MultiContact, tolerance};
use crate::units::Seconds;
use glam::DVec3;
use smallvec::SmallVec;

/// Balls whose path a contact changed.
pub(super) type Changed = SmallVec<[usize; 16]>;

/// Work of a change of velocity by a force [J], not yet made: m Δv · (v + Δv/2).
fn kick_j(mover: &Mover, change: DVec3) -> f64 {
    if mover.inverse_mass > 0.0 {
        change.dot(mover.velocity + 0.5 * change) / mover.inverse_mass
    } else {
        0.0
    }
}

impl FixedStep {
    /// Lets a contact happen; returns the balls whose path it changed.
    pub(super) fn resolve(&mut self, start: Seconds, contact: &Contact) -> Changed {
        match contact.partner {
            Partner::Tip => self.strike(start, contact),
            Partner::Ball(other) => self.collide(start, contact, other),
            Partner::Plane(number) => {
                let surface = self.ground.planes[number].surface;
                self.bounce(start, contact, surface)
            }
            Partner::Face(face) => {
                let surface = self.ground.faces[face as usize].surface;
                self.bounce(start, contact, surface)
            }
        }
    }

    /// Ends a ball's path at `tau` and lets it go on with what `mover` says.
    fn go_on_from(&mut self, start: Seconds, index: usize, tau: Seconds, mover: &Mover) {
        let body = &mut self.bodies[index];
        let position = body.path.at(tau);
        body.orientation = crate::physics::spring::turned(
            body.orientation,
            body.angular_velocity,
            tau - body.path.start,
        );
        body.take(mover);
        body.way = None;
        body.asleep = false;
        body.path = Path {
            start: tau,
            position,
            velocity: if body.ball.flags.integrate { body.velocity } else { DVec3::ZERO },
            revision: body.path.revision + 1,
            contacts: body.path.contacts + 1,
        };
        let knot = body.knot(start + tau, position);
        body.knots.push(knot);
    }

    /// Closing speed below which a contact keeps no restitution: what this step's forces alone have
    /// made, or what is too slow to matter.
    fn lasting(&self, a: usize, b: Option<usize>, normal: DVec3, least: f64) -> f64 {
        let kick = self.bodies[a].kick - b.map_or(DVec3::ZERO, |b| self.bodies[b].kick);
        (-1.01 * kick.dot(normal)).max(least)
    }

    /// The part of the step's kick that is late at `tau` and presses a ball into a surface [m/s].
    /// The velocity holds the kick of the whole step; thrown back by a contact, what acts after it
    /// would give energy to every hop, and low hops would never end. Euler-Cromer's velocity is
    /// that of the middle of the step: positions that it leads to lie on the parabola through them.
    fn late(&self, index: usize, normal: DVec3, tau: Seconds) -> DVec3 {
        let pressed = self.bodies[index].kick.dot(normal).min(0.0);
        let of_velocity = match self.settings.integrator {
            Integrator::EulerCromer => 0.5,
            Integrator::Verlet | Integrator::PositionVerlet | Integrator::Rk4 => 1.0,
        };
        normal * (pressed * (of_velocity - tau / self.h))
    }

    /// The law with its restitution for this approach.
    fn law_at(&self, law: Law, approach: f64, lasting: f64, index: usize) -> Law {
        let caught = self.bodies[index].path.contacts >= tolerance::CONTACTS_PER_STEP;
        if approach <= lasting || caught { Law { restitution: 0.0, ..law } } else { law }
    }

    /// Two balls, and all that touch them.
    fn collide(&mut self, start: Seconds, contact: &Contact, other: usize) -> Changed {
        let (tau, members) = (contact.tau, self.cluster_of(contact.ball, other, contact.tau));
        let pairs = self.pairs_of(&members, contact, other);
        let mut movers: SmallVec<[Mover; 16]> =
            members.iter().map(|index| self.bodies[*index].mover()).collect();
        let place = |index: usize| members.iter().position(|member| *member == index).unwrap_or(0);

        let mut touches: Vec<Touch> = Vec::with_capacity(pairs.len());
        for (a, b, normal) in &pairs {
            let (one, two) = (&movers[place(*a)], &movers[place(*b)]);
            let lasting = self.lasting(*a, Some(*b), *normal, tolerance::STICKY_M_S);
            let slip = one.surface_velocity(*normal) - two.surface_velocity(-*normal);
            let approach = -slip.dot(*normal);
            let law = self.parameters.ball_at((slip + *normal * approach).length());
            let alone = members.len() == 2;
            let law = self.law_at(law, if alone { approach } else { f64::INFINITY }, lasting, *a);
            let touch = Touch::new(place(*a), Some(place(*b)), *normal, law);
            touches.push(Touch { sticky_m_s: lasting, ..touch });
        }
        let holding: SmallVec<[(usize, Support); 8]> = members
            .iter()
            .flat_map(|index| {
                let body = &self.bodies[*index];
                let mut held = if body.supports.is_empty() {
                    SmallVec::new()
                } else {
                    body.holding(body.path.at(tau))
                };
                // A cushion throws back what is pressed into it: a contact of its own.
                held.retain(|support| !matches!(support.surface, Surface::Cushion(_)));
                held.into_iter().map(|support| (place(*index), support)).collect::<Vec<_>>()
            })
            .collect();

        if let ([touch], true) = (&mut touches[..], members.len() == 2) {
            // A pair alone: the closed form. What carries a ball only keeps it from being pressed
            // in, without restitution and, at this short a contact, without friction.
            let (a, b) = (0, 1);
            let (mut one, mut two) = (movers[a], movers[b]);
            let law = Law { restitution: touch.restitution, friction: touch.friction };
            let bed = |index: usize| {
                let (_, support) = holding.iter().find(|(place, _)| *place == index)?;
                let friction = self.parameters.surface(support.surface).friction;
                Some(Bed { normal: support.normal, friction })
            };
            let (Impact { impulse, loss_j, .. }, cloth) = choice::pair(
                &mut one,
                &mut two,
                touch.normal,
                [bed(a), bed(b)],
                law,
                &self.parameters,
            );
            (movers[a], movers[b]) = (one, two);
            touch.impulse = impulse;
            touch.loss_j = loss_j;
            for impact in cloth {
                self.ledger.cloth_j += impact.loss_j;
                self.ledger.momentum.table += impact.impulse;
            }
            for (index, support) in &holding {
                self.hold_up(&mut movers[*index], support);
            }
        } else {
            let smooth = Law { restitution: 0.0, friction: 0.0 };
            let balls = touches.len();
            touches.extend(holding.iter().map(|(index, support)| Touch {
                carries: true,
                ..Touch::new(*index, None, support.normal, smooth)
            }));
            let mut gaps: SmallVec<[f64; 32]> =
                pairs.iter().map(|(a, b, _)| self.gap(*a, *b, tau).max(0.0)).collect();
            gaps.resize(touches.len(), 0.0);
            choice::several(&mut movers, &mut touches, &gaps, &self.parameters);
            for touch in &touches[balls..] {
                self.ledger.face_j += touch.loss_j;
                self.ledger.momentum.table += touch.impulse;
            }
            touches.truncate(balls);
        }

        let mut changed = Changed::new();
        for (index, mover) in members.iter().zip(&movers) {
            let body = &self.bodies[*index];
            if body.velocity != mover.velocity || body.angular_velocity != mover.angular_velocity {
                changed.push(*index);
            }
        }
        // A contact that did nothing must not be found again.
        for index in [contact.ball, other] {
            if !changed.contains(&index) {
                changed.push(index);
            }
        }
        for ((a, b, normal), touch) in pairs.iter().zip(&touches) {
            self.ledger.ball_ball_j += touch.loss_j;
            let impulse = touch.impulse.dot(*normal);
            if impulse > 0.0 {
                self.work.contacts += 1;
                let inverse =
                    movers[touch.a].inverse_mass + touch.b.map_or(0.0, |b| movers[b].inverse_mass);
                let speed = impulse * inverse / (1.0 + touch.restitution);
                let at = self.bodies[*a].path.at(tau) - *normal * self.bodies[*a].ball.radius_m;
                self.tell_collision(start + tau, *a, *b, at, speed);
            }
        }
        for (index, mover) in members.iter().zip(&movers) {
            if changed.contains(index) {
                self.go_on_from(start, *index, tau, mover);
            }
        }
        changed
    }

    /// The surface below takes what would press the ball into it.
    fn hold_up(&mut self, mover: &mut Mover, support: &Support) {
        let Mover { inverse_mass, .. } = *mover;
        let into = mover.velocity.dot(support.normal);
        if into < 0.0 && inverse_mass > 0.0 {
            mover.velocity -= support.normal * into;
            self.ledger.face_j += 0.5 * into * into / inverse_mass;
            self.ledger.momentum.table -= support.normal * (into / inverse_mass);
        }
    }

    /// The partners of a contact, and from them outwards all balls that nearly touch.
    fn cluster_of(&mut self, a: usize, b: usize, tau: Seconds) -> SmallVec<[usize; 16]> {
        let mut members: SmallVec<[usize; 16]> = SmallVec::from_slice(&[a, b]);
        if self.parameters.multi_contact == MultiContact::Pairwise {
            members.sort_unstable();
            return members;
        }
        let mut next = 0;
        while next < members.len() {
            let member = members[next];
            next += 1;
            let near = self.balls_near(member);
            for other in &near {
                if !members.contains(other) && self.gap(member, *other, tau) <= tolerance::CLUSTER_M
                {
                    members.push(*other);
                }
            }
            self.scratch.near = near;
        }
        members.sort_unstable();
        members
    }

    fn gap(&self, a: usize, b: usize, tau: Seconds) -> f64 {
        let (a, b) = (&self.bodies[a], &self.bodies[b]);
        a.path.at(tau).distance(b.path.at(tau)) - a.ball.radius_m - b.ball.radius_m
    }

    /// All pairs of a cluster that nearly touch, with the unit vector from the second to the first.
    /// Without back-dating the normal is that at the step's end, as an overlap test would find it
    /// (paper, section 5.4.3), unless the balls do not close along it: then nothing would come of
    /// the contact, and it would be found again and again.
    fn pairs_of(
        &self,
        members: &[usize],
        contact: &Contact,
        other: usize,
    ) -> SmallVec<[(usize, usize, DVec3); 32]> {
        let mut pairs = SmallVec::new();
        let (dated, tau) = (self.settings.contact_back_dating, contact.tau);
        for (place, a) in members.iter().enumerate() {
            for b in &members[place + 1..] {
                let own = *a == contact.ball && *b == other;
                if own || self.gap(*a, *b, contact.tau) <= tolerance::CLUSTER_M {
                    let (one, two) = (&self.bodies[*a], &self.bodies[*b]);
                    let normal = |at| (one.path.at(at) - two.path.at(at)).normalize_or(DVec3::X);
                    let late = normal(self.h);
                    let closes = (one.velocity - two.velocity).dot(late) < -tolerance::CLOSING_M_S;
                    let found = if dated || !closes { normal(tau) } else { late };
                    pairs.push((*a, *b, found));
                }
            }
        }
        pairs
    }

    /// A ball and a fixed surface.
    fn bounce(&mut self, start: Seconds, contact: &Contact, surface: Surface) -> Changed {
        let (index, tau, normal) = (contact.ball, contact.tau, contact.normal);
        let at = start + tau;
        let mut changed = Changed::new();
        changed.push(index);
        match surface {
            Surface::PocketBottom(pocket) => {
                self.take_out(at, index, tau, BallPlace::Pocketed, Some(pocket));
                return changed;
            }
            Surface::Floor => {
                self.take_out(at, index, tau, BallPlace::OffTable, None);
                return changed;
            }
            _ => {}
        }

        // What carries the ball, apart from what it meets.
        let mut mover = self.bodies[index].mover();
        let position = self.bodies[index].path.at(tau);
        let apart = |other: DVec3| other.dot(normal) < 1.0 - tolerance::COPLANAR;
        let mut held = self.bodies[index].holding(position);
        held.retain(|support| apart(support.normal));

        let late = if held.is_empty() { self.late(index, normal, tau) } else { DVec3::ZERO };
        let approach = -(mover.velocity - late).dot(normal);
        let least = match surface {
            Surface::Cushion(_) => tolerance::STICKY_M_S,
            _ => tolerance::LANDING_M_S,
        };
        let lasting = self.lasting(index, None, normal, least);
        let law = match surface {
            Surface::Cushion(_) => self.parameters.cushion_at(approach),
            _ => self.parameters.surface(surface),
        };
        let law = self.law_at(law, approach, lasting, index);
        // A ball that stays is pressed for the rest of the step too: nothing is late then, and a
        // contact cannot give back what makes it happen again.
        let late = if law.restitution > 0.0 { late } else { DVec3::ZERO };
        self.ledger.integration_j += kick_j(&mover, -late);
        mover.velocity -= late;

        // Other surfaces that it meets at this moment.
        let met: SmallVec<[(DVec3, Surface); 2]> = self
            .also_touches(contact)
            .filter(|other| apart(other.normal))
            .map(|other| (other.normal, self.surface_of(other.partner)))
            .collect();

        let mut loss_j = 0.0;
        if met.is_empty() && held.is_empty() {
            let impact = ball_face::bounce(&mut mover, normal, law.restitution, law.friction);
            self.ledger.momentum.table += impact.impulse;
            loss_j += impact.loss_j;
        } else if let ([], [support]) = (&met[..], &held[..]) {
            let cloth = self.parameters.surface(support.surface);
            let (own, bed) = match surface {
                Surface::Cushion(_) => choice::cushion_and_bed(
                    &mut mover,
                    normal,
                    support.normal,
                    law,
                    cloth,
                    &self.parameters,
                ),
                _ => cushion::bounce(&mut mover, normal, support.normal, law, cloth),
            };
            self.ledger.momentum.table += own.impulse + bed.impulse;
            self.ledger.cloth_j += bed.loss_j;
            loss_j += own.loss_j;
        } else {
            let mut touches: SmallVec<[Touch; 6]> = SmallVec::new();
            touches.push(Touch::new(0, None, normal, law));
            for (normal, surface) in &met {
                let law = match surface {
                    Surface::Cushion(_) => self.parameters.cushion_at(-mover.velocity.dot(*normal)),
                    _ => self.parameters.surface(*surface),
                };
                let law = self.law_at(law, f64::INFINITY, lasting, index);
                let touch = Touch::new(0, None, *normal, law);
                touches.push(Touch { sticky_m_s: lasting, ..touch });
            }
            for support in &held {
                let law = self.parameters.surface(support.surface);
                let touch = Touch::new(0, None, support.normal, law);
                touches.push(Touch { carries: true, ..touch });
            }
            cluster::resolve(core::slice::from_mut(&mut mover), &mut touches);
            for touch in &touches {
                self.ledger.momentum.table += touch.impulse;
                loss_j += touch.loss_j;
            }
        }
        match surface {
            Surface::Cushion(_) => self.ledger.cushion_j += loss_j,
            _ => self.ledger.face_j += loss_j,
        }

        self.ledger.integration_j += kick_j(&mover, late);
        mover.velocity += late;

        self.work.contacts += 1;
        let point = position - normal * self.bodies[index].ball.radius_m;
        let before = self.bodies[index].velocity;
        if let Surface::Cushion(rail) = surface {
            self.tell_cushion(at, index, rail, point, approach);
        }
        for (normal, surface) in &met {
            if let Surface::Cushion(rail) = surface {
                self.tell_cushion(at, index, *rail, point, -before.dot(*normal));
            }
        }
        self.go_on_from(start, index, tau, &mover);
        if law.restitution == 0.0 {
            self.lay_on(index, contact);
        }
        changed
    }

    pub(super) fn surface_of(&self, partner: Partner) -> Surface {
        match partner {
            Partner::Plane(number) => self.ground.planes[number].surface,
            Partner::Face(face) => self.ground.faces[face as usize].surface,
            Partner::Ball(_) | Partner::Tip => Surface::Obstacle,
        }
    }

    /// A ball that stays on a flat surface lies on it exactly: rounding of the time of contact does
    /// not keep it a hair above or below.
    fn lay_on(&mut self, index: usize, contact: &Contact) {
        let (origin, normal) = match contact.partner {
            Partner::Plane(number) => {
                let plane = &self.ground.planes[number];
                (plane.normal.dot(plane.point), plane.normal)
            }
            Partner::Face(face) => {
                let face = &self.ground.faces[face as usize];
                (face.offset, face.normal)
            }
            Partner::Ball(_) | Partner::Tip => return,
        };
        if contact.normal.dot(normal).abs() < 1.0 - tolerance::COPLANAR {
            return;
        }
        let side = contact.normal.dot(normal).signum();
        let body = &mut self.bodies[index];
        let off = body.ball.radius_m - side * (normal.dot(body.path.position) - origin);
        if off.abs() <= tolerance::PUSH_OUT_M {
            body.path.position += normal * (side * off);
        }
    }

    /// The tip strikes a ball.
    fn strike(&mut self, start: Seconds, contact: &Contact) -> Changed {
        let (index, tau, at) = (contact.ball, contact.tau, start + contact.tau);
        let mut changed = Changed::new();
        let Some(cue) = &self.cue else { return changed };
        let (tip, velocity) = cue.tip_at(tau);
        let direction = cue.guided.direction(at);
        let has_struck = cue.guided.has_struck;
        changed.push(index);

        let position = self.bodies[index].path.at(tau);
        let normal = (position - tip).normalize_or(direction);
        let mut mover = self.bodies[index].mover();
        let before = mover.surface_velocity(normal);
        let approach = -(before - velocity).dot(normal);
        let mut cue = Cue::new(&self.parameters, velocity, direction);
        let impact = cue_contact(&mut mover, &mut cue, normal);
        // Work of the impulse on the ball, whose surface moves with the mean of both velocities.
        let after = mover.surface_velocity(normal);
        self.ledger.cue_j += 0.5 * impact.impulse.dot(before + after);
        self.ledger.momentum.cue += impact.impulse;
        self.work.contacts += 1;

        // What is told is as it was before the stroke.
        let lively = |place: usize| self.bodies[place].liveliness() > tolerance::REST_M_S;
        let moving = !has_struck
            && (0..self.bodies.len()).any(|place| self.bodies[place].in_play() && lively(place));
        let point = position - normal * self.bodies[index].ball.radius_m;
        let ball = self.bodies[index].ball.id;
        self.begin_shot();
        self.go_on_from(start, index, tau, &mover);
        let kind = FactKind::CueBallStruck {
            ball,
            push: self.is_pushed(index, tau),
            moving,
            player: None,
            miscue: !impact.sticks,
            position_m: point,
            normal_speed_m_s: approach,
        };
        self.tell(at, kind);
        if !has_struck {
            self.tell_shaft(at, index, tau, &CuePose { tip, velocity, direction, solid: true });
        }
        // However softly: whoever waits for the end of a shot shall hear of it.
        self.moved = true;
        let h = self.h;
        if let Some(motion) = &mut self.cue {
            motion.strike(start, tau, h, index, cue.velocity);
        }
        changed
    }

    /// Balls that lie in the shaft when it strikes were touched by it. They are told, not moved.
    fn tell_shaft(&mut self, at: Seconds, struck: usize, tau: Seconds, pose: &CuePose) {
        for index in 0..self.bodies.len() {
            let body = &self.bodies[index];
            let (centre, radius_m) = (body.path.at(tau), body.ball.radius_m);
            if index != struck && body.solid() && pose.shaft_meets(centre, radius_m) {
                let ball = body.ball.id;
                self.tell(at, FactKind::BallTouched { ball, by: TouchedBy::Shaft });
            }
        }
    }

    /// Whether the ball, just struck, meets another while the tip is still on it: within the time
    /// that a tip stays, and not frozen to it before.
    fn is_pushed(&self, index: usize, tau: Seconds) -> bool {
        let body = &self.bodies[index];
        (0..self.bodies.len()).any(|place| {
            let other = &self.bodies[place];
            place != index
                && other.solid()
                && self.gap(index, place, tau) > tolerance::CLUSTER_M
                && {
                    crate::physics::roots::straight(
                        body.path.position - other.path.at(tau),
                        body.path.velocity - other.path.velocity,
                        body.ball.radius_m + other.ball.radius_m,
                        tolerance::TIP_CONTACT_S,
                        0.0,
                    )
                    .is_some()
                }
        })
    }
}
