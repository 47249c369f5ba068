//! A stylus that points in the window: the ends that a game's servo has for it, and a servo without
//! a game for the menus, which never pushes.

use crate::haptic::{NoServo, Opened, Plan, Seat, Started, Watch};
use glam::{DVec2, DVec3};
use hapticbillard::haptic::{ButtonEdge, Leads, ServoReport};
use hapticbillard::input::{StylusMouse, StylusSays};
use std::sync::Arc;

/// The window's end of a stylus that can point.
pub struct StylusPort {
    /// Every press and release.
    pub buttons: rtrb::Consumer<ButtonEdge>,
    /// Its workspace [m].
    pub workspace_m: DVec3,
}

impl StylusPort {
    /// What it says by its servo's newest tick, to a window of this size [pixels], since the last
    /// time.
    pub fn says(
        &mut self,
        report: &ServoReport,
        mouse: &mut StylusMouse,
        window: DVec2,
    ) -> Vec<StylusSays> {
        // Before the first tick nothing was read.
        if report.counters.ticks == 0 {
            return Vec::new();
        }
        let edges = std::iter::from_fn(|| self.buttons.pop().ok());
        mouse.hear(&report.sample.device, edges, window, self.workspace_m)
    }
}

/// A stylus while no game has it. Dropping it closes the device.
pub struct DeskStylus {
    port: StylusPort,
    report: triple_buffer::Output<ServoReport>,
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
        Ok(DeskStylus { port: StylusPort { buttons, workspace_m }, report, _seat: seat })
    }

    /// What it says to a window of this size [pixels] since the last time.
    pub fn says(&mut self, mouse: &mut StylusMouse, window: DVec2) -> Vec<StylusSays> {
        self.port.says(self.report.read(), mouse, window)
    }
}
