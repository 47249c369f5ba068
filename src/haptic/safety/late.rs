//! Which of the forces that were sent acts now: a device may be late by whole samples.

use crate::units::Seconds;
use glam::DVec3;

/// Most samples that a device may be late.
const LATE_MAX: usize = 16;

/// The last forces.
#[derive(Debug, Clone)]
pub(super) struct Sent {
    ring: [DVec3; LATE_MAX + 1],
    late: usize,
    next: usize,
}

impl Sent {
    pub fn new(latency_s: Seconds, period_s: Seconds) -> Self {
        let late = libm::round(latency_s / period_s).clamp(0.0, LATE_MAX as f64) as usize;
        Sent { ring: [DVec3::ZERO; LATE_MAX + 1], late, next: 0 }
    }

    /// A force is sent.
    pub fn send(&mut self, force: DVec3) {
        self.ring[self.next] = force;
        self.next = (self.next + 1) % self.ring.len();
    }

    /// The force that has acted since the tick before.
    pub fn acting(&self) -> DVec3 {
        self.ring[(self.next + self.ring.len() - 1 - self.late) % self.ring.len()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_force_acts_as_late_as_the_device_is() {
        for late in 0..=LATE_MAX {
            let mut sent = Sent::new(late as f64 * 0.001, 0.001);
            for k in 0..100_u32 {
                sent.send(DVec3::X * f64::from(k));
                let expected = (f64::from(k) - late as f64).max(0.0);
                assert_eq!(sent.acting().x, expected);
            }
        }
    }
}
