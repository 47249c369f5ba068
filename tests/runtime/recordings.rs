//! Recordings of games that were ended from outside, and of those that were killed.

use super::cli::{folder, lines, program, text};
use rustix::process::{Pid, Signal, WaitOptions, kill_process, waitpid};
use std::fs;
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};

fn start(arguments: &[&str]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_hapticbillard"))
        .args(arguments)
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

/// Waits until the recording has so many lines, or is whole.
fn wait_for(file: &Path, draft: &Path, count: usize, child: &mut Child) {
    let has_lines = |file| fs::read_to_string(file).is_ok_and(|text| count < text.lines().count());
    while !has_lines(draft) && !has_lines(file) {
        assert!(child.try_wait().unwrap().is_none(), "it ended without a recording");
        std::thread::yield_now();
    }
}

fn send(child: &Child, signal: Signal) {
    kill_process(Pid::from_child(child), signal).unwrap();
}

/// Replays and returns the summary.
fn verify(file: &Path) -> serde_json::Value {
    let replayed = program(&["replay", file.to_str().unwrap(), "--verify", "--json"]);
    assert!(replayed.status.success(), "{replayed:?}");
    lines(&replayed.stdout).pop().unwrap()["summary"].clone()
}

/// Whether it is the recording of a game that has begun and not ended.
fn is_under_way(path: &Path) -> bool {
    let is_draft = path.extension().is_some_and(|extension| extension == "part");
    is_draft && fs::read_to_string(path).is_ok_and(|text| text.contains("\n{\"hash\""))
}

/// So many whole recordings of an interrupted match are replayed.
const WHOLE_MAX: u32 = 30;

/// Plays many games into `folder` and sends a signal while one is under way.
fn match_that_gets(signal: Signal, name: &str) -> Output {
    let folder = folder(name);
    let games = ["match", "--games", "5000", "--seed", "3", "--record", folder.to_str().unwrap()];
    let child = start(&games);
    // It is made to stand still to look whether a game is under way.
    loop {
        send(&child, Signal::STOP);
        let stopped = waitpid(Some(Pid::from_child(&child)), WaitOptions::UNTRACED).unwrap();
        assert!(stopped.unwrap().1.stopped(), "it ended before it was stopped");
        if fs::read_dir(&folder).unwrap().any(|entry| is_under_way(&entry.unwrap().path())) {
            break;
        }
        send(&child, Signal::CONT);
        std::thread::yield_now();
    }
    send(&child, signal);
    send(&child, Signal::CONT);
    let output = child.wait_with_output().unwrap();

    let (mut whole, mut cut_off) = (0_u32, 0_u32);
    for entry in fs::read_dir(&folder).unwrap() {
        let path = entry.unwrap().path();
        let is_whole = path.extension().is_some_and(|extension| extension == "jsonl");
        // A file that was created a moment ago may be without its header still.
        if !is_whole && !is_under_way(&path) {
            continue;
        }
        // On a busy machine there may be thousands before one is seen under way.
        if is_whole && WHOLE_MAX <= whole {
            continue;
        }
        let summary = verify(&path);
        // A game may have been written to its end and have had no time for its name.
        assert!(summary["complete"] == true || !is_whole, "{}", path.display());
        assert!(0 < summary["verified"].as_u64().unwrap(), "{}", path.display());
        *(if is_whole { &mut whole } else { &mut cut_off }) += 1;
    }
    assert!(0 < cut_off, "{whole} whole, {cut_off} cut off");
    output
}

#[test]
fn a_match_that_gets_an_interrupt_leaves_recordings_that_replay() {
    let output = match_that_gets(Signal::INT, "match_interrupted");
    assert_eq!(output.status.signal(), Some(Signal::INT.as_raw()), "{output:?}");
    // Whole lines only: a script can read what was printed.
    assert!(output.stdout.is_empty() || output.stdout.ends_with(b"\n"), "{output:?}");
}

#[test]
fn a_match_that_is_killed_leaves_recordings_that_replay() {
    let output = match_that_gets(Signal::KILL, "match_killed");
    assert_eq!(output.status.signal(), Some(Signal::KILL.as_raw()), "{output:?}");
}

#[test]
fn a_game_that_is_asked_to_end_ends_in_order_with_a_whole_recording() {
    for (signal, name) in [(Signal::INT, "int"), (Signal::TERM, "term"), (Signal::HUP, "hup")] {
        ends_in_order(signal, &folder("play_interrupted").join(format!("{name}.jsonl")));
    }
}

fn ends_in_order(signal: Signal, file: &Path) {
    let draft = file.with_extension("jsonl.part");
    let mut child = start(&["play", "--seed", "5", "--record", file.to_str().unwrap()]);
    wait_for(file, &draft, 3, &mut child);
    send(&child, signal);
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success(), "{output:?}");
    let said = text(&output.stdout);
    assert!(said.contains("the game was ended") || said.contains(" wins "), "{said}");
    assert!(!draft.exists());
    assert_eq!(verify(file)["complete"], true);
}
