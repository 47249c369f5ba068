//! The game: one actor per core, and what they share with the operating system.
//!
//! The cores are in the package `hapticbillard`; nothing here decides anything about billiards.

pub mod error;

pub mod files;
