//! When a device may be pushed: what it reports makes it rest, or lose it for good. A plain state
//! machine that runs in the callback.

use super::faults::{Class, class, sentence};
use super::hd::calibration;
use crate::haptic::turns::Explain;
use hapticbillard::haptic::DeviceStatus;
use hapticbillard::units::Seconds;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

/// How long motors rest at least [s].
const REST_S: Seconds = 1.0;
/// Motors that are warmer go on resting; 1 is too hot.
const COOL: f64 = 0.5;
/// After so many ticks in a row with a complaint the device is given up.
const COMPLAINTS: u32 = 100;

/// Why a device may not be pushed, as its control sees it.
#[derive(Debug, Default)]
pub struct Reason(AtomicU32);

impl Explain for Reason {
    fn why(&self) -> Option<String> {
        match self.0.load(Ordering::Acquire) {
            0 => None,
            code => Some(sentence(code)),
        }
    }
}

/// The state of a device.
#[derive(Debug)]
pub struct Care {
    status: DeviceStatus,
    rest_left_s: Seconds,
    complaints: u32,
    has_complained: bool,
    reason: Arc<Reason>,
}

impl Care {
    /// Of a device that works, and says to `reason` when it does not.
    pub fn new(reason: Arc<Reason>) -> Self {
        Care {
            status: DeviceStatus::Ready,
            rest_left_s: 0.0,
            complaints: 0,
            has_complained: false,
            reason,
        }
    }

    /// Whether the device may be pushed.
    pub fn status(&self) -> DeviceStatus {
        self.status
    }

    /// The library reports an error.
    pub fn hear(&mut self, code: u32) {
        match class(code) {
            Class::Rest => self.rest(code),
            Class::Loss => self.lose(code),
            Class::Complaint => {
                self.has_complained = true;
                if self.complaints >= COMPLAINTS {
                    self.lose(code);
                }
            }
        }
    }

    /// How far the device is calibrated. Until it is, and a while after, its positions may jump.
    pub fn check(&mut self, calibrated: u32) {
        if matches!(calibrated, calibration::NEEDS_UPDATE | calibration::NEEDS_MANUAL_INPUT) {
            self.rest(calibrated);
        }
    }

    /// Another tick, `dt` after the last one [s]. `warmth` is asked for while motors rest.
    pub fn go_on(&mut self, dt: Seconds, warmth: impl FnOnce() -> f64) {
        self.complaints = if self.has_complained { self.complaints + 1 } else { 0 };
        self.has_complained = false;
        if self.status != DeviceStatus::Warm {
            return;
        }
        self.rest_left_s -= dt;
        if self.rest_left_s <= 0.0 && warmth() <= COOL {
            self.status = DeviceStatus::Ready;
            self.reason.0.store(0, Ordering::Release);
        }
    }

    fn rest(&mut self, code: u32) {
        if self.status != DeviceStatus::Lost {
            self.status = DeviceStatus::Warm;
            self.rest_left_s = REST_S;
            self.reason.0.store(code, Ordering::Release);
        }
    }

    fn lose(&mut self, code: u32) {
        if self.status != DeviceStatus::Lost {
            self.status = DeviceStatus::Lost;
            self.reason.0.store(code, Ordering::Release);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn care() -> (Care, Arc<Reason>) {
        let reason = Arc::new(Reason::default());
        (Care::new(reason.clone()), reason)
    }

    #[test]
    fn warm_motors_rest_until_they_are_cool() {
        let (mut care, reason) = care();
        assert_eq!((care.status(), reason.why()), (DeviceStatus::Ready, None));
        care.hear(0x200);
        assert!(reason.why().unwrap().contains("HD_WARM_MOTORS (0x200)"));
        for _ in 0..1500 {
            care.go_on(0.001, || 0.9);
            assert_eq!(care.status(), DeviceStatus::Warm);
        }
        care.go_on(0.001, || 0.4);
        assert_eq!((care.status(), reason.why()), (DeviceStatus::Ready, None));
        // A device that does not say how warm it is rests for a second.
        care.hear(0x202);
        let ticks = (1..).find(|_| {
            care.go_on(0.001, || 0.0);
            care.status() == DeviceStatus::Ready
        });
        assert!((995..=1005).contains(&ticks.unwrap()));
    }

    #[test]
    fn a_lost_device_stays_lost_and_the_first_reason_counts() {
        let (mut care, reason) = care();
        care.hear(0x302);
        care.hear(0x300);
        care.hear(0x200);
        (0..5000).for_each(|_| care.go_on(0.001, || 0.0));
        assert_eq!(care.status(), DeviceStatus::Lost);
        assert!(reason.why().unwrap().contains("HD_COMM_ERROR (0x302)"));
    }

    #[test]
    fn single_complaints_are_forgotten_and_endless_ones_are_not() {
        let (mut care, reason) = care();
        for _ in 0..1000 {
            care.hear(0x402);
            care.go_on(0.001, || 0.0);
            care.go_on(0.001, || 0.0);
        }
        assert_eq!((care.status(), reason.why()), (DeviceStatus::Ready, None));
        for _ in 0..=COMPLAINTS {
            care.hear(0x402);
            care.go_on(0.001, || 0.0);
        }
        assert_eq!(care.status(), DeviceStatus::Lost);
    }

    #[test]
    fn an_uncalibrated_device_is_not_pushed() {
        let (mut care, reason) = care();
        care.check(calibration::OK);
        assert_eq!(care.status(), DeviceStatus::Ready);
        care.check(calibration::NEEDS_MANUAL_INPUT);
        assert_eq!(care.status(), DeviceStatus::Warm);
        assert!(reason.why().unwrap().contains("inkwell"));
    }
}
