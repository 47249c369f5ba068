//! The three balls of carom: where they stand when a game begins, and where they return to.

use super::Occupied;
use crate::ids::BallId;
use crate::table::{Bed, CAROM_START_M};
use glam::DVec2;

/// The white and the yellow, which the players strike, and the red.
const BALLS: [BallId; 3] = [BallId(0), BallId(1), RED];
const RED: BallId = BallId(2);

/// Where each ball stands before the break of the player who strikes `cue_ball` [m]: the red on the
/// foot spot, the opponent's ball on the head spot, the own one beside it (rules of the UMB).
pub(super) fn carom_start(bed: &Bed, cue_ball: BallId) -> [(BallId, DVec2); 3] {
    BALLS.map(|ball| {
        let place = match ball {
            RED => bed.foot_spot(),
            _ if ball == cue_ball => bed.head_spot() - DVec2::Y * CAROM_START_M,
            _ => bed.head_spot(),
        };
        (ball, place)
    })
}

/// Where a ball returns to: the red to the foot spot, the cue ball of whoever shoots next to the
/// head spot, the other one to the centre spot. If a ball is in the way, there is room where that
/// one belongs (rules of USBA and UMB for three-cushion). All in metres.
pub(super) fn carom_spot(
    bed: &Bed,
    cue_ball: BallId,
    ball: BallId,
    occupied: &[Occupied],
    radius_m: f64,
) -> DVec2 {
    let home = |ball: BallId| match ball {
        RED => bed.foot_spot(),
        _ if ball == cue_ball => bed.head_spot(),
        _ => DVec2::ZERO,
    };
    let in_the_way = |spot: DVec2| {
        occupied.iter().find(|(_, place, other)| place.distance(spot) <= radius_m + other)
    };
    let mut spot = home(ball);
    // Each of the other balls can be in the way once.
    for _ in occupied {
        match in_the_way(spot) {
            Some((other, ..)) => spot = home(*other),
            None => break,
        }
    }
    // A ball that lies where it belongs shows no other place: then the first free one is taken.
    let is_free = |spot: &DVec2| in_the_way(*spot).is_none();
    let spots = [spot, bed.foot_spot(), bed.head_spot(), DVec2::ZERO];
    spots.into_iter().find(is_free).unwrap_or(spot)
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
        assert_eq!(carom_spot(&BED, cue_ball, ball, &others, R), DVec2::new(x, 0.0));
    }

    #[test]
    fn balls_have_homes_and_give_way_to_balls_that_lie_there() {
        let far = [(WHITE, 0.3, 0.5), (YELLOW, -0.3, 0.5)];
        check(WHITE, RED, &far, 0.71);
        check(WHITE, WHITE, &[(YELLOW, 0.3, 0.5), (RED, 0.5, 0.5)], -0.71);
        check(YELLOW, WHITE, &[(YELLOW, 0.3, 0.5), (RED, 0.5, 0.5)], 0.0);
        // The yellow covers the foot spot: the red goes where the yellow belongs.
        check(WHITE, RED, &[(YELLOW, 0.72, 0.03), (WHITE, 0.3, 0.5)], 0.0);
        check(YELLOW, RED, &[(YELLOW, 0.72, 0.03), (WHITE, 0.3, 0.5)], -0.71);
        // That is covered too: the third is free.
        check(WHITE, RED, &[(YELLOW, 0.72, 0.03), (WHITE, 0.01, 0.0)], -0.71);
        // The opponent's ball lies where the own one belongs, and the red where it belongs itself.
        check(WHITE, WHITE, &[(YELLOW, -0.72, 0.0), (RED, 0.0, 0.02)], 0.71);
        // Just beside the spot there is room.
        check(WHITE, RED, &[(YELLOW, 0.71, 0.062), (WHITE, 0.3, 0.5)], 0.71);
    }
}
