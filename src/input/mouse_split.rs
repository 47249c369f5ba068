//! Who reads a mouse that moves a hand at a haptic device: the hand, or the eye that looks on.

use super::held::Held;
use super::{Button, HumanMode, Key, RawInput};

/// Who reads a report.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reader {
    /// The hand alone.
    Hand,
    /// The eye alone.
    Eye,
    /// Both.
    Both,
}

/// Splits the reports of mouse and keyboard: movements and wheel belong to the hand, but to the eye
/// while the middle button or `c` is held; keys are the eye's.
#[derive(Debug, Default, Clone)]
pub struct MouseSplit {
    held: Held,
}

impl MouseSplit {
    /// Who reads this report.
    pub fn reader(&mut self, report: &RawInput) -> Reader {
        match report {
            RawInput::Moved { .. } | RawInput::Wheel { .. } if self.is_looking() => Reader::Eye,
            RawInput::Moved { .. } | RawInput::Wheel { .. } => Reader::Hand,
            RawInput::Button { button, down } => {
                self.held.button(*button, *down);
                if *button == Button::Middle { Reader::Eye } else { Reader::Hand }
            }
            RawInput::Key { key, down } => {
                self.held.key(*key, *down);
                Reader::Eye
            }
            RawInput::Picked { .. } | RawInput::Aid(_) => Reader::Eye,
            RawInput::FocusLost => {
                self.held.forget();
                Reader::Both
            }
            RawInput::Closed => Reader::Both,
        }
    }

    /// The same in this stage of a turn: the mouse puts the cue ball down before it moves the hand.
    pub fn reader_in(&mut self, mode: HumanMode, report: &RawInput) -> Reader {
        match (self.reader(report), mode) {
            (Reader::Hand, HumanMode::Placing) => Reader::Eye,
            (reader, _) => reader,
        }
    }

    /// Whether this key is down.
    pub fn holds(&self, key: Key) -> bool {
        self.held.has(key)
    }

    fn is_looking(&self) -> bool {
        self.held.has_button(Button::Middle) || self.held.has(Key::Letter('c'))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn while_somebody_looks_round_the_hand_stays_where_it_is() {
        let mut split = MouseSplit::default();
        let moved = RawInput::Moved { right: 0.1, up: 0.0 };
        let wheel = RawInput::Wheel { notches: 1.0 };
        let middle = |down| RawInput::Button { button: Button::Middle, down };
        let left = RawInput::Button { button: Button::Left, down: true };
        assert_eq!([&moved, &wheel, &left].map(|report| split.reader(report)), [Reader::Hand; 3]);
        assert_eq!(split.reader(&middle(true)), Reader::Eye);
        assert_eq!([&moved, &wheel].map(|report| split.reader(report)), [Reader::Eye; 2]);
        assert_eq!(split.reader(&middle(false)), Reader::Eye);
        assert_eq!(split.reader(&moved), Reader::Hand);
        let key = RawInput::Key { key: Key::Letter('c'), down: true };
        assert_eq!([&key, &moved].map(|report| split.reader(report)), [Reader::Eye; 2]);
        // Everything is let go with the keyboard.
        assert_eq!(split.reader(&RawInput::FocusLost), Reader::Both);
        assert_eq!(split.reader(&moved), Reader::Hand);
    }
}
