//! A simulated Omni in a simulated hand that plays on a real table: device, servo, physics.

use glam::DVec3;
use hapticbillard::ball::{Ball, BallState};
use hapticbillard::cue::{Aim, CuePath};
use hapticbillard::events::{Command, Fact, FactKind, FactSet};
use hapticbillard::haptic::simulated::{Guide, HandModel, HandScript, Leg, SimulatedDevice};
use hapticbillard::haptic::{
    Buttons, ContactEvent, Device, DeviceSpec, HapticBall, HapticMesh, HapticScene, Reach, Servo,
    ServoReport, ServoSettings, StylusSample,
};
use hapticbillard::ids::BallId;
use hapticbillard::physics::{Parameters, PhysicsSettings, Simulation};
use hapticbillard::table::Table;
use std::sync::Arc;

pub const TICK_S: f64 = 0.001;
/// The cue is drawn back and waits.
pub const READY_TICKS: u64 = 1_100;

/// Where the stylus is pressed, how far it is drawn back, to where the stroke is steady, and where
/// it ends [m]: all within the workspace.
const PRESS_Z: f64 = 0.012;
const BACK_Z: f64 = 0.035;
const STEADY_Z: f64 = -0.010;
const END_Z: f64 = -0.035;

/// What all strokes share.
pub struct Room {
    pub table: Table,
    pub mesh: Arc<HapticMesh>,
    pub physics: Simulation,
}

impl Room {
    pub fn new() -> Self {
        let table = Table::preset("pool-9ft").unwrap();
        let settings = PhysicsSettings::default();
        let physics = Simulation::from_parts(&table, balls(&table), &settings).unwrap();
        Room { mesh: Arc::new(HapticMesh::of(&table)), table, physics }
    }
}

#[derive(Clone)]
pub struct Rig {
    pub device: SimulatedDevice,
    pub servo: Servo,
    pub physics: Simulation,
    pub scene: HapticScene,
    pub facts: Vec<Fact>,
    balls: Vec<Ball>,
    last: Option<StylusSample>,
    tick: u64,
}

/// The cue ball on its spot and an object ball far away.
pub fn balls(table: &Table) -> Vec<(Ball, BallState)> {
    let bed = table.bed.unwrap();
    let at = |x: f64, y: f64| DVec3::new(x, y, hapticbillard::ball::POOL_RADIUS_M);
    let spot = bed.head_spot();
    [(0, at(spot.x, spot.y)), (1, at(0.9, 0.3))]
        .map(|(id, place)| (Ball::pool(BallId(id)), BallState::at_rest(BallId(id), place)))
        .to_vec()
}

impl Rig {
    /// A hand of this kind with this script at the cue ball, the workspace laid along `aim`.
    pub fn new(room: &Room, script: HandScript, hand: HandModel, aim: &Aim) -> Self {
        let spec = DeviceSpec::OMNI;
        let settings = ServoSettings::of(&spec);
        let placed = balls(&room.table);
        let pivot = placed[0].1.position;
        let parameters = Parameters::pool();
        let reach = Reach::to_ball(1, pivot, aim, &settings.reach, &parameters);
        let mut rig = Rig {
            device: SimulatedDevice::new(spec, hand, Guide::Script(script)),
            servo: Servo::new(settings).among(room.mesh.clone()),
            physics: room.physics.clone(),
            scene: HapticScene { reach: Some(reach), ..HapticScene::default() },
            facts: Vec::new(),
            balls: placed.into_iter().map(|(ball, _)| ball).collect(),
            last: None,
            tick: 0,
        };
        rig.publish();
        rig
    }

    /// What the physics says becomes the servo's scene.
    fn publish(&mut self) {
        self.scene.serial += 1;
        self.scene.sample_seen = self.tick;
        self.scene.time_s = self.physics.now_s();
        self.scene.ball_count = 0;
        for ball in &self.balls {
            let state = self.physics.sample(ball.id, self.physics.now_s()).unwrap();
            assert!(self.scene.add(HapticBall::of(ball, &state)));
        }
    }

    /// A tick: the servo's sample goes to the physics, the physics' balls go to the servo.
    pub fn tick(&mut self) -> ServoReport {
        let state = self.device.read(if self.tick == 0 { 0.0 } else { TICK_S });
        let force = self.servo.tick(&state, &self.scene, TICK_S);
        self.device.write(force);
        let report = *self.servo.report();
        let start_s = self.tick as f64 * TICK_S;
        self.tick += 1;
        let sample = report.sample;
        if let Some(before) = self.last.replace(sample) {
            let piece = sample.piece(&before, start_s, 5.0 * TICK_S);
            // While the stabiliser holds the cue strikes; before and after it is led past balls.
            let path = CuePath {
                solid: sample.stabilised && before.stabilised,
                pieces: std::iter::once(piece).collect(),
            };
            self.physics.apply(start_s, &Command::MoveCue(Arc::new(path))).unwrap();
        }
        let end_s = start_s + TICK_S;
        let mut now_s = self.physics.now_s();
        while now_s < end_s {
            now_s = self.physics.advance(end_s, FactSet::default(), &mut self.facts).unwrap();
        }
        self.publish();
        report
    }

    pub fn ball(&self) -> BallState {
        self.physics.sample(BallId::CUE, self.physics.now_s()).unwrap()
    }
}

/// A hand that waits, presses the front button, draws back, strikes at `speed_m_s` and stops.
/// `phase_s` shifts the stroke against the ticks.
pub fn stroke(speed_m_s: f64, phase_s: f64) -> HandScript {
    let at = |z: f64| DVec3::new(0.0, 0.0, z);
    let hold = |leg: Leg| leg.holding(Buttons::FRONT);
    // From rest to the speed over a part of the way, then steadily through the ball.
    let steady_z = 0.6 * BACK_Z + 0.4 * PRESS_Z;
    let rise_s = 2.0 * (BACK_Z - steady_z) / speed_m_s;
    let through_s = (steady_z - STEADY_Z) / speed_m_s;
    let fall_s = 2.0 * (STEADY_Z - END_Z) / speed_m_s;
    let ahead = DVec3::NEG_Z * speed_m_s;
    HandScript::practised(
        at(PRESS_Z),
        vec![
            Leg::to(at(PRESS_Z), 0.6),
            hold(Leg::to(at(PRESS_Z), 0.02)),
            hold(Leg::to(at(BACK_Z), 0.25)),
            hold(Leg::to(at(BACK_Z), 0.3 + phase_s)),
            hold(Leg::through(at(steady_z), ahead, rise_s)),
            hold(Leg::through(at(STEADY_Z), ahead, through_s)),
            hold(Leg::to(at(END_Z), fall_s)),
            hold(Leg::to(at(END_Z), 0.1)),
        ],
    )
}

/// What a stroke showed.
#[derive(Debug, Clone)]
pub struct Felt {
    pub contact: ContactEvent,
    /// From the contact in the physics to the end of the tick that felt it [s].
    pub late_s: f64,
    /// Before the safety chain, within 30 ms of the contact.
    pub peak_wanted_n: f64,
    pub peak_sent_n: f64,
    /// Of the sent force along the stroke, within 30 ms of the contact [N s].
    pub impulse_ns: f64,
    /// Of the cue ball two ticks after the stroke [m/s].
    pub ball: DVec3,
    /// Closing speed that the physics saw [m/s].
    pub struck_m_s: f64,
    /// How often the physics saw the tip meet the ball.
    pub strikes: usize,
}

/// Everything before the stroke, which is the same for all of them: the cue is drawn back.
pub fn drawn_back(room: &Room, hand: HandModel, aim: &Aim) -> Rig {
    let mut rig = Rig::new(room, stroke(1.0, 0.0), hand, aim);
    for _ in 0..READY_TICKS {
        rig.tick();
    }
    assert!(rig.servo.report().sample.stabilised);
    rig
}

/// Goes on with `script`, and says what was felt of the first contact with a ball.
pub fn play(ready: &Rig, script: HandScript) -> Felt {
    let ticks = (script.duration_s() / TICK_S) as u64 - READY_TICKS;
    let mut rig = ready.clone();
    *rig.device.guide_mut() = Guide::Script(script);
    let (mut contact, mut after) = (None, 0_u64);
    let (mut peak_wanted_n, mut peak_sent_n, mut impulse_ns) = (0.0_f64, 0.0_f64, 0.0);
    let mut ball = DVec3::ZERO;
    for _ in 0..ticks {
        let report = rig.tick();
        if let (None, Some(event)) = (contact, report.contact) {
            contact = Some(event);
        }
        if contact.is_some() && after < 30 {
            peak_wanted_n = peak_wanted_n.max(report.wanted.0.length());
            impulse_ns += report.force.0.z * TICK_S;
            if after == 2 {
                ball = rig.ball().velocity;
            }
            after += 1;
        }
        peak_sent_n = peak_sent_n.max(report.force.0.length());
    }
    let struck = |fact: &&Fact| matches!(fact.kind, FactKind::CueBallStruck { .. });
    let first = rig.facts.iter().find(struck).expect("the physics saw no stroke");
    let contact = contact.expect("the hand felt no stroke");
    let struck_m_s = match first.kind {
        FactKind::CueBallStruck { normal_speed_m_s, .. } => normal_speed_m_s,
        _ => 0.0,
    };
    let late_s = contact.tick as f64 * TICK_S - first.time_s;
    let strikes = rig.facts.iter().filter(struck).count();
    Felt { contact, late_s, peak_wanted_n, peak_sent_n, impulse_ns, ball, struck_m_s, strikes }
}
