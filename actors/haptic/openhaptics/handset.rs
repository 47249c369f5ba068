//! The device as the servo sees it: one frame of the library per turn, begun by the reading and
//! ended by the force. It runs in the library's callback: no allocation, lock or log.

use super::care::{Care, Reason};
use super::hd::{calibration, capability, parameter};
use super::session::Session;
use hapticbillard::haptic::openhaptics::HdReading;
use hapticbillard::haptic::{Device, DeviceSpec, DeviceState, DeviceStatus, Force};
use hapticbillard::units::Seconds;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// An open device in the library's loop.
pub struct Handset {
    session: Arc<Session>,
    care: Care,
    last: DeviceState,
    is_in_frame: bool,
    /// Whether its motors get anything.
    is_output_on: bool,
    /// It is lost, and was told so with a last force of zero.
    is_parted: bool,
    /// The library's loop has ended: nothing is sent any more.
    closed: Arc<AtomicBool>,
}

impl Handset {
    /// A device whose output is on.
    pub fn new(session: Arc<Session>, reason: Arc<Reason>, closed: Arc<AtomicBool>) -> Self {
        Handset {
            session,
            care: Care::new(reason),
            last: DeviceState::default(),
            is_in_frame: false,
            is_output_on: true,
            is_parted: false,
            closed,
        }
    }

    fn begin(&mut self) {
        if !self.is_in_frame {
            self.session.hd().begin_frame(self.session.device());
            self.is_in_frame = true;
        }
    }

    /// Takes in what went wrong, and switches the motors accordingly.
    fn listen(&mut self) {
        let hd = self.session.hd();
        for code in hd.errors() {
            self.care.hear(code);
        }
        let wanted = self.care.status() == DeviceStatus::Ready;
        if wanted != self.is_output_on {
            hd.switch(capability::FORCE_OUTPUT, wanted);
            self.is_output_on = wanted;
        }
    }

    fn calibrate(&mut self) {
        let hd = self.session.hd();
        let Some(style) = self.session.style else { return };
        let state = hd.check_calibration();
        if state == calibration::NEEDS_UPDATE && style != calibration::ENCODER_RESET {
            hd.update_calibration(style);
        }
        self.care.check(state);
    }

    fn reading(&self) -> DeviceState {
        let hd = self.session.hd();
        let vector = |parameter| {
            let [x, y, z, ..] = hd.doubles(parameter);
            [x, y, z]
        };
        let transform = match self.session.spec.senses_orientation {
            true => hd.doubles(parameter::CURRENT_TRANSFORM),
            false => Default::default(),
        };
        let said = HdReading {
            position_mm: vector(parameter::CURRENT_POSITION),
            velocity_mm_s: vector(parameter::CURRENT_VELOCITY),
            transform,
            buttons: hd.integer(parameter::CURRENT_BUTTONS),
        };
        said.state(&self.session.spec, self.session.centre_m)
    }
}

impl Device for Handset {
    fn spec(&self) -> DeviceSpec {
        self.session.spec
    }

    fn read(&mut self, dt: Seconds) -> DeviceState {
        let hd = self.session.current();
        self.care.go_on(dt, || hd.temperature());
        if self.is_parted {
            return self.last;
        }
        self.calibrate();
        self.begin();
        let now = self.reading();
        self.listen();
        let status = self.care.status();
        // What a lost device says may be anything; the last good reading stays.
        let reading = if status == DeviceStatus::Lost { self.last } else { now };
        self.last = DeviceState { status, ..reading };
        self.last
    }

    fn write(&mut self, force: Force) {
        if self.is_parted || self.closed.load(Ordering::Acquire) {
            return;
        }
        self.begin();
        let hd = self.session.current();
        hd.set_force(force.0.to_array());
        hd.end_frame(self.session.device());
        self.is_in_frame = false;
        // An error that comes only now lets the motors go at once; the next turn sends zero.
        let was_lost = self.last.status == DeviceStatus::Lost;
        self.listen();
        self.is_parted = was_lost;
    }
}
