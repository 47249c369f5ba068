//! OpenHaptics through the real backend, in front of a stub library with scripted faults: what is
//! read, what the player is told, and that no force is left.

mod opening;
mod program;
mod running;

use crate::servo::{Heart, PUSH_N, control, tokio, wait_for};
use crate::stub_hd::StubHd;
use glam::DVec3;
use hapticbillard::events::Health;
use hapticbillard::haptic::{Effect, EffectSet, ServoReport};
use hapticbillard_actors::haptic::openhaptics::open;
use hapticbillard_actors::haptic::{Asked, Haptic, Look, Opened, Plan, Seat, Started};
use kameo::prelude::*;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Less than this is felt as a push, whatever a busy machine's lateness leaves of the stiffness.
const FELT_N: f64 = 0.1 * PUSH_N;

fn plan(opened: Opened) -> Plan {
    Plan {
        opened,
        asked: Asked::default(),
        mesh: None,
        effects: EffectSet::of(1, &[Effect::Constant { force: DVec3::X * PUSH_N }]),
        reach: None,
        lay: None,
        bodies: Vec::new(),
    }
}

/// A servo at the stub, its world alive, its control at work.
struct Game {
    stub: StubHd,
    seat: Arc<Seat>,
    control: ActorRef<Haptic>,
    runtime: tokio::runtime::Runtime,
    heart: Heart,
}

impl Game {
    fn start(test: &str, script: &str) -> Self {
        let stub = StubHd::new(test, script);
        let opened = open(Some(stub.path()), None).unwrap();
        Game::with(stub, opened)
    }

    fn with(stub: StubHd, opened: Opened) -> Self {
        let Started { seat, .. } = Seat::start(plan(opened)).unwrap();
        let heart = Heart::of(seat.signs());
        let runtime = tokio();
        let control = control(&runtime, &seat);
        Game { stub, seat, control, runtime, heart }
    }

    fn report(&self) -> ServoReport {
        self.runtime.block_on(self.control.ask(Look).send()).unwrap().report
    }

    /// Waits until the player is told this. A busy machine may have other news meanwhile.
    #[track_caller]
    fn wait_for_news(&self, expected: &str) {
        let mut told = Vec::new();
        let start = Instant::now();
        while !told.iter().any(|told: &String| told.contains(expected)) {
            assert!(start.elapsed() < Duration::from_secs(60), "'{expected}' not in {told:?}");
            let looked = self.runtime.block_on(self.control.ask(Look).send()).unwrap();
            told.extend(looked.news.into_iter().filter_map(|health| match health {
                Health::ActorFailed { reason, .. } => Some(reason),
                _ => None,
            }));
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    #[track_caller]
    fn wait_for_push(&self) {
        wait_for("a push", || self.stub.force_n() > FELT_N && self.stub.pushes());
    }

    #[track_caller]
    fn wait_for_nothing(&self) {
        wait_for("no force", || self.stub.force_n() == 0.0);
    }

    #[track_caller]
    fn wait_for_well(&self) {
        wait_for("the news that it is well", || {
            let looked = self.runtime.block_on(self.control.ask(Look).send()).unwrap();
            looked.news.iter().any(|health| matches!(health, Health::ActorRestarted { .. }))
        });
    }

    /// Ends it all; what was called since the beginning.
    fn end(self) -> Vec<String> {
        let Game { stub, seat, control, runtime, heart } = self;
        runtime.block_on(async {
            let _ = control.stop_gracefully().await;
            control.wait_for_shutdown().await;
        });
        drop((runtime, seat, heart));
        assert_eq!(stub.force_n(), 0.0, "{:?}", stub.log());
        assert!(!stub.pushes());
        let log = stub.log();
        let wrong = ["second frame", "no frame", "outside"];
        assert!(!log.iter().any(|line| wrong.iter().any(|wrong| line.contains(wrong))), "{log:?}");
        log
    }
}
