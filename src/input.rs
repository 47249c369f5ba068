//! The input manager: what devices say becomes what a player does.
//!
//! A window (or a script that stands in for one) reports [`RawInput`]. [`Controls`] make an
//! [`Action`] of a key or a button, by [`Bindings`] and the [`Profile`] that is active; what a hand
//! hears is [`HandInput`], which knows no keys. The [`Human`] turns it into commands of one tick,
//! exactly as a computer player gives them, and into the [`HumanView`] that the picture follows.
//! Time comes in ticks; nothing here knows a window.

mod raw;
pub use raw::{Button, Key, RawInput};

mod names;

mod action;
pub use action::Action;

mod control;
pub use control::Control;

mod profile;
pub use profile::{Controller, Profile, Profiles};

mod bindings;
pub use bindings::{Beside, Bindings, BindingsError, Bound};

mod controls;
pub use controls::{Controls, Edge};

mod hand_input;
pub use hand_input::{HandInput, Stick};

mod pad;
pub use pad::{
    DEAD_ZONE, PadAxis, PadButton, PadInput, PadMeaning, PadQueue, PadState, Rumble, shaped,
};

mod view;
pub use view::{CameraPose, HumanMode, HumanView, Look, View};

pub mod feel;

mod foresight;
pub use foresight::{AimAid, BallWay, Foresight};

mod held;

mod camera;
pub use camera::Room;

mod sight;
pub use sight::ghost as first_met;

mod placing;

mod calling;
pub use calling::CallView;

mod tip;

mod hand_over;
pub use hand_over::StylusWord;

mod human;
pub use human::{Human, STYLUS};

mod drive;
pub use drive::{CameraHand, Drive, Steering};

mod pointing;
pub use pointing::{Pointing, StylusMouse, StylusSays};

mod mouse_split;
pub use mouse_split::{MouseSplit, Reader};

mod tutor;
pub use tutor::{Lesson, Tutor};

mod led;
pub use led::{Led, LedHuman};
