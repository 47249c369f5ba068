//! What must hold in nine-ball and in straight pool, from who called what and which balls are gone.

use super::account::{Account, Fate, require};
use hapticbillard::events::{BallInHand, Call, CallKind, Choice, Racked, TurnAfter, Verdict};
use hapticbillard::ids::BallId;

/// So many points win straight pool.
const TARGET: i32 = 100;

pub fn check_nine_ball(
    account: &Account,
    call: Option<&Call>,
    verdict: &Verdict,
    fate: &Fate,
) -> Result<(), String> {
    let (own, other) = (account.player, account.player.other());
    let before = &account.state;
    let fouls = before.fouls.of(own);
    require(before.warned == (fouls == 2), "a player on two fouls is not told, or another is")?;
    let counted = if verdict.legal { 0 } else { fouls + 1 };
    let is_racked = verdict.rack.is_some();
    let counted = if is_racked { 0 } else { counted };
    require(verdict.fouls_after.of(own) == counted, "fouls are miscounted")?;
    let others = if is_racked { 0 } else { before.fouls.of(other) };
    require(verdict.fouls_after.of(other) == others, "fouls of the other player changed")?;

    let pushes_out = before.after_break && call == Some(&Call::Kind(CallKind::PushOut));
    let nine = BallId::NINE;
    let winner = match (verdict.legal, fate.fell(nine) && !pushes_out) {
        (true, true) => Some(own),
        (false, _) if counted == 3 => Some(other),
        _ => None,
    };
    require(verdict.winner == winner, "somebody else has won")?;
    require((verdict.turn == TurnAfter::End) == winner.is_some(), "only a win ends the game")?;
    let returns = winner.is_none() && (fate.fell(nine) || fate.left(nine));
    require(verdict.spot.as_slice() == &[nine][..usize::from(returns)], "the 9, and no other")?;
    if winner.is_some() || is_racked {
        return Ok(());
    }
    let chooses = verdict.legal && pushes_out;
    let options: &[Choice] = if chooses { &[Choice::Shoot, Choice::PassBack] } else { &[] };
    require(verdict.options.as_slice() == options, "a push-out is chosen after, and no other")?;
    let goes_on = verdict.legal && !pushes_out && fate.pots(before.cue_ball) > 0;
    require((verdict.turn == TurnAfter::Continue) == goes_on, "a ball keeps the turn")?;
    let in_hand = if verdict.legal { BallInHand::None } else { BallInHand::Anywhere };
    require(verdict.ball_in_hand == in_hand, "the cue ball is in hand after a foul")
}

pub fn check_straight(
    account: &Account,
    call: Option<&Call>,
    verdict: &Verdict,
    fate: &Fate,
) -> Result<(), String> {
    let (own, other) = (account.player, account.player.other());
    let before = &account.state;
    let fouls = before.fouls.of(own);
    require(before.warned == (fouls == 2), "a player on two fouls is not told, or another is")?;
    require(verdict.points.of(other) == 0, "the other player has points")?;
    require(verdict.fouls_after.of(other) == before.fouls.of(other), "another player's foul")?;
    let points = verdict.points.of(own);
    let counted = match (verdict.legal, points) {
        (true, 0..) => 0,
        (false, -1) if fouls < 2 => fouls + 1,
        (false, -2) if before.is_break() => fouls,
        (false, -16) if fouls == 2 => 0,
        _ => return Err(format!("{points} points, and {fouls} fouls before")),
    };
    require(verdict.fouls_after.of(own) == counted, "fouls are miscounted")?;

    let fell = before.on_table.iter().filter(|ball| fate.fell(**ball)).count();
    let left = before.on_table.len() - fell;
    let has_called =
        |ball: BallId| matches!(call, Some(Call::Ball { ball: of, .. }) if *of == ball);
    let has_made = before.on_table.iter().any(|ball| fate.fell(*ball) && has_called(*ball));
    require(points <= 0 || has_made, "points without the called ball")?;
    require(points <= 0 || points == fell as i32, "each ball is a point")?;

    let has_won = points > 0 && before.score.of(own) + points >= TARGET;
    require(verdict.winner == has_won.then_some(own), "only 100 points win")?;
    let fourteen = points > 0 && left <= 1 && !has_won;
    require((verdict.rack == Some(Racked::Fourteen)) == fourteen, "the next rack in its time")?;
    require(points != -16 || verdict.rack == Some(Racked::All), "a third foul is another break")?;

    let is_gone = |ball: &&BallId| fate.fell(**ball) || fate.left(**ball);
    let gone: Vec<BallId> = before.on_table.iter().filter(is_gone).copied().collect();
    let stays_out = points > 0 || verdict.rack == Some(Racked::All);
    let spot = if stays_out { &[][..] } else { &gone };
    require(verdict.spot.as_slice() == spot, "what made no point returns")
}
