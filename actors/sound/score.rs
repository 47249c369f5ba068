//! The score of a game: all that its mixer is told, computed as fast as it goes and without a sound
//! card.

use crate::conductor::RunError;
use crate::error::Error;
use crate::game::{LIMIT, Stage};
use hapticbillard::events::{Event, Fact, Source, Topics};
use hapticbillard::hash::StateHash;
use hapticbillard::lockstep::{self, Lockstep};
use hapticbillard::physics::Snapshot;
use hapticbillard::replay::{RecordedInput, Recording};
use hapticbillard::sound::{Foley, Script, Told};
use hapticbillard::tick::{Delivered, FrameSource, Outcome, Pace, Participant};
use hapticbillard::units::{Seconds, Tick};
use std::sync::{Arc, Mutex, PoisonError};

/// Every so many ticks it is looked at which balls roll.
const LOOK_TICKS: u64 = 4;
/// A scene in which nobody acts is over when nothing has moved for so long [ticks].
const REST_TICKS: u64 = 1000;

/// What a mixer is told, in the order of its frames.
#[derive(Debug, Clone, PartialEq)]
pub struct Score {
    /// Each thing with its frame.
    pub told: Vec<(u64, Told)>,
    /// When the game was over, or the time was up [s].
    pub end_s: Seconds,
}

/// The score of a scene, or of a recording of it, up to `limit_s` of the game, for a stream of
/// `rate_hz` frames a second.
///
/// # Errors
/// What the scene or its physics says.
pub fn score(
    stage: &Stage,
    replay: Option<Arc<Recording>>,
    rate_hz: u32,
    limit_s: Seconds,
) -> Result<Score, Error> {
    let cast = stage.cast()?;
    let first = Arc::new(cast.simulation.snapshot(0.0));
    let mut script = Script::new(stage.foley(first)?, f64::from(rate_hz));
    let acts =
        replay.is_some() || stage.scene.players.iter().any(|player| player.kind.is_computer());

    let ear = Ear::default();
    let input = replay.map(|recording| Box::new(RecordedInput(recording)) as Box<dyn FrameSource>);
    let setup = lockstep::Setup {
        pace: Pace::EveryTick,
        limit: Tick::containing(limit_s).min(LIMIT),
        input,
        observers: vec![Box::new(ear.clone())],
        ..lockstep::Setup::headless(LIMIT)
    };
    let mut game = Lockstep::new(cast, setup).map_err(RunError::from)?;
    let (mut ticks, mut moved) = (0_u64, 0);
    loop {
        let finished = game.step().map_err(RunError::from)?;
        let table = game.table().clone();
        ticks += 1;
        let facts = ear.take();
        facts.iter().for_each(|fact| script.hear(fact, Some(&table)));
        if !facts.is_empty() || ticks.is_multiple_of(LOOK_TICKS) {
            script.see(&table);
        }
        if table.is_rolling() || !facts.is_empty() {
            moved = ticks;
        }
        let is_over = !acts && moved + REST_TICKS <= ticks;
        if finished.is_some() || is_over {
            script.see(&table);
            return Ok(Score { told: script.finish(), end_s: table.time_s });
        }
    }
}

/// The score of facts alone, and of snapshots where there are some, each in the order of its times.
/// Without snapshots no ball is heard to roll.
pub fn score_of_facts(
    facts: &[Fact],
    snapshots: &[Arc<Snapshot>],
    foley: Foley,
    rate_hz: u32,
) -> Score {
    let mut script = Script::new(foley, f64::from(rate_hz));
    let mut seen = snapshots.iter().peekable();
    for fact in facts {
        while let Some(snapshot) = seen.next_if(|snapshot| snapshot.time_s < fact.time_s) {
            script.see(snapshot);
        }
        script.hear(fact, seen.peek().map(|snapshot| &***snapshot));
    }
    seen.for_each(|snapshot| script.see(snapshot));
    let last = [facts.last().map(|f| f.time_s), snapshots.last().map(|s| s.time_s)];
    let end_s = last.into_iter().flatten().fold(0.0, f64::max);
    Score { told: script.finish(), end_s }
}

/// Hears every fact.
#[derive(Clone, Default)]
struct Ear(Arc<Mutex<Vec<Fact>>>);

impl Ear {
    fn take(&self) -> Vec<Fact> {
        std::mem::take(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl Participant for Ear {
    fn source(&self) -> Source {
        Source::Runtime
    }

    fn topics(&self) -> Topics {
        Topics::FACTS
    }

    fn start(&mut self, _: &Snapshot) -> Outcome {
        Outcome::default()
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        let facts = delivered.events.iter().filter_map(|stamped| match &stamped.event {
            Event::Fact(fact) => Some(*fact),
            _ => None,
        });
        self.0.lock().unwrap_or_else(PoisonError::into_inner).extend(facts);
        Outcome::default()
    }

    fn hash(&self, _: &mut StateHash) {}
}
