//! The proxy: a sphere that follows the hand and stays out of everything.
//!
//! It goes where the device would have it, in steps shorter than its radius, so that it never gets
//! through a face; each step slides along at most three planes (Zilles and Salisbury 1995, Ruspini
//! 1997). What it cannot follow is felt as a spring. Friction holds it while the device pulls
//! within the cone of static friction, and lets it slide at the rim of that of sliding friction;
//! it sticks again well within it (CHAI3D's finger proxy, hysteresis 0.6).

use super::obstacles::{Obstacle, Obstacles, Touch};
use glam::DVec3;

/// Longest step as a share of the radius.
const STEP: f64 = 0.5;
/// Most steps in a tick; a tip of 1 cm keeps up with 40 m/s.
const STEPS_MAX: usize = 8;
/// Static over sliding friction.
const STATIC: f64 = 1.3;
/// Share of the cone of sliding friction within which a sliding proxy sticks.
const STICK: f64 = 0.6;
/// The proxy has arrived if it is this near [m].
const ARRIVED_M: f64 = 1e-9;

/// The planes that the proxy lies against.
#[derive(Debug, Clone, Copy, Default)]
struct Planes {
    normals: [DVec3; 3],
    count: usize,
}

impl Planes {
    fn add(&mut self, normal: DVec3) {
        let is_known = self.normals[..self.count].iter().any(|n| n.dot(normal) > 0.999_999);
        if is_known {
            return;
        }
        // A fourth plane takes the place of the oldest.
        if self.count == self.normals.len() {
            self.normals.rotate_left(1);
            self.count -= 1;
        }
        self.normals[self.count] = normal;
        self.count += 1;
    }

    /// What of a way does not lead into a plane.
    fn slid(&self, mut way: DVec3) -> DVec3 {
        let planes = &self.normals[..self.count];
        for _ in 0..4 {
            for normal in planes {
                way -= *normal * way.dot(*normal).min(0.0);
            }
        }
        way
    }
}

/// What the proxy met in a tick.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Met {
    /// What it lies against; the last that pushed it.
    pub obstacle: Option<Obstacle>,
    /// Unit vector out of that.
    pub normal: DVec3,
    /// It did not lie against anything before.
    pub is_new: bool,
}

/// The proxy.
#[derive(Debug, Clone, Default)]
pub(super) struct Proxy {
    centre: DVec3,
    is_laid: bool,
    is_touching: bool,
    slides: bool,
}

impl Proxy {
    /// Its centre [m].
    pub fn centre(&self) -> DVec3 {
        self.centre
    }

    /// Forgets where it was: the next tick lays it anew.
    pub fn lift(&mut self) {
        self.is_laid = false;
        self.is_touching = false;
    }

    /// It is here now, whatever it was at.
    pub fn lay(&mut self, at: DVec3) {
        *self = Proxy { centre: at, is_laid: true, ..Proxy::default() };
    }

    /// Follows the hand to `target`.
    pub fn follow(
        &mut self,
        target: DVec3,
        radius_m: f64,
        friction: f64,
        obstacles: &Obstacles<'_>,
    ) -> Met {
        if !self.is_laid {
            (self.centre, self.is_laid) = (target, true);
        }
        // What moved into it pushes it away first.
        let mut met = Met::default();
        let side = (self.centre - target).normalize_or(DVec3::Z);
        let (start, mut planes) = out(self.centre, radius_m, side, obstacles, &mut met);

        let mut centre = start;
        for _ in 0..STEPS_MAX {
            let way = planes.slid(target - centre);
            if way.length() < ARRIVED_M {
                break;
            }
            let step = way.clamp_length_max(STEP * radius_m);
            let tried = centre + step;
            let side = -step.normalize_or(DVec3::NEG_Z);
            let next;
            (next, planes) = out(tried, radius_m, side, obstacles, &mut met);
            let moved = next - centre;
            centre = next;
            if moved.length() < ARRIVED_M {
                break;
            }
        }
        let pressed = target - centre;
        let touches = met.obstacle.is_some() && pressed.length() > ARRIVED_M;
        if touches && self.is_touching {
            centre = self.rubbed(start, centre, pressed.length(), friction);
            let side = -pressed.normalize_or(DVec3::NEG_Z);
            centre = out(centre, radius_m, side, obstacles, &mut met).0;
        } else {
            self.slides = false;
        }
        met.is_new = touches && !self.is_touching;
        if !touches {
            met.obstacle = None;
        }
        (self.centre, self.is_touching) = (centre, touches);
        met
    }

    /// Where friction leaves the proxy on its way from `start` to `free`, where it would be without
    /// any: `pull` is how far the device is from there, which is how hard it presses.
    fn rubbed(&mut self, start: DVec3, free: DVec3, pull: f64, friction: f64) -> DVec3 {
        let way = free - start;
        let holds = pull * friction * if self.slides { STICK } else { STATIC };
        if way.length() <= holds {
            self.slides = false;
            return start;
        }
        self.slides = true;
        free - way.clamp_length_max(pull * friction)
    }
}

/// The sphere moved out of everything, and the planes that it lies against then.
fn out(
    centre: DVec3,
    radius_m: f64,
    side: DVec3,
    obstacles: &Obstacles<'_>,
    met: &mut Met,
) -> (DVec3, Planes) {
    let mut planes = Planes::default();
    let centre = obstacles.pushed_out(centre, radius_m, side, |touch: &Touch| {
        planes.add(touch.normal);
        (met.obstacle, met.normal) = (Some(touch.obstacle), touch.normal);
    });
    (centre, planes)
}
