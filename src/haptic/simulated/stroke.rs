//! The script of a stroke.

use super::script::{HandScript, Leg};
use crate::haptic::device::Buttons;
use crate::units::Seconds;
use glam::DVec3;

/// Where the stylus is pressed, how far it is drawn back, from and to where the stroke is steady,
/// and where it ends [m]: all within the depth of an Omni.
const PRESS_Z: f64 = 0.012;
const BACK_Z: f64 = 0.035;
const STEADY_Z: [f64; 2] = [0.026, -0.010];
const END_Z: f64 = -0.035;

impl HandScript {
    /// A practised hand that waits in front of the ball, presses the front button, draws back,
    /// waits for `pause_s`, strikes at `speed_m_s` [m/s] and stops behind it.
    pub fn stroke(speed_m_s: f64, pause_s: Seconds) -> HandScript {
        let at = |z: f64| DVec3::new(0.0, 0.0, z);
        let hold = |leg: Leg| leg.holding(Buttons::FRONT);
        let [steady_from, steady_to] = STEADY_Z;
        let rise_s = 2.0 * (BACK_Z - steady_from) / speed_m_s;
        let through_s = (steady_from - steady_to) / speed_m_s;
        let fall_s = 2.0 * (steady_to - END_Z) / speed_m_s;
        let ahead = DVec3::NEG_Z * speed_m_s;
        HandScript::practised(
            at(PRESS_Z),
            vec![
                Leg::to(at(PRESS_Z), 0.6),
                hold(Leg::to(at(PRESS_Z), 0.02)),
                hold(Leg::to(at(BACK_Z), 0.25)),
                hold(Leg::to(at(BACK_Z), pause_s)),
                hold(Leg::through(at(steady_from), ahead, rise_s)),
                hold(Leg::through(at(steady_to), ahead, through_s)),
                hold(Leg::to(at(END_Z), fall_s)),
                hold(Leg::to(at(END_Z), 0.1)),
            ],
        )
    }
}
