//! The hop after an impact (paper, section 2.3): why the paper gave up Verlet.
//!
//! A ball is dropped on the ground, in one dimension, with the paper's treatment of a contact: what
//! overlaps is pushed out and the velocity is turned round. Verlet in its position form knows no
//! velocity: it takes the way of the last step for it. Pushing a ball out changes that way, so that
//! the push becomes a speed, push over step; and a velocity that is turned round must be written
//! back as a made-up last place. Both are tried here beside Verlet in its velocity form, which has
//! neither trouble. The solver's own position form is dropped too: under the standard laws it
//! writes the last place anew, under those of 2009 it takes what pushes the ball out for its way.

use super::starts::{self, R};
use crate::events::FactSet;
use crate::ids::BallId;
use crate::physics::{Parameters, PhysicsError, PhysicsSettings, Simulation};
use crate::units::Seconds;
use glam::DVec3;

const GRAVITY_M_S2: f64 = 9.81;

/// How the step is written down.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// Semi-implicit Euler, the paper's choice.
    EulerCromer,
    /// Verlet by place and velocity.
    VelocityVerlet,
    /// Verlet by this place and the last; a contact pushes the ball out and turns its way round.
    PositionVerlet,
    /// The same, but the last place is written anew at a contact, from the new velocity.
    PositionVerletMended,
}

impl Form {
    /// All of them.
    pub const ALL: [Form; 4] =
        [Form::EulerCromer, Form::VelocityVerlet, Form::PositionVerlet, Form::PositionVerletMended];

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Form::EulerCromer => "Euler-Cromer",
            Form::VelocityVerlet => "Verlet, velocity form",
            Form::PositionVerlet => "Verlet, position form, ball pushed out",
            Form::PositionVerletMended => "Verlet, position form, last place written anew",
        }
    }
}

/// What a ball does that is dropped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hop {
    /// Height of the first hop [m].
    pub first_m: f64,
    /// What it is in truth [m]: restitution squared times the drop.
    pub truth_m: f64,
    /// Highest point after it should lie still [m].
    pub at_rest_m: f64,
}

/// Drops a ball from `drop_m` in steps of `h`.
pub fn hop(form: Form, drop_m: f64, restitution: f64, h: Seconds) -> Hop {
    let (mut x, mut v) = (drop_m, 0.0);
    // The last place from which gravity brings a ball at rest here.
    let mut last = x - 0.5 * GRAVITY_M_S2 * h * h;
    let falls_s = (2.0 * drop_m / GRAVITY_M_S2).sqrt();
    let still_s = falls_s * (1.0 + restitution) / (1.0 - restitution) + 0.1;
    let (mut first_m, mut at_rest_m) = (0.0_f64, 0.0_f64);
    let mut contacts = 0;
    let steps = ((still_s + 1.0) / h).ceil() as u32;
    for step in 1..=steps {
        match form {
            Form::EulerCromer => {
                v -= GRAVITY_M_S2 * h;
                x += v * h;
            }
            Form::VelocityVerlet => {
                x += v * h - 0.5 * GRAVITY_M_S2 * h * h;
                v -= GRAVITY_M_S2 * h;
            }
            Form::PositionVerlet | Form::PositionVerletMended => {
                let next = 2.0 * x - last - GRAVITY_M_S2 * h * h;
                v = (next - x) / h - 0.5 * GRAVITY_M_S2 * h;
                last = x;
                x = next;
            }
        }
        if x < 0.0 {
            contacts += 1;
            let depth = -x;
            x = 0.0;
            match form {
                Form::EulerCromer | Form::VelocityVerlet => v = restitution * v.abs(),
                // The way of the last step is turned and shortened; pushing out adds to it.
                Form::PositionVerlet => last = x - (restitution * (last + depth) + depth),
                Form::PositionVerletMended => {
                    v *= -restitution;
                    last = x - v * h - 0.5 * GRAVITY_M_S2 * h * h;
                }
            }
        }
        if contacts == 1 {
            first_m = first_m.max(x);
        }
        if f64::from(step) * h > still_s {
            at_rest_m = at_rest_m.max(x);
        }
    }
    Hop { first_m, truth_m: restitution * restitution * drop_m, at_rest_m }
}

/// Drops a ball on the cloth of the solver itself.
///
/// # Errors
/// [`PhysicsError`] if it does not get on.
pub fn solver_hop(
    settings: &PhysicsSettings,
    drop_m: f64,
    restitution: f64,
) -> Result<Hop, PhysicsError> {
    let mut parameters = Parameters::of(settings);
    parameters.cloth.restitution = restitution;
    let start = starts::ball(0, DVec3::Z * (R + drop_m), DVec3::ZERO, DVec3::ZERO);
    let mut world =
        Simulation::with_parameters(&starts::cloth(), vec![start], settings, parameters)?;
    let falls_s = (2.0 * drop_m / GRAVITY_M_S2).sqrt();
    let still_s = falls_s * (1.0 + restitution) / (1.0 - restitution) + 0.1;
    let (mut first_m, mut at_rest_m) = (0.0_f64, 0.0_f64);
    let mut facts = Vec::new();
    // The first hop begins after the fall; it is over when it comes down again.
    let (mut rises, mut over, mut last) = (false, false, drop_m);
    for look in 1..=(4000.0 * (still_s + 1.0)) as u32 {
        let at = f64::from(look) / 4000.0;
        facts.clear();
        world.advance(at, FactSet::NONE, &mut facts)?;
        let height = world.sample(BallId(0), at).map_or(f64::NAN, |ball| ball.position.z - R);
        rises |= at > falls_s && height > last;
        over |= rises && height < 0.2 * first_m;
        if rises && !over {
            first_m = first_m.max(height);
        }
        if at > still_s {
            at_rest_m = at_rest_m.max(height);
        }
        last = height;
    }
    Ok(Hop { first_m, truth_m: restitution * restitution * drop_m, at_rest_m })
}
