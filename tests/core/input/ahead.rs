//! What a person sees ahead is what happens.

use super::desk::{Desk, shipped};
use hapticbillard::ids::BallId;
use hapticbillard::input::{AimAid, HandInput, HumanMode, Key};

/// A game with the cue ball put down and aimed at the rack.
fn aiming(scene: &str) -> Desk {
    let mut desk = Desk::new(&shipped(scene));
    desk.wait(3);
    if desk.mode() == HumanMode::Placing {
        desk.key(Key::Enter);
        desk.wait(3);
    }
    assert_eq!(desk.mode(), HumanMode::Aiming);
    desk
}

#[test]
fn the_key_goes_through_what_helps_to_aim() {
    let mut desk = aiming("wpa_eight_ball");
    assert!(desk.view().ghost.is_some() && desk.view().ways.is_empty(), "a line");
    desk.key(Key::Letter('x'));
    desk.wait(40);
    assert!(desk.view().ghost.is_some() && !desk.view().ways.is_empty(), "ways");
    desk.key(Key::Letter('x'));
    desk.wait(40);
    assert!(desk.view().ghost.is_none() && desk.view().ways.is_empty(), "nothing");
    desk.hear(&[HandInput::Aid(AimAid::Ways)]);
    desk.wait(40);
    assert_eq!(desk.view().ways[0].ball, BallId::CUE);
}

#[test]
fn balls_go_where_it_was_seen_that_they_would() {
    let mut desk = aiming("training");
    desk.hear(&[HandInput::Aid(AimAid::Ways)]);
    desk.hold(Key::Letter('a'), 300);
    desk.hold(Key::Down, 900);
    // As hard as the stroke before: the first one tells how hard the second is taken to be.
    desk.hold(Key::Enter, 700);
    desk.wait_until(30_000, |desk| desk.mode() == HumanMode::Watching);
    let struck = desk.view().expected_m_s;
    assert!(1.0 < struck && struck < 3.0, "{struck}");
    desk.key(Key::Letter('u'));
    desk.wait_until(30_000, |desk| desk.mode() == HumanMode::Aiming);
    desk.wait(40);
    let ways = desk.view().ways.clone();
    let made = desk.view().expected_m_s;
    assert!((made / struck - 1.0).abs() < 0.01, "a key makes what it shows: {made}, {struck}");
    let lies = desk.table().clone();
    for way in ways.iter() {
        let from = lies.ball(way.ball).unwrap().position;
        assert!(way.points[0].distance(from) < 1e-9, "{:?} starts where it lies", way.ball);
    }
    // The same stroke again.
    desk.hold(Key::Letter('a'), 300);
    desk.hold(Key::Down, 900);
    desk.wait(40);
    let ways = desk.view().ways.clone();
    let before = desk.verdicts().len();
    desk.hold(Key::Enter, 700);
    desk.wait_until(30_000, |desk| before < desk.verdicts().len());
    let cue_way = &ways[0];
    let end = desk.table().ball(BallId::CUE).unwrap().position;
    assert!(cue_way.rests);
    let off = cue_way.points.last().unwrap().distance(end);
    assert!(off < 1e-6, "{off} m off at {end}");
}
