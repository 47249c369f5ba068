//! How a contact feels in the hands that hold a gamepad.

use crate::events::{Fact, FactKind};

/// An impact as fast as this shakes with all there is [m/s]: a hard break.
const FULL_M_S: f64 = 8.0;
/// What is slower is not felt [m/s].
const LEAST_M_S: f64 = 0.15;
/// How long a gamepad shakes [ms]: the shortest that its motors follow.
const SHORT_MS: u32 = 60;
const LONG_MS: u32 = 140;

/// A short shake.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rumble {
    /// How strong [0 to 1].
    pub strength: f64,
    /// How long [ms].
    pub duration_ms: u32,
}

impl Rumble {
    /// What of this contact is felt, if anything.
    ///
    /// The strength is `share · sqrt((v − LEAST_M_S) / (FULL_M_S − LEAST_M_S))`, at most `share`,
    /// with the normal speed of approach v [m/s]; share is 1 for the tip, which the hand holds, 1/2
    /// for ball on ball, 1/4 for a cushion. The root lifts soft contacts to where a motor turns.
    pub fn of(fact: &Fact) -> Option<Self> {
        let (share, speed_m_s) = match fact.kind {
            FactKind::CueBallStruck { normal_speed_m_s, .. } => (1.0, normal_speed_m_s),
            FactKind::BallsCollided { normal_speed_m_s, .. } => (0.5, normal_speed_m_s),
            FactKind::CushionHit { normal_speed_m_s, .. } => (0.25, normal_speed_m_s),
            _ => return None,
        };
        let hard = (speed_m_s - LEAST_M_S) / (FULL_M_S - LEAST_M_S);
        let strength = share * hard.clamp(0.0, 1.0).sqrt();
        let duration_ms = SHORT_MS + (strength * f64::from(LONG_MS - SHORT_MS)) as u32;
        (0.0 < strength).then_some(Rumble { strength, duration_ms })
    }
}
