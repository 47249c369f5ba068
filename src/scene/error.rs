//! What is wrong with a scene, in one line that says how to put it right.

use crate::one_line::one_line;

/// The first thing that is wrong with a scene file.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{file}:{line}: {key}{}: {allowed}; {fix}", found_text(found))]
pub struct SceneError {
    /// The file, as the caller named it.
    pub file: Box<str>,
    /// Line number from 1.
    pub line: usize,
    /// Path of the key, such as `ball[2].mass_kg`; entries of a list count from 0.
    pub key: Box<str>,
    /// What stands there, as it is written; none if something is missing.
    pub found: Option<Box<str>>,
    /// What is allowed there.
    pub allowed: Box<str>,
    /// What to do.
    pub fix: Box<str>,
}

fn found_text(found: &Option<Box<str>>) -> String {
    found.as_ref().map(|found| format!(" = {found}")).unwrap_or_default()
}

impl SceneError {
    /// Builds an error; all its parts are made fit for one line.
    pub(super) fn new(
        file: &str,
        line: usize,
        key: &str,
        found: Option<&str>,
        allowed: &str,
        fix: &str,
    ) -> Self {
        SceneError {
            file: one_line(file, 200).into(),
            line,
            key: one_line(key, 120).into(),
            found: found.map(|found| one_line(found, 60).into()),
            allowed: one_line(allowed, 400).into(),
            fix: one_line(fix, 400).into(),
        }
    }
}

/// The candidate that was probably meant by `word`: the same quantity in another unit, or a
/// spelling that is a few letters away.
pub(super) fn meant<'c>(word: &str, candidates: &[&'c str]) -> Option<&'c str> {
    // Longer words are no slips of the pen, and would make the distance expensive.
    if word.len() > 64 {
        return None;
    }
    let same_quantity = |candidate: &&&str| stem(candidate) == stem(word);
    candidates.iter().find(same_quantity).copied().or_else(|| {
        let (best, distance) = candidates
            .iter()
            .map(|candidate| (*candidate, edit_distance(word, candidate)))
            .min_by_key(|(_, distance)| *distance)?;
        (distance <= 1 + word.chars().count() / 6).then_some(best)
    })
}

/// A key without the unit at its end.
fn stem(key: &str) -> &str {
    // Longest first, so that `_m_s` is not taken for `_s`.
    const UNITS: [&str; 26] = [
        "_nm_rad", "_rad_s2", "_n_m", "_ns_m", "_m_s2", "_rad_s", "_deg_s", "_km_h", "_m_s",
        "_mm_s", "_cm_s", "_rpm", "_deg", "_rad", "_ms", "_us", "_ns", "_mm", "_cm", "_km", "_kg",
        "_in", "_g", "_m", "_s", "_h",
    ];
    UNITS.iter().find_map(|unit| key.strip_suffix(unit)).unwrap_or(key)
}

/// How many letters must be inserted, deleted or replaced to make `b` of `a` (Levenshtein, 1965).
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, from) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, to) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(from != *to);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(row[j + 1] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_meant_key_is_found_by_its_quantity_or_its_spelling() {
        let keys = ["step_ms", "solver", "gravity_m_s2", "radius_m"];
        assert_eq!(meant("step_s", &keys), Some("step_ms"));
        assert_eq!(meant("step", &keys), Some("step_ms"));
        assert_eq!(meant("radius_mm", &keys), Some("radius_m"));
        assert_eq!(meant("gravity", &keys), Some("gravity_m_s2"));
        assert_eq!(meant("sovler", &keys), Some("solver"));
        assert_eq!(meant("banana", &keys), None);
    }

    #[test]
    fn distances_are_those_of_the_textbook() {
        assert_eq!(edit_distance("kitten", "sitting"), 3);
        assert_eq!(edit_distance("", "abc"), 3);
        assert_eq!(edit_distance("same", "same"), 0);
    }
}
