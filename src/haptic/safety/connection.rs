//! Stage 11: a device that is not ready is not pushed, and nothing is felt that nobody answers for.

use crate::haptic::device::DeviceStatus;

/// Whether the device may be pushed.
pub(super) fn is_open(status: DeviceStatus, is_live: bool) -> bool {
    is_live && status == DeviceStatus::Ready
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_ready_device_under_a_living_hand_is_pushed() {
        assert!(is_open(DeviceStatus::Ready, true));
        assert!(!is_open(DeviceStatus::Ready, false));
        assert!(!is_open(DeviceStatus::Warm, true));
        assert!(!is_open(DeviceStatus::Lost, true));
    }
}
