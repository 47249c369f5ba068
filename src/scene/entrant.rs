//! A player as a command line or a recording names him: `KIND[@NOISE]`.

use super::{PlayerKind, PlayerSection};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// The kinds that can be asked for: who plays without anybody at a device.
const KINDS: [PlayerKind; 1] = [PlayerKind::Paper];

/// Who plays in place of a scene's player, and how; what is none stays as the scene says.
///
/// Written as text it is `paper` or `paper@0.5`; a recording holds the kind alone or a table.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(from = "Form", into = "Form")]
pub struct Entrant {
    /// Who decides.
    pub kind: Option<PlayerKind>,
    /// Noise of the strokes, in multiples of the player's own.
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
    noise: Option<f64>,
}

impl From<Form> for Entrant {
    fn from(form: Form) -> Self {
        match form {
            Form::Kind(kind) => kind.into(),
            Form::Table(Table { kind, noise }) => Entrant { kind, noise },
        }
    }
}

impl From<Entrant> for Form {
    fn from(Entrant { kind, noise }: Entrant) -> Self {
        match (kind, noise) {
            (Some(kind), None) => Form::Kind(kind),
            _ => Form::Table(Table { kind, noise }),
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
        section.noise = self.noise.unwrap_or(section.noise);
    }
}

/// Why a text names no player; one line.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum NoEntrant {
    /// Nobody is called so.
    #[error("'{found}' is no computer player; write one of {}", kinds())]
    Kind {
        /// What was written.
        found: String,
    },
    /// What follows the @.
    #[error("'{found}' is no noise; write a number from 0 to 100 after the @, such as paper@0.5")]
    Noise {
        /// What was written.
        found: String,
    },
}

fn kinds() -> String {
    KINDS.map(PlayerKind::name).join(", ")
}

impl FromStr for Entrant {
    type Err = NoEntrant;

    fn from_str(text: &str) -> Result<Self, NoEntrant> {
        let (name, noise) = match text.split_once('@') {
            Some((name, noise)) => (name, Some(noise)),
            None => (text, None),
        };
        let kind = KINDS.into_iter().find(|kind| kind.name() == name);
        let kind = kind.ok_or_else(|| NoEntrant::Kind { found: name.into() })?;
        let noise = noise.map(|noise| {
            let number = noise.parse().ok().filter(|number| (0.0..=100.0).contains(number));
            number.ok_or_else(|| NoEntrant::Noise { found: noise.into() })
        });
        Ok(Entrant { kind: Some(kind), noise: noise.transpose()? })
    }
}

impl fmt::Display for Entrant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.kind.map_or("scene's", PlayerKind::name))?;
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
    }

    #[track_caller]
    fn check_error(text: &str, expected: &str) {
        let error = text.parse::<Entrant>().unwrap_err().to_string();
        assert!(error.contains(expected) && !error.contains('\n'), "{error}");
    }

    #[test]
    fn what_is_wrong_is_named_with_what_to_write() {
        check_error("papier", "'papier' is no computer player; write one of paper");
        check_error("human", "'human' is no computer player");
        check_error("paper@", "'' is no noise");
        check_error("paper@-1", "write a number from 0 to 100");
        check_error("paper@NaN", "'NaN' is no noise");
    }
}
