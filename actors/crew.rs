//! Who is on board, for whoever supervises a game from outside; and what can be done to them.
//!
//! A [`Fault`] is a message among an actor's others, so that it strikes between two of them, or
//! while the actor is asked. `soak` and the tests do that on purpose; a game is run without.

use crate::ai::Ai;
use crate::conductor::Conductor;
use crate::event_manager::EventManager;
use crate::haptic::Haptic;
use crate::input::{Input, StandIn};
use crate::observer::Observer;
use crate::physics::Physics;
use crate::recorder::Recorder;
use crate::rules::Rules;
use crate::sound::Sound;
use kameo::mailbox;
use kameo::prelude::*;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// How many messages an actor of the tick can have waiting: it is asked once a tick and answers
/// before the next, so two are one more than ever wait. When it is full the asker waits.
pub(crate) const MAILBOX: usize = 2;

/// Something bad that happens to an actor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    /// It is stopped from outside, whatever it does.
    Kill,
    /// It panics.
    Panic,
    /// It holds its thread for so long, and everybody who shares it.
    Stall(Duration),
    /// It answers so much later; others go on.
    Delay(Duration),
    /// So many messages that mean nothing arrive, as fast as its mailbox takes them.
    Flood(u32),
}

/// A message that does what it says to whoever reads it.
#[derive(Debug, Clone, Copy)]
pub enum Blow {
    /// Nothing.
    Nothing,
    /// It panics.
    Panic,
    /// It holds its thread.
    Stall(Duration),
    /// It waits.
    Delay(Duration),
}

impl Blow {
    async fn strike(self) {
        match self {
            Blow::Nothing => {}
            // Without the words of a panic on stderr: this one is meant.
            Blow::Panic => std::panic::resume_unwind(Box::new("the actor is made to fail")),
            Blow::Stall(time) => std::thread::sleep(time),
            Blow::Delay(time) => tokio::time::sleep(time).await,
        }
    }
}

macro_rules! can_be_struck {
    ($($actor:ty),+) => {
        $(impl Message<Blow> for $actor {
            type Reply = ();

            async fn handle(&mut self, blow: Blow, _: &mut Context<Self, ()>) {
                blow.strike().await;
            }
        })+
    };
}

can_be_struck!(
    Ai,
    Conductor,
    EventManager,
    Haptic,
    Input,
    Observer,
    Physics,
    Recorder,
    Rules,
    Sound,
    StandIn
);

/// Who comes aboard, if anybody wants to know.
#[derive(Clone, Default)]
pub struct Crew(Option<Roster>);

/// Everybody who came aboard and lives.
#[derive(Clone, Default)]
pub struct Roster(Arc<Mutex<Vec<Member>>>);

/// One of the crew. Nobody is kept alive by being known.
struct Member {
    name: &'static str,
    lives: Box<dyn Fn() -> bool + Send>,
    suffer: Box<dyn Fn(Fault) -> bool + Send>,
}

impl Crew {
    /// A crew, and the roster of it.
    pub fn watched() -> (Self, Roster) {
        let roster = Roster::default();
        (Crew(Some(roster.clone())), roster)
    }

    /// Spawns an actor of the tick.
    pub fn join<A: Message<Blow> + Actor<Args = A>>(
        &self,
        name: &'static str,
        actor: A,
    ) -> ActorRef<A> {
        let actor = A::spawn_with_mailbox(actor, mailbox::bounded(MAILBOX));
        self.tell(name, &actor);
        actor
    }

    /// Tells of an actor that somebody else spawned.
    pub fn tell<A: Message<Blow>>(&self, name: &'static str, actor: &ActorRef<A>) {
        let Some(roster) = &self.0 else { return };
        let known = actor.downgrade();
        let lives = {
            let known = known.clone();
            Box::new(move || known.upgrade().is_some_and(|actor| actor.is_alive()))
        };
        let suffer = Box::new(move |fault| {
            known.upgrade().filter(ActorRef::is_alive).is_some_and(|actor| strike(&actor, fault))
        });
        let mut members = roster.members();
        members.retain(|member| (member.lives)());
        members.push(Member { name, lives, suffer });
    }
}

impl Roster {
    fn members(&self) -> MutexGuard<'_, Vec<Member>> {
        // Nothing is done under the lock that could leave it half done.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Does this to everybody of a name who lives; returns to how many. Who is too busy to take a
    /// message is spared.
    pub fn strike(&self, name: &str, fault: Fault) -> usize {
        let members = self.members();
        members.iter().filter(|member| member.name == name && (member.suffer)(fault)).count()
    }

    /// The names of those who live, in the order in which they came.
    pub fn living(&self) -> Vec<&'static str> {
        self.members().iter().filter(|member| (member.lives)()).map(|member| member.name).collect()
    }
}

fn strike<A: Message<Blow>>(actor: &ActorRef<A>, fault: Fault) -> bool {
    match fault {
        Fault::Kill => {
            actor.kill();
            true
        }
        Fault::Panic => actor.tell(Blow::Panic).try_send().is_ok(),
        Fault::Stall(time) => actor.tell(Blow::Stall(time)).try_send().is_ok(),
        Fault::Delay(time) => actor.tell(Blow::Delay(time)).try_send().is_ok(),
        Fault::Flood(count) => {
            let actor = actor.downgrade();
            // From a thread of its own: whoever strikes is part of the tick and must not wait.
            std::thread::spawn(move || {
                for _ in 0..count {
                    let Some(actor) = actor.upgrade().filter(ActorRef::is_alive) else { return };
                    if actor.tell(Blow::Nothing).try_send().is_err() {
                        std::thread::yield_now();
                    }
                }
            });
            true
        }
    }
}
