//! The racks of a game: what [`Command::Rack`](crate::events::Command::Rack) lays down.

use super::{Lie, Snapshot};
use crate::ball::{Ball, BallPlace, BallState};
use crate::events::{Racked, Racking};
use crate::rack::{Rack, RackError};
use crate::table::{Bed, Table};
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
            Racked::Fourteen => Arc::new([]),
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
}
