//! The searching player: geometry proposes, its own copy of the simulation decides under the
//! player's own noise, a value of the position stands for what comes after.

mod aim;

mod choosing;

mod decision;
pub use decision::{Considered, Decision, Deliberation, PlannedShot, Thoughts};

mod outcome;
pub use outcome::Outcome;

mod placing;

mod race;

mod search;

mod task;
pub use task::{Task, TaskKind};

mod trial;

mod value;

mod workers;
pub use workers::{Inline, Workers};

mod world;

use super::noise::StrokeNoise;
use super::settings::Level;
use super::stroke::TIP_SPEED_MAX_M_S;
use super::throw_table::ThrowTable;
use crate::ball::{Ball, BallState};
use crate::ids::GameKind;
use crate::physics::Simulation;
use crate::table::{Bed, Table};
use race::Races;
use std::sync::Arc;
use world::World;

/// Tip of a club player's break [m/s].
const CLUB_BREAK_M_S: f64 = 7.0;

/// What a mind is made of.
#[derive(Debug, Clone)]
pub struct MindSetup {
    /// A simulation of the table, with the game's laws and any balls: the player's own copy.
    pub simulation: Simulation,
    /// The balls of the game.
    pub balls: Vec<Ball>,
    /// The table.
    pub table: Arc<Table>,
    /// Its playing area.
    pub bed: Bed,
    /// Radius of every ball [m].
    pub ball_radius_m: f64,
    /// What is played.
    pub game: GameKind,
    /// How far it looks.
    pub level: Level,
    /// How its strokes err, and what it reckons with.
    pub noise: StrokeNoise,
    /// How the club's player allows for throw.
    pub throw: ThrowTable,
    /// Shots that it may simulate for a decision, to their end; the short runs to the first contact
    /// by which a pot is aimed are not counted.
    pub simulations: u32,
}

/// What a searching player knows besides the question that it is asked.
#[derive(Debug)]
pub struct Mind {
    setup: MindSetup,
    races: Races,
}

impl std::ops::Deref for Mind {
    type Target = MindSetup;

    fn deref(&self) -> &MindSetup {
        &self.setup
    }
}

impl Mind {
    /// A mind that has not thought yet.
    pub fn new(setup: MindSetup) -> Self {
        let races = Races::new(setup.game, setup.level, &setup.noise);
        Mind { setup, races }
    }

    /// Answers a question. The same question, mind and seed give the same answer, however many
    /// workers there are.
    pub fn deliberate(&self, task: &Task, workers: &dyn Workers) -> Deliberation {
        self.answer(task, workers).unwrap_or_else(|| Deliberation {
            decision: Decision::Nothing,
            thoughts: Thoughts::default(),
            simulations: 0,
        })
    }

    fn answer(&self, task: &Task, workers: &dyn Workers) -> Option<Deliberation> {
        let lies: Vec<_> = task.lies.iter().copied().map(world::at_rest).collect();
        let turn = task.turn.clone();
        let world = World::new(self, &lies, task.referee.clone(), turn).ok()?;
        match task.kind {
            TaskKind::Shoot => search::shoot(self, task, &world, workers),
            TaskKind::Place(zone) => placing::place(self, task, &world, zone, workers),
            TaskKind::Choose => choosing::choose(self, task, &world),
        }
    }

    /// How hard a rack is broken [m/s]. Harder is better: of the champion's breaks at 7 m/s half
    /// pocket a ball without a foul, at 10 m/s two in three.
    fn break_speed_m_s(&self) -> f64 {
        match self.level {
            Level::Paper | Level::Club => CLUB_BREAK_M_S,
            Level::Champion => TIP_SPEED_MAX_M_S,
        }
    }

    /// The balls of the game where they lie.
    fn balls_at(&self, lies: &[BallState]) -> Vec<(Ball, BallState)> {
        let ball = |state: &BallState| self.balls.iter().find(|ball| ball.id == state.id);
        lies.iter().filter_map(|state| Some((ball(state)?.clone(), *state))).collect()
    }
}

#[cfg(test)]
mod tests;
