//! Which buttons and keys are held down.

use super::{Button, Key};
use std::collections::BTreeSet;

/// What is held.
#[derive(Debug, Clone, Default)]
pub(super) struct Held {
    buttons: BTreeSet<Button>,
    keys: BTreeSet<Key>,
}

impl Held {
    /// A button was pressed or let go.
    pub fn button(&mut self, button: Button, down: bool) {
        if down {
            self.buttons.insert(button);
        } else {
            self.buttons.remove(&button);
        }
    }

    /// A key was pressed or let go.
    pub fn key(&mut self, key: Key, down: bool) {
        if down {
            self.keys.insert(key);
        } else {
            self.keys.remove(&key);
        }
    }

    /// Everything counts as let go.
    pub fn forget(&mut self) {
        self.buttons.clear();
        self.keys.clear();
    }

    /// Whether this button is down.
    pub fn has_button(&self, button: Button) -> bool {
        self.buttons.contains(&button)
    }

    /// Whether this key is down.
    pub fn has(&self, key: Key) -> bool {
        self.keys.contains(&key)
    }

    /// 1 if only the first is down, −1 if only the second, else 0.
    pub fn balance(&self, more: Key, less: Key) -> f64 {
        f64::from(u8::from(self.has(more))) - f64::from(u8::from(self.has(less)))
    }
}
