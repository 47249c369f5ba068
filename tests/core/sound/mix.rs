//! The mixer: whatever it is told, what comes out is what a head would hear.

/// Nothing is allocated after the beginning.
mod allocation;
/// Cuts, volume and modes without clicks.
mod changes;
/// Absurd orders.
mod fuzz;
/// Full scale and no further.
mod limiter;
/// What it costs.
mod load;
/// Doppler, and balls that come and go.
mod moving;
/// Left and right, near and far.
mod place;
/// Sixty-four voices and no more.
mod pool;
/// Set-up and measures.
mod rig;
/// Walls that answer.
mod room;
/// Frames, and where the stream is cut.
mod time;
