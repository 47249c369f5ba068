//! Times what a participant thinks: for reports, never for the game.

use crate::cpu_time::thread_cpu_time;
use hapticbillard::events::{Event, PlayerState, Source, Topics};
use hapticbillard::hash::StateHash;
use hapticbillard::physics::Snapshot;
use hapticbillard::tick::{Delivered, Outcome, Participant};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// Decisions so far, and the processor time that the ticks took in which they were made.
#[derive(Debug, Default, Clone)]
pub struct Stopwatch(Arc<Mutex<(u32, Duration)>>);

impl Stopwatch {
    /// Processor time per decision [ms]; none before the first.
    pub fn cpu_ms_per_decision(&self) -> Option<f64> {
        let (decisions, time) = *self.0.lock().unwrap_or_else(PoisonError::into_inner);
        (decisions > 0).then(|| time.as_secs_f64() * 1e3 / f64::from(decisions))
    }
}

/// A participant under a stopwatch; it plays as without.
pub struct Timed<P> {
    core: P,
    stopwatch: Stopwatch,
}

impl<P> Timed<P> {
    /// Puts `core` under `stopwatch`.
    pub fn new(core: P, stopwatch: Stopwatch) -> Self {
        Timed { core, stopwatch }
    }
}

impl<P: Participant> Participant for Timed<P> {
    fn source(&self) -> Source {
        self.core.source()
    }

    fn topics(&self) -> Topics {
        self.core.topics()
    }

    fn start(&mut self, table: &Snapshot) -> Outcome {
        self.core.start(table)
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        let start = thread_cpu_time();
        let outcome = self.core.collect(delivered);
        let time = thread_cpu_time().saturating_sub(start);
        // Who begins to aim has just decided.
        let decided = outcome.publish.iter().any(|publication| {
            matches!(&publication.event, Event::Player(report)
                if report.state == PlayerState::Aiming)
        });
        if decided {
            let mut sum = self.stopwatch.0.lock().unwrap_or_else(PoisonError::into_inner);
            *sum = (sum.0 + 1, sum.1 + time);
        }
        outcome
    }

    fn hash(&self, hash: &mut StateHash) {
        self.core.hash(hash);
    }
}
