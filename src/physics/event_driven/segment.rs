//! The universal currency of the solver: a stretch of motion whose path is a quadratic in time.
//!
//! Every kind of motion, exact or approximated, is handed to detection in this form; only the
//! producers differ. A ball keeps its own start time and is evaluated when somebody asks, so balls
//! that nothing happens to cost nothing and gather no rounding.

use super::swing::Swing;
use crate::ball::{BallPlace, BallState, Motion};
use crate::hash::StateHash;
use crate::ids::BallId;
use crate::physics::spring;
use crate::units::Seconds;
use glam::{DQuat, DVec3};

/// What law a segment follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Course {
    /// Neither moves nor spins.
    Rest,
    /// Hops too low to be followed one by one; at rest when the series has ended.
    Settling,
    /// Stands and spins.
    Spinning,
    /// Rolls.
    Rolling,
    /// Slides.
    Sliding,
    /// Nothing carries it.
    Flying,
    /// Swings on its spring.
    Springing,
    /// A short piece of what has no closed form: pivoting on a rim, wedged, sliding down a slope.
    Lasting,
}

/// A stretch of a ball's motion: x + v τ + ½ a τ², τ from its start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// When it begins [s].
    pub start_s: Seconds,
    /// When its law ends by itself [s]; may be infinite.
    pub end_s: Seconds,
    /// Centre at its start [m].
    pub position: DVec3,
    /// Velocity at its start [m/s].
    pub velocity: DVec3,
    /// Acceleration [m/s²].
    pub acceleration: DVec3,
    /// Angular velocity at its start [rad/s].
    pub angular_velocity: DVec3,
    /// Angular acceleration but for the decay of the spin about `normal` [rad/s²].
    pub angular_acceleration: DVec3,
    /// Unit normal of what carries the ball.
    pub normal: DVec3,
    /// Deceleration of the spin about `normal`, which ends at zero [rad/s²].
    pub spin_deceleration: f64,
    /// Orientation at its start.
    pub orientation: DQuat,
    /// Its law.
    pub course: Course,
    /// The spring that it swings on; then the path is the spring's, exactly, and the accelerations
    /// are those at the start.
    pub swing: Option<Swing>,
}

impl Segment {
    /// A ball that stands still for ever.
    pub fn still(at: Seconds, position: DVec3, orientation: DQuat) -> Self {
        Segment {
            start_s: at,
            end_s: f64::INFINITY,
            position,
            velocity: DVec3::ZERO,
            acceleration: DVec3::ZERO,
            angular_velocity: DVec3::ZERO,
            angular_acceleration: DVec3::ZERO,
            normal: DVec3::Z,
            spin_deceleration: 0.0,
            orientation,
            course: Course::Rest,
            swing: None,
        }
    }

    /// Centre at `at` [m].
    #[inline]
    pub fn position_at(&self, at: Seconds) -> DVec3 {
        let t = at - self.start_s;
        match &self.swing {
            None => self.position + (self.velocity + self.acceleration * (0.5 * t)) * t,
            Some(swing) => swing.way_after(self, t).0,
        }
    }

    /// Velocity at `at` [m/s].
    #[inline]
    pub fn velocity_at(&self, at: Seconds) -> DVec3 {
        let t = at - self.start_s;
        match &self.swing {
            None => self.velocity + self.acceleration * t,
            Some(swing) => swing.way_after(self, t).1,
        }
    }

    /// Whether the path is that of a spring, and no parabola.
    pub fn swings(&self) -> bool {
        self.swing.is_some_and(|swing| swing.linear.is_some())
    }

    /// Spin about the normal after `t` of the segment [rad/s], and the angle turned by it [rad].
    fn spin_after(&self, t: Seconds) -> (f64, f64) {
        let spin = self.angular_velocity.dot(self.normal);
        if self.spin_deceleration == 0.0 {
            return (spin, spin * t);
        }
        let stops = spin.abs() / self.spin_deceleration;
        if t >= stops {
            (0.0, 0.5 * spin * stops)
        } else {
            let left = spin - self.spin_deceleration.copysign(spin) * t;
            (left, 0.5 * (spin + left) * t)
        }
    }

    /// Angular velocity at `at` [rad/s].
    pub fn angular_velocity_at(&self, at: Seconds) -> DVec3 {
        let t = at - self.start_s;
        if let Some(swing) = &self.swing {
            return swing.turn_after(self, t).1;
        }
        let base = self.angular_velocity + self.angular_acceleration * t;
        if self.spin_deceleration == 0.0 {
            return base;
        }
        let spin = self.angular_velocity.dot(self.normal);
        base + self.normal * (self.spin_after(t).0 - spin)
    }

    /// Orientation at `at`; for display.
    ///
    /// The rotation vector ∫ω dt + t³/12 (α × ω) (Magnus, fourth order); exact while the axis keeps
    /// its direction, as in rolling and spinning.
    pub fn orientation_at(&self, at: Seconds) -> DQuat {
        let t = at - self.start_s;
        if t <= 0.0 || self.course == Course::Rest {
            return self.orientation;
        }
        if let Some(swing) = &self.swing {
            let angle = swing.turn_after(self, t).0;
            return spring::turned(swing.anchor, angle, 1.0);
        }
        let (alpha, omega) = (self.angular_acceleration, self.angular_velocity);
        let spin = omega.dot(self.normal);
        let mean = omega * t
            + alpha * (0.5 * t * t)
            + self.normal * (self.spin_after(t).1 - spin * t)
            + alpha.cross(omega) * (t * t * t / 12.0);
        spring::turned(self.orientation, mean, 1.0)
    }

    /// The state of the ball at `at`.
    pub fn state(&self, id: BallId, place: BallPlace, at: Seconds) -> BallState {
        BallState {
            id,
            position: self.position_at(at),
            velocity: self.velocity_at(at),
            angular_velocity: self.angular_velocity_at(at),
            orientation: self.orientation_at(at),
            motion: self.motion(at),
            place,
        }
    }

    /// How the ball moves at `at`.
    pub fn motion(&self, at: Seconds) -> Motion {
        match self.course {
            Course::Rest => Motion::Rest,
            Course::Spinning if at >= self.end_s => Motion::Rest,
            Course::Spinning => Motion::Spinning,
            Course::Rolling => Motion::Rolling,
            Course::Sliding => Motion::Sliding,
            Course::Flying | Course::Settling | Course::Springing => Motion::Airborne,
            Course::Lasting if self.velocity == DVec3::ZERO => Motion::Rest,
            Course::Lasting => Motion::Sliding,
        }
    }

    /// Adds everything that decides its future to `hash`.
    pub fn hash(&self, hash: &mut StateHash) {
        hash.f64(self.start_s);
        hash.f64(self.end_s);
        hash.u64(self.course as u64);
        hash.vec3(self.position);
        hash.vec3(self.velocity);
        hash.vec3(self.acceleration);
        hash.vec3(self.angular_velocity);
        hash.vec3(self.angular_acceleration);
        hash.quat(self.orientation);
    }
}
