//! The actor of somebody who only watches from inside the tick: a tally, an event log, a progress
//! bar. It loses nothing, and it publishes nothing.

use crate::participant::{Answer, Mail, collect};
use hapticbillard::tick::Participant;
use kameo::prelude::*;

/// Owns one observer.
#[derive(Actor)]
pub struct Observer(pub Box<dyn Participant>);

impl Message<Mail> for Observer {
    type Reply = Answer;

    async fn handle(&mut self, mail: Mail, _: &mut Context<Self, Answer>) -> Answer {
        collect(&mut *self.0, &mail)
    }
}
