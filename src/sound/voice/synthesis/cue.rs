//! A tip that slips off, and chalk.

use super::Synthesis;
use crate::sound::parameters::{
    CHALK_GAP_S, CHALK_STROKES, ClassParameters, MISCUE_CONTACTS, MISCUE_GAP_S,
};

/// Short contacts, each weaker than the one before, and a scrape.
pub(super) fn miscue(mut synthesis: Synthesis<'_>, row: &ClassParameters) {
    let drive = synthesis.drive(row);
    let count = synthesis.count(MISCUE_CONTACTS);
    let (mut at_s, mut strength) = (0.0, 1.0);
    synthesis.modes(row);
    for _ in 0..count {
        let length_s = synthesis.length_s(row);
        synthesis.strike(row, length_s, at_s, strength * synthesis.speed_m_s, strength * drive);
        at_s += synthesis.chance.between(MISCUE_GAP_S[0], MISCUE_GAP_S[1]);
        strength *= synthesis.chance.between(0.5, 0.9);
    }
    synthesis.noise(row, 0.0, drive);
    synthesis.ring_out(row, at_s);
}

/// Strokes of scraping.
pub(super) fn chalk(mut synthesis: Synthesis<'_>, row: &ClassParameters) {
    let count = synthesis.count(CHALK_STROKES);
    let mut at_s = 0.0;
    for _ in 0..count {
        let gain = synthesis.chance.level(3.0);
        synthesis.noise(row, at_s, gain);
        at_s += synthesis.chance.between(CHALK_GAP_S[0], CHALK_GAP_S[1]);
    }
}
