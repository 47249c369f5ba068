//! Ball: the one moving body. It knows no billiards: a golf ball, the mount of a camera or the tip
//! of a cue is a ball with other numbers (paper, chapter 2).

use crate::ids::BallId;
use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

/// Radius of a regulation pool ball [m].
pub const POOL_RADIUS_M: f64 = 0.028575;
/// Mass of a pool ball [kg].
pub const POOL_MASS_KG: f64 = 0.17;
/// Radius of a snooker ball [m]: 52.5 mm across (WPBSA).
pub const SNOOKER_RADIUS_M: f64 = 0.02625;
/// Mass of a snooker ball [kg] (Mathavan, Jackson, Parkin 2009).
pub const SNOOKER_MASS_KG: f64 = 0.1406;
/// Radius of a carom ball [m]: 61.5 mm across (UMB: 61 to 61.5 mm).
pub const CAROM_RADIUS_M: f64 = 0.03075;
/// Mass of a carom ball [kg] (UMB: 205 to 220 g).
pub const CAROM_MASS_KG: f64 = 0.21;
/// Moment of inertia of a solid sphere over m R².
pub const SOLID_SPHERE: f64 = 0.4;

/// What a ball is made of; does not change while it moves.
#[derive(Debug, Clone, PartialEq)]
pub struct Ball {
    /// Its name.
    pub id: BallId,
    /// Radius [m].
    pub radius_m: f64,
    /// Mass [kg].
    pub mass_kg: f64,
    /// Moment of inertia over m R²: 2/5 for a solid sphere, 2/3 for a hollow one.
    pub inertia_factor: f64,
    /// What acts on it.
    pub flags: BallFlags,
    /// Pulls it to an anchor, if present.
    pub spring: Option<Spring>,
}

impl Ball {
    /// A regulation pool ball.
    pub fn pool(id: BallId) -> Self {
        Ball {
            id,
            radius_m: POOL_RADIUS_M,
            mass_kg: POOL_MASS_KG,
            inertia_factor: SOLID_SPHERE,
            flags: BallFlags::default(),
            spring: None,
        }
    }

    /// A snooker ball.
    pub fn snooker(id: BallId) -> Self {
        Ball { radius_m: SNOOKER_RADIUS_M, mass_kg: SNOOKER_MASS_KG, ..Ball::pool(id) }
    }

    /// A carom ball.
    pub fn carom(id: BallId) -> Self {
        Ball { radius_m: CAROM_RADIUS_M, mass_kg: CAROM_MASS_KG, ..Ball::pool(id) }
    }

    /// Moment of inertia [kg m²].
    pub fn inertia_kg_m2(&self) -> f64 {
        self.inertia_factor * self.mass_kg * self.radius_m * self.radius_m
    }
}

/// What acts on a ball (paper, chapter 2). All true for a billiard ball.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct BallFlags {
    /// It has weight.
    pub gravity: bool,
    /// It moves.
    pub integrate: bool,
    /// It touches other things.
    pub collide: bool,
}

impl Default for BallFlags {
    fn default() -> Self {
        BallFlags { gravity: true, integrate: true, collide: true }
    }
}

/// A spring and damper to an anchor, linear and angular (paper, chapter 2).
///
/// Force −k (x − x_a) − d v; torque −k_a θ − d_a ω, θ the rotation vector from the anchor's
/// orientation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Spring {
    /// Where it pulls to [m].
    pub anchor_m: DVec3,
    /// Orientation it pulls to.
    pub anchor_orientation: DQuat,
    /// Linear stiffness k [N/m].
    pub stiffness_n_m: f64,
    /// Linear damping d [N s/m].
    pub damping_ns_m: f64,
    /// Angular stiffness k_a [N m/rad].
    pub angular_stiffness_nm_rad: f64,
    /// Angular damping d_a [N m s/rad].
    pub angular_damping_nms_rad: f64,
}

impl Default for Spring {
    fn default() -> Self {
        Spring {
            anchor_m: DVec3::ZERO,
            anchor_orientation: DQuat::IDENTITY,
            stiffness_n_m: 0.0,
            damping_ns_m: 0.0,
            angular_stiffness_nm_rad: 0.0,
            angular_damping_nms_rad: 0.0,
        }
    }
}

/// How a ball moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Motion {
    /// Neither moves nor spins.
    Rest,
    /// Stands and spins about the vertical.
    Spinning,
    /// Rolls without slipping.
    Rolling,
    /// Slips on what carries it.
    Sliding,
    /// Nothing carries it.
    Airborne,
}

/// Where a ball is in the game's sense.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BallPlace {
    /// In play: part of the simulation.
    OnTable,
    /// Down in a pocket and collected; no longer simulated.
    Pocketed,
    /// Left the table and collected; no longer simulated.
    OffTable,
    /// Waiting in a hand to be placed; not simulated.
    InHand,
}

/// The state of a ball at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BallState {
    /// The ball.
    pub id: BallId,
    /// Centre [m].
    pub position: DVec3,
    /// Velocity [m/s].
    pub velocity: DVec3,
    /// Angular velocity [rad/s].
    pub angular_velocity: DVec3,
    /// Rotation from the ball's own frame to the world; for display.
    pub orientation: DQuat,
    /// How it moves.
    pub motion: Motion,
    /// Where it is in the game's sense.
    pub place: BallPlace,
}

impl BallState {
    /// A ball at rest on the table, its centre at `position` [m].
    pub fn at_rest(id: BallId, position: DVec3) -> Self {
        BallState {
            id,
            position,
            velocity: DVec3::ZERO,
            angular_velocity: DVec3::ZERO,
            orientation: DQuat::IDENTITY,
            motion: Motion::Rest,
            place: BallPlace::OnTable,
        }
    }
}
