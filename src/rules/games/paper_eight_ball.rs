//! The reduced eight-ball of the 2009 paper (section 5.2), one function per rule.
//!
//! Nothing is called and there is no safety. Rails are not required, on the break or later. Where
//! the paper is silent, the sentence at each rule says what holds here.

use crate::events::{BallInHand, Call, Foul, Group, Groups, Topic, TurnAfter, Verdict};
use crate::ids::{BallId, PlayerId};
use crate::rules::fouls::{self, Rule, committed, verdict_on};
use crate::rules::game::Game;
use crate::rules::shot::Shot;
use crate::rules::state::State;
use smallvec::SmallVec;

/// The game. Rails are never required, so cushions decide nothing.
pub const GAME: Game = Game {
    open: |state, _| {
        state.groups = Some(Groups::Open);
        state.ball_in_hand = BallInHand::Kitchen;
    },
    judge,
    may_be_first,
    facts: &[Topic::BallsCollided],
    ends: "Settled, the 8 is gone or 60 turns were dry",
    in_hand: "Turn, cue ball in hand (break, foul, placement refused)",
    ..Game::USUAL
};

/// So many turns in a row without a pocketed object ball are a draw.
const DRY_TURNS_MAX: u32 = 60;

/// What makes a shot a foul. There are no others: a push, a ball that still moves, or the wrong
/// player's stroke are none in this game. An object ball off the table stays out, but for the 8 on
/// the break.
const FOULS: [(Foul, Rule); 9] = [
    (Foul::Scratch, fouls::scratch),
    (Foul::CueOff, fouls::cue_ball_off),
    (Foul::NoContact, fouls::no_contact),
    (Foul::WrongFirst, |state, shot| fouls::wrong_first(state, shot, may_be_first)),
    (Foul::BallOff, fouls::ball_off),
    (Foul::DoubleHit, fouls::double_hit),
    (Foul::TouchedBall, fouls::touched_ball),
    (Foul::BadPlacement, fouls::bad_placement),
    (Foul::EightEarly, eight_early),
];

/// Judges a finished shot. A call means nothing in this game.
pub fn judge(state: &State, _call: Option<&Call>, shot: &Shot) -> Verdict {
    let fouls = committed(&[&FOULS], state, shot);
    let legal = fouls.is_empty();
    let groups = groups_after(state, shot, legal);
    let verdict = Verdict { groups: Some(groups), ..verdict_on(state, shot, fouls) };

    if let Some(winner) = winner(state, shot, legal) {
        Verdict { turn: TurnAfter::End, winner: Some(winner), ..verdict }
    } else if is_draw(state, shot) {
        Verdict { turn: TurnAfter::End, ..verdict }
    } else if legal && keeps_turn(state, shot, groups) {
        Verdict {
            turn: TurnAfter::Continue,
            next_player: Some(state.player),
            spot: spotted(state, shot),
            ..verdict
        }
    } else {
        Verdict {
            turn: TurnAfter::Pass,
            next_player: Some(state.player.other()),
            ball_in_hand: in_hand_after(legal),
            spot: spotted(state, shot),
            ..verdict
        }
    }
}

/// The cue ball may meet first: any colour while the table is open, then an own ball, and the 8
/// when no own ball is left.
pub fn may_be_first(state: &State, ball: BallId) -> bool {
    if ball == BallId::EIGHT {
        return own_group_is_gone(state);
    }
    match (Group::of(ball), own_group(state)) {
        (Some(group), Some(own)) => group == own,
        _ => true,
    }
}

/// Foul: the 8 fell after the break although the own group was not gone before the shot.
fn eight_early(state: &State, shot: &Shot) -> bool {
    !state.is_break() && shot.has_pocketed(BallId::EIGHT) && !own_group_is_gone(state)
}

/// After the break the 8 decides the game: pocketed without a foul it wins, as it is a foul before
/// the own group is gone; pocketed with a foul or driven off the table it loses.
fn winner(state: &State, shot: &Shot, legal: bool) -> Option<PlayerId> {
    if state.is_break() || !eight_is_gone(shot) {
        return None;
    }
    Some(if legal { state.player } else { state.player.other() })
}

/// Sixty turns in a row, of both players together, without a pocketed object ball are a draw.
fn is_draw(state: &State, shot: &Shot) -> bool {
    state.dry_turns_after(shot) >= DRY_TURNS_MAX
}

/// The first colour that falls on a shot without a foul after the break becomes the shooter's
/// group; if several fall, the first in time. Once assigned, groups never change.
fn groups_after(state: &State, shot: &Shot, legal: bool) -> Groups {
    let groups = state.groups.unwrap_or_default();
    if groups != Groups::Open || !legal || state.is_break() {
        return groups;
    }
    let first_colour = shot.pocketed.iter().find_map(|pocketed| Group::of(pocketed.ball));
    first_colour.map_or(Groups::Open, |group| Groups::assigned(state.player, group))
}

/// On the break any colour keeps the turn, later only an own ball.
fn keeps_turn(state: &State, shot: &Shot, groups: Groups) -> bool {
    let own = groups.of(state.player);
    let mut fallen = shot.pocketed.iter().filter_map(|pocketed| Group::of(pocketed.ball));
    fallen.any(|group| state.is_break() || Some(group) == own)
}

/// The 8 that falls or leaves the table on the break is spotted. No other ball ever is.
fn spotted(state: &State, shot: &Shot) -> SmallVec<[BallId; 4]> {
    let eight = state.is_break() && eight_is_gone(shot);
    eight.then_some(BallId::EIGHT).into_iter().collect()
}

/// After a foul the opponent has the cue ball in hand anywhere, after the break too.
fn in_hand_after(legal: bool) -> BallInHand {
    if legal { BallInHand::None } else { BallInHand::Anywhere }
}

fn eight_is_gone(shot: &Shot) -> bool {
    shot.has_pocketed(BallId::EIGHT) || shot.off.contains(&BallId::EIGHT)
}

fn own_group(state: &State) -> Option<Group> {
    state.groups.unwrap_or_default().of(state.player)
}

/// Whether the player at the table has a group and none of it was left before the shot.
fn own_group_is_gone(state: &State) -> bool {
    own_group(state)
        .is_some_and(|own| !state.on_table.iter().any(|ball| Group::of(*ball) == Some(own)))
}
