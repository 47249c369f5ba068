//! `hapticbillard render`: one picture without a window.

#[cfg(feature = "renderer")]
mod thought;

use super::{Status, not_negative, size};
use clap::{Args, ValueEnum};
use glam::DVec3;
use hapticbillard::scene::Entrant;
use hapticbillard_actors::error::Error;
use std::io::Write;
use std::path::PathBuf;
#[cfg(feature = "renderer")]
use {
    super::replay::read_recording,
    hapticbillard::events::FactSet,
    hapticbillard::input::{CameraPose, HumanView},
    hapticbillard::renderer::{DrawList, Hud, Radii, draw_thoughts},
    hapticbillard::replay::Recording,
    hapticbillard::scene::Overrides,
    hapticbillard_actors::files::{load_scene, write_whole},
    hapticbillard_actors::game::Stage,
    hapticbillard_actors::renderer::{frame_times, png},
    thought::Thought,
};

const EXAMPLE: &str = "\
Examples:
  hapticbillard render --scene eight_ball --out table.png
  hapticbillard render --scene break_shot --at 0.4 --size 1920x1080 --out break.png
  hapticbillard render --scene free_play --eye=-3.9,-2.6,0.9 --target 1.5,1,0.2 --out room.png
  hapticbillard render --scene eight_ball_headless --thoughts 3 --out thoughts.png
  hapticbillard render --replay game.jsonl --thoughts 12 --from head --out thoughts.png";

/// Renders one picture of a scene into a PNG file, without a window.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct RenderArgs {
    /// A shipped scene (see `scenes`) or a scene file.
    #[arg(long, value_name = "SCENE", required_unless_present = "replay")]
    pub scene: Option<String>,

    /// A recorded game in place of a scene; with --thoughts.
    #[arg(long, value_name = "FILE", requires = "thoughts")]
    #[arg(conflicts_with_all = ["scene", "seed", "players"])]
    pub replay: Option<PathBuf>,

    /// Plays the game until computer players have decided on so many strokes, and shows what the
    /// last one saw: free and blocked ways, the shots it considered with their chances.
    #[arg(long, value_name = "N", num_args = 0..=1, default_missing_value = "1",
          conflicts_with = "at", value_parser = clap::value_parser!(u32).range(1..))]
    pub thoughts: Option<u32>,

    /// The players of that game, in place of the scene's, as for `tournament`.
    #[arg(long, value_name = "A,B", value_delimiter = ',', num_args = 1, requires = "thoughts")]
    pub players: Vec<Entrant>,

    /// Fixes everything random, in place of the scene's seed.
    #[arg(long, value_name = "K")]
    pub seed: Option<u64>,

    /// Where the picture is taken from; with --thoughts from above.
    #[arg(long, value_enum)]
    pub from: Option<Eye>,

    /// Where the eye is [m], in place of --from: along the table, to its left, above the cloth.
    #[arg(long, value_name = "X,Y,Z", conflicts_with = "from", value_parser = point)]
    #[arg(allow_hyphen_values = true)]
    pub eye: Option<DVec3>,

    /// What that eye looks at [m].
    #[arg(long, value_name = "X,Y,Z", requires = "eye", value_parser = point)]
    #[arg(allow_hyphen_values = true, default_value = "0,0,0")]
    pub target: DVec3,

    /// Size of the picture in pixels.
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = size)]
    pub size: (u32, u32),

    /// The PNG file.
    #[arg(long, value_name = "FILE", value_parser = png_name)]
    pub out: PathBuf,

    /// Lets the balls move for so many seconds first.
    #[arg(long, value_name = "SECONDS", default_value = "0", value_parser = not_negative)]
    #[arg(allow_negative_numbers = true)]
    pub at: f64,

    /// Draws the picture so many times more and says how long one takes, without smooth edges.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub frames: Option<u32>,

    /// Prints the summary as a JSON line.
    #[arg(long)]
    pub json: bool,
}

/// Where a picture is taken from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Eye {
    /// Over the head of the table.
    Head,
    /// Straight above.
    Above,
}

/// The name of a picture, which is a PNG file whatever its name says.
fn png_name(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    match path.extension() {
        Some(ending) if ending.eq_ignore_ascii_case("png") => Ok(path),
        _ => Err(String::from("pictures are PNG files: write a name that ends in .png")),
    }
}

/// A point in metres, such as `-2,0,0.5`.
fn point(text: &str) -> Result<DVec3, String> {
    let numbers: Vec<f64> = text.split(',').filter_map(|number| number.parse().ok()).collect();
    match numbers[..] {
        [x, y, z] if text.matches(',').count() == 2 && [x, y, z].iter().all(|x| x.abs() <= 1e3) => {
            Ok(DVec3::new(x, y, z))
        }
        _ => Err(String::from("expected three numbers of metres, such as -2,0,0.5")),
    }
}

/// What was written.
#[cfg(feature = "renderer")]
#[derive(serde::Serialize)]
struct Summary<'a> {
    out: &'a std::path::Path,
    width: u32,
    height: u32,
    time_s: f64,
    balls: usize,
    bytes: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    frame_ms: Option<Frames>,
}

/// How long one picture takes [ms].
#[cfg(feature = "renderer")]
#[derive(Clone, Copy, serde::Serialize)]
struct Frames {
    least: f64,
    median: f64,
}

#[cfg(feature = "renderer")]
impl Frames {
    fn of(mut times: Vec<std::time::Duration>) -> Option<Self> {
        times.sort();
        let ms = |time: &std::time::Duration| time.as_secs_f64() * 1e3;
        Some(Frames { least: ms(times.first()?), median: ms(times.get(times.len() / 2)?) })
    }
}

/// The game that is shown.
#[cfg(feature = "renderer")]
fn stage(args: &RenderArgs) -> Result<(Stage, Option<Recording>), Error> {
    if let Some(path) = &args.replay {
        let recording = read_recording(path)?;
        return Ok((Stage::of_recording(&recording)?, Some(recording)));
    }
    let scene = args.scene.as_deref().unwrap_or_default();
    let stage = Stage::new(&load_scene(scene)?, scene)?;
    let players = args.players.clone();
    Ok((stage.with(Overrides { seed: args.seed, players, ..Overrides::default() }), None))
}

/// The eye.
#[cfg(feature = "renderer")]
fn eye(args: &RenderArgs, stage: &Stage) -> CameraPose {
    if let Some(eye) = args.eye {
        return CameraPose { eye, target: args.target, ..CameraPose::default() };
    }
    let length_m = stage.table.bed.map_or(2.54, |bed| bed.length_m);
    let above = CameraPose::above(length_m);
    // Beside the table is room for what is written about thoughts.
    let aside = above.aside(0.165 * length_m);
    match (args.from, args.thoughts) {
        (Some(Eye::Above) | None, Some(_)) => aside,
        (Some(Eye::Above), None) => above,
        (Some(Eye::Head), _) | (None, None) => CameraPose::default(),
    }
}

/// Renders.
#[cfg(feature = "renderer")]
pub fn run(args: &RenderArgs, out: &mut dyn Write) -> Result<Status, Error> {
    let (stage, recording) = stage(args)?;
    let balls = stage.scene.build_balls(&stage.table)?;
    let radii = Radii::new(balls.iter().map(|(ball, _)| (ball.id, ball.radius_m)))
        .with_set(stage.scene.equipment().into());
    let view = HumanView { camera: eye(args, &stage), ..HumanView::default() };
    let (list, written, time_s) = match args.thoughts {
        Some(number) => {
            let thought = Thought::of(&stage, recording, number)?;
            let mut list = DrawList::new(&thought.table, &view, &radii);
            draw_thoughts(&thought.insight, &radii, &mut list);
            (list, thought.written(), thought.table.time_s)
        }
        None => {
            let mut simulation = stage.simulation()?;
            simulation.advance(args.at, FactSet::NONE, &mut Vec::new())?;
            let world = simulation.snapshot(args.at);
            (DrawList::new(&world, &view, &radii), Hud::default(), args.at)
        }
    };
    let file = png(&stage.table, &list, &written, args.size)?;
    write_whole(&args.out, &file)?;
    let (width, height) = args.size;
    let (balls, bytes) = (list.balls.len(), file.len());
    let frame_ms = match args.frames {
        Some(count) => Frames::of(frame_times(&stage.table, &list, args.size, count as usize)?),
        None => None,
    };
    if args.json {
        let summary = Summary { out: &args.out, width, height, time_s, balls, bytes, frame_ms };
        super::json_line(out, &serde_json::json!({ "summary": summary }))?;
    } else {
        let path = args.out.display();
        writeln!(out, "{path}: {width} x {height} pixels, {balls} balls, at {time_s} s")?;
        if let Some(Frames { least, median }) = frame_ms {
            writeln!(out, "one takes {median:.1} ms, {least:.1} ms at best")?;
        }
    }
    Ok(Status::Success)
}

/// Says that there is nothing to render with.
#[cfg(not(feature = "renderer"))]
pub fn run(_: &RenderArgs, _: &mut dyn Write) -> Result<Status, Error> {
    let fix = "build it with the feature `renderer`, which is there by default";
    Err(Error::input("render", "this build draws no pictures", fix))
}
