//! The wheel menu as it stands in the window: words, and where they are.

use super::Words;
use crate::menu::Wheel;

/// An open wheel, in words. Places and lengths are in pixels.
#[derive(Debug, Clone, PartialEq)]
pub struct WheelPanel {
    /// Its middle.
    pub centre: [f64; 2],
    /// Radius of its hub.
    pub hub: f64,
    /// Where the pointer is.
    pub pointer: [f64; 2],
    /// The actions.
    pub items: Vec<WheelItem>,
}

/// An action on a wheel.
#[derive(Debug, Clone, PartialEq)]
pub struct WheelItem {
    /// What it is called.
    pub text: String,
    /// The middle of its disc.
    pub at: [f64; 2],
    /// Its radius.
    pub radius: f64,
    /// It is meant.
    pub is_meant: bool,
}

impl WheelPanel {
    /// An open wheel.
    pub fn new(wheel: &Wheel, words: &Words) -> Self {
        let item = |(action, at, radius, is_meant): (crate::input::Action, glam::DVec2, _, _)| {
            let text = words.get(&format!("wheel_{}", action.name()));
            WheelItem { text, at: at.to_array(), radius, is_meant }
        };
        WheelPanel {
            centre: wheel.centre().to_array(),
            hub: wheel.hub(),
            pointer: wheel.pointer().to_array(),
            items: wheel.items().map(item).collect(),
        }
    }
}
