//! Two balls that meet: acceleration noise, not ringing.
//!
//! Each ball is accelerated by half a sine as long as the contact, and pushes the air (Chadwick,
//! Zheng and James 2012: for small bodies this is what is speed). The other ball pushes the other
//! way, a diameter behind.

use super::Pot;
use crate::sound::contact::hertz_s;
use crate::sound::parameters::{BALL_MASS_KG, BALL_RADIUS_M, RESIN, Recipe, SOUND_SPEED_M_S};

/// Puts a click into the pot.
pub(super) fn cook(mut pot: Pot<'_>, row: &Recipe) {
    let speed = pot.speed_m_s;
    let hertz = hertz_s(0.5 * BALL_MASS_KG, 0.5 * BALL_RADIUS_M, [RESIN; 2], speed);
    let length_s = pot.varied(hertz);
    pot.modes(row);
    pot.strike(&row.contact, length_s, 0.0, speed, speed);
    let other_s = 2.0 * BALL_RADIUS_M / SOUND_SPEED_M_S;
    pot.strike(&row.contact, length_s, other_s, -speed, 0.0);
    pot.ring_out(row, length_s);
}
