//! A desk: a game in lockstep with a script at mouse and keyboard.

use hapticbillard::cast::Cast;
use hapticbillard::events::{Event, Topics};
use hapticbillard::hash::StateHash;
use hapticbillard::input::{Human, HumanView, RawInput};
use hapticbillard::lockstep::{Lockstep, Setup};
use hapticbillard::physics::Snapshot;
use hapticbillard::replay::Line;
use hapticbillard::scene::Scene;
use hapticbillard::tick::{
    Delivered, Finished, Frame, FrameSource, Inflow, Outcome, Pace, Participant,
};
use hapticbillard::events::Source;
use hapticbillard::units::Tick;
use std::sync::{Arc, Mutex};

/// What both sides of the desk share.
struct Shared {
    human: Human,
    /// Reports for the next tick.
    reports: Vec<RawInput>,
    frames: Vec<(Tick, Frame)>,
    inflows: Vec<Inflow>,
    heard: Vec<(Tick, Event)>,
}

struct Hand(Arc<Mutex<Shared>>);

impl FrameSource for Hand {
    fn inflow(&mut self, tick: Tick) -> Inflow {
        let mut shared = self.0.lock().unwrap();
        let reports = std::mem::take(&mut shared.reports);
        let inflow = shared.human.inflow(tick, &reports);
        if !inflow.frame.is_empty() {
            shared.frames.push((tick, inflow.frame.clone()));
        }
        shared.inflows.push(inflow.clone());
        inflow
    }
}

impl Participant for Hand {
    fn source(&self) -> Source {
        Source::Input
    }

    fn topics(&self) -> Topics {
        Topics::ALL
    }

    fn start(&mut self, table: &Snapshot) -> Outcome {
        self.0.lock().unwrap().human.start(table)
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        let mut shared = self.0.lock().unwrap();
        let heard = delivered.events.iter().map(|stamped| (delivered.tick, stamped.event.clone()));
        shared.heard.extend(heard);
        shared.human.collect(delivered)
    }

    fn hash(&self, _: &mut StateHash) {}
}

/// A game with a person.
pub struct Desk {
    game: Lockstep<'static>,
    shared: Arc<Mutex<Shared>>,
    pub finished: Option<Finished>,
}

impl Desk {
    pub fn new(scene: &Scene) -> Self {
        Desk::with_pace(scene, Pace::EveryTick)
    }

    pub fn with_pace(scene: &Scene, pace: Pace) -> Self {
        let table = Arc::new(scene.build_table(&mut |_| unreachable!()).unwrap());
        let mut cast = Cast::new(scene, table).unwrap();
        let human = cast.human.take().unwrap();
        let shared = Arc::new(Mutex::new(Shared {
            human,
            reports: Vec::new(),
            frames: Vec::new(),
            inflows: Vec::new(),
            heard: Vec::new(),
        }));
        let mut setup = Setup::headless(Tick(3_600_000));
        setup.pace = pace;
        setup.input = Some(Box::new(Hand(shared.clone())));
        setup.observers.push(Box::new(Hand(shared.clone())));
        Desk { game: Lockstep::new(cast, setup).unwrap(), shared, finished: None }
    }
}
