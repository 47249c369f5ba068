//! What is looked at, one after the other.

use hapticbillard::menu::Settings;
use hapticbillard::scene::Overrides;
use hapticbillard::units::Tick;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files;
use hapticbillard_actors::game::Stage;
use hapticbillard_actors::haptic::{self, Asked, Grant};
use hapticbillard_actors::runtime::Setup;
use hapticbillard_actors::soak::{self, Trial};
use hapticbillard_actors::sound;
use serde::Serialize;
use std::path::Path;

/// How it is with something.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Health {
    /// It is there.
    Well,
    /// It is not there, and games go without it.
    Missing,
    /// Every game needs it.
    Broken,
}

/// What was found.
#[derive(Debug, Clone, Serialize)]
pub struct Found {
    /// What was looked at.
    pub what: &'static str,
    /// How it is.
    pub health: Health,
    /// In words.
    pub found: String,
    /// What would help.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub remedy: Option<String>,
}

impl Found {
    fn well(what: &'static str, found: impl Into<String>) -> Self {
        Found { what, health: Health::Well, found: found.into(), remedy: None }
    }

    fn missing(what: &'static str, found: impl Into<String>, remedy: &str) -> Self {
        let remedy = Some(remedy.to_string());
        Found { what, health: Health::Missing, found: found.into(), remedy }
    }

    fn broken(what: &'static str, found: impl Into<String>, remedy: &str) -> Self {
        Found { health: Health::Broken, ..Found::missing(what, found, remedy) }
    }
}

/// Everything that is looked at.
pub const ALL: [fn() -> Vec<Found>; 8] =
    [program, game, recordings, settings, picture, speakers, devices, rights];

fn program() -> Vec<Found> {
    let parts = [
        ("renderer", cfg!(feature = "renderer")),
        ("sound", cfg!(feature = "sound")),
        ("rtkit", cfg!(feature = "rtkit")),
    ];
    let built = parts.into_iter().filter(|(_, is_built)| *is_built).map(|(name, _)| name);
    let built = built.collect::<Vec<_>>().join(", ");
    let built = if built.is_empty() { "no features".to_string() } else { built };
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let version = env!("CARGO_PKG_VERSION");
    let machine = format!("{}, cores that it may use: {cores}", files::processor_name());
    vec![
        Found::well("program", format!("{version}, built with {built}")),
        Found::well("machine", machine),
    ]
}

/// A minute of a game, by actors and in lockstep.
fn game() -> Vec<Found> {
    const SEED: u64 = 1;
    const LIMIT: Tick = Tick(60_000);
    let trial = || -> Result<usize, Error> {
        let name = "eight_ball_headless";
        let stage = Stage::new(&files::load_scene(name)?, name)?;
        let stage = stage.with(Overrides { seed: Some(SEED), ..Overrides::default() });
        let reference = soak::reference(&stage, SEED, LIMIT)?;
        let (is_jostled, faults) = (false, Vec::new());
        let trial = Trial { seed: SEED, workers: 2, physics_thread: true, is_jostled, faults };
        let file = format!("hapticbillard-doctor-{}.jsonl", std::process::id());
        let file = std::env::temp_dir().join(file);
        let played = soak::play(&stage, &reference, &trial, &file, Setup::headless(LIMIT));
        played.ended.map_err(|wrong| {
            Error::input("a game by actors", wrong.to_string(), "run `hapticbillard soak --faults`")
        })?;
        Ok(reference.seen.events.len())
    };
    vec![match trial() {
        Ok(events) => {
            let found = format!("a minute of eight-ball is the same by actors: {events} events");
            Found::well("game", found)
        }
        Err(error) => Found::broken("game", error.to_string(), "tell us, with this output"),
    }]
}

fn recordings() -> Vec<Found> {
    let what = "recordings";
    let written = || -> Result<String, Error> {
        let folder = files::recordings_folder()?;
        let trial = folder.join(format!(".doctor-{}", std::process::id()));
        files::write_whole(&trial, b"can this be written?\n")?;
        files::remove(&trial);
        let is_game = |name: &&String| name.ends_with(".jsonl") || name.ends_with(".part");
        let count = files::names_in(&folder).iter().filter(is_game).count();
        Ok(format!("{} can be written; games in it: {count}", folder.display()))
    };
    let remedy = "games are not recorded: free the disk or set XDG_DATA_HOME to another folder";
    vec![match written() {
        Ok(found) => Found::well(what, found),
        Err(error) => Found::missing(what, error.to_string(), remedy),
    }]
}

fn settings() -> Vec<Found> {
    let what = "settings";
    let read = || -> Result<String, Error> {
        let file = files::settings_file()?;
        let shown = file.display();
        let Some(text) = files::read_if_there(&file, 1 << 20)? else {
            return Ok(format!("{shown} is not there yet: everything is as usual"));
        };
        let read = Settings::parse(&text);
        read.map_err(|error| Error::input(shown.to_string(), error, "correct or remove it"))?;
        Ok(format!("{shown} is as it should be"))
    };
    vec![match read() {
        Ok(found) => Found::well(what, found),
        Err(error) => Found::missing(what, error.to_string(), "the menus begin as usual"),
    }]
}

#[cfg(feature = "renderer")]
fn picture() -> Vec<Found> {
    let display = ["WAYLAND_DISPLAY", "DISPLAY"].into_iter().find_map(|name| {
        let value = std::env::var(name).ok().filter(|value| !value.is_empty())?;
        Some(format!("{name}={value}"))
    });
    let window = match display {
        Some(display) => Found::well("display", display),
        None if cfg!(all(unix, not(target_os = "macos"))) => Found::missing(
            "display",
            "neither DISPLAY nor WAYLAND_DISPLAY is set: there is no window",
            "start the game in a graphical session, or with `xvfb-run`",
        ),
        None => Found::well("display", "the system's own"),
    };
    let card = match hapticbillard_actors::renderer::card() {
        Ok(card) => Found::well("OpenGL", card),
        Err(error) => Found::missing("OpenGL", error.to_string(), "pictures need it"),
    };
    vec![window, card]
}

#[cfg(not(feature = "renderer"))]
fn picture() -> Vec<Found> {
    let remedy = "build with the feature `renderer`";
    vec![Found::missing("OpenGL", "this program was built without a window", remedy)]
}

fn speakers() -> Vec<Found> {
    let remedy = "games are silent until there is one; a scene can name it in [sound]";
    vec![match sound::system().outputs() {
        Ok(outputs) if outputs.is_empty() => Found::missing("sound", "there is no output", remedy),
        Ok(outputs) => {
            let names: Vec<_> = outputs.iter().map(|output| output.name.as_str()).collect();
            let first = names.iter().take(4).copied().collect::<Vec<_>>().join(", ");
            let more = names.len().saturating_sub(4);
            let more = if more > 0 { format!(" and {more} more") } else { String::new() };
            Found::well("sound", format!("{first}{more}"))
        }
        Err(error) => Found::missing("sound", error.to_string(), remedy),
    }]
}

/// Those that can be there or not.
fn devices() -> Vec<Found> {
    let real = haptic::list().into_iter().filter(|device| device.says.is_some());
    real.map(|device| {
        let says = device.says.unwrap_or_default();
        match device.spec {
            Some(spec) => Found::well(device.name, format!("{}: {says}", spec.model)),
            None => {
                let remedy =
                    "without one, device = \"mouse\" lets your mouse move a simulated hand";
                Found::missing(device.name, says, remedy)
            }
        }
    })
    .collect()
}

/// What a servo would get.
fn rights() -> Vec<Found> {
    let obtained = haptic::probe(&Asked::default());
    let found = obtained.parts().into_iter().map(|(what, grant)| match grant {
        Grant::Refused(refusal) => {
            let found = format!("{} was refused: {}", refusal.asked, refusal.reason);
            Found::missing(what, found, &refusal.remedy)
        }
        grant => Found::well(what, grant.to_string()),
    });
    let mut found: Vec<_> = found.collect();
    let limits = Path::new("/proc/sys/kernel/sched_rt_runtime_us");
    if let Ok(Some(text)) = files::read_if_there(limits, 64)
        && text.trim() == "0"
    {
        let remedy = "as root: sysctl kernel.sched_rt_runtime_us=950000";
        found.push(Found::missing(
            "real time",
            "the kernel gives real-time threads no time",
            remedy,
        ));
    }
    found
}
