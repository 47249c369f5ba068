//! What a scene does not name is not started: threads and memory of a headless game, counted from
//! outside.

use std::collections::BTreeSet;
use std::fs;
use std::process::{Command, Stdio};
use std::time::Duration;

/// What was seen of a process while it ran.
#[derive(Debug, Default)]
struct Seen {
    /// Names of its threads, those of its first moment apart.
    threads: BTreeSet<String>,
    most_threads: usize,
    /// Peak of its resident memory [kB].
    peak_kb: u64,
    /// Most of what it had of its own: without the program and the libraries [kB].
    own_kb: u64,
}

/// Runs the program and watches it until it ends.
fn watch(arguments: &[&str]) -> Seen {
    let mut child = Command::new(env!("CARGO_BIN_EXE_hapticbillard"))
        .args(arguments)
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let process = format!("/proc/{}", child.id());
    let mut seen = Seen::default();
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        let tasks = fs::read_dir(format!("{process}/task")).into_iter().flatten().flatten();
        let names: Vec<String> = tasks
            .filter_map(|task| fs::read_to_string(task.path().join("comm")).ok())
            .map(|name| name.trim().to_string())
            .collect();
        seen.most_threads = seen.most_threads.max(names.len());
        seen.threads.extend(names);
        let status = fs::read_to_string(format!("{process}/status")).unwrap_or_default();
        let kb = |name: &str| {
            let line = status.lines().find_map(|line| line.strip_prefix(name));
            line.and_then(|text| text.split_whitespace().next()?.parse().ok()).unwrap_or(0)
        };
        seen.peak_kb = seen.peak_kb.max(kb("VmHWM:"));
        seen.own_kb = seen.own_kb.max(kb("RssAnon:"));
        // The peak only grows: the last look before the end is enough.
        std::thread::sleep(Duration::from_millis(2));
    };
    assert!(status.success(), "{arguments:?} failed");
    assert!(0 < seen.peak_kb, "the process was over before it was seen");
    seen
}

#[cfg(target_os = "linux")]
#[test]
fn a_headless_game_starts_one_worker_and_stays_small() {
    let seen =
        watch(&["match", "--scene", "eight_ball_headless", "--games", "1", "--driver", "actors"]);
    // The program, the one job that plays games, and the one worker of the runtime. No window, no
    // sound, no servo, no recorder; physics has no thread of its own in this scene.
    assert!(seen.most_threads <= 3, "{seen:?}");
    for absent in ["window", "render", "sound", "alsa", "servo", "recorder", "physics"] {
        assert!(!seen.threads.iter().any(|name| name.contains(absent)), "{seen:?}");
    }
    // What a game takes; the rest is the program itself and the system's libraries, of which a
    // development build maps 18 MB. (As released all of it is 24 MB: see the report.)
    assert!(seen.own_kb < 16_000, "{seen:?}");
    assert!(seen.peak_kb < 36_000, "{seen:?}");
}

#[cfg(target_os = "linux")]
#[test]
fn lockstep_and_simulate_start_no_runtime() {
    let lockstep = watch(&["match", "--games", "1", "--driver", "lockstep"]);
    assert!(lockstep.most_threads <= 2, "{lockstep:?}");
    assert!(!lockstep.threads.contains("game"), "{lockstep:?}");
    let simulate = watch(&["simulate", "--scene", "break_shot", "--until-rest"]);
    assert_eq!(simulate.most_threads, 1, "{simulate:?}");
}
