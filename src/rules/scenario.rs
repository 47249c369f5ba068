//! Rule scenarios: a state, what happens, and the verdict that must come out.

use super::ball_names::{named, numbered, numbered_object};
use super::fact_json::read_fact;
use super::judge;
use super::shot::{Shot, watch};
use super::state::State;
use crate::events::{Call, Verdict};
use crate::ids::GameKind;
use crate::one_line::{one_line, without_place};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// Files with more scenarios, or scenarios with more events, are refused.
const LENGTH_MAX: usize = 100_000;

/// One scenario as its file has it.
///
/// State and events stay JSON until the game is known: each game has its own fields and balls, and
/// a scenario of a game that is not known here must not spoil its neighbours.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Scenario {
    /// Unique name.
    pub id: String,
    /// The game, by its short name.
    pub ruleset: String,
    /// What it is about.
    #[serde(default)]
    pub description: String,
    /// Table and game before the shot.
    #[serde(default)]
    pub state: Value,
    /// What was called.
    #[serde(default)]
    pub call: Value,
    /// What happens, in time order.
    #[serde(default)]
    pub events: Vec<Map<String, Value>>,
    /// The verdict that must come out.
    #[serde(default)]
    pub expect: Map<String, Value>,
}

/// A file of scenarios cannot be read.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ScenarioError {
    /// It is not what it should be.
    #[error(
        "line {line}, column {column}: {problem}; expected a JSON list of scenarios, each with \
         id, ruleset, state, call, events and expect"
    )]
    NoScenarios {
        /// Counted from 1.
        line: usize,
        /// Counted from 1.
        column: usize,
        /// What is wrong.
        problem: String,
    },
    /// It is far too long.
    #[error("{count} {what}: at most {LENGTH_MAX} are read; split the file")]
    TooMany {
        /// How many there are.
        count: usize,
        /// Of what.
        what: String,
    },
}

/// Whether a scenario came out as expected.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ScenarioStatus {
    /// It did.
    Pass,
    /// It did not, or could not be judged.
    Fail,
    /// Its game is not known here.
    Unsupported,
}

/// What came of a scenario.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ScenarioResult {
    /// The scenario.
    pub id: String,
    /// Whether it came out as expected.
    pub status: ScenarioStatus,
    /// What the file expects.
    pub expected: Map<String, Value>,
    /// The verdict, in the same form; empty if there is none.
    pub got: Map<String, Value>,
    /// Where the two differ, or why there is no verdict.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub differences: Vec<Difference>,
    /// The verdict itself.
    #[serde(skip)]
    pub verdict: Option<Verdict>,
}

/// One difference between expectation and verdict.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Difference {
    /// The key of the verdict, or of the scenario where that cannot be read.
    pub key: String,
    /// What is wrong, for people.
    pub problem: String,
}

/// Reads a file of scenarios.
pub fn read_scenarios(text: &str) -> Result<Vec<Scenario>, ScenarioError> {
    let scenarios: Vec<Scenario> =
        serde_json::from_str(text).map_err(|error| ScenarioError::NoScenarios {
            line: error.line(),
            column: error.column(),
            problem: without_place(&error),
        })?;
    if scenarios.len() > LENGTH_MAX {
        return Err(ScenarioError::TooMany { count: scenarios.len(), what: "scenarios".into() });
    }
    match scenarios.iter().find(|scenario| scenario.events.len() > LENGTH_MAX) {
        Some(Scenario { id, events, .. }) => Err(ScenarioError::TooMany {
            count: events.len(),
            what: format!("events in scenario '{}'", one_line(id, 60)),
        }),
        None => Ok(scenarios),
    }
}

/// Judges a scenario and compares. Never fails otherwise than by its status.
pub fn run_scenario(scenario: &Scenario) -> ScenarioResult {
    let (got, verdict, differences) = match verdict_of(scenario) {
        Ok(verdict) => {
            let got = form_of(scenario, &verdict);
            let differences = compare(&scenario.expect, &got);
            (got, Some(verdict), differences)
        }
        Err(difference) => (Map::new(), None, vec![difference]),
    };
    ScenarioResult {
        id: scenario.id.clone(),
        status: match differences.first() {
            None => ScenarioStatus::Pass,
            Some(first) if first.key == "ruleset" => ScenarioStatus::Unsupported,
            Some(_) => ScenarioStatus::Fail,
        },
        expected: scenario.expect.clone(),
        got,
        differences,
        verdict,
    }
}

fn verdict_of(scenario: &Scenario) -> Result<Verdict, Difference> {
    let problem = |key: &str, problem: String| Difference {
        key: key.into(),
        problem: one_line(&problem, 400),
    };
    let game: GameKind = scenario
        .ruleset
        .parse()
        .map_err(|error: super::UnknownGame| problem("ruleset", error.to_string()))?;
    let in_numbers = |value: &Value| {
        let mut value = value.clone();
        numbered(game, &mut value);
        value
    };
    let state: State = match in_numbers(&scenario.state) {
        Value::Null => State::default(),
        value => State::deserialize(value).map_err(|error| problem("state", error.to_string()))?,
    };
    let call = Option::<Call>::deserialize(in_numbers(&scenario.call)).map_err(|_| {
        let allowed = r#"null, {"ball","pocket"}, "safety" or "push_out""#;
        problem("call", format!("{}: expected {allowed}", scenario.call))
    })?;

    let mut shot = Shot::of(state.cue_ball);
    for (i, event) in scenario.events.iter().enumerate() {
        let fact = read_fact(numbered_object(game, event.clone()))
            .map_err(|error| problem(&format!("events[{i}]"), error.problem))?;
        watch(&mut shot, &fact);
        if shot.settled {
            return Ok(judge(game, &state, call.as_ref(), &shot));
        }
    }
    Err(problem("events", "nothing settles, so there is no verdict".into()))
}

/// The verdict in the form of a scenario's expectation.
fn form_of(scenario: &Scenario, verdict: &Verdict) -> Map<String, Value> {
    let mut value = serde_json::to_value(verdict).unwrap_or_default();
    if let Ok(game) = scenario.ruleset.parse() {
        named(game, &mut value);
    }
    match value {
        Value::Object(object) => object,
        _ => Map::new(),
    }
}

/// The keys that an expectation can have. One that is absent expects null, none, empty, false or
/// 0; only what becomes of the turn has no such value and is then not compared.
const KEYS: [&str; 16] = [
    "legal",
    "fouls",
    "turn",
    "next_player",
    "groups",
    "winner",
    "ball_in_hand",
    "spot",
    "chooser",
    "options",
    "fouls_after",
    "points",
    "ball_on_next",
    "free_ball",
    "pocketed",
    "rack",
];

fn compare(expected: &Map<String, Value>, got: &Map<String, Value>) -> Vec<Difference> {
    let unknown = expected.keys().filter(|key| !KEYS.contains(&key.as_str())).map(|key| {
        let problem = format!("no such key; the keys are {}", KEYS.join(", "));
        Difference { key: one_line(key, 60), problem }
    });
    let keys = KEYS.into_iter().filter(|key| {
        // The file format says nothing of what fell and what is racked; who writes it gets it
        // compared.
        let is_optional = ["turn", "pocketed", "rack"].contains(key);
        !is_optional || expected.contains_key(*key)
    });
    let different = keys.filter_map(|key| {
        let (want, have) = (expected.get(key), got.get(key));
        (normal(key, want) != normal(key, have)).then(|| {
            let show = |value: Option<&Value>| value.unwrap_or(&Value::Null).to_string();
            let problem = format!("expected {}, got {}", show(want), show(have));
            Difference { key: key.into(), problem: one_line(&problem, 400) }
        })
    });
    different.chain(unknown).collect()
}

/// A value as it is compared: whatever means nothing is null, and sets are sorted.
fn normal(key: &str, value: Option<&Value>) -> Value {
    let is_set = ["fouls", "spot", "options"].contains(&key);
    match value {
        Some(value) if means_nothing(value) => Value::Null,
        Some(Value::Array(items)) if is_set => {
            let mut items = items.clone();
            items.sort_by_key(Value::to_string);
            Value::Array(items)
        }
        Some(value) => value.clone(),
        None => Value::Null,
    }
}

fn means_nothing(value: &Value) -> bool {
    match value {
        Value::Null => true,
        Value::Bool(flag) => !flag,
        Value::Number(number) => number.as_f64() == Some(0.0),
        Value::String(text) => text.is_empty() || text == "none",
        Value::Array(items) => items.is_empty(),
        Value::Object(fields) => fields.values().all(means_nothing),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_of_something_else_is_refused_with_its_place() {
        let error = read_scenarios("[\n {\"id\": 3}\n]").unwrap_err();
        assert!(matches!(error, ScenarioError::NoScenarios { line: 2, .. }), "{error}");
        assert!(error.to_string().contains("expected a JSON list"), "{error}");
        assert!(read_scenarios("not json").is_err());
    }

    #[test]
    fn an_expectation_that_is_wrong_in_one_key_names_it() {
        let text = r#"[{"id":"a","ruleset":"free_play","state":{"on_table":["1"]},
            "events":[{"t":0,"e":"tip","ball":"0"},{"t":1,"e":"settle"}],
            "expect":{"legal":true,"turn":"continue","next_player":2}}]"#;
        let result = run_scenario(&read_scenarios(text).unwrap()[0]);
        assert_eq!(result.status, ScenarioStatus::Fail);
        assert_eq!(result.differences.len(), 1, "{result:?}");
        assert_eq!(result.differences[0].key, "next_player");
        assert_eq!(result.differences[0].problem, "expected 2, got 1");
    }

    #[test]
    fn what_cannot_be_judged_says_why() {
        #[track_caller]
        fn check(text: &str, key: &str, part: &str) {
            let result = run_scenario(&read_scenarios(text).unwrap()[0]);
            let unknown = key == "ruleset";
            let status = if unknown { ScenarioStatus::Unsupported } else { ScenarioStatus::Fail };
            assert_eq!(result.status, status);
            assert_eq!(result.differences[0].key, key);
            assert!(result.differences[0].problem.contains(part), "{result:?}");
        }
        check(r#"[{"id":"a","ruleset":"shove"}]"#, "ruleset", "unknown game 'shove'");
        check(r#"[{"id":"a","ruleset":"paper8","events":[]}]"#, "events", "nothing settles");
        check(
            r#"[{"id":"a","ruleset":"paper8","state":{"player":7}}]"#,
            "state",
            "expected 1 or 2",
        );
        check(
            r#"[{"id":"a","ruleset":"paper8","events":[{"t":0,"e":"hop"}]}]"#,
            "events[0]",
            "expected one of",
        );
        check(r#"[{"id":"a","ruleset":"paper8","call":"left"}]"#, "call", "push_out");
    }
}
