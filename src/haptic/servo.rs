//! The servo: one tick from reading to force.

use super::device::{DeviceState, Force};
use super::effect_force::Hand;
use super::mesh::HapticMesh;
use super::obstacles::{Obstacle, Obstacles, Round};
use super::proxy::{Met, Proxy};
use super::reach::{Placed, Workspace};
use super::report::{ContactEvent, ServoReport, StylusSample, Touched, WorkspacePose};
use super::safety::{Felt, Safety};
use super::scene::{BALLS_MAX, HapticScene, Reach};
use super::settings::ServoSettings;
use super::strike::{Impact, Lead, Way, impact};
use super::tip::{Piece, Tip};
use super::transient::Transient;
use super::world::World;
use crate::units::Seconds;
use glam::DVec3;
use std::sync::Arc;

/// What moves is never carried farther than this at a time [s]: a stall is not caught up with.
const DT_MAX_S: Seconds = 0.02;

/// A tip that is laid anew goes so many times as far as it can go in a tick: across the workspace.
const LAY_MAX: u32 = 12;
/// It has arrived when it goes no farther than this [m].
const LAID_M: f64 = 1e-6;

/// Everything that is rendered, between two ticks.
///
/// [`Servo::tick`] returns within microseconds, allocates nothing, takes no lock and never panics.
/// What is wrong with its input makes the force zero and is counted in the report.
#[derive(Debug, Clone)]
pub struct Servo {
    settings: ServoSettings,
    mesh: Option<Arc<HapticMesh>>,
    velocity: DVec3,
    world: World,
    workspace: Workspace,
    tip: Tip,
    proxy: Proxy,
    lead: Lead,
    /// How much of what is touched is felt.
    solid: f64,
    transient: Transient,
    safety: Safety,
    report: ServoReport,
}

impl Servo {
    /// A servo that has not begun, in a world without anything fixed.
    pub fn new(settings: ServoSettings) -> Self {
        Servo {
            settings,
            mesh: None,
            velocity: DVec3::ZERO,
            world: World::new(),
            workspace: Workspace::new(),
            tip: Tip::default(),
            proxy: Proxy::default(),
            lead: Lead::default(),
            solid: 1.0,
            transient: Transient::default(),
            safety: Safety::new(&settings),
            report: ServoReport { stiffness_factor: 1.0, ..ServoReport::default() },
        }
    }

    /// The same among faces and planes.
    pub fn among(self, mesh: Arc<HapticMesh>) -> Self {
        Servo { mesh: Some(mesh), ..self }
    }

    /// What the last tick did.
    pub fn report(&self) -> &ServoReport {
        &self.report
    }

    /// From now on no effect and no coupling is stiffer than `n_m` [N/m]. Whoever changes it while
    /// something is felt does so in small steps. What is no positive number changes nothing.
    pub fn limit_stiffness(&mut self, n_m: f64) {
        if n_m > 0.0 {
            self.settings.stiffness_max_n_m = n_m;
        }
    }

    /// One tick: the force on the device [N, device frame], from what it says, the newest scene
    /// and the true time since the last tick [s].
    pub fn tick(&mut self, device: &DeviceState, scene: &HapticScene, dt: Seconds) -> Force {
        let true_dt = dt;
        self.report.counters.ticks += 1;
        self.report.contact = None;
        if !(device.is_finite() && 0.0 < dt && dt.is_finite()) {
            return self.safety.refuse(&self.settings.safety, &mut self.report);
        }
        self.report.time_s += dt;
        let dt = dt.min(DT_MAX_S);

        let cut_off = std::f64::consts::TAU * self.settings.velocity_filter_hz;
        self.velocity += (device.velocity - self.velocity) * -libm::expm1(-cut_off * dt);
        self.world.go_on(scene, dt);
        let felt = match &scene.reach {
            Some(reach) if reach.is_sound() => self.touch(reach, device, dt),
            _ => self.let_go(),
        };

        self.report.sample.tick = self.report.counters.ticks;
        self.report.sample.dt = true_dt;
        self.report.sample.device = *device;
        self.report.sample.anchor = scene.anchor;
        self.report.stiffness_max_n_m = self.settings.stiffness_max_n_m;
        let hand = Hand {
            position: device.position,
            velocity: self.velocity,
            dt: true_dt,
            stiffness_max_n_m: self.settings.stiffness_max_n_m,
        };
        self.safety.pass(felt, &hand, device, scene, &self.settings, &mut self.report)
    }

    /// Nothing is reached.
    fn let_go(&mut self) -> Felt {
        self.workspace.leave();
        self.proxy.lift();
        self.tip = Tip::default();
        self.lead = Lead::default();
        self.report.depth_m = 0.0;
        self.report.workspace = None;
        self.report.sample.stabilised = false;
        Felt { contact: DVec3::ZERO, sharp: DVec3::ZERO }
    }

    /// Moves tip and proxy, and says what the world does to the hand.
    fn touch(&mut self, reach: &Reach, device: &DeviceState, dt: Seconds) -> Felt {
        let settings = self.settings;
        let place = self.proxy.centre();
        let placed = self.workspace.place(reach, device, place, &settings.reach, dt);
        if placed.is_new {
            self.lay(&placed, reach.tip_radius_m);
        }
        let lead = [self.lead, self.lead_after(reach, &placed, dt)];
        self.lead = lead[1];

        // The tip as physics gets it: kept out of what is fixed, and of nothing else.
        let piece = self.tip.follow(placed.target, settings.coupling.tracking_rad_s, dt);
        let mesh = self.mesh.as_deref();
        let fixed = Obstacles { mesh, balls: [None; BALLS_MAX] };
        let mut held = None;
        let (from, to, radius_m) = (piece.from, self.tip.at(), reach.tip_radius_m);
        let out = fixed.swept(from, to, radius_m, DVec3::Z, |touch| held = Some(touch.normal));
        if let Some(normal) = held {
            self.tip.held(out, normal);
        }

        // What the hand feels of a stroke, and of what it lies against.
        self.strike(reach, &placed, piece, lead, dt);
        let mesh = self.mesh.as_deref();
        let obstacles = Obstacles { mesh, balls: touched(&self.world, &placed) };
        let friction = settings.coupling.friction;
        let met = self.proxy.follow(placed.target, radius_m, friction, &obstacles);
        if met.is_new && reach.solid {
            self.meet(&met, &placed);
        }
        let pulled = placed.in_device(self.proxy.centre() - placed.target);
        let stiffness = settings.coupling.stiffness_n_m.min(settings.stiffness_max_n_m);
        let spring = stiffness * pulled;
        let damping = self.damping(pulled);
        let back = placed.direction * self.lead.offset_m;
        let recoil = settings.coupling.recoil * stiffness * placed.in_device(back);
        // What was not felt comes back slowly: the hand may be deep in something.
        let fade_s = settings.safety.fade_s.max(dt);
        self.solid = if reach.solid { (self.solid + dt / fade_s).min(1.0) } else { 0.0 };
        let touched = (spring + damping + recoil) * self.solid;

        self.tell(reach, &placed, pulled.length());
        Felt {
            contact: placed.force + touched,
            sharp: self.transient.force(dt, &settings.transient),
        }
    }

    /// Lays the tip anew: from the ball to where the device would have it, so that it is never
    /// under the table where the hand lies low.
    fn lay(&mut self, placed: &Placed, radius_m: f64) {
        let fixed = Obstacles { mesh: self.mesh.as_deref(), balls: [None; BALLS_MAX] };
        self.proxy.lay(placed.pivot);
        for _ in 0..LAY_MAX {
            let before = self.proxy.centre();
            self.proxy.follow(placed.target, radius_m, 0.0, &fixed);
            if before.distance(self.proxy.centre()) < LAID_M {
                break;
            }
        }
        self.tip.lay(self.proxy.centre());
        self.lead = Lead::default();
    }

    /// Bc acts on the speed into what is touched, never pulls.
    fn damping(&self, pulled: DVec3) -> DVec3 {
        let coupling = &self.settings.coupling;
        let out = pulled.normalize_or_zero();
        let into = self.velocity.dot(out).min(0.0);
        -out * (coupling.damping_ns_m * into)
    }

    fn lead_after(&self, reach: &Reach, placed: &Placed, dt: Seconds) -> Lead {
        match &reach.cue {
            Some(cue) if placed.stabilised => self.lead.after(dt, cue.coupling_rad_s),
            _ => Lead::default(),
        }
    }

    /// Solves the first impact of a stroke in this tick.
    fn strike(
        &mut self,
        reach: &Reach,
        placed: &Placed,
        piece: Piece,
        lead: [Lead; 2],
        dt: Seconds,
    ) {
        let Some(cue) = reach.cue.filter(|_| placed.stabilised) else { return };
        let direction = placed.direction;
        let way = Way { piece, direction, lead, dt, radius_m: reach.tip_radius_m };
        let first = self
            .world
            .balls()
            .filter(|(_, shown)| shown.ball.inverse_mass > 0.0)
            .filter_map(|(index, shown)| Some((index, impact(&way, shown, &cue)?)))
            .min_by(|(_, a), (_, b)| a.after_s.total_cmp(&b.after_s));
        let Some((index, hit)) = first else { return };
        let left_s = dt - hit.after_s;
        let tick = self.report.counters.ticks;
        let Impact { mover, normal, .. } = hit;
        let (velocity, spin) = (mover.velocity, mover.angular_velocity);
        self.world.struck(index, tick, left_s, hit.ball, velocity, spin);

        // From the impact on the cue goes at its own speed.
        let share = hit.after_s / dt;
        let at_hit = Lead {
            offset_m: lead[0].offset_m + (lead[1].offset_m - lead[0].offset_m) * share,
            rate_m_s: lead[0].rate_m_s
                + (lead[1].rate_m_s - lead[0].rate_m_s) * share
                + hit.change.dot(direction),
        };
        self.lead = at_hit.after(left_s, cue.coupling_rad_s);

        let push = placed.in_device(-normal * hit.speed_m_s);
        let speed_m_s = push.length();
        let settings = &self.settings.transient;
        self.transient.begin(push.normalize_or_zero(), speed_m_s, settings.ball_hz, settings);
        let id = self.world.ball(index).map(|shown| shown.ball.id).unwrap_or_default();
        self.note(Touched::Struck(id), left_s, hit.speed_m_s, hit.impulse);
    }

    /// The proxy begins to touch something.
    fn meet(&mut self, met: &Met, placed: &Placed) {
        let out = placed.in_device(met.normal).normalize_or_zero();
        let speed_m_s = (-self.velocity.dot(out)).max(0.0);
        let settings = &self.settings.transient;
        let (touched, frequency_hz) = match met.obstacle {
            Some(Obstacle::Ball(index)) => match self.world.ball(index) {
                Some(shown) => (Touched::Ball(shown.ball.id), settings.ball_hz),
                None => return,
            },
            _ => (Touched::Face, settings.face_hz),
        };
        self.transient.begin(out, speed_m_s, frequency_hz, settings);
        self.note(touched, 0.0, speed_m_s * placed.across, DVec3::ZERO);
    }

    fn note(&mut self, touched: Touched, before_end_s: Seconds, speed_m_s: f64, impulse: DVec3) {
        let tick = self.report.counters.ticks;
        self.report.counters.contacts += 1;
        self.report.contact =
            Some(ContactEvent { tick, before_end_s, touched, speed_m_s, impulse });
    }

    fn tell(&mut self, reach: &Reach, placed: &Placed, depth_m: f64) {
        let (azimuth_rad, elevation_rad) = self.workspace.angles();
        self.report.sample = StylusSample {
            tip: self.tip.at(),
            velocity: self.tip.velocity(),
            direction: placed.direction,
            stabilised: placed.stabilised,
            ..self.report.sample
        };
        self.report.target = placed.target;
        self.report.workspace = Some(WorkspacePose {
            origin: placed.origin,
            turn: placed.turn,
            scale: placed.across,
            pivot: placed.pivot,
            tip_radius_m: reach.tip_radius_m,
        });
        self.report.proxy = self.proxy.centre();
        self.report.depth_m = depth_m;
        (self.report.azimuth_rad, self.report.elevation_rad) = (azimuth_rad, elevation_rad);
    }
}

/// The balls that are in the way. During a stroke a ball that can move is struck instead.
fn touched(world: &World, placed: &Placed) -> [Option<Round>; BALLS_MAX] {
    let mut rounds = [None; BALLS_MAX];
    for (index, shown) in world.balls() {
        if !(placed.stabilised && shown.ball.inverse_mass > 0.0) {
            let (centre, radius_m) = (shown.centre, shown.ball.radius_m);
            rounds[index] = Some(Round { index, centre, radius_m });
        }
    }
    rounds
}
