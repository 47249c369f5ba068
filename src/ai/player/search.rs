//! What a searching player has besides the paper's: somebody who thinks, and ears for all that
//! tells how the game stands.

use super::Player;
use crate::ai::mind::{Decision, Deliberation, Mind, Task, TaskKind};
use crate::ai::thinker::{ThinkInline, Thinker, Thinking};
use crate::hash::StateHash;
use crate::ids::GameKind;
use crate::physics::Snapshot;
use crate::rules::Referee;
use crate::tick::{Delivered, Participant};
use rand::RngExt;
use std::sync::Arc;

/// The question of a turn, and who thinks about it.
pub(super) struct Search {
    mind: Arc<Mind>,
    thinker: Arc<dyn Thinker>,
    /// Hears what the referee of the game hears, and so knows what that knows.
    referee: Referee,
    asked: Option<Asked>,
}

/// A question that was asked in this turn.
struct Asked {
    task: Task,
    answer: Answer,
}

enum Answer {
    /// Nobody has begun to think, or who did was sent away.
    None,
    /// Somebody thinks.
    Coming(Box<dyn Thinking>),
    /// It was taken.
    Here(Arc<Deliberation>),
}

/// A clone asks its question anew, and gets the same answer.
impl Clone for Search {
    fn clone(&self) -> Self {
        let asked = self.asked.as_ref().map(|Asked { task, answer }| {
            let answer = match answer {
                Answer::Here(deliberation) => Answer::Here(deliberation.clone()),
                Answer::None | Answer::Coming(_) => Answer::None,
            };
            Asked { task: task.clone(), answer }
        });
        let Search { mind, thinker, referee, .. } = self;
        let (mind, thinker, referee) = (mind.clone(), thinker.clone(), referee.clone());
        Search { mind, thinker, referee, asked }
    }
}

impl Search {
    pub fn new(mind: Arc<Mind>, referee: Referee) -> Self {
        Search { mind, thinker: Arc::new(ThinkInline), referee, asked: None }
    }

    pub fn with_thinker(self, thinker: Arc<dyn Thinker>) -> Self {
        Search { thinker, ..self }
    }

    pub fn game(&self) -> GameKind {
        self.referee.game()
    }

    /// Begins the game; what the referee says is said by the one of the game.
    pub fn start(&mut self, table: &Snapshot) {
        let _ = self.referee.start(table);
    }

    /// Hears what happened. The referee of the game hears the same and speaks for both.
    pub fn hear(&mut self, delivered: &Delivered) {
        let _ = self.referee.collect(delivered);
    }

    /// Whether an answer is still to come.
    pub fn is_open(&self) -> bool {
        self.asked.as_ref().is_some_and(|asked| !matches!(asked.answer, Answer::Here(_)))
    }

    /// What the last question was about.
    fn kind(&self) -> Option<TaskKind> {
        self.asked.as_ref().map(|asked| asked.task.kind)
    }

    fn ask(&mut self, task: Task) {
        // Whoever thinks about the question before is sent away first.
        self.asked = None;
        let answer = Answer::Coming(self.thinker.begin(&self.mind, task.clone()));
        self.asked = Some(Asked { task, answer });
    }

    /// Sends away whoever thinks: nobody wants to know any more.
    pub fn forget(&mut self) {
        self.asked = None;
    }

    /// The answer to the question of this kind; waits for it. None if there was no such question.
    fn answer(&mut self, is_kind: impl Fn(TaskKind) -> bool) -> Option<Arc<Deliberation>> {
        let asked = self.asked.as_mut().filter(|asked| is_kind(asked.task.kind))?;
        let deliberation = match std::mem::replace(&mut asked.answer, Answer::None) {
            Answer::Here(deliberation) => deliberation,
            Answer::Coming(thinking) => Arc::new(thinking.finish()),
            Answer::None => Arc::new(self.thinker.begin(&self.mind, asked.task.clone()).finish()),
        };
        asked.answer = Answer::Here(deliberation.clone());
        Some(deliberation)
    }

    /// What was thought in this turn, once it is known.
    pub fn deliberation(&self) -> Option<&Arc<Deliberation>> {
        match &self.asked.as_ref()?.answer {
            Answer::Here(deliberation) => Some(deliberation),
            Answer::None | Answer::Coming(_) => None,
        }
    }

    /// What decides the future: not how far somebody has come with thinking.
    pub fn hash(&self, hash: &mut StateHash) {
        Participant::hash(&self.referee, hash);
        if let Some(asked) = &self.asked {
            hash.u64(asked.task.seed);
            hash.u64(match asked.task.kind {
                TaskKind::Shoot => 1,
                TaskKind::Choose => 2,
                TaskKind::Place(zone) => 3 + zone as u64,
            });
        }
    }
}

impl Player {
    /// Asks who thinks, if anybody does, and is waited for until the pause is over.
    pub(super) fn ponder(&mut self, kind: TaskKind, delivered: &Delivered) {
        let (Some(search), Some(turn)) = (&mut self.search, &self.turn) else { return };
        search.ask(Task {
            kind,
            lies: delivered.table.balls.clone(),
            referee: search.referee.clone(),
            turn: turn.clone(),
            played_from: self.played_from,
            has_asked: self.has_asked,
            seed: self.rng.random(),
        });
    }

    /// The table is not what it was when the question was asked: asks again, and takes its time.
    pub(super) fn ponder_again(&mut self, delivered: &Delivered) {
        let kind = self.search.as_ref().filter(|search| search.is_open()).and_then(Search::kind);
        if let Some(kind) = kind {
            self.due = Some(delivered.tick.after(self.pause_ticks()));
            self.ponder(kind, delivered);
        }
    }

    /// What was decided; waits for it. None if nobody thinks or nothing was found.
    pub(super) fn decided(&mut self, is_kind: impl Fn(TaskKind) -> bool) -> Option<Decision> {
        let deliberation = self.search.as_mut()?.answer(is_kind)?;
        Some(deliberation.decision.clone())
    }
}
