//! `sound render` and `sound devices` as a shell sees them.

use super::super::cli::{folder, lines, program, text};
use std::fs;
use std::path::Path;

/// Left and right of a file, and its rate [Hz].
fn read(path: &Path) -> (Vec<[f32; 2]>, u32) {
    let mut file = hound::WavReader::open(path).unwrap();
    let spec = file.spec();
    assert_eq!((spec.channels, spec.bits_per_sample), (2, 24));
    let samples: Vec<f32> =
        file.samples::<i32>().map(|sample| sample.unwrap() as f32 / 8_388_607.0).collect();
    (samples.chunks(2).map(|frame| [frame[0], frame[1]]).collect(), spec.sample_rate)
}

fn energy(heard: &[[f32; 2]], ear: usize) -> f64 {
    heard.iter().map(|frame| f64::from(frame[ear]) * f64::from(frame[ear])).sum()
}

#[test]
fn a_scene_and_the_facts_and_samples_of_it_sound_alike() {
    let folder = folder("render_alike");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let [whole, again, piped, facts] = ["a.wav", "b.wav", "c.wav", "facts.jsonl"].map(path);
    let render = |what: [&str; 2], out: &str| {
        let mut arguments =
            vec!["sound", "render", "--seed", "5", "--seconds", "1.5", "--json", "--out", out];
        arguments.extend(what);
        let output = program(&arguments);
        assert!(output.status.success(), "{output:?}");
        lines(&output.stdout).pop().unwrap()["summary"].clone()
    };
    let summary = render(["--scene", "break_shot"], &whole);
    assert!(summary["onsets"].as_u64().unwrap() > 20, "{summary}");
    assert_eq!(summary["refused"], 0);
    render(["--scene", "break_shot"], &again);
    assert!(fs::read(&whole).unwrap() == fs::read(&again).unwrap(), "two runs differ");

    let simulated = program(&[
        "simulate",
        "--seed",
        "5",
        "--scene",
        "break_shot",
        "--until",
        "1.5",
        "--sample",
        "0.002",
        "--json",
    ]);
    fs::write(&facts, simulated.stdout).unwrap();
    render(["--facts", &facts], &piped);
    let ((whole, rate), (piped, _)) = (read(Path::new(&whole)), read(Path::new(&piped)));
    assert_eq!((whole.len(), piped.len(), rate), (72_000, 72_000, 48_000));
    for ear in [0, 1] {
        let ratio = energy(&piped, ear) / energy(&whole, ear);
        assert!((0.8..1.25).contains(&ratio), "{ratio}");
    }
}

#[test]
fn a_recorded_game_sounds_as_it_did() {
    let folder = folder("render_recording");
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let [game, played, replayed] = ["game.jsonl", "a.wav", "b.wav"].map(path);
    let scene = ["--scene", "eight_ball_headless", "--seed", "5"];
    let output = program(&[&["play"], &scene[..], &["--record", &game]].concat());
    assert!(output.status.success(), "{output:?}");
    for (what, out) in [(&scene[..], &played), (&["--recording", &game], &replayed)] {
        let rest = ["--seconds", "12", "--out", out];
        let output = program(&[&["sound", "render"], what, &rest].concat());
        assert!(output.status.success(), "{output:?}");
    }
    let (heard, _) = read(Path::new(&played));
    assert!(energy(&heard, 0) > 0.01, "{}", energy(&heard, 0));
    assert!(fs::read(&played).unwrap() == fs::read(&replayed).unwrap(), "they differ");
}

#[test]
fn rate_mode_and_place_of_the_listener_are_heard() {
    let folder = folder("render_options");
    let facts = folder.join("facts.jsonl");
    let hit = |y: f64| {
        format!(
            "{{\"t\":0.1,\"e\":\"hit\",\"a\":\"0\",\"b\":\"1\",\"position_m\":[0,{y},0.03],\
             \"normal_speed_m_s\":3}}\n"
        )
    };
    // To the left of somebody who looks along +x.
    fs::write(&facts, hit(0.6)).unwrap();
    let out = folder.join("out.wav");
    for (mode, rate) in [("headphones", 44_100_u32), ("loudspeakers", 96_000)] {
        let rate_text = rate.to_string();
        let output = program(&[
            "sound",
            "render",
            "--facts",
            facts.to_str().unwrap(),
            "--out",
            out.to_str().unwrap(),
            "--mode",
            mode,
            "--rate",
            &rate_text,
            "--listener=-1,0,0.3",
            "--no-room",
        ]);
        assert!(output.status.success(), "{output:?}");
        let (heard, found) = read(&out);
        assert_eq!(found, rate);
        assert!(energy(&heard, 0) > 1.3 * energy(&heard, 1), "{mode}");
        let first = heard.iter().position(|frame| frame[0].abs() > 1e-5).unwrap();
        let way_s = 1.36_f64.sqrt() / 343.0;
        let late_s = first as f64 / f64::from(rate) - 0.1 - way_s;
        assert!(late_s.abs() < 0.001, "{mode}: {late_s}");
    }
}

#[test]
fn whatever_cannot_be_rendered_is_said_in_one_line() {
    let folder = folder("render_wrong");
    let file = |name: &str, text: &str| {
        let path = folder.join(name);
        fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let nothing = file("nothing.jsonl", "\n");
    let broken = file("broken.jsonl", "{\"t\":0.1,\"e\":\"hit\",\"a\":\"0\"\n");
    let late = file("late.jsonl", "{\"t\":1e300,\"e\":\"settle\"}\n");
    let strange = file("strange.jsonl", "{\"t\":0,\"e\":\"banana\"}\n");
    let out = folder.join("never.wav");
    for (what, value, place) in [
        ("--facts", nothing.as_str(), "there is no fact in it"),
        ("--facts", &broken, "broken.jsonl:1"),
        ("--facts", &late, "no time of a game"),
        ("--facts", &strange, "banana"),
        ("--facts", "missing.jsonl", "missing.jsonl"),
        ("--scene", "banana", "'banana'"),
        ("--recording", &broken, "broken.jsonl"),
    ] {
        let output = program(&["sound", "render", what, value, "--out", out.to_str().unwrap()]);
        assert_eq!(output.status.code(), Some(2), "{output:?}");
        let said = text(&output.stderr);
        assert!(said.starts_with("error: ") && said.contains(place), "{said}");
        assert_eq!(said.lines().count(), 1, "{said}");
    }
    assert!(!out.exists());
    // What was not written whole does not stay behind.
    let nowhere = folder.join("nothing.jsonl").join("out.wav");
    let output = program(&[
        "sound",
        "render",
        "--scene",
        "break_shot",
        "--seconds",
        "0.1",
        "--out",
        nowhere.to_str().unwrap(),
    ]);
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 4);
}

#[test]
fn a_scene_is_mixed_as_it_says_and_the_command_line_goes_before() {
    let folder = folder("render_section");
    let sounds = folder.join("sounds");
    let sounds = sounds.to_str().unwrap();
    let bank = program(&["sound", "bank", "--out", sounds, "--variants", "1", "--rate", "22050"]);
    assert!(bank.status.success(), "{bank:?}");
    let render = |section: &str, flags: &[&str]| {
        let (scene, out) = (folder.join("scene.toml"), folder.join("out.wav"));
        let balls = "[[ball]]\nid = 0\nposition_m = [-0.3, 0, 0.03]\nvelocity_m_s = [3, 0, 0]\n\
            [[ball]]\nid = 1\nposition_m = [0, 0, 0.03]\n";
        let section = section.replace(';', "\n");
        fs::write(&scene, format!("[scene]\nname = \"x\"\n[physics]\n{section}\n{balls}")).unwrap();
        let (scene, written) = (scene.to_str().unwrap(), out.to_str().unwrap());
        let whole = ["sound", "render", "--seconds", "0.5", "--scene", scene, "--out", written];
        let output = program(&[&whole[..], flags].concat());
        assert!(output.status.success(), "{output:?}");
        read(&out).0
    };
    let plain = render("[sound];room = false", &[]);
    assert!(energy(&plain, 0) > 0.0);
    assert!(plain == render("[sound]", &["--no-room"]));
    for (key, flag) in [
        ("mode = \"loudspeakers\"", &["--mode", "loudspeakers"][..]),
        ("volume = 0.5", &["--volume", "0.5"]),
        ("recordings = \"sounds\"", &["--recordings", sounds]),
    ] {
        let said = render(&format!("[sound];room = false;{key}"), &[]);
        assert!(said != plain, "{key} is not heard");
        assert!(said == render("[sound];room = false", flag), "{key} is not {flag:?}");
    }
    let said = "[sound];room = false;mode = \"loudspeakers\";volume = 0.5";
    assert!(plain == render(said, &["--mode", "headphones", "--volume", "1"]));
    assert!(plain != render("[sound];room = false;room_tone = true", &[]));
    // Without a section it is what a section without a key asks for.
    assert!(render("", &[]) == render("[sound]", &[]));
}
