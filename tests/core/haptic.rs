//! The haptic renderer: closed loops, effects, safety, strokes.

mod cases;
mod rig;
mod strokes;
mod walls;
