//! What players want, and what is said in a game.

use super::Choice;
use crate::cue::CuePath;
use crate::ids::{BallId, PlayerId, PocketId};
use glam::DVec2;
use serde::{Deserialize, Serialize};
use smallvec::SmallVec;
use std::sync::Arc;

/// Something a player, or the rules, want done. It acts at its tick.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Command {
    /// Lead the cue along a path from now on.
    MoveCue(Arc<CuePath>),
    /// Take the cue away from the table.
    LiftCue,
    /// Put a ball down on the bed. Physics answers with [`super::FactKind::BallPlaced`].
    PlaceBall {
        /// The ball.
        ball: BallId,
        /// Where on the bed [m].
        position_m: DVec2,
        /// Where it may be put.
        zone: Zone,
    },
    /// Put balls back on their spots. From the rules.
    SpotBalls(Spotting),
    /// Rack balls anew. From the rules.
    Rack(Racking),
    /// Put the balls back where they lay before the last shot; training.
    Undo,
    /// Say what will be pocketed, or what kind of shot it is.
    Call(Call),
    /// Take one of the offered options.
    Choose(Choice),
}

/// Which balls return to the table.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Spotting {
    /// The balls.
    pub balls: SmallVec<[BallId; 4]>,
    /// The ball that is struck next: in carom the other ones' spots depend on it.
    #[serde(default)]
    pub cue_ball: BallId,
}

/// Which balls are racked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Racking {
    /// Counts the racks of a game from 0, which it began with: each stands a little otherwise.
    pub serial: u32,
    /// All of them, or those that fell.
    pub balls: Racked,
}

/// How much of a rack is set up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Racked {
    /// Every ball, as at the start of a game.
    All,
    /// Straight pool: fourteen balls without the apex, or all if none is left. The one that is
    /// left, and the cue ball, stay where they are unless they are in the way: see
    /// [`crate::rack::next_rack`].
    Fourteen,
}

/// Where a ball may be put.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Zone {
    /// Behind the head string.
    Kitchen,
    /// Anywhere on the bed.
    #[default]
    Anywhere,
    /// In snooker's D.
    D,
}

/// Whether the next player has the cue ball in hand.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BallInHand {
    /// No: it is played from where it lies.
    #[default]
    None,
    /// Behind the head string.
    Kitchen,
    /// Anywhere on the bed.
    Anywhere,
    /// In snooker's D.
    D,
}

impl BallInHand {
    /// The zone, if the ball is in hand.
    pub fn zone(self) -> Option<Zone> {
        match self {
            BallInHand::None => None,
            BallInHand::Kitchen => Some(Zone::Kitchen),
            BallInHand::Anywhere => Some(Zone::Anywhere),
            BallInHand::D => Some(Zone::D),
        }
    }
}

/// What a player announces before a shot.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Call {
    /// A ball and the pocket it will go to; snooker names only the ball.
    Ball {
        /// The ball.
        ball: BallId,
        /// Its pocket.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        pocket: Option<PocketId>,
    },
    /// A kind of shot.
    Kind(CallKind),
}

/// A kind of shot that is announced.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CallKind {
    /// The turn passes whatever falls.
    Safety,
    /// Nine-ball, after the break: order and rails do not matter.
    PushOut,
    /// Nothing: what was announced before is taken back.
    Nothing,
}

/// What a player may announce before a shot.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Calls {
    /// A ball.
    pub ball: bool,
    /// The pocket of that ball.
    pub pocket: bool,
    /// A safety.
    pub safety: bool,
    /// A push-out.
    pub push_out: bool,
}

/// Something that each of two players has. JSON: `{"1":…,"2":…}`.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct ByPlayer<T: Default> {
    /// Player 1's.
    #[serde(rename = "1")]
    pub one: T,
    /// Player 2's.
    #[serde(rename = "2")]
    pub two: T,
}

impl<T: Copy + Default + PartialEq> ByPlayer<T> {
    /// A player's.
    pub fn of(&self, player: PlayerId) -> T {
        if player == PlayerId::ONE { self.one } else { self.two }
    }

    /// The same with another value for a player.
    #[must_use]
    pub fn with(mut self, player: PlayerId, value: T) -> Self {
        match player {
            PlayerId::ONE => self.one = value,
            _ => self.two = value,
        }
        self
    }

    /// Whether nobody has anything.
    pub fn is_nothing(&self) -> bool {
        *self == Self::default()
    }
}

/// What is on in snooker. JSON: `"red"`, `"colour"` or the name of a ball.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BallOn {
    /// Any red.
    Red,
    /// Any colour, to be nominated.
    Colour,
    /// This ball.
    Ball(BallId),
}

impl BallOn {
    /// Whether a ball of snooker is on, if any colour will do where one must be nominated.
    pub fn is(self, ball: BallId) -> bool {
        match self {
            BallOn::Red => (1..=15).contains(&ball.0),
            BallOn::Colour => (16..=21).contains(&ball.0),
            BallOn::Ball(on) => ball == on,
        }
    }
}

impl Serialize for BallOn {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            BallOn::Red => serializer.serialize_str("red"),
            BallOn::Colour => serializer.serialize_str("colour"),
            BallOn::Ball(ball) => ball.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for BallOn {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let word = String::deserialize(deserializer)?;
        match word.as_str() {
            "red" => Ok(BallOn::Red),
            "colour" => Ok(BallOn::Colour),
            _ => word.parse().map(|ball| BallOn::Ball(BallId(ball))).map_err(|_| {
                serde::de::Error::custom(format!("'{word}': expected red, colour or a ball"))
            }),
        }
    }
}

/// The kind of shot that a turn begins with.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ShotKind {
    /// The first of a rack.
    Break,
    /// Any other.
    #[default]
    Normal,
    /// An announced push-out.
    PushOut,
}

/// Solids or stripes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Group {
    /// 1 to 7.
    Solids,
    /// 9 to 15.
    Stripes,
}

impl Group {
    /// The balls of this group among others, in their order.
    pub fn among(self, balls: &[BallId]) -> impl Iterator<Item = BallId> {
        balls.iter().copied().filter(move |ball| Group::of(*ball) == Some(self))
    }

    /// The group of a pool ball; none for the cue ball and the 8.
    pub fn of(ball: BallId) -> Option<Self> {
        match ball.0 {
            1..=7 => Some(Group::Solids),
            9..=15 => Some(Group::Stripes),
            _ => None,
        }
    }

    /// The other one.
    pub fn other(self) -> Self {
        match self {
            Group::Solids => Group::Stripes,
            Group::Stripes => Group::Solids,
        }
    }
}

/// Who plays which group. JSON: `"open"` or `{"1":"solids","2":"stripes"}`.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "GroupsForm", into = "GroupsForm")]
pub enum Groups {
    /// Nobody yet.
    #[default]
    Open,
    /// Player 1 has this group, player 2 the other.
    Assigned {
        /// Player 1's.
        one: Group,
    },
}

impl Groups {
    /// The group of a player.
    pub fn of(self, player: PlayerId) -> Option<Group> {
        match self {
            Groups::Open => None,
            Groups::Assigned { one } if player == PlayerId::ONE => Some(one),
            Groups::Assigned { one } => Some(one.other()),
        }
    }

    /// `player` has `group`.
    pub fn assigned(player: PlayerId, group: Group) -> Self {
        Groups::Assigned { one: if player == PlayerId::ONE { group } else { group.other() } }
    }
}

#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum GroupsForm {
    Word(OpenWord),
    Table {
        #[serde(rename = "1")]
        one: Group,
        #[serde(rename = "2")]
        two: Group,
    },
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum OpenWord {
    Open,
}

impl From<Groups> for GroupsForm {
    fn from(groups: Groups) -> Self {
        match groups {
            Groups::Open => GroupsForm::Word(OpenWord::Open),
            Groups::Assigned { one } => GroupsForm::Table { one, two: one.other() },
        }
    }
}

impl TryFrom<GroupsForm> for Groups {
    type Error = String;

    fn try_from(form: GroupsForm) -> Result<Self, String> {
        match form {
            GroupsForm::Word(_) => Ok(Groups::Open),
            GroupsForm::Table { one, two } if one != two => Ok(Groups::Assigned { one }),
            GroupsForm::Table { .. } => Err("both players have the same group".into()),
        }
    }
}

/// Where a computer player stands in its turn (paper, section 5.4).
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PlayerState {
    /// Not at the table.
    #[default]
    Idle,
    /// Pauses, as if thinking it over.
    Lazing,
    /// Leads the cue to where it will strike.
    Aiming,
    /// Strokes.
    Shooting,
    /// Watches the balls.
    Analyzing,
    /// Has seen the shot's end.
    Done,
}

/// A player's state changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct PlayerReport {
    /// Who.
    pub player: PlayerId,
    /// Now.
    pub state: PlayerState,
}

/// What a menu can ask for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MenuAction {
    /// Time stands still.
    Pause,
    /// It goes on.
    Resume,
    /// The game ends here.
    Quit,
}

/// The runtime reports on itself.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Health {
    /// An actor failed.
    ActorFailed {
        /// Its name.
        actor: String,
        /// Why.
        reason: String,
    },
    /// Another one took its place, and lost nothing.
    ActorRestarted {
        /// Its name.
        actor: String,
    },
    /// Something that was asked of the operating system or a device was not given; the game does
    /// without it.
    Refused {
        /// Which actor asked.
        actor: String,
        /// For what.
        asked: String,
        /// Why it was refused.
        reason: String,
        /// What would help.
        remedy: String,
    },
    /// A queue was full: how many were dropped so far.
    QueueFull {
        /// Its name.
        queue: String,
        /// Dropped since the start.
        dropped: u64,
    },
}
