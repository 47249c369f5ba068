//! Free play: no fouls, no groups, nobody wins.

use crate::events::{BallInHand, Call, TurnAfter, Verdict};
use crate::rules::fouls::verdict_on;
use crate::rules::game::Game;
use crate::rules::shot::Shot;
use crate::rules::state::State;
use smallvec::SmallVec;

/// The game. The cue ball is played from where it lies, and in hand anywhere without one.
pub const GAME: Game = Game {
    open: |state, has_cue_ball| {
        state.ball_in_hand = if has_cue_ball { BallInHand::None } else { BallInHand::Anywhere };
    },
    judge,
    ends: "Settled, no object ball is left",
    in_hand: "Turn, cue ball in hand (it was gone, or its placement refused)",
    ..Game::USUAL
};

/// Judges a finished shot: whatever it did, the same player goes on, until no object ball is left.
pub fn judge(state: &State, _call: Option<&Call>, shot: &Shot) -> Verdict {
    let verdict = verdict_on(state, shot, SmallVec::new());
    if is_table_cleared(state, shot) {
        return Verdict { turn: TurnAfter::End, ..verdict };
    }
    Verdict {
        turn: TurnAfter::Continue,
        next_player: Some(state.player),
        ball_in_hand: in_hand_after(shot),
        ..verdict
    }
}

/// The game ends when the last object ball is gone. Without any from the start it never ends.
fn is_table_cleared(state: &State, shot: &Shot) -> bool {
    !state.on_table.is_empty() && state.left_by(shot).is_empty()
}

/// A cue ball that is down or off the table returns in hand anywhere.
fn in_hand_after(shot: &Shot) -> BallInHand {
    if shot.cue_pocketed || shot.cue_off { BallInHand::Anywhere } else { BallInHand::None }
}
