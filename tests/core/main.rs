//! Tests of the cores: pure, milliseconds.

/// Tables: dimensions measured back from the vertices, closed body, pockets.
mod table;

/// Racks: order of the balls, gaps, spotting.
mod rack;
