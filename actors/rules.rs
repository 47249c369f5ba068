//! The actor of the referee.

use crate::participant::{Answer, Mail, collect};
use hapticbillard::rules::Referee;
use kameo::prelude::*;

/// Owns the referee.
#[derive(Actor)]
pub struct Rules(pub Referee);

impl Message<Mail> for Rules {
    type Reply = Answer;

    async fn handle(&mut self, mail: Mail, _: &mut Context<Self, Answer>) -> Answer {
        let answer = collect(&mut self.0, &mail);
        for publication in &answer.outcome.publish {
            tracing::debug!(parent: &mail.1, "{:?}", publication.event);
        }
        answer
    }
}
