//! The program beside a RealtimeKit of our own, on a bus of our own: what an ordinary user gets.

use super::cli::{folder, lines, text};
use rustix::thread::{CapabilitySet, remove_capability_from_bounding_set};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::Duration;
use zbus::connection::Builder;
use zbus::{fdo, interface};

const PATH: &str = "/org/freedesktop/RealtimeKit1";
/// The time without a pause that the service allows [µs].
const LIMIT_US: u64 = 200_000;

/// The bus itself, as far as a client greets it.
struct Bus;

#[interface(name = "org.freedesktop.DBus")]
impl Bus {
    fn hello(&self) -> String {
        ":1.1".to_string()
    }
}

/// Grants to threads that have limited themselves, or to nobody.
struct Kit {
    refuses: bool,
}

#[interface(name = "org.freedesktop.RealtimeKit1")]
impl Kit {
    fn make_thread_realtime(&self, thread: u64, priority: u32) -> fdo::Result<()> {
        if self.refuses {
            return Err(fdo::Error::AccessDenied("not this user".into()));
        }
        let limits = std::fs::read_to_string(format!("/proc/{thread}/limits")).unwrap();
        let limit = limits.lines().find(|line| line.starts_with("Max realtime timeout")).unwrap();
        let hard: Option<u64> = limit.split_whitespace().nth(4).and_then(|word| word.parse().ok());
        if hard.is_none_or(|hard| hard > LIMIT_US) {
            return Err(fdo::Error::Failed(format!("no limit: {limit}")));
        }
        // Whoever runs the tests may have no rights to give away: then it only says that it does.
        let (priority, thread) = (priority.to_string(), thread.to_string());
        let arguments = ["--reset-on-fork", "--rr", "--pid", &priority, &thread];
        let _ = Command::new("chrt").args(arguments).status();
        Ok(())
    }

    #[zbus(property, name = "MaxRealtimePriority")]
    fn max_realtime_priority(&self) -> i32 {
        20
    }

    #[zbus(property, name = "RTTimeUSecMax")]
    fn rt_time_usec_max(&self) -> i64 {
        LIMIT_US as i64
    }
}

/// What answers at a bus.
#[derive(Clone, Copy)]
enum Answers {
    Granting,
    Refusing,
    /// It takes the call and says nothing.
    Never,
}

/// A bus at a socket, as long as the program runs.
fn bus(name: &str, answers: Answers) -> PathBuf {
    let socket = folder(name).join("bus");
    let listener = std::os::unix::net::UnixListener::bind(&socket).unwrap();
    listener.set_nonblocking(true).unwrap();
    std::thread::spawn(move || {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().unwrap();
        runtime.block_on(async {
            let listener = tokio::net::UnixListener::from_std(listener).unwrap();
            let (mut served, mut silent) = (Vec::new(), Vec::new());
            loop {
                let (stream, _) = listener.accept().await.unwrap();
                let refuses = match answers {
                    Answers::Granting => false,
                    Answers::Refusing => true,
                    Answers::Never => {
                        silent.push(stream);
                        continue;
                    }
                };
                let server = Builder::unix_stream(stream)
                    .server(zbus::Guid::generate())
                    .and_then(|server| server.p2p().serve_at("/org/freedesktop/DBus", Bus))
                    .and_then(|server| server.serve_at(PATH, Kit { refuses }));
                served.push(server.unwrap().build().await.unwrap());
            }
        });
    });
    socket
}

/// The program of somebody who may not have real-time priority, at this bus.
fn ordinary(bus: &Path, arguments: &[&str]) -> Output {
    // Somebody without rights cannot give one up either.
    let _ = remove_capability_from_bounding_set(CapabilitySet::SYS_NICE);
    Command::new(env!("CARGO_BIN_EXE_hapticbillard"))
        .args(arguments)
        .env("DBUS_SYSTEM_BUS_ADDRESS", format!("unix:path={}", bus.display()))
        .output()
        .unwrap()
}

/// What came of the priority.
fn priority(bus: &Path) -> Value {
    let output = ordinary(bus, &["haptic", "check", "--seconds", "0.3", "--json"]);
    let lines = lines(&output.stdout);
    lines[0]["summary"]["priority"]["outcome"].clone()
}

#[track_caller]
fn check_refused(bus: &Path, reason: &str, remedy: &str) {
    let outcome = priority(bus);
    if outcome["obtained"].is_string() {
        // This user has the right by other means.
        return;
    }
    let refused = &outcome["refused"];
    assert!(refused["reason"].as_str().unwrap().contains(reason), "{refused}");
    let told = refused["remedy"].as_str().unwrap();
    assert!(told.contains(remedy) && told.contains("rtprio 80"), "{refused}");
}

#[test]
fn what_realtime_kit_grants_is_told_with_its_name() {
    let bus = bus("kit_grants", Answers::Granting);
    let outcome = priority(&bus);
    let Some(obtained) = outcome["obtained"].as_str() else {
        // Whoever runs the tests had nothing to give: the program has looked.
        let reason = outcome["refused"]["reason"].as_str().unwrap();
        assert!(reason.contains("RealtimeKit: it was not kept"), "{outcome}");
        return;
    };
    assert!(
        obtained == "SCHED_RR 20, by RealtimeKit" || obtained.contains("the kernel"),
        "{outcome}"
    );
    let scene = ordinary(&bus, &["scene", "haptic_touch"]);
    let line = format!("priority   asked for real-time priority 80: {obtained}");
    assert!(text(&scene.stdout).contains(&line), "{}", text(&scene.stdout));
}

#[test]
fn what_it_refuses_is_told_in_its_words_with_what_would_help() {
    check_refused(&bus("kit_refuses", Answers::Refusing), "RealtimeKit: not this user", "polkit");
}

#[test]
fn without_a_bus_or_with_one_that_says_nothing_the_servo_runs_all_the_same() {
    let nowhere = folder("kit_nowhere").join("bus");
    check_refused(&nowhere, "there is no D-Bus system bus", "install the package rtkit");
    let start = std::time::Instant::now();
    let silent = bus("kit_silent", Answers::Never);
    check_refused(&silent, "RealtimeKit does not answer", "rtkit-daemon");
    assert!(start.elapsed() < Duration::from_secs(60), "it waits for ever");
}
