//! What a searching player is asked.

use crate::ball::BallState;
use crate::events::{Turn, Zone};
use crate::rules::Referee;
use std::sync::Arc;

/// A question, with all that its answer may depend on besides the player's own [`super::Mind`].
#[derive(Debug, Clone)]
pub struct Task {
    /// What is to be decided.
    pub kind: TaskKind,
    /// All balls as they lie, also those that do not; their orientations mean nothing.
    pub lies: Vec<BallState>,
    /// How the game stands, as everybody can know who heard what happened.
    pub referee: Referee,
    /// What the referee called for.
    pub turn: Arc<Turn>,
    /// The zone that the cue ball was put into in this turn.
    pub played_from: Option<Zone>,
    /// The other player was asked to play again, and this one has not played since.
    pub has_asked: bool,
    /// Seed of everything that the search leaves to chance.
    pub seed: u64,
}

/// What is to be decided.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TaskKind {
    /// The next stroke.
    Shoot,
    /// Where in this zone the cue ball is put down.
    Place(Zone),
    /// Which of the options is taken.
    Choose,
}
