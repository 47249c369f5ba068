//! Actors that are replaced when they die, while their cores live on: hands and computer players.
//!
//! The core is not in the actor; the actor borrows it for a message. When the actor is gone another
//! one takes its place at once, because the tick waits for its answer, and is given the same
//! message. A core that a panic left half done goes back to where it was before, see [`Saved`].
//! The game is the same, bit by bit. Who dies over the same message twice stays dead, and so does
//! who dies too often: then the game stops in order.

use crate::news::News;
use hapticbillard::events::Health;
use kameo::prelude::*;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// How often an actor is replaced in a game.
const REPLACED_MAX: u32 = 32;

/// A core that actors borrow.
pub struct Shared<C: ?Sized>(Arc<Mutex<C>>);

impl<C: ?Sized> Clone for Shared<C> {
    fn clone(&self) -> Self {
        Shared(self.0.clone())
    }
}

impl<C> Shared<C> {
    /// Nobody has borrowed it yet.
    pub fn new(core: C) -> Self {
        Shared(Arc::new(Mutex::new(core)))
    }

    /// Borrows it. Whoever had it before may have died over it.
    pub fn borrow(&self) -> MutexGuard<'_, C> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A core that knows how it was before its last work, if that did not end.
#[derive(Debug, Clone)]
pub struct Saved<C> {
    now: C,
    before: Option<C>,
}

impl<C: Clone> Saved<C> {
    /// A core between two works.
    pub fn new(core: C) -> Self {
        Saved { now: core, before: None }
    }

    /// The core as it is.
    pub fn get(&self) -> &C {
        self.before.as_ref().unwrap_or(&self.now)
    }

    /// Works on it. If that panics the core is as it was before.
    pub fn work<R>(&mut self, work: impl FnOnce(&mut C) -> R) -> R {
        if let Some(before) = self.before.take() {
            self.now = before;
        }
        self.before = Some(self.now.clone());
        let result = work(&mut self.now);
        self.before = None;
        result
    }
}

/// The place of an actor.
pub struct Kept<A: Actor> {
    name: String,
    place: Mutex<Place<A>>,
    spawn: Box<dyn Fn() -> ActorRef<A> + Send + Sync>,
    news: News,
}

struct Place<A: Actor> {
    actor: ActorRef<A>,
    left: u32,
}

impl<A: Actor> Kept<A> {
    /// Spawns the first one; `name` is what the player is told.
    pub fn new(
        name: impl Into<String>,
        spawn: impl Fn() -> ActorRef<A> + Send + Sync + 'static,
        news: impl Into<News>,
    ) -> Self {
        let place = Mutex::new(Place { actor: spawn(), left: REPLACED_MAX });
        Kept { name: name.into(), place, spawn: Box::new(spawn), news: news.into() }
    }

    fn place(&self) -> MutexGuard<'_, Place<A>> {
        // Nothing is done under the lock that could leave it half done.
        self.place.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The one that is there.
    pub fn actor(&self) -> ActorRef<A> {
        self.place().actor.clone()
    }

    /// Another one in the place of `gone`, and tells the player why; none if it was replaced too
    /// often.
    pub fn instead_of(&self, gone: &ActorRef<A>, reason: &str) -> Option<ActorRef<A>> {
        let mut place = self.place();
        if place.actor.id() != gone.id() {
            return Some(place.actor.clone());
        }
        place.left = place.left.checked_sub(1)?;
        // What looks dead does not come back.
        gone.kill();
        place.actor = (self.spawn)();
        tracing::warn!("{}: {reason}; another one takes its place", self.name);
        let failed = Health::ActorFailed { actor: self.name.clone(), reason: reason.to_string() };
        for health in [failed, Health::ActorRestarted { actor: self.name.clone() }] {
            self.news.tell(health);
        }
        Some(place.actor.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::panic::{AssertUnwindSafe, catch_unwind};

    #[test]
    fn what_a_panic_left_half_done_is_undone() {
        let core = Shared::new(Saved::new(vec![1]));
        let died = catch_unwind(AssertUnwindSafe(|| {
            core.borrow().work(|list| {
                list.push(2);
                panic!("the work is made to fail here");
            })
        }));
        assert!(died.is_err());
        assert_eq!(core.borrow().get(), &[1]);
        core.borrow().work(|list| list.push(3));
        assert_eq!(core.borrow().get(), &[1, 3]);
    }
}
