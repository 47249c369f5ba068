//! Every failure through the shipped tick with the shipped chain.

use glam::DVec3;
use hapticbillard::haptic::{
    DeviceSpec, DeviceState, DeviceStatus, Effect, EffectSet, HapticBall, HapticScene, Reach,
    SafetyFlags, Servo, ServoReport, ServoSettings,
};
use hapticbillard::{cue::Aim, physics::Parameters};

/// A hand that rests 2 mm in a wall of 500 N/m: 1 N.
struct Contact {
    servo: Servo,
    device: DeviceState,
    scene: HapticScene,
}

impl Contact {
    fn new() -> Self {
        let wall = Effect::Plane {
            normal: DVec3::NEG_X,
            offset_m: 0.0,
            stiffness_n_m: 500.0,
            damping_ns_m: 0.0,
        };
        let mut contact = Contact {
            servo: Servo::new(ServoSettings::of(&DeviceSpec::OMNI)),
            device: DeviceState::default(),
            scene: HapticScene { effects: EffectSet::of(1, &[wall]), ..HapticScene::default() },
        };
        contact.device.position.x = -0.001;
        contact.ticks(700);
        contact.device.position.x = 0.002;
        contact.ticks(10);
        assert!((contact.newton() - 1.0).abs() < 1e-9, "{}", contact.newton());
        contact
    }

    fn tick(&mut self) -> ServoReport {
        self.scene.serial += 1;
        self.silent_tick(0.001)
    }

    /// Without news of the world.
    fn silent_tick(&mut self, dt: f64) -> ServoReport {
        self.servo.tick(&self.device, &self.scene, dt);
        *self.servo.report()
    }

    fn ticks(&mut self, n: u32) {
        for _ in 0..n {
            self.tick();
        }
    }

    fn silence(&mut self, n: u32) {
        for _ in 0..n {
            self.silent_tick(0.001);
        }
    }

    fn newton(&self) -> f64 {
        self.servo.report().force.0.length()
    }

    /// Zero now; out of the wall and in again it is back after its ramp, and not before.
    #[track_caller]
    fn is_off_and_comes_back(&mut self) {
        assert_eq!(self.newton(), 0.0);
        // Still in the wall: it must not come back under the hand.
        self.ticks(1_000);
        assert_eq!(self.newton(), 0.0);
        self.device.position.x = -0.001;
        self.ticks(100);
        self.device.position.x = 0.002;
        self.ticks(2);
        assert!(self.newton() < 0.3, "{}", self.newton());
        self.ticks(600);
        assert!((self.newton() - 1.0).abs() < 1e-6, "{}", self.newton());
    }
}

#[test]
fn a_device_that_says_no_numbers_is_let_go_at_once() {
    for bad in [f64::NAN, f64::INFINITY] {
        let mut contact = Contact::new();
        let good = contact.device;
        contact.device.position.y = bad;
        assert!(contact.tick().flags.has(SafetyFlags::NOT_FINITE));
        assert_eq!(contact.servo.report().counters.not_finite, 1);
        contact.device = good;
        contact.tick();
        contact.is_off_and_comes_back();
    }
    let mut contact = Contact::new();
    for dt in [f64::NAN, 0.0, -1.0, f64::INFINITY] {
        contact.silent_tick(dt);
        assert_eq!(contact.newton(), 0.0);
    }
}

#[test]
fn a_world_that_says_no_numbers_gives_no_force() {
    let mut contact = Contact::new();
    contact.scene.effects.slots[5] = Some(Effect::Constant { force: DVec3::X * f64::NAN });
    assert!(contact.tick().flags.has(SafetyFlags::NOT_FINITE));
    assert!(contact.newton() < 1e-12);
    // A ball that is nowhere is not felt.
    let mut contact = Contact::new();
    let parameters = Parameters::pool();
    let settings = ServoSettings::of(&DeviceSpec::OMNI).reach;
    let aim = Aim::default();
    contact.scene.reach = Some(Reach::to_ball(1, DVec3::ZERO, &aim, &settings, &parameters));
    contact.scene.add(HapticBall {
        position: DVec3::splat(f64::NAN),
        radius_m: 1.0,
        ..HapticBall::NONE
    });
    contact.ticks(100);
    assert!((contact.newton() - 1.0).abs() < 1e-6);
    // Nor is a workspace that lies nowhere, and neither leaves a trace.
    let sound = contact.scene.reach.unwrap();
    for wrong in [
        Reach { pivot: DVec3::X * f64::NAN, ..sound },
        Reach { scale: 0.0, ..sound },
        Reach { azimuth_rad: f64::INFINITY, ..sound },
    ] {
        contact.scene.reach = Some(Reach { serial: sound.serial + 1, ..wrong });
        contact.ticks(10);
        assert!((contact.newton() - 1.0).abs() < 1e-6);
        contact.scene.reach = Some(sound);
        contact.ticks(10);
        assert!(contact.servo.report().sample.tip.is_finite());
    }
}

#[test]
fn a_silent_world_fades_and_a_world_that_speaks_again_is_felt_again() {
    let mut contact = Contact::new();
    contact.silence(19);
    assert!((contact.newton() - 1.0).abs() < 1e-9);
    contact.silence(60);
    assert_eq!(contact.newton(), 0.0);
    assert!(contact.servo.report().flags.has(SafetyFlags::STALE));
    contact.ticks(60);
    assert!((contact.newton() - 1.0).abs() < 1e-9);
}

#[test]
fn a_lost_a_warm_and_a_deserted_device_are_let_go_within_a_tick() {
    for status in [DeviceStatus::Lost, DeviceStatus::Warm] {
        let mut contact = Contact::new();
        contact.device.status = status;
        assert!(contact.tick().flags.has(SafetyFlags::DISCONNECTED));
        assert_eq!(contact.newton(), 0.0);
        contact.device.status = DeviceStatus::Ready;
        contact.tick();
        contact.is_off_and_comes_back();
    }
    let mut contact = Contact::new();
    contact.scene.live = false;
    contact.tick();
    assert_eq!(contact.newton(), 0.0);
    contact.scene.live = true;
    contact.tick();
    contact.is_off_and_comes_back();
}

#[test]
fn a_stall_switches_off_and_late_ticks_soften() {
    let mut contact = Contact::new();
    contact.silent_tick(0.050);
    assert_eq!(contact.servo.report().counters.stalls, 1);
    contact.is_off_and_comes_back();

    let mut contact = Contact::new();
    for _ in 0..3 {
        contact.scene.serial += 1;
        assert!(contact.silent_tick(0.002).flags.has(SafetyFlags::LATE));
    }
    contact.ticks(100);
    assert!((contact.newton() - 0.5).abs() < 1e-9, "{}", contact.newton());
    contact.ticks(1_100);
    assert!((contact.newton() - 1.0).abs() < 1e-9);
}

#[test]
fn a_device_that_runs_away_is_let_go_by_its_own_speed() {
    let mut contact = Contact::new();
    contact.device.velocity = DVec3::X * 9.0;
    contact.ticks(10);
    assert_eq!(contact.servo.report().counters.too_fast, 1);
    contact.device.velocity = DVec3::ZERO;
    contact.ticks(30);
    contact.is_off_and_comes_back();
}

#[test]
fn whatever_is_asked_for_no_force_is_above_the_limit_or_rises_too_fast() {
    let mut servo = Servo::new(ServoSettings::of(&DeviceSpec::OMNI));
    let mut last = DVec3::ZERO;
    let mut most = 0.0_f64;
    for k in 0..20_000_u32 {
        // Constants of up to 1e6 N in changing slots and generations.
        let n = f64::from(k / 40);
        let size = libm::pow(10.0, 6.0 * libm::sin(n));
        let way = DVec3::new(libm::sin(n), libm::cos(2.0 * n), libm::sin(3.0 * n));
        let set = EffectSet::of(k / 200, &[Effect::Constant { force: way * size }]);
        let quiet = if k < 1_000 { EffectSet::default() } else { set };
        let scene = HapticScene { serial: u64::from(k), effects: quiet, ..HapticScene::default() };
        let force = servo.tick(&DeviceState::default(), &scene, 0.001).0;
        assert!(force.length() <= 3.3, "{k}: {force}");
        most = most.max(force.length());
        // Twice the limit: from one side of it to the other.
        assert!((force - last).length() <= 6.6);
        last = force;
    }
    assert!(most > 3.0, "{most}");
    assert!(servo.report().counters.clamp > 0 && servo.report().counters.slew > 0);
}

#[test]
fn a_long_push_sinks_to_what_the_motors_bear() {
    let mut contact = Contact::new();
    contact.device.position.x = 0.006;
    contact.ticks(60_000);
    assert!(contact.servo.report().force_rms_n < 0.9);
    assert!((contact.newton() - 0.88).abs() < 0.05, "{}", contact.newton());
    assert!(contact.servo.report().flags.has(SafetyFlags::THERMAL));
}
