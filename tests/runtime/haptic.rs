//! `haptic simulate`: cases and strokes as a script sees them.

use crate::cli::{folder, lines, program, text};
use crate::mocks::haply_service::{Arm, Fault, HaplyService};
use crate::servo::wait_for;
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
fn devices_are_listed_and_what_is_not_there_says_why() {
    let lines = lines(&program(&["haptic", "devices", "--json"]).stdout);
    let is = |name: &str| lines.iter().find(|line| line["name"] == name).unwrap();
    assert_eq!(is("mouse")["spec"]["force_max_n"], 3.3);
    assert!(is("haply")["built_in"] == true && is("haply")["says"].is_string());
    assert_eq!(lines.last().unwrap()["summary"]["devices"], 5);
    assert_eq!(is("openhaptics")["built_in"], true);
    let plain = program(&["haptic", "devices"]);
    let told = text(&plain.stdout);
    // Wherever this runs, its service runs or does not.
    let says = is("haply")["says"].as_str().unwrap();
    assert!(told.contains(says) && says.contains("localhost:10001"), "{told}");
    assert!(told.contains("recorded:FILE  a recording of a device; like the recorded one"));
}

#[test]
fn a_stroke_that_was_recorded_strikes_again_with_the_same_bits() {
    let folder = folder("recorded_stroke");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_string();
    let [hand, once, again] = ["hand.jsonl", "once.csv", "again.csv"].map(path);
    let stroke = ["haptic", "simulate", "--stroke", "1.0", "--json", "--out", &once];
    let first = program(&[&stroke[..], &["--record", &hand]].concat());
    assert!(first.status.success(), "{first:?}");
    let replay = ["haptic", "simulate", "--recording", &hand, "--json", "--out", &again];
    let second = program(&replay);
    assert!(second.status.success(), "{second:?}");
    assert_eq!(first.stdout, second.stdout);
    assert_eq!(fs::read(&once).unwrap(), fs::read(&again).unwrap());
    // A recording with a wrong line says which.
    let text_of = fs::read_to_string(&hand).unwrap();
    let spoiled: Vec<&str> = text_of.lines().take(7).chain(["{\"dt\":\"soon\"}"]).collect();
    fs::write(&hand, spoiled.join("\n")).unwrap();
    let wrong = program(&replay);
    assert_eq!(wrong.status.code(), Some(2));
    let told = text(&wrong.stderr);
    assert!(
        told.contains("hand.jsonl: line 8: invalid type") && told.lines().count() == 1,
        "{told}"
    );
}

#[test]
fn the_check_records_a_device_and_feels_the_recording() {
    let folder = folder("recorded_check");
    let file = folder.join("hand.jsonl");
    let path = file.to_str().unwrap();
    let output = program(&["haptic", "check", "--seconds", "0.4", "--record", path, "--json"]);
    let device = &lines(&output.stdout)[0]["summary"]["device"];
    let recorded = device["recorded"].as_u64().unwrap();
    assert!(recorded > 10 && device["recording_lost"] == 0, "{device}");
    let text_of = fs::read_to_string(&file).unwrap();
    assert_eq!(text_of.lines().count() as u64, recorded + 1);
    assert!(!file.with_file_name("hand.jsonl.part").exists());
    let name = format!("recorded:{path}");
    let output = program(&["haptic", "check", "--seconds", "0.2", "--device", &name, "--json"]);
    let device = &lines(&output.stdout)[0]["summary"]["device"];
    assert_eq!([&device["name"], &device["model"]], [&name, "recorded device"]);
    assert_eq!(device["troubles"].as_array().map(Vec::len), Some(0), "{device}");
}

#[cfg(target_os = "linux")]
#[test]
fn a_recording_that_is_interrupted_is_whole() {
    use rustix::process::{Pid, Signal, kill_process};
    let file = folder("interrupted_check").join("hand.jsonl");
    let child = std::process::Command::new(env!("CARGO_BIN_EXE_hapticbillard"))
        .args(["haptic", "check", "--seconds", "600", "--record", file.to_str().unwrap()])
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::null())
        .spawn()
        .unwrap();
    let part = file.with_file_name("hand.jsonl.part");
    let written = || fs::read_to_string(&part).map_or(0, |text| text.lines().count());
    wait_for("some readings", || written() > 100);
    kill_process(Pid::from_child(&child), Signal::INT).unwrap();
    let output = child.wait_with_output().unwrap();
    let told = text(&output.stdout);
    let readings = told.lines().find(|line| line.starts_with("recorded")).unwrap();
    let whole = fs::read_to_string(&file).unwrap();
    let count = format!("recorded   {} readings, 0 lost", whole.lines().count() - 1);
    assert_eq!(readings, count);
    assert!(whole.ends_with("}\n") && !part.exists());
}

#[test]
fn a_haply_service_can_be_checked_and_one_that_is_not_there_is_told() {
    let service = HaplyService::start(Arm::NEW, Fault::None);
    let name = format!("haply:{}", service.address());
    let check = ["haptic", "check", "--seconds", "0.5", "--device", &name, "--json"];
    let device = &lines(&program(&check).stdout)[0]["summary"]["device"];
    assert_eq!([&device["name"], &device["model"]], [&name, "Haply Inverse3"]);
    let number = |key: &str| device[key].as_f64().unwrap();
    assert!(number("latency_us") > 0.0 && number("stiffness_max_n_m") <= 500.0, "{device}");
    assert!(service.counts()[1] > 300 && service.force_n() == 0.0);
    drop(service);
    let refused = program(&check);
    assert_eq!(refused.status.code(), Some(2));
    let told = text(&refused.stderr);
    assert!(told.starts_with("error: no Haply Inverse service answers at 127.0.0.1"), "{told}");
    let wrong = program(&["haptic", "check", "--device", "haply:here"]);
    assert!(text(&wrong.stderr).contains("`hapticbillard haptic devices` lists them"));
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
    let file = folder("haptic_scene").join("omni.toml");
    let own = "[scene]\nname = \"x\"\n[physics]\n[haptic]\ndevice = \"openhaptics\"\n";
    fs::write(&file, own).unwrap();
    let told = program(&["scene", file.to_str().unwrap()]);
    for part in ["servo in the scheduler of the device's library", "80: the vendor's scheduler"] {
        assert!(text(&told.stdout).contains(part), "{told:?}");
    }
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
