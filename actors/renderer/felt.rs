//! A haptic device in the window: the newest tick out of its slot, and what is drawn of it.

use crate::haptic::Timing;
use hapticbillard::haptic::ServoReport;
use hapticbillard::input::{HumanMode, HumanView};
use hapticbillard::physics::Snapshot;
use hapticbillard::renderer::{
    DrawList, FeltEye, FeltLook, FeltTool, Hud, Overlay, Punctuality, Radii, Words, aimed_by_stylus,
};
use hapticbillard::table::Table;
use std::sync::Arc;

/// How often the histogram of lateness is read [s]: it is long.
const PUNCTUALITY_S: f64 = 0.25;

/// What a window shows of a haptic device.
pub struct FeltSetup {
    /// The servo's newest tick.
    pub report: triple_buffer::Output<ServoReport>,
    /// How punctual it is.
    pub timing: Arc<Timing>,
    /// How it is drawn.
    pub look: FeltLook,
    /// What it is called.
    pub device: String,
    /// The panel is there from the beginning.
    pub overlay: bool,
    /// Whoever holds it plays: the camera is behind its workspace.
    pub leads: bool,
    /// There are turns; in those of others the camera is elsewhere.
    pub has_turns: bool,
    /// A mouse moves the hand.
    pub by_mouse: bool,
}

/// The window's end.
pub struct FeltScreen {
    setup: FeltSetup,
    overlay: Overlay,
    eye: FeltEye,
    drawn_s: f64,
    asked_s: f64,
}

impl FeltScreen {
    /// Before the first tick.
    pub fn new(setup: FeltSetup) -> Self {
        let overlay = Overlay::new(setup.device.clone(), setup.look.force_max_n);
        let eye = FeltEye::new(setup.look.tool);
        FeltScreen { setup, overlay, eye, drawn_s: 0.0, asked_s: -1.0 }
    }

    /// Takes what is new at `now_s` on the window's clock.
    pub fn take(&mut self, now_s: f64) {
        self.setup.report.update();
        self.overlay.take(self.setup.report.output_buffer(), now_s);
        if self.asked_s + PUNCTUALITY_S <= now_s {
            self.asked_s = now_s;
            self.overlay.take_punctuality(punctuality(&self.setup.timing), now_s);
        }
    }

    /// The player's view, as whoever holds the device has it.
    pub fn view(
        &mut self,
        view: &HumanView,
        world: &Snapshot,
        table: &Table,
        radii: &Radii,
        now_s: f64,
    ) -> HumanView {
        let dt = now_s - std::mem::replace(&mut self.drawn_s, now_s);
        let report = self.setup.report.output_buffer();
        if !self.setup.leads {
            return view.clone();
        }
        let is_away = match view.mode {
            HumanMode::Placing => true,
            HumanMode::Watching => self.setup.has_turns,
            HumanMode::Aiming | HumanMode::Stroking | HumanMode::Paused => false,
        };
        let wanted = match report.workspace {
            Some(workspace) if !is_away && !view.look.bird => {
                self.eye.behind(&workspace, &view.look, world.is_rolling())
            }
            _ => view.camera,
        };
        let view = HumanView { camera: self.eye.follow(wanted, dt), ..view.clone() };
        if self.setup.look.tool == FeltTool::Stylus || is_away {
            return view;
        }
        aimed_by_stylus(&view, report, world, table, radii)
    }

    /// Adds it to a picture.
    pub fn draw(&mut self, list: &mut DrawList) {
        list.show_felt(self.setup.report.output_buffer(), &self.setup.look);
    }

    /// Adds it to what is written.
    pub fn write(&self, hud: Hud, view: &HumanView, words: &Words) -> Hud {
        let is_shown = self.setup.overlay != view.overlay;
        let panel = self.overlay.panel(words).filter(|_| is_shown);
        let by_mouse = self.setup.by_mouse.then_some(self.setup.look.tool);
        hud.with_felt(panel, by_mouse, view, words)
    }
}

fn punctuality(timing: &Timing) -> Punctuality {
    let late = &timing.lateness;
    let late_ns = [late.quantile(0.5), late.quantile(0.99), late.most()];
    Punctuality {
        ticks: timing.ticks(),
        missed: timing.missed(),
        late_s: late_ns.map(|ns| ns as f64 * 1e-9),
    }
}
