//! Tests of the cores: pure, milliseconds.

/// Scene files: what is wrong in them is said in one exact line.
mod scene;
