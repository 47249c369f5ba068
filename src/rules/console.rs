//! The paper's rule console (section 5.2): facts in, one a line; phase, state and verdict out.

use super::ball_names::{numbered, numbered_object};
use super::fact_json::read_fact;
use super::games::game;
use super::phase::Phase;
use super::referee::Referee;
use super::state::State;
use crate::events::Choice;
use crate::events::{Call, CallKind, Command, Event, Source, Turn, Verdict};
use crate::ids::BallId;
use crate::ids::GameKind;
use crate::one_line::{one_line, without_place};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::sync::Arc;

/// Longer lines are refused [bytes].
const LINE_MAX: usize = 1 << 20;

/// A game that is played by typing facts.
///
/// ```
/// use hapticbillard::ids::GameKind;
/// use hapticbillard::rules::Console;
///
/// let mut console = Console::new(GameKind::PaperEightBall);
/// console.feed_line(r#"{"t":0.0,"e":"place","ball":"0","zone":"kitchen","ok":true}"#)?;
/// console.feed_line(r#"{"t":0.1,"e":"tip","ball":"0"}"#)?;
/// let answer = console.feed_line(r#"{"t":9.0,"e":"settle"}"#)?;
/// let verdict = answer.verdict.ok_or("a shot that is over is judged")?;
/// assert!(!verdict.legal && verdict.fouls.len() == 1); // the cue ball met nothing
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Console {
    referee: Referee,
    lines: usize,
}

/// Where the game stands after a line.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ConsoleAnswer {
    /// The line was a fact or a state. Others (samples of ball positions, summaries, comments) are
    /// passed over.
    pub heard: bool,
    /// The phase.
    pub phase: Phase,
    /// Table and game.
    pub state: State,
    /// The verdict that this line brought about.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub verdict: Option<Arc<Verdict>>,
    /// What the player at the table has announced.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub call: Option<Call>,
    /// The turn that this line brought about.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub turn: Option<Arc<Turn>>,
}

/// A line is not understood.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ConsoleError {
    /// It is no JSON object.
    #[error(
        "line {line}, column {column}: {problem}; expected one fact as a JSON object, such as \
         {{\"t\":0.15,\"e\":\"hit\",\"a\":\"0\",\"b\":\"1\"}}"
    )]
    NotAnObject {
        /// Counted from 1.
        line: usize,
        /// Counted from 1.
        column: usize,
        /// What is wrong.
        problem: String,
    },
    /// It is an object, but no fact.
    #[error("line {line}, column {column}: {problem}")]
    NotAFact {
        /// Counted from 1.
        line: usize,
        /// Counted from 1: the wrong value's key, or the end where one is missing.
        column: usize,
        /// What is wrong and what is allowed.
        problem: String,
    },
    /// It is far too long.
    #[error("line {line}: {bytes} bytes; at most {LINE_MAX} are read")]
    TooLong {
        /// Counted from 1.
        line: usize,
        /// Its length.
        bytes: usize,
    },
}

impl Console {
    /// A new game with a full rack; player 1 breaks.
    pub fn new(kind: GameKind) -> Self {
        let mut referee = Referee::new(kind);
        referee.begin((0..=game(kind).balls).map(BallId));
        Console { referee, lines: 0 }
    }

    /// Where the game stands.
    pub fn answer(&self) -> ConsoleAnswer {
        ConsoleAnswer {
            heard: false,
            phase: self.referee.phase(),
            state: self.referee.state().clone(),
            verdict: None,
            call: self.referee.call().cloned(),
            turn: None,
        }
    }

    /// Takes the next line: a fact, `{"call":…}` as rule scenarios have it, `{"choose":"accept"}`,
    /// in training `{"undo":true}`, or `{"state":{…}}` to go on from another state.
    ///
    /// What `simulate --json` prints passes through: its facts are heard, the rest is passed over,
    /// as are empty lines and comments (`#`). After an error the game stands where it stood.
    pub fn feed_line(&mut self, text: &str) -> Result<ConsoleAnswer, ConsoleError> {
        self.lines += 1;
        let line = self.lines;
        if text.len() > LINE_MAX {
            return Err(ConsoleError::TooLong { line, bytes: text.len() });
        }
        let trimmed = text.trim();
        if trimmed.is_empty() || trimmed.starts_with('#') {
            return Ok(self.answer());
        }
        let object: Map<String, Value> =
            serde_json::from_str(text).map_err(|error| ConsoleError::NotAnObject {
                line,
                column: error.column().max(1),
                problem: without_place(&error),
            })?;
        let is_fact = object.contains_key("e") || object.contains_key("fact");
        let kind = self.referee.game();
        for key in ["call", "choose", "undo"] {
            if let (false, Some(value)) = (is_fact, object.get(key)) {
                return self.obey(text, key, value.clone());
            }
        }
        if let (false, Some(state)) = (is_fact, object.get("state")) {
            let mut state = state.clone();
            numbered(kind, &mut state);
            let state = State::deserialize(state).map_err(|error| ConsoleError::NotAFact {
                line,
                column: column_of(text, Some("state")),
                problem: one_line(&format!("state: {error}"), 400),
            })?;
            self.referee = Referee::resume(self.referee.game(), state);
            let said = self.referee.begin([]);
            return Ok(self.answer_with(said));
        }
        let passes = ["balls", "summary"].iter().any(|key| object.contains_key(*key));
        if !is_fact && passes {
            return Ok(self.answer());
        }
        let fact =
            read_fact(numbered_object(kind, object)).map_err(|error| ConsoleError::NotAFact {
                line,
                column: column_of(text, error.key.as_deref()),
                problem: error.problem,
            })?;
        let said = self.referee.handle(&fact);
        Ok(self.answer_with(said))
    }

    /// Hears a call or a choice. One that is not allowed now is refused.
    fn obey(&mut self, text: &str, key: &str, value: Value) -> Result<ConsoleAnswer, ConsoleError> {
        let refused = |problem: String| ConsoleError::NotAFact {
            line: self.lines,
            column: column_of(text, Some(key)),
            problem: one_line(&problem, 400),
        };
        let unknown = |error: serde_json::Error| refused(format!("{key}: {error}"));
        let mut value = value;
        numbered(self.referee.game(), &mut value);
        let command = match key {
            "call" => Command::Call(Call::deserialize(value).map_err(unknown)?),
            "undo" => Command::Undo,
            _ => Command::Choose(Choice::deserialize(value).map_err(unknown)?),
        };
        let phase = self.referee.phase();
        let mut after = self.referee.clone();
        let said = after.obey(Source::Input, &command);
        let is_heard = match &command {
            Command::Call(Call::Kind(CallKind::Nothing)) => after.call().is_none(),
            Command::Call(call) => after.call() == Some(call),
            _ => !said.is_empty(),
        };
        if !is_heard {
            let options = &self.referee.state().options;
            let problem = match options.is_empty() {
                true => format!("{key}: nothing of the kind is asked for in the phase {phase}"),
                false => format!(
                    "{key}: expected one of {}",
                    serde_json::to_string(options).unwrap_or_default()
                ),
            };
            return Err(refused(problem));
        }
        self.referee = after;
        Ok(self.answer_with(said))
    }

    fn answer_with(&self, said: impl IntoIterator<Item = Event>) -> ConsoleAnswer {
        let mut answer = ConsoleAnswer { heard: true, ..self.answer() };
        for event in said {
            match event {
                Event::Verdict(verdict) => answer.verdict = Some(verdict),
                Event::Turn(turn) => answer.turn = Some(turn),
                _ => {}
            }
        }
        answer
    }
}

/// The column, from 1, of a key in a line; that of its end without a key.
fn column_of(line: &str, key: Option<&str>) -> usize {
    let end = line.trim_end().len();
    let place = key.and_then(|key| line.find(&format!("\"{key}\""))).unwrap_or(end);
    line[..place].chars().count() + usize::from(place < end)
}
