//! Random facts, in possible and impossible orders, fed to the referee.
//!
//! `FUZZ_SEED` and `FUZZ_EVENTS` set where the run begins and how long it is; a failure names the
//! seed of its game. What holds is checked against an account of the game kept here.

use super::facts::{Swarm, made_possible};
use hapticbillard::events::{
    BallInHand, Call, Command, Event, Fact, FactKind, Foul, Group, Groups, TurnAfter, Verdict,
};
use hapticbillard::hash::{Digest, StateHash};
use hapticbillard::ids::{BallId, PlayerId};
use hapticbillard::rules::{Console, GameKind, Judge, Phase, Referee, Shot, State, judge};
use hapticbillard::tick::Participant;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Facts in one game at the most.
const GAME_EVENTS: usize = 1500;

/// Facts that a game goes on for after its end.
const LATE_EVENTS: usize = 20;

#[test]
fn the_referee_keeps_its_rules_whatever_happens() {
    let first = number("FUZZ_SEED", 1);
    let events = number("FUZZ_EVENTS", 300_000);
    let (mut seed, mut done, mut tally) = (first, 0, Tally::default());
    while done < events {
        for game in [GameKind::PaperEightBall, GameKind::FreePlay] {
            done += match play(game, right_judge, seed) {
                Ok(game_tally) => tally.add(game_tally),
                Err(problem) => panic!("FUZZ_SEED={seed} {game}: {problem}"),
            };
        }
        seed += 1;
    }
    // The generator must reach the corners, or nothing was tested.
    if events >= 300_000 {
        assert!(tally.verdicts > 1000, "{tally:?}");
        assert!(tally.fouls > 100 && tally.wins > 10 && tally.draws > 3, "{tally:?}");
        assert!(tally.assigned > 10 && tally.spotted > 10 && tally.shuffled > 100, "{tally:?}");
    }
}

/// The real rules; only eight-ball has groups.
fn right_judge(state: &State, call: Option<&Call>, shot: &Shot) -> Verdict {
    match state.groups {
        Some(_) => judge(GameKind::PaperEightBall, state, call, shot),
        None => judge(GameKind::FreePlay, state, call, shot),
    }
}

/// Each of these judges is wrong in one point; if the account did not notice, it would be blind.
#[test]
fn a_wrong_judge_is_found_out() {
    assert_eq!(found_out(right_judge), None);

    let wrong: [(&str, Judge); 7] = [
        ("the fouling player goes on", |state, call, shot| {
            let verdict = judge(GameKind::PaperEightBall, state, call, shot);
            match verdict.turn {
                TurnAfter::Pass => Verdict { next_player: Some(state.player), ..verdict },
                _ => verdict,
            }
        }),
        ("a scratch is none", |state, call, shot| {
            let shot = Shot { cue_pocketed: false, ..shot.clone() };
            judge(GameKind::PaperEightBall, state, call, &shot)
        }),
        ("groups are assigned anew", |state, call, shot| {
            let open = State { groups: Some(Groups::Open), ..state.clone() };
            let verdict = judge(GameKind::PaperEightBall, state, call, shot);
            let anew = judge(GameKind::PaperEightBall, &open, call, shot);
            Verdict { groups: anew.groups, ..verdict }
        }),
        ("any pocketed ball is spotted", |state, call, shot| {
            let verdict = judge(GameKind::PaperEightBall, state, call, shot);
            Verdict { spot: verdict.pocketed.clone(), ..verdict }
        }),
        ("there is no draw", |state, call, shot| {
            let state = State { dry_turns: 0, ..state.clone() };
            judge(GameKind::PaperEightBall, &state, call, shot)
        }),
        ("the 8 loses on the break too", |state, call, shot| {
            let verdict = judge(GameKind::PaperEightBall, state, call, shot);
            match verdict.pocketed.contains(&BallId::EIGHT) {
                true => Verdict {
                    turn: TurnAfter::End,
                    next_player: None,
                    winner: Some(state.player.other()),
                    ..verdict
                },
                false => verdict,
            }
        }),
        ("of two at the same time the first told is met first", |state, call, shot| {
            let mut shot = shot.clone();
            shot.first_contacts.truncate(1);
            judge(GameKind::PaperEightBall, state, call, &shot)
        }),
    ];
    for (name, judge) in wrong {
        assert!(found_out(judge).is_some(), "nobody noticed: {name}");
    }
}

/// Whatever is typed, the console answers or says what it dislikes, and then stands where it stood.
#[test]
fn the_console_survives_any_line() {
    let good = [
        r#"{"t":0,"e":"tip","ball":"0","push":true,"player":2}"#,
        r#"{"t":0.2,"e":"hit","a":"0","b":"1","in_kitchen":false}"#,
        r#"{"t":0.3,"e":"cushion","ball":"1","rail":"foot","onset":false}"#,
        r#"{"t":0.4,"fact":"BallPocketed","ball":"8","pocket":"FL"}"#,
        r#"{"state":{"player":2,"groups":{"1":"solids","2":"stripes"},"on_table":["8","9"]}}"#,
        r#"{"t":1e3,"e":"settle","snookered":true}"#,
        r#"{"t":0,"e":"place","ball":"0","zone":"kitchen","ok":true}"#,
    ];
    let seed = number("FUZZ_SEED", 1);
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    let mut console = Console::new(GameKind::PaperEightBall);
    let (mut heard, mut refused) = (0, 0);
    for _ in 0..20_000 {
        let mut line = good[rng.random_range(0..good.len())].as_bytes().to_vec();
        for _ in 0..rng.random_range(0..4) {
            let at = rng.random_range(0..line.len());
            match rng.random_range(0..4) {
                0 => line[at] = rng.random(),
                1 => line.truncate(at + 1),
                2 => line.insert(at, b"{}[]\",:019-.e"[rng.random_range(0..13)]),
                _ => drop(line.remove(at)),
            }
            if line.is_empty() {
                break;
            }
        }
        let before = console.answer();
        match console.feed_line(&String::from_utf8_lossy(&line)) {
            Ok(answer) => heard += u32::from(answer.heard),
            Err(error) => {
                refused += 1;
                assert!(error.to_string().starts_with("line "), "FUZZ_SEED={seed}: {error}");
                assert_eq!(console.answer(), before, "FUZZ_SEED={seed}: {error}");
            }
        }
    }
    assert!(heard > 1000 && refused > 1000, "FUZZ_SEED={seed}: {heard} heard, {refused} refused");
}

fn found_out(judge: Judge) -> Option<String> {
    (1..=60).find_map(|seed| play(GameKind::PaperEightBall, judge, seed).err())
}

fn number(name: &str, default: u64) -> u64 {
    match std::env::var(name) {
        Ok(text) => text.parse().unwrap_or_else(|_| panic!("{name}={text} is no whole number")),
        Err(_) => default,
    }
}

/// What a run has met.
#[derive(Debug, Default)]
struct Tally {
    events: u64,
    verdicts: u64,
    fouls: u64,
    wins: u64,
    draws: u64,
    assigned: u64,
    spotted: u64,
    shuffled: u64,
}

impl Tally {
    fn add(&mut self, other: Tally) -> u64 {
        self.verdicts += other.verdicts;
        self.fouls += other.fouls;
        self.wins += other.wins;
        self.draws += other.draws;
        self.assigned += other.assigned;
        self.spotted += other.spotted;
        self.shuffled += other.shuffled;
        self.events += other.events;
        other.events
    }
}

/// Plays one game of random facts; an error says which rule the referee broke.
fn play(game: GameKind, judge: Judge, seed: u64) -> Result<Tally, String> {
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    let swarm = Swarm::new(&mut rng);
    let mut referee = Referee::with_judge(game, judge);
    if referee.handle(&fact(0.0, FactKind::Settled { snookered: false })).iter().next().is_some() {
        return Err("something was said before the game began".into());
    }
    let mut account = Account::new(game);
    let rack = (1..=15).map(BallId);
    account.check_turn(&referee.begin(rack), &referee)?;

    let (mut time_s, mut tally) = (0.0, Tally::default());
    let mut before_shot = referee.clone();
    let mut facts: Vec<Fact> = Vec::new();
    let mut late = 0;
    for _ in 0..GAME_EVENTS {
        late += usize::from(referee.phase() == Phase::Over);
        if late > LATE_EVENTS {
            break;
        }
        let is_shooting = referee.phase() == Phase::Shooting;
        let mut kind = swarm.kind(&mut rng, &referee);
        if swarm.is_possible {
            kind = made_possible(kind, is_shooting, &mut rng, &referee);
        }
        let is_tie = rng.random_bool(swarm.tie);
        if !is_tie {
            time_s += 0.125;
        }
        if !swarm.is_possible && rng.random_bool(0.05) {
            time_s -= 1.0;
        }
        let fact = fact(time_s, kind);
        let (phase, hash) = (referee.phase(), hash_of(&referee));
        if phase != Phase::Shooting {
            before_shot = referee.clone();
            facts.clear();
        }
        facts.push(fact);
        let said = referee.handle(&fact);
        tally.events += 1;
        match (phase, kind) {
            (Phase::Over, _) if !said.is_empty() || hash_of(&referee) != hash => {
                return Err("something was heard after the end".into());
            }
            (Phase::Shooting, FactKind::Settled { .. }) => {
                account.check_shot(&facts, &said, &referee, &mut tally)?;
                tally.shuffled += u64::from(check_ties(&before_shot, &mut facts, &said, &mut rng)?);
            }
            (Phase::Placing | Phase::Waiting, FactKind::BallPlaced { ball: BallId::CUE, .. })
                if !said.is_empty() =>
            {
                account.check_turn(&said, &referee)?;
            }
            _ if !said.is_empty() => return Err(format!("{kind:?} made the referee say {said:?}")),
            _ => {}
        }
    }
    Ok(tally)
}

fn fact(time_s: f64, kind: FactKind) -> Fact {
    Fact { time_s, kind }
}

fn hash_of(referee: &Referee) -> Digest {
    let mut hash = StateHash::new();
    referee.hash(&mut hash);
    hash.finish()
}

/// What happens at the same time within a shot may be told in any order. The stroke that begins it
/// and the rest that ends it keep their places. Returns whether there was anything to shuffle.
fn check_ties(
    before: &Referee,
    facts: &mut [Fact],
    said: &[Event],
    rng: &mut Pcg64Mcg,
) -> Result<bool, String> {
    let between = 1..facts.len() - 1;
    if between.is_empty() {
        return Ok(false);
    }
    let mut was_shuffled = false;
    for ties in facts[between].chunk_by_mut(|a, b| a.time_s == b.time_s) {
        was_shuffled |= ties.len() > 1;
        (1..ties.len()).rev().for_each(|i| ties.swap(i, rng.random_range(0..=i)));
    }
    let mut referee = before.clone();
    let said_now: Vec<Event> = facts.iter().flat_map(|fact| referee.handle(fact)).collect();
    match said_now == said {
        true => Ok(was_shuffled),
        false => Err(format!("the order of ties decides: {said:?} against {said_now:?}")),
    }
}

/// The game as somebody who does not trust the referee writes it down.
struct Account {
    game: GameKind,
    on_table: Vec<BallId>,
    groups: Option<Groups>,
    player: PlayerId,
    is_break: bool,
    dry_turns: u32,
    turn_had_pot: bool,
    shot_number: u32,
}

impl Account {
    fn new(game: GameKind) -> Self {
        Account {
            game,
            on_table: (1..=15).map(BallId).collect(),
            groups: (game == GameKind::PaperEightBall).then_some(Groups::Open),
            player: PlayerId::ONE,
            is_break: true,
            dry_turns: 0,
            turn_had_pot: false,
            shot_number: 1,
        }
    }

    fn check_shot(
        &mut self,
        facts: &[Fact],
        said: &[Event],
        referee: &Referee,
        tally: &mut Tally,
    ) -> Result<(), String> {
        let [Event::Verdict(verdict), rest @ ..] = said else {
            return Err(format!("no verdict at rest: {said:?}"));
        };
        let fallen: Vec<BallId> = facts
            .iter()
            .filter_map(|fact| match fact.kind {
                FactKind::BallPocketed { ball, .. } => Some(ball),
                _ => None,
            })
            .collect();
        let lost: Vec<BallId> = facts
            .iter()
            .filter_map(|fact| match fact.kind {
                FactKind::BallOffTable { ball } => Some(ball),
                _ => None,
            })
            .collect();
        let fell = |ball: BallId| fallen.contains(&ball);
        let left = |ball: BallId| lost.contains(&ball);
        let pots = (1..18).filter(|ball| fell(BallId(*ball))).count();
        require(verdict.player == Some(self.player), "the verdict is on another player")?;
        require(verdict.pocketed.len() == pots, "a pocketed ball is missing or double")?;
        require(verdict.legal == verdict.fouls.is_empty(), "a foul shot is called legal")?;
        require(verdict.fouls.is_sorted(), "fouls are not sorted")?;

        match self.game {
            GameKind::PaperEightBall => self.check_eight_ball(verdict, &fell, &left, pots)?,
            GameKind::FreePlay => {
                require(verdict.legal && verdict.groups.is_none(), "a foul in free play")?;
                require(verdict.turn != TurnAfter::Pass, "the turn passed in free play")?;
                require(verdict.winner.is_none(), "somebody won free play")?;
                let in_hand = verdict.ball_in_hand == BallInHand::Anywhere;
                let is_gone = fell(BallId::CUE) || left(BallId::CUE);
                let goes_on = verdict.turn == TurnAfter::Continue;
                require(in_hand == (goes_on && is_gone), "the cue ball is in the wrong place")?;
            }
            _ => {}
        }

        tally.verdicts += 1;
        tally.fouls += u64::from(!verdict.legal);
        tally.wins += u64::from(verdict.winner.is_some());
        let is_end = verdict.turn == TurnAfter::End;
        tally.draws += u64::from(is_end && verdict.winner.is_none());
        tally.assigned += u64::from(verdict.groups != self.groups);
        tally.spotted += verdict.spot.len() as u64;

        let count = self.on_table.len() + verdict.spot.len();
        self.on_table.retain(|ball| !fell(*ball) && !left(*ball));
        self.on_table.extend(verdict.spot.iter().filter(|ball| fell(**ball) || left(**ball)));
        self.on_table.sort_unstable();
        self.on_table.dedup();
        require(self.on_table.len() <= count, "balls came from nowhere")?;
        require(referee.state().on_table.as_slice() == self.on_table, "balls are miscounted")?;
        self.groups = verdict.groups;
        self.is_break = false;
        self.shot_number += 1;

        let rest = match (verdict.spot.is_empty(), rest) {
            (true, rest) => rest,
            (false, [Event::Command(Command::SpotBalls(spotting)), rest @ ..]) => {
                require(
                    spotting.balls == verdict.spot,
                    "other balls are spotted than the verdict says",
                )?;
                rest
            }
            (false, _) => return Err("the balls to spot are not spotted".into()),
        };
        if is_end {
            require(verdict.next_player.is_none(), "somebody shoots after the end")?;
            require(rest.is_empty(), "something was said after the end")?;
            return require(referee.phase() == Phase::Over, "the end is not the end");
        }
        self.player = verdict.next_player.ok_or("nobody shoots next")?;
        self.check_turn(rest, referee)
    }

    fn check_eight_ball(
        &mut self,
        verdict: &Verdict,
        fell: &dyn Fn(BallId) -> bool,
        left: &dyn Fn(BallId) -> bool,
        pots: usize,
    ) -> Result<(), String> {
        let other = self.player.other();
        let has = |foul: Foul| verdict.fouls.contains(&foul);
        require(has(Foul::Scratch) == fell(BallId::CUE), "a scratch is missed or made up")?;
        require(has(Foul::CueOff) == left(BallId::CUE), "a lost cue ball is missed or made up")?;
        let any_left = (1..18).any(|ball| left(BallId(ball)));
        require(has(Foul::BallOff) == any_left, "a lost ball is missed or made up")?;

        if !verdict.legal && verdict.turn != TurnAfter::End {
            require(verdict.next_player == Some(other), "a foul does not end the turn")?;
            require(verdict.ball_in_hand == BallInHand::Anywhere, "a foul gives no ball in hand")?;
        }
        let is_settled = self.groups != Some(Groups::Open);
        require(!is_settled || verdict.groups == self.groups, "groups changed")?;
        let is_assigned = verdict.groups != self.groups;
        require(!is_assigned || (verdict.legal && !self.is_break), "assigned by a foul or break")?;

        let eight_gone = fell(BallId::EIGHT) || left(BallId::EIGHT);
        let decides = eight_gone && !self.is_break;
        require(verdict.winner.is_some() == decides, "the 8 does not decide, or something else")?;
        let expected_spot: &[BallId] =
            if eight_gone && self.is_break { &[BallId::EIGHT] } else { &[] };
        require(verdict.spot.as_slice() == expected_spot, "wrong balls are spotted")?;
        if verdict.winner == Some(self.player) {
            let own = self.groups.and_then(|groups| groups.of(self.player));
            let has_own = self
                .on_table
                .iter()
                .any(|ball| Group::of(*ball).is_some() && Group::of(*ball) == own);
            require(own.is_some() && !has_own && verdict.legal, "won without the right to")?;
        }

        self.turn_had_pot |= pots > 0;
        if verdict.turn != TurnAfter::Continue {
            self.dry_turns = if self.turn_had_pot { 0 } else { self.dry_turns + 1 };
            self.turn_had_pot = false;
        }
        let is_draw = verdict.turn == TurnAfter::End && verdict.winner.is_none();
        let is_due = self.dry_turns >= 60 && verdict.winner.is_none();
        require(is_draw == is_due, "a draw comes too early or too late")
    }

    fn check_turn(&self, said: &[Event], referee: &Referee) -> Result<(), String> {
        let [Event::Turn(turn)] = said else {
            return Err(format!("one turn was awaited, not {said:?}"));
        };
        require(turn.player == self.player, "the wrong player is called")?;
        require(turn.shot_number == self.shot_number, "shots are miscounted")?;
        require(turn.on_table.as_slice() == self.on_table, "the turn has other balls")?;
        require(turn.groups == self.groups, "the turn has other groups")?;
        let all_lie = turn.legal_first.iter().all(|ball| turn.on_table.contains(ball));
        require(all_lie && turn.legal_first.is_sorted(), "a ball on is not on the table")?;
        let in_hand = turn.ball_in_hand != BallInHand::None;
        require((referee.phase() == Phase::Placing) == in_hand, "the phase contradicts the turn")
    }
}

fn require(holds: bool, problem: &str) -> Result<(), String> {
    if holds { Ok(()) } else { Err(problem.into()) }
}
