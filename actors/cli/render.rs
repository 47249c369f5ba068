//! `hapticbillard render`: one picture without a window.

use super::{Status, not_negative, size};
use clap::Args;
use hapticbillard_actors::error::Error;
use std::io::Write;
use std::path::PathBuf;

const EXAMPLE: &str = "\
Examples:
  hapticbillard render --scene eight_ball --out table.png
  hapticbillard render --scene break_shot --at 0.4 --size 1920x1080 --out break.png";

/// Renders one picture of a scene into a PNG file, without a window.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct RenderArgs {
    /// A shipped scene (see `scenes`) or a scene file.
    #[arg(long, value_name = "SCENE")]
    pub scene: String,

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

/// Renders.
#[cfg(feature = "renderer")]
pub fn run(args: &RenderArgs, out: &mut dyn Write) -> Result<Status, Error> {
    use hapticbillard::events::FactSet;
    use hapticbillard::input::HumanView;
    use hapticbillard::renderer::{DrawList, Radii};
    use hapticbillard_actors::files::{load_scene, write_whole};
    use hapticbillard_actors::game::Stage;
    use hapticbillard_actors::renderer::png;

    let stage = Stage::new(&load_scene(&args.scene)?, &args.scene)?;
    let mut simulation = stage.simulation()?;
    simulation.advance(args.at, FactSet::NONE, &mut Vec::new())?;
    let world = simulation.snapshot(args.at);
    let balls = stage.scene.build_balls(&stage.table)?;
    let radii = Radii::new(balls.iter().map(|(ball, _)| (ball.id, ball.radius_m)))
        .with_set(stage.scene.equipment().into());
    let list = DrawList::new(&world, &HumanView::default(), &radii);
    let file = png(&stage.table, &list, args.size)?;
    write_whole(&args.out, &file)?;
    let (width, height) = args.size;
    let (balls, bytes) = (list.balls.len(), file.len());
    if args.json {
        let summary = Summary { out: &args.out, width, height, time_s: args.at, balls, bytes };
        super::json_line(out, &serde_json::json!({ "summary": summary }))?;
    } else {
        let path = args.out.display();
        writeln!(out, "{path}: {width} x {height} pixels, {balls} balls, at {} s", args.at)?;
    }
    Ok(Status::Success)
}

/// Says that there is nothing to render with.
#[cfg(not(feature = "renderer"))]
pub fn run(_: &RenderArgs, _: &mut dyn Write) -> Result<Status, Error> {
    let fix = "build it with the feature `renderer`, which is there by default";
    Err(Error::input("render", "this build draws no pictures", fix))
}
