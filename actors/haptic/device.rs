//! Which devices there are, and how they are opened.

use glam::DVec3;
use hapticbillard::haptic::simulated::{
    Guide, HandModel, HandScript, Leg, MouseFeel, MouseHand, SimulatedDevice,
};
use hapticbillard::haptic::{Buttons, Device, DeviceSpec, DeviceState, Force};
use hapticbillard::input::{Button, RawInput};
use hapticbillard::scene::HapticDevice;
use hapticbillard::units::Seconds;

/// Where the hand of a mouse begins [m]: in front of what there is to touch.
const MOUSE_START_M: DVec3 = DVec3::new(0.0, 0.0, 0.033);
/// Reports of a mouse that wait at most.
const MOVES: usize = 256;

/// A kind of device as `haptic devices` lists it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Listed {
    /// Its name in a scene.
    pub name: &'static str,
    /// What it is, in units; none: it is not built in.
    pub spec: Option<DeviceSpec>,
    /// In words.
    pub about: &'static str,
}

/// All kinds that a scene can name.
pub fn list() -> [Listed; 5] {
    let spec = Some(DeviceSpec::OMNI);
    [
        Listed { name: "simulated", spec, about: "a simulated device in a simulated hand" },
        Listed { name: "mouse", spec, about: "a simulated device; a mouse moves the hand" },
        Listed { name: "recorded:FILE", spec: None, about: "a recording of a device" },
        Listed {
            name: "openhaptics",
            spec: None,
            about: "SensAble and 3D Systems, by OpenHaptics",
        },
        Listed { name: "haply", spec: None, about: "Haply Inverse3, at its service" },
    ]
}

/// Why there is no device.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "the haptic device '{name}' is not built in; write device = \"simulated\" or \"mouse\" in \
     [haptic], or \"none\""
)]
pub struct NoDevice {
    /// What was asked for.
    pub name: String,
}

/// A device that was opened.
pub struct Opened {
    /// The device.
    pub device: Box<dyn Device>,
    /// The way from a mouse into its hand, if one leads there.
    pub mouse: Option<MousePort>,
}

/// Opens the device that a scene names; none where it wants none.
///
/// # Errors
/// [`NoDevice`] if this build does not know it.
pub fn open(wanted: &HapticDevice) -> Result<Option<Opened>, NoDevice> {
    let spec = DeviceSpec::OMNI;
    match wanted {
        HapticDevice::None => Ok(None),
        HapticDevice::Auto | HapticDevice::Simulated => {
            let guide = Guide::Script(roaming());
            let device = SimulatedDevice::new(spec, HandModel::GRIP, guide);
            Ok(Some(Opened { device: Box::new(device), mouse: None }))
        }
        HapticDevice::Mouse => {
            let hand = MouseHand::new(MouseFeel::default()).starting_at(MOUSE_START_M);
            let guide = Guide::Mouse(hand);
            let device = SimulatedDevice::new(spec, HandModel::MOUSE, guide);
            let (port, moves) = rtrb::RingBuffer::new(MOVES);
            let device = MouseDevice { device, moves };
            Ok(Some(Opened { device: Box::new(device), mouse: Some(MousePort(port)) }))
        }
        HapticDevice::Recorded(_) | HapticDevice::OpenHaptics | HapticDevice::Haply => {
            Err(NoDevice { name: wanted.name() })
        }
    }
}

/// How long the hand without a person goes from place to place [s], and how often.
const LEG_S: Seconds = 1.0;
const LEGS: u32 = 600;

/// A hand that feels its way through the whole workspace for ten minutes, then rests: on a curve
/// whose three directions have no common period soon.
fn roaming() -> HandScript {
    let size = 0.35 * DeviceSpec::OMNI.workspace_m;
    let place = |k: u32| {
        let angle = f64::from(k) * DVec3::new(1.1, 1.7, 2.3);
        DVec3::new(libm::sin(angle.x), libm::sin(angle.y), libm::cos(angle.z)) * size
    };
    let legs = (1..=LEGS).map(|k| Leg::to(place(k), LEG_S)).collect();
    HandScript::practised(place(0), legs)
}

/// What a mouse did.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MouseMove {
    /// It moved, in heights of the window.
    Moved {
        /// To the right.
        right: f64,
        /// Away from the user.
        up: f64,
    },
    /// The wheel turned, positive away from the user.
    Wheel(f64),
    /// These buttons are held now.
    Held(Buttons),
    /// The hand draws back in depth to where it began, once the finger has let go.
    DrawBack,
    /// The hand goes back to where it began.
    Home,
}

/// The way from a mouse into the hand.
pub struct MousePort(rtrb::Producer<MouseMove>);

impl MousePort {
    /// Hands a report over. False if the device is gone or takes none: the report is lost, and the
    /// next buttons are right again.
    pub fn say(&mut self, report: MouseMove) -> bool {
        self.0.push(report).is_ok()
    }
}

/// A mouse as a window reports it, on its way into the hand: the left button is the front one of
/// the stylus, the right the rear one.
pub struct FeltMouse {
    port: MousePort,
    held: Buttons,
    /// After a stroke the hand draws back by itself.
    draws_back: bool,
}

impl FeltMouse {
    /// A mouse without a button held.
    pub fn new(port: MousePort) -> Self {
        FeltMouse { port, held: Buttons::default(), draws_back: false }
    }

    /// The same of somebody who strikes: after each stroke the hand draws back by itself.
    #[must_use]
    pub fn striking(self) -> Self {
        FeltMouse { draws_back: true, ..self }
    }

    /// The hand goes back to where it began.
    pub fn go_home(&mut self) {
        let _ = self.port.say(MouseMove::Home);
    }

    /// Takes a report.
    pub fn hear(&mut self, report: &RawInput) {
        let heard = match report {
            RawInput::Moved { right, up } => MouseMove::Moved { right: *right, up: *up },
            RawInput::Wheel { notches } => MouseMove::Wheel(*notches),
            RawInput::Button { button, down } => {
                let stylus = match button {
                    Button::Left => Buttons::FRONT,
                    Button::Right => Buttons::REAR,
                    _ => return,
                };
                self.held = if *down { self.held.with(stylus) } else { self.held.without(stylus) };
                MouseMove::Held(self.held)
            }
            RawInput::FocusLost | RawInput::Closed => {
                self.held = Buttons::default();
                MouseMove::Held(self.held)
            }
            RawInput::Key { .. } => return,
        };
        // A full ring loses movements; whatever is held is said again with the next button.
        let _ = self.port.say(heard);
        let is_let_go = matches!(report, RawInput::Button { button: Button::Left, down: false });
        if is_let_go && self.draws_back {
            let _ = self.port.say(MouseMove::DrawBack);
        }
    }
}

/// A simulated device whose hand a mouse moves.
struct MouseDevice {
    device: SimulatedDevice,
    moves: rtrb::Consumer<MouseMove>,
}

impl Device for MouseDevice {
    fn spec(&self) -> DeviceSpec {
        self.device.spec()
    }

    fn read(&mut self, dt: Seconds) -> DeviceState {
        while let Ok(report) = self.moves.pop() {
            if let Guide::Mouse(hand) = self.device.guide_mut() {
                match report {
                    MouseMove::Moved { right, up } => hand.moved(right, up),
                    MouseMove::Wheel(notches) => hand.wheel(notches),
                    MouseMove::Held(buttons) => hand.hold(buttons),
                    MouseMove::DrawBack => hand.draw_back(),
                    MouseMove::Home => hand.go_home(),
                }
            }
        }
        self.device.read(dt)
    }

    fn write(&mut self, force: Force) {
        self.device.write(force);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mouse_moves_the_hand_of_its_device() {
        let Opened { mut device, mouse } = open(&HapticDevice::Mouse).unwrap().unwrap();
        let mut mouse = FeltMouse::new(mouse.unwrap());
        mouse.hear(&RawInput::Moved { right: 0.25, up: 0.0 });
        mouse.hear(&RawInput::Button { button: Button::Left, down: true });
        mouse.hear(&RawInput::Moved { right: 0.0, up: 0.125 });
        let state = (0..2000).map(|_| device.read(0.001)).last().unwrap();
        // A quarter and an eighth of 160 mm, up to the device's dry friction against the hand.
        assert!((state.position.x - 0.04).abs() < 0.01, "{state:?}");
        assert!((state.position.z - (0.033 - 0.02)).abs() < 0.01, "{state:?}");
        assert!(state.position.y.abs() < 0.01 && state.buttons == Buttons::FRONT, "{state:?}");
    }

    #[test]
    fn the_roaming_hand_stays_inside_and_moves_slowly_enough() {
        let script = roaming();
        let half = 0.5 * DeviceSpec::OMNI.workspace_m;
        for k in 0..60_000 {
            let intent = script.at(f64::from(k) * 0.01);
            assert!(intent.position.abs().cmple(half).all() && intent.velocity.length() < 0.5);
        }
    }

    #[test]
    fn what_is_listed_without_a_specification_is_refused() {
        for device in [HapticDevice::OpenHaptics, HapticDevice::Haply] {
            let listed = list().into_iter().find(|listed| listed.name == device.name()).unwrap();
            assert_eq!(listed.spec, None);
            let error = open(&device).err().unwrap().to_string();
            assert!(error.contains(listed.name) && error.contains("not built in"), "{error}");
        }
        assert!(open(&HapticDevice::None).unwrap().is_none());
        assert!(open(&HapticDevice::Auto).unwrap().is_some());
    }
}
