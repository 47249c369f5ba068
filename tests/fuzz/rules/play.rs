//! One game of random events, played against the referee and written down by somebody who does not
//! trust it.

use super::account::Account;
use super::script::{Script, Step};
use crate::facts::{Swarm, made_possible};
use hapticbillard::events::{Call, CallKind, Choice, Command, Event, Fact, FactKind, Source};
use hapticbillard::hash::{Digest, StateHash};
use hapticbillard::ids::{BallId, PocketId};
use hapticbillard::rules::{GameKind, Judge, Phase, Referee, game};
use hapticbillard::tick::Participant;
use rand::{Rng, RngExt};

/// Events in one game at the most.
const GAME_EVENTS: usize = 1500;

/// Events that a game goes on for after its end.
const LATE_EVENTS: usize = 20;

/// What a run has met.
#[derive(Debug, Default, Clone, Copy)]
pub struct Tally {
    /// Facts and commands.
    pub events: u64,
    /// Shots that were judged.
    pub verdicts: u64,
    /// Of these, with a foul.
    pub fouls: u64,
    /// Games that somebody won.
    pub wins: u64,
    /// Games that nobody won.
    pub draws: u64,
    /// Groups that were assigned.
    pub assigned: u64,
    /// Balls that were spotted.
    pub spotted: u64,
    /// Shots whose ties were told in another order.
    pub shuffled: u64,
    /// Choices that were taken.
    pub choices: u64,
    /// Calls that were heard.
    pub calls: u64,
    /// Balls that were racked in the middle of a game.
    pub racks: u64,
    /// Points that were made.
    pub points: u64,
}

impl Tally {
    /// Adds another run's; how many events that had.
    pub fn add(&mut self, other: Tally) -> u64 {
        self.events += other.events;
        self.verdicts += other.verdicts;
        self.fouls += other.fouls;
        self.wins += other.wins;
        self.draws += other.draws;
        self.assigned += other.assigned;
        self.spotted += other.spotted;
        self.shuffled += other.shuffled;
        self.choices += other.choices;
        self.calls += other.calls;
        self.racks += other.racks;
        self.points += other.points;
        other.events
    }
}

/// Plays one game; an error says which rule the referee broke.
pub fn play(kind: GameKind, judge: Judge, rng: &mut impl Rng) -> Result<Tally, String> {
    let swarm = Swarm::new(rng);
    let mut referee = Referee::with_judge(kind, judge);
    let rest = fact(0.0, FactKind::Settled { snookered: false, cue_in_rack: false });
    if !referee.handle(&rest).is_empty() {
        return Err("something was said before the game began".into());
    }
    let mut account = Account::new(kind, judge);
    let rack = (0..=game(kind).balls).map(BallId);
    account.check_opening(&referee.begin(rack), &referee)?;

    let (mut time_s, mut tally) = (0.0, Tally::default());
    let mut before_shot = referee.clone();
    // Of the shot itself, and with the placements before it.
    let (mut facts, mut heard): (Vec<Fact>, Vec<Fact>) = Default::default();
    let mut late = 0;
    let mut script = Script::default();
    for _ in 0..GAME_EVENTS {
        late += usize::from(referee.phase() == Phase::Over);
        if late > LATE_EVENTS {
            break;
        }
        tally.events += 1;
        let chooses = referee.phase() == Phase::Choosing;
        if rng.random_bool(if chooses { 0.5 } else { swarm.commands }) {
            command(&mut referee, &mut account, &mut tally, rng)?;
            continue;
        }
        let is_shooting = referee.phase() == Phase::Shooting;
        let mut what = swarm.kind(rng, &referee);
        if swarm.is_possible {
            what = made_possible(what, is_shooting, rng, &referee);
        }
        if rng.random_bool(swarm.skill) {
            match script.next(&referee, rng) {
                Some(Step::Say(command)) => {
                    hear(&mut referee, &mut account, &mut tally, Source::Input, &command)?;
                    continue;
                }
                Some(Step::Happen(kind)) => what = kind,
                None => {}
            }
        }
        if !rng.random_bool(swarm.tie) {
            time_s += 0.125;
        }
        if !swarm.is_possible && rng.random_bool(0.05) {
            time_s -= 1.0;
        }
        let fact = fact(time_s, what);
        let phase = referee.phase();
        if let (true, FactKind::BallPlaced { ball, ok, .. }) = (game(kind).is_practice, what) {
            // What a hand does in the middle of a shot depends on the order, as it must.
            if phase == Phase::Shooting {
                continue;
            }
            if ok && matches!(phase, Phase::Placing | Phase::Waiting) {
                account.put(ball);
            }
        }
        let sealed = (phase == Phase::Over).then(|| hash_of(&referee));
        if phase != Phase::Shooting {
            before_shot = referee.clone();
            facts.clear();
        }
        facts.push(fact);
        let cue_ball = referee.state().cue_ball;
        let returns = matches!(phase, Phase::Placing | Phase::Waiting)
            && matches!(what, FactKind::BallPlaced { ball, .. } if ball == cue_ball)
            && std::mem::take(&mut account.awaits_return);
        if is_heard(phase, &what, cue_ball) && !returns {
            heard.push(fact);
        }
        let call = referee.call().cloned();
        let said = referee.handle(&fact);
        match (phase, what) {
            (Phase::Over, _) if !said.is_empty() || sealed != Some(hash_of(&referee)) => {
                return Err("something was heard after the end".into());
            }
            (Phase::Shooting, FactKind::Settled { .. }) => {
                account.check_shot(&heard, call.as_ref(), &said, &referee, &mut tally)?;
                heard.clear();
                tally.shuffled += u64::from(check_ties(&before_shot, &mut facts, &said, rng)?);
            }
            (Phase::Placing | Phase::Waiting, FactKind::BallPlaced { .. }) if !said.is_empty() => {
                account.check_turn(&said, &referee)?;
            }
            _ if !said.is_empty() => return Err(format!("{what:?} made the referee say {said:?}")),
            _ => {}
        }
    }
    Ok(tally)
}

/// A player calls, chooses, or says what nobody asked for.
fn command(
    referee: &mut Referee,
    account: &mut Account,
    tally: &mut Tally,
    rng: &mut impl Rng,
) -> Result<(), String> {
    let options = referee.state().options.clone();
    let command = match rng.random_range(0..10) {
        0..6 if !options.is_empty() => Command::Choose(options[rng.random_range(0..options.len())]),
        0 => Command::Choose(CHOICES[rng.random_range(0..CHOICES.len())]),
        1 => Command::Call(Call::Kind(CallKind::Safety)),
        2 => Command::Call(Call::Kind(CallKind::PushOut)),
        3 => Command::LiftCue,
        _ => {
            let on_table = &referee.state().on_table;
            let ball = match on_table.as_slice() {
                [] => BallId(rng.random_range(0..25)),
                balls => balls[rng.random_range(0..balls.len())],
            };
            let pocket = PocketId::ALL[rng.random_range(0..6)];
            Command::Call(Call::Ball { ball, pocket: rng.random_bool(0.9).then_some(pocket) })
        }
    };
    let source = match rng.random_bool(0.9) {
        true => Source::Input,
        false => Source::Ai(referee.state().player.other()),
    };
    hear(referee, account, tally, source, &command)
}

/// Hands a command over and looks at what follows.
fn hear(
    referee: &mut Referee,
    account: &mut Account,
    tally: &mut Tally,
    source: Source,
    command: &Command,
) -> Result<(), String> {
    let options = referee.state().options.clone();
    let (before, phase, called) = (hash_of(referee), referee.phase(), referee.call().cloned());
    let said = referee.obey(source, command);
    let is_heard = hash_of(referee) != before;
    if is_heard && source != Source::Input {
        return Err(format!("{command:?} of the wrong player was heard"));
    }
    match command {
        Command::Choose(choice) if phase == Phase::Choosing && options.contains(choice) => {
            if source != Source::Input {
                return Ok(());
            }
            tally.choices += 1;
            account.check_choice(&said, referee, tally)
        }
        Command::Call(call) if is_heard => {
            tally.calls += 1;
            if !said.is_empty() || referee.call() != Some(call) {
                return Err(format!("{call:?} made the referee say {said:?}"));
            }
            match phase {
                Phase::Placing | Phase::Waiting => Ok(()),
                _ => Err(format!("{call:?} was heard in the phase {phase}")),
            }
        }
        _ if is_heard || !said.is_empty() || referee.call() != called.as_ref() => {
            Err(format!("{command:?} was heard in the phase {phase}, and made it say {said:?}"))
        }
        _ => Ok(()),
    }
}

/// Everything that somebody may say to a choice.
pub const CHOICES: [Choice; 13] = [
    Choice::PutBack,
    Choice::Accept,
    Choice::CueInHandKitchen,
    Choice::RerackAndBreak,
    Choice::RerackOpponentBreaks,
    Choice::Respot8Continue,
    Choice::Respot8CueInHandKitchen,
    Choice::Rebreak,
    Choice::Shoot,
    Choice::PassBack,
    Choice::AskAgain,
    Choice::Play,
    Choice::SpotFrozen,
];

/// What belongs to a shot: the cue ball's placement before it, the stroke, and all until rest.
fn is_heard(phase: Phase, what: &FactKind, cue_ball: BallId) -> bool {
    let places = matches!(what, FactKind::BallPlaced { .. });
    match phase {
        Phase::Placing | Phase::Waiting => match what {
            FactKind::BallPlaced { ball, .. } => *ball == cue_ball,
            FactKind::CueBallStruck { .. } | FactKind::BallTouched { .. } => true,
            _ => false,
        },
        Phase::Shooting => !places,
        Phase::Opening | Phase::Choosing | Phase::Over => false,
    }
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
    rng: &mut impl Rng,
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
    if !was_shuffled {
        return Ok(false);
    }
    let mut referee = before.clone();
    let said_now: Vec<Event> = facts.iter().flat_map(|fact| referee.handle(fact)).collect();
    match said_now == said {
        true => Ok(true),
        false => Err(format!("the order of ties decides: {said:?} against {said_now:?}")),
    }
}
