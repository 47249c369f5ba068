//! Reads a catalogue.

use super::error::CatalogueError;
use super::judge::Tolerance;
use super::kinds::{self, LAWS};
use super::setup::Setup;
use serde_json::{Map, Value};

const CASE_KEYS: [&str; 14] = [
    "id",
    "group",
    "title",
    "kind",
    "kind_of_run",
    "law",
    "setup",
    "expect",
    "tolerance",
    "reference",
    "formula",
    "source",
    "verified",
    "note",
];
/// Most cases of a file.
const CASES_MAX: usize = 10_000;
/// Most runs of a case.
const RUNS_MAX: usize = 100_000;

/// Cases with known answers.
#[derive(Debug, Clone)]
pub struct Catalogue {
    /// In the order of the file.
    pub cases: Vec<Case>,
}

/// A case.
#[derive(Debug, Clone)]
pub struct Case {
    /// Its name.
    pub id: String,
    /// What it is about.
    pub title: String,
    pub(super) kind_of_run: String,
    /// The setup of each run, with the law that it presumes.
    pub(super) runs: Vec<(String, Map<String, Value>)>,
    pub(super) expect: Vec<Expectation>,
    pub(super) tolerance: Tolerance,
}

/// What must come out.
#[derive(Debug, Clone)]
pub(super) struct Expectation {
    /// The key as the file writes it.
    pub key: String,
    /// One value a run; none where the file says nothing.
    pub values: Vec<Value>,
}

impl Expectation {
    /// What is to be observed: the key without `measured_` and `model_`.
    pub fn observable(&self) -> &str {
        let key = self.key.strip_prefix("measured_").unwrap_or(&self.key);
        key.strip_prefix("model_").unwrap_or(key)
    }
}

impl Catalogue {
    /// Reads the text of a catalogue. Kinds of run that this build does not know are kept and will
    /// be unsupported; anything else that it does not know is an error.
    pub fn parse(text: &str) -> Result<Catalogue, CatalogueError> {
        let value: Value =
            serde_json::from_str(text).map_err(|e| CatalogueError::Json(e.to_string()))?;
        let shape = |key: &str, problem: &str, fix: &str| CatalogueError::shape(key, problem, fix);
        let Value::Object(root) = value else {
            return Err(shape("the file", "is no JSON object", "write {\"cases\": [..]}"));
        };
        let known = ["schema", "conventions", "cases"];
        if let Some(key) = root.keys().find(|key| !known.contains(&key.as_str())) {
            let fix = "a catalogue has the keys schema, conventions, cases";
            return Err(shape(key, "is no key of a catalogue", fix));
        }
        if root.get("schema").is_some_and(|schema| schema.as_str() != Some("validation-cases/2")) {
            let fix = "this build reads \"validation-cases/2\"";
            return Err(shape("schema", "is another format", fix));
        }
        let Some(Value::Array(cases)) = root.get("cases") else {
            return Err(shape("cases", "is no list", "write {\"cases\": [..]}"));
        };
        if cases.len() > CASES_MAX {
            return Err(shape("cases", "has too many entries", "list at most 10000"));
        }
        let cases = cases
            .iter()
            .enumerate()
            .map(|(number, case)| read_case(number, case))
            .collect::<Result<Vec<Case>, _>>()?;
        let mut ids: Vec<&str> = cases.iter().map(|case| &*case.id).collect();
        ids.sort_unstable();
        if let Some(twice) = ids.windows(2).find(|pair| pair[0] == pair[1]) {
            let problem = "another case has this id";
            return Err(CatalogueError::case(twice[0], "id", problem, "give each its own"));
        }
        Ok(Catalogue { cases })
    }
}

fn read_case(number: usize, value: &Value) -> Result<Case, CatalogueError> {
    let place = format!("cases[{number}]");
    let Value::Object(case) = value else {
        return Err(CatalogueError::shape(&place, "is no JSON object", "write {\"id\": ..}"));
    };
    let Some(id) = case.get("id").and_then(Value::as_str) else {
        return Err(CatalogueError::shape(&place, "has no id", "write \"id\": \"A01\""));
    };
    let wrong = |key: &str, problem: &str, fix: &str| CatalogueError::case(id, key, problem, fix);
    if let Some(key) = case.keys().find(|key| !CASE_KEYS.contains(&key.as_str())) {
        let fix = format!("a case has the keys {}", CASE_KEYS.join(", "));
        return Err(wrong(key, "is no key of a case", &fix));
    }
    let text = |key: &str| case.get(key).and_then(Value::as_str);
    let Some(kind_of_run) = text("kind_of_run") else {
        return Err(wrong("kind_of_run", "missing", "name the runner"));
    };
    let object = |key: &str| match case.get(key) {
        Some(Value::Object(object)) => Ok(object.clone()),
        None if key == "tolerance" => Ok(Map::new()),
        _ => Err(wrong(key, "is no JSON object", "write an object with keys")),
    };
    let (setup, expect) = (object("setup")?, object("expect")?);
    let law = match case.get("law") {
        None => "default",
        Some(law) => law.as_str().ok_or_else(|| wrong("law", "is no text", "name a law"))?,
    };
    let (runs, many) = read_runs(id, law, setup)?;
    let mut expectations = Vec::new();
    for (key, value) in expect {
        let values = match value {
            Value::Array(list) if many && list.len() == runs.len() => list,
            _ if many => {
                let fix =
                    format!("write a list of {} values, null where nothing is stated", runs.len());
                return Err(wrong(&key, "has not the shape of one value a run", &fix));
            }
            value => vec![value],
        };
        expectations.push(Expectation { key, values });
    }
    let keys: Vec<&str> = expectations.iter().map(|expect| &*expect.key).collect();
    let tolerance = Tolerance::read(id, &object("tolerance")?, &keys)?;
    let case = Case {
        id: id.to_string(),
        title: text("title").unwrap_or_default().to_string(),
        kind_of_run: kind_of_run.to_string(),
        runs,
        expect: expectations,
        tolerance,
    };
    check_vocabulary(&case)?;
    Ok(case)
}

/// The runs of a setup, and whether it listed them.
#[allow(clippy::type_complexity)]
fn read_runs(
    id: &str,
    law: &str,
    mut setup: Map<String, Value>,
) -> Result<(Vec<(String, Map<String, Value>)>, bool), CatalogueError> {
    let wrong = |problem: &str, fix: &str| CatalogueError::case(id, "runs", problem, fix);
    let Some(runs) = setup.remove("runs") else {
        let law = take_law(id, &mut setup)?.unwrap_or_else(|| law.to_string());
        return Ok((vec![(law, setup)], false));
    };
    let Value::Array(runs) = runs else { return Err(wrong("is no list", "write a list of runs")) };
    if runs.is_empty() || runs.len() > RUNS_MAX {
        return Err(wrong("has no or too many entries", "list 1 to 100000 runs"));
    }
    let mut merged = Vec::with_capacity(runs.len());
    for run in runs {
        let Value::Object(run) = run else {
            return Err(wrong("an entry is no object", "write objects with keys of the setup"));
        };
        let mut values = setup.clone();
        values.extend(run);
        let own = take_law(id, &mut values)?;
        merged.push((own.unwrap_or_else(|| law.to_string()), values));
    }
    Ok((merged, true))
}

fn take_law(id: &str, setup: &mut Map<String, Value>) -> Result<Option<String>, CatalogueError> {
    match setup.remove("law") {
        None => Ok(None),
        Some(Value::String(law)) => Ok(Some(law)),
        Some(_) => Err(CatalogueError::case(id, "law", "is no text", "name a law")),
    }
}

/// Every key is one that the kind knows, and every value has its shape.
fn check_vocabulary(case: &Case) -> Result<(), CatalogueError> {
    let Some(kind) = kinds::kind(&case.kind_of_run) else { return Ok(()) };
    let wrong = |key: &str, problem: String, fix: &str| {
        Err(CatalogueError::case(&case.id, key, problem, fix))
    };
    for expect in &case.expect {
        if !kind.expect.contains(&expect.observable()) {
            let problem = format!("{} cannot tell it", kind.name);
            let fix = format!("it can tell {}", kind.expect.join(", "));
            return wrong(&expect.key, problem, &fix);
        }
    }
    for (law, values) in &case.runs {
        if !LAWS.contains(&&**law) {
            let fix = format!("the laws are {}", LAWS.join(", "));
            return wrong("law", format!("there is no law '{law}'"), &fix);
        }
        let known = |key: &str| kind.required.contains(&key) || kind.optional.contains(&key);
        if let Some(key) = values.keys().find(|key| !known(key)) {
            let fix = format!("it has {}", [kind.required, kind.optional].concat().join(", "));
            return wrong(key, format!("{} has no such key", kind.name), &fix);
        }
        if let Some(key) = kind.required.iter().find(|key| !values.contains_key(**key)) {
            return wrong(key, "missing".into(), "this kind of run needs it");
        }
        Setup { id: &case.id, law, values }.check()?;
    }
    Ok(())
}
