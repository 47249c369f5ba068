//! Names of balls in rule files: numbers in pool, letters where a game has its own.

use super::games::game;
use crate::ids::{BallId, GameKind};
use serde_json::{Map, Value};

/// Keys under which rule files write balls.
const KEYS: [&str; 13] = [
    "ball",
    "a",
    "b",
    "on_table",
    "cue_ball",
    "on",
    "nominated",
    "spot",
    "pocketed",
    "ball_on_next",
    "frozen",
    "frozen_to_cue",
    "legal_first",
];

/// What a game calls a ball.
pub fn ball_name(kind: GameKind, ball: BallId) -> String {
    let name = game(kind).names.get(usize::from(ball.0));
    name.map_or_else(|| ball.to_string(), |name| name.to_string())
}

/// The ball that a game calls so; none if it has none of that name.
pub fn ball_named(kind: GameKind, name: &str) -> Option<BallId> {
    let names = game(kind).names;
    if names.is_empty() {
        return name.parse().ok().map(BallId);
    }
    names.iter().position(|other| *other == name).map(|number| BallId(number as u16))
}

/// Writes numbers for names, wherever a rule file has a ball. What is no name of a ball is left to
/// whoever reads the value.
pub(super) fn numbered(kind: GameKind, value: &mut Value) {
    let number = |name: &str| ball_named(kind, name).map(|ball| ball.to_string());
    rename(game(kind).names, value, false, &number);
}

/// [`numbered`] for an object.
pub(super) fn numbered_object(kind: GameKind, object: Map<String, Value>) -> Map<String, Value> {
    let mut value = Value::Object(object);
    numbered(kind, &mut value);
    match value {
        Value::Object(object) => object,
        _ => Map::new(),
    }
}

/// Writes names for numbers.
pub(super) fn named(kind: GameKind, value: &mut Value) {
    let name = |number: &str| Some(ball_name(kind, BallId(number.parse().ok()?)));
    rename(game(kind).names, value, false, &name);
}

fn rename(
    names: &[&str],
    value: &mut Value,
    is_ball: bool,
    change: &impl Fn(&str) -> Option<String>,
) {
    // Where balls have numbers there is nothing to change.
    if names.is_empty() {
        return;
    }
    match value {
        Value::String(text) if is_ball => {
            if let Some(other) = change(text) {
                *text = other;
            }
        }
        Value::Array(items) => {
            items.iter_mut().for_each(|item| rename(names, item, is_ball, change));
        }
        Value::Object(fields) => {
            for (key, field) in fields {
                rename(names, field, KEYS.contains(&key.as_str()), change);
            }
        }
        _ => {}
    }
}
