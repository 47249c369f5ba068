//! `tournament` as a shell sees it, and `match`, which counts in the same way.

use crate::cli::{folder, lines, program, text};
use serde_json::Value;

/// Two players at their own noise: quick racks.
const PLAYERS: &str = "paper@0,paper@4";

fn json(arguments: &[&str]) -> Vec<Value> {
    let output = program(arguments);
    assert!(output.status.success(), "{output:?}");
    lines(&output.stdout)
}

fn of<'a>(lines: &'a [Value], kind: &str) -> Vec<&'a Value> {
    lines.iter().filter_map(|line| line.get(kind)).collect()
}

#[test]
fn a_pairing_is_the_match_of_its_players_rack_by_rack() {
    let seed = ["--seed", "5", "--json"];
    let tournament =
        json(&[&["tournament", "--players", PLAYERS, "--racks", "4"], &seed[..]].concat());
    let game = json(&[&["match", "--players", PLAYERS, "--games", "4"], &seed[..]].concat());
    let racks = of(&tournament, "rack");
    assert_eq!(racks.len(), 4);
    for (rack, game) in racks.iter().zip(&game) {
        assert_eq!(rack["state_hash"], game["state_hash"]);
        assert_eq!((&rack["winner"], &rack["made"]), (&game["winner"], &game["made"]));
    }

    // What is told of pairing and players is the sum of the racks.
    let pairing = of(&tournament, "pairing")[0];
    let sum = |key: &str, seat: usize| -> u64 {
        racks.iter().map(|rack| rack[key][seat].as_u64().unwrap()).sum()
    };
    for (seat, player) in of(&tournament, "player").into_iter().enumerate() {
        for key in ["shots", "fouls", "pots", "aimed", "made", "safeties", "breaks", "in_hand"] {
            assert_eq!(player[key], sum(key, seat), "{key}");
            assert_eq!(pairing["accounts"][seat][key], player[key], "{key}");
        }
        assert_eq!(player["breaks"], 2, "they break in turn");
        assert!(player["made"].as_u64() <= player["aimed"].as_u64());
    }
    let wins: u64 = pairing["wins"].as_array().unwrap().iter().map(|w| w.as_u64().unwrap()).sum();
    assert_eq!(wins + pairing["draws"].as_u64().unwrap(), 4);
}

#[test]
fn a_pairing_ends_when_its_question_is_answered() {
    // Whether a hand that shakes wildly wins 19 of 20 is clear after three lost racks.
    let arguments =
        ["tournament", "--players", "paper@20,paper@0", "--racks", "60", "--until", "0.95"];
    let lines = json(&[&arguments[..], &["--json"]].concat());
    let pairing = of(&lines, "pairing")[0];
    assert_eq!(pairing["verdict"], "missed");
    assert!(pairing["racks"].as_u64().unwrap() < 60, "{pairing}");
    assert_eq!(of(&lines, "rack").len() as u64, pairing["racks"].as_u64().unwrap());
    assert_eq!(lines.last().unwrap()["summary"]["decided"], 1);
}

#[test]
fn noises_are_played_one_after_another_and_drawn() {
    let folder = folder("tournament");
    let out = folder.to_str().unwrap();
    let arguments =
        ["tournament", "--players", "paper@0,paper", "--racks", "2", "--noise", "0.5,3"];
    let run = || program(&[&arguments[..], &["--out", out]].concat());
    let output = run();
    assert!(output.status.success(), "{output:?}");
    let shown = text(&output.stdout);
    for expected in ["paper@0 : paper", "0.5", "success %", "robustness.svg"] {
        assert!(shown.contains(expected), "{shown}");
    }
    let file = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    let page = file("tournament.md");
    assert!(page.contains("| paper@0 : paper | 3 | 2 |"), "{page}");
    for figure in ["wins.svg", "robustness.svg"] {
        assert!(file(figure).starts_with("<svg") && page.contains(figure));
    }
    assert_eq!(run().stdout, output.stdout, "two runs print the same bytes");
}

#[test]
fn racks_are_recorded_with_their_players_and_replayed() {
    let folder = folder("tournament_records");
    let record = folder.to_str().unwrap();
    let arguments = ["tournament", "--players", PLAYERS, "--racks", "1", "--record", record];
    assert!(program(&arguments).status.success());
    let file = folder.join("paper-at-0-paper-at-4-noise-1/game_0001.jsonl");
    let replayed = program(&["replay", file.to_str().unwrap(), "--verify"]);
    assert!(replayed.status.success(), "{replayed:?}");
}

#[test]
fn what_is_wrong_about_players_and_goals_is_said_with_what_to_write() {
    for (arguments, expected) in [
        (&["--players", "papier,paper"][..], "is called \"papier\""),
        (&["--players", "paper@x,paper"], "'x' is no noise"),
        (&["--players", "paper"], "give two or more"),
        (&["--players", "paper,paper@1,paper"], "paper is there twice"),
        (&["--players", PLAYERS, "--until", "1"], "write a share above 0.05 and below 1"),
        (&["--players", PLAYERS, "--until", "0.5,0.6"], "one for each pairing"),
        (&["--players", PLAYERS, "--scene", "one_ball"], "a match needs rules and two players"),
        (&["--players", PLAYERS, "--scene", "training"], "training"),
    ] {
        let output = program(&[&["tournament"], arguments].concat());
        assert_eq!(output.status.code(), Some(2), "{output:?}");
        assert!(text(&output.stderr).contains(expected), "{output:?}");
        assert!(output.stdout.is_empty(), "{output:?}");
    }
}

#[test]
#[cfg(feature = "renderer")]
fn thoughts_of_a_game_and_of_its_recording_are_one_picture() {
    let folder = folder("thoughts");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_string();
    let (game, record) = (path("game.png"), path("records"));
    let played = program(&["match", "--seed", "3", "--record", &record]);
    assert!(played.status.success(), "{played:?}");
    let size = ["--size", "320x180", "--thoughts", "4"];
    // The first game of a match has a seed of its own, which its recording holds.
    let recording = path("records/game_0001.jsonl");
    let replayed = path("replayed.png");
    let render = |more: &[&str]| program(&[&["render"], more, &size[..]].concat());
    let again = render(&["--replay", &recording, "--out", &replayed]);
    if text(&again.stderr).contains("cannot draw without a window") {
        return;
    }
    assert!(again.status.success(), "{again:?}");
    let seed = hapticbillard::hash::seed_of(3, 0).to_string();
    let direct = render(&["--scene", "eight_ball_headless", "--seed", &seed, "--out", &game]);
    assert!(direct.status.success(), "{direct:?}");
    assert_eq!(std::fs::read(&game).unwrap(), std::fs::read(&replayed).unwrap());

    let late = program(&["render", "--replay", &recording, "--thoughts", "999", "--out", &game]);
    assert_eq!(late.status.code(), Some(2));
    assert!(text(&late.stderr).contains("strokes are decided on in this game"), "{late:?}");
}
