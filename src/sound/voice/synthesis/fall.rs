//! Balls that fall: into a pocket, through the gully, on the floor.

use super::Synthesis;
use crate::sound::parameters::{
    ClassParameters, FLOOR_RESTITUTION, GRAVITY_M_S2, GULLY_S, GULLY_SPEEDS_M_S, POCKET_DEPTH_M,
    POCKET_DROP, SILENT_BELOW_M_S,
};
use crate::sound::voice::pulse::PULSES_MAX;
use crate::sound::voice::run::Run;

/// The back of the pocket at once, its ground after the fall.
pub(super) fn pocket(mut synthesis: Synthesis<'_>, row: &ClassParameters) {
    let drive = synthesis.drive(row);
    let length_s = synthesis.length_s(row);
    synthesis.strike(row, length_s, 0.0, synthesis.speed_m_s, 0.0);
    synthesis.noise(row, 0.0, drive);

    let drop_s = (2.0 * POCKET_DEPTH_M / GRAVITY_M_S2).sqrt();
    let landing_m_s = GRAVITY_M_S2 * drop_s;
    let length_s = synthesis.length_s(&POCKET_DROP);
    synthesis.modes(&POCKET_DROP);
    synthesis.strike(&POCKET_DROP, length_s, drop_s, landing_m_s, landing_m_s);
    synthesis.noise(&POCKET_DROP, drop_s, landing_m_s);
    synthesis.ring_out(&POCKET_DROP, drop_s);
}

/// A ball that rolls down a channel and comes to rest in the tray, at the balls that lie there.
pub(super) fn gully(mut synthesis: Synthesis<'_>, row: &ClassParameters, seed: u32) {
    let way_s = synthesis.chance.between(GULLY_S[0], GULLY_S[1]);
    let until = (way_s * synthesis.rate_hz) as u32;
    synthesis.voice.run = Some(Run::new(seed, until, synthesis.level, synthesis.rate_hz));
    synthesis.modes(row);

    // Once at the tray, and once more after a small bounce.
    let arrival_m_s = GULLY_SPEEDS_M_S[1];
    let again_s = way_s + synthesis.chance.between(0.06, 0.12);
    for (at_s, speed_m_s) in [(way_s, arrival_m_s), (again_s, 0.3 * arrival_m_s)] {
        synthesis.speed_m_s = speed_m_s;
        let length_s = synthesis.length_s(row);
        let drive = synthesis.drive(row);
        synthesis.strike(row, length_s, at_s, speed_m_s, drive);
    }
    synthesis.ring_out(row, again_s);
}

/// Bounces on the floor, each from the height that the one before left.
pub(super) fn floor(mut synthesis: Synthesis<'_>, row: &ClassParameters) {
    let mut at_s = 0.0;
    synthesis.modes(row);
    for _ in 0..PULSES_MAX {
        let speed = synthesis.speed_m_s;
        let length_s = synthesis.length_s(row);
        let drive = synthesis.drive(row);
        synthesis.strike(row, length_s, at_s, speed, drive);
        synthesis.ring_out(row, at_s);

        let up_m_s = FLOOR_RESTITUTION * speed;
        at_s += 2.0 * up_m_s / GRAVITY_M_S2;
        synthesis.speed_m_s = up_m_s;
        if up_m_s < SILENT_BELOW_M_S {
            break;
        }
    }
}
