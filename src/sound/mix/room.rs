//! The room around the table.

use glam::Vec3;

/// A box with walls that answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Room {
    /// Corner with the least coordinates [m]; the bed of the table is at z = 0.
    pub low_m: Vec3,
    /// Corner with the greatest coordinates [m].
    pub high_m: Vec3,
    /// Time in which the sound of the room falls by 60 dB [s].
    pub t60_s: f32,
}

impl Room {
    /// A cellar of 7 m x 5 m x 2.6 m with a carpet, the table in its middle.
    pub const CELLAR: Room =
        Room { low_m: Vec3::new(-3.5, -2.5, -0.78), high_m: Vec3::new(3.5, 2.5, 1.82), t60_s: 0.4 };
}
