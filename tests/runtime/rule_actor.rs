//! Random events against the actor of the referee, through its mailbox: it says what its core
//! says, and it never dies.
//!
//! `FUZZ_SEED` and `FUZZ_EVENTS` choose another run or a longer one.

use crate::facts::{Swarm, made_possible};
use hapticbillard::events::{
    Command, Event, Fact, FactKind, MenuAction, PlayerReport, PlayerState, Source, Stamp, Stamped,
};
use hapticbillard::hash::Digest;
use hapticbillard::ids::{BallId, PlayerId};
use hapticbillard::rules::{GameKind, Phase, Referee};
use hapticbillard::tick::{Delivered, Outcome};
use hapticbillard::units::Tick;
use hapticbillard_actors::participant::{Answer, Ask, Mail, collect, door};
use hapticbillard_actors::rules::Rules;
use kameo::actor::{ActorRef, Spawn};
use kameo::error::SendError;
use kameo::mailbox;
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
    fn new(game: GameKind) -> Self {
        let mut core = Referee::new(game);
        core.begin((1..=15).map(BallId));
        let actor = Rules::spawn_with_mailbox(Rules(core.clone()), mailbox::bounded(2));
        Pair { core, ask: door(actor.clone()), actor, sequence: 0 }
    }

    /// One tick's mail, in which anything may stand: the door does not look into it.
    fn mail(&mut self, rng: &mut Pcg64Mcg, swarm: &Swarm, tick: u64) -> Mail {
        let mut ahead = self.core.clone();
        let count = [0, 1, 1, 2, 5][rng.random_range(0..5)];
        let events: Vec<Stamped> = (0..count)
            .map(|_| {
                let event = match rng.random_range(0..12) {
                    0 => Event::Command(Command::LiftCue),
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
                let source = Source::Physics;
                let stamp = Stamp { tick: Tick(tick), source, sequence: self.sequence };
                Stamped { stamp, event }
            })
            .collect();
        Mail(Delivered { tick: Tick(tick), events: events.into(), table: Default::default() })
    }

    /// Sends the mail both ways.
    async fn deliver(&mut self, mail: Mail) -> [(Outcome, Digest); 2] {
        let from_core = collect(&mut self.core, &mail);
        let from_actor = (self.ask)(mail).answer().await.unwrap();
        [from_core, from_actor].map(|Answer { outcome, digest }| (outcome, digest))
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
/// is refused, not lost in silence, and the actor goes on from what it has taken.
#[tokio::test]
async fn a_full_mailbox_refuses_and_the_actor_lives_on() {
    let mut pair = Pair::new(GameKind::FreePlay);
    pair.actor.wait_for_startup().await;
    let fact = |kind| {
        let stamp = Stamp { tick: Tick(1), source: Source::Physics, sequence: 0 };
        let event = Event::Fact(Fact { time_s: 0.0, kind });
        let events = [Stamped { stamp, event }].into();
        Mail(Delivered { tick: Tick(1), events, table: Default::default() })
    };
    let settled = || fact(FactKind::Settled { snookered: false, cue_in_rack: false });
    // On one thread the actor does not run before somebody waits for it.
    let taken = [(pair.ask)(settled()), (pair.ask)(settled())];
    let refused = (pair.ask)(settled()).answer().await;
    assert!(matches!(refused, Err(SendError::MailboxFull(_))), "{refused:?}");
    for asked in taken {
        asked.answer().await.unwrap();
    }
    let [core, actor] = pair.deliver(settled()).await;
    assert_eq!(actor, core);
    assert!(pair.actor.is_alive());
}
