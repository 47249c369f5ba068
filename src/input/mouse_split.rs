//! Who reads a mouse that moves a hand at a haptic device: the hand, or the eye that looks on.

use super::held::Held;
use super::{Action, HandInput, HumanMode};

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

/// Splits what a hand hears: movements and wheel belong to the hand at the device, but to the eye
/// while somebody looks round; the rest is the eye's, but for the buttons of the mouse.
#[derive(Debug, Default, Clone)]
pub struct MouseSplit {
    held: Held,
}

impl MouseSplit {
    /// Who reads this.
    pub fn reader(&mut self, report: &HandInput) -> Reader {
        match report {
            HandInput::Moved { .. } | HandInput::Wheel { .. } => {
                if self.holds(Action::Look) {
                    Reader::Eye
                } else {
                    Reader::Hand
                }
            }
            HandInput::Act { action, down } => {
                self.held.act(*action, *down);
                match action {
                    Action::Stroke | Action::MouseMovesTip => Reader::Hand,
                    _ => Reader::Eye,
                }
            }
            HandInput::Picked { .. }
            | HandInput::Aid(_)
            | HandInput::Points { .. }
            | HandInput::Hold(_)
            | HandInput::Steering(_)
            | HandInput::StylusSpeed(_)
            | HandInput::Paused(_)
            | HandInput::Stick { .. }
            | HandInput::Trigger(_) => Reader::Eye,
            HandInput::FocusLost | HandInput::PadLost => {
                self.held.forget();
                Reader::Both
            }
            HandInput::Closed => Reader::Both,
        }
    }

    /// The same in this stage of a turn: the mouse puts the cue ball down before it moves the hand.
    pub fn reader_in(&mut self, mode: HumanMode, report: &HandInput) -> Reader {
        match (self.reader(report), mode) {
            (Reader::Hand, HumanMode::Placing | HumanMode::Pointing) => Reader::Eye,
            (reader, _) => reader,
        }
    }

    /// Whether this goes on.
    pub fn holds(&self, action: Action) -> bool {
        self.held.has(action)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn while_somebody_looks_round_the_hand_stays_where_it_is() {
        let mut split = MouseSplit::default();
        let moved = HandInput::Moved { right: 0.1, up: 0.0 };
        let wheel = HandInput::Wheel { notches: 1.0 };
        let look = |down| HandInput::Act { action: Action::Look, down };
        let stroke = HandInput::Act { action: Action::Stroke, down: true };
        assert_eq!([&moved, &wheel, &stroke].map(|report| split.reader(report)), [Reader::Hand; 3]);
        assert_eq!(split.reader(&look(true)), Reader::Eye);
        assert_eq!([&moved, &wheel].map(|report| split.reader(report)), [Reader::Eye; 2]);
        assert_eq!(split.reader(&look(false)), Reader::Eye);
        assert_eq!(split.reader(&moved), Reader::Hand);
        assert_eq!([&look(true), &moved].map(|report| split.reader(report)), [Reader::Eye; 2]);
        // Everything is let go with the keyboard.
        assert_eq!(split.reader(&HandInput::FocusLost), Reader::Both);
        assert_eq!(split.reader(&moved), Reader::Hand);
    }
}
