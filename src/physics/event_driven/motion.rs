//! Which law a ball follows from here, in closed form.
//!
//! On a level surface: sliding (the slip keeps its direction), rolling, spinning, rest. On a slope:
//! what runs along the line of fall. In the air: gravity. Whatever else carries a ball has no
//! closed form and is left to [`super::lasting`].

use super::segment::{Course, Segment};
use super::swing;
use crate::ball::Ball;
use crate::physics::laws::cloth::slip_velocity;
use crate::physics::{Parameters, tolerance};
use crate::units::Seconds;
use glam::DVec3;

/// The part of a motion that a law continues.
#[derive(Debug, Clone, Copy)]
pub struct Start {
    /// When, where, how fast, how turned; the rest is overwritten.
    pub segment: Segment,
    /// Unit normal of what carries the ball.
    pub normal: DVec3,
    /// Sliding friction of what carries it.
    pub friction: f64,
    /// How long the hops last that are too low to follow [s].
    pub hops_s: Seconds,
}

/// Longest segment with a force [s]: bounds the loss of digits in high powers of time.
const LONGEST_S: Seconds = 100.0;

/// A ball that nothing carries: it flies, or swings on its spring.
pub fn free(start: &Segment, ball: &Ball, parameters: &Parameters) -> Segment {
    let start = Segment { swing: None, ..*start };
    let flying = flying(&start, ball, parameters);
    swing::on_spring(&flying, ball, parameters).unwrap_or(flying)
}

/// A ball that nothing carries.
fn flying(start: &Segment, ball: &Ball, parameters: &Parameters) -> Segment {
    let weighs = ball.flags.gravity && ball.flags.integrate && parameters.gravity_m_s2 != 0.0;
    let acceleration = if weighs { DVec3::NEG_Z * parameters.gravity_m_s2 } else { DVec3::ZERO };
    Segment {
        end_s: if weighs { start.start_s + LONGEST_S } else { f64::INFINITY },
        acceleration,
        angular_acceleration: DVec3::ZERO,
        normal: DVec3::Z,
        spin_deceleration: 0.0,
        course: Course::Flying,
        ..*start
    }
}

/// A carried ball, by what its slip says; none if its motion has no closed form.
pub fn carried(start: &Start, ball: &Ball, parameters: &Parameters) -> Option<Segment> {
    if ball.spring.is_some() {
        return None;
    }
    let s = &start.segment;
    let slip = slip_velocity(s.velocity, s.angular_velocity, ball.radius_m, start.normal);
    let slope = Slope::new(start.normal, parameters.gravity_m_s2)?;
    if slip.length() > tolerance::SLIP_M_S {
        slope.slide(start, ball, parameters, slip)
    } else {
        // The last of the slip goes at once.
        let velocity = s.velocity - slip * (ball.inertia_factor / (1.0 + ball.inertia_factor));
        roll(&Start { segment: Segment { velocity, ..*s }, ..*start }, ball, parameters)
    }
}

/// A ball that has stopped slipping, whatever rounding says.
pub fn roll(start: &Start, ball: &Ball, parameters: &Parameters) -> Option<Segment> {
    Slope::new(start.normal, parameters.gravity_m_s2)?.roll(start, ball, parameters)
}

/// Gravity seen from a surface.
struct Slope {
    /// Along the surface, downhill [m/s²].
    along: DVec3,
    /// Into the surface [m/s²].
    into: f64,
}

impl Slope {
    /// None for a surface that carries nothing: a wall, a ceiling, or no gravity.
    fn new(normal: DVec3, gravity_m_s2: f64) -> Option<Self> {
        let gravity = DVec3::NEG_Z * gravity_m_s2;
        let into = -gravity.dot(normal);
        if into <= 1e-9 * gravity_m_s2 || gravity_m_s2 == 0.0 {
            return None;
        }
        let along = gravity + normal * into;
        let level = along.length() <= 1e-12 * gravity_m_s2;
        Some(Slope { along: if level { DVec3::ZERO } else { along }, into })
    }

    fn slide(
        &self,
        start: &Start,
        ball: &Ball,
        parameters: &Parameters,
        slip: DVec3,
    ) -> Option<Segment> {
        let s = &start.segment;
        let size = slip.length();
        let direction = slip / size;
        let friction = direction * (-start.friction * self.into);
        // The direction of the slip stays only if gravity pulls along it.
        let pull = self.along.dot(direction);
        let aside = (self.along - direction * pull).length();
        if aside > 1e-12 * self.into {
            return None;
        }
        let closes = start.friction * self.into * (1.0 + 1.0 / ball.inertia_factor) - pull;
        let lasts = if closes > 0.0 { size / closes } else { f64::INFINITY };
        let longest = if self.along == DVec3::ZERO && start.friction == 0.0 {
            f64::INFINITY
        } else {
            LONGEST_S
        };
        Some(Segment {
            end_s: s.start_s + lasts.min(longest),
            acceleration: friction + self.along,
            angular_acceleration: -start.normal.cross(friction)
                / (ball.inertia_factor * ball.radius_m),
            normal: start.normal,
            spin_deceleration: parameters.spin_deceleration_rad_s2,
            course: Course::Sliding,
            ..*s
        })
    }

    fn roll(&self, start: &Start, ball: &Ball, parameters: &Parameters) -> Option<Segment> {
        let s = &start.segment;
        let normal = start.normal;
        let spin = s.angular_velocity.dot(normal);
        let drag = parameters.rolling_resistance * self.into;
        let pull = self.along / (1.0 + ball.inertia_factor);
        let carried = Segment {
            normal,
            spin_deceleration: parameters.spin_deceleration_rad_s2,
            acceleration: DVec3::ZERO,
            angular_acceleration: DVec3::ZERO,
            ..*s
        };

        if pull != DVec3::ZERO {
            let held = self.along.length() * ball.inertia_factor / (1.0 + ball.inertia_factor)
                <= start.friction * self.into;
            let speed = s.velocity.length();
            let heading = if speed > 0.0 { s.velocity / speed } else { pull.normalize_or_zero() };
            let aside = pull - heading * pull.dot(heading);
            if !held || aside.length() > 1e-12 * self.into && drag > 0.0 {
                return None;
            }
            if !(speed == 0.0 && pull.length() <= drag) {
                let acceleration = pull - heading * drag;
                let against = -acceleration.dot(heading);
                let lasts = if against > 0.0 && drag > 0.0 { speed / against } else { LONGEST_S };
                return Some(Segment {
                    end_s: s.start_s + lasts.min(LONGEST_S),
                    acceleration,
                    angular_velocity: normal.cross(s.velocity) / ball.radius_m + normal * spin,
                    angular_acceleration: normal.cross(acceleration) / ball.radius_m,
                    course: Course::Rolling,
                    ..carried
                });
            }
        } else if s.velocity.length() > tolerance::ROLL_M_S {
            let speed = s.velocity.length();
            let acceleration = s.velocity * (-drag / speed);
            let lasts = if drag > 0.0 { speed / drag } else { f64::INFINITY };
            return Some(Segment {
                end_s: s.start_s + lasts.min(if drag > 0.0 { LONGEST_S } else { lasts }),
                acceleration,
                angular_velocity: normal.cross(s.velocity) / ball.radius_m + normal * spin,
                angular_acceleration: normal.cross(acceleration) / ball.radius_m,
                course: Course::Rolling,
                ..carried
            });
        }

        // It stands.
        let decays = parameters.spin_deceleration_rad_s2 > 0.0;
        let still = Segment { velocity: DVec3::ZERO, end_s: f64::INFINITY, ..carried };
        if spin != 0.0 {
            let lasts = if decays {
                spin.abs() / parameters.spin_deceleration_rad_s2
            } else {
                f64::INFINITY
            };
            return Some(Segment {
                end_s: s.start_s + lasts,
                angular_velocity: normal * spin,
                course: Course::Spinning,
                ..still
            });
        }
        let settles = start.hops_s > 0.0;
        Some(Segment {
            end_s: if settles { s.start_s + start.hops_s } else { f64::INFINITY },
            angular_velocity: DVec3::ZERO,
            course: if settles { Course::Settling } else { Course::Rest },
            ..still
        })
    }
}

/// What follows when a segment's law has ended by itself; `end` is the state at its end.
pub fn after(
    segment: &Segment,
    end: &Start,
    ball: &Ball,
    parameters: &Parameters,
) -> Option<Segment> {
    let lapsed = end.segment.start_s - segment.start_s >= LONGEST_S;
    match segment.course {
        Course::Flying | Course::Springing => Some(free(&end.segment, ball, parameters)),
        Course::Sliding | Course::Rolling if lapsed => carried(end, ball, parameters),
        Course::Sliding => roll(end, ball, parameters),
        Course::Rolling | Course::Spinning | Course::Settling | Course::Rest => {
            let spin = end.segment.angular_velocity.dot(end.normal);
            let kept =
                if segment.course == Course::Rolling { end.normal * spin } else { DVec3::ZERO };
            let state = Segment { velocity: DVec3::ZERO, angular_velocity: kept, ..end.segment };
            roll(&Start { segment: state, hops_s: 0.0, ..*end }, ball, parameters)
        }
        Course::Lasting => None,
    }
}
