//! Recordings are untrusted: a spoiled one is refused in one line, or replays to an end or to an
//! error, and never hangs.

use super::generator::{cases, generator, seed, spoiled};
use glam::{DVec2, DVec3};
use hapticbillard::cast::Cast;
use hapticbillard::cue::{CuePath, CuePiece};
use hapticbillard::event_manager::Publication;
use hapticbillard::events::{Command, Event, MenuAction, Zone};
use hapticbillard::ids::BallId;
use hapticbillard::lockstep::{self, Lockstep};
use hapticbillard::replay::{Header, Line, RecordedInput, Recording, VERSION};
use hapticbillard::scene::{Overrides, Scene};
use hapticbillard::shipped;
use hapticbillard::tick::{Frame, FrameSource, Inflow};
use hapticbillard::units::Tick;
use std::collections::BTreeMap;
use std::sync::Arc;

/// So much of the game is recorded [ticks].
const LIMIT: u64 = 6_000;

const NAME: &str = "eight_ball_headless";

/// What may be inserted: whole lines in the wrong place, and events that nobody sent.
const WORDS: [&str; 8] = [
    "{\"end\":{\"tick\":3,\"reason\":\"quit\"}}\n",
    "{\"frame\":{\"tick\":18446744073709551615,\"publish\":[]}}\n",
    "{\"frame\":{\"tick\":5,\"publish\":[{\"event\":{\"command\":\"lift_cue\"}}]}}\n",
    "{\"hash\":{\"tick\":1,\"physics\":\"0\",\"participants\":[],\"balls\":[]}}\n",
    "{\"recording\":{}}\n",
    "\"delay_ticks\":18446744073709551615,",
    "[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[",
    "null",
];

/// A hand that puts the cue ball down and strikes it.
struct Hand;

impl FrameSource for Hand {
    fn inflow(&mut self, tick: Tick) -> Inflow {
        let piece = CuePiece {
            start_s: 0.6,
            duration_s: 0.4,
            position: DVec3::new(-0.8, 0.1, 0.03),
            velocity: DVec3::new(2.0, 0.0, 0.0),
            acceleration: DVec3::ZERO,
            direction: DVec3::X,
            direction_end: DVec3::X,
        };
        let path = CuePath { solid: true, pieces: [piece].into_iter().collect() };
        let (ball, position_m, zone) = (BallId::CUE, DVec2::new(-0.7, 0.1), Zone::Kitchen);
        let event = match tick.0 {
            0..=200 => Event::Command(Command::PlaceBall { ball, position_m, zone }),
            201..=600 => Event::Command(Command::MoveCue(Arc::new(path))),
            _ => Event::Menu(MenuAction::Pause),
        };
        let mut frame = Frame::new();
        let next = [200, 600, 900].map(Tick).into_iter().find(|next| tick < *next);
        if [200, 600, 900].contains(&tick.0) {
            frame.push(Publication { event, delay_ticks: 0, label: Some(3) });
        }
        Inflow { frame, next, ..Inflow::default() }
    }
}

/// The first seconds of a game in which a hand joins in. The scene's own text is left out: it is
/// spoiled elsewhere, and would take up most of this one.
fn sample() -> String {
    let mut header = Header {
        version: VERSION,
        program: "fuzz".into(),
        scene_name: NAME.into(),
        scene: shipped::scene(NAME).unwrap().into(),
        files: BTreeMap::new(),
        overrides: Overrides { seed: Some(3), ..Overrides::default() },
    };
    let mut lines = Vec::new();
    let mut record = |line: &Line| lines.push(line.clone());
    let record: Option<&mut dyn FnMut(&Line)> = Some(&mut record);
    let input: Option<Box<dyn FrameSource>> = Some(Box::new(Hand));
    let setup = lockstep::Setup { input, record, ..lockstep::Setup::headless(Tick(LIMIT)) };
    lockstep::run(cast(&header).unwrap(), setup).unwrap();
    header.scene = String::new();
    lines.insert(0, Line::Recording(header));
    lines.iter().map(|line| line.to_json() + "\n").collect()
}

fn cast(header: &Header) -> Option<Cast> {
    let mut scene = Scene::parse(NAME, &header.scene).ok()?;
    header.overrides.apply(&mut scene);
    let table = scene.build_table(&mut |_| Err("no files".into())).ok()?;
    Cast::new(&scene, Arc::new(table)).ok()
}

#[test]
fn spoiled_recordings_replay_or_say_what_is_wrong_in_one_line() {
    let sample = sample();
    let whole = Recording::parse(&sample).unwrap();
    assert!(whole.frames.len() == 3 && !whole.hashes.is_empty(), "{sample}");
    let (mut wrong, mut replayed, mut diverged) = (0, 0, 0);
    for case in 0..cases(10_000) {
        let place = format!("seed {}, case {case}", seed());
        let mut random = generator(case);
        let text = spoiled(&sample, &WORDS, &mut random);
        match Recording::parse(&text) {
            Err(error) => {
                wrong += 1;
                let line = error.to_string();
                assert!(!line.contains(char::is_control) && line.len() < 2000, "{place}: {line}");
            }
            // Replaying takes longer than reading: every hundredth is enough for a smoke.
            Ok(recording) if case % 100 == 0 => {
                let mut header = recording.header.clone();
                header.scene = shipped::scene(NAME).unwrap().into();
                let Some(cast) = cast(&header) else { continue };
                let recording = Arc::new(recording);
                let setup = lockstep::Setup {
                    input: Some(Box::new(RecordedInput(recording.clone()))),
                    verify: Some(recording),
                    ..lockstep::Setup::headless(Tick(LIMIT))
                };
                match replay(cast, setup) {
                    Ok(()) => replayed += 1,
                    Err(line) => {
                        diverged += 1;
                        assert!(!line.contains(char::is_control), "{place}: {line}");
                    }
                }
            }
            Ok(_) => {}
        }
    }
    // The canary: a generator that only makes right texts, or only wrong ones, tests nothing.
    assert!(wrong > 0 && diverged > 0, "{wrong} wrong, {replayed} replayed, {diverged} diverged");
}

/// Replays to the end, in a bounded number of steps.
fn replay(cast: Cast, setup: lockstep::Setup<'_>) -> Result<(), String> {
    let mut game = Lockstep::new(cast, setup).map_err(|error| error.to_string())?;
    for _ in 0..100_000 {
        if game.step().map_err(|error| error.to_string())?.is_some() {
            return Ok(());
        }
    }
    panic!("the replay does not end");
}
