//! Tests of the cores: pure, milliseconds.

/// The computer player: planning, cue motion, turn states.
mod ai;
