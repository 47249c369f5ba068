//! Somebody who is asked what to play, and thinks on a thread of its own.

use hapticbillard::ai::{Advice, Adviser, Inline};
use hapticbillard::ball::BallState;
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
    /// Nobody aims at that table any more.
    Late,
}

/// What was asked about: a turn, and the table in it.
struct Asked {
    turn: Arc<Turn>,
    table: Arc<Snapshot>,
}

impl Asked {
    /// Whether this is the same turn, and all balls lie as they lay.
    fn is(&self, turn: &Turn, table: &Snapshot) -> bool {
        let balls = self.table.balls.iter().zip(&table.balls);
        let lies =
            |(a, b): (&BallState, &BallState)| (a.position, a.place) == (b.position, b.place);
        (self.turn.player, self.turn.shot_number) == (turn.player, turn.shot_number)
            && self.table.balls.len() == table.balls.len()
            && balls.into_iter().all(lies)
    }
}

/// The adviser of a game, in the window.
pub struct AdviceScreen {
    adviser: Adviser,
    /// What is asked, and where the answer comes.
    asked: Option<(Asked, flume::Receiver<Option<Advice>>)>,
    /// What is shown, and for what.
    shown: Option<(Asked, Advice)>,
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
    pub fn ask(&mut self, turn: Arc<Turn>, table: &Arc<Snapshot>) -> Result<(), NoAdvice> {
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
        let asked = Asked { turn, table: table.clone() };
        (self.asked, self.shown) = (Some((asked, answer)), None);
        Ok(())
    }

    /// What came of the question, once; `turn`: somebody aims in it now.
    pub fn take(&mut self, turn: Option<&Arc<Turn>>, table: &Snapshot) -> Option<Answer> {
        let is_now = |asked: &Asked| turn.is_some_and(|turn| asked.is(turn, table));
        self.shown.take_if(|(asked, _)| !is_now(asked));
        let answer = match self.asked.as_ref()?.1.try_recv() {
            Ok(answer) => answer,
            Err(flume::TryRecvError::Empty) => return None,
            Err(flume::TryRecvError::Disconnected) => None,
        };
        let (asked, _) = self.asked.take()?;
        Some(match answer {
            _ if !is_now(&asked) => Answer::Late,
            None => Answer::Nothing,
            Some(advice) => {
                self.shown = Some((asked, advice.clone()));
                Answer::Here(advice)
            }
        })
    }

    /// What is shown.
    pub fn shown(&self) -> Option<&Advice> {
        self.shown.as_ref().map(|(_, advice)| advice)
    }
}
