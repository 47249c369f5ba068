//! The mixer: whatever it is told, what comes out is what a head would hear.

/// Full scale and no further.
mod limiter;
/// Left and right, near and far.
mod place;
/// Sixty-four voices and no more.
mod pool;
/// Set-up and measures.
mod rig;
/// Frames, and where the stream is cut.
mod time;
