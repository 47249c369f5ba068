//! Who decides for a player, by name.

use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// Who decides for a player.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PlayerKind {
    /// Somebody at the input.
    Human,
    /// The computer player of the paper: geometry from above, no look into the future.
    Paper,
    /// A computer that tries its best few ideas on a table of its own.
    Club,
    /// A computer that tries all of them, and looks at the shot after.
    Champion,
    /// A computer of a strength between 0 and [`STRENGTH_MAX`].
    Computer(u8),
    /// A recording, which the input plays back.
    Recorded,
}

/// The greatest strength of a computer.
pub const STRENGTH_MAX: u8 = 100;
/// The strength of a computer for which none is given.
pub const STRENGTH_USUAL: u8 = 50;

impl PlayerKind {
    /// Every kind, as a scene may name it.
    pub const ALL: [PlayerKind; 6] = [
        PlayerKind::Human,
        PlayerKind::Paper,
        PlayerKind::Club,
        PlayerKind::Champion,
        PlayerKind::Computer(STRENGTH_USUAL),
        PlayerKind::Recorded,
    ];

    /// Its name in a scene; a computer's strength is a key of its own.
    pub fn name(self) -> &'static str {
        match self {
            PlayerKind::Human => "human",
            PlayerKind::Paper => "paper",
            PlayerKind::Club => "club",
            PlayerKind::Champion => "champion",
            PlayerKind::Computer(_) => "computer",
            PlayerKind::Recorded => "recorded",
        }
    }

    /// Whether a computer decides.
    pub fn is_computer(self) -> bool {
        match self {
            PlayerKind::Human | PlayerKind::Recorded => false,
            PlayerKind::Paper
            | PlayerKind::Club
            | PlayerKind::Champion
            | PlayerKind::Computer(_) => true,
        }
    }
}

/// As a command line names it: a strength is a number.
impl fmt::Display for PlayerKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            PlayerKind::Computer(strength) => strength.fmt(f),
            kind => f.pad(kind.name()),
        }
    }
}

/// No computer player has this name.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "no computer player is called {0:?}: write paper, club, champion, or a strength from 0 to \
     {STRENGTH_MAX}"
)]
pub struct UnknownComputer(pub String);

/// A computer player: its kind, or its strength as a number.
impl FromStr for PlayerKind {
    type Err = UnknownComputer;

    fn from_str(text: &str) -> Result<Self, UnknownComputer> {
        let named = [PlayerKind::Paper, PlayerKind::Club, PlayerKind::Champion];
        let strength = || text.parse().ok().filter(|strength| *strength <= STRENGTH_MAX);
        let named = named.into_iter().find(|kind| kind.name() == text);
        named
            .or_else(|| strength().map(PlayerKind::Computer))
            .ok_or_else(|| UnknownComputer(text.to_string()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_computer_is_named_by_its_kind_or_by_its_strength() {
        for text in ["paper", "club", "champion", "0", "37", "100"] {
            let kind: PlayerKind = text.parse().unwrap();
            assert!(kind.is_computer());
            assert_eq!(kind.to_string(), text);
        }
        for wrong in ["human", "recorded", "101", "-1", "5.5", "", "Paper"] {
            let error = wrong.parse::<PlayerKind>().unwrap_err().to_string();
            assert!(error.contains("or a strength from 0 to 100"), "{error}");
        }
    }

    #[test]
    fn a_recording_keeps_every_kind() {
        for kind in PlayerKind::ALL {
            let json = serde_json::to_string(&kind).unwrap();
            assert_eq!(serde_json::from_str::<PlayerKind>(&json).unwrap(), kind, "{json}");
        }
        assert_eq!(serde_json::to_string(&PlayerKind::Paper).unwrap(), "\"paper\"");
        assert_eq!(serde_json::to_string(&PlayerKind::Computer(70)).unwrap(), "{\"computer\":70}");
    }
}
