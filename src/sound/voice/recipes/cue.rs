//! A tip that slips off, and chalk.

use super::Pot;
use crate::sound::parameters::{CHALK_GAP_S, CHALK_STROKES, MISCUE_CONTACTS, MISCUE_GAP_S, Recipe};

/// Short contacts, each weaker than the one before, and a scrape.
pub(super) fn miscue(mut pot: Pot<'_>, row: &Recipe) {
    let drive = pot.drive(row);
    let count = pot.count(MISCUE_CONTACTS);
    let (mut at_s, mut strength) = (0.0, 1.0);
    pot.modes(row);
    for _ in 0..count {
        let length_s = pot.length_s(&row.contact);
        pot.strike(&row.contact, length_s, at_s, strength * pot.speed_m_s, strength * drive);
        at_s += pot.chance.between(MISCUE_GAP_S[0], MISCUE_GAP_S[1]);
        strength *= pot.chance.between(0.5, 0.9);
    }
    pot.noise(row, 0.0, drive);
    pot.ring_out(row, at_s);
}

/// Strokes of scraping.
pub(super) fn chalk(mut pot: Pot<'_>, row: &Recipe) {
    let count = pot.count(CHALK_STROKES);
    let mut at_s = 0.0;
    for _ in 0..count {
        let gain = pot.chance.level(3.0);
        pot.noise(row, at_s, gain);
        at_s += pot.chance.between(CHALK_GAP_S[0], CHALK_GAP_S[1]);
    }
}
