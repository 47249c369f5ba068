//! What holds the hand while it leads no cue: the spring of the wheel menu, and the return spring
//! of the camera between six planes (paper, sections 3.3.2 and 3.3.3).
//!
//! Both are made in the servo's own tick, from the place where the stylus is in the tick in which
//! they begin: what is felt and what is reckoned with is the same place.

use super::device::{Buttons, DeviceState, DeviceStatus};
use super::effect::{EFFECTS_MAX, Effect, EffectSet};
use super::scene::{HapticScene, Reach};
use glam::DVec3;

/// The spring of the wheel menu [N/m]: against the dry friction of the mechanism it brings the
/// stylus back to within two millimetres.
pub const WHEEL_STIFFNESS_N_M: f64 = 150.0;
/// The return spring of the camera [N/m]: gentle, since it acts for as long as somebody looks
/// round.
const RETURN_STIFFNESS_N_M: f64 = 25.0;
/// How far the stylus goes before the camera moves [m] (paper, section 3.3.3).
pub const THRESHOLD_M: f64 = 0.005;
/// The planes there [N/m]: enough to be felt.
const PLANE_STIFFNESS_N_M: f64 = 150.0;
/// Damping of both springs [N s/m].
const DAMPING_NS_M: f64 = 1.0;

/// What the stylus is for. Whatever that is, its rear button opens the wheel menu.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub enum Leads {
    /// It leads the cue.
    #[default]
    Cue,
    /// It leads the camera.
    Camera,
    /// It points at things in the window.
    Pointer,
}

/// Where the hand is held, in the device frame [m].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Anchor {
    /// Where the wheel menu was opened.
    Wheel(DVec3),
    /// Where the stylus was when it began to lead the camera.
    Camera(DVec3),
}

/// Begins and ends anchors, tick by tick.
#[derive(Debug, Clone)]
pub struct Anchors {
    now: Option<Anchor>,
    leads: Leads,
    /// A rear button that was down before is not pressed.
    was_down: bool,
    changes: u32,
}

impl Default for Anchors {
    /// Nothing holds the hand; a button that is down at first was pressed for something else.
    fn default() -> Self {
        Anchors { now: None, leads: Leads::default(), was_down: true, changes: 0 }
    }
}

impl Anchors {
    /// One tick: what holds the hand now. A device that is lost or says no numbers is held by
    /// nothing.
    pub fn step(&mut self, device: &DeviceState, leads: Leads) -> Option<Anchor> {
        if device.status == DeviceStatus::Lost || !device.is_finite() {
            let was_held = self.now.take().is_some();
            self.changes = self.changes.wrapping_add(u32::from(was_held));
            (self.leads, self.was_down) = (leads, true);
            return None;
        }
        let is_down = device.buttons.has(Buttons::REAR);
        let was_down = std::mem::replace(&mut self.was_down, is_down);
        let is_pressed = is_down && !was_down;
        let next = match (leads, self.now) {
            (_, Some(Anchor::Wheel(_))) if is_down => self.now,
            _ if is_pressed => Some(Anchor::Wheel(device.position)),
            (Leads::Camera, Some(Anchor::Camera(_))) => self.now,
            (Leads::Camera, _) => Some(Anchor::Camera(device.position)),
            (Leads::Cue | Leads::Pointer, _) => None,
        };
        if self.now != next {
            self.changes = self.changes.wrapping_add(1);
        }
        (self.now, self.leads) = (next, leads);
        next
    }

    /// Puts what is to be felt into a scene: what was ordered, and the anchor. While the stylus
    /// leads no cue the workspace stays where it is, and nothing is struck or touched.
    pub fn apply(&self, effects: &EffectSet, reach: Option<Reach>, scene: &mut HapticScene) {
        scene.anchor = self.now;
        scene.effects = *effects;
        scene.effects.generation = effects.generation.wrapping_add(self.changes);
        scene.reach = reach;
        let is_free = self.now.is_none() && self.leads == Leads::Cue;
        if let Some(reach) = scene.reach.as_mut().filter(|_| !is_free) {
            (reach.turns, reach.solid, reach.cue) = (false, false, None);
        }
        let Some(anchor) = self.now else { return };
        let free = scene.effects.slots.iter_mut().filter(|slot| slot.is_none());
        for (slot, effect) in free.zip(anchor.effects()) {
            *slot = Some(effect);
        }
    }
}

impl Anchor {
    /// Most effects of an anchor.
    pub const EFFECTS: usize = 7;

    /// What is felt of it.
    fn effects(self) -> impl Iterator<Item = Effect> {
        let (point, stiffness_n_m, planes) = match self {
            Anchor::Wheel(at) => (at, WHEEL_STIFFNESS_N_M, 0),
            Anchor::Camera(at) => (at, RETURN_STIFFNESS_N_M, 6),
        };
        let damping_ns_m = DAMPING_NS_M;
        let spring = Effect::Point { point, stiffness_n_m, damping_ns_m };
        let faces = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
        // The faces of a cube round the place, each of which pushes inwards.
        let face = move |normal: DVec3| Effect::Plane {
            normal,
            offset_m: normal.dot(point) - THRESHOLD_M,
            stiffness_n_m: PLANE_STIFFNESS_N_M,
            damping_ns_m: 0.0,
        };
        std::iter::once(spring).chain(faces.into_iter().take(planes).map(face))
    }
}

const _: () = assert!(Anchor::EFFECTS <= EFFECTS_MAX);

#[cfg(test)]
mod tests {
    use super::super::device::DeviceSpec;
    use super::super::servo::Servo;
    use super::super::settings::ServoSettings;
    use super::super::simulated::{Guide, HandModel, HandScript, Leg, SimulatedDevice};
    use super::*;
    use crate::haptic::Device;

    /// A hand at an Omni, tick by tick.
    struct Bench {
        device: SimulatedDevice,
        servo: Servo,
        anchors: Anchors,
        scene: HapticScene,
    }

    impl Bench {
        fn new(legs: Vec<Leg>) -> Self {
            let guide = Guide::Script(HandScript::drawn(DVec3::ZERO, legs));
            Bench {
                device: SimulatedDevice::new(DeviceSpec::OMNI, HandModel::GRIP, guide),
                servo: Servo::new(ServoSettings::of(&DeviceSpec::OMNI)),
                anchors: Anchors::default(),
                scene: HapticScene::default(),
            }
        }

        /// So long; where the handle is then [m], and the last force [N].
        fn run(&mut self, seconds: f64, leads: Leads) -> (DVec3, DVec3) {
            let mut force = DVec3::ZERO;
            for _ in 0..(seconds * 1e3) as u32 {
                let state = self.device.read(0.001);
                self.anchors.step(&state, leads);
                self.anchors.apply(&EffectSet::default(), None, &mut self.scene);
                self.scene.serial += 1;
                let sent = self.servo.tick(&state, &self.scene, 0.001);
                self.device.write(sent);
                force = sent.0;
            }
            (self.device.position(), force)
        }
    }

    #[test]
    fn the_wheel_brings_the_stylus_back_to_where_it_was_opened() {
        let out = DVec3::new(0.02, 0.01, 0.0);
        let mut hand = Bench::new(vec![
            Leg::to(DVec3::ZERO, 1.0),
            Leg::to(out, 0.5).holding(Buttons::REAR),
            // The hand gives way: it would stay, but holds loosely.
            Leg::to(DVec3::new(0.004, 0.0, 0.0), 1.0).holding(Buttons::REAR),
        ]);
        let (opened, _) = hand.run(1.002, Leads::Cue);
        let (_, force) = hand.run(0.45, Leads::Cue);
        assert!(0.5 < -force.normalize().dot(out.normalize()) && 0.3 < force.length(), "{force}");
        let (back, _) = hand.run(1.05, Leads::Cue);
        // Dry friction over stiffness: 0.26 N / 150 N/m, and the hand's own spring.
        assert!(back.distance(opened) < 0.003, "{back} of {opened}");
        assert_eq!(hand.anchors.now.map(|anchor| matches!(anchor, Anchor::Wheel(_))), Some(true));
    }

    #[test]
    fn the_cameras_threshold_is_felt() {
        let mut hand = Bench::new(vec![
            Leg::to(DVec3::ZERO, 1.0),
            Leg::ramp(DVec3::new(0.004, 0.0, 0.0), 1.0),
            Leg::ramp(DVec3::new(0.012, 0.0, 0.0), 1.0),
        ]);
        hand.run(1.0, Leads::Camera);
        let (inside, gentle) = hand.run(1.0, Leads::Camera);
        let (outside, firm) = hand.run(1.0, Leads::Camera);
        assert!(inside.x < THRESHOLD_M && THRESHOLD_M < outside.x, "{inside} {outside}");
        let slope = (gentle.x - firm.x) / (outside.x - inside.x);
        assert!(-0.15 < gentle.x && gentle.x < 0.0, "{gentle}");
        assert!(2.0 * RETURN_STIFFNESS_N_M < slope, "{slope} N/m");
    }

    #[test]
    fn a_device_that_is_lost_or_says_no_numbers_is_held_by_nothing() {
        let mut anchors = Anchors::default();
        let free = DeviceState::default();
        let rear = DeviceState { buttons: Buttons::REAR, ..free };
        // Pressed before anybody looked.
        assert_eq!(anchors.step(&rear, Leads::Cue), None);
        let lost = DeviceState { status: DeviceStatus::Lost, ..rear };
        let nan = DeviceState { position: DVec3::NAN, ..rear };
        for broken in [lost, nan] {
            anchors.step(&free, Leads::Camera);
            assert!(anchors.step(&free, Leads::Camera).is_some());
            assert_eq!(anchors.step(&broken, Leads::Camera), None);
            let elsewhere = DeviceState { position: DVec3::Y, ..rear };
            assert_eq!(anchors.step(&elsewhere, Leads::Camera), Some(Anchor::Camera(DVec3::Y)));
        }
    }

    #[test]
    fn what_holds_the_hand_neither_turns_the_workspace_nor_strikes() {
        let mut anchors = Anchors::default();
        let mut scene = HapticScene::default();
        let rear = DeviceState { buttons: Buttons::REAR, ..DeviceState::default() };
        let free = DeviceState::default();
        let set = EffectSet::of(7, &[Effect::Constant { force: DVec3::X }]);
        assert_eq!(anchors.step(&free, Leads::Cue), None);
        anchors.apply(&set, None, &mut scene);
        assert_eq!((scene.effects, scene.anchor), (set, None));
        let wheel = Anchor::Wheel(DVec3::ZERO);
        assert_eq!(anchors.step(&rear, Leads::Cue), Some(wheel));
        // What it leads may change while the wheel is open; nothing begins before that is over.
        assert_eq!(anchors.step(&rear, Leads::Camera), Some(wheel));
        anchors.apply(&set, None, &mut scene);
        assert_ne!(scene.effects.generation, set.generation);
        assert_eq!(scene.effects.slots.iter().flatten().count(), 2);
        let moved = DeviceState { position: DVec3::X, ..free };
        assert_eq!(anchors.step(&moved, Leads::Camera), Some(Anchor::Camera(DVec3::X)));
        assert_eq!(anchors.step(&free, Leads::Camera), Some(Anchor::Camera(DVec3::X)));
        anchors.apply(&set, None, &mut scene);
        assert_eq!(scene.effects.slots.iter().flatten().count(), 1 + Anchor::EFFECTS);
        assert_eq!(anchors.step(&free, Leads::Pointer), None);
        assert_eq!(anchors.step(&rear, Leads::Pointer), Some(wheel));
        assert_eq!(anchors.step(&free, Leads::Cue), None);
    }
}
