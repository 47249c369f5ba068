//! Strokes: what the hand does is what the tip does.

use super::desk::{Desk, RATES_HZ, free_play};
use hapticbillard::events::{Command, FactKind};
use hapticbillard::input::feel::{
    STROKE_ACCELERATION_MAX_M_S2, STROKE_M_PER_HEIGHT, STROKE_SPEED_MAX_M_S,
};
use hapticbillard::input::{Button, HumanMode, Key, RawInput};
use hapticbillard::table::Table;
use hapticbillard::tick::Pace;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::sync::Arc;

/// A cue ball in the middle of the head half, an object ball far down the table; aiming.
fn at_the_ball() -> Desk {
    let mut desk = Desk::new(&free_play(&[(0, -0.4, 0.0), (1, 0.9, 0.3)]));
    desk.wait(3);
    assert_eq!(desk.mode(), HumanMode::Aiming);
    desk
}

#[test]
fn the_tip_strikes_with_the_speed_of_the_hand_whatever_the_mouse_reports() {
    for rate_hz in RATES_HZ {
        for speed_m_s in [0.3, 1.0, 2.5, 5.0] {
            let mut desk = at_the_ball();
            desk.stroke(0.38, speed_m_s, rate_hz);
            assert_eq!(desk.tips(), 1, "{rate_hz} Hz, {speed_m_s} m/s");
            let struck = desk.view().strength_m_s;
            assert!((struck / speed_m_s - 1.0).abs() < 0.03, "{rate_hz} Hz: {struck}");
            // And that is what physics saw: a central hit meets the ball along its normal.
            let seen = desk.facts().into_iter().find_map(|fact| match fact.kind {
                FactKind::CueBallStruck { normal_speed_m_s, .. } => Some(normal_speed_m_s),
                _ => None,
            });
            assert!((seen.unwrap() - struck).abs() < 1e-9);
        }
    }
}

#[test]
fn a_slow_mouse_in_a_slow_window_still_strikes_about_as_hard() {
    // 125 reports a second, handed on 60 times a second: two in most pictures, three in some.
    let mut worst = 0.0f64;
    for start in 0..12u64 {
        let mut desk = at_the_ball();
        desk.button(Button::Left, true);
        desk.sweep(-1.0, 350, 1000);
        desk.wait(100);
        let mut waiting = 0;
        for tick in 1 + 37 * start..=500 + 37 * start {
            waiting += tick * 125 / 1000 - (tick - 1) * 125 / 1000;
            let mut reports = vec![];
            if tick * 60 / 1000 > (tick - 1) * 60 / 1000 {
                let report = RawInput::Moved { right: 0.0, up: 2.0 / 125.0 / STROKE_M_PER_HEIGHT };
                reports = vec![report; std::mem::take(&mut waiting) as usize];
            }
            if desk.mode() == HumanMode::Stroking {
                desk.tick(&reports);
            }
        }
        assert_eq!(desk.tips(), 1);
        worst = worst.max((desk.view().strength_m_s / 2.0 - 1.0).abs());
    }
    assert!(worst < 0.15, "{worst}");
}

#[test]
fn the_path_of_a_stroke_has_no_jumps_and_keeps_its_limits() {
    let mut desk = at_the_ball();
    // As hard as can be, in bursts.
    desk.button(Button::Left, true);
    desk.sweep(-20.0, 100, 60);
    desk.sweep(60.0, 300, 60);
    assert_eq!(desk.tips(), 1);
    let mut paths = desk.commands().into_iter().filter_map(|command| match command {
        Command::MoveCue(path) if path.solid => Some(path.pieces[0]),
        _ => None,
    });
    let mut last = paths.next().unwrap();
    let mut count = 0;
    for piece in paths {
        let (place, velocity) = last.at(piece.start_s);
        assert!(place.distance(piece.position) < 1e-12);
        assert!(velocity.distance(piece.velocity) < 1e-9);
        assert!(piece.velocity.length() <= STROKE_SPEED_MAX_M_S + 1e-9);
        assert!(piece.acceleration.length() <= STROKE_ACCELERATION_MAX_M_S2 + 1e-6);
        (last, count) = (piece, count + 1);
    }
    assert!(count > 100);
}

#[test]
fn letting_go_losing_the_keyboard_and_pausing_end_a_stroke_without_a_hit() {
    let enders: [&[RawInput]; 3] = [
        &[RawInput::Button { button: Button::Left, down: false }],
        &[RawInput::FocusLost],
        &[RawInput::Key { key: Key::Escape, down: true }],
    ];
    for ender in enders {
        let mut desk = at_the_ball();
        desk.button(Button::Left, true);
        desk.sweep(-1.0, 200, 125);
        desk.sweep(2.0, 60, 125);
        assert_eq!(desk.mode(), HumanMode::Stroking);
        assert!(desk.table().cue.unwrap().solid);
        desk.tick(ender);
        assert!(!desk.table().cue.unwrap().solid, "{ender:?}");
        // The hand goes on, but it holds nothing.
        for _ in 0..300 {
            desk.moved(0.0, 0.01);
        }
        assert_eq!(desk.tips(), 0, "{ender:?}");
        assert_ne!(desk.mode(), HumanMode::Stroking);
    }
}

#[test]
fn a_hand_that_lets_go_beyond_the_ball_has_struck_it() {
    // A window that draws slowly hands the push and the letting go on in one burst.
    let mut desk = at_the_ball();
    desk.button(Button::Left, true);
    desk.sweep(-1.0, 200, 125);
    desk.wait(100);
    desk.tick(&[
        RawInput::Moved { right: 0.0, up: 0.3 / STROKE_M_PER_HEIGHT },
        RawInput::Button { button: Button::Left, down: false },
    ]);
    assert_eq!(desk.mode(), HumanMode::Stroking);
    desk.wait(200);
    assert_eq!(desk.tips(), 1);

    // One that lets go just before the ball has not, however fast it was.
    let mut desk = at_the_ball();
    desk.button(Button::Left, true);
    desk.sweep(-1.0, 200, 125);
    desk.wait(100);
    desk.tick(&[
        RawInput::Moved { right: 0.0, up: 0.225 / STROKE_M_PER_HEIGHT },
        RawInput::Button { button: Button::Left, down: false },
    ]);
    desk.wait(200);
    assert_eq!((desk.tips(), desk.mode()), (0, HumanMode::Aiming));
}

#[test]
fn time_is_hurried_only_for_somebody_who_waits() {
    let mut desk = at_the_ball();
    let f = |down| RawInput::Key { key: Key::Letter('f'), down };
    desk.tick(&[f(true)]);
    assert!(!desk.last().hurried, "aiming");
    desk.stroke(0.3, 2.0, 125);
    desk.wait(2);
    assert!(desk.last().hurried, "balls roll");
    desk.tick(&[RawInput::Key { key: Key::Escape, down: true }]);
    assert!(desk.last().paused && !desk.last().hurried);
    desk.tick(&[RawInput::Key { key: Key::Escape, down: true }, f(false)]);
    desk.wait(2);
    assert!(!desk.last().hurried, "let go");
}

#[test]
fn the_interface_never_hits_twice() {
    let mut random = Pcg64Mcg::seed_from_u64(5);
    let table = Arc::new(Table::preset("pool-9ft").unwrap());
    for i in 0..200 {
        let (x, y) = (random.random_range(-1.2..1.2), random.random_range(-0.6..0.6));
        let scene = free_play(&[(0, x, y), (1, 1.24, 0.0)]);
        let mut desk = Desk::at(&scene, table.clone(), Pace::EveryTick);
        desk.wait(2);
        desk.turn_to(random.random_range(-3.1..3.1));
        desk.tick(&[
            RawInput::Button { button: Button::Right, down: true },
            RawInput::Moved {
                right: random.random_range(-0.3..0.3),
                up: random.random_range(-0.3..0.3),
            },
            RawInput::Button { button: Button::Right, down: false },
        ]);
        let control = |down| RawInput::Key { key: Key::Control, down };
        let raise = RawInput::Wheel { notches: random.random_range(0.0..35.0) };
        desk.tick(&[control(true), raise, control(false)]);
        let pull_m = random.random_range(0.05..0.4);
        let speed_m_s = random.random_range(0.2..9.0);
        let rate_hz = RATES_HZ[random.random_range(0..3)];
        desk.stroke(pull_m, speed_m_s, rate_hz);
        // The hand follows through, and the cue comes back only when all is at rest.
        for _ in 0..80 {
            desk.moved(0.0, 0.02);
        }
        assert_eq!(desk.tips(), 1, "stroke {i}: {:?}", desk.view().aim);
        assert!(desk.table().cue.is_none_or(|cue| !cue.solid));
    }
}

/// Where the cue ball goes after a stroke with this offset: its direction after the first and
/// after the second cushion would depend on the table, so the spin itself is looked at.
fn spin_after(side: f64, height: f64) -> (glam::DVec3, glam::DVec3) {
    let mut desk = at_the_ball();
    desk.turn_to(0.0);
    let per_height = hapticbillard::input::feel::OFFSET_PER_HEIGHT;
    desk.button(Button::Right, true);
    desk.moved(side / per_height, height / per_height);
    desk.button(Button::Right, false);
    let aim = desk.view().aim;
    assert!((aim.side_offset - side).abs() < 1e-12 && (aim.height_offset - height).abs() < 1e-12);
    desk.stroke(0.3, 2.0, 125);
    assert_eq!(desk.tips(), 1);
    (desk.cue_ball().velocity, desk.cue_ball().angular_velocity)
}

#[test]
fn a_tip_right_of_the_middle_turns_the_ball_as_right_english_does() {
    let (velocity, right) = spin_after(0.3, 0.0);
    // Struck on the right, the ball turns anticlockwise seen from above and leaves to the left.
    assert!(right.z > 20.0, "{right}");
    assert!(velocity.y > 0.0, "{velocity}");
    let (velocity, left) = spin_after(-0.3, 0.0);
    assert!(left.z < -20.0 && velocity.y < 0.0, "{left} {velocity}");
    // Above the middle it rolls ahead, below it turns backwards: about +y is forwards along +x.
    assert!(spin_after(0.0, 0.3).1.y > 20.0);
    assert!(spin_after(0.0, -0.4).1.y < -20.0);
}

#[test]
fn the_strength_that_is_shown_is_that_of_the_last_contact() {
    let mut desk = at_the_ball();
    desk.stroke(0.3, 1.5, 125);
    let struck = desk.view().strength_m_s;
    desk.wait(200);
    assert_eq!((desk.mode(), desk.view().strength_m_s), (HumanMode::Watching, struck));
    assert!((struck - 1.5).abs() < 0.05);
}

#[test]
fn a_touch_too_soft_to_be_seen_ends_the_shot_as_well() {
    let mut desk = at_the_ball();
    desk.button(Button::Left, true);
    desk.sweep(0.0297, 1000, 1000);
    desk.sweep(0.0005, 4000, 1000);
    assert_eq!(desk.tips(), 1);
    assert!(desk.view().strength_m_s < 0.001, "{}", desk.view().strength_m_s);
    desk.wait_until(3000, |desk| desk.verdicts().len() == 1);
    desk.wait(3);
    assert_eq!(desk.mode(), HumanMode::Aiming);
}
