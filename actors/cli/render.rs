//! `hapticbillard render`: one picture without a window.

pub mod bench;

pub mod film;

#[cfg(feature = "renderer")]
mod thought;

use super::{Status, not_negative, size};
use clap::{Args, ValueEnum};
use glam::DVec3;
use hapticbillard::picture::Preset;
use hapticbillard::scene::Entrant;
use hapticbillard_actors::error::Error;
use std::io::Write;
use std::path::PathBuf;
#[cfg(feature = "renderer")]
use {
    super::replay::read_recording,
    hapticbillard::cue::{Aim, CuePose},
    hapticbillard::events::FactSet,
    hapticbillard::ids::BallId,
    hapticbillard::input::{CameraPose, HumanMode, HumanView, first_met},
    hapticbillard::physics::Snapshot,
    hapticbillard::picture::{PictureSettings, Smoothing},
    hapticbillard::renderer::{DrawList, Hud, Radii, draw_thoughts, draw_vectors},
    hapticbillard::replay::Recording,
    hapticbillard::scene::Overrides,
    hapticbillard_actors::files::{load_scene, write_whole},
    hapticbillard_actors::game::Stage,
    hapticbillard_actors::renderer::png,
    thought::Thought,
};

const EXAMPLE: &str = "\
Examples:
  hapticbillard render --scene eight_ball --out table.png
  hapticbillard render --scene break_shot --at 0.4 --size 1920x1080 --out break.png
  hapticbillard render --scene break_shot --at 0.5 --options shadows=volumes,triangles=5120 \\
    --eye -0.4,-0.3,0.2 --target 0.6,0,0 --out volumes.png
  hapticbillard render --scene eight_ball --aim 2.5 --preset high --out aim.png
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

    #[command(flatten)]
    pub picture: PictureArgs,

    /// Where the picture is taken from; with --thoughts from above.
    #[arg(long, value_enum)]
    pub from: Option<Eye>,

    /// The eye in metres: x along the table, y across it, z above the cloth.
    #[arg(long, value_name = "X,Y,Z", value_parser = place, conflicts_with = "from")]
    #[arg(allow_hyphen_values = true)]
    pub eye: Option<DVec3>,

    /// What the eye looks at, in metres; the middle of the table unless it is said.
    #[arg(long, value_name = "X,Y,Z", value_parser = place, requires = "eye")]
    #[arg(allow_hyphen_values = true)]
    pub target: Option<DVec3>,

    /// Vertical field of view.
    #[arg(long, value_name = "DEGREES", value_parser = field_of_view)]
    pub fov: Option<f64>,

    /// Somebody aims with the cue at the cue ball, in this direction; the eye is behind the cue.
    #[arg(long, value_name = "DEGREES", conflicts_with = "thoughts")]
    #[arg(allow_negative_numbers = true)]
    pub aim: Option<f64>,

    /// Arrows at balls: velocity blue, axis of spin green, slip on the cloth violet.
    #[arg(long)]
    pub vectors: bool,

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

    /// Prints the summary as a JSON line.
    #[arg(long)]
    pub json: bool,
}

/// How pictures are drawn.
#[derive(Debug, Clone, Args)]
pub struct PictureArgs {
    /// How much a picture may cost: very_low, low, medium, high or very_high.
    #[arg(long, value_name = "NAME", value_parser = preset)]
    pub preset: Option<Preset>,

    /// What is otherwise than that, as in shadows=volumes,triangles=5120.
    #[arg(long, value_name = "KEY=VALUE,..", value_delimiter = ',', num_args = 1)]
    pub options: Vec<String>,
}

#[cfg(feature = "renderer")]
impl PictureArgs {
    /// What is asked for; smooth edges if nothing else is, because a file is drawn once.
    pub fn settings(&self) -> Result<PictureSettings, Error> {
        let usual = PictureSettings { smooth: Smoothing::On, ..PictureSettings::default() };
        let mut settings = self.preset.map_or(usual, |preset| preset.applied(usual));
        for option in &self.options {
            settings.read(option).map_err(|error| {
                Error::input("--options", error.to_string(), "`render --help` has an example")
            })?;
        }
        Ok(settings)
    }
}

fn preset(text: &str) -> Result<Preset, String> {
    let known = Preset::ALL.into_iter().find(|preset| preset.key() == text);
    known.ok_or_else(|| format!("there are {}", Preset::ALL.map(Preset::key).join(", ")))
}

/// Where a picture is taken from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Eye {
    /// Over the head of the table.
    Head,
    /// Straight above.
    Above,
}

/// Three numbers.
fn place(text: &str) -> Result<DVec3, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    match numbers.as_deref() {
        Ok(&[x, y, z]) if [x, y, z].iter().all(|number: &f64| number.abs() < 100.0) => {
            Ok(DVec3::new(x, y, z))
        }
        _ => Err("write three numbers below 100, as in -2.6,-1.1,1.5".into()),
    }
}

fn field_of_view(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(degrees) if (1.0..=150.0).contains(&degrees) => Ok(degrees),
        _ => Err("write a number from 1 to 150".into()),
    }
}

/// The name of a picture, which is a PNG file whatever its name says.
fn png_name(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    match path.extension() {
        Some(ending) if ending.eq_ignore_ascii_case("png") => Ok(path),
        _ => Err(String::from("pictures are PNG files: write a name that ends in .png")),
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

/// The radii of a stage's balls, and how they look.
#[cfg(feature = "renderer")]
pub fn radii(stage: &Stage) -> Result<Radii, Error> {
    let balls = stage.scene.build_balls(&stage.table)?;
    Ok(Radii::new(balls.iter().map(|(ball, _)| (ball.id, ball.radius_m)))
        .with_set(stage.scene.equipment().into()))
}

/// The eye.
#[cfg(feature = "renderer")]
fn eye(args: &RenderArgs, stage: &Stage) -> CameraPose {
    let length_m = stage.table.bed.map_or(2.54, |bed| bed.length_m);
    let field_of_view_rad =
        args.fov.map_or(CameraPose::default().field_of_view_rad, f64::to_radians);
    if let Some(eye) = args.eye {
        let target = args.target.unwrap_or_default();
        return CameraPose { eye, target, field_of_view_rad };
    }
    CameraPose { field_of_view_rad, ..usual_eye(args, length_m) }
}

#[cfg(feature = "renderer")]
fn usual_eye(args: &RenderArgs, length_m: f64) -> CameraPose {
    let above = CameraPose::above(length_m);
    // Beside the table is room for what is written about thoughts.
    let aside = above.aside(0.165 * length_m);
    match (args.from, args.thoughts) {
        (Some(Eye::Above) | None, Some(_)) => aside,
        (Some(Eye::Above), None) => above,
        (Some(Eye::Head), _) | (None, None) => CameraPose::default(),
    }
}

/// Somebody aims, with the cue a hand's breadth behind the cue ball.
#[cfg(feature = "renderer")]
fn aim(
    azimuth_deg: f64,
    args: &RenderArgs,
    world: &mut Snapshot,
    view: &mut HumanView,
    (stage, radii): (&Stage, &Radii),
) -> Result<(), Error> {
    const BEHIND_M: f64 = 0.06;
    let ball = world.on_table().find(|ball| ball.id == BallId::CUE).ok_or_else(|| {
        Error::input("--aim", "there is no cue ball on the table", "choose another scene")
    })?;
    let (centre, radius_m) = (ball.position, radii.of(BallId::CUE));
    let aim = Aim {
        azimuth_rad: azimuth_deg.to_radians(),
        elevation_rad: 0.09,
        side_offset: 0.0,
        height_offset: 0.0,
    };
    let direction = aim.direction();
    let tip = aim.tip_pulled_back(centre, radius_m, BEHIND_M);
    world.cue = Some(CuePose { tip, velocity: DVec3::ZERO, direction, solid: false });
    let level = direction.truncate().normalize_or_zero();
    if let Some((ghost, heading)) =
        first_met(world, stage.table.bed.as_ref(), BallId::CUE, centre, level)
    {
        (view.ghost, view.object_heading) = (Some(ghost), heading);
    }
    (view.mode, view.aim) = (HumanMode::Aiming, aim);
    if args.eye.is_none() && args.from.is_none() {
        view.camera.eye = centre - (level * 0.75).extend(0.0) + DVec3::Z * 0.36;
        view.camera.target = centre + (level * 0.35).extend(0.0);
    }
    Ok(())
}

/// Renders.
#[cfg(feature = "renderer")]
pub fn run(args: &RenderArgs, out: &mut dyn Write) -> Result<Status, Error> {
    let mut picture = args.picture.settings()?;
    picture.vectors |= args.vectors;
    let (stage, recording) = stage(args)?;
    let mut radii = radii(&stage)?;
    radii.mark(picture.marks);
    let mut view = HumanView { camera: eye(args, &stage), ..HumanView::default() };
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
            let mut world = simulation.snapshot(args.at);
            if let Some(azimuth_deg) = args.aim {
                aim(azimuth_deg, args, &mut world, &mut view, (&stage, &radii))?;
            }
            let mut list = DrawList::new(&world, &view, &radii);
            if picture.vectors {
                draw_vectors(&world, &radii, &mut list);
            }
            (list, Hud::default(), args.at)
        }
    };
    let file = png(&stage.table, &list, &written, &picture, args.size)?;
    write_whole(&args.out, &file)?;
    let (width, height) = args.size;
    let (balls, bytes) = (list.balls.len(), file.len());
    if args.json {
        let summary = Summary { out: &args.out, width, height, time_s, balls, bytes };
        super::json_line(out, &serde_json::json!({ "summary": summary }))?;
    } else {
        let path = args.out.display();
        writeln!(out, "{path}: {width} x {height} pixels, {balls} balls, at {time_s} s")?;
    }
    Ok(Status::Success)
}

/// Says that there is nothing to render with.
#[cfg(not(feature = "renderer"))]
pub fn run(_: &RenderArgs, _: &mut dyn Write) -> Result<Status, Error> {
    no_pictures("render")
}

#[cfg(not(feature = "renderer"))]
fn no_pictures(command: &str) -> Result<Status, Error> {
    let fix = "build it with the feature `renderer`, which is there by default";
    Err(Error::input(command, "this build draws no pictures", fix))
}
