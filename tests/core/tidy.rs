//! The shape of the repository: what each part may name, and what nobody may leave behind.
//!
//! Every rule is a function of a path and a text, so that it can be shown to fail on a bad sample.

use std::fs;
use std::path::{Path, PathBuf};

/// The modules of `src`, lowest layer first. A module may use its own row and the rows above it.
const LAYERS: [&[&str]; 18] = [
    &[
        "units", "ids", "hash", "ball", "mesh", "cue", "events", "picture", "shipped", "one_line",
        "noise", "quantile",
    ],
    &["table", "rack"],
    // What stands round a table, and the light in it.
    &["room"],
    &["physics"],
    // A scene holds the settings of the physics that it asks for.
    &["scene"],
    // What a hand feels: contact laws, tables and cue, nothing of a game.
    &["haptic"],
    // The order of a tick: what is delivered when, and how it is written down.
    &["event_manager", "tick", "replay"],
    &["rules"],
    &["ai"],
    // Cases with known answers, run on the physics and the learner.
    &["validation"],
    &["input"],
    &["menu"],
    &["sound"],
    &["renderer"],
    &["tally"],
    &["cast"],
    &["lockstep"],
    &["report"],
];

/// The files of `actors` and the core in `src` that each of them runs; those without a core serve
/// several.
const ACTORS: [(&str, Option<&str>); 34] = [
    ("ai", Some("ai")),
    ("conductor", Some("tick")),
    ("event_manager", Some("event_manager")),
    ("haptic", Some("haptic")),
    ("input", Some("input")),
    ("observer", Some("tally")),
    ("physics", Some("physics")),
    ("recorder", Some("replay")),
    ("renderer", Some("renderer")),
    ("rules", Some("rules")),
    ("sound", Some("sound")),
    ("participant", Some("tick")),
    ("batch", None),
    ("build", None),
    ("cli", None),
    ("cpu_time", None),
    ("crew", None),
    ("stopwatch", None),
    ("error", None),
    ("event_log", None),
    ("game", None),
    ("files", None),
    ("histogram", None),
    ("kept", None),
    ("lib", None),
    ("logging", None),
    ("meters", None),
    ("news", None),
    ("shot", None),
    ("main", None),
    ("pacer", None),
    ("runtime", None),
    ("soak", None),
    ("slots", None),
];

/// Longest line [columns].
const COLUMNS_MAX: usize = 100;
/// Longest file [lines].
const LINES_MAX: usize = 600;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Every text file of the repository that somebody wrote, with its path from the root.
fn files() -> Vec<(String, String)> {
    let mut found = Vec::new();
    let mut folders: Vec<PathBuf> =
        ["src", "actors", "assets", "config", "tests", ".ci", ".github"]
            .iter()
            .map(|folder| root().join(folder))
            .collect();
    let mut paths: Vec<PathBuf> = ["Cargo.toml", "README.md", "Makefile", "clippy.toml"]
        .iter()
        .map(|file| root().join(file))
        .collect();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
            let path = entry.path();
            // A crate of its own, outside the workspace, has its build in its folder, and what
            // its fuzzers write.
            let built = ["target", "work", "artifacts"];
            let is_build = path.file_name().is_some_and(|name| built.iter().any(|b| name == *b));
            if path.is_dir() && !is_build {
                folders.push(path);
            } else {
                paths.push(path);
            }
        }
    }
    for path in paths {
        if let (Ok(text), Ok(name)) = (fs::read_to_string(&path), path.strip_prefix(root())) {
            found.push((name.to_string_lossy().replace('\\', "/"), text));
        }
    }
    found.sort();
    found
}

/// The code of a file with its line numbers: without comments and without unit tests.
fn code(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let tests = text.find("#[cfg(test)]\nmod tests {").unwrap_or(text.len());
    text[..tests].lines().enumerate().map(|(i, line)| {
        let code = line.split("//").next().unwrap_or_default();
        (i + 1, code)
    })
}

/// Whether `line` names `word`, not only something that contains it.
fn names(line: &str, word: &str) -> bool {
    let inner = |c: char| c.is_alphanumeric() || c == '_';
    line.match_indices(word).any(|(at, _)| {
        let before = line[..at].chars().next_back().is_some_and(inner);
        let after = line[at + word.len()..].chars().next().is_some_and(inner);
        !before && !after
    })
}

/// Invariant 1: the cores are pure.
fn purity(path: &str, text: &str) -> Vec<String> {
    const IMPURE: [&str; 19] = [
        "kameo",
        "tokio",
        "flume",
        "three_d",
        "winit",
        "cpal",
        "clap",
        "log",
        "std::thread",
        "thread::spawn",
        "Instant",
        "SystemTime",
        "std::fs",
        "std::env",
        "std::net",
        "std::process",
        // Their order differs from run to run.
        "HashMap",
        "HashSet",
        "thread_rng",
    ];
    if !path.starts_with("src/") {
        return Vec::new();
    }
    let impure = |(line, code): (usize, &str)| {
        // `libm::log` is a function, and pure.
        let code = code.replace("libm::log", "");
        let found = IMPURE.iter().filter(|word| names(&code, word));
        found.map(|word| format!("{path}:{line}: a core names {word}")).collect::<Vec<_>>()
    };
    code(text).flat_map(impure).collect()
}

fn layer(module: &str) -> Option<usize> {
    LAYERS.iter().position(|row| row.contains(&module))
}

/// The arrows between the layers point downwards.
fn arrows(path: &str, text: &str) -> Vec<String> {
    let Some(inside) = path.strip_prefix("src/") else { return Vec::new() };
    let module = inside.split(['/', '.']).next().unwrap_or_default();
    if module == "lib" || inside.ends_with("/tests.rs") {
        return Vec::new();
    }
    let Some(own) = layer(module) else {
        return vec![format!("{path}: the module {module} has no layer; add it to LAYERS")];
    };
    let mut wrong = Vec::new();
    for (line, code) in code(text) {
        for part in code.split("crate::").skip(1) {
            let name: String =
                part.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
            if layer(&name).is_some_and(|other| other > own) {
                wrong.push(format!("{path}:{line}: {module} uses {name}, which is above it"));
            }
        }
    }
    wrong
}

/// Invariants 3 and 7: one place knows the graphics library, one place knows files.
fn places(path: &str, text: &str) -> Vec<String> {
    if !path.starts_with("actors/") || !path.ends_with(".rs") {
        return Vec::new();
    }
    let mut wrong = Vec::new();
    for (line, code) in code(text) {
        let graphics = ["three_d", "cgmath", "winit"].iter().any(|word| names(code, word));
        if graphics && !path.starts_with("actors/renderer") {
            wrong.push(format!("{path}:{line}: only actors/renderer knows the graphics library"));
        }
        let opens = ["std::fs", "File::open", "File::create", "OpenOptions"];
        if path != "actors/files.rs" && opens.iter().any(|word| names(code, word)) {
            wrong.push(format!("{path}:{line}: files are opened in actors/files.rs"));
        }
    }
    wrong
}

/// Nothing too long, nothing left over, nothing of one machine only.
fn leftovers(path: &str, text: &str) -> Vec<String> {
    // In two pieces, so that this file is not found.
    let words = [
        concat!("dbg", "!("),
        concat!("todo", "!("),
        concat!("unimplemented", "!("),
        concat!("#[ign", "ore"),
        concat!("#[should", "_panic"),
        concat!("FIX", "ME"),
    ];
    let folders =
        [concat!("/wo", "rk/"), concat!("/t", "mp/"), concat!("/ho", "me/"), concat!("/ro", "ot/")];
    let is_rust = path.ends_with(".rs");
    let mut wrong = Vec::new();
    for (i, line) in text.lines().enumerate() {
        let place = format!("{path}:{}", i + 1);
        if is_rust && line.chars().count() > COLUMNS_MAX {
            wrong.push(format!("{place}: longer than {COLUMNS_MAX} columns"));
        }
        for word in words.iter().filter(|word| is_rust && line.contains(**word)) {
            wrong.push(format!("{place}: left over: {word}"));
        }
        for folder in folders.iter().filter(|folder| line.contains(**folder)) {
            wrong.push(format!("{place}: a path of one machine: {folder}"));
        }
    }
    if is_rust && text.lines().count() > LINES_MAX {
        wrong.push(format!("{path}: longer than {LINES_MAX} lines; look for the seam"));
    }
    wrong
}

/// Every actor has a core of its name.
fn cores(path: &str, exists: &dyn Fn(&str) -> bool) -> Vec<String> {
    let Some(name) = path.strip_prefix("actors/").and_then(|path| path.strip_suffix(".rs")) else {
        return Vec::new();
    };
    if name.contains('/') {
        return Vec::new();
    }
    match ACTORS.iter().find(|(actor, _)| *actor == name) {
        None => vec![format!("{path}: which core does it run? Add it to ACTORS")],
        Some((_, Some(core))) if !exists(&format!("src/{core}.rs")) => {
            vec![format!("{path}: its core src/{core}.rs does not exist")]
        }
        Some(_) => Vec::new(),
    }
}

/// Everything that is wrong with one file.
fn problems(path: &str, text: &str) -> Vec<String> {
    let exists = |core: &str| root().join(core).exists();
    [purity(path, text), arrows(path, text), places(path, text), leftovers(path, text)]
        .into_iter()
        .flatten()
        .chain(cores(path, &exists))
        .collect()
}

#[test]
fn the_repository_is_tidy() {
    let files = files();
    // The canary: a walk that finds nothing finds nothing wrong.
    for known in ["src/lib.rs", "actors/main.rs", "tests/core/tidy.rs", "Cargo.toml"] {
        assert!(files.iter().any(|(path, _)| path == known), "{known} was not read");
    }
    let wrong: Vec<String> = files.iter().flat_map(|(path, text)| problems(path, text)).collect();
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn every_module_has_a_layer_and_every_layer_a_place() {
    let modules = fs::read_to_string(root().join("src/lib.rs")).unwrap();
    let declared = modules.lines().filter_map(|line| line.strip_prefix("pub mod "));
    for module in declared.map(|line| line.trim_end_matches(';')) {
        assert!(layer(module).is_some(), "{module} has no layer");
    }
    let all: Vec<&str> = LAYERS.iter().copied().flatten().copied().collect();
    for (i, module) in all.iter().enumerate() {
        assert!(!all[..i].contains(module), "{module} stands in two layers");
    }
}

#[test]
fn bad_samples_are_found() {
    #[track_caller]
    fn check(path: &str, text: &str, expected: &str) {
        let found = problems(path, text);
        assert!(found.iter().any(|line| line.contains(expected)), "{found:?}");
    }
    check("src/physics/world.rs", "use std::time::Instant;\n", ":1: a core names Instant");
    check("src/ai/plan.rs", "\nlet x: HashMap<u8, u8>;\n", ":2: a core names HashMap");
    check("src/rules.rs", "use kameo::Actor;\n", "a core names kameo");
    check("src/scene.rs", "std::fs::read(path)\n", "a core names std::fs");
    check("src/physics.rs", "use crate::rules::judge;\n", "physics uses rules, which is above it");
    check("src/newcomer.rs", "", "the module newcomer has no layer");
    check("actors/conductor.rs", "use three_d::Window;\n", "only actors/renderer knows");
    check("actors/recorder.rs", "std::fs::write(a, b)\n", "files are opened in actors/files.rs");
    check("actors/newcomer.rs", "", "which core does it run?");
    check("src/units.rs", concat!("dbg", "!(x)\n"), "left over");
    check("README.md", concat!("see /ho", "me/me/notes\n"), "a path of one machine");
    check("src/units.rs", &"x".repeat(101), "longer than 100 columns");
    check("src/units.rs", &"x\n".repeat(601), "longer than 600 lines");
    let missing = cores("actors/rules.rs", &|_| false);
    assert!(missing[0].contains("src/rules.rs does not exist"), "{missing:?}");

    // And what is allowed is not found.
    let fine = "// An Instant would make this impure.\nlet y = libm::log(x) + logarithm;\n";
    assert_eq!(problems("src/physics/laws.rs", fine), Vec::<String>::new());
    let tests = "fn a() {}\n#[cfg(test)]\nmod tests {\n    use crate::lockstep::run;\n}\n";
    assert_eq!(problems("src/units.rs", tests), Vec::<String>::new());
}
