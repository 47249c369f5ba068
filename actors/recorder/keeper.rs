//! Keeps a recording whole while its actor comes and goes.
//!
//! The conductor hands every line over and waits until it is on disk. When the recorder dies, or
//! the disk refuses, the game goes on: lines wait here, and a new recorder goes on behind the last
//! line that is known to be on disk. It is started after a second of game time, and after twice as
//! long each time it fails again, up to a minute.
//!
//! At most [`WAITING_MAX`] lines wait. When there are more the recording ends where it is, and can
//! be replayed that far.

use super::{Record, Written};
use crate::error::Error;
use hapticbillard::events::Health;
use hapticbillard::replay::Line;
use hapticbillard::units::Tick;
use kameo::prelude::*;
use std::collections::VecDeque;
use std::path::{Path, PathBuf};

/// Most lines that wait for a new recorder: a minute of a hand that never rests.
pub const WAITING_MAX: usize = 1 << 16;
/// How long the first pause is [ticks].
const PAUSE: u64 = 1000;
/// How long a pause is at most [ticks].
const PAUSE_MAX: u64 = 60_000;
/// Its name in what the player is told.
const RECORDER: &str = "recorder";

/// Starts a recorder for this file that goes on behind so many bytes.
pub type Open = Box<dyn FnMut(&Path, u64) -> Result<ReplyRecipient<Record, Written>, Error> + Send>;

/// Why a recording is not whole.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{} ends at tick {}: {reason}", file.display(), tick.0)]
pub struct Lost {
    /// The file.
    pub file: PathBuf,
    /// What happened later is not in it.
    pub tick: Tick,
    /// Why.
    pub reason: String,
}

/// The conductor's side of a recording.
pub struct Keeper {
    path: PathBuf,
    open: Open,
    recorder: Option<Hired>,
    /// On disk for certain [bytes].
    length: u64,
    /// The tick of the last line that is on disk.
    reached: Tick,
    waiting: VecDeque<Line>,
    /// In a row.
    failures: u32,
    retry: Tick,
    reason: String,
    gave_up: bool,
}

impl Keeper {
    /// Begins a recording.
    ///
    /// # Errors
    /// [`Error`] if the file cannot be begun: then there is still time to choose another.
    pub async fn begin(path: PathBuf, header: Line, open: Open) -> Result<Self, Error> {
        let mut keeper = Keeper {
            path,
            open,
            recorder: None,
            length: 0,
            reached: Tick(0),
            waiting: VecDeque::from([header]),
            failures: 0,
            retry: Tick(0),
            reason: String::new(),
            gave_up: false,
        };
        match keeper.write_waiting().await {
            Ok(()) => Ok(keeper),
            Err(Failure::Disk(error)) => Err(error),
            Err(Failure::Gone(reason)) => {
                let reason = std::io::Error::other(reason);
                Err(Error::Write { path: keeper.path, reason })
            }
        }
    }

    /// Records a line. Returns what the player should be told, if anything.
    pub async fn record(&mut self, line: Line) -> Option<Health> {
        if self.gave_up {
            return None;
        }
        let tick = line.tick();
        let is_last = matches!(line, Line::End { .. });
        self.waiting.push_back(line);
        // Whoever is down is left alone for a while, unless there is no later.
        if self.recorder.is_none() && tick < self.retry && !is_last {
            return self.give_up_when_full();
        }
        let failure = match self.write_waiting().await {
            Ok(()) if self.failures == 0 => return None,
            Ok(()) => {
                self.failures = 0;
                tracing::warn!("the game is recorded again, and nothing is missing");
                return Some(Health::ActorRestarted { actor: RECORDER.into() });
            }
            Err(failure) => failure,
        };
        self.recorder = None;
        self.reason = failure.to_string();
        let pause = PAUSE << self.failures.min(6);
        self.retry = tick.after(pause.min(PAUSE_MAX));
        self.failures = self.failures.saturating_add(1);
        // Told once; that it fails again and again is no news.
        if self.failures == 1 {
            tracing::warn!("the game is not recorded for now: {}", self.reason);
            return Some(self.failed());
        }
        self.give_up_when_full()
    }

    /// Waits until the recorder has stopped, and says what is missing. What waits for one is
    /// written now: there is no later.
    pub async fn end(mut self) -> Option<Lost> {
        if !self.gave_up && !self.waiting.is_empty() {
            self.recorder = None;
            if let Err(failure) = self.write_waiting().await {
                self.reason = failure.to_string();
            }
        }
        if let Some(recorder) = self.recorder.take() {
            // One that has stopped already is what is wanted.
            let _ = recorder.0.stop_gracefully().await;
            recorder.0.wait_for_shutdown().await;
        }
        let is_whole = self.waiting.is_empty() && !self.gave_up;
        (!is_whole).then_some(Lost { file: self.path, tick: self.reached, reason: self.reason })
    }

    fn failed(&self) -> Health {
        Health::ActorFailed { actor: RECORDER.into(), reason: self.reason.clone() }
    }

    fn give_up_when_full(&mut self) -> Option<Health> {
        if self.waiting.len() < WAITING_MAX {
            return None;
        }
        self.waiting = VecDeque::new();
        self.gave_up = true;
        tracing::warn!("the recording ends at tick {}: {}", self.reached.0, self.reason);
        Some(self.failed())
    }

    /// Writes all that waits, in order, with a new recorder if there is none.
    async fn write_waiting(&mut self) -> Result<(), Failure> {
        if self.recorder.is_none() {
            self.recorder = Some(Hired((self.open)(&self.path, self.length)?));
        }
        while let (Some(line), Some(recorder)) = (self.waiting.front(), &self.recorder) {
            let written = recorder.0.ask(Record(line.clone())).send().await;
            self.length = written.map_err(|error| Failure::Gone(error.to_string()))?.0?;
            self.reached = line.tick();
            self.waiting.pop_front();
        }
        Ok(())
    }
}

/// A recorder that goes when it is let go: an actor with a thread of its own holds itself, and
/// would stay for ever.
struct Hired(ReplyRecipient<Record, Written>);

impl Drop for Hired {
    fn drop(&mut self) {
        self.0.kill();
    }
}

#[derive(Debug, thiserror::Error)]
enum Failure {
    #[error(transparent)]
    Disk(#[from] Error),
    #[error("the recorder stopped: {0}")]
    Gone(String),
}
