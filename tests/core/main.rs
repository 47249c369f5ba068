//! Tests of the cores: pure, milliseconds.

// Helpers of tests may fail loudly, as tests do.
#![allow(clippy::unwrap_used)]

/// Geometry for tests, independent of the solvers' own.
mod geometry;

/// Tables: dimensions measured back from the vertices, closed body, pockets.
mod table;

/// Racks: order of the balls, gaps, spotting.
mod rack;

/// Scenes that several physics tests share.
mod physics_scenes;
mod physics_explore;
