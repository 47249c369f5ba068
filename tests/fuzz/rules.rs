//! Random facts, calls and choices, in possible and impossible orders, fed to the referee of every
//! game.
//!
//! `FUZZ_SEED` and `FUZZ_EVENTS` set where the run begins and how long it is (for each game); a
//! failure names the seed of its game. What holds is checked against an account of the game that is
//! kept here.

/// What must hold in every game.
mod account;
/// Judges that are wrong in one point.
mod canaries;
/// Small games, all of them.
mod enumerate;
/// What must hold in the games of the paper.
mod paper;
/// One game of random events.
pub mod play;
/// What must hold in nine-ball and straight pool.
mod pool;
/// Shots as good players make them.
mod script;
/// A second judge of eight-ball.
mod second;

use super::generator::number;
use hapticbillard::rules::{Console, GameKind, game};
use play::{Tally, play};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

#[test]
fn the_referee_keeps_its_rules_whatever_happens() {
    let first = number("FUZZ_SEED", 1);
    let events = number("FUZZ_EVENTS", 150_000);
    for kind in GameKind::ALL {
        let (mut seed, mut tally) = (first, Tally::default());
        while tally.events < events {
            let mut rng = Pcg64Mcg::seed_from_u64(seed);
            match play(kind, game(kind).judge, &mut rng) {
                Ok(game_tally) => tally.add(game_tally),
                Err(problem) => panic!("FUZZ_SEED={seed} {kind}: {problem}"),
            };
            seed += 1;
        }
        println!("{kind}: {tally:?}");
        // The generator must reach the corners, or nothing was tested.
        if events >= 150_000 {
            check_corners(kind, &tally);
        }
    }
}

fn check_corners(kind: GameKind, tally: &Tally) {
    let met = |what: &str, count: u64, least: u64| {
        assert!(count >= least, "{kind} met too little, {what}: {tally:?}");
    };
    met("verdicts", tally.verdicts, 500);
    met("shuffled", tally.shuffled, 100);
    match kind {
        GameKind::FreePlay => met("draws", tally.draws, 1),
        GameKind::Training => met("racks", tally.racks, 1),
        GameKind::PaperEightBall => {
            met("fouls", tally.fouls, 100);
            met("wins", tally.wins, 10);
            met("draws", tally.draws, 2);
            met("assigned", tally.assigned, 10);
            met("spotted", tally.spotted, 10);
        }
        GameKind::Snooker => {
            met("fouls", tally.fouls, 100);
            met("wins", tally.wins, 1);
            met("choices", tally.choices, 10);
            met("points", tally.points, 100);
            met("spotted", tally.spotted, 100);
        }
        GameKind::ThreeCushion | GameKind::FreeCarom => {
            met("fouls", tally.fouls, 100);
            met("wins", tally.wins, 10);
            met("points", tally.points, 100);
            met("spotted", tally.spotted, 100);
            met("choices", tally.choices, 10);
        }
        GameKind::WpaEightBall => {
            met("fouls", tally.fouls, 100);
            met("wins", tally.wins, 10);
            met("assigned", tally.assigned, 10);
            met("choices", tally.choices, 10);
            met("calls", tally.calls, 100);
            met("racks", tally.racks, 10);
        }
        GameKind::WpaNineBall => {
            met("fouls", tally.fouls, 100);
            met("wins", tally.wins, 10);
            met("spotted", tally.spotted, 10);
            met("choices", tally.choices, 10);
            met("calls", tally.calls, 10);
        }
        GameKind::Straight => {
            met("fouls", tally.fouls, 100);
            met("points", tally.points, 100);
            met("spotted", tally.spotted, 100);
            met("choices", tally.choices, 10);
            met("calls", tally.calls, 100);
            met("racks", tally.racks, 10);
        }
    }
}

/// Whatever is typed, the console answers or says what it dislikes, and then stands where it stood.
#[test]
fn the_console_survives_any_line() {
    let good = [
        r#"{"t":0,"e":"tip","ball":"0","push":true,"player":2}"#,
        r#"{"t":0.2,"e":"hit","a":"0","b":"1","in_kitchen":false}"#,
        r#"{"t":0.3,"e":"cushion","ball":"1","rail":"foot","onset":false}"#,
        r#"{"t":0.4,"fact":"BallPocketed","ball":"8","pocket":"FL"}"#,
        r#"{"state":{"player":2,"groups":{"1":"solids","2":"stripes"},"on_table":["8","9"]}}"#,
        r#"{"t":1e3,"e":"settle","snookered":true}"#,
        r#"{"t":0,"e":"place","ball":"0","zone":"kitchen","ok":true}"#,
    ];
    let seed = number("FUZZ_SEED", 1);
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    let mut console = Console::new(GameKind::PaperEightBall);
    let (mut heard, mut refused) = (0, 0);
    for _ in 0..20_000 {
        let mut line = good[rng.random_range(0..good.len())].as_bytes().to_vec();
        for _ in 0..rng.random_range(0..4) {
            let at = rng.random_range(0..line.len());
            match rng.random_range(0..4) {
                0 => line[at] = rng.random(),
                1 => line.truncate(at + 1),
                2 => line.insert(at, b"{}[]\",:019-.e"[rng.random_range(0..13)]),
                _ => drop(line.remove(at)),
            }
            if line.is_empty() {
                break;
            }
        }
        let before = console.answer();
        match console.feed_line(&String::from_utf8_lossy(&line)) {
            Ok(answer) => heard += u32::from(answer.heard),
            Err(error) => {
                refused += 1;
                assert!(error.to_string().starts_with("line "), "FUZZ_SEED={seed}: {error}");
                assert_eq!(console.answer(), before, "FUZZ_SEED={seed}: {error}");
            }
        }
    }
    assert!(heard > 1000 && refused > 1000, "FUZZ_SEED={seed}: {heard} heard, {refused} refused");
}
