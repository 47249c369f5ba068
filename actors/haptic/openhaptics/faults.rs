//! What the HD library reports, by number: its name, how bad it is, and what helps.

use super::hd::calibration;

/// How bad it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Class {
    /// The motors must rest, then it goes on.
    Rest,
    /// The device is gone.
    Loss,
    /// A request was not liked; nothing is broken.
    Complaint,
}

/// The library's name for an error, or for what a calibration needs.
pub fn name(code: u32) -> &'static str {
    match code {
        0x100 => "HD_INVALID_ENUM",
        0x101 => "HD_INVALID_VALUE",
        0x102 => "HD_INVALID_OPERATION",
        0x103 => "HD_INVALID_INPUT_TYPE",
        0x104 => "HD_BAD_HANDLE",
        0x200 => "HD_WARM_MOTORS",
        0x201 => "HD_EXCEEDED_MAX_FORCE",
        0x202 => "HD_EXCEEDED_MAX_FORCE_IMPULSE",
        0x203 => "HD_EXCEEDED_MAX_VELOCITY",
        0x204 => "HD_FORCE_ERROR",
        0x300 => "HD_DEVICE_FAULT",
        0x301 => "HD_DEVICE_ALREADY_INITIATED",
        0x302 => "HD_COMM_ERROR",
        0x303 => "HD_COMM_CONFIG_ERROR",
        0x304 => "HD_TIMER_ERROR",
        0x400 => "HD_ILLEGAL_BEGIN",
        0x401 => "HD_ILLEGAL_END",
        0x402 => "HD_FRAME_ERROR",
        0x500 => "HD_INVALID_PRIORITY",
        0x501 => "HD_SCHEDULER_FULL",
        0x600 => "HD_INVALID_LICENSE",
        calibration::NEEDS_UPDATE => "HD_CALIBRATION_NEEDS_UPDATE",
        calibration::NEEDS_MANUAL_INPUT => "HD_CALIBRATION_NEEDS_MANUAL_INPUT",
        _ => "an error",
    }
}

/// How bad an error is in a running loop.
pub fn class(code: u32) -> Class {
    match code {
        0x200..=0x2FF => Class::Rest,
        0x104 | 0x300..=0x3FF | 0x600 => Class::Loss,
        _ => Class::Complaint,
    }
}

/// What helps.
pub fn remedy(code: u32) -> &'static str {
    match code {
        0x101 => "its hardware has other rates",
        0x200 => "its motors are warm: no force until they have rested",
        0x201..=0x204 => "hold the stylus more firmly: the force comes back in a second",
        0x301 => "another program has the device: end it",
        0x104 | 0x300 | 0x302 | 0x303 => {
            "check the device's cable and power, then start the game again"
        }
        0x304 => "end other programs that use the device, then start the game again",
        0x600 => "install a licence as the vendor's guide says",
        calibration::NEEDS_UPDATE => "it calibrates itself: move the stylus a little",
        calibration::NEEDS_MANUAL_INPUT => "put the stylus into its inkwell",
        _ => "try the vendor's own diagnosis program",
    }
}

/// Name, number and remedy in a sentence.
pub fn sentence(code: u32) -> String {
    format!("the OpenHaptics library says {} ({code:#x}): {}", name(code), remedy(code))
}

/// Name and number.
pub fn short(code: u32) -> String {
    format!("{} ({code:#x})", name(code))
}
