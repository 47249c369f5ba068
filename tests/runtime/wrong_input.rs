//! Wrong input to every command: exit code 2, nothing on stdout, one line on stderr that names the
//! place.

use super::cli::{folder, program, text};
use std::fs;

/// Files that nobody should have to be given, and a folder.
fn wrong_files(name: &str) -> Vec<String> {
    let folder = folder(name);
    let files: [(&str, Vec<u8>); 6] = [
        ("empty", Vec::new()),
        ("binary", (0..=255).cycle().take(3000).collect()),
        ("deep", b"[".repeat(100_000)),
        ("braces", b"{\"a\":".repeat(100_000)),
        ("long_line", b"x".repeat(3 << 20)),
        ("numbers", b"{\"t\":1e999,\"id\":99999999999999999999999}\n".to_vec()),
    ];
    let mut paths = vec![folder.join("missing"), folder.clone()];
    for (name, bytes) in files {
        fs::write(folder.join(name), bytes).unwrap();
        paths.push(folder.join(name));
    }
    paths.iter().map(|path| path.to_str().unwrap().to_string()).collect()
}

#[track_caller]
fn check(arguments: &[&str], place: &str) {
    let output = program(arguments);
    let shown: String = text(&output.stderr).chars().take(300).collect();
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {shown}");
    assert!(output.stdout.is_empty(), "{arguments:?}");
    let line = text(&output.stderr).strip_suffix('\n').unwrap_or_default();
    assert!(line.starts_with("error: ") && line.contains(place), "{arguments:?}: {shown}");
    assert!(!line.contains(char::is_control) && line.len() < 2000, "{arguments:?}: {shown}");
}

#[test]
fn every_command_refuses_a_wrong_scene_in_one_line() {
    for file in wrong_files("wrong_scenes") {
        check(&["scene", &file], &file);
        check(&["simulate", "--scene", &file], &file);
        check(&["match", "--scene", &file], &file);
        check(&["play", "--no-record", "--scene", &file], &file);
        #[cfg(feature = "renderer")]
        check(&["render", "--scene", &file, "--out", "never.png"], &file);
    }
    for command in ["simulate", "match", "play"] {
        check(&[command, "--scene", "banana"], "'banana'");
    }
}

#[test]
fn every_command_refuses_a_wrong_file_in_one_line() {
    for file in wrong_files("wrong_data") {
        check(&["replay", &file], &file);
        check(&["replay", &file, "--verify", "--json"], &file);
        check(&["validate", "--cases", &file], &file);
        check(&["rules", "--scenarios", &file], &file);
        // An empty file of facts or shots is a short one, not a wrong one.
        if !file.ends_with("/empty") {
            check(&["rules", &file], &file);
            check(&["simulate", "--scene", "free_play", "--batch", &file], &file);
        }
    }
}

#[test]
fn what_does_not_fit_together_is_said_in_one_line() {
    check(&["match", "--scene", "one_ball"], "--scene one_ball");
    check(&["match", "--scene", "eight_ball"], "a person plays");
    check(&["match", "--players", "paper"], "--players: 1 players given");
    check(&["match", "--record", "/dev/null"], "/dev/null/game_0001.jsonl");
    check(
        &["simulate", "--scene", "minigolf", "--batch", &one_shot("sideways", "\"side\":1")],
        "1",
    );
    check(
        &["simulate", "--scene", "free_play", "--batch", &one_shot("miss", "\"side\":1")],
        ":1: ",
    );
    check(&["validate", "--only", "Z99"], "'Z99'");
}

fn one_shot(name: &str, keys: &str) -> String {
    let file = folder(name).join("shots.jsonl");
    fs::write(&file, format!("{{\"speed_m_s\":2,{keys}}}\n")).unwrap();
    file.to_str().unwrap().to_string()
}

/// Options are refused by the parser of the command line, which also shows how to use them.
#[test]
fn wrong_options_exit_with_2_and_name_the_option() {
    let wrong: [(&[&str], &str); 22] = [
        (&["play", "--speed", "0"], "--speed"),
        (&["play", "--record", "a.jsonl", "--no-record"], "--no-record"),
        (&["simulate"], "--scene"),
        (&["simulate", "--scene", "one_ball", "--until", "NaN"], "--until"),
        (&["simulate", "--scene", "one_ball", "--until", "1", "--until-rest"], "--until-rest"),
        (&["simulate", "--scene", "one_ball", "--step-ms", "0"], "--step-ms"),
        (&["simulate", "--scene", "one_ball", "--sample=-1"], "--sample"),
        (&["simulate", "--scene", "one_ball", "--bench", "0"], "--bench"),
        (&["simulate", "--scene", "one_ball", "--solver", "magic"], "--solver"),
        (&["match", "--noise=-1"], "--noise"),
        (&["match", "--noise", "inf"], "--noise"),
        (&["match", "--seed=-5"], "--seed"),
        (&["match", "--players", "paper,tiger"], "--players"),
        (&["rules", "--game", "croquet"], "--game"),
        (&["replay"], "<FILE>"),
        (&["render", "--scene", "one_ball"], "--out"),
        (&["learn"], "--out"),
        (&["learn", "--out", "x", "--profile", "2010"], "--profile"),
        (&["learn", "--out", "x", "--outliers", "1.1"], "--outliers"),
        (&["learn", "--out", "x", "--shots", "19"], "--shots"),
        (&["learn", "--out", "x", "--observation-error", "NaN"], "--observation-error"),
        (&["learn", "--check", "--no-threshold"], "--no-threshold"),
    ];
    for (arguments, option) in wrong {
        let output = program(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(output.stdout.is_empty(), "{arguments:?}");
        let said = text(&output.stderr);
        assert!(said.starts_with("error: ") && said.contains(option), "{arguments:?}: {said}");
    }
}
