use crate::bytes::{check_line, text};
use hapticbillard::haptic::{
    Force, HapticScene, INVERSE3, Inverse3, Inverse3Trouble, Servo, ServoSettings,
};

/// Of a longer talk so many messages are heard.
const MESSAGES: usize = 50;
/// Between two of them [s].
const PERIOD_S: f64 = 0.001;

/// The first line is the service's greeting, the others follow.
pub fn run(data: &[u8]) {
    let text = text(data);
    let mut messages = text.lines();
    let mut arm = match Inverse3::greeted(messages.next().unwrap_or_default()) {
        Ok(arm) => arm,
        Err(trouble) => return check_line(&trouble.to_string()),
    };
    check_line(&format!("the arm {}", arm.name()));
    let mut out = String::new();
    arm.greeting(&mut out);
    check_sent(&out);
    let mut servo = Servo::new(ServoSettings::of(&arm.spec()));
    let scene = HapticScene { live: true, ..HapticScene::default() };
    for message in messages.take(MESSAGES) {
        match arm.hear(message, PERIOD_S) {
            Ok(state) => {
                let force = servo.tick(&state, &scene, PERIOD_S);
                assert!(force.0.length() <= INVERSE3.force_max_n, "{force:?} of {state:?}");
                // A force that no servo gives is none that is sent.
                arm.push(Force(state.position), &mut out);
                check_sent(&out);
            }
            Err(trouble) => check_line(&trouble.to_string()),
        }
        arm.trouble().map(Inverse3Trouble::to_string).iter().for_each(|line| check_line(line));
    }
}

/// JSON, in which every number is one.
fn check_sent(message: &str) {
    assert!(serde_json::from_str::<serde_json::Value>(message).is_ok(), "{message}");
}
