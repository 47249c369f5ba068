//! The visible world at one time: what everybody can see.

use crate::ball::{BallPlace, BallState};
use crate::cue::CuePose;
use crate::ids::BallId;
use crate::units::Seconds;

/// A slower ball seems to lie [m/s].
const SLOW_M_S: f64 = 0.005;

/// All balls and the cue at one time.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Snapshot {
    /// The time [s].
    pub time_s: Seconds,
    /// All balls, those that are out of play included, in ascending order of id.
    pub balls: Vec<BallState>,
    /// The cue, if it is at the table.
    pub cue: Option<CuePose>,
}

impl Snapshot {
    /// The state of one ball.
    pub fn ball(&self, id: BallId) -> Option<&BallState> {
        self.balls.binary_search_by_key(&id, |ball| ball.id).ok().map(|i| &self.balls[i])
    }

    /// Whether any ball is seen to move.
    pub fn is_rolling(&self) -> bool {
        self.on_table().any(|ball| SLOW_M_S < ball.velocity.length())
    }

    /// The balls in play.
    pub fn on_table(&self) -> impl Iterator<Item = &BallState> + Clone {
        self.balls.iter().filter(|ball| ball.place == BallPlace::OnTable)
    }
}
