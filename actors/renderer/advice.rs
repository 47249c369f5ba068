//! Somebody who is asked what to play, and thinks on a thread of its own.

use hapticbillard::ai::{Advice, Adviser, Inline};
use hapticbillard::events::{Topics, Turn};
use hapticbillard::physics::Snapshot;
use hapticbillard::tick::Delivered;
use std::sync::Arc;
use std::thread;

/// Why nobody can be asked. The key of what the player is told.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoAdvice {
    /// There is nobody.
    Nobody,
    /// There is nothing to aim at now.
    NotNow,
    /// Somebody thinks already.
    Thinks,
}

impl NoAdvice {
    /// The key of its text.
    pub fn text(self) -> &'static str {
        match self {
            NoAdvice::Nobody => "advice_nobody",
            NoAdvice::NotNow => "advice_not_now",
            NoAdvice::Thinks => "advice_thinks",
        }
    }
}

/// What came of a question.
pub enum Answer {
    /// This, and it is shown.
    Here(Advice),
    /// There is nothing to be played.
    Nothing,
}

/// The adviser of a game, in the window.
pub struct AdviceScreen {
    adviser: Adviser,
    /// The turn that was asked about, by its number, and where the answer comes.
    asked: Option<(Arc<Turn>, flume::Receiver<Option<Advice>>)>,
    /// What is shown, and for which turn.
    shown: Option<(Arc<Turn>, Advice)>,
}

impl AdviceScreen {
    /// Before the first tick.
    pub fn new(mut adviser: Adviser, first: &Snapshot) -> Self {
        adviser.start(first);
        AdviceScreen { adviser, asked: None, shown: None }
    }

    /// What it must hear.
    pub fn topics(&self) -> Topics {
        self.adviser.topics()
    }

    /// Hears what happened.
    pub fn hear(&mut self, delivered: &Delivered) {
        self.adviser.hear(delivered);
    }

    /// Begins to think about a turn.
    ///
    /// # Errors
    /// [`NoAdvice`] if it thinks already, or the system gives no thread.
    pub fn ask(&mut self, turn: Arc<Turn>, table: &Snapshot) -> Result<(), NoAdvice> {
        if self.asked.is_some() {
            return Err(NoAdvice::Thinks);
        }
        let question = self.adviser.ask(turn.clone(), table);
        let (answer_in, answer) = flume::bounded(1);
        let think = move || {
            // A window that is gone wants to know nothing.
            let _ = answer_in.send(question.answer(&Inline));
        };
        let thread = thread::Builder::new().name("advice".into()).spawn(think);
        thread.map_err(|error| {
            tracing::warn!("no thread to think on: {error}");
            NoAdvice::Nobody
        })?;
        (self.asked, self.shown) = (Some((turn, answer)), None);
        Ok(())
    }

    /// What came of the question, once, if it is still the turn that it was about.
    pub fn take(&mut self, turn: Option<&Arc<Turn>>) -> Option<Answer> {
        let is_same = |one: &Arc<Turn>| {
            turn.is_some_and(|turn| {
                (one.player, one.shot_number) == (turn.player, turn.shot_number)
            })
        };
        if self.shown.as_ref().is_some_and(|(of, _)| !is_same(of)) {
            self.shown = None;
        }
        let answer = match &self.asked.as_ref()?.1.try_recv() {
            Ok(answer) => answer.clone(),
            Err(flume::TryRecvError::Empty) => return None,
            Err(flume::TryRecvError::Disconnected) => None,
        };
        let (of, _) = self.asked.take()?;
        if !is_same(&of) {
            return None;
        }
        let Some(advice) = answer else { return Some(Answer::Nothing) };
        self.shown = Some((of, advice.clone()));
        Some(Answer::Here(advice))
    }

    /// It is no longer shown.
    pub fn forget(&mut self) {
        self.shown = None;
    }

    /// What is shown.
    pub fn shown(&self) -> Option<&Advice> {
        self.shown.as_ref().map(|(_, advice)| advice)
    }
}
