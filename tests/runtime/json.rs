//! What `--json` prints: the keys that scripts rely on, and options that change what they should.

use super::cli::{folder, lines, program};
use serde_json::Value;

/// Runs a command that succeeds; returns its lines and its summary.
#[track_caller]
fn json(arguments: &[&str]) -> (Vec<Value>, Value) {
    let output = program(arguments);
    assert!(output.status.success(), "{output:?}");
    let mut lines = lines(&output.stdout);
    let summary = lines.pop().unwrap()["summary"].clone();
    assert!(lines.iter().all(|line| line.get("summary").is_none()));
    (lines, summary)
}

#[track_caller]
fn has_keys(value: &Value, keys: &[&str]) {
    let object = value.as_object().unwrap();
    for key in keys {
        assert!(object.contains_key(*key), "{key} is missing in {value}");
    }
}

const WORK: [&str; 6] =
    ["steps", "events", "pair_tests", "face_tests", "contacts", "force_evaluations"];

#[test]
fn simulate_prints_samples_facts_and_a_summary() {
    let (printed, summary) =
        json(&["simulate", "--scene", "break_shot", "--sample", "0.5", "--until", "2", "--json"]);
    let (samples, facts): (Vec<_>, Vec<_>) =
        printed.iter().partition(|line| line.get("balls").is_some());
    let times: Vec<f64> = samples.iter().map(|line| line["t"].as_f64().unwrap()).collect();
    assert_eq!(times, [0.0, 0.5, 1.0, 1.5, 2.0]);
    for ball in samples[1]["balls"].as_array().unwrap() {
        has_keys(ball, &["id", "position_m", "velocity_m_s", "angular_velocity_rad_s", "motion"]);
        assert_eq!(ball["position_m"].as_array().unwrap().len(), 3);
    }
    assert!(facts.len() > 10);
    for fact in &facts {
        has_keys(fact, &["t", "fact", "e"]);
    }
    // One stream in the order of time.
    let all = printed.iter().map(|line| line["t"].as_f64().unwrap());
    assert!(all.collect::<Vec<_>>().is_sorted());
    has_keys(&summary, &["cpu_ms", "work", "energy_J", "state_hash", "end_s", "facts"]);
    has_keys(&summary["work"], &WORK);
    has_keys(&summary["energy_J"], &["start", "end"]);
    assert_eq!((&summary["end_s"], &summary["facts"]), (&2.0.into(), &facts.len().into()));
}

#[test]
fn simulate_prints_the_same_bytes_again_but_for_its_run_time() {
    let run = |options: &[&str]| {
        let (mut printed, mut summary) = json(&[&["simulate", "--json"], options].concat());
        summary.as_object_mut().unwrap().remove("cpu_ms");
        printed.push(summary);
        printed
    };
    let breaks = ["--scene", "break_shot"];
    assert!(run(&breaks) == run(&breaks));
    // The seed says which ball lies where in the rack.
    let racked = |seed: &str| {
        run(&["--scene", "eight_ball", "--sample", "1", "--until", "0.1", "--seed", seed])
    };
    assert!(racked("5") == racked("5"));
    assert!(racked("5") != racked("6"));
}

#[test]
fn options_of_simulate_stand_in_for_what_the_scene_says() {
    let work = |options: &[&str]| {
        let start = ["simulate", "--scene", "one_ball", "--until", "1", "--json"];
        let (_, summary) = json(&[&start, options].concat());
        let [steps, evaluations] =
            ["steps", "force_evaluations"].map(|key| summary["work"][key].as_u64().unwrap());
        (steps, evaluations, summary["state_hash"].clone())
    };
    let fixed = ["--solver", "fixed-step"];
    let (steps, evaluations, hash) =
        work(&[&fixed[..], &["--step-ms", "2", "--integrator", "euler-cromer"]].concat());
    let (fine_steps, ..) =
        work(&[&fixed[..], &["--step-ms", "0.5", "--integrator", "euler-cromer"]].concat());
    assert_eq!((steps, fine_steps), (500, 2000));
    let (_, rk4_evaluations, rk4_hash) =
        work(&[&fixed[..], &["--step-ms", "2", "--integrator", "rk4"]].concat());
    assert!(2 * evaluations < rk4_evaluations, "{evaluations} {rk4_evaluations}");
    assert_ne!(hash, rk4_hash);
    let (exact_steps, ..) = work(&["--solver", "event-driven"]);
    assert!(exact_steps < steps, "{exact_steps} steps of the exact solver");
}

#[test]
fn simulate_until_rest_ends_when_everything_has_settled() {
    let (printed, summary) = json(&["simulate", "--scene", "one_ball", "--until-rest", "--json"]);
    assert_eq!(printed.last().unwrap()["fact"], "Settled");
    assert_eq!(summary["end_s"].as_f64().unwrap(), printed.last().unwrap()["t"].as_f64().unwrap());
    // It is what is done without being asked.
    let (same, _) = json(&["simulate", "--scene", "one_ball", "--json"]);
    assert_eq!(same, printed);
}

#[test]
fn simulate_bench_prints_how_long_a_shot_takes() {
    let (printed, summary) =
        json(&["simulate", "--scene", "break_shot", "--until", "1", "--bench", "3", "--json"]);
    assert!(printed.is_empty());
    has_keys(&summary, &["shots", "cpu_us_per_shot", "events_per_shot", "us_per_event"]);
    has_keys(&summary["cpu_us_per_shot"], &["mean", "median", "p99"]);
    assert_eq!(summary["shots"], 3);
    assert!(summary["cpu_us_per_shot"]["median"].as_f64().unwrap() > 0.0);
}

#[test]
fn simulate_batch_prints_a_line_a_shot_in_the_order_of_the_file() {
    let file = folder("json_batch").join("shots.jsonl");
    let shots: Vec<String> = (1..=5).map(|n| format!("{{\"speed_m_s\":0.{n}}}\n")).collect();
    std::fs::write(&file, shots.concat()).unwrap();
    let batch = file.to_str().unwrap();
    let (printed, summary) =
        json(&["simulate", "--scene", "free_play", "--batch", batch, "--json"]);
    assert_eq!(summary["shots"], 5);
    let numbers: Vec<u64> = printed.iter().map(|line| line["shot"].as_u64().unwrap()).collect();
    assert_eq!(numbers, (1..=5).collect::<Vec<_>>());
    for line in &printed {
        has_keys(line, &["end_s", "facts", "balls", "energy_J", "state_hash"]);
    }
    // Harder strokes roll for longer, so nothing was mixed up.
    let ends: Vec<f64> = printed.iter().map(|line| line["end_s"].as_f64().unwrap()).collect();
    assert!(ends.is_sorted(), "{ends:?}");
}

#[test]
fn match_prints_a_line_a_game_and_the_totals_and_times_only_when_asked() {
    let arguments = ["match", "--games", "2", "--seed", "1", "--json"];
    let (games, summary) = json(&arguments);
    let keys = ["game", "players", "winner", "shots", "fouls", "pots", "run_out", "state_hash"];
    for (index, game) in games.iter().enumerate() {
        has_keys(game, &keys);
        assert_eq!(game["game"], index + 1);
        assert!(game.get("cpu_ms_per_decision").is_none());
    }
    has_keys(&summary, &["games", "wins", "interval95"]);
    has_keys(&summary["wins"], &["1", "2"]);
    // The same bytes again, whichever runtime plays.
    let again = program(&[&arguments[..], &["--driver", "lockstep"]].concat());
    assert_eq!(again.stdout, program(&arguments).stdout);
    let (timed, _) = json(&["match", "--seed", "1", "--json", "--timing"]);
    has_keys(&timed[0], &["cpu_ms_per_decision"]);
}

#[test]
fn noise_spoils_the_strokes_of_both_players() {
    let shots_and_pots = |noise: &str| {
        let (_, summary) =
            json(&["match", "--games", "3", "--seed", "2", "--noise", noise, "--json"]);
        let sum = |key: &str| {
            let both = summary[key].as_array().unwrap();
            both.iter().map(|count| count.as_u64().unwrap()).sum::<u64>() as f64
        };
        (sum("shots"), sum("pots"))
    };
    let (calm_shots, calm_pots) = shots_and_pots("0");
    let (wild_shots, wild_pots) = shots_and_pots("20");
    assert!(
        2.0 * wild_pots / wild_shots < calm_pots / calm_shots,
        "{calm_pots} of {calm_shots} without noise, {wild_pots} of {wild_shots} with"
    );
    assert_eq!(shots_and_pots("0"), (calm_shots, calm_pots));
}
