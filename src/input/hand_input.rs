//! What a hand hears: no keys any more, but what they mean.

use super::feel::TRIGGER_BEGIN;
use super::{Action, AimAid, Steering};
use crate::cue::Aim;
use glam::DVec2;

/// One thing that a player's hand does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum HandInput {
    /// The mouse moved, in heights of the window.
    Moved {
        /// To the right.
        right: f64,
        /// Upwards.
        up: f64,
    },
    /// The wheel turned, in notches; away from the hand is positive.
    Wheel {
        /// How far.
        notches: f64,
    },
    /// An action begins or ends.
    Act {
        /// Which.
        action: Action,
        /// It begins.
        down: bool,
    },
    /// A stick of a gamepad is here from now on: right and up, each from −1 to 1, without its dead
    /// zone.
    Stick {
        /// Which.
        stick: Stick,
        /// Where.
        at: DVec2,
    },
    /// The trigger that strokes is pressed so far from now on [0 to 1].
    Trigger(f64),
    /// A stylus points here in the window, in its heights from its middle.
    Points {
        /// To the right.
        right: f64,
        /// Upwards.
        up: f64,
    },
    /// The cue is held so, from now on.
    Hold(Aim),
    /// So a stylus leads the camera, from now on.
    Steering(Steering),
    /// So much faster a stylus leads the camera, from now on.
    StylusSpeed(f64),
    /// A line of the options that are written in the window was clicked, counted from 0.
    Picked {
        /// Which.
        option: usize,
    },
    /// So much help is wanted while aiming, from now on.
    Aid(AimAid),
    /// Time stands still from now on, or goes on, whatever it did.
    Paused(bool),
    /// Nobody listens to the devices any more: everything held counts as let go.
    FocusLost,
    /// A gamepad is gone: everything held counts as let go, and time stands still.
    PadLost,
    /// The window was closed.
    Closed,
}

impl HandInput {
    /// Whether this is a stick or a trigger that is not at rest.
    pub fn is_moved(&self) -> bool {
        match self {
            HandInput::Stick { at, .. } => *at != DVec2::ZERO,
            HandInput::Trigger(pressed) => TRIGGER_BEGIN < *pressed,
            _ => false,
        }
    }
}

/// A stick of a gamepad.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stick {
    /// Under the left thumb.
    Left,
    /// Under the right thumb.
    Right,
}
