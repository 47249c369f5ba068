//! Seeded fuzz tests.

/// The referee under random facts.
mod rules;
