//! Cue motion: paths without jumps, and the planned speed where the tip meets the ball.

use super::{BED, R};
use glam::{DVec2, DVec3, dvec3};
use hapticbillard::ai::{Stroke, approach, resting_pose, withdrawal};
use hapticbillard::cue::{
    Aim, BUTT_RADIUS_M, CUE_LENGTH_M, CuePath, CuePose, OFFSET_LIMIT, SHAFT_RADIUS_M, TIP_RADIUS_M,
    elevation_over_balls,
};
use hapticbillard::ids::PlayerId;

const BALL: DVec3 = DVec3::new(-0.4, 0.2, R);

fn aim(azimuth_deg: f64, elevation_deg: f64, side: f64, height: f64) -> Aim {
    Aim {
        azimuth_rad: azimuth_deg.to_radians(),
        elevation_rad: elevation_deg.to_radians(),
        side_offset: side,
        height_offset: height,
    }
}

fn strokes() -> Vec<Stroke> {
    let mut all = Vec::new();
    for azimuth in [0.0, 73.0, 180.0, -100.0] {
        for (elevation, side, height) in [(2.0, 0.0, 0.0), (8.0, 0.3, -0.2), (50.0, 0.0, 0.4)] {
            for speed in [0.7, 2.0, 4.5, 6.2] {
                let aim = aim(azimuth, elevation, side, height);
                all.push(Stroke::at_ball(aim, BALL, R, speed));
            }
        }
    }
    all
}

#[track_caller]
fn check_without_jumps(path: &CuePath) {
    for pair in path.pieces.windows(2) {
        let (position, velocity) = pair[0].at(pair[0].end_s());
        assert!((pair[0].end_s() - pair[1].start_s).abs() < 1e-9, "gap in time");
        assert!(position.distance(pair[1].position) < 1e-9, "jump at {}", pair[1].start_s);
        assert!(velocity.distance(pair[1].velocity) < 1e-6, "kick at {}", pair[1].start_s);
        assert!(pair[0].direction_end.distance(pair[1].direction) < 1e-12, "the shaft jumps");
    }
    assert!(path.pieces.iter().all(|piece| piece.duration_s > 0.0));
}

#[track_caller]
fn check_ends(path: &CuePath, from: &CuePose, to: DVec3) {
    let (first, last) = (&path.pieces[0], &path.pieces[path.pieces.len() - 1]);
    assert!(first.position.distance(from.tip) < 1e-12);
    assert!(first.velocity.distance(from.velocity) < 1e-12);
    let (position, velocity) = last.at(last.end_s());
    assert!(position.distance(to) < 1e-9 && velocity.length() < 1e-9);
}

#[test]
fn strokes_are_continuous_and_begin_and_end_at_rest() {
    for stroke in strokes() {
        let path = stroke.path(3.25);
        check_without_jumps(&path);
        let last = path.pieces.last().unwrap();
        check_ends(&path, &stroke.address(), last.at(last.end_s()).0);
        assert!(path.solid);
        assert!((path.end_s().unwrap() - 3.25 - stroke.duration_s()).abs() < 1e-9);
    }
}

#[test]
fn tip_has_the_planned_speed_from_30_mm_before_to_10_mm_after_the_contact() {
    for stroke in strokes() {
        let path = stroke.path(1.0);
        let contact_s = 1.0 + stroke.contact_after_s();
        let at = |time_s: f64| path.piece_at(time_s).unwrap().at(time_s);
        let (tip, _) = at(contact_s);
        assert!(tip.distance(stroke.contact) < 1e-9);
        for way in [-0.030, -0.01, 0.0, 0.005, 0.010] {
            let (_, velocity) = at(contact_s + way / stroke.speed_m_s);
            let planned = stroke.aim.direction() * stroke.speed_m_s;
            assert!(velocity.distance(planned) < 1e-12, "{way}: {velocity}");
        }
        // Not before and not after: it comes to rest within 10 cm of follow-through.
        let last = path.pieces.last().unwrap();
        let follow = last.at(last.end_s()).0.distance(stroke.contact);
        assert!((0.06..0.115).contains(&follow), "{follow} m");
    }
}

#[test]
fn tip_touches_the_ball_at_the_wanted_point_and_nowhere_before() {
    for stroke in strokes() {
        assert!((stroke.contact.distance(BALL) - R - TIP_RADIUS_M).abs() < 1e-12);
        let path = stroke.path(0.0);
        let contact_s = stroke.contact_after_s();
        for i in 0..1000 {
            let time_s = contact_s * f64::from(i) / 1000.0;
            let tip = path.piece_at(time_s).unwrap().at(time_s).0;
            assert!(tip.distance(BALL) > R + TIP_RADIUS_M, "touches at {time_s} of {contact_s}");
        }
    }
}

#[test]
fn approach_leads_from_anywhere_to_the_address_and_lets_the_stroke_begin() {
    for stroke in strokes() {
        for player in [PlayerId::ONE, PlayerId::TWO] {
            let rest = resting_pose(player, &BED);
            assert!(!BED.holds(rest.tip.truncate(), 0.0), "it rests beside the table");
            let moving = CuePose { velocity: dvec3(0.3, -0.2, 0.1), ..stroke.address() };
            for from in [rest, moving] {
                let path = approach(&from, &stroke, 2.0);
                check_without_jumps(&path);
                check_ends(&path, &from, stroke.address().tip);
                assert!(!path.solid);
                assert!((0.7..0.9).contains(&(path.end_s().unwrap() - 2.0)));
                let last = path.pieces.last().unwrap();
                assert!(last.direction_end.distance(stroke.aim.direction()) < 1e-12);
                assert!(path.pieces.iter().all(|piece| piece.direction.is_normalized()));
            }
        }
    }
}

#[test]
fn withdrawal_takes_a_moving_cue_back_and_up() {
    for stroke in strokes() {
        let direction = stroke.aim.direction();
        let from = CuePose {
            tip: stroke.contact,
            velocity: direction * stroke.speed_m_s,
            direction,
            solid: true,
        };
        let path = withdrawal(&from, 5.0);
        check_without_jumps(&path);
        assert!(!path.solid);
        let last = path.pieces.last().unwrap();
        let (end, velocity) = last.at(last.end_s());
        assert!(velocity.length() < 1e-9);
        assert!(end.z > from.tip.z + 0.1, "up");
        assert!((end - from.tip).dot(direction) < -0.05, "back");
    }
}

#[test]
fn offsets_move_the_contact_to_the_right_and_up() {
    let level = |side, height| aim(0.0, 0.0, side, height).contact_point(BALL, R) - BALL;
    assert!(level(0.0, 0.0).distance(dvec3(-R, 0.0, 0.0)) < 1e-12);
    let right = level(0.4, 0.0);
    assert!((right.y + 0.4 * R).abs() < 1e-12, "looking along +x, right is −y: {right}");
    let high = level(0.0, 0.4);
    assert!((high.z - 0.4 * R).abs() < 1e-12);
    assert!((high.length() - R).abs() < 1e-12, "on the ball");
    let too_far = level(3.0, 4.0);
    let offset = libm::hypot(too_far.y, too_far.z) / R;
    assert!((offset - OFFSET_LIMIT).abs() < 1e-12, "kept within the limit: {offset}");
    // A raised butt points down, and a middle hit is still towards the ball's middle.
    let raised = aim(0.0, 30.0, 0.0, 0.0);
    assert!((raised.direction().z + 0.5).abs() < 1e-12);
    let tip = raised.tip_pulled_back(BALL, R, 0.1);
    assert!((BALL - tip).normalize().distance(raised.direction()) < 1e-12);
    assert!((tip.distance(BALL) - R - TIP_RADIUS_M - 0.1).abs() < 1e-12);
}

#[test]
fn butt_is_raised_until_the_shaft_clears_the_balls_behind() {
    let over = |ball: DVec2, aim: &Aim| elevation_over_balls(DVec2::ZERO, aim, [ball], R);
    assert_eq!(over(DVec2::new(0.5, 0.0), &Aim::default()), 0.0, "in front");
    assert_eq!(over(DVec2::new(-0.5, 0.06), &Aim::default()), 0.0, "beside");
    let offsets = [(0.0, 0.0), (0.0, -0.4), (0.0, 0.2), (0.3, 0.0), (-0.3, -0.3)];
    for (side_offset, height_offset) in offsets {
        for ball in [DVec2::new(-2.5 * R, 0.0), DVec2::new(-0.15, 0.02), DVec2::new(-0.9, -0.03)] {
            let level = Aim { side_offset, height_offset, ..Aim::default() };
            let aim = Aim { elevation_rad: over(ball, &level), ..level };
            // Walk along the shaft and measure.
            let tip = aim.tip_at_contact(DVec3::Z * R, R);
            let gaps = (0..14_500).map(|i| {
                let back = f64::from(i) * 1e-4;
                let radius =
                    SHAFT_RADIUS_M + back / CUE_LENGTH_M * (BUTT_RADIUS_M - SHAFT_RADIUS_M);
                let apart = (tip - aim.direction() * back).distance(ball.extend(R));
                apart - R - radius.max(TIP_RADIUS_M)
            });
            let least = gaps.fold(f64::INFINITY, f64::min);
            assert!(least > 0.0, "{ball} {aim:?}: {least}");
            assert!(
                least < 0.005 || aim.elevation_rad == 0.0,
                "{ball} {aim:?}: not steeper than needed"
            );
        }
    }
}
