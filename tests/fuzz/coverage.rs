//! The targets of the fuzz tests as a crate of their own, which libFuzzer is built around: see
//! `coverage/README.md`.

// The modules are those of the seeded tests, which use more of them.
#![allow(dead_code, unused_imports, missing_docs)]

mod allowance;
mod bytes;
mod facts;
mod generator;
mod rules;
pub mod sounds;
pub mod targets;
