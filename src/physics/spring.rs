//! Springs and dampers, exactly in time.
//!
//! x″ = −ω² x − 2 ζ ω x′ has a closed form; stepping it explicitly is unstable from ω h ≥ 2 on
//! (Euler-Cromer) and inaccurate long before. The cue's coupling uses the closed form. A ball's own
//! spring under `fixed-step` is part of the smooth forces and integrated with the rest, as in the
//! paper: that is what the integrators are compared on.

use crate::ball::{Ball, Spring};
use crate::units::Seconds;
use glam::{DQuat, DVec3};

/// The 2×2 matrix that carries (x, x′) over `dt`, x measured from the anchor: the rows
/// `[x←x, x←x′]` and `[x′←x, x′←x′]`.
///
/// With σ = ζ ω and s² = σ² − ω²: x(t) = e^(−σt) (x₀ C + (x₀′ + σ x₀) S), C = cosh(s t) and
/// S = sinh(s t)/s; cosine and sine for s² < 0. Near s = 0, S is taken from its series, so critical
/// damping needs no special case; overdamped, the exponentials are joined before they overflow.
pub fn propagator(omega_rad_s: f64, damping_ratio: f64, dt: Seconds) -> [[f64; 2]; 2] {
    Damped { omega: omega_rad_s, sigma: damping_ratio * omega_rad_s }.propagator(dt)
}

/// What a spring and a damper make of a coordinate: x″ = −ω² x − 2 σ x′. A damper alone has ω = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Damped {
    /// √(k/m) [rad/s].
    pub omega: f64,
    /// d/(2 m) [1/s].
    pub sigma: f64,
}

impl Damped {
    /// A spring and a damper on an inertia; none if there is neither.
    pub fn new(inertia: f64, stiffness: f64, damping: f64) -> Option<Self> {
        let omega = (stiffness / inertia).sqrt();
        let damped = Damped { omega, sigma: damping / (2.0 * inertia) };
        (damped != Damped { omega: 0.0, sigma: 0.0 }).then_some(damped)
    }

    /// How fast the last of a motion dies away [1/s]; zero if it never does. Overdamped it is the
    /// slower of the two exponents, −ω²/(σ + s).
    pub fn decay(&self) -> f64 {
        let Damped { omega, sigma } = *self;
        if omega == 0.0 {
            2.0 * sigma
        } else if sigma <= omega {
            sigma
        } else {
            omega * omega / (sigma + (sigma * sigma - omega * omega).sqrt())
        }
    }

    /// Offset and speed after `dt`, from those now.
    pub fn after(&self, offset: DVec3, velocity: DVec3, dt: Seconds) -> (DVec3, DVec3) {
        let m = self.propagator(dt);
        (offset * m[0][0] + velocity * m[0][1], offset * m[1][0] + velocity * m[1][1])
    }

    /// See [`propagator`].
    pub fn propagator(&self, dt: Seconds) -> [[f64; 2]; 2] {
        let Damped { omega, sigma } = *self;
        carry(omega, sigma, dt)
    }
}

fn carry(omega: f64, sigma: f64, dt: Seconds) -> [[f64; 2]; 2] {
    let s2 = sigma * sigma - omega * omega;
    let z = s2 * dt * dt;

    // C and S, both times e^(−σ t).
    let (c, s) = if z.abs() < 1e-4 {
        let decay = libm::exp(-sigma * dt);
        let cosh = 1.0 + z / 2.0 * (1.0 + z / 12.0 * (1.0 + z / 30.0));
        let sinh = dt * (1.0 + z / 6.0 * (1.0 + z / 20.0 * (1.0 + z / 42.0)));
        (decay * cosh, decay * sinh)
    } else if z < 0.0 {
        let rate = (-s2).sqrt();
        let (sin, cos) = libm::sincos(rate * dt);
        let decay = libm::exp(-sigma * dt);
        (decay * cos, decay * sin / rate)
    } else {
        // s < σ: the faster exponent −σ − s never overflows, and the slower one is −ω²/(σ + s).
        let rate = s2.sqrt();
        let slow = libm::exp(-omega * omega / (sigma + rate) * dt);
        let fast = libm::exp(-(sigma + rate) * dt);
        (0.5 * (slow + fast), 0.5 * (slow - fast) / rate)
    };

    [[c + sigma * s, s], [-omega * omega * s, c - sigma * s]]
}

/// Acceleration [m/s²] and angular acceleration [rad/s²] that a ball's spring gives it (paper,
/// chapter 2): (−k (x − x_a) − d v)/m and (−k_a θ − d_a ω)/I, θ the rotation vector from the
/// anchor's orientation, at most half a turn long.
pub fn acceleration(
    ball: &Ball,
    spring: &Spring,
    position: DVec3,
    velocity: DVec3,
    orientation: DQuat,
    angular_velocity: DVec3,
) -> (DVec3, DVec3) {
    let force =
        -spring.stiffness_n_m * (position - spring.anchor_m) - spring.damping_ns_m * velocity;
    let torque = -spring.angular_stiffness_nm_rad
        * rotation_vector(orientation * spring.anchor_orientation.inverse())
        - spring.angular_damping_nms_rad * angular_velocity;
    (force / ball.mass_kg, torque / ball.inertia_kg_m2())
}

/// Rotation vector of a unit quaternion [rad]: axis times angle, the shorter way round.
pub fn rotation_vector(rotation: DQuat) -> DVec3 {
    let q = if rotation.w < 0.0 { -rotation } else { rotation };
    let axis = DVec3::new(q.x, q.y, q.z);
    let sine = axis.length();
    if sine < 1e-12 { 2.0 * axis } else { axis * (2.0 * libm::atan2(sine, q.w) / sine) }
}

/// `orientation` after turning with `angular_velocity` for `dt`: exp(ω dt) q.
pub fn turned(orientation: DQuat, angular_velocity: DVec3, dt: Seconds) -> DQuat {
    let rate = angular_velocity.length();
    if rate * dt.abs() < 1e-300 {
        return orientation;
    }
    let (sin, cos) = libm::sincos(0.5 * rate * dt);
    let axis = angular_velocity * (sin / rate);
    (DQuat::from_xyzw(axis.x, axis.y, axis.z, cos) * orientation).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_of_a_propagator_make_the_whole_for_any_damping() {
        for damping in [0.0, 0.3, 0.999_999, 1.0, 1.000_001, 3.0, 40.0] {
            for omega in [1.0, 50.0, 4_000.0] {
                let half = propagator(omega, damping, 0.001);
                let whole = propagator(omega, damping, 0.002);
                for row in 0..2 {
                    for column in 0..2 {
                        let product =
                            half[row][0] * half[0][column] + half[row][1] * half[1][column];
                        let scale = whole[row][column].abs().max(half[row][column].abs()).max(1e-3);
                        assert!((product - whole[row][column]).abs() < 1e-10 * scale);
                    }
                }
            }
        }
    }

    #[test]
    fn a_critically_damped_spring_follows_its_formula() {
        let m = propagator(40.0, 1.0, 0.05);
        let decay = libm::exp(-2.0);
        assert!((m[0][0] - 3.0 * decay).abs() < 1e-15);
        assert!((m[0][1] - 0.05 * decay).abs() < 1e-16);
    }

    #[test]
    fn turning_forth_is_read_back_as_a_rotation_vector() {
        let turn = DVec3::new(0.3, -0.2, 0.9);
        let read = rotation_vector(turned(DQuat::IDENTITY, turn, 1.0));
        assert!((read - turn).length() < 1e-14);
    }
}
