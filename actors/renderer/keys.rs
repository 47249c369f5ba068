//! Keys and buttons of the window system as the game knows them.

use hapticbillard::input::{Button, Key};
use winit::event::{MouseButton, MouseScrollDelta, VirtualKeyCode};

/// Pixels of a touchpad's scrolling that count as one notch of a wheel.
const PIXELS_PER_NOTCH: f64 = 40.0;

/// The buttons that the game knows.
pub fn button(button: MouseButton) -> Option<Button> {
    match button {
        MouseButton::Left => Some(Button::Left),
        MouseButton::Right => Some(Button::Right),
        MouseButton::Middle => Some(Button::Middle),
        // As X11 and evdev count them; other systems begin at 1 with the hind one.
        MouseButton::Other(1 | 8) => Some(Button::Back),
        MouseButton::Other(2 | 9) => Some(Button::Forward),
        MouseButton::Other(_) => None,
    }
}

/// How far a wheel was turned [notches].
pub fn notches(delta: MouseScrollDelta) -> f64 {
    match delta {
        MouseScrollDelta::LineDelta(_, lines) => f64::from(lines),
        MouseScrollDelta::PixelDelta(pixels) => pixels.y / PIXELS_PER_NOTCH,
    }
}

/// The keys that the game knows.
pub fn key(code: VirtualKeyCode) -> Option<Key> {
    use VirtualKeyCode as Code;
    Some(match code {
        Code::Left => Key::Left,
        Code::Right => Key::Right,
        Code::Up => Key::Up,
        Code::Down => Key::Down,
        Code::Space => Key::Space,
        Code::Return | Code::NumpadEnter => Key::Enter,
        Code::Escape => Key::Escape,
        Code::Tab => Key::Tab,
        Code::LShift | Code::RShift => Key::Shift,
        Code::LControl | Code::RControl => Key::Control,
        Code::LAlt => Key::Alt,
        Code::PageUp => Key::PageUp,
        Code::PageDown => Key::PageDown,
        Code::Home => Key::Home,
        Code::End => Key::End,
        Code::Insert => Key::Insert,
        Code::Delete => Key::Delete,
        Code::Back => Key::Backspace,
        Code::Plus | Code::Equals | Code::NumpadAdd => Key::Letter('+'),
        Code::Minus | Code::NumpadSubtract => Key::Letter('-'),
        Code::Comma => Key::Letter(','),
        Code::Period => Key::Letter('.'),
        Code::Semicolon => Key::Letter(';'),
        Code::Apostrophe => Key::Letter('\''),
        Code::Slash => Key::Letter('/'),
        Code::Backslash => Key::Letter('\\'),
        Code::LBracket => Key::Letter('['),
        Code::RBracket => Key::Letter(']'),
        Code::Grave => Key::Letter('`'),
        Code::OEM102 => Key::Letter('<'),
        code => return numbered(code),
    })
}

/// Letters, digits and function keys, whose codes follow each other.
fn numbered(code: VirtualKeyCode) -> Option<Key> {
    use VirtualKeyCode as Code;
    let from = |first: Code| (code as u32).checked_sub(first as u32);
    let within = |first: Code, count: u32| from(first).filter(|place| *place < count);
    let letter = |first: u8, place: u32| Key::Letter((first + place as u8) as char);
    if let Some(place) = within(Code::A, 26) {
        return Some(letter(b'a', place));
    }
    // The code of 0 stands behind that of 9.
    if let Some(place) = within(Code::Key1, 9) {
        return Some(letter(b'1', place));
    }
    if let Some(place) = within(Code::Numpad0, 10) {
        return Some(letter(b'0', place));
    }
    if code == Code::Key0 {
        return Some(Key::Letter('0'));
    }
    within(Code::F1, 12).map(|place| Key::Function(place as u8 + 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_follow_each_other_as_they_are_counted_on() {
        use VirtualKeyCode as Code;
        let keys = [
            (Code::A, Key::Letter('a')),
            (Code::Q, Key::Letter('q')),
            (Code::Z, Key::Letter('z')),
            (Code::Key1, Key::Letter('1')),
            (Code::Key9, Key::Letter('9')),
            (Code::Key0, Key::Letter('0')),
            (Code::Numpad3, Key::Letter('3')),
            (Code::F1, Key::Function(1)),
            (Code::F12, Key::Function(12)),
        ];
        for (code, expected) in keys {
            assert_eq!(key(code), Some(expected), "{code:?}");
        }
        assert_eq!(key(Code::F13), None);
        assert_eq!(key(Code::Mute), None);
    }
}
