//! `hapticbillard bench-render`: the paper's tables of frames per second (section 4.4.1).

use super::super::{Status, not_negative, size};
use clap::Args;
use hapticbillard_actors::error::Error;
use std::io::Write;
use std::path::PathBuf;

const EXAMPLE: &str = "\
As in the paper: a shot that is the same every time, the whole table in the picture, neither limit
nor smooth edges, and settings that touch the balls only; then the presets. While the eye rests,
table and room are drawn once; `--moving` measures what a moving eye costs. Every row is measured in
turn, again and again, so that a busy machine is not busy for one of them alone. A picture counts
from its begin until the graphics card has drawn it; it is not shown.

Examples:
  hapticbillard bench-render --out bench.md
  hapticbillard bench-render --moving --only medium
  hapticbillard bench-render --size 640x400 --rounds 5 --json";

/// How far an eye that moves does so from picture to picture [m].
#[cfg(feature = "renderer")]
const MOVED_M: f64 = 1e-4;

/// Measures how long pictures take with which settings: the paper's tables.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct BenchRenderArgs {
    /// A shipped scene (see `scenes`) or a scene file whose balls roll.
    #[arg(long, value_name = "SCENE", default_value = "break_shot")]
    pub scene: String,

    /// Size of the pictures in pixels; the paper's unless it is said.
    #[arg(long, value_name = "WxH", default_value = "1440x900", value_parser = size)]
    pub size: (u32, u32),

    /// How often every row is measured.
    #[arg(long, value_name = "N", default_value = "6")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..))]
    pub rounds: u32,

    /// Pictures of a row in a round.
    #[arg(long, value_name = "N", default_value = "10")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..))]
    pub frames: u32,

    /// Seconds of the game that the pictures are spread over.
    #[arg(long, value_name = "SECONDS", default_value = "2", value_parser = not_negative)]
    pub seconds: f64,

    /// The eye moves from picture to picture, so that nothing of the last one can be kept.
    #[arg(long)]
    pub moving: bool,

    /// Measures only rows whose name has this in it, as in `medium` or `volumes`.
    #[arg(long, value_name = "TEXT")]
    pub only: Option<String>,

    /// Writes the tables as Markdown into this file.
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,

    /// Prints a JSON line per row in place of the tables.
    #[arg(long)]
    pub json: bool,
}

/// Measures.
#[cfg(feature = "renderer")]
pub fn run(args: &BenchRenderArgs, out: &mut dyn Write) -> Result<Status, Error> {
    use super::super::{json_line, progress};
    use hapticbillard::events::FactSet;
    use hapticbillard::input::HumanView;
    use hapticbillard::picture::{BenchRow, Environment, FrameTimes, bench_markdown, bench_rows};
    use hapticbillard::renderer::DrawList;
    use hapticbillard_actors::files::{load_scene, write_whole};
    use hapticbillard_actors::game::Stage;
    use hapticbillard_actors::renderer::Studio;

    let only = args.only.as_deref().unwrap_or_default();
    let rows: Vec<_> = bench_rows().into_iter().filter(|row| row.name().contains(only)).collect();
    if rows.is_empty() {
        let names: Vec<String> = bench_rows().iter().map(BenchRow::name).collect();
        let problem = format!("no row has '{only}' in its name");
        return Err(Error::input("--only", problem, format!("rows are {}", names.join("; "))));
    }
    let stage = Stage::new(&load_scene(&args.scene)?, &args.scene)?;
    let radii = super::radii(&stage)?;
    let mut simulation = stage.simulation()?;
    let mut lists = Vec::new();
    for frame in 0..args.frames {
        let at = args.seconds * f64::from(frame) / f64::from(args.frames);
        simulation.advance(at, FactSet::NONE, &mut Vec::new())?;
        let world = simulation.snapshot(at);
        lists.push(DrawList::new(&world, &HumanView::default(), &radii));
    }
    let mut studio = Studio::new(&stage.table)?;
    let device = studio.card();
    let mut times = vec![Vec::new(); rows.len()];
    let mut moved_m = 0.0;
    let bar = progress(u64::from(args.rounds) * rows.len() as u64, "measuring");
    for _ in 0..args.rounds {
        for (row, times) in rows.iter().zip(&mut times) {
            // Shaders, textures and targets are there before it counts.
            let both = lists.len().min(2);
            for (number, place) in (0..both).chain(0..lists.len()).enumerate() {
                let list = &mut lists[place];
                if args.moving {
                    moved_m += MOVED_M;
                    list.camera.eye.x = HumanView::default().camera.eye.x + moved_m;
                }
                let time_s = studio.timed(list, &row.settings, args.size)?;
                if both <= number {
                    times.push(time_s);
                }
            }
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    let measured: Vec<_> = rows
        .iter()
        .zip(&times)
        .filter_map(|(row, times)| Some((*row, FrameTimes::of(times)?)))
        .collect();
    let text = bench_markdown(&measured, &device, args.size, args.moving);
    if let Some(path) = &args.out {
        write_whole(path, text.as_bytes())?;
    }
    if !args.json {
        write!(out, "{text}")?;
        return Ok(Status::Success);
    }
    for (row, times) in &measured {
        let settings = &row.settings;
        json_line(
            out,
            &serde_json::json!({
                "shadows": settings.shadows,
                "room": settings.room,
                "triangles": settings.triangles,
                "texture": settings.texture,
                "environment": settings.environment != Environment::Off,
                "normal_map": settings.normal_map,
                "frame_ms": times,
                "fps_2009": row.fps_2009,
                "preset": row.preset.map(|preset| preset.key()),
            }),
        )?;
    }
    let (width, height) = args.size;
    let summary = serde_json::json!({
        "device": device,
        "size": format!("{width}x{height}"),
        "moving": args.moving,
    });
    json_line(out, &serde_json::json!({ "summary": summary }))?;
    Ok(Status::Success)
}

/// Says that there is nothing to render with.
#[cfg(not(feature = "renderer"))]
pub fn run(_: &BenchRenderArgs, _: &mut dyn Write) -> Result<Status, Error> {
    super::no_pictures("bench-render")
}
