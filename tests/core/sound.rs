//! What is heard, measured as a listener would: level, spectrum, time.

/// Spectra and levels.
mod measure;

/// The click of two balls.
mod ball_click;

/// The mixer: two ears, many voices, a room.
mod mix;
