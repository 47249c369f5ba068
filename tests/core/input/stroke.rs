//! Strokes: what the hand does is what the tip does.

use super::desk::{Desk, RATES_HZ, free_play};
use hapticbillard::events::{Command, FactKind};
use hapticbillard::input::feel::{STROKE_ACCELERATION_MAX_M_S2, STROKE_SPEED_MAX_M_S};
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
            println!("{rate_hz} Hz {speed_m_s}: {struck}");
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
