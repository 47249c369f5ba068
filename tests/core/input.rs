//! A person at mouse and keyboard, from raw reports to the game.

/// A game in lockstep with a script at mouse and keyboard.
mod desk;
/// Strokes: what the hand does is what the tip does.
mod stroke;
