//! Names of games.

use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};
use std::fmt;
use std::str::FromStr;

/// All games: the name in code, in scene files, in JSON, that of the rack that a scene begins with
/// (none if any balls will do), and the file in `src/rules/games`. A new game is a file there and a
/// line here.
macro_rules! for_all_games {
    ($then:ident) => {
        $then! {
            /// The reduced eight-ball of the 2009 paper (section 5.2).
            PaperEightBall "paper-eight-ball" "paper8" "eight-ball" paper_eight_ball;
            /// Eight-ball by the rules of the WPA.
            WpaEightBall "wpa-eight-ball" "wpa8" "eight-ball" wpa_eight_ball;
            /// Nine-ball by the rules of the WPA.
            WpaNineBall "wpa-nine-ball" "wpa9" "nine-ball" wpa_nine_ball;
            /// Straight pool, 14.1 continuous, by the rules of the WPA.
            Straight "straight" "straight" "eight-ball" straight;
            /// Snooker by the rules of the WPBSA.
            Snooker "snooker" "snooker" "snooker" snooker;
            /// Both other balls, and three cushions before the second.
            ThreeCushion "three-cushion" "three_cushion" "carom" three_cushion;
            /// Both other balls.
            FreeCarom "free-carom" "free_carom" "carom" free_carom;
            /// Everybody for himself, without fouls.
            FreePlay "free-play" "free_play" "" free_play;
            /// Practice: any ball is put anywhere, shots are taken back.
            Training "training" "training" "" training;
        }
    };
}
pub(crate) use for_all_games;

macro_rules! kinds {
    ($($(#[$about:meta])* $kind:ident $id:literal $short:literal $rack:literal $file:ident;)*) => {
        /// A game whose rules are known.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum GameKind {
            $($(#[$about])* $kind,)*
        }

        impl GameKind {
            /// All games.
            pub const ALL: [GameKind; [$($id),*].len()] = [$(GameKind::$kind),*];

            /// Its name in scene files.
            pub fn id(self) -> &'static str {
                match self {
                    $(GameKind::$kind => $id,)*
                }
            }

            /// Its name in JSON.
            pub fn short_id(self) -> &'static str {
                match self {
                    $(GameKind::$kind => $short,)*
                }
            }

            fn named_rack(self) -> &'static str {
                match self {
                    $(GameKind::$kind => $rack,)*
                }
            }
        }
    };
}

for_all_games!(kinds);

impl GameKind {
    /// The rack that a scene of the game begins with, by its name there; none if any balls will do.
    pub fn rack(self) -> Option<&'static str> {
        Some(self.named_rack()).filter(|name| !name.is_empty())
    }

    /// How many play at least; never more than two.
    pub fn players_min(self) -> usize {
        if self.rack().is_some() { 2 } else { 1 }
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
