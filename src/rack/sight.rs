//! Whether a player is snookered: what can be hit in a straight line.

use super::Spots;
use crate::events::Spotting;
use crate::ids::BallId;
use crate::table::Bed;
use glam::DVec2;
use smallvec::SmallVec;

/// Rings of places in the D from which a cue ball in hand is tried, and places on the outermost:
/// 29 mm apart on a full-size table.
const RINGS: usize = 10;
const PLACES: usize = 32;

/// Less than this in the way is a touch, not an obstacle [m].
const TOUCH_M: f64 = 1e-9;

/// What it takes to see whether a player is snookered.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sight {
    /// The playing area.
    pub bed: Bed,
    /// Where balls return to.
    pub spots: Spots,
    /// Radius of every ball [m].
    pub radius_m: f64,
}

/// From where the cue ball is played.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum From {
    /// From here [m].
    Here(DVec2),
    /// From anywhere in the D.
    D,
}

impl Sight {
    /// The balls as they will lie once some are spotted. `lying` are the others [m].
    pub fn with_spotted(
        &self,
        lying: &[(BallId, DVec2)],
        cue_ball: Option<DVec2>,
        spot: &[BallId],
    ) -> Vec<(BallId, DVec2)> {
        let mut balls: Vec<(BallId, DVec2)> =
            lying.iter().copied().filter(|(ball, _)| !spot.contains(ball)).collect();
        let cue = cue_ball.map(|at| (BallId::CUE, at));
        let lie = balls.iter().copied().chain(cue).map(|(id, at)| (id, at, self.radius_m));
        let spotting = Spotting { balls: SmallVec::from_slice(spot), cue_ball: BallId::CUE };
        let radius_m = |_| Some(self.radius_m);
        balls.extend(self.spots.places(&self.bed, &spotting, lie.collect(), radius_m));
        balls
    }

    /// Whether no ball on can be hit in a straight line on both its edges, balls on not counted as
    /// obstacles (rules of the WPBSA). Cushions do not snooker. Nobody is snookered when
    /// nothing is on.
    ///
    /// From the D it is tried from a grid of places, so a window of a few millimetres may be
    /// missed.
    pub fn is_snookered(
        &self,
        from: From,
        balls: &[(BallId, DVec2)],
        is_on: impl Fn(BallId) -> bool,
    ) -> bool {
        let (on, others): (Vec<_>, Vec<_>) = balls.iter().copied().partition(|(id, _)| is_on(*id));
        let places = match from {
            From::Here(place) => vec![place],
            From::D => self.places_in_d(balls),
        };
        let sees = |place: &DVec2| on.iter().any(|(_, ball)| self.sees(*place, *ball, &others));
        !on.is_empty() && !places.is_empty() && !places.iter().any(sees)
    }

    /// Whether both edges of `ball` can be hit from `place`.
    fn sees(&self, place: DVec2, ball: DVec2, others: &[(BallId, DVec2)]) -> bool {
        let (way, reach) = (ball - place, 2.0 * self.radius_m);
        let distance = way.length();
        if distance <= reach + TOUCH_M {
            return true;
        }
        // The middle of the cue ball that grazes an edge runs along a tangent to the circle of
        // radius 2 R round the ball, and meets it after the length of that tangent.
        let length = (distance * distance - reach * reach).max(0.0).sqrt();
        let (cos, sin) = (length / distance, reach / distance);
        let ahead = way / distance;
        [ahead * cos + ahead.perp() * sin, ahead * cos - ahead.perp() * sin]
            .iter()
            .all(|along| others.iter().all(|(_, other)| !self.stops(place, *along, length, *other)))
    }

    /// Whether a ball is in the way of one that runs `length` from `place`.
    fn stops(&self, place: DVec2, along: DVec2, length: f64, other: DVec2) -> bool {
        let to = other - place;
        let nearest = to.dot(along).clamp(0.0, length);
        // A ball that touches the cue ball at its start stops it only if it lies ahead.
        nearest > 0.0 && (to - nearest * along).length() < 2.0 * self.radius_m - TOUCH_M
    }

    /// Free places in the D, its corners and its middle among them [m].
    fn places_in_d(&self, balls: &[(BallId, DVec2)]) -> Vec<DVec2> {
        let middle = DVec2::new(self.bed.baulk_line_x(), 0.0);
        let on_ring = |ring: usize| {
            let radius = self.bed.d_radius_m() * ring as f64 / RINGS as f64;
            (0..=PLACES).map(move |k| {
                let angle = core::f64::consts::PI * (0.5 + k as f64 / PLACES as f64);
                // Rounding must not put the ends beyond the line.
                let off = radius * DVec2::new(libm::cos(angle).min(0.0), libm::sin(angle));
                middle + off
            })
        };
        let is_free = |place: &DVec2| {
            balls.iter().all(|(_, ball)| place.distance(*ball) >= 2.0 * self.radius_m)
        };
        (0..=RINGS).flat_map(on_ring).filter(is_free).collect()
    }
}
