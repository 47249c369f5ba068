//! `hapticbillard [play]`: the game.

#[cfg(feature = "renderer")]
mod felt;
#[cfg(feature = "renderer")]
mod in_window;
#[cfg(feature = "renderer")]
mod kept_keys;
#[cfg(feature = "renderer")]
mod kept_settings;

use super::{Driver, Status, positive};
use clap::Args;
use hapticbillard::events::{Event, Source, Topic, Topics};
use hapticbillard::hash::StateHash;
use hapticbillard::ids::GameKind;
use hapticbillard::menu::GameChoice;
use hapticbillard::physics::Snapshot;
use hapticbillard::rules::{Language, Texts};
use hapticbillard::scene::{Overrides, Scene};
use hapticbillard::tally::Tally;
use hapticbillard::tick::{Delivered, Outcome, Participant};
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::{keep_newest, load_scene, new_recording_name, recordings_folder};
use hapticbillard_actors::game::{Headless, Stage, play_headless};
use hapticbillard_actors::pacer::{StopFlag, describe};
use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::OnceLock;

const EXAMPLE: &str = "\
Without a scene or a game the main menu opens; Escape opens a menu in a game. Without a display it
says so and plays eight_ball_headless with a live score. Every game is recorded in the user's data
folder, where the last 20 are kept; what is set in the menus stands in settings.toml in the user's
configuration folder.

Examples:
  hapticbillard                              the main menu
  hapticbillard play --scene training
  hapticbillard play --game wpa-eight-ball
  hapticbillard play --seed 3 --record game.jsonl
  hapticbillard play --scene haptic_touch --record-device hand.jsonl
  hapticbillard play --scene haptic_touch --telemetry touch.csv";

/// Plays a game in a window.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct PlayArgs {
    /// Begins at once with a shipped scene (see `scenes`) or a scene file.
    #[arg(long, value_name = "SCENE")]
    pub scene: Option<String>,

    /// What is played, with its rack, in place of the scene's game; `rules --help` lists all.
    #[arg(long, value_name = "GAME")]
    pub game: Option<GameKind>,

    /// Fixes everything random, in place of the scene's seed.
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,

    /// Records into this file instead of the data folder.
    #[arg(long, value_name = "FILE", conflicts_with = "no_record")]
    pub record: Option<PathBuf>,

    /// Records nothing.
    #[arg(long)]
    pub no_record: bool,

    /// Records what the haptic device says into this file, as JSON lines.
    #[arg(long, value_name = "FILE")]
    pub record_device: Option<PathBuf>,

    /// Writes every tick of the haptic device's servo into this file, as CSV.
    #[arg(long, value_name = "FILE")]
    pub telemetry: Option<PathBuf>,

    /// The runtime of a game without a window.
    #[arg(long, value_enum, default_value_t)]
    pub driver: Driver,

    /// Game time per real time; 1 is as in the world, 0.25 slow motion.
    #[arg(long, value_name = "FACTOR", default_value = "1", value_parser = positive)]
    #[arg(allow_negative_numbers = true)]
    pub speed: f64,
}

/// How many games are kept in the data folder.
const KEPT: usize = 20;

/// The scene of a game about which only other things are said.
const USUAL: &str = "eight_ball";
/// The scene that is played where there is no window.
const HEADLESS: &str = "eight_ball_headless";

/// Plays.
pub fn run(args: &PlayArgs, out: &mut dyn Write) -> Result<Status, Error> {
    let stage = match args.scene.as_deref() {
        None if args.opens_menu() => None,
        scene => Some(stage(args, scene.unwrap_or_else(|| usual_scene(args.game)))?),
    };
    if let Some(stage) = stage.as_ref().filter(|stage| stage.scene.renderer.is_none()) {
        return play_without_window(args, stage, out);
    }
    match play_in_window(args, stage, out)? {
        Ok(status) => Ok(status),
        Err(why) => {
            eprintln!("{why}: {HEADLESS} is played without a window");
            play_without_window(args, &self::stage(args, HEADLESS)?, out)
        }
    }
}

impl PlayArgs {
    /// Nothing is said about a single game.
    fn opens_menu(&self) -> bool {
        let PlayArgs { scene, game, seed, record, record_device, telemetry, .. } = self;
        scene.is_none()
            && game.is_none()
            && seed.is_none()
            && record.is_none()
            && record_device.is_none()
            && telemetry.is_none()
    }
}

/// The scene of a game for which no scene is given: one that begins with its balls and its table.
fn usual_scene(game: Option<GameKind>) -> &'static str {
    let Some(game) = game else { return USUAL };
    let is_of_game = |scene: &&str| {
        let text = hapticbillard::shipped::scene(scene).unwrap_or_default();
        let rules = Scene::parse(scene, text).ok().and_then(|scene| scene.rules);
        rules.is_some_and(|rules| rules.game == game)
    };
    GameChoice::ALL.map(GameChoice::scene).into_iter().find(is_of_game).unwrap_or(USUAL)
}

fn stage(args: &PlayArgs, scene: &str) -> Result<Stage, Error> {
    let stage = Stage::new(&load_scene(scene)?, scene)?.for_game(args.game)?;
    Ok(stage.with(Overrides { game: args.game, seed: args.seed, ..Overrides::default() }))
}

/// Where a game is recorded: the first one where the player says, others into the data folder.
fn recording(args: &PlayArgs, is_first: bool) -> Option<PathBuf> {
    if args.no_record {
        return None;
    }
    if is_first && args.record.is_some() {
        return args.record.clone();
    }
    match recordings_folder() {
        Ok(folder) => Some(folder.join(new_recording_name())),
        Err(error) => {
            tracing::warn!("the game is not recorded: {error}");
            None
        }
    }
}

/// Deletes old recordings, if this one went into the data folder.
fn tidy_up(args: &PlayArgs, path: Option<&PathBuf>) {
    if path == args.record.as_ref() {
        return;
    }
    if let Some(folder) = path.and_then(|path| path.parent())
        && let Err(error) = keep_newest(folder, KEPT)
    {
        tracing::warn!("{error}");
    }
}

/// Ends a game, or whatever looks at the flag, in order when somebody presses Ctrl-C.
pub fn stop_at_interrupt() -> StopFlag {
    // One handler for the whole program: who gets no window plays another game without one.
    static STOP: OnceLock<StopFlag> = OnceLock::new();
    let stop = STOP.get_or_init(|| {
        let stop = StopFlag::default();
        let flag = stop.clone();
        // Without a handler Ctrl-C ends the program at once, and leaves a recording without its
        // end.
        if let Err(error) = ctrlc::set_handler(move || flag.set()) {
            tracing::warn!("Ctrl-C will not end the game in order: {error}");
        }
        stop
    });
    stop.clone()
}

fn play_without_window(
    args: &PlayArgs,
    stage: &Stage,
    out: &mut dyn Write,
) -> Result<Status, Error> {
    if args.record_device.is_some() {
        let problem = "a game without a window has no haptic device";
        return Err(Error::input("--record-device", problem, "leave it out"));
    }
    if args.telemetry.is_some() {
        let problem = "without a window no haptic device is felt";
        return Err(Error::input("--telemetry", problem, "play a scene with [haptic] in a window"));
    }
    let record = recording(args, true);
    let names: Vec<String> = stage.scene.players.iter().map(|player| player.name.clone()).collect();
    let how = Headless {
        driver: args.driver.into(),
        record: record.clone(),
        observers: vec![Box::new(LiveScore::new(&names))],
        stop: stop_at_interrupt(),
        ..Headless::default()
    };
    let (finished, tally) = play_headless(stage, how)?;
    tidy_up(args, record.as_ref());
    match tally.winner {
        Some(player) => {
            let name = names.get(player.index()).map_or("", String::as_str);
            let shots: u32 = tally.shots.iter().sum();
            writeln!(out, "{name} wins after {shots} shots")?;
        }
        None => writeln!(out, "{}", describe(finished.end))?,
    }
    Ok(Status::Success)
}

/// Tells every shot on stderr as it is judged.
struct LiveScore {
    texts: Texts,
    names: Vec<String>,
    tally: Tally,
}

impl LiveScore {
    fn new(names: &[String]) -> Self {
        let texts = Texts::new(Language::English);
        let texts = match names {
            [one, two] => texts.with_names(one, two),
            _ => texts,
        };
        LiveScore { texts, names: names.to_vec(), tally: Tally::default() }
    }
}

impl Participant for LiveScore {
    fn source(&self) -> Source {
        Source::Runtime
    }

    fn topics(&self) -> Topics {
        Topics::of(&[Topic::Verdict])
    }

    fn start(&mut self, _: &Snapshot) -> Outcome {
        Outcome::default()
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        for stamped in delivered.events.iter() {
            if let Event::Verdict(verdict) = &stamped.event {
                self.tally.count(verdict);
                let shot: u32 = self.tally.shots.iter().sum();
                let player = verdict.player.and_then(|player| self.names.get(player.index()));
                let player = player.map_or("", String::as_str);
                let [a, b] = self.tally.pots;
                let said = self.texts.verdict(verdict);
                // Whoever reads no more ends no game.
                let _ = writeln!(io::stderr(), "shot {shot:>3}, balls {a}-{b}: {player}: {said}");
            }
        }
        Outcome::default()
    }

    fn hash(&self, _: &mut StateHash) {}
}

#[cfg(not(feature = "renderer"))]
fn play_in_window(
    _: &PlayArgs,
    _: Option<Stage>,
    _: &mut dyn Write,
) -> Result<Result<Status, String>, Error> {
    Ok(Err("this build has no window".into()))
}

#[cfg(feature = "renderer")]
use in_window::play_in_window;
#[cfg(feature = "renderer")]
pub use in_window::{has_display, replay_in_window};
