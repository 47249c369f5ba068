//! Games that are disturbed: the same to the bit, or stopped in order with everything recorded.
//!
//! The cells of the table of failures that no seed may leave out stand in [`super::failures`];
//! here seeds choose. `FAULTS=100` tries so many games with sound and a hand.

use super::cli::{folder, lines, program};
use super::sound::heard_through;
use super::sound::speaker::Speaker;
use glam::DVec3;
use hapticbillard::haptic::{Device, DeviceSpec, DeviceState, DeviceStatus, Force};
use hapticbillard::scene::{Overrides, Scene};
use hapticbillard::tick::End;
use hapticbillard::units::Tick;
use hapticbillard_actors::files::LoadedScene;
use hapticbillard_actors::game::Stage;
use hapticbillard_actors::haptic::{self, Asked, Core, Opened, Plan, Seat, Signs};
use hapticbillard_actors::pacer::Tempo;
use hapticbillard_actors::runtime::{Felt, Setup};
use hapticbillard_actors::soak::{self, Ended, FaultKind, Trial, Victim, Wrong, faults};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};

/// Runs `soak`, which must find nothing wrong; returns its games and its summary.
#[track_caller]
fn soaked(arguments: &[&str]) -> (Vec<Value>, Value) {
    let output = program(&[&["soak", "--json"], arguments].concat());
    assert!(output.status.success(), "{output:?}");
    let mut games = lines(&output.stdout);
    let summary = games.pop().unwrap()["summary"].clone();
    assert_eq!(summary["wrong"], 0);
    (games, summary)
}

#[test]
fn games_survive_what_the_table_says_and_are_the_same_on_any_number_of_threads() {
    let seed = ["--seed", "5", "--games", "24"];
    let (_, undisturbed) = soaked(&seed);
    let (games, summary) = soaked(&[&seed[..], &["--faults", "--jostle"]].concat());
    assert_eq!(summary["hash"], undisturbed["hash"]);
    assert_eq!(undisturbed["stopped_in_order"], 0);
    let stopped = summary["stopped_in_order"].as_u64().unwrap();
    assert!((4..20).contains(&stopped), "{summary}");
    let workers: BTreeSet<u64> = games.iter().filter_map(|g| g["workers"].as_u64()).collect();
    assert_eq!(Vec::from_iter(workers), [1, 2, 8]);
    // Most pairs of victim and fault were met.
    assert!(summary["faults"].as_array().unwrap().len() > 20, "{summary}");
    for game in games {
        let ends = |fault: &Value| {
            ["kill", "panic"].contains(&fault["kind"].as_str().unwrap())
                && !["ai", "input", "recorder"].contains(&fault["victim"].as_str().unwrap())
                && fault["struck"].as_u64().unwrap() > 0
        };
        let has_end = game["faults"].as_array().unwrap().iter().any(ends);
        // Who is struck with the last mail of all may not be missed.
        assert!(has_end || !game["stopped"].as_bool().unwrap(), "{game}");
    }
}

#[test]
fn one_game_of_many_can_be_played_again() {
    let game = |games: &[Value]| games[games.len() - 1].clone();
    let (all, _) = soaked(&["--seed", "9", "--games", "3", "--faults"]);
    let (one, _) = soaked(&["--seed", "9", "--games", "1", "--first", "2", "--faults"]);
    assert_eq!((game(&all), one.len()), (game(&one), 1));
}

/// What a device and its test know of each other.
#[derive(Default)]
struct Wires {
    signs: OnceLock<Arc<Signs>>,
    /// Ticks with a force.
    pushed: AtomicU64,
    /// The most ticks in a row with a force although nobody held the dead man's switch.
    alone: AtomicU64,
    /// Ticks with a force beyond what the device bears, or none at all.
    absurd: AtomicU64,
    /// The last force of all [N], as bits.
    last: AtomicU64,
}

/// A hand that goes down and up through whatever is there.
struct Pressing {
    wires: Arc<Wires>,
    time_s: f64,
    alone: u64,
}

impl Device for Pressing {
    fn spec(&self) -> DeviceSpec {
        DeviceSpec::OMNI
    }

    fn read(&mut self, dt: f64) -> DeviceState {
        self.time_s += dt;
        let (phase, depth_m) = (4.0 * self.time_s, 0.04);
        DeviceState {
            position: DVec3::new(0.0, depth_m * libm::cos(phase), 0.0),
            velocity: DVec3::new(0.0, -4.0 * depth_m * libm::sin(phase), 0.0),
            status: DeviceStatus::Ready,
            ..DeviceState::default()
        }
    }

    fn write(&mut self, force: Force) {
        let (wires, force_n) = (&self.wires, force.0.length());
        if !(force_n <= DeviceSpec::OMNI.force_max_n * 1.001) {
            wires.absurd.fetch_add(1, Ordering::SeqCst);
        }
        let is_held = wires.signs.get().is_none_or(|signs| signs.is_held());
        self.alone = if force_n > 0.0 && !is_held { self.alone + 1 } else { 0 };
        wires.alone.fetch_max(self.alone, Ordering::SeqCst);
        wires.pushed.fetch_add(u64::from(force_n > 0.0), Ordering::SeqCst);
        wires.last.store(force_n.to_bits(), Ordering::SeqCst);
    }
}

/// Eight-ball between computers, with a hand that feels the table.
fn stage(seed: u64) -> Stage {
    let shipped = hapticbillard::shipped::scene("eight_ball_headless").unwrap();
    let text = format!("{shipped}\n[haptic]\ndevice = \"simulated\"\n");
    let scene = Scene::parse("felt.toml", &text).unwrap();
    let stage = Stage::new(&LoadedScene { scene, text, folder: None }, "felt.toml").unwrap();
    stage.with(Overrides { seed: Some(seed), ..Overrides::default() })
}

/// A game of some seconds of real time with sound and a hand, disturbed. How it ended, and what
/// of sound and hand was struck.
fn felt_and_heard(seed: u64, folder: &Path) -> (Ended, Vec<(Victim, FaultKind)>) {
    let stage = stage(seed);
    let limit = Tick(40_000);
    let reference = soak::reference(&stage, seed, limit).unwrap();
    let wires = Arc::new(Wires::default());
    let device = Pressing { wires: wires.clone(), time_s: 0.0, alone: 0 };
    let plan = Plan {
        opened: Opened::new(device),
        asked: Asked { core: Core::Any, lock_memory: false, ..Asked::default() },
        ..stage.haptic().unwrap().unwrap()
    };
    let haptic::Started { seat, world, .. } = Seat::start(plan).unwrap();
    assert!(wires.signs.set(seat.signs().clone()).is_ok());
    let speaker = Speaker::new();
    let setup = Setup {
        tempo: Tempo::RealTime(8.0),
        sound: Some(heard_through(&stage, &speaker)),
        haptic: Some(Felt { seat, world }),
        ..Setup::headless(limit)
    };
    let running = speaker.run();
    let everybody = [&Victim::ALWAYS[..], &[Victim::Sound, Victim::Haptic, Victim::Haptic]];
    let trial = Trial {
        seed,
        workers: 2,
        physics_thread: seed.is_multiple_of(2),
        is_jostled: false,
        faults: faults(seed, reference.seen.batches, &everybody.concat()),
    };
    let file = folder.join(format!("{seed}.jsonl"));
    let played = soak::play(&stage, &reference, &trial, &file, setup);
    drop(running);
    let ended = played.ended.unwrap_or_else(|wrong| panic!("game {seed}: {wrong}"));
    // A tick that had begun when the switch was let go may end with its force, and no other.
    assert!(wires.alone.load(Ordering::SeqCst) <= 1, "game {seed}");
    assert_eq!(wires.absurd.load(Ordering::SeqCst), 0, "game {seed}");
    assert_eq!(f64::from_bits(wires.last.load(Ordering::SeqCst)), 0.0, "game {seed}");
    // Only who plays long enough gets through the ramp of the start.
    let hit = |victim| matches!(victim, Victim::Sound | Victim::Haptic);
    let struck = played.struck.iter().filter(|one| one.victims > 0 && hit(one.planned.victim));
    let of = |one: &soak::Struck| (one.planned.victim, FaultKind::of(one.planned.fault));
    let pushed = wires.pushed.load(Ordering::SeqCst);
    assert!(ended == Ended::Stopped || pushed > 0, "game {seed}: nothing was felt");
    (ended, struck.map(of).collect())
}

#[test]
fn games_with_sound_and_a_hand_survive_the_same_and_nothing_pushes_alone() {
    let count: u64 = std::env::var("FAULTS").map_or(6, |text| text.parse().unwrap());
    let (next, folder) = (AtomicU64::new(0), folder("felt_and_heard"));
    let (mut same, mut struck) = (0, Vec::new());
    // They mostly wait for the clock.
    std::thread::scope(|scope| {
        let work = || {
            let mut done = Vec::new();
            loop {
                let seed = next.fetch_add(1, Ordering::SeqCst);
                if count <= seed {
                    return done;
                }
                done.push(felt_and_heard(seed, &folder));
            }
        };
        let threads: Vec<_> = (0..3).map(|_| scope.spawn(work)).collect();
        for thread in threads {
            for (ended, hit) in thread.join().unwrap() {
                same += u64::from(ended == Ended::Same);
                struck.extend(hit);
            }
        }
    });
    println!("{same} of {count} games the same; sound and hand were struck by {struck:?}");
    assert!(0 < same && !struck.is_empty(), "{same} {struck:?}");
}

#[test]
fn a_game_that_is_another_one_is_found_out() {
    let limit = Tick(20_000);
    let reference = soak::reference(&stage(1), 1, limit).unwrap();
    let trial =
        Trial { seed: 1, workers: 1, physics_thread: false, is_jostled: false, faults: Vec::new() };
    let file = folder("another_game").join("game.jsonl");
    let play =
        |seed| soak::play(&stage(seed), &reference, &trial, &file, Setup::headless(limit)).ended;
    assert_eq!(reference.finished.end, End::Limit);
    assert_eq!(play(1).unwrap(), Ended::Same);
    assert!(matches!(play(2).unwrap_err(), Wrong::End { .. }));
}
