//! `hapticbillard match`: games without a window.

use super::in_order::in_order;
use super::racks::{self, Rack, Racks};
use super::{Driver, Status, json_line, not_negative, progress};
use clap::Args;
use hapticbillard::hash::Digest;
use hapticbillard::ids::{GameKind, PlayerId};
use hapticbillard::replay::TickHash;
use hapticbillard::scene::Entrant;
use hapticbillard::tally::{Account, Tally, wilson};
use hapticbillard_actors::error::Error;
use hapticbillard_actors::pacer::describe;
use serde::Serialize;
use std::io::Write;
use std::ops::ControlFlow;
use std::path::PathBuf;

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

    /// The two players, in place of the scene's, as for `tournament`; the first breaks in the
    /// first game.
    #[arg(long, value_name = "A,B", value_delimiter = ',', num_args = 1)]
    pub players: Vec<Entrant>,

    /// Noise of the players' strokes, in multiples of the Computer Pool Olympiad's, in place of the
    /// scene's.
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
    /// Shots that were meant to pocket a ball, and those of them that did without a foul.
    aimed: [u32; 2],
    made: [u32; 2],
    run_outs: u32,
}

/// Plays the games.
pub fn run(args: &MatchArgs, out: &mut dyn Write) -> Result<Status, Error> {
    let stage = racks::stage(&args.scene, args.game)?;
    if args.players.len() == 1 || args.players.len() > 2 {
        let problem = format!("{} players given", args.players.len());
        return Err(Error::input("--players", problem, "give two, such as paper,paper"));
    }
    let racks = Racks {
        stage: &stage,
        game: args.game,
        seed: args.seed.unwrap_or(stage.scene.about.seed),
        players: args.players.clone(),
        noise: args.noise,
        driver: args.driver,
        record: args.record.clone(),
        is_timed: args.timing,
    };
    racks.check()?;
    let bar = progress(u64::from(args.games), "games");
    let names: Vec<String> = stage.scene.players.iter().map(|player| player.name.clone()).collect();
    let mut summary = Summary { games: args.games, ..Summary::default() };
    let mut accounts = [Account::default(); 2];
    in_order(
        args.games,
        |game| racks.play(game),
        |game, result| {
            let Rack { finished, tally, cpu_ms_per_decision, wall_ms, .. } = result?;
            count(&mut summary, &mut accounts, &tally);
            bar.inc(1);
            let state_hash = finished.hash.as_ref().map(TickHash::all);
            if args.json {
                let line = GameLine {
                    game: game + 1,
                    players: &names,
                    tally: &tally,
                    ticks: finished.tick.0,
                    state_hash,
                    cpu_ms_per_decision,
                    wall_ms: args.timing.then_some(wall_ms),
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
                let took = match cpu_ms_per_decision {
                    Some(ms) => format!(", {wall_ms:.0} ms, {ms:.3} ms a decision"),
                    None => String::new(),
                };
                writeln!(
                    out,
                    "game {:>3}: {winner}; shots {a}-{b}, fouls {c}-{d}, balls \
                     {e}-{f}{clear}{took}",
                    game + 1
                )?;
            }
            out.flush()?;
            Ok(ControlFlow::Continue(()))
        },
    )?;
    bar.finish_and_clear();
    let wins = accounts.map(|account| account.wins);
    let intervals = wins.map(|won| wilson(won, wins[0] + wins[1]));
    summary.wins = wins.into();
    summary.interval95 = intervals.into();
    summary.add(&accounts);
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

impl Summary {
    fn add(&mut self, accounts: &[Account; 2]) {
        self.shots = accounts.map(|account| account.shots);
        self.fouls = accounts.map(|account| account.fouls);
        self.pots = accounts.map(|account| account.pots);
        self.aimed = accounts.map(|account| account.aimed);
        self.made = accounts.map(|account| account.made);
        self.run_outs = accounts.iter().map(|account| account.run_outs).sum();
    }
}

fn count(summary: &mut Summary, accounts: &mut [Account; 2], tally: &Tally) {
    match tally.winner {
        Some(_) => {}
        None if tally.over => summary.draws += 1,
        None => summary.stalled += 1,
    }
    for (account, player) in accounts.iter_mut().zip([PlayerId::ONE, PlayerId::TWO]) {
        *account += Account::of(tally, player);
    }
}
