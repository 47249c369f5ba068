//! Training: no fouls, any ball is put anywhere, shots are taken back. One plays, or two in turn.

use crate::events::{BallInHand, Call, Racked, TurnAfter, Verdict};
use crate::ids::GameKind;
use crate::rules::fouls::verdict_on;
use crate::rules::game::{Game, UNDO_SHOTS};
use crate::rules::shot::Shot;
use crate::rules::state::State;
use smallvec::SmallVec;

/// The game. The cue ball is played from where it lies, and in hand anywhere without one.
pub const GAME: Game = Game {
    open: |state, has_cue_ball| {
        state.ball_in_hand = if has_cue_ball { BallInHand::None } else { BallInHand::Anywhere };
    },
    judge,
    after,
    is_practice: true,
    takes_back: UNDO_SHOTS,
    ends: "never",
    in_hand: "Turn, cue ball in hand (it was gone)",
    ..Game::USUAL
};

/// Judges a finished shot: nothing is a foul, and who has pocketed a ball, or plays alone, goes on.
/// A cleared table is racked anew.
pub fn judge(state: &State, _call: Option<&Call>, shot: &Shot) -> Verdict {
    let goes_on = state.is_alone || !shot.pocketed.is_empty();
    let player = if goes_on { state.player } else { state.player.other() };
    let rack = is_table_cleared(state, shot).then_some(Racked::All);
    let is_gone = shot.cue_ball_is_gone();
    Verdict {
        turn: if goes_on { TurnAfter::Continue } else { TurnAfter::Pass },
        next_player: Some(player),
        // A new rack brings the cue ball as well.
        ball_in_hand: match rack {
            None if is_gone => BallInHand::Anywhere,
            _ => BallInHand::None,
        },
        rack,
        ..verdict_on(state, shot, SmallVec::new())
    }
}

/// The last object ball is gone. A table without any from the start is not racked.
fn is_table_cleared(state: &State, shot: &Shot) -> bool {
    !state.on_table.is_empty() && state.left_by(shot).is_empty()
}

/// The state before the next shot; on a cleared table, before another break.
fn after(state: &State, shot: &Shot, verdict: &Verdict) -> State {
    match verdict.rack {
        Some(_) => state.reopened(GameKind::Training, verdict.next_player.unwrap_or(state.player)),
        None => state.after(shot, verdict),
    }
}
