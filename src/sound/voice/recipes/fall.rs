//! Balls that fall: into a pocket, through the gully, on the floor.

use super::Pot;
use crate::sound::contact::hertz_s;
use crate::sound::parameters::{
    BALL_MASS_KG, BALL_RADIUS_M, FLOOR_RESTITUTION, GRAVITY_M_S2, GULLY_S, GULLY_SPEEDS_M_S,
    POCKET_DEPTH_M, POCKET_DROP, RESIN, Recipe, SILENT_BELOW_M_S, WOOD,
};
use crate::sound::voice::pulse::PULSES_MAX;
use crate::sound::voice::run::Run;

/// The back of the pocket at once, its ground after the fall.
pub(super) fn pocket(mut pot: Pot<'_>, row: &Recipe) {
    let drive = pot.drive(row);
    let length_s = pot.length_s(&row.contact);
    pot.strike(&row.contact, length_s, 0.0, pot.speed_m_s, 0.0);
    pot.noise(row, 0.0, drive);

    let drop_s = (2.0 * POCKET_DEPTH_M / GRAVITY_M_S2).sqrt();
    let landing_m_s = GRAVITY_M_S2 * drop_s;
    let length_s = pot.length_s(&POCKET_DROP.contact);
    pot.modes(&POCKET_DROP);
    pot.strike(&POCKET_DROP.contact, length_s, drop_s, landing_m_s, landing_m_s);
    pot.noise(&POCKET_DROP, drop_s, landing_m_s);
    pot.ring_out(&POCKET_DROP, drop_s);
}

/// A ball that rolls down a channel and comes to rest in the tray, at the balls that lie there.
pub(super) fn gully(mut pot: Pot<'_>, row: &Recipe, seed: u32) {
    let way_s = pot.chance.between(GULLY_S[0], GULLY_S[1]);
    let until = (way_s * pot.rate_hz) as u32;
    pot.voice.run = Some(Run::new(seed, until, pot.level, pot.rate_hz));
    pot.modes(row);

    // Once at the tray, and once more after a small bounce.
    let arrival_m_s = GULLY_SPEEDS_M_S[1];
    let again_s = way_s + pot.chance.between(0.06, 0.12);
    for (at_s, speed_m_s) in [(way_s, arrival_m_s), (again_s, 0.3 * arrival_m_s)] {
        pot.speed_m_s = speed_m_s;
        let length_s = pot.length_s(&row.contact);
        let drive = pot.drive(row);
        pot.strike(&row.contact, length_s, at_s, speed_m_s, drive);
    }
    pot.ring_out(row, again_s);
}

/// Bounces on the floor, each from the height that the one before left.
pub(super) fn floor(mut pot: Pot<'_>, row: &Recipe) {
    let mut at_s = 0.0;
    pot.modes(row);
    for _ in 0..PULSES_MAX {
        let speed = pot.speed_m_s;
        let hertz = hertz_s(BALL_MASS_KG, BALL_RADIUS_M, [RESIN, WOOD], speed);
        let length_s = pot.varied(hertz);
        let drive = pot.drive(row);
        pot.strike(&row.contact, length_s, at_s, speed, drive);
        pot.ring_out(row, at_s);

        let up_m_s = FLOOR_RESTITUTION * speed;
        at_s += 2.0 * up_m_s / GRAVITY_M_S2;
        pot.speed_m_s = up_m_s;
        if up_m_s < SILENT_BELOW_M_S {
            break;
        }
    }
}
