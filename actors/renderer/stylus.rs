//! A stylus that points at menus: its servo runs without a game, and without any force.

use crate::haptic::{NoServo, Opened, Plan, Seat, Started, Watch};
use glam::{DVec2, DVec3};
use hapticbillard::haptic::{ButtonEdge, DeviceState, Leads, ServoReport};
use hapticbillard::input::{StylusMouse, StylusSays};
use std::sync::Arc;

/// The window's ends of a stylus.
pub struct StylusPort {
    /// The servo's newest tick.
    pub report: triple_buffer::Output<ServoReport>,
    /// Every press and release.
    pub buttons: rtrb::Consumer<ButtonEdge>,
    /// Its workspace [m].
    pub workspace_m: DVec3,
}

impl StylusPort {
    /// What it says to a window of this size [pixels] since the last time.
    pub fn says(&mut self, mouse: &mut StylusMouse, window: DVec2) -> Vec<StylusSays> {
        let StylusPort { report, buttons, workspace_m } = self;
        report.update();
        let state = heard(report.output_buffer());
        let edges = std::iter::from_fn(|| buttons.pop().ok());
        mouse.hear(&state, edges, window, *workspace_m)
    }
}

/// What the device said in a tick.
fn heard(report: &ServoReport) -> DeviceState {
    report.sample.device
}

/// A stylus while no game has it. Dropping it closes the device.
pub struct DeskStylus {
    port: StylusPort,
    _seat: Arc<Seat>,
}

impl DeskStylus {
    /// Begins to hear a device. Nobody holds its dead man's switch: it is without force.
    ///
    /// # Errors
    /// [`NoServo`] if there is no thread, or the device's own scheduler does not start.
    pub fn start(opened: Opened) -> Result<Self, NoServo> {
        let workspace_m = opened.device.spec().workspace_m;
        let (mut watch, buttons) = Watch::default().with_buttons();
        let (picture, report) = triple_buffer::triple_buffer(&ServoReport::default());
        watch.picture = Some(picture);
        let Started { seat, .. } = Seat::start_watched(Plan::idle(opened), watch)?;
        seat.signs().lead(Leads::Pointer);
        Ok(DeskStylus { port: StylusPort { report, buttons, workspace_m }, _seat: seat })
    }

    /// What it says to a window of this size [pixels] since the last time.
    pub fn says(&mut self, mouse: &mut StylusMouse, window: DVec2) -> Vec<StylusSays> {
        self.port.says(mouse, window)
    }
}
