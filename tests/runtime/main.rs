//! Tests of the runtime.

// Helpers of tests may fail loudly, as tests do.
#![allow(clippy::unwrap_used)]

/// The program as a shell sees it: what it prints where, and its exit codes.
mod cli;
/// Files: sizes, kinds, writing whole.
mod files;
