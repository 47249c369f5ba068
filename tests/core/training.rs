//! The referee in training, and calls that are taken back.

use hapticbillard::events::{
    BallInHand, Call, CallKind, Command, Event, Fact, Racked, Source, Turn, TurnAfter, Verdict,
};
use hapticbillard::hash::{Digest, StateHash};
use hapticbillard::ids::{BallId, GameKind, PlayerId, PocketId};
use hapticbillard::rules::{Console, Phase, Referee, State, UNDO_SHOTS};
use hapticbillard::tick::Participant;
use std::sync::Arc;

fn referee() -> Referee {
    let mut referee = Referee::new(GameKind::Training);
    referee.begin([0, 1, 2, 3].map(BallId));
    referee
}

fn hear(referee: &mut Referee, lines: &[&str]) -> Vec<Event> {
    let fact = |line: &&str| -> Fact { serde_json::from_str(line).unwrap() };
    lines.iter().map(fact).flat_map(|fact| referee.handle(&fact)).collect()
}

const TIP: &str = r#"{"t":0,"e":"tip","ball":"0"}"#;
const REST: &str = r#"{"t":9,"e":"settle"}"#;

fn undo(referee: &mut Referee) -> Vec<Event> {
    referee.obey(Source::Input, &Command::Undo).to_vec()
}

fn turn(said: &[Event]) -> Arc<Turn> {
    match said.last() {
        Some(Event::Turn(turn)) => turn.clone(),
        other => panic!("no turn: {other:?}"),
    }
}

fn verdict(said: &[Event]) -> Arc<Verdict> {
    let verdict = |event: &Event| match event {
        Event::Verdict(verdict) => Some(verdict.clone()),
        _ => None,
    };
    said.iter().find_map(verdict).unwrap()
}

fn digest(referee: &Referee) -> Digest {
    let mut hash = StateHash::new();
    referee.hash(&mut hash);
    hash.finish()
}

#[test]
fn nothing_is_a_foul_and_the_turn_passes_between_two_only() {
    let miss = [TIP, r#"{"t":1,"e":"off","ball":"0"}"#, REST];
    let mut two = referee();
    let said = hear(&mut two, &miss);
    assert!(verdict(&said).legal);
    let next = turn(&said);
    assert_eq!((next.player, next.ball_in_hand), (PlayerId::TWO, BallInHand::Anywhere));
    let mut one = Referee::new(GameKind::Training).alone();
    one.begin([0, 1].map(BallId));
    let said = hear(&mut one, &miss);
    assert_eq!((verdict(&said).turn, turn(&said).player), (TurnAfter::Continue, PlayerId::ONE));
    let pot = [TIP, r#"{"t":1,"e":"pocket","ball":"2","pocket":"FL"}"#, REST];
    assert_eq!(turn(&hear(&mut two, &pot)).player, PlayerId::TWO, "who pots goes on");
}

#[test]
fn undo_leads_back_to_the_last_bit_shot_by_shot() {
    let mut referee = referee();
    let mut seen: Vec<(State, Digest)> = Vec::new();
    for ball in [1, 3] {
        seen.push((referee.state().clone(), digest(&referee)));
        let pot = format!(r#"{{"t":1,"e":"pocket","ball":"{ball}","pocket":"HL"}}"#);
        hear(&mut referee, &[TIP, &pot, REST]);
    }
    // In the middle of a third.
    seen.push((referee.state().clone(), digest(&referee)));
    hear(&mut referee, &[TIP, r#"{"t":1,"e":"pocket","ball":"0","pocket":"HL"}"#]);
    for (number, (state, digest_then)) in seen.iter().enumerate().rev() {
        let said = undo(&mut referee);
        assert_eq!(turn(&said).shot_number, number as u32 + 1);
        assert_eq!(referee.state(), state);
        assert_eq!(digest(&referee), *digest_then);
        assert_eq!(referee.phase(), Phase::Waiting);
    }
    assert_eq!(undo(&mut referee), [], "there is no shot before the first");
    for _ in 0..2 * UNDO_SHOTS {
        hear(&mut referee, &[TIP, REST]);
    }
    let back = std::iter::from_fn(|| Some(undo(&mut referee)).filter(|said| !said.is_empty()));
    assert_eq!(back.count(), UNDO_SHOTS);
}

#[test]
fn undo_is_nothing_in_other_games() {
    for kind in GameKind::ALL.into_iter().filter(|kind| *kind != GameKind::Training) {
        let mut referee = Referee::new(kind);
        referee.begin((0..=15).map(BallId));
        hear(&mut referee, &[TIP, REST]);
        let before = digest(&referee);
        assert_eq!(undo(&mut referee), [], "{kind}");
        assert_eq!(digest(&referee), before, "{kind}");
    }
}

#[test]
fn a_ball_that_a_hand_puts_down_is_on_the_table_wherever_it_was() {
    let mut referee = referee();
    let put = r#"{"t":20,"e":"place","ball":"2","zone":"anywhere","ok":true}"#;
    hear(&mut referee, &[TIP, r#"{"t":1,"e":"pocket","ball":"2","pocket":"FL"}"#, REST]);
    assert!(!referee.state().on_table.contains(&BallId(2)));
    let said = hear(&mut referee, &[put]);
    assert!(turn(&said).legal_first.contains(&BallId(2)));
    assert_eq!(referee.phase(), Phase::Waiting);
    // Refused: it is where it was.
    let refused = put.replace("true", "false").replace("\"2\"", "\"7\"");
    assert_eq!(hear(&mut referee, &[&refused]), []);
    // While others roll.
    let off = r#"{"t":1,"e":"off","ball":"2"}"#;
    let said = hear(&mut referee, &[TIP, off, put, REST]);
    assert!(turn(&said).on_table.contains(&BallId(2)));
    // The cue ball in hand is put down, and lies then.
    let scratch = r#"{"t":1,"e":"pocket","ball":"0","pocket":"FL"}"#;
    hear(&mut referee, &[TIP, scratch, REST]);
    assert_eq!(referee.phase(), Phase::Placing);
    hear(&mut referee, &[r#"{"t":20,"e":"place","ball":"0","zone":"anywhere","ok":true}"#]);
    assert_eq!(referee.phase(), Phase::Waiting);
    assert_eq!(referee.state().ball_in_hand, BallInHand::None);
}

#[test]
fn a_cleared_table_is_racked_with_the_balls_of_the_beginning_and_undo_clears_it_again() {
    let mut referee = referee();
    for ball in [1, 2, 3] {
        let pot = format!(r#"{{"t":1,"e":"pocket","ball":"{ball}","pocket":"HL"}}"#);
        let said = hear(&mut referee, &[TIP, &pot, REST]);
        if ball == 3 {
            let racking = said.iter().find_map(|event| match event {
                Event::Command(Command::Rack(racking)) => Some(*racking),
                _ => None,
            });
            assert_eq!(
                racking.map(|racking| (racking.serial, racking.balls)),
                Some((1, Racked::All))
            );
            assert_eq!(turn(&said).on_table.as_slice(), [1, 2, 3].map(BallId));
        }
    }
    assert!(referee.state().is_break());
    assert_eq!(turn(&undo(&mut referee)).on_table.as_slice(), [BallId(3)]);
}

#[test]
fn a_call_is_taken_back_by_calling_nothing() {
    let state = State { on_table: (1..=15).map(BallId).collect(), ..State::default() };
    let mut referee = Referee::resume(GameKind::WpaEightBall, state);
    referee.begin([]);
    let call = |referee: &mut Referee, call| referee.obey(Source::Input, &Command::Call(call));
    call(&mut referee, Call::Ball { ball: BallId(3), pocket: Some(PocketId::Hl) });
    assert!(referee.call().is_some());
    call(&mut referee, Call::Kind(CallKind::Nothing));
    assert_eq!(referee.call(), None);

    let mut console = Console::new(GameKind::WpaEightBall);
    console.feed_line(r#"{"state":{"on_table":["1","2"]}}"#).unwrap();
    console.feed_line(r#"{"call":{"ball":"1","pocket":"HL"}}"#).unwrap();
    console.feed_line(r#"{"call":"nothing"}"#).unwrap();
}
