use crate::bytes::{Bytes, check_line, text};
use hapticbillard::haptic::openhaptics::{HdLimits, HdReading, told};
use hapticbillard::haptic::{DeviceSpec, HapticScene, Servo, ServoSettings};

/// So many readings are felt, `PERIOD_S` apart [s].
const READINGS: usize = 20;
const PERIOD_S: f64 = 0.001;

/// Models as a library may name them; friction is known of some.
const MODELS: [&str; 3] = ["", "PHANTOM Omni", "PHANTOM Premium 1.5"];

/// Numbers as they stand in memory: limits, then readings; what is left is a text.
pub fn run(data: &[u8]) {
    let mut bytes = Bytes(data);
    let [model] = bytes.take();
    let said = |bytes: &mut Bytes<'_>| match bytes.take() {
        [0] => None,
        [_] => Some(bytes.number()),
    };
    let limits = HdLimits {
        workspace_mm: bytes.numbers(),
        force_max_n: said(&mut bytes),
        force_continuous_n: said(&mut bytes),
        stiffness_max_n_mm: said(&mut bytes),
        damping_max_ns_mm: said(&mut bytes),
        rate_hz: bytes.number(),
        input_dof: i32::from_le_bytes(bytes.take()),
    };
    let spec = limits.spec(MODELS[usize::from(model) % MODELS.len()]);
    check_spec(&spec);
    let centre_m = limits.centre_m();
    assert!(centre_m.is_finite(), "{limits:?}");
    let mut servo = Servo::new(ServoSettings::of(&spec));
    let scene = HapticScene { live: true, ..HapticScene::default() };
    for _ in 0..READINGS {
        let reading = HdReading {
            position_mm: bytes.numbers(),
            velocity_mm_s: bytes.numbers(),
            transform: bytes.numbers(),
            buttons: i32::from_le_bytes(bytes.take()),
        };
        let state = reading.state(&spec, centre_m);
        assert!(state.orientation.is_normalized(), "{reading:?}");
        let force = servo.tick(&state, &scene, PERIOD_S);
        assert!(force.0.length() <= spec.force_max_n, "{force:?} of {reading:?}");
        if bytes.0.is_empty() {
            break;
        }
    }
    check_line(&format!("the device {}", told(&text(bytes.0))));
}

/// Whatever a device says of itself, it is one that a servo can be in front of.
fn check_spec(spec: &DeviceSpec) {
    let positive = [
        spec.force_max_n,
        spec.force_continuous_n,
        spec.stiffness_max_n_m,
        spec.damping_max_ns_m,
        spec.rate_hz,
        spec.workspace_m.min_element(),
    ];
    assert!(positive.iter().all(|number| (0.0..1e5).contains(number) && 0.0 < *number), "{spec:?}");
    assert!(spec.force_continuous_n <= spec.force_max_n, "{spec:?}");
}
