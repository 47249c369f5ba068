//! What goes into the servo's thread and what comes out, wait-free on both sides.
//!
//! | | carries | when nobody takes it |
//! |---|---|---|
//! | [`Orders`] in | effects, reach, greatest stiffness | the newest counts |
//! | [`Balls`] in | balls in play, a heartbeat of the world | the newest counts |
//! | [`Signs`] in | the heartbeat in pause, the dead man's switch | – |
//! | [`Signs`] to the control | how far the mouse has turned the workspace | sums count |
//! | report out | everything about the last tick | the newest counts |
//! | samples out | the stylus at every tick, for who strikes | the oldest stay, loss is counted |
//! | edges out | presses and releases, in order | the same; a sample tells what is held |
//! | picture out | the same as the report, for a window | the newest counts |
//! | telemetry out | everything about every tick | the oldest stay, loss is counted |

use super::timing::Timing;
use glam::DVec2;
use hapticbillard::ball::Ball;
use hapticbillard::haptic::{
    BALLS_MAX, ButtonEdge, EffectSet, HapticBall, Leads, Reach, ServoReport, StylusSample,
};
use hapticbillard::physics::Snapshot;
use hapticbillard::units::Seconds;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU8, AtomicU64, Ordering};

/// By their code; the first is the usual one.
const LEADS: [Leads; 3] = [Leads::Cue, Leads::Camera, Leads::Pointer];

/// Samples that wait at most: a quarter of a second.
const SAMPLES: usize = 256;
/// Button edges that wait at most: a second of one in every tick.
const EDGES: usize = 1024;

/// What is to be felt besides the balls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Orders {
    /// Forces that belong to no body.
    pub effects: EffectSet,
    /// How the device reaches into the world.
    pub reach: Option<Reach>,
    /// Nothing is stiffer than this [N/m].
    pub stiffness_max_n_m: f64,
}

/// The balls in play at one time.
#[derive(Debug, Clone, Copy)]
pub struct Balls {
    /// Counts up with every state of the world.
    pub serial: u64,
    /// The time [s].
    pub time_s: Seconds,
    /// The last sample that physics had taken in.
    pub sample_seen: u64,
    /// Only the first `count` count.
    pub balls: [HapticBall; BALLS_MAX],
    /// How many there are.
    pub count: usize,
}

impl Default for Balls {
    fn default() -> Self {
        Balls {
            serial: 0,
            time_s: 0.0,
            sample_seen: 0,
            balls: [HapticBall::NONE; BALLS_MAX],
            count: 0,
        }
    }
}

/// Two signs of life that the servo looks at in every tick.
#[derive(Debug, Default)]
pub struct Signs {
    heartbeat: AtomicU64,
    held: AtomicBool,
    seen: AtomicU64,
    /// To the left and upwards since the start [rad], as bits.
    turned: [AtomicU64; 2],
    leads: AtomicU8,
}

impl Signs {
    /// The world stands still on purpose: whoever paused it says so, again and again. A servo that
    /// gets neither this nor new balls for 20 ms fades out.
    pub fn beat(&self) {
        self.heartbeat.fetch_add(1, Ordering::Release);
    }

    /// How often it beat.
    pub fn heartbeat(&self) -> u64 {
        self.heartbeat.load(Ordering::Acquire)
    }

    /// The dead man's switch: nothing is felt while nobody holds it.
    pub fn hold(&self, held: bool) {
        self.held.store(held, Ordering::Release);
    }

    /// Whether somebody holds it.
    pub fn is_held(&self) -> bool {
        self.held.load(Ordering::Acquire)
    }

    /// The workspace is to be turned to the left and raised [rad]. Only one thread says so.
    pub fn turn(&self, by: DVec2) {
        for (turned, by) in self.turned.iter().zip([by.x, by.y]) {
            let sum = f64::from_bits(turned.load(Ordering::Relaxed)) + by;
            turned.store(sum.to_bits(), Ordering::Relaxed);
        }
    }

    /// How far that was since the start [rad].
    pub fn turned(&self) -> DVec2 {
        let [left, up] = [0, 1].map(|i| f64::from_bits(self.turned[i].load(Ordering::Relaxed)));
        DVec2::new(left, up)
    }

    /// What the stylus is for from now on.
    pub fn lead(&self, leads: Leads) {
        let code = LEADS.iter().position(|one| *one == leads).unwrap_or_default();
        self.leads.store(code as u8, Ordering::Relaxed);
    }

    /// What it is for.
    pub fn leads(&self) -> Leads {
        let code = usize::from(self.leads.load(Ordering::Relaxed));
        LEADS.get(code).copied().unwrap_or_default()
    }

    /// Physics has taken in the samples up to this one.
    pub fn see(&self, sample: u64) {
        self.seen.store(sample, Ordering::Release);
    }

    /// The last sample that physics has taken in.
    pub fn seen(&self) -> u64 {
        self.seen.load(Ordering::Acquire)
    }
}

/// A tick as telemetry has it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TickTold {
    /// Everything about it.
    pub report: ServoReport,
    /// From its deadline to its begin [ns]; 0 if somebody else keeps the time.
    pub late_ns: u64,
}

/// The servo's ends of what only looks on. What is not there costs nothing.
#[derive(Default)]
pub struct Watch {
    /// The newest tick, for a picture.
    pub picture: Option<triple_buffer::Input<ServoReport>>,
    /// Every press and release, for a window.
    pub buttons: Option<rtrb::Producer<ButtonEdge>>,
    /// Every tick, for a file.
    pub telemetry: Option<rtrb::Producer<TickTold>>,
    /// Where punctuality is counted.
    pub timing: Arc<Timing>,
}

impl Watch {
    /// The same where somebody hears of every press and release; and that end.
    pub fn with_buttons(mut self) -> (Self, rtrb::Consumer<ButtonEdge>) {
        let (told, heard) = rtrb::RingBuffer::new(EDGES);
        self.buttons = Some(told);
        (self, heard)
    }
}

/// The servo's end.
pub struct ServoPorts {
    pub(super) orders: triple_buffer::Output<Orders>,
    pub(super) balls: triple_buffer::Output<Balls>,
    pub(super) signs: Arc<Signs>,
    pub(super) report: triple_buffer::Input<ServoReport>,
    pub(super) samples: rtrb::Producer<StylusSample>,
    pub(super) buttons: Option<rtrb::Producer<ButtonEdge>>,
    pub(super) picture: Option<triple_buffer::Input<ServoReport>>,
    pub(super) telemetry: Option<rtrb::Producer<TickTold>>,
    pub(super) timing: Arc<Timing>,
}

/// The end of whoever controls it.
pub struct ControlPorts {
    /// What is to be felt.
    pub orders: triple_buffer::Input<Orders>,
    /// The last tick.
    pub report: triple_buffer::Output<ServoReport>,
    /// How punctual it is.
    pub timing: Arc<Timing>,
}

/// The end of whoever strikes with it.
pub struct StylusPorts {
    /// Every sample, while they are taken.
    pub samples: rtrb::Consumer<StylusSample>,
    /// Where it says what physics has seen, and what the stylus is for.
    pub signs: Arc<Signs>,
}

/// The end of whoever moves balls.
pub struct WorldPort {
    serial: u64,
    bodies: Vec<Ball>,
    balls: triple_buffer::Input<Balls>,
    signs: Arc<Signs>,
}

impl WorldPort {
    /// The balls are now as `table` says. Those beyond [`BALLS_MAX`] are not felt.
    pub fn show(&mut self, table: &Snapshot) {
        let slot = self.balls.input_buffer_mut();
        self.serial += 1;
        slot.serial = self.serial;
        (slot.time_s, slot.sample_seen, slot.count) = (table.time_s, self.signs.seen(), 0);
        for state in table.on_table() {
            let Ok(index) = self.bodies.binary_search_by_key(&state.id, |ball| ball.id) else {
                continue;
            };
            if slot.count < BALLS_MAX {
                slot.balls[slot.count] = HapticBall::of(&self.bodies[index], state);
                slot.count += 1;
            }
        }
        self.balls.publish();
    }
}

/// All ends.
pub struct AllPorts {
    /// The servo's.
    pub servo: ServoPorts,
    /// The control's.
    pub control: ControlPorts,
    /// The stylus'.
    pub stylus: StylusPorts,
    /// The world's.
    pub world: WorldPort,
    /// For whoever lets hearts beat.
    pub signs: Arc<Signs>,
}

impl AllPorts {
    /// Slots and rings between a servo and a world with these balls.
    pub fn new(orders: Orders, bodies: Vec<Ball>) -> Self {
        AllPorts::watched(orders, bodies, Watch::default())
    }

    /// The same while somebody looks on.
    pub fn watched(orders: Orders, mut bodies: Vec<Ball>, watch: Watch) -> Self {
        let Watch { picture, buttons, telemetry, timing } = watch;
        bodies.sort_by_key(|ball| ball.id);
        let (orders_in, orders_out) = triple_buffer::triple_buffer(&orders);
        let (balls_in, balls_out) = triple_buffer::triple_buffer(&Balls::default());
        let (report_in, report_out) = triple_buffer::triple_buffer(&ServoReport::default());
        let (samples_in, samples_out) = rtrb::RingBuffer::new(SAMPLES);
        let signs = Arc::new(Signs::default());
        AllPorts {
            servo: ServoPorts {
                orders: orders_out,
                balls: balls_out,
                signs: signs.clone(),
                report: report_in,
                samples: samples_in,
                buttons,
                picture,
                telemetry,
                timing: timing.clone(),
            },
            control: ControlPorts { orders: orders_in, report: report_out, timing },
            stylus: StylusPorts { samples: samples_out, signs: signs.clone() },
            world: WorldPort { serial: 0, bodies, balls: balls_in, signs: signs.clone() },
            signs,
        }
    }
}
