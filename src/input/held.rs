//! Which actions are held.

use super::Action;
use std::collections::BTreeSet;

/// What is held.
#[derive(Debug, Clone, Default)]
pub(super) struct Held(BTreeSet<Action>);

impl Held {
    /// An action begins or ends.
    pub fn act(&mut self, action: Action, down: bool) {
        if down {
            self.0.insert(action);
        } else {
            self.0.remove(&action);
        }
    }

    /// Everything counts as let go.
    pub fn forget(&mut self) {
        self.0.clear();
    }

    /// Whether this goes on.
    pub fn has(&self, action: Action) -> bool {
        self.0.contains(&action)
    }

    /// 1 if only the first goes on, −1 if only the second, else 0.
    pub fn balance(&self, more: Action, less: Action) -> f64 {
        f64::from(u8::from(self.has(more))) - f64::from(u8::from(self.has(less)))
    }
}
