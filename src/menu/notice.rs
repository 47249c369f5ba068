//! What a menu has to say to the player, before it is put into words.

use crate::input::{Action, Control};

/// One thing to say.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Notice {
    /// Something went wrong; in words already.
    Wrong(String),
    /// A key was given to another action than these, which have lost it.
    Lost {
        /// Which key.
        control: Control,
        /// They.
        losers: Vec<Action>,
    },
    /// A key stays where it is: this action cannot be without it.
    Refused {
        /// Which key.
        control: Control,
        /// It.
        of: Action,
    },
    /// All keys are as they are shipped.
    UsualKeys,
    /// The program is new to whoever sees it.
    Welcome,
    /// A gamepad is gone.
    PadLost,
}
