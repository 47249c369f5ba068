//! Stage 8: a device that runs away is let go.

/// How many ticks in a row the device was too fast.
#[derive(Debug, Clone, Default)]
pub(super) struct TooFast {
    ticks: u32,
    is_off: bool,
}

/// What the stage says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Speed {
    /// It may be felt.
    Fine,
    /// The force goes off in this tick.
    Trips,
    /// It is off until the device is slower.
    Off,
}

impl TooFast {
    /// `speed_m_s` of the device itself, not of the tip in the world.
    pub fn watch(&mut self, speed_m_s: f64, limit_m_s: f64, ticks_max: u32) -> Speed {
        self.ticks = if speed_m_s > limit_m_s { self.ticks.saturating_add(1) } else { 0 };
        if self.ticks >= ticks_max.max(1) {
            let was_off = std::mem::replace(&mut self.is_off, true);
            return if was_off { Speed::Off } else { Speed::Trips };
        }
        if self.ticks == 0 {
            self.is_off = false;
        }
        if self.is_off { Speed::Off } else { Speed::Fine }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_ticks_above_the_limit_switch_off_and_one_below_ends_it() {
        let mut watch = TooFast::default();
        let mut seen = |speed| watch.watch(speed, 2.0, 3);
        assert_eq!([seen(2.1), seen(2.1), seen(1.9)], [Speed::Fine; 3]);
        assert_eq!([seen(2.1), seen(2.1)], [Speed::Fine; 2]);
        assert_eq!([seen(2.1), seen(9.0)], [Speed::Trips, Speed::Off]);
        assert_eq!([seen(1.0), seen(2.1)], [Speed::Fine; 2]);
        assert_eq!(TooFast::default().watch(1e9, f64::INFINITY, 1), Speed::Fine);
    }
}
