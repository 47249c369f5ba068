//! The blow that is felt when the tip meets something: a decaying oscillation, as strong as the
//! impact was fast. Without it an impact that is over within a tick would hardly be felt.

use super::effect_force::ringing;
use super::settings::TransientSettings;
use crate::units::Seconds;
use glam::DVec3;

/// The last blow.
#[derive(Debug, Clone, Default)]
pub(super) struct Transient {
    /// L v_n along the way that the hand is pushed [N].
    size: DVec3,
    frequency_hz: f64,
    age_s: Option<Seconds>,
}

impl Transient {
    /// Something was met at `speed_m_s` of the device along `push`, unit vector. A blow within the
    /// refractory time of the last one is not felt.
    ///
    /// The blow begins with the tick and not within it: its first sample is its peak, so the same
    /// stroke feels the same wherever the tick falls.
    pub fn begin(
        &mut self,
        push: DVec3,
        speed_m_s: f64,
        frequency_hz: f64,
        settings: &TransientSettings,
    ) {
        if self.age_s.is_some_and(|age_s| age_s < settings.refractory_s) {
            return;
        }
        self.size = push * (settings.gain_ns_m * speed_m_s);
        self.frequency_hz = frequency_hz;
        self.age_s = Some(0.0);
    }

    /// The force of this tick [N]; `dt` passes after it.
    pub fn force(&mut self, dt: Seconds, settings: &TransientSettings) -> DVec3 {
        let Some(age_s) = self.age_s else { return DVec3::ZERO };
        self.age_s = Some(age_s + dt);
        if age_s > settings.length_s {
            self.age_s = Some(f64::INFINITY);
            return DVec3::ZERO;
        }
        self.size * ringing(age_s, self.frequency_hz, settings.decay_s)
    }
}
