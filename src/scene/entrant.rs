//! A player as a command line or a recording names him: `KIND[:SIMULATIONS][@NOISE]`.

use super::{PlayerKind, PlayerSection, UnknownComputer};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// Most shots that a player may simulate for a decision.
pub(super) const SIMULATIONS_MAX: u32 = 1_000_000;

/// Who plays in place of a scene's player, and how; what is none stays as the scene says.
///
/// Written as text it is `paper`, `paper@0.5`, `champion:2000`, `club:20@0`, or `70` for a computer
/// of that strength; a recording holds the kind alone or a table.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(from = "Form", into = "Form")]
pub struct Entrant {
    /// Who decides.
    pub kind: Option<PlayerKind>,
    /// Shots that it may simulate for a decision.
    pub simulations: Option<u32>,
    /// Noise of the strokes, in multiples of the Computer Pool Olympiad's.
    pub noise: Option<f64>,
}

/// How a recording holds it. The kind alone is what recordings held first.
#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum Form {
    Kind(PlayerKind),
    Table(Table),
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    kind: Option<PlayerKind>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    simulations: Option<u32>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    noise: Option<f64>,
}

impl From<Form> for Entrant {
    fn from(form: Form) -> Self {
        match form {
            Form::Kind(kind) => kind.into(),
            Form::Table(Table { kind, simulations, noise }) => Entrant { kind, simulations, noise },
        }
    }
}

impl From<Entrant> for Form {
    fn from(Entrant { kind, simulations, noise }: Entrant) -> Self {
        match (kind, simulations, noise) {
            (Some(kind), None, None) => Form::Kind(kind),
            _ => Form::Table(Table { kind, simulations, noise }),
        }
    }
}

impl From<PlayerKind> for Entrant {
    fn from(kind: PlayerKind) -> Self {
        Entrant { kind: Some(kind), ..Entrant::default() }
    }
}

impl Entrant {
    /// Changes a player of a scene.
    pub fn apply(&self, section: &mut PlayerSection) {
        section.kind = self.kind.unwrap_or(section.kind);
        section.simulations = self.simulations.or(section.simulations);
        section.noise = self.noise.or(section.noise);
    }
}

/// Why a text names no player; one line.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum NoEntrant {
    /// Nobody is called so.
    #[error(transparent)]
    Kind(#[from] UnknownComputer),
    /// What follows the colon.
    #[error(
        "'{found}' is no number of simulations; write 1 to {SIMULATIONS_MAX} after the colon, such \
         as champion:2000"
    )]
    Simulations {
        /// What was written.
        found: String,
    },
    /// A player that does not simulate.
    #[error("paper simulates nothing; write paper without a colon, or champion:2000")]
    Simulates,
    /// What follows the @.
    #[error("'{found}' is no noise; write a number from 0 to 100 after the @, such as paper@0.5")]
    Noise {
        /// What was written.
        found: String,
    },
}

impl FromStr for Entrant {
    type Err = NoEntrant;

    fn from_str(text: &str) -> Result<Self, NoEntrant> {
        let (rest, noise) = parts(text, '@');
        let (name, simulations) = parts(rest, ':');
        let kind: PlayerKind = name.parse()?;
        if simulations.is_some() && kind == PlayerKind::Paper {
            return Err(NoEntrant::Simulates);
        }
        let simulations = simulations.map(|count| {
            let number = count.parse().ok().filter(|n| (1..=SIMULATIONS_MAX).contains(n));
            number.ok_or_else(|| NoEntrant::Simulations { found: count.into() })
        });
        let noise = noise.map(|noise| {
            let number = noise.parse().ok().filter(|number| (0.0..=100.0).contains(number));
            number.ok_or_else(|| NoEntrant::Noise { found: noise.into() })
        });
        let (simulations, noise) = (simulations.transpose()?, noise.transpose()?);
        Ok(Entrant { kind: Some(kind), simulations, noise })
    }
}

/// What stands before and behind a sign, if it is there.
fn parts(text: &str, sign: char) -> (&str, Option<&str>) {
    text.split_once(sign).map_or((text, None), |(before, behind)| (before, Some(behind)))
}

impl fmt::Display for Entrant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.kind {
            Some(kind) => kind.fmt(f)?,
            None => f.write_str("scene's")?,
        }
        if let Some(simulations) = self.simulations {
            write!(f, ":{simulations}")?;
        }
        match self.noise {
            Some(noise) => write!(f, "@{noise}"),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(text: &str, json: &str) {
        let entrant: Entrant = text.parse().unwrap();
        assert_eq!(entrant.to_string(), text);
        assert_eq!(serde_json::to_string(&entrant).unwrap(), json);
        assert_eq!(serde_json::from_str::<Entrant>(json).unwrap(), entrant);
    }

    #[test]
    fn what_is_written_is_read() {
        check("paper", r#""paper""#);
        check("paper@0.5", r#"{"kind":"paper","noise":0.5}"#);
        check("champion:2000", r#"{"kind":"champion","simulations":2000}"#);
        check("club:20@0", r#"{"kind":"club","simulations":20,"noise":0.0}"#);
        check("70@2", r#"{"kind":{"computer":70},"noise":2.0}"#);
    }

    #[track_caller]
    fn check_error(text: &str, expected: &str) {
        let error = text.parse::<Entrant>().unwrap_err().to_string();
        assert!(error.contains(expected) && !error.contains('\n'), "{error}");
    }

    #[test]
    fn what_is_wrong_is_named_with_what_to_write() {
        check_error("papier", "no computer player is called \"papier\": write paper, club");
        check_error("human", "no computer player is called");
        check_error("101", "a strength from 0 to 100");
        check_error("champion:0", "'0' is no number of simulations; write 1 to 1000000");
        check_error("champion:many@1", "'many' is no number of simulations");
        check_error("paper:5", "paper simulates nothing");
        check_error("paper@", "'' is no noise");
        check_error("paper@-1", "write a number from 0 to 100");
        check_error("paper@NaN", "'NaN' is no noise");
    }
}
