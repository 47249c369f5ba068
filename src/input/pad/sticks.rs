//! Where the sticks and triggers of a gamepad are, and what that means.

use super::super::{HandInput, Stick};
use super::{PadAxis, PadButton, PadInput, shaped};
use crate::input::Action;
use glam::DVec2;

/// A stick that is farther out than the first value is pushed like a button, until it is nearer
/// than the second [share of its way]: a trembling thumb pushes once. The left trigger likewise.
const PUSHED: f64 = 0.6;
const NO_LONGER: f64 = 0.4;

/// Which way a stick is pushed that moves a menu.
const WAYS: [(Action, DVec2); 4] = [
    (Action::MenuUp, DVec2::Y),
    (Action::MenuDown, DVec2::NEG_Y),
    (Action::MenuLess, DVec2::NEG_X),
    (Action::MenuMore, DVec2::X),
];

/// What a report of a gamepad means.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PadMeaning {
    /// A button is pressed or let go.
    Button(PadButton, bool),
    /// A hand that plays hears this.
    Hand(HandInput),
    /// A gamepad is there, or is gone.
    There(bool),
}

/// Where sticks and triggers are.
#[derive(Debug, Clone, Default)]
pub struct PadState {
    left: DVec2,
    right: DVec2,
    is_trigger_down: bool,
    pushed: Option<Action>,
}

impl PadState {
    /// Takes a report. What is no number is 0.
    pub fn hear(&mut self, report: PadInput) -> Option<PadMeaning> {
        let (axis, value) = match report {
            PadInput::Button { button, down } => return Some(PadMeaning::Button(button, down)),
            PadInput::Connected => return Some(PadMeaning::There(true)),
            PadInput::Lost => {
                *self = PadState::default();
                return Some(PadMeaning::There(false));
            }
            PadInput::Axis { axis, value } if value.is_finite() => (axis, value.clamp(-1.0, 1.0)),
            PadInput::Axis { axis, .. } => (axis, 0.0),
        };
        let (stick, at) = match axis {
            PadAxis::LeftTrigger => {
                let edge = if self.is_trigger_down { NO_LONGER } else { PUSHED };
                let down = edge <= value;
                let is_new = std::mem::replace(&mut self.is_trigger_down, down) != down;
                return is_new.then_some(PadMeaning::Button(PadButton::LeftTrigger, down));
            }
            PadAxis::RightTrigger => {
                return Some(PadMeaning::Hand(HandInput::Trigger(value.max(0.0))));
            }
            PadAxis::LeftX => (Stick::Left, DVec2::new(value, self.left.y)),
            PadAxis::LeftY => (Stick::Left, DVec2::new(self.left.x, value)),
            PadAxis::RightX => (Stick::Right, DVec2::new(value, self.right.y)),
            PadAxis::RightY => (Stick::Right, DVec2::new(self.right.x, value)),
        };
        match stick {
            Stick::Left => self.left = at,
            Stick::Right => self.right = at,
        }
        Some(PadMeaning::Hand(HandInput::Stick { stick, at: shaped(at) }))
    }

    /// How the left stick moves a menu as long as it is pushed out of the middle.
    pub fn leans(&self) -> Option<Action> {
        let (action, way) = WAYS.iter().find(|(action, _)| Some(*action) == self.pushed)?;
        (NO_LONGER <= self.left.dot(*way)).then_some(*action)
    }

    /// The left stick was pushed out of the middle since this was asked last: how it moves a menu.
    pub fn pushed(&mut self) -> Option<Action> {
        if let Some(pushed) = self.pushed {
            let (_, way) = WAYS.iter().find(|(action, _)| *action == pushed)?;
            if NO_LONGER <= self.left.dot(*way) {
                return None;
            }
        }
        let way = WAYS.iter().find(|(_, way)| PUSHED <= self.left.dot(*way));
        self.pushed = way.map(|(action, _)| *action);
        self.pushed
    }
}
