//! The actor runtime gives the bits of lockstep, whatever the threads; recordings replay to the
//! end; a mock of the input plays a whole game.

use crate::mocks::MockHand;
use hapticbillard::cast::Cast;
use hapticbillard::hash::Digest;
use hapticbillard::ids::PlayerId;
use hapticbillard::lockstep;
use hapticbillard::replay::{Recording, TickHash};
use hapticbillard::scene::{Overrides, PlayerKind};
use hapticbillard::tally::{Scorer, Tally};
use hapticbillard::tick::{End, Finished, Pace};
use hapticbillard::units::Tick;
use hapticbillard_actors::files::load_scene;
use hapticbillard_actors::game::{Driver, Headless, LIMIT, Stage, play_headless};
use hapticbillard_actors::runtime::{self, InputPort};
use std::path::PathBuf;
use std::sync::Arc;

fn stage(name: &str, seed: u64) -> Stage {
    let stage = Stage::new(&load_scene(name).unwrap(), name).unwrap();
    stage.with(Overrides { seed: Some(seed), ..Overrides::default() })
}

fn all(finished: &Finished) -> (End, Tick, Option<Digest>) {
    (finished.end, finished.tick, finished.hash.as_ref().map(TickHash::all))
}

fn lockstep(stage: &Stage, pace: Pace, limit: Tick) -> Finished {
    let setup = lockstep::Setup { pace, ..lockstep::Setup::headless(limit) };
    lockstep::run(stage.cast().unwrap(), setup).unwrap()
}

fn actors(stage: &Stage, pace: Pace, workers: usize, thread: bool, limit: Tick) -> Finished {
    let base = runtime::Setup::headless(limit);
    let setup = runtime::Setup { pace, workers, physics_thread: thread, ..base };
    runtime::run(stage.cast().unwrap(), setup).unwrap()
}

#[test]
fn actors_give_the_bits_of_lockstep_with_any_number_of_workers() {
    let stage = stage("eight_ball_headless", 3);
    let reference = lockstep(&stage, Pace::Jump, LIMIT);
    assert_eq!(reference.end, End::Over);
    for workers in [1, 2, 4] {
        let run = actors(&stage, Pace::Jump, workers, false, LIMIT);
        assert_eq!(all(&run), all(&reference), "{workers} workers");
    }
    let run = actors(&stage, Pace::Jump, 1, true, LIMIT);
    assert_eq!(all(&run), all(&reference), "physics on a thread of its own");
}

#[test]
fn players_that_search_in_the_background_decide_as_in_lockstep() {
    let stage = stage("eight_ball_headless", 3);
    let players = vec![PlayerKind::Computer(70).into(), PlayerKind::Club.into()];
    let stage = stage.with(Overrides { players, seed: Some(5), ..Overrides::default() });
    let limit = Tick(120_000);
    let reference = lockstep(&stage, Pace::Jump, limit);
    assert!(reference.hash.is_some());
    for workers in [1, 2] {
        let run = actors(&stage, Pace::Jump, workers, false, limit);
        assert_eq!(all(&run), all(&reference), "{workers} workers");
    }
}

#[test]
fn jumping_changes_no_bit() {
    // A minute of each, tick by tick and jumping. The last tick in which anybody is called is the
    // same, so its hash is.
    let limit = Tick(60_000);
    for name in ["eight_ball_headless", "break_shot", "one_ball"] {
        let stage = stage(name, 5);
        let hashes = [Pace::EveryTick, Pace::Jump].map(|pace| {
            let mut lines = Vec::new();
            let mut record = |line: &hapticbillard::replay::Line| lines.push(line.to_json());
            let record: Option<&mut dyn FnMut(&hapticbillard::replay::Line)> = Some(&mut record);
            let base = lockstep::Setup::headless(limit);
            let observers = vec![Box::new(Everything) as Box<_>];
            let setup = lockstep::Setup { pace, record, observers, ..base };
            lockstep::run(stage.cast().unwrap(), setup).unwrap();
            // The end differs: a jump knows earlier that nothing will happen any more.
            lines.pop();
            lines
        });
        assert!(!hashes[0].is_empty(), "{name}");
        assert_eq!(hashes[0], hashes[1], "{name}");
    }
}

/// Listens to everything, so that every fact makes a hash.
struct Everything;

impl hapticbillard::tick::Participant for Everything {
    fn source(&self) -> hapticbillard::events::Source {
        hapticbillard::events::Source::Runtime
    }

    fn topics(&self) -> hapticbillard::events::Topics {
        hapticbillard::events::Topics::ALL
    }

    fn start(&mut self, _: &hapticbillard::physics::Snapshot) -> hapticbillard::tick::Outcome {
        hapticbillard::tick::Outcome::default()
    }

    fn collect(&mut self, _: &hapticbillard::tick::Delivered) -> hapticbillard::tick::Outcome {
        hapticbillard::tick::Outcome::default()
    }

    fn hash(&self, _: &mut hapticbillard::hash::StateHash) {}
}

/// A file that is gone when the test is.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str) -> Self {
        let folder = std::env::temp_dir();
        Scratch(folder.join(format!("hapticbillard-{}-{name}.jsonl", std::process::id())))
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
    }
}

fn replay(path: &PathBuf, driver: Driver) -> (Finished, Tally) {
    let recording = Recording::parse(&std::fs::read_to_string(path).unwrap()).unwrap();
    let stage = Stage::of_recording(&recording).unwrap();
    assert!(!recording.hashes.is_empty());
    let expected = recording.hashes.len() as u64;
    let replay = Some(Arc::new(recording));
    let how = Headless { driver, replay, verify: true, ..Headless::default() };
    let (finished, tally) = play_headless(&stage, how).unwrap();
    assert_eq!(finished.verified, expected);
    (finished, tally)
}

#[test]
fn a_recording_of_either_driver_replays_with_both() {
    let stage = stage("eight_ball_headless", 8);
    for driver in [Driver::Actors, Driver::Lockstep] {
        let file = Scratch::new(&format!("{driver:?}"));
        let record = Some(file.0.clone());
        let how = Headless { driver, record, ..Headless::default() };
        let (finished, _) = play_headless(&stage, how).unwrap();
        for other in [Driver::Actors, Driver::Lockstep] {
            let (replayed, _) = replay(&file.0, other);
            assert_eq!(all(&replayed), all(&finished), "{driver:?}, then {other:?}");
        }
    }
}

#[test]
fn a_mock_of_the_input_plays_a_whole_game() {
    let name = "eight_ball";
    let stage = stage(name, 11);
    let human = stage.scene.players.iter().position(|p| p.kind == PlayerKind::Human).unwrap();
    let human = PlayerId(human as u8 + 1);
    let cast: Cast = stage.cast().unwrap();
    let hand = MockHand::new(human, 21, &cast.table);
    let file = Scratch::new("mock");
    let scorer = Scorer::default();
    let setup = runtime::Setup {
        // A hand may act at any tick.
        pace: Pace::EveryTick,
        input: InputPort::Hand(Box::new(hand)),
        record: Some((file.0.clone(), stage.header())),
        observers: vec![Box::new(scorer.clone())],
        ..runtime::Setup::headless(LIMIT)
    };
    let finished = runtime::run(cast, setup).unwrap();
    let tally = scorer.tally();
    assert_eq!(finished.end, End::Over);
    assert!(tally.over && tally.shots[human.index()] > 0, "{tally:?}");

    let (replayed, again) = replay(&file.0, Driver::Lockstep);
    assert_eq!((all(&replayed), again), (all(&finished), tally));
    replay(&file.0, Driver::Actors);
}

#[test]
fn a_changed_recording_is_found_out_and_the_ball_is_named() {
    let stage = stage("eight_ball_headless", 8);
    let file = Scratch::new("changed");
    let how = Headless { record: Some(file.0.clone()), ..Headless::default() };
    play_headless(&stage, how).unwrap();
    let text = std::fs::read_to_string(&file.0).unwrap();
    let mut recording = Recording::parse(&text).unwrap();
    let (tick, hash) = recording.hashes.iter_mut().nth(5).unwrap();
    let (tick, ball) = (*tick, hash.balls[3].0);
    hash.balls[3].1 ^= 1;
    hash.physics.0 ^= 1;
    let replay = Some(Arc::new(recording));
    let how = Headless { replay, verify: true, ..Headless::default() };
    let error = play_headless(&stage, how).unwrap_err().to_string();
    assert!(error.contains(&format!("diverges at tick {} ", tick.0)), "{error}");
    assert!(error.contains(&format!("ball {ball} is not as recorded")), "{error}");
}
