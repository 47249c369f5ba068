//! Which of the laws act: the choices of a scene, and one function for each kind of contact that
//! follows them.
//!
//! Why the defaults are what they are: `coulomb` needs two numbers that everybody knows and is
//! exact for spheres; `combined` is the only cushion law here that holds for any face, any support
//! and any speed; `rounds` is exact, symmetric and costs no extra time. The published models stand
//! beside them to be compared with, and each belongs to its own parameters.

use super::cluster::{self, Touch};
use super::mathavan_2014::Bed;
use super::{Impact, Mover, ball_ball, cushion, hertz, mathavan_2010, mathavan_2014};
use crate::physics::{Contact, Parameters};
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// What two balls do to each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BallLaw {
    /// Newton's restitution, Coulomb's friction with a constant coefficient.
    #[default]
    Coulomb,
    /// The same with a coefficient that falls with the slip ([`super::speed_friction`]).
    SpeedDependent,
    /// Integrated over the impulse, with the cloth under the balls ([`super::mathavan_2014`]).
    #[serde(rename = "mathavan-2014")]
    Mathavan2014,
}

/// What a cushion does to a ball on the bed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CushionLaw {
    /// Cushion and bed solved jointly ([`super::cushion`]).
    #[default]
    Combined,
    /// The same with a restitution that depends on the speed ([`super::han_2005`]).
    #[serde(rename = "han-2005")]
    Han2005,
    /// Integrated over the impulse ([`super::mathavan_2010`]).
    #[serde(rename = "mathavan-2010")]
    Mathavan2010,
}

/// What several contacts at one instant do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MultiContact {
    /// Rounds of joint impulses ([`super::cluster`]).
    #[default]
    Rounds,
    /// Elastic contacts followed in time, without friction ([`super::hertz`]).
    Hertz,
    /// One pair after the other, in the order found; for comparison with programs that do so. It
    /// breaks mirror symmetry.
    Pairwise,
}

/// Sweeps over the pairs of a cluster at most; it bounds the work.
const SWEEPS_MAX: usize = 400;

impl Parameters {
    /// Restitution and friction of two balls that meet with this slip [m/s].
    pub fn ball_at(&self, slip_m_s: f64) -> Contact {
        match self.ball_law {
            BallLaw::SpeedDependent => {
                Contact { friction: self.ball_friction_curve.at(slip_m_s), ..self.ball }
            }
            BallLaw::Coulomb | BallLaw::Mathavan2014 => self.ball,
        }
    }

    /// Restitution and friction of a cushion that a ball meets with this normal speed [m/s].
    pub fn cushion_at(&self, normal_speed_m_s: f64) -> Contact {
        match self.cushion_law {
            CushionLaw::Han2005 => Contact {
                restitution: super::han_2005::restitution(normal_speed_m_s),
                ..self.cushion
            },
            CushionLaw::Combined | CushionLaw::Mathavan2010 => self.cushion,
        }
    }
}

/// Two balls and nothing else but what carries them, by the law of `parameters`; `normal` points
/// from `b` to `a`. `contact` is [`Parameters::ball_at`], less what the solver takes off its
/// restitution.
pub fn pair(
    a: &mut Mover,
    b: &mut Mover,
    normal: DVec3,
    beds: [Option<Bed>; 2],
    contact: Contact,
    parameters: &Parameters,
) -> (Impact, [Impact; 2]) {
    match parameters.ball_law {
        BallLaw::Mathavan2014 => mathavan_2014::collide(a, b, normal, beds, contact),
        BallLaw::Coulomb | BallLaw::SpeedDependent => {
            let Contact { restitution, friction } = contact;
            let impact = ball_ball::collide(a, b, normal, restitution, friction);
            (impact, [Impact::default(); 2])
        }
    }
}

/// A carried ball and a cushion, by the law of `parameters`. `contact` is
/// [`Parameters::cushion_at`], less what the solver takes off its restitution. Returns what the
/// cushion and what the bed did.
pub fn cushion_and_bed(
    ball: &mut Mover,
    normal: DVec3,
    support: DVec3,
    contact: Contact,
    cloth: Contact,
    parameters: &Parameters,
) -> (Impact, Impact) {
    cushion_and_bed_by(cushion::bounce, ball, normal, support, contact, cloth, parameters)
}

/// The same, equal but for rounding, by [`cushion::bounce_directly`]. The stepper keeps to the
/// other way, on which the bits of its recordings rest.
pub fn cushion_and_bed_directly(
    ball: &mut Mover,
    normal: DVec3,
    support: DVec3,
    contact: Contact,
    cloth: Contact,
    parameters: &Parameters,
) -> (Impact, Impact) {
    let combined = cushion::bounce_directly;
    cushion_and_bed_by(combined, ball, normal, support, contact, cloth, parameters)
}

/// The same, with a way to solve the combined law.
fn cushion_and_bed_by(
    combined: impl Fn(&mut Mover, DVec3, DVec3, Contact, Contact) -> (Impact, Impact),
    ball: &mut Mover,
    normal: DVec3,
    support: DVec3,
    contact: Contact,
    cloth: Contact,
    parameters: &Parameters,
) -> (Impact, Impact) {
    match parameters.cushion_law {
        CushionLaw::Mathavan2010 => {
            let bed = Bed { normal: support, friction: cloth.friction };
            mathavan_2010::bounce(ball, normal, bed, contact)
        }
        CushionLaw::Combined | CushionLaw::Han2005 => {
            combined(ball, normal, support, contact, cloth)
        }
    }
}

/// The contacts of a cluster, by the rule of `parameters`; `gaps_m` are the distances of the
/// surfaces. Returns whether none closes any more.
pub fn several(
    movers: &mut [Mover],
    touches: &mut [Touch],
    gaps_m: &[f64],
    parameters: &Parameters,
) -> bool {
    match parameters.multi_contact {
        MultiContact::Rounds => cluster::resolve(movers, touches),
        MultiContact::Hertz => hertz::resolve(movers, touches, gaps_m),
        MultiContact::Pairwise => one_by_one(movers, touches),
    }
}

/// Each contact on its own, again and again until none closes.
fn one_by_one(movers: &mut [Mover], touches: &mut [Touch]) -> bool {
    for _ in 0..SWEEPS_MAX {
        let mut quiet = true;
        for touch in touches.iter_mut() {
            let before = touch.impulse;
            cluster::resolve(movers, core::slice::from_mut(touch));
            quiet &= touch.impulse == before;
        }
        if quiet {
            return true;
        }
    }
    false
}
