//! Completions and manual pages: each command has them, and shells read them.

use crate::cli::{folder, program, text};
use std::io::Write;
use std::process::{Command, Stdio};

/// The names of all commands, as the help lists them.
fn commands() -> Vec<String> {
    let help = program(&["--help"]);
    let help = text(&help.stdout);
    let listed = help.split("Commands:\n").nth(1).unwrap().split("\n\n").next().unwrap();
    // What a command does may go on in a second line.
    let names = listed.lines().filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    let names = names.filter_map(|line| line.split_whitespace().next());
    names.filter(|name| *name != "help").map(String::from).collect()
}

#[test]
fn each_command_has_a_page_with_its_options_and_examples() {
    let folder = folder("manual");
    let output = program(&["man", "--out", folder.to_str().unwrap()]);
    assert!(output.status.success(), "{output:?}");
    let commands = commands();
    assert!(commands.len() > 14, "{commands:?}");
    let read = |page: &str| std::fs::read_to_string(folder.join(page)).unwrap();
    for command in &commands {
        let page = read(&format!("hapticbillard-{command}.1"));
        let escaped = command.replace('-', "\\-");
        assert!(page.contains(&format!("hapticbillard\\-{escaped} \\- ")), "{page}");
        assert!(page.contains(".SH OPTIONS"), "{page}");
    }
    assert!(read("hapticbillard.1").contains("hapticbillard\\-simulate(1)"));
    let check = read("hapticbillard-haptic-check.1");
    // An example keeps its lines.
    let examples = check.split(".EX\n").nth(1).unwrap().split(".EE").next().unwrap();
    assert!(examples.lines().count() > 1, "{check}");
    assert!(examples.lines().all(|line| line.starts_with("  hapticbillard")), "{examples}");
    let pages = std::fs::read_dir(&folder).unwrap().count();
    assert_eq!(text(&output.stdout), format!("{pages} pages in {}\n", folder.display()));
}

#[test]
fn a_manual_that_cannot_be_written_is_one_line_on_stderr() {
    let file = folder("manual_refused").join("file");
    std::fs::write(&file, "").unwrap();
    let output = program(&["man", "--out", file.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    let told = text(&output.stderr);
    assert!(told.starts_with("error: cannot write ") && told.lines().count() == 1, "{told}");
}

#[test]
fn completions_know_each_command_and_bash_reads_them() {
    let commands = commands();
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let output = program(&["completions", shell]);
        assert!(output.status.success(), "{shell}");
        let script = text(&output.stdout);
        for command in &commands {
            assert!(script.contains(command.as_str()), "{shell}: {command}");
        }
    }
    let script = program(&["completions", "bash"]).stdout;
    // Not every system has a bash.
    let ask = "\nCOMP_WORDS=(hapticbillard simulate --see); COMP_CWORD=2; \
               _hapticbillard hapticbillard --see simulate; echo \"${COMPREPLY[@]}\"\n";
    let bash = Command::new("bash").stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
    if let Ok(mut bash) = bash {
        bash.stdin.take().unwrap().write_all(&[&script, ask.as_bytes()].concat()).unwrap();
        let answer = bash.wait_with_output().unwrap();
        assert_eq!(text(&answer.stdout), "--seed\n");
    }
}

#[test]
fn an_unknown_shell_is_refused() {
    let output = program(&["completions", "tcsh"]);
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    assert!(text(&output.stderr).contains("bash, elvish, fish"), "{output:?}");
}
