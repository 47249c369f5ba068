//! Compares what came out with what must come out.

use super::catalogue::{Case, Expectation};
use super::error::{CatalogueError, Trouble};
use super::kinds;
use super::observe;
use super::observed::{Observations, Observed};
use super::setup::Setup;
use crate::physics::SolverKind;
use serde::Serialize;
use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// How a case ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// Everything that is expected came out.
    Pass,
    /// Something else came out.
    Fail,
    /// This build, or this solver, cannot be asked.
    Unsupported,
}

/// The verdict on a case.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Outcome {
    /// The case.
    pub id: String,
    /// How it ended.
    pub status: Status,
    /// The expect key with the largest error over its limit.
    pub key: Option<String>,
    /// Its error; none if nothing came out.
    pub error: Option<f64>,
    /// What the error may be.
    pub limit: Option<f64>,
    /// Why it is unsupported, or did not get through.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// Tolerances of a case.
#[derive(Debug, Clone, Default)]
pub(super) struct Tolerance {
    rel: f64,
    abs: f64,
    realtime_rel: Option<f64>,
    realtime: BTreeMap<String, f64>,
    own: BTreeMap<String, Own>,
}

/// The entry of one key.
#[derive(Debug, Clone, Default)]
struct Own {
    /// One value, or one a run.
    rel: Vec<f64>,
    abs: Vec<f64>,
    interval: bool,
    bound: bool,
}

/// What holds for one key in one run.
#[derive(Debug, Clone, Copy)]
struct Rule {
    rel: f64,
    abs: f64,
    interval: bool,
    bound: bool,
    /// The key has an entry of its own, which also judges counts and truths.
    own: bool,
}

impl Tolerance {
    pub fn read(
        id: &str,
        entries: &Map<String, Value>,
        expected: &[&str],
    ) -> Result<Self, CatalogueError> {
        let fix = "write a number of 0 or more";
        let number = |key: &str, value: &Value| match value.as_f64() {
            Some(number) if number >= 0.0 => Ok(number),
            _ => Err(CatalogueError::case(id, key, "is no tolerance", fix)),
        };
        let object = |key: &str, value: &Value| match value {
            Value::Object(object) => Ok(object.clone()),
            _ => Err(CatalogueError::case(id, key, "is no JSON object", "write an object")),
        };
        let mut tolerance = Tolerance::default();
        for (key, value) in entries {
            match key.as_str() {
                "rel" => tolerance.rel = number(key, value)?,
                "abs" => tolerance.abs = number(key, value)?,
                "realtime_rel" => tolerance.realtime_rel = Some(number(key, value)?),
                "realtime" => {
                    for (key, value) in object(key, value)? {
                        let limit = number(&key, &value)?;
                        tolerance.realtime.insert(key, limit);
                    }
                }
                key if expected.contains(&key) => {
                    let mut own = Own::default();
                    for (name, value) in object(key, value)? {
                        match (name.as_str(), &value) {
                            ("interval", Value::Bool(yes)) => own.interval = *yes,
                            ("bound", Value::Bool(yes)) => own.bound = *yes,
                            ("rel" | "abs", value) => {
                                let list = match value {
                                    Value::Array(list) => {
                                        list.iter().map(|v| number(key, v)).collect()
                                    }
                                    value => number(key, value).map(|number| vec![number]),
                                }?;
                                if name == "rel" { own.rel = list } else { own.abs = list }
                            }
                            (name, _) => {
                                let problem = format!("'{name}' is no tolerance");
                                let fix = "write rel, abs, interval or bound";
                                return Err(CatalogueError::case(id, key, problem, fix));
                            }
                        }
                    }
                    tolerance.own.insert(key.to_string(), own);
                }
                key => {
                    let fix = "name a key of expect, rel, abs, realtime_rel or realtime";
                    return Err(CatalogueError::case(id, key, "is not expected", fix));
                }
            }
        }
        Ok(tolerance)
    }

    /// The rule for a key; none if the key is not asked of a stepping solver.
    fn rule(&self, key: &str, run: usize, stepping: bool) -> Option<Rule> {
        let own = self.own.get(key);
        let pick = |list: &[f64]| match list {
            [] => 0.0,
            [one] => *one,
            several => several.get(run).copied().unwrap_or(0.0),
        };
        let mut rule = match own {
            Some(own) => Rule {
                rel: pick(&own.rel),
                abs: pick(&own.abs),
                interval: own.interval,
                bound: own.bound,
                own: true,
            },
            None => {
                Rule { rel: self.rel, abs: self.abs, interval: false, bound: false, own: false }
            }
        };
        rule.bound |= key.starts_with("max_");
        if stepping {
            match (self.realtime.get(key), self.realtime_rel) {
                (Some(limit), _) => (rule.rel, rule.abs) = (0.0, *limit),
                (None, Some(rel)) => rule.rel = rule.rel.max(rel),
                (None, None) => return None,
            }
        }
        Some(rule)
    }
}

/// The error over its limit that is worst so far.
#[derive(Debug, Default)]
struct Worst {
    ratio: f64,
    found: Option<(String, Option<f64>, f64)>,
}

impl Worst {
    fn take(&mut self, key: &str, error: Option<f64>, limit: f64) {
        let ratio = match error {
            Some(error) if error <= 0.0 => 0.0,
            // 0/0 is met, x/0 is not.
            Some(error) if !error.is_nan() => error / limit,
            _ => f64::INFINITY,
        };
        if self.found.is_none() || ratio > self.ratio {
            self.ratio = ratio;
            self.found = Some((key.to_string(), error.filter(|e| e.is_finite()), limit));
        }
    }
}

/// Runs a case and judges it.
pub(super) fn judge(case: &Case, solver: SolverKind) -> Result<Outcome, CatalogueError> {
    let ended = |status, reason| Outcome {
        id: case.id.clone(),
        status,
        key: None,
        error: None,
        limit: None,
        reason: Some(reason),
    };
    let Some(kind) = kinds::kind(&case.kind_of_run) else {
        let name = super::error::one_line(&case.kind_of_run);
        return Ok(ended(Status::Unsupported, format!("this build knows no kind_of_run '{name}'")));
    };
    let stepping = kind.solved && solver == SolverKind::FixedStep;

    let mut worst = Worst::default();
    for (run, (law, values)) in case.runs.iter().enumerate() {
        let asked: Vec<(&Expectation, Rule)> = case
            .expect
            .iter()
            .filter(|expect| !expect.values[run].is_null())
            .filter_map(|expect| Some((expect, case.tolerance.rule(&expect.key, run, stepping)?)))
            .collect();
        if asked.is_empty() {
            continue;
        }
        let keys: Vec<&str> = asked.iter().map(|(expect, _)| expect.observable()).collect();
        let setup = Setup { id: &case.id, law, values };
        let seen = match observe(kind.name, &setup, &keys, solver) {
            Ok(seen) => seen,
            Err(Trouble::Wrong(error)) => return Err(error),
            Err(Trouble::Unsupported(why)) => return Ok(ended(Status::Unsupported, why)),
            Err(Trouble::Failed(why)) => return Ok(ended(Status::Fail, why)),
        };
        for (expect, rule) in &asked {
            compare(expect, run, rule, &seen, &mut worst);
        }
    }
    let Some((key, error, limit)) = worst.found else {
        let why = "the case states nothing that is asked of a solver with steps";
        return Ok(ended(Status::Unsupported, why.into()));
    };
    let passed = worst.ratio <= 1.0;
    let reason = error.is_none().then(|| format!("{key} did not come out"));
    let status = if passed { Status::Pass } else { Status::Fail };
    Ok(Outcome { id: case.id.clone(), status, key: Some(key), error, limit: Some(limit), reason })
}

fn compare(expect: &Expectation, run: usize, rule: &Rule, seen: &Observations, worst: &mut Worst) {
    let key = &expect.key;
    let expected = &expect.values[run];
    match seen.get(expect.observable()) {
        Some(observed) => compare_value(key, expected, observed, rule, worst),
        None => worst.take(key, None, 0.0),
    }
}

fn compare_value(key: &str, expected: &Value, observed: &Observed, rule: &Rule, worst: &mut Worst) {
    match (expected, observed) {
        (Value::Null, _) => {}
        (Value::Array(band), Observed::Number(value)) if rule.interval => {
            let ends: Option<Vec<f64>> = band.iter().map(Value::as_f64).collect();
            match ends.as_deref() {
                Some([low, high]) if low <= high => {
                    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
                    worst.take(key, Some((value - middle).abs()), half);
                }
                _ => worst.take(key, None, 0.0),
            }
        }
        (Value::Bool(expected), Observed::Truth(value)) => {
            let limit = if rule.own { rule.abs } else { 0.0 };
            worst.take(key, Some(f64::from(expected != value)), limit);
        }
        // The first of several balls is the one that the case speaks of.
        (Value::Number(_), Observed::List(list)) if !list.is_empty() => {
            compare_value(key, expected, &list[0], rule, worst);
        }
        (Value::Number(expected), Observed::Number(value)) => {
            number(key, expected.as_f64(), *value, None, rule, worst);
        }
        (Value::Number(expected), Observed::Count(value)) => {
            let exact = Rule { rel: 0.0, abs: 0.0, ..*rule };
            let rule = if rule.own { rule } else { &exact };
            number(key, expected.as_f64(), *value as f64, None, rule, worst);
        }
        (Value::Array(list), Observed::Vector(values)) if list.len() == values.len() => {
            let parts: Vec<Option<f64>> = list.iter().map(Value::as_f64).collect();
            let largest = parts.iter().flatten().fold(0.0_f64, |scale, x| scale.max(x.abs()));
            for ((part, value), given) in parts.iter().zip(values).zip(list) {
                if !given.is_null() {
                    number(key, *part, *value, Some(largest), rule, worst);
                }
            }
        }
        // Further impacts need not be listed.
        (Value::Array(list), Observed::List(values)) => {
            for (place, expected) in list.iter().enumerate() {
                match values.get(place) {
                    Some(value) => compare_value(key, expected, value, rule, worst),
                    None if expected.is_null() => {}
                    None => worst.take(key, None, 0.0),
                }
            }
        }
        _ => worst.take(key, None, 0.0),
    }
}

fn number(
    key: &str,
    expected: Option<f64>,
    value: f64,
    scale: Option<f64>,
    rule: &Rule,
    worst: &mut Worst,
) {
    let Some(expected) = expected else { return worst.take(key, None, 0.0) };
    let limit = (rule.rel * scale.unwrap_or(expected.abs())).max(rule.abs);
    if rule.bound {
        // Only above the bound there is anything wrong.
        worst.take(key, Some(value), expected + limit);
    } else {
        worst.take(key, Some((value - expected).abs()), limit);
    }
}
