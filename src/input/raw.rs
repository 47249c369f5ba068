//! What mouse, keyboard and gamepad say, in units that do not depend on the window's size.

use super::PadInput;

/// One report of a device.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RawInput {
    /// The mouse moved, in heights of the window.
    Moved {
        /// To the right.
        right: f64,
        /// Upwards.
        up: f64,
    },
    /// A button of the mouse.
    Button {
        /// Which.
        button: Button,
        /// Pressed or let go.
        down: bool,
    },
    /// The wheel turned, in notches; away from the hand is positive.
    Wheel {
        /// How far.
        notches: f64,
    },
    /// A key.
    Key {
        /// Which.
        key: Key,
        /// Pressed, or held and repeated by the system; or let go.
        down: bool,
    },
    /// A line of the options that are written in the window was clicked, counted from 0.
    Picked {
        /// Which.
        option: usize,
    },
    /// A gamepad.
    Pad(PadInput),
    /// Another window has the keyboard now: everything held counts as let go.
    FocusLost,
    /// The window was closed.
    Closed,
}

/// A button of the mouse.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Button {
    /// Under the index finger.
    Left,
    /// Under the middle finger.
    Right,
    /// The wheel.
    Middle,
    /// The hind one at the side.
    Back,
    /// The front one at the side.
    Forward,
}

/// A key that the game knows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Key {
    /// Arrow to the left.
    Left,
    /// Arrow to the right.
    Right,
    /// Arrow up.
    Up,
    /// Arrow down.
    Down,
    /// A letter, lower case, a digit, or a mark.
    Letter(char),
    /// The space bar.
    Space,
    /// Return.
    Enter,
    /// Escape.
    Escape,
    /// Tabulator.
    Tab,
    /// Either shift key.
    Shift,
    /// Either control key.
    Control,
    /// Either Alt key.
    Alt,
    /// Page up.
    PageUp,
    /// Page down.
    PageDown,
    /// Home.
    Home,
    /// End.
    End,
    /// Insert.
    Insert,
    /// Delete.
    Delete,
    /// Backspace.
    Backspace,
    /// A function key, by its number.
    Function(u8),
}
