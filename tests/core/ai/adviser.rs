//! Advice: what the computer would play for a person, and that it works.

use crate::input::desk::Desk;
use hapticbillard::ai::{Advice, Inline};
use hapticbillard::cast::Cast;
use hapticbillard::events::{FactKind, Topic};
use hapticbillard::ids::BallId;
use hapticbillard::input::{HandInput, HumanMode};
use hapticbillard::scene::Scene;
use std::sync::Arc;

/// Free play with three balls, of which one lies before a pocket.
fn scene() -> Scene {
    let text = "[scene]\nname = \"Advice\"\n[physics]\nsolver = \"event-driven\"\n\
        [table]\npreset = \"pool-9ft\"\n[cue]\n[rules]\ngame = \"free-play\"\n\
        [[player]]\nname = \"You\"\nkind = \"human\"\n[input]\nprofile = \"default\"\n\
        [[ball]]\nid = 0\nposition_m = [0.2, 0.1]\n\
        [[ball]]\nid = 3\nposition_m = [1.05, 0.40]\n\
        [[ball]]\nid = 5\nposition_m = [-0.9, -0.2]\n";
    Scene::parse("advice.toml", text).unwrap()
}

fn advice(desk: &Desk, scene: &Scene) -> Option<Advice> {
    let table = Arc::new(scene.build_table(&mut |_| Err(String::new())).unwrap());
    let mut adviser = Cast::new(scene, table).unwrap().adviser.expect("somebody sits there");
    let topics = adviser.topics();
    assert!(topics.contains(Topic::Turn) && topics.contains(Topic::Command));
    adviser.start(desk.table());
    let question = adviser.ask(desk.turn().unwrap(), desk.table());
    let answer = question.answer(&Inline);
    // The same question has the same answer, whoever asks.
    assert_eq!(question.clone().answer(&Inline), answer);
    answer
}

#[test]
fn the_cue_is_held_as_advised_and_the_ball_falls() {
    let scene = scene();
    let mut desk = Desk::new(&scene);
    desk.wait(5);
    let advice = advice(&desk, &scene).expect("there is something to pocket");
    assert!(0.5 < advice.chance, "{advice:?}");
    let pot = advice.insight.chosen().and_then(|chosen| chosen.pot());
    let (ball, pocket) = pot.unwrap_or_else(|| panic!("{:#?}", advice.insight.prospects));
    desk.hear(&[HandInput::Hold(advice.aim)]);
    desk.wait(2);
    let held = desk.view().aim;
    assert!((held.azimuth_rad - advice.aim.azimuth_rad).abs() < 1e-12, "{held:?}");
    assert_eq!(held.side_offset, advice.aim.side_offset);
    // A hand that strikes about as hard.
    desk.stroke(0.25, advice.speed_m_s, 1000);
    desk.wait_until(20_000, |desk| {
        desk.facts().iter().any(|fact| matches!(fact.kind, FactKind::Settled { .. }))
    });
    let falls = desk.facts().into_iter().any(|fact| {
        matches!(fact.kind, FactKind::BallPocketed { ball: b, pocket: p, .. }
            if (b, p) == (ball, pocket))
    });
    assert!(falls, "{ball:?} into {pocket:?}");
}

#[test]
fn advice_changes_nothing_while_no_cue_is_aimed() {
    let scene = scene();
    let mut desk = Desk::new(&scene);
    desk.wait(5);
    let aim = desk.view().aim;
    let other = hapticbillard::cue::Aim { azimuth_rad: aim.azimuth_rad + 1.0, ..aim };
    desk.key(hapticbillard::input::Key::Escape);
    assert_eq!(desk.mode(), HumanMode::Paused);
    desk.hear(&[HandInput::Hold(other)]);
    desk.key(hapticbillard::input::Key::Escape);
    desk.wait(3);
    assert_eq!((desk.mode(), desk.view().aim), (HumanMode::Aiming, aim));
    assert!(desk.table().ball(BallId::CUE).is_some());
}
