//! A haptic device in the window: the newest tick out of its slot, and what is drawn of it.

use super::stylus::StylusPort;
use crate::haptic::Timing;
use glam::DVec2;
use hapticbillard::haptic::ServoReport;
use hapticbillard::input::{HumanMode, HumanView, StylusMouse, StylusSays, View};
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
    /// Nobody else plays: the camera is behind its workspace. Beside a mouse that plays it is so
    /// while the stylus holds the cue.
    pub leads: bool,
    /// There are turns; in those of others the camera is elsewhere.
    pub has_turns: bool,
    /// A mouse moves the hand.
    pub by_mouse: bool,
    /// Somebody holds it who can point with it.
    pub stylus: Option<StylusPort>,
}

/// The window's end.
pub struct FeltScreen {
    setup: FeltSetup,
    overlay: Overlay,
    eye: FeltEye,
    /// It leads the cue, or nobody else plays.
    leads: bool,
    drawn_s: f64,
    asked_s: f64,
}

impl FeltScreen {
    /// Before the first tick.
    pub fn new(setup: FeltSetup) -> Self {
        let overlay = Overlay::new(setup.device.clone(), setup.look.force_max_n);
        let eye = FeltEye::new(setup.look.tool);
        let leads = setup.leads;
        FeltScreen { setup, overlay, eye, leads, drawn_s: 0.0, asked_s: -1.0 }
    }

    /// What its stylus says to a window of this size [pixels] since the last time, if it can point.
    pub fn says(&mut self, mouse: &mut StylusMouse, window: DVec2) -> Vec<StylusSays> {
        let Some(stylus) = &mut self.setup.stylus else { return Vec::new() };
        self.setup.report.update();
        stylus.says(self.setup.report.output_buffer(), mouse, window)
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
        if !self.setup.leads && self.setup.look.tool == FeltTool::Stylus {
            return view.clone();
        }
        if !self.setup.leads && view.mode != HumanMode::Paused {
            self.leads = view.mode == HumanMode::HoldingStylus
                || (self.leads && view.mode == HumanMode::Pointing);
        }
        let is_elsewhere = match view.mode {
            HumanMode::Placing | HumanMode::Pointing | HumanMode::Choosing => true,
            HumanMode::Watching => self.setup.has_turns,
            HumanMode::Aiming
            | HumanMode::HoldingStylus
            | HumanMode::Stroking
            | HumanMode::Paused => false,
        };
        // An eye that the stylus leads is where it was led to.
        let is_away = !self.leads || is_elsewhere || view.look.free;
        let wanted = match report.workspace {
            Some(workspace) if !is_away && view.look.view == View::Usual => {
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
        // Where the mouse has the cue, the world shows it.
        if self.leads || self.setup.look.tool == FeltTool::Stylus {
            list.show_felt(self.setup.report.output_buffer(), &self.setup.look);
        }
    }

    /// Whether a mouse moves the hand that holds the device.
    pub fn is_by_mouse(&self) -> bool {
        self.setup.by_mouse && self.leads
    }

    /// Adds it to what is written.
    pub fn write(&self, hud: Hud, view: &HumanView, words: &Words) -> Hud {
        let is_shown = self.setup.overlay != view.overlay;
        let panel = self.overlay.panel(words).filter(|_| is_shown);
        let by_mouse = self.is_by_mouse().then_some(self.setup.look.tool);
        let mut hud = hud.with_felt(panel, by_mouse, view, words);
        let aims = matches!(view.mode, HumanMode::Aiming | HumanMode::Stroking);
        if self.leads && by_mouse.is_none() && self.setup.look.tool == FeltTool::Cue && aims {
            hud.hint = words.get(if self.setup.leads { "felt_stylus" } else { "stylus" });
        }
        hud
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

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DMat3, DVec3};
    use hapticbillard::ball::{BallState, POOL_RADIUS_M};
    use hapticbillard::haptic::{ReachSettings, WorkspacePose};
    use hapticbillard::ids::BallId;
    use hapticbillard::renderer::Scoreboard;
    use hapticbillard::rules::{Language, Texts};

    const BALL: DVec3 = DVec3::new(0.0, 0.0, POOL_RADIUS_M);

    /// A stylus that points ahead, its tip a hand's breadth behind the cue ball.
    fn report() -> ServoReport {
        let turn = DMat3::from_cols(DVec3::NEG_Y, DVec3::Z, DVec3::NEG_X);
        let workspace =
            WorkspacePose { origin: BALL, turn, scale: 2.0, pivot: BALL, tip_radius_m: 0.006 };
        let tip = BALL - DVec3::X * 0.1;
        let mut report = ServoReport { proxy: tip, target: tip, ..ServoReport::default() };
        (report.sample.tip, report.sample.direction) = (tip, DVec3::X);
        report.workspace = Some(workspace);
        report
    }

    fn screen(leads: bool) -> FeltScreen {
        let (mut written, newest) = triple_buffer::triple_buffer(&ServoReport::default());
        written.write(report());
        let mut screen = FeltScreen::new(FeltSetup {
            report: newest,
            timing: Arc::default(),
            look: FeltLook::new(FeltTool::Cue, 3.3, &ReachSettings::default()),
            device: "test".into(),
            overlay: false,
            leads,
            has_turns: true,
            by_mouse: false,
            stylus: None,
        });
        screen.take(0.0);
        screen
    }

    /// What is seen of a player who does this: the view, whether the device is drawn, the hint.
    fn seen(screen: &mut FeltScreen, mode: HumanMode) -> (HumanView, bool, String) {
        let balls = vec![BallState::at_rest(BallId::CUE, BALL)];
        let world = Snapshot { balls, ..Snapshot::default() };
        let table = Table::preset("pool-9ft").unwrap();
        let (radii, words) = (Radii::default(), Words::new(Language::English));
        let view = HumanView { mode, ..HumanView::default() };
        let view = screen.view(&view, &world, &table, &radii, 100.0);
        let mut list = DrawList::new(&world, &view, &radii);
        screen.draw(&mut list);
        let board = Scoreboard::new(Vec::new());
        let hud = Hud::new(&board, &view, &Texts::new(Language::English), &words);
        let hint = screen.write(hud, &view, &words).hint;
        (view, !list.solids.is_empty(), hint)
    }

    #[test]
    fn beside_a_mouse_the_device_is_seen_while_it_has_the_cue() {
        let mut screen = screen(false);
        let usual = HumanView::default().camera;
        let (view, is_drawn, _) = seen(&mut screen, HumanMode::Aiming);
        assert_eq!((view.mode, view.camera, is_drawn), (HumanMode::Aiming, usual, false));
        let (view, is_drawn, hint) = seen(&mut screen, HumanMode::HoldingStylus);
        assert!(view.ghost.is_some() && view.mode == HumanMode::Aiming && is_drawn);
        assert!(hint.contains("The mouse turns the table"), "{hint}");
        // A pause changes nothing.
        assert!(seen(&mut screen, HumanMode::Paused).1);
        assert!(!seen(&mut screen, HumanMode::Placing).1);
        assert!(!seen(&mut screen, HumanMode::Paused).1);
    }

    #[test]
    fn alone_with_a_device_it_is_always_seen() {
        let mut screen = screen(true);
        let (view, is_drawn, hint) = seen(&mut screen, HumanMode::Aiming);
        assert!(view.camera != HumanView::default().camera && is_drawn);
        assert!(hint.contains("edge of the box"), "{hint}");
        assert!(seen(&mut screen, HumanMode::Placing).1);
    }
}
