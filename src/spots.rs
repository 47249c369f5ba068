//! Spots: where balls return to that have left the table.

use crate::events::Spots;
use crate::ids::BallId;
use crate::rack;
use crate::table::Bed;
use glam::DVec2;

/// A ball that takes up room: its name, its middle and its radius [m].
pub type Occupied = (BallId, DVec2, f64);

/// The red of carom.
const RED: BallId = BallId(2);

/// Where a ball of `radius` returns to. All in metres.
pub fn place(spots: Spots, bed: &Bed, ball: BallId, radius: f64, others: &[Occupied]) -> DVec2 {
    match spots {
        Spots::Pool => {
            let occupied = others.iter().map(|(_, place, other)| (*place, *other));
            rack::spot_position(bed, occupied, radius)
        }
        Spots::Carom { cue_ball } => carom(bed, cue_ball, ball, radius, others),
    }
}

/// Carom: the red belongs on the foot spot, the cue ball of whoever shoots next on the head spot,
/// the other one on the centre spot. If a ball is in the way, the place is free where that one
/// belongs (rules of the USBA and the UMB for three-cushion).
fn carom(bed: &Bed, cue_ball: BallId, ball: BallId, radius: f64, others: &[Occupied]) -> DVec2 {
    let home = |ball: BallId| match ball {
        RED => bed.foot_spot(),
        _ if ball == cue_ball => bed.head_spot(),
        _ => DVec2::ZERO,
    };
    let in_the_way = |spot: DVec2| {
        others.iter().find(|(_, place, other)| place.distance(spot) <= radius + other)
    };
    let mut spot = home(ball);
    // Each of two other balls can be in the way once.
    for _ in others {
        match in_the_way(spot) {
            Some((other, ..)) => spot = home(*other),
            None => break,
        }
    }
    // A ball in the way that is at home itself leaves its own place to nobody: what is left is.
    let spots = [bed.foot_spot(), bed.head_spot(), DVec2::ZERO];
    let is_free = |spot: &DVec2| in_the_way(*spot).is_none();
    if is_free(&spot) { spot } else { spots.into_iter().find(is_free).unwrap_or(spot) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BED: Bed = Bed { length_m: 2.84, width_m: 1.42 };
    const R: f64 = 0.03075;
    const WHITE: BallId = BallId(0);
    const YELLOW: BallId = BallId(1);

    #[track_caller]
    fn check(cue_ball: BallId, ball: BallId, others: &[(BallId, f64, f64)], x: f64) {
        let others: Vec<Occupied> =
            others.iter().map(|(id, x, y)| (*id, DVec2::new(*x, *y), R)).collect();
        let found = place(Spots::Carom { cue_ball }, &BED, ball, R, &others);
        assert_eq!(found, DVec2::new(x, 0.0));
    }

    #[test]
    fn carom_balls_have_homes_and_give_way_to_balls_that_lie_there() {
        let far = [(WHITE, 0.3, 0.5), (YELLOW, -0.3, 0.5)];
        check(WHITE, RED, &far, 0.71);
        check(WHITE, WHITE, &[(YELLOW, 0.3, 0.5), (RED, 0.5, 0.5)], -0.71);
        check(YELLOW, WHITE, &[(YELLOW, 0.3, 0.5), (RED, 0.5, 0.5)], 0.0);
        // The yellow covers the foot spot: the red goes where the yellow belongs.
        check(WHITE, RED, &[(YELLOW, 0.72, 0.03), (WHITE, 0.3, 0.5)], 0.0);
        check(YELLOW, RED, &[(YELLOW, 0.72, 0.03), (WHITE, 0.3, 0.5)], -0.71);
        // That is covered too: the third is free.
        check(WHITE, RED, &[(YELLOW, 0.72, 0.03), (WHITE, 0.01, 0.0)], -0.71);
        // A ball in the way on a place that is its own by chance.
        check(WHITE, RED, &[(YELLOW, 0.71, 0.0), (WHITE, 0.0, 0.02)], -0.71);
        // Just beside the spot there is room.
        check(WHITE, RED, &[(YELLOW, 0.71, 0.062), (WHITE, 0.3, 0.5)], 0.71);
    }

    #[test]
    fn pool_balls_return_to_the_foot_spot() {
        assert_eq!(place(Spots::Pool, &BED, RED, R, &[]), BED.foot_spot());
    }
}
