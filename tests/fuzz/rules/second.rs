//! A second judge of eight-ball, written from the tables of the rules alone, without a look at the
//! program's own. Both must say the same of every shot.
//!
//! It judges the list of facts, not what the program has made of them. `FUZZ_SEED` chooses another
//! run, `FUZZ_EVENTS` how many shots of each game are judged, `SECOND_GAMES` how many whole games
//! of good players, and `SECOND_MATCHES` how many matches of computer players on a simulated table.

/// What the second judge says.
mod expected;
/// Matches of computer players on a simulated table.
mod matches;
/// The paper's eight-ball.
mod paper;
/// Questions to a list of facts.
mod seen;
/// The referee at work, with the second judge looking over his shoulder.
mod watched;
/// Eight-ball of the WPA.
mod wpa;

use super::number;
use super::play::CHOICES;
use super::script::{Script, Step};
use crate::facts::{Swarm, made_possible};
use hapticbillard::events::{Call, CallKind, Command, Fact, FactKind, Source};
use hapticbillard::ids::{BallId, PocketId};
use hapticbillard::rules::{GameKind, Judge, Phase, State, game};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::time::Instant;
use watched::{Met, Watched};

/// Whom the program's judge is held against.
type SecondJudge = fn(&State, Option<&Call>, &[Fact]) -> expected::Expected;

const GAMES: [(GameKind, SecondJudge); 2] = [
    (GameKind::WpaEightBall, wpa::wpa_eight_ball),
    (GameKind::PaperEightBall, paper::paper_eight_ball),
];

/// Events in one game at the most.
const GAME_EVENTS: usize = 1500;
/// Events in a game that is played to its end.
const WHOLE_GAME_EVENTS: usize = 20_000;

/// Each row of the tables must be met so often, or nothing was compared.
const ROW_LEAST: u64 = 10;
const WPA_ROWS: [&str; 14] = [
    "break: the 8",
    "break: the 8 and a foul",
    "break: scratch",
    "break: another foul",
    "break: a colour",
    "break: dry",
    "break: illegal",
    "the 8: won",
    "the 8: lost",
    "foul",
    "safety",
    "called ball",
    "nothing called fell",
    "stalemate",
];
const PAPER_ROWS: [&str; 9] = [
    "the 8: won",
    "the 8: lost",
    "foul",
    "break: a colour",
    "break: the 8",
    "groups assigned",
    "own ball",
    "no own ball",
    "draw",
];

#[test]
fn a_second_judge_agrees_on_whatever_happens() {
    let first = number("FUZZ_SEED", 1);
    let shots = number("FUZZ_EVENTS", 30_000);
    for (kind, second) in GAMES {
        let (mut seed, mut met, start) = (first, Met::default(), Instant::now());
        while met.shots < shots {
            let mut rng = Pcg64Mcg::seed_from_u64(seed);
            let mut swarm = Swarm::new(&mut rng);
            // Half of all games have good players; without them few get beyond the break.
            swarm.skill = [0.0, 0.5, 0.9, 1.0][rng.random_range(0..4)];
            let judge = game(kind).judge;
            play((kind, judge, second), &swarm, GAME_EVENTS, &mut rng, &mut met)
                .unwrap_or_else(|problem| panic!("FUZZ_SEED={seed} {kind}: {problem}"));
            seed += 1;
        }
        report(kind, &met, start);
        if shots >= 30_000 {
            check_rows(kind, &met);
        }
    }
}

#[test]
fn a_second_judge_agrees_on_whole_games() {
    let games = number("SECOND_GAMES", 20);
    for (kind, second) in GAMES {
        let (mut met, start) = (Met::default(), Instant::now());
        for seed in 1..=games {
            let mut rng = Pcg64Mcg::seed_from_u64(seed);
            let mut swarm = Swarm::new(&mut rng);
            (swarm.is_possible, swarm.skill, swarm.commands) = (true, 1.0, 0.0);
            let judge = game(kind).judge;
            play((kind, judge, second), &swarm, WHOLE_GAME_EVENTS, &mut rng, &mut met)
                .unwrap_or_else(|problem| panic!("{kind}, game {seed}: {problem}"));
        }
        report(kind, &met, start);
        assert_eq!(met.games, games, "{kind}: a game came to no end");
    }
}

/// A second judge that agrees with anything would be worth nothing: here are wrong ones to find.
#[test]
fn a_second_judge_finds_a_wrong_one() {
    for (name, kind, wrong) in WRONG {
        let second = GAMES.iter().find(|(of, _)| of == kind).unwrap().1;
        let is_found = (1..=200).any(|seed| {
            let mut rng = Pcg64Mcg::seed_from_u64(seed);
            let mut swarm = Swarm::new(&mut rng);
            swarm.skill = [0.0, 0.5, 0.9][seed as usize % 3];
            let met = &mut Met::default();
            play((*kind, *wrong, second), &swarm, GAME_EVENTS, &mut rng, met).is_err()
        });
        assert!(is_found, "{kind}: nobody noticed: {name}");
    }
}

const WRONG: &[(&str, GameKind, Judge)] = &[
    ("the kitchen may be shot at", GameKind::WpaEightBall, |state, call, shot| {
        let mut shot = shot.clone();
        shot.first_contacts.iter_mut().for_each(|met| met.in_kitchen = false);
        hapticbillard::rules::judge(GameKind::WpaEightBall, state, call, &shot)
    }),
    ("a stalemate comes a turn late", GameKind::WpaEightBall, |state, call, shot| {
        let state = State { dry_turns: state.dry_turns.saturating_sub(1), ..state.clone() };
        hapticbillard::rules::judge(GameKind::WpaEightBall, &state, call, shot)
    }),
    ("any pocket will do", GameKind::WpaEightBall, |state, call, shot| {
        let call = match call {
            Some(Call::Ball { ball, .. }) => {
                Some(Call::Ball { ball: *ball, pocket: shot.pocket_of(*ball) })
            }
            other => other.cloned(),
        };
        hapticbillard::rules::judge(GameKind::WpaEightBall, state, call.as_ref(), shot)
    }),
    ("the last colour assigns", GameKind::PaperEightBall, |state, call, shot| {
        let mut shot = shot.clone();
        shot.pocketed.reverse();
        hapticbillard::rules::judge(GameKind::PaperEightBall, state, call, &shot)
    }),
];

/// One game; an error says where the two judges differ.
fn play(
    (kind, judge, second): (GameKind, Judge, SecondJudge),
    swarm: &Swarm,
    events: usize,
    rng: &mut impl Rng,
    met: &mut Met,
) -> Result<(), String> {
    let mut watched = Watched::new(kind, judge, second);
    watched.begin((0..=game(kind).balls).map(BallId));
    let (mut script, mut time_s) = (Script::default(), 0.0);
    for _ in 0..events {
        let phase = watched.referee.phase();
        if phase == Phase::Over {
            met.games += 1;
            break;
        }
        let is_choosing = phase == Phase::Choosing;
        if rng.random_bool(if is_choosing { 0.5 } else { swarm.commands }) {
            watched.obey(Source::Input, &said_by_chance(&watched, rng), met)?;
            continue;
        }
        let mut what = swarm.kind(rng, &watched.referee);
        if swarm.is_possible {
            what = made_possible(what, phase == Phase::Shooting, rng, &watched.referee);
        }
        if rng.random_bool(swarm.skill) {
            match script.next(&watched.referee, rng) {
                Some(Step::Say(command)) => {
                    watched.obey(Source::Input, &command, met)?;
                    continue;
                }
                Some(Step::Happen(kind)) => what = kind,
                None => {}
            }
        }
        if !rng.random_bool(swarm.tie) {
            time_s += 0.125;
        }
        if has_meaning(&what, watched.heard()) {
            watched.handle(&Fact { time_s, kind: what }, met)?;
        }
    }
    Ok(())
}

/// A choice, or a call.
fn said_by_chance(watched: &Watched, rng: &mut impl Rng) -> Command {
    let state = watched.referee.state();
    match (state.options.as_slice(), state.on_table.as_slice()) {
        ([_, ..], _) => Command::Choose(CHOICES[rng.random_range(0..CHOICES.len())]),
        (_, [_, ..]) if rng.random_bool(0.8) => {
            let ball = state.on_table[rng.random_range(0..state.on_table.len())];
            let pocket = PocketId::ALL[rng.random_range(0..6)];
            Command::Call(Call::Ball { ball, pocket: rng.random_bool(0.9).then_some(pocket) })
        }
        _ => Command::Call(Call::Kind(CallKind::Safety)),
    }
}

/// Whether the tables have a word for it: balls of another game, a cue ball that meets itself, and
/// a ball that goes a second time in one shot are for other tests.
fn has_meaning(what: &FactKind, heard: &[Fact]) -> bool {
    let is_gone = |ball: BallId| {
        heard.iter().any(|fact| match fact.kind {
            FactKind::BallPocketed { ball: gone, .. } | FactKind::BallOffTable { ball: gone } => {
                gone == ball
            }
            _ => false,
        })
    };
    let is_ball = |ball: BallId| ball.0 <= 15;
    match *what {
        FactKind::BallsCollided { a, b, .. } => a != b && is_ball(a) && is_ball(b),
        FactKind::BallPocketed { ball, .. } | FactKind::BallOffTable { ball } => {
            is_ball(ball) && !is_gone(ball)
        }
        FactKind::BallPlaced { ball, .. }
        | FactKind::CueBallStruck { ball, .. }
        | FactKind::CushionHit { ball, .. }
        | FactKind::HeadStringCrossed { ball }
        | FactKind::BallTouched { ball, .. } => is_ball(ball),
        // Carom alone has a word for balls that lie together.
        FactKind::BallsFrozen { .. } => false,
        FactKind::Settled { .. } => true,
    }
}

fn report(kind: GameKind, met: &Met, start: Instant) {
    let rate = met.events as f64 / start.elapsed().as_secs_f64().max(1e-9);
    let Met { shots, games, events, choices, .. } = met;
    println!("{kind}: {shots} shots of {events} events, {games} games ended, {choices} choices");
    println!("{kind}: {rate:.0} events/s; by row: {:?}", met.rows);
}

fn check_rows(kind: GameKind, met: &Met) {
    let rows = match kind {
        GameKind::WpaEightBall => &WPA_ROWS[..],
        _ => &PAPER_ROWS,
    };
    for row in rows {
        let count = met.rows.get(row).copied().unwrap_or(0);
        assert!(count >= ROW_LEAST, "{kind}: '{row}' was met {count} times: {:?}", met.rows);
    }
    let is_known = |row: &&&'static str| rows.contains(row);
    assert_eq!(met.rows.keys().filter(is_known).count(), met.rows.len(), "a row without a name");
}
