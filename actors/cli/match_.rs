//! `hapticbillard match`: games without a window.

use super::in_order::in_order;
use super::{Driver, Status, json_line, not_negative, progress};
use clap::Args;
use hapticbillard::cast::seed_of;
use hapticbillard::hash::Digest;
use hapticbillard::ids::{GameKind, PlayerId};
use hapticbillard::replay::TickHash;
use hapticbillard::rules;
use hapticbillard::scene::{Overrides, PlayerKind};
use hapticbillard::tally::Tally;
use hapticbillard::tick::Finished;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::load_scene;
use hapticbillard_actors::game::{Headless, Stage, play_headless};
use hapticbillard_actors::pacer::describe;
use hapticbillard_actors::stopwatch::Stopwatch;
use serde::Serialize;
use std::io::Write;
use std::path::PathBuf;
use std::time::Instant;

const EXAMPLE: &str = "\
Prints a line per game and a total: who won, shots, fouls, balls pocketed, racks cleared in one
turn. Two runs with one seed print the same bytes, unless --timing is given.

A recording is named FILE.part until its game has ended; one that was cut off can be replayed as far
as it goes.

Examples:
  hapticbillard match --games 100 --seed 1
  hapticbillard match --game wpa-eight-ball --games 20 --seed 1
  hapticbillard match --games 10 --players champion,club --noise 0.5 --json
  hapticbillard match --games 3 --record games/";

/// Plays games without a window, as fast as possible.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct MatchArgs {
    /// A shipped scene (see `scenes`) or a scene file.
    #[arg(long, value_name = "SCENE", default_value = "eight_ball_headless")]
    pub scene: String,

    /// How many games.
    #[arg(long, value_name = "N", default_value = "1",
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub games: u32,

    /// What is played, with its rack, in place of the scene's game; `rules --help` lists all.
    #[arg(long, value_name = "GAME")]
    pub game: Option<GameKind>,

    /// Fixes everything random, in place of the scene's seed.
    #[arg(long, value_name = "K")]
    pub seed: Option<u64>,

    /// Kinds of the two players, in place of the scene's; the first breaks in the first game.
    /// paper, club, champion, or a strength from 0 to 100.
    #[arg(long, value_name = "A,B", value_delimiter = ',', num_args = 1)]
    pub players: Vec<PlayerKind>,

    /// Noise of both players' strokes, in multiples of their own, in place of the scene's.
    #[arg(long, value_name = "X", value_parser = not_negative)]
    pub noise: Option<f64>,

    /// Records every game into this folder.
    #[arg(long, value_name = "DIR")]
    pub record: Option<PathBuf>,

    /// The runtime; both give the same output.
    #[arg(long, value_enum, default_value_t)]
    pub driver: Driver,

    /// Prints JSON lines: one per game, then the summary.
    #[arg(long)]
    pub json: bool,

    /// Also tells how long decisions took; two runs then differ.
    #[arg(long)]
    pub timing: bool,
}

/// What a line of JSON says about one game.
#[derive(Serialize)]
struct GameLine<'a> {
    game: u32,
    players: &'a [String],
    #[serde(flatten)]
    tally: &'a Tally,
    ticks: u64,
    state_hash: Option<Digest>,
    #[serde(skip_serializing_if = "Option::is_none")]
    cpu_ms_per_decision: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    wall_ms: Option<f64>,
}

/// A value for each player, by the player's number.
#[derive(Default, Serialize)]
struct PerPlayer<T> {
    #[serde(rename = "1")]
    one: T,
    #[serde(rename = "2")]
    two: T,
}

impl<T> From<[T; 2]> for PerPlayer<T> {
    fn from([one, two]: [T; 2]) -> Self {
        PerPlayer { one, two }
    }
}

/// The totals of a match. Arrays hold player 1, then player 2, as in a line.
#[derive(Default, Serialize)]
struct Summary {
    games: u32,
    wins: PerPlayer<u32>,
    /// Wilson's 95 % interval of each player's chance to win a decided game.
    interval95: PerPlayer<[f64; 2]>,
    draws: u32,
    stalled: u32,
    shots: [u32; 2],
    fouls: [u32; 2],
    pots: [u32; 2],
    run_outs: u32,
}

/// Plays the games.
pub fn run(args: &MatchArgs, out: &mut dyn Write) -> Result<Status, Error> {
    let loaded = load_scene(&args.scene)?;
    let stage = Stage::new(&loaded, &args.scene)?.for_game(args.game)?;
    let scene = &stage.scene;
    let what = format!("--scene {}", args.scene);
    if scene.rules.is_none() || scene.players.len() != 2 {
        let fix = "choose a scene with [rules] and two [[player]], such as eight_ball_headless";
        return Err(Error::input(what, "a match needs rules and two players", fix));
    }
    if let Some(rules) = scene.rules
        && rules::game(rules.game).is_practice
    {
        let what = format!("{what} --game {}", rules.game);
        return Err(Error::input(what, "this game never ends", "play it in a window with `play`"));
    }
    let kinds = match args.players.len() {
        0 => scene.players.iter().map(|player| player.kind).collect(),
        _ => args.players.clone(),
    };
    if args.players.len() == 1 || args.players.len() > 2 {
        let problem = format!("{} players given", args.players.len());
        return Err(Error::input("--players", problem, "give two, such as paper,paper"));
    }
    if !kinds.iter().all(|kind| kind.is_computer()) {
        let fix = "add --players paper,paper, or play it in a window with `play`";
        return Err(Error::input(what, "a person plays in this scene", fix));
    }

    let seed = args.seed.unwrap_or(scene.about.seed);
    let bar = progress(u64::from(args.games), "games");
    let names: Vec<String> = scene.players.iter().map(|player| player.name.clone()).collect();
    let play = |game: u32| -> Result<(Finished, Tally, Took), Error> {
        let overrides = Overrides {
            game: args.game,
            seed: Some(seed_of(seed, u64::from(game))),
            // They break in turn.
            first_player: Some(PlayerId(1 + (game % 2) as u8)),
            players: kinds.clone(),
            noise: args.noise,
        };
        let file = format!("game_{:04}.jsonl", game + 1);
        let record = args.record.as_ref().map(|folder| folder.join(file));
        let stopwatch = args.timing.then(Stopwatch::default);
        let driver = args.driver.into();
        let how = Headless { driver, record, stopwatch: stopwatch.clone(), ..Headless::default() };
        let start = Instant::now();
        let (finished, tally) = play_headless(&stage.with(overrides), how)?;
        let took = Took {
            cpu_ms_per_decision: stopwatch.and_then(|watch| watch.cpu_ms_per_decision()),
            wall_ms: start.elapsed().as_secs_f64() * 1e3,
        };
        Ok((finished, tally, took))
    };
    let mut summary = Summary { games: args.games, ..Summary::default() };
    let mut wins = [0; 2];
    in_order(args.games, play, |game, result| {
        let (finished, tally, took) = result?;
        count(&mut summary, &mut wins, &tally);
        bar.inc(1);
        let state_hash = finished.hash.as_ref().map(TickHash::all);
        if args.json {
            let line = GameLine {
                game: game + 1,
                players: &names,
                tally: &tally,
                ticks: finished.tick.0,
                state_hash,
                cpu_ms_per_decision: took.cpu_ms_per_decision,
                wall_ms: args.timing.then_some(took.wall_ms),
            };
            json_line(out, &line)?;
        } else {
            let winner = match tally.winner {
                Some(player) => format!("{} wins", names[player.index()]),
                None if tally.over => "draw".into(),
                None => format!("no end: {}", describe(finished.end)),
            };
            let [[a, b], [c, d], [e, f]] = [tally.shots, tally.fouls, tally.pots];
            let clear = if tally.run_out { ", table run" } else { "" };
            let took = match took.cpu_ms_per_decision {
                Some(ms) => format!(", {:.0} ms, {ms:.3} ms a decision", took.wall_ms),
                None => String::new(),
            };
            writeln!(
                out,
                "game {:>3}: {winner}; shots {a}-{b}, fouls {c}-{d}, balls {e}-{f}{clear}{took}",
                game + 1
            )?;
        }
        Ok(out.flush()?)
    })?;
    bar.finish_and_clear();
    let intervals = interval95(wins);
    summary.wins = wins.into();
    summary.interval95 = intervals.into();
    if args.json {
        json_line(out, &serde_json::json!({ "summary": summary }))?;
    } else {
        let [a, b] = wins;
        let [[low, high], _] = intervals;
        writeln!(
            out,
            "{} {a} : {b} {} in {} games, {} drawn; {} wins {:.0} to {:.0} % (95 %)",
            names[0],
            names[1],
            args.games,
            summary.draws,
            names[0],
            low * 100.0,
            high * 100.0
        )?;
    }
    Ok(if summary.stalled == 0 { Status::Success } else { Status::CheckFailed })
}

/// How long a game took.
struct Took {
    cpu_ms_per_decision: Option<f64>,
    wall_ms: f64,
}

fn count(summary: &mut Summary, wins: &mut [u32; 2], tally: &Tally) {
    match tally.winner {
        Some(player) => wins[player.index()] += 1,
        None if tally.over => summary.draws += 1,
        None => summary.stalled += 1,
    }
    for seat in 0..2 {
        summary.shots[seat] += tally.shots[seat];
        summary.fouls[seat] += tally.fouls[seat];
        summary.pots[seat] += tally.pots[seat];
    }
    summary.run_outs += u32::from(tally.run_out);
}

/// Wilson's score interval at 95 % for each player (Wilson 1927).
fn interval95(wins: [u32; 2]) -> [[f64; 2]; 2] {
    const Z: f64 = 1.959_963_984_540_054;
    let n = f64::from(wins[0] + wins[1]);
    wins.map(|wins| {
        if n == 0.0 {
            return [0.0, 1.0];
        }
        let p = f64::from(wins) / n;
        let middle = (p + Z * Z / (2.0 * n)) / (1.0 + Z * Z / n);
        let half = Z / (1.0 + Z * Z / n) * (p * (1.0 - p) / n + Z * Z / (4.0 * n * n)).sqrt();
        [(middle - half).max(0.0), (middle + half).min(1.0)]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wilson_interval_of_eight_in_ten() {
        // Brown, Cai and DasGupta 2001 give 0.490 to 0.943.
        let [[low, high], _] = interval95([8, 2]);
        assert!((low - 0.490).abs() < 1e-3 && (high - 0.943).abs() < 1e-3, "{low} {high}");
    }
}
