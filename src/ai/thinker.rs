//! How a player gets its thinking done: at once, or by somebody else while the game goes on.

use super::mind::{Deliberation, Inline, Mind, Task};
use std::sync::Arc;

/// Takes questions.
pub trait Thinker: Send + Sync {
    /// Begins to think; the answer is asked for later.
    fn begin(&self, mind: &Arc<Mind>, task: Task) -> Box<dyn Thinking>;
}

/// A question that is being thought about. Who drops it does not want to know any more.
pub trait Thinking: Send {
    /// The answer; waits for it.
    fn finish(self: Box<Self>) -> Deliberation;
}

/// Thinks when the answer is asked for, in the thread that asks.
#[derive(Debug, Clone, Copy, Default)]
pub struct ThinkInline;

struct Postponed {
    mind: Arc<Mind>,
    task: Task,
}

impl Thinker for ThinkInline {
    fn begin(&self, mind: &Arc<Mind>, task: Task) -> Box<dyn Thinking> {
        Box::new(Postponed { mind: mind.clone(), task })
    }
}

impl Thinking for Postponed {
    fn finish(self: Box<Self>) -> Deliberation {
        self.mind.deliberate(&self.task, &Inline)
    }
}
