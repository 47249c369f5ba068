//! The servo's place in the runtime: thread and device stay here while controls come and go, since
//! a vendor's library cannot be loaded twice. Whoever controls holds the dead man's switch; a
//! control that is gone, for whatever reason, has let go of it.

use super::body::Body;
use super::ports::{ControlPorts, Signs, StylusPorts, Watch, WorldPort};
use super::rights::{Asked, Core, Obtained, Refusal};
use super::thread::{NoServo, ServoThread};
use super::timing::Timing;
use super::turns::{Called, Explain, Turns};
use super::{AllPorts, Opened, Orders};
use crate::event_manager::Sink;
use glam::DVec3;
use hapticbillard::ball::Ball;
use hapticbillard::cue::Aim;
use hapticbillard::events::{Topic, Topics};
use hapticbillard::haptic::{
    DeviceSpec, EffectSet, HapticMesh, Reach, ReachSettings, Servo, ServoSettings, stiffness_for,
};
use hapticbillard::physics::Parameters;
use hapticbillard::tick::Delivered;
use hapticbillard::units::Seconds;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// What a servo is made of.
pub struct Plan {
    /// The device, and the way into its hand.
    pub opened: Opened,
    /// What is asked of the operating system.
    pub asked: Asked,
    /// What is fixed and can be felt.
    pub mesh: Option<Arc<HapticMesh>>,
    /// Forces that belong to no body.
    pub effects: EffectSet,
    /// How the device reaches into the world.
    pub reach: Option<Reach>,
    /// How the workspace is laid anew when another shot begins; none: it stays where it is.
    pub lay: Option<Lay>,
    /// The balls that there can be.
    pub bodies: Vec<Ball>,
}

impl Plan {
    /// A device that is heard and never pushed: nothing of the operating system is asked for.
    pub fn idle(opened: Opened) -> Self {
        let asked = Asked { core: Core::Any, priority: None, lock_memory: false, spin_us: 0 };
        let (mesh, reach, lay, bodies) = (None, None, None, Vec::new());
        Plan { opened, asked, mesh, effects: EffectSet::default(), reach, lay, bodies }
    }
}

/// How a workspace is laid to the cue ball.
#[derive(Debug, Clone)]
pub struct Lay {
    /// The workspace.
    pub settings: ReachSettings,
    /// The cue.
    pub parameters: Parameters,
}

impl Lay {
    /// The workspace in front of a cue ball at `pivot` [m], seen along `aim`.
    pub fn to(&self, serial: u32, pivot: DVec3, aim: &Aim) -> Reach {
        Reach::to_ball(serial, pivot, aim, &self.settings, &self.parameters)
    }
}

/// Mail that waits for a control at most; it only says where the cue ball lies. What does not fit
/// is counted as dropped.
const MAIL: usize = 64;

/// A servo that runs, and the ends that belong to others.
pub struct Started {
    /// Its place.
    pub seat: Arc<Seat>,
    /// For physics.
    pub world: WorldPort,
    /// For whoever strikes with the stylus; where nobody does it is dropped.
    pub stylus: StylusPorts,
}

/// Thread, device and the control's ports.
pub struct Seat {
    turns: Box<dyn Turns>,
    timing: Arc<Timing>,
    signs: Arc<Signs>,
    explains: Option<Arc<dyn Explain>>,
    spec: DeviceSpec,
    lay: Option<Lay>,
    mail: (flume::Sender<Delivered>, flume::Receiver<Delivered>),
    dropped: Arc<AtomicU64>,
    /// With what was ordered last: another control goes on with it.
    control: Mutex<Option<(ControlPorts, Orders)>>,
}

impl Seat {
    /// Starts a servo. Nothing is felt until a control takes hold of it.
    ///
    /// # Errors
    /// [`NoServo`] if there is no thread, or the device's own scheduler does not start.
    pub fn start(plan: Plan) -> Result<Started, NoServo> {
        Seat::start_watched(plan, Watch::default())
    }

    /// The same while somebody looks on.
    ///
    /// # Errors
    /// [`NoServo`] if there is no thread, or the device's own scheduler does not start.
    pub fn start_watched(plan: Plan, watch: Watch) -> Result<Started, NoServo> {
        let Plan { opened, asked, mesh, effects, reach, lay, bodies } = plan;
        let Opened { device, scheduler, explains, .. } = opened;
        let spec = device.spec();
        let servo = Servo::new(ServoSettings::of(&spec));
        let servo = match mesh {
            Some(mesh) => servo.among(mesh),
            None => servo,
        };
        let orders = Orders { effects, reach, stiffness_max_n_m: stiffness_for(&spec, 0.0) };
        let AllPorts { servo: ports, control, stylus, world, .. } =
            AllPorts::watched(orders, bodies, watch);
        let (timing, signs) = (ports.timing.clone(), ports.signs.clone());
        let body = Body::new(device, servo, ports);
        let turns: Box<dyn Turns> = match scheduler {
            Some(scheduler) => scheduler.start(Called::new(body))?,
            None => Box::new(ServoThread::start(body, asked)?),
        };
        let (mail, control) = (flume::bounded(MAIL), Mutex::new(Some((control, orders))));
        let seat = Seat {
            turns,
            timing,
            signs,
            explains,
            spec,
            lay,
            mail,
            dropped: Arc::default(),
            control,
        };
        Ok(Started { seat: Arc::new(seat), world, stylus })
    }

    /// What its thread got.
    pub fn obtained(&self) -> &Obtained {
        self.turns.obtained()
    }

    /// How punctual it is.
    pub fn timing(&self) -> &Timing {
        &self.timing
    }

    /// Its signs of life.
    pub fn signs(&self) -> &Arc<Signs> {
        &self.signs
    }

    /// What the operating system and the device refused.
    pub fn refusals(&self) -> impl Iterator<Item = &Refusal> {
        self.obtained().refusals().chain(self.device_refusal())
    }

    /// What the device refused.
    pub fn device_refusal(&self) -> Option<&Refusal> {
        self.turns.refusal()
    }

    /// Whether it turns.
    pub fn is_running(&self) -> bool {
        self.turns.is_running()
    }

    /// Why its device is not ready, and what to do; none if nothing is wrong.
    pub fn why(&self) -> Option<String> {
        let device = self.explains.as_ref().and_then(|explains| explains.why());
        device.or_else(|| self.turns.why())
    }

    /// How much later its device's forces act than its specification says [s].
    pub fn device_late_s(&self) -> Seconds {
        self.explains.as_ref().map_or(0.0, |explains| explains.late_s())
    }

    /// The device.
    pub fn spec(&self) -> &DeviceSpec {
        &self.spec
    }

    /// How its workspace is laid anew.
    pub fn lay(&self) -> Option<&Lay> {
        self.lay.as_ref()
    }

    /// What its control wants to be told, and where to.
    pub fn sink(&self) -> Sink {
        let topics = Topics::of(&[Topic::Turn, Topic::Settled, Topic::BallPlaced]);
        let (mail, dropped) = (self.mail.0.clone(), self.dropped.clone());
        Sink { name: super::HAPTIC, topics, mail, dropped }
    }

    /// Mail that found its queue full.
    pub fn dropped(&self) -> u64 {
        self.dropped.load(Ordering::Relaxed)
    }

    /// What the control was told.
    pub fn mail(&self) -> impl Iterator<Item = Delivered> {
        self.mail.1.try_iter()
    }

    /// Takes hold of the servo. None while somebody else does.
    pub fn hold(self: &Arc<Self>) -> Option<Held> {
        let (ports, orders) = self.slot().take()?;
        self.signs().hold(true);
        Some(Held { ports: Some(ports), orders, seat: self.clone() })
    }

    fn slot(&self) -> std::sync::MutexGuard<'_, Option<(ControlPorts, Orders)>> {
        // Nothing is done under the lock that could leave it half done.
        self.control.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Hold of a servo. Dropping it lets go: from the servo's next tick on nothing is felt.
pub struct Held {
    seat: Arc<Seat>,
    orders: Orders,
    /// None only while this is dropped.
    ports: Option<ControlPorts>,
}

impl Held {
    /// The servo.
    pub fn seat(&self) -> &Arc<Seat> {
        &self.seat
    }

    /// What is to be felt.
    pub fn orders(&self) -> &Orders {
        &self.orders
    }

    /// From now on something else is to be felt.
    pub fn order(&mut self, orders: Orders) {
        self.orders = orders;
        if let Some(ports) = &mut self.ports {
            ports.orders.write(orders);
        }
    }

    /// The servo's last tick.
    pub fn report(&mut self) -> hapticbillard::haptic::ServoReport {
        self.ports.as_mut().map(|ports| *ports.report.read()).unwrap_or_default()
    }
}

impl Drop for Held {
    fn drop(&mut self) {
        self.seat.signs().hold(false);
        *self.seat.slot() = self.ports.take().map(|ports| (ports, self.orders));
    }
}
