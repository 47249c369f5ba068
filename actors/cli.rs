//! The command line: one file per command, each with help that teaches.
//!
//! What a command answers goes to stdout and nothing else does; progress and logs go to stderr.
//! The exit code is 0 for success, 1 if a check failed, 2 for wrong usage or input.

mod in_order;

mod racks;

mod plot;

mod play;

mod simulate;

mod match_;

mod tournament;

mod replay;

mod bake;

mod render;

mod scene;

mod scenes;

mod rules;

mod validate;

mod haptic;

mod sound;

mod report;

mod learn;

mod soak;

mod doctor;

mod completions;

mod man;

use clap::error::ErrorKind as WrongUsage;
use clap::parser::ValueSource;
use clap::{ArgAction, CommandFactory, FromArgMatches, Parser, Subcommand, ValueEnum};
use hapticbillard_actors::error::Error;
use hapticbillard_actors::logging::{self, LogFile};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::PathBuf;
use std::process::ExitCode;

const ABOUT: &str = "Billiards with real physics: a game, and a toolbox around the same core";

const EXAMPLES: &str = "\
Examples:
  hapticbillard                          the main menu of the game
  hapticbillard scenes                   list the shipped scenes
  hapticbillard simulate --scene break_shot --json
  hapticbillard match --scene eight_ball_headless --games 10

Every command has --help with an example. With --json a command prints JSON lines on stdout, the
last of which is {\"summary\":{..}}.
Log: warnings go to stderr; -v, -vv and -vvv say more. RUST_LOG chooses by module, and every actor
is one: hapticbillard_actors::conductor, event_manager, physics, rules, ai, input, haptic, sound,
recorder, renderer. RUST_LOG=warn,hapticbillard_actors::rules=debug tells all that the rules decide;
hapticbillard_actors::shot=info in it names the shot on every line. `play` also writes a log a day
into the folder logs/ in the user's data folder and keeps the last 7.
Exit codes: 0 success, 1 a check failed, 2 wrong usage or input.";

#[derive(Parser)]
#[command(name = "hapticbillard", version, about = ABOUT, after_help = EXAMPLES)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,

    #[command(flatten)]
    play: play::PlayArgs,

    /// Says more on stderr; twice: even more. RUST_LOG chooses by module.
    #[arg(short, long, global = true, action = ArgAction::Count)]
    verbose: u8,

    /// Writes the log into this file too, behind what is there.
    #[arg(long, global = true, value_name = "FILE")]
    log_file: Option<PathBuf>,
}

#[derive(Subcommand)]
enum Command {
    Play(play::PlayArgs),
    Simulate(simulate::SimulateArgs),
    Match(match_::MatchArgs),
    Tournament(tournament::TournamentArgs),
    Replay(replay::ReplayArgs),
    Render(render::RenderArgs),
    BenchRender(render::bench::BenchRenderArgs),
    Film(render::film::FilmArgs),
    Bake(bake::BakeArgs),
    Scene(scene::SceneArgs),
    Scenes(scenes::ScenesArgs),
    Rules(rules::RulesArgs),
    Validate(validate::ValidateArgs),
    Haptic(haptic::HapticArgs),
    Sound(sound::SoundArgs),
    Report(report::ReportArgs),
    Learn(learn::LearnArgs),
    Soak(soak::SoakArgs),
    Doctor(doctor::DoctorArgs),
    Completions(completions::CompletionsArgs),
    Man(man::ManArgs),
}

/// Which runtime plays a game; both give the same output.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum Driver {
    /// All cores in one thread, in virtual time: the reference.
    Lockstep,
    /// One actor per core.
    #[default]
    Actors,
}

impl From<Driver> for hapticbillard_actors::game::Driver {
    fn from(driver: Driver) -> Self {
        match driver {
            Driver::Lockstep => Self::Lockstep,
            Driver::Actors => Self::Actors,
        }
    }
}

/// How a command ended, if it could do its work.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// Everything is as it should be.
    Success,
    /// It did its work, and found that something is not as it should be.
    CheckFailed,
}

/// The command line. What is said of a game stands behind `play` or alone; what every command
/// takes stands anywhere, which clap's own `args_conflicts_with_subcommands` does not allow.
fn arguments() -> Cli {
    let mut command = Cli::command();
    let matches = command.clone().get_matches();
    if let Some(name) = matches.subcommand_name() {
        let is_given = |id: &&str| matches.value_source(id) == Some(ValueSource::CommandLine);
        let of_play = command.get_arguments().filter(|argument| !argument.is_global_set());
        let strays = of_play.filter(|argument| is_given(&argument.get_id().as_str()));
        let stray = strays.filter_map(|argument| argument.get_long()).next();
        if let Some(stray) = stray {
            let line =
                format!("--{stray} is for a game: write it behind {name} if it belongs there");
            command.error(WrongUsage::ArgumentConflict, line).exit();
        }
    }
    Cli::from_arg_matches(&matches).unwrap_or_else(|error| error.exit())
}

/// Reads the command line and does what it says.
pub fn run() -> ExitCode {
    let cli = arguments();
    let command = cli.command.unwrap_or(Command::Play(cli.play));
    let file = match (cli.log_file, &command) {
        (Some(path), _) => LogFile::At(path),
        (None, Command::Play(_)) => LogFile::Daily,
        (None, _) => LogFile::None,
    };
    let _logging = logging::start(cli.verbose, &file);

    let mut out = BufWriter::new(io::stdout().lock());
    let result = match command {
        Command::Play(args) => play::run(&args, &mut out),
        Command::Simulate(args) => simulate::run(&args, &mut out),
        Command::Match(args) => match_::run(&args, &mut out),
        Command::Tournament(args) => tournament::run(&args, &mut out),
        Command::Replay(args) => replay::run(&args, &mut out),
        Command::Render(args) => render::run(&args, &mut out),
        Command::BenchRender(args) => render::bench::run(&args, &mut out),
        Command::Film(args) => render::film::run(&args, &mut out),
        Command::Bake(args) => bake::run(&args, &mut out),
        Command::Scene(args) => scene::run(&args, &mut out),
        Command::Scenes(args) => scenes::run(&args, &mut out),
        Command::Rules(args) => rules::run(&args, &mut out),
        Command::Validate(args) => validate::run(&args, &mut out),
        Command::Haptic(args) => haptic::run(&args, &mut out),
        Command::Sound(args) => sound::run(&args, &mut out),
        Command::Report(args) => report::run(&args, &mut out),
        Command::Learn(args) => learn::run(&args, &mut out),
        Command::Soak(args) => soak::run(&args, &mut out),
        Command::Doctor(args) => doctor::run(&args, &mut out),
        Command::Completions(args) => completions::run(&args, Cli::command(), &mut out),
        Command::Man(args) => man::run(&args, Cli::command(), &mut out),
    };
    match result.and_then(|status| Ok(out.flush().map(|()| status)?)) {
        Ok(Status::Success) => ExitCode::SUCCESS,
        Ok(Status::CheckFailed) => ExitCode::from(1),
        // Who closes the pipe, as `head` does, has read enough.
        Err(Error::Output(error)) if error.kind() == ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

/// One line of JSON.
pub fn json_line(out: &mut dyn Write, value: &impl serde::Serialize) -> Result<(), Error> {
    serde_json::to_writer(&mut *out, value).map_err(io::Error::from)?;
    Ok(out.write_all(b"\n")?)
}

/// A progress bar for `length` pieces of work; invisible unless stderr is a terminal.
pub fn progress(length: u64, what: &'static str) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(length), ProgressDrawTarget::stderr());
    let template = "{msg} {wide_bar} {pos}/{len}, {eta} left";
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    bar.with_message(what)
}

/// A number of seconds or a factor that is not negative.
pub fn not_negative(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() && number >= 0.0 => Ok(number),
        _ => Err(String::from("expected a number that is not negative")),
    }
}

/// A number above zero.
pub fn positive(text: &str) -> Result<f64, String> {
    match not_negative(text) {
        Ok(number) if number > 0.0 => Ok(number),
        _ => Err(String::from("expected a number above 0")),
    }
}

/// A size in pixels, such as `1280x720`.
pub fn size(text: &str) -> Result<(u32, u32), String> {
    let sides = text.split_once('x').map(|(w, h)| (w.parse::<u32>(), h.parse::<u32>()));
    match sides {
        Some((Ok(width), Ok(height)))
            if (64..=16_384).contains(&width) && (64..=16_384).contains(&height) =>
        {
            Ok((width, height))
        }
        _ => Err(String::from("expected WIDTHxHEIGHT in pixels, such as 1280x720, 64 to 16384")),
    }
}
