//! One game twice: undisturbed in lockstep, then by actors that are disturbed.

use super::{Chatter, FaultKind, Jostle, Planned, Saboteur, Seen, Struck, Survival, Witness};
use super::{Victim, survival};
use crate::conductor::RunError;
use crate::crew::{Crew, Roster};
use crate::error::Error;
use crate::files::{self, LineWriter};
use crate::game::Stage;
use crate::recorder::Recorder;
use crate::runtime::{self, InputPort, Setup};
use hapticbillard::hash::Digest;
use hapticbillard::lockstep;
use hapticbillard::replay::{Line, TickHash};
use hapticbillard::tick::{Finished, Participant};
use hapticbillard::units::Tick;
use std::path::Path;
use std::sync::PoisonError;
use std::time::Duration;

/// A game that takes longer than this hangs.
const PATIENCE: Duration = Duration::from_secs(120);

/// So many batches of events before the end of a game a kill may come too late.
const NEAR_END: u64 = 64;
/// More than any recording has [bytes].
const RECORDING_MAX: u64 = 1 << 30;

/// A game as it is when nobody disturbs it.
#[derive(Debug, Clone)]
pub struct Reference {
    /// How it ended.
    pub finished: Finished,
    /// Its recording, line by line, with the tick of each.
    lines: Vec<(Tick, String)>,
    /// What happened in it.
    pub seen: Seen,
}

/// How a game is disturbed.
#[derive(Debug, Clone)]
pub struct Trial {
    /// Fixes what is done.
    pub seed: u64,
    /// Threads of the runtime.
    pub workers: usize,
    /// Physics has one of its own.
    pub physics_thread: bool,
    /// The threads are jostled.
    pub is_jostled: bool,
    /// What strikes.
    pub faults: Vec<Planned>,
}

/// What came of it.
#[derive(Debug)]
pub struct Played {
    /// What struck.
    pub struck: Vec<Struck>,
    /// How it ended, if it is as it must be.
    pub ended: Result<Ended, Wrong>,
}

/// How a disturbed game ends that is as it must be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ended {
    /// As the undisturbed one: the same to the bit.
    Same,
    /// It was stopped in order, because somebody failed who must not.
    Stopped,
}

/// Why a disturbed game is not as it must be.
#[derive(Debug, thiserror::Error)]
pub enum Wrong {
    /// The game could not be played at all.
    #[error(transparent)]
    Error(#[from] Error),
    /// It does not end.
    #[error("the game hangs: it has not ended after {} s", PATIENCE.as_secs())]
    Hangs,
    /// The runtime itself failed.
    #[error("the runtime panicked")]
    Panicked,
    /// It stopped, and nothing had happened for which it should.
    #[error("the game stopped, and should have gone on: {0}")]
    Stopped(RunError),
    /// It went on, and should have stopped.
    #[error("the game went on without {who} and ended with {found}, undisturbed with {expected}")]
    WentOn {
        /// Whoever failed.
        who: &'static str,
        /// How it ended.
        found: String,
        /// How it ends undisturbed.
        expected: String,
    },
    /// It ended otherwise.
    #[error("the game ended with {found}, and undisturbed with {expected}")]
    End {
        /// As it must be.
        expected: String,
        /// As it is.
        found: String,
    },
    /// Events are missing, or others.
    #[error("event {at} of {of} is missing or another one")]
    Events {
        /// Which, counted from 0.
        at: usize,
        /// How many there are.
        of: usize,
    },
    /// The recording is not as it must be.
    #[error("line {line} of the recording is missing or another one (tick {})", tick.0)]
    Recording {
        /// Which, counted from 1.
        line: usize,
        /// Its tick.
        tick: Tick,
    },
    /// Actors are left.
    #[error("after the game there are still {0}")]
    Left(String),
}

/// The end of a game and the hash of its last state, as a line.
pub fn end_of(finished: &Finished) -> String {
    let hash = finished.hash.as_ref().map_or(Digest(0), TickHash::all);
    // A clock that jumps and one that does not end at different ticks, with the same state.
    format!("{:?} {hash}", finished.end)
}

/// Plays a game in lockstep, until `limit` at the latest.
///
/// # Errors
/// [`Error`] if it cannot be played.
pub fn reference(stage: &Stage, seed: u64, limit: Tick) -> Result<Reference, Error> {
    let mut lines = vec![(Tick(0), Line::Recording(stage.header()).to_json())];
    let mut write = |line: &Line| lines.push((line.tick(), line.to_json()));
    let record: Option<&mut dyn FnMut(&Line)> = Some(&mut write);
    let witness = Witness::default();
    let observers: Vec<Box<dyn Participant>> = vec![Box::new(witness.clone())];
    let input = Some(Box::new(Chatter { seed }) as Box<_>);
    let setup = lockstep::Setup { record, observers, input, ..lockstep::Setup::headless(limit) };
    let finished = lockstep::run(stage.cast()?, setup).map_err(RunError::from)?;
    Ok(Reference { finished, lines, seen: witness.seen() })
}

/// Plays the same game by actors, disturbs them, and compares. The game is recorded into `file`,
/// which is gone afterwards unless something is wrong. `base` says what else there is.
pub fn play(
    stage: &Stage,
    reference: &Reference,
    trial: &Trial,
    file: &Path,
    base: Setup,
) -> Played {
    let (crew, roster) = Crew::watched();
    let witness = Witness::default();
    let (saboteur, struck) = Saboteur::new(&trial.faults, roster.clone());
    let mut observers = base.observers;
    observers.push(Box::new(witness.clone()));
    observers.push(Box::new(saboteur));
    let recorder = {
        let crew = crew.clone();
        Box::new(move |path: &Path, length| Recorder::start_in(&crew, path, length))
    };
    let setup = Setup {
        input: InputPort::StandIn(Box::new(Chatter { seed: trial.seed })),
        record: Some((file.to_path_buf(), stage.header())),
        recorder,
        observers,
        physics_thread: trial.physics_thread,
        workers: trial.workers,
        crew,
        ..base
    };
    let jostle = trial.is_jostled.then(|| Jostle::begin(trial.seed, roster.clone()));
    let ended = run_patiently(stage, setup);
    drop(jostle);
    let struck = struck.lock().unwrap_or_else(PoisonError::into_inner).clone();
    let ended = ended.and_then(|ended| judge(reference, ended, &struck, &witness.seen(), file));
    let ended = ended.and_then(|ended| match left(&roster) {
        left if left.is_empty() => Ok(ended),
        left => Err(Wrong::Left(left.join(", "))),
    });
    if ended.is_ok() {
        files::remove(file);
        files::remove(&LineWriter::draft_of(file));
    }
    Played { struck, ended }
}

/// Whether a game that has ended is as it must be.
fn judge(
    reference: &Reference,
    ended: Result<Finished, RunError>,
    struck: &[Struck],
    seen: &Seen,
    file: &Path,
) -> Result<Ended, Wrong> {
    let has_hit = |struck: &&Struck| struck.victims > 0;
    let ending = struck.iter().filter(has_hit).find(|struck| ends(struck.planned));
    match (ended, ending) {
        (Ok(finished), None) => {
            let (expected, found) = (end_of(&reference.finished), end_of(&finished));
            if expected != found {
                return Err(Wrong::End { expected, found });
            }
            has_all(reference, seen, None)?;
            is_recorded(reference, file, None)?;
            Ok(Ended::Same)
        }
        // Who is killed goes when they next wait, which may be after a game that is near its end:
        // then nothing may be missing in it.
        (Ok(finished), Some(ending)) => {
            let (expected, found) = (end_of(&reference.finished), end_of(&finished));
            let is_near_end = reference.seen.batches <= ending.planned.batch + NEAR_END;
            let who = ending.planned.victim.name();
            if expected != found || !is_near_end {
                return Err(Wrong::WentOn { who, found, expected });
            }
            has_all(reference, seen, None)?;
            is_recorded(reference, file, None)?;
            Ok(Ended::Same)
        }
        (Err(error), None) => Err(Wrong::Stopped(error)),
        (Err(_), Some(ending)) => {
            has_all(reference, seen, Some(ending.tick))?;
            // Who strikes conductor and recorder takes what one had for the other.
            let is_recorder = |struck: &Struck| struck.planned.victim == Victim::Recorder;
            let is_cut = ending.planned.victim == Victim::Conductor
                && struck.iter().filter(has_hit).any(is_recorder);
            let up_to = if is_cut { Tick(0) } else { ending.tick };
            is_recorded(reference, &LineWriter::draft_of(file), Some(up_to))?;
            Ok(Ended::Stopped)
        }
    }
}

fn ends(planned: Planned) -> bool {
    survival(planned.victim, FaultKind::of(planned.fault)) == Survival::Stops
}

/// Runs a game on a thread of its own, so that one that hangs is noticed.
fn run_patiently(stage: &Stage, setup: Setup) -> Result<Result<Finished, RunError>, Wrong> {
    let cast = stage.cast()?;
    let (tell, ended) = flume::bounded(1);
    let thread = std::thread::Builder::new().name("trial".into()).spawn(move || {
        // Whoever lost patience need not know.
        let _ = tell.send(runtime::run(cast, setup));
    });
    let thread = thread.map_err(|error| RunError::Start(error.to_string())).map_err(Error::from)?;
    match ended.recv_timeout(PATIENCE) {
        Ok(ended) => {
            // It has said its last word, and ends.
            let _ = thread.join();
            Ok(ended)
        }
        Err(flume::RecvTimeoutError::Timeout) => Err(Wrong::Hangs),
        Err(flume::RecvTimeoutError::Disconnected) => Err(Wrong::Panicked),
    }
}

/// Every event was heard, in order, up to a tick.
fn has_all(reference: &Reference, seen: &Seen, up_to: Option<Tick>) -> Result<(), Wrong> {
    let (all, heard) = (&reference.seen.events, &seen.events);
    let at = all.iter().zip(heard).take_while(|(one, other)| one == other).count();
    // Who was killed with this tick's mail in hand may not have read it.
    let due = match up_to {
        None => all.len(),
        Some(tick) => reference.seen.ticks.partition_point(|heard| *heard < tick),
    };
    let is_whole = due <= at && at == heard.len();
    if is_whole { Ok(()) } else { Err(Wrong::Events { at, of: due }) }
}

/// Every line is on disk, in order, up to a tick: byte for byte.
fn is_recorded(reference: &Reference, file: &Path, up_to: Option<Tick>) -> Result<(), Wrong> {
    is_the_same(reference, &files::read_text(file, RECORDING_MAX)?, up_to)
}

fn is_the_same(reference: &Reference, text: &str, up_to: Option<Tick>) -> Result<(), Wrong> {
    let mut found = text.split_inclusive('\n');
    for (at, (tick, line)) in reference.lines.iter().enumerate() {
        let is_same = match found.next() {
            Some(found) => found.strip_suffix('\n') == Some(line),
            // A recording that was cut off ends with whole lines.
            None if up_to.is_some_and(|up_to| up_to <= *tick) => return Ok(()),
            None => false,
        };
        if !is_same {
            return Err(Wrong::Recording { line: at + 1, tick: *tick });
        }
    }
    match found.next() {
        None => Ok(()),
        Some(_) => {
            let tick = reference.finished.tick;
            Err(Wrong::Recording { line: reference.lines.len() + 1, tick })
        }
    }
}

/// Who lives although the game is over. An actor ends in a moment of its own.
fn left(roster: &Roster) -> Vec<&'static str> {
    for _ in 0..200 {
        if roster.living().is_empty() {
            return Vec::new();
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    roster.living()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reference() -> Reference {
        let lines = (0..4).map(|n| (Tick(10 * n), format!("line {n}"))).collect();
        let events: Vec<Digest> = (0..6).map(Digest).collect();
        let ticks = (0..6).map(|n| Tick(5 * n)).collect();
        let finished = Finished {
            end: hapticbillard::tick::End::Over,
            tick: Tick(30),
            hash: None,
            verified: 0,
        };
        Reference { finished, lines, seen: Seen { events, ticks, batches: 6 } }
    }

    fn recorded(text: &str, up_to: Option<Tick>) -> Option<String> {
        is_the_same(&reference(), text, up_to).err().map(|wrong| wrong.to_string())
    }

    #[test]
    fn a_recording_that_misses_a_line_or_a_byte_is_found_out() {
        let whole = "line 0\nline 1\nline 2\nline 3\n";
        assert_eq!(recorded(whole, None), None);
        let wrong = |line, tick| {
            Some(format!("line {line} of the recording is missing or another one (tick {tick})"))
        };
        assert_eq!(recorded("line 0\nline 1\n", None), wrong(3, 20));
        assert_eq!(recorded("line 0\nline 1\nline 3\n", None), wrong(3, 20));
        assert_eq!(recorded("line 0\nline 1\nline 2\nline 3", None), wrong(4, 30));
        assert_eq!(recorded(&format!("{whole}line 4\n"), None), wrong(5, 30));
        // What was struck in tick 20 has recorded all before it.
        assert_eq!(recorded("line 0\nline 1\n", Some(Tick(20))), None);
        assert_eq!(recorded("line 0\n", Some(Tick(20))), wrong(2, 10));
    }

    #[test]
    fn events_that_are_missing_or_others_are_found_out() {
        let reference = reference();
        let heard = |events: &[u64], up_to| {
            let events: Vec<Digest> = events.iter().copied().map(Digest).collect();
            let seen = Seen { events, ..Seen::default() };
            has_all(&reference, &seen, up_to).is_ok()
        };
        assert!(heard(&[0, 1, 2, 3, 4, 5], None));
        assert!(!heard(&[0, 1, 2, 3, 4], None) && !heard(&[0, 2, 1, 3, 4, 5], None));
        assert!(!heard(&[0, 1, 2, 3, 4, 5, 6], None));
        // All before tick 15 were due.
        assert!(heard(&[0, 1, 2], Some(Tick(15))) && heard(&[0, 1, 2, 3], Some(Tick(15))));
        assert!(!heard(&[0, 1], Some(Tick(15))) && !heard(&[0, 1, 2, 9], Some(Tick(15))));
    }
}
