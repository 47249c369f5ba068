//! The input manager.
