//! An installed program: an empty folder, an empty home, no environment to speak of.

use crate::cli::{folder, lines, text};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Runs the program in `home`, which is also its home, and knows nothing else of the system.
fn run(home: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_hapticbillard"))
        .args(arguments)
        .env_clear()
        .env("HOME", home)
        .current_dir(home)
        .output()
        .unwrap()
}

fn found(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() { files.extend(found(&path)) } else { files.push(path) }
    }
    files
}

#[test]
fn every_shipped_scene_runs_from_an_empty_folder_and_leaves_it_empty() {
    let home = folder("anywhere");
    let listed = lines(&run(&home, &["scenes", "--json"]).stdout);
    let names = listed.iter().filter_map(|line| line["scene"].as_str());
    let mut count = 0;
    for name in names {
        let output = run(&home, &["simulate", "--scene", name, "--until", "0.1", "--json"]);
        assert!(output.status.success(), "{name}: {output:?}");
        count += 1;
    }
    assert_eq!(count, hapticbillard::shipped::SCENES.len());
    let output = run(&home, &["match", "--games", "1", "--game", "wpa-nine-ball"]);
    assert!(output.status.success(), "{output:?}");
    assert_eq!(found(&home), Vec::<PathBuf>::new());
}

#[cfg(target_os = "linux")]
#[test]
fn a_game_without_a_display_is_played_and_recorded_in_the_home() {
    let home = folder("anywhere_played");
    let output = run(&home, &["play", "--driver", "lockstep"]);
    assert!(output.status.success(), "{output:?}");
    assert!(text(&output.stdout).contains("wins"), "{output:?}");
    let files = found(&home);
    let data = home.join(".local/share/hapticbillard");
    assert!(files.iter().all(|file| file.starts_with(&data)), "{files:?}");
    let recordings: Vec<_> =
        files.iter().filter(|file| file.starts_with(data.join("recordings"))).collect();
    let [recording] = recordings[..] else { panic!("{files:?}") };
    let replayed = run(&home, &["replay", recording.to_str().unwrap(), "--verify"]);
    assert!(replayed.status.success(), "{replayed:?}");
}

#[cfg(feature = "renderer")]
#[test]
fn a_picture_is_drawn_from_an_empty_folder() {
    let home = folder("anywhere_drawn");
    let output = run(&home, &["render", "--scene", "eight_ball", "--out", "table.png"]);
    assert!(output.status.success(), "{output:?}");
    assert_eq!(found(&home), [home.join("table.png")]);
}
