//! What the mixer is told: sounds that begin, and balls that roll.

use crate::ids::BallId;
use crate::units::Seconds;
use glam::Vec3;

/// What makes a sound.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum SoundClass {
    /// Two balls met.
    BallClick,
    /// The tip struck a ball.
    CueStrike,
    /// The tip slipped off a ball.
    Miscue,
    /// A ball met a cushion.
    Cushion,
    /// A ball fell into a pocket.
    Pocket,
    /// A ball runs through the gully, after it fell.
    Gully,
    /// A ball that hopped met the cloth again.
    Landing,
    /// A ball met the floor of the room.
    Floor,
    /// Chalk on the tip.
    Chalk,
}

impl SoundClass {
    /// All classes.
    pub const ALL: [SoundClass; 9] = [
        SoundClass::BallClick,
        SoundClass::CueStrike,
        SoundClass::Miscue,
        SoundClass::Cushion,
        SoundClass::Pocket,
        SoundClass::Gully,
        SoundClass::Landing,
        SoundClass::Floor,
        SoundClass::Chalk,
    ];

    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            SoundClass::BallClick => "ball_click",
            SoundClass::CueStrike => "cue_strike",
            SoundClass::Miscue => "miscue",
            SoundClass::Cushion => "cushion",
            SoundClass::Pocket => "pocket",
            SoundClass::Gully => "gully",
            SoundClass::Landing => "landing",
            SoundClass::Floor => "floor",
            SoundClass::Chalk => "chalk",
        }
    }

    /// Whether the speed decides that it is heard at all: a ball falls into a pocket and runs
    /// through the gully however slow it was, and chalk is no impact.
    pub fn is_impact(self) -> bool {
        !matches!(self, SoundClass::Pocket | SoundClass::Gully | SoundClass::Chalk)
    }
}

/// A sound that begins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Onset {
    /// When, in the time of the game [s].
    pub time_s: Seconds,
    /// What.
    pub class: SoundClass,
    /// Normal speed of approach [m/s].
    pub speed_m_s: f32,
    /// Where [m].
    pub position_m: Vec3,
    /// Along the line of the impact, a unit vector; zero if it is not known.
    pub axis: Vec3,
    /// What the chance in it is drawn from: no two hits sound the same.
    pub seed: u32,
}

/// A ball on the cloth, as it is heard until the next one of the same ball.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rolling {
    /// The ball.
    pub ball: BallId,
    /// Its radius [m].
    pub radius_m: f32,
    /// Its centre [m].
    pub position_m: Vec3,
    /// Its velocity [m/s].
    pub velocity_m_s: Vec3,
    /// Speed of its lowest point over the cloth [m/s]; 0 when it rolls.
    pub slip_m_s: f32,
}
