//! The camera of somebody who holds a haptic device: behind the workspace, which it sees whole
//! (paper, section 3.3.3).

use super::felt::FeltTool;
use crate::haptic::WorkspacePose;
use crate::input::{CameraPose, Look};
use crate::units::Seconds;
use glam::{DQuat, DVec3};

/// The eye in the device frame, and what it looks at [m]: above and behind the box, straight behind
/// a cue.
const EYE_M: DVec3 = DVec3::new(0.0, 0.105, 0.27);
const TARGET_M: DVec3 = DVec3::new(0.0, -0.004, -0.03);
/// A stylus would hide what it touches: the eye is aside.
const ASIDE_EYE_M: DVec3 = DVec3::new(0.075, 0.13, 0.24);
/// While balls roll it is farther away and higher, and looks farther ahead.
const ROLLING_EYE_M: DVec3 = DVec3::new(0.0, 0.45, 0.6);
const ROLLING_TARGET_M: DVec3 = DVec3::new(0.0, -0.04, -0.45);
/// Lowest and highest eye [rad]: never straight above what it looks at.
const RISE_RAD: (f64, f64) = (-0.6, 1.45);
/// The eye stays above the floor by this [m].
const FLOOR_M: f64 = 0.03;
/// Time constant in which it follows a workspace that is laid elsewhere [s].
const FOLLOW_S: Seconds = 0.12;

/// The camera.
#[derive(Debug, Clone)]
pub struct FeltEye {
    usual: DVec3,
    shown: Option<CameraPose>,
}

impl FeltEye {
    /// The eye of somebody who holds this tool.
    pub fn new(tool: FeltTool) -> Self {
        let usual = match tool {
            FeltTool::Stylus => ASIDE_EYE_M,
            FeltTool::Cue => EYE_M,
        };
        FeltEye { usual, shown: None }
    }

    /// The picture `dt` after the last one, where `wanted` is the place to be.
    pub fn follow(&mut self, wanted: CameraPose, dt: Seconds) -> CameraPose {
        let share = -libm::expm1(-dt.max(0.0) / FOLLOW_S);
        let shown = self.shown.map_or(wanted, |shown| CameraPose {
            eye: shown.eye.lerp(wanted.eye, share),
            target: shown.target.lerp(wanted.target, share),
            ..wanted
        });
        self.shown = Some(shown);
        shown
    }

    /// Behind a workspace, and farther away while balls roll.
    pub fn behind(&self, workspace: &WorkspacePose, look: &Look, is_rolling: bool) -> CameraPose {
        let (eye, target) =
            if is_rolling { (ROLLING_EYE_M, ROLLING_TARGET_M) } else { (self.usual, TARGET_M) };
        // Turned, raised and zoomed about what is looked at.
        let offset = (eye - target) * look.zoom;
        let level = libm::hypot(offset.x, offset.z);
        let rise = libm::atan2(offset.y, level);
        let to = (rise + look.rise_rad).clamp(RISE_RAD.0, RISE_RAD.1);
        let turned =
            DQuat::from_rotation_y(look.turn_rad) * DQuat::from_rotation_x(rise - to) * offset;
        let mut eye = workspace.to_world(target + turned);
        eye.z = eye.z.max(FLOOR_M);
        CameraPose { eye, target: workspace.to_world(target), ..CameraPose::default() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DMat3;

    fn workspace(azimuth_rad: f64, at: DVec3) -> WorkspacePose {
        let (sin, cos) = libm::sincos(azimuth_rad);
        let (right, ahead) = (DVec3::new(sin, -cos, 0.0), DVec3::new(cos, sin, 0.0));
        let turn = DMat3::from_cols(right, right.cross(ahead), -ahead);
        WorkspacePose { origin: at, turn, scale: 2.0, pivot: at, tip_radius_m: 0.01 }
    }

    #[test]
    fn the_eye_sees_the_whole_box_from_behind_however_it_is_turned() {
        let half = DVec3::new(0.08, 0.06, 0.035);
        let tools = [FeltTool::Stylus, FeltTool::Cue];
        for (tool, azimuth_rad) in tools.into_iter().flat_map(|t| [0.0, 1.0, -2.5].map(|a| (t, a)))
        {
            let workspace = workspace(azimuth_rad, DVec3::new(0.3, -0.2, 0.5));
            let pose = FeltEye::new(tool).behind(&workspace, &Look::default(), false);
            let ahead = (pose.target - pose.eye).normalize();
            // As the stylus points, and from above.
            assert!(ahead.dot(-workspace.turn.z_axis) > 0.8 && pose.eye.z > pose.target.z);
            for k in 0..8_u8 {
                let sign = |bit: u8| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
                let corner = workspace.to_world(half * DVec3::new(sign(0), sign(1), sign(2)));
                let way = corner - pose.eye;
                let right = ahead.cross(DVec3::Z).normalize();
                let size = libm::tan(0.5 * pose.field_of_view_rad) * way.dot(ahead);
                // In a picture of 16 to 9.
                assert!(way.dot(right.cross(ahead)).abs() < size, "{tool:?} {corner}");
                assert!(way.dot(right).abs() < 16.0 / 9.0 * size, "{tool:?} {corner}");
            }
        }
    }

    #[test]
    fn a_workspace_that_jumps_is_followed_smoothly_and_reached() {
        let mut eye = FeltEye::new(FeltTool::Cue);
        let (here, there) = (workspace(0.0, DVec3::ZERO), workspace(1.0, DVec3::X));
        let look = Look::default();
        let first = eye.follow(eye.behind(&here, &look, false), 0.0);
        assert_eq!(first, eye.behind(&here, &look, false));
        let next = eye.follow(eye.behind(&there, &look, false), 0.016);
        let whole = eye.behind(&there, &look, false).eye.distance(first.eye);
        assert!(next.eye.distance(first.eye) < 0.2 * whole);
        for _ in 0..120 {
            eye.follow(eye.behind(&there, &look, false), 0.016);
        }
        assert!(eye.shown.unwrap().eye.distance(eye.behind(&there, &look, false).eye) < 1e-4);
    }

    #[test]
    fn looking_round_keeps_what_is_looked_at() {
        let workspace = workspace(0.0, DVec3::Z);
        let eye = FeltEye::new(FeltTool::Cue);
        let usual = eye.behind(&workspace, &Look::default(), false);
        let look = Look { turn_rad: 0.5, rise_rad: 0.3, zoom: 2.0, ..Look::default() };
        let turned = eye.behind(&workspace, &look, false);
        assert_eq!(turned.target, usual.target);
        let [near, far] = [usual, turned].map(|pose| pose.eye.distance(pose.target));
        assert!((far / near - 2.0).abs() < 1e-9);
        assert!(turned.eye.z - turned.target.z > 2.0 * (usual.eye.z - usual.target.z));
    }
}
