//! What the program says about itself: on stderr, in a file, and about which shot.

use super::cli::folder;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Runs the program with its own home, so that no file of somebody else is touched.
fn program(home: &Path, log: Option<&str>, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hapticbillard"));
    command.args(arguments).env("XDG_DATA_HOME", home).env("HOME", home).env_remove("RUST_LOG");
    if let Some(log) = log {
        command.env("RUST_LOG", log);
    }
    command.output().unwrap()
}

fn logs(home: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(home.join("hapticbillard/logs")).into_iter().flatten();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

const GAME: [&str; 5] = ["play", "--scene", "eight_ball_headless", "--seed", "8"];

#[cfg(target_os = "linux")]
#[test]
fn a_game_that_is_played_has_a_log_that_names_the_shot_and_stderr_stays_as_it_was() {
    let home = folder("log_of_a_game");
    // Old days, more than are kept.
    std::fs::create_dir_all(home.join("hapticbillard/logs")).unwrap();
    for day in 1..=20 {
        let name = format!("hapticbillard.2001-01-{day:02}.log");
        std::fs::write(home.join("hapticbillard/logs").join(name), "old\n").unwrap();
    }
    let output = program(&home, None, &[&GAME[..], &["--no-record"]].concat());
    assert!(output.status.success(), "{output:?}");
    let said = text(&output.stderr);
    assert!(said.lines().all(|line| line.starts_with("shot ")), "{said}");

    let logs = logs(&home);
    assert_eq!(logs.len(), 7, "{logs:?}");
    let log = std::fs::read_to_string(logs.last().unwrap()).unwrap();
    let turns: Vec<&str> = log.lines().filter(|line| line.ends_with("a turn begins")).collect();
    assert!(turns.len() > 5, "{log}");
    for (i, line) in turns.iter().enumerate() {
        let shot =
            format!("Z INFO  hapticbillard_actors::event_manager] shot{{number={} player=", i + 1);
        assert!(line.starts_with("[20") && line.contains(&shot), "{line}");
    }
    assert!(log.lines().last().unwrap().contains("the game ends at tick "), "{log}");
}

#[test]
fn a_log_that_cannot_be_written_is_said_once_and_the_game_goes_on() {
    let home = folder("log_in_vain");
    std::fs::create_dir_all(home.join("hapticbillard")).unwrap();
    // Where the folder should be is a file.
    std::fs::write(home.join("hapticbillard/logs"), "").unwrap();
    let output = program(&home, None, &[&GAME[..], &["--no-record"]].concat());
    assert!(output.status.success(), "{output:?}");
    let said = text(&output.stderr);
    let warnings: Vec<&str> = said.lines().filter(|line| !line.starts_with("shot ")).collect();
    assert!(
        matches!(warnings[..], [line] if line.contains("WARN ")
        && line.contains("there is no log file: cannot write ")),
        "{said}"
    );
}

#[test]
fn other_commands_write_no_log_but_where_they_are_told_to() {
    let home = folder("log_of_commands");
    let scenes = program(&home, None, &["scenes"]);
    assert!(scenes.status.success() && scenes.stderr.is_empty(), "{scenes:?}");
    assert_eq!(logs(&home), Vec::<PathBuf>::new());

    let file = home.join("own/file.log");
    let path = file.to_str().unwrap();
    let game = ["match", "--games", "1", "--seed", "8", "--log-file", path];
    let (first, second) = (program(&home, None, &game), program(&home, None, &game));
    assert!(first.status.success() && first.stderr.is_empty(), "{first:?}");
    assert_eq!(first.stdout, second.stdout);
    let log = std::fs::read_to_string(&file).unwrap();
    // The second is behind the first.
    assert_eq!(log.matches("the game ends at tick ").count(), 2, "{log}");
    let shots = |log: &str| log.matches("shot{number=2 ").count();
    assert!(0 < shots(&log) && shots(&log).is_multiple_of(2), "{log}");
}

#[test]
fn every_actor_has_a_level_of_its_own() {
    let home = folder("log_by_actor");
    let game = ["match", "--games", "1", "--seed", "8"];
    for (actor, says) in [("rules", "Verdict("), ("ai", "MoveCue("), ("physics", "BallsCollided")] {
        let wanted = format!("off,hapticbillard_actors::{actor}=debug");
        let output = program(&home, Some(&wanted), &game);
        let said = text(&output.stderr);
        let from = format!(" DEBUG hapticbillard_actors::{actor}] ");
        assert!(output.status.success() && said.contains(says), "{said}");
        assert!(said.lines().all(|line| line.contains(&from)), "{actor}: {said}");
    }
    let wrong = program(&home, Some("hapticbillard_actors::rules=loud"), &["scenes"]);
    assert!(wrong.status.success() && !wrong.stdout.is_empty(), "{wrong:?}");
    assert!(text(&wrong.stderr).contains("ignoring"), "{wrong:?}");
}
