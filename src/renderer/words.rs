//! The words in the window, in one language.

use crate::input::{Action, Bindings, Control, Key};
use crate::rules::Language;

/// What stands in place of an action in a text that is filled with keys: `{key:pause}`, or
/// `{pad:pause}` for the buttons of a gamepad.
const MARKS: [(&str, bool); 2] = [("{key:", false), ("{pad:", true)];

/// A table of controls.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HelpOf {
    /// Mouse and keyboard.
    Keys,
    /// A gamepad.
    Pad,
    /// A mouse that moves the hand at a haptic device.
    Felt,
    /// A menu.
    Menu,
}

impl HelpOf {
    fn section(self) -> &'static str {
        match self {
            HelpOf::Keys => "help",
            HelpOf::Pad => "help_pad",
            HelpOf::Felt => "help_felt",
            HelpOf::Menu => "help_menu",
        }
    }
}

/// The words of one language; the sentences of the rules are beside them in the same file.
#[derive(Debug, Clone)]
pub struct Words {
    table: toml::Table,
    /// What keys are called.
    keys: toml::Table,
    bindings: Bindings,
}

impl Words {
    /// The words over the picture of a game.
    pub fn new(language: Language) -> Self {
        Self::of("hud", language)
    }

    /// The words of the menus.
    pub fn of_menus(language: Language) -> Self {
        Self::of("menu", language)
    }

    fn of(section: &str, language: Language) -> Self {
        // The file is compiled in and a test reads it: it cannot fail on a user's machine.
        let file: toml::Table = language.file().parse().unwrap_or_default();
        let table = |name: &str| {
            file.get(name).and_then(toml::Value::as_table).cloned().unwrap_or_default()
        };
        Words { table: table(section), keys: table("key"), bindings: Bindings::shipped() }
    }

    /// The same where keys mean this.
    #[must_use]
    pub fn with_keys(self, bindings: &Bindings) -> Self {
        Words { bindings: bindings.clone(), ..self }
    }

    /// The text at a key; the key itself where there is none, so that nothing is ever silent.
    pub fn get(&self, key: &str) -> String {
        self.with_names(self.table.get(key).and_then(toml::Value::as_str).unwrap_or(key))
    }

    /// The same with something filled in.
    pub fn fill(&self, key: &str, place: &str, value: &str) -> String {
        self.get(key).replace(&format!("{{{place}}}"), value)
    }

    /// The controls: what to press and what it does.
    pub fn help(&self, of: HelpOf) -> Vec<(String, String)> {
        let text = |row: &toml::Value, key: &str| {
            self.with_names(row.get(key).and_then(toml::Value::as_str).unwrap_or_default())
        };
        let rows = self.table.get(of.section()).and_then(toml::Value::as_array);
        let rows = rows.into_iter().flatten();
        rows.map(|row| (text(row, "keys"), text(row, "does"))).collect()
    }

    /// What an action is called.
    pub fn action(&self, action: Action) -> String {
        self.get(&format!("action_{}", action.name()))
    }

    /// What a key is called.
    pub fn key(&self, control: Control) -> String {
        match control {
            Control::Key(Key::Letter(letter)) => letter.to_string(),
            Control::Key(Key::Function(number)) => format!("F{number}"),
            _ => {
                let name = control.name();
                self.keys.get(&name).and_then(toml::Value::as_str).unwrap_or(&name).to_string()
            }
        }
    }

    /// What the keys of an action are called: those of a gamepad, or the others.
    fn keys_of(&self, action: Action, of_pad: bool) -> String {
        let keys = self.bindings.keys(action).iter().filter(|key| key.is_pad() == of_pad);
        listed(keys.map(|key| self.key(*key)))
    }

    /// What all keys of an action are called, under these bindings; those of a gamepad so that
    /// nobody takes them for letters.
    pub fn all_keys_of(&self, action: Action, bindings: &Bindings) -> String {
        listed(bindings.keys(action).iter().map(|key| match key {
            Control::Pad(_) => self.fill("pad_key", "name", &self.key(*key)),
            _ => self.key(*key),
        }))
    }

    /// A text with the names of keys in it.
    fn with_names(&self, text: &str) -> String {
        let mut text = text.to_string();
        for (mark, of_pad) in MARKS {
            while let Some(from) = text.find(mark) {
                let Some(to) = text[from..].find('}').map(|to| from + to) else { break };
                let action = Action::named(&text[from + mark.len()..to]);
                let keys = action.map_or_else(String::new, |action| self.keys_of(action, of_pad));
                text.replace_range(from..=to, &keys);
            }
        }
        text
    }

    /// All keys, for comparing languages.
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.table.keys().map(String::as_str)
    }
}

fn listed(names: impl Iterator<Item = String>) -> String {
    let names: Vec<String> = names.collect();
    if names.is_empty() { "–".into() } else { names.join(", ") }
}
