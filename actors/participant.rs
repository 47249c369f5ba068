//! What rules, players and input have in common: they take part in the tick.
//!
//! Whoever implements `Message<Delivered>` is a listener, the paper's `AbstractEventListener`; the
//! runtime registers it when it spawns it. A mock is any actor that answers [`Mail`].

use hapticbillard::events::{Source, Topics};
use hapticbillard::hash::{Digest, StateHash};
use hapticbillard::physics::Snapshot;
use hapticbillard::tick::{Delivered, Outcome, Participant};
use kameo::error::SendError;
use kameo::prelude::*;
use kameo::request::PendingReply;

/// The mail of one tick.
#[derive(Debug, Clone)]
pub struct Mail(pub Delivered);

/// The answer to the mail: what the participant publishes, and the hash of its state.
#[derive(Debug, Clone, Reply)]
pub struct Answer {
    /// What it publishes.
    pub outcome: Outcome,
    /// Its state after the tick.
    pub digest: Digest,
}

/// Puts mail into a participant's mailbox at once and returns the answer to come. When the mailbox
/// is full it refuses: a participant is asked once a tick and answers before the next, so this
/// means that somebody else writes to it.
pub type Ask =
    Box<dyn Fn(Mail) -> Result<PendingReply<Mail, Answer>, SendError> + Send + Sync + 'static>;

/// A participant as the event manager knows it.
pub struct Seat {
    /// Its name on what it publishes.
    pub source: Source,
    /// What it wants to be told.
    pub topics: Topics,
    /// What it said at the start.
    pub first: Answer,
    /// Where its mail goes. It keeps the actor alive.
    pub ask: Ask,
}

/// The door to an actor that answers [`Mail`].
pub fn door<A: Message<Mail, Reply = Answer>>(actor: ActorRef<A>) -> Ask {
    Box::new(move |mail| actor.ask(mail).try_enqueue())
}

/// Hands `mail` to a core.
pub fn collect(core: &mut (impl Participant + ?Sized), mail: &Mail) -> Answer {
    let outcome = core.collect(&mail.0);
    Answer { outcome, digest: digest(core) }
}

/// Starts a core.
pub fn start(core: &mut (impl Participant + ?Sized), table: &Snapshot) -> Answer {
    let outcome = core.start(table);
    Answer { outcome, digest: digest(core) }
}

fn digest(core: &(impl Participant + ?Sized)) -> Digest {
    let mut hash = StateHash::new();
    core.hash(&mut hash);
    hash.finish()
}
