//! What the servo tells of a tick: one plain value, for slots, rings and files.

use super::anchor::Anchor;
use super::device::{Buttons, DeviceState, Force};
use crate::cue::CuePiece;
use crate::ids::BallId;
use crate::units::Seconds;
use glam::{DMat3, DVec3};

/// Two samples that differ less from one parabola are joined by it [m].
const JOINED_M: f64 = 1e-9;

/// A sample of the stylus, as the input takes it to the physics.
#[derive(Debug, Default, Clone, Copy, PartialEq)]
pub struct StylusSample {
    /// Which tick of the servo, from 1.
    pub tick: u64,
    /// True time since the sample before [s].
    pub dt: Seconds,
    /// What the device said.
    pub device: DeviceState,
    /// Centre of the tip after coupling, stabiliser and table, before any ball [m].
    pub tip: DVec3,
    /// Its velocity [m/s].
    pub velocity: DVec3,
    /// Unit vector along the shaft, from butt to tip.
    pub direction: DVec3,
    /// The stroke stabiliser holds: the tip moves along its shaft.
    pub stabilised: bool,
    /// What holds the hand while it leads no cue.
    pub anchor: Option<Anchor>,
}

impl StylusSample {
    /// The way of the tip from `before` to this sample as a piece of a cue path that begins at
    /// `start_s` and holds for `duration_s`; what follows replaces it after `dt`.
    ///
    /// The parabola that the servo has reckoned with, so that physics finds the same contact.
    pub fn piece(&self, before: &StylusSample, start_s: Seconds, duration_s: Seconds) -> CuePiece {
        let joined = before.tip + 0.5 * (before.velocity + self.velocity) * self.dt;
        let (velocity, acceleration) = if joined.distance(self.tip) < JOINED_M {
            (before.velocity, (self.velocity - before.velocity) / self.dt)
        } else {
            // The tip was held by something, or laid elsewhere.
            ((self.tip - before.tip) / self.dt, DVec3::ZERO)
        };
        CuePiece {
            start_s,
            duration_s,
            position: before.tip,
            velocity,
            acceleration,
            direction: before.direction,
            direction_end: self.direction,
        }
    }
}

/// A press or a release.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ButtonEdge {
    /// Which tick of the servo.
    pub tick: u64,
    /// Which button.
    pub button: Buttons,
    /// Pressed, not released.
    pub down: bool,
}

/// What the tip touched.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Touched {
    /// A ball that could be struck: the impact was solved.
    Struck(BallId),
    /// A ball that was only touched.
    Ball(BallId),
    /// The table.
    Face,
}

/// A contact that the hand felt begin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactEvent {
    /// Which tick of the servo.
    pub tick: u64,
    /// When it happened, before the end of that tick [s].
    pub before_end_s: Seconds,
    /// What was touched.
    pub touched: Touched,
    /// Closing speed along the normal [m/s], in the world.
    pub speed_m_s: f64,
    /// Impulse on the ball that the servo's own solution gives [N s].
    pub impulse: DVec3,
}

/// Which stages of the safety chain acted in a tick.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct SafetyFlags(pub u16);

impl SafetyFlags {
    /// A number was none.
    pub const NOT_FINITE: SafetyFlags = SafetyFlags(1);
    /// The world is old.
    pub const STALE: SafetyFlags = SafetyFlags(1 << 1);
    /// Effects are fading into each other.
    pub const CROSS_FADE: SafetyFlags = SafetyFlags(1 << 2);
    /// The passivity controller damps.
    pub const PASSIVITY: SafetyFlags = SafetyFlags(1 << 3);
    /// The force rose too fast.
    pub const SLEW: SafetyFlags = SafetyFlags(1 << 4);
    /// The motors are warm.
    pub const THERMAL: SafetyFlags = SafetyFlags(1 << 5);
    /// The force was too large.
    pub const CLAMP: SafetyFlags = SafetyFlags(1 << 6);
    /// The device moves too fast.
    pub const TOO_FAST: SafetyFlags = SafetyFlags(1 << 7);
    /// The force is still rising from a start.
    pub const RAMP: SafetyFlags = SafetyFlags(1 << 8);
    /// Ticks came late.
    pub const LATE: SafetyFlags = SafetyFlags(1 << 9);
    /// The device is not ready, or nobody is at the dead man's switch.
    pub const DISCONNECTED: SafetyFlags = SafetyFlags(1 << 10);

    /// Whether all of `flags` are set.
    pub fn has(self, flags: SafetyFlags) -> bool {
        self.0 & flags.0 == flags.0
    }

    /// These without `flags`.
    pub fn without(self, flags: SafetyFlags) -> SafetyFlags {
        SafetyFlags(self.0 & !flags.0)
    }

    /// Sets `flags` if `on`.
    pub fn set(&mut self, flags: SafetyFlags, on: bool) {
        if on {
            self.0 |= flags.0;
        }
    }
}

/// How often things happened since the servo began [ticks, unless noted].
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Counters {
    /// Ticks.
    pub ticks: u64,
    /// A number was none.
    pub not_finite: u64,
    /// The passivity controller acted.
    pub passivity: u64,
    /// The slew limit acted.
    pub slew: u64,
    /// The clamp acted.
    pub clamp: u64,
    /// The device was too fast: how often the force went off.
    pub too_fast: u64,
    /// Ticks came late.
    pub late: u64,
    /// Stalls: how often the force went off for one.
    pub stalls: u64,
    /// Contacts that were felt to begin.
    pub contacts: u64,
}

/// How the workspace of the device lies in the world now.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WorkspacePose {
    /// Where the origin of the device frame lies [m].
    pub origin: DVec3,
    /// From the device frame to the world: columns are right, up and towards the user.
    pub turn: DMat3,
    /// Metres of the world per metre of the device.
    pub scale: f64,
    /// What it turns about: the middle of the ball to be struck [m].
    pub pivot: DVec3,
    /// Radius of the sphere that stands for the tip [m].
    pub tip_radius_m: f64,
}

impl WorkspacePose {
    /// A place of the device frame in the world [m].
    pub fn to_world(&self, position: DVec3) -> DVec3 {
        self.origin + self.turn * position * self.scale
    }
}

/// Everything about one tick.
#[derive(Debug, Default, Clone, Copy, PartialEq)]
pub struct ServoReport {
    /// The stylus and the tip.
    pub sample: StylusSample,
    /// Time since the servo began [s].
    pub time_s: Seconds,
    /// Where the device would have the centre of the tip if nothing were in the way [m].
    pub target: DVec3,
    /// Centre of the sphere that is felt: like the tip, but kept out of balls [m].
    pub proxy: DVec3,
    /// How far the tip is in what keeps the proxy out [m], in the device's scale.
    pub depth_m: f64,
    /// How the workspace lies in the world; none while nothing is reached.
    pub workspace: Option<WorkspacePose>,
    /// The direction that the workspace lies in now, and how far it is lowered [rad].
    pub azimuth_rad: f64,
    /// See above.
    pub elevation_rad: f64,
    /// What laws alone would give [N].
    pub wanted: Force,
    /// What was sent [N].
    pub force: Force,
    /// Root mean square of the force over the thermal time constant [N].
    pub force_rms_n: f64,
    /// Energy that the passivity observer has seen go into the renderer [J]; negative: it came out.
    pub energy_j: f64,
    /// Nothing is stiffer than this before the factor below [N/m].
    pub stiffness_max_n_m: f64,
    /// What the stiffness of everything is multiplied by.
    pub stiffness_factor: f64,
    /// Which stages acted.
    pub flags: SafetyFlags,
    /// How often, so far.
    pub counters: Counters,
    /// A contact that began in this tick.
    pub contact: Option<ContactEvent>,
}
