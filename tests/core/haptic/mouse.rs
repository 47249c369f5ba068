//! Somebody at a mouse moves the hand of the simulated device.

use super::rig::balls;
use glam::DVec3;
use hapticbillard::cue::Aim;
use hapticbillard::events::{Fact, FactKind};
use hapticbillard::haptic::simulated::{Guide, HandModel, HandScript, MouseFeel, MouseHand};
use hapticbillard::haptic::{Buttons, DeviceSpec, Rehearsal};
use hapticbillard::ids::BallId;
use hapticbillard::table::Table;

fn desk() -> Rehearsal {
    let table = Table::preset("pool-9ft").unwrap();
    let (balls, hand) = (balls(&table), HandModel::MOUSE);
    let script = HandScript::drawn(DVec3::ZERO, Vec::new());
    let aim = Aim { elevation_rad: 0.06, ..Aim::default() };
    let mut desk = Rehearsal::new(&table, balls, DeviceSpec::OMNI, hand, script, &aim).unwrap();
    *desk.device.guide_mut() = Guide::Mouse(MouseHand::new(MouseFeel::default()));
    desk
}

fn mouse(desk: &mut Rehearsal) -> &mut MouseHand {
    match desk.device.guide_mut() {
        Guide::Mouse(mouse) => mouse,
        Guide::Script(_) => panic!("a script holds the device"),
    }
}

fn ticks(desk: &mut Rehearsal, n: u32) {
    for _ in 0..n {
        desk.tick().unwrap();
    }
}

#[test]
fn the_hand_goes_where_the_mouse_goes_and_stays_in_its_box() {
    let mut desk = desk();
    mouse(&mut desk).moved(0.25, 0.125);
    ticks(&mut desk, 600);
    let way = desk.device.position() - DVec3::new(0.04, 0.02, 0.0);
    // Dry friction of 0.26 N holds the handle of a hand of 200 N/m within 1.3 mm of that.
    assert!(way.length() < 0.001_5, "{way}");
    mouse(&mut desk).wheel(-3.0);
    ticks(&mut desk, 600);
    assert!((desk.device.position().z - 0.012).abs() < 0.001_5);
    mouse(&mut desk).moved(f64::NAN, 0.0);
    mouse(&mut desk).moved(99.0, 99.0);
    ticks(&mut desk, 1_500);
    assert!(desk.device.position().abs().max_element() < 0.1, "{}", desk.device.position());
}

#[test]
fn a_force_can_be_seen_it_keeps_the_hand_from_where_the_mouse_is() {
    let mut desk = desk();
    ticks(&mut desk, 700);
    // 80 mm to the right is 10 mm behind the edge plane.
    mouse(&mut desk).moved(0.5, 0.0);
    ticks(&mut desk, 1_000);
    let x = desk.device.position().x;
    assert!((0.072..0.078).contains(&x), "{x}");
}

#[test]
fn pushing_the_mouse_with_the_left_button_held_strikes() {
    let mut desk = desk();
    // In front of the ball.
    mouse(&mut desk).wheel(-4.0);
    ticks(&mut desk, 700);
    mouse(&mut desk).hold(Buttons::FRONT);
    mouse(&mut desk).moved(0.3, -0.1);
    ticks(&mut desk, 400);
    assert!(desk.servo.report().sample.stabilised);
    for _ in 0..60 {
        mouse(&mut desk).moved(0.0, 0.3 / 60.0);
        ticks(&mut desk, 1);
    }
    ticks(&mut desk, 100);
    let is_strike = |fact: &&Fact| matches!(fact.kind, FactKind::CueBallStruck { .. });
    assert_eq!(desk.facts.iter().filter(is_strike).count(), 1);
    let ball = desk.ball(BallId::CUE).unwrap();
    assert!(ball.velocity.x > 1.0 && ball.velocity.y.abs() < 0.05, "{}", ball.velocity);
}

#[test]
fn a_quick_stroke_is_not_cut_short_by_letting_go_and_the_hand_draws_back_after_it() {
    let mut desk = desk();
    let start = DVec3::new(0.0, 0.0, 0.033);
    let hand = MouseHand::new(MouseFeel::default()).starting_at(start);
    *desk.device.guide_mut() = Guide::Mouse(hand);
    ticks(&mut desk, 700);
    mouse(&mut desk).hold(Buttons::FRONT);
    // Through the ball, and the button is up before the hand has got anywhere.
    mouse(&mut desk).moved(0.0, 0.25);
    ticks(&mut desk, 5);
    mouse(&mut desk).hold(Buttons::default());
    mouse(&mut desk).draw_back();
    ticks(&mut desk, 900);
    let is_strike = |fact: &&Fact| matches!(fact.kind, FactKind::CueBallStruck { .. });
    assert_eq!(desk.facts.iter().filter(is_strike).count(), 1);
    assert!(desk.device.position().distance(start) < 0.002, "{}", desk.device.position());
    assert!(!desk.servo.report().sample.stabilised);
}
