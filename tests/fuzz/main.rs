//! Seeded fuzz tests. `FUZZ_SEED` and `FUZZ_EVENTS` choose another run or a longer one.

// Helpers of tests may fail loudly, as tests do.
#![allow(clippy::unwrap_used)]

/// An allocator that refuses what no small file may cost.
mod allowance;
/// Bytes from outside, and what must hold of what is said about them.
mod bytes;
/// Inputs that libFuzzer found.
mod corpus;
/// Messages of a haptic device's service, and recordings of devices.
mod devices;
/// Random facts for the referee.
mod facts;
/// Texts that come from outside: scenes, meshes, tables, catalogues.
mod files;
/// Seeds from the environment, and ways to spoil a text.
mod generator;
/// What is piped in: facts, scenarios of rules, strokes.
mod lines;
/// Recordings, read and replayed.
mod recordings;
/// Sequences of facts, possible and impossible, against the referee.
mod rules;
/// What is made of bytes from outside, for libFuzzer and for its corpus.
mod targets;
