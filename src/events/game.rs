//! What players want and what the rules say.

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
    /// Put balls back on their spots, or as near behind them as there is room. From the rules.
    SpotBalls(SmallVec<[BallId; 4]>),
    /// Say what will be pocketed, or what kind of shot it is.
    Call(Call),
    /// Take one of the offered options.
    Choose(Choice),
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

/// Why a shot was not clean.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Foul {
    /// The cue ball is down.
    Scratch,
    /// The cue ball left the table.
    CueOff,
    /// The cue ball met no ball.
    NoContact,
    /// It met a wrong ball first.
    WrongFirst,
    /// No ball was pocketed or driven to a rail after the contact.
    NoRail,
    /// An object ball left the table.
    BallOff,
    /// The tip met the cue ball twice.
    DoubleHit,
    /// The tip was still on the cue ball when that met the object ball.
    Push,
    /// A ball was touched by something else.
    TouchedBall,
    /// The cue ball was put where it may not be.
    BadPlacement,
    /// Played from behind the head string at a ball that lies there too.
    Kitchen,
    /// A ball was still moving.
    Moving,
    /// The wrong player shot.
    OutOfTurn,
    /// Too few balls reached a rail on the break.
    IllegalBreak,
    /// The 8 fell before its time.
    EightEarly,
    /// The 8 fell into another pocket than called.
    EightWrongPocket,
    /// The third foul in a row.
    ThreeFouls,
    /// Snooker: a ball fell that was not on.
    BallNotOnPocketed,
}

/// What becomes of the turn.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TurnAfter {
    /// The same player shoots again.
    Continue,
    /// The other player shoots.
    #[default]
    Pass,
    /// The game is over.
    End,
}

/// What a player may choose after a shot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[allow(missing_docs)] // the names are the rule book's
pub enum Choice {
    Accept,
    CueInHandKitchen,
    RerackAndBreak,
    RerackOpponentBreaks,
    #[serde(rename = "respot8_continue")]
    Respot8Continue,
    #[serde(rename = "respot8_cue_in_hand_kitchen")]
    Respot8CueInHandKitchen,
    Rebreak,
    Shoot,
    PassBack,
    AskAgain,
    Play,
}

/// What the rules say about a shot.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Verdict {
    /// Who shot.
    pub player: Option<PlayerId>,
    /// No foul.
    pub legal: bool,
    /// All fouls, sorted.
    pub fouls: SmallVec<[Foul; 2]>,
    /// What becomes of the turn.
    pub turn: TurnAfter,
    /// Who shoots next; none when the game is over.
    pub next_player: Option<PlayerId>,
    /// The groups after the shot; none where a game has none.
    pub groups: Option<Groups>,
    /// Who won; a draw is [`TurnAfter::End`] without a winner.
    pub winner: Option<PlayerId>,
    /// For the next shot.
    pub ball_in_hand: BallInHand,
    /// Balls that return to the table.
    pub spot: SmallVec<[BallId; 4]>,
    /// Object balls that fell in this shot, in time order.
    pub pocketed: SmallVec<[BallId; 4]>,
}

/// A player is called to the table.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Turn {
    /// Who.
    pub player: PlayerId,
    /// To play what.
    pub shot: ShotKind,
    /// Whether the cue ball is in hand.
    pub ball_in_hand: BallInHand,
    /// Who plays which group; none where a game has none.
    pub groups: Option<Groups>,
    /// Object balls on the table, in ascending order.
    pub on_table: SmallVec<[BallId; 16]>,
    /// Object balls that the cue ball may meet first without a foul, in ascending order.
    pub legal_first: SmallVec<[BallId; 16]>,
    /// Counts the turns' shots of this game from 1.
    pub shot_number: u32,
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
