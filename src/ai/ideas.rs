//! What geometry proposes: shots that might be worth a simulation.

use super::noise::StrokeNoise;
use super::plan::{Goal, Line};
use super::view::TableView2d;
use crate::events::Zone;
use crate::ids::{BallId, PocketId};
use glam::DVec2;
use rand::Rng;
use smallvec::SmallVec;

/// What sort of shot an idea is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum IdeaKind {
    /// A ball straight into a pocket.
    Pot,
    /// A ball into a pocket by another one.
    Combination,
    /// A ball into a pocket by one cushion.
    Bank,
    /// The cue ball by one cushion to a ball.
    Kick,
    /// A ball into a pocket by the cue ball, or another ball, that comes off a first one; in carom
    /// the cue ball to both others.
    Carom,
    /// Meet a ball, full or thin, to pocket nothing.
    Contact,
    /// Open the rack.
    Break,
    /// Nothing can be reached: the least bad.
    Desperate,
}

/// A shot that might be worth a simulation.
#[derive(Debug, Clone, PartialEq)]
pub struct Idea {
    /// What sort.
    pub kind: IdeaKind,
    /// The ball that the cue ball meets first.
    pub first: Option<BallId>,
    /// The ball that shall fall, or, where none falls, be met last.
    pub ball: Option<BallId>,
    /// The pocket that it shall fall into.
    pub pocket: Option<PocketId>,
    /// Where the cue ball sets out to; unit vector.
    pub direction: DVec2,
    /// Middle of the cue ball at its first meeting with a ball [m].
    pub ghost: DVec2,
    /// Where the first ball shall go, for pots and combinations, where that is what aiming is
    /// about; unit vector.
    pub first_way: Option<DVec2>,
    /// Cut at the first ball, anticlockwise positive [rad].
    pub cut_rad: f64,
    /// Way of the cue ball to the first ball [m].
    pub to_ball_m: f64,
    /// Way of balls from there to the end [m].
    pub to_end_m: f64,
    /// Cushions on both ways together.
    pub cushions: u8,
    /// Speed of the tip that just does it [m/s].
    pub speed_least_m_s: f64,
    /// Chance that it works for a player with this noise, estimated; for ranking.
    pub chance: f64,
    /// The ways, to be drawn.
    pub lines: SmallVec<[Line; 4]>,
}

/// Which ideas are wanted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Repertoire {
    /// Pots, and meeting a ball.
    Plain,
    /// Everything.
    Full,
}

/// Shots from a cue ball at `cue`, best chance first. Never empty.
pub fn ideas(
    _view: &TableView2d,
    _cue: DVec2,
    _goal: &Goal,
    _noise: &StrokeNoise,
    _repertoire: Repertoire,
) -> Vec<Idea> {
    Vec::new()
}

/// Places for a cue ball in hand in `zone`, best first [m]; all have room.
pub fn spots(
    _view: &TableView2d,
    _zone: Zone,
    _goal: &Goal,
    _noise: &StrokeNoise,
    _rng: &mut impl Rng,
) -> Vec<DVec2> {
    Vec::new()
}
