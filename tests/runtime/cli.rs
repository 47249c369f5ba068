//! The program as a shell sees it: what it prints where, and its exit codes.

use serde_json::Value;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// Runs the program with nothing on its standard input.
pub fn program(arguments: &[&str]) -> Output {
    with_stdin(arguments, "")
}

fn with_stdin(arguments: &[&str], stdin: &str) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_hapticbillard"))
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // Who does not read stdin has closed it by now; that is no failure.
    let _ = child.stdin.take().unwrap().write_all(stdin.as_bytes());
    child.wait_with_output().unwrap()
}

/// The JSON lines that it printed.
pub fn lines(bytes: &[u8]) -> Vec<Value> {
    let text = std::str::from_utf8(bytes).unwrap();
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// What it printed.
pub fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

/// A folder of this test's own, empty at its start.
pub fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

#[track_caller]
fn refused(arguments: &[&str], expected: &str) {
    let output = program(arguments);
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    assert!(output.stdout.is_empty(), "{output:?}");
    assert_eq!(text(&output.stderr), format!("error: {expected}\n"));
}

#[test]
fn every_command_teaches_with_an_example() {
    let commands = [
        "play",
        "simulate",
        "match",
        "tournament",
        "replay",
        "render",
        "bake",
        "scene",
        "scenes",
        "rules",
        "validate",
        "report",
        "learn",
        "soak",
        "doctor",
        "completions",
        "man",
    ];
    for command in commands {
        let output = program(&[command, "--help"]);
        assert!(output.status.success(), "{command}");
        let help = text(&output.stdout);
        assert!(
            help.contains(&format!("  hapticbillard {command} "))
                || command == "play"
                || help.contains(&format!("| hapticbillard {command}")),
            "{help}"
        );
        assert!(help.contains("Examples:"), "{help}");
    }
    for command in ["simulate", "check", "devices"] {
        let help = program(&["haptic", command, "--help"]);
        let example = format!("Examples:\n  hapticbillard haptic {command}");
        assert!(text(&help.stdout).contains(&example), "{help:?}");
    }
    for command in ["render", "bank", "devices"] {
        let help = program(&["sound", command, "--help"]);
        let example = format!("  hapticbillard sound {command}");
        assert!(text(&help.stdout).contains(&example), "{help:?}");
    }
    let help = program(&["--help"]);
    assert!(text(&help.stdout).contains("haptic"));
    assert!(text(&help.stdout).contains("sound"));
    assert!(commands.iter().all(|command| text(&help.stdout).contains(command)));
}

#[test]
fn a_mistyped_command_line_exits_with_2() {
    for wrong in [
        &["banana"][..],
        &["scenes", "--yaml"],
        &["match", "--games", "0"],
        &["play", "--speed", "-1"],
        &["--seed", "3", "simulate"],
        &["render", "--scene", "one_ball", "--out", "picture.jpg"],
        &["render", "--scene", "one_ball", "--out", "picture.png", "--eye", "1,2"],
        &["bake", "--samples", "0"],
    ] {
        let output = program(wrong);
        assert_eq!(output.status.code(), Some(2), "{wrong:?}");
        assert!(output.stdout.is_empty(), "{wrong:?}");
    }
}

#[test]
fn what_every_command_takes_stands_before_or_behind_it() {
    for arguments in [&["-v", "scenes"], &["scenes", "-v"]] {
        assert!(program(arguments).status.success(), "{arguments:?}");
    }
}

#[test]
fn scenes_lists_each_shipped_scene_on_one_line() {
    let output = program(&["scenes", "--json"]);
    let lines = lines(&output.stdout);
    let count = hapticbillard::shipped::SCENES.len();
    assert_eq!(lines.len(), count + 1);
    assert_eq!(lines[count]["summary"]["scenes"], count);
    let plain = program(&["scenes"]);
    assert_eq!(text(&plain.stdout).lines().count(), count);
}

#[test]
fn scene_says_what_starts_and_what_was_left_out() {
    let lines = lines(&program(&["scene", "one_ball", "--json"]).stdout);
    let kinds = |kind: &str| lines.iter().filter(|line| line["kind"] == kind).count();
    let summary = &lines[lines.len() - 1]["summary"];
    assert_eq!(summary["actors"], kinds("actor"));
    assert_eq!(summary["terms"], kinds("term"));
    assert_eq!(summary["left_out"], kinds("left_out"));
    assert_eq!(summary["balls"], 1);
    let left_out = |name| lines.iter().any(|l| l["name"] == name && l["kind"] == "left_out");
    assert!(left_out("renderer") && left_out("rules") && left_out("ball-ball contact"));
}

#[test]
fn a_wrong_scene_is_one_line_on_stderr() {
    let folder = folder("wrong_scene");
    let file = folder.join("wrong.toml");
    std::fs::write(&file, "[scene]\nname = \"x\"\n[physics]\nstep_s = 0.004\n").unwrap();
    let file = file.to_str().unwrap();
    refused(
        &["scene", file],
        &format!(
            "{file}:4: physics.step_s = 0.004: physics has the keys solver, step_ms, integrator, \
             sub_steps, profile, ball_law, cushion_law, multi_contact, hop_m_s, lasting_step_ms, \
             gravity_m_s2, ball_friction, flight, contact_back_dating, thread; did you mean \
             step_ms?"
        ),
    );
    refused(
        &["scene", "banana"],
        "there is no scene 'banana': write a file or one of eight_ball, eight_ball_headless, \
         wpa_eight_ball, nine_ball, straight, training, tutorial, free_play, snooker, \
         three_cushion, free_carom, break_shot, one_ball, minigolf, haptic_touch",
    );
}

const FOUL: &str = "{\"t\":0,\"e\":\"place\",\"ball\":\"0\",\"zone\":\"kitchen\",\"ok\":true}\n\
    {\"t\":0.1,\"e\":\"tip\",\"ball\":\"0\"}\n# a comment\n{\"t\":9,\"e\":\"settle\"}\n";

#[test]
fn rules_judges_what_is_piped_in() {
    let output = with_stdin(&["rules", "--game", "paper8", "--why", "--json"], FOUL);
    assert!(output.status.success(), "{output:?}");
    let lines = lines(&output.stdout);
    let verdict = lines.iter().find(|line| line.get("verdict").is_some()).unwrap();
    assert_eq!(verdict["verdict"]["fouls"][0], "no_contact");
    assert!(!verdict["why"].as_array().unwrap().is_empty());
    let summary = &lines[lines.len() - 1]["summary"];
    assert_eq!((&summary["verdicts"], &summary["fouls"]), (&1.into(), &1.into()));

    let wrong = with_stdin(&["rules"], "{\"t\":0,\"e\":\"banana\"}\n");
    assert_eq!(wrong.status.code(), Some(2));
    let line = text(&wrong.stderr);
    assert!(line.starts_with("error: stdin: line 1,") && line.lines().count() == 1, "{line}");
}

#[test]
fn a_failing_scenario_exits_with_1() {
    let folder = folder("scenarios");
    let file = folder.join("one.json");
    let scenario = |legal: bool| {
        format!(
            "[{{\"id\":\"A\",\"ruleset\":\"free_play\",\"state\":{{\"player\":1,\"shot\":\
             \"normal\",\"on_table\":[\"1\"]}},\"events\":[{{\"t\":0,\"e\":\"tip\",\"ball\":\
             \"0\"}},{{\"t\":1,\"e\":\"settle\"}}],\"expect\":{{\"legal\":{legal},\
             \"turn\":\"continue\",\"next_player\":1}}}}]"
        )
    };
    for (legal, code) in [(true, 0), (false, 1)] {
        std::fs::write(&file, scenario(legal)).unwrap();
        let output = program(&["rules", "--json", "--scenarios", file.to_str().unwrap()]);
        assert_eq!(output.status.code(), Some(code), "{output:?}");
        let lines = lines(&output.stdout);
        assert_eq!(lines[0]["status"], if legal { "pass" } else { "fail" });
        assert_eq!(lines[1]["summary"]["pass"], u32::from(legal));
    }
}

#[test]
fn without_features_no_graphics_library_is_built() {
    let output = Command::new(env!("CARGO"))
        .args(["tree", "--offline", "--locked", "--package", "hapticbillard-actors"])
        .args(["--no-default-features", "--edges", "normal", "--prefix", "none"])
        .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap())
        .output()
        .unwrap();
    let tree = text(&output.stdout);
    assert!(tree.contains("kameo "), "{output:?}");
    for library in ["three-d", "winit", "egui", "khronos-egl", "cpal"] {
        assert!(!tree.lines().any(|line| line.starts_with(&format!("{library} "))), "{library}");
    }
}

#[test]
fn validate_prints_a_line_a_case_and_exits_with_1_if_one_fails() {
    let output = program(&["validate", "--only", "B05", "D04", "P07", "--json"]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let printed = lines(&output.stdout);
    assert_eq!(printed.len(), 4);
    let ids: Vec<&str> = printed[..3].iter().map(|line| line["id"].as_str().unwrap()).collect();
    assert_eq!(ids, ["B05", "D04", "P07"]);
    assert_eq!(printed[0]["status"], "pass");
    assert_eq!(printed[0]["key"], "throw_deg");
    assert!(printed[0]["error"].as_f64().unwrap() <= printed[0]["limit"].as_f64().unwrap());
    assert!(printed[0]["cpu_ms"].as_f64().unwrap() >= 0.0);
    assert_eq!(printed[2]["status"], "unsupported");
    let summary = &printed[3]["summary"];
    assert_eq!([&summary["pass"], &summary["fail"], &summary["unsupported"]], [2, 0, 1]);

    let file = folder("validate").join("wrong.json");
    let wrong = r#"{"cases": [{"id": "W", "kind_of_run": "fixed_step_figures",
        "setup": {"T_s": 0.004, "speed_m_s": 5}, "expect": {"travel_per_step_m": 0.03}}]}"#;
    std::fs::write(&file, wrong).unwrap();
    let output = program(&["validate", "--cases", file.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    let shown = text(&output.stdout);
    assert!(
        shown.contains("FAIL") && shown.ends_with("0 pass, 1 fail, 0 unsupported\n"),
        "{shown}"
    );
}

#[test]
fn learn_writes_a_figure_and_numbers_for_each_condition_and_the_same_bytes_again() {
    let written = |name: &str| {
        let folder = folder(name);
        let out = folder.to_str().unwrap();
        let arguments = ["learn", "--out", out, "--profile", "2009", "--no-ball-friction"];
        let output =
            program(&[&arguments[..], &["--seeds", "3", "--shots", "25", "--json"]].concat());
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        let rows = lines(&output.stdout);
        let ids: Vec<_> = rows[..2].iter().map(|row| row["condition"].as_str().unwrap()).collect();
        assert_eq!(ids, ["2009_no_friction_no_back_dating", "2009_no_friction"]);
        assert_eq!(rows[2]["summary"]["conditions"], 2);
        let read = |file: String| std::fs::read_to_string(folder.join(file)).unwrap();
        let csv = read(format!("{}.csv", ids[1]));
        assert_eq!(csv.lines().count(), 26, "{csv}");
        assert!(csv.starts_with("shot,cut_deg,"), "{csv}");
        let svg = read(format!("{}.svg", ids[1]));
        assert!(svg.contains("threshold") && svg.contains("hit rate, mean of 10"), "{svg}");
        let summary: Value = serde_json::from_str(&read("summary.json".into())).unwrap();
        assert_eq!(summary["conditions"][0], rows[0]);
        [csv, svg, read("LEARN.md".into())]
    };
    assert_eq!(written("learn"), written("learn_again"));
}

#[test]
fn learn_makes_the_shipped_throw_table() {
    let file = folder("throw").join("throw.toml");
    let output = program(&["learn", "--throw-table", file.to_str().unwrap(), "--json"]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let made = std::fs::read_to_string(&file).unwrap();
    assert_eq!(made, hapticbillard::shipped::THROW_TABLE);
    let summary = &lines(&output.stdout)[0]["summary"];
    assert!(summary["error_deg"].as_f64() < summary["best_single_error_deg"].as_f64());
}

#[test]
fn validate_refuses_what_is_no_catalogue_in_one_line() {
    let file = folder("validate_bad").join("bad.json");
    let name = file.to_str().unwrap();
    std::fs::write(&file, "{\"cases\": [{\"id\": 3}]}").unwrap();
    refused(
        &["validate", "--cases", name],
        &format!(
            "{name}: cases[0]: has no id; write \"id\": \"A01\"; see the shipped catalogue for the \
             format"
        ),
    );
    refused(
        &["validate", "--only", "Z99"],
        "--only: there is no case 'Z99'; see `hapticbillard validate` for the ids",
    );
    let output = program(&["validate", "--solver", "banana"]);
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    assert!(text(&output.stderr).contains("fixed-step"), "{output:?}");
}

#[test]
fn a_step_or_an_integrator_for_a_solver_without_steps_is_refused() {
    let exact = ["simulate", "--scene", "one_ball", "--solver", "event-driven", "--until", "1"];
    for option in [["--step-ms", "1"], ["--integrator", "rk4"]] {
        let expected = format!(
            "{}: event-driven has no steps, so it would change nothing; add --solver fixed-step, \
             or leave it out",
            option[0]
        );
        refused(&[&exact[..], &option].concat(), &expected);
        // To measure beside it there is a stepper.
        let bench = program(&[&exact[..], &option, &["--bench", "1"]].concat());
        assert!(bench.status.success(), "{bench:?}");
    }
}

#[test]
fn play_without_a_display_says_so_in_one_line_and_plays_on() {
    let folder = folder("no_display");
    let output = Command::new(env!("CARGO_BIN_EXE_hapticbillard"))
        .arg("play")
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .env("HOME", &folder)
        .env("XDG_DATA_HOME", &folder)
        .output()
        .unwrap();
    assert!(output.status.success(), "{output:?}");
    let said = text(&output.stderr);
    let first = said.lines().next().unwrap();
    assert!(first.ends_with("eight_ball_headless is played without a window"), "{first}");
    assert!(said.lines().skip(1).all(|line| line.starts_with("shot ")), "{said}");
    assert!(text(&output.stdout).contains(" wins after "), "{output:?}");
    let recordings = folder.join("hapticbillard").join("recordings");
    let files: Vec<_> = std::fs::read_dir(recordings).unwrap().collect();
    assert_eq!(files.len(), 1);
    let file = files[0].as_ref().unwrap().path();
    let checked = program(&["replay", file.to_str().unwrap(), "--verify", "--headless"]);
    assert!(checked.status.success(), "{checked:?}");
}

#[cfg(not(feature = "renderer"))]
#[test]
fn render_in_a_build_without_pictures_says_so() {
    refused(
        &["render", "--scene", "one_ball", "--out", "never.png"],
        "render: this build draws no pictures; \
         build it with the feature `renderer`, which is there by default",
    );
}

#[test]
fn report_writes_tables_figures_and_a_page_that_name_the_same_runs() {
    let folder = folder("report");
    let out = folder.to_str().unwrap();
    let output =
        program(&["report", "--quick", "--only", "bounce", "spring_stiff", "--out", out, "--json"]);
    assert!(output.status.success(), "{output:?}");
    let printed = lines(&output.stdout);
    let summary = &printed[printed.len() - 1]["summary"];
    let count = |status: &str| printed.iter().filter(|line| line["status"] == status).count();
    assert_eq!(summary["rows"], printed.len() - 1);
    assert_eq!([&summary["failed"], &summary["left_out"]], [count("failed"), count("left out")]);
    assert!(count("failed") > 0 && count("left out") > 0 && count("ok") > 0);
    for line in &printed[..printed.len() - 1] {
        assert!(line["status"] != "ok" || line["error_m"].as_f64().unwrap() < 1.0, "{line}");
        assert!(line["status"] == "ok" || !line["remark"].as_str().unwrap().is_empty(), "{line}");
    }

    let read = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    assert_eq!(read("errors.csv").lines().count(), printed.len());
    let page = read("REPORT.md");
    for figure in ["bounce.svg", "spring_stiff.svg", "chaos.svg"] {
        assert!(page.contains(&format!("]({figure})")), "{figure}");
        assert!(read(figure).starts_with("<svg "), "{figure}");
    }
    assert!(!page.contains("NaN"), "{page}");
    refused(
        &["report", "--only", "banana"],
        "--only: there is no scene 'banana'; write sliding, draw, masse, cut, cut_cushion, \
         rail_first, jump, bounce, pocket, spring_soft, spring, spring_stiff, cradle, break, \
         thousand",
    );
}

#[test]
fn report_puts_other_programs_beside_its_own_rows() {
    let folder = folder("report_peers");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let (cases, file) = (path("cases.jsonl"), path("peers.json"));
    let bounce = ["report", "--quick", "--only", "bounce"];
    let output = program(&[&bounce[..], &["--cases", &cases]].concat());
    assert!(output.status.success(), "{output:?}");
    let case = &lines(&std::fs::read(&cases).unwrap())[0];
    assert_eq!(case["starts"][0]["truth_m"].as_array().unwrap().len(), 32);

    let row = |program: &str, step_ms: Value, error_m: Value, status: &str, remark: &str| {
        serde_json::json!({
            "scene": "bounce", "digest": case["digest"], "program": program, "setting": "",
            "step_ms": step_ms, "starts": 3, "error_m": error_m,
            "cpu_us_per_s": if error_m.is_null() { Value::Null } else { [1e-3; 3].into() },
            "status": status, "remark": remark,
        })
    };
    let one = |name: &str, problem: Option<&str>| {
        let about = format!("About {name}.");
        serde_json::json!({"name": name, "version": "1", "about": about, "problem": problem})
    };
    let mut peers = serde_json::json!({
        "made": "some day",
        "programs": [one("alpha", None), one("beta", None), one("gamma", Some("no wheel"))],
        "rows": [
            row("alpha", 4.0.into(), 1e-20.into(), "ok", "helped"),
            row("beta", Value::Null, Value::Null, "cannot_express", "balls cannot fly"),
        ],
    });
    let write = |peers: &Value| std::fs::write(&file, peers.to_string()).unwrap();
    write(&peers);
    let out = path("out");
    let output = program(&[&bounce[..], &["--out", &out, "--peers", &file]].concat());
    assert!(output.status.success(), "{output:?}");
    let read = |name: &str| std::fs::read_to_string(Path::new(&out).join(name)).unwrap();
    let page = read("REPORT.md");
    for expected in [
        "- alpha (1): About alpha.",
        "- gamma (not run: no wheel): About gamma.",
        "| alpha | 4 | 1.0e-20 | - | 0.0 (0.0 to 0.0) | - | ok: helped |",
        "| beta | - | - | - | - | - | cannot express: balls cannot fly |",
        "Event-driven is not on the Pareto front: as good and as cheap or better are alpha at 4 ms",
    ] {
        assert!(page.contains(expected), "{expected} is not in\n{page}");
    }
    let errors = read("errors.csv");
    assert!(errors.contains("\nbounce,\"beta\",,position,"), "{errors}");
    let fields = |line: &str| line.split(',').count();
    let counts: Vec<usize> = errors.lines().map(fields).collect();
    assert!(counts.windows(2).all(|pair| pair[0] == pair[1]), "{errors}");
    let figure = read("bounce.svg");
    assert!(figure.contains("alpha") && !figure.contains("beta"), "{figure}");

    peers["rows"][0]["digest"] = "0000000000000001".into();
    write(&peers);
    refused(
        &[&bounce[..], &["--out", &out, "--peers", &file]].concat(),
        &format!(
            "--peers {file}: alpha was given another scene 'bounce' than this one; \
             write it anew with tests/peers/run.py"
        ),
    );
}
