//! Every tolerance of the solvers: its unit, what it means, and what changing it does.

use crate::units::Seconds;

/// Balls whose gap is at most this are struck as one cluster [m]. At 10 m/s phenolic balls compress
/// by about 0.8 mm, so gaps below 0.1 mm close before the first pair has parted. Smaller: a racked
/// break becomes a cascade of pairs that amplifies micrometres of jitter to metres per second.
pub const CLUSTER_M: f64 = 1e-4;

/// A contact closes if its normal speed exceeds this [m/s]. Larger: balls creep into each other.
pub const CLOSING_M_S: f64 = 1e-5;

/// Contacts that close more slowly than this are pressed, not struck [m/s]. Prediction asks for so
/// much, so that a resolved contact is not predicted again at once.
pub const STRUCK_M_S: f64 = 2.0 * CLOSING_M_S;

/// Below this approach speed two balls, or a ball and a cushion, stay together [m/s]. Larger:
/// slow kisses die.
pub const STICKY_M_S: f64 = 1e-4;

/// Below this approach speed a ball that lands stays down [m/s]. Larger: the last hops are lost;
/// smaller: more of them are computed. A hop of 5 mm/s is a micrometre high.
pub const LANDING_M_S: f64 = 5e-3;

/// A surface no farther than this carries the ball [m]. Larger: hops of that height are lost.
pub const SUPPORT_M: f64 = 1e-6;

/// Overlaps deeper than this are pushed out [m]; below it they are rounding.
pub const PUSH_OUT_M: f64 = 1e-9;

/// A ball has left a rail, a ball or the tip once it is farther away than this [m]. Larger: a
/// second contact counts as the same one.
pub const APART_M: f64 = 1e-4;

/// A repeated contact that has not parted in between is told only above this normal speed [m/s];
/// otherwise a ball lying at a cushion would tell it at every step.
pub const REPEATED_CONTACT_M_S: f64 = 1e-2;

/// A ball slower than this, spin times radius included, is at rest for the game [m/s]. It changes
/// no motion, only when [`crate::events::FactKind::Settled`] is told.
pub const REST_M_S: f64 = 1e-3;

/// How long everything must be at rest before it has settled [s].
pub const SETTLE_S: Seconds = 0.2;

/// Slip below this is rolling when motion is named [m/s]. It changes no motion.
pub const ROLLING_SLIP_M_S: f64 = 1e-4;

/// How long a leather tip stays on a ball [s]; a cue ball that meets another ball within this time
/// after the stroke was pushed. Alciatore, high-speed videos: about 1 ms.
pub const TIP_CONTACT_S: Seconds = 1e-3;

/// The tip leaves a ball alone that it has struck and not parted from, no longer than this [s]: a
/// ball that the bed throws back against the tip is one stroke.
pub const TIP_BLIND_S: Seconds = 0.05;

/// A cluster's rounds of impulses; later rounds have no restitution. It bounds the work.
pub const CLUSTER_ROUNDS: usize = 40;

/// Relative change of impulses at which the iteration of one round ends.
pub const CLUSTER_RELATIVE: f64 = 2e-14;

/// Iterations of one round at most. It bounds the work of large clusters.
pub const CLUSTER_ITERATIONS: usize = 200;

/// Contacts of one ball within one step before they lose their restitution: a ball that is caught
/// between surfaces comes to rest there instead of bouncing for ever.
pub const CONTACTS_PER_STEP: u32 = 16;

/// Two normals closer than this [rad] are one surface; faces so close to one plane [m] lie in it.
pub const COPLANAR: f64 = 1e-9;

/// Two balls, or a ball and a plane, may overlap by this at the start [m]: rounding of a tight
/// rack.
pub const START_OVERLAP_M: f64 = 1e-6;

/// A ball that falls this far below everything has left the table [m].
pub const ABYSS_M: f64 = 1.0;

/// Two things that lie together and are pressed collide once they overlap by this [m]; it is taken
/// back then. Larger: energy appears; smaller: more micro-impacts.
pub const PRESS_M: f64 = 1e-7;

/// A hop on level ground that begins slower than this is not followed; how long the rest of the
/// series lasts is added in closed form [m/s]. Larger: paths differ by the way slid during the last
/// hops, some micrometres a landing, and a break takes fewer events.
pub const HOP_M_S: f64 = 2e-3;

/// A hop slower than this is followed nowhere [m/s].
pub const LEAST_HOP_M_S: f64 = 5e-5;

/// Speed below which a hop off a surface is not followed [m/s]. `upright` is the part of the
/// surface's normal against gravity.
///
/// A series of hops lasts 2v/(g n (1 − e)) and takes all of its energy with it, so nothing but the
/// last 0.8 ms of a series is left out: what bounces without loss goes on for ever, and a wall has
/// no hops.
pub fn hop_m_s(restitution: f64, upright: f64) -> f64 {
    let part = (2.0 * (1.0 - restitution)).clamp(0.0, 1.0) * upright.max(0.0);
    (HOP_M_S * part).max(LEAST_HOP_M_S)
}

/// Smaller slip goes at once [m/s]; else 1e-7 m/s of it would breed sliding for 1e-7 s.
pub const SLIP_M_S: f64 = 1e-5;

/// A ball that begins to roll more slowly stands [m/s]; it would roll a ten-thousandth of a
/// millimetre.
pub const ROLL_M_S: f64 = 1e-4;

/// Faces whose planes differ by no more than this [m] are one patch.
pub const MERGE_M: f64 = 1e-6;

/// And whose normals have a cosine that differs from 1 by no more than this: 1e-4 rad.
pub const MERGE_NORMAL: f64 = 5e-9;

/// Normals of one contact, seen from neighbouring features: the cosine differs from 1 by less.
pub const SAME_NORMAL: f64 = 1e-9;

/// A ball that has more contacts than this within [`BUSY_S`] is in lasting contact.
pub const BUSY_CONTACTS: u32 = 16;

/// See [`BUSY_CONTACTS`] [s].
pub const BUSY_S: Seconds = 0.01;

/// Step of the motion that has no closed form [s].
pub const LASTING_STEP_S: Seconds = 5e-4;

/// A ball that turns about an edge more slowly goes on that grid too [m/s]: resistance may stop it.
pub const PIVOT_M_S: f64 = 5e-3;

/// What leans on several things, begins a step no faster than this and ends it no faster either
/// sleeps at once [m/s]. On a rim what stays unnoticed doubles in 40 ms: it would be asleep by
/// [`SLEEP_S`] all the same.
pub const CALM_M_S: f64 = 1e-9;

/// What lies still this long, slower than [`REST_M_S`], sleeps [s].
pub const SLEEP_S: Seconds = 0.2;
