//! What came of a simulated shot.

use crate::cue::Aim;

/// What came of a simulated shot, as far as a search needs it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Outcome {
    /// How the cue was meant to be held.
    pub aim: Aim,
    /// Speed that the tip was meant to have at the contact [m/s].
    pub speed_m_s: f64,
    /// It did what it was meant to do.
    pub success: bool,
    /// No foul.
    pub legal: bool,
    /// Chance to win the game after it.
    pub value: f64,
    /// Shots that were simulated for it.
    pub simulations: u32,
}
