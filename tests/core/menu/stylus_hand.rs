//! A simulated hand at a simulated Omni, with its servo: what it says to a window and to a game.

use glam::{DQuat, DVec2, DVec3};
use hapticbillard::ball::{Ball, BallPlace};
use hapticbillard::cue::{Aim, CuePath};
use hapticbillard::haptic::simulated::{Guide, HandModel, HandScript, Leg, SimulatedDevice};
use hapticbillard::haptic::{
    Anchor, Anchors, ButtonEdge, Buttons, Device, DeviceSpec, EffectSet, HapticBall, HapticMesh,
    HapticScene, Leads, Reach, ReachSettings, Servo, ServoReport, ServoSettings, StylusSample,
};
use hapticbillard::ids::BallId;
use hapticbillard::input::{CameraHand, StylusMouse, StylusSays, StylusWord};
use hapticbillard::physics::{Parameters, Snapshot};
use hapticbillard::table::Table;
use hapticbillard::units::TICK_S;
use std::sync::Arc;

/// How often a window looks, in ticks of the servo.
const LOOK_TICKS: u64 = 16;
/// Where the cue ball is in the device (paper, section 3.3.3) [m].
pub const BALL: DVec3 = DVec3::new(0.0, 0.0, -0.014);

/// The hand, and what it holds.
pub struct Hand {
    device: SimulatedDevice,
    servo: Servo,
    anchors: Anchors,
    scene: HapticScene,
    reach: Option<Reach>,
    balls: Vec<Ball>,
    mouse: StylusMouse,
    window: DVec2,
    edges: Vec<ButtonEdge>,
    held: Buttons,
    last: Option<StylusSample>,
    /// What the hand intends at the end of its script.
    at: DVec3,
    tick: u64,
}

impl Hand {
    /// In the middle of the workspace.
    pub fn new(table: &Table, window: DVec2) -> Self {
        let guide = Guide::Script(HandScript::practised(DVec3::ZERO, Vec::new()));
        let spec = DeviceSpec::OMNI;
        let servo = Servo::new(ServoSettings::of(&spec)).among(Arc::new(HapticMesh::of(table)));
        Hand {
            device: SimulatedDevice::new(spec, HandModel::ARM, guide),
            servo,
            anchors: Anchors::default(),
            scene: HapticScene::default(),
            reach: None,
            balls: (0..16).map(|id| Ball::pool(BallId(id))).collect(),
            mouse: StylusMouse::default(),
            window,
            edges: Vec::new(),
            held: Buttons::default(),
            last: None,
            at: DVec3::ZERO,
            tick: 0,
        }
    }

    /// From now on the hand does this, from where it is.
    pub fn follow(&mut self, legs: impl IntoIterator<Item = Leg>) {
        let stays = Leg::to(self.at, self.device.time_s()).holding(self.held);
        let legs: Vec<Leg> = std::iter::once(stays).chain(legs).collect();
        let script = HandScript::practised(self.at, legs.clone());
        self.at = legs.last().map_or(self.at, |leg| leg.to);
        *self.device.guide_mut() = Guide::Script(script);
    }

    /// How many ticks it is from now until a script of this length is over.
    pub fn ticks(seconds: f64) -> u64 {
        (seconds / TICK_S).ceil() as u64
    }

    /// The place of the hand that points here in the window [pixels].
    pub fn pointing_at(&self, pixel: DVec2) -> DVec3 {
        let workspace = DeviceSpec::OMNI.workspace_m.truncate();
        let from_middle = (pixel - 0.5 * self.window) / self.window * workspace;
        DVec3::new(from_middle.x, -from_middle.y, 0.0)
    }

    /// Where it points [pixels].
    pub fn place(&self) -> DVec2 {
        self.mouse.place().unwrap_or(0.5 * self.window)
    }

    /// Where the handle really is [m].
    pub fn position(&self) -> DVec3 {
        self.device.position()
    }

    /// The servo's last tick.
    pub fn report(&self) -> &ServoReport {
        self.servo.report()
    }

    /// A shot begins: the workspace is laid to the cue ball, and keeps its direction.
    pub fn lay(&mut self, table: &Snapshot) {
        let Some(ball) = table.ball(BallId::CUE) else { return };
        let serial = self.reach.map_or(0, |reach| reach.serial) + 1;
        let report = self.servo.report();
        let aim = Aim {
            azimuth_rad: report.azimuth_rad,
            elevation_rad: report.elevation_rad.max(0.06),
            ..Aim::default()
        };
        let settings = ReachSettings::default();
        let reach = Reach::to_ball(serial, ball.position, &aim, &settings, &Parameters::pool());
        self.reach = Some(reach);
    }

    /// One tick without a world: what it says to the window, if that looks.
    pub fn rest(&mut self) -> Vec<StylusSays> {
        self.turn(Leads::Pointer, None);
        self.look()
    }

    /// One tick in a game: what it says to that at `start_s`, and to the window.
    pub fn play(
        &mut self,
        leads: Leads,
        table: &Snapshot,
        start_s: f64,
    ) -> (StylusWord, Vec<StylusSays>) {
        let sample = self.turn(leads, Some(table)).sample;
        let before = self.last.replace(sample);
        let path = before.map(|before| {
            let solid = sample.stabilised && before.stabilised;
            let pieces = std::iter::once(sample.piece(&before, start_s, 5.0 * TICK_S)).collect();
            Arc::new(CuePath { solid, pieces })
        });
        let camera = match sample.anchor {
            Some(Anchor::Camera(from)) => Some(CameraHand::of(&sample.device, from)),
            _ => None,
        };
        let (direction, armed) = (sample.direction, sample.stabilised);
        (StylusWord::Held { direction, armed, path, camera }, self.look())
    }

    fn turn(&mut self, leads: Leads, table: Option<&Snapshot>) -> ServoReport {
        self.tick += 1;
        let state = self.device.read(TICK_S);
        self.anchors.step(&state, leads);
        self.anchors.apply(&EffectSet::default(), self.reach, &mut self.scene);
        self.scene.serial += 1;
        self.scene.ball_count = 0;
        if let Some(table) = table {
            self.scene.time_s = table.time_s;
            self.scene.sample_seen = self.tick;
            let is_felt = |id: BallId| {
                table.ball(id).filter(|ball| ball.place == BallPlace::OnTable).copied()
            };
            for ball in &self.balls {
                if let Some(state) = is_felt(ball.id) {
                    self.scene.add(HapticBall::of(ball, &state));
                }
            }
        }
        let force = self.servo.tick(&state, &self.scene, TICK_S);
        self.device.write(force);
        let (pressed, released) = state.buttons.edges(self.held);
        for button in [Buttons::FRONT, Buttons::REAR] {
            for (edges, down) in [(pressed, true), (released, false)] {
                if edges.has(button) {
                    self.edges.push(ButtonEdge { tick: self.tick, button, down });
                }
            }
        }
        self.held = state.buttons;
        *self.servo.report()
    }

    fn look(&mut self) -> Vec<StylusSays> {
        if !self.tick.is_multiple_of(LOOK_TICKS) {
            return Vec::new();
        }
        let state = self.servo.report().sample.device;
        let edges = std::mem::take(&mut self.edges);
        self.mouse.hear(&state, edges, self.window, DeviceSpec::OMNI.workspace_m)
    }
}

/// A stroke at this speed of the hand [m/s], turned to the left about the cue ball [rad].
pub fn stroke(speed_m_s: f64, left_rad: f64) -> Vec<Leg> {
    let turned = DQuat::from_rotation_y(left_rad);
    let at = |z: f64| BALL + turned * (DVec3::new(0.0, 0.0, z) - BALL);
    let ahead = turned * DVec3::NEG_Z * speed_m_s;
    // As `HandScript::stroke`, but turned.
    let (press, back, end) = (0.012, 0.035, -0.035);
    let (steady_from, steady_to) = (0.026, -0.010);
    let rise_s = 2.0 * (back - steady_from) / speed_m_s;
    let through_s = (steady_from - steady_to) / speed_m_s;
    let fall_s = 2.0 * (steady_to - end) / speed_m_s;
    let free = [Leg::to(at(back), 0.3), Leg::to(at(press), 0.5)];
    let held = [
        Leg::to(at(press), 0.05),
        Leg::to(at(back), 0.3),
        Leg::to(at(back), 0.2),
        Leg::through(at(steady_from), ahead, rise_s),
        Leg::through(at(steady_to), ahead, through_s),
        Leg::to(at(end), fall_s),
        Leg::to(at(end), 0.05),
    ];
    let held = held.map(|leg| leg.holding(Buttons::FRONT));
    let after = [Leg::to(at(end), 0.05), Leg::to(at(back), 0.4), Leg::to(DVec3::ZERO, 0.3)];
    let legs = free.into_iter().chain(held).chain(after).map(|leg| leg.turned(turned));
    legs.collect()
}
