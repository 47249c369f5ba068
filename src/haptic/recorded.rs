//! The recorded device: says again what another device said, whatever force is written to it.
//!
//! It goes by time. Read in the rhythm in which it was recorded it gives reading after reading, so
//! that a servo computes the same bits again; read in another rhythm it gives the reading that is
//! nearest, but passes none at which buttons or status change. At its end it rests where it was
//! last, without speed, and has let go of its buttons.

use super::device::{Buttons, Device, DeviceSpec, DeviceState, Force};
use super::recording::DeviceRecording;
use crate::units::Seconds;
use glam::DVec3;
use std::sync::Arc;

/// A device that exists only as a recording.
#[derive(Debug, Clone)]
pub struct RecordedDevice {
    recording: Arc<DeviceRecording>,
    /// The reading that counts.
    at: usize,
    /// Its time, and the time now, both since the first reading [s].
    at_s: Seconds,
    time_s: Seconds,
    is_begun: bool,
    is_over: bool,
}

impl RecordedDevice {
    /// A device at the begin of a recording.
    pub fn new(recording: Arc<DeviceRecording>) -> Self {
        RecordedDevice { recording, at: 0, at_s: 0.0, time_s: 0.0, is_begun: false, is_over: false }
    }

    fn said(&self) -> DeviceState {
        self.recording.readings.get(self.at).map(|reading| reading.state).unwrap_or_default()
    }

    /// Goes on to the reading that is due. The last one is said once at least.
    fn go_on(&mut self) {
        let Some(last) = self.recording.readings.len().checked_sub(1) else { return };
        if self.at == last {
            let dt = self.recording.readings[last].dt;
            self.is_over |= self.at_s + 0.5 * dt < self.time_s;
        }
        while let Some(next) = self.recording.readings.get(self.at + 1) {
            if self.time_s < self.at_s + 0.5 * next.dt {
                return;
            }
            let (before, now) = (self.said(), next.state);
            self.at_s += next.dt;
            self.at += 1;
            if (before.buttons, before.status) != (now.buttons, now.status) {
                return;
            }
        }
    }
}

impl Device for RecordedDevice {
    fn spec(&self) -> DeviceSpec {
        self.recording.spec
    }

    fn read(&mut self, dt: Seconds) -> DeviceState {
        if std::mem::replace(&mut self.is_begun, true) {
            self.time_s += dt;
            self.go_on();
        }
        match self.is_over {
            false => self.said(),
            true => {
                DeviceState { velocity: DVec3::ZERO, buttons: Buttons::default(), ..self.said() }
            }
        }
    }

    fn write(&mut self, _: Force) {}
}
