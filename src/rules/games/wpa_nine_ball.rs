//! Nine-ball by the rules of the World Pool-Billiard Association: the text of 2016, with the
//! changes of 2025 as they were reported (any touched ball is a foul). One function per rule.
//!
//! Nothing is called but a push-out. Where the text leaves room: on the break its own requirement
//! takes the place of the rail after the contact; twelve turns in a row without a pocketed ball are
//! the stalemate that a referee would call.

use crate::events::{
    BallInHand, Call, CallKind, Calls, Choice, Foul, Racked, ShotKind, Topic, TurnAfter, Verdict,
};
use crate::ids::{BallId, GameKind};
use crate::rules::fouls::{self, Rule, committed, verdict_on};
use crate::rules::game::{Chosen, Game};
use crate::rules::shot::Shot;
use crate::rules::state::State;
use smallvec::{SmallVec, smallvec};

/// The game.
pub const GAME: Game = Game {
    judge,
    may_be_first,
    after,
    choose,
    calls: |state| Calls { push_out: may_push_out(state), ..Calls::default() },
    facts: &[Topic::BallsCollided, Topic::CushionHit, Topic::HeadStringCrossed],
    balls: 9,
    ends: "Settled, the 9 is down or it was the third foul in a row",
    in_hand: "Turn, cue ball in hand (break, foul, placement refused)",
    ..Game::USUAL
};

/// So many fouls in a row lose.
const FOULS_MAX: u8 = 3;

/// So many turns in a row without a pocketed object ball are a stalemate.
const DRY_TURNS_MAX: u32 = 12;

/// What is a foul on every shot besides [`fouls::ALWAYS`].
const EVERY_SHOT: [(Foul, Rule); 1] =
    [(Foul::Kitchen, |state, shot| fouls::kitchen(state, shot, may_be_first))];

/// What is a foul as well, but on a push-out. The ball to meet first is the lowest that was on the
/// table before the shot.
const UNLESS_PUSHED_OUT: [(Foul, Rule); 4] = [
    (Foul::NoContact, fouls::no_contact),
    (Foul::WrongFirst, |state, shot| fouls::wrong_first(state, shot, may_be_first)),
    (Foul::NoRail, no_rail),
    (Foul::IllegalBreak, illegal_break),
];

/// Judges a finished shot.
pub fn judge(state: &State, call: Option<&Call>, shot: &Shot) -> Verdict {
    let is_push_out = is_push_out(state, call);
    let unless_pushed_out: &[(Foul, Rule)] = if is_push_out { &[] } else { &UNLESS_PUSHED_OUT };
    let fouls = committed(&[&fouls::ALWAYS, &EVERY_SHOT, unless_pushed_out], state, shot);
    let legal = fouls.is_empty();
    let fouls_after = fouls::in_a_row(state, legal);
    let verdict = Verdict { fouls_after, ..verdict_on(state, shot, fouls) };
    match (legal, is_push_out) {
        (false, _) => judge_foul(state, shot, verdict),
        (true, true) => judge_push_out(state, shot, verdict),
        (true, false) => judge_legal(state, shot, verdict),
    }
}

/// A foul: the other player has the cue ball in hand anywhere. The third in a row in the same rack
/// loses, if the player was told of two.
fn judge_foul(state: &State, shot: &Shot, verdict: Verdict) -> Verdict {
    let (own, other) = (state.player, state.player.other());
    if verdict.fouls_after.of(own) >= FOULS_MAX {
        let mut fouls = verdict.fouls;
        fouls.push(Foul::ThreeFouls);
        fouls.sort_unstable();
        return Verdict { turn: TurnAfter::End, winner: Some(other), fouls, ..verdict };
    }
    let ball_in_hand = BallInHand::Anywhere;
    Verdict { next_player: Some(other), ball_in_hand, spot: spotted(shot), ..verdict }
}

/// A push-out without a foul: whatever fell, the other player chooses who shoots from here. The 9
/// does not win, but is spotted.
fn judge_push_out(state: &State, shot: &Shot, verdict: Verdict) -> Verdict {
    Verdict {
        chooser: Some(state.player.other()),
        options: smallvec![Choice::Shoot, Choice::PassBack],
        spot: spotted(shot),
        ..verdict
    }
}

/// A shot without a foul: the 9 wins, on the break too; any other ball keeps the turn.
fn judge_legal(state: &State, shot: &Shot, verdict: Verdict) -> Verdict {
    let (own, other) = (state.player, state.player.other());
    if shot.has_pocketed(BallId::NINE) {
        return Verdict { turn: TurnAfter::End, winner: Some(own), ..verdict };
    }
    if !shot.pocketed.is_empty() {
        return Verdict { turn: TurnAfter::Continue, next_player: Some(own), ..verdict };
    }
    if is_stalemate(state, shot) {
        return Verdict {
            turn: TurnAfter::before(own, state.breaker),
            next_player: Some(state.breaker),
            rack: Some(Racked::All),
            ball_in_hand: BallInHand::Kitchen,
            fouls_after: Default::default(),
            ..verdict
        };
    }
    Verdict { next_player: Some(other), ..verdict }
}

/// A push-out may be announced for the first shot after a break without a foul, by whoever is at
/// the table.
fn may_push_out(state: &State) -> bool {
    !state.is_break() && (state.after_break || state.shot == ShotKind::PushOut)
}

/// A push-out is one only if it was announced.
fn is_push_out(state: &State, call: Option<&Call>) -> bool {
    let is_announced =
        state.shot == ShotKind::PushOut || call == Some(&Call::Kind(CallKind::PushOut));
    may_push_out(state) && is_announced
}

/// The cue ball may meet first: the lowest ball on the table. On a push-out it may meet any.
fn may_be_first(state: &State, ball: BallId) -> bool {
    state.shot == ShotKind::PushOut || state.on_table.first() == Some(&ball)
}

/// Foul, after the break: neither did a ball fall nor did one reach a rail after the contact.
fn no_rail(state: &State, shot: &Shot) -> bool {
    !state.is_break() && fouls::no_rail(state, shot)
}

/// Foul: a ball was met on the break, but none fell, and fewer than four object balls were driven
/// to a rail. Without a contact that is the foul.
fn illegal_break(state: &State, shot: &Shot) -> bool {
    state.is_break() && !shot.first_contacts.is_empty() && fouls::is_weak_break(shot)
}

/// Stalemate: nobody has pocketed a ball for twelve turns; the original breaker breaks again.
fn is_stalemate(state: &State, shot: &Shot) -> bool {
    state.dry_turns_after(shot) >= DRY_TURNS_MAX
}

/// The 9 is spotted if it falls on a foul or a push-out, or leaves the table. No other ball ever
/// is.
fn spotted(shot: &Shot) -> SmallVec<[BallId; 4]> {
    let is_gone = shot.has_pocketed(BallId::NINE) || shot.off.contains(&BallId::NINE);
    is_gone.then_some(BallId::NINE).into_iter().collect()
}

/// The state before the next shot; after a stalemate, before another break.
fn after(state: &State, shot: &Shot, verdict: &Verdict) -> State {
    if verdict.rack.is_some() {
        return state.reopened(GameKind::WpaNineBall, state.breaker);
    }
    let after_break = state.is_break() && verdict.legal;
    State { after_break, ..state.after(shot, verdict) }.with_warning()
}

/// After a push-out the chooser shoots, or the other player again.
fn choose(state: &State, choice: Choice) -> Chosen {
    let player = if choice == Choice::PassBack { state.player.other() } else { state.player };
    let state = State { player, options: SmallVec::new(), ..state.clone() };
    Chosen::goes_on(state.with_warning())
}
