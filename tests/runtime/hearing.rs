//! Somebody who hears events of one topic and keeps them.

use hapticbillard::events::{Event, Source, Topic, Topics};
use hapticbillard::hash::StateHash;
use hapticbillard::physics::Snapshot;
use hapticbillard::tick::{Delivered, Outcome, Participant};
use std::sync::{Arc, Mutex};

/// The listener; clones share what was heard.
#[derive(Clone)]
pub struct Hears {
    topic: Topic,
    heard: Arc<Mutex<Vec<Event>>>,
}

impl Hears {
    /// Nothing was heard yet.
    pub fn of(topic: Topic) -> Self {
        Hears { topic, heard: Arc::default() }
    }

    /// What was heard so far, in order, as far as `wanted` takes it.
    pub fn heard<T>(&self, wanted: impl Fn(&Event) -> Option<T>) -> Vec<T> {
        self.heard.lock().unwrap().iter().filter_map(wanted).collect()
    }
}

impl Participant for Hears {
    fn source(&self) -> Source {
        Source::Runtime
    }

    fn topics(&self) -> Topics {
        Topics::of(&[self.topic])
    }

    fn start(&mut self, _: &Snapshot) -> Outcome {
        Outcome::default()
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        let events = delivered.events.iter().map(|stamped| stamped.event.clone());
        self.heard.lock().unwrap().extend(events);
        Outcome::default()
    }

    fn hash(&self, _: &mut StateHash) {}
}
