//! The eight-ball of the 2009 paper, section 5.2, with the conventions that fix what it leaves
//! open.

use super::expected::Expected;
use super::seen::{Seen, may_lie};
use hapticbillard::events::{BallInHand, Call, Fact, Foul, Group, Groups, TurnAfter};
use hapticbillard::ids::BallId;
use hapticbillard::rules::State;

/// So many turns without a pocketed ball are a draw.
const DRAW_TURNS: u32 = 60;

/// The verdict on a shot with these facts. Nothing is called, and there is no safety.
pub fn paper_eight_ball(state: &State, _: Option<&Call>, facts: &[Fact]) -> Expected {
    let seen = Seen(facts);
    let (shooter, opponent) = (state.player, state.player.other());
    let groups = state.groups.unwrap_or_default();
    let fouls = fouls(state, seen);
    let eight_gone = seen.fell(BallId::EIGHT) || seen.left(BallId::EIGHT);

    if eight_gone && !state.is_break() {
        // The 8 wins only if the own group was gone before the shot and the shot is no foul;
        // otherwise, and off the table, it loses.
        let mut faults = fouls;
        // Off the table it is lost in any case, early or not.
        if seen.fell(BallId::EIGHT) && !has_right_to_eight(state) {
            faults.push(Foul::EightEarly);
        }
        return if faults.is_empty() {
            Expected::ends("the 8: won", Some(shooter), groups)
        } else {
            Expected::ends("the 8: lost", Some(opponent), groups).fouled(faults)
        };
    }

    let colour = seen.fallen().into_iter().find_map(Group::of);
    let result = if !fouls.is_empty() {
        // A foul assigns no group; the opponent has the cue ball in hand anywhere.
        Expected::plays("foul", shooter, opponent, groups)
            .fouled(fouls)
            .in_hand(BallInHand::Anywhere)
    } else {
        match (state.is_break(), groups.of(shooter), colour) {
            // A colour on the break keeps the turn and assigns nothing.
            (true, _, Some(_)) => Expected::plays("break: a colour", shooter, shooter, groups),
            // The first colour that falls on a later shot assigns the groups.
            (false, None, Some(group)) => {
                let assigned = Groups::assigned(shooter, group);
                Expected::plays("groups assigned", shooter, shooter, assigned)
            }
            // An own ball keeps the turn.
            (false, Some(own), Some(_))
                if seen.fallen().into_iter().any(|ball| Group::of(ball) == Some(own)) =>
            {
                Expected::plays("own ball", shooter, shooter, groups)
            }
            // No own ball down ends the turn.
            _ => Expected::plays("no own ball", shooter, opponent, groups),
        }
    };

    // 60 turns in a row without a pocketed object ball are a draw.
    let is_dry = seen.fallen().is_empty() && !state.pocketed_this_turn;
    let ends_turn = result.turn == TurnAfter::Pass;
    if ends_turn && is_dry && state.dry_turns + 1 >= DRAW_TURNS {
        return Expected::ends("draw", None, groups).fouled(result.fouls);
    }
    // The 8 on the break, down or off, is spotted; the turn goes on as the shot deserves.
    if eight_gone {
        return Expected { row: "break: the 8", ..result }.spots_eight();
    }
    result
}

/// The 8 comes after all own balls, and nobody owns any before the groups are assigned.
fn has_right_to_eight(state: &State) -> bool {
    match state.groups.unwrap_or_default().of(state.player) {
        None => false,
        Some(own) => !state.on_table.iter().any(|ball| Group::of(*ball) == Some(own)),
    }
}

/// An opponent's ball is wrong first, and so is the 8 before its time.
fn is_wrong(state: &State, ball: BallId) -> bool {
    let theirs = state.groups.unwrap_or_default().of(state.player.other());
    let is_early = ball == BallId::EIGHT && !has_right_to_eight(state);
    is_early || (theirs.is_some() && Group::of(ball) == theirs)
}

/// All fouls that this game knows. Rails are never required.
fn fouls(state: &State, seen: Seen<'_>) -> Vec<Foul> {
    let first = seen.first_met();
    let is_wrong_first = !first.is_empty() && first.iter().all(|met| is_wrong(state, met.0));
    [
        (Foul::Scratch, seen.fell(BallId::CUE)),
        (Foul::CueOff, seen.left(BallId::CUE)),
        (Foul::NoContact, seen.tips() > 0 && first.is_empty()),
        (Foul::WrongFirst, is_wrong_first),
        (Foul::BallOff, seen.lost_an_object_ball()),
        (Foul::DoubleHit, seen.tips() > 1),
        (Foul::TouchedBall, seen.touched()),
        // The list leaves it out, but "the break is played from behind the head string" means
        // little without it.
        (
            Foul::BadPlacement,
            seen.placed().is_some_and(|place| !may_lie(state.ball_in_hand, place)),
        ),
    ]
    .into_iter()
    .filter_map(|(foul, is_committed)| is_committed.then_some(foul))
    .collect()
}
