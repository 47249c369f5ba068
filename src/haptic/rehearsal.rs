//! A rehearsal: device, servo and physics, tick by tick, without anything else of a game. What a
//! hand does goes through the servo to the physics, and what balls do comes back.

use super::device::{Device, DeviceSpec};
use super::mesh::HapticMesh;
use super::report::{ServoReport, StylusSample};
use super::scene::{HapticBall, HapticScene, Reach};
use super::servo::Servo;
use super::settings::ServoSettings;
use super::simulated::{Guide, HandModel, HandScript, SimulatedDevice};
use crate::ball::{Ball, BallState};
use crate::cue::{Aim, CuePath};
use crate::events::{Command, Fact, FactSet};
use crate::ids::BallId;
use crate::physics::{Parameters, PhysicsError, PhysicsSettings, Simulation};
use crate::table::Table;
use crate::units::{Seconds, TICK_S};
use std::sync::Arc;

/// How long a piece of the cue's path holds [s]; the next tick's replaces it.
const PIECE_S: Seconds = 5.0 * TICK_S;

/// A hand at a table.
#[derive(Debug, Clone)]
pub struct Rehearsal<D = SimulatedDevice> {
    /// The device, such as one in a simulated hand.
    pub device: D,
    /// What renders.
    pub servo: Servo,
    /// What the servo is told.
    pub scene: HapticScene,
    /// What happened at the table.
    pub facts: Vec<Fact>,
    physics: Simulation,
    balls: Vec<Ball>,
    last: Option<StylusSample>,
    tick: u64,
}

impl Rehearsal {
    /// A hand with a script at a device like `spec`, in front of the cue ball of `balls`, the
    /// workspace laid along `aim`.
    pub fn new(
        table: &Table,
        balls: Vec<(Ball, BallState)>,
        spec: DeviceSpec,
        hand: HandModel,
        script: HandScript,
        aim: &Aim,
    ) -> Result<Self, PhysicsError> {
        let device = SimulatedDevice::new(spec, hand, Guide::Script(script));
        Rehearsal::with(table, balls, device, aim)
    }
}

impl<D: Device> Rehearsal<D> {
    /// Any device in front of the cue ball of `balls`, the workspace laid along `aim`.
    ///
    /// # Errors
    /// [`PhysicsError`] if there is no cue ball, or if balls and table do not fit.
    pub fn with(
        table: &Table,
        balls: Vec<(Ball, BallState)>,
        device: D,
        aim: &Aim,
    ) -> Result<Self, PhysicsError> {
        let settings = ServoSettings::of(&device.spec());
        let parameters = Parameters::of(&PhysicsSettings::default());
        let cue_ball = balls.iter().find(|(ball, _)| ball.id == BallId::CUE);
        let (_, state) = cue_ball.ok_or(PhysicsError::UnknownBall(BallId::CUE))?;
        let reach = Reach::to_ball(1, state.position, aim, &settings.reach, &parameters);
        let physics = Simulation::from_parts(table, balls.clone(), &PhysicsSettings::default())?;
        let mesh = Arc::new(HapticMesh::of(table));
        let mut rehearsal = Rehearsal {
            device,
            servo: Servo::new(settings).among(mesh),
            scene: HapticScene { reach: Some(reach), ..HapticScene::default() },
            facts: Vec::new(),
            physics,
            balls: balls.into_iter().map(|(ball, _)| ball).collect(),
            last: None,
            tick: 0,
        };
        rehearsal.publish();
        Ok(rehearsal)
    }

    /// Time reached [s].
    pub fn now_s(&self) -> Seconds {
        self.tick as f64 * TICK_S
    }

    /// A ball as the physics has it.
    pub fn ball(&self, id: BallId) -> Option<BallState> {
        self.physics.sample(id, self.physics.now_s())
    }

    /// One tick: a reading, the force made of it, and what the physics makes of the sample.
    pub fn tick(&mut self) -> Result<ServoReport, PhysicsError> {
        let state = self.device.read(if self.tick == 0 { 0.0 } else { TICK_S });
        let force = self.servo.tick(&state, &self.scene, TICK_S);
        self.device.write(force);
        let report = *self.servo.report();
        let start_s = self.now_s();
        self.tick += 1;
        if let Some(before) = self.last.replace(report.sample) {
            let piece = report.sample.piece(&before, start_s, PIECE_S);
            // While the stabiliser holds the cue strikes; before and after it is led past balls.
            let solid = report.sample.stabilised && before.stabilised;
            let path = CuePath { solid, pieces: std::iter::once(piece).collect() };
            self.physics.apply(start_s, &Command::MoveCue(Arc::new(path)))?;
        }
        while self.physics.now_s() < self.now_s() {
            self.physics.advance(self.now_s(), FactSet::default(), &mut self.facts)?;
        }
        self.publish();
        Ok(report)
    }

    /// What the physics says becomes the servo's scene.
    fn publish(&mut self) {
        self.scene.serial += 1;
        self.scene.sample_seen = self.tick;
        self.scene.time_s = self.physics.now_s();
        self.scene.ball_count = 0;
        for ball in &self.balls {
            if let Some(state) = self.physics.sample(ball.id, self.scene.time_s) {
                // Balls beyond those that can be felt are not.
                let _ = self.scene.add(HapticBall::of(ball, &state));
            }
        }
    }
}
