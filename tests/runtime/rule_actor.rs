//! Random events against the actor of the referee, through its mailbox: it says what its core
//! says, and it never dies.
//!
//! `FUZZ_SEED` and `FUZZ_EVENTS` choose another run or a longer one.

use crate::facts::{Swarm, made_possible};
use hapticbillard::events::{
    Call, CallKind, Choice, Command, Event, Fact, FactKind, MenuAction, PlayerReport, PlayerState,
    Source, Stamp, Stamped,
};
use hapticbillard::hash::Digest;
use hapticbillard::ids::{BallId, PlayerId, PocketId};
use hapticbillard::rules::{GameKind, Phase, Referee, game as game_of};
use hapticbillard::tick::{Delivered, Outcome};
use hapticbillard::units::Tick;
use hapticbillard_actors::participant::{Answer, Ask, Mail, collect, door};
use hapticbillard_actors::rules::Rules;
use kameo::actor::{ActorRef, Spawn};
use kameo::mailbox;
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

fn number(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(default)
}

/// A referee, and an actor that owns another one like it.
struct Pair {
    core: Referee,
    actor: ActorRef<Rules>,
    ask: Ask,
    sequence: u64,
}

impl Pair {
    fn new(kind: GameKind) -> Self {
        let mut core = Referee::new(kind);
        core.begin((0..=game_of(kind).balls).map(BallId));
        let actor = Rules::spawn_with_mailbox(Rules(core.clone()), mailbox::bounded(2));
        Pair { core, ask: door(actor.clone()), actor, sequence: 0 }
    }

    /// One tick's mail, in which anything may stand: the door does not look into it.
    fn mail(&mut self, rng: &mut Pcg64Mcg, swarm: &Swarm, tick: u64) -> Mail {
        let mut ahead = self.core.clone();
        let count = [0, 1, 1, 2, 5][rng.random_range(0..5)];
        let mut events: Vec<Stamped> = (0..count)
            .map(|_| {
                let mut source = Source::Physics;
                let event = match rng.random_range(0..12) {
                    0 => {
                        source = if rng.random_bool(0.8) {
                            Source::Input
                        } else {
                            Source::Ai(PlayerId::TWO)
                        };
                        let command = command(rng, &ahead);
                        ahead.obey(source, &command);
                        Event::Command(command)
                    }
                    1 => Event::Menu(MenuAction::Pause),
                    2 => {
                        let (player, state) = (PlayerId::TWO, PlayerState::Aiming);
                        Event::Player(PlayerReport { player, state })
                    }
                    _ => {
                        let mut kind = swarm.kind(rng, &ahead);
                        if swarm.is_possible {
                            let shooting = ahead.phase() == Phase::Shooting;
                            kind = made_possible(kind, shooting, rng, &ahead);
                        }
                        let time_s = if rng.random_bool(0.01) { f64::NAN } else { tick as f64 };
                        let fact = Fact { time_s, kind };
                        ahead.handle(&fact);
                        Event::Fact(fact)
                    }
                };
                self.sequence += 1;
                let stamp = Stamp { tick: Tick(tick), source, sequence: self.sequence };
                Stamped { stamp, event }
            })
            .collect();
        // A manager that is out of order is no reason to fall.
        if rng.random_bool(0.1) {
            events.shuffle(rng);
        }
        Delivered { tick: Tick(tick), events: events.into(), table: Default::default() }.into()
    }

    /// Sends the mail both ways.
    async fn deliver(&mut self, mail: Mail) -> [(Outcome, Digest); 2] {
        let from_core = collect(&mut self.core, &mail);
        let from_actor = (self.ask)(mail).answer().await.unwrap();
        [from_core, from_actor].map(|Answer { outcome, digest }| (outcome, digest))
    }
}

/// What a player may say: an option, a call, or nothing that concerns the rules.
fn command(rng: &mut Pcg64Mcg, referee: &Referee) -> Command {
    let state = referee.state();
    match (state.options.as_slice(), rng.random_range(0..6)) {
        (options @ [_, ..], 0..4) => Command::Choose(options[rng.random_range(0..options.len())]),
        (_, 0) => Command::Choose(Choice::Rebreak),
        (_, 1) => Command::Call(Call::Kind(CallKind::Safety)),
        (_, 2) => Command::Call(Call::Kind(CallKind::PushOut)),
        (_, 3) => Command::LiftCue,
        _ => {
            let ball = state.on_table.first().copied().unwrap_or_default();
            let pocket = PocketId::ALL[rng.random_range(0..6)];
            Command::Call(Call::Ball { ball, pocket: Some(pocket) })
        }
    }
}

#[tokio::test]
async fn the_rule_actor_says_what_its_core_says_whatever_it_is_sent() {
    let (first, mails) = (number("FUZZ_SEED", 1), number("FUZZ_EVENTS", 40_000));
    let (mut seed, mut sent, mut verdicts, mut ends) = (first, 0, 0, 0);
    while sent < mails {
        for game in GameKind::ALL {
            let mut rng = Pcg64Mcg::seed_from_u64(seed);
            let swarm = Swarm::new(&mut rng);
            let mut pair = Pair::new(game);
            let mut late = 0;
            for tick in 1..=600 {
                let mail = pair.mail(&mut rng, &swarm, tick);
                let [core, actor] = pair.deliver(mail).await;
                assert_eq!(actor, core, "FUZZ_SEED={seed} {game}, mail {tick}");
                let said = core.0.publish.iter();
                verdicts += said.filter(|p| matches!(p.event, Event::Verdict(_))).count();
                sent += 1;
                late += u32::from(pair.core.phase() == Phase::Over);
                if 10 < late {
                    ends += 1;
                    break;
                }
            }
            assert!(pair.actor.is_alive(), "FUZZ_SEED={seed} {game}");
        }
        seed += 1;
    }
    // The generator must reach the corners, or nothing was tested.
    if mails >= 40_000 {
        assert!(1000 < verdicts && 5 < ends, "{verdicts} verdicts, {ends} games over");
    }
}

/// The event manager asks once a tick and waits. Who does not wait finds the mailbox full: the mail
/// waits for room, nothing is lost, and the actor goes on.
#[tokio::test]
async fn a_full_mailbox_lets_mail_wait_and_the_actor_lives_on() {
    let mut pair = Pair::new(GameKind::FreePlay);
    pair.actor.wait_for_startup().await;
    let fact = |kind| {
        let stamp = Stamp { tick: Tick(1), source: Source::Physics, sequence: 0 };
        let event = Event::Fact(Fact { time_s: 0.0, kind });
        let events = [Stamped { stamp, event }].into();
        Mail::from(Delivered { tick: Tick(1), events, table: Default::default() })
    };
    let settled = || fact(FactKind::Settled { snookered: false, cue_in_rack: false });
    // On one thread the actor does not run before somebody waits for it.
    let taken = [(pair.ask)(settled()), (pair.ask)(settled())];
    let waiting = (pair.ask)(settled());
    for asked in taken.into_iter().chain([waiting]) {
        asked.answer().await.unwrap();
    }
    let [core, actor] = pair.deliver(settled()).await;
    assert_eq!(actor, core);
    assert!(pair.actor.is_alive());
}

/// Stopped in the middle of its mail, the actor answers what it has taken as its core does, and
/// refuses the rest; nobody waits for ever.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn stopped_in_the_middle_it_answers_what_it_has_taken_and_refuses_the_rest() {
    let first = number("FUZZ_SEED", 1);
    let (mut answered, mut refused) = (0, 0);
    for seed in first..first + 200 {
        let mut rng = Pcg64Mcg::seed_from_u64(seed);
        let swarm = Swarm::new(&mut rng);
        let kind = GameKind::ALL[rng.random_range(0..GameKind::ALL.len())];
        let mut pair = Pair::new(kind);
        let actor = pair.actor.clone();
        let stops_at = rng.random_range(1..40);
        let mut alive = true;
        for tick in 1..=40 {
            if tick == stops_at {
                match rng.random_bool(0.5) {
                    true => actor.kill(),
                    false => drop(actor.stop_gracefully().await),
                }
            }
            let mail = pair.mail(&mut rng, &swarm, tick);
            let expected = collect(&mut pair.core, &mail);
            match (pair.ask)(mail).answer().await {
                Ok(answer) => {
                    assert!(alive, "FUZZ_SEED={seed}: it answered after it had refused");
                    let pairs = (answer.outcome, answer.digest);
                    assert_eq!(pairs, (expected.outcome, expected.digest), "FUZZ_SEED={seed}");
                    answered += 1;
                }
                Err(_) => {
                    assert!(tick >= stops_at, "FUZZ_SEED={seed}: it refused before its end");
                    alive = false;
                    refused += 1;
                }
            }
        }
        actor.wait_for_shutdown().await;
        let mail = pair.mail(&mut rng, &swarm, 41);
        let late = (pair.ask)(mail).answer().await;
        assert!(late.is_err(), "FUZZ_SEED={seed}: it was stopped and lives on");
    }
    assert!(answered > 1000 && refused > 1000, "{answered} answered, {refused} refused");
}
