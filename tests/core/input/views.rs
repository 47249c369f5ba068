//! Where a table is seen from: views that follow a ball, and the way from one to the other.

use super::desk::{Desk, free_play};
use glam::DVec3;
use hapticbillard::ids::BallId;
use hapticbillard::input::{CameraPose, HumanMode, Key, RawInput, View};
use hapticbillard::renderer::Mount;

fn desk() -> Desk {
    let mut desk = Desk::new(&free_play(&[(0, -0.4, 0.0), (1, 0.4, 0.0)]));
    desk.wait(400);
    desk
}

/// The camera as a window shows it, with the ball that it rides.
fn shown(desk: &Desk) -> CameraPose {
    Mount::default().carry(desk.view(), desk.table()).camera
}

fn go_to(desk: &mut Desk, view: View) {
    while desk.view().look.view != view {
        desk.key(Key::Letter('w'));
    }
    desk.wait(400);
}

#[test]
fn one_key_leads_through_all_views_and_back() {
    let mut desk = desk();
    let behind_cue = shown(&desk);
    let mut eyes = Vec::new();
    for view in View::ALL.into_iter().skip(1).chain([View::Usual]) {
        desk.key(Key::Letter('w'));
        assert_eq!(desk.view().look.view, view);
        desk.wait(400);
        let camera = shown(&desk);
        let ahead = (camera.target - camera.eye).normalize();
        assert!(ahead.z < -0.1, "{view:?} looks down at the table: {ahead}");
        eyes.push((view, camera.eye));
    }
    assert!(eyes.last().unwrap().1.distance(behind_cue.eye) < 1e-9);
    for (n, (view, eye)) in eyes.iter().enumerate() {
        for (other, place) in &eyes[n + 1..] {
            assert!(0.15 < eye.distance(*place), "{view:?} and {other:?} are the same");
        }
    }
    let eye = |view| eyes.iter().find(|(one, _)| *one == view).unwrap().1;
    assert!(eye(View::Head).x < -2.0 && 2.0 < eye(View::Foot).x && eye(View::Side).y < -1.5);
    assert!(2.0 < eye(View::Bird).z);
}

#[test]
fn an_eye_that_rides_with_a_ball_keeps_its_place_beside_it_wherever_it_rolls() {
    for view in [View::Round, View::Follow] {
        let mut desk = desk();
        go_to(&mut desk, view);
        let beside = |desk: &Desk| shown(desk).eye - desk.cue_ball().position;
        let before = beside(&desk);
        desk.stroke(0.2, 1.0, 1000);
        // Round a ball nothing depends on how the cue is held; the mouse that pushes moves no eye.
        let (mut rolled, mut last) = (0.0_f64, shown(&desk).eye);
        let mut before_m_s = desk.cue_ball().velocity.length();
        for tick in 0..2_000 {
            desk.tick(&[]);
            rolled = rolled.max(desk.cue_ball().position.distance(DVec3::new(-0.4, 0.0, 0.0)));
            let (eye, now) = (shown(&desk).eye, beside(&desk));
            assert!((now - before).with_z(0.0).length() < 0.01, "{view:?} {tick}: {now} {before}");
            // No faster than the ball was or is, so it never jumps.
            let (speed, ball) = (eye.distance(last) / 1e-3, desk.cue_ball().velocity.length());
            assert!(speed < ball.max(before_m_s) + 0.2, "{view:?}: {speed} m/s");
            (last, before_m_s) = (eye, ball);
        }
        assert!(0.5 < rolled, "it rolled {rolled} m");
    }
}

#[test]
fn the_way_from_view_to_view_begins_as_fast_as_the_eye_was() {
    let mut desk = desk();
    let (mut before, mut last) = (DVec3::ZERO, shown(&desk).eye);
    let mut worst = 0.0_f64;
    for tick in 0..1_500 {
        // In the middle of one way another one is wanted.
        let wants = [100, 250, 330, 700].contains(&tick);
        let down = wants.then_some(RawInput::Key { key: Key::Letter('w'), down: true });
        let up = wants.then_some(RawInput::Key { key: Key::Letter('w'), down: false });
        desk.tick(&down.into_iter().chain(up).collect::<Vec<_>>());
        let eye = shown(&desk).eye;
        let speed = (eye - last) / 1e-3;
        if 0 < tick {
            worst = worst.max((speed - before).length());
        }
        (before, last) = (speed, eye);
    }
    // Eyes that set out at up to 3 m/s leave at that; what is faster is slowed down.
    assert!(worst < 9.0, "a jump of {worst} m/s");

    // One that is led by hand leaves as fast as it walks.
    desk.key(Key::Letter('g'));
    desk.tick(&[RawInput::Key { key: Key::Up, down: true }]);
    desk.wait(300);
    let before = shown(&desk).eye;
    desk.wait(1);
    let walks = (shown(&desk).eye - before) / 1e-3;
    assert!((walks.length() - 1.2).abs() < 0.01, "{walks}");
    desk.tick(&[RawInput::Key { key: Key::Letter('g'), down: true }]);
    let from = shown(&desk).eye;
    desk.wait(1);
    let leaves = (shown(&desk).eye - from) / 1e-3;
    // The spline begins as steeply as it walked, and bends at once.
    assert!((leaves - walks).length() < 0.1, "{walks} {leaves}");
}

#[test]
fn turning_the_cue_turns_no_eye_that_goes_round_the_ball() {
    let mut desk = desk();
    go_to(&mut desk, View::Round);
    let before = shown(&desk);
    desk.turn_to(1.2);
    assert_eq!(shown(&desk), before);
    assert_eq!(desk.view().rides.map(|(ball, _)| ball), Some(BallId::CUE));
    // Holding the key to look leads it round, at the same distance.
    desk.tick(&[RawInput::Key { key: Key::Letter('c'), down: true }]);
    desk.moved(0.3, 0.0);
    desk.tick(&[RawInput::Key { key: Key::Letter('c'), down: false }]);
    let [far, now] = [before, shown(&desk)].map(|camera| camera.eye.distance(camera.target));
    assert!((far - now).abs() < 1e-9 && 0.3 < shown(&desk).eye.distance(before.eye));
    assert_eq!(desk.mode(), HumanMode::Aiming);
}
