//! What every event asks of every ball, kept together and apart from all the rest.
//!
//! An event of one ball looks at all others: who may be met, who is near, who leans on it. A few
//! numbers of each answer that for most of them, and they lie side by side in memory.

use super::body::Body;
use super::segment::Course;
use crate::units::Seconds;
use glam::DVec3;

/// The way of a ball's centre, as it was when the ball was last predicted.
#[derive(Debug, Clone, Copy)]
pub struct Path {
    start_s: Seconds,
    position: DVec3,
    velocity: DVec3,
    /// Acceleration [m/s²].
    pub acceleration: DVec3,
    /// Speed at its start [m/s], and size of the acceleration [m/s²].
    haste: (f64, f64),
    /// How long it is known: up to the ball's own event or the end of the segment [s].
    pub known_s: Seconds,
    /// Radius of the ball [m].
    pub radius_m: f64,
    /// The ball touches other things.
    pub solid: bool,
    /// The centre stays where it is.
    pub stands: bool,
    /// The ball neither moves nor will by itself.
    pub still: bool,
    /// The ball can move.
    pub moves: bool,
    /// The ball is in lasting contact.
    pub lasts: bool,
    /// The ball sleeps on others, which wake it.
    pub leans: bool,
    /// The ball swings on a spring: its way is the segment's, not this one.
    pub swings: bool,
}

impl Path {
    /// The way of a ball from now on.
    pub fn of(body: &Body) -> Self {
        let s = &body.segment;
        let swings = s.swings();
        // On a spring it may come anywhere.
        let speed = if swings { f64::INFINITY } else { s.velocity.length() };
        Path {
            start_s: s.start_s,
            position: s.position,
            velocity: s.velocity,
            acceleration: s.acceleration,
            haste: (speed, s.acceleration.length()),
            known_s: body.own_s().min(s.end_s),
            radius_m: body.ball.radius_m,
            solid: body.solid(),
            stands: body.stands(),
            still: body.is_still(),
            moves: body.ball.flags.integrate,
            lasts: s.course == Course::Lasting,
            leans: body.leans && s.course == Course::Rest,
            swings,
        }
    }

    /// Centre at `at` [m], but for a ball on a spring.
    #[inline]
    pub fn position_at(&self, at: Seconds) -> DVec3 {
        let t = at - self.start_s;
        self.position + (self.velocity + self.acceleration * (0.5 * t)) * t
    }

    /// Velocity at `at` [m/s], but for a ball on a spring.
    #[inline]
    pub fn velocity_at(&self, at: Seconds) -> DVec3 {
        self.velocity + self.acceleration * (at - self.start_s)
    }

    /// No longer way than the centre can go from `at` on for `horizon` [m].
    #[inline]
    pub fn reach_m(&self, at: Seconds, horizon: Seconds) -> f64 {
        let (speed, pull) = self.haste;
        (speed + pull * (at - self.start_s + 0.5 * horizon)) * horizon
    }
}
