//! What all variants share: the events, the check of their order, the runtime.

use hapticbillard::events::{Event, Fact, FactKind, Source, Stamp, Stamped};
use hapticbillard::ids::BallId;
use hapticbillard::units::Tick;
use std::time::Duration;

pub const SUBSCRIBERS: usize = 7;
pub const PER_TICK: u64 = 16;

#[allow(dead_code)]
pub fn fact(number: u64) -> Fact {
    let ball = BallId((number % 16) as u16);
    Fact { time_s: number as f64 * 1e-4, kind: FactKind::HeadStringCrossed { ball } }
}

pub fn stamped(number: u64) -> Stamped {
    let tick = Tick(number / PER_TICK + 1);
    let stamp = Stamp { tick, source: Source::Physics, sequence: number };
    Stamped { stamp, event: Event::Fact(fact(number)) }
}

/// Counts what arrives and insists on its order.
#[derive(Default)]
pub struct Check {
    pub seen: u64,
    last: Option<Stamp>,
}

impl Check {
    pub fn take(&mut self, stamped: &Stamped) {
        assert!(self.last < Some(stamped.stamp), "out of order");
        self.last = Some(stamped.stamp);
        self.seen += 1;
    }
}

/// Runs `job` on a runtime as the game has it: one worker, and nothing on the caller's thread.
pub fn on_runtime<F>(job: F) -> Duration
where
    F: Future<Output = Duration> + Send + 'static,
{
    let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(1).build().unwrap();
    runtime.block_on(async { tokio::spawn(job).await.unwrap() })
}
