//! What is heard, measured as a listener would: level, spectrum, time.

/// Spectra and levels.
mod measure;

/// The click of two balls.
mod ball_click;
/// Recordings in place of the synthesis.
mod bank;
/// All other classes.
mod classes;
/// Balls that roll and slide, and a quiet room.
mod rolling;
/// Ends, means, chance and absurd orders.
mod safe;

/// The mixer: two ears, many voices, a room.
mod mix;

/// What facts and snapshots sound like.
mod foley;

/// From the time of the game to the frames of a stream.
mod timeline;

/// Real shots, from physics to samples.
mod shots;
