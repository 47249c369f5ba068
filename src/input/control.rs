//! What can be pressed, and its name in files.

use super::{Button, Key, PadButton};

/// A key, a button of the mouse, or a button of a gamepad.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Control {
    /// Of the keyboard.
    Key(Key),
    /// Of the mouse.
    Button(Button),
    /// Of a gamepad.
    Pad(PadButton),
}

/// Keys that are no characters, by name.
const KEYS: [(&str, Key); 18] = [
    ("left", Key::Left),
    ("right", Key::Right),
    ("up", Key::Up),
    ("down", Key::Down),
    ("space", Key::Space),
    ("enter", Key::Enter),
    ("escape", Key::Escape),
    ("tab", Key::Tab),
    ("shift", Key::Shift),
    ("control", Key::Control),
    ("alt", Key::Alt),
    ("page_up", Key::PageUp),
    ("page_down", Key::PageDown),
    ("home", Key::Home),
    ("end", Key::End),
    ("insert", Key::Insert),
    ("delete", Key::Delete),
    ("backspace", Key::Backspace),
];
/// So many function keys there are.
const FUNCTION_KEYS: u8 = 12;
/// Characters that are keys by themselves, beside letters and digits.
const MARKS: &str = "+-,.;'/\\[]`<";

const BUTTONS: [(&str, Button); 5] = [
    ("mouse_left", Button::Left),
    ("mouse_right", Button::Right),
    ("mouse_middle", Button::Middle),
    ("mouse_back", Button::Back),
    ("mouse_forward", Button::Forward),
];

const PADS: [(&str, PadButton); 15] = [
    ("pad_a", PadButton::A),
    ("pad_b", PadButton::B),
    ("pad_x", PadButton::X),
    ("pad_y", PadButton::Y),
    ("pad_up", PadButton::Up),
    ("pad_down", PadButton::Down),
    ("pad_left", PadButton::Left),
    ("pad_right", PadButton::Right),
    ("pad_left_shoulder", PadButton::LeftShoulder),
    ("pad_right_shoulder", PadButton::RightShoulder),
    ("pad_left_trigger", PadButton::LeftTrigger),
    ("pad_left_stick", PadButton::LeftStick),
    ("pad_right_stick", PadButton::RightStick),
    ("pad_start", PadButton::Start),
    ("pad_select", PadButton::Select),
];

impl Control {
    /// Its name in files.
    pub fn name(self) -> String {
        let of = |names: &[(&str, Control)]| {
            names.iter().find(|(_, one)| *one == self).map(|(name, _)| (*name).to_string())
        };
        match self {
            Control::Key(Key::Letter(letter)) => letter.to_string(),
            Control::Key(Key::Function(number)) => format!("f{number}"),
            _ => of(&Self::named_ones()).unwrap_or_default(),
        }
    }

    /// What has this name.
    pub fn named(name: &str) -> Option<Self> {
        let mut letters = name.chars();
        if let (Some(letter), None) = (letters.next(), letters.next()) {
            let is_key =
                letter.is_ascii_lowercase() || letter.is_ascii_digit() || MARKS.contains(letter);
            return is_key.then_some(Control::Key(Key::Letter(letter)));
        }
        let named = Self::named_ones();
        let found = named.iter().find(|(one, _)| *one == name).map(|(_, control)| *control);
        found.or_else(|| Self::functions().find(|control| control.name() == name))
    }

    /// Every name that a file may hold.
    pub fn names() -> Vec<String> {
        let letters = ('a'..='z').chain('0'..='9').chain(MARKS.chars()).map(String::from);
        let named = Self::named_ones().into_iter().map(|(name, _)| name.to_string());
        letters.chain(named).chain(Self::functions().map(Control::name)).collect()
    }

    /// Whether it is on a gamepad.
    pub fn is_pad(self) -> bool {
        matches!(self, Control::Pad(_))
    }

    fn functions() -> impl Iterator<Item = Control> {
        (1..=FUNCTION_KEYS).map(|number| Control::Key(Key::Function(number)))
    }

    fn named_ones() -> Vec<(&'static str, Control)> {
        let keys = KEYS.iter().map(|(name, key)| (*name, Control::Key(*key)));
        let buttons = BUTTONS.iter().map(|(name, button)| (*name, Control::Button(*button)));
        let pads = PADS.iter().map(|(name, button)| (*name, Control::Pad(*button)));
        keys.chain(buttons).chain(pads).collect()
    }
}
