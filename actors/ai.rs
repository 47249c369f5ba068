//! The actor of a computer player.

mod thinking;
pub use thinking::ThinkAhead;

use crate::kept::{Saved, Shared};
use crate::participant::{Answer, Mail, collect};
use hapticbillard::ai::Player;
use kameo::prelude::*;

/// Plays for one computer player, who outlives it.
#[derive(Actor)]
pub struct Ai(pub Shared<Saved<Player>>);

impl Message<Mail> for Ai {
    type Reply = Answer;

    async fn handle(&mut self, mail: Mail, _: &mut Context<Self, Answer>) -> Answer {
        let answer = self.0.borrow().work(|player| collect(player, &mail));
        for publication in &answer.outcome.publish {
            tracing::debug!(parent: &mail.1, "{:?}", publication.event);
        }
        answer
    }
}
