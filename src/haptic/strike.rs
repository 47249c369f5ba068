//! A stroke as the hand feels it: the impact is solved in the tick in which it happens, with the
//! law that physics uses, on the servo's own copy of the ball. Physics decides what really happens.
//!
//! The cue then lags behind its path and the hand draws it back, as in the solvers; that lag is
//! the spring force that is felt after the blow.

use super::scene::CueBody;
use super::tip::Piece;
use super::world::Shown;
use crate::physics::laws::Mover;
use crate::physics::laws::cue_ball::{Cue, cue_contact};
use crate::physics::{roots, spring};
use crate::units::Seconds;
use glam::DVec3;

/// A lag this small, and this slow, is over [m, m/s].
const OVER: f64 = 1e-7;

/// How far the cue is ahead of its path, along the shaft.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Lead {
    /// How far [m]; negative while it lags behind.
    pub offset_m: f64,
    /// Its rate [m/s].
    pub rate_m_s: f64,
}

impl Lead {
    /// `dt` later, drawn back at this rate.
    pub fn after(self, dt: Seconds, coupling_rad_s: f64) -> Lead {
        if self.offset_m.abs() < OVER && self.rate_m_s.abs() < OVER {
            return Lead::default();
        }
        let m = spring::propagator(coupling_rad_s, 1.0, dt);
        Lead {
            offset_m: m[0][0] * self.offset_m + m[0][1] * self.rate_m_s,
            rate_m_s: m[1][0] * self.offset_m + m[1][1] * self.rate_m_s,
        }
    }
}

/// An impact of the tip on a ball.
#[derive(Debug, Clone, Copy)]
pub(super) struct Impact {
    /// When, after the begin of the tick [s].
    pub after_s: Seconds,
    /// Unit vector from the tip to the ball.
    pub normal: DVec3,
    /// Closing speed along it [m/s].
    pub speed_m_s: f64,
    /// Where the ball's middle is [m].
    pub ball: DVec3,
    /// The ball afterwards.
    pub mover: Mover,
    /// What the cue's velocity changed by [m/s].
    pub change: DVec3,
    /// Impulse on the ball [N s].
    pub impulse: DVec3,
}

/// The way of the tip in one tick, its lead included.
#[derive(Debug, Clone, Copy)]
pub(super) struct Way {
    /// The path.
    pub piece: Piece,
    /// Unit vector along the shaft.
    pub direction: DVec3,
    /// The lead at the begin, and at the end.
    pub lead: [Lead; 2],
    /// Length of the tick [s].
    pub dt: Seconds,
    /// Radius of the tip [m].
    pub radius_m: f64,
}

/// The first impact of the tip on `ball` in this tick.
pub(super) fn impact(way: &Way, ball: &Shown, cue: &CueBody) -> Option<Impact> {
    let Way { piece, direction, lead, dt, radius_m } = *way;
    let inv_dt = 1.0 / dt;

    // Relative motion of ball and tip: x + v τ + ½ a τ².
    let ball_velocity = (ball.centre - ball.before) * inv_dt;
    let lead_rate = (lead[1].offset_m - lead[0].offset_m) * inv_dt;
    let tip = piece.from + direction * lead[0].offset_m;
    let tip_velocity = piece.velocity + direction * lead_rate;
    let acceleration = (piece.velocity_end - piece.velocity) * inv_dt;
    let offset = ball.before - tip;
    let distance_m = ball.ball.radius_m + radius_m;
    let velocity = ball_velocity - tip_velocity;
    let after_s = roots::curved(offset, velocity, -acceleration, distance_m, dt)?;

    let tau = after_s;
    let place = ball.before + ball_velocity * tau;
    let tip = tip + (tip_velocity + acceleration * (0.5 * tau)) * tau;
    let normal = (place - tip).normalize_or(direction);
    let own_rate = lead[0].rate_m_s + (lead[1].rate_m_s - lead[0].rate_m_s) * (tau * inv_dt);
    let mut body = Cue {
        velocity: piece.velocity + acceleration * tau + direction * own_rate,
        direction,
        mass_kg: cue.mass_kg,
        end_mass_kg: cue.end_mass_kg,
        contact: cue.contact,
    };
    let mut mover = Mover {
        velocity: ball.ball.velocity,
        angular_velocity: ball.ball.angular_velocity,
        inverse_mass: ball.ball.inverse_mass,
        inverse_inertia: ball.ball.inverse_inertia,
        radius_m: ball.ball.radius_m,
    };
    let before = body.velocity;
    let speed_m_s = -(mover.surface_velocity(normal) - before).dot(normal);
    let impact = cue_contact(&mut mover, &mut body, normal);
    (impact.impulse != DVec3::ZERO).then_some(Impact {
        after_s,
        normal,
        speed_m_s,
        ball: place,
        mover,
        change: body.velocity - before,
        impulse: impact.impulse,
    })
}
