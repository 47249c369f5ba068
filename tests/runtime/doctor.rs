//! `doctor`: what it says of a machine that has everything, and of one that has little.

use super::cli::{folder, lines, text};
use serde_json::Value;
use std::process::{Command, Output};

/// Runs it with this folder for everything that the user keeps, and without a display.
fn doctor(home: &std::path::Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hapticbillard"));
    for name in ["XDG_DATA_HOME", "XDG_CONFIG_HOME", "HOME"] {
        command.env(name, home);
    }
    command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
    command.arg("doctor").args(arguments).output().unwrap()
}

fn found<'a>(lines: &'a [Value], what: &str) -> &'a Value {
    lines.iter().find(|line| line["what"] == what).unwrap()
}

#[test]
fn a_doctor_plays_a_game_and_leaves_nothing_behind() {
    let home = folder("doctor");
    let output = doctor(&home, &["--json"]);
    assert!(output.status.success(), "{output:?}");
    let lines = lines(&output.stdout);
    assert_eq!(found(&lines, "game")["health"], "well");
    assert!(found(&lines, "game")["found"].as_str().unwrap().contains("the same by actors"));
    assert_eq!(found(&lines, "recordings")["health"], "well");
    assert_eq!(found(&lines, "settings")["health"], "well");
    let summary = &lines[lines.len() - 1]["summary"];
    assert_eq!(summary["broken"], 0);
    let missing = |line: &&Value| line["health"] == "missing";
    assert_eq!(lines.iter().filter(missing).count() as u64, summary["missing"].as_u64().unwrap());
    // Whatever is missing is named with what would help.
    assert!(lines.iter().filter(missing).all(|line| !line["remedy"].as_str().unwrap().is_empty()));
    #[cfg(feature = "renderer")]
    assert_eq!(found(&lines, "display")["health"], "missing");
    let files = std::fs::read_dir(home.join("hapticbillard").join("recordings")).unwrap();
    assert_eq!(files.count(), 0);
}

#[test]
fn what_cannot_be_written_or_read_is_said_in_words() {
    let home = folder("doctor_sick");
    std::fs::create_dir_all(home.join("hapticbillard")).unwrap();
    std::fs::write(home.join("hapticbillard").join("recordings"), "in the way").unwrap();
    std::fs::write(home.join("hapticbillard").join("settings.toml"), "volume_percent = x").unwrap();
    let output = doctor(&home, &[]);
    // A game can be played all the same.
    assert!(output.status.success(), "{output:?}");
    let said = text(&output.stdout);
    let after = |mark: &str| {
        let line = said.lines().skip_while(|line| !line.starts_with(mark)).take(2);
        line.collect::<Vec<_>>().join(" ")
    };
    let recordings = after("missing recordings");
    assert!(recordings.contains("XDG_DATA_HOME"), "{said}");
    assert!(after("missing settings").contains("settings.toml"), "{said}");
    assert!(said.contains("goes without what is missing"), "{said}");
}
