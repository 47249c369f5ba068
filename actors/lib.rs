//! HapticBillard's actors: one kameo shell per core of the package `hapticbillard`, and what they
//! share with the operating system.
//!
//! A shell moves messages in and out of its core and decides nothing about billiards. [`runtime`]
//! is the only place that says who runs where.
//!
//! # Looking inside
//!
//! - **The log**: [`logging`] says who writes what where. From `info` on a line names its shot.
//! - **The window**: F3 shows how long ticks and pictures take, and what waits in which queue;
//!   see [`meters`].
//! - **tokio-console** shows every task, how often it was woken and how long it was busy. With the
//!   feature `trace` every message of an actor is a span below that of its shot:
//!   ```text
//!   RUSTFLAGS="--cfg tokio_unstable" cargo run --release --features console,trace -- play
//!   tokio-console                        # in another terminal; cargo install tokio-console
//!   ```
//! - **A flame graph** of a headless game, with Linux's `perf`. The release profile keeps line
//!   tables for it; `cpu-clock` works on virtual machines too, where there are no counters:
//!   ```text
//!   cargo build --release && cargo install inferno
//!   perf record -e cpu-clock -F 499 --call-graph dwarf,16384 -o perf.data \
//!     target/release/hapticbillard match --games 20
//!   perf script -i perf.data | inferno-collapse-perf | inferno-flamegraph > flame.svg
//!   ```
//!   `perf report -i perf.data --no-children` says the same as a table.

pub mod error;

pub mod files;

pub mod logging;

pub mod shot;

pub mod cpu_time;

pub mod histogram;

pub mod batch;

pub mod kept;

pub mod participant;

pub mod event_manager;

pub mod physics;

pub mod rules;

pub mod ai;

pub mod input;

pub mod haptic;

pub mod sound;

pub mod observer;

pub mod event_log;

pub mod recorder;

pub mod conductor;

pub mod pacer;

pub mod meters;

pub mod news;

pub mod crew;

pub mod runtime;

pub mod stopwatch;

pub mod game;

pub mod soak;

#[cfg(feature = "renderer")]
pub mod renderer;
