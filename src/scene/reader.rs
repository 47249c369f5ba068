//! Reads typed values out of a parsed TOML text and knows on which line each of them stands.

use super::SceneError;
use super::error::meant;
use crate::one_line::is_one_line;
use glam::DVec3;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Longest string that is accepted [characters].
const STRING_MAX: usize = 4096;

/// A file's name and text: where errors point to.
pub(super) struct Source<'t> {
    pub file: &'t str,
    pub text: &'t str,
}

impl Source<'_> {
    /// Line number from 1 of a byte of the text.
    pub fn line(&self, offset: usize) -> usize {
        let before = self.text.as_bytes().iter().take(offset);
        1 + before.filter(|byte| **byte == b'\n').count()
    }

    /// What is written at `span`.
    fn written(&self, span: Range<usize>) -> &str {
        self.text.get(span).unwrap_or_default()
    }

    /// An error at what is written at `span`.
    pub fn error(&self, span: Range<usize>, key: &str, allowed: &str, fix: &str) -> SceneError {
        let line = self.line(span.start);
        SceneError::new(self.file, line, key, Some(self.written(span)), allowed, fix)
    }
}

/// The numbers that make sense for a key.
#[derive(Clone, Copy)]
pub(super) struct Limits {
    pub low: f64,
    pub high: f64,
    /// Unit as the message writes it; empty for a pure number.
    pub unit: &'static str,
    /// A value that would do.
    pub example: &'static str,
}

impl Limits {
    fn range(&self) -> String {
        let space = if self.unit.is_empty() { "" } else { " " };
        format!(" from {} to {}{space}{}", self.low, self.high, self.unit)
    }

    fn allowed(&self) -> String {
        format!("expected a number{}", self.range())
    }
}

/// A table of the file: a section, an entry of a list, or an inline table.
pub(super) struct Section<'t> {
    source: &'t Source<'t>,
    /// Its path, such as `physics` or `ball[2]`.
    path: String,
    table: &'t DeTable<'t>,
    /// Where it begins.
    start: usize,
}

impl<'t> Section<'t> {
    /// The whole file.
    pub fn root(source: &'t Source<'t>, table: &'t DeTable<'t>) -> Self {
        Section { source, path: String::new(), table, start: 0 }
    }

    /// The line where it begins.
    pub fn line(&self) -> usize {
        self.source.line(self.start)
    }

    /// The path of a key in it.
    fn key(&self, key: &str) -> String {
        if self.path.is_empty() { key.to_string() } else { format!("{}.{key}", self.path) }
    }

    fn value(&self, key: &str) -> Option<&'t Spanned<DeValue<'t>>> {
        self.table.get(key)
    }

    /// An error about the value of `key`.
    pub fn error(&self, key: &str, allowed: &str, fix: &str) -> SceneError {
        match self.value(key) {
            Some(value) => self.source.error(value.span(), &self.key(key), allowed, fix),
            None => self.missing(key, allowed, fix),
        }
    }

    /// An error about `key`, which is not there.
    pub fn missing(&self, key: &str, allowed: &str, fix: &str) -> SceneError {
        let (file, line) = (self.source.file, self.line());
        let key = self.key(key);
        SceneError::new(file, line, &key, None, &format!("missing, {allowed}"), fix)
    }

    /// An error about the section or list `key` as a whole.
    pub fn error_about(&self, key: &str, allowed: &str, fix: &str) -> SceneError {
        let first = self.value(key).map(|value| match value.get_ref() {
            DeValue::Array(array) => array.first().map_or(value.span(), Spanned::span),
            _ => value.span(),
        });
        let line = self.source.line(first.map_or(self.start, |span| span.start));
        SceneError::new(self.source.file, line, &self.key(key), None, allowed, fix)
    }

    /// Refuses every key but these; the first one in the file that is none of them is named.
    pub fn allow(&self, keys: &[&str]) -> Result<(), SceneError> {
        let strange = self.table.iter().filter(|(key, _)| !keys.contains(&&**key.get_ref()));
        let Some((key, value)) = strange.min_by_key(|(key, _)| key.span().start) else {
            return Ok(());
        };
        let list = keys.join(", ");
        let (what, allowed) = match &*self.path {
            "" => ("section", format!("this build knows the sections {list}")),
            path if keys.is_empty() => ("key", format!("{path} has no keys")),
            path => ("key", format!("{path} has the keys {list}")),
        };
        let word: &str = key.get_ref();
        let fix = match meant(word, keys) {
            Some(meant) => format!("did you mean {meant}?"),
            None => format!("remove this {what}"),
        };
        // A section's header says more than its content, which may be long.
        let written = (!value.get_ref().is_table() && !value.get_ref().is_array())
            .then(|| self.source.written(value.span()));
        let line = self.source.line(key.span().start);
        Err(SceneError::new(self.source.file, line, &self.key(word), written, &allowed, &fix))
    }

    /// The table at `key`.
    pub fn section(&self, key: &str) -> Result<Option<Section<'t>>, SceneError> {
        let Some(value) = self.value(key) else { return Ok(None) };
        let path = self.key(key);
        match value.get_ref() {
            DeValue::Table(table) => {
                Ok(Some(Section { source: self.source, path, table, start: value.span().start }))
            }
            DeValue::Array(_) if self.path.is_empty() => Err(SceneError::new(
                self.source.file,
                self.source.line(value.span().start),
                &path,
                None,
                "must be one section",
                &format!("write [{key}] once, with single brackets"),
            )),
            _ => {
                let fix = match &*self.path {
                    "" => format!("write [{key}]"),
                    _ => format!("write {key} = {{ .. }} with its keys inside"),
                };
                Err(self.error(key, "must be a table of keys", &fix))
            }
        }
    }

    /// The entries of the list of tables at `key`, at most `limit`.
    pub fn entries(&self, key: &str, limit: usize) -> Result<Vec<Section<'t>>, SceneError> {
        let Some(value) = self.value(key) else { return Ok(Vec::new()) };
        let brackets = format!("write [[{key}]] with double brackets");
        let DeValue::Array(array) = value.get_ref() else {
            let line = self.source.line(value.span().start);
            let path = self.key(key);
            let allowed = "must be a list of entries";
            return Err(SceneError::new(self.source.file, line, &path, None, allowed, &brackets));
        };
        if array.len() > limit {
            let line = self.source.line(array[limit].span().start);
            return Err(SceneError::new(
                self.source.file,
                line,
                &format!("{}[{limit}]", self.key(key)),
                None,
                &format!("at most {limit} entries of {key} are allowed"),
                &format!("remove {}", array.len() - limit),
            ));
        }
        let entry = |(i, value): (usize, &'t Spanned<DeValue<'t>>)| {
            let path = format!("{}[{i}]", self.key(key));
            match value.get_ref() {
                DeValue::Table(table) => {
                    Ok(Section { source: self.source, path, table, start: value.span().start })
                }
                _ => Err(self.source.error(
                    value.span(),
                    &path,
                    "must be a table of keys",
                    &brackets,
                )),
            }
        };
        array.iter().enumerate().map(entry).collect()
    }

    /// The number at `key`.
    pub fn number(&self, key: &str, limits: Limits) -> Result<Option<f64>, SceneError> {
        let Some(value) = self.value(key) else { return Ok(None) };
        let fix = format!("write for example {key} = {}", limits.example);
        self.one_number(value, &self.key(key), limits, &fix).map(Some)
    }

    fn one_number(
        &self,
        value: &Spanned<DeValue<'_>>,
        key: &str,
        limits: Limits,
        fix: &str,
    ) -> Result<f64, SceneError> {
        let number = match value.get_ref() {
            DeValue::Float(float) => float.as_str().parse::<f64>().ok(),
            DeValue::Integer(integer) => {
                i64::from_str_radix(integer.as_str(), integer.radix()).ok().map(|n| n as f64)
            }
            _ => None,
        };
        match number {
            Some(number) if limits.low <= number && number <= limits.high => Ok(number),
            _ => Err(self.source.error(value.span(), key, &limits.allowed(), fix)),
        }
    }

    /// The whole number at `key`.
    pub fn integer(
        &self,
        key: &str,
        range: std::ops::RangeInclusive<u64>,
    ) -> Result<Option<u64>, SceneError> {
        let Some(value) = self.value(key) else { return Ok(None) };
        let number = value
            .get_ref()
            .as_integer()
            .and_then(|integer| u64::from_str_radix(integer.as_str(), integer.radix()).ok());
        match number {
            Some(number) if range.contains(&number) => Ok(Some(number)),
            _ => Err(self.error(
                key,
                &format!("expected a whole number from {} to {}", range.start(), range.end()),
                &format!("write for example {key} = {}", range.start()),
            )),
        }
    }

    /// The text at `key`.
    pub fn text(&self, key: &str, example: &str) -> Result<Option<String>, SceneError> {
        let Some(value) = self.value(key) else { return Ok(None) };
        let fix = format!("write for example {key} = \"{example}\"");
        let allowed = format!("expected a line in quotes, at most {STRING_MAX} characters");
        match value.get_ref().as_str() {
            Some(text) if is_one_line(text, STRING_MAX) => Ok(Some(text.to_string())),
            _ => Err(self.error(key, &allowed, &fix)),
        }
    }

    /// `true` or `false` at `key`.
    pub fn switch(&self, key: &str) -> Result<Option<bool>, SceneError> {
        let Some(value) = self.value(key) else { return Ok(None) };
        match value.get_ref().as_bool() {
            Some(switch) => Ok(Some(switch)),
            None => Err(self.error(key, "expected true or false", &format!("write {key} = true"))),
        }
    }

    /// One of a few words at `key`. The first word of each choice is the name, others are known
    /// as well.
    pub fn choice<T: Copy>(
        &self,
        key: &str,
        choices: &[(&[&'static str], T)],
    ) -> Result<Option<T>, SceneError> {
        let Some(value) = self.value(key) else { return Ok(None) };
        let word = value.get_ref().as_str();
        let found = word.and_then(|word| choices.iter().find(|(names, _)| names.contains(&word)));
        if let Some((_, choice)) = found {
            return Ok(Some(*choice));
        }
        let names: Vec<&str> = choices.iter().map(|(names, _)| names[0]).collect();
        let quoted: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
        // Somebody who forgot the quotes meant the word as well.
        let word = word.unwrap_or(self.source.written(value.span()));
        let fix = match meant(word, &names) {
            Some(meant) => format!("did you mean \"{meant}\"?"),
            None => format!("write for example {key} = {}", quoted[0]),
        };
        let allowed = match &*quoted {
            [only] => format!("this build knows only {only}"),
            all => format!("this build knows {}", all.join(", ")),
        };
        Err(self.error(key, &allowed, &fix))
    }

    /// The list of `count` numbers at `key`.
    pub fn numbers<const N: usize>(
        &self,
        key: &str,
        limits: Limits,
    ) -> Result<Option<[f64; N]>, SceneError> {
        let Some(value) = self.value(key) else { return Ok(None) };
        let example = vec![limits.example; N].join(", ");
        let fix = format!("write for example {key} = [{example}]");
        let array = match value.get_ref() {
            DeValue::Array(array) if array.len() == N => array,
            _ => {
                let allowed = format!("expected a list of {N} numbers{}", limits.range());
                return Err(self.error(key, &allowed, &fix));
            }
        };
        let mut numbers = [0.0; N];
        for (i, (number, value)) in numbers.iter_mut().zip(array.iter()).enumerate() {
            *number = self.one_number(value, &format!("{}[{i}]", self.key(key)), limits, &fix)?;
        }
        Ok(Some(numbers))
    }

    /// The vector at `key`.
    pub fn vector(&self, key: &str, limits: Limits) -> Result<Option<DVec3>, SceneError> {
        Ok(self.numbers::<3>(key, limits)?.map(DVec3::from_array))
    }

    /// How many elements the list at `key` has, if it is one.
    pub fn length(&self, key: &str) -> Option<usize> {
        self.value(key).and_then(|value| value.get_ref().as_array()).map(|array| array.len())
    }
}
