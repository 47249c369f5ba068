//! What came of a simulated shot.

/// What came of a simulated shot, as far as a search needs it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Outcome {
    /// It did what it was meant to do.
    pub success: bool,
    /// No foul.
    pub legal: bool,
    /// Chance to win the game after it.
    pub value: f64,
}
