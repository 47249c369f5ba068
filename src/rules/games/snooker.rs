//! Snooker, by the rules of the WPBSA. One function per rule.
//!
//! Where the rule book leaves room, or a referee's ear would be needed:
//! - Who nominates nothing nominates the ball that the cue ball meets first. Where a colour is on
//!   and neither tells which, a foul is worth seven, as one before a nomination is.
//! - The choice of who plays at a black that is spotted after a tie is drawn by lot; here the other
//!   player plays.
//! - Whether a shot was a miss is the referee's opinion. Here every shot that does not meet a ball
//!   on first is one, unless a player needs penalty points.
//!
//! Left out, because no fact tells it: a ball that touches the cue ball at the start counts as met
//! in the rule book; jump shots; a snooker behind the free ball; the frame lost by three misses.

use crate::events::{
    BallInHand, BallOn, ByPlayer, Call, Calls, Choice, Foul, Topic, TurnAfter, Verdict,
};
use crate::ids::{BallId, PlayerId};
use crate::rules::fouls::{self, Rule, committed, verdict_on};
use crate::rules::game::{Chosen, Game};
use crate::rules::shot::Shot;
use crate::rules::state::{Missed, State};
use smallvec::{SmallVec, smallvec};

/// The game.
pub const GAME: Game = Game {
    open: |state, _| {
        state.ball_in_hand = BallInHand::D;
        state.on = Some(BallOn::Red);
    },
    judge,
    may_be_first,
    after,
    choose,
    calls: |state| Calls {
        ball: state.free_ball || on(state) == BallOn::Colour,
        ..Calls::default()
    },
    facts: &[Topic::BallsCollided],
    balls: 21,
    names: &[
        "0", "R1", "R2", "R3", "R4", "R5", "R6", "R7", "R8", "R9", "R10", "R11", "R12", "R13",
        "R14", "R15", "Y", "G", "Br", "Bl", "P", "K",
    ],
    has_score: true,
    is_practice: false,
    // Balls are put back after a miss.
    takes_back: 1,
    knows_snookers: true,
    ends: "Settled, the black is down or fouled on and the points differ",
    in_hand: "Turn, cue ball in hand in the D",
};

/// The ball that ends a frame.
const BLACK: BallId = BallId(21);

/// A foul costs at least this.
const PENALTY_MIN: i32 = 4;

/// And at most this.
const PENALTY_MAX: i32 = 7;

/// What is a foul besides [`fouls::ALWAYS`].
const FOULS: [(Foul, Rule); 3] = [
    (Foul::NoContact, fouls::no_contact),
    (Foul::WrongFirst, wrong_first),
    (Foul::BallNotOnPocketed, wrong_ball_fell),
];

/// Judges a finished shot.
pub fn judge(state: &State, call: Option<&Call>, shot: &Shot) -> Verdict {
    let state = &with_nomination(state, call, shot);
    let fouls = committed(&[&fouls::ALWAYS, &FOULS], state, shot);
    let verdict = verdict_on(state, shot, fouls);
    let verdict = if verdict.legal {
        judge_clean(state, shot, verdict)
    } else {
        judge_foul(state, shot, verdict)
    };
    if is_last_ball_played(state, shot, &verdict) {
        return end_frame(state, shot, verdict);
    }
    verdict
}

/// A shot without a foul: who scores plays on.
fn judge_clean(state: &State, shot: &Shot, verdict: Verdict) -> Verdict {
    let (own, other) = (state.player, state.player.other());
    let points = points_made(state, shot);
    let spot = spotted(state, shot, &verdict);
    let left = left_with(state, shot, &spot);
    let verdict = Verdict { spot, points: ByPlayer::default().with(own, points), ..verdict };
    if points == 0 {
        return Verdict { next_player: Some(other), ball_on_next: lowest_on(&left), ..verdict };
    }
    let is_red_made = on(state) == BallOn::Red && left.iter().any(|ball| is_colour(*ball));
    let next = if is_red_made { Some(BallOn::Colour) } else { lowest_on(&left) };
    Verdict { turn: TurnAfter::Continue, next_player: Some(own), ball_on_next: next, ..verdict }
}

/// A foul: the other player gets the penalty, and plays or asks the offender to play again. A cue
/// ball that is gone is in hand in the D.
fn judge_foul(state: &State, shot: &Shot, verdict: Verdict) -> Verdict {
    let other = state.player.other();
    let spot = spotted(state, shot, &verdict);
    let ball_on_next = lowest_on(&left_with(state, shot, &spot));
    let returns = shot.cue_ball_is_gone();
    Verdict {
        spot,
        ball_on_next,
        points: ByPlayer::default().with(other, penalty(state, shot)),
        ball_in_hand: if returns { BallInHand::D } else { BallInHand::None },
        chooser: Some(other),
        options: smallvec![Choice::Play, Choice::AskAgain],
        free_ball: shot.snookered,
        ..verdict
    }
}

/// When only the black is left the first score or foul ends the frame.
fn is_last_ball_played(state: &State, shot: &Shot, verdict: &Verdict) -> bool {
    let only_black = state.on_table.as_slice() == [BLACK] && on(state) == BallOn::Ball(BLACK);
    let nothing_left = left_with(state, shot, &verdict.spot).is_empty();
    nothing_left || only_black && !verdict.legal
}

/// The end of a frame: the higher score wins. After a tie the black is spotted, and the other
/// player has the cue ball in hand in the D.
fn end_frame(state: &State, shot: &Shot, verdict: Verdict) -> Verdict {
    let score = score_after(state, &verdict);
    let verdict = Verdict {
        turn: TurnAfter::End,
        next_player: None,
        ball_in_hand: BallInHand::None,
        spot: smallvec![],
        chooser: None,
        options: smallvec![],
        ball_on_next: None,
        free_ball: false,
        ..verdict
    };
    let has_black = state.on_table.contains(&BLACK) || is_gone(shot, BLACK);
    match score.one.cmp(&score.two) {
        std::cmp::Ordering::Equal if has_black => Verdict {
            turn: TurnAfter::Pass,
            next_player: Some(state.player.other()),
            ball_in_hand: BallInHand::D,
            spot: smallvec![BLACK],
            ball_on_next: Some(BallOn::Ball(BLACK)),
            ..verdict
        },
        std::cmp::Ordering::Equal => verdict,
        std::cmp::Ordering::Less => Verdict { winner: Some(PlayerId::TWO), ..verdict },
        std::cmp::Ordering::Greater => Verdict { winner: Some(PlayerId::ONE), ..verdict },
    }
}

/// What is worth how much: a red 1; yellow, green, brown, blue, pink and black 2 to 7.
fn value(ball: BallId) -> i32 {
    match ball.0 {
        1..=15 => 1,
        16..=21 => i32::from(ball.0) - 14,
        _ => 0,
    }
}

fn is_red(ball: BallId) -> bool {
    value(ball) == 1
}

fn is_colour(ball: BallId) -> bool {
    value(ball) > 1
}

/// What is on; a state that does not say so has what a turn begins with.
fn on(state: &State) -> BallOn {
    state.on.or_else(|| lowest_on(&state.on_table)).unwrap_or(BallOn::Red)
}

/// What a turn begins with: a red, or when none is left the colour of the lowest value.
fn lowest_on(on_table: &[BallId]) -> Option<BallOn> {
    let colours = on_table.iter().copied().filter(|ball| is_colour(*ball));
    match on_table.iter().any(|ball| is_red(*ball)) {
        true => Some(BallOn::Red),
        false => colours.min().map(BallOn::Ball),
    }
}

/// The state with what counts as nominated: what the player called, or else the ball that the cue
/// ball met first.
fn with_nomination(state: &State, call: Option<&Call>, shot: &Shot) -> State {
    let called = match call {
        Some(Call::Ball { ball, .. }) => Some(*ball),
        _ => state.nominated,
    };
    let met = match shot.first_contacts.as_slice() {
        [met] => Some(met.ball),
        _ => None,
    };
    let may_be = |ball: &BallId| may_nominate(state, *ball);
    State { nominated: called.filter(may_be).or(met.filter(may_be)), ..state.clone() }
}

/// A colour may be nominated after a red, and any ball as a free ball.
fn may_nominate(state: &State, ball: BallId) -> bool {
    if state.free_ball {
        return value(ball) > 0;
    }
    on(state) == BallOn::Colour && is_colour(ball)
}

/// Whether a ball is on, the free ball not counted.
fn is_on(state: &State, ball: BallId) -> bool {
    match on(state) {
        BallOn::Red => is_red(ball),
        BallOn::Colour => is_colour(ball) && state.nominated == Some(ball),
        BallOn::Ball(on) => ball == on,
    }
}

/// The nominated ball that counts as a ball on without being one.
fn free_ball(state: &State) -> Option<BallId> {
    state.nominated.filter(|ball| may_nominate(state, *ball) && !is_on(state, *ball))
}

/// The cue ball may meet first: a red, the nominated colour, or the colour whose turn it is; if a
/// free ball is nominated, only that.
fn may_be_first(state: &State, ball: BallId) -> bool {
    match (state.nominated.filter(|named| may_nominate(state, *named)), free_ball(state)) {
        (_, Some(free)) => ball == free,
        (Some(_), None) => is_on(state, ball),
        (None, None) => is_on(state, ball) || may_nominate(state, ball),
    }
}

/// A ball may fall if it is on, or the free ball.
fn may_fall(state: &State, ball: BallId) -> bool {
    is_on(state, ball) || free_ball(state) == Some(ball)
}

/// Foul: the cue ball met a wrong ball first, or at the same time as a right one: only two reds, or
/// the free ball and a ball on, may be met together.
fn wrong_first(state: &State, shot: &Shot) -> bool {
    let met = &shot.first_contacts;
    let is_right = met.iter().any(|met| may_be_first(state, met.ball))
        && met.iter().all(|met| may_fall(state, met.ball));
    !met.is_empty() && !is_right
}

/// Foul: a ball fell that was not on.
fn wrong_ball_fell(state: &State, shot: &Shot) -> bool {
    shot.pocketed.iter().any(|fallen| !may_fall(state, fallen.ball))
}

/// Points of a shot without a foul: one for each red, and for a free ball in the place of one; else
/// the value of the ball on, once, even if the free ball falls with it.
fn points_made(state: &State, shot: &Shot) -> i32 {
    let fallen = shot.pocketed.len();
    match on(state) {
        BallOn::Red => fallen as i32,
        _ if fallen > 0 => value_of_on(state),
        _ => 0,
    }
}

/// The value of the ball on; seven if a colour is on and nothing tells which.
fn value_of_on(state: &State) -> i32 {
    match (on(state), state.nominated) {
        (BallOn::Red, _) => 1,
        (BallOn::Ball(ball), _) => value(ball),
        (BallOn::Colour, Some(ball)) => value(ball),
        (BallOn::Colour, None) => PENALTY_MAX,
    }
}

/// The penalty of a foul: the highest of the values of the ball on, of a wrong ball that was met
/// first, and of every wrong ball that fell, left the table or was touched; from four to seven.
fn penalty(state: &State, shot: &Shot) -> i32 {
    let wrong_met = wrong_first(state, shot).then_some(&shot.first_contacts).into_iter().flatten();
    let wrong_fell = shot.pocketed.iter().map(|fallen| fallen.ball);
    let wrong_fell = wrong_fell.filter(|ball| !may_fall(state, *ball));
    let touched = shot.touched.iter().map(|(ball, _)| *ball);
    let concerned = wrong_met.map(|met| met.ball).chain(wrong_fell).chain(shot.off.iter().copied());
    let values = concerned.chain(touched).map(value);
    values.fold(value_of_on(state), i32::max).clamp(PENALTY_MIN, PENALTY_MAX)
}

/// Colours that return, those of the highest value first: all that fell or left the table, but for
/// the one whose turn it was if it fell without a foul. Reds never do.
fn spotted(state: &State, shot: &Shot, verdict: &Verdict) -> SmallVec<[BallId; 4]> {
    let stays_down = |ball: BallId| verdict.legal && on(state) == BallOn::Ball(ball);
    let colours = (16..=BLACK.0).rev().map(BallId);
    colours.filter(|ball| is_gone(shot, *ball) && !stays_down(*ball)).collect()
}

fn is_gone(shot: &Shot, ball: BallId) -> bool {
    shot.has_pocketed(ball) || shot.off.contains(&ball)
}

/// The object balls on the table once these are spotted.
fn left_with(state: &State, shot: &Shot, spot: &[BallId]) -> SmallVec<[BallId; 16]> {
    let mut left = state.left_by(shot);
    left.extend(spot.iter().copied());
    left.sort_unstable();
    left.dedup();
    left
}

fn score_after(state: &State, verdict: &Verdict) -> ByPlayer<i32> {
    let add = |player| state.score.of(player).saturating_add(verdict.points.of(player));
    ByPlayer { one: add(PlayerId::ONE), two: add(PlayerId::TWO) }
}

/// The state before the next shot. Colours are spotted before anybody chooses, so that the chooser
/// sees the table.
fn after(state: &State, shot: &Shot, verdict: &Verdict) -> State {
    let next = state.after(shot, verdict);
    let on_table = left_with(state, shot, &verdict.spot);
    let missed = is_miss(state, verdict, &on_table).then(|| {
        let (on, free_ball) = (Some(on(state)), state.free_ball);
        Box::new(Missed { on_table: state.on_table.clone(), on, free_ball })
    });
    let mut options = next.options;
    if missed.is_some() {
        options.push(Choice::PutBack);
    }
    State { on_table, missed, options, ..next }
}

/// A miss: the cue ball did not meet a ball on first. None is called if before or after the shot a
/// player could not win any more without penalty points.
fn is_miss(state: &State, verdict: &Verdict, on_table: &[BallId]) -> bool {
    let has_missed = verdict.fouls.iter().any(|foul| {
        let foul = *foul;
        foul == Foul::NoContact || foul == Foul::WrongFirst
    });
    let is_open = |score: ByPlayer<i32>, points_left: i32| {
        score.one.abs_diff(score.two) < points_left.unsigned_abs()
    };
    let before = points_left(&state.on_table, on(state));
    let after = points_left(on_table, verdict.ball_on_next.unwrap_or(BallOn::Red));
    let is_offered = has_missed && !verdict.options.is_empty();
    is_offered && is_open(state.score, before) && is_open(score_after(state, verdict), after)
}

/// The most that can still be made: a black with each red, one more if a colour is on, and all
/// colours once.
fn points_left(on_table: &[BallId], on: BallOn) -> i32 {
    let reds = on_table.iter().filter(|ball| is_red(**ball)).count() as i32;
    let colours: i32 = on_table.iter().filter(|ball| is_colour(**ball)).map(|b| value(*b)).sum();
    let blacks = reds + i32::from(on == BallOn::Colour);
    reds + blacks * value(BLACK) + colours
}

/// What an option means; the state is the chooser's. A free ball is not the offender's.
fn choose(state: &State, choice: Choice) -> Chosen {
    let goes_on = State { options: SmallVec::new(), missed: None, ..state.clone() };
    let again = State { player: state.player.other(), free_ball: false, ..goes_on.clone() };
    Chosen::goes_on(match (choice, &state.missed) {
        (Choice::PutBack, Some(missed)) => State {
            on_table: missed.on_table.clone(),
            on: missed.on,
            free_ball: missed.free_ball,
            ball_in_hand: BallInHand::None,
            ..again
        },
        (Choice::AskAgain | Choice::PutBack, _) => again,
        _ => goes_on,
    })
}
