//! Tests of the cores: pure, milliseconds.

/// The computer player: planning, cue motion, turn states.
mod ai;
/// Tables: dimensions measured back from the vertices, closed body, pockets.
mod table;

/// Racks: order of the balls, gaps, spotting.
mod rack;
