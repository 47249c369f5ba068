//! The report's chapter of what is left out, made alone.

use crate::cli::{folder, program, text};

const BUILDS: &str = r#"{"starts": 20, "builds": [
    {"features": "none", "crates": 130, "program": {"bytes": 9500000,
    "headless_start": {"user_ms": 31.2, "cpu_ms": 38.0, "peak_kib": 20480},
    "one_ball": {"user_ms": 3.4, "cpu_ms": 5.0, "peak_kib": 9000},
    "game": {"user_ms": 60.0, "cpu_ms": 66.0, "peak_kib": 25600}}},
    {"features": "sound", "crates": 149, "program": null}]}"#;

#[test]
fn the_chapter_takes_the_place_of_the_old_one_and_nothing_else_changes() {
    let folder = folder("left_out");
    let (report, builds) = (folder.join("REPORT.md"), folder.join("builds.json"));
    let (before, after) = ("# A report\n\nOf old.\n\n", "## Beyond physics\n\nThe rest.\n");
    let old = format!("{before}## What is left out costs nothing\n\nBanana.\n\n{after}");
    std::fs::write(&report, old).unwrap();
    std::fs::write(&builds, BUILDS).unwrap();
    let (out, builds) = (folder.to_str().unwrap(), builds.to_str().unwrap());
    let output = program(&["report", "--left-out", "--builds", builds, "--out", out]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let made = std::fs::read_to_string(&report).unwrap();
    assert!(made.starts_with(before) && made.ends_with(after), "{made}");
    assert!(!made.contains("Banana") && made.contains("in a run of its own"), "{made}");
    for (scene, _) in hapticbillard::shipped::SCENES {
        assert!(made.contains(&format!("\n| {scene} |")), "{scene}");
    }
    let row = "| none | 130 | 9.5 | 31 (38) | 3 (5) | 60 (66) | 25.0 |";
    assert!(made.contains(row) && made.contains("| sound | 149 | - |"), "{made}");
}

#[test]
fn what_is_no_report_and_what_are_no_builds_is_refused_in_one_line() {
    let folder = folder("left_out_refused");
    let (report, builds) = (folder.join("REPORT.md"), folder.join("builds.json"));
    std::fs::write(&report, "# Something else\n").unwrap();
    let refused = |arguments: &[&str], expected: &str| {
        let output = program(arguments);
        assert_eq!(output.status.code(), Some(2), "{output:?}");
        let told = text(&output.stderr);
        assert!(told.contains(expected) && told.lines().count() == 1, "{told}");
    };
    let out = folder.to_str().unwrap();
    refused(&["report", "--left-out", "--out", out], "no chapter of what is left out");
    std::fs::write(&builds, r#"{"starts": 20, "builds": [{"features": "none"}]}"#).unwrap();
    let builds = builds.to_str().unwrap();
    let expected = "missing field `crates`";
    refused(&["report", "--left-out", "--builds", builds, "--out", out], expected);
    assert_eq!(std::fs::read_to_string(&report).unwrap(), "# Something else\n");
}
