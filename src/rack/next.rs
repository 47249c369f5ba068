//! Straight pool goes on with a new rack while one ball is left (WPA rules 4.2 and 4.8).

use super::{jitter, pitch, places};
use crate::ball::POOL_RADIUS_M;
use crate::ids::BallId;
use crate::table::Bed;
use glam::DVec2;
use rand::{SeedableRng, seq::SliceRandom};
use rand_pcg::Pcg64Mcg;

/// What becomes of the cue ball when balls are racked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CueBallGoes {
    /// It stays where it lies.
    Nowhere,
    /// It is put here on the bed [m].
    To(DVec2),
    /// It is played from behind the head string.
    InHand,
}

/// Where balls stand when straight pool goes on with a new rack.
#[derive(Debug, Clone, PartialEq)]
pub struct NextRack {
    /// All fifteen object balls and their places on the bed [m], in the order of their ids; the one
    /// that was left is among them.
    pub balls: Vec<(BallId, DVec2)>,
    /// What becomes of the cue ball.
    pub cue_ball: CueBallGoes,
}

/// Racks the balls 1 to 15 but the one that is `left` at its place: in a triangle without its apex,
/// in an order that the seed shuffles. The cue ball, which lies at its place or is gone, and the
/// ball that is left stay where they are unless they are in the way. Places in metres on the bed.
///
/// In the way is what lies in the outline of the triangle or overlaps it (WPA rule 4.8):
///
/// - No ball is left, or both are in the way: all fifteen are racked, the one that was left on the
///   foot spot. A cue ball in the way is in hand behind the head string.
/// - Only the ball that is left is in the way: it goes to the head spot, or to the middle of the
///   table if the cue ball blocks that.
/// - Only the cue ball is in the way: it is in hand behind the head string, unless the ball that is
///   left lies there; then it goes to the head spot, or to the middle if that ball blocks the spot.
pub fn next_rack(
    bed: &Bed,
    cue_ball: Option<DVec2>,
    left: Option<(BallId, DVec2)>,
    seed: u64,
) -> NextRack {
    let outline = Outline::of(bed);
    let blocks_head = |place: DVec2| place.distance(bed.head_spot()) < 2.0 * POOL_RADIUS_M;
    let spot = |is_blocked: bool| if is_blocked { DVec2::ZERO } else { bed.head_spot() };
    let cue_in_way = cue_ball.is_some_and(|place| outline.is_blocked_by(place));

    let goes = |in_hand: bool| match in_hand || cue_ball.is_none() {
        true => CueBallGoes::InHand,
        false => CueBallGoes::Nowhere,
    };
    let (apart, cue_ball_goes) = match left {
        None => (None, goes(cue_in_way)),
        Some((_, place)) => match (outline.is_blocked_by(place), cue_in_way) {
            (true, true) => (None, CueBallGoes::InHand),
            (true, false) => (Some(spot(cue_ball.is_some_and(blocks_head))), goes(false)),
            (false, true) if place.x < bed.head_string_x() => {
                (Some(place), CueBallGoes::To(spot(blocks_head(place))))
            }
            (false, in_way) => (Some(place), goes(in_way)),
        },
    };

    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let last = left.map(|(ball, _)| ball);
    let mut order: Vec<BallId> = (1..=15).map(BallId).filter(|ball| Some(*ball) != last).collect();
    order.shuffle(&mut random);
    // The apex comes first: the ball that was left, or nothing.
    let is_apex_free = apart.is_some();
    if let (Some(ball), false) = (last, is_apex_free) {
        order.insert(0, ball);
    }
    let places = places(&[1, 2, 3, 4, 5], bed.foot_spot(), POOL_RADIUS_M)
        .map(|place| place + jitter(&mut random))
        .skip(usize::from(is_apex_free));
    let mut balls: Vec<(BallId, DVec2)> = order.into_iter().zip(places).collect();
    balls.extend(last.zip(apart));
    balls.sort_by_key(|(ball, _)| *ball);
    NextRack { balls, cue_ball: cue_ball_goes }
}

/// The triangle that is drawn around a tight rack of fifteen.
struct Outline {
    corners: [DVec2; 3],
}

impl Outline {
    fn of(bed: &Bed) -> Self {
        let pitch = pitch(POOL_RADIUS_M);
        let row_pitch = 0.75f64.sqrt() * pitch;
        let radius = 0.5 * pitch;
        let apex = bed.foot_spot();
        // Each side is moved out by a radius from the middles of the balls along it.
        let tip = apex - DVec2::new(2.0 * radius, 0.0);
        let back = apex.x + 4.0 * row_pitch + radius;
        let half = 2.0 * pitch + 3f64.sqrt() * radius;
        Outline { corners: [tip, DVec2::new(back, -half), DVec2::new(back, half)] }
    }

    /// Whether a ball here lies in the outline or overlaps it.
    fn is_blocked_by(&self, place: DVec2) -> bool {
        let sides = [0, 1, 2].map(|i| (self.corners[i], self.corners[(i + 1) % 3]));
        let is_inside = sides.iter().all(|(from, to)| 0.0 <= (to - from).perp_dot(place - from));
        let distance = |(from, to): &(DVec2, DVec2)| {
            let side = to - from;
            let along = ((place - from).dot(side) / side.length_squared()).clamp(0.0, 1.0);
            place.distance(from + along * side)
        };
        is_inside || sides.iter().any(|side| distance(side) < POOL_RADIUS_M)
    }
}
