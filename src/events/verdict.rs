//! What the rules say: verdicts and turns.

use super::{BallInHand, BallOn, ByPlayer, Calls, Groups, Racked, ShotKind};
use crate::ids::{BallId, PlayerId};
use serde::{Deserialize, Serialize};
use smallvec::SmallVec;

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

impl TurnAfter {
    /// What becomes of the turn of `player` when `next` shoots.
    pub fn before(player: PlayerId, next: PlayerId) -> Self {
        if next == player { TurnAfter::Continue } else { TurnAfter::Pass }
    }
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
    PutBack,
    SpotFrozen,
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
    /// Balls that return to the table; where a choice decides, those that would.
    pub spot: SmallVec<[BallId; 4]>,
    /// Object balls that fell in this shot, in time order.
    pub pocketed: SmallVec<[BallId; 4]>,
    /// Who chooses how it goes on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub chooser: Option<PlayerId>,
    /// Between what; nothing if there is no choice.
    #[serde(skip_serializing_if = "SmallVec::is_empty")]
    pub options: SmallVec<[Choice; 3]>,
    /// Fouls in a row, where a game counts them.
    #[serde(skip_serializing_if = "ByPlayer::is_nothing")]
    pub fouls_after: ByPlayer<u8>,
    /// Points that this shot added.
    #[serde(skip_serializing_if = "ByPlayer::is_nothing")]
    pub points: ByPlayer<i32>,
    /// Snooker: what is on next.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ball_on_next: Option<BallOn>,
    /// Snooker: the next player may nominate any ball.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub free_ball: bool,
    /// Balls that are racked now.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rack: Option<Racked>,
}

impl Verdict {
    /// Balls that return to the table at once; none where that is a matter of choice.
    pub fn spotted_now(&self) -> &[BallId] {
        let decides = |choice| {
            matches!(
                choice,
                Choice::Respot8Continue | Choice::Respot8CueInHandKitchen | Choice::SpotFrozen
            )
        };
        if self.options.iter().copied().any(decides) { &[] } else { &self.spot }
    }
}

/// A player is called to the table: to shoot, or to choose if there are options.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
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
    /// What the player must choose from before anybody shoots; nothing if there is no choice.
    #[serde(skip_serializing_if = "SmallVec::is_empty")]
    pub options: SmallVec<[Choice; 3]>,
    /// What may be called.
    pub calls: Calls,
    /// The ball that the player strikes.
    pub cue_ball: BallId,
    /// Points so far, where a game has them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub score: Option<ByPlayer<i32>>,
    /// Snooker: what is on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub on: Option<BallOn>,
    /// Snooker: any ball may be nominated as if it were on.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub free_ball: bool,
    /// The player has been told that the next foul is the third in a row.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub warned: bool,
}
