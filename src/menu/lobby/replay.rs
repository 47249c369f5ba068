//! The last shot is seen again. Time stands still in the game meanwhile, and what devices say goes
//! to whoever looks.

use super::{Game, Lobby, Order};
use crate::input::{Action, HandInput, HumanMode};

/// Whether an action leads back from the film.
pub(super) fn ends_replay(action: Action) -> bool {
    matches!(action, Action::Pause | Action::Replay)
}

impl Lobby {
    /// Whether there is a shot that can be seen again.
    pub fn see_film(&mut self, has_film: bool) {
        self.has_film = has_film;
    }

    /// Whether it is seen again now.
    pub fn is_replaying(&self) -> bool {
        self.replay.is_some()
    }

    /// The film is over, or nobody wants to see it any more.
    pub fn end_replay(&mut self) -> Vec<Order> {
        let goes_on = self.replay;
        let mut orders = self.leave_replay();
        if goes_on == Some(true) && self.game == Game::Running {
            self.is_resuming = true;
            orders.push(Order::Tell(HandInput::Paused(false)));
        }
        if goes_on.is_some() && self.game == Game::Over {
            self.open("over");
        }
        orders.extend(self.settle());
        orders
    }

    /// The film ends with the game that it is of.
    pub(super) fn leave_replay(&mut self) -> Vec<Order> {
        self.replay.take().map(|_| Order::Replay(false)).into_iter().collect()
    }

    /// The last shot is to be seen again.
    pub(super) fn begin_replay(&mut self) -> Vec<Order> {
        if self.game == Game::None || self.replay.is_some() {
            return Vec::new();
        }
        if !self.has_film {
            return vec![Order::Say("no_replay")];
        }
        // A game that was told to go on does so after the film.
        let is_paused = self.mode == HumanMode::Paused && !self.is_resuming;
        let goes_on = self.game == Game::Running && !is_paused;
        self.close();
        self.replay = Some(goes_on);
        let mut orders = Vec::new();
        if goes_on {
            // What is held in the game is let go: the film hears when it is.
            let stands = [HandInput::FocusLost, HandInput::Paused(true)];
            orders.extend(stands.map(Order::Tell));
        }
        orders.push(Order::Replay(true));
        orders.extend(self.settle());
        orders
    }

    /// What is said to the game, or to whoever sees the film.
    pub(super) fn tells(&self, input: HandInput) -> Order {
        if self.replay.is_some() { Order::Onlook(input) } else { Order::Tell(input) }
    }
}
