//! The places of two eyes.

use crate::input::CameraPose;
use crate::picture::Stereo;
use glam::DVec3;

/// How far eyes are from each other [m].
const EYES_M: f64 = 0.063;
/// They look at things that are at least so many times farther away than from each other: from
/// nearer, nobody can bring both pictures together.
const FARTHER: f64 = 32.0;

/// The left and the right eye of somebody whose single eye would be at `pose`; both look at what
/// that looks at.
pub fn eyes(pose: &CameraPose, stereo: Stereo) -> Option<[CameraPose; 2]> {
    let (left, right) = match stereo {
        Stereo::Off => return None,
        Stereo::Left => (0.0, 1.0),
        Stereo::Middle => (-0.5, 0.5),
        Stereo::Right => (-1.0, 0.0),
    };
    let ahead = pose.target - pose.eye;
    let apart_m = EYES_M.min(ahead.length() / FARTHER);
    let aside = ahead.cross(DVec3::Z).normalize_or_zero() * apart_m;
    Some([left, right].map(|by| CameraPose { eye: pose.eye + aside * by, ..*pose }))
}
