//! What a window shows: the next picture, and pictures that are kept.

use super::super::encoded;
use super::super::gl_window::NotShown;
use super::super::hud;
use super::super::stage::BACKGROUND;
use super::Desk;
use hapticbillard::menu::Order;
use hapticbillard::picture::PictureSettings;
use hapticbillard::renderer::{DrawList, HelpOf, Hud, WheelPanel};
use std::time::Instant;
use three_d::{ClearState, CoreError, RenderTarget, Viewport, egui};

impl Desk<'_> {
    /// How pictures are drawn.
    pub(super) fn picture_settings(&self) -> PictureSettings {
        self.lobby.menu().map_or(self.picture, |menu| menu.settings.picture)
    }

    /// Gets everything ready that pictures of what is shown now need, and says meanwhile how far
    /// that has come.
    pub(super) fn warm_up(&mut self) {
        self.show_progress(0.5);
        let Some((list, _)) = self.seen() else { return };
        let settings = self.picture_settings();
        let stage = match (&mut self.game, &mut self.backdrop) {
            (Some(game), _) => &mut game.stage,
            (None, Some((_, stage))) => stage,
            (None, None) => return,
        };
        // What is wrong is told with the first picture.
        let _ = self.painter.warm_up(stage, &list, &settings);
        self.show_progress(1.0);
    }

    /// Shows how much is ready [0 to 1], before there can be a picture.
    pub(super) fn show_progress(&mut self, share: f32) {
        let size = self.window.inner_size();
        if size.width == 0 || size.height == 0 {
            return;
        }
        let text = self.over.get("preparing");
        let viewport = Viewport::new_at_origo(size.width, size.height);
        self.gui.update(&mut [], self.start.elapsed().as_secs_f64() * 1e3, viewport, 1.0, |ui| {
            let layer = egui::LayerId::background();
            hud::progress(&ui.ctx().layer_painter(layer), &text, share);
        });
        let gui = &self.gui;
        let target = RenderTarget::screen(&self.graphics, size.width, size.height);
        let [r, g, b] = BACKGROUND;
        target.clear(ClearState::color_and_depth(r, g, b, 1.0, 1.0));
        // Nobody misses a bar; a window that shows nothing says so with the first picture.
        if target.write::<CoreError>(|| gui.render()).is_ok() {
            let _ = self.graphics.show();
        }
        self.shown = None;
    }

    /// What is drawn and written now.
    pub(super) fn seen(&mut self) -> Option<(DrawList, Hud)> {
        let now_s = self.now_s();
        let (help, picture) = (self.help(), self.picture_settings());
        // Both would stand on each other.
        let panel = self.panel().filter(|_| help.is_none());
        let Some(game) = &mut self.game else {
            let (list, _) = self.backdrop.as_ref()?;
            let pointer = self.pointer_shown();
            return Some((list.clone(), Hud { menu: panel, help, pointer, ..Hud::default() }));
        };
        let view = game.view();
        let words = &self.words;
        game.picture = picture;
        let wheel = self.lobby.wheel().map(|wheel| WheelPanel::new(wheel, words));
        let (list, mut hud) = game.seen(&view, self.lobby.is_by_pad(), now_s);
        if help.is_some() {
            (hud.help, hud.help_hint) = (help, String::new());
        }
        if let Some(mut panel) = panel {
            if let (Some((title, _)), true) = (&hud.banner, self.lobby.is_over()) {
                panel.title.clone_from(title);
            }
            // The menu says it.
            hud.banner = None;
            (hud.hint, hud.help_hint, hud.lesson) = (String::new(), String::new(), None);
            hud.options.clear();
            hud.menu = Some(panel);
        }
        hud.pointer = if wheel.is_none() { self.pointer_shown() } else { None };
        hud.wheel = wheel;
        Some((list, hud))
    }

    /// The table of controls, while it is wanted.
    pub(super) fn help(&self) -> Option<(String, Vec<(String, String)>)> {
        let is_by_pad = self.lobby.is_by_pad();
        let of = match &self.game {
            _ if !self.lobby.shows_help() => return None,
            Some(game) if !self.lobby.is_menu_open() => game.help(is_by_pad),
            _ => HelpOf::Menu,
        };
        Some((self.over.get("help_title"), self.over.help(of)))
    }

    /// Draws the next picture, if it is another one. Whether it was.
    ///
    /// # Errors
    /// The window does not show it.
    pub(super) fn draw(&mut self) -> Result<bool, NotShown> {
        // Nothing can be made where everything is lost.
        self.graphics.check()?;
        let now_s = self.now_s();
        let mut begun = None;
        if let Some(game) = &mut self.game {
            game.meters.show(self.shows_meters);
            begun = game.meters.now();
            game.take_news(now_s);
            for order in self.lobby.see(&game.view()) {
                if let Order::Tell(input) = order {
                    game.outbox.say(input);
                }
            }
            self.look_after_aids();
            let Some(game) = &mut self.game else { return Ok(false) };
            let felt = game.shake.take();
            let wants = self.lobby.menu().is_none_or(|menu| menu.settings.rumble);
            if let (Some(rumble), Some(pads), true) = (felt, &self.pads, wants) {
                pads.shake(rumble);
            }
        }
        self.hold_pointer();
        let Some((list, mut written)) = self.seen() else { return Ok(false) };
        self.said.take_if(|(_, until)| *until < Instant::now());
        written.message.extend(self.said.iter().map(|(said, _)| said.clone()));
        let size = self.window.inner_size();
        let is_same = self.shown.as_ref().is_some_and(|(a, b)| (a, b) == (&list, &written));
        if is_same || size.width == 0 || size.height == 0 {
            self.note_picture(None);
            return Ok(false);
        }
        let settings = self.picture_settings();
        let viewport = Viewport::new_at_origo(size.width, size.height);
        let scale = f32::from(settings.hud_scale) / 100.0;
        self.gui.update(&mut [], now_s * 1e3, viewport, 1.0, |ui| {
            let layer = egui::LayerId::background();
            hud::paint(&ui.ctx().layer_painter(layer), &list, &written, scale);
        });
        let stage = match (&mut self.game, &mut self.backdrop) {
            (Some(game), _) => &mut game.stage,
            (None, Some((_, stage))) => stage,
            (None, None) => return Ok(false),
        };
        let (gui, painter) = (&self.gui, &mut self.painter);
        let target = RenderTarget::screen(&self.graphics, size.width, size.height);
        let drawn =
            painter.prepare(stage, &list, &settings, (size.width, size.height)).and_then(|ready| {
                painter.finish(ready, stage, &list, &settings, &target, || gui.render())
            });
        let is_kept = std::mem::take(&mut self.wants_picture) && drawn.is_ok();
        let picture = is_kept.then(|| target.read_color::<[u8; 4]>());
        let shown = match drawn {
            Ok(()) => self.graphics.show(),
            // What is lost gives other errors, too.
            Err(error) => self.graphics.check().and(Err(NotShown::Other(error.to_string()))),
        };
        if let Err(error) = shown {
            self.wants_picture |= is_kept;
            return Err(error);
        }
        self.losses = 0;
        self.shown = Some((list, written));
        self.note_picture(begun);
        if let Some(rows) = picture {
            self.keep_picture(&rows, (size.width, size.height));
        }
        Ok(true)
    }

    /// A picture is there, begun then, or another one was not needed.
    pub(super) fn note_picture(&mut self, begun: Option<Instant>) {
        if let Some(game) = &mut self.game {
            game.meters.drawn(begun);
        }
    }

    /// Writes what the window shows into a file, and says where.
    pub(super) fn keep_picture(&mut self, rows: &[[u8; 4]], size: (u32, u32)) {
        let kept = encoded(rows, size)
            .map_err(|error| error.to_string())
            .and_then(|png| self.host.picture(&png).map_err(|error| error.to_string()));
        let words = &self.over;
        let said = match kept {
            Ok(path) => words.fill("picture", "path", &path.display().to_string()),
            Err(reason) => words.fill("no_picture", "reason", &reason),
        };
        self.say(said);
    }
}
