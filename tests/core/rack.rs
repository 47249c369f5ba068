//! Racks and spots.

use glam::DVec2;
use hapticbillard::ball::{Ball, BallState, POOL_RADIUS_M};
use hapticbillard::ids::BallId;
use hapticbillard::rack::{
    CueBallGoes, JITTER_MAX_M, NextRack, Rack, RackError, next_rack, overlaps, spot_position,
};
use hapticbillard::table::{Bed, Table};

fn bed_only() -> Table {
    let bed = Some(Bed { length_m: 2.54, width_m: 1.27 });
    Table { bed, ..Table::default() }
}

fn position(balls: &[(Ball, BallState)], id: u16) -> DVec2 {
    balls.iter().find(|(ball, _)| ball.id == BallId(id)).unwrap().1.position.truncate()
}

/// Ids of the balls from the apex back, row by row, each from right to left.
fn rows(balls: &[(Ball, BallState)]) -> Vec<u16> {
    let mut object: Vec<_> = balls.iter().filter(|(ball, _)| ball.id != BallId::CUE).collect();
    let row = |state: &BallState| ((state.position.x - 0.635) / 0.0495).round() as i64;
    object
        .sort_by(|a, b| row(&a.1).cmp(&row(&b.1)).then(a.1.position.y.total_cmp(&b.1.position.y)));
    object.iter().map(|(ball, _)| ball.id.0).collect()
}

#[test]
fn racked_balls_nearly_touch_but_never_overlap() {
    let table = bed_only();
    for seed in 0..200 {
        for (rack, count, contacts) in
            [(Rack::eight_ball(seed), 16, 30), (Rack::nine_ball(seed), 10, 16)]
        {
            let balls = rack.place(&table).unwrap();
            assert_eq!(balls.len(), count);
            assert_eq!(overlaps(&balls), None, "seed {seed}");
            let near = 2.0 * POOL_RADIUS_M + 4.0 * JITTER_MAX_M + 1e-8;
            let mut pairs = 0;
            for (i, a) in balls.iter().enumerate() {
                pairs += balls[i + 1..]
                    .iter()
                    .filter(|b| a.1.position.distance(b.1.position) <= near)
                    .count();
            }
            assert_eq!(pairs, contacts, "seed {seed}");
        }
    }
}

#[test]
fn eight_stands_in_the_third_row_and_back_corners_differ() {
    let table = bed_only();
    let mut apexes = std::collections::BTreeSet::new();
    let mut right_is_solid = [false; 2];
    for seed in 0..200 {
        let balls = Rack::eight_ball(seed).place(&table).unwrap();
        let order = rows(&balls);
        assert_eq!(order[4], 8, "seed {seed}: {order:?}");
        assert_ne!(order[10] < 8, order[14] < 8, "seed {seed}: {order:?}");
        let mut all = order.clone();
        all.sort_unstable();
        assert_eq!(all, (1..=15).collect::<Vec<u16>>());
        assert!(
            position(&balls, order[0]).distance(DVec2::new(0.635, 0.0)) <= JITTER_MAX_M + 1e-12
        );
        assert_eq!(position(&balls, 0), DVec2::new(-0.635, 0.0));
        apexes.insert(order[0]);
        right_is_solid[usize::from(order[10] < 8)] = true;
    }
    assert_eq!(apexes.len(), 14, "every ball but the 8 gets to the apex: {apexes:?}");
    assert_eq!(right_is_solid, [true; 2]);
}

#[test]
fn nine_ball_has_the_one_on_the_spot_and_the_nine_in_the_middle() {
    for seed in 0..50 {
        let order = rows(&Rack::nine_ball(seed).place(&bed_only()).unwrap());
        assert_eq!((order[0], order[4]), (1, 9), "seed {seed}: {order:?}");
    }
}

#[test]
fn a_seed_gives_the_same_rack_and_another_seed_another() {
    let table = bed_only();
    let place = |seed| Rack::eight_ball(seed).place(&table).unwrap();
    assert_eq!(place(7), place(7));
    assert_ne!(place(7), place(8));
}

#[test]
fn racks_without_bed_and_doubled_balls_are_errors() {
    let error = Rack::eight_ball(1).place(&Table::plane()).unwrap_err();
    assert_eq!(error, RackError::NoBed { table: "plane".to_owned() });
    let mut balls = Rack::nine_ball(1).place(&bed_only()).unwrap();
    balls.reverse();
    let sorted = Rack::from_balls(balls.clone()).place(&Table::plane()).unwrap();
    assert!(sorted.windows(2).all(|pair| pair[0].0.id < pair[1].0.id));
    balls.push(balls[0].clone());
    let error = Rack::from_balls(balls).place(&bed_only()).unwrap_err();
    assert_eq!(error, RackError::Twice { id: BallId(9) });
}

#[test]
fn overlapping_balls_are_named_with_their_depth() {
    let mut balls = Rack::nine_ball(1).place(&bed_only()).unwrap();
    balls[3].1.position = balls[2].1.position;
    balls[3].1.position.z += 2.0 * POOL_RADIUS_M - 0.001;
    // Far from all others, so that only this pair can be found.
    balls[2].1.position.x = -1.0;
    balls[3].1.position.x = -1.0;
    let (a, b, depth) = overlaps(&balls).unwrap();
    assert_eq!((a, b), (BallId(2), BallId(3)));
    assert!((depth - 0.001).abs() < 1e-12);
}

#[test]
fn spotted_ball_goes_behind_and_then_before_the_spot() {
    let bed = Bed { length_m: 2.54, width_m: 1.27 };
    let r = POOL_RADIUS_M;
    let spot = |balls: &[DVec2]| {
        let occupied: Vec<_> = balls.iter().map(|p| (BallId::EIGHT, *p, r)).collect();
        spot_position(&bed, &occupied, r)
    };
    let foot = bed.foot_spot();
    assert_eq!(spot(&[]), foot);
    let behind = spot(&[foot]);
    assert_eq!(behind.y, 0.0);
    assert!((behind.x - foot.x - 2.0 * r).abs() < 2e-6 && behind.x > foot.x + 2.0 * r);
    // A ball beside the string leaves less room: Pythagoras.
    let beside = spot(&[foot + DVec2::new(0.0, 1.2 * r)]);
    assert!((beside.x - foot.x - 1.6 * r).abs() < 2e-6, "{beside}");
    // The string behind is full: as near before the spot as possible.
    let full: Vec<DVec2> =
        (0..12).map(|i| foot + DVec2::new(2.0 * r * f64::from(i), 0.0)).collect();
    let before = spot(&full);
    assert!((before.x - foot.x + 2.0 * r).abs() < 2e-6, "{before}");
}

/// Every row of the table in WPA rule 4.8, by columns: the cue ball in the rack, elsewhere, and on
/// the head spot.
#[test]
fn whoever_is_in_the_way_of_the_next_rack_goes_where_the_rules_say() {
    let bed = Bed { length_m: 2.54, width_m: 1.27 };
    let r = POOL_RADIUS_M;
    let in_rack = bed.foot_spot() + DVec2::new(3.0 * r, 0.5 * r);
    // Over the outline by a hair, and beside it by a hair.
    let on_edge = bed.foot_spot() - DVec2::new(3.0 * r - 1e-4, 0.0);
    let beside = bed.foot_spot() - DVec2::new(3.0 * r + 1e-4, 0.0);
    let on_head = bed.head_spot() + DVec2::new(-r, 1.5 * r);
    let kitchen = bed.head_spot() + DVec2::new(-0.1, 0.3);
    let on_string = DVec2::new(bed.head_string_x(), 0.3);
    let foot_side = bed.head_spot() + DVec2::new(0.4, 0.2);

    let check = |cue: DVec2, left: Option<DVec2>, cue_goes: CueBallGoes, left_at: Option<DVec2>| {
        let ball = BallId(5);
        let rack = next_rack(&bed, Some(cue), left.map(|place| (ball, place)), 3);
        assert_eq!(rack.cue_ball, cue_goes, "{cue} {left:?}");
        let (_, place) = rack.balls.iter().find(|(id, _)| *id == ball).unwrap();
        match (left, left_at) {
            (Some(_), None) => assert!(place.distance(bed.foot_spot()) < 2e-5, "apex: {place}"),
            (_, Some(at)) => assert_eq!(*place, at, "{cue} {left:?}"),
            (None, None) => {}
        }
    };
    use CueBallGoes::{InHand, Nowhere, To};
    let (head, middle) = (bed.head_spot(), DVec2::ZERO);

    for blocking in [in_rack, on_edge] {
        check(blocking, Some(in_rack + DVec2::new(0.0, 2.1 * r)), InHand, None);
        check(blocking, None, InHand, None);
        check(blocking, Some(kitchen), To(head), Some(kitchen));
        check(blocking, Some(on_head), To(middle), Some(on_head));
        check(blocking, Some(on_string), InHand, Some(on_string));
        check(blocking, Some(foot_side), InHand, Some(foot_side));
        check(blocking, Some(beside - DVec2::new(r, 0.0)), InHand, Some(beside - DVec2::X * r));

        check(kitchen, Some(blocking), Nowhere, Some(head));
        check(on_head, Some(blocking), Nowhere, Some(middle));
    }
    for cue in [kitchen, on_head, foot_side, beside] {
        check(cue, None, Nowhere, None);
    }
    for (cue, left) in [(kitchen, on_head), (on_head, beside), (beside, kitchen)] {
        check(cue, Some(left), Nowhere, Some(left));
    }
}

#[test]
fn the_next_rack_has_all_balls_once_and_none_overlaps() {
    let table = bed_only();
    let bed = table.bed.unwrap();
    let r = POOL_RADIUS_M;
    // A grid of places for both balls, fine around the rack.
    let places = |step: f64, from: DVec2, to: DVec2| {
        let count = ((to - from) / step).floor();
        (0..=count.x as usize * count.y as usize).map(move |i| {
            let across = count.y as usize;
            from + DVec2::new((i / across) as f64, (i % across) as f64) * step
        })
    };
    let corner = bed.foot_spot() + DVec2::new(0.2, 0.25);
    let coarse = || places(0.11, DVec2::new(-1.2, -0.6), DVec2::new(1.2, 0.6));
    let fine = || places(0.013, DVec2::new(0.5, 0.0), corner);
    let pairs = fine()
        .flat_map(|cue| coarse().step_by(7).map(move |left| (cue, left)))
        .chain(coarse().step_by(7).flat_map(|cue| fine().map(move |left| (cue, left))))
        .filter(|(cue, left)| cue.distance(*left) >= 2.0 * r);
    let mut racks = 0;
    for (i, (cue, left)) in pairs.enumerate() {
        let ball = BallId(1 + i as u16 % 15);
        let NextRack { balls, cue_ball } = next_rack(&bed, Some(cue), Some((ball, left)), i as u64);
        assert!(balls.iter().map(|(id, _)| id.0).eq(1..=15));
        let mut standing: Vec<(Ball, BallState)> = balls
            .iter()
            .map(|(id, place)| (Ball::pool(*id), BallState::at_rest(*id, place.extend(r))))
            .collect();
        let cue_at = match cue_ball {
            CueBallGoes::Nowhere => Some(cue),
            CueBallGoes::To(place) => Some(place),
            CueBallGoes::InHand => None,
        };
        let pool = |place: DVec2| BallState::at_rest(BallId::CUE, place.extend(r));
        standing.extend(cue_at.map(|place| (Ball::pool(BallId::CUE), pool(place))));
        assert_eq!(overlaps(&standing), None, "cue ball {cue}, {ball} at {left}");
        racks += 1;
    }
    assert!(racks > 5_000, "{racks}");

    let rack = |seed| next_rack(&bed, None, Some((BallId(4), DVec2::new(0.0, 0.3))), seed);
    assert_eq!(rack(1), rack(1));
    assert_ne!(rack(1), rack(2));
    assert_eq!(rack(1).cue_ball, CueBallGoes::InHand, "a cue ball that is gone");
    let free = |seed| !rack(seed).balls.iter().any(|(_, p)| p.distance(bed.foot_spot()) < r);
    assert!((0..20).all(free), "the apex stays free");
}
