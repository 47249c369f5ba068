//! Hands and walls, with the whole safety chain as it is shipped.

use glam::DVec3;
use hapticbillard::haptic::simulated::{Guide, HandModel, HandScript, Leg, SimulatedDevice};
use hapticbillard::haptic::{
    Device, DeviceSpec, Effect, EffectSet, HapticScene, SafetyFlags, Servo, ServoSettings,
};

/// What remained of a push into a wall.
struct Rest {
    ripple_m: f64,
    depth_m: f64,
    passivity: u64,
    most_n: f64,
    factor: f64,
}

/// A wall of stiffness `k` that is pushed for 6 s; what the device did in the last second.
fn push(spec: DeviceSpec, hand: HandModel, k: f64, bias_n: f64) -> Rest {
    let wall =
        Effect::Plane { normal: DVec3::NEG_X, offset_m: 0.0, stiffness_n_m: k, damping_ns_m: 0.0 };
    let script = HandScript::drawn(
        DVec3::X * -0.01,
        vec![Leg::to(DVec3::X * -0.01, 1.0), Leg::ramp(DVec3::X * 0.015, 0.1)],
    );
    let mut device = SimulatedDevice::new(spec, hand, Guide::Script(script));
    let mut servo = Servo::new(ServoSettings::of(&spec));
    let mut scene = HapticScene { effects: EffectSet::of(1, &[wall]), ..HapticScene::default() };
    let period_s = spec.period_s();
    let ticks = (6.0 / period_s) as u64;
    let (mut low, mut high, mut most_n) = (f64::INFINITY, f64::NEG_INFINITY, 0.0_f64);
    for tick in 0..ticks {
        if tick as f64 * period_s > 1.0 && bias_n != 0.0 {
            // Nobody holds it: a weight pushes.
            device.push(DVec3::X * bias_n);
        }
        let state = device.read(if tick == 0 { 0.0 } else { period_s });
        scene.serial += 1;
        let force = servo.tick(&state, &scene, period_s);
        device.write(force);
        most_n = most_n.max(force.0.length());
        if tick as f64 * period_s > 5.0 {
            low = low.min(device.position().x);
            high = high.max(device.position().x);
        }
    }
    let report = servo.report();
    assert!(!report.flags.has(SafetyFlags::NOT_FINITE));
    Rest {
        ripple_m: high - low,
        depth_m: low,
        passivity: report.counters.passivity,
        most_n,
        factor: report.stiffness_factor,
    }
}

#[test]
fn explore() {
    for (name, hand) in [
        ("L", HandModel::LIGHT),
        ("G", HandModel::GRIP),
        ("F", HandModel::FIRM),
        ("A", HandModel::ARM),
        ("0", HandModel::None),
    ] {
        for t in [0.001, 0.004] {
            for d in 0..3 {
                for fc in [0.26, 0.0] {
                    for k in [500.0, 1121.0] {
                        let spec = DeviceSpec {
                            rate_hz: 1.0 / t,
                            latency_s: d as f64 * t,
                            friction_n: fc,
                            ..DeviceSpec::OMNI
                        };
                        let r = push(spec, hand, k, if name == "0" { 0.5 } else { 0.0 });
                        println!(
                            "X {name} T={t} d={d} fc={fc} K={k}: ripple {:.3} mm depth {:.2} mm pc {} most {:.3} factor {:.3}",
                            r.ripple_m * 1e3,
                            r.depth_m * 1e3,
                            r.passivity,
                            r.most_n,
                            r.factor
                        );
                    }
                }
            }
        }
    }
}
