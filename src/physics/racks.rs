//! The racks of a game: what [`Command::Rack`](crate::events::Command::Rack) lays down.

use super::{Lie, Snapshot};
use crate::ball::{Ball, BallPlace, BallState, POOL_RADIUS_M};
use crate::events::{Racked, Racking};
use crate::ids::BallId;
use crate::rack::{CueBallGoes, Rack, RackError, next_rack};
use crate::table::{Bed, Table};
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// How the balls of a game are racked, as often as its rules ask for it.
#[derive(Debug, Clone)]
pub struct Racks {
    rack: Rack,
    /// Balls that stand elsewhere than the rack would put them, or that it does not have.
    apart: Vec<(Ball, BallState)>,
    bed: Option<Bed>,
}

impl Racks {
    /// This rack on this table, and over it each ball that stands apart.
    pub fn new(rack: Rack, apart: Vec<(Ball, BallState)>, table: &Table) -> Self {
        Racks { rack, apart, bed: table.bed }
    }

    /// The balls when the rack with this number is set up, in ascending order; the game began with
    /// number 0.
    ///
    /// # Errors
    /// [`RackError`] if the table has no spots, or a ball is named twice.
    pub fn balls(&self, serial: u32) -> Result<Vec<(Ball, BallState)>, RackError> {
        let table = Table { bed: self.bed, ..Table::default() };
        let mut balls = self.rack.again(serial).place(&table)?;
        balls.retain(|(ball, _)| self.apart.iter().all(|(other, _)| other.id != ball.id));
        balls.extend(self.apart.iter().cloned());
        balls.sort_by_key(|(ball, _)| ball.id);
        Ok(balls)
    }

    /// What is laid down on a table that looks like `table`. A ball that no rack has is taken off,
    /// so that nothing is in its way.
    pub(super) fn lies(&self, racking: Racking, table: &Snapshot) -> Arc<[Lie]> {
        match racking.balls {
            Racked::All => self.all(racking.serial, table),
            Racked::Fourteen => self.fourteen(racking.serial, table),
        }
    }

    fn all(&self, serial: u32, table: &Snapshot) -> Arc<[Lie]> {
        // It could be racked when the game began, on the same bed.
        let balls = self.balls(serial).unwrap_or_default();
        let lie = |seen: &BallState| {
            let racked = balls.iter().find(|(ball, _)| ball.id == seen.id);
            match racked {
                Some((_, state)) => Lie { orientation: seen.orientation, ..Lie::from(state) },
                None => Lie { place: BallPlace::InHand, ..Lie::from(seen) },
            }
        };
        table.balls.iter().map(lie).collect()
    }

    /// Straight pool goes on: see [`next_rack`].
    fn fourteen(&self, serial: u32, table: &Snapshot) -> Arc<[Lie]> {
        let Some(bed) = &self.bed else { return Arc::new([]) };
        let lies = table.balls.iter().map(|ball| {
            let is_there = ball.place == BallPlace::OnTable;
            (ball.id, is_there, ball.position)
        });
        let (cue_ball, left) = lying(lies);
        let rack = next_rack(bed, cue_ball, left, self.rack.seed(serial));
        let put = |seen: &BallState, place: BallPlace, at: Option<DVec2>| {
            let position = at.map_or(seen.position, |at| at.extend(self.radius_m(seen.id)));
            Lie { place, position, ..Lie::from(seen) }
        };
        let lie = |seen: &BallState| match rack.balls.iter().find(|(ball, _)| *ball == seen.id) {
            Some((_, at)) => Some(put(seen, BallPlace::OnTable, Some(*at))),
            None if seen.id != BallId::CUE => Some(put(seen, BallPlace::InHand, None)),
            None => match rack.cue_ball {
                CueBallGoes::Nowhere => None,
                CueBallGoes::To(at) => Some(put(seen, BallPlace::OnTable, Some(at))),
                CueBallGoes::InHand => Some(put(seen, BallPlace::InHand, None)),
            },
        };
        table.balls.iter().filter_map(lie).collect()
    }

    fn radius_m(&self, ball: BallId) -> f64 {
        let apart = self.apart.iter().find(|(other, _)| other.id == ball);
        apart.map_or(POOL_RADIUS_M, |(ball, _)| ball.radius_m)
    }
}

/// Where the cue ball lies, and the object ball that is left, of balls that are in play or not.
fn lying(
    balls: impl Iterator<Item = (BallId, bool, DVec3)>,
) -> (Option<DVec2>, Option<(BallId, DVec2)>) {
    let (mut cue_ball, mut left) = (None, None);
    for (ball, _, position) in balls.filter(|(_, is_there, _)| *is_there) {
        match ball {
            BallId::CUE => cue_ball = Some(position.truncate()),
            _ => left = left.or(Some((ball, position.truncate()))),
        }
    }
    (cue_ball, left)
}

/// Whether the next rack of straight pool takes the cue ball up from where it lies: one object ball
/// of fifteen is left, or none. In any other world it is not.
pub(super) fn cue_in_rack(
    bed: Option<&Bed>,
    balls: impl ExactSizeIterator<Item = (BallId, bool, DVec3)> + Clone,
) -> bool {
    let is_full = balls.len() == 16 && balls.clone().map(|(ball, ..)| ball.0).eq(0..16);
    let left = balls.clone().filter(|(ball, is_there, _)| *is_there && *ball != BallId::CUE);
    let (Some(bed), true, true) = (bed, is_full, left.count() <= 1) else { return false };
    let (cue_ball, left) = lying(balls);
    cue_ball.is_some() && next_rack(bed, cue_ball, left, 0).cue_ball == CueBallGoes::InHand
}
