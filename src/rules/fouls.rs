//! Fouls that several games know, one function each, with the rule's sentence; and what every
//! verdict begins with.

use super::shot::{FirstContact, Shot};
use super::state::State;
use crate::events::{ByPlayer, Foul, Verdict};
use crate::ids::BallId;
use smallvec::SmallVec;

/// Whether a shot broke one rule.
pub type Rule = fn(&State, &Shot) -> bool;

/// What is a foul on every shot of pool and of snooker.
pub const ALWAYS: [(Foul, Rule); 9] = [
    (Foul::Scratch, scratch),
    (Foul::CueOff, cue_ball_off),
    (Foul::BallOff, ball_off),
    (Foul::DoubleHit, double_hit),
    (Foul::Push, push),
    (Foul::TouchedBall, touched_ball),
    (Foul::BadPlacement, bad_placement),
    (Foul::Moving, moving),
    (Foul::OutOfTurn, out_of_turn),
];

/// So many object balls must reach a rail on a break on which none falls.
const DRIVEN_MIN: usize = 4;

/// All fouls of some lists that a shot committed, sorted.
pub fn committed(lists: &[&[(Foul, Rule)]], state: &State, shot: &Shot) -> SmallVec<[Foul; 2]> {
    let broken = lists.iter().copied().flatten().filter(|(_, rule)| rule(state, shot));
    let mut fouls: SmallVec<[Foul; 2]> = broken.map(|(foul, _)| *foul).collect();
    fouls.sort_unstable();
    fouls
}

/// What every verdict on a shot says, whatever follows from it.
pub fn verdict_on(state: &State, shot: &Shot, fouls: SmallVec<[Foul; 2]>) -> Verdict {
    Verdict {
        player: Some(state.player),
        legal: fouls.is_empty(),
        fouls,
        pocketed: shot.pocketed_balls(),
        ..Verdict::default()
    }
}

/// Fouls in a row of each player after a shot: a shot without a foul sets the own count to 0. A
/// third one counts only for who was told of two; without a warning it is the second again.
pub fn in_a_row(state: &State, legal: bool) -> ByPlayer<u8> {
    let own = match (legal, state.fouls.of(state.player)) {
        (true, _) => 0,
        (false, 2..) if !state.warned => 2,
        (false, 2..) => 3,
        (false, count) => count + 1,
    };
    state.fouls.with(state.player, own)
}

/// Foul: the cue ball is down.
pub fn scratch(_: &State, shot: &Shot) -> bool {
    shot.cue_pocketed
}

/// Foul: the cue ball is off the table.
pub fn cue_ball_off(_: &State, shot: &Shot) -> bool {
    shot.cue_off
}

/// Foul: the cue ball met no ball. A touch without a stroke is judged as a touch alone.
pub fn no_contact(_: &State, shot: &Shot) -> bool {
    let is_only_a_touch = shot.tips == 0 && !shot.touched.is_empty();
    shot.first_contacts.is_empty() && !is_only_a_touch
}

/// Foul: the cue ball met a ball first that it may not. Of several met at the same time, the right
/// one was first.
pub fn wrong_first(state: &State, shot: &Shot, may_be_first: fn(&State, BallId) -> bool) -> bool {
    let met = &shot.first_contacts;
    !met.is_empty() && !met.iter().any(|met| may_be_first(state, met.ball))
}

/// Not enough for a break: no object ball fell, and fewer than four were driven to a rail.
pub fn is_weak_break(shot: &Shot) -> bool {
    shot.pocketed.is_empty() && shot.driven().len() < DRIVEN_MIN
}

/// Foul: no object ball fell, and after the first contact no ball was pocketed, driven off the
/// table or driven to a rail. A ball that already touched a rail is not driven to it. Without a
/// contact that is the foul.
pub fn no_rail(_: &State, shot: &Shot) -> bool {
    let has_met = !shot.first_contacts.is_empty();
    has_met && shot.pocketed.is_empty() && !shot.is_driven_after_contact()
}

/// Foul: an object ball is off the table.
pub fn ball_off(_: &State, shot: &Shot) -> bool {
    !shot.off.is_empty()
}

/// Foul: the tip met the cue ball twice.
pub fn double_hit(_: &State, shot: &Shot) -> bool {
    shot.tips > 1
}

/// Foul: the tip was still on the cue ball when that met another ball, not frozen to it before.
pub fn push(_: &State, shot: &Shot) -> bool {
    shot.push
}

/// Foul: a ball was touched by anything but the tip's one stroke or another ball.
pub fn touched_ball(_: &State, shot: &Shot) -> bool {
    !shot.touched.is_empty()
}

/// Foul: the cue ball was played from where it may not be put: outside of its zone, on another
/// ball, or without having it in hand.
pub fn bad_placement(state: &State, shot: &Shot) -> bool {
    shot.placement.is_some_and(|(zone, ok)| !ok || !state.may_place_in(zone))
}

/// Foul: played with the cue ball in hand behind the head string, the ball that was met first lay
/// behind it too, and the cue ball had not crossed it before. Of several balls met at the same
/// time, one that breaks no rule counts as the first.
pub fn kitchen(state: &State, shot: &Shot, may_be_first: fn(&State, BallId) -> bool) -> bool {
    let met = &shot.first_contacts;
    let is_right = |met: &&FirstContact| may_be_first(state, met.ball);
    let is_foul = match met.iter().any(|met| is_right(&met)) {
        true => met.iter().filter(is_right).all(|met| met.in_kitchen),
        false => !met.is_empty() && met.iter().all(|met| met.in_kitchen),
    };
    state.is_in_kitchen() && is_foul && !shot.crossed_head_first()
}

/// Foul: a ball still moved, or spun, when the stroke began.
pub fn moving(_: &State, shot: &Shot) -> bool {
    shot.moving
}

/// Foul: somebody shot who was not at the table.
pub fn out_of_turn(state: &State, shot: &Shot) -> bool {
    shot.struck_by.is_some_and(|player| player != state.player)
}
