//! The paper's method: fixed steps, contacts found near the paths of a step (chapter 2).
//!
//! Time is cut into steps of h; grid time n is n·h, computed as `n · step_ms / 1000`, so that it is
//! the double nearest to the decimal number and meets the ticks of the logical clock. A step is:
//! commands, smooth forces and what carries the balls ([`smooth`]), contacts along the straight
//! paths of the step ([`sweep`]), and what holds at its end ([`finish`]). A step in which something
//! happens may be cut into parts ([`sub_steps`]). Under `profile = "2009"`
//! the middle part is the paper's own ([`paper_step`]).
//!
//! A step is computed when time beyond its start is asked for; facts carry the exact time of the
//! contact within the step and wait until that time is reached. A command acts at the first grid
//! time not before its own that has not been computed yet; what it causes is told when time goes
//! on. Hence where `advance` is cut changes no bit. While everything is at rest to the last bit and
//! no tip comes near, steps are skipped; computing them would change nothing.

mod body;
mod commands;
mod contacts;
mod cue_motion;
mod finish;
mod ground;
pub(super) mod narrow;
mod paper_step;
mod smooth;
pub mod spatial_hash;
mod sub_steps;
mod sweep;
mod tell;

pub(crate) use body::{Knot, between};

use super::{
    Integrator, Ledger, Lie, Memory, Order, Parameters, PhysicsError, PhysicsSettings, Profile,
    Solver, Work, checks, tolerance,
};
use crate::ball::{Ball, BallPlace, BallState};
use crate::cue::CuePose;
use crate::events::{Command, Fact, FactSet};
use crate::hash::StateHash;
use crate::ids::BallId;
use crate::table::Table;
use crate::units::Seconds;
use body::Body;
use cue_motion::CueMotion;
use glam::DVec3;
use ground::Ground;
use spatial_hash::{Bounds, Seen, SpatialHash};
use std::collections::VecDeque;
use std::sync::Arc;

/// Size of a cell [m] (paper, section 2.1): a compromise between few candidates and few cells.
pub const CELL_M: f64 = 0.1;

/// The stepper.
#[derive(Debug, Clone)]
pub struct FixedStep {
    ground: Arc<Ground>,
    parameters: Parameters,
    settings: PhysicsSettings,
    /// Length of a step, or of the part in hand [s].
    h: Seconds,
    /// When the step, or the part in hand, began [s].
    begun: Seconds,
    /// All balls, in ascending order of id.
    bodies: Vec<Body>,
    cue: Option<CueMotion>,
    /// Steps so far: the state is that of grid time `step`.
    step: u64,
    commands: VecDeque<Due>,
    /// Where the balls lay before the last shots.
    memory: Memory,
    /// Facts that were computed but lie beyond the time asked for.
    pending: VecDeque<Fact>,
    /// Facts of the step in hand.
    told: Vec<Fact>,
    /// A ball that slid begins to roll, or comes to rest, in the step in hand.
    changes: bool,
    /// Pairs that touched and have not parted, in ascending order.
    touching: Vec<(usize, usize)>,
    /// Something moved since everything last settled.
    moved: bool,
    /// The step since which everything is at rest.
    rest_since: Option<u64>,
    settle_steps: u64,
    skips: bool,
    rejects: bool,
    ledger: Ledger,
    work: Work,
    tracks: Option<Vec<Vec<Knot>>>,
    scratch: Scratch,
    /// Size of a cell [m].
    cell_m: f64,
}

/// What is to be done and the step at whose start it acts.
#[derive(Debug, Clone)]
struct Due {
    step: u64,
    order: Order,
}

/// Memory that is used again in each step; holds nothing between steps.
#[derive(Debug, Clone)]
struct Scratch {
    balls: SpatialHash,
    seen_balls: Seen,
    seen_faces: Seen,
    faces: Vec<u32>,
    near: Vec<usize>,
    queue: Vec<sweep::Contact>,
    awake: Vec<usize>,
}

impl Scratch {
    fn new(cell_m: f64, balls: usize) -> Self {
        Scratch {
            balls: SpatialHash::new(cell_m, 4 * balls),
            seen_balls: Seen::default(),
            seen_faces: Seen::default(),
            faces: Vec::new(),
            near: Vec::new(),
            queue: Vec::new(),
            awake: Vec::new(),
        }
    }
}

impl FixedStep {
    /// A world of balls on a table, with cells of `cell_m`; any size finds the same contacts.
    pub fn new(
        table: &Table,
        balls: Vec<(Ball, BallState)>,
        settings: &PhysicsSettings,
        parameters: Parameters,
        cell_m: f64,
    ) -> Result<Self, PhysicsError> {
        checks::check_setting(
            "step_ms",
            settings.step_ms,
            1e-6,
            50.0,
            "must lie between 1e-6 and 50",
        )?;
        sub_steps::check(settings)?;
        checks::check_setting("cell_m", cell_m, 1e-9, 1e9, "must be a positive length")?;
        parameters.check()?;
        let ground = Arc::new(Ground::new(table, cell_m));
        Self::on(ground, cell_m, balls, settings.clone(), parameters)
    }

    /// Other balls at their start on the same table, which is prepared only once.
    ///
    /// # Errors
    /// [`PhysicsError`] if a value is impossible or two balls overlap.
    pub fn with_balls(&self, balls: Vec<(Ball, BallState)>) -> Result<Self, PhysicsError> {
        let (settings, parameters) = (self.settings.clone(), self.parameters.clone());
        let world = Self::on(self.ground.clone(), self.cell_m, balls, settings, parameters)?;
        Ok(FixedStep { skips: self.skips, rejects: self.rejects, ..world })
    }

    fn on(
        ground: Arc<Ground>,
        cell_m: f64,
        balls: Vec<(Ball, BallState)>,
        settings: PhysicsSettings,
        parameters: Parameters,
    ) -> Result<Self, PhysicsError> {
        let bodies: Vec<Body> = checks::checked(balls)?
            .into_iter()
            .map(|(ball, state)| Body::new(ball, &state))
            .collect();
        let count = bodies.len();
        let h = settings.step_ms / 1000.0;
        let mut world = FixedStep {
            ground,
            parameters,
            settings,
            h,
            begun: 0.0,
            bodies,
            cue: None,
            step: 0,
            commands: VecDeque::new(),
            memory: Memory::default(),
            pending: VecDeque::new(),
            told: Vec::new(),
            changes: false,
            touching: Vec::new(),
            moved: false,
            rest_since: None,
            settle_steps: (tolerance::SETTLE_S / h).ceil() as u64,
            skips: true,
            rejects: true,
            ledger: Ledger::default(),
            work: Work::default(),
            tracks: None,
            scratch: Scratch::new(cell_m, count),
            cell_m,
        };
        for index in 0..count {
            world.find_supports(index);
            world.clear_touched_rails(index);
            world.bodies[index].name_motion();
        }
        world.ledger.start_j = world.kinetic_j() + world.potential_j();
        world.ledger.momentum.start = world.momentum();
        Ok(world)
    }

    /// Computes every step, even where nothing can happen; for tests that skipping changes nothing.
    pub fn without_skipping(mut self) -> Self {
        self.skips = false;
        self
    }

    /// Tests every ball against every face and every other ball; for tests of what cells and boxes
    /// save, and that they leave out nothing that matters.
    pub fn without_broad_phase(mut self) -> Self {
        self.rejects = false;
        self
    }

    /// Length of a step [s].
    pub fn step_s(&self) -> Seconds {
        self.h
    }

    /// Radius of a ball [m]; none if nobody knows it.
    pub fn radius_m(&self, ball: BallId) -> Option<f64> {
        Some(self.bodies[self.index(ball)?].ball.radius_m)
    }

    /// Keeps where the balls go from now on; see [`FixedStep::take_tracks`].
    pub(crate) fn keep_tracks(&mut self) {
        let time_s = self.grid(self.step);
        let start = |body: &Body| vec![body.knot(time_s, body.position)];
        self.tracks = Some(self.bodies.iter().map(start).collect());
    }

    /// Where each ball went since [`FixedStep::keep_tracks`], in the order of the balls.
    pub(crate) fn take_tracks(&mut self) -> Vec<Vec<Knot>> {
        let time_s = self.grid(self.step);
        let mut tracks = self.tracks.take().unwrap_or_default();
        for (track, body) in tracks.iter_mut().zip(&self.bodies) {
            track.push(body.knot(time_s, body.position));
        }
        tracks
    }

    fn track(&mut self) {
        let Some(tracks) = &mut self.tracks else { return };
        for (track, body) in tracks.iter_mut().zip(&self.bodies) {
            if !(body.asleep && body.knots.len() < 2) {
                track.extend_from_slice(&body.knots);
            }
        }
    }

    /// Grid time `step` [s].
    fn grid(&self, step: u64) -> Seconds {
        step as f64 * self.settings.step_ms / 1000.0
    }

    /// The first step whose grid time is not before `at`.
    fn step_at(&self, at: Seconds) -> u64 {
        let guess = (at / self.h).max(0.0) as u64;
        // The quotient may be off by one; a time that no run reaches has no step after it.
        let near = guess.saturating_sub(1)..=guess.saturating_add(2);
        near.into_iter().find(|step| self.grid(*step) >= at).unwrap_or(u64::MAX)
    }

    /// One step, or as many as can be skipped before `limit`.
    fn go_on(&mut self, limit: Seconds) -> Result<(), PhysicsError> {
        self.carry_out_commands();
        if self.skips && self.bodies.iter().all(|body| !body.active()) {
            let reach = self.still_until();
            let next = self.commands.front().map_or(u64::MAX, |due| due.step);
            let settles = self.rest_since.map_or(u64::MAX, |since| since + self.settle_steps);
            let settles = if self.moved { settles } else { u64::MAX };
            let target = self.step_at(limit).min(next).min(settles).min(reach);
            if target > self.step {
                for body in &mut self.bodies {
                    body.knots.clear();
                }
                self.step = target;
                let end = self.grid(target);
                if let Some(cue) = &mut self.cue {
                    cue.end_step(&self.bodies, end);
                }
                self.watch_rest();
                self.hand_over();
                return Ok(());
            }
        }
        self.one_step()?;
        self.hand_over();
        Ok(())
    }

    /// The step up to which no tip comes near a ball that is at rest; the present one if it does
    /// now, `u64::MAX` if never.
    fn still_until(&self) -> u64 {
        let Some(cue) = self.cue.as_ref().filter(|cue| cue.guided.is_solid()) else {
            return u64::MAX;
        };
        let start = self.grid(self.step);
        if cue.stands_from().is_some_and(|end| end <= start) {
            return u64::MAX;
        }
        let mut ahead = cue.clone();
        ahead.prepare(start, 0.0, self.h);
        let way = ahead.step_bounds();
        let near = |body: &Body| {
            let reach = body.ball.radius_m + tolerance::CLUSTER_M;
            Bounds::swept(body.position, body.position, reach).overlap(&way)
        };
        let meets = self.bodies.iter().any(|body| body.solid() && near(body));
        if meets { self.step } else { self.step + 1 }
    }

    /// The whole step.
    fn one_step(&mut self) -> Result<(), PhysicsError> {
        let (start, end) = (self.grid(self.step), self.grid(self.step + 1));
        if self.settings.sub_steps > 1 {
            self.try_step(start, end)?;
        } else {
            self.part(start, end)?;
        }
        self.step += 1;
        self.watch_rest();
        self.track();
        Ok(())
    }

    /// A step, or one part of it.
    fn part(&mut self, start: Seconds, end: Seconds) -> Result<(), PhysicsError> {
        self.work.steps += 1;
        self.begin(start);

        // Forces, and what carries the balls.
        self.smooth();

        // Contacts.
        match self.settings.profile {
            Profile::Standard => self.sweep(start)?,
            Profile::Paper2009 => self.paper_contacts(start),
        }

        // Where everything is now, and what that means.
        self.finish(start, end)
    }

    /// Remembers where each ball's path begins.
    fn begin(&mut self, start: Seconds) {
        self.begun = start;
        self.changes = false;
        for body in &mut self.bodies {
            body.knots.clear();
            if body.in_play() {
                let knot = body.knot(start, body.position);
                body.knots.push(knot);
            }
            body.path = body::Path { position: body.position, ..Default::default() };
            body.kick = DVec3::ZERO;
        }
        if let Some(cue) = &mut self.cue {
            cue.prepare(start, 0.0, self.h);
        }
    }

    /// Puts the step's facts in order of time and hands them over.
    fn hand_over(&mut self) {
        self.told.sort_by(|a, b| a.time_s.total_cmp(&b.time_s));
        self.pending.extend(self.told.drain(..));
    }

    fn index(&self, ball: BallId) -> Option<usize> {
        self.bodies.binary_search_by_key(&ball, |body| body.ball.id).ok()
    }

    fn kinetic_j(&self) -> f64 {
        self.bodies.iter().filter(|body| body.in_play()).map(|body| body.mover().kinetic_j()).sum()
    }

    fn potential_j(&self) -> f64 {
        let g = self.parameters.gravity_m_s2;
        self.bodies.iter().filter(|body| body.in_play()).map(|body| weight_j(body, g)).sum()
    }

    fn momentum(&self) -> DVec3 {
        self.bodies
            .iter()
            .filter(|body| body.in_play() && body.ball.flags.integrate)
            .map(|body| body.velocity * body.ball.mass_kg)
            .sum()
    }
}

impl Solver for FixedStep {
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
            while let Some(fact) = self.pending.front().copied() {
                if fact.time_s > limit {
                    break;
                }
                self.pending.pop_front();
                facts.push(fact);
                if stop.contains(fact.kind.topic()) {
                    return Ok(fact.time_s);
                }
            }
            if self.grid(self.step) >= limit {
                return Ok(limit);
            }
            self.go_on(limit)?;
        }
    }

    fn sample(&self, ball: BallId, at: Seconds) -> Option<BallState> {
        Some(self.bodies[self.index(ball)?].sample(at, self.grid(self.step)))
    }

    fn cue(&self, at: Seconds) -> Option<CuePose> {
        self.cue.as_ref().map(|cue| cue.guided.pose(at))
    }

    fn balls(&self) -> Vec<BallId> {
        self.bodies.iter().map(|body| body.ball.id).collect()
    }

    fn is_still(&self) -> bool {
        self.bodies.iter().all(|body| !body.active())
            && self.still_until() == u64::MAX
            && !self.moved
            && self.commands.is_empty()
            && self.pending.is_empty()
    }

    fn work(&self) -> Work {
        self.work
    }

    fn ledger(&self) -> Ledger {
        self.ledger.closed(self.kinetic_j(), self.potential_j(), self.momentum())
    }

    fn hash(&self, hash: &mut StateHash) {
        hash.u64(self.step);
        for body in &self.bodies {
            hash.u64(u64::from(body.ball.id.0));
            hash.u64(body.place as u64);
            hash.u64(u64::from(body.clear_rails) << 8 | u64::from(body.held_rails));
            hash.vec3(body.position);
            hash.vec3(body.velocity);
            hash.vec3(body.angular_velocity);
            hash.quat(body.orientation);
            if self.settings.integrator == Integrator::PositionVerlet {
                hash.vec3(body.way.unwrap_or(DVec3::INFINITY));
                hash.vec3(body.pushed);
            }
        }
        if let Some(cue) = &self.cue {
            cue.guided.hash(hash);
        }
        for (a, b) in &self.touching {
            hash.u64((*a as u64) << 32 | *b as u64);
        }
        hash.u64(u64::from(self.moved));
        hash.u64(self.rest_since.map_or(u64::MAX, |step| step));
        hash.u64(self.commands.len() as u64);
        hash.u64(self.pending.len() as u64);
        self.pending.iter().for_each(|fact| hash.f64(fact.time_s));
        self.memory.hash(hash);
    }
}

/// Weight times height [J]; zero for a ball without weight.
fn weight_j(body: &Body, gravity_m_s2: f64) -> f64 {
    let weighs = body.ball.flags.gravity && body.ball.flags.integrate;
    if weighs { body.ball.mass_kg * gravity_m_s2 * body.position.z } else { 0.0 }
}

/// Takes a ball out of play, where it is.
fn collect(body: &mut Body, place: BallPlace, time_s: Seconds) {
    body.placed = (body.place, time_s);
    body.place = place;
    body.velocity = DVec3::ZERO;
    body.angular_velocity = DVec3::ZERO;
    body.motion = crate::ball::Motion::Rest;
    body.supports.clear();
}
