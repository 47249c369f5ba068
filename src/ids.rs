//! Names of things: balls, pockets, rails, players.

mod game;

pub(crate) use game::for_all_games;
pub use game::{GameKind, UnknownGame};

use serde::de::{Error, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;

/// A ball. 0 is the cue ball, 1 to 15 are the object balls of pool; a scene may have more.
///
/// In JSON it is a string (`"0"`), as rule files write it.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BallId(pub u16);

impl BallId {
    /// The ball that the cue may strike.
    pub const CUE: BallId = BallId(0);
    /// The black ball of eight-ball.
    pub const EIGHT: BallId = BallId(8);
    /// The ball that decides nine-ball.
    pub const NINE: BallId = BallId(9);
}

impl fmt::Display for BallId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl Serialize for BallId {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for BallId {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        // A visitor and no untagged enum: that would hide that a field is missing at all.
        struct BallVisitor;

        impl Visitor<'_> for BallVisitor {
            type Value = BallId;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a ball: a whole number from 0 to 65535")
            }

            fn visit_str<E: Error>(self, text: &str) -> Result<BallId, E> {
                text.parse().map(BallId).map_err(|_| no_ball(&text))
            }

            // Scene files may write the plain number.
            fn visit_u64<E: Error>(self, number: u64) -> Result<BallId, E> {
                u16::try_from(number).map(BallId).map_err(|_| no_ball(&number))
            }

            fn visit_i64<E: Error>(self, number: i64) -> Result<BallId, E> {
                u16::try_from(number).map(BallId).map_err(|_| no_ball(&number))
            }
        }

        fn no_ball<E: Error>(what: &dyn fmt::Display) -> E {
            E::custom(format!("'{what}' is no ball: a whole number from 0 to 65535 expected"))
        }

        deserializer.deserialize_any(BallVisitor)
    }
}

/// A pocket, seen from the head of the table: head, middle or foot; left or right.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
pub enum PocketId {
    /// Head left: −x, +y.
    Hl,
    /// Head right: −x, −y.
    Hr,
    /// Middle left: +y.
    Ml,
    /// Middle right: −y.
    Mr,
    /// Foot left: +x, +y.
    Fl,
    /// Foot right: +x, −y.
    Fr,
}

impl PocketId {
    /// All pockets, in their fixed order.
    pub const ALL: [PocketId; 6] = [Self::Hl, Self::Hr, Self::Ml, Self::Mr, Self::Fl, Self::Fr];

    /// Whether this is one of the two in the middle of the long rails.
    pub fn is_side(self) -> bool {
        matches!(self, Self::Ml | Self::Mr)
    }
}

impl fmt::Display for PocketId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Hl => "HL",
            Self::Hr => "HR",
            Self::Ml => "ML",
            Self::Mr => "MR",
            Self::Fl => "FL",
            Self::Fr => "FR",
        })
    }
}

/// A rail, seen from the head of the table, which lies at −x; left is +y.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Rail {
    /// At −x.
    Head,
    /// At +x.
    Foot,
    /// At +y.
    Left,
    /// At −y.
    Right,
}

impl Rail {
    /// All rails, in their fixed order.
    pub const ALL: [Rail; 4] = [Self::Head, Self::Foot, Self::Left, Self::Right];

    /// Its bit in a set of rails.
    pub fn bit(self) -> u8 {
        1 << self as u8
    }
}

/// A player: 1 or 2. Who breaks first is player 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct PlayerId(pub u8);

impl PlayerId {
    /// The player who breaks in the first rack.
    pub const ONE: PlayerId = PlayerId(1);
    /// The other player.
    pub const TWO: PlayerId = PlayerId(2);

    /// The opponent in a game of two.
    pub fn other(self) -> Self {
        if self == Self::ONE { Self::TWO } else { Self::ONE }
    }

    /// Place in an array of two.
    pub fn index(self) -> usize {
        usize::from(self != Self::ONE)
    }
}

impl Default for PlayerId {
    fn default() -> Self {
        PlayerId::ONE
    }
}

impl fmt::Display for PlayerId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}
