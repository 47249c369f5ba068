//! What games of three balls have in common: white, yellow and red on a table without pockets.
//!
//! Each player has a cue ball of his own, player 1 the white, player 2 the yellow; to the other it
//! is an object ball. All three are always on the table: one that is gone returns to its spot at
//! once, and nothing is ever in hand.
//!
//! World rules of the UMB (1989) and rules of the USBA (2009), as far as they can be judged from
//! what the balls do. Left out: the lag, the equalising inning of the second player, and fouls of
//! the body (a foot off the floor, the shot clock).

use super::fouls::{self, Rule, committed, verdict_on};
use super::game::Chosen;
use super::shot::{Met, Shot};
use super::state::State;
use crate::events::{ByPlayer, Choice, Foul, TurnAfter, Verdict};
use crate::ids::{BallId, PlayerId};
use crate::units::Seconds;
use smallvec::{SmallVec, smallvec};

/// What rule files call the balls, in the order of their numbers.
pub const NAMES: &[&str] = &["W", "Y", "R"];

/// The white.
const WHITE: BallId = BallId(0);
/// The yellow.
const YELLOW: BallId = BallId(1);
/// The red.
const RED: BallId = BallId(2);
/// All three.
const BALLS: [BallId; 3] = [WHITE, YELLOW, RED];

/// A ball that lay against the cue ball was played at if they meet so soon after the stroke [s]: a
/// cue ball that has left it needs longer to return.
const PLAYED_AT_S: Seconds = 5e-3;

/// What is a foul on every shot. To miss is none.
const FOULS: [(Foul, Rule); 10] = [
    (Foul::Scratch, fouls::scratch),
    (Foul::CueOff, fouls::cue_ball_off),
    (Foul::WrongFirst, |state, shot| fouls::wrong_first(state, shot, may_be_first)),
    (Foul::BallOff, object_ball_lost),
    (Foul::DoubleHit, fouls::double_hit),
    (Foul::Push, push),
    (Foul::TouchedBall, fouls::touched_ball),
    (Foul::BadPlacement, fouls::bad_placement),
    (Foul::Moving, fouls::moving),
    (Foul::OutOfTurn, fouls::out_of_turn),
];

/// What distinguishes one game of three balls from another.
pub struct Carom {
    /// Whether a shot without a foul scores.
    pub scores: fn(&Shot) -> bool,
    /// Points taken away for each ball that is lost.
    pub lost_ball: i32,
    /// So many points win.
    pub target: i32,
}

/// The three balls lie, and each player strikes his own.
pub fn open(state: &mut State, _has_cue_ball: bool) {
    state.cue_ball = if state.player == PlayerId::ONE { WHITE } else { YELLOW };
    state.on_table = object_balls(state.cue_ball);
}

/// On the break the cue ball may meet the red first, later either ball.
pub fn may_be_first(state: &State, ball: BallId) -> bool {
    !state.is_break() || ball == RED
}

/// Judges a finished shot: it scores and the turn goes on, or the turn passes. A foul scores
/// nothing.
pub fn judge(game: &Carom, state: &State, shot: &Shot) -> Verdict {
    let (own, other) = (state.player, state.player.other());
    let fouls = committed(&[&FOULS], state, shot);
    let lost = lost(shot);
    let has_scored = fouls.is_empty() && (game.scores)(shot);
    let points = i32::from(has_scored) - game.lost_ball * lost.len() as i32;
    let points_of_shot = ByPlayer::default().with(own, points);
    let verdict = Verdict { points: points_of_shot, ..verdict_on(state, shot, fouls) };
    if has_scored && state.score.of(own).saturating_add(points) >= game.target {
        return Verdict { turn: TurnAfter::End, winner: Some(own), ..verdict };
    }
    let (turn, next) =
        if has_scored { (TurnAfter::Continue, own) } else { (TurnAfter::Pass, other) };
    let verdict = Verdict { turn, next_player: Some(next), spot: lost, ..verdict };
    offer_to_spot_frozen(state, shot, verdict)
}

/// A player whose cue ball lies against another may play away from it, or have the balls that
/// touch spotted. Balls that are gone return first, so nothing is offered with them.
fn offer_to_spot_frozen(state: &State, shot: &Shot, verdict: Verdict) -> Verdict {
    let cue_ball = next_cue_ball(state, &verdict);
    let frozen = frozen_to(cue_ball, shot);
    if frozen.is_empty() || !verdict.spot.is_empty() {
        return verdict;
    }
    Verdict {
        chooser: verdict.next_player,
        options: smallvec![Choice::Accept, Choice::SpotFrozen],
        spot: with_cue_ball(cue_ball, &frozen),
        ..verdict
    }
}

/// The state before the next shot, or before its player's choice.
pub fn after(state: &State, shot: &Shot, verdict: &Verdict) -> State {
    let cue_ball = next_cue_ball(state, verdict);
    State {
        cue_ball,
        on_table: object_balls(cue_ball),
        frozen_to_cue: match verdict.options.is_empty() {
            true => SmallVec::new(),
            false => frozen_to(cue_ball, shot),
        },
        ..state.after(shot, verdict)
    }
}

/// Who accepts plays away from the balls that touch; else they return to their spots, the cue ball
/// with them.
pub fn choose(state: &State, choice: Choice) -> Chosen {
    let played = State { options: SmallVec::new(), ..state.clone() };
    if choice != Choice::SpotFrozen {
        return Chosen::goes_on(played);
    }
    let spot = with_cue_ball(state.cue_ball, &state.frozen_to_cue);
    let state = State { frozen_to_cue: SmallVec::new(), ..played };
    Chosen { spot, ..Chosen::goes_on(state) }
}

/// The cue ball touched both other balls.
pub fn touched_both(shot: &Shot) -> bool {
    rails_before_second_ball(shot).is_some()
}

/// How often the cue ball was driven to a cushion before it met the second ball; none if it did not
/// meet two. The same cushion counts again; of what happened at the same time, cushions come first.
pub fn rails_before_second_ball(shot: &Shot) -> Option<usize> {
    let ball_of = |met: &(Seconds, Met)| match met.1 {
        Met::Ball(ball) => Some(ball),
        Met::Rail(_) => None,
    };
    let first = shot.cue_met.iter().find_map(ball_of)?;
    let second = shot.cue_met.iter().position(|met| ball_of(met).is_some_and(|b| b != first))?;
    Some(shot.cue_met[..second].iter().filter(|met| ball_of(met).is_none()).count())
}

/// Foul: another ball than the cue ball is gone.
fn object_ball_lost(_: &State, shot: &Shot) -> bool {
    !shot.off.is_empty() || !shot.pocketed.is_empty()
}

/// Foul: the tip was still on the cue ball when that met another ball; or a ball that lay against
/// the cue ball was played at, and not away from.
fn push(state: &State, shot: &Shot) -> bool {
    let played_at = |(time_s, met): &(Seconds, Met)| match met {
        Met::Ball(ball) => {
            state.frozen_to_cue.contains(ball)
                && shot.struck_s.is_some_and(|struck_s| time_s - struck_s <= PLAYED_AT_S)
        }
        Met::Rail(_) => false,
    };
    shot.push || shot.cue_met.iter().any(played_at)
}

/// Balls that left the table, or went down where a table has pockets, in ascending order. They
/// return to their spots.
fn lost(shot: &Shot) -> SmallVec<[BallId; 4]> {
    let is_lost = |ball: &BallId| match *ball == shot.cue_ball {
        true => shot.cue_ball_is_gone(),
        false => shot.off.contains(ball) || shot.has_pocketed(*ball),
    };
    BALLS.into_iter().filter(is_lost).collect()
}

/// The balls that lie against this one at the end.
fn frozen_to(ball: BallId, shot: &Shot) -> SmallVec<[BallId; 2]> {
    shot.frozen_to(ball).into_iter().filter(|other| BALLS.contains(other)).collect()
}

/// The ball that is struck next.
fn next_cue_ball(state: &State, verdict: &Verdict) -> BallId {
    match verdict.next_player {
        Some(next) if next != state.player => other_cue_ball(state.cue_ball),
        _ => state.cue_ball,
    }
}

fn other_cue_ball(cue_ball: BallId) -> BallId {
    if cue_ball == YELLOW { WHITE } else { YELLOW }
}

fn object_balls(cue_ball: BallId) -> SmallVec<[BallId; 16]> {
    BALLS.into_iter().filter(|ball| *ball != cue_ball).collect()
}

fn with_cue_ball(cue_ball: BallId, others: &[BallId]) -> SmallVec<[BallId; 4]> {
    let mut balls: SmallVec<[BallId; 4]> = others.iter().copied().chain([cue_ball]).collect();
    balls.sort_unstable();
    balls
}
