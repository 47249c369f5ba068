//! HapticBillard's actors: one kameo shell per core of the package `hapticbillard`, and what they
//! share with the operating system.
//!
//! A shell moves messages in and out of its core and decides nothing about billiards. [`runtime`]
//! is the only place that says who runs where.

pub mod error;

pub mod files;

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

pub mod crew;

pub mod runtime;

pub mod stopwatch;

pub mod game;

pub mod soak;

#[cfg(feature = "renderer")]
pub mod renderer;
