//! What a gamepad holds in a menu goes on, as a held key of a keyboard does by itself.

use super::{Edge, Lobby, Order};
use crate::input::Action;
use crate::units::Seconds;

/// How long something is held before it goes on, and between two steps then [s].
const FIRST_S: Seconds = 0.45;
const NEXT_S: Seconds = 0.11;
/// What can go on: along lines and values.
const STEPS: [Action; 4] = [Action::MenuUp, Action::MenuDown, Action::MenuLess, Action::MenuMore];

/// What is held, and when it goes on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Repeat {
    action: Action,
    due_s: Seconds,
}

impl Lobby {
    /// Time passes at a window, whose clock shows this [s].
    pub fn pass(&mut self, now_s: Seconds) -> Vec<Order> {
        let Some(held) = self.held_in_menu() else {
            self.repeat = None;
            return Vec::new();
        };
        match &mut self.repeat {
            Some(Repeat { action, due_s }) if *action == held => {
                if now_s < *due_s {
                    return Vec::new();
                }
                *due_s = now_s + NEXT_S;
                self.act(held, Edge::Repeated)
            }
            repeat => {
                *repeat = Some(Repeat { action: held, due_s: now_s + FIRST_S });
                Vec::new()
            }
        }
    }

    /// The step that a gamepad's stick or button holds in a menu.
    fn held_in_menu(&self) -> Option<Action> {
        let waits = self.menu.as_ref().is_some_and(|menu| menu.waits_for_key().is_some());
        if !self.is_menu_open() || waits || self.shows_help {
            return None;
        }
        // A keyboard repeats by itself, and what was pressed before the menu opened means nothing.
        let holds = |action: &Action| {
            let keys = self.controls.bindings().keys(*action);
            let is_held = keys.iter().any(|key| key.is_pad() && self.controls.holds(*key));
            is_held && self.controls.has(*action)
        };
        self.pad.leans().or_else(|| STEPS.into_iter().find(holds))
    }
}
