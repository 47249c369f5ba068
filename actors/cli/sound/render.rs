//! `hapticbillard sound render`: what a game sounds like, as a WAV file.

mod facts;

use crate::cli::{Status, positive};
use clap::{ArgGroup, Args, ValueEnum};
use glam::Vec3;
use hapticbillard_actors::error::Error;
use std::io::Write;
use std::path::PathBuf;
#[cfg(feature = "sound")]
use {
    hapticbillard::sound::{MixSettings, Mode, Room},
    hapticbillard_actors::game::Stage,
    hapticbillard_actors::sound::{Plan, Score, Wiring},
    std::sync::Arc,
};

const EXAMPLE: &str = "\
The same mixer makes the file that plays in a game. A scene is played by its computer players, or
rolls until everything rests; a recording is played again. Both are mixed as the scene's [sound]
says; what is written here goes before. Facts are JSON lines as `simulate --json` prints them; only
with --sample are balls heard to roll and to land, and the samples should lie close together.
Without, a ball falls into a pocket or on the floor where it last touched something.

Examples:
  hapticbillard sound render --scene break_shot --out break.wav
  hapticbillard sound render --recording game.jsonl --seconds 60 --out game.wav
  hapticbillard simulate --scene break_shot --sample 0.005 --json > break.jsonl
  hapticbillard sound render --facts break.jsonl --listener=-2,0.5,0.8 --out break.wav
  hapticbillard sound render --facts break.jsonl --mode loudspeakers --no-room --out dry.wav";

/// The longest file [s].
#[cfg(feature = "sound")]
const LONGEST_S: f64 = 3600.0;
/// What is still heard after the last event [s].
#[cfg(feature = "sound")]
const TAIL_S: f64 = 1.5;

/// Mixes a game into a WAV file.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
#[command(group = ArgGroup::new("what").required(true))]
pub struct RenderArgs {
    /// A shipped scene (see `scenes`) or a scene file.
    #[arg(long, value_name = "SCENE", group = "what")]
    pub scene: Option<String>,

    /// A recorded game.
    #[arg(long, value_name = "FILE", group = "what")]
    pub recording: Option<PathBuf>,

    /// Facts, and samples where there are some, as JSON lines; `-` reads stdin.
    #[arg(long, value_name = "FILE", group = "what")]
    pub facts: Option<PathBuf>,

    /// The WAV file, in 24 bits.
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,

    /// What it is made for. Without it: what the scene says, else headphones.
    #[arg(long, value_enum)]
    pub mode: Option<ModeName>,

    /// Where it is heard from, in metres; the listener faces the middle of the table. Without it:
    /// at the head end.
    #[arg(long, value_name = "X,Y,Z", value_parser = place, allow_hyphen_values = true)]
    pub listener: Option<Vec3>,

    /// Frames a second.
    #[arg(long, value_name = "HZ", default_value_t = 48_000)]
    #[arg(value_parser = clap::value_parser!(u32).range(8_000..=192_000))]
    pub rate: u32,

    /// Ends after so many seconds of the game.
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    pub seconds: Option<f64>,

    /// Factor of the whole; 1 is as in the world: 127 dB at one metre are full scale. Without it:
    /// what the scene says, else 1.
    #[arg(long, value_name = "FACTOR", value_parser = positive)]
    pub volume: Option<f64>,

    /// Without the walls of a room, whatever the scene says.
    #[arg(long)]
    pub no_room: bool,

    /// A folder of recordings that stand in for the synthesis; `sound bank` shows their names.
    /// Without it: that of the scene.
    #[arg(long, value_name = "DIR")]
    pub recordings: Option<PathBuf>,

    /// Fixes everything random, in place of the scene's seed.
    #[arg(long, value_name = "N", conflicts_with = "recording")]
    pub seed: Option<u64>,

    /// Prints the summary as a JSON line.
    #[arg(long)]
    pub json: bool,
}

/// What a file is made for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ModeName {
    /// One channel an ear.
    Headphones,
    /// Two loudspeakers in front of the listener.
    Loudspeakers,
}

/// A place in metres, such as `-2,0,0.8`.
fn place(text: &str) -> Result<Vec3, String> {
    let numbers: Vec<f32> = text.split(',').filter_map(|part| part.trim().parse().ok()).collect();
    match numbers[..] {
        [x, y, z] if text.split(',').count() == 3 && [x, y, z].iter().all(|n| n.abs() < 1e3) => {
            Ok(Vec3::new(x, y, z))
        }
        _ => Err(String::from("expected three numbers in metres, such as -2,0,0.8")),
    }
}

/// Says that there is nothing to render with.
#[cfg(not(feature = "sound"))]
pub fn run(_: &RenderArgs, _: &mut dyn Write) -> Result<Status, Error> {
    let fix = "build it with the feature `sound`, which is there by default";
    Err(Error::input("sound render", "this build has no sound", fix))
}

/// Renders.
#[cfg(feature = "sound")]
pub fn run(args: &RenderArgs, out: &mut dyn Write) -> Result<Status, Error> {
    use hapticbillard::sound::{Mixer, Told};
    use hapticbillard_actors::sound::{bank, write_wave};

    let (score, asked) = score(args)?;
    let Asked { settings, recordings } = asked.with(args);
    let onsets = score.told.iter().filter(|(_, told)| matches!(told, Told::Start { .. })).count();
    let bank = bank(recordings.as_deref(), args.rate)?;
    let mut mixer = Mixer::new(settings, Arc::new(bank));
    mixer.set_listener(listener(args));
    let longest_s = args.seconds.unwrap_or(score.end_s + TAIL_S).min(LONGEST_S);
    let end = (longest_s * f64::from(args.rate)) as u64;
    let written = write_wave(&args.out, &mut mixer, score.told, end)?;
    let peak_dbfs = 20.0 * libm::log10(f64::from(written.peak).max(1e-9));
    if args.json {
        let summary = serde_json::json!({ "summary": {
            "out": args.out, "seconds": longest_s, "frames": written.frames, "rate_hz": args.rate,
            "onsets": onsets, "merged": written.work.merged, "stolen": written.work.stolen,
            "refused": written.work.refused, "late": written.work.late, "peak_dbfs": peak_dbfs,
        }});
        crate::cli::json_line(out, &summary)?;
    } else {
        let path = args.out.display();
        writeln!(out, "{path}: {longest_s:.1} s, {onsets} sounds, peak {peak_dbfs:.1} dBFS")?;
    }
    Ok(Status::Success)
}

#[cfg(feature = "sound")]
fn listener(args: &RenderArgs) -> hapticbillard::sound::Listener {
    use hapticbillard::sound::Listener;
    match args.listener {
        Some(eye) => Listener::looking(eye, -eye, Vec3::Z),
        None => Listener::default(),
    }
}

/// How it is mixed.
#[cfg(feature = "sound")]
struct Asked {
    settings: MixSettings,
    recordings: Option<PathBuf>,
}

#[cfg(feature = "sound")]
impl Asked {
    /// As a window plays this scene; one that asks for no sound is played by default.
    fn by_scene(stage: &Stage) -> Result<Self, Error> {
        let first = Arc::new(stage.simulation()?.snapshot(0.0));
        Ok(match stage.sound(first, 1.0)? {
            Some(Plan { wiring: Wiring { settings, recordings, .. }, .. }) => {
                Asked { settings, recordings }
            }
            None => Asked::by_default(),
        })
    }

    fn by_default() -> Self {
        let settings = MixSettings { room: Some(Room::CELLAR), ..MixSettings::default() };
        Asked { settings, recordings: None }
    }

    /// The same with what the command line says.
    fn with(self, args: &RenderArgs) -> Self {
        let settings = MixSettings {
            rate_hz: args.rate as f32,
            mode: match args.mode {
                Some(ModeName::Headphones) => Mode::Headphones,
                Some(ModeName::Loudspeakers) => Mode::Loudspeakers,
                None => self.settings.mode,
            },
            room: self.settings.room.filter(|_| !args.no_room),
            volume: args.volume.map_or(self.settings.volume, |volume| volume as f32),
            ..self.settings
        };
        Asked { settings, recordings: args.recordings.clone().or(self.recordings) }
    }
}

#[cfg(feature = "sound")]
fn score(args: &RenderArgs) -> Result<(Score, Asked), Error> {
    use crate::cli::replay::read_recording;
    use hapticbillard::scene::Overrides;
    use hapticbillard_actors::files::load_scene;
    use hapticbillard_actors::sound::score;

    let limit_s = args.seconds.unwrap_or(LONGEST_S).min(LONGEST_S);
    if let Some(file) = &args.recording {
        let recording = Arc::new(read_recording(file)?);
        let stage = Stage::of_recording(&recording)?;
        let asked = Asked::by_scene(&stage)?;
        return Ok((score(&stage, Some(recording), args.rate, limit_s)?, asked));
    }
    if let Some(name) = &args.scene {
        let stage = Stage::new(&load_scene(name)?, name)?;
        let stage = stage.with(Overrides { seed: args.seed, ..Overrides::default() });
        let asked = Asked::by_scene(&stage)?;
        return Ok((score(&stage, None, args.rate, limit_s)?, asked));
    }
    match &args.facts {
        Some(file) => {
            let score = facts::score(file, args.rate, args.seed.unwrap_or(0))?;
            Ok((score, Asked::by_default()))
        }
        // The command line sees to it that there is one of the three.
        None => Err(Error::input("sound render", "nothing to render", "write --scene SCENE")),
    }
}
