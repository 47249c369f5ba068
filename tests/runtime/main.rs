//! Tests of the runtime.

// Helpers of tests may fail loudly, as tests do.
#![allow(clippy::unwrap_used)]

/// Many shots at once.
mod batch;
/// The program as a shell sees it: what it prints where, and its exit codes.
mod cli;
/// Files: sizes, kinds, writing whole.
mod files;
/// Who stands in for whom.
mod mocks;
/// What enters from outside: pauses, wrong files.
mod outside;
/// Pictures without a window.
#[cfg(feature = "renderer")]
mod pictures;
/// Threads and memory, counted from outside.
mod resources;
/// Actors against lockstep, replays, a mock hand.
mod same_bits;
/// A whole game in a window.
#[cfg(feature = "renderer")]
mod whole_game;
