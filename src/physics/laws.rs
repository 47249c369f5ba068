//! Contact laws: pure functions on the states of the bodies that touch.
//!
//! Every solver uses these literally, so that two solvers can differ in when and where contacts
//! happen, never in what a contact does. One file per law; each states source, limits, parameters.

pub mod ball_ball;
pub mod ball_face;
pub mod choice;
pub mod cloth;
pub mod cluster;
pub mod cue_axis;
pub mod cue_ball;
pub mod cushion;
pub mod han_2005;
pub mod hertz;
pub mod mathavan_2010;
pub mod mathavan_2014;
pub mod one_ball;
pub mod paper_2009;
pub mod speed_friction;
pub mod wedge;

use crate::ball::Ball;
use glam::DVec3;

/// A ball as a contact law sees it: how it moves and how it resists.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mover {
    /// Velocity [m/s].
    pub velocity: DVec3,
    /// Angular velocity [rad/s].
    pub angular_velocity: DVec3,
    /// 1/m [1/kg]; zero for a ball that does not move.
    pub inverse_mass: f64,
    /// 1/I [1/(kg m²)].
    pub inverse_inertia: f64,
    /// Radius [m].
    pub radius_m: f64,
}

impl Mover {
    /// `ball` in motion.
    pub fn new(ball: &Ball, velocity: DVec3, angular_velocity: DVec3) -> Self {
        let moves = ball.flags.integrate;
        Mover {
            velocity,
            angular_velocity,
            inverse_mass: if moves { 1.0 / ball.mass_kg } else { 0.0 },
            inverse_inertia: if moves { 1.0 / ball.inertia_kg_m2() } else { 0.0 },
            radius_m: ball.radius_m,
        }
    }

    /// Velocity of the surface point at −R `normal` [m/s]: v + ω × (−R n).
    pub fn surface_velocity(&self, normal: DVec3) -> DVec3 {
        self.velocity - self.radius_m * self.angular_velocity.cross(normal)
    }

    /// Applies `impulse` [N s] at the surface point −R `normal`.
    pub fn push(&mut self, normal: DVec3, impulse: DVec3) {
        self.velocity += self.inverse_mass * impulse;
        self.angular_velocity -= self.inverse_inertia * self.radius_m * normal.cross(impulse);
    }

    /// 1/m + R²/I [1/kg]: how the surface point yields to a tangential impulse.
    pub fn tangential_compliance(&self) -> f64 {
        self.inverse_mass + self.radius_m * self.radius_m * self.inverse_inertia
    }

    /// ½ m v² + ½ I ω² [J]; zero for a ball that does not move.
    pub fn kinetic_j(&self) -> f64 {
        let part =
            |square: f64, inverse: f64| if inverse > 0.0 { 0.5 * square / inverse } else { 0.0 };
        part(self.velocity.length_squared(), self.inverse_mass)
            + part(self.angular_velocity.length_squared(), self.inverse_inertia)
    }
}

/// What a contact did.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Impact {
    /// Impulse on the first body [N s].
    pub impulse: DVec3,
    /// Whether the surfaces ended without slip.
    pub sticks: bool,
    /// Energy that was lost [J]: −J · (u + u′)/2, from impulse and surface velocities alone, so
    /// that the ledger can hold it against the balls' kinetic energy.
    pub loss_j: f64,
}
