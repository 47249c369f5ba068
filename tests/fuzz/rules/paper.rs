//! What the paper's eight-ball and free play must give besides, in another form than their judges.

use super::account::{Account, Fate, require};
use hapticbillard::events::{BallInHand, Foul, Group, Groups, TurnAfter, Verdict};
use hapticbillard::ids::BallId;
use hapticbillard::rules::State;

/// Balls that an absurd fact may name.
const NAMED: u16 = 25;

/// What the account of the paper's eight-ball remembers.
#[derive(Debug, Default, Clone)]
pub struct Memory {
    dry_turns: u32,
    turn_had_pot: bool,
}

impl Memory {
    /// What it would remember in a game that stands so.
    pub fn resumed(state: &State) -> Self {
        Memory { dry_turns: state.dry_turns, turn_had_pot: state.pocketed_this_turn }
    }
}

/// Free play knows no fouls.
pub fn check_free_play(verdict: &Verdict, fate: &Fate) -> Result<(), String> {
    require(verdict.legal && verdict.groups.is_none(), "a foul in free play")?;
    require(verdict.turn != TurnAfter::Pass, "the turn passed in free play")?;
    require(verdict.winner.is_none(), "somebody won free play")?;
    let in_hand = verdict.ball_in_hand == BallInHand::Anywhere;
    let is_gone = fate.fell(BallId::CUE) || fate.left(BallId::CUE);
    let goes_on = verdict.turn == TurnAfter::Continue;
    require(in_hand == (goes_on && is_gone), "the cue ball is in the wrong place")
}

/// The paper's eight-ball.
pub fn check_eight_ball(
    account: &mut Account,
    verdict: &Verdict,
    fate: &Fate,
) -> Result<(), String> {
    let (own_player, groups_before) = (account.player, account.groups);
    let pots = fate.pots(BallId::CUE);
    let other = own_player.other();
    let has = |foul: Foul| verdict.fouls.contains(&foul);
    require(has(Foul::Scratch) == fate.fell(BallId::CUE), "a scratch is missed or made up")?;
    require(has(Foul::CueOff) == fate.left(BallId::CUE), "a lost cue ball is missed or made up")?;
    let any_left = (1..NAMED).any(|ball| fate.left(BallId(ball)));
    require(has(Foul::BallOff) == any_left, "a lost ball is missed or made up")?;

    if !verdict.legal && verdict.turn != TurnAfter::End {
        require(verdict.next_player == Some(other), "a foul does not end the turn")?;
        require(verdict.ball_in_hand == BallInHand::Anywhere, "a foul gives no ball in hand")?;
    }
    let is_assigned = verdict.groups != groups_before;
    require(!is_assigned || (verdict.legal && !account.is_break), "assigned by a foul or break")?;

    let eight_gone = fate.fell(BallId::EIGHT) || fate.left(BallId::EIGHT);
    let decides = eight_gone && !account.is_break;
    require(verdict.winner.is_some() == decides, "the 8 does not decide, or something else")?;
    let expected_spot: &[BallId] =
        if eight_gone && account.is_break { &[BallId::EIGHT] } else { &[] };
    require(verdict.spot.as_slice() == expected_spot, "wrong balls are spotted")?;
    if verdict.winner == Some(own_player) {
        let own = groups_before.and_then(|groups: Groups| groups.of(own_player));
        let is_own = |ball: &BallId| Group::of(*ball).is_some() && Group::of(*ball) == own;
        let has_own = account.on_table.iter().any(is_own);
        require(own.is_some() && !has_own && verdict.legal, "won without the right to")?;
    }

    let memory = &mut account.paper;
    memory.turn_had_pot |= pots > 0;
    if verdict.turn != TurnAfter::Continue {
        memory.dry_turns = if memory.turn_had_pot { 0 } else { memory.dry_turns + 1 };
        memory.turn_had_pot = false;
    }
    let is_draw = verdict.turn == TurnAfter::End && verdict.winner.is_none();
    let is_due = memory.dry_turns >= 60 && verdict.winner.is_none();
    require(is_draw == is_due, "a draw comes too early or too late")
}
