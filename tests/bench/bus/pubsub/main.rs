//! Kameo's own PubSub with the events of the event manager. Prints how long it took [s].
//!
//! `bus-bench` builds and runs it.

#[path = "../common.rs"]
mod common;

use common::{Check, SUBSCRIBERS, on_runtime, stamped};
use hapticbillard::events::Stamped;
use kameo::prelude::*;
use kameo_actors::DeliveryStrategy;
use kameo_actors::pubsub::{PubSub, Publish, Subscribe};
use std::time::{Duration, Instant};

#[derive(Actor)]
struct Hearer(Check);

impl Message<Stamped> for Hearer {
    type Reply = ();

    async fn handle(&mut self, stamped: Stamped, _: &mut Context<Self, ()>) {
        self.0.take(&stamped);
    }
}

struct Seen;

impl Message<Seen> for Hearer {
    type Reply = u64;

    async fn handle(&mut self, _: Seen, _: &mut Context<Self, u64>) -> u64 {
        self.0.seen
    }
}

fn pubsub(events: u64) -> Duration {
    on_runtime(async move {
        let pubsub = PubSub::<Stamped>::spawn(PubSub::new(DeliveryStrategy::Guaranteed));
        let hearers: Vec<_> =
            (0..SUBSCRIBERS).map(|_| Hearer::spawn(Hearer(Check::default()))).collect();
        for hearer in &hearers {
            pubsub.ask(Subscribe(hearer.clone())).await.unwrap();
        }
        let start = Instant::now();
        for number in 0..events {
            pubsub.tell(Publish(stamped(number))).await.unwrap();
        }
        pubsub.stop_gracefully().await.unwrap();
        pubsub.wait_for_shutdown().await;
        for hearer in hearers {
            assert_eq!(hearer.ask(Seen).await.unwrap(), events);
        }
        start.elapsed()
    })
}

fn main() {
    let events = std::env::args().nth(1).and_then(|text| text.parse().ok());
    let Some(events) = events else {
        eprintln!("usage: pubsub-bench EVENTS");
        std::process::exit(2)
    };
    println!("{}", pubsub(events).as_secs_f64());
}
