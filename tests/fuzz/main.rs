//! Seeded fuzz tests.
