//! Aiming and placing: what is held how, and what may not be.

use super::desk::{Desk, free_play, shipped};
use hapticbillard::cue::OFFSET_LIMIT;
use hapticbillard::events::{Command, FactKind, Zone};
use hapticbillard::ids::BallId;
use hapticbillard::input::feel::{
    AIM_RAD_PER_HEIGHT, ELEVATION_MAX_RAD, ELEVATION_MIN_RAD, ELEVATION_RAD_PER_NOTCH, FINE,
    OFFSET_PER_S, PLACING_M_PER_HEIGHT,
};
use hapticbillard::input::{Button, HumanMode, Key, RawInput};

fn desk(balls: &[(u16, f64, f64)]) -> Desk {
    let mut desk = Desk::new(&free_play(balls));
    desk.wait(3);
    assert_eq!(desk.mode(), HumanMode::Aiming);
    desk
}

#[test]
fn the_first_aim_is_at_the_nearest_ball_and_on_a_break_at_the_apex() {
    let view = desk(&[(0, 0.0, 0.0), (1, 1.0, 0.0), (2, -0.3, 0.3)]).view();
    assert!((view.aim.azimuth_rad - 0.75 * std::f64::consts::PI).abs() < 1e-9);
    let ghost = view.ghost.unwrap();
    let radius_m = ghost.z;
    let expected = 0.3 * 2f64.sqrt() - 2.0 * radius_m;
    assert!((ghost.truncate().length() - expected).abs() < 1e-9);
    assert!((view.object_heading - glam::DVec2::new(-1.0, 1.0) * 0.5f64.sqrt()).length() < 1e-9);

    let mut desk = Desk::new(&shipped("free_play"));
    desk.wait(3);
    if desk.mode() == HumanMode::Placing {
        desk.button(Button::Left, true);
        desk.wait(3);
    }
    assert_eq!((desk.mode(), desk.view().aim.azimuth_rad), (HumanMode::Aiming, 0.0));
}

#[test]
fn the_mouse_turns_the_cue_by_the_stated_gain_and_shift_by_a_tenth() {
    let mut desk = desk(&[(0, 0.0, 0.0), (1, 1.0, 0.0)]);
    desk.moved(0.3, 0.1);
    assert!((desk.view().aim.azimuth_rad + 0.3 * AIM_RAD_PER_HEIGHT).abs() < 1e-12);
    desk.tick(&[
        RawInput::Key { key: Key::Shift, down: true },
        RawInput::Moved { right: -0.3, up: 0.0 },
        RawInput::Key { key: Key::Shift, down: false },
    ]);
    let expected = -0.3 * AIM_RAD_PER_HEIGHT * (1.0 - FINE);
    assert!((desk.view().aim.azimuth_rad - expected).abs() < 1e-12);
    // Past the object ball: the cushion is met, and nothing leaves there.
    assert_eq!(desk.view().object_heading, glam::DVec2::ZERO);
    assert!(desk.view().ghost.is_some());
}

#[test]
fn the_cue_is_told_only_when_it_is_held_anew() {
    let mut desk = desk(&[(0, 0.0, 0.0), (1, 1.0, 0.0)]);
    let before = desk.frames().len();
    desk.wait(200);
    desk.tick(&[RawInput::Wheel { notches: 3.0 }]);
    desk.key(Key::Letter('v'));
    assert_eq!(desk.frames().len(), before, "neither time nor the camera is the game's business");
    desk.moved(0.1, 0.0);
    desk.wait(10);
    assert_eq!(desk.frames().len(), before + 1);
    let Some(Command::MoveCue(path)) = desk.commands().pop() else { panic!() };
    assert!(!path.solid);
}

#[test]
fn the_tip_stays_within_its_limit_and_returns_to_the_middle() {
    let mut desk = desk(&[(0, 0.0, 0.0), (1, 1.0, 0.0)]);
    desk.hold(Key::Right, 400);
    let aim = desk.view().aim;
    assert!((aim.side_offset - 0.4 * OFFSET_PER_S).abs() < 1e-9 && aim.height_offset == 0.0);
    desk.button(Button::Right, true);
    desk.moved(5.0, 5.0);
    desk.button(Button::Right, false);
    let aim = desk.view().aim;
    let size = libm::hypot(aim.side_offset, aim.height_offset);
    assert!((size - OFFSET_LIMIT).abs() < 1e-12, "{aim:?}");
    assert_eq!(aim.azimuth_rad, 0.0, "the mouse did one thing at a time");
    desk.key(Key::Space);
    let aim = desk.view().aim;
    assert_eq!((aim.side_offset, aim.height_offset), (0.0, 0.0));
}

#[test]
fn the_butt_is_raised_over_balls_and_rails_and_no_lower_than_they_ask() {
    let mut open = desk(&[(0, 0.5, 0.0), (1, 1.0, 0.0)]);
    assert_eq!(open.view().aim.elevation_rad, ELEVATION_MIN_RAD);
    // The wheel with Control raises it; without, it does not.
    open.tick(&[RawInput::Wheel { notches: 5.0 }]);
    assert_eq!(open.view().aim.elevation_rad, ELEVATION_MIN_RAD);
    let control = |down| RawInput::Key { key: Key::Control, down };
    open.tick(&[control(true), RawInput::Wheel { notches: 5.0 }, control(false)]);
    let expected = ELEVATION_MIN_RAD + 5.0 * ELEVATION_RAD_PER_NOTCH;
    assert!((open.view().aim.elevation_rad - expected).abs() < 1e-12);
    open.hold(Key::PageUp, 10_000);
    assert_eq!(open.view().aim.elevation_rad, ELEVATION_MAX_RAD);
    open.hold(Key::PageDown, 10_000);
    assert_eq!(open.view().aim.elevation_rad, ELEVATION_MIN_RAD);

    // A ball behind the cue ball, and the tip above, in and below the middle.
    let mut behind = desk(&[(0, 0.5, 0.0), (1, 1.0, 0.0), (2, 0.4, 0.0)]);
    behind.turn_to(0.0);
    for keys in [None, Some(Key::Up), Some(Key::Down), Some(Key::Down)] {
        keys.into_iter().for_each(|key| behind.hold(key, 1900));
        behind.hold(Key::PageDown, 3000);
        let aim = behind.view().aim;
        assert!(aim.elevation_rad > 0.2, "{aim:?}");
        // Not one point of the shaft is in the ball behind.
        let cue = behind.table().cue.unwrap();
        let ball = behind.table().ball(BallId(2)).unwrap().position;
        for i in 0..1400 {
            let point = cue.tip - cue.direction * (0.001 * f64::from(i));
            assert!(point.distance(ball) > ball.z + 0.0065, "{aim:?}");
        }
    }
    let mut rail = desk(&[(0, -1.2, 0.0), (1, 1.0, 0.0)]);
    assert!(rail.view().aim.elevation_rad > 2.0 * ELEVATION_MIN_RAD);
    rail.turn_to(3.0);
    assert_eq!(rail.view().aim.elevation_rad, ELEVATION_MIN_RAD);
}

#[test]
fn looking_round_moves_the_eye_and_not_the_cue() {
    let mut desk = desk(&[(0, 0.0, 0.0), (1, 1.0, 0.0)]);
    desk.wait(400);
    let before = desk.view();
    assert!(before.camera.eye.x < -0.5, "behind the ball: {:?}", before.camera);
    desk.tick(&[
        RawInput::Button { button: Button::Middle, down: true },
        RawInput::Moved { right: 0.4, up: 0.1 },
        RawInput::Button { button: Button::Middle, down: false },
    ]);
    let round = desk.view();
    assert_eq!(round.aim, before.aim);
    assert!(round.camera.eye.distance(before.camera.eye) > 0.3);
    desk.key(Key::Letter('v'));
    desk.wait(400);
    let above = desk.view().camera;
    assert!(above.eye.z > 1.5 && above.eye.truncate().length() < 0.1, "{above:?}");
    // Turning the cue turns the eye with it at once, back behind it.
    desk.key(Key::Letter('v'));
    desk.wait(400);
    desk.turn_to(1.0);
    let turned = desk.view().camera;
    assert!(turned.eye.y < -0.5, "{turned:?}");
    assert!(turned.eye.is_finite() && turned.target.is_finite());
}

#[test]
fn the_cue_ball_in_hand_goes_where_the_mouse_takes_it_and_lies_where_it_may() {
    let mut desk = Desk::new(&shipped("eight_ball"));
    desk.wait(3);
    assert_eq!(desk.mode(), HumanMode::Placing, "the break is from the kitchen");
    let start = desk.view().placing.unwrap();
    // The view knows as well as physics: outside of the kitchen, then on the rack, then inside.
    for (right, up, allowed) in [(0.5, 0.0, false), (0.35, 0.0, false), (-0.9, 0.1, true)] {
        let before = desk.view().placing.unwrap();
        desk.moved(right, up);
        let view = desk.view();
        let by = view.placing.unwrap() - before;
        let expected = glam::DVec2::new(right, up) * PLACING_M_PER_HEIGHT;
        assert!((by - expected).length() < 1e-12, "{by}");
        assert_eq!(view.placing_allowed, allowed, "{start} {:?}", view.placing);
        desk.button(Button::Left, true);
        desk.button(Button::Left, false);
        desk.wait(3);
        let placed = desk.facts().into_iter().rev().find_map(|fact| match fact.kind {
            FactKind::BallPlaced { ball: BallId::CUE, zone, ok } => Some((zone, ok)),
            _ => None,
        });
        assert_eq!(placed, Some((Zone::Kitchen, allowed)));
        let mode = if allowed { HumanMode::Aiming } else { HumanMode::Placing };
        assert_eq!(desk.mode(), mode);
    }
    assert!(desk.cue_ball().position.x < -0.635);
}

#[test]
fn a_ball_in_hand_keeps_off_other_balls_and_on_the_bed() {
    // The cue ball falls, and free play gives it back in hand.
    let mut desk = desk(&[(0, 1.0, 0.0), (1, -0.5, 0.0)]);
    desk.turn_to(0.0);
    let corner = glam::DVec2::new(1.27, 0.635) - glam::DVec2::new(1.0, 0.0);
    desk.turn_to(libm::atan2(corner.y, corner.x));
    desk.stroke(0.2, 1.0, 1000);
    desk.wait_until(20_000, |desk| desk.mode() == HumanMode::Placing);
    // To the object ball, from wherever the hand holds it.
    let home = desk.view().placing.unwrap();
    let to = (glam::DVec2::new(-0.52, 0.0) - home) / PLACING_M_PER_HEIGHT;
    desk.moved(to.x, to.y);
    assert!(!desk.view().placing_allowed);
    desk.button(Button::Left, true);
    desk.wait(3);
    assert_eq!(desk.mode(), HumanMode::Placing);
    desk.button(Button::Left, false);
    // Far beyond the rail it stays on the bed, at the corner, over the pocket.
    desk.moved(9.0, 9.0);
    let at = desk.view().placing.unwrap();
    assert!(at.x < 1.27 && at.y < 0.635);
    desk.moved(-1.0, -0.2);
    assert!(desk.view().placing_allowed);
    desk.button(Button::Left, true);
    desk.wait(3);
    assert_eq!(desk.mode(), HumanMode::Aiming);
}
