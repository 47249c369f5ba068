//! The mixer: whatever it is told, what comes out is what a head would hear.

/// Left and right, near and far.
mod place;
/// Set-up and measures.
mod rig;
/// Frames, and where the stream is cut.
mod time;
