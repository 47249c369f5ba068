//! Tests of the cores: pure, milliseconds.

/// The referee, the rule console and the scenarios of the paper's eight-ball.
mod rules;
