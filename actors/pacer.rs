//! Makes time run: sends the conductor one step after another.
//!
//! A paced game keeps to real time: ticks are sent in small groups, because the timers of the
//! runtime have a grain of a millisecond. When a tick takes too long, game time slows; ticks are
//! never skipped.

use crate::conductor::{Conductor, Progress, Quit, RunError, Step};
use crate::meters::Meters;
use hapticbillard::tick::{End, Finished};
use hapticbillard::units::Tick;
use kameo::error::SendError;
use kameo::prelude::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use tokio::time::Instant;

/// Whether a game keeps to real time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tempo {
    /// As fast as possible.
    Free,
    /// This many seconds of the game per second: 1 for play.
    RealTime(f64),
}

/// How far a paced game may lag before it gives the lost time up.
const LAG_MAX: Duration = Duration::from_millis(50);
/// How much faster time runs for somebody who would rather not wait. Fast enough to skip a long
/// roll, slow enough to see who pockets what.
const HURRY: f64 = 8.0;
/// How long it waits at most [s].
const WAIT_MAX_S: f64 = 86_400.0;
/// How long the pacer sleeps at least.
const GRAIN: Duration = Duration::from_millis(2);

/// A flag by which anybody (Ctrl-C, a closed window) ends the game between two ticks.
#[derive(Debug, Default, Clone)]
pub struct StopFlag(Arc<AtomicBool>);

impl StopFlag {
    /// Asks for the end.
    pub fn set(&self) {
        self.0.store(true, Ordering::Release);
    }

    /// Whether somebody asked for the end.
    pub fn is_set(&self) -> bool {
        self.0.load(Ordering::Acquire)
    }
}

/// Runs a game to its end.
///
/// # Errors
/// What the conductor says.
pub async fn run(
    conductor: &ActorRef<Conductor>,
    tempo: Tempo,
    stop: &StopFlag,
    meters: Option<&Meters>,
) -> Result<Finished, RunError> {
    let mut start = (Instant::now(), Tick(0));
    let mut was_hurried = false;
    loop {
        let begun = meters.and_then(Meters::now);
        let stepped = if stop.is_set() {
            conductor.ask(Quit).await.map_err(gone)?
        } else {
            conductor.ask(Step).await.map_err(gone)?
        };
        let (tick, progress) = stepped.0?;
        match progress {
            Progress::Finished(finished) => return Ok(finished),
            Progress::Paused => {
                tokio::time::sleep(Duration::from_millis(10)).await;
                start = (Instant::now(), tick);
            }
            Progress::Running | Progress::Hurried => {
                if let (Some(meters), Some(begun)) = (meters, begun) {
                    meters.note_tick(tick, begun);
                }
                let Tempo::RealTime(rate) = tempo else { continue };
                let hurried = progress == Progress::Hurried;
                if hurried != was_hurried {
                    was_hurried = hurried;
                    start = (Instant::now(), tick);
                }
                start = pace(start, tick, if hurried { rate * HURRY } else { rate }).await;
            }
        }
    }
}

/// Waits until the tick's time has come; returns where time is counted from.
async fn pace(start: (Instant, Tick), tick: Tick, rate: f64) -> (Instant, Tick) {
    let passed_s = tick.0.saturating_sub(start.1.0) as f64 / 1000.0;
    // However slow motion is asked for: a tick does not take longer than a day.
    let wait = Duration::try_from_secs_f64((passed_s / rate).clamp(0.0, WAIT_MAX_S));
    let due = start.0 + wait.unwrap_or_default();
    let now = Instant::now();
    if now + GRAIN < due {
        tokio::time::sleep_until(due).await;
    } else if due + LAG_MAX < now {
        return (now, tick);
    }
    start
}

fn gone<M, E: std::fmt::Debug>(error: SendError<M, E>) -> RunError
where
    SendError<M, E>: std::fmt::Display,
{
    RunError::Gone { actor: "conductor", tick: Tick(0), reason: error.to_string() }
}

/// Why a finished game's end is worth a word to the player.
pub fn describe(end: End) -> &'static str {
    match end {
        End::Over => "the game is over",
        End::Quit => "the game was ended",
        End::Idle => "nothing moves and nobody acts any more",
        End::Limit => "the time limit was reached",
    }
}
