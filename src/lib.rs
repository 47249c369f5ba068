//! HapticBillard's core: billiards as plain, deterministic Rust.
//!
//! Nothing in this crate starts a thread, reads a clock, opens a file or draws a random number
//! that did not come from a seed. The package `hapticbillard-actors` runs these cores as actors;
//! someone who only wants the physics needs nothing else than this crate.
//!
//! Modules in reading order: shared vocabulary first, then one module per subsystem, then what
//! binds them together.

pub mod units;

pub mod ids;

pub mod hash;

pub mod ball;

pub mod mesh;

pub mod cue;

mod one_line;

pub mod events;

pub mod picture;

pub mod table;

pub mod noise;

pub mod quantile;

pub mod rack;

pub mod room;

pub mod scene;

pub mod haptic;

pub mod shipped;

pub mod event_manager;

pub mod tick;

pub mod physics;

pub mod rules;

pub mod ai;

pub mod validation;

pub mod input;

pub mod menu;

pub mod sound;

pub mod renderer;

pub mod tally;

pub mod cast;

pub mod lockstep;

pub mod replay;

pub mod report;

/// The examples of the README, compiled and run as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
