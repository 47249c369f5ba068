//! A gamepad: what it says, and what becomes of it.
//!
//! Sticks have a dead zone and a curve ([`shaped`]); buttons are bound like keys; the right trigger
//! strokes ([`TriggerPull`]); contacts are felt in the hands ([`Rumble`]).

mod shape;
pub use shape::{DEAD_ZONE, shaped};

mod queue;
pub use queue::PadQueue;

mod sticks;
pub use sticks::{PadMeaning, PadState};

mod trigger;
pub(super) use trigger::{Pulled, TriggerPull};

mod rumble;
pub use rumble::Rumble;

/// One report of a gamepad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PadInput {
    /// A button.
    Button {
        /// Which.
        button: PadButton,
        /// Pressed or let go.
        down: bool,
    },
    /// A stick or a trigger is somewhere else now.
    Axis {
        /// Which.
        axis: PadAxis,
        /// Sticks: from −1 to 1, right and up; triggers: from 0 to 1.
        value: f64,
    },
    /// A gamepad is there.
    Connected,
    /// One is gone.
    Lost,
}

/// A button of a gamepad, by the names on the most usual one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum PadButton {
    /// The lower one of four.
    A,
    /// The right one.
    B,
    /// The left one.
    X,
    /// The upper one.
    Y,
    /// Of the cross.
    Up,
    /// Of the cross.
    Down,
    /// Of the cross.
    Left,
    /// Of the cross.
    Right,
    /// Above the left trigger.
    LeftShoulder,
    /// Above the right trigger.
    RightShoulder,
    /// The left trigger, pressed half or farther.
    LeftTrigger,
    /// The left stick, pressed.
    LeftStick,
    /// The right stick, pressed.
    RightStick,
    /// In the middle, on the right.
    Start,
    /// In the middle, on the left.
    Select,
}

/// What a gamepad says by how far.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum PadAxis {
    /// The left stick to the right.
    LeftX,
    /// The left stick upwards.
    LeftY,
    /// The right stick to the right.
    RightX,
    /// The right stick upwards.
    RightY,
    /// The left trigger.
    LeftTrigger,
    /// The right trigger.
    RightTrigger,
}

impl PadAxis {
    /// All.
    pub const ALL: [PadAxis; 6] = [
        PadAxis::LeftX,
        PadAxis::LeftY,
        PadAxis::RightX,
        PadAxis::RightY,
        PadAxis::LeftTrigger,
        PadAxis::RightTrigger,
    ];
}
