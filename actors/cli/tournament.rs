//! `hapticbillard tournament`: every player against every other one.

mod figure;

mod outcome;

mod pages;

mod plan;

mod table;

use super::in_order::in_order;
use super::racks::{self, Rack, Racks};
use super::{Driver, Status, json_line, not_negative, progress};
use clap::Args;
use hapticbillard::ids::GameKind;
use hapticbillard::scene::Entrant;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::game::Stage;
use indicatif::ProgressBar;
use outcome::{Outcome, RackLine, Standing};
use plan::{Match, Plan};
use std::io::Write;
use std::ops::ControlFlow;
use std::path::PathBuf;

const EXAMPLE: &str = "\
A player is KIND[:SIMULATIONS][@NOISE]: paper, club, champion, or a strength from 0 to 100; how many
shots it may simulate for a decision; the noise of its strokes in multiples of the Computer Pool
Olympiad's. For example paper@0.5, champion:2000, club:20@0, 70. Breaks alternate. Two runs with one
seed print the same bytes, unless --timing is given.

What is counted:
  success        shots meant to pocket a ball (called, or chosen by the player) whose ball fell into
                 its pocket without a foul; breaks are left out
  run-outs       racks won in a visit that pocketed eight balls or more
  break and run  racks won in the visit that began with the break, of all breaks
  from hand      visits begun with the cue ball in hand anywhere that won the rack
  safeties       shots meant to pocket nothing
  avoidable      fouls although the player had considered a shot that was none in any simulation;
                 paper does not simulate
Intervals are Wilson's at 95 % (1927), of decided racks. --until P ends a pairing when Wald's
sequential test (1945) decides whether its first player wins P of the decided racks: P - d against
P + d, with d = min(0.05, (1 - P) / 2) and 5 % errors either way. Unlike an interval, the test may
be looked at after each rack.

Examples:
  hapticbillard tournament --players champion:500,club,paper --racks 50
  hapticbillard tournament --players club,paper --noise 0,0.5,1,2,5 --out results/
  hapticbillard tournament --players champion,club --racks 400 --until 0.8 --json";

/// Lets every player play against every other one, without a window.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct TournamentArgs {
    /// Who plays, the one who is thought to be strongest first: KIND[:SIMULATIONS][@NOISE].
    #[arg(long, value_name = "A,B,..", value_delimiter = ',', num_args = 1, required = true)]
    pub players: Vec<Entrant>,

    /// How many racks each pairing plays, at most.
    #[arg(long, value_name = "N", default_value = "100",
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub racks: u32,

    /// Noise of all players' strokes who have none of their own; several are played one after
    /// another.
    #[arg(long, value_name = "X,..", value_delimiter = ',', num_args = 1, default_value = "1",
          value_parser = not_negative)]
    pub noise: Vec<f64>,

    /// Ends a pairing as soon as it is decided whether its first player wins this share of the
    /// racks; one number, or one for each pairing in the order of the table.
    #[arg(long, value_name = "P,..", value_delimiter = ',', num_args = 1)]
    pub until: Vec<f64>,

    /// A shipped scene (see `scenes`) or a scene file.
    #[arg(long, value_name = "SCENE", default_value = "eight_ball_headless")]
    pub scene: String,

    /// What is played, with its rack, in place of the scene's game; `rules --help` lists all.
    #[arg(long, value_name = "GAME")]
    pub game: Option<GameKind>,

    /// Fixes everything random, in place of the scene's seed.
    #[arg(long, value_name = "K")]
    pub seed: Option<u64>,

    /// Records every rack into a folder of its pairing in this one.
    #[arg(long, value_name = "DIR")]
    pub record: Option<PathBuf>,

    /// Writes tables and figures into this folder.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,

    /// The runtime; both give the same output.
    #[arg(long, value_enum, default_value = "lockstep")]
    pub driver: Driver,

    /// Prints JSON lines: one per rack, pairing and player, then the summary.
    #[arg(long)]
    pub json: bool,

    /// Also tells how long decisions took, in lockstep on one core each; two runs then differ.
    #[arg(long)]
    pub timing: bool,
}

/// Plays the tournament.
pub fn run(args: &TournamentArgs, out: &mut dyn Write) -> Result<Status, Error> {
    let plan = Plan::new(args)?;
    let stage = racks::stage(&args.scene, args.game)?;
    let bar = progress(plan.racks_at_most(), "racks");
    let mut outcomes = Vec::new();
    for (number, game) in plan.matches.iter().enumerate() {
        let place = format!("{}/{}", number + 1, plan.matches.len());
        bar.set_message(format!("{place} {} at noise {}", game.title(), game.noise));
        outcomes.push(play(args, &stage, game, &bar, out)?);
        // A pairing that ended early leaves racks that are not to come.
        bar.set_position((number as u64 + 1) * u64::from(args.racks));
    }
    bar.finish_and_clear();
    let standings = Standing::of_all(&plan, &outcomes);
    if args.json {
        for outcome in &outcomes {
            json_line(out, &serde_json::json!({ "pairing": outcome.line(args.timing) }))?;
        }
        for standing in &standings {
            json_line(out, &serde_json::json!({ "player": standing.line(args.timing) }))?;
        }
        json_line(out, &serde_json::json!({ "summary": outcome::Summary::of(&outcomes) }))?;
    } else {
        out.write_all(pages::on_screen(&outcomes, &standings, args.timing).as_bytes())?;
    }
    if let Some(folder) = &args.out {
        for file in pages::write(folder, args, &stage, &outcomes, &standings)? {
            if !args.json {
                writeln!(out, "{}", file.display())?;
            }
        }
    }
    let is_sound = outcomes.iter().all(|outcome| outcome.stalled == 0);
    Ok(if is_sound { Status::Success } else { Status::CheckFailed })
}

/// Plays the racks of one pairing at one noise.
fn play(
    args: &TournamentArgs,
    stage: &Stage,
    game: &Match,
    bar: &ProgressBar,
    out: &mut dyn Write,
) -> Result<Outcome, Error> {
    let racks = Racks {
        stage,
        game: args.game,
        seed: args.seed.unwrap_or(stage.scene.about.seed),
        players: game.players.to_vec(),
        noise: Some(game.noise),
        driver: args.driver,
        record: args.record.as_ref().map(|folder| folder.join(game.file_name())),
        is_timed: args.timing,
    };
    racks.check()?;
    let mut outcome = Outcome::new(game);
    in_order(
        args.racks,
        |rack| racks.play(rack),
        |number, result| {
            let rack: Rack = result?;
            outcome.add(&rack);
            bar.inc(1);
            if args.json {
                let line = RackLine::new(game, number, &rack);
                json_line(out, &serde_json::json!({ "rack": line }))?;
                out.flush()?;
            }
            Ok(if outcome.is_decided() {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            })
        },
    )?;
    Ok(outcome)
}
