//! The place of sound in the runtime: the line to the device and the ways in stay here while
//! controls come and go.

use super::backend::NoSound;
use super::knobs::Knobs;
use super::line::{Line, News, Open, Wiring};
use crate::event_manager::Sink;
use hapticbillard::physics::Snapshot;
use hapticbillard::sound::{Foley, Listener};
use hapticbillard::tick::Delivered;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Mail that waits for a control at most; what does not fit is counted as dropped.
const MAIL: usize = 4096;

/// What sound is made of.
pub struct Plan {
    /// The line to the device.
    pub wiring: Wiring,
    /// What makes sounds of facts.
    pub foley: Foley,
    /// The world before the first tick.
    pub first: Arc<Snapshot>,
    /// Seconds of the game per second.
    pub pace: f64,
    /// Volume and mute.
    pub knobs: Arc<Knobs>,
}

/// Sound that waits for its control, and the ends that belong to others.
pub struct Started {
    /// Its place.
    pub seat: Arc<Seat>,
    /// For physics.
    pub world: triple_buffer::Input<Arc<Snapshot>>,
    /// For whoever looks on.
    pub listener: triple_buffer::Input<Listener>,
}

/// What a control works with.
pub struct Ports {
    /// What became of the device.
    pub news: flume::Receiver<News>,
    /// The stream, while there is one.
    pub open: Option<Open>,
    /// Why there is none, once that was said.
    pub lost: Option<String>,
    /// The newest state of the world.
    pub world: triple_buffer::Output<Arc<Snapshot>>,
    /// Where it is heard from.
    pub listener: triple_buffer::Output<Listener>,
    /// What happened.
    pub mail: flume::Receiver<Delivered>,
}

/// The place.
pub struct Seat {
    line: Mutex<Option<Line>>,
    ports: Mutex<Option<Ports>>,
    mail: flume::Sender<Delivered>,
    dropped: Arc<AtomicU64>,
    foley: Foley,
    pace: f64,
    knobs: Arc<Knobs>,
}

impl Seat {
    /// Starts the line. Nothing is heard until a control takes hold of it.
    ///
    /// # Errors
    /// [`NoSound`] if there is no thread. A device that is missing is no error: it may come.
    pub fn start(plan: Plan) -> Result<Started, NoSound> {
        let Plan { wiring, foley, first, pace, knobs } = plan;
        let (line, news) = Line::start(wiring)?;
        let (world_in, world) = triple_buffer::triple_buffer(&first);
        let (listener_in, listener) = triple_buffer::triple_buffer(&Listener::default());
        let (mail_in, mail) = flume::bounded(MAIL);
        let ports = Ports { news, open: None, lost: None, world, listener, mail };
        let seat = Seat {
            line: Mutex::new(Some(line)),
            ports: Mutex::new(Some(ports)),
            mail: mail_in,
            dropped: Arc::default(),
            foley,
            pace,
            knobs,
        };
        Ok(Started { seat: Arc::new(seat), world: world_in, listener: listener_in })
    }

    /// What its control wants to be told, and where to.
    pub fn sink(&self) -> Sink {
        let (mail, dropped) = (self.mail.clone(), self.dropped.clone());
        Sink { name: super::SOUND, topics: Foley::TOPICS, mail, dropped }
    }

    /// Mail that found its queue full.
    pub fn dropped(&self) -> u64 {
        self.dropped.load(Ordering::Relaxed)
    }

    /// What makes sounds of facts, before the first fact.
    pub fn foley(&self) -> Foley {
        self.foley.clone()
    }

    /// Seconds of the game per second.
    pub fn pace(&self) -> f64 {
        self.pace
    }

    /// Volume and mute.
    pub fn knobs(&self) -> &Arc<Knobs> {
        &self.knobs
    }

    /// Takes hold of it. None while somebody else does.
    pub fn hold(self: &Arc<Self>) -> Option<Held> {
        let ports = self.slot().take()?;
        Some(Held { ports: Some(ports), seat: self.clone() })
    }

    /// Ends the line; returns when the device is closed.
    pub async fn end(&self) {
        let line = self.line.lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Some(line) = line {
            line.end().await;
        }
    }

    fn slot(&self) -> MutexGuard<'_, Option<Ports>> {
        // Nothing is done under the lock that could leave it half done.
        self.ports.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Hold of it; dropping it lets go.
pub struct Held {
    seat: Arc<Seat>,
    /// None only while this is dropped.
    ports: Option<Ports>,
}

impl Held {
    /// The place.
    pub fn seat(&self) -> &Arc<Seat> {
        &self.seat
    }

    /// What is worked with.
    pub fn ports(&mut self) -> Option<&mut Ports> {
        self.ports.as_mut()
    }
}

impl Drop for Held {
    fn drop(&mut self) {
        *self.seat.slot() = self.ports.take();
    }
}
