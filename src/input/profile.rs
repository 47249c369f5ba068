//! Profiles: which controllers hear what is pressed, and when.
//!
//! As in the paper (sections 3.1.1 and 3.3.2) controllers and profiles belong to each other n:m. A
//! controller takes a group of actions; it is active if one of the profiles that it belongs to is.
//! One profile is always active, and one more beside it: which one, the [`Lobby`] says.
//!
//! [`Lobby`]: crate::menu::Lobby

use super::bindings::BindingsError;
use super::names::nearest;
use crate::one_line::one_line;
use toml::de::{DeTable, DeValue};

/// A group of actions that belong together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Controller {
    /// The cue, a ball in hand, and what is called with a stroke.
    Cue,
    /// What the rules leave to a player.
    Choice,
    /// From where the table is seen.
    Eye,
    /// How time goes.
    Clock,
    /// The way out of a game.
    Leave,
    /// What is shown beside the table.
    Show,
    /// Volume and mode of the sound.
    Sound,
    /// A shot that is seen again.
    Film,
    /// What a window does whatever stands in it.
    Window,
    /// The lines of a menu.
    Menu,
}

impl Controller {
    const NAMES: [(&'static str, Controller); 10] = [
        ("cue", Controller::Cue),
        ("choice", Controller::Choice),
        ("eye", Controller::Eye),
        ("clock", Controller::Clock),
        ("leave", Controller::Leave),
        ("show", Controller::Show),
        ("sound", Controller::Sound),
        ("film", Controller::Film),
        ("window", Controller::Window),
        ("menu", Controller::Menu),
    ];
}

/// When something is heard.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Profile {
    /// Always.
    Always,
    /// A page of a menu is open.
    Menu,
    /// Somebody plays.
    Cue,
    /// Somebody must take an option.
    Choice,
    /// Nobody plays, and somebody looks on.
    Camera,
    /// Time stands still, and no menu is open.
    Pause,
    /// The last shot is seen again.
    Replay,
}

impl Profile {
    /// All.
    pub const ALL: [Profile; 7] = [
        Profile::Always,
        Profile::Replay,
        Profile::Menu,
        Profile::Cue,
        Profile::Choice,
        Profile::Camera,
        Profile::Pause,
    ];

    /// The name of its file.
    pub fn name(self) -> &'static str {
        match self {
            Profile::Always => "always",
            Profile::Menu => "menu",
            Profile::Cue => "cue",
            Profile::Choice => "choice",
            Profile::Camera => "camera",
            Profile::Pause => "pause",
            Profile::Replay => "replay",
        }
    }
}

/// Which controllers belong to which profiles.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Profiles(Vec<(Profile, Controller)>);

impl Profiles {
    /// Reads a file per profile: names and texts.
    ///
    /// # Errors
    /// [`BindingsError`]: which file, which line, and what is meant.
    pub fn parse(files: &[(&str, &str)]) -> Result<Self, BindingsError> {
        let mut pairs = Vec::new();
        for profile in Profile::ALL {
            let name = profile.name();
            let file = format!("config/profiles/{name}.toml");
            let text = files.iter().find(|(one, _)| *one == name).map(|(_, text)| *text);
            let Some(text) = text else { return Err(BindingsError::NoProfile { file }) };
            pairs.extend(controllers(&file, text)?.into_iter().map(|one| (profile, one)));
        }
        Ok(Profiles(pairs))
    }

    /// Whether this controller hears anything while this profile is active.
    pub fn is_active(&self, controller: Controller, profile: Profile) -> bool {
        let belongs = |profile| self.0.contains(&(profile, controller));
        belongs(Profile::Always) || belongs(profile)
    }
}

fn controllers(file: &str, text: &str) -> Result<Vec<Controller>, BindingsError> {
    let form = |problem: &str| BindingsError::Form {
        file: file.into(),
        problem: one_line(problem.trim_end(), 400),
    };
    let table = DeTable::parse(text).map_err(|error| form(&error.to_string()))?;
    let (mut listed, mut others) = (None, 0);
    for (key, value) in table.get_ref() {
        match (key.get_ref().as_ref(), value.get_ref()) {
            ("controllers", DeValue::Array(list)) => listed = Some(list),
            _ => others += 1,
        }
    }
    let (Some(listed), 0) = (listed, others) else {
        return Err(form("a profile is one list: controllers = [..]"));
    };
    let mut found = Vec::new();
    for value in listed {
        let name = value.get_ref().as_str().unwrap_or_default();
        let known = Controller::NAMES.iter().find(|(known, _)| *known == name);
        let Some((_, controller)) = known else {
            return Err(BindingsError::NoController {
                file: file.into(),
                line: line_at(text, value.span().start),
                name: one_line(name, 40),
                nearest: nearest(name, Controller::NAMES.iter().map(|(known, _)| *known)),
            });
        };
        found.push(*controller);
    }
    Ok(found)
}

/// The line of a place in a text, counted from 1.
pub(super) fn line_at(text: &str, place: usize) -> usize {
    text.bytes().take(place).filter(|byte| *byte == b'\n').count() + 1
}
