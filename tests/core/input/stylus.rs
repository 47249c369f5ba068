//! A stylus beside the mouse: who strikes, and what becomes of a stroke whose device is lost.

use super::desk::{Desk, free_play};
use glam::{DVec2, DVec3};
use hapticbillard::ball::POOL_RADIUS_M;
use hapticbillard::cue::{CuePath, CuePiece, TIP_RADIUS_M};
use hapticbillard::events::{Command, Event, Health, MenuAction};
use hapticbillard::input::feel::AIM_RAD_PER_HEIGHT;
use hapticbillard::input::{Button, HumanMode, Key, RawInput, STYLUS, StylusWord};
use hapticbillard::units::TICK_S;
use std::sync::Arc;

const CUE_BALL: DVec3 = DVec3::new(-0.4, 0.0, POOL_RADIUS_M);

fn desk() -> Desk {
    let scene = free_play(&[(0, CUE_BALL.x, CUE_BALL.y), (1, 0.4, 0.0), (2, 0.9, 0.5)]);
    Desk::with_stylus(&scene)
}

/// The tip's middle is `at_m` from where it meets the cue ball and moves on at `speed_m_s`.
fn held(desk: &Desk, at_m: f64, speed_m_s: f64, armed: bool) -> StylusWord {
    let direction = DVec3::X;
    let contact = desk.cue_ball().position - direction * (POOL_RADIUS_M + TIP_RADIUS_M);
    let piece = CuePiece {
        // The game begins with tick 1, whose frame is the second that is asked for.
        start_s: (desk.frames_asked() - 1) as f64 * TICK_S,
        duration_s: 5.0 * TICK_S,
        position: contact + direction * at_m,
        velocity: direction * speed_m_s,
        acceleration: DVec3::ZERO,
        direction,
        direction_end: direction,
    };
    let pieces = std::iter::once(piece).collect();
    let path = Some(Arc::new(CuePath { solid: armed, pieces }));
    StylusWord::Held { direction, armed, path, camera: None }
}

/// A stylus at rest before the cue ball.
fn rest(desk: &mut Desk, ticks: u32, armed: bool) {
    for _ in 0..ticks {
        desk.say(held(desk, -0.05, 0.0, armed));
    }
}

/// A stroke with the stylus, until it has met something.
fn stroke(desk: &mut Desk, speed_m_s: f64) {
    let mut at_m = -0.05;
    while desk.mode() == HumanMode::HoldingStylus {
        assert!(at_m < 0.1, "the stroke met nothing");
        desk.say(held(desk, at_m, speed_m_s, true));
        at_m += speed_m_s * TICK_S;
    }
}

/// What was told of the stylus: whether it is there.
fn told(desk: &Desk) -> Vec<bool> {
    let told = |event| match event {
        Event::Health(health) => match &*health {
            Health::ActorFailed { actor, .. } if actor == STYLUS => Some(false),
            Health::ActorRestarted { actor } if actor == STYLUS => Some(true),
            _ => None,
        },
        _ => None,
    };
    desk.heard().into_iter().filter_map(told).collect()
}

fn menus(desk: &Desk) -> Vec<MenuAction> {
    let menu = |event| match event {
        Event::Menu(action) => Some(action),
        _ => None,
    };
    desk.heard().into_iter().filter_map(menu).collect()
}

/// The last cue that was shown touches nothing.
fn is_cue_harmless(desk: &Desk) -> bool {
    let paths = desk.commands().into_iter().rev();
    let path = |command| match command {
        Command::MoveCue(path) => Some(path),
        _ => None,
    };
    !paths.filter_map(path).next().unwrap().solid
}

#[test]
fn the_stylus_strikes_and_the_left_button_does_not() {
    let mut desk = desk();
    rest(&mut desk, 5, false);
    assert_eq!(desk.mode(), HumanMode::HoldingStylus);
    desk.button(Button::Left, true);
    desk.moved(0.0, 0.5);
    desk.button(Button::Left, false);
    rest(&mut desk, 20, true);
    assert_eq!((desk.mode(), desk.tips()), (HumanMode::HoldingStylus, 0));
    stroke(&mut desk, 2.0);
    assert_eq!((desk.mode(), desk.tips()), (HumanMode::Watching, 1));
    assert!((desk.view().strength_m_s - 2.0).abs() < 1e-9, "{:?}", desk.view());
    desk.wait_until(30_000, |desk| !desk.verdicts().is_empty());
    desk.wait(3);
    // And again.
    assert!(desk.verdicts()[0].legal && desk.mode() == HumanMode::HoldingStylus);
    assert!(told(&desk).is_empty() && menus(&desk).is_empty());
}

#[test]
fn a_device_that_is_lost_in_an_armed_stroke_stops_time_and_then_the_mouse_strikes() {
    let mut desk = desk();
    rest(&mut desk, 5, true);
    desk.say(StylusWord::Lost);
    assert!(desk.last().paused && desk.mode() == HumanMode::Paused);
    assert!(is_cue_harmless(&desk));
    desk.say(StylusWord::Lost);
    assert!(desk.last().paused);
    // It is back before the player goes on: the mouse strikes all the same.
    rest(&mut desk, 5, true);
    assert!(desk.last().paused);
    desk.tick(&[RawInput::Key { key: Key::Letter('p'), down: true }]);
    rest(&mut desk, 5, true);
    assert_eq!((desk.mode(), desk.tips()), (HumanMode::Aiming, 0));
    assert_eq!(told(&desk), [false]);
    assert_eq!(menus(&desk), [MenuAction::Pause, MenuAction::Resume]);
    desk.stroke(0.3, 1.5, 125);
    assert_eq!(desk.tips(), 1);
    // With the next address the stylus strikes, and the player is told.
    desk.wait_until(30_000, |desk| !desk.verdicts().is_empty());
    rest(&mut desk, 5, false);
    assert_eq!(told(&desk), [false, true]);
    stroke(&mut desk, 1.0);
    assert_eq!(desk.tips(), 2);
}

#[test]
fn a_device_that_is_lost_in_no_stroke_leaves_the_cue_to_the_mouse_at_once() {
    let mut desk = desk();
    rest(&mut desk, 5, false);
    desk.say(StylusWord::Lost);
    assert!(!desk.last().paused && desk.mode() == HumanMode::Aiming);
    desk.wait(2);
    assert!(is_cue_harmless(&desk) && told(&desk) == [false] && menus(&desk).is_empty());
    desk.stroke(0.3, 1.5, 125);
    assert_eq!((desk.tips(), desk.mode()), (1, HumanMode::Watching));
    // Lost for good: the next address is the mouse's.
    desk.say(StylusWord::Lost);
    desk.wait_until(30_000, |desk| !desk.verdicts().is_empty());
    desk.wait(3);
    assert_eq!((desk.mode(), told(&desk)), (HumanMode::Aiming, vec![false]));
}

#[test]
fn a_device_that_is_lost_while_balls_roll_takes_its_cue_away() {
    let mut desk = desk();
    rest(&mut desk, 5, true);
    stroke(&mut desk, 2.0);
    desk.say(StylusWord::Lost);
    desk.wait(400);
    assert!(!desk.last().paused && is_cue_harmless(&desk));
    let cue = desk.table().cue.unwrap();
    assert!(cue.tip.distance(CUE_BALL) > 0.1, "{cue:?}");
}

#[test]
fn the_mouse_turns_the_workspace_unless_a_stroke_is_armed() {
    let mut desk = desk();
    rest(&mut desk, 5, false);
    let before = desk.view().aim;
    desk.moved(0.1, 0.0);
    assert_eq!(desk.take_turn(), DVec2::new(-0.1 * AIM_RAD_PER_HEIGHT, 0.0));
    assert_eq!(desk.take_turn(), DVec2::ZERO);
    desk.hold(Key::PageUp, 10);
    assert!(desk.take_turn().y > 0.0);
    rest(&mut desk, 1, true);
    desk.moved(0.1, 0.0);
    desk.hold(Key::PageUp, 10);
    assert_eq!(desk.take_turn(), DVec2::ZERO);
    // What the cue points along is the stylus' own affair.
    assert_eq!(desk.view().aim, before);
}

#[test]
fn a_pause_in_an_armed_stroke_leaves_no_cue_behind_that_strikes() {
    let mut desk = desk();
    rest(&mut desk, 5, true);
    assert!(!is_cue_harmless(&desk));
    desk.tick(&[RawInput::Key { key: Key::Letter('p'), down: true }]);
    assert!(desk.last().paused && is_cue_harmless(&desk));
}
