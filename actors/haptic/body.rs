//! The body of the servo's loop: one reading, one tick, one force. It needs no thread and no clock,
//! and never allocates, locks, logs or waits.

use super::ports::{Orders, ServoPorts, TickTold};
use hapticbillard::haptic::{
    Anchors, ButtonEdge, Buttons, Device, DeviceState, Force, HapticScene, Servo, ServoReport,
    StylusSample,
};
use hapticbillard::units::Seconds;

/// How fast the greatest stiffness changes: a wall under the hand must not become a step [1/s].
const SOFTEN_PER_S: f64 = 10.0;

/// A device, its servo and their ports. Whatever ends it leaves the device without force.
pub struct Body {
    device: Box<dyn Device>,
    servo: Servo,
    scene: HapticScene,
    ports: ServoPorts,
    anchors: Anchors,
    stiffness_n_m: f64,
    stiffness_wanted_n_m: f64,
    /// None before the first reading: what is down then was pressed for somebody else.
    held: Option<Buttons>,
    /// Of the newest balls.
    serial: u64,
    /// Of this turn [ns].
    late_ns: u64,
}

impl Body {
    /// Joins them.
    pub fn new(device: Box<dyn Device>, mut servo: Servo, mut ports: ServoPorts) -> Self {
        let stiffness_max_n_m = ports.orders.read().stiffness_max_n_m;
        servo.limit_stiffness(stiffness_max_n_m);
        Body {
            device,
            servo,
            scene: HapticScene::default(),
            ports,
            anchors: Anchors::default(),
            stiffness_n_m: stiffness_max_n_m,
            stiffness_wanted_n_m: stiffness_max_n_m,
            held: None,
            serial: 0,
            late_ns: 0,
        }
    }

    /// The period of the device [s].
    pub fn period_s(&self) -> Seconds {
        self.device.spec().period_s()
    }

    /// The ports.
    pub fn ports(&self) -> &ServoPorts {
        &self.ports
    }

    /// Takes the force away.
    pub fn let_go(&mut self) {
        self.device.write(Force::ZERO);
    }

    /// The next turn begins `late_ns` after its deadline; whoever keeps no deadlines says nothing.
    pub fn begin_late(&mut self, late_ns: u64) {
        self.late_ns = late_ns;
    }

    /// One turn of the loop, `dt` after the last one [s].
    pub fn turn(&mut self, dt: Seconds) -> &ServoReport {
        self.hear(dt);
        let state = self.device.read(dt);
        // Where no window opens a wheel, the rear button holds nothing.
        let seen = match self.ports.buttons {
            Some(_) => state,
            None => DeviceState { buttons: state.buttons.without(Buttons::REAR), ..state },
        };
        self.anchors.step(&seen, self.ports.signs.leads());
        let Orders { effects, reach, .. } = self.ports.orders.output_buffer();
        self.anchors.apply(effects, *reach, &mut self.scene);
        let force = self.servo.tick(&state, &self.scene, dt);
        self.device.write(force);
        let report = *self.servo.report();
        self.tell_buttons(state.buttons, report.counters.ticks);
        self.tell_sample(report.sample);
        self.ports.report.write(report);
        self.tell_watchers(report);
        self.servo.report()
    }

    /// Takes what is new from outside.
    fn hear(&mut self, dt: Seconds) {
        if self.ports.orders.update() {
            self.stiffness_wanted_n_m = self.ports.orders.output_buffer().stiffness_max_n_m;
        }
        if self.ports.balls.update() {
            let balls = self.ports.balls.output_buffer();
            self.scene.balls = balls.balls;
            self.scene.ball_count = balls.count;
            self.scene.time_s = balls.time_s;
            self.scene.sample_seen = balls.sample_seen;
            self.serial = balls.serial;
        }
        self.scene.serial = self.serial + self.ports.signs.heartbeat();
        self.scene.live = self.ports.signs.is_held();
        if self.stiffness_n_m != self.stiffness_wanted_n_m {
            let step = SOFTEN_PER_S * dt * self.stiffness_n_m.max(self.stiffness_wanted_n_m);
            self.stiffness_n_m +=
                (self.stiffness_wanted_n_m - self.stiffness_n_m).clamp(-step, step);
            self.servo.limit_stiffness(self.stiffness_n_m);
        }
    }

    fn tell_buttons(&mut self, buttons: Buttons, tick: u64) {
        let Some(held) = self.held.replace(buttons) else { return };
        let (pressed, released) = buttons.edges(held);
        for bit in 0..u8::BITS {
            let button = Buttons(1 << bit);
            for (edges, down) in [(pressed, true), (released, false)] {
                let edge = ButtonEdge { tick, button, down };
                if let Some(told) = self.ports.buttons.as_mut().filter(|_| edges.has(button))
                    && told.push(edge).is_err()
                {
                    self.ports.timing.lose_button();
                }
            }
        }
    }

    fn tell_watchers(&mut self, report: ServoReport) {
        if let Some(picture) = &mut self.ports.picture {
            picture.write(report);
        }
        let told = TickTold { report, late_ns: self.late_ns };
        if let Some(telemetry) = &mut self.ports.telemetry
            && telemetry.push(told).is_err()
        {
            self.ports.timing.lose_row();
        }
    }

    fn tell_sample(&mut self, sample: StylusSample) {
        // Where nobody strikes with the stylus the other end is gone, and nothing is lost.
        if !self.ports.samples.is_abandoned() && self.ports.samples.push(sample).is_err() {
            self.ports.timing.lose_sample();
        }
    }
}

impl Drop for Body {
    fn drop(&mut self) {
        self.let_go();
    }
}
