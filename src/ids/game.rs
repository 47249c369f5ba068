//! Names of games.

use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};
use std::fmt;
use std::str::FromStr;

/// A game whose rules are known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum GameKind {
    /// The reduced eight-ball of the 2009 paper (section 5.2).
    PaperEightBall,
    /// Everybody for himself, without fouls.
    FreePlay,
}

impl GameKind {
    /// All games.
    pub const ALL: [GameKind; 2] = [GameKind::PaperEightBall, GameKind::FreePlay];

    /// Its name in scene files.
    pub fn id(self) -> &'static str {
        match self {
            GameKind::PaperEightBall => "paper-eight-ball",
            GameKind::FreePlay => "free-play",
        }
    }

    /// Its name in JSON.
    pub fn short_id(self) -> &'static str {
        match self {
            GameKind::PaperEightBall => "paper8",
            GameKind::FreePlay => "free_play",
        }
    }
}

impl fmt::Display for GameKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.id())
    }
}

/// No game has this name.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("unknown game '{name}'; the games are {}", known_games())]
pub struct UnknownGame {
    /// What was asked for.
    pub name: String,
}

fn known_games() -> String {
    GameKind::ALL.map(|game| format!("'{}' (short '{}')", game.id(), game.short_id())).join(", ")
}

impl FromStr for GameKind {
    type Err = UnknownGame;

    fn from_str(name: &str) -> Result<Self, UnknownGame> {
        GameKind::ALL
            .into_iter()
            .find(|game| name == game.id() || name == game.short_id())
            .ok_or_else(|| UnknownGame { name: name.into() })
    }
}

impl Serialize for GameKind {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.short_id())
    }
}

impl<'de> Deserialize<'de> for GameKind {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        String::deserialize(deserializer)?.parse().map_err(D::Error::custom)
    }
}
