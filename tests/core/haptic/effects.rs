//! Effects through the shipped tick: laws, superposition, what is changed when.

use glam::DVec3;
use hapticbillard::haptic::{
    DeviceSpec, DeviceState, Effect, EffectSet, HapticScene, Region, SafetySettings, Servo,
    ServoSettings,
};

/// A servo that gives what the laws give.
fn bare() -> Servo {
    Servo::new(ServoSettings {
        velocity_filter_hz: f64::INFINITY,
        stiffness_max_n_m: f64::INFINITY,
        safety: SafetySettings::OFF,
        ..ServoSettings::of(&DeviceSpec::OMNI)
    })
}

fn at(position: DVec3) -> DeviceState {
    DeviceState { position, ..DeviceState::default() }
}

fn scene(effects: &[Effect]) -> HapticScene {
    HapticScene { effects: EffectSet::of(0, effects), ..HapticScene::default() }
}

/// The first force of an effect on a device that rests at `position`.
fn force(effects: &[Effect], position: DVec3) -> DVec3 {
    bare().tick(&at(position), &scene(effects), 0.001).0
}

const P: DVec3 = DVec3::new(0.010, -0.020, 0.005);

fn all() -> Vec<Effect> {
    let (stiffness_n_m, damping_ns_m) = (400.0, 0.0);
    let region = Region::Ball { centre: DVec3::ZERO, radius_m: 0.1 };
    vec![
        Effect::Constant { force: DVec3::new(0.1, 0.2, -0.3) },
        Effect::Point { point: P, stiffness_n_m, damping_ns_m },
        Effect::Line { point: P, direction: DVec3::Z, stiffness_n_m, damping_ns_m },
        Effect::Plane { normal: DVec3::Y, offset_m: 0.001, stiffness_n_m, damping_ns_m },
        Effect::Sphere { centre: P, radius_m: 0.03, stiffness_n_m, damping_ns_m },
        Effect::Magnet { point: P, stiffness_n_m, force_max_n: 1.0, reach_m: 0.04 },
        Effect::Viscous { region, damping_ns_m: 2.0 },
        Effect::Vibration { region, direction: DVec3::X, amplitude_n: 1.0, frequency_hz: 100.0 },
    ]
}

#[track_caller]
fn near(force: DVec3, expected: DVec3) {
    assert!((force - expected).length() < 1e-12, "{force}, not {expected}");
}

#[test]
fn each_law_is_what_it_says() {
    let laws = all();
    let x = P + DVec3::new(0.003, -0.004, 0.001);
    near(force(&laws[0..1], x), DVec3::new(0.1, 0.2, -0.3));
    near(force(&laws[1..2], x), 400.0 * DVec3::new(-0.003, 0.004, -0.001));
    near(force(&laws[2..3], x), 400.0 * DVec3::new(-0.003, 0.004, 0.0));
    // 1 mm above the origin and 24 mm below it: 25 mm deep.
    near(force(&laws[3..4], x), DVec3::Y * (400.0 * 0.025));
    near(force(&laws[3..4], DVec3::Y * 0.002), DVec3::ZERO);
    let out = (x - P).normalize();
    near(force(&laws[4..5], x), out * (400.0 * (0.03 - x.distance(P))));
    near(force(&laws[4..5], P + DVec3::X * 0.031), DVec3::ZERO);
    // The spring reaches 1 N at 2.5 mm; from there it falls to zero at 40 mm.
    near(force(&laws[5..6], P + DVec3::X * 0.002), DVec3::X * -0.8);
    near(force(&laws[5..6], P + DVec3::X * 0.021_25), DVec3::X * -0.5);
    near(force(&laws[5..6], P + DVec3::X * 0.041), DVec3::ZERO);
    // In the middle of a sphere every way out is as short; one is taken.
    assert!((force(&laws[4..5], P).length() - 12.0).abs() < 1e-12);
}

#[test]
fn damping_resists_motion_inside_and_never_pulls() {
    let mut servo = bare();
    let moving = |velocity| DeviceState { velocity, ..at(DVec3::X * 0.01) };
    let viscous = all()[6];
    let v = DVec3::new(0.1, 0.0, -0.2);
    near(servo.tick(&moving(v), &scene(&[viscous]), 0.001).0, -2.0 * v);
    let wall = Effect::Plane {
        normal: DVec3::X,
        offset_m: 0.011,
        stiffness_n_m: 100.0,
        damping_ns_m: 5.0,
    };
    // 0.1 N of the spring and 0.5 N of damping that would pull the device back.
    near(bare().tick(&moving(DVec3::X * 0.1), &scene(&[wall]), 0.001).0, DVec3::ZERO);
    near(bare().tick(&moving(DVec3::X * -0.1), &scene(&[wall]), 0.001).0, DVec3::X * 0.6);
}

#[test]
fn forces_of_several_effects_add_up() {
    let laws = all();
    for k in 0..50 {
        let k = f64::from(k);
        let x = 0.03 * DVec3::new(libm::sin(k), libm::cos(1.7 * k), libm::sin(2.3 * k));
        let sum: DVec3 = laws.iter().map(|law| force(&[*law], x)).sum();
        near(force(&laws, x), sum);
    }
}

#[test]
fn forces_are_continuous_where_a_body_begins() {
    let eps = 1e-9;
    let laws = all();
    for (law, border) in [(3, DVec3::Y * 0.001), (4, P + DVec3::Z * 0.03), (5, P + DVec3::X * 0.04)]
    {
        for side in [-eps, eps] {
            let way = if law == 3 { DVec3::Y } else { (border - P).normalize() };
            let felt = force(&laws[law..=law], border + way * side);
            assert!(felt.length() < 1e-6, "{law}: {felt}");
        }
    }
}

#[test]
fn a_stick_slip_holds_until_it_breaks_and_sticks_again() {
    let slip =
        Effect::StickSlip { region: Region::Everywhere, stiffness_n_m: 500.0, force_max_n: 0.5 };
    let (mut servo, scene) = (bare(), scene(&[slip]));
    let mut x = |mm: f64| servo.tick(&at(DVec3::X * mm * 1e-3), &scene, 0.001).0.x;
    near(DVec3::splat(x(0.0)), DVec3::ZERO);
    near(DVec3::splat(x(0.8)), DVec3::splat(-0.4));
    // 1.2 mm would be 0.6 N: it slips, and the next 0.4 mm are felt from there.
    near(DVec3::splat(x(1.2)), DVec3::ZERO);
    near(DVec3::splat(x(1.6)), DVec3::splat(-0.2));
}

#[test]
fn a_vibration_and_a_blow_run_in_their_own_time() {
    let vibration = all()[7];
    let (mut servo, scene_) = (bare(), scene(&[vibration]));
    for tick in 0..50 {
        let expected = libm::sin(std::f64::consts::TAU * 0.1 * f64::from(tick));
        near(servo.tick(&at(DVec3::ZERO), &scene_, 0.001).0, DVec3::X * expected);
    }
    let blow = |serial| Effect::Blow {
        serial,
        direction: DVec3::Y,
        amplitude_n: 2.0,
        frequency_hz: 150.0,
        decay_s: 0.006,
    };
    let mut servo = bare();
    let mut y = |serial| servo.tick(&at(DVec3::ZERO), &scene(&[blow(serial)]), 0.001).0.y;
    assert_eq!(y(1), 2.0);
    let second = 2.0 * libm::exp(-1.0 / 6.0) * libm::cos(std::f64::consts::TAU * 0.15);
    assert!((y(1) - second).abs() < 1e-12);
    assert_eq!(y(2), 2.0);
    for _ in 0..100 {
        y(2);
    }
    assert_eq!(y(2), 0.0);
}

#[test]
fn an_effect_is_modified_while_it_acts_and_never_half() {
    // Point and stiffness change together at every tick; a mixture would be another force.
    let mut servo = bare();
    for k in 0..1_000_u32 {
        let (x, stiffness_n_m) = (f64::from(k % 7) * 1e-3, 100.0 + f64::from(k % 5));
        let point = Effect::Point { point: DVec3::X * x, stiffness_n_m, damping_ns_m: 0.0 };
        let felt = servo.tick(&at(DVec3::ZERO), &scene(&[point]), 0.001).0;
        assert_eq!(felt.x, stiffness_n_m * x);
    }
}

#[test]
fn a_turned_world_gives_the_turned_force() {
    let turn = glam::DQuat::from_xyzw(0.1, -0.7, 0.3, 0.6).normalize();
    let (k, b) = (400.0, 0.0);
    for i in 0..40 {
        let i = f64::from(i);
        let x = 0.02 * DVec3::new(libm::sin(i), libm::sin(1.3 * i), libm::cos(0.7 * i));
        let here = [
            Effect::Point { point: P, stiffness_n_m: k, damping_ns_m: b },
            Effect::Line { point: P, direction: DVec3::X, stiffness_n_m: k, damping_ns_m: b },
            Effect::Sphere { centre: P, radius_m: 0.02, stiffness_n_m: k, damping_ns_m: b },
        ];
        let there = [
            Effect::Point { point: turn * P, stiffness_n_m: k, damping_ns_m: b },
            Effect::Line {
                point: turn * P,
                direction: turn * DVec3::X,
                stiffness_n_m: k,
                damping_ns_m: b,
            },
            Effect::Sphere { centre: turn * P, radius_m: 0.02, stiffness_n_m: k, damping_ns_m: b },
        ];
        near(force(&there, turn * x), turn * force(&here, x));
    }
}
