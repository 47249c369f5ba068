//! When what happens: the end of a segment, the terrain, other balls.
//!
//! Each ball knows its own next event and its earliest partner. The horizon of a pair is the
//! earlier of both own events: beyond it their paths are not known. After an event only balls whose
//! segment changed are predicted again, and those whose earliest partner was one of them.

use super::EventDriven;
use super::body::{Own, Report};
use super::closing::{self, Relative};
use super::path::Path;
use super::segment::Course;
use super::sweep;
use super::swing_meets;
use crate::physics::tolerance;
use crate::units::Seconds;
use glam::DVec3;
use smallvec::SmallVec;

/// More than what rounding takes off a distance.
const ROUGH: f64 = 1.0 + 1e-9;

/// Balls that an event changed.
pub(super) type Changed = SmallVec<[usize; 16]>;

impl EventDriven {
    /// Predicts everything afresh.
    pub(super) fn predict_all(&mut self) {
        let all: Changed = (0..self.bodies.len()).collect();
        self.predict(self.done, &all);
    }

    /// Predicts the balls that an event at `at` changed.
    pub(super) fn predict(&mut self, at: Seconds, changed: &[usize]) {
        let mut changed = Changed::from_slice(changed);
        self.begin_pieces(at, &mut changed);
        for index in &changed {
            self.predict_own(at, *index);
            self.paths[*index] = Path::of(&self.bodies[*index]);
            self.pairs[*index] = (f64::INFINITY, 0);
        }
        // Whoever waited for one of them looks for somebody else.
        let mut stale: Changed = SmallVec::new();
        for (index, pair) in self.pairs.iter_mut().enumerate() {
            if pair.0.is_finite() && changed.contains(&pair.1) {
                *pair = (f64::INFINITY, 0);
                stale.push(index);
            }
        }
        for index in changed.iter().chain(&stale) {
            self.next[*index] = self.bodies[*index].alone_s();
        }
        for (place, index) in changed.iter().enumerate() {
            self.predict_pairs(at, *index, |other| !changed[..place].contains(&other));
        }
        for (place, index) in stale.iter().enumerate() {
            self.predict_pairs(at, *index, |other| {
                !changed.contains(&other) && !stale[..place].contains(&other)
            });
        }
        self.predict_tip(at, &changed);
    }

    fn predict_own(&mut self, at: Seconds, index: usize) {
        let EventDriven { terrain, bodies, work, .. } = self;
        let body = &mut bodies[index];
        body.report = (f64::INFINITY, Report::HeadString);
        if !body.in_play() {
            body.own = Own::Ends(f64::INFINITY);
            return;
        }
        let segment = &body.segment;
        // A lasting ball's piece ends with the step of all of them.
        let end_s = if segment.course == Course::Lasting { f64::INFINITY } else { segment.end_s };
        body.own = Own::Ends(end_s);
        work.flights += u64::from(segment.course == Course::Flying);
        let spins =
            segment.spin_deceleration > 0.0 && segment.angular_velocity.dot(segment.normal) != 0.0;
        work.spins += u64::from(spins);
        if body.ball.flags.collide && !body.stands() {
            let until = segment.end_s.min(at + 1e4);
            let radius = body.ball.radius_m;
            if segment.swings() {
                body.own = swing_meets::own_event(terrain, segment, radius, at, work);
            } else {
                let met =
                    sweep::first_meeting(terrain, segment, radius, at, until, &body.held, work);
                if let Some(meeting) = met {
                    body.own = Own::Meets(meeting);
                }
            }
        }
        if let Some(head) = terrain.head_string_x() {
            body.behind |= body.segment.position_at(at).x < head - tolerance::PUSH_OUT_M;
        }
        self.bodies[index].report = self.next_report(at, index);
    }

    /// The next thing that is only told: the head string, or sinking below the bed.
    pub(super) fn next_report(&mut self, after: Seconds, index: usize) -> (Seconds, Report) {
        let body = &self.bodies[index];
        let none = (f64::INFINITY, Report::HeadString);
        let Some(head) = self.terrain.head_string_x() else { return none };
        if body.stands() {
            return none;
        }
        let radius = body.ball.radius_m;
        if body.segment.swings() && !swing_meets::is_told(&self.terrain, &body.segment) {
            return none;
        }
        let until = body.segment.end_s.min(body.own_s());
        let falls = matches!(body.segment.course, Course::Flying | Course::Lasting);
        let (mut from, sinks) = (after, falls && !self.terrain.pockets.is_empty());
        if !body.behind && !sinks {
            return none;
        }
        loop {
            let body = &self.bodies[index];
            let piece = body.segment.stretch(from, until);
            let horizon = piece.end_s - from;
            let (x, v) = (piece.position_at(from), piece.velocity_at(from));
            let a = piece.acceleration;
            let mut best = none;
            // x − head rises through zero: its negative falls.
            if body.behind
                && let Some(time) =
                    closing::falling_quadratic((head - x.x).max(0.0), -v.x, -a.x, horizon)
            {
                best = (from + time, Report::HeadString);
            }
            let sinks = sinks && x.z > -radius + tolerance::PUSH_OUT_M;
            self.work.pocket_tests += u64::from(sinks);
            if sinks
                && let Some(time) = closing::falling_quadratic(x.z + radius, v.z, a.z, horizon)
                && from + time < best.0
            {
                best = (from + time, Report::Depth);
            }
            if best.0.is_finite() || until <= piece.end_s {
                return best;
            }
            from = piece.end_s;
        }
    }

    fn predict_pairs(&mut self, at: Seconds, index: usize, wanted: impl Fn(usize) -> bool) {
        let own = self.paths[index];
        if !own.solid {
            return;
        }
        let (position, velocity) = self.way_at(index, at);
        for other in 0..self.paths.len() {
            let path = &self.paths[other];
            if other == index || !path.solid || own.stands && path.stands || !wanted(other) {
                continue;
            }
            let known = self.pairs[index].0.max(self.pairs[other].0);
            let horizon = own.known_s.min(path.known_s).min(known) - at;
            if own.swings || path.swings {
                if own.moves || path.moves {
                    self.work.pair_tests += 1;
                    let time = self.swinging_pair(at, index, other, at + horizon);
                    self.note_pair(index, other, time);
                }
                continue;
            }
            let distance = own.radius_m + path.radius_m;
            // A rough look at what both can reach spares most of the work while they hop.
            let far = (distance + own.reach_m(at, horizon) + path.reach_m(at, horizon)) * ROUGH;
            if (position - path.position_at(at)).length_squared() > far * far {
                continue;
            }
            let (there, pace) = self.way_at(other, at);
            let motion = Relative {
                offset: position - there,
                velocity: velocity - pace,
                acceleration: own.acceleration - path.acceleration,
            };
            if motion.velocity == DVec3::ZERO && motion.acceleration == DVec3::ZERO
                || !own.moves && !path.moves
                || own.lasts
                    && path.lasts
                    && motion.offset.length() - distance <= super::lasting::TOUCH_M
            {
                continue;
            }
            self.work.pair_tests += 1;
            let time = closing::spheres(&motion, distance, horizon).map(|time| at + time);
            self.note_pair(index, other, time);
        }
    }

    /// Two balls meet at `time`, if they do.
    fn note_pair(&mut self, index: usize, other: usize, time: Option<Seconds>) {
        let Some(time) = time else { return };
        // The lower number breaks ties, so that the order of balls decides nothing else.
        for (one, two) in [(index, other), (other, index)] {
            let pair = &mut self.pairs[one];
            if time < pair.0 || time == pair.0 && two < pair.1 {
                *pair = (time, two);
                self.next[one] = self.next[one].min(time);
            }
        }
    }

    /// Position and velocity of a ball's centre [m, m/s].
    #[inline]
    fn way_at(&self, index: usize, at: Seconds) -> (DVec3, DVec3) {
        let path = &self.paths[index];
        if path.swings {
            return self.swing_at(index, at);
        }
        (path.position_at(at), path.velocity_at(at))
    }

    #[cold]
    fn swing_at(&self, index: usize, at: Seconds) -> (DVec3, DVec3) {
        let segment = &self.bodies[index].segment;
        (segment.position_at(at), segment.velocity_at(at))
    }

    /// Centre of a ball [m].
    #[inline]
    pub(super) fn centre_at(&self, index: usize, at: Seconds) -> DVec3 {
        self.way_at(index, at).0
    }
}
