//! The referee and the console, and the scenarios of the paper's eight-ball.

use hapticbillard::ball::{BallPlace, BallState, Motion};
use hapticbillard::events::{
    BallInHand, Command, Event, Fact, Foul, Group, Groups, ShotKind, Source, Spotting, Stamp,
    Stamped, Topic, Turn, TurnAfter, Verdict,
};
use hapticbillard::hash::{Digest, StateHash};
use hapticbillard::ids::{BallId, PlayerId};
use hapticbillard::physics::Snapshot;
use hapticbillard::rules::{
    Console, ConsoleError, GameKind, Language, Phase, Referee, ScenarioStatus, State, Texts,
    legal_first, read_scenarios, run_scenario,
};
use hapticbillard::tick::{Delivered, Participant};
use hapticbillard::units::Tick;
use serde_json::json;
use std::sync::Arc;

/// Scenarios of the rule book, a file per game and more.
const FILES: [&str; 9] = [
    include_str!("data/rules/paper_eight_ball.json"),
    include_str!("data/rules/paper_eight_ball_more.json"),
    include_str!("data/rules/wpa_eight_ball.json"),
    include_str!("data/rules/wpa_eight_ball_more.json"),
    include_str!("data/rules/wpa_nine_ball.json"),
    include_str!("data/rules/straight.json"),
    include_str!("data/rules/snooker.json"),
    include_str!("data/rules/three_cushion.json"),
    include_str!("data/rules/free_carom.json"),
];

#[test]
fn every_scenario_comes_out() {
    for scenario in FILES.into_iter().flat_map(|file| read_scenarios(file).unwrap()) {
        let result = run_scenario(&scenario);
        assert_eq!(result.status, ScenarioStatus::Pass, "{}: {:?}", result.id, result.differences);
    }
}

/// A scenario that passes whatever it expects would prove nothing.
#[test]
fn every_scenario_fails_when_its_expectation_is_turned_round() {
    for mut scenario in FILES.into_iter().flat_map(|file| read_scenarios(file).unwrap()) {
        let legal = scenario.expect["legal"].as_bool().unwrap();
        scenario.expect.insert("legal".into(), (!legal).into());
        let result = run_scenario(&scenario);
        assert_eq!(result.status, ScenarioStatus::Fail, "{}", result.id);
        assert_eq!(result.differences.len(), 1, "{}: {:?}", result.id, result.differences);
    }
}

/// The referee, behind its console, gives the verdict that the pure function gives, fact by fact.
#[test]
fn the_referee_agrees_with_the_scenarios() {
    for scenario in FILES.into_iter().flat_map(|file| read_scenarios(file).unwrap()) {
        let expected = run_scenario(&scenario).verdict.unwrap();
        let kind = scenario.ruleset.parse().unwrap();
        let mut console = Console::new(kind);
        let mut feed = |line: serde_json::Value| console.feed_line(&line.to_string());
        feed(json!({ "state": scenario.state })).unwrap();
        // What may not be called is refused, and means nothing to the pure function.
        if !scenario.call.is_null() {
            let _ = feed(json!({ "call": scenario.call }));
        }
        let mut verdicts = Vec::new();
        let (mut last, mut is_over) = (None, false);
        for event in &scenario.events {
            let answer = feed(event.clone().into()).unwrap();
            let is_verdict = answer.verdict.is_some();
            verdicts.extend(answer.verdict);
            if is_verdict {
                (last, is_over) =
                    (answer.turn.map(|turn| turn.player), answer.phase == Phase::Over);
            }
        }
        let id = &scenario.id;
        assert_eq!(verdicts.len(), 1, "{id}");
        assert_eq!(*verdicts[0], expected, "{id}");
        assert_eq!(is_over, expected.turn == TurnAfter::End, "{id}");
        assert_eq!(last, expected.chooser.or(expected.next_player), "{id}");
    }
}

fn fact(text: &str) -> Fact {
    serde_json::from_str(text).expect("a test writes facts as rule files do")
}

/// One shot: a stroke at `t`, what `between` lists, and rest.
fn shot(referee: &mut Referee, between: &[&str]) -> Vec<Event> {
    let mut said = referee.handle(&fact(r#"{"t":0,"e":"tip","ball":"0"}"#)).to_vec();
    for text in between {
        said.extend(referee.handle(&fact(text)));
    }
    said.extend(referee.handle(&fact(r#"{"t":9,"e":"settle"}"#)));
    said
}

fn verdicts(said: &[Event]) -> Vec<Verdict> {
    said.iter()
        .filter_map(|event| match event {
            Event::Verdict(verdict) => Some((**verdict).clone()),
            _ => None,
        })
        .collect()
}

fn turn(event: &Event) -> Turn {
    match event {
        Event::Turn(turn) => (**turn).clone(),
        other => panic!("a turn was awaited, not {other:?}"),
    }
}

fn started(game: GameKind) -> Referee {
    let mut referee = Referee::new(game);
    referee.begin((0..=15).map(BallId));
    referee
}

fn hash_of(referee: &Referee) -> Digest {
    let mut hash = StateHash::new();
    referee.hash(&mut hash);
    hash.finish()
}

fn ball(id: u16, place: BallPlace) -> BallState {
    BallState {
        id: BallId(id),
        position: Default::default(),
        velocity: Default::default(),
        angular_velocity: Default::default(),
        orientation: Default::default(),
        motion: Motion::Rest,
        place,
    }
}

#[test]
fn the_first_turn_is_the_break_with_what_lies_on_the_table() {
    let table = Snapshot {
        balls: vec![
            ball(0, BallPlace::InHand),
            ball(1, BallPlace::OnTable),
            ball(2, BallPlace::Pocketed),
            ball(8, BallPlace::OnTable),
        ],
        ..Snapshot::default()
    };
    let mut referee = Referee::new(GameKind::PaperEightBall).first_player(PlayerId::TWO);
    let outcome = referee.start(&table);
    assert_eq!(outcome.publish.len(), 1);
    assert_eq!(outcome.publish[0].delay_ticks, 0);
    let first = turn(&outcome.publish[0].event);
    assert_eq!(first.player, PlayerId::TWO);
    assert_eq!(first.shot, ShotKind::Break);
    assert_eq!(first.ball_in_hand, BallInHand::Kitchen);
    assert_eq!(first.on_table.as_slice(), [BallId(1), BallId(8)]);
    assert_eq!(first.legal_first.as_slice(), [BallId(1)], "the 8 never on an open table");
    assert_eq!(first.shot_number, 1);
    assert_eq!(referee.phase(), Phase::Placing);
}

#[test]
fn a_refused_or_misplaced_cue_ball_repeats_the_turn() {
    let mut referee = started(GameKind::PaperEightBall);
    for refused in [
        r#"{"t":0,"e":"place","ball":"0","zone":"kitchen","ok":false}"#,
        r#"{"t":0,"e":"place","ball":"0","zone":"anywhere","ok":true}"#,
    ] {
        let said = referee.handle(&fact(refused));
        assert_eq!(turn(&said[0]).shot_number, 1);
        assert_eq!(referee.phase(), Phase::Placing);
    }
    let good = r#"{"t":0,"e":"place","ball":"0","zone":"kitchen","ok":true}"#;
    assert!(referee.handle(&fact(good)).is_empty());
    assert_eq!(referee.phase(), Phase::Waiting);
    let said = shot(&mut referee, &[r#"{"t":1,"e":"hit","a":"0","b":"1"}"#]);
    assert!(verdicts(&said)[0].legal, "the last placement counts");
}

#[test]
fn a_ball_that_is_not_in_hand_may_not_be_placed() {
    let mut referee = started(GameKind::PaperEightBall);
    shot(&mut referee, &[r#"{"t":1,"e":"hit","a":"0","b":"1"}"#]);
    assert_eq!(referee.phase(), Phase::Waiting);
    let place = r#"{"t":0,"e":"place","ball":"0","zone":"anywhere","ok":true}"#;
    assert_eq!(turn(&referee.handle(&fact(place))[0]).player, PlayerId::TWO);
    let said = shot(&mut referee, &[r#"{"t":1,"e":"hit","a":"0","b":"1"}"#]);
    assert_eq!(verdicts(&said)[0].fouls.as_slice(), [Foul::BadPlacement]);
}

#[test]
fn facts_between_shots_are_no_part_of_one() {
    let mut referee = started(GameKind::PaperEightBall);
    let before = hash_of(&referee);
    for text in [
        r#"{"t":0,"e":"pocket","ball":"3","pocket":"FL"}"#,
        r#"{"t":0,"e":"hit","a":"0","b":"8"}"#,
        r#"{"t":0,"e":"off","ball":"0"}"#,
        r#"{"t":0,"e":"settle"}"#,
    ] {
        assert!(referee.handle(&fact(text)).is_empty());
    }
    assert_eq!(hash_of(&referee), before);
    assert_eq!(referee.phase(), Phase::Placing);
    assert_eq!(referee.state().on_table.len(), 15);
}

#[test]
fn the_eight_is_spotted_between_verdict_and_turn() {
    let mut referee = started(GameKind::PaperEightBall);
    let said = shot(
        &mut referee,
        &[
            r#"{"t":1,"e":"hit","a":"0","b":"1"}"#,
            r#"{"t":2,"e":"pocket","ball":"8","pocket":"FL"}"#,
            r#"{"t":2,"e":"pocket","ball":"12","pocket":"FR"}"#,
        ],
    );
    assert_eq!(said.len(), 3);
    let balls = std::iter::once(BallId::EIGHT).collect();
    let spot = Event::Command(Command::SpotBalls(Spotting { balls, cue_ball: BallId::CUE }));
    assert_eq!(said[1], spot);
    let next = turn(&said[2]);
    assert_eq!((next.player, next.shot, next.shot_number), (PlayerId::ONE, ShotKind::Normal, 2));
    assert!(next.on_table.contains(&BallId::EIGHT) && !next.on_table.contains(&BallId(12)));
    assert_eq!(next.groups, Some(Groups::Open));
}

#[test]
fn dry_turns_are_counted_over_both_players_and_end_in_a_draw() {
    let mut referee = started(GameKind::PaperEightBall);
    let hit = r#"{"t":1,"e":"hit","a":"0","b":"1"}"#;
    for count in 1..=30 {
        shot(&mut referee, &[hit]);
        assert_eq!(referee.state().dry_turns, count);
    }
    // A turn of two shots of which the first pockets a ball is not dry.
    shot(&mut referee, &[hit, r#"{"t":2,"e":"pocket","ball":"2","pocket":"FL"}"#]);
    assert_eq!(referee.state().dry_turns, 0);
    assert_eq!(referee.state().groups, Some(Groups::assigned(PlayerId::ONE, Group::Solids)));
    shot(&mut referee, &[hit]);
    assert_eq!(referee.state().dry_turns, 0);
    for count in 1..60 {
        shot(&mut referee, &[hit]);
        assert_eq!(referee.state().dry_turns, count);
        assert_ne!(referee.phase(), Phase::Over);
    }
    let said = shot(&mut referee, &[hit]);
    assert_eq!(referee.phase(), Phase::Over);
    let verdict = &verdicts(&said)[0];
    assert_eq!((verdict.turn, verdict.winner), (TurnAfter::End, None));
    assert_eq!(said.len(), 1, "no turn after the end");
}

#[test]
fn nothing_is_heard_after_the_end() {
    let state = State {
        groups: Some(Groups::assigned(PlayerId::ONE, Group::Solids)),
        on_table: [8, 9].map(BallId).into_iter().collect(),
        ..State::default()
    };
    let mut referee = Referee::resume(GameKind::PaperEightBall, state);
    let first = turn(&referee.begin([])[0]);
    assert_eq!(first.legal_first.as_slice(), [BallId::EIGHT]);
    let won = [
        r#"{"t":1,"e":"hit","a":"0","b":"8"}"#,
        r#"{"t":2,"e":"pocket","ball":"8","pocket":"FL"}"#,
    ];
    let said = shot(&mut referee, &won);
    assert_eq!(verdicts(&said)[0].winner, Some(PlayerId::ONE));
    let after = hash_of(&referee);
    assert!(shot(&mut referee, &won).is_empty());
    assert_eq!(hash_of(&referee), after);
}

#[test]
fn mail_is_taken_in_batches_and_answered_for_the_next_tick() {
    let mut referee = started(GameKind::PaperEightBall);
    let facts = [
        r#"{"t":0.001,"e":"tip","ball":"0"}"#,
        r#"{"t":0.4,"e":"hit","a":"0","b":"1"}"#,
        r#"{"t":0.9,"e":"pocket","ball":"0","pocket":"ML"}"#,
        r#"{"t":4.0,"e":"settle"}"#,
    ];
    let mail = |sequence: usize, text: &str| Stamped {
        stamp: Stamp { tick: Tick(1), source: Source::Physics, sequence: sequence as u64 },
        event: Event::Fact(fact(text)),
    };
    let events: Arc<[Stamped]> = facts.iter().enumerate().map(|(i, text)| mail(i, text)).collect();
    let table = Arc::new(Snapshot::default());
    let outcome = referee.collect(&Delivered { tick: Tick(1), events, table });
    assert!(outcome.publish.iter().all(|publication| publication.delay_ticks == 0));
    assert_eq!(outcome.wake, None);
    let said: Vec<Event> = outcome.publish.into_iter().map(|p| p.event).collect();
    assert_eq!(verdicts(&said)[0].fouls.as_slice(), [Foul::Scratch]);
    let next = turn(&said[1]);
    assert_eq!((next.player, next.ball_in_hand), (PlayerId::TWO, BallInHand::Anywhere));
}

#[test]
fn only_facts_that_decide_anything_are_subscribed_to() {
    let paper = Referee::new(GameKind::PaperEightBall).topics();
    assert!(paper.contains(Topic::BallsCollided));
    assert!(!paper.contains(Topic::CushionHit) && !paper.contains(Topic::HeadStringCrossed));
    let free = Referee::new(GameKind::FreePlay).topics();
    assert!(free.contains(Topic::Settled) && !free.contains(Topic::BallsCollided));
}

#[test]
fn free_play_goes_on_until_the_table_is_cleared() {
    let mut referee = Referee::new(GameKind::FreePlay);
    let first = turn(&referee.begin([0, 1, 8].map(BallId))[0]);
    assert_eq!((first.ball_in_hand, first.groups), (BallInHand::None, None));
    assert_eq!(first.legal_first.as_slice(), [BallId(1), BallId(8)]);

    let scratch = [
        r#"{"t":1,"e":"touch","ball":"1","by":"hand"}"#,
        r#"{"t":2,"e":"pocket","ball":"8","pocket":"FL"}"#,
        r#"{"t":2,"e":"pocket","ball":"0","pocket":"FL"}"#,
    ];
    let said = shot(&mut referee, &scratch);
    assert!(verdicts(&said)[0].legal);
    let next = turn(said.last().unwrap());
    assert_eq!((next.player, next.ball_in_hand), (PlayerId::ONE, BallInHand::Anywhere));
    assert_eq!(next.on_table.as_slice(), [BallId(1)]);

    for _ in 0..100 {
        shot(&mut referee, &[]);
    }
    assert_eq!(referee.state().dry_turns, 0, "there is no draw");
    let said = shot(&mut referee, &[r#"{"t":1,"e":"off","ball":"1"}"#]);
    let verdict = &verdicts(&said)[0];
    assert_eq!((verdict.turn, verdict.winner), (TurnAfter::End, None));
    assert_eq!(referee.phase(), Phase::Over);
}

#[test]
fn free_play_without_object_balls_never_ends() {
    let mut referee = Referee::new(GameKind::FreePlay);
    referee.begin([BallId::CUE]);
    for _ in 0..3 {
        shot(&mut referee, &[r#"{"t":1,"e":"off","ball":"0"}"#]);
        assert_eq!(referee.phase(), Phase::Placing);
    }
}

#[test]
fn whoever_may_be_hit_first_is_hit_without_a_foul_and_nobody_else() {
    let hit = |ball: BallId| format!(r#"{{"t":1,"e":"hit","a":"0","b":"{ball}"}}"#);
    for groups in [
        Groups::Open,
        Groups::assigned(PlayerId::ONE, Group::Solids),
        Groups::assigned(PlayerId::TWO, Group::Solids),
    ] {
        // Every subset of two balls of each group and the 8.
        for mask in 0..32u32 {
            let pool = [1, 2, 8, 9, 10].map(BallId);
            let on_table = (0..5).filter(|i| mask >> i & 1 == 1).map(|i| pool[i]).collect();
            let state = State { groups: Some(groups), on_table, ..State::default() };
            let legal = legal_first(GameKind::PaperEightBall, &state);
            for ball in &state.on_table {
                let mut referee = Referee::resume(GameKind::PaperEightBall, state.clone());
                referee.begin([]);
                let said = shot(&mut referee, &[&hit(*ball)]);
                assert_eq!(verdicts(&said)[0].legal, legal.contains(ball), "{state:?} {ball}");
            }
        }
    }
}

#[test]
fn the_console_plays_a_game_line_by_line() {
    let mut console = Console::new(GameKind::PaperEightBall);
    assert_eq!(console.answer().phase, Phase::Placing);
    let lines = [
        "# a comment",
        r#"{"t":0.0,"balls":[{"id":"0","position_m":[0,0,0]}]}"#,
        r#"{"t":0,"fact":"CueBallStruck","e":"tip","ball":"0","position_m":[0,0,0],"new":1}"#,
        r#"{"t":0.2,"fact":"BallsCollided","a":"0","b":"1"}"#,
        r#"{"t":0.9,"e":"pocket","ball":"0","pocket":"FL","speed_m_s":1.5}"#,
    ];
    let heard: Vec<bool> =
        lines.iter().map(|line| console.feed_line(line).unwrap().heard).collect();
    assert_eq!(heard, [false, false, true, true, true]);
    assert_eq!(console.answer().phase, Phase::Shooting);
    let answer = console.feed_line(r#"{"t":3,"e":"settle"}"#).unwrap();
    assert_eq!(answer.verdict.unwrap().fouls.as_slice(), [Foul::Scratch]);
    assert_eq!(answer.phase, Phase::Placing);
    assert_eq!(answer.turn.unwrap().player, PlayerId::TWO);
    assert!(!console.feed_line(r#"{"summary":{"cpu_ms":1}}"#).unwrap().heard);

    let state = r#"{"state":{"player":2,"groups":{"1":"solids","2":"stripes"},"on_table":["8"]}}"#;
    let answer = console.feed_line(state).unwrap();
    assert_eq!(answer.turn.unwrap().legal_first.as_slice(), [BallId::EIGHT]);
    assert_eq!(answer.phase, Phase::Waiting);
}

#[test]
fn the_console_names_line_and_column_and_goes_on() {
    let mut console = Console::new(GameKind::PaperEightBall);
    console.feed_line("").unwrap();
    let at = |error: ConsoleError| match error {
        ConsoleError::NotAnObject { line, column, .. }
        | ConsoleError::NotAFact { line, column, .. } => (line, column, error.to_string()),
        ConsoleError::TooLong { .. } => panic!("{error}"),
    };
    let (line, column, text) = at(console.feed_line(r#"{"t":0,"e":"hop"}"#).unwrap_err());
    assert_eq!((line, column), (2, 8), "{text}");
    assert!(text.starts_with("line 2, column 8: unknown variant `hop`, expected one of `place`"));
    let (line, column, text) = at(console.feed_line(r#"{"t":0,"#).unwrap_err());
    assert_eq!((line, column), (3, 7), "{text}");
    let (line, column, text) = at(console.feed_line("[]").unwrap_err());
    assert_eq!((line, column), (4, 1), "{text}");
    let (_, column, text) = at(console.feed_line(r#"{"state":{"player":9}}"#).unwrap_err());
    assert_eq!(column, 2, "{text}");
    assert!(text.contains("expected 1 or 2"), "{text}");
    let long = "x".repeat((1 << 20) + 1);
    assert!(matches!(console.feed_line(&long), Err(ConsoleError::TooLong { line: 6, .. })));
    assert!(console.feed_line(r#"{"t":0,"e":"tip","ball":"0"}"#).unwrap().heard);
}

#[test]
fn turns_are_announced_in_words() {
    let texts = Texts::new(Language::English);
    let mut referee = Referee::new(GameKind::PaperEightBall);
    let first = turn(&referee.begin((1..=15).map(BallId))[0]);
    assert_eq!(
        texts.turn(&first),
        "Player 1 to break. Ball in hand behind the head string for Player 1."
    );
    let said = shot(
        &mut referee,
        &[
            r#"{"t":1,"e":"hit","a":"0","b":"1"}"#,
            r#"{"t":2,"e":"pocket","ball":"1","pocket":"FL"}"#,
        ],
    );
    assert_eq!(texts.verdict(&verdicts(&said)[0]), "Player 1 continues.");
    assert_eq!(texts.turn(&turn(&said[1])), "Player 1 to shoot. The table is open.");
    assert_eq!(texts.why(&verdicts(&said)[0]), ["No rule was broken.", "The shot keeps the turn."]);
}
