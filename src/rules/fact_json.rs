//! One fact out of JSON, with a message that says which key is wrong and what it may be.

use crate::events::{Fact, FactKind};
use crate::ids::PlayerId;
use crate::one_line::one_line;
use serde_json::{Map, Value};

/// Why an object is no fact.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct NoFact {
    /// The key whose value is wrong; none if one is missing.
    pub key: Option<String>,
    /// What is wrong, and what is allowed.
    pub problem: String,
}

/// The tags of facts in rule files, and the names that reports give them.
const TAGS: [(&str, &str); 10] = [
    ("BallPlaced", "place"),
    ("CueBallStruck", "tip"),
    ("BallsCollided", "hit"),
    ("CushionHit", "cushion"),
    ("HeadStringCrossed", "cross_head"),
    ("BallPocketed", "pocket"),
    ("BallOffTable", "off"),
    ("BallTouched", "touch"),
    ("BallsFrozen", "frozen"),
    ("Settled", "settle"),
];

/// Reads a fact. Keys that it does not have are ignored. The tag `e` may also be given in its long
/// form, `"fact":"BallsCollided"`.
pub(super) fn read_fact(mut object: Map<String, Value>) -> Result<Fact, NoFact> {
    if !object.contains_key("e") {
        let name = object.get("fact").and_then(Value::as_str);
        if let Some((_, tag)) = TAGS.iter().find(|(long, _)| Some(*long) == name) {
            object.insert("e".into(), (*tag).into());
        }
    }
    let fact =
        parse(&object).map_err(|problem| NoFact { key: wrong_key(&object, &problem), problem })?;
    match fact.kind {
        FactKind::CueBallStruck { player: Some(player), .. }
            if player != PlayerId::ONE && player != PlayerId::TWO =>
        {
            let problem = format!("player {player}: expected 1 or 2");
            Err(NoFact { key: Some("player".into()), problem })
        }
        _ => Ok(fact),
    }
}

fn parse(object: &Map<String, Value>) -> Result<Fact, String> {
    serde_json::from_value(Value::Object(object.clone()))
        .map_err(|error| one_line(&error.to_string(), 400))
}

/// Serde does not say which value it disliked: it is the one without which the complaint changes.
/// The tag comes late, because nothing is left of a complaint about the others without it; the
/// time comes last, because it is read first.
fn wrong_key(object: &Map<String, Value>, problem: &str) -> Option<String> {
    if problem.starts_with("missing field") {
        return None;
    }
    let mut keys: Vec<&String> = object.keys().collect();
    keys.sort_by_key(|key| ["e", "t"].iter().position(|late| key == late).map_or(0, |i| i + 1));
    keys.into_iter()
        .find(|key| {
            let mut without = object.clone();
            without.remove(*key);
            parse(&without).err().as_deref() != Some(problem)
        })
        .cloned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Fact, NoFact> {
        read_fact(serde_json::from_str(text).unwrap())
    }

    #[test]
    fn both_names_of_a_fact_are_understood() {
        let samples = [
            r#""e":"place","ball":"0","zone":"kitchen","ok":true"#,
            r#""e":"tip","ball":"0""#,
            r#""e":"hit","a":"0","b":"1""#,
            r#""e":"cushion","ball":"0","rail":"foot""#,
            r#""e":"cross_head","ball":"0""#,
            r#""e":"pocket","ball":"3","pocket":"FL""#,
            r#""e":"off","ball":"3""#,
            r#""e":"touch","ball":"3","by":"hand""#,
            r#""e":"frozen","a":"0","b":"2""#,
            r#""e":"settle""#,
        ];
        for (sample, (long, tag)) in samples.into_iter().zip(TAGS) {
            let fact = read(&format!(r#"{{"t":0.5,"x":1,{sample}}}"#)).unwrap();
            assert_eq!(fact.kind.name(), long);
            let tagged = format!(r#""e":"{tag}""#);
            assert!(sample.starts_with(&tagged));
            let renamed = sample.replace(&tagged, &format!(r#""fact":"{long}""#));
            assert_eq!(read(&format!(r#"{{"t":0.5,{renamed}}}"#)).unwrap(), fact);
        }
    }

    #[test]
    fn errors_name_the_key_and_what_is_allowed() {
        #[track_caller]
        fn check(text: &str, key: Option<&str>, part: &str) {
            let error = read(text).unwrap_err();
            assert_eq!(error.key.as_deref(), key, "{error:?}");
            assert!(error.problem.contains(part), "{error:?}");
        }
        check(r#"{"t":0,"e":"hop"}"#, Some("e"), "expected one of `place`, `tip`, `hit`");
        check(r#"{"t":0,"e":"hit","a":"0"}"#, None, "missing field `b`");
        check(r#"{"t":0}"#, None, "missing field `e`");
        check(r#"{"e":"settle"}"#, None, "missing field `t`");
        check(r#"{"t":"soon","e":"settle"}"#, Some("t"), "expected f64");
        check(r#"{"t":0,"e":"pocket","ball":"1","pocket":"XX"}"#, Some("pocket"), "`HL`, `HR`");
        check(r#"{"t":0,"e":"off","ball":"R1"}"#, Some("ball"), "whole number from 0 to 65535");
        check(r#"{"t":0,"e":"tip","ball":"0","player":3}"#, Some("player"), "expected 1 or 2");
    }
}
