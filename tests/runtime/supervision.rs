//! Who dies and what then: a game goes on without its recorder and the recording goes on with
//! another one; without an observer, or an input that dies again and again, the game stops in
//! order, and can be replayed up to there. Everybody else: [`super::failures`].

use super::cli::folder;
use super::hearing::Hears;
use hapticbillard::events::{Event, Health, Source, Topic, Topics};
use hapticbillard::hash::StateHash;
use hapticbillard::physics::Snapshot;
use hapticbillard::replay::{Recording, TickHash};
use hapticbillard::scene::Overrides;
use hapticbillard::tick::{Delivered, Finished, Frame, FrameSource, Inflow, Outcome, Participant};
use hapticbillard::units::Tick;
use hapticbillard_actors::conductor::RunError;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::load_scene;
use hapticbillard_actors::game::{Headless, LIMIT, Stage, play_headless};
use hapticbillard_actors::pacer::Tempo;
use hapticbillard_actors::recorder::{Open, Record, Recorder, Written};
use hapticbillard_actors::runtime::{self, InputPort, Setup};
use kameo::prelude::*;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;

pub fn stage() -> Stage {
    let name = "eight_ball_headless";
    let stage = Stage::new(&load_scene(name).unwrap(), name).unwrap();
    stage.with(Overrides { seed: Some(4), ..Overrides::default() })
}

pub fn run(setup: Setup) -> Result<Finished, RunError> {
    runtime::run(stage().cast().unwrap(), setup)
}

pub fn recorded(file: &Path, recorder: Open) -> Setup {
    let record = Some((file.to_path_buf(), stage().header()));
    Setup { record, recorder, ..Setup::headless(LIMIT) }
}

/// The same game with nobody in its way, and its recording.
pub fn undisturbed(name: &str) -> (Finished, String) {
    let file = folder(name).join("undisturbed.jsonl");
    let finished = run(recorded(&file, Box::new(Recorder::start))).unwrap();
    (finished, fs::read_to_string(file).unwrap())
}

pub fn draft(file: &Path) -> PathBuf {
    file.with_extension("jsonl.part")
}

/// A recorder that writes so many lines and then fails in its own way.
#[derive(Actor)]
struct Frail {
    inner: ReplyRecipient<Record, Written>,
    left: u32,
    file: PathBuf,
    end: Ending,
}

#[derive(Clone, Copy)]
enum Ending {
    Panics,
    Stops,
    LeavesHalfALine,
    DiskIsFull,
}

impl Message<Record> for Frail {
    type Reply = Written;

    async fn handle(&mut self, line: Record, context: &mut Context<Self, Written>) -> Written {
        if self.left == 0 {
            match self.end {
                Ending::Panics => panic!("the recorder is made to fail here"),
                Ending::Stops => context.stop(),
                Ending::LeavesHalfALine => {
                    let file = fs::File::options().append(true).open(draft(&self.file));
                    file.unwrap().write_all(b"{\"frame\":{\"ti").unwrap();
                    panic!("the recorder is made to fail in the middle of a line");
                }
                Ending::DiskIsFull => {}
            }
            return Written(Err(full(&self.file)));
        }
        self.left -= 1;
        self.inner.ask(line).send().await.unwrap()
    }
}

fn full(file: &Path) -> Error {
    let reason = std::io::Error::from(std::io::ErrorKind::StorageFull);
    Error::Write { path: file.to_path_buf(), reason }
}

fn frail(file: &Path, length: u64, left: u32, end: Ending) -> ReplyRecipient<Record, Written> {
    let inner = Recorder::start(file, length).unwrap();
    Frail::spawn(Frail { inner, left, file: file.to_path_buf(), end }).reply_recipient()
}

#[test]
fn a_recorder_that_dies_again_and_again_loses_not_a_byte_and_stops_no_game() {
    let (reference, whole) = undisturbed("recorder_dies");
    let endings = [Ending::Panics, Ending::Stops, Ending::LeavesHalfALine, Ending::DiskIsFull];
    let file = folder("recorder_dies").join("game.jsonl");
    let listener = Hears::of(Topic::Health);
    let mut starts = 0;
    let open: Open = Box::new(move |path, length| {
        starts += 1;
        match starts {
            // Not every recorder that is started comes up.
            n if n % 5 == 4 => Err(full(path)),
            n => Ok(frail(path, length, 18, endings[n % 4])),
        }
    });
    let setup = Setup { observers: vec![Box::new(listener.clone())], ..recorded(&file, open) };
    let finished = run(setup).unwrap();
    assert_eq!(finished, reference);
    assert_eq!(fs::read_to_string(&file).unwrap(), whole);
    assert!(!draft(&file).exists());

    // Whoever plays was told of each failure, and of each recovery.
    let heard = listener.heard(|event| match event {
        Event::Health(health) => Some((**health).clone()),
        _ => None,
    });
    let failed = |health: &&Health| matches!(health, Health::ActorFailed { .. });
    let failures = heard.iter().filter(failed).count();
    assert!(4 < failures, "{heard:?}");
    let alternates = heard.windows(2).all(|pair| failed(&&pair[0]) != failed(&&pair[1]));
    assert!(failed(&&heard[0]) && alternates, "{heard:?}");
}

#[test]
fn a_recording_that_cannot_go_on_ends_where_it_is_and_the_game_is_played_to_its_end() {
    let (reference, whole) = undisturbed("recording_ends");
    let file = folder("recording_ends").join("game.jsonl");
    let dying = || -> Open {
        let mut starts = 0;
        Box::new(move |path, length| {
            starts += 1;
            if starts == 1 { Ok(frail(path, length, 30, Ending::Panics)) } else { Err(full(path)) }
        })
    };

    // A person plays on. (So fast that nobody waits for the clock.)
    let played = Setup { tempo: Tempo::RealTime(1e9), ..recorded(&file, dying()) };
    assert_eq!(run(played).unwrap(), reference);
    let begun = fs::read_to_string(draft(&file)).unwrap();
    assert!(whole.starts_with(&begun) && begun.lines().count() == 30);
    verify(&draft(&file));

    // A run without a person played too, but it says that it has not done all it was asked for.
    let error = run(recorded(&file, dying())).unwrap_err();
    let line = error.to_string();
    assert!(matches!(error, RunError::Recording(_)), "{line}");
    assert!(line.contains("game.jsonl ends at tick ") && line.lines().count() == 1, "{line}");
}

/// Replays a recording that may have no end, and checks every hash in it.
pub fn verify(file: &Path) {
    let recording = Recording::parse(&fs::read_to_string(file).unwrap()).unwrap();
    assert_eq!(recording.end, None);
    let hashes = recording.hashes.len() as u64;
    assert!(5 < hashes);
    let stage = Stage::of_recording(&recording).unwrap();
    let replay = Some(Arc::new(recording));
    let how = Headless { replay, verify: true, ..Headless::default() };
    let (finished, _) = play_headless(&stage, how).unwrap();
    assert_eq!(finished.verified, hashes);
    assert!(finished.hash.as_ref().map(TickHash::all).is_some());
}

#[test]
fn a_recording_that_cannot_begin_is_refused_before_the_game() {
    let folder = folder("recording_refused");
    let file = folder.join("file").join("game.jsonl");
    fs::write(folder.join("file"), "a file where a folder is needed").unwrap();
    let error = run(recorded(&file, Box::new(Recorder::start))).unwrap_err();
    assert!(matches!(error, RunError::Recording(_)), "{error}");
    assert!(error.to_string().contains("game.jsonl"), "{error}");
}

/// Dies when it has heard so many verdicts.
struct Mortal(u32);

impl Participant for Mortal {
    fn source(&self) -> Source {
        Source::Runtime
    }

    fn topics(&self) -> Topics {
        Topics::of(&[Topic::Verdict])
    }

    fn start(&mut self, _: &Snapshot) -> Outcome {
        Outcome::default()
    }

    fn collect(&mut self, _: &Delivered) -> Outcome {
        self.0 -= 1;
        assert_ne!(self.0, 0, "the participant is made to die here");
        Outcome::default()
    }

    fn hash(&self, _: &mut StateHash) {}
}

#[test]
fn when_a_participant_dies_the_game_stops_in_order_and_is_recorded_up_to_there() {
    let file = folder("participant_dies").join("game.jsonl");
    let observers: Vec<Box<dyn Participant>> = vec![Box::new(Mortal(3))];
    let setup = Setup { observers, ..recorded(&file, Box::new(Recorder::start)) };
    let line = run(setup).unwrap_err().to_string();
    assert!(line.starts_with("Runtime stopped at tick ") && line.lines().count() == 1, "{line}");
    verify(&draft(&file));
}

/// Stands in for the input, and dies over every frame from the thirtieth on.
struct Fainting(u32);

impl FrameSource for Fainting {
    fn inflow(&mut self, tick: Tick) -> Inflow {
        self.0 += 1;
        assert!(self.0 < 30, "the input is made to die here");
        Inflow { frame: Frame::new(), next: Some(tick.after(500)), ..Inflow::default() }
    }
}

#[test]
fn when_the_input_dies_for_good_the_game_stops_in_order_and_is_recorded_up_to_there() {
    let file = folder("input_dies").join("game.jsonl");
    let input = InputPort::StandIn(Box::new(Fainting(0)));
    let setup = Setup { input, ..recorded(&file, Box::new(Recorder::start)) };
    let line = run(setup).unwrap_err().to_string();
    assert!(line.starts_with("the input actor stopped at tick "), "{line}");
    verify(&draft(&file));
}
