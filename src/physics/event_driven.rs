//! The exact solver: every free motion in closed form, every contact a root of a polynomial.
//!
//! A ball follows a [`Segment`] until something happens to it: its law ends by itself, it meets the
//! terrain, another ball or the tip, or a command touches it. The first of all these is taken, its
//! contact law acts, and only the balls that it changed are predicted again. Nothing tunnels, a
//! ball at rest does not move, and cost goes with events and not with time. What has no closed form
//! (rims, slopes with friction, several supports, springs) is produced in short pieces by
//! [`lasting`], for the balls concerned alone.
//!
//! Facts carry the exact time. A command acts at its own time, after what happens at that moment.
//! Where `advance` is cut changes no bit, because nothing is computed for the sake of a cut.

mod body;
pub mod closing;
mod cluster;
mod commands;
mod contacts;
mod course;
mod lasting;
mod motion;
mod path;
mod pivot;
mod predict;
#[cfg(test)]
mod resegment;
mod segment;
#[cfg(test)]
mod shortcuts;
mod sweep;
mod swing;
mod swing_meets;
mod tell;
mod terrain;
mod tip;

pub use segment::{Course, Segment};

use super::{
    Ledger, Lie, Memory, Order, Parameters, PhysicsError, Solver, Work, checks, tolerance,
};
use crate::ball::{Ball, BallState};
use crate::cue::CuePose;
use crate::events::{Command, Fact, FactSet};
use crate::hash::StateHash;
use crate::ids::BallId;
use crate::table::Table;
use crate::units::Seconds;
use body::{Body, Own};
use path::Path;
use std::collections::VecDeque;
use std::sync::Arc;
use terrain::Terrain;
use tip::Tip;

/// Events of one ball per second of simulated time beyond which something is stuck; a ball in the
/// tightest of wedges makes a tenth of it.
const EVENTS_PER_SECOND_MAX: u64 = 200_000;

/// The solver.
#[derive(Debug, Clone)]
pub struct EventDriven {
    terrain: Arc<Terrain>,
    parameters: Parameters,
    /// All balls, in ascending order of id.
    bodies: Vec<Body>,
    /// For each ball its way, as detection sees it.
    paths: Vec<Path>,
    /// For each ball when it meets another first [s], and which.
    pairs: Vec<(Seconds, usize)>,
    /// For each ball the time of the first thing that happens to it [s].
    next: Vec<Seconds>,
    tip: Option<Tip>,
    /// The time reached [s].
    now: Seconds,
    /// The last event [s].
    done: Seconds,
    commands: VecDeque<(Seconds, Order)>,
    /// Where the balls lay before the last shots.
    memory: Memory,
    /// Facts that were computed but not handed over yet.
    told: Vec<Fact>,
    /// Pairs that touched, and when last [s], in ascending order.
    touching: Vec<(usize, usize, Seconds)>,
    /// Next step of the balls in lasting contact [s].
    lasting_at: Seconds,
    /// Balls that begin a lasting contact in the present event.
    begins: predict::Changed,
    /// Something moved since everything last settled.
    moved: bool,
    /// Since when everything is at rest [s].
    rest_since: Option<Seconds>,
    ledger: Ledger,
    work: Work,
    /// Events in the present second, and when it began.
    counted: (u64, Seconds),
    tracks: Option<Vec<Vec<Segment>>>,
}

/// What happens next.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Next {
    Ball(usize),
    Tip,
    Lasting,
    Command,
    Settle,
    Nothing,
}

impl EventDriven {
    /// A world of balls on a table.
    ///
    /// # Errors
    /// [`PhysicsError`] if a value is impossible or two balls overlap.
    pub fn new(
        table: &Table,
        balls: Vec<(Ball, BallState)>,
        parameters: Parameters,
    ) -> Result<Self, PhysicsError> {
        parameters.check()?;
        let balls = checks::checked(balls)?;
        let terrain = Arc::new(Terrain::new(table, largest(&balls)));
        Ok(Self::on(terrain, balls, parameters))
    }

    /// Other balls at their start on the same table, which is prepared only once.
    ///
    /// # Errors
    /// [`PhysicsError`] if a value is impossible or two balls overlap.
    pub fn with_balls(&self, balls: Vec<(Ball, BallState)>) -> Result<Self, PhysicsError> {
        let balls = checks::checked(balls)?;
        let radius_m = largest(&balls);
        let terrain = if radius_m == self.terrain.radius_m() {
            self.terrain.clone()
        } else {
            Arc::new(self.terrain.for_balls_of(radius_m))
        };
        Ok(Self::on(terrain, balls, self.parameters.clone()))
    }

    fn on(terrain: Arc<Terrain>, balls: Vec<(Ball, BallState)>, parameters: Parameters) -> Self {
        let bodies: Vec<Body> =
            balls.into_iter().map(|(ball, state)| Body::new(ball, &state)).collect();
        let count = bodies.len();
        let mut world = EventDriven {
            terrain,
            parameters,
            paths: bodies.iter().map(Path::of).collect(),
            pairs: vec![(f64::INFINITY, 0); count],
            bodies,
            next: vec![f64::INFINITY; count],
            tip: None,
            now: 0.0,
            done: 0.0,
            commands: VecDeque::new(),
            memory: Memory::default(),
            told: Vec::new(),
            touching: Vec::new(),
            lasting_at: f64::INFINITY,
            begins: predict::Changed::new(),
            moved: false,
            rest_since: None,
            ledger: Ledger::default(),
            work: Work::default(),
            counted: (0, 0.0),
            tracks: None,
        };
        for index in 0..count {
            world.lay_down(index);
        }
        // What laying down took off is before the start.
        world.ledger = Ledger::default();
        world.ledger.start_j = world.bodies.iter().map(|body| world.energy_of(body, 0.0)).sum();
        world.ledger.momentum.start = world.momentum(0.0);
        for index in 0..count {
            world.clear_touched_rails(index);
        }
        world.predict_all();
        world.watch_rest();
        world
    }

    /// Radius of a ball [m]; none if nobody knows it.
    pub fn radius_m(&self, ball: BallId) -> Option<f64> {
        Some(self.bodies[self.index(ball)?].ball.radius_m)
    }

    /// Keeps where the balls go from now on; see [`EventDriven::take_tracks`].
    pub(crate) fn keep_tracks(&mut self) {
        self.tracks = Some(self.bodies.iter().map(|body| vec![body.segment]).collect());
    }

    /// Where each ball went since [`EventDriven::keep_tracks`], in the order of the balls.
    pub(crate) fn take_tracks(&mut self) -> Vec<Vec<Segment>> {
        self.tracks.take().unwrap_or_default()
    }

    fn index(&self, ball: BallId) -> Option<usize> {
        self.bodies.binary_search_by_key(&ball, |body| body.ball.id).ok()
    }

    /// Hands over what was told, up to a fact in `stop`; returns the time of that.
    fn hand_over(&mut self, stop: FactSet, facts: &mut Vec<Fact>) -> Option<Seconds> {
        if self.told.is_empty() {
            return None;
        }
        let last = self.told.iter().position(|fact| stop.contains(fact.kind.topic()));
        let count = last.map_or(self.told.len(), |last| last + 1);
        facts.extend(self.told.drain(..count));
        last.and_then(|_| facts.last()).map(|fact| fact.time_s)
    }

    /// The first thing that happens, and when. Ties go in the order in which they are listed here.
    fn next_event(&self) -> (Seconds, Next) {
        let mut best = (f64::INFINITY, Next::Nothing);
        for (index, time) in self.next.iter().enumerate() {
            if *time < best.0 {
                best = (*time, Next::Ball(index));
            }
        }
        let tip = self.tip.as_ref().map_or(f64::INFINITY, Tip::next_s);
        let settles = self.rest_since.map_or(f64::INFINITY, |since| since + tolerance::SETTLE_S);
        let command = self.commands.front().map_or(f64::INFINITY, |(at, _)| *at);
        for (time, next) in [
            (tip, Next::Tip),
            (self.lasting_at, Next::Lasting),
            (settles, Next::Settle),
            (command, Next::Command),
        ] {
            if time < best.0 {
                best = (time, next);
            }
        }
        best
    }

    /// Lets one thing happen.
    fn happen(&mut self, at: Seconds, next: Next) -> Result<(), PhysicsError> {
        self.done = self.done.max(at);
        let at = self.done;
        self.count(at)?;
        match next {
            Next::Ball(index) => self.ball_event(at, index)?,
            Next::Tip => self.tip_event(at)?,
            Next::Lasting => self.step_lasting(at)?,
            Next::Command => match self.commands.pop_front() {
                Some((_, Order::Command(command))) => self.carry_out(at, &command)?,
                Some((_, Order::Lay(lies))) => self.lay_all(at, &lies),
                None => {}
            },
            Next::Settle => self.settle(at),
            Next::Nothing => {}
        }
        self.watch_rest();
        Ok(())
    }

    fn ball_event(&mut self, at: Seconds, index: usize) -> Result<(), PhysicsError> {
        let body = &self.bodies[index];
        let (own, pair, report) = (body.own_s(), self.pairs[index].0, body.report.0);
        if report <= own && report <= pair {
            self.report(at, index);
            return Ok(());
        }
        if pair < own {
            let other = self.pairs[index].1;
            return self.collide(at, index, other);
        }
        match body.own {
            Own::Meets(meeting) if meeting.leaves => self.leave(at, index, meeting.feature),
            Own::Meets(meeting) => self.meet(at, index, &meeting),
            Own::Ends(_) => self.follow(at, index),
        }
    }

    /// Counts an event; too many of them in too little time are an error, never a hang.
    fn count(&mut self, at: Seconds) -> Result<(), PhysicsError> {
        self.work.events += 1;
        if at - self.counted.1 >= 1.0 {
            self.counted = (0, at);
        }
        self.counted.0 += 1;
        if self.counted.0 > EVENTS_PER_SECOND_MAX * (1 + self.bodies.len() as u64 / 8) {
            let busiest = self.bodies.iter().max_by_key(|body| body.busy.1);
            return Err(PhysicsError::TooManyEvents {
                time_s: at,
                events: self.counted.0,
                ball: busiest.map_or(BallId::CUE, |body| body.ball.id),
                state: Box::new(self.snapshot(at)),
            });
        }
        Ok(())
    }

    fn snapshot(&self, at: Seconds) -> super::Snapshot {
        super::Snapshot {
            time_s: at,
            balls: self.bodies.iter().map(|body| body.sample(at)).collect(),
            cue: self.tip.as_ref().map(|tip| tip.cue.pose(at)),
        }
    }
}

/// Radius of the largest ball [m].
fn largest(balls: &[(Ball, BallState)]) -> f64 {
    balls.iter().map(|(ball, _)| ball.radius_m).fold(0.0, f64::max)
}

impl Solver for EventDriven {
    fn apply(&mut self, at: Seconds, command: &Command) -> Result<(), PhysicsError> {
        self.check_command(at, command)?;
        self.order(at, Order::Command(command.clone()));
        Ok(())
    }

    fn lay(&mut self, at: Seconds, lies: Arc<[Lie]>) {
        self.order(at, Order::Lay(lies));
    }

    fn remember(&mut self, shots: usize) {
        self.memory = Memory::of(shots);
    }

    fn advance(
        &mut self,
        limit: Seconds,
        stop: FactSet,
        facts: &mut Vec<Fact>,
    ) -> Result<Seconds, PhysicsError> {
        if !limit.is_finite() {
            return Err(PhysicsError::Command { time_s: limit, term: "time limit" });
        }
        loop {
            if let Some(time) = self.hand_over(stop, facts) {
                self.now = self.now.max(time);
                return Ok(time);
            }
            let (at, next) = self.next_event();
            if !(at <= limit) {
                self.now = self.now.max(limit);
                return Ok(limit);
            }
            self.happen(at, next)?;
        }
    }

    fn sample(&self, ball: BallId, at: Seconds) -> Option<BallState> {
        Some(self.bodies[self.index(ball)?].sample(at))
    }

    fn cue(&self, at: Seconds) -> Option<CuePose> {
        self.tip.as_ref().map(|tip| tip.cue.pose(at))
    }

    fn balls(&self) -> Vec<BallId> {
        self.bodies.iter().map(|body| body.ball.id).collect()
    }

    fn is_still(&self) -> bool {
        self.next.iter().all(|time| time.is_infinite())
            && !self.moved
            && self.told.is_empty()
            && self.commands.is_empty()
            && self.lasting_at.is_infinite()
            && self.tip.as_ref().is_none_or(|tip| tip.next_s().is_infinite())
            && self.bodies.iter().all(|body| body.is_still())
    }

    fn work(&self) -> Work {
        self.work
    }

    fn ledger(&self) -> Ledger {
        self.closed_ledger()
    }

    fn hash(&self, hash: &mut StateHash) {
        for (body, pair) in self.bodies.iter().zip(&self.pairs) {
            body.hash(pair.0, hash);
        }
        if let Some(tip) = &self.tip {
            tip.cue.hash(hash);
        }
        for (a, b, at) in &self.touching {
            hash.u64((*a as u64) << 32 | *b as u64);
            hash.f64(*at);
        }
        hash.f64(self.lasting_at);
        hash.u64(u64::from(self.moved));
        hash.f64(self.rest_since.unwrap_or(f64::INFINITY));
        hash.u64(self.commands.len() as u64);
        hash.u64(self.told.len() as u64);
        self.memory.hash(hash);
    }
}
