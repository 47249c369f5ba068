//! When what happens: the end of a segment, the terrain, other balls.
//!
//! Each ball knows its own next event and its earliest partner. The horizon of a pair is the
//! earlier of both own events: beyond it their paths are not known. After an event only balls whose
//! segment changed are predicted again, and those whose earliest partner was one of them.

use super::body::{Own, Report};
use super::closing::{self, Relative};
use super::segment::Course;
use super::sweep;
use super::{EventDriven, Segment};
use crate::physics::tolerance;
use crate::units::Seconds;
use glam::DVec3;
use smallvec::SmallVec;

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
            self.bodies[*index].pair = (f64::INFINITY, 0);
        }
        // Whoever waited for one of them looks for somebody else.
        let mut stale: Changed = SmallVec::new();
        for (index, body) in self.bodies.iter_mut().enumerate() {
            if body.pair.0.is_finite() && changed.contains(&body.pair.1) {
                body.pair = (f64::INFINITY, 0);
                stale.push(index);
            }
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
        for index in 0..self.bodies.len() {
            self.next[index] = self.bodies[index].next_s();
        }
    }

    fn predict_own(&mut self, at: Seconds, index: usize) {
        let terrain = self.terrain.clone();
        let body = &mut self.bodies[index];
        body.report = (f64::INFINITY, Report::HeadString);
        if !body.in_play() {
            body.own = Own::Ends(f64::INFINITY);
            return;
        }
        let segment = body.segment;
        // A lasting ball's piece ends with the step of all of them.
        let end_s = if segment.course == Course::Lasting { f64::INFINITY } else { segment.end_s };
        body.own = Own::Ends(end_s);
        if body.ball.flags.collide && !body.stands() {
            let until = segment.end_s.min(at + 1e4);
            let met = sweep::first_meeting(
                &terrain,
                &segment,
                body.ball.radius_m,
                at,
                until,
                &body.held,
                &mut self.work,
            );
            if let Some(meeting) = met {
                body.own = Own::Meets(meeting);
            }
        }
        if let Some(head) = terrain.head_string_x() {
            let body = &mut self.bodies[index];
            body.behind |= body.segment.position_at(at).x < head - tolerance::PUSH_OUT_M;
        }
        self.bodies[index].report = self.next_report(at, index);
    }

    /// The next thing that is only told: the head string, or sinking below the bed.
    pub(super) fn next_report(&self, after: Seconds, index: usize) -> (Seconds, Report) {
        let body = &self.bodies[index];
        let none = (f64::INFINITY, Report::HeadString);
        let Some(head) = self.terrain.head_string_x() else { return none };
        if body.stands() {
            return none;
        }
        let segment = &body.segment;
        let horizon = segment.end_s.min(body.own_s()) - after;
        let (x, v) = (segment.position_at(after), segment.velocity_at(after));
        let a = segment.acceleration;
        let mut best = none;
        // x − head rises through zero: its negative falls.
        if body.behind
            && let Some(time) =
                closing::falling_quadratic((head - x.x).max(0.0), -v.x, -a.x, horizon)
        {
            best = (after + time, Report::HeadString);
        }
        let radius = body.ball.radius_m;
        let sinks = !self.terrain.pockets.is_empty()
            && matches!(segment.course, Course::Flying | Course::Lasting);
        if sinks
            && x.z > -radius + tolerance::PUSH_OUT_M
            && let Some(time) = closing::falling_quadratic(x.z + radius, v.z, a.z, horizon)
            && after + time < best.0
        {
            best = (after + time, Report::Depth);
        }
        best
    }

    fn predict_pairs(&mut self, at: Seconds, index: usize, wanted: impl Fn(usize) -> bool) {
        if !self.bodies[index].solid() {
            return;
        }
        let own: Segment = self.bodies[index].segment;
        let stands = self.bodies[index].stands();
        let (position, velocity) = (own.position_at(at), own.velocity_at(at));
        let radius = self.bodies[index].ball.radius_m;
        let own_s = self.bodies[index].own_s().min(own.end_s);
        let moves = self.bodies[index].ball.flags.integrate;
        for other in 0..self.bodies.len() {
            let body = &self.bodies[other];
            if other == index || !body.solid() || !wanted(other) || stands && body.stands() {
                continue;
            }
            let known = self.bodies[index].pair.0.max(body.pair.0);
            let horizon = own_s.min(body.own_s()).min(body.segment.end_s).min(known) - at;
            let start = position - body.segment.position_at(at);
            let distance = radius + body.ball.radius_m;
            // A rough look at what both can reach spares most of the work while they hop.
            let reach = self.bodies[index].reach_m(at, horizon) + body.reach_m(at, horizon);
            let far = (distance + reach) * (1.0 + 1e-9);
            if start.length_squared() > far * far {
                continue;
            }
            let lasts = own.course == Course::Lasting && body.segment.course == Course::Lasting;
            let motion = Relative {
                offset: start,
                velocity: velocity - body.segment.velocity_at(at),
                acceleration: own.acceleration - body.segment.acceleration,
            };
            if motion.velocity == DVec3::ZERO && motion.acceleration == DVec3::ZERO
                || !moves && !body.ball.flags.integrate
                || lasts && start.length() - distance <= super::lasting::TOUCH_M
            {
                continue;
            }
            self.work.pair_tests += 1;
            let Some(time) = closing::spheres(&motion, distance, horizon) else { continue };
            let time = at + time;
            // The lower number breaks ties, so that the order of balls decides nothing else.
            for (one, two) in [(index, other), (other, index)] {
                let pair = &mut self.bodies[one].pair;
                if time < pair.0 || time == pair.0 && two < pair.1 {
                    *pair = (time, two);
                }
            }
        }
    }
}
