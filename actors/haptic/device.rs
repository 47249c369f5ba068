//! Which devices there are, and how they are opened.

use super::haply::{self, NoHaply};
use super::openhaptics::{self, NoOpenHaptics};
use super::recording;
use super::turns::{Explain, Scheduler};
use glam::DVec3;
use hapticbillard::haptic::simulated::{
    Guide, HandModel, HandScript, Leg, MouseFeel, MouseHand, SimulatedDevice,
};
use hapticbillard::haptic::{Buttons, Device, DeviceSpec, DeviceState, Force, RecordedDevice};
use hapticbillard::input::{Action, HandInput};
use hapticbillard::scene::HapticDevice;
use hapticbillard::units::Seconds;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

/// Where the hand of a mouse begins [m]: in front of what there is to touch.
const MOUSE_START_M: DVec3 = DVec3::new(0.0, 0.0, 0.033);
/// Reports of a mouse that wait at most.
const MOVES: usize = 256;

/// A kind of device as `haptic devices` lists it.
#[derive(Debug, Clone, PartialEq)]
pub struct Listed {
    /// Its name in a scene.
    pub name: &'static str,
    /// In words.
    pub about: &'static str,
    /// What it is, in units; none: there is none, or any.
    pub spec: Option<DeviceSpec>,
    /// What it says of itself, or why it is not there.
    pub says: Option<String>,
}

/// All kinds that a scene can name. Those that can be there or not are asked.
pub fn list() -> [Listed; 5] {
    let simulated = |name, about| Listed { name, about, spec: Some(DeviceSpec::OMNI), says: None };
    let (omni, omni_says) = match openhaptics::look(openhaptics::named().as_deref(), None) {
        Ok(seen) => (Some(seen.spec), seen.about),
        Err(error) => (None, error.to_string()),
    };
    let (inverse3, inverse3_says) = match haply::open(haply::ADDRESS, TRIED) {
        Ok(opened) => (Some(opened.device.spec()), format!("its service is at {}", haply::ADDRESS)),
        Err(error) => (None, error.to_string()),
    };
    [
        simulated("simulated", "a simulated device in a simulated hand"),
        simulated("mouse", "a simulated device; a mouse moves the hand"),
        Listed {
            name: "recorded:FILE",
            about: "a recording of a device",
            spec: None,
            says: Some("what `haptic check --record FILE` wrote".to_string()),
        },
        Listed {
            name: "openhaptics",
            about: "SensAble and 3D Systems, by OpenHaptics",
            spec: omni,
            says: Some(omni_says),
        },
        Listed {
            name: "haply",
            about: "Haply Inverse3, at its service",
            spec: inverse3,
            says: Some(inverse3_says),
        },
    ]
}

/// Why there is no device.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum NoDevice {
    /// A recording cannot be replayed.
    #[error("{}: {problem}", path.display())]
    Recording {
        /// The file.
        path: PathBuf,
        /// What is wrong, and where.
        problem: String,
    },
    /// There is no Inverse3.
    #[error(transparent)]
    Haply(#[from] NoHaply),
    /// OpenHaptics does not give it.
    #[error(transparent)]
    OpenHaptics(#[from] NoOpenHaptics),
}

/// A device that was opened.
pub struct Opened {
    /// The device.
    pub device: Box<dyn Device>,
    /// The way from a mouse into its hand, if one leads there.
    pub mouse: Option<MousePort>,
    /// What turns its servo; none: a thread of ours.
    pub scheduler: Option<Box<dyn Scheduler>>,
    /// Who knows why it is not ready.
    pub explains: Option<Arc<dyn Explain>>,
    /// Somebody holds it who can point with it.
    pub points: bool,
}

impl Opened {
    /// A device that a thread of ours turns, and that nobody else has to do with.
    pub fn new(device: impl Device + 'static) -> Self {
        Opened {
            device: Box::new(device),
            mouse: None,
            scheduler: None,
            explains: None,
            points: true,
        }
    }
}

/// How long a service may take to answer that somebody wants, and one that is only tried.
const WANTED: Duration = Duration::from_secs(2);
const TRIED: Duration = Duration::from_millis(300);

/// Opens the device that a scene names; none where it wants none. A recording is sought from the
/// working folder.
///
/// # Errors
/// [`NoDevice`] if this build does not know it, or it is not there.
pub fn open(wanted: &HapticDevice) -> Result<Option<Opened>, NoDevice> {
    match wanted {
        HapticDevice::None => Ok(None),
        HapticDevice::Auto => Ok(Some(first_there().unwrap_or_else(simulated))),
        HapticDevice::Simulated => Ok(Some(simulated())),
        HapticDevice::OpenHaptics(name) => {
            let library = openhaptics::named();
            Ok(Some(openhaptics::open(library.as_deref(), name.as_deref())?))
        }
        HapticDevice::Mouse => {
            let hand = MouseHand::new(MouseFeel::default()).starting_at(MOUSE_START_M);
            let guide = Guide::Mouse(hand);
            let device = SimulatedDevice::new(DeviceSpec::OMNI, HandModel::MOUSE, guide);
            let (port, moves) = rtrb::RingBuffer::new(MOVES);
            let device = MouseDevice { device, moves };
            let mouse = Some(MousePort(port));
            // The mouse itself points.
            Ok(Some(Opened { mouse, points: false, ..Opened::new(device) }))
        }
        HapticDevice::Recorded(file) => {
            let recording = recording::load(Path::new(file))?;
            let device = RecordedDevice::new(Arc::new(recording));
            // Whoever held it meant no menus of today.
            Ok(Some(Opened { points: false, ..Opened::new(device) }))
        }
        HapticDevice::Haply(address) => {
            let address = address.as_deref().unwrap_or(haply::ADDRESS);
            Ok(Some(haply::open(address, WANTED)?))
        }
    }
}

/// A simulated device in nobody's hand.
fn simulated() -> Opened {
    let guide = Guide::Script(roaming());
    let device = SimulatedDevice::new(DeviceSpec::OMNI, HandModel::GRIP, guide);
    Opened { points: false, ..Opened::new(device) }
}

/// The first real device that is there. Who has no vendor's library and no service has no device,
/// and need not be told.
fn first_there() -> Option<Opened> {
    match openhaptics::open(openhaptics::named().as_deref(), None) {
        Ok(opened) => return Some(opened),
        Err(NoOpenHaptics::NoLibrary { .. }) => {}
        Err(error) => tracing::warn!("{error}"),
    }
    match haply::open(haply::ADDRESS, TRIED) {
        Ok(opened) => return Some(opened),
        Err(NoHaply::Unreachable { .. }) => {}
        Err(error) => tracing::warn!("{error}"),
    }
    None
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
    lost: u64,
}

impl FeltMouse {
    /// A mouse without a button held.
    pub fn new(port: MousePort) -> Self {
        FeltMouse { port, held: Buttons::default(), draws_back: false, lost: 0 }
    }

    /// The same of somebody who strikes: after each stroke the hand draws back by itself.
    #[must_use]
    pub fn striking(self) -> Self {
        FeltMouse { draws_back: true, ..self }
    }

    /// The hand goes back to where it began.
    pub fn go_home(&mut self) {
        self.say(MouseMove::Home);
    }

    /// Takes a report.
    pub fn hear(&mut self, report: &HandInput) {
        let heard = match report {
            HandInput::Moved { right, up } => MouseMove::Moved { right: *right, up: *up },
            HandInput::Wheel { notches } => MouseMove::Wheel(*notches),
            HandInput::Act { action, down } => {
                let stylus = match action {
                    Action::Stroke => Buttons::FRONT,
                    Action::MouseMovesTip => Buttons::REAR,
                    _ => return,
                };
                self.held = if *down { self.held.with(stylus) } else { self.held.without(stylus) };
                MouseMove::Held(self.held)
            }
            HandInput::FocusLost | HandInput::PadLost | HandInput::Closed => {
                self.held = Buttons::default();
                MouseMove::Held(self.held)
            }
            HandInput::Stick { .. }
            | HandInput::Trigger(_)
            | HandInput::Picked { .. }
            | HandInput::Aid(_)
            | HandInput::Points { .. }
            | HandInput::Hold(_)
            | HandInput::StylusSpeed(_)
            | HandInput::Paused(_)
            | HandInput::Steering(_) => return,
        };
        self.say(heard);
        let is_let_go = matches!(report, HandInput::Act { action: Action::Stroke, down: false });
        if is_let_go && self.draws_back {
            self.say(MouseMove::DrawBack);
        }
    }

    /// A full ring loses what is said, and that is counted; whatever is held is said again with the
    /// next button.
    fn say(&mut self, report: MouseMove) {
        if !self.port.say(report) {
            self.lost += 1;
            if self.lost == 1 {
                tracing::warn!("the simulated device takes no more of the mouse");
            }
        }
    }

    /// What was said in vain.
    pub fn lost(&self) -> u64 {
        self.lost
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
        let Opened { mut device, mouse, .. } = open(&HapticDevice::Mouse).unwrap().unwrap();
        let mut mouse = FeltMouse::new(mouse.unwrap());
        mouse.hear(&HandInput::Moved { right: 0.25, up: 0.0 });
        mouse.hear(&HandInput::Act { action: Action::Stroke, down: true });
        mouse.hear(&HandInput::Moved { right: 0.0, up: 0.125 });
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
    fn what_needs_no_hardware_can_be_opened() {
        assert!(open(&HapticDevice::None).unwrap().is_none());
        assert!(open(&HapticDevice::Auto).unwrap().is_some());
    }
}
