//! Gamepads and styluses at a window, and what points at things in it: the mouse, or a stylus.

use super::super::hud;
use super::Desk;
use glam::DVec2;
use hapticbillard::input::{HumanMode, PadInput, RawInput, StylusSays};
use hapticbillard::menu::{Order, Pointed};
use hapticbillard::renderer::MenuLayout;
use std::time::Duration;
use winit::event_loop::ControlFlow;

/// A device that is lost in the menus is sought so often.
const SEEK_AGAIN: Duration = Duration::from_secs(3);

impl Desk<'_> {
    /// Size of the window [pixels].
    pub(super) fn size(&self) -> DVec2 {
        let size = self.window.inner_size();
        DVec2::new(size.width.max(1).into(), size.height.max(1).into())
    }

    /// Gamepads have said something. They speak to every window, but only the one that has the
    /// keyboard is meant.
    pub(super) fn hear_pads(&mut self, flow: &mut ControlFlow) {
        let Some(pads) = &self.pads else { return };
        let orders = self.lobby.pass(self.now_s());
        let is_meant = |report: &PadInput| {
            self.is_focused || matches!(report, PadInput::Connected | PadInput::Lost)
        };
        for report in pads.take().into_iter().filter(is_meant).collect::<Vec<_>>() {
            self.hear(RawInput::Pad(report), flow);
        }
        self.obey(orders, flow);
    }

    /// A stylus has said something.
    pub(super) fn hear_stylus(&mut self, flow: &mut ControlFlow) {
        self.look_for_stylus();
        let window = self.size();
        let mouse = &mut self.stylus_mouse;
        let said = match (&mut self.stylus, &mut self.game) {
            (Some(stylus), _) => stylus.says(mouse, window),
            (None, Some(game)) => game.stylus_says(mouse, window),
            (None, None) => return,
        };
        for said in said {
            self.is_by_stylus = said != StylusSays::Lost;
            self.seeker.note(self.is_by_stylus);
            let place = self.stylus_mouse.place().unwrap_or(0.5 * window);
            let (pointed, picked) = (self.pointed(), self.picked());
            let orders = self.lobby.hear_stylus(said, place, pointed, picked);
            self.obey(orders, flow);
        }
    }

    /// Another device may be set. One that is not there lets a while pass, so it is asked only when
    /// nothing more is set.
    pub(super) fn change_stylus(&mut self) {
        self.speed_stylus();
        let haptic = self.lobby.menu().map(|menu| menu.settings.haptic);
        // A game that goes on keeps the device that it has.
        if std::mem::replace(&mut self.haptic, haptic) != haptic && !self.lobby.has_game() {
            self.take_up_stylus();
        }
    }

    /// Its pointer moves as far as is set. Not while a scale is pulled: a stylus that pulls that of
    /// its own speed would run away from itself.
    fn speed_stylus(&mut self) {
        let factor = self.lobby.menu().map_or(1.0, |menu| menu.settings.stylus_factor());
        self.stylus_mouse.set_faster(factor);
    }

    /// The device is free for a game; whoever looks for it is waited for.
    pub(super) fn free_stylus(&mut self) {
        self.seeker.give_up();
        self.drop_stylus();
    }

    /// No stylus is heard any more until another servo has its device; what it held is let go.
    fn drop_stylus(&mut self) {
        self.stylus = None;
        self.is_by_stylus = false;
        if let Some(lost) = self.stylus_mouse.let_go() {
            for order in self.lobby.hear_stylus(lost, DVec2::ZERO, None, None) {
                if let Order::Tell(input) = order {
                    self.tell(input);
                }
            }
        }
    }

    /// Menus hear the stylus of the device that is set, while no game has it. Taking it up goes on
    /// beside the menus.
    pub(super) fn take_up_stylus(&mut self) {
        self.drop_stylus();
        self.haptic = self.lobby.menu().map(|menu| menu.settings.haptic);
        self.speed_stylus();
        self.seek(false);
    }

    fn seek(&mut self, is_again: bool) {
        let Some(menu) = self.lobby.menu() else { return };
        if let Some(take_up) = self.host.stylus(&menu.settings) {
            self.seeker.seek(take_up, is_again);
        }
    }

    /// What came of taking a stylus up. One that was lost is sought again and again.
    fn look_for_stylus(&mut self) {
        match self.seeker.found() {
            Some(Ok(stylus)) => self.stylus = stylus,
            Some(Err(error)) => {
                tracing::warn!("{error}");
                self.lobby.complain(error.to_string());
            }
            None if self.seeker.is_lost_for(SEEK_AGAIN) && !self.lobby.has_game() => {
                // The device is let go of before it is opened anew.
                self.stylus = None;
                self.seek(true);
            }
            None => {}
        }
    }

    /// Where whatever was moved last points [pixels], unless it belongs to a game.
    fn place(&self) -> Option<(f64, f64)> {
        match self.stylus_mouse.place().filter(|_| self.is_by_stylus) {
            Some(place) => {
                let place = place.clamp(DVec2::ZERO, self.size() - DVec2::ONE);
                Some((place.x, place.y))
            }
            None => self.pointer.place(),
        }
    }

    /// The same, where the window shows it: the mouse has an arrow of its own.
    pub(super) fn pointer_shown(&self) -> Option<[f64; 2]> {
        let is_shown = self.is_by_stylus && self.lobby.is_pointed_at();
        self.place().filter(|_| is_shown).map(|(x, y)| [x, y])
    }

    /// The line of the menu under a free pointer.
    pub(super) fn pointed(&self) -> Option<Pointed> {
        let panel = self.panel()?;
        let size = self.window.inner_size().cast::<f64>();
        let layout = MenuLayout::new((size.width, size.height), panel.lines.len());
        layout.line_at(&panel, self.place()?)
    }

    /// The line of the options under a free pointer.
    pub(super) fn picked(&self) -> Option<usize> {
        let (x, y) = self.place()?;
        let (_, hud) = self.shown.as_ref()?;
        let size = self.window.inner_size();
        let scale = f32::from(self.picture_settings().hud_scale) / 100.0;
        let size = (size.width as f32, size.height as f32);
        hud::option_at(hud, size, scale, (x as f32, y as f32))
    }

    /// While time stands still, something is to be chosen or no game goes on, the pointer belongs
    /// to the player's desk.
    pub(super) fn hold_pointer(&mut self) {
        let is_free = |mode| matches!(mode, HumanMode::Paused | HumanMode::Choosing);
        let goes_on = self.game.as_mut().is_some_and(|game| !is_free(game.mode()));
        let is_seen = (goes_on && self.lobby.has_game()) || self.lobby.is_replaying();
        let is_playing = self.is_focused && is_seen && !self.lobby.is_menu_open();
        if is_playing && !self.pointer.is_caught() {
            self.pointer.catch(&self.window);
        } else if !is_playing && self.pointer.is_caught() {
            self.pointer.release(&self.window);
        }
    }
}
