//! Spots: where balls return to the table.

use super::carom::carom_spot;
use super::{nearest_on_line, spot_position};
use crate::events::Spotting;
use crate::ids::BallId;
use crate::table::Bed;
use glam::DVec2;
use smallvec::SmallVec;

/// A ball that takes up room: its name, its middle and its radius [m].
pub type Occupied = (BallId, DVec2, f64);

/// The spots that a set of balls has.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub enum Spots {
    /// One for all: the foot spot.
    #[default]
    Foot,
    /// One for each colour of snooker, 16 to 21: yellow, green, brown, blue, pink, black.
    Snooker,
    /// Carom: one for each ball.
    Carom,
}

/// The colours of snooker, from the lowest value to the highest.
const COLOURS: std::ops::RangeInclusive<u16> = 16..=21;

/// The black's spot in front of the top cushion over the bed's length: 12¾ of 140½ inches.
const BLACK_FROM_TOP: f64 = 12.75 / 140.5;

impl Spots {
    /// A ball's own spot in pool or snooker [m].
    pub fn of(self, bed: &Bed, ball: BallId) -> DVec2 {
        let baulk = DVec2::new(bed.baulk_line_x(), 0.0);
        match (self, ball.0) {
            (Spots::Snooker, 16) => baulk - DVec2::Y * bed.d_radius_m(),
            (Spots::Snooker, 17) => baulk + DVec2::Y * bed.d_radius_m(),
            (Spots::Snooker, 18) => baulk,
            (Spots::Snooker, 19) => DVec2::ZERO,
            (Spots::Snooker, 21) => DVec2::new((0.5 - BLACK_FROM_TOP) * bed.length_m, 0.0),
            // The pink's is in the middle between the centre and the top cushion.
            _ => bed.foot_spot(),
        }
    }

    /// Where a ball is spotted, given the others and the ball that is struck next. All in metres.
    ///
    /// In pool see [`spot_position`]. In carom each ball has a spot. A colour of snooker goes to
    /// its own spot; if that is occupied to the free spot of the highest value; if all are, as near
    /// to its own spot as possible on the line to the top cushion, or else on the line away from it
    /// (rules of the WPBSA on spotting colours).
    pub fn place(
        self,
        bed: &Bed,
        ball: BallId,
        cue_ball: BallId,
        occupied: &[Occupied],
        radius_m: f64,
    ) -> DVec2 {
        match self {
            Spots::Snooker if COLOURS.contains(&ball.0) => {
                self.colour_spot(bed, ball, occupied, radius_m)
            }
            Spots::Foot | Spots::Snooker => spot_position(bed, occupied, radius_m),
            Spots::Carom => carom_spot(bed, cue_ball, ball, occupied, radius_m),
        }
    }

    /// Where balls are spotted, in the order in which that is done, each among all that `lie` there
    /// and those before it. None of them is if nobody knows the first.
    pub fn places(
        self,
        bed: &Bed,
        Spotting { balls, cue_ball }: &Spotting,
        mut lie: Vec<Occupied>,
        radius_m: impl Fn(BallId) -> Option<f64>,
    ) -> Vec<(BallId, DVec2)> {
        let Some(first_m) = balls.first().and_then(|ball| radius_m(*ball)) else {
            return Vec::new();
        };
        let others: Vec<Occupied> =
            lie.iter().copied().filter(|(ball, ..)| !balls.contains(ball)).collect();
        let mut places = Vec::new();
        for ball in self.in_order(bed, balls, &others, first_m) {
            let Some(radius_m) = radius_m(ball) else { continue };
            lie.retain(|(other, ..)| *other != ball);
            let place = self.place(bed, ball, *cue_ball, &lie, radius_m);
            lie.push((ball, place, radius_m));
            places.push((ball, place));
        }
        places
    }

    fn colour_spot(self, bed: &Bed, ball: BallId, occupied: &[Occupied], radius_m: f64) -> DVec2 {
        let own = self.of(bed, ball);
        let highest_first = COLOURS.rev().map(|id| self.of(bed, BallId(id)));
        std::iter::once(own)
            .chain(highest_first)
            .find(|spot| is_free(*spot, occupied, radius_m))
            .unwrap_or_else(|| nearest_on_line(bed, own, occupied, radius_m))
    }

    /// The order in which balls are spotted. In snooker those whose own spots are free come first,
    /// then the others from the highest value down (rules of the WPBSA on spotting colours).
    pub fn in_order(
        self,
        bed: &Bed,
        balls: &[BallId],
        occupied: &[Occupied],
        radius_m: f64,
    ) -> SmallVec<[BallId; 4]> {
        let mut order = SmallVec::from_slice(balls);
        if self == Spots::Snooker {
            let waits = |ball: BallId| !is_free(self.of(bed, ball), occupied, radius_m);
            order.sort_by_key(|ball| (waits(*ball), std::cmp::Reverse(*ball)));
        }
        order
    }
}

/// Whether a ball can stand here without touching another.
fn is_free(place: DVec2, occupied: &[Occupied], radius_m: f64) -> bool {
    occupied.iter().all(|(_, other, radius)| place.distance(*other) > radius_m + radius)
}
