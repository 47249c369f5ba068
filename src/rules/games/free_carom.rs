//! Free carom (straight rail), a race to 30, with the penalty of FooBillard's game "carambol".

use crate::events::{Call, Topic, Verdict};
use crate::rules::carom::{self, Carom};
use crate::rules::game::Game;
use crate::rules::shot::Shot;
use crate::rules::state::State;

/// The game.
pub const GAME: Game = Game {
    open: carom::open,
    judge,
    may_be_first: carom::may_be_first,
    after: carom::after,
    choose: carom::choose,
    facts: &[Topic::BallsCollided, Topic::BallsFrozen],
    balls: 2,
    names: carom::NAMES,
    has_score: true,
    ends: "Settled, somebody has 30 points",
    in_hand: "never: balls are spotted",
    ..Game::USUAL
};

/// What is its own. A point is taken away for each ball that is lost, so that a score may be less
/// than nothing.
const FREE_CAROM: Carom = Carom { scores: carom::touched_both, lost_ball: 1, target: 30 };

/// Judges a finished shot. One point: the cue ball touched both other balls, whatever else it met.
pub fn judge(state: &State, _call: Option<&Call>, shot: &Shot) -> Verdict {
    carom::judge(&FREE_CAROM, state, shot)
}
