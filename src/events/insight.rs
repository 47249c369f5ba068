//! A look into a computer player's mind, for whoever watches: no core hears it, no hash contains it
//! and no recording keeps it.

use crate::ids::{BallId, PlayerId, PocketId};
use glam::DVec2;
use serde::{Deserialize, Serialize};
use smallvec::SmallVec;

/// What a player saw and weighed when it decided on a stroke (paper, figure 5.2).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Insight {
    /// Who.
    pub player: PlayerId,
    /// Where the cue ball lay [m].
    pub cue_ball: DVec2,
    /// The ways that were examined.
    pub ways: Vec<Way>,
    /// The shots that were considered, at most one of them chosen.
    pub prospects: Vec<Prospect>,
}

impl Insight {
    /// The shot that is going to be played.
    pub fn chosen(&self) -> Option<&Prospect> {
        self.prospects.iter().find(|prospect| prospect.is_chosen)
    }
}

/// A straight way of a ball over the cloth.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Way {
    /// Where it begins [m].
    pub from: DVec2,
    /// Where it ends [m].
    pub to: DVec2,
    /// What it leads to.
    pub leads_to: WayEnd,
    /// No ball is in the way.
    pub is_free: bool,
    /// It belongs to the shot that is played.
    pub is_chosen: bool,
}

/// Where a way leads.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum WayEnd {
    /// From the cue ball to a ball.
    Ball(BallId),
    /// From this ball to a pocket.
    Pocket(BallId, PocketId),
}

/// What a shot is meant to do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum IdeaKind {
    /// A ball straight into a pocket.
    Pot,
    /// A ball into a pocket by another one.
    Combination,
    /// A ball into a pocket by one cushion.
    Bank,
    /// The cue ball by a cushion to a ball.
    Kick,
    /// A ball into a pocket by the cue ball that comes off a first one; in carom the cue ball to
    /// both others.
    Carom,
    /// Meet a ball, full or thin, to pocket nothing.
    Contact,
    /// Open the rack.
    Break,
    /// Nothing can be reached: the least bad.
    Desperate,
}

/// A shot that a player has considered.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Prospect {
    /// What sort of shot.
    pub kind: IdeaKind,
    /// The ball that shall fall, or that shall be met if none shall fall.
    pub ball: Option<BallId>,
    /// The pocket that the ball shall fall into; none if none shall fall.
    pub pocket: Option<PocketId>,
    /// The middle of the cue ball when it meets its first ball [m].
    pub ghost: DVec2,
    /// The ways of its balls.
    pub ways: SmallVec<[Way; 4]>,
    /// The chance to succeed under the player's own noise, 0 to 1; none if it was not estimated.
    pub chance: Option<f64>,
    /// The chance that it is no foul, 0 to 1; none if it was not estimated.
    pub legal: Option<f64>,
    /// What the shot is worth to the player, the larger the better; none if it was not estimated.
    pub value: Option<f64>,
    /// How often it was simulated.
    pub samples: u32,
    /// It is going to be played.
    pub is_chosen: bool,
}

impl Prospect {
    /// The ball that shall fall, and where.
    pub fn pot(&self) -> Option<(BallId, PocketId)> {
        self.ball.zip(self.pocket)
    }
}
