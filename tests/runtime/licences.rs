//! The licences of everything that is linked into the program.
//!
//! `assets/LICENCES.md` lists them; `UPDATE_LICENCES=1` (or `make licences`) writes it anew.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;

/// Licences under which a program may be given away in binary form, with no more than their text
/// beside it. Those of MPL-2.0 are used as they are; their source is at the registry.
const ALLOWED: [&str; 13] = [
    "0BSD",
    "Apache-2.0",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "ISC",
    "MIT",
    "MPL-2.0",
    "OFL-1.1",
    "Ubuntu-font-1.0",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
];

const HEAD: &str = "\
# Licences

HapticBillard is under MIT or Apache-2.0, as you like. These libraries are linked into the program
with its default features on Linux, by the licence that each of them states; their versions stand in
`Cargo.lock`. The texts of all these licences, with the names of those who hold the rights, are in
the Debian package beside this file. Made by `make licences`.
";

/// Whether one can choose so that only what is allowed applies: `(MIT OR X) AND Unicode-3.0`.
fn is_allowed(licence: &str) -> bool {
    // Older packages separate choices by a slash.
    let licence = licence.replace('/', " OR ");
    let choices = |part: &str| {
        let part = part.trim_matches(['(', ')', ' ']);
        part.split(" OR ").any(|choice| {
            let name = choice.split(" WITH ").next().unwrap_or_default();
            ALLOWED.contains(&name.trim())
        })
    };
    // AND binds closer than OR, but every package here puts its choices in brackets.
    licence.split(" AND ").all(choices)
}

/// The libraries under each licence.
fn libraries() -> BTreeMap<String, BTreeSet<String>> {
    let output = Command::new(env!("CARGO"))
        .args(["tree", "--offline", "--locked", "--package", "hapticbillard-actors"])
        .args(["--edges", "normal,no-proc-macro", "--prefix", "none"])
        .args(["--target", "x86_64-unknown-linux-gnu", "--format", "{p}|{l}"])
        .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap())
        .output()
        .unwrap();
    assert!(output.status.success(), "{output:?}");
    let mut found = BTreeMap::<String, BTreeSet<String>>::new();
    for line in String::from_utf8(output.stdout).unwrap().lines() {
        let (package, licence) = line.split_once('|').unwrap();
        let name = package.split(' ').next().unwrap();
        // A package that is listed again is marked.
        let licence = licence.trim_end_matches(" (*)");
        if !name.starts_with("hapticbillard") {
            found.entry(licence.to_string()).or_default().insert(name.to_string());
        }
    }
    found
}

fn overview(libraries: &BTreeMap<String, BTreeSet<String>>) -> String {
    let mut text = HEAD.to_string();
    for (licence, names) in libraries {
        let names: Vec<_> = names.iter().map(String::as_str).collect();
        text += &format!("\n## {licence}\n\n{}\n", names.join(", "));
    }
    text
}

#[test]
fn every_library_may_be_given_away_and_is_listed() {
    let libraries = libraries();
    for (licence, names) in &libraries {
        assert!(is_allowed(licence), "{names:?} are under '{licence}'");
    }
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/LICENCES.md");
    let made = overview(&libraries);
    if std::env::var_os("UPDATE_LICENCES").is_some() {
        std::fs::write(&file, &made).unwrap();
    }
    let listed = std::fs::read_to_string(&file).unwrap_or_default();
    assert!(made == listed, "assets/LICENCES.md is out of date: run `make licences`");
}

#[test]
fn licences_that_bind_the_whole_program_are_found() {
    for fine in ["MIT", "MIT/Apache-2.0", "(MIT OR Apache-2.0) AND Unicode-3.0", "MPL-2.0"] {
        assert!(is_allowed(fine), "{fine}");
    }
    assert!(is_allowed("Apache-2.0 OR GPL-2.0-only"));
    assert!(is_allowed("Apache-2.0 WITH LLVM-exception OR Apache-2.0 OR MIT"));
    for wrong in ["", "GPL-3.0-only", "MIT AND GPL-2.0-only", "(MIT OR Apache-2.0) AND LGPL-3.0"] {
        assert!(!is_allowed(wrong), "{wrong}");
    }
}
