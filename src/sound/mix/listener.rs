//! Who listens, and from where.

use super::surroundings::point;
use glam::Vec3;

/// A step of the head beyond this [m] is a cut to another place, not a movement.
const CUT_M: f32 = 0.5;
/// And so is a turn beyond this, as the cosine: 30°.
const CUT_COS: f32 = 0.866;
/// Where a sound is heard from is reckoned anew beyond this [m],
const STALE_M: f32 = 0.02;
/// and beyond this, as the cosine: 2.5°.
const STALE_COS: f32 = 0.999;
/// How slowly the head follows what is told [s]: poses come once a picture, in steps.
const FOLLOW_S: f32 = 0.025;

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

    /// A head that can be reckoned with, or none.
    fn sane(self) -> Option<Listener> {
        let position_m = point(self.position_m)?;
        Some(Listener { position_m, right: point(self.right)?.try_normalize()? })
    }

    fn is_near(&self, other: &Listener, distance_m: f32, cosine: f32) -> bool {
        let near = self.position_m.distance_squared(other.position_m) < distance_m * distance_m;
        near && self.right.dot(other.right) > cosine
    }

    /// Whether a way reckoned for `self` will do for `other`.
    pub(super) fn hears_as(&self, other: &Listener) -> bool {
        self.is_near(other, STALE_M, STALE_COS)
    }
}

impl Default for Listener {
    /// Above the head end of a table, looking down its length.
    fn default() -> Self {
        Listener { position_m: Vec3::new(-2.0, 0.0, 0.8), right: Vec3::NEG_Y }
    }
}

/// The head on its way to where it was told to be.
#[derive(Debug, Clone, Copy, Default)]
pub struct Follower {
    told: Option<Listener>,
    now: Listener,
}

impl Follower {
    /// Where it is.
    pub fn now(&self) -> Listener {
        self.now
    }

    /// A movement is followed, a cut (and the first place of all) taken at once; what is no place
    /// is ignored.
    pub fn tell(&mut self, listener: Listener) {
        let Some(told) = listener.sane() else { return };
        if self.told.is_none() || !self.now.is_near(&told, CUT_M, CUT_COS) {
            self.now = told;
        }
        self.told = Some(told);
    }

    /// A span of time on.
    pub fn follow(&mut self, span_s: f32) {
        let Some(told) = self.told.filter(|told| *told != self.now) else { return };
        if self.now.is_near(&told, 1e-4, 1.0 - 1e-6) {
            self.now = told;
            return;
        }
        let share = 1.0 - libm::expf(-span_s / FOLLOW_S);
        self.now.position_m = self.now.position_m.lerp(told.position_m, share);
        self.now.right = self.now.right.lerp(told.right, share).normalize_or(told.right);
    }
}
