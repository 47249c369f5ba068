//! Eight-ball by the rules of the World Pool-Billiard Association: the text of 2016, with the
//! changes of 2025 as they were reported (any touched ball is a foul). One function per rule.
//!
//! Where the text leaves room: a break that is a foul is not an illegal break as well; the 8 that
//! falls on a break with any foul is treated as with a scratch; twelve turns in a row without a
//! pocketed ball are the stalemate that a referee would call.

use crate::events::{
    BallInHand, Call, Calls, Choice, Foul, Group, Groups, Racked, Topic, TurnAfter, Verdict,
};
use crate::ids::{BallId, GameKind};
use crate::rules::fouls::{self, Rule, committed, verdict_on};
use crate::rules::game::{Chosen, Game};
use crate::rules::shot::Shot;
use crate::rules::state::State;
use smallvec::{SmallVec, smallvec};

/// The game.
pub const GAME: Game = Game {
    open: |state, _| {
        state.groups = Some(Groups::Open);
        state.ball_in_hand = BallInHand::Kitchen;
    },
    judge,
    may_be_first,
    after,
    choose,
    calls: |state| {
        let called = !state.is_break();
        Calls { ball: called, pocket: called, safety: called, push_out: false }
    },
    facts: &[Topic::BallsCollided, Topic::CushionHit, Topic::HeadStringCrossed],
    ends: "Settled, the 8 is gone after the break",
    in_hand: "Turn, cue ball in hand (break, foul, placement refused)",
    ..Game::USUAL
};

/// So many turns in a row without a pocketed object ball are a stalemate.
const DRY_TURNS_MAX: u32 = 12;

/// What is a foul on every shot besides [`fouls::ALWAYS`].
const EVERY_SHOT: [(Foul, Rule); 2] = [
    (Foul::NoContact, fouls::no_contact),
    (Foul::Kitchen, |state, shot| fouls::kitchen(state, shot, may_be_first)),
];

/// What is a foul as well, but on the break.
const AFTER_BREAK: [(Foul, Rule); 2] = [
    (Foul::WrongFirst, |state, shot| fouls::wrong_first(state, shot, may_be_first)),
    (Foul::NoRail, fouls::no_rail),
];

/// Judges a finished shot.
pub fn judge(state: &State, call: Option<&Call>, shot: &Shot) -> Verdict {
    let after_break: &[(Foul, Rule)] = if state.is_break() { &[] } else { &AFTER_BREAK };
    let fouls = committed(&[&fouls::ALWAYS, &EVERY_SHOT, after_break], state, shot);
    let verdict = Verdict { groups: Some(groups(state)), ..verdict_on(state, shot, fouls) };
    if state.is_break() {
        judge_break(state, shot, verdict)
    } else if eight_is_gone(shot) {
        judge_eight(state, call, shot, verdict)
    } else {
        judge_colours(state, call, shot, verdict)
    }
}

/// The break: nothing is called, and the table stays open whatever falls.
fn judge_break(state: &State, shot: &Shot, verdict: Verdict) -> Verdict {
    let (own, other) = (state.player, state.player.other());
    let eight_fell = shot.has_pocketed(BallId::EIGHT);
    if !verdict.legal {
        // The cue ball is gone: it comes back behind the head string.
        let returns = shot.cue_ball_is_gone();
        let ball_in_hand = if returns { BallInHand::Kitchen } else { BallInHand::None };
        let options: SmallVec<[Choice; 3]> = if eight_fell {
            smallvec![Choice::Respot8CueInHandKitchen, Choice::Rebreak]
        } else if returns {
            smallvec![]
        } else {
            smallvec![Choice::Accept, Choice::CueInHandKitchen]
        };
        return Verdict {
            next_player: Some(other),
            ball_in_hand,
            chooser: (!options.is_empty()).then_some(other),
            options,
            spot: spotted(shot),
            ..verdict
        };
    }
    if eight_fell {
        return Verdict {
            turn: TurnAfter::Continue,
            next_player: Some(own),
            chooser: Some(own),
            options: smallvec![Choice::Respot8Continue, Choice::Rebreak],
            spot: spotted(shot),
            ..verdict
        };
    }
    if !shot.pocketed.is_empty() {
        return Verdict { turn: TurnAfter::Continue, next_player: Some(own), ..verdict };
    }
    if fouls::is_weak_break(shot) {
        return Verdict {
            legal: false,
            fouls: smallvec![Foul::IllegalBreak],
            chooser: Some(other),
            options: smallvec![
                Choice::Accept,
                Choice::RerackAndBreak,
                Choice::RerackOpponentBreaks
            ],
            ..verdict
        };
    }
    Verdict { next_player: Some(other), ..verdict }
}

/// A shot on which the 8 fell, or left the table, ends the game: it wins if it fell into the called
/// pocket, without a foul, when the own group was gone before the shot; else it loses.
fn judge_eight(state: &State, call: Option<&Call>, shot: &Shot, verdict: Verdict) -> Verdict {
    let mut fouls = verdict.fouls;
    if !own_group_is_gone(state) {
        fouls.push(Foul::EightEarly);
    } else if eight_in_wrong_pocket(call, shot) {
        fouls.push(Foul::EightWrongPocket);
    }
    fouls.sort_unstable();
    let legal = fouls.is_empty();
    let winner = if legal { state.player } else { state.player.other() };
    Verdict { turn: TurnAfter::End, legal, fouls, winner: Some(winner), ..verdict }
}

/// Any other shot.
fn judge_colours(state: &State, call: Option<&Call>, shot: &Shot, verdict: Verdict) -> Verdict {
    let (own, other) = (state.player, state.player.other());
    if !verdict.legal {
        return Verdict { next_player: Some(other), ball_in_hand: BallInHand::Anywhere, ..verdict };
    }
    if let Some(group) = made_as_called(state, call, shot) {
        let groups = match groups(state) {
            Groups::Open => Groups::assigned(own, group),
            assigned => assigned,
        };
        return Verdict {
            turn: TurnAfter::Continue,
            next_player: Some(own),
            groups: Some(groups),
            ..verdict
        };
    }
    if is_stalemate(state, shot) {
        let (next_player, rack) = (Some(state.breaker), Some(Racked::All));
        let (groups, ball_in_hand) = (Some(Groups::Open), BallInHand::Kitchen);
        let turn = TurnAfter::before(own, state.breaker);
        return Verdict { turn, next_player, rack, groups, ball_in_hand, ..verdict };
    }
    Verdict { next_player: Some(other), ..verdict }
}

/// The cue ball may meet first: any colour on an open table, then an own ball, and the 8 when no
/// own ball was left before the shot.
fn may_be_first(state: &State, ball: BallId) -> bool {
    if state.is_break() {
        return true;
    }
    if ball == BallId::EIGHT {
        return own_group_is_gone(state);
    }
    own_group(state).is_none_or(|own| Group::of(ball) == Some(own) && !own_group_is_gone(state))
}

/// The 8 went down in another pocket than the called one, or none was called.
fn eight_in_wrong_pocket(call: Option<&Call>, shot: &Shot) -> bool {
    let Some(pocket) = shot.pocket_of(BallId::EIGHT) else { return false };
    call != Some(&Call::Ball { ball: BallId::EIGHT, pocket: Some(pocket) })
}

/// The called ball, an own one or any colour on an open table, fell into the called pocket: then
/// its group. A called safety makes nothing, whatever falls.
fn made_as_called(state: &State, call: Option<&Call>, shot: &Shot) -> Option<Group> {
    let Some(Call::Ball { ball, pocket: Some(pocket) }) = call else { return None };
    let group = Group::of(*ball)?;
    let own = own_group(state).is_none_or(|own| own == group);
    (own && shot.pocket_of(*ball) == Some(*pocket)).then_some(group)
}

/// Stalemate: nobody has pocketed a ball for twelve turns; the original breaker breaks again.
fn is_stalemate(state: &State, shot: &Shot) -> bool {
    state.dry_turns_after(shot) >= DRY_TURNS_MAX
}

/// The 8 that falls or leaves the table on the break is spotted. No other ball ever is.
fn spotted(shot: &Shot) -> SmallVec<[BallId; 4]> {
    eight_is_gone(shot).then_some(BallId::EIGHT).into_iter().collect()
}

/// The state before the next shot; after a stalemate, before another break.
fn after(state: &State, shot: &Shot, verdict: &Verdict) -> State {
    if verdict.rack.is_some() {
        return state.reopened(GameKind::WpaEightBall, state.breaker);
    }
    state.after(shot, verdict)
}

/// What an option means; the state is the chooser's.
fn choose(state: &State, choice: Choice) -> Chosen {
    let own = state.player;
    let goes_on = |ball_in_hand| {
        Chosen::goes_on(State { options: SmallVec::new(), ball_in_hand, ..state.clone() })
    };
    let with_eight = |ball_in_hand| {
        let mut chosen = goes_on(ball_in_hand);
        chosen.spot.push(BallId::EIGHT);
        if let Err(place) = chosen.state.on_table.binary_search(&BallId::EIGHT) {
            chosen.state.on_table.insert(place, BallId::EIGHT);
        }
        chosen
    };
    let breaks = |player| Chosen {
        state: state.reopened(GameKind::WpaEightBall, player),
        spot: SmallVec::new(),
        rack: true,
    };
    match choice {
        Choice::CueInHandKitchen => goes_on(BallInHand::Kitchen),
        Choice::Respot8Continue => with_eight(BallInHand::None),
        Choice::Respot8CueInHandKitchen => with_eight(BallInHand::Kitchen),
        Choice::RerackAndBreak | Choice::Rebreak => breaks(own),
        Choice::RerackOpponentBreaks => breaks(own.other()),
        // The others are options of other games.
        _ => goes_on(state.ball_in_hand),
    }
}

fn groups(state: &State) -> Groups {
    state.groups.unwrap_or_default()
}

fn eight_is_gone(shot: &Shot) -> bool {
    shot.has_pocketed(BallId::EIGHT) || shot.off.contains(&BallId::EIGHT)
}

fn own_group(state: &State) -> Option<Group> {
    groups(state).of(state.player)
}

/// Whether none of the own group was left before the shot; without groups, whether no colour was
/// left at all: nobody could go on otherwise.
fn own_group_is_gone(state: &State) -> bool {
    let own = own_group(state);
    let is_own = |ball: &BallId| match (Group::of(*ball), own) {
        (Some(group), Some(own)) => group == own,
        (group, None) => group.is_some(),
        (None, Some(_)) => false,
    };
    !state.on_table.iter().any(is_own)
}
