//! A shot of a real game, filmed and seen again.

use crate::input::desk::{Desk, free_play};
use hapticbillard::events::FactKind;
use hapticbillard::ids::BallId;
use hapticbillard::input::{Action, HandInput, View};
use hapticbillard::physics::Snapshot;
use hapticbillard::renderer::{Mount, Reel, Screening};
use hapticbillard::table::Table;
use std::sync::{Arc, OnceLock};

fn table() -> Arc<Table> {
    static TABLE: OnceLock<Arc<Table>> = OnceLock::new();
    TABLE.get_or_init(|| Arc::new(Table::preset("pool-9ft").unwrap())).clone()
}

/// A shot with a collision, as a window films it: every fourth state; and all states of it.
fn shot() -> &'static (Reel, Vec<Snapshot>) {
    static SHOT: OnceLock<(Reel, Vec<Snapshot>)> = OnceLock::new();
    SHOT.get_or_init(|| {
        let mut desk = Desk::new(&free_play(&[(0, -0.4, 0.0), (1, 0.4, 0.02)]));
        desk.wait(100);
        let (mut reel, mut states, mut known) = (Reel::default(), Vec::new(), 0);
        let mut tick = |desk: &Desk, n: u64| {
            let state = desk.table().clone();
            if n.is_multiple_of(4) {
                reel.take(&Arc::new(state.clone()));
            }
            states.push(state);
            let facts = desk.facts();
            for fact in &facts[known..] {
                match fact.kind {
                    FactKind::CueBallStruck { ball, .. } => reel.struck(ball),
                    FactKind::Settled { .. } => reel.settled(fact.time_s),
                    _ => {}
                }
            }
            known = facts.len();
        };
        // The stroke itself is not seen tick by tick here; the cue has come near enough.
        desk.stroke(0.2, 1.4, 1000);
        for n in 0..12_000 {
            desk.tick(&[]);
            tick(&desk, n);
        }
        (reel, states)
    })
}

#[test]
fn the_film_shows_every_ball_where_it_was() {
    let (reel, states) = shot();
    let film = reel.clone().film().expect("a shot was made");
    let first = film.at(0.0);
    let mut worst = 0.0_f64;
    for state in states.iter().filter(|state| first.time_s <= state.time_s) {
        let seen = film.at(state.time_s - first.time_s);
        if film.length_s() < state.time_s - first.time_s {
            break;
        }
        for (a, b) in seen.balls.iter().zip(&state.balls) {
            worst = worst.max(a.position.distance(b.position));
        }
    }
    // Between two of its pictures a ball may meet another: 4 ms at a metre a second.
    assert!(worst < 2e-3, "{worst} m");
    assert_eq!((film.cue_ball(), film.ways()), (BallId::CUE, reel.ways()));
    let moved = reel.ways().iter().filter(|way| 10 < way.points.len()).count();
    assert_eq!(moved, 2, "both balls leave a trace");
}

#[test]
fn whoever_sees_it_can_slow_it_hold_it_and_walk_round() {
    let film = shot().0.clone().film().unwrap();
    let mut shown = Screening::new(film.clone(), table());
    let (world, view) = shown.seen();
    assert_eq!((world.time_s, view.look.view), (film.at(0.0).time_s, View::Follow));
    // It begins at half the speed.
    (0..60).for_each(|_| shown.pass(1.0 / 60.0));
    assert!((shown.place_s().0 - 0.5).abs() < 1e-9, "{:?}", shown.place_s());
    shown.turn(Action::FilmSlower);
    (0..60).for_each(|_| shown.pass(1.0 / 60.0));
    assert!((shown.place_s().0 - 0.75).abs() < 1e-9);
    shown.turn(Action::FilmHold);
    let before = shown.seen();
    shown.hear(HandInput::Moved { right: 0.2, up: 0.0 });
    (0..60).for_each(|_| shown.pass(1.0 / 60.0));
    let after = shown.seen();
    assert_eq!(before.0, after.0, "it stands still");
    assert!(0.1 < before.1.camera.eye.distance(after.1.camera.eye), "and the eye goes round");
    shown.turn(Action::FilmHold);
    (0..9).for_each(|_| shown.turn(Action::FilmFaster));
    assert!((shown.rate() - 2.0).abs() < 1e-12);
    (0..600).for_each(|_| shown.pass(1.0 / 60.0));
    assert!(shown.is_over());
    // From its end it can begin again.
    shown.turn(Action::FilmHold);
    assert!(!shown.is_over() && shown.place_s().0 == 0.0);
}

#[test]
fn the_eye_rides_with_the_ball_of_the_film() {
    let film = shot().0.clone().film().unwrap();
    let mut shown = Screening::new(film, table());
    (0..120).for_each(|_| shown.pass(1.0 / 60.0));
    let mut mount = Mount::default();
    let mut eye = |shown: &Screening| {
        let (world, view) = shown.seen();
        let ball = world.balls[0].position;
        mount.carry(view, &world).camera.eye - ball
    };
    let (before, place) = (eye(&shown), shown.seen().0.balls[0].position);
    (0..60).for_each(|_| shown.pass(1.0 / 60.0));
    let moved = shown.seen().0.balls[0].position.distance(place);
    assert!(0.05 < moved, "the ball goes on: {moved}");
    assert!((eye(&shown) - before).with_z(0.0).length() < 1e-6);
}

#[test]
fn a_shot_that_is_taken_back_leaves_no_film() {
    let mut reel = shot().0.clone();
    assert!(reel.has_film());
    reel.forget();
    assert!(!reel.has_film() && reel.film().is_none() && reel.ways().is_empty());
}
