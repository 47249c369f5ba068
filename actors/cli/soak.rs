//! `hapticbillard soak`: game after game in one process, each held against lockstep.

mod games;
mod told;

use super::{Status, progress};
use clap::Args;
use games::Games;
use hapticbillard::hash::StateHash;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::game::LIMIT;
use hapticbillard_actors::runtime::Setup;
use hapticbillard_actors::soak::{self, Growth, Trial, Use, Victim, Wrong, faults};
use std::io::Write;
use std::path::PathBuf;
use std::time::{Duration, Instant};
use told::{Game, Told};

const EXAMPLE: &str = "\
Every game is played twice: in lockstep, and by actors on 1, 2 and 8 threads in turn. Facts,
verdicts, recording and state must be the same, to the bit. In between this looks at the memory, the
threads and the handles of its own process: they must not grow. Games are eight-ball by two rule
books and nine-ball, mostly of players that need no time to think.

--faults kills actors in the middle of games, makes them panic, stalls, delays and floods them, at
ticks that the seed says. The game must be the same then too; or, when somebody failed who must not
(physics, rules, event manager, conductor, an observer), stop in order with everything recorded up
to there. --jostle holds actors and threads up at random and changes their priorities.

What the process uses differs from run to run; `hash` is one number for all that happened in all
games, and is the same in every run, of every build.

Examples:
  hapticbillard soak --minutes 10
  hapticbillard soak --games 1000 --jostle
  hapticbillard soak --games 1000 --faults --seed 3
  hapticbillard soak --games 1 --first 417 --faults --seed 3     one of them again";

/// Plays games for hours and looks for what differs, hangs or grows.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct SoakArgs {
    /// How many games.
    #[arg(long, value_name = "N", conflicts_with = "minutes",
          value_parser = clap::value_parser!(u64).range(1..=100_000_000))]
    pub games: Option<u64>,

    /// How long, if not so many games; 1 if neither is said.
    #[arg(long, value_name = "M", value_parser = super::positive)]
    pub minutes: Option<f64>,

    /// Fixes everything random.
    #[arg(long, value_name = "K", default_value_t = 1)]
    pub seed: u64,

    /// The game to begin with, counted from 0.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub first: u64,

    /// Actors are killed, stalled and flooded.
    #[arg(long)]
    pub faults: bool,

    /// Threads are held up and change their priorities.
    #[arg(long)]
    pub jostle: bool,

    /// Threads of the runtime, in turn.
    #[arg(long, value_name = "N,..", value_delimiter = ',', num_args = 1, default_value = "1,2,8",
          value_parser = clap::value_parser!(u16).range(1..=64))]
    pub workers: Vec<u16>,

    /// Prints JSON lines: one per game, then the summary.
    #[arg(long)]
    pub json: bool,
}

/// Plays the games.
pub fn run(args: &SoakArgs, out: &mut dyn Write) -> Result<Status, Error> {
    let games = Games::new(args.seed)?;
    let time = args.minutes.or(args.games.is_none().then_some(1.0));
    let time = time.map(|minutes| Duration::from_secs_f64(60.0 * minutes));
    let (begin, folder) = (Instant::now(), Scratch::new());
    let bar = match (args.games, time) {
        (Some(count), _) => progress(count, "games"),
        (None, time) => progress(time.unwrap_or_default().as_secs(), "seconds"),
    };
    let mut told = Told::new(args.json);
    let mut all = StateHash::new();
    let mut moments = Vec::new();
    for number in args.first.. {
        let count = number - args.first;
        let is_late = time.is_some_and(|time| time <= begin.elapsed());
        if args.games.is_some_and(|games| games <= count) || (is_late && 0 < count) {
            break;
        }
        let (stage, seed) = games.at(number)?;
        let reference = soak::reference(&stage, seed, LIMIT)?;
        reference.seen.events.iter().for_each(|event| all.u64(event.0));
        let workers = args.workers[(number % args.workers.len() as u64) as usize];
        let planned = match args.faults {
            true => faults(seed, reference.seen.batches, &Victim::ALWAYS),
            false => Vec::new(),
        };
        let trial = Trial {
            seed,
            workers: workers.into(),
            physics_thread: number % 2 == 1,
            is_jostled: args.jostle,
            faults: planned,
        };
        let file = folder.0.join(format!("game-{number}.jsonl"));
        let base = Setup::headless(LIMIT);
        let played = soak::play(&stage, &reference, &trial, &file, base);
        told.game(&Game { number, workers, reference: &reference, played: &played }, out)?;
        let least = moments.iter().map(|moment: &Use| moment.threads).min();
        moments.extend(Use::settled(least.unwrap_or(usize::MAX)));
        match args.games {
            Some(_) => bar.inc(1),
            None => bar.set_position(begin.elapsed().as_secs()),
        }
        // Its threads are still there: what comes after would be disturbed by more than was
        // planned.
        if matches!(played.ended, Err(Wrong::Hangs)) {
            break;
        }
    }
    bar.finish_and_clear();
    told.end(all.finish(), Growth::over(&moments), begin.elapsed(), out)
}

/// Where games are recorded: gone afterwards, unless something is in it that was wrong.
struct Scratch(PathBuf);

impl Scratch {
    fn new() -> Self {
        Scratch(std::env::temp_dir().join(format!("hapticbillard-soak-{}", std::process::id())))
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        hapticbillard_actors::files::remove_if_empty(&self.0);
    }
}
