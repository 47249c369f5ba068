//! The actor of a computer player.

use crate::participant::{Answer, Mail, collect};
use hapticbillard::ai::Player;
use kameo::prelude::*;

/// Owns one computer player.
#[derive(Actor)]
pub struct Ai(pub Player);

impl Message<Mail> for Ai {
    type Reply = Answer;

    async fn handle(&mut self, mail: Mail, _: &mut Context<Self, Answer>) -> Answer {
        collect(&mut self.0, &mail)
    }
}
