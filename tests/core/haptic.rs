//! The haptic renderer: closed loops, effects, safety, strokes.

mod allocation;
mod cases;
mod effects;
mod guard;
mod inverse3;
mod mouse;
mod recording;
mod rig;
mod section;
mod strokes;
mod touch;
mod walls;
mod workspace;
