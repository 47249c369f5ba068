//! Eight-ball of the WPA, from the tables of its text alone. Numbers are those of the rule book.

use super::expected::Expected;
use super::seen::{Met, Seen, may_lie};
use hapticbillard::events::{
    BallInHand, Call, CallKind, Choice, Fact, Foul, Group, Groups, Racked,
};
use hapticbillard::ids::BallId;
use hapticbillard::rules::State;

/// So many turns without a pocketed ball are a stalemate.
const STALEMATE_TURNS: u32 = 12;

/// The verdict on a shot with these facts.
pub fn wpa_eight_ball(state: &State, call: Option<&Call>, facts: &[Fact]) -> Expected {
    let seen = Seen(facts);
    if state.is_break() { on_the_break(state, seen) } else { later(state, call, seen) }
}

/// 3.3: the break. Nothing is called, and any ball may be met first.
fn on_the_break(state: &State, seen: Seen<'_>) -> Expected {
    let (breaker, opponent) = (state.player, state.player.other());
    let open = Groups::Open;
    let fouls = fouls(state, seen, |_| true);
    let eight_fell = seen.fell(BallId::EIGHT);
    // Before any choice the cue ball is in hand only if it is gone.
    let is_gone = seen.fell(BallId::CUE) || seen.left(BallId::CUE);
    let in_hand = if is_gone { BallInHand::Kitchen } else { BallInHand::None };

    if eight_fell && fouls.is_empty() {
        // "The 8 falls, no foul": the breaker has it spotted and goes on, or breaks again.
        return Expected::plays("break: the 8", breaker, breaker, open)
            .spots_eight()
            .chooses(breaker, &[Choice::Respot8Continue, Choice::Rebreak]);
    }
    if eight_fell {
        // "The 8 falls and scratch", and any other foul with the 8: the opponent has the 8 spotted
        // and the cue ball in hand behind the head string, or breaks again.
        return Expected::plays("break: the 8 and a foul", breaker, opponent, open)
            .fouled(fouls)
            .spots_eight()
            .in_hand(in_hand)
            .chooses(opponent, &[Choice::Respot8CueInHandKitchen, Choice::Rebreak]);
    }
    if !fouls.is_empty() {
        let next = if is_gone {
            // "Scratch, no 8": the opponent has the cue ball in hand behind the head string.
            Expected::plays("break: scratch", breaker, opponent, open).in_hand(in_hand)
        } else {
            // "Object ball off the table", "any other foul": the opponent accepts the table, or
            // takes the cue ball in hand behind the head string.
            Expected::plays("break: another foul", breaker, opponent, open)
                .chooses(opponent, &[Choice::Accept, Choice::CueInHandKitchen])
        };
        let next = next.fouled(fouls);
        // "It stays out", but "the 8 is spotted".
        return if seen.left(BallId::EIGHT) { next.spots_eight() } else { next };
    }
    if !seen.fallen().is_empty() {
        // "A colour falls, no foul": the breaker goes on, the table stays open.
        return Expected::plays("break: a colour", breaker, breaker, open);
    }
    if seen.object_balls_to_rails() >= 4 {
        // "Nothing falls, at least four object balls to rails": as it lies.
        return Expected::plays("break: dry", breaker, opponent, open);
    }
    // "Nothing falls, fewer than four": no cue ball in hand; accept, re-rack and break, or let the
    // same player break again. Who shoots next is not known before.
    let options = [Choice::Accept, Choice::RerackAndBreak, Choice::RerackOpponentBreaks];
    let illegal = Expected::plays("break: illegal", breaker, opponent, open)
        .fouled([Foul::IllegalBreak])
        .chooses(opponent, &options);
    Expected { next_player: None, ..illegal }
}

/// What comes after the break, in the order of the table.
fn later(state: &State, call: Option<&Call>, seen: Seen<'_>) -> Expected {
    let (shooter, opponent) = (state.player, state.player.other());
    let groups = state.groups.unwrap_or_default();
    // 1: the fouls.
    let fouls = fouls(state, seen, |ball| is_on(state, ball));

    // 2: the 8 fell or left the table.
    let called = |ball: BallId| match call {
        Some(Call::Ball { ball: named, pocket: Some(pocket) }) => {
            *named == ball && seen.fell_into(ball, *pocket)
        }
        _ => false,
    };
    if seen.fell(BallId::EIGHT) || seen.left(BallId::EIGHT) {
        let mut faults = fouls;
        if !is_cleared(state) {
            faults.push(Foul::EightEarly);
        } else if seen.fell(BallId::EIGHT) && !called(BallId::EIGHT) {
            faults.push(Foul::EightWrongPocket);
        }
        return if faults.is_empty() {
            Expected::ends("the 8: won", Some(shooter), groups)
        } else {
            Expected::ends("the 8: lost", Some(opponent), groups).fouled(faults)
        };
    }

    // 3: a foul passes the turn, with the cue ball in hand anywhere. Nothing is spotted. In the
    // order of the table that comes before a stalemate: nobody fouls his way into one.
    if !fouls.is_empty() {
        return Expected::plays("foul", shooter, opponent, groups)
            .fouled(fouls)
            .in_hand(BallInHand::Anywhere);
    }
    // 4: a called safety passes the turn, whatever fell.
    let is_safety = call == Some(&Call::Kind(CallKind::Safety));
    // 5: the called ball in the called pocket. On an open table its group is the shooter's. The row
    // says nothing of a called ball of the opponent's; it is read as "an own ball is called".
    let own = groups.of(shooter);
    if let Some(Call::Ball { ball, .. }) = call
        && called(*ball)
        && (own.is_none() || own == Group::of(*ball))
    {
        let now = match (groups, Group::of(*ball)) {
            (Groups::Open, Some(group)) => Groups::assigned(shooter, group),
            _ => groups,
        };
        return Expected::plays("called ball", shooter, shooter, now);
    }
    // Stalemate (1.12, 3.11): so many turns without a pocketed ball, and the original breaker
    // breaks again.
    let is_dry = seen.fallen().is_empty() && !state.pocketed_this_turn;
    if is_dry && state.dry_turns + 1 >= STALEMATE_TURNS {
        let again = Expected::plays("stalemate", shooter, state.breaker, Groups::Open)
            .in_hand(BallInHand::Kitchen);
        return Expected { rack: Some(Racked::All), ..again };
    }
    // 6: otherwise it passes as it lies.
    let row = if is_safety { "safety" } else { "nothing called fell" };
    Expected::plays(row, shooter, opponent, groups)
}

/// Whether the shooter had no ball of the own group left before the shot. On an open table all
/// colours are still to be played.
fn is_cleared(state: &State) -> bool {
    let own = state.groups.unwrap_or_default().of(state.player);
    let is_own = |ball: &BallId| match (own, Group::of(*ball)) {
        (Some(own), group) => group == Some(own),
        (None, group) => group.is_some(),
    };
    !state.on_table.iter().any(is_own)
}

/// Row 1, "wrong first", turned round. Open: any but the 8, unless that is all there is. Assigned:
/// an own ball; once they are gone, the 8.
fn is_on(state: &State, ball: BallId) -> bool {
    let own = state.groups.unwrap_or_default().of(state.player);
    match (own, is_cleared(state)) {
        (None, false) => ball != BallId::EIGHT,
        (None, true) => true,
        (Some(own), false) => Group::of(ball) == Some(own),
        (Some(_), true) => ball == BallId::EIGHT,
    }
}

/// Row 1 of the later table; `may_be_first` says which ball is on.
fn fouls(state: &State, seen: Seen<'_>, may_be_first: impl Fn(BallId) -> bool) -> Vec<Foul> {
    let first = seen.first_met();
    let is_met = !first.is_empty();
    // An exact tie: the legal ball counts as the first one.
    let is_right = |met: &&Met| may_be_first(met.0);
    let right: Vec<Met> = first.iter().filter(is_right).copied().collect();
    let counted = if right.is_empty() { &first } else { &right };
    let all_in_kitchen = is_met && counted.iter().all(|met| met.1);
    let from_kitchen = state.ball_in_hand == BallInHand::Kitchen;
    let needs_rail = !state.is_break() && seen.fallen().is_empty();
    [
        (Foul::Scratch, seen.fell(BallId::CUE)),
        (Foul::CueOff, seen.left(BallId::CUE)),
        (Foul::NoContact, seen.tips() > 0 && !is_met),
        (Foul::WrongFirst, is_met && right.is_empty()),
        (Foul::NoRail, is_met && needs_rail && !seen.rail_after_contact()),
        (Foul::BallOff, seen.lost_an_object_ball()),
        (Foul::DoubleHit, seen.tips() > 1),
        (Foul::Push, seen.pushed()),
        (Foul::TouchedBall, seen.touched()),
        (
            Foul::BadPlacement,
            seen.placed().is_some_and(|place| !may_lie(state.ball_in_hand, place)),
        ),
        (Foul::Kitchen, from_kitchen && all_in_kitchen && !seen.crossed_in_time()),
        (Foul::Moving, seen.struck_too_soon()),
        (Foul::OutOfTurn, seen.struck_by_other_than(state.player)),
    ]
    .into_iter()
    .filter_map(|(foul, is_committed)| is_committed.then_some(foul))
    .collect()
}
