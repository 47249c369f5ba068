//! The inputs that coverage-guided fuzzing found, read again: what was right or wrong about them
//! stays so, and a change that breaks one of them is found here.

use super::targets::TARGETS;
use std::fs;
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};

/// The inputs of a target, in order of their names.
fn inputs(target: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fuzz/coverage/corpus");
    let entries = fs::read_dir(folder.join(target)).unwrap_or_else(|e| panic!("{target}: {e}"));
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

#[test]
fn every_input_of_the_corpus_is_taken_or_refused() {
    for (name, run) in TARGETS {
        let paths = inputs(name);
        assert!(!paths.is_empty(), "{name} has no corpus");
        for path in paths {
            let data = fs::read(&path).unwrap();
            let shown = path.display();
            assert!(catch_unwind(|| run(&data)).is_ok(), "{name} fails on {shown}");
        }
    }
}

#[test]
fn every_target_has_a_binary() {
    let manifest = include_str!("coverage/Cargo.toml");
    for (name, _) in TARGETS {
        assert!(manifest.contains(&format!("\"bin/{name}.rs\"")), "{name}");
    }
}
