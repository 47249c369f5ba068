//! Somebody who looks over a person's shoulder and says what a computer would play.
//!
//! Nothing of it is part of the game: it hears what everybody hears, and whoever shows the answer
//! may forget it.

use super::insight::insight_of_thoughts;
use super::mind::{Decision, Mind, MindSetup, Task, TaskKind, Thoughts, Workers};
use crate::cue::Aim;
use crate::events::{Insight, ShotKind, Topic, Topics, Turn};
use crate::ids::GameKind;
use crate::physics::Snapshot;
use crate::rules::{self, Referee};
use crate::tick::{Delivered, Participant};
use std::sync::{Arc, OnceLock};

/// The adviser of a game.
#[derive(Debug, Clone)]
pub struct Adviser {
    /// What its mind is made of; made when somebody asks.
    setup: Arc<MindSetup>,
    mind: Arc<OnceLock<Mind>>,
    /// Hears what the referee of the game hears, and so knows what that knows.
    referee: Referee,
}

/// What it was asked; the answer is computed wherever there is time.
#[derive(Debug, Clone)]
pub struct Question {
    setup: Arc<MindSetup>,
    mind: Arc<OnceLock<Mind>>,
    task: Task,
}

/// What it would play.
#[derive(Debug, Clone, PartialEq)]
pub struct Advice {
    /// What it considered.
    pub insight: Insight,
    /// How the cue is held.
    pub aim: Aim,
    /// Speed of the tip at the contact [m/s].
    pub speed_m_s: f64,
    /// The chance that it does what it is meant to, for the arm that the mind reckons with.
    pub chance: f64,
}

impl Adviser {
    /// Somebody with such a mind. `referee` is that of the game, before the game.
    pub fn new(setup: MindSetup, referee: Referee) -> Self {
        Adviser { setup: Arc::new(setup), mind: Arc::default(), referee }
    }

    /// What it must hear.
    pub fn topics(&self) -> Topics {
        rules::topics(self.referee.game()).or(Topics::of(&[Topic::Command, Topic::Turn]))
    }

    /// The game begins with this table.
    pub fn start(&mut self, table: &Snapshot) {
        let _ = self.referee.start(table);
    }

    /// Hears what happened.
    pub fn hear(&mut self, delivered: &Delivered) {
        let _ = self.referee.collect(delivered);
    }

    /// What it would play in this turn, on this table.
    pub fn ask(&self, mut turn: Arc<Turn>, table: &Snapshot) -> Question {
        if nobody_counts(self.setup.game) {
            // Nothing need be broken where nobody counts.
            Arc::make_mut(&mut turn).shot = ShotKind::Normal;
        }
        let task = Task {
            kind: TaskKind::Shoot,
            lies: table.balls.clone(),
            referee: self.referee.clone(),
            seed: u64::from(turn.shot_number),
            turn,
            played_from: None,
            has_asked: false,
        };
        Question { setup: self.setup.clone(), mind: self.mind.clone(), task }
    }
}

/// Whether it is a game that nobody can win.
fn nobody_counts(game: GameKind) -> bool {
    matches!(game, GameKind::FreePlay | GameKind::Training)
}

/// Where nobody counts every shot is worth the same; whoever asks wants to pocket a ball.
fn choose_pot(thoughts: &mut Thoughts) {
    let pots = thoughts.candidates.iter().enumerate();
    let pots = pots.filter(|(_, candidate)| candidate.idea.pocket.is_some());
    let best = pots.max_by(|(_, a), (_, b)| a.success.total_cmp(&b.success)).map(|(at, _)| at);
    if let Some(best) = best {
        let all = thoughts.candidates.iter_mut().enumerate();
        all.for_each(|(at, candidate)| candidate.chosen = at == best);
    }
}

impl Question {
    /// Thinks. None if nothing can be played.
    pub fn answer(&self, workers: &dyn Workers) -> Option<Advice> {
        let mind = self.mind.get_or_init(|| Mind::new((*self.setup).clone()));
        let deliberation = mind.deliberate(&self.task, workers);
        let Decision::Shoot(_) = deliberation.decision else { return None };
        let mut thoughts = deliberation.thoughts;
        if nobody_counts(self.setup.game) {
            choose_pot(&mut thoughts);
        }
        let planned = thoughts.candidates.iter().find(|candidate| candidate.chosen)?.clone();
        let turn = &self.task.turn;
        let cue_ball = self.task.lies.iter().find(|ball| ball.id == turn.cue_ball)?;
        let cue_ball = cue_ball.position.truncate();
        Some(Advice {
            insight: insight_of_thoughts(turn.player, cue_ball, &thoughts, &[]),
            aim: planned.aim,
            speed_m_s: planned.speed_m_s,
            chance: planned.success,
        })
    }
}
