//! A ball on its spring: its motion in closed form, and how far that reaches.
//!
//! x″ = −ω² (x − x_rest) − 2 σ x′ holds for any time, so a swing is one segment until it has died
//! away or something touches the ball. Its energy never grows, hence |x − x_rest| never exceeds
//! A = √(|x|² + |x′|²/ω²); along any unit vector the same holds for the components. What is farther
//! away than that is not looked for ([`super::swing_meets`]).

use super::segment::{Course, Segment};
use crate::ball::{Ball, Spring};
use crate::physics::Parameters;
use crate::physics::laws::Mover;
use crate::physics::spring::{Damped, rotation_vector};
use crate::units::Seconds;
use glam::{DQuat, DVec3};

/// A swing of less speed, offset times frequency included, is over [m/s].
const OVER_M_S: f64 = 1e-10;

/// And so is what rounding makes of a place: so many of its last digits.
const DIGITS: f64 = 16.0 * f64::EPSILON;

/// How far a parabola may be off the swing that it stands for [m].
const PARABOLA_M: f64 = 1e-8;

/// Most of a swing that one parabola stands for, over 1/ω; and longest [s].
const PIECE: (f64, Seconds) = (0.5, 1.0);

/// A ball on springs and dampers, about a point of rest.
///
/// The angular part is exact while the ball turns about one axis; else it holds for small angles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Swing {
    /// Where the forces balance [m]; for a damper alone where the segment begins.
    pub rest: DVec3,
    /// How fast that moves [m/s]: what weighs falls evenly through a damper.
    pub drift: DVec3,
    /// Of the path; none if the ball flies as without springs.
    pub linear: Option<Damped>,
    /// Of the turning; none if there is neither spring nor damper.
    pub angular: Option<Damped>,
    /// The orientation that it pulls to.
    pub anchor: DQuat,
}

impl Swing {
    /// Position and velocity after `t` of the segment.
    pub fn way_after(&self, segment: &Segment, t: Seconds) -> (DVec3, DVec3) {
        match &self.linear {
            Some(damped) => {
                let (offset, speed) = self.start(segment);
                let (offset, speed) = damped.after(offset, speed, t);
                (self.rest + self.drift * t + offset, self.drift + speed)
            }
            None => {
                let Segment { position, velocity, acceleration, .. } = *segment;
                (position + (velocity + acceleration * (0.5 * t)) * t, velocity + acceleration * t)
            }
        }
    }

    /// Rotation vector from the anchor, and angular velocity, after `t` of the segment.
    pub fn turn_after(&self, segment: &Segment, t: Seconds) -> (DVec3, DVec3) {
        let angle = self.angle(segment);
        let spin = segment.angular_velocity;
        self.angular.map_or((angle + spin * t, spin), |damped| damped.after(angle, spin, t))
    }

    /// Offset and speed at the segment's start, seen from the point of rest.
    fn start(&self, segment: &Segment) -> (DVec3, DVec3) {
        (segment.position - self.rest, segment.velocity - self.drift)
    }

    fn angle(&self, segment: &Segment) -> DVec3 {
        rotation_vector(segment.orientation * self.anchor.inverse())
    }

    /// How far from the point of rest the ball ever gets, along a unit vector [m].
    pub fn reach_along_m(&self, segment: &Segment, direction: DVec3) -> f64 {
        let (offset, speed) = self.start(segment);
        self.reach_m(offset.dot(direction), speed.dot(direction))
    }

    /// How far from the point of rest the ball ever gets [m].
    pub fn reach_all_m(&self, segment: &Segment) -> f64 {
        let (offset, speed) = self.start(segment);
        self.reach_m(offset.length(), speed.length())
    }

    fn reach_m(&self, offset: f64, speed: f64) -> f64 {
        let omega = self.linear.map_or(0.0, |damped| damped.omega);
        if omega == 0.0 { f64::INFINITY } else { libm::hypot(offset, speed / omega) }
    }

    /// No smaller than the ball's speed ever gets [m/s].
    pub fn haste_m_s(&self, segment: &Segment) -> f64 {
        let (offset, speed) = self.start(segment);
        let omega = self.linear.map_or(0.0, |damped| damped.omega);
        libm::hypot(offset.length() * omega, speed.length()) + self.drift.length()
    }

    /// How much of the swing is left: of the path [m/s] and of the turning [rad/s], each over what
    /// counts as nothing.
    fn left(&self, segment: &Segment, radius_m: f64) -> (f64, f64) {
        let path = self.linear.map_or(f64::INFINITY, |damped| {
            let (offset, speed) = self.start(segment);
            let nothing = OVER_M_S.max(DIGITS * damped.omega * self.rest.length());
            (offset.length() * damped.omega + speed.length()) / nothing
        });
        let spin = segment.angular_velocity.length();
        let turning = match &self.angular {
            Some(damped) => {
                let nothing = (OVER_M_S / radius_m).max(DIGITS * damped.omega);
                (self.angle(segment).length() * damped.omega + spin) / nothing
            }
            None if spin == 0.0 => 0.0,
            None => f64::INFINITY,
        };
        (path, turning)
    }

    /// How long the swing lasts, or at least when it is worth another look [s].
    fn lasts_s(&self, (path, turning): (f64, f64)) -> Seconds {
        let dies = |left: f64, damped: &Option<Damped>| {
            let decay = damped.map_or(0.0, |damped| damped.decay());
            // One more for what is no plain exponential.
            if left <= 1.0 { 0.0 } else { (1.0 + libm::log(left)) / decay }
        };
        let drifts = self.drift != DVec3::ZERO;
        let path = if drifts { f64::INFINITY } else { dies(path, &self.linear) };
        path.max(dies(turning, &self.angular))
    }
}

/// What a spring with its dampers makes of a ball's path and of its turning.
fn damped(ball: &Ball, spring: &Spring) -> (Option<Damped>, Option<Damped>) {
    let inertia = ball.inertia_kg_m2();
    (
        Damped::new(ball.mass_kg, spring.stiffness_n_m, spring.damping_ns_m),
        Damped::new(inertia, spring.angular_stiffness_nm_rad, spring.angular_damping_nms_rad),
    )
}

/// A ball that flies as `start` says, if it has a spring or a damper: it swings, or hangs at rest.
///
/// Weight only shifts the point of rest, by g/ω²; through a damper alone it falls evenly at g/(2 σ)
/// in the end.
pub fn on_spring(start: &Segment, ball: &Ball, parameters: &Parameters) -> Option<Segment> {
    let spring = ball.spring.as_ref().filter(|_| ball.flags.integrate)?;
    let (linear, angular) = damped(ball, spring);
    if linear.is_none() && angular.is_none() {
        return None;
    }
    let weighs = ball.flags.gravity && parameters.gravity_m_s2 > 0.0;
    let weight = DVec3::NEG_Z * if weighs { parameters.gravity_m_s2 } else { 0.0 };
    let (rest, drift) = match &linear {
        Some(Damped { omega: 0.0, sigma }) => (start.position, weight / (2.0 * sigma)),
        Some(Damped { omega, .. }) => (spring.anchor_m + weight / (omega * omega), DVec3::ZERO),
        None => (start.position, DVec3::ZERO),
    };
    let swing = Swing { rest, drift, linear, angular, anchor: spring.anchor_orientation };
    let Some(damped) = &linear else {
        return Some(Segment { swing: Some(swing), ..*start });
    };
    let left = swing.left(start, ball.radius_m);
    if left.0 <= 1.0 && left.1 <= 1.0 && drift == DVec3::ZERO {
        return Some(Segment::still(start.start_s, rest, start.orientation));
    }
    let (offset, speed) = swing.start(start);
    Some(Segment {
        end_s: start.start_s + swing.lasts_s(left),
        acceleration: -damped.omega * damped.omega * offset - 2.0 * damped.sigma * speed,
        course: Course::Springing,
        swing: Some(swing),
        ..*start
    })
}

impl Segment {
    /// A stretch of a swing from `from` on, as the parabola through its ends: as long as that is
    /// good enough, and no longer than to `until`. The parabola is off by at most
    /// 2/81 |x‴| h³, and where x‴ is small by the next term.
    pub fn stretch(&self, from: Seconds, until: Seconds) -> Segment {
        let Some((swing, damped)) = self.swing.and_then(|s| Some((s, s.linear?))) else {
            return Segment { end_s: self.end_s.min(until), ..*self };
        };
        let t = from - self.start_s;
        let (position, velocity) = swing.way_after(self, t);
        let offset = position - swing.rest - swing.drift * t;
        let (squared, twice) = (damped.omega * damped.omega, 2.0 * damped.sigma);
        let pull = -squared * offset - twice * (velocity - swing.drift);
        let third = -squared * (velocity - swing.drift) - twice * pull;
        let fourth = -squared * pull - twice * third;
        let off = 40.0 * PARABOLA_M;
        let longest = (PIECE.0 / damped.omega).min(PIECE.1);
        let piece = longest
            .min(libm::cbrt(off / third.length()))
            .min((off / fourth.length()).sqrt().sqrt());
        // A number more than `from`, however late it is.
        let end_s = (from + piece).max(from.next_up()).min(until);
        let length = end_s - from;
        let end = swing.way_after(self, end_s - self.start_s).0;
        let acceleration = if length > 0.0 {
            (end - position - velocity * length) * (2.0 / (length * length))
        } else {
            pull
        };
        let course = Course::Flying;
        Segment {
            start_s: from,
            end_s,
            position,
            velocity,
            acceleration,
            course,
            swing: None,
            ..*self
        }
    }
}

/// What springs and dampers do to a ball in lasting contact over a step of `dt`, by the implicit
/// midpoint rule, which is stable however stiff they are and keeps the energy of a free swing:
/// (1 + β) v₁ = (1 − β) v₀ − h ω² x₀ + J/m, β = h σ + ¼ h² ω². What else acts on the ball has been
/// added to `mover`; by 1 + β it is more inert for contacts, so that their impulses J hold against
/// the spring's force.
pub fn push(mover: &mut Mover, ball: &Ball, spring: &Spring, from: &Segment, dt: Seconds) {
    let (linear, angular) = damped(ball, spring);
    if let Some(Damped { omega, sigma }) = linear {
        let beta = dt * sigma + 0.25 * dt * dt * omega * omega;
        let offset = from.position - spring.anchor_m;
        let force = from.velocity * beta + offset * (dt * omega * omega);
        mover.velocity = (mover.velocity - force) / (1.0 + beta);
        mover.inverse_mass /= 1.0 + beta;
    }
    if let Some(Damped { omega, sigma }) = angular {
        let beta = dt * sigma + 0.25 * dt * dt * omega * omega;
        let angle = rotation_vector(from.orientation * spring.anchor_orientation.inverse());
        let torque = from.angular_velocity * beta + angle * (dt * omega * omega);
        mover.angular_velocity = (mover.angular_velocity - torque) / (1.0 + beta);
        mover.inverse_inertia /= 1.0 + beta;
    }
}
