//! OpenHaptics devices: what their HD library says of a device and of a moment. No library is here.
//!
//! Its units are mm, mm/s, N, N/mm and N s/mm, its axes those of the device frame. Nothing that it
//! says is taken as it comes: where it is out of all reason, the numbers of an Omni stand in.

use super::device::{Buttons, DeviceSpec, DeviceState, DeviceStatus};
use crate::one_line::one_line;
use glam::{DMat3, DQuat, DVec3};
use std::ops::RangeInclusive;

/// Metres in a millimetre.
const MM: f64 = 1e-3;
/// Buttons that a device may have.
const BUTTONS: i32 = 0xF;
/// The longest text that is shown [characters].
const TEXT_MAX: usize = 100;
/// How far from length 1 an axis of a rotation may be.
const UNIT: f64 = 0.1;

/// What the library says of a device; none where it complains.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct HdLimits {
    /// Left, bottom, back, right, top, front [mm].
    pub workspace_mm: [f64; 6],
    /// Largest force [N].
    pub force_max_n: Option<f64>,
    /// Largest force for a long time [N].
    pub force_continuous_n: Option<f64>,
    /// Largest stiffness [N/mm].
    pub stiffness_max_n_mm: Option<f64>,
    /// Largest damping [N s/mm].
    pub damping_max_ns_mm: Option<f64>,
    /// How often it calls [Hz].
    pub rate_hz: f64,
    /// In how many ways it senses: 3 places, and 3 angles.
    pub input_dof: i32,
}

impl HdLimits {
    /// The device. Friction is not reported: only devices whose friction is published are credited
    /// with it, since it allows more stiffness.
    pub fn spec(&self, model: &'static str) -> DeviceSpec {
        let usual = DeviceSpec::OMNI;
        let limit = |said: Option<f64>, unit: f64, range: RangeInclusive<f64>, usual: f64| {
            said.map(|said| said * unit).filter(|said| range.contains(said)).unwrap_or(usual)
        };
        let force_max_n = limit(self.force_max_n, 1.0, 0.1..=50.0, usual.force_max_n);
        let force_continuous_n =
            limit(self.force_continuous_n, 1.0, 0.01..=50.0, usual.force_continuous_n);
        let is_known = ["omni", "touch"].iter().any(|name| model.to_lowercase().contains(name));
        DeviceSpec {
            model: if model.is_empty() { "OpenHaptics" } else { model },
            workspace_m: self.size_m().unwrap_or(usual.workspace_m),
            force_max_n,
            force_continuous_n: force_continuous_n.min(force_max_n),
            stiffness_max_n_m: limit(
                self.stiffness_max_n_mm,
                1.0 / MM,
                10.0..=10_000.0,
                usual.stiffness_max_n_m,
            ),
            damping_max_ns_m: limit(
                self.damping_max_ns_mm,
                1.0 / MM,
                0.1..=100.0,
                usual.damping_max_ns_m,
            ),
            friction_n: if is_known { usual.friction_n } else { 0.0 },
            rate_hz: rate_hz(self.rate_hz).unwrap_or(usual.rate_hz),
            senses_orientation: self.input_dof >= 6,
            has_own_scheduler: true,
            ..usual
        }
    }

    /// The middle of its workspace, in the library's frame [m]; the origin if that is no box.
    pub fn centre_m(&self) -> DVec3 {
        let low = DVec3::from_slice(&self.workspace_mm[..3]) * MM;
        self.size_m().map_or(DVec3::ZERO, |size| low + 0.5 * size)
    }

    /// Width, height and depth [m]; none if it is no box near the device.
    fn size_m(&self) -> Option<DVec3> {
        let (low, high) = self.workspace_mm.split_at(3);
        let (low, high) = (DVec3::from_slice(low) * MM, DVec3::from_slice(high) * MM);
        let fits = |side: f64| (0.01..=2.0).contains(&side);
        let is_box = (high - low).to_array().into_iter().all(fits);
        (is_box && low.abs().max_element() <= 10.0).then_some(high - low)
    }
}

/// A rate that a servo can run at [Hz].
pub fn rate_hz(said: f64) -> Option<f64> {
    (10.0..=20_000.0).contains(&said).then_some(said)
}

/// A name or version, in one line.
pub fn told(text: &str) -> String {
    one_line(text.trim(), TEXT_MAX)
}

/// What the library says of one moment.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct HdReading {
    /// Where the tip is [mm].
    pub position_mm: [f64; 3],
    /// Its velocity [mm/s].
    pub velocity_mm_s: [f64; 3],
    /// Rotation and place, column by column.
    pub transform: [f64; 16],
    /// A bit for each button held: the front one, the rear one.
    pub buttons: i32,
}

impl HdReading {
    /// The reading of a device that works, around `centre_m` [m]. Numbers that are none stay so,
    /// for the servo to refuse; a rotation is always one.
    pub fn state(&self, spec: &DeviceSpec, centre_m: DVec3) -> DeviceState {
        DeviceState {
            position: DVec3::from_array(self.position_mm) * MM - centre_m,
            velocity: DVec3::from_array(self.velocity_mm_s) * MM,
            orientation: match spec.senses_orientation {
                true => orientation(&self.transform),
                false => DQuat::IDENTITY,
            },
            buttons: Buttons(u8::try_from(self.buttons & BUTTONS).unwrap_or(0)),
            status: DeviceStatus::Ready,
        }
    }
}

/// Rotation of a transform; none for three axes that are none.
fn orientation(m: &[f64; 16]) -> DQuat {
    let column = |i: usize| DVec3::new(m[i], m[i + 1], m[i + 2]);
    let columns = [column(0), column(4), column(8)];
    let are_units = columns.iter().all(|axis| (axis.length() - 1.0).abs() < UNIT);
    let axes = DMat3::from_cols(columns[0], columns[1], columns[2]);
    match are_units && axes.determinant() > 0.5 {
        true => DQuat::from_mat3(&axes).normalize(),
        false => DQuat::IDENTITY,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_transform_turns_the_stylus_as_its_columns_say() {
        // A quarter turn to the left about y: the stylus, which points along -z, points along -x.
        let left = [
            0.0, 0.0, -1.0, 0.0, //
            0.0, 1.0, 0.0, 0.0, //
            1.0, 0.0, 0.0, 0.0, //
            10.0, 20.0, 30.0, 1.0,
        ];
        let pointing = orientation(&left) * DVec3::NEG_Z;
        assert!((pointing - DVec3::NEG_X).length() < 1e-12, "{pointing}");
        assert_eq!(orientation(&[0.0; 16]), DQuat::IDENTITY);
        assert_eq!(orientation(&[f64::NAN; 16]), DQuat::IDENTITY);
        assert_eq!(orientation(&left.map(|number| 1e200 * number)), DQuat::IDENTITY);
    }

    #[test]
    fn numbers_out_of_all_reason_are_those_of_an_omni() {
        let said = HdLimits {
            workspace_mm: [-100.0, -50.0, -20.0, 100.0, 50.0, 40.0],
            force_max_n: Some(7.9),
            force_continuous_n: Some(30.0),
            stiffness_max_n_mm: Some(f64::NAN),
            damping_max_ns_mm: None,
            rate_hz: 1e9,
            input_dof: 6,
        };
        let spec = said.spec("Phantom");
        assert!((spec.workspace_m - DVec3::new(0.2, 0.1, 0.06)).length() < 1e-12, "{spec:?}");
        assert!((said.centre_m() - 0.01 * DVec3::Z).length() < 1e-12, "{}", said.centre_m());
        assert_eq!((spec.force_max_n, spec.force_continuous_n), (7.9, 7.9));
        assert_eq!(spec.stiffness_max_n_m, DeviceSpec::OMNI.stiffness_max_n_m);
        assert_eq!((spec.rate_hz, spec.friction_n), (1000.0, 0.0));
        let far = HdLimits { workspace_mm: [1e9, 0.0, 0.0, 1e9 + 100.0, 100.0, 100.0], ..said };
        assert_eq!(far.spec("").workspace_m, DeviceSpec::OMNI.workspace_m);
        assert_eq!(far.centre_m(), DVec3::ZERO);
    }
}
