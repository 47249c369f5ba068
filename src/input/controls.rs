//! What is held down, and which actions that makes: the way from keys to what a player means.

use super::{Action, Bindings, Control, Profile};
use std::collections::BTreeMap;
use std::sync::Arc;

/// What becomes of an action.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Edge {
    /// It begins.
    Pressed,
    /// A key that began it is held, and its system repeats it.
    Repeated,
    /// It ends.
    Released,
}

/// Keys that are down, under the bindings of now.
///
/// Every action that begins ends: with its last key, with the profile that hears it, or when
/// everything counts as let go. A key that is held goes on to mean what it meant when it went down,
/// whatever is bound meanwhile.
#[derive(Debug, Clone)]
pub struct Controls {
    bindings: Arc<Bindings>,
    profile: Profile,
    /// What is down, and what it means; none if nobody hears it.
    held: BTreeMap<Control, Option<Action>>,
}

impl Controls {
    /// Nothing is held, and a menu is open.
    pub fn new(bindings: Bindings) -> Self {
        let (bindings, held) = (Arc::new(bindings), BTreeMap::new());
        Controls { bindings, profile: Profile::Menu, held }
    }

    /// The bindings of now.
    pub fn bindings(&self) -> &Bindings {
        &self.bindings
    }

    /// Other bindings, for what is pressed from now on.
    pub fn rebind(&mut self, bindings: Bindings) {
        self.bindings = Arc::new(bindings);
    }

    /// Something is pressed or let go.
    pub fn hear(&mut self, control: Control, down: bool) -> Option<(Action, Edge)> {
        if !down {
            let action = self.held.remove(&control)??;
            return (!self.has(action)).then_some((action, Edge::Released));
        }
        if let Some(held) = self.held.get(&control) {
            return held.map(|action| (action, Edge::Repeated));
        }
        let action = self.bindings.action(control, self.profile);
        // What goes on already does not begin with a second key.
        let begins = action.filter(|action| !(action.is_held() && self.has(*action)));
        self.held.insert(control, action);
        begins.map(|action| (action, Edge::Pressed))
    }

    /// Whether this is down.
    pub fn holds(&self, control: Control) -> bool {
        self.held.contains_key(&control)
    }

    /// This is pressed, and means nothing until it is pressed again.
    pub fn swallow(&mut self, control: Control) {
        self.held.insert(control, None);
    }

    /// This profile is active from now on; which actions that ends.
    pub fn switch(&mut self, profile: Profile) -> Vec<Action> {
        self.profile = profile;
        let mut ended = Vec::new();
        for held in self.held.values_mut() {
            // What is down goes on to be, but means nothing any more.
            ended.extend(held.take_if(|action| !self.bindings.hears(*action, profile)));
        }
        ended.sort();
        ended.dedup();
        ended
    }

    /// Everything counts as let go.
    pub fn forget(&mut self) {
        self.held.clear();
    }

    /// Whether a key for this is down, and means it.
    pub fn has(&self, action: Action) -> bool {
        self.held.values().any(|held| *held == Some(action))
    }
}
