//! Ball in hand: where the mouse holds a ball, and whether it may lie there.

use super::sight::{others, place_of};
use crate::events::Zone;
use crate::ids::BallId;
use crate::physics::{Snapshot, may_stand};
use crate::table::{Bed, Table};
use glam::DVec2;

/// A ball is in hand.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Placing {
    /// Which.
    pub ball: BallId,
    /// Where it may be put.
    pub zone: Zone,
    /// Where it is held [m].
    pub at: DVec2,
    /// It was put down, and physics has not answered.
    pub is_put: bool,
}

impl Placing {
    /// Takes the ball up from where it lies, or brings it to its zone; to the tee [m] where there
    /// is no bed.
    pub fn new(
        ball: BallId,
        zone: Zone,
        on_table: &Snapshot,
        bed: Option<&Bed>,
        tee: DVec2,
    ) -> Self {
        let lies = place_of(on_table, ball).map(|ball| ball.truncate());
        let home = bed.map_or(tee, |bed| bed.home(zone));
        let in_zone = |place: &DVec2| bed.is_none_or(|bed| bed.in_zone(zone, *place));
        Placing { ball, zone, at: lies.filter(in_zone).unwrap_or(home), is_put: false }
    }

    /// Moves it; it does not leave the bed.
    pub fn moved(&mut self, by: DVec2, bed: Option<&Bed>, radius_m: f64) {
        self.hold_at(self.at + by, bed, radius_m);
    }

    /// Holds it there [m]; it does not leave the bed.
    pub fn hold_at(&mut self, at: DVec2, bed: Option<&Bed>, radius_m: f64) {
        self.at = at;
        if let Some(bed) = bed {
            let half = bed.half() - DVec2::splat(radius_m);
            self.at = self.at.clamp(-half, half);
        }
    }

    /// Whether it may lie where it is held: in its zone, on the bed, on no other ball.
    pub fn is_allowed(&self, on_table: &Snapshot, table: &Table, radius_m: f64) -> bool {
        // A ball's middle lies its radius above the bed.
        let others = others(on_table, self.ball).map(|ball| (ball, ball.z));
        let bed = table.bed.as_ref();
        may_stand(bed, &table.pockets, others, radius_m, self.at, self.zone)
    }
}
