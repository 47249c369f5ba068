//! The input manager: what devices say becomes what a player does.
//!
//! A window (or a script that stands in for one) reports [`RawInput`]; the [`Human`] turns it into
//! commands of one tick, exactly as a computer player gives them, and into the [`HumanView`] that
//! the picture follows. Time comes in ticks; nothing here knows a window.

mod human;
mod raw;
mod view;

pub use human::Human;
pub use raw::{Button, Key, RawInput};
pub use view::{CameraPose, HumanMode, HumanView};
