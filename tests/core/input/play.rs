//! Whole turns and games of a person.

use super::desk::{Desk, free_play, shipped};
use glam::DVec2;
use hapticbillard::ai::{Goal, TableView2d, plan_shot};
use hapticbillard::ball::POOL_RADIUS_M;
use hapticbillard::events::{Event, Foul, MenuAction, ShotKind, TurnAfter};
use hapticbillard::hash::StateHash;
use hapticbillard::ids::PlayerId;
use hapticbillard::input::feel::PLACING_M_PER_HEIGHT;
use hapticbillard::input::{Button, HumanMode, Key, RawInput};
use hapticbillard::replay::Line;
use hapticbillard::table::Table;
use hapticbillard::tick::{End, Pace};
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;
use std::sync::Arc;

#[test]
fn a_turn_of_free_play_goes_from_aim_to_rest_to_the_next_aim() {
    let mut desk = Desk::new(&free_play(&[(0, -0.4, 0.0), (1, 0.4, 0.0), (2, 0.9, 0.5)]));
    desk.wait(3);
    desk.stroke(0.3, 1.5, 125);
    assert_eq!(desk.mode(), HumanMode::Watching);
    desk.wait_until(20_000, |desk| !desk.verdicts().is_empty());
    desk.wait(3);
    assert!(desk.verdicts()[0].legal);
    assert_eq!(desk.verdicts()[0].turn, TurnAfter::Continue);
    assert_eq!(desk.mode(), HumanMode::Aiming);
    let cue = desk.table().cue.unwrap();
    assert!(!cue.solid && cue.tip.distance(desk.cue_ball().position) < 0.1);
}

#[test]
fn a_pause_holds_the_hand_and_not_the_eye_and_is_told_once() {
    let mut desk = Desk::new(&free_play(&[(0, -0.4, 0.0), (1, 0.4, 0.0)]));
    desk.wait(400);
    let before = desk.view();
    desk.tick(&[RawInput::Key { key: Key::Escape, down: true }]);
    assert!(desk.last().paused && desk.mode() == HumanMode::Paused);
    desk.wait(5);
    let frames = desk.frames().len();
    desk.moved(0.3, 0.3);
    desk.button(Button::Left, true);
    desk.hold(Key::Up, 50);
    desk.tick(&[
        RawInput::Button { button: Button::Middle, down: true },
        RawInput::Moved { right: 0.4, up: 0.0 },
        RawInput::Button { button: Button::Middle, down: false },
    ]);
    assert!(desk.last().paused && desk.frames().len() == frames, "nothing enters in a pause");
    assert_eq!(desk.view().aim, before.aim);
    assert_ne!(desk.view().camera, before.camera);
    desk.button(Button::Left, false);
    // The answer that ends the pause carries nothing, because nobody would use it.
    desk.tick(&[RawInput::Key { key: Key::Letter('p'), down: true }]);
    assert!(!desk.last().paused && desk.last().frame.is_empty());
    desk.wait(1);
    let menu = |event: Event| match event {
        Event::Menu(action) => Some(action),
        _ => None,
    };
    let told: Vec<_> = desk.heard().into_iter().filter_map(menu).collect();
    assert_eq!(told, [MenuAction::Pause, MenuAction::Resume]);
    assert_eq!(desk.mode(), HumanMode::Aiming);
}

#[test]
fn q_quits_in_a_pause_only_and_closing_the_window_always() {
    let mut desk = Desk::new(&free_play(&[(0, -0.4, 0.0), (1, 0.4, 0.0)]));
    desk.key(Key::Letter('q'));
    assert!(!desk.last().quit);
    desk.key(Key::Letter('p'));
    desk.tick(&[RawInput::Key { key: Key::Letter('q'), down: true }]);
    assert!(desk.last().quit);
    desk.tick(&[]);
    assert_eq!(desk.finished.as_ref().unwrap().end, End::Quit);

    let mut desk = Desk::new(&free_play(&[(0, -0.4, 0.0), (1, 0.4, 0.0)]));
    desk.tick(&[RawInput::Closed]);
    assert!(desk.last().quit);
}

/// A person who plans like the computer but plays by mouse; now and then into the void.
struct Person {
    table: Arc<Table>,
    random: Pcg64Mcg,
    shots: u32,
}

impl Person {
    fn look(&self, desk: &Desk) -> TableView2d {
        let bed = self.table.bed.unwrap();
        TableView2d::of(desk.table(), &bed, &self.table.pockets, POOL_RADIUS_M)
    }

    /// Takes the ball to the nearest allowed place of a coarse search, and puts it down.
    fn place(&mut self, desk: &mut Desk) {
        for i in 0..400 {
            let (column, row) = (i % 20, i / 20);
            let wanted = DVec2::new(-0.7 - 0.02 * f64::from(row), -0.4 + 0.04 * f64::from(column));
            let by = (wanted - desk.view().placing.unwrap()) / PLACING_M_PER_HEIGHT;
            desk.moved(by.x, by.y);
            if desk.view().placing_allowed {
                break;
            }
        }
        desk.button(Button::Left, true);
        desk.button(Button::Left, false);
        desk.wait(3);
    }

    fn shoot(&mut self, desk: &mut Desk) {
        let view = self.look(desk);
        let turn = desk.turn().unwrap();
        let zone = turn.ball_in_hand.zone();
        let goal = Goal::of(&turn, &view, zone);
        let cue_ball = desk.cue_ball().position.truncate();
        let plan = plan_shot(&view, cue_ball, &goal, 0.07, &mut self.random);
        self.shots += 1;
        let (mut way, mut speed_m_s) = (plan.direction, plan.speed_m_s);
        if self.shots == 2 && turn.shot != ShotKind::Break {
            // Softly at the nearer long rail: no ball is met, which is a foul.
            way = DVec2::new(0.0, if cue_ball.y < 0.0 { -1.0 } else { 1.0 });
            speed_m_s = 0.1;
        }
        desk.turn_to(libm::atan2(way.y, way.x));
        let pull_m = (0.1 + 0.06 * speed_m_s).min(0.4);
        desk.stroke(pull_m, speed_m_s, 125);
    }
}

#[test]
fn a_person_and_a_computer_play_eight_ball_to_its_end() {
    let scene = shipped("eight_ball");
    let table = Arc::new(Table::preset("pool-9ft").unwrap());
    let mut person = Person { table: table.clone(), random: Pcg64Mcg::seed_from_u64(3), shots: 0 };
    let mut desk = Desk::at(&scene, table.clone(), Pace::EveryTick);
    while desk.finished.is_none() {
        match desk.mode() {
            HumanMode::Placing => person.place(&mut desk),
            HumanMode::Aiming => person.shoot(&mut desk),
            _ => desk.tick(&[]),
        }
        assert!(person.shots < 200, "the game does not end");
    }
    assert_eq!(desk.finished.as_ref().unwrap().end, End::Over);
    let verdicts = desk.verdicts();
    let own = || verdicts.iter().filter(|verdict| verdict.player == Some(PlayerId::ONE));
    assert!(
        own().any(|verdict| verdict.fouls.contains(&Foul::NoContact)),
        "the foul that was meant"
    );
    assert!(own().any(|verdict| verdict.legal && !verdict.pocketed.is_empty()), "a pot");
    let twice = [Foul::DoubleHit, Foul::OutOfTurn, Foul::Moving, Foul::BadPlacement];
    assert!(own().all(|verdict| !verdict.fouls.iter().any(|foul| twice.contains(foul))));
    assert!(verdicts.iter().any(|verdict| verdict.player == Some(PlayerId::TWO)));
    assert_eq!(verdicts.iter().filter(|verdict| verdict.turn == TurnAfter::End).count(), 1);
}

#[test]
fn two_people_share_the_mouse() {
    let text = hapticbillard::shipped::scene("eight_ball").unwrap();
    let text = text.replace("kind = \"computer\"\nstrength = 50", "kind = \"human\"");
    let scene = hapticbillard::scene::Scene::parse("two.toml", &text).unwrap();
    let mut desk = Desk::new(&scene);
    desk.wait(3);
    // The first breaks softly into the void; the second has the ball in hand.
    desk.button(Button::Left, true);
    desk.button(Button::Left, false);
    desk.wait(3);
    desk.turn_to(std::f64::consts::PI);
    desk.stroke(0.2, 0.3, 125);
    desk.wait_until(30_000, |desk| !desk.verdicts().is_empty());
    desk.wait(3);
    assert_eq!(desk.turn().unwrap().player, PlayerId::TWO);
    assert_eq!(desk.mode(), HumanMode::Placing);
}

/// Frames, hash and recording of one short log of reports.
fn logged() -> (Vec<String>, u64, Vec<Line>) {
    let scene = free_play(&[(0, -0.4, 0.0), (1, 0.4, 0.1), (2, 0.9, 0.5)]);
    let mut desk = Desk::new(&scene);
    desk.wait(3);
    desk.moved(0.01, 0.2);
    desk.hold(Key::Up, 300);
    desk.stroke(0.35, 3.0, 60);
    desk.wait(2000);
    let mut hash = StateHash::new();
    for ball in &desk.table().balls {
        hash.vec3(ball.position);
        hash.vec3(ball.angular_velocity);
    }
    let lines: Vec<Line> =
        desk.frames().into_iter().map(|(tick, publish)| Line::Frame { tick, publish }).collect();
    (lines.iter().map(Line::to_json).collect(), hash.finish().0, lines)
}

#[test]
fn the_same_reports_give_the_same_frames_and_the_same_balls() {
    let (first, second) = (logged(), logged());
    assert!(first.0.len() > 300);
    assert_eq!(first.0, second.0);
    assert_eq!(first.1, second.1);
}

#[test]
fn a_person_is_asked_in_every_tick_whatever_the_pace() {
    let scene = free_play(&[(0, -0.4, 0.0), (1, 0.4, 0.1)]);
    let table = Arc::new(Table::preset("pool-9ft").unwrap());
    let play = |pace| {
        let mut desk = Desk::at(&scene, table.clone(), pace);
        desk.wait(3);
        desk.stroke(0.3, 2.0, 125);
        desk.wait(500);
        (desk.frames(), desk.cue_ball().position)
    };
    assert_eq!(play(Pace::EveryTick), play(Pace::Jump));
}
