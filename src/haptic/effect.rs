//! Effects: forces that belong to no body of the world (paper, section 3.3.1).
//!
//! Geometric effects are penalty forces: proportional to how far a constraint is violated, along
//! the direction that reduces the violation fastest. Active effects add up.

use crate::units::Seconds;
use glam::DVec3;

/// Most effects that act at a time.
pub const EFFECTS_MAX: usize = 32;

/// Where an effect acts.
#[derive(Debug, Default, Clone, Copy, PartialEq)]
pub enum Region {
    /// Anywhere.
    #[default]
    Everywhere,
    /// Inside of a sphere.
    Ball {
        /// Its centre [m].
        centre: DVec3,
        /// Its radius [m].
        radius_m: f64,
    },
}

impl Region {
    /// Whether a place lies in it.
    pub fn holds(&self, position: DVec3) -> bool {
        match self {
            Region::Everywhere => true,
            Region::Ball { centre, radius_m } => position.distance(*centre) <= *radius_m,
        }
    }
}

/// One force law, in the device frame. x is the position, v the velocity of the device.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Effect {
    /// F = c.
    Constant {
        /// c [N].
        force: DVec3,
    },
    /// Pulls to a point: F = K (p − x) − B v.
    Point {
        /// p [m].
        point: DVec3,
        /// K [N/m].
        stiffness_n_m: f64,
        /// B [N s/m].
        damping_ns_m: f64,
    },
    /// Pulls to a line, along which it is free: F = K (foot − x) − B v⊥.
    Line {
        /// A point of the line [m].
        point: DVec3,
        /// Unit vector along it.
        direction: DVec3,
        /// K [N/m].
        stiffness_n_m: f64,
        /// B [N s/m].
        damping_ns_m: f64,
    },
    /// Keeps the device on the free side: F = (K depth − B v·n) n while depth = d − n·x > 0; never
    /// pulls.
    Plane {
        /// n: unit vector to the free side.
        normal: DVec3,
        /// d: how far the plane is from the origin along n [m].
        offset_m: f64,
        /// K [N/m].
        stiffness_n_m: f64,
        /// B [N s/m].
        damping_ns_m: f64,
    },
    /// Keeps the device out of a sphere: F = (K depth − B v·n) n while depth = r − |x − c| > 0, n
    /// from c to x; never pulls.
    Sphere {
        /// c [m].
        centre: DVec3,
        /// r [m].
        radius_m: f64,
        /// K [N/m].
        stiffness_n_m: f64,
        /// B [N s/m].
        damping_ns_m: f64,
    },
    /// Pulls to a point like a spring up to a greatest force, which then falls linearly to zero at
    /// its reach.
    Magnet {
        /// Where it pulls to [m].
        point: DVec3,
        /// Of the spring near the point [N/m].
        stiffness_n_m: f64,
        /// The greatest force [N].
        force_max_n: f64,
        /// Beyond this distance there is none [m].
        reach_m: f64,
    },
    /// Resists motion: F = −B v.
    Viscous {
        /// Where.
        region: Region,
        /// B [N s/m].
        damping_ns_m: f64,
    },
    /// A spring to where the device last stuck; where the spring would pull harder than the
    /// friction holds, the device slips and sticks anew.
    StickSlip {
        /// Where.
        region: Region,
        /// Of the spring [N/m].
        stiffness_n_m: f64,
        /// What holds [N].
        force_max_n: f64,
    },
    /// F = A sin(2π f t) along a direction, t since the effect began.
    Vibration {
        /// Where.
        region: Region,
        /// Unit vector.
        direction: DVec3,
        /// A [N].
        amplitude_n: f64,
        /// f [Hz].
        frequency_hz: f64,
    },
    /// A single decaying blow: F = A exp(−t/τ) cos(2π f t) along a direction, t since `serial`
    /// changed. Kuchenbecker, Fiene, Niemeyer 2006.
    Blow {
        /// Counts up with every blow.
        serial: u32,
        /// Unit vector.
        direction: DVec3,
        /// A [N].
        amplitude_n: f64,
        /// f [Hz].
        frequency_hz: f64,
        /// τ [s].
        decay_s: Seconds,
    },
}

/// The effects that act.
///
/// An effect keeps its slot while it is modified, as often as one likes; that takes effect at the
/// next tick. Whoever enables or disables effects, or puts another kind into a slot, counts
/// `generation` up: the servo then fades from the old set to the new one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EffectSet {
    /// Counts up when other effects act than before.
    pub generation: u32,
    /// The effects, each in its slot.
    pub slots: [Option<Effect>; EFFECTS_MAX],
}

impl Default for EffectSet {
    fn default() -> Self {
        EffectSet { generation: 0, slots: [None; EFFECTS_MAX] }
    }
}

impl EffectSet {
    /// A set of these effects; those beyond [`EFFECTS_MAX`] are left out.
    pub fn of(generation: u32, effects: &[Effect]) -> Self {
        let mut set = EffectSet { generation, ..EffectSet::default() };
        for (slot, effect) in set.slots.iter_mut().zip(effects) {
            *slot = Some(*effect);
        }
        set
    }
}
