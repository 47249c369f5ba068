//! The force of an effect, and what an effect must remember.

use super::effect::{EFFECTS_MAX, Effect, EffectSet};
use crate::units::Seconds;
use glam::DVec3;

/// A blow that is this many of its decay times old is over.
const BLOW_DECAYS: f64 = 8.0;

/// What one slot remembers between ticks.
#[derive(Debug, Default, Clone, Copy)]
struct Memory {
    /// Time since the effect began, or since its blow [s].
    age_s: Seconds,
    /// Where the device last stuck [m].
    stuck: Option<DVec3>,
    /// The last blow that was begun.
    serial: Option<u32>,
}

/// The device as effects see it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hand {
    /// Its position [m].
    pub position: DVec3,
    /// Its filtered velocity [m/s].
    pub velocity: DVec3,
    /// Time since the last tick [s].
    pub dt: Seconds,
    /// No effect is stiffer than this [N/m].
    pub stiffness_max_n_m: f64,
}

/// What a whole set remembers.
#[derive(Debug, Clone, Copy)]
pub(super) struct EffectMemory([Memory; EFFECTS_MAX]);

impl EffectMemory {
    /// Nothing.
    pub fn new() -> Self {
        EffectMemory([Memory::default(); EFFECTS_MAX])
    }

    /// The sum of all forces of `set` [N], and that of its blows alone, which is part of it.
    pub fn force(&mut self, set: &EffectSet, hand: &Hand) -> (DVec3, DVec3) {
        let (mut sum, mut blows) = (DVec3::ZERO, DVec3::ZERO);
        for (slot, memory) in set.slots.iter().zip(&mut self.0) {
            match slot {
                Some(effect) => {
                    let force = effect.force(memory, hand);
                    sum += force;
                    if matches!(effect, Effect::Blow { .. }) {
                        blows += force;
                    }
                }
                None => *memory = Memory::default(),
            }
        }
        (sum, blows)
    }
}

/// K depth − B v·n along n, never pulling.
fn pushed_out(depth_m: f64, normal: DVec3, stiffness: f64, damping: f64, hand: &Hand) -> DVec3 {
    if depth_m <= 0.0 {
        return DVec3::ZERO;
    }
    normal * (stiffness * depth_m - damping * hand.velocity.dot(normal)).max(0.0)
}

impl Effect {
    /// The force on the device [N].
    fn force(&self, memory: &mut Memory, hand: &Hand) -> DVec3 {
        let (x, v) = (hand.position, hand.velocity);
        let held = |stiffness_n_m: f64| stiffness_n_m.min(hand.stiffness_max_n_m);
        match *self {
            Effect::Constant { force } => force,
            Effect::Point { point, stiffness_n_m, damping_ns_m } => {
                held(stiffness_n_m) * (point - x) - damping_ns_m * v
            }
            Effect::Line { point, direction, stiffness_n_m, damping_ns_m } => {
                let across = |vector: DVec3| vector - direction * vector.dot(direction);
                held(stiffness_n_m) * across(point - x) - damping_ns_m * across(v)
            }
            Effect::Plane { normal, offset_m, stiffness_n_m, damping_ns_m } => {
                let depth_m = offset_m - normal.dot(x);
                pushed_out(depth_m, normal, held(stiffness_n_m), damping_ns_m, hand)
            }
            Effect::Sphere { centre, radius_m, stiffness_n_m, damping_ns_m } => {
                let depth_m = radius_m - centre.distance(x);
                // In the very middle every way out is as short; up is one.
                let normal = (x - centre).normalize_or(DVec3::Y);
                pushed_out(depth_m, normal, held(stiffness_n_m), damping_ns_m, hand)
            }
            Effect::Magnet { point, stiffness_n_m, force_max_n, reach_m } => {
                magnet(point - x, held(stiffness_n_m), force_max_n, reach_m)
            }
            Effect::Viscous { region, damping_ns_m } => {
                if region.holds(x) {
                    -damping_ns_m * v
                } else {
                    DVec3::ZERO
                }
            }
            Effect::StickSlip { region, stiffness_n_m, force_max_n } => {
                if !region.holds(x) {
                    memory.stuck = None;
                    return DVec3::ZERO;
                }
                let stuck = *memory.stuck.get_or_insert(x);
                let force = held(stiffness_n_m) * (stuck - x);
                if force.length() <= force_max_n {
                    return force;
                }
                memory.stuck = Some(x);
                DVec3::ZERO
            }
            Effect::Vibration { region, direction, amplitude_n, frequency_hz } => {
                let phase = std::f64::consts::TAU * frequency_hz * memory.age_s;
                memory.age_s += hand.dt;
                if region.holds(x) {
                    direction * (amplitude_n * libm::sin(phase))
                } else {
                    DVec3::ZERO
                }
            }
            Effect::Blow { serial, direction, amplitude_n, frequency_hz, decay_s } => {
                if memory.serial != Some(serial) {
                    *memory = Memory { serial: Some(serial), ..Memory::default() };
                }
                let age_s = memory.age_s;
                memory.age_s += hand.dt;
                direction * (amplitude_n * ringing(age_s, frequency_hz, decay_s))
            }
        }
    }
}

/// exp(−t/τ) cos(2π f t), zero once it is over.
pub(super) fn ringing(age_s: Seconds, frequency_hz: f64, decay_s: Seconds) -> f64 {
    if !(age_s < BLOW_DECAYS * decay_s) {
        return 0.0;
    }
    let phase = std::f64::consts::TAU * frequency_hz * age_s;
    libm::exp(-age_s / decay_s) * libm::cos(phase)
}

/// A spring up to its greatest force; from there the force falls linearly to zero at the reach.
fn magnet(to_point: DVec3, stiffness: f64, force_max_n: f64, reach_m: f64) -> DVec3 {
    let distance = to_point.length();
    let peak_m = if stiffness > 0.0 { force_max_n / stiffness } else { 0.0 };
    let size = if distance <= peak_m.min(reach_m) {
        stiffness * distance
    } else if distance < reach_m {
        force_max_n * (reach_m - distance) / (reach_m - peak_m)
    } else {
        0.0
    };
    to_point.normalize_or_zero() * size
}
