//! What enters from outside: nothing is lost in a pause, and wrong files are refused in one line.

use super::cli::{folder, program, text};
use hapticbillard::events::{Event, MenuAction};
use hapticbillard::tick::{Frame, FrameSource, Inflow, Pace};
use hapticbillard::units::Tick;
use hapticbillard_actors::files::load_scene;
use hapticbillard_actors::game::Stage;
use hapticbillard_actors::runtime::{self, InputPort};

/// Pauses at tick 3, does something while time stands still, and goes on.
struct Pausing(u32);

impl FrameSource for Pausing {
    fn inflow(&mut self, tick: Tick) -> Inflow {
        self.0 += 1;
        let mut frame = Frame::new();
        if self.0 == 6 {
            frame.push(Event::Menu(MenuAction::Resume).into());
        }
        let (paused, quit) = ((4..=7).contains(&self.0), tick.0 > 9);
        Inflow { frame, paused, quit, ..Inflow::default() }
    }
}

#[test]
fn what_is_done_in_a_pause_enters_in_the_first_tick_after_it() {
    let file = folder("pause").join("game.jsonl");
    let stage = Stage::new(&load_scene("one_ball").unwrap(), "one_ball").unwrap();
    let setup = runtime::Setup {
        pace: Pace::EveryTick,
        input: InputPort::StandIn(Box::new(Pausing(0))),
        record: Some((file.clone(), stage.header())),
        ..runtime::Setup::headless(Tick(20))
    };
    runtime::run(stage.cast().unwrap(), setup).unwrap();
    let written = std::fs::read_to_string(file).unwrap();
    let frames = written.lines().filter(|line| line.starts_with("{\"frame\""));
    let frames: Vec<&str> = frames.collect();
    assert_eq!(
        frames,
        ["{\"frame\":{\"tick\":4,\"publish\":[{\"event\":{\"menu\":\"resume\"}}]}}"]
    );
}

#[test]
fn wrong_files_of_shots_and_recordings_are_one_line_and_exit_with_2() {
    let folder = folder("wrong_files");
    let wrong = [
        ("{\"speed_m_s\":\"fast\"}\n", ":1: "),
        ("{\"speed_m_s\":1}\n{\"speed_m_s\":NaN}\n", ":2: "),
        ("{\"speed_m_s\":1e308}\n", ":1: "),
        ("{\"spin\":1}\n", ":1: "),
        ("{\"speed_m_s\":1", ":1: "),
    ];
    for (text_of_file, place) in wrong {
        let file = folder.join("file.jsonl");
        std::fs::write(&file, text_of_file).unwrap();
        let file = file.to_str().unwrap();
        let batch = program(&["simulate", "--scene", "free_play", "--batch", file, "--json"]);
        assert_eq!(batch.status.code(), Some(2), "{text_of_file}: {batch:?}");
        let line = text(&batch.stderr);
        assert!(line.contains(place) && line.lines().count() == 1, "{line}");
        let replay = program(&["replay", file, "--verify"]);
        assert_eq!(replay.status.code(), Some(2), "{text_of_file}: {replay:?}");
        let line = text(&replay.stderr);
        assert!(line.contains("line 1") && line.lines().count() == 1, "{line}");
    }
}
