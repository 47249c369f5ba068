//! `haptic simulate`: cases and strokes as a script sees them.

use crate::cli::{folder, lines, program, text};
use std::fs;
use std::path::Path;

#[test]
fn cases_are_rows_and_a_summary() {
    let output = program(&["haptic", "simulate", "--only", "H7", "H13", "--json"]);
    assert!(output.status.success(), "{output:?}");
    let lines = lines(&output.stdout);
    assert_eq!(lines.len(), 3);
    for (line, id) in lines.iter().zip(["H7", "H13"]) {
        assert_eq!([&line["id"], &line["status"]], [id, "pass"]);
        assert!(line["key"].is_string() && line["error"].is_number() && line["limit"].is_number());
    }
    assert_eq!(lines[2]["summary"]["pass"], 2);
    let wrong = program(&["haptic", "simulate", "--only", "H99"]);
    assert_eq!(wrong.status.code(), Some(2));
    assert!(text(&wrong.stderr).contains("see `hapticbillard haptic simulate` for the ids"));
}

#[test]
fn a_file_of_cases_is_judged_by_what_it_says() {
    let folder = folder("haptic_cases");
    let file = folder.join("cases.json");
    let case = |id: &str, ratio: f64| {
        format!(
            r#"{{"id": "{id}", "kind_of_run": "bounce_gain", "setup": {{"m_kg": 0.1,
            "K_N_m": 800, "T_s": 0.001, "speed_m_s": 0.3, "phases": 50}},
            "expect": {{"speed_ratio": {ratio}}}, "tolerance": {{"rel": 0.01}}}}"#
        )
    };
    // exp(pi T sqrt(K/m)/4) for a held force.
    let text = format!("{{\"cases\": [{}, {}]}}", case("X1", 1.0728), case("X2", 1.2));
    fs::write(&file, text).unwrap();
    let output = program(&["haptic", "simulate", "--cases", file.to_str().unwrap(), "--json"]);
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    let lines = lines(&output.stdout);
    assert_eq!([&lines[0]["status"], &lines[1]["status"]], ["pass", "fail"]);
}

#[test]
fn a_stroke_is_told_tick_by_tick() {
    let folder = folder("haptic_stroke");
    let file = folder.join("stroke.csv");
    let path = file.to_str().unwrap();
    let arguments =
        ["haptic", "simulate", "--stroke", "1.0", "--hand", "arm", "--out", path, "--json"];
    let output = program(&arguments);
    let csv = fs::read_to_string(&file).unwrap();
    assert!(output.status.success(), "{output:?}");
    let summary = &lines(&output.stdout)[0]["summary"];
    let number = |key: &str| summary[key].as_f64().unwrap();
    // Scale and gain make 5.5 m/s of a hand at 1 m/s.
    assert!((number("tip_m_s") / 5.5 - 1.0).abs() < 0.02, "{summary}");
    assert!(number("ball_m_s") > 7.0 && number("force_peak_n") <= 3.3, "{summary}");
    let rows: Vec<&str> = csv.lines().collect();
    assert_eq!(rows.len() as f64, number("ticks") + 1.0);
    let columns = rows[0].split(',').count();
    assert!(rows.iter().all(|row| row.split(',').count() == columns));
    let struck = rows.iter().filter(|row| row.contains("struck 0")).count();
    assert_eq!(struck, 1);
}

#[test]
fn devices_are_listed_and_what_is_not_built_in_says_so() {
    let lines = lines(&program(&["haptic", "devices", "--json"]).stdout);
    let is = |name: &str| lines.iter().find(|line| line["name"] == name).unwrap();
    assert_eq!(is("simulated")["built_in"], true);
    assert_eq!(is("mouse")["spec"]["force_max_n"], 3.3);
    assert_eq!(is("openhaptics")["built_in"], false);
    assert_eq!(lines.last().unwrap()["summary"]["built_in"], 2);
    let plain = program(&["haptic", "devices"]);
    assert!(
        text(&plain.stdout)
            .lines()
            .any(|line| { line.starts_with("haply") && line.ends_with("not built in") })
    );
}

#[test]
fn the_check_says_what_was_asked_for_and_measures() {
    let output = program(&["haptic", "check", "--seconds", "0.5", "--load", "--json"]);
    let summary = &lines(&output.stdout)[0]["summary"];
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    // Every deadline had its tick or was missed; a busy machine misses many.
    let due = number(&summary["ticks"]) + number(&summary["missed"]);
    assert!(due >= 450.0 && number(&summary["ticks"]) > 10.0, "{summary}");
    for measured in ["lateness_us", "work_us"] {
        let [p50, p99, most] = ["p50", "p99", "max"].map(|key| number(&summary[measured][key]));
        assert!(p50 <= p99 && p99 <= most, "{summary}");
    }
    assert!(number(&summary["work_us"]["p50"]) > 0.1, "{summary}");
    for right in ["core", "priority", "memory"] {
        let outcome = &summary[right]["outcome"];
        let remedy = &outcome["refused"]["remedy"];
        assert!(outcome["obtained"].is_string() || remedy.is_string(), "{summary}");
    }
    let is_ours = number(&summary["overruns"]) * 1000.0 > number(&summary["ticks"]);
    assert_eq!(output.status.code(), Some(i32::from(is_ours)), "{summary}");

    let output = program(&["haptic", "check", "--seconds", "0.2", "--core", "1023"]);
    let told = text(&output.stdout);
    assert!(told.contains("core       asked for core 1023: core 1023 was refused"), "{told}");
    for line in ["priority ", "memory ", "spin ", "ticks ", "lateness ", "work ", "overruns "] {
        assert!(told.lines().any(|told| told.starts_with(line)), "{told}");
    }
}

#[test]
fn a_scene_says_what_its_servo_will_get() {
    let told = program(&["scene", "haptic_touch"]);
    assert!(text(&told.stdout).contains("priority   asked for real-time priority 80"), "{told:?}");
    let json = lines(&program(&["scene", "haptic_touch", "--json"]).stdout);
    let servo = &json.last().unwrap()["summary"]["servo"];
    assert_eq!([&servo["priority"], &servo["spin_us"]], [80, 100]);
    let none = lines(&program(&["scene", "eight_ball", "--json"]).stdout);
    assert!(none.last().unwrap()["summary"]["servo"].is_null());
}

/// The ticks of a telemetry file, which begins with the names of its columns.
fn ticks(file: &Path) -> Vec<u64> {
    let text = fs::read_to_string(file).unwrap();
    let mut rows = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let columns = rows.next().unwrap();
    let late = columns.iter().position(|name| *name == "late_s").unwrap();
    rows.map(|row| {
        assert_eq!(row.len(), columns.len());
        assert!(row[late].parse::<f64>().unwrap() >= 0.0);
        row[0].parse().unwrap()
    })
    .collect()
}

#[test]
fn telemetry_has_every_tick_once_and_in_order() {
    let folder = folder("telemetry");
    let file = folder.join("ticks.csv");
    let path = file.to_str().unwrap();
    let check = ["haptic", "check", "--seconds", "0.5", "--telemetry", path, "--json"];
    let summary = lines(&program(&check).stdout)[0]["summary"].clone();
    let told = &summary["telemetry"];
    let ticks = ticks(&file);
    assert_eq!([&told["rows"], &told["lost"]], [ticks.len(), 0], "{summary}");
    assert!(ticks.len() > 10 && ticks.iter().zip(1..).all(|(tick, nth)| *tick == nth));
    assert!(!folder.join("ticks.csv.part").exists());
}

#[cfg(unix)]
#[test]
fn an_interrupted_check_leaves_whole_telemetry() {
    use std::process::{Command, Stdio};
    let folder = folder("telemetry_interrupted");
    let (file, part) = (folder.join("ticks.csv"), folder.join("ticks.csv.part"));
    let child = Command::new(env!("CARGO_BIN_EXE_hapticbillard"))
        .args(["haptic", "check", "--seconds", "600", "--telemetry", file.to_str().unwrap()])
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    // Once there are rows it runs, and hears.
    let begun = || fs::metadata(&part).is_ok_and(|part| part.len() > 20_000);
    let is_there = (0..1200).any(|_| {
        std::thread::sleep(std::time::Duration::from_millis(50));
        begun()
    });
    assert!(is_there, "no telemetry after a minute");
    let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(sent.unwrap().success());
    let output = child.wait_with_output().unwrap();
    let ticks = ticks(&file);
    assert!(ticks.len() > 30 && !part.exists());
    let told = text(&output.stdout);
    assert!(told.contains(&format!("telemetry: {} ticks in ", ticks.len())), "{told}");
}

#[test]
fn telemetry_without_anything_to_feel_is_refused_with_a_sentence() {
    let folder = folder("telemetry_refused");
    let path = folder.join("none.csv");
    let asked = ["play", "--no-record", "--telemetry", path.to_str().unwrap(), "--scene"];
    let output = program(&[&asked[..], &["eight_ball_headless"]].concat());
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("play a scene with [haptic]"), "{output:?}");
    assert!(!path.exists());
    let nowhere = program(&["haptic", "check", "--telemetry", "/proc/none/ticks.csv"]);
    assert_eq!(nowhere.status.code(), Some(2));
    assert!(text(&nowhere.stderr).contains("cannot write /proc/none/ticks.csv"), "{nowhere:?}");
}
