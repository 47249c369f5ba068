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
use kameo::prelude::{ActorRef, Message, Reply};
use std::future::ready;
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll, Waker};
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

/// Asks whoever takes the place of somebody who died for this reason; none if nobody does.
pub type Again = Box<dyn FnOnce(&str) -> Option<Answering> + Send>;

/// What came of the mail.
pub type Answered = Result<Answer, SendError<Mail>>;

/// An answer to come.
pub type Answering = Pin<Box<dyn Future<Output = Answered> + Send>>;

/// Somebody was asked.
pub struct Asked {
    answer: Answering,
    /// Who dies over the mail is replaced and asked again.
    again: Option<Again>,
}

impl Asked {
    /// Waits for the answer.
    ///
    /// # Errors
    /// What became of the mail: the participant is gone, or it died over it.
    pub async fn answer(self) -> Answered {
        match (self.answer.await, self.again) {
            (Err(error), Some(again)) => match again(&error.to_string()) {
                Some(answer) => answer.await,
                None => Err(error),
            },
            (answered, _) => answered,
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
    Box::new(move |mail| Asked { answer: put(&actor, mail), again: None })
}

/// The door to whoever is in this place.
pub fn kept_door<A: Message<Mail, Reply = Answer>>(kept: Arc<Kept<A>>) -> Ask {
    Box::new(move |mail| {
        let actor = kept.actor();
        let answer = put(&actor, mail.clone());
        let kept = kept.clone();
        let again = move |reason: &str| Some(put(&kept.instead_of(&actor, reason)?, mail));
        Asked { answer, again: Some(Box::new(again)) }
    })
}

/// Puts mail into the mailbox of an actor, now if there is room; otherwise it waits there with
/// others who write to it. (Kameo's own `try_enqueue` panics where mail is refused.)
fn put<A: Message<Mail, Reply = Answer>>(actor: &ActorRef<A>, mail: Mail) -> Answering {
    let actor = actor.clone();
    let mut answer: Answering = Box::pin(async move { actor.ask(mail).send().await });
    // The mail is sent when the future is polled first; whoever awaits it wakes for the answer.
    match answer.as_mut().poll(&mut Context::from_waker(Waker::noop())) {
        Poll::Ready(answered) => Box::pin(ready(answered)),
        Poll::Pending => answer,
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
