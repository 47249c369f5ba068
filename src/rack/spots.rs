//! Spots: where balls return to the table.

use super::carom::carom_spot;
use super::spot_position;
use crate::ids::BallId;
use crate::table::Bed;
use glam::DVec2;

/// A ball that takes up room: its name, its middle and its radius [m].
pub type Occupied = (BallId, DVec2, f64);

/// The spots that a set of balls has.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub enum Spots {
    /// One for all: the foot spot.
    #[default]
    Foot,
    /// Carom: one for each ball.
    Carom,
}

impl Spots {
    /// Where a ball is spotted, given the others and the ball that is struck next. All in metres.
    pub fn place(
        self,
        bed: &Bed,
        ball: BallId,
        cue_ball: BallId,
        occupied: &[Occupied],
        radius_m: f64,
    ) -> DVec2 {
        match self {
            Spots::Foot => {
                let occupied = occupied.iter().map(|(_, place, other)| (*place, *other));
                spot_position(bed, occupied, radius_m)
            }
            Spots::Carom => carom_spot(bed, cue_ball, ball, occupied, radius_m),
        }
    }
}
