//! Two balls that meet: acceleration noise, not ringing.
//!
//! Each ball is accelerated by half a sine as long as the contact, and pushes the air (Chadwick,
//! Zheng and James 2012: for small bodies this is what is heard). The other ball pushes the other
//! way, a diameter behind.

use super::Synthesis;
use crate::sound::parameters::{BALL_RADIUS_M, ClassParameters, SOUND_SPEED_M_S};

/// Two contacts, of opposite sign.
pub(super) fn ball_click(mut synthesis: Synthesis<'_>, row: &ClassParameters) {
    let speed = synthesis.speed_m_s;
    let length_s = synthesis.length_s(row);
    synthesis.modes(row);
    synthesis.strike(row, length_s, 0.0, speed, speed);
    let other_s = 2.0 * BALL_RADIUS_M / SOUND_SPEED_M_S;
    synthesis.strike(row, length_s, other_s, -speed, 0.0);
    synthesis.ring_out(row, length_s);
}
