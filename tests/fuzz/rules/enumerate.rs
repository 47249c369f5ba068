//! Small games, all of them: every shot of a few facts, from every state that such shots lead to.

use super::account::Account;
use super::play::Tally;
use super::script::{cushion, down, met, struck};
use hapticbillard::events::{ByPlayer, Call, Choice, Command, Event, Fact, FactKind, Source};
use hapticbillard::hash::{Digest, StateHash};
use hapticbillard::ids::{BallId, PlayerId, PocketId, Rail};
use hapticbillard::rules::{GameKind, Phase, Referee, State, game};
use std::collections::BTreeSet;

/// Facts in a shot at the most, between the stroke and rest.
const FACTS: usize = 3;
/// Shots that a game is followed for.
const SHOTS: usize = 3;
/// States that are followed further after each shot; those beyond are only judged.
const STATES: usize = 300;

#[test]
fn every_short_game_of_few_balls_keeps_the_rules() {
    for kind in GameKind::ALL {
        let mut tally = Tally::default();
        let mut seen = BTreeSet::new();
        let mut states: Vec<State> =
            starts(kind).into_iter().filter(|s| seen.insert(hash_of(s))).collect();
        for _ in 0..SHOTS {
            let mut next = Vec::new();
            for state in states.iter().take(STATES) {
                for after in all_shots(kind, state, &mut tally) {
                    if seen.insert(hash_of(&after)) {
                        next.push(after);
                    }
                }
            }
            states = next;
        }
        println!("{kind}: {} shots, {} states", tally.verdicts, seen.len());
        assert!(tally.verdicts > 10_000 && seen.len() > 5, "{kind}: {tally:?}");
    }
}

/// States with three object balls or fewer: as at the start, and after it.
fn starts(kind: GameKind) -> Vec<State> {
    let sets: [&[u16]; 4] = [&[1, 8, 9], &[1, 9], &[8, 9], &[8]];
    let of = |player: PlayerId, balls: &[u16]| {
        let balls = balls.iter().copied().filter(|ball| *ball <= game(kind).balls).chain([0]);
        let state = State::opening(kind, player, balls.map(BallId));
        // So near its end that a race is won.
        let score = match kind {
            GameKind::Straight => ByPlayer { one: 98, two: 98 },
            _ => ByPlayer::default(),
        };
        State { score, ..state }
    };
    // Where each player has a cue ball it matters who breaks.
    let two = matches!(kind, GameKind::ThreeCushion | GameKind::FreeCarom);
    let second = two.then(|| of(PlayerId::TWO, &[1, 2]));
    sets.iter().map(|balls| of(PlayerId::ONE, balls)).chain(second).collect()
}

/// All shots from a state; the states that they lead to. Every option is taken.
fn all_shots(kind: GameKind, state: &State, tally: &mut Tally) -> Vec<State> {
    let mut referee = Referee::resume(kind, state.clone());
    let mut account = Account::resumed(kind, game(kind).judge, state);
    let said = referee.begin([]);
    account.check_turn(&said, &referee).unwrap_or_else(|error| panic!("{kind} {state:?}: {error}"));
    let mut after = Vec::new();
    if referee.phase() == Phase::Choosing {
        for choice in &state.options {
            after.extend(chosen(kind, &referee, &account, *choice, tally));
        }
        return after;
    }
    let alphabet = alphabet(kind, state);
    let mut place = Vec::new();
    for length in 0..=FACTS {
        let count = alphabet.len().pow(length as u32);
        for number in 0..count {
            place.clear();
            let mut rest = number;
            for _ in 0..length {
                place.push(alphabet[rest % alphabet.len()]);
                rest /= alphabet.len();
            }
            for call in calls(kind, state) {
                let (referee, account) = (referee.clone(), account.clone());
                after.extend(one_shot(kind, referee, account, &place, call, tally));
            }
        }
    }
    after
}

fn one_shot(
    kind: GameKind,
    mut referee: Referee,
    mut account: Account,
    between: &[FactKind],
    call: Option<Call>,
    tally: &mut Tally,
) -> Option<State> {
    if let Some(call) = &call {
        referee.obey(Source::Input, &Command::Call(call.clone()));
    }
    let mut facts: Vec<Fact> = Vec::new();
    let zone = referee.state().ball_in_hand.zone();
    let ball = referee.state().cue_ball;
    let placed = zone.map(|zone| FactKind::BallPlaced { ball, zone, ok: true });
    let settled = FactKind::Settled { snookered: false, cue_in_rack: false };
    let all =
        placed.into_iter().chain([struck(ball)]).chain(between.iter().copied()).chain([settled]);
    for (number, kind) in all.enumerate() {
        facts.push(Fact { time_s: number as f64, kind });
    }
    let heard = referee.call().cloned();
    let said: Vec<Event> = facts.iter().flat_map(|fact| referee.handle(fact)).collect();
    account
        .check_shot(&facts, heard.as_ref(), &said, &referee, tally)
        .unwrap_or_else(|error| panic!("{kind} {between:?} {call:?}: {error}"));
    (referee.phase() != Phase::Over).then(|| referee.state().clone())
}

fn chosen(
    kind: GameKind,
    referee: &Referee,
    account: &Account,
    choice: Choice,
    tally: &mut Tally,
) -> Option<State> {
    let (mut referee, mut account) = (referee.clone(), account.clone());
    let said = referee.obey(Source::Input, &Command::Choose(choice));
    account
        .check_choice(&said, &referee, tally)
        .unwrap_or_else(|error| panic!("{kind} {choice:?}: {error}"));
    Some(referee.state().clone())
}

/// What may happen in a shot.
fn alphabet(kind: GameKind, state: &State) -> Vec<FactKind> {
    let cue_ball = state.cue_ball;
    let mut kinds = vec![cushion(cue_ball, Rail::Foot), down(cue_ball, PocketId::Fl)];
    for ball in state.on_table.iter().take(3) {
        kinds.extend([met(cue_ball, *ball), down(*ball, PocketId::Fl), cushion(*ball, Rail::Left)]);
        kinds.push(FactKind::BallOffTable { ball: *ball });
    }
    if matches!(kind, GameKind::ThreeCushion | GameKind::FreeCarom) {
        // Either player's ball may lie against the red.
        kinds.extend([0, 1].map(|a| FactKind::BallsFrozen { a: BallId(a), b: BallId(2) }));
    }
    kinds
}

/// Nothing, and each kind of call that is allowed.
fn calls(kind: GameKind, state: &State) -> Vec<Option<Call>> {
    let calls = (game(kind).calls)(state);
    let mut list = vec![None];
    if let (true, Some(ball)) = (calls.ball, state.on_table.first()) {
        let pocket = calls.pocket.then_some(PocketId::Fl);
        list.push(Some(Call::Ball { ball: *ball, pocket }));
    }
    list
}

/// Of what decides the future of a game but for its length.
fn hash_of(state: &State) -> Digest {
    let mut hash = StateHash::new();
    let state = State { dry_turns: 0, score: Default::default(), ..state.clone() };
    state.hash_into(&mut hash);
    hash.finish()
}
