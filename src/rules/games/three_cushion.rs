//! Three-cushion, a race to 15.

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
    facts: &[Topic::BallsCollided, Topic::CushionHit, Topic::BallsFrozen],
    balls: 2,
    names: carom::NAMES,
    has_score: true,
    ends: "Settled, somebody has 15 points",
    in_hand: "never: balls are spotted",
    ..Game::USUAL
};

/// What is its own.
const THREE_CUSHION: Carom = Carom { scores, lost_ball: 0, target: 15 };

/// So many cushions before the second ball.
const CUSHIONS_MIN: usize = 3;

/// Judges a finished shot. A ball that is lost is a foul and costs no points.
pub fn judge(state: &State, _call: Option<&Call>, shot: &Shot) -> Verdict {
    carom::judge(&THREE_CUSHION, state, shot)
}

/// One point: the cue ball touched both other balls and was driven to a cushion at least three
/// times before it met the second of them.
fn scores(shot: &Shot) -> bool {
    carom::rails_before_second_ball(shot).is_some_and(|rails| rails >= CUSHIONS_MIN)
}
