//! HapticBillard's actors: one kameo shell per core of the package `hapticbillard`.
//!
//! A shell moves messages in and out of its core and decides nothing. [`runtime`] is the only
//! place that says who runs where.

pub mod event_manager;
pub mod participant;
