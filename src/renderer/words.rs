//! The words in the window, in one language.

use crate::rules::Language;

/// The words of one language; the sentences of the rules are beside them in the same file.
#[derive(Debug, Clone)]
pub struct Words {
    table: toml::Table,
    help: Vec<(String, String)>,
    help_felt: Vec<(String, String)>,
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
        let table = file.get(section).and_then(toml::Value::as_table).cloned().unwrap_or_default();
        let text = |row: &toml::Value, key: &str| {
            row.get(key).and_then(toml::Value::as_str).unwrap_or_default().to_string()
        };
        let rows = |key: &str| {
            let rows = table.get(key).and_then(toml::Value::as_array).into_iter().flatten();
            rows.map(|row| (text(row, "keys"), text(row, "does"))).collect()
        };
        Words { help: rows("help"), help_felt: rows("help_felt"), table }
    }

    /// The text at a key; the key itself where there is none, so that nothing is ever silent.
    pub fn get(&self, key: &str) -> String {
        self.table.get(key).and_then(toml::Value::as_str).unwrap_or(key).to_string()
    }

    /// The same with something filled in.
    pub fn fill(&self, key: &str, place: &str, value: &str) -> String {
        self.get(key).replace(&format!("{{{place}}}"), value)
    }

    /// The controls: what to press and what it does.
    pub fn help(&self) -> &[(String, String)] {
        &self.help
    }

    /// The controls while a mouse moves the hand at a haptic device.
    pub fn help_felt(&self) -> &[(String, String)] {
        &self.help_felt
    }

    /// All keys, for comparing languages.
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.table.keys().map(String::as_str)
    }
}
