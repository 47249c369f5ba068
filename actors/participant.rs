//! What rules, players and input have in common: they take part in the tick.
//!
//! Whoever implements `Message<Delivered>` is a listener, the paper's `AbstractEventListener`; the
//! runtime registers it when it spawns it. A mock is any actor that answers [`Mail`].

use crate::kept::Kept;
use hapticbillard::events::{Source, Topics};
use hapticbillard::hash::{Digest, StateHash};
use hapticbillard::physics::Snapshot;
use hapticbillard::tick::{Delivered, Outcome, Participant};
use kameo::error::SendError;
use kameo::prelude::*;
use kameo::request::PendingReply;
use std::sync::Arc;
use tracing::Span;

/// The mail of one tick, and in which shot it was sent, for the log.
#[derive(Debug, Clone)]
pub struct Mail(pub Delivered, pub Span);

impl From<Delivered> for Mail {
    fn from(delivered: Delivered) -> Self {
        Mail(delivered, Span::none())
    }
}

/// The answer to the mail: what the participant publishes, and the hash of its state.
#[derive(Debug, Clone, Reply)]
pub struct Answer {
    /// What it publishes.
    pub outcome: Outcome,
    /// Its state after the tick.
    pub digest: Digest,
}

/// Puts mail into a participant's mailbox at once and returns the answer to come.
pub type Ask = Box<dyn Fn(Mail) -> Asked + Send + Sync + 'static>;

/// Asks whoever takes the place of somebody who died for this reason.
pub type Again = Box<dyn FnOnce(&str) -> Asked + Send>;

/// What came of the mail.
pub type Answered = Result<Answer, SendError<Mail>>;

/// Somebody was asked.
pub enum Asked {
    /// The mail is in the mailbox.
    Pending(PendingReply<Mail, Answer>),
    /// The same, and who dies over it is replaced and asked again.
    Kept(PendingReply<Mail, Answer>, Again),
    /// The participant is gone, or its mailbox is full.
    Refused(Box<SendError<Mail>>),
}

impl Asked {
    /// Waits for the answer.
    ///
    /// # Errors
    /// What became of the mail: the participant is gone, it died over it, or its mailbox is full.
    /// It is asked once a tick and answers before the next, so a full mailbox means that somebody
    /// else writes to it.
    pub async fn answer(self) -> Answered {
        let again = match self {
            Asked::Kept(answer, again) => match answer.await {
                Ok(answer) => return Ok(answer),
                Err(error) => again(&error.to_string()),
            },
            asked => asked,
        };
        match again {
            Asked::Pending(answer) | Asked::Kept(answer, _) => answer.await,
            Asked::Refused(error) => Err(*error),
        }
    }
}

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
    Box::new(move |mail| put(&actor, mail))
}

/// The door to whoever is in this place.
pub fn kept_door<A: Message<Mail, Reply = Answer>>(kept: Arc<Kept<A>>) -> Ask {
    Box::new(move |mail| {
        let actor = kept.actor();
        let again = {
            let (kept, actor, mail) = (kept.clone(), actor.clone(), mail.clone());
            move |reason: &str| match kept.instead_of(&actor, reason) {
                Some(other) => put(&other, mail),
                None => Asked::Refused(Box::new(SendError::ActorNotRunning(mail))),
            }
        };
        match put(&actor, mail) {
            Asked::Pending(answer) => Asked::Kept(answer, Box::new(again)),
            Asked::Refused(error) => again(&error.to_string()),
            asked => asked,
        }
    })
}

/// Puts mail into the mailbox of an actor.
fn put<A: Message<Mail, Reply = Answer>>(actor: &ActorRef<A>, mail: Mail) -> Asked {
    // Kameo's `try_enqueue` panics where mail is refused, so it is looked at before. Between
    // two ticks a participant has nothing to do that it could die of.
    if !actor.is_alive() {
        return Asked::Refused(Box::new(SendError::ActorNotRunning(mail)));
    }
    if actor.mailbox_sender().capacity() == Some(0) {
        return Asked::Refused(Box::new(SendError::MailboxFull(mail)));
    }
    match actor.ask(mail).try_enqueue() {
        Ok(answer) => Asked::Pending(answer),
        Err(_) => Asked::Refused(Box::new(SendError::ActorStopped)),
    }
}

/// Hands `mail` to a core.
pub fn collect(core: &mut (impl Participant + ?Sized), mail: &Mail) -> Answer {
    let outcome = mail.1.in_scope(|| core.collect(&mail.0));
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
