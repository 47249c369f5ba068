//! Lines and files that are piped in: facts for the rule console, scenarios of rules, strokes of
//! `simulate --batch`. Whatever stands in them, they are taken or refused in one line.

use super::generator::{cases, generator, seed, spoiled};
use hapticbillard::physics::{Setup, Simulation};
use hapticbillard::rack::Rack;
use hapticbillard::rules::{Console, GameKind, ScenarioStatus, read_scenarios, run_scenario};
use hapticbillard::table::Table;

/// A game as `simulate --json` prints it and as somebody types it.
const FACTS: &str = r#"# the break
{"t":0,"balls":[{"id":"0","position_m":[-0.6,0,0.028575]}]}
{"t":0,"e":"place","ball":"0","zone":"kitchen","ok":true}
{"t":0.1,"e":"tip","ball":"0","push":false,"position_m":[-0.6,0,0.03],"normal_speed_m_s":8.5}
{"t":0.2,"fact":"BallsCollided","e":"hit","a":"0","b":"1","in_kitchen":false}
{"t":0.3,"e":"cushion","ball":"1","rail":"foot","onset":true}
{"t":0.35,"e":"cross_head","ball":"2"}
{"t":0.4,"e":"pocket","ball":"9","pocket":"FL","speed_m_s":1.5}
{"t":0.5,"e":"off","ball":"3"}
{"t":0.6,"e":"touch","ball":"4","by":"hand"}
{"t":9.5,"e":"settle","snookered":false}
{"state":{"player":2,"groups":{"1":"solids","2":"stripes"},"on_table":["8","9"]}}
{"t":10,"e":"tip","ball":"0","player":2}
{"t":12,"e":"settle"}
{"summary":{"facts":12}}
"#;

/// Facts in the wrong place, of the wrong type, far too large; names with line breaks in them.
const FACT_WORDS: [&str; 12] = [
    "{\"t\":1e308,\"e\":\"settle\"}\n",
    "{\"t\":0,\"e\":\"tip\",\"ball\":0}\n",
    "{\"t\":0,\"e\":\"hit\",\"a\":\"99999\",\"b\":\"0\"}\n",
    "{\"t\":0,\"e\":\"hop\\nskip\\u2028\"}\n",
    "{\"t\":0,\"e\":\"pocket\",\"ball\":\"1\",\"pocket\":\"a\\u0000b\\r\"}\n",
    "{\"state\":{\"on\\ntable\":[]}}\n",
    "{\"state\":{\"player\":2,\"on_table\":[\"65535\"],\"shot\":\"push_out\"}}\n",
    "\"e\":\"settle\",",
    "null",
    "[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[",
    "\\ud800",
    "{\"state\":null}\n",
];

#[track_caller]
fn check_line(line: &str, place: &str) {
    assert!(!line.contains(|c: char| c.is_control() || c == '\u{2028}'), "{place}: {line:?}");
    assert!(!line.is_empty() && line.len() < 2000, "{place}: {line:?}");
}

#[test]
fn spoiled_files_of_facts_are_judged_or_refused_in_one_line() {
    let (mut verdicts, mut refused, mut whole) = (0, 0, 0);
    for case in 0..cases(10_000) {
        let mut random = generator(case);
        let place = format!("seed {}, case {case}", seed());
        let text = spoiled(FACTS, &FACT_WORDS, &mut random);
        let game = GameKind::ALL[case as usize % GameKind::ALL.len()];
        let mut console = Console::new(game);
        let mut stopped = false;
        for (index, line) in text.lines().enumerate() {
            let before = console.answer();
            match console.feed_line(line) {
                Ok(answer) => verdicts += u64::from(answer.verdict.is_some()),
                // The program stops here; who types goes on from where the game stood.
                Err(error) => {
                    stopped = true;
                    refused += 1;
                    let said = error.to_string();
                    check_line(&said, &place);
                    assert!(said.starts_with(&format!("line {}", index + 1)), "{place}: {said}");
                    assert_eq!(console.answer(), before, "{place}");
                }
            }
        }
        whole += u64::from(!stopped);
    }
    // The canary: a generator that only makes right texts, or only wrong ones, tests nothing.
    if cases(10_000) >= 1000 {
        assert!(verdicts > 1000 && refused > 500 && whole > 500, "{verdicts} {refused} {whole}");
    }
}

const SCENARIOS: &str = r#"[
  {"id": "A1", "ruleset": "paper8", "description": "a pot goes on",
   "state": {"player": 1, "shot": "normal", "on_table": ["1", "2", "8", "9"],
             "groups": {"1": "solids", "2": "stripes"}, "dry_turns": 0},
   "call": null,
   "events": [{"t": 0, "e": "tip", "ball": "0"}, {"t": 0.1, "e": "hit", "a": "0", "b": "1"},
              {"t": 0.5, "e": "pocket", "ball": "1", "pocket": "FR"}, {"t": 3, "e": "settle"}],
   "expect": {"legal": true, "turn": "continue", "next_player": 1, "fouls": [],
              "groups": {"1": "solids", "2": "stripes"}, "pocketed": ["1"]}},
  {"id": "A2", "ruleset": "free_play", "state": {"on_table": ["1"]}, "call": "safety",
   "events": [{"t": 0, "e": "tip", "ball": "0"}, {"t": 1, "e": "settle"}],
   "expect": {"legal": true, "turn": "continue", "next_player": 1}}
]
"#;

const SCENARIO_WORDS: [&str; 9] = [
    "\"expect\": {\"legal\": 3},",
    "\"events\": [],",
    "\"ruleset\": \"croquet\\nset\",",
    "\"call\": {\"ball\": \"1\", \"pocket\": \"\\u0007\"},",
    "\"state\": \"none\",",
    "null",
    "{}",
    "[[[[[[[[[[[[[[[[",
    "1e999",
];

#[test]
fn spoiled_scenarios_are_judged_or_refused_in_one_line() {
    let (mut wrong, mut ended) = (0, [0; 3]);
    for case in 0..cases(10_000) {
        let mut random = generator(case);
        let place = format!("seed {}, case {case}", seed());
        match read_scenarios(&spoiled(SCENARIOS, &SCENARIO_WORDS, &mut random)) {
            Ok(scenarios) => {
                for scenario in &scenarios {
                    let result = run_scenario(scenario);
                    ended[result.status as usize] += 1;
                    let is_fine = result.status == ScenarioStatus::Pass;
                    assert_eq!(result.differences.is_empty(), is_fine, "{place}");
                    for difference in &result.differences {
                        check_line(&difference.problem, &place);
                    }
                }
            }
            Err(error) => {
                wrong += 1;
                check_line(&error.to_string(), &place);
            }
        }
    }
    if cases(10_000) >= 1000 {
        assert!(wrong > 100 && ended.iter().all(|count| *count > 20), "{wrong} {ended:?}");
    }
}

const STRIKE: &str = "{\"speed_m_s\":4,\"azimuth_deg\":10,\"elevation_deg\":5,\"side\":0.1,\
    \"height\":-0.2}";

const STRIKE_WORDS: [&str; 10] = [
    "\"side\":2,",
    "\"speed_m_s\":-3,",
    "\"elevation_deg\":90,",
    "\"azimuth_deg\":1e300,",
    "\"sp\\need\":1,",
    "\"side\":\"left\",",
    "\"height\":null,",
    "{",
    "[",
    "NaN",
];

#[test]
fn spoiled_strokes_are_played_or_refused_in_one_line() {
    let start = Simulation::new(Table::preset("pool-9ft").unwrap(), Rack::nine_ball(1)).unwrap();
    let (mut refused, mut impossible, mut struck) = (0, 0, 0);
    for case in 0..cases(10_000) {
        let mut random = generator(case);
        let place = format!("seed {}, case {case}", seed());
        let line = spoiled(STRIKE, &STRIKE_WORDS, &mut random);
        let setup = match Setup::from_json(&line, &[]) {
            Ok(setup) => setup,
            Err(error) => {
                refused += 1;
                check_line(&error.to_string(), &place);
                continue;
            }
        };
        match setup.begin(&start) {
            Ok(mut simulation) => {
                struck += 1;
                // To play takes longer than to read: some are enough for a smoke.
                if struck % 50 == 0
                    && let Err(error) = simulation.advance(0.05, Default::default(), &mut vec![])
                {
                    check_line(&error.to_string(), &place);
                }
            }
            Err(error) => {
                impossible += 1;
                check_line(&error.to_string(), &place);
            }
        }
    }
    if cases(10_000) >= 1000 {
        assert!(
            refused > 100 && impossible > 10 && struck > 100,
            "{refused} {impossible} {struck}"
        );
    }
}
