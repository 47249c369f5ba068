//! Hands and walls, with the whole safety chain as it is shipped.

use glam::DVec3;
use hapticbillard::haptic::simulated::{Guide, HandModel, HandScript, Leg, SimulatedDevice};
use hapticbillard::haptic::{
    Device, DeviceSpec, Effect, EffectSet, HapticScene, Servo, ServoSettings,
};

/// The stiffness that an Omni is made for [N/m].
const STIFF_N_M: f64 = 500.0;

/// What remained of a push into a wall.
struct Rest {
    ripple_m: f64,
    passivity: u64,
    most_n: f64,
    depth_m: f64,
}

/// A device of this kind, `late` samples late.
fn device(period_s: f64, late: u32, friction_n: f64) -> DeviceSpec {
    DeviceSpec {
        rate_hz: 1.0 / period_s,
        latency_s: f64::from(late) * period_s,
        friction_n,
        ..DeviceSpec::OMNI
    }
}

/// A wall that a hand pushes, or a weight of 0.5 N if nobody holds the device; what the device
/// did in the last second of `seconds`.
fn push(spec: DeviceSpec, hand: HandModel, settings: ServoSettings, seconds: f64) -> Rest {
    let wall = Effect::Plane {
        normal: DVec3::NEG_X,
        offset_m: 0.0,
        stiffness_n_m: STIFF_N_M,
        damping_ns_m: 0.0,
    };
    let before = DVec3::X * -0.01;
    let legs = vec![Leg::to(before, 1.0), Leg::ramp(DVec3::X * 0.015, 0.1)];
    let guide = Guide::Script(HandScript::drawn(before, legs));
    let mut device = SimulatedDevice::new(spec, hand, guide);
    let mut servo = Servo::new(settings);
    let mut scene = HapticScene { effects: EffectSet::of(1, &[wall]), ..HapticScene::default() };
    let period_s = spec.period_s();
    let (mut low, mut high, mut most_n) = (f64::INFINITY, f64::NEG_INFINITY, 0.0_f64);
    for tick in 0..(seconds / period_s) as u64 {
        let time_s = tick as f64 * period_s;
        if hand == HandModel::None && time_s > 1.0 {
            device.push(DVec3::X * 0.5);
        }
        let state = device.read(if tick == 0 { 0.0 } else { period_s });
        scene.serial += 1;
        let force = servo.tick(&state, &scene, period_s);
        device.write(force);
        most_n = most_n.max(force.0.length());
        if time_s > seconds - 1.0 {
            low = low.min(device.position().x);
            high = high.max(device.position().x);
        }
    }
    let passivity = servo.report().counters.passivity;
    Rest { ripple_m: high - low, passivity, most_n, depth_m: low }
}

const HANDS: [(&str, HandModel); 4] = [
    ("L", HandModel::LIGHT),
    ("G", HandModel::GRIP),
    ("F", HandModel::FIRM),
    ("A", HandModel::ARM),
];

#[test]
fn a_wall_as_stiff_as_the_device_settles_under_every_hand() {
    for (name, hand) in HANDS {
        for late in 0..3 {
            let spec = device(0.001, late, 0.26);
            let rest = push(spec, hand, ServoSettings::of(&spec), 3.0);
            assert!(rest.ripple_m < 1.1e-4, "{name}, {late}: {} m", rest.ripple_m);
            assert!(rest.depth_m > 5e-4 && rest.most_n > 1.0, "{name}: nothing was felt");
            assert!(rest.most_n <= 3.3, "{name}: {} N", rest.most_n);
        }
    }
}

#[test]
fn where_theory_says_it_cannot_the_observer_acts_and_no_swing_remains() {
    let mut acted = 0;
    for (name, hand) in HANDS.into_iter().chain([("0", HandModel::None)]) {
        for period_s in [0.001, 0.004] {
            for late in 0..3 {
                for friction_n in [0.26, 0.0] {
                    let spec = device(period_s, late, friction_n);
                    let seconds = if hand == HandModel::None { 15.0 } else { 5.0 };
                    let rest = push(spec, hand, ServoSettings::of(&spec), seconds);
                    let case = format!("{name}, {period_s} s, {late} late, {friction_n} N");
                    assert!(rest.ripple_m < 2e-4, "{case}: {} m", rest.ripple_m);
                    assert!(rest.most_n <= 3.3, "{case}: {} N", rest.most_n);
                    // Without friction or hand every sampled wall is active: b < K T/2.
                    if name == "0" {
                        assert!(rest.passivity > 0, "{case}: the observer slept");
                    }
                    acted += u64::from(rest.passivity > 0);
                }
            }
        }
    }
    assert!(acted > 30, "{acted}");
}

#[test]
fn without_the_observer_the_same_loops_swing() {
    // The canary: these are the loops that the test above calms.
    for (hand, late, least_m) in
        [(HandModel::LIGHT, 2, 0.01), (HandModel::GRIP, 2, 0.001), (HandModel::None, 0, 0.01)]
    {
        let spec = device(0.004, late, 0.0);
        let mut settings = ServoSettings::of(&spec);
        settings.stiffness_max_n_m = f64::INFINITY;
        settings.safety.passivity_damping_ns_m = 0.0;
        let rest = push(spec, hand, settings, 5.0);
        assert!(rest.ripple_m > least_m, "{hand:?}: {}", rest.ripple_m);
    }
}

#[test]
fn the_observer_calms_loops_that_are_stiffer_than_the_ceiling_would_allow() {
    for (name, hand) in HANDS {
        let spec = device(0.004, 2, 0.26);
        let mut settings = ServoSettings::of(&spec);
        settings.stiffness_max_n_m = f64::INFINITY;
        let rest = push(spec, hand, settings, 8.0);
        assert!(rest.ripple_m < 2e-4, "{name}: {}", rest.ripple_m);
    }
}
