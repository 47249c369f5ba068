//! No level sees what it may not: what is hidden from the paper's player changes no bit of its
//! shot.

use super::{BED, R, clearance, pockets, random_view};
use glam::{DQuat, DVec2, DVec3};
use hapticbillard::ai::{Player, PlayerSettings, TableView2d};
use hapticbillard::ball::{BallPlace, BallState, Motion};
use hapticbillard::events::{
    Command, Event, PlayerReport, PlayerState, Source, Stamp, Stamped, Turn,
};
use hapticbillard::hash::{Digest, StateHash};
use hapticbillard::ids::{BallId, PlayerId};
use hapticbillard::physics::{Profile, Snapshot};
use hapticbillard::tick::{Delivered, Participant};
use hapticbillard::units::Tick;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::sync::Arc;

const OTHER: PlayerId = PlayerId::TWO;

/// A world with this view from above, at rest and lying where balls lie.
fn world(view: &TableView2d) -> Snapshot {
    let cue = (BallId::CUE, view.cue_ball.unwrap_or_default());
    let balls = view.balls.iter().map(|ball| (ball.id, ball.position));
    let at_rest = |(id, place): (BallId, DVec2)| BallState::at_rest(id, place.extend(R));
    let mut balls: Vec<_> = std::iter::once(cue).chain(balls).map(at_rest).collect();
    // A ball that is down, wherever that is.
    balls.push(BallState { place: BallPlace::Pocketed, ..at_rest((BallId(15), DVec2::ZERO)) });
    Snapshot { time_s: 0.0, balls, cue: None }
}

/// The same from above, and nothing else the same.
fn with_other_secrets(world: &Snapshot, seed: u64) -> Snapshot {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut vector = |size: f64| {
        let mut number = || random.random_range(-size..size);
        DVec3::new(number(), number(), number())
    };
    let mut other = world.clone();
    for ball in &mut other.balls {
        ball.position.z += vector(0.1).z;
        ball.velocity = vector(3.0);
        ball.angular_velocity = vector(200.0);
        ball.orientation = DQuat::from_scaled_axis(vector(3.0));
        ball.motion = Motion::Airborne;
        if ball.place == BallPlace::Pocketed {
            ball.position = vector(1.0);
        }
    }
    other
}

fn turn(player: PlayerId, view: &TableView2d) -> Event {
    let on_table = || view.balls.iter().map(|ball| ball.id);
    Event::Turn(Arc::new(Turn {
        player,
        on_table: on_table().collect(),
        legal_first: on_table().collect(),
        shot_number: 1,
        ..Turn::default()
    }))
}

fn delivered(tick: Tick, table: &Snapshot, mail: Vec<(Source, Event)>) -> Delivered {
    let stamped = |(source, event)| Stamped { stamp: Stamp { tick, source, sequence: 0 }, event };
    let table = Arc::new(Snapshot { time_s: tick.end_s(), ..table.clone() });
    Delivered { tick, events: mail.into_iter().map(stamped).collect(), table }
}

fn player(id: PlayerId, seed: u64) -> Player {
    let settings = PlayerSettings::paper(seed, Profile::Standard);
    Player::new(id, settings, BED, pockets(), R, clearance())
}

/// All that the player says from its turn to its stroke, to the last bit, and its own state.
fn shot(view: &TableView2d, table: &Snapshot, whispers: &[Event]) -> (Vec<String>, Digest) {
    let mut player = player(PlayerId::ONE, 7);
    let _ = player.start(table);
    let mut said = Vec::new();
    let mut tick = Tick(10);
    let mut mail = vec![(Source::Rules, turn(PlayerId::ONE, view))];
    while player.state() != PlayerState::Shooting {
        mail.extend(whispers.iter().cloned().map(|event| (Source::Ai(OTHER), event)));
        let outcome = player.collect(&delivered(tick, table, std::mem::take(&mut mail)));
        // Printed numbers are those that were, signs of zeros included.
        said.push(format!("{outcome:?}"));
        tick = outcome.wake.expect("a player at the table wants to go on");
    }
    let plan = player.plan().expect("it has decided");
    said.push(format!("{plan:?} {:?}", player.stroke()));
    let mut hash = StateHash::new();
    player.hash(&mut hash);
    (said, hash.finish())
}

#[test]
fn the_papers_player_plays_the_same_shot_whatever_is_hidden() {
    for seed in 0..40 {
        let view = random_view(seed, 1 + (seed % 9) as u16);
        let seen = world(&view);
        let hidden = with_other_secrets(&seen, seed);
        assert_ne!(seen, hidden);
        assert_eq!(shot(&view, &hidden, &[]), shot(&view, &seen, &[]), "table {seed}");
    }
}

#[test]
fn it_hears_nothing_of_the_other_players_plans() {
    let view = random_view(3, 6);
    let seen = world(&view);
    // The other has a plan of its own, from a turn that it had, and tells what it does.
    let mut other = player(OTHER, 99);
    let mut tick = Tick(10);
    let mut mail = vec![(Source::Rules, turn(OTHER, &view))];
    let mut whispers =
        vec![Event::Player(PlayerReport { player: OTHER, state: PlayerState::Aiming })];
    while other.state() != PlayerState::Shooting {
        let outcome = other.collect(&delivered(tick, &seen, std::mem::take(&mut mail)));
        let events = outcome.publish.into_iter().map(|publication| publication.event);
        whispers.extend(events);
        tick = outcome.wake.expect("a player at the table wants to go on");
    }
    let strokes = |event: &&Event| matches!(event, Event::Command(Command::MoveCue(_)));
    assert!(whispers.iter().filter(strokes).count() >= 2, "its approach and its stroke");
    assert_eq!(shot(&view, &seen, &whispers), shot(&view, &seen, &[]));
}

#[test]
fn what_can_be_seen_does_change_the_shot() {
    let view = random_view(3, 6);
    let seen = world(&view);
    let mut moved = seen.clone();
    let cue = &mut moved.balls[0];
    cue.position += DVec3::new(1e-9, 0.0, 0.0);
    assert_ne!(shot(&view, &moved, &[]), shot(&view, &seen, &[]));
}
