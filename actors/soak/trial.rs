//! One game twice: undisturbed in lockstep, then by actors that are disturbed.

use super::{Chatter, FaultKind, Jostle, Planned, Saboteur, Seen, Struck, Survival, Witness};
use super::{Victim, survival};
use crate::conductor::RunError;
use crate::crew::{Crew, Roster};
use crate::error::Error;
use crate::files::{self, LineWriter};
use crate::game::{LIMIT, Stage};
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

/// What came of it, if it is as it must be.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Played {
    /// It was stopped in order, because somebody failed who must not.
    pub has_stopped: bool,
    /// The faults that struck.
    pub struck: Vec<Struck>,
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
    #[error("the game went on to its end without {0}")]
    WentOn(&'static str),
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

/// Plays a game in lockstep.
///
/// # Errors
/// [`Error`] if it cannot be played.
pub fn reference(stage: &Stage, seed: u64) -> Result<Reference, Error> {
    let mut lines = vec![(Tick(0), Line::Recording(stage.header()).to_json())];
    let mut write = |line: &Line| lines.push((line.tick(), line.to_json()));
    let record: Option<&mut dyn FnMut(&Line)> = Some(&mut write);
    let witness = Witness::default();
    let observers: Vec<Box<dyn Participant>> = vec![Box::new(witness.clone())];
    let input = Some(Box::new(Chatter { seed }) as Box<_>);
    let setup = lockstep::Setup { record, observers, input, ..lockstep::Setup::headless(LIMIT) };
    let finished = lockstep::run(stage.cast()?, setup).map_err(RunError::from)?;
    Ok(Reference { finished, lines, seen: witness.seen() })
}

/// Plays the same game by actors, disturbs them, and compares. The game is recorded into `file`,
/// which is gone afterwards unless something is wrong. `base` says what else there is.
///
/// # Errors
/// [`Wrong`]: what is not as it must be.
pub fn play(
    stage: &Stage,
    reference: &Reference,
    trial: &Trial,
    file: &Path,
    base: Setup,
) -> Result<Played, Wrong> {
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
    let ended = ended?;
    let struck = struck.lock().unwrap_or_else(PoisonError::into_inner).clone();
    let ending = struck.iter().find(|struck| struck.victims > 0 && ends(struck.planned));
    let played = Played { has_stopped: ended.is_err(), struck: struck.clone() };
    match (ended, ending) {
        (Ok(finished), None) => {
            let (expected, found) = (end_of(&reference.finished), end_of(&finished));
            if expected != found {
                return Err(Wrong::End { expected, found });
            }
            has_all(reference, &witness.seen(), None)?;
            is_recorded(reference, file, None)?;
        }
        (Ok(finished), Some(ending)) => {
            // Who is struck when nobody needs them any more is not missed.
            if end_of(&finished) != end_of(&reference.finished) || !is_last(reference, ending) {
                return Err(Wrong::WentOn(ending.planned.victim.name()));
            }
        }
        (Err(error), None) => return Err(Wrong::Stopped(error)),
        (Err(_), Some(ending)) => {
            has_all(reference, &witness.seen(), Some(ending.tick))?;
            // Who strikes conductor and recorder takes what one had for the other.
            let was_recorder = |s: &Struck| s.planned.victim == Victim::Recorder;
            let is_cut = ending.planned.victim == Victim::Conductor
                && struck.iter().any(|s| was_recorder(s) && s.victims > 0);
            let up_to = if is_cut { Tick(0) } else { ending.tick };
            is_recorded(reference, &LineWriter::draft_of(file), Some(up_to))?;
        }
    }
    let left = left(&roster);
    if !left.is_empty() {
        return Err(Wrong::Left(left.join(", ")));
    }
    files::remove(file);
    files::remove(&LineWriter::draft_of(file));
    Ok(played)
}

fn ends(planned: Planned) -> bool {
    survival(planned.victim, FaultKind::of(planned.fault)) == Survival::Stops
}

/// Nothing more was delivered after this strike.
fn is_last(reference: &Reference, struck: &Struck) -> bool {
    reference.seen.batches <= struck.planned.batch + 1
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
    let text = files::read_text(file, RECORDING_MAX)?;
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
