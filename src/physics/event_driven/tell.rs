//! What is told: facts, each once, with the exact time; and the accounts of energy and momentum.
//!
//! Balls that lie together, or at a cushion, meet again and again; that is told when it begins and,
//! later, only if they meet with some speed.

use super::body::{Body, Report};
use super::segment::{Course, Segment};
use super::{EventDriven, predict};
use crate::ball::BallPlace;
use crate::events::{Fact, FactKind};
use crate::ids::{BallId, PocketId, Rail};
use crate::mesh::Surface;
use crate::physics::{Ledger, checks, racks, tolerance};
use crate::units::Seconds;
use glam::DVec3;

/// A pair that has not met for so long has parted in between [s].
const APART_S: Seconds = 0.05;

impl EventDriven {
    pub(super) fn tell(&mut self, time_s: Seconds, kind: FactKind) {
        self.told.push(Fact { time_s, kind });
    }

    /// Two balls met; `a` comes before `b`.
    pub(super) fn tell_collision(
        &mut self,
        time_s: Seconds,
        a: usize,
        b: usize,
        position_m: DVec3,
        normal_speed_m_s: f64,
    ) {
        let place = self.touching.binary_search_by_key(&(a, b), |(a, b, _)| (*a, *b));
        let new = match place {
            Ok(place) => {
                let last = std::mem::replace(&mut self.touching[place].2, time_s);
                time_s - last > APART_S
            }
            Err(place) => {
                self.touching.insert(place, (a, b, time_s));
                true
            }
        };
        if !new && normal_speed_m_s <= tolerance::REPEATED_CONTACT_M_S {
            return;
        }
        let (mut one, mut two) = (a, b);
        if self.bodies[two].ball.id == BallId::CUE {
            (one, two) = (two, one);
        }
        let x = self.bodies[two].segment.position_at(time_s).x;
        let kind = FactKind::BallsCollided {
            a: self.bodies[one].ball.id,
            b: self.bodies[two].ball.id,
            in_kitchen: self.terrain.head_string_x().is_some_and(|head| x <= head),
            position_m,
            normal_speed_m_s,
        };
        self.tell(time_s, kind);
    }

    /// A ball met a cushion.
    pub(super) fn tell_cushion(
        &mut self,
        time_s: Seconds,
        index: usize,
        rail: Rail,
        position_m: DVec3,
        normal_speed_m_s: f64,
    ) {
        self.watch_rails(index, time_s);
        let bit = rail.bit();
        let body = &mut self.bodies[index];
        let onset = body.clear_rails & bit != 0;
        let held = body.held_rails & bit != 0;
        body.clear_rails &= !bit;
        body.held_rails |= bit;
        if held && !onset && normal_speed_m_s <= tolerance::REPEATED_CONTACT_M_S {
            return;
        }
        let ball = body.ball.id;
        self.tell(time_s, FactKind::CushionHit { ball, rail, onset, position_m, normal_speed_m_s });
    }

    /// Notes which rails a ball has left in the segment that ends now: it was away from them at its
    /// middle or is at its end.
    pub(super) fn watch_rails(&mut self, index: usize, end: Seconds) {
        let body = &self.bodies[index];
        if body.clear_rails == ALL_RAILS && body.held_rails == 0 {
            return;
        }
        let (segment, radius) = (&body.segment, body.ball.radius_m);
        for place in [0.5 * (segment.start_s + end), end].map(|at| segment.position_at(at)) {
            let near = self.rails_at(place, radius);
            let body = &mut self.bodies[index];
            body.clear_rails |= ALL_RAILS & !near;
            body.held_rails &= near;
        }
    }

    /// The rails that a ball touches.
    fn rails_at(&self, centre: DVec3, radius_m: f64) -> u8 {
        // Far inside of the noses there are none.
        let inside = |bed: crate::table::Bed| {
            (bed.half() - centre.truncate().abs()).min_element() > radius_m + tolerance::APART_M
        };
        if self.terrain.bed.is_some_and(inside) {
            return 0;
        }
        let near = self.terrain.near_but(centre, radius_m + tolerance::APART_M, true);
        let rails = near.iter().map(|(feature, ..)| match self.terrain.surface(*feature) {
            Surface::Cushion(rail) => rail.bit(),
            _ => 0,
        });
        rails.fold(0, |all, bit| all | bit)
    }

    /// A shot begins here for this ball: it has been away from the rails that it does not touch.
    pub(super) fn clear_touched_rails(&mut self, index: usize) {
        let at = self.done;
        let position = self.bodies[index].segment.position_at(at);
        let near = self.rails_at(position, self.bodies[index].ball.radius_m);
        let body = &mut self.bodies[index];
        body.clear_rails = ALL_RAILS & !near;
        body.held_rails = 0;
        body.behind = self.terrain.head_string_x().is_some_and(|head| position.x <= head);
    }

    /// Something that is only told.
    pub(super) fn report(&mut self, at: Seconds, index: usize) {
        let ball = self.bodies[index].ball.id;
        match self.bodies[index].report.1 {
            Report::HeadString => {
                self.bodies[index].behind = false;
                self.tell(at, FactKind::HeadStringCrossed { ball });
            }
            Report::Depth => {
                if self.sinks_for_good(at, index) {
                    return;
                }
            }
        }
        self.bodies[index].report = self.next_report(at, index);
        self.next[index] = self.bodies[index].alone_s().min(self.pairs[index].0);
    }

    /// A ball wholly below the bed inside a pocket and too slow to come back is down; one below
    /// everything has left the table.
    pub(super) fn sinks_for_good(&mut self, at: Seconds, index: usize) -> bool {
        let body = &self.bodies[index];
        let radius = body.ball.radius_m;
        let position = body.segment.position_at(at);
        if position.z > -radius + tolerance::PUSH_OUT_M || self.terrain.pockets.is_empty() {
            if position.z < self.terrain.lowest_m - tolerance::ABYSS_M {
                self.take_out(at, index, BallPlace::OffTable, None);
                return true;
            }
            return false;
        }
        let speed = body.segment.velocity_at(at).length_squared();
        let rises = speed >= 2.0 * self.parameters.gravity_m_s2 * -position.z;
        let pocket = self
            .terrain
            .pockets
            .iter()
            .find(|pocket| pocket.centre.distance(position.truncate()) <= pocket.radius_m + radius)
            .map(|pocket| pocket.id);
        if pocket.is_some() && !rises {
            self.take_out(at, index, BallPlace::Pocketed, pocket);
            return true;
        }
        false
    }

    /// A ball leaves play: into a pocket, or off the table.
    pub(super) fn take_out(
        &mut self,
        at: Seconds,
        index: usize,
        place: BallPlace,
        pocket: Option<PocketId>,
    ) {
        self.close_segment(at, index);
        let body = &self.bodies[index];
        self.ledger.removed_j += self.energy_of(body, at);
        if body.ball.flags.integrate {
            let momentum = body.segment.velocity_at(at) * body.ball.mass_kg;
            self.ledger.momentum.removed += momentum;
        }
        let body = &mut self.bodies[index];
        let (ball, speed_m_s) = (body.ball.id, body.segment.velocity_at(at).length());
        let rest =
            Segment::still(at, body.segment.position_at(at), body.segment.orientation_at(at));
        body.put(place, at);
        body.held.clear();
        body.turn_into(rest);
        self.note_track(index);
        self.touching.retain(|(a, b, _)| *a != index && *b != index);
        self.tell(
            at,
            match pocket {
                Some(pocket) => FactKind::BallPocketed { ball, pocket, speed_m_s },
                None => FactKind::BallOffTable { ball },
            },
        );
        self.predict(at, &[index]);
        self.wake_neighbours(at, &[index]);
    }

    /// Notices that everything has come to rest, or moves again.
    pub(super) fn watch_rest(&mut self) {
        debug_assert!(self.bodies.iter().zip(&self.paths).all(|(b, p)| b.is_still() == p.still));
        let still = self.paths.iter().all(|path| path.still);
        if !still {
            self.moved = true;
            self.rest_since = None;
        } else if self.moved && self.rest_since.is_none() {
            self.rest_since = Some(self.done);
        }
    }

    /// Everything has been at rest long enough. It changes no state, but for balls that lie beside
    /// the bed: they have left the table.
    pub(super) fn settle(&mut self, at: Seconds) {
        self.moved = false;
        self.rest_since = None;
        for index in 0..self.bodies.len() {
            let beside = |feature| self.terrain.surface(feature) == Surface::Wood;
            if self.bodies[index].in_play()
                && self.bodies[index].held.iter().any(|feature| beside(*feature))
            {
                self.take_out(at, index, BallPlace::OffTable, None);
            } else {
                self.clear_touched_rails(index);
            }
        }
        self.moved = false;
        if let Some(tip) = &mut self.tip {
            tip.cue.has_struck = false;
        }
        self.memory.end();
        let lies = |body: &Body| (body.ball.id, body.segment.position_at(at), body.ball.radius_m);
        let solid = self.bodies.iter().filter(|body| body.solid());
        for (a, b) in checks::frozen_pairs(solid.map(lies).collect()) {
            self.tell(at, FactKind::BallsFrozen { a, b });
        }
        let lies = |body: &Body| (body.ball.id, body.in_play(), body.segment.position_at(at));
        let bed = self.terrain.bed.as_ref();
        let cue_in_rack = racks::cue_in_rack(bed, self.bodies.iter().map(lies));
        self.tell(at, FactKind::Settled { snookered: false, cue_in_rack });
    }

    pub(super) fn note_track(&mut self, index: usize) {
        if let Some(tracks) = &mut self.tracks {
            tracks[index].push(self.bodies[index].segment);
        }
    }

    /// Kinetic energy, and weight times height [J].
    pub(super) fn energy_of(&self, body: &Body, at: Seconds) -> f64 {
        if body.in_play() { body.mover(at).kinetic_j() + self.weight_j(body, at) } else { 0.0 }
    }

    /// Weight times height [J]; zero for a ball without weight.
    pub(super) fn weight_j(&self, body: &Body, at: Seconds) -> f64 {
        self.lift_j(body, body.segment.position_at(at).z)
    }

    /// Weight times a height [m]; zero for a ball without weight [J].
    pub(super) fn lift_j(&self, body: &Body, height_m: f64) -> f64 {
        let weighs = body.ball.flags.gravity && body.ball.flags.integrate;
        if weighs { body.ball.mass_kg * self.parameters.gravity_m_s2 * height_m } else { 0.0 }
    }

    pub(super) fn momentum(&self, at: Seconds) -> DVec3 {
        self.bodies
            .iter()
            .filter(|body| body.in_play() && body.ball.flags.integrate)
            .map(|body| body.segment.velocity_at(at) * body.ball.mass_kg)
            .sum()
    }

    /// Books what the segment of a ball did up to `at`.
    pub(super) fn close_segment(&mut self, at: Seconds, index: usize) {
        let body = &self.bodies[index];
        if body.segment.swing.is_some() {
            let given = self.spring_j(body, at);
            self.ledger.spring_j += given;
        }
        let (loss_j, table, smooth) = self.account(&self.bodies[index], at);
        self.ledger.cloth_j += loss_j;
        self.ledger.momentum.table += table;
        self.ledger.momentum.smooth += smooth;
    }

    /// Energy that a spring with its damper has given in a segment [J]: what is not weight.
    fn spring_j(&self, body: &Body, at: Seconds) -> f64 {
        let start = body.segment.start_s;
        self.energy_of(body, at) - self.energy_of(body, start)
    }

    /// Energy that a segment has lost to what carries the ball [J], impulse of the table and of
    /// gravity [N s], from its start to `at`.
    ///
    /// Sliding: ∫ f·u dt, with the slip u falling linearly. Rolling: drag times path, with the
    /// spin's share. Spin: I α ∫ |ω_n| dt.
    fn account(&self, body: &Body, at: Seconds) -> (f64, DVec3, DVec3) {
        let s = &body.segment;
        let t = at - s.start_s;
        if !body.in_play() || !body.ball.flags.integrate || t <= 0.0 {
            return (0.0, DVec3::ZERO, DVec3::ZERO);
        }
        let (mass, inertia) = (body.ball.mass_kg, body.ball.inertia_kg_m2());
        let weighs = body.ball.flags.gravity;
        let gravity =
            if weighs { DVec3::NEG_Z * self.parameters.gravity_m_s2 } else { DVec3::ZERO };
        let smooth = gravity * (mass * t);
        if s.swing.is_some() {
            let change = (s.velocity_at(at) - s.velocity) * mass;
            return (0.0, DVec3::ZERO, change);
        }
        let mut loss_j = 0.0;
        let table = s.acceleration * (mass * t) - smooth;
        match s.course {
            Course::Sliding => {
                let friction = s.acceleration - (gravity - s.normal * gravity.dot(s.normal));
                let slip = |at: Seconds| {
                    s.velocity_at(at)
                        - body.ball.radius_m * s.angular_velocity_at(at).cross(s.normal)
                };
                loss_j -= mass * friction.dot(0.5 * (slip(s.start_s) + slip(at))) * t;
            }
            Course::Rolling => {
                let pull = gravity - s.normal * gravity.dot(s.normal);
                let factor = 1.0 + body.ball.inertia_factor;
                let drag = s.acceleration * factor - pull;
                loss_j -= mass * drag.dot(0.5 * (s.velocity + s.velocity_at(at))) * t;
            }
            Course::Lasting => {
                // All that is no gravity acts at the surface: its work on path and spin.
                let mean = 0.5 * (s.velocity + s.velocity_at(at));
                let mean_spin = 0.5 * (s.angular_velocity + s.angular_velocity_at(at));
                loss_j -= mass * (s.acceleration - gravity).dot(mean) * t
                    + inertia * s.angular_acceleration.dot(mean_spin) * t;
            }
            Course::Flying
            | Course::Springing
            | Course::Spinning
            | Course::Settling
            | Course::Rest => {}
        }
        if s.spin_deceleration > 0.0 {
            let spin = s.angular_velocity.dot(s.normal);
            let left = s.angular_velocity_at(at).dot(s.normal);
            loss_j += 0.5 * inertia * (spin * spin - left * left);
        }
        (loss_j, table, smooth)
    }

    /// The ledger now, with what the open segments have done.
    pub(super) fn closed_ledger(&self) -> Ledger {
        let mut ledger = self.ledger;
        let at = self.now.max(self.done);
        let (mut kinetic, mut weight) = (0.0, 0.0);
        for body in self.bodies.iter().filter(|body| body.in_play()) {
            if body.segment.swing.is_some() {
                ledger.spring_j += self.spring_j(body, at);
            }
            let (loss_j, table, smooth) = self.account(body, at);
            ledger.cloth_j += loss_j;
            ledger.momentum.table += table;
            ledger.momentum.smooth += smooth;
            kinetic += body.mover(at).kinetic_j();
            weight += self.weight_j(body, at);
        }
        ledger.closed(kinetic, weight, self.momentum(at))
    }

    /// Wakes balls that lean on one that has changed.
    pub(super) fn wake_neighbours(&mut self, at: Seconds, changed: &[usize]) {
        let mut woken = predict::Changed::new();
        for (index, path) in self.paths.iter().enumerate() {
            if !path.leans || !path.solid || changed.contains(&index) {
                continue;
            }
            let near = |other: &usize| {
                let apart = self.centre_at(index, at).distance(self.centre_at(*other, at));
                let reach = path.radius_m + self.paths[*other].radius_m;
                apart <= reach + super::lasting::TOUCH_M * 10.0
            };
            if changed.iter().any(near) {
                woken.push(index);
            }
        }
        if !woken.is_empty() {
            self.begins.extend_from_slice(&woken);
            self.predict(at, &woken);
        }
    }
}

const ALL_RAILS: u8 = 0b1111;
