//! `hapticbillard film`: a game as pictures, frame by frame.

use super::super::{not_negative, size};
use super::{Eye, PictureArgs};
use clap::Args;
use std::path::PathBuf;

const EXAMPLE: &str = "\
Frame n shows the game at exactly n / FPS seconds, however long it takes to draw. A name that ends
in .y4m becomes one file that encoders read, such as `ffmpeg -i shot.y4m shot.mp4`; any other name
is a folder of PNG files.

Examples:
  hapticbillard film --scene break_shot --seconds 3 --out break.y4m
  hapticbillard film --replay game.jsonl --from-s 12 --seconds 5 --fps 30 --out frames
  hapticbillard film --scene break_shot --speed 0.1 --seconds 0.3 --preset high --out slow.y4m";

/// Renders a game as a film, frame by frame, without a window.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct FilmArgs {
    /// A shipped scene (see `scenes`) or a scene file: its balls move, and nobody plays.
    #[arg(long, value_name = "SCENE", required_unless_present = "replay")]
    pub scene: Option<String>,

    /// A recorded game.
    #[arg(long, value_name = "FILE", conflicts_with = "scene")]
    pub replay: Option<PathBuf>,

    /// The file or the folder.
    #[arg(long, value_name = "PATH")]
    pub out: PathBuf,

    /// The first moment of the game in seconds.
    #[arg(long, value_name = "SECONDS", default_value = "0", value_parser = not_negative)]
    pub from_s: f64,

    /// How many seconds of the game.
    #[arg(long, value_name = "SECONDS", default_value = "5", value_parser = not_negative)]
    pub seconds: f64,

    /// Frames per second.
    #[arg(long, value_name = "N", default_value = "60")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub fps: u32,

    /// Seconds of the game per second of the film, in hundredths at least.
    #[arg(long, value_name = "X", default_value = "1", value_parser = pace)]
    pub speed: f64,

    /// Size of the picture in pixels.
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = size)]
    pub size: (u32, u32),

    /// Where it is taken from.
    #[arg(long, value_enum, default_value = "head")]
    pub from: Eye,

    #[command(flatten)]
    pub picture: PictureArgs,

    /// Prints the summary as a JSON line.
    #[arg(long)]
    pub json: bool,
}

fn pace(text: &str) -> Result<f64, String> {
    let pace = not_negative(text)?;
    if (0.01..=100.0).contains(&pace) { Ok(pace) } else { Err("write 0.01 to 100".into()) }
}

/// Says that there is nothing to render with.
#[cfg(not(feature = "renderer"))]
pub fn run(
    _: &FilmArgs,
    _: &mut dyn std::io::Write,
) -> Result<super::super::Status, hapticbillard_actors::error::Error> {
    super::no_pictures("film")
}

/// Renders.
#[cfg(feature = "renderer")]
pub use filming::run;

#[cfg(feature = "renderer")]
mod filming {
    use super::super::super::replay::read_recording;
    use super::super::super::{Status, json_line, progress};
    use super::{Eye, FilmArgs};
    use hapticbillard::events::FactSet;
    use hapticbillard::input::{CameraPose, HumanView};
    use hapticbillard::lockstep::{Lockstep, Setup};
    use hapticbillard::physics::{Simulation, Snapshot};
    use hapticbillard::picture::PictureSettings;
    use hapticbillard::renderer::{
        DrawList, FilmClock, Radii, between, draw_vectors, y4m_frame, y4m_head,
    };
    use hapticbillard::replay::RecordedInput;
    use hapticbillard::tick::Pace;
    use hapticbillard::units::Seconds;
    use hapticbillard_actors::conductor::RunError;
    use hapticbillard_actors::error::Error;
    use hapticbillard_actors::files::{load_scene, make_folder, write_whole, write_whole_by};
    use hapticbillard_actors::game::{LIMIT, Stage};
    use hapticbillard_actors::renderer::{Studio, encoded};
    use std::io::{self, Write};
    use std::sync::Arc;

    /// Takes the frames of a film with their numbers.
    type Writing<'a> = &'a mut dyn FnMut(u64, &[[u8; 4]]) -> Result<(), Error>;

    /// Who knows the world at every moment of a film, in ascending order.
    enum World {
        /// Balls that nobody plays with.
        Free(Box<Simulation>),
        /// A recorded game: the last two ticks, and the game until it is over.
        Game { before: Arc<Snapshot>, newest: Arc<Snapshot>, game: Option<Box<Lockstep<'static>>> },
    }

    impl World {
        /// The world at a moment; none after the end of a recording.
        fn at(&mut self, moment_s: Seconds) -> Result<Option<Snapshot>, Error> {
            match self {
                World::Free(simulation) => {
                    simulation.advance(moment_s, FactSet::NONE, &mut Vec::new())?;
                    Ok(Some(simulation.snapshot(moment_s)))
                }
                World::Game { before, newest, game } => {
                    while let Some(running) = game.as_mut().filter(|_| newest.time_s < moment_s) {
                        let is_over = running.step().map_err(RunError::from)?.is_some();
                        if newest.time_s < running.table().time_s {
                            *before = std::mem::replace(newest, running.table().clone());
                        }
                        if is_over {
                            *game = None;
                        }
                    }
                    let is_there = moment_s <= newest.time_s;
                    Ok(is_there.then(|| between(before, newest, moment_s)))
                }
            }
        }
    }

    struct Camera {
        studio: Studio,
        view: HumanView,
        radii: Radii,
        settings: PictureSettings,
        size: (u32, u32),
    }

    impl Camera {
        fn shoot(&mut self, world: &Snapshot) -> Result<Vec<[u8; 4]>, Error> {
            let mut list = DrawList::new(world, &self.view, &self.radii);
            if self.settings.vectors {
                draw_vectors(world, &self.radii, &mut list);
            }
            Ok(self.studio.pixels(&list, &self.settings, self.size)?)
        }
    }

    /// See above.
    pub fn run(args: &FilmArgs, out: &mut dyn Write) -> Result<Status, Error> {
        let settings = args.picture.settings()?;
        let (stage, recording) = match (&args.replay, &args.scene) {
            (Some(path), _) => {
                let recording = read_recording(path)?;
                (Stage::of_recording(&recording)?, Some(recording))
            }
            (None, scene) => {
                let scene = scene.as_deref().unwrap_or_default();
                (Stage::new(&load_scene(scene)?, scene)?, None)
            }
        };
        let mut radii = super::super::radii(&stage)?;
        radii.mark(settings.marks);
        let mut world = match recording {
            None => World::Free(Box::new(stage.simulation()?)),
            Some(recording) => {
                let mut setup = Setup::headless(LIMIT);
                setup.pace = Pace::EveryTick;
                setup.input = Some(Box::new(RecordedInput(Arc::new(recording))));
                let game = Lockstep::new(stage.cast()?, setup).map_err(RunError::from)?;
                let first = game.table().clone();
                World::Game { before: first.clone(), newest: first, game: Some(Box::new(game)) }
            }
        };
        let length_m = stage.table.bed.map_or(2.54, |bed| bed.length_m);
        let camera = match args.from {
            Eye::Above => CameraPose::above(length_m),
            Eye::Head => CameraPose::default(),
        };
        let mut camera = Camera {
            studio: Studio::new(&stage.table)?,
            view: HumanView { camera, ..HumanView::default() },
            radii,
            settings,
            size: args.size,
        };
        let clock = FilmClock { fps: args.fps, speed: args.speed, from_s: args.from_s };
        let frames = clock.frames_in(args.seconds);
        let bar = progress(frames, "drawing");
        let mut drawn = 0;
        let mut next = |write: Writing<'_>| {
            for frame in 0..frames {
                let Some(world) = world.at(clock.moment_s(frame))? else { break };
                write(frame, &camera.shoot(&world)?)?;
                drawn += 1;
                bar.inc(1);
            }
            Ok::<(), Error>(())
        };
        let is_one_file =
            args.out.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("y4m"));
        if is_one_file {
            let mut failed = None;
            let written = write_whole_by(&args.out, |file| {
                file.write_all(y4m_head(args.size, args.fps).as_bytes())?;
                let done = next(&mut |_, rows| Ok(file.write_all(&y4m_frame(rows))?));
                // Whatever went wrong is told as it is, and leaves no file behind.
                done.map_err(|error| {
                    failed = Some(error);
                    io::Error::other("the film is not whole")
                })
            });
            if let Some(error) = failed {
                return Err(error);
            }
            written?;
        } else {
            make_folder(&args.out)?;
            next(&mut |frame, rows| {
                let png = encoded(rows, args.size)?;
                write_whole(&args.out.join(format!("frame_{frame:06}.png")), &png)
            })?;
        }
        bar.finish_and_clear();
        let (path, (width, height)) = (&args.out, args.size);
        if args.json {
            let (fps, speed) = (args.fps, args.speed);
            let summary = serde_json::json!({
                "out": path, "frames": drawn, "fps": fps, "speed": speed,
                "width": width, "height": height,
            });
            json_line(out, &serde_json::json!({ "summary": summary }))?;
        } else {
            writeln!(out, "{}: {drawn} frames of {width} x {height} pixels", path.display())?;
        }
        Ok(Status::Success)
    }
}
