//! Recordings: everything that entered a game from outside, and hashes to check a replay by.
//!
//! A recording is JSON lines. The first holds the header; then come frames (before they are used),
//! state hashes (one per subsystem at every tick that delivered a fact) and at last the end.
//!
//! Guaranteed: the same build replays a recording bit for bit, with either driver, jumping or not.
//! Not guaranteed: another version of the program, whose laws may differ; the replay then stops at
//! the first divergence and names the tick and the ball.

use crate::event_manager::Publication;
use crate::events::Source;
use crate::hash::{Digest, StateHash};
use crate::ids::BallId;
use crate::one_line::without_place;
use crate::physics::Snapshot;
use crate::scene::Overrides;
use crate::tick::{End, Frame, FrameSource, Inflow};
use crate::units::Tick;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Version of the format.
pub const VERSION: u32 = 1;
/// The largest recording that is read [bytes].
pub const SIZE_MAX: usize = 256 << 20;

/// The first line.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Header {
    /// Version of the format.
    pub version: u32,
    /// Program and version that wrote it.
    pub program: String,
    /// Name of the scene file.
    pub scene_name: String,
    /// The scene file's whole text.
    pub scene: String,
    /// Mesh files that the scene names, by the name it gives them.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub files: BTreeMap<String, String>,
    /// What was changed about the scene.
    #[serde(default)]
    pub overrides: Overrides,
}

/// State hashes after a tick, one per subsystem.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TickHash {
    /// The tick.
    pub tick: Tick,
    /// The simulation's.
    pub physics: Digest,
    /// Each participant's, in order of registration.
    pub participants: Vec<(Source, Digest)>,
    /// Each ball's, shortened to 32 bits: tells which one diverged.
    pub balls: Vec<(BallId, u32)>,
}

impl TickHash {
    /// Puts the hashes of a tick together.
    pub fn new(
        tick: Tick,
        physics: Digest,
        participants: impl IntoIterator<Item = (Source, Digest)>,
        table: &Snapshot,
    ) -> Self {
        let balls = table.balls.iter().map(|ball| {
            let mut hash = StateHash::new();
            hash.vec3(ball.position);
            hash.vec3(ball.velocity);
            hash.vec3(ball.angular_velocity);
            hash.u64(ball.place as u64);
            (ball.id, hash.finish().0 as u32)
        });
        // A hand is not computed, so it has no hash: the frames stand for it. Observers decide
        // nothing.
        let participants = participants
            .into_iter()
            .filter(|(source, _)| !matches!(source, Source::Input | Source::Runtime));
        TickHash { tick, physics, participants: participants.collect(), balls: balls.collect() }
    }

    /// One hash over all subsystems.
    pub fn all(&self) -> Digest {
        let mut hash = StateHash::new();
        hash.u64(self.physics.0);
        self.participants.iter().for_each(|(_, digest)| hash.u64(digest.0));
        hash.finish()
    }

    /// The first difference to what was recorded.
    pub fn divergence(&self, recorded: &TickHash) -> Option<Divergence> {
        if self == recorded {
            return None;
        }
        let ball = self.balls.iter().zip(&recorded.balls).find(|(own, old)| own != old);
        let what = if let Some((own, _)) = ball {
            format!("ball {}", own.0)
        } else if self.physics != recorded.physics {
            "physics (no ball's own state)".into()
        } else {
            let pair = self.participants.iter().zip(&recorded.participants);
            match pair.into_iter().find(|(own, old)| own != old) {
                Some((own, _)) => format!("{:?}", own.0).to_lowercase(),
                None => "who takes part".into(),
            }
        };
        Some(Divergence { tick: self.tick, what })
    }
}

/// Where a replay left the recording.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, thiserror::Error)]
#[error("the replay diverges at tick {} ({} s): {what} is not as recorded", tick.0, tick.end_s())]
pub struct Divergence {
    /// When.
    pub tick: Tick,
    /// The first ball or subsystem that differs.
    pub what: String,
}

/// One line of a recording.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Line {
    /// The first.
    Recording(Header),
    /// What entered in a tick.
    Frame {
        /// The tick.
        tick: Tick,
        /// What entered.
        publish: Frame,
    },
    /// Hashes to check by.
    Hash(TickHash),
    /// The last.
    End {
        /// The last tick.
        tick: Tick,
        /// Why it ended.
        reason: End,
    },
}

impl Line {
    /// The tick that it belongs to.
    pub fn tick(&self) -> Tick {
        match self {
            Line::Recording(_) => Tick(0),
            Line::Frame { tick, .. } | Line::End { tick, .. } => *tick,
            Line::Hash(hash) => hash.tick,
        }
    }

    /// The line as it is written, without the line break.
    pub fn to_json(&self) -> String {
        // Plain data with string keys: serialising it cannot fail.
        serde_json::to_string(self).unwrap_or_default()
    }
}

/// A recording that was read.
///
/// A game is recorded and run again, and every hash is compared.
///
/// ```
/// use hapticbillard::cast::Cast;
/// use hapticbillard::lockstep::{Setup, run};
/// use hapticbillard::replay::{Header, Line, RecordedInput, Recording, VERSION};
/// use hapticbillard::scene::{Overrides, Scene};
/// use hapticbillard::shipped;
/// use hapticbillard::units::Tick;
/// use std::sync::Arc;
///
/// let text = shipped::scene("eight_ball_headless").ok_or("no such scene")?;
/// let scene = Scene::parse("eight_ball_headless.toml", text)?;
/// let table = Arc::new(scene.build_table(&mut |file| Err(format!("there is no {file}")))?);
///
/// let header = Line::Recording(Header {
///     version: VERSION,
///     program: "an example".into(),
///     scene_name: "eight_ball_headless".into(),
///     scene: text.into(),
///     files: Default::default(),
///     overrides: Overrides::default(),
/// });
/// let mut written = header.to_json() + "\n";
/// let mut write = |line: &Line| written += &(line.to_json() + "\n");
/// let limit = Tick(60_000); // the first minute
/// let setup = Setup { record: Some(&mut write), ..Setup::headless(limit) };
/// let first = run(Cast::new(&scene, table.clone())?, setup)?;
///
/// let recording = Arc::new(Recording::parse(&written)?);
/// let setup = Setup {
///     input: Some(Box::new(RecordedInput(recording.clone()))),
///     verify: Some(recording.clone()),
///     ..Setup::headless(limit)
/// };
/// let again = run(Cast::new(&scene, table)?, setup)?;
/// assert_eq!(again.hash, first.hash);
/// assert!(again.verified > 0 && again.verified == recording.hashes.len() as u64);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    /// The first line.
    pub header: Header,
    /// What entered, by tick.
    pub frames: BTreeMap<Tick, Frame>,
    /// What to check by, by tick.
    pub hashes: BTreeMap<Tick, TickHash>,
    /// How it ended; none if the recording was cut off.
    pub end: Option<(Tick, End)>,
}

/// Why a recording cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum RecordingError {
    /// Too large.
    #[error("the recording has {bytes} bytes; at most {SIZE_MAX} are read")]
    TooLarge {
        /// Its size.
        bytes: usize,
    },
    /// Nothing in it.
    #[error("line 1: the file is empty; a recording begins with {{\"recording\":{{…}}}}")]
    Empty,
    /// A line is no recording line.
    #[error("line {line}, column {column}: {problem}; {remedy}")]
    Line {
        /// From 1.
        line: usize,
        /// From 1.
        column: usize,
        /// What is wrong.
        problem: String,
        /// What to do.
        remedy: &'static str,
    },
    /// Another format.
    #[error("line 1: format version {found}; this program reads version {VERSION}")]
    Version {
        /// The version found.
        found: u32,
    },
}

impl Recording {
    /// Reads a recording.
    ///
    /// # Errors
    /// [`RecordingError`] with the first line that does not fit.
    pub fn parse(text: &str) -> Result<Self, RecordingError> {
        if text.len() > SIZE_MAX {
            return Err(RecordingError::TooLarge { bytes: text.len() });
        }
        let mut lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
        let (_, first) = lines.next().ok_or(RecordingError::Empty)?;
        let header = match parse_line(1, first)? {
            Line::Recording(header) => header,
            _ => {
                return Err(wrong(
                    1,
                    "the first line is no header",
                    "begin with {\"recording\":…}",
                ));
            }
        };
        if header.version != VERSION {
            return Err(RecordingError::Version { found: header.version });
        }
        let mut recording =
            Recording { header, frames: BTreeMap::new(), hashes: BTreeMap::new(), end: None };
        let mut last = Tick(0);
        let total = text.lines().count();
        for (index, line) in lines {
            let number = index + 1;
            if recording.end.is_some() {
                return Err(wrong(number, "a line after the end", "delete it"));
            }
            let cut = number == total && !text.ends_with('\n');
            let line = match parse_line(number, line) {
                Ok(line) => line,
                // Who was killed while writing leaves half a line: the rest is as good as ever.
                Err(_) if cut => break,
                Err(error) => return Err(error),
            };
            match line {
                Line::Recording(_) => {
                    return Err(wrong(number, "a second header", "one file holds one recording"));
                }
                Line::Frame { tick, publish } => {
                    if tick < last || recording.frames.insert(tick, publish).is_some() {
                        return Err(wrong(number, "ticks are not in order", ORDER));
                    }
                    last = tick;
                }
                Line::Hash(hash) => {
                    let tick = hash.tick;
                    if tick < last || recording.hashes.insert(tick, hash).is_some() {
                        return Err(wrong(number, "ticks are not in order", ORDER));
                    }
                    last = tick;
                }
                Line::End { tick, reason } => recording.end = Some((tick, reason)),
            }
        }
        Ok(recording)
    }

    /// The next tick after `now` for which the recording has a frame or a hash.
    pub fn next_after(&self, now: Tick) -> Option<Tick> {
        let from = now.after(1)..;
        let frame = self.frames.range(from.clone()).next().map(|(tick, _)| *tick);
        let hash = self.hashes.range(from).next().map(|(tick, _)| *tick);
        let end = self.end.map(|(tick, _)| tick).filter(|tick| *tick > now);
        [frame, hash, end].into_iter().flatten().min()
    }

    /// Whether a run that ended after `tick` with `verified` matching hashes was the whole game.
    ///
    /// # Errors
    /// [`Divergence`] if the recording goes on where the run ended, or ended elsewhere.
    pub fn check_end(&self, tick: Tick, end: End, verified: u64) -> Result<(), Divergence> {
        if verified < self.hashes.len() as u64 {
            let what = "the end of the game: the recording goes on, and that".into();
            return Err(Divergence { tick, what });
        }
        match self.end {
            // Where else a game ends depends on whether it jumps.
            Some((last, End::Over)) if (last, End::Over) != (tick, end) => {
                Err(Divergence { tick, what: "the end of the game".into() })
            }
            _ => Ok(()),
        }
    }

    /// The frame of `tick`; empty if there is none.
    pub fn frame(&self, tick: Tick) -> Frame {
        self.frames.get(&tick).cloned().unwrap_or_default()
    }

    /// The last tick that the recording knows.
    pub fn last_tick(&self) -> Tick {
        let frame = self.frames.last_key_value().map(|(tick, _)| *tick);
        let hash = self.hashes.last_key_value().map(|(tick, _)| *tick);
        let end = self.end.map(|(tick, _)| tick);
        [frame, hash, end].into_iter().flatten().max().unwrap_or_default()
    }

    /// The events that entered, all of them.
    pub fn publications(&self) -> impl Iterator<Item = &Publication> {
        self.frames.values().flatten()
    }
}

/// A recording standing in for whoever acted: the mock of the input manager.
#[derive(Debug, Clone)]
pub struct RecordedInput(pub Arc<Recording>);

impl FrameSource for RecordedInput {
    fn inflow(&mut self, tick: Tick) -> Inflow {
        let recording = &self.0;
        // Somebody quit, or the recording was cut off and nobody knows what came then.
        let last = match recording.end {
            Some((last, End::Quit)) => Some(last),
            None => Some(recording.last_tick()),
            Some(_) => None,
        };
        let quit = last.is_some_and(|last| last < tick);
        let next = match last {
            // The one tick at which there is to quit.
            Some(last) if last <= tick => Some(last.after(1)),
            _ => recording.next_after(tick),
        };
        Inflow { frame: recording.frame(tick), next, quit, ..Inflow::default() }
    }
}

const ORDER: &str = "ticks must rise from line to line";

fn wrong(line: usize, problem: &str, remedy: &'static str) -> RecordingError {
    RecordingError::Line { line, column: 1, problem: problem.into(), remedy }
}

fn parse_line(number: usize, line: &str) -> Result<Line, RecordingError> {
    serde_json::from_str(line).map_err(|error| {
        let remedy = match number {
            1 => "a recording begins with {\"recording\":{…}}; is it the right file?",
            _ => "restore the file, or delete this line and all after it to replay the rest",
        };
        // The message ends with its own place, which is that inside the line.
        let problem = without_place(&error);
        RecordingError::Line { line: number, column: error.column().max(1), problem, remedy }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::events::{Event, MenuAction};

    fn header() -> Line {
        Line::Recording(Header {
            version: VERSION,
            program: "test".into(),
            scene_name: "one".into(),
            scene: String::new(),
            files: BTreeMap::new(),
            overrides: Overrides::default(),
        })
    }

    fn frame(tick: u64) -> Line {
        let publish = Frame::from_iter([Publication::from(Event::Menu(MenuAction::Pause))]);
        Line::Frame { tick: Tick(tick), publish }
    }

    fn text(lines: &[Line]) -> String {
        lines.iter().map(|line| line.to_json() + "\n").collect()
    }

    #[test]
    fn what_was_written_is_read() {
        let end = Line::End { tick: Tick(9), reason: End::Quit };
        let recording = Recording::parse(&text(&[header(), frame(3), end])).unwrap();
        assert_eq!(recording.frame(Tick(3)).len(), 1);
        assert_eq!(recording.frame(Tick(4)).len(), 0);
        assert_eq!(recording.next_after(Tick(0)), Some(Tick(3)));
        assert_eq!(recording.next_after(Tick(3)), Some(Tick(9)));
        assert_eq!(recording.end, Some((Tick(9), End::Quit)));
    }

    #[test]
    fn a_recording_that_was_cut_off_is_read_as_far_as_it_goes() {
        let whole = text(&[header(), frame(3), frame(5)]);
        let cut = Recording::parse(&whole[..whole.len() - 9]).unwrap();
        assert_eq!(cut.frames.keys().collect::<Vec<_>>(), [&Tick(3)]);
        let mut input = RecordedInput(Arc::new(cut));
        assert_eq!(input.inflow(Tick(0)).next, Some(Tick(3)));
        // Nobody knows what came then: it ends, whoever could go on.
        assert_eq!(input.inflow(Tick(3)).next, Some(Tick(4)));
        assert!(!input.inflow(Tick(3)).quit && input.inflow(Tick(4)).quit);
    }

    #[test]
    fn a_game_that_ended_elsewhere_is_not_the_recorded_one() {
        let end = Line::End { tick: Tick(9), reason: End::Over };
        let recording = Recording::parse(&text(&[header(), end])).unwrap();
        assert_eq!(recording.check_end(Tick(9), End::Over, 0), Ok(()));
        for (tick, end) in [(Tick(8), End::Over), (Tick(9), End::Idle)] {
            let divergence = recording.check_end(tick, end, 0).unwrap_err();
            assert_eq!(divergence.tick, tick);
            assert!(divergence.what.contains("end of the game"), "{divergence}");
        }
    }

    #[track_caller]
    fn check_error(text: &str, expected: &str) {
        let error = Recording::parse(text).unwrap_err().to_string();
        assert!(error.contains(expected), "{error}");
        assert!(!error.contains('\n'), "{error}");
    }

    #[test]
    fn bad_recordings_name_line_and_remedy() {
        check_error("", "line 1: the file is empty");
        check_error("{}", "line 1, column 2");
        let whole = text(&[header(), frame(3)]);
        check_error(&whole[..40], "line 1, column 40: EOF");
        check_error(&whole.replace("\"publish\"", "\"pub\""), "line 2, column");
        check_error(&whole.replace("\"publish\"", "\"pub\""), "delete this line and all after it");
        check_error(&text(&[header(), frame(3), frame(2)]), "line 3, column 1: ticks are not in");
        check_error(&text(&[frame(3)]), "the first line is no header");
        check_error(&whole.replace("\"version\":1", "\"version\":99"), "format version 99");
    }
}
