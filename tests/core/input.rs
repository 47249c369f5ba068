//! A person at mouse, keyboard and gamepad, from raw reports to the game.

/// What is seen ahead.
mod ahead;
/// Aiming and placing: what is held how, and what may not be.
mod aim;
/// Which key means what, and what is held.
mod bindings;
/// Calls, options, training.
mod calls;
/// A camera that is led by hand.
mod camera;
/// A game in lockstep with a script at mouse and keyboard.
pub mod desk;
/// A person whose stylus strikes.
mod led;
/// A gamepad.
mod pad;
/// Whole turns and games of a person.
mod play;
/// Strokes: what the hand does is what the tip does.
mod stroke;
/// A stylus beside the mouse: who strikes, and what becomes of a stroke whose device is lost.
mod stylus;

mod tutor;

mod views;
