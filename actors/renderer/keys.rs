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
        Code::PageUp => Key::PageUp,
        Code::PageDown => Key::PageDown,
        Code::F1 => Key::Help,
        Code::F3 => Key::Meters,
        Code::F12 => Key::Picture,
        Code::Key1 | Code::Numpad1 => Key::Letter('1'),
        Code::Key2 | Code::Numpad2 => Key::Letter('2'),
        Code::Key3 | Code::Numpad3 => Key::Letter('3'),
        Code::A => Key::Letter('a'),
        Code::B => Key::Letter('b'),
        Code::C => Key::Letter('c'),
        Code::D => Key::Letter('d'),
        Code::F => Key::Letter('f'),
        Code::H => Key::Letter('h'),
        Code::I => Key::Letter('i'),
        Code::M => Key::Letter('m'),
        Code::N => Key::Letter('n'),
        Code::O => Key::Letter('o'),
        Code::P => Key::Letter('p'),
        Code::Q => Key::Letter('q'),
        Code::R => Key::Letter('r'),
        Code::S => Key::Letter('s'),
        Code::T => Key::Letter('t'),
        Code::U => Key::Letter('u'),
        Code::V => Key::Letter('v'),
        Code::X => Key::Letter('x'),
        Code::Plus | Code::Equals | Code::NumpadAdd => Key::Letter('+'),
        Code::Minus | Code::NumpadSubtract => Key::Letter('-'),
        _ => return None,
    })
}
