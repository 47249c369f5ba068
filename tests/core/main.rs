//! Tests of the cores: pure, milliseconds.
