//! Which keys and buttons mean which action.
//!
//! The usual ones are `config/profiles/keys.toml`; a player's own file stands over them, action by
//! action. A key may mean several things as long as no profile makes two of them hear it at once:
//! Escape pauses a game and leaves a page.

use super::names::nearest;
use super::profile::line_at;
use super::{Action, Control, Controller, Profile, Profiles};
use crate::one_line::one_line;
use crate::shipped;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::sync::Arc;
use toml::de::{DeTable, DeValue};

/// What is wrong with a file of keys or of profiles; one line.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum BindingsError {
    /// It is no TOML, or is not of this form.
    #[error("{file}: {problem}")]
    Form {
        /// Which file.
        file: String,
        /// What the parser says, with the line.
        problem: String,
    },
    /// A profile has no file.
    #[error("{file} is missing")]
    NoProfile {
        /// Which file.
        file: String,
    },
    /// There is no such controller.
    #[error("{file}:{line}: there is no controller {name:?}; is {nearest:?} meant?")]
    NoController {
        /// Which file.
        file: String,
        /// Where, counted from 1.
        line: usize,
        /// What stands there.
        name: String,
        /// What may be meant.
        nearest: &'static str,
    },
    /// There is no such action.
    #[error("{file}:{line}: there is no action {name:?}; is {nearest:?} meant?")]
    NoAction {
        /// Which file.
        file: String,
        /// Where, counted from 1.
        line: usize,
        /// What stands there.
        name: String,
        /// What may be meant.
        nearest: &'static str,
    },
    /// There is no such key.
    #[error("{file}:{line}: there is no key {name:?} for {action}; is {nearest:?} meant?")]
    NoKey {
        /// Which file.
        file: String,
        /// Where, counted from 1.
        line: usize,
        /// For which action.
        action: &'static str,
        /// What stands there.
        name: String,
        /// What may be meant.
        nearest: String,
    },
    /// What stands at an action is no list of names.
    #[error("{file}:{line}: {action} needs a list of keys, such as {action} = [\"a\"]")]
    NoList {
        /// Which file.
        file: String,
        /// Where, counted from 1.
        line: usize,
        /// Which action.
        action: &'static str,
    },
    /// Two actions hear one key at once.
    #[error("{file}:{line}: `{key}` is bound to {first} and to {second} in profile {profile}")]
    Conflict {
        /// Which file.
        file: String,
        /// Where the second one stands, counted from 1.
        line: usize,
        /// Which key.
        key: String,
        /// The two.
        first: &'static str,
        /// See above.
        second: &'static str,
        /// Where both hear it.
        profile: &'static str,
    },
    /// An action without which nobody comes to a menu, or out of it, has no key.
    #[error("{file}:{line}: {action} needs a key: without one nobody could use the menus")]
    Needed {
        /// Which file.
        file: String,
        /// Where, counted from 1.
        line: usize,
        /// Which action.
        action: &'static str,
    },
}

/// What became of a wish to bind a key.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Bound {
    /// It is so now, and these actions have lost the key.
    Done {
        /// Which; usually none.
        losers: Vec<Action>,
    },
    /// It is not so: this action cannot be without the key.
    Refused {
        /// Which.
        of: Action,
    },
}

/// Whether a new key stands beside the old ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Beside {
    /// The old ones of the same kind of device go.
    Instead,
    /// They stay.
    Added,
}

/// Keys and buttons for every action.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Bindings {
    profiles: Arc<Profiles>,
    keys: BTreeMap<Action, Vec<Control>>,
}

impl Bindings {
    /// The keys that are shipped.
    pub fn shipped() -> Self {
        // The files are compiled in and a test reads them: they cannot fail on a user's machine.
        Self::read_shipped().unwrap_or_default()
    }

    /// The same.
    ///
    /// # Errors
    /// What is wrong with a shipped file.
    pub fn read_shipped() -> Result<Self, BindingsError> {
        let profiles = Arc::new(Profiles::parse(shipped::PROFILES)?);
        let none = Bindings { profiles, keys: BTreeMap::new() };
        none.with_file("config/profiles/keys.toml", shipped::KEYS)
    }

    /// The same with what a file says over them. What it says nothing of stays as it is, but for
    /// keys that it gives to others, if that is not one of the menus'.
    ///
    /// # Errors
    /// [`BindingsError`]: which line, and what is meant.
    pub fn with_file(&self, file: &str, text: &str) -> Result<Self, BindingsError> {
        let read = Read::parse(file, text)?;
        let mut keys = self.keys.clone();
        for (action, (_, controls)) in &read.keys {
            for (other, held) in &mut keys {
                let is_open = !read.keys.contains_key(other) && !is_of_menus(*other);
                if is_open && self.meet(*action, *other).is_some() {
                    held.retain(|control| !controls.contains(control));
                }
            }
        }
        keys.extend(read.keys.iter().map(|(action, (_, controls))| (*action, controls.clone())));
        let bound = Bindings { profiles: self.profiles.clone(), keys };
        bound.check(&read)?;
        Ok(bound)
    }

    /// Finds two actions that hear one key at once, and those that cannot be without one.
    fn check(&self, read: &Read<'_>) -> Result<(), BindingsError> {
        for (n, action) in Action::ALL.iter().enumerate() {
            for other in &Action::ALL[n + 1..] {
                let Some(profile) = self.meet(*action, *other) else { continue };
                let shared = self.keys(*action).iter().find(|key| self.keys(*other).contains(key));
                if let Some(key) = shared {
                    return Err(BindingsError::Conflict {
                        file: read.file.into(),
                        line: read.line(*action).max(read.line(*other)),
                        key: key.name(),
                        first: action.name(),
                        second: other.name(),
                        profile: profile.name(),
                    });
                }
            }
            if action.is_needed() && !self.keys(*action).iter().any(|key| !key.is_pad()) {
                let (file, line) = (read.file.into(), read.line(*action));
                return Err(BindingsError::Needed { file, line, action: action.name() });
            }
        }
        Ok(())
    }

    /// A profile in which both are heard.
    fn meet(&self, one: Action, other: Action) -> Option<Profile> {
        let hears = |action: &Action, profile| self.hears(*action, profile);
        // In what is always heard everything meets, so that it is named only if nothing else is.
        let mut all = Profile::ALL.iter().rev().copied();
        all.find(|profile| one != other && [one, other].iter().all(|one| hears(one, *profile)))
    }

    /// Whether this action is heard while this profile is active.
    pub fn hears(&self, action: Action, profile: Profile) -> bool {
        self.profiles.is_active(action.controller(), profile)
    }

    /// What a key means while this profile is active.
    pub fn action(&self, control: Control, profile: Profile) -> Option<Action> {
        let mut bound = self.keys.iter().filter(|(_, keys)| keys.contains(&control));
        bound.find(|(action, _)| self.hears(**action, profile)).map(|(action, _)| *action)
    }

    /// The keys of an action.
    pub fn keys(&self, action: Action) -> &[Control] {
        self.keys.get(&action).map_or(&[], Vec::as_slice)
    }

    /// Binds a key; whoever would hear it at the same time loses it, if it can be without.
    pub fn bind(&mut self, action: Action, control: Control, beside: Beside) -> Bound {
        let mut losers = Action::ALL.to_vec();
        losers.retain(|other| {
            self.meet(action, *other).is_some() && self.keys(*other).contains(&control)
        });
        if let Some(of) = losers.iter().copied().find(|of| self.cannot_lose(*of, control)) {
            return Bound::Refused { of };
        }
        for loser in &losers {
            self.keys.entry(*loser).or_default().retain(|key| *key != control);
        }
        let keys = self.keys.entry(action).or_default();
        keys.retain(|key| {
            *key != control && (beside == Beside::Added || key.is_pad() != control.is_pad())
        });
        keys.push(control);
        Bound::Done { losers }
    }

    /// Nobody uses a menu without its keys: they stay, and so does the last key for a pause.
    fn cannot_lose(&self, action: Action, control: Control) -> bool {
        let others = self.keys(action).iter().filter(|key| **key != control);
        is_of_menus(action) || action.is_needed() && others.filter(|key| !key.is_pad()).count() == 0
    }

    /// As a file.
    pub fn to_toml(&self) -> String {
        let mut text = String::from("# A list of keys for every action.\n\n");
        for action in Action::ALL {
            let names: Vec<String> =
                self.keys(*action).iter().map(|key| format!("{:?}", key.name())).collect();
            // Writing to a text cannot fail.
            let _ = writeln!(text, "{} = [{}]", action.name(), names.join(", "));
        }
        text
    }
}

fn is_of_menus(action: Action) -> bool {
    action.controller() == Controller::Menu
}

/// A file of keys: for every action in it the line, and the keys.
struct Read<'a> {
    file: &'a str,
    keys: BTreeMap<Action, (usize, Vec<Control>)>,
}

impl<'a> Read<'a> {
    fn parse(file: &'a str, text: &str) -> Result<Self, BindingsError> {
        let table = DeTable::parse(text).map_err(|error| BindingsError::Form {
            file: file.into(),
            problem: one_line(error.to_string().trim_end(), 400),
        })?;
        let mut keys = BTreeMap::new();
        for (name, value) in table.get_ref() {
            let line = line_at(text, name.span().start);
            let name = name.get_ref().as_ref();
            let action = Action::named(name).ok_or_else(|| BindingsError::NoAction {
                file: file.into(),
                line,
                name: one_line(name, 40),
                nearest: nearest(name, Action::ALL.iter().map(|action| action.name())),
            })?;
            let no_list =
                || BindingsError::NoList { file: file.into(), line, action: action.name() };
            let DeValue::Array(list) = value.get_ref() else { return Err(no_list()) };
            let mut controls = Vec::new();
            for value in list {
                let name = value.get_ref().as_str().ok_or_else(no_list)?;
                let line = line_at(text, value.span().start);
                let control =
                    Control::named(name).ok_or_else(|| no_key(file, line, action, name))?;
                if !controls.contains(&control) {
                    controls.push(control);
                }
            }
            keys.insert(action, (line, controls));
        }
        Ok(Read { file, keys })
    }

    /// Where an action stands; the first line if it does not.
    fn line(&self, action: Action) -> usize {
        self.keys.get(&action).map_or(1, |(line, _)| *line)
    }
}

fn no_key(file: &str, line: usize, action: Action, name: &str) -> BindingsError {
    let names = Control::names();
    BindingsError::NoKey {
        file: file.into(),
        line,
        action: action.name(),
        name: one_line(name, 40),
        nearest: nearest(name, names.iter().map(String::as_str)).to_string(),
    }
}
