//! Facts: what physics saw happen.

use super::Topic;
use crate::ids::{BallId, PlayerId, PocketId, Rail};
use crate::units::Seconds;
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// Something that happened, and exactly when.
///
/// JSON: `{"t":0.15,"e":"hit","a":"0","b":"1"}`. The fields that rules do not need are optional in
/// rule files and always present in what physics writes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Fact {
    /// When [s].
    #[serde(rename = "t")]
    pub time_s: Seconds,
    /// What.
    #[serde(flatten)]
    pub kind: FactKind,
}

/// What happened.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(tag = "e")]
pub enum FactKind {
    /// A ball in hand was put down, or could not be: then `ok` is false and it stays in hand.
    #[serde(rename = "place")]
    BallPlaced {
        /// The ball.
        ball: BallId,
        /// Where it was allowed to be put.
        zone: super::Zone,
        /// False: outside the zone or on another ball.
        ok: bool,
    },
    /// A contact of the tip with a ball began: with the cue ball, whichever that is, or with one
    /// that may not be struck. A second one in one shot is a double hit.
    #[serde(rename = "tip")]
    CueBallStruck {
        /// The ball.
        ball: BallId,
        /// The tip was still on the ball when that met another, not frozen to it at the start.
        #[serde(default)]
        push: bool,
        /// A ball was still moving or spinning.
        #[serde(default)]
        moving: bool,
        /// Who struck, if it is not the player at the table.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        player: Option<PlayerId>,
        /// The tip slipped on the ball.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        miscue: bool,
        /// Point of contact [m].
        #[serde(default)]
        position_m: DVec3,
        /// Normal speed of approach [m/s].
        #[serde(default)]
        normal_speed_m_s: f64,
    },
    /// Two balls met; `a` is ball 0 if it is one of them.
    #[serde(rename = "hit")]
    BallsCollided {
        /// The first ball.
        a: BallId,
        /// The ball that was struck.
        b: BallId,
        /// `b` lies behind the head string.
        #[serde(default)]
        in_kitchen: bool,
        /// Point of contact [m].
        #[serde(default)]
        position_m: DVec3,
        /// Normal speed of approach [m/s].
        #[serde(default)]
        normal_speed_m_s: f64,
    },
    /// A ball met a cushion, its jaws included.
    #[serde(rename = "cushion")]
    CushionHit {
        /// The ball.
        ball: BallId,
        /// The rail that the cushion belongs to.
        rail: Rail,
        /// False: it already touched that rail and had not left it, so it was not driven there.
        #[serde(default = "yes")]
        onset: bool,
        /// Point of contact [m].
        #[serde(default)]
        position_m: DVec3,
        /// Normal speed of approach [m/s].
        #[serde(default)]
        normal_speed_m_s: f64,
    },
    /// The base of a ball crossed the head string towards the foot.
    #[serde(rename = "cross_head")]
    HeadStringCrossed {
        /// The ball.
        ball: BallId,
    },
    /// A ball is down and stays down.
    #[serde(rename = "pocket")]
    BallPocketed {
        /// The ball.
        ball: BallId,
        /// Where.
        pocket: PocketId,
        /// Its speed when it was counted as down [m/s].
        #[serde(default)]
        speed_m_s: f64,
    },
    /// A ball left the table: it met the floor, or came to rest beside the bed.
    #[serde(rename = "off")]
    BallOffTable {
        /// The ball.
        ball: BallId,
    },
    /// A ball was touched by anything but the tip's one forward stroke or another ball.
    #[serde(rename = "touch")]
    BallTouched {
        /// The ball.
        ball: BallId,
        /// By what.
        by: TouchedBy,
    },
    /// Two balls lie against each other, now that everything is at rest: told just before
    /// [`FactKind::Settled`].
    #[serde(rename = "frozen")]
    BallsFrozen {
        /// The one with the lower number.
        a: BallId,
        /// The other.
        b: BallId,
    },
    /// Everything is at rest and nothing spins.
    #[serde(rename = "settle")]
    Settled {
        /// Snooker: no ball on can be hit on both edges in a straight line.
        #[serde(default)]
        snookered: bool,
        /// Straight pool, one object ball or none is left: the cue ball lies where the others are
        /// racked, and so that it must be played from behind the head string.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        cue_in_rack: bool,
    },
}

/// What touched a ball against the rules.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TouchedBy {
    /// The tip, on a ball that is not the cue ball. The rules say so of what was struck.
    Tip,
    /// The shaft.
    Shaft,
    /// A hand.
    Hand,
    /// A haptic stylus.
    Stylus,
    /// Clothes, chalk, anything else.
    #[serde(other)]
    Other,
}

fn yes() -> bool {
    true
}

impl FactKind {
    /// The topic under which it can be subscribed.
    pub fn topic(&self) -> Topic {
        match self {
            FactKind::BallPlaced { .. } => Topic::BallPlaced,
            FactKind::CueBallStruck { .. } => Topic::CueBallStruck,
            FactKind::BallsCollided { .. } => Topic::BallsCollided,
            FactKind::CushionHit { .. } => Topic::CushionHit,
            FactKind::HeadStringCrossed { .. } => Topic::HeadStringCrossed,
            FactKind::BallPocketed { .. } => Topic::BallPocketed,
            FactKind::BallOffTable { .. } => Topic::BallOffTable,
            FactKind::BallTouched { .. } => Topic::BallTouched,
            FactKind::BallsFrozen { .. } => Topic::BallsFrozen,
            FactKind::Settled { .. } => Topic::Settled,
        }
    }

    /// The name of the variant, as the code and reports write it.
    pub fn name(&self) -> &'static str {
        match self {
            FactKind::BallPlaced { .. } => "BallPlaced",
            FactKind::CueBallStruck { .. } => "CueBallStruck",
            FactKind::BallsCollided { .. } => "BallsCollided",
            FactKind::CushionHit { .. } => "CushionHit",
            FactKind::HeadStringCrossed { .. } => "HeadStringCrossed",
            FactKind::BallPocketed { .. } => "BallPocketed",
            FactKind::BallOffTable { .. } => "BallOffTable",
            FactKind::BallTouched { .. } => "BallTouched",
            FactKind::BallsFrozen { .. } => "BallsFrozen",
            FactKind::Settled { .. } => "Settled",
        }
    }
}
