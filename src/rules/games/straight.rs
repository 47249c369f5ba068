//! Straight pool, 14.1 continuous, by the rules of the World Pool-Billiard Association: the text of
//! 2016, with the changes of 2025 as they were reported (any touched ball is a foul). One function
//! per rule. A race to 100.
//!
//! Where the text leaves room: after a break that is a foul the cue ball is in hand behind the head
//! string only if it is gone; 24 turns in a row in which nobody scores are the stalemate that a
//! referee would call, and as nobody can lag here, the original breaker breaks again. Left out: the
//! cue ball in hand after a foul on which it neither left the area behind the head string nor met a
//! ball beyond (second paragraph of rule 6.11).

use crate::events::{
    BallInHand, ByPlayer, Call, Calls, Choice, Foul, Racked, Topic, TurnAfter, Verdict,
};
use crate::ids::{BallId, GameKind};
use crate::rules::fouls::{self, Rule, committed, verdict_on};
use crate::rules::game::{Chosen, Game};
use crate::rules::shot::{Met, Shot};
use crate::rules::state::State;
use smallvec::{SmallVec, smallvec};

/// The game. Any ball may be met first, and every shot is called.
pub const GAME: Game = Game {
    judge,
    after,
    choose,
    calls: |_| Calls { ball: true, pocket: true, safety: true, push_out: false },
    facts: &[Topic::BallsCollided, Topic::CushionHit, Topic::HeadStringCrossed],
    has_score: true,
    ends: "Settled, somebody has 100 points",
    in_hand: "Turn, cue ball in hand (break, scratch, in the way of the rack, placement refused)",
    ..Game::USUAL
};

/// So many points win.
const TARGET: i32 = 100;

/// So many object balls must reach a rail on a break on which the called ball does not fall; the
/// cue ball must too.
const DRIVEN_MIN: usize = 2;

/// Points taken away for a foul, for a break that misses its requirement, and on top of the first
/// for the third foul in a row.
const FOUL_POINTS: i32 = 1;
const BREAK_POINTS: i32 = 2;
const THREE_FOULS_POINTS: i32 = 15;

/// So many fouls in a row are a serious one.
const FOULS_MAX: u8 = 3;

/// So many turns in a row without a point are a stalemate. Long exchanges of safeties are none.
const DRY_TURNS_MAX: u32 = 24;

/// What is a foul besides [`fouls::ALWAYS`]. There is no wrong ball.
const FOULS: [(Foul, Rule); 3] = [
    (Foul::NoContact, fouls::no_contact),
    (Foul::NoRail, no_rail),
    (Foul::Kitchen, |state, shot| fouls::kitchen(state, shot, |_, _| true)),
];

/// Judges a finished shot.
pub fn judge(state: &State, call: Option<&Call>, shot: &Shot) -> Verdict {
    let fouls = committed(&[&fouls::ALWAYS, &FOULS], state, shot);
    let is_made = is_made_as_called(state, call, shot);
    let verdict = verdict_on(state, shot, fouls);
    if state.is_break() && !is_made && !is_open_break(shot) {
        judge_breaking_foul(state, shot, verdict)
    } else if !verdict.legal {
        judge_foul(state, shot, verdict)
    } else if is_made {
        judge_score(state, shot, verdict)
    } else {
        judge_miss(state, shot, verdict)
    }
}

/// A break that misses its requirement costs two points, whatever other foul it is, and does not
/// count among three in a row. The other player accepts the table or demands another break.
fn judge_breaking_foul(state: &State, shot: &Shot, verdict: Verdict) -> Verdict {
    let mut fouls = verdict.fouls;
    fouls.push(Foul::IllegalBreak);
    fouls.sort_unstable();
    Verdict {
        legal: false,
        fouls,
        points: taken(state, BREAK_POINTS),
        fouls_after: state.fouls,
        chooser: Some(state.player.other()),
        options: smallvec![Choice::Accept, Choice::RerackOpponentBreaks],
        ball_in_hand: in_hand_after_foul(shot),
        spot: spotted(state, shot),
        ..verdict
    }
}

/// A foul costs a point, and the turn passes. The third in a row, of which the player was told at
/// two, costs fifteen more; then all balls are racked, and the offender breaks.
fn judge_foul(state: &State, shot: &Shot, verdict: Verdict) -> Verdict {
    let (own, other) = (state.player, state.player.other());
    let fouls_after = fouls::in_a_row(state, false);
    if fouls_after.of(own) < FOULS_MAX {
        return Verdict {
            next_player: Some(other),
            points: taken(state, FOUL_POINTS),
            fouls_after,
            ball_in_hand: in_hand_after_foul(shot),
            spot: spotted(state, shot),
            ..verdict
        };
    }
    let mut fouls = verdict.fouls;
    fouls.push(Foul::ThreeFouls);
    fouls.sort_unstable();
    Verdict {
        fouls,
        turn: TurnAfter::Continue,
        next_player: Some(own),
        points: taken(state, FOUL_POINTS + THREE_FOULS_POINTS),
        fouls_after: fouls_after.with(own, 0),
        ball_in_hand: BallInHand::Kitchen,
        rack: Some(Racked::All),
        ..verdict
    }
}

/// The called ball fell as called: every ball that fell is a point, and the turn goes on. When one
/// ball is left, or none, the others are racked anew.
fn judge_score(state: &State, shot: &Shot, verdict: Verdict) -> Verdict {
    let own = state.player;
    let made = state.on_table.iter().filter(|ball| shot.has_pocketed(**ball)).count() as i32;
    let verdict = Verdict {
        points: ByPlayer::default().with(own, made),
        fouls_after: fouls::in_a_row(state, true),
        ..verdict
    };
    if state.score.of(own).saturating_add(made) >= TARGET {
        return Verdict { turn: TurnAfter::End, winner: Some(own), ..verdict };
    }
    let rack = (state.left_by(shot).len() <= 1).then_some(Racked::Fourteen);
    let is_in_way = rack.is_some() && shot.cue_in_rack;
    Verdict {
        turn: TurnAfter::Continue,
        next_player: Some(own),
        rack,
        ball_in_hand: if is_in_way { BallInHand::Kitchen } else { BallInHand::None },
        ..verdict
    }
}

/// A safety, or a miss: the turn passes. Balls that fell are spotted and are no points.
fn judge_miss(state: &State, shot: &Shot, verdict: Verdict) -> Verdict {
    let own = state.player;
    let verdict = Verdict { fouls_after: fouls::in_a_row(state, true), ..verdict };
    if dry_turns_after(state, false) >= DRY_TURNS_MAX {
        return Verdict {
            turn: TurnAfter::before(own, state.breaker),
            next_player: Some(state.breaker),
            rack: Some(Racked::All),
            ball_in_hand: BallInHand::Kitchen,
            ..verdict
        };
    }
    Verdict { next_player: Some(own.other()), spot: spotted(state, shot), ..verdict }
}

/// The called ball fell into the called pocket; how it got there does not matter. A called safety
/// makes nothing, whatever falls.
fn is_made_as_called(state: &State, call: Option<&Call>, shot: &Shot) -> bool {
    let Some(Call::Ball { ball, pocket: Some(pocket) }) = call else { return false };
    state.on_table.contains(ball) && shot.pocket_of(*ball) == Some(*pocket)
}

/// On the break the cue ball, after it met the rack, and two object balls must be driven to a rail.
/// One that falls or leaves the table was driven there.
fn is_open_break(shot: &Shot) -> bool {
    let Some(met_s) = shot.first_contact_s else { return false };
    let reached_rail = |(time_s, met): &(f64, Met)| matches!(met, Met::Rail(_)) && met_s <= *time_s;
    let is_cue_ball_driven = shot.cue_ball_is_gone() || shot.cue_met.iter().any(reached_rail);
    is_cue_ball_driven && shot.driven().len() >= DRIVEN_MIN
}

/// Foul, after the break: neither did a ball fall nor did one reach a rail after the contact.
fn no_rail(state: &State, shot: &Shot) -> bool {
    !state.is_break() && fouls::no_rail(state, shot)
}

/// After a foul the cue ball is played from where it lies; if it is gone, from behind the head
/// string.
fn in_hand_after_foul(shot: &Shot) -> BallInHand {
    if shot.cue_ball_is_gone() { BallInHand::Kitchen } else { BallInHand::None }
}

/// Balls that fell on a foul, a safety or a miss, and those that left the table, are spotted; the
/// lower number first.
fn spotted(state: &State, shot: &Shot) -> SmallVec<[BallId; 4]> {
    let is_gone = |ball: &BallId| shot.has_pocketed(*ball) || shot.off.contains(ball);
    state.on_table.iter().copied().filter(is_gone).collect()
}

fn taken(state: &State, points: i32) -> ByPlayer<i32> {
    ByPlayer::default().with(state.player, -points)
}

/// Turns in a row in which nobody scored, once a shot that ends a turn is over.
fn dry_turns_after(state: &State, has_scored: bool) -> u32 {
    match has_scored || state.pocketed_this_turn {
        true => 0,
        false => state.dry_turns.saturating_add(1),
    }
}

/// The state before the next shot; where all balls are racked, before another break.
fn after(state: &State, shot: &Shot, verdict: &Verdict) -> State {
    let has_scored = verdict.points.of(state.player) > 0;
    let next = State {
        dry_turns: dry_turns_after(state, has_scored),
        pocketed_this_turn: has_scored,
        ..state.after(shot, verdict)
    };
    match verdict.rack {
        Some(Racked::All) => before_break(&next),
        _ => next,
    }
    .with_warning()
}

/// Points and fouls go on from rack to rack.
fn before_break(state: &State) -> State {
    let reopened = state.reopened(GameKind::Straight, state.player);
    State { fouls: state.fouls, ..reopened }
}

/// After a break that missed its requirement: the table as it is, or the same player breaks again.
fn choose(state: &State, choice: Choice) -> Chosen {
    let next = State { options: SmallVec::new(), ..state.clone() };
    if choice != Choice::RerackOpponentBreaks {
        return Chosen::goes_on(next);
    }
    let next = State { player: state.player.other(), ..next };
    Chosen { state: before_break(&next).with_warning(), spot: SmallVec::new(), rack: true }
}
