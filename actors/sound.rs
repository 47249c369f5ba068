//! Sound between the core and the operating system.

#[cfg(feature = "sound")]
pub mod bank_files;
