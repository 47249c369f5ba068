//! What follows from a verdict in nine-ball, straight pool and eight-ball: who is called to do
//! what, and which balls return.

use hapticbillard::events::{
    BallInHand, ByPlayer, Call, CallKind, Choice, Command, Event, Fact, Foul, Racked, ShotKind,
    Source, Spotting, Turn, TurnAfter, Verdict,
};
use hapticbillard::ids::{BallId, PlayerId, PocketId};
use hapticbillard::rules::{GameKind, Language, Phase, Referee, State, Texts, game};

const HIT_1: &str = r#"{"t":1,"e":"hit","a":"0","b":"1"}"#;
const HIT_7: &str = r#"{"t":1,"e":"hit","a":"0","b":"7"}"#;
const RAIL: &str = r#"{"t":2,"e":"cushion","ball":"0","rail":"left"}"#;
const SCRATCH: &str = r#"{"t":3,"e":"pocket","ball":"0","pocket":"FL"}"#;
const NINE: &str = r#"{"t":3,"e":"pocket","ball":"9","pocket":"FL"}"#;
const FOUR_RAILS: [&str; 4] = [
    r#"{"t":2,"e":"cushion","ball":"1","rail":"left"}"#,
    r#"{"t":2,"e":"cushion","ball":"2","rail":"left"}"#,
    r#"{"t":2,"e":"cushion","ball":"3","rail":"foot"}"#,
    r#"{"t":2,"e":"cushion","ball":"4","rail":"foot"}"#,
];

/// What the referee says to one shot.
struct Said {
    verdict: Verdict,
    commands: Vec<Command>,
    turn: Option<Turn>,
}

fn said(events: impl IntoIterator<Item = Event>) -> Said {
    let mut said = Said { verdict: Verdict::default(), commands: Vec::new(), turn: None };
    for event in events {
        match event {
            Event::Verdict(verdict) => said.verdict = (*verdict).clone(),
            Event::Command(command) => said.commands.push(command),
            Event::Turn(turn) => said.turn = Some((*turn).clone()),
            other => panic!("the referee said {other:?}"),
        }
    }
    said
}

fn shot(referee: &mut Referee, between: &[&str]) -> Said {
    let tip = r#"{"t":0,"e":"tip","ball":"0"}"#;
    let settle = r#"{"t":9,"e":"settle"}"#;
    let texts = std::iter::once(tip).chain(between.iter().copied()).chain([settle]);
    let facts: Vec<Fact> = texts.map(|text| serde_json::from_str(text).unwrap()).collect();
    said(facts.iter().flat_map(|fact| referee.handle(fact)))
}

fn spotted(ball: u16) -> Command {
    let balls = balls([ball]).collect();
    Command::SpotBalls(Spotting { balls, cue_ball: BallId::CUE })
}

fn call(referee: &mut Referee, call: Call) -> bool {
    referee.obey(Source::Input, &Command::Call(call.clone()));
    referee.call() == Some(&call)
}

fn choose(referee: &mut Referee, choice: Choice) -> Said {
    said(referee.obey(Source::Input, &Command::Choose(choice)))
}

fn started(kind: GameKind) -> Referee {
    let mut referee = Referee::new(kind);
    referee.begin((0..=game(kind).balls).map(BallId));
    referee
}

fn resumed(kind: GameKind, state: State) -> Referee {
    let mut referee = Referee::resume(kind, state);
    referee.begin([]);
    referee
}

fn balls(ids: impl IntoIterator<Item = u16>) -> impl Iterator<Item = BallId> {
    ids.into_iter().map(BallId)
}

fn push_out() -> Call {
    Call::Kind(CallKind::PushOut)
}

/// The whole way of a push-out: break, announcement, the choice, and the shot that follows.
#[test]
fn a_push_out_is_announced_once_and_the_other_player_chooses() {
    for (choice, shooter) in [(Choice::Shoot, PlayerId::ONE), (Choice::PassBack, PlayerId::TWO)] {
        let mut referee = started(GameKind::WpaNineBall);
        assert!(!call(&mut referee, push_out()), "not for the break");
        let after_break = shot(&mut referee, &[&[HIT_1][..], &FOUR_RAILS[..]].concat());
        let turn = after_break.turn.unwrap();
        assert_eq!((turn.player, turn.shot), (PlayerId::TWO, ShotKind::Normal));
        assert!(turn.calls.push_out && !turn.calls.safety && !turn.calls.ball);
        assert_eq!(turn.legal_first.as_slice(), [BallId(1)]);
        assert!(call(&mut referee, push_out()));

        let pushed = shot(&mut referee, &[HIT_7, NINE]);
        assert!(pushed.verdict.legal);
        let spot = spotted(9);
        assert_eq!(pushed.commands, [spot], "the 9 lies before anybody chooses");
        let turn = pushed.turn.unwrap();
        assert_eq!(turn.player, PlayerId::ONE);
        assert_eq!(turn.options.as_slice(), [Choice::Shoot, Choice::PassBack]);
        assert_eq!(turn.on_table.len(), 9);
        assert_eq!(referee.phase(), Phase::Choosing);

        let next = choose(&mut referee, choice);
        assert!(next.commands.is_empty());
        let turn = next.turn.unwrap();
        assert_eq!((turn.player, turn.ball_in_hand), (shooter, BallInHand::None));
        assert!(!turn.calls.push_out);
        assert!(!call(&mut referee, push_out()), "only once");
        assert_eq!(shot(&mut referee, &[HIT_7, RAIL]).verdict.fouls.as_slice(), [Foul::WrongFirst]);
    }
}

#[test]
fn no_push_out_after_a_break_with_a_foul() {
    let mut referee = started(GameKind::WpaNineBall);
    let turn = shot(&mut referee, &[HIT_1, SCRATCH]).turn.unwrap();
    assert_eq!((turn.player, turn.ball_in_hand), (PlayerId::TWO, BallInHand::Anywhere));
    assert!(!turn.calls.push_out && !call(&mut referee, push_out()));
}

/// Fouls are counted per player, a warning comes at two, and the third ends it.
#[test]
fn nine_ball_warns_at_two_fouls_and_ends_at_three() {
    let mut referee = started(GameKind::WpaNineBall);
    shot(&mut referee, &[&[HIT_1][..], &FOUR_RAILS[..]].concat());
    let mut warnings = Vec::new();
    loop {
        let foul = shot(&mut referee, &[HIT_7, RAIL]);
        let Some(turn) = foul.turn else {
            assert_eq!(foul.verdict.fouls.as_slice(), [Foul::WrongFirst, Foul::ThreeFouls]);
            assert_eq!(foul.verdict.winner, Some(PlayerId::ONE));
            break;
        };
        warnings.push((turn.player.0, turn.warned));
    }
    assert_eq!(warnings, [(1, false), (2, false), (1, false), (2, true)]);
}

#[test]
fn a_shot_without_a_foul_takes_the_warning_back() {
    let state = State {
        on_table: balls([1, 7, 9]).collect(),
        fouls: ByPlayer { one: 2, two: 2 },
        ..State::default()
    };
    let mut referee = resumed(GameKind::WpaNineBall, state.clone());
    let turn = shot(&mut referee, &[HIT_1, RAIL]).turn.unwrap();
    assert!(turn.warned, "player 2 is told of two");
    let turn = shot(&mut referee, &[HIT_1, RAIL]).turn.unwrap();
    assert!(!turn.warned && referee.state().fouls.is_nothing());
}

#[test]
fn a_stalemate_is_a_new_rack_by_the_first_breaker_without_fouls() {
    let state = State {
        player: PlayerId::TWO,
        on_table: balls([1, 7, 9]).collect(),
        fouls: ByPlayer { one: 2, two: 0 },
        dry_turns: 11,
        ..State::default()
    };
    let mut referee = resumed(GameKind::WpaNineBall, state);
    let stalemate = shot(&mut referee, &[HIT_1, RAIL]);
    assert!(matches!(&stalemate.commands[..], [Command::Rack(rack)] if rack.balls == Racked::All));
    let turn = stalemate.turn.unwrap();
    assert_eq!((turn.player, turn.shot), (PlayerId::ONE, ShotKind::Break));
    assert_eq!((turn.on_table.len(), turn.ball_in_hand), (9, BallInHand::Kitchen));
    assert!(!turn.warned && referee.state().fouls.is_nothing());
}

/// The 8 that left the table on the break was lost when the opponent accepted: it came back only
/// with a choice that names it.
#[test]
fn the_eight_off_the_table_on_the_break_is_back_before_the_choice() {
    for choice in [Choice::Accept, Choice::CueInHandKitchen] {
        let mut referee = started(GameKind::WpaEightBall);
        let off = r#"{"t":3,"e":"off","ball":"8"}"#;
        let foul = shot(&mut referee, &[HIT_1, off]);
        assert_eq!(foul.commands, [spotted(8)]);
        let next = choose(&mut referee, choice);
        assert!(next.commands.is_empty());
        assert!(next.turn.unwrap().on_table.contains(&BallId::EIGHT));
    }
}

#[test]
fn the_eight_that_fell_on_the_break_returns_by_choice() {
    let eight = r#"{"t":3,"e":"pocket","ball":"8","pocket":"FL"}"#;
    let mut referee = started(GameKind::WpaEightBall);
    let fell = shot(&mut referee, &[HIT_1, eight]);
    assert!(fell.commands.is_empty());
    assert!(!fell.turn.unwrap().on_table.contains(&BallId::EIGHT));
    let next = choose(&mut referee, Choice::Respot8Continue);
    assert_eq!(next.commands, [spotted(8)]);
    let turn = next.turn.unwrap();
    assert_eq!((turn.player, turn.on_table.len()), (PlayerId::ONE, 15));
}

fn called(ball: u16) -> Call {
    Call::Ball { ball: BallId(ball), pocket: Some(PocketId::Fl) }
}

fn down(ball: u16) -> String {
    format!(r#"{{"t":3,"e":"pocket","ball":"{ball}","pocket":"FL"}}"#)
}

/// A run through two racks: the balls that fell come back as soon as one is left.
#[test]
fn straight_pool_goes_on_from_rack_to_rack() {
    let mut referee = started(GameKind::Straight);
    let mut score = 0;
    for rack in 1..=2 {
        let first = referee.state().on_table.len();
        assert_eq!(first, 15);
        for ball in 1..=14 {
            assert!(call(&mut referee, called(ball)));
            let hit = format!(r#"{{"t":1,"e":"hit","a":"0","b":"{ball}"}}"#);
            let made = shot(&mut referee, &[&hit, &down(ball)]);
            score += 1;
            let turn = made.turn.unwrap();
            assert_eq!(turn.player, PlayerId::ONE);
            assert_eq!(turn.score, Some(ByPlayer { one: score, two: 0 }));
            assert_eq!(turn.shot, ShotKind::Normal);
            let racked: Vec<_> = made.commands.iter().collect();
            match (ball, &racked[..]) {
                (14, [Command::Rack(racking)]) => {
                    assert_eq!((racking.balls, racking.serial), (Racked::Fourteen, rack));
                    assert_eq!(turn.on_table.len(), 15);
                }
                (1..=13, []) => assert_eq!(turn.on_table.len(), 15 - usize::from(ball)),
                other => panic!("{other:?}"),
            }
        }
    }
}

/// A third foul costs sixteen points in all, and whoever made it breaks a full rack.
#[test]
fn straight_pool_punishes_a_third_foul_with_another_break() {
    let state = State {
        on_table: balls(1..=9).collect(),
        score: ByPlayer { one: 20, two: 5 },
        fouls: ByPlayer { one: 1, two: 1 },
        breaker: PlayerId::TWO,
        ..State::default()
    };
    let mut referee = resumed(GameKind::Straight, state);
    assert_eq!(shot(&mut referee, &[HIT_1]).turn.unwrap().player, PlayerId::TWO);
    assert_eq!(shot(&mut referee, &[HIT_1, RAIL]).turn.unwrap().player, PlayerId::ONE);
    let third = shot(&mut referee, &[HIT_1, &down(3)]);
    assert!(third.verdict.legal, "an uncalled ball is no foul");
    shot(&mut referee, &[HIT_1, RAIL]);
    assert!(referee.state().fouls.is_nothing());
    for (number, points) in [(1, 18), (2, 17)] {
        let turn = shot(&mut referee, &[HIT_1]).turn.unwrap();
        assert_eq!(turn.score.unwrap().one, points, "foul {number}");
        assert!(!turn.warned);
        let turn = shot(&mut referee, &[HIT_1, RAIL]).turn.unwrap();
        assert_eq!(turn.warned, number == 2);
    }
    let third = shot(&mut referee, &[HIT_1, SCRATCH]);
    assert_eq!(third.verdict.turn, TurnAfter::Continue);
    assert!(matches!(&third.commands[..], [Command::Rack(rack)] if rack.balls == Racked::All));
    let turn = third.turn.unwrap();
    assert_eq!((turn.player, turn.shot), (PlayerId::ONE, ShotKind::Break));
    assert_eq!(turn.score, Some(ByPlayer { one: 1, two: 5 }));
    assert_eq!((turn.on_table.len(), turn.ball_in_hand), (15, BallInHand::Kitchen));
    assert!(!turn.warned && referee.state().fouls.is_nothing());
}

#[test]
fn a_breaking_foul_is_accepted_or_the_same_player_breaks_again() {
    for (choice, player, shot_kind) in [
        (Choice::Accept, PlayerId::TWO, ShotKind::Normal),
        (Choice::RerackOpponentBreaks, PlayerId::ONE, ShotKind::Break),
    ] {
        let mut referee = started(GameKind::Straight);
        let foul = shot(&mut referee, &[HIT_1, &down(4), SCRATCH]);
        assert_eq!(foul.verdict.fouls.as_slice(), [Foul::Scratch, Foul::IllegalBreak]);
        assert_eq!(foul.commands, [spotted(4)]);
        assert_eq!(foul.turn.unwrap().player, PlayerId::TWO);
        let next = choose(&mut referee, choice);
        assert_eq!(next.commands.len(), usize::from(shot_kind == ShotKind::Break));
        let turn = next.turn.unwrap();
        assert_eq!((turn.player, turn.shot), (player, shot_kind));
        assert_eq!(turn.score, Some(ByPlayer { one: -2, two: 0 }));
        assert_eq!((turn.on_table.len(), turn.ball_in_hand), (15, BallInHand::Kitchen));
    }
}

#[test]
fn choices_warnings_and_points_are_put_in_words() {
    let texts = Texts::new(Language::English);
    let mut referee = started(GameKind::Straight);
    let foul = shot(&mut referee, &[HIT_1]);
    assert_eq!(
        texts.verdict(&foul.verdict),
        "Foul: too few balls reached a rail on the break. Points for Player 1: -2. Player 2 \
         chooses how it goes on."
    );
    assert_eq!(
        texts.turn(&foul.turn.unwrap()),
        "Player 2 chooses: play the table as it is; or rack the balls, the other player breaks \
         again."
    );
    let mut referee = started(GameKind::WpaNineBall);
    let after_break = shot(&mut referee, &[&[HIT_1][..], &FOUR_RAILS[..]].concat());
    assert_eq!(
        texts.turn(&after_break.turn.unwrap()),
        "Player 2 to shoot. The 1 is on. Player 2 may announce a push-out."
    );
    call(&mut referee, push_out());
    let pushed = shot(&mut referee, &[HIT_7]);
    assert_eq!(texts.verdict(&pushed.verdict), "Player 1 chooses how it goes on.");
    assert_eq!(
        texts.why(&pushed.verdict),
        [
            "No rule was broken.",
            "It was a push-out without a foul, so the other player chooses who shoots."
        ]
    );
    choose(&mut referee, Choice::PassBack);
    let won = shot(&mut referee, &[HIT_1, NINE]);
    assert_eq!(texts.why(&won.verdict)[1], "The 9 fell on a shot without a foul: that wins.");
}
