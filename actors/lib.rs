//! HapticBillard's actors: one kameo shell per core of the package `hapticbillard`, and what they
//! share with the operating system.
//!
//! A shell moves messages in and out of its core and decides nothing about billiards. The runtime
//! is the only place that says who runs where.

pub mod error;

pub mod files;

pub mod participant;

pub mod event_manager;
