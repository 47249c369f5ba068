//! Times what a participant thinks: for reports, never for the game.

use crate::cpu_time::thread_cpu_time;
use hapticbillard::events::{Event, PlayerState, Source, Topics};
use hapticbillard::hash::StateHash;
use hapticbillard::physics::Snapshot;
use hapticbillard::tick::{Delivered, Outcome, Participant};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// How long a decision took: everything that a player did since its last one.
#[derive(Debug, Default, Clone, Copy, PartialEq)]
pub struct Took {
    /// Processor time of the thread that asked for it.
    pub cpu: Duration,
    /// Time by the clock on the wall, while the player was at it.
    pub wall: Duration,
}

/// The decisions so far, of player 1 and player 2.
#[derive(Debug, Default, Clone)]
pub struct Stopwatch(Arc<Mutex<[Vec<Took>; 2]>>);

impl Stopwatch {
    /// Processor time per decision [ms]; none before the first.
    pub fn cpu_ms_per_decision(&self) -> Option<f64> {
        let took = self.decisions().concat();
        let sum: Duration = took.iter().map(|took| took.cpu).sum();
        (!took.is_empty()).then(|| sum.as_secs_f64() * 1e3 / took.len() as f64)
    }

    /// Every decision of player 1 and of player 2.
    pub fn decisions(&self) -> [Vec<Took>; 2] {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

/// A participant under a stopwatch.
pub struct Timed<P> {
    core: P,
    stopwatch: Stopwatch,
    /// Since the last decision.
    since: Took,
}

impl<P: Participant> Timed<P> {
    /// Puts `core` under `stopwatch`.
    pub fn new(core: P, stopwatch: Stopwatch) -> Self {
        Timed { core, stopwatch, since: Took::default() }
    }

    /// Who begins to aim has just decided.
    fn note(&mut self, outcome: &Outcome) {
        let decided = outcome.publish.iter().find_map(|publication| match &publication.event {
            Event::Player(report) if report.state == PlayerState::Aiming => Some(report.player),
            _ => None,
        });
        if let Some(player) = decided {
            let took = std::mem::take(&mut self.since);
            let mut all = self.stopwatch.0.lock().unwrap_or_else(PoisonError::into_inner);
            all[player.index()].push(took);
        }
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
        let (cpu, wall) = (thread_cpu_time(), Instant::now());
        let outcome = self.core.collect(delivered);
        self.since.cpu += thread_cpu_time().saturating_sub(cpu);
        self.since.wall += wall.elapsed();
        self.note(&outcome);
        outcome
    }

    fn hash(&self, hash: &mut StateHash) {
        self.core.hash(hash);
    }
}
