//! The messages of a service as they are written.

use super::to_device;
use crate::haptic::device::Buttons;
use glam::{DQuat, DVec3};
use serde::Deserialize;
use serde::de::IgnoredAny;

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Message {
    pub inverse3: Option<Vec<Arm>>,
    pub wireless_verse_grip: Option<Vec<Grip>>,
    pub custom_verse_grip: Option<Vec<Grip>>,
    pub verse_grip: Option<Vec<Grip>>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Arm {
    pub device_id: String,
    pub config: Option<Config>,
    pub state: Option<ArmState>,
    pub status: Option<ArmStatus>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Config {
    #[serde(rename = "type")]
    pub kind: Option<String>,
    pub basis: Option<Basis>,
    pub coordinate_origin: Option<String>,
    pub preset: Option<IgnoredAny>,
    pub mount: Option<IgnoredAny>,
    pub filters: Option<IgnoredAny>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Basis {
    pub permutation: Option<String>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct ArmState {
    pub cursor_position: Option<Place>,
    pub cursor_velocity: Option<Place>,
    pub body_orientation: Option<Turn>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct ArmStatus {
    pub calibrated: Option<bool>,
    pub power_supply: Option<bool>,
    pub ready: Option<bool>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Place {
    pub x: Option<f64>,
    pub y: Option<f64>,
    pub z: Option<f64>,
}

impl Place {
    pub fn numbers(&self) -> DVec3 {
        let [x, y, z] = [self.x, self.y, self.z].map(|number| number.unwrap_or(f64::NAN));
        DVec3::new(x, y, z)
    }
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Turn {
    pub x: Option<f64>,
    pub y: Option<f64>,
    pub z: Option<f64>,
    pub w: Option<f64>,
}

/// How far from length 1 a quaternion may be.
const UNIT: f64 = 0.1;

impl Turn {
    /// None if it is no rotation.
    pub fn turned(&self) -> Option<DQuat> {
        let axis = to_device(DVec3::new(self.x?, self.y?, self.z?));
        let turned = DQuat::from_xyzw(axis.x, axis.y, axis.z, self.w?);
        ((turned.length() - 1.0).abs() < UNIT).then(|| turned.normalize())
    }
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Grip {
    pub state: Option<GripState>,
    pub status: Option<GripStatus>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct GripStatus {
    pub connected: Option<bool>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct GripState {
    pub orientation: Option<Turn>,
    pub buttons: Option<GripButtons>,
    /// A grip with a cable has but one.
    pub button: Option<bool>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct GripButtons {
    pub a: Option<bool>,
    pub b: Option<bool>,
}

impl Grip {
    pub fn is_there(&self) -> bool {
        self.status.as_ref().and_then(|status| status.connected) != Some(false)
    }
}

impl GripState {
    /// Button a strikes, b opens the menu.
    pub fn held(&self) -> Buttons {
        let buttons = self.buttons.as_ref();
        let front = self.button.or(buttons.and_then(|buttons| buttons.a));
        let rear = buttons.and_then(|buttons| buttons.b);
        [(front, Buttons::FRONT), (rear, Buttons::REAR)].into_iter().fold(
            Buttons::default(),
            |held, (down, button)| if down == Some(true) { held.with(button) } else { held },
        )
    }
}
