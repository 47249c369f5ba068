//! The progress bar: on a terminal it is on stderr, elsewhere it is nowhere, and it never mixes
//! with what a command answers.

use super::cli::{folder, lines, program};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{Winsize, tcsetwinsize};
use std::ffi::OsStr;
use std::fs::File;
use std::io::Read;
use std::os::unix::ffi::OsStrExt;
use std::process::{Command, Stdio};

/// Commands that take a while, with what their bar counts.
fn long_commands(shots: &str) -> Vec<(Vec<&str>, &'static str)> {
    vec![
        (vec!["match", "--games", "2", "--json"], "games"),
        (vec!["simulate", "--scene", "one_ball", "--bench", "50", "--json"], "shots"),
        (vec!["simulate", "--scene", "free_play", "--batch", shots, "--json"], "shots"),
        (vec!["validate", "--only", "B05", "D04", "P07", "--json"], "cases"),
        (vec!["learn", "--check", "--json"], "lessons"),
    ]
}

fn shots(name: &str) -> String {
    let file = folder(name).join("shots.jsonl");
    std::fs::write(&file, "{\"speed_m_s\":1}\n{\"speed_m_s\":2,\"azimuth_deg\":5}\n").unwrap();
    file.to_str().unwrap().to_string()
}

#[test]
fn without_a_terminal_there_is_no_bar() {
    for (arguments, _) in long_commands(&shots("no_bar")) {
        let output = program(&arguments);
        assert!(output.status.success(), "{output:?}");
        assert!(output.stderr.is_empty(), "{arguments:?}: {output:?}");
        assert!(lines(&output.stdout).pop().unwrap()["summary"].is_object());
    }
}

#[test]
fn on_a_terminal_the_bar_is_on_stderr_and_the_answer_stays_clean() {
    for (arguments, what) in long_commands(&shots("bar")) {
        let (answer, shown) = on_a_terminal(&arguments);
        assert!(lines(answer.as_bytes()).pop().unwrap()["summary"].is_object(), "{answer}");
        assert!(shown.contains(what) && shown.contains(" left"), "{arguments:?}: {shown:?}");
        assert!(!shown.contains("summary"), "{shown:?}");
        // It clears its line when it is done.
        assert!(shown.ends_with("\r\u{1b}[2K") || shown.ends_with("\u{1b}[2K\r"), "{shown:?}");
    }
}

/// Runs the program with a terminal as its stderr; returns its stdout and what the terminal got.
fn on_a_terminal(arguments: &[&str]) -> (String, String) {
    let terminal = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).unwrap();
    grantpt(&terminal).unwrap();
    unlockpt(&terminal).unwrap();
    let size = Winsize { ws_row: 25, ws_col: 80, ws_xpixel: 0, ws_ypixel: 0 };
    tcsetwinsize(&terminal, size).unwrap();
    let name = ptsname(&terminal, Vec::new()).unwrap();
    let end = File::options().read(true).write(true).open(OsStr::from_bytes(name.to_bytes()));
    let child = Command::new(env!("CARGO_BIN_EXE_hapticbillard"))
        .args(arguments)
        .env("TERM", "xterm")
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(end.unwrap())
        .spawn()
        .unwrap();
    // Read at once, or a full terminal would make the program wait.
    let reader = std::thread::spawn(move || {
        let mut shown = Vec::new();
        let mut terminal = File::from(terminal);
        let mut bytes = [0; 4096];
        // A terminal that everybody has closed cannot be read any more.
        while let Ok(count @ 1..) = terminal.read(&mut bytes) {
            shown.extend_from_slice(&bytes[..count]);
        }
        String::from_utf8_lossy(&shown).into_owned()
    });
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success(), "{output:?}");
    (String::from_utf8(output.stdout).unwrap(), reader.join().unwrap())
}
