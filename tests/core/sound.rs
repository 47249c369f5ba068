//! What is heard: measures on the mixer's output.

/// Two ears, many voices, a room.
mod mix;
