//! Who listens, and from where.

use glam::Vec3;

/// A head: where it is and which way its ears point.
///
/// The head is a sphere: it cannot tell front from back, so that one axis is all there is to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Listener {
    /// Middle between the ears [m].
    pub position_m: Vec3,
    /// From the left ear to the right one, a unit vector.
    pub right: Vec3,
}

impl Listener {
    /// A camera's head: eye at `eye_m`, looking along `forward`, with `up` somewhere above.
    pub fn looking(eye_m: Vec3, forward: Vec3, up: Vec3) -> Listener {
        Listener { position_m: eye_m, right: forward.cross(up).normalize_or(Vec3::NEG_Y) }
    }
}

impl Default for Listener {
    /// Above the head end of a table, looking down its length.
    fn default() -> Self {
        Listener { position_m: Vec3::new(-2.0, 0.0, 0.8), right: Vec3::NEG_Y }
    }
}
