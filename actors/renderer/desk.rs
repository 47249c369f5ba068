//! What happens in a window: devices, the menu, the game, the next picture.

use super::hud;
use super::keys::{button, key, menu_input, notches};
use super::pointer::Pointer;
use super::running::Running;
use super::stage::{BACKGROUND, Stage};
use super::window::{Backdrop, GameEnded, Host, WindowSetup};
use crate::error::Error;
use crate::pacer::StopFlag;
use hapticbillard::input::{Button, HumanMode, Key, RawInput};
use hapticbillard::menu::{Deed, Menu, MenuInput};
use hapticbillard::renderer::{DrawList, Hud, MenuLayout, MenuPanel, Words};
use hapticbillard::rules::Language;
use std::time::{Duration, Instant};
use three_d::{ClearState, CoreError, GUI, RenderTarget, Viewport, WindowedContext, egui};
use winit::event::{DeviceEvent, ElementState, Event, WindowEvent};
use winit::event_loop::{ControlFlow, EventLoopProxy};
use winit::window::{Fullscreen, Window};

/// A picture takes at least so long: 60 a second are enough.
const FRAME: Duration = Duration::from_micros(16_600);
/// What was set is written when nothing more was set for so long: a scale is pulled in many steps.
const KEEP_AFTER: Duration = Duration::from_millis(700);

/// The window with all that is drawn into it.
pub(super) struct Desk<'a> {
    window: Window,
    graphics: WindowedContext,
    gui: GUI,
    host: &'a mut dyn Host,
    ended: EventLoopProxy<GameEnded>,
    stop: StopFlag,
    system: Language,
    menu: Option<Menu>,
    words: Words,
    /// What is seen behind the main menu, and what the graphics card holds of it from when it is
    /// first needed.
    backdrop: Option<(Backdrop, Option<Stage>)>,
    game: Option<Running>,
    /// The game was told to go on, and has not yet done so.
    is_resuming: bool,
    /// Whoever plays has had enough of the game.
    is_leaving: bool,
    /// What was set and is not written yet.
    unkept: Option<Instant>,
    /// The volume that the game was last told.
    volume: Option<f32>,
    /// The line of a menu whose scale the pointer holds.
    dragged: Option<usize>,
    /// What went wrong with a game that no menu can tell of.
    failed: Option<Error>,
    pointer: Pointer,
    start: Instant,
    due: Instant,
    /// What the window shows now; none if it must be drawn again.
    shown: Option<(DrawList, Hud)>,
    is_focused: bool,
    held: Vec<Key>,
}

impl<'a> Desk<'a> {
    /// A window that begins with what its setup says.
    ///
    /// # Errors
    /// Why the game that shall begin at once cannot.
    pub fn new(
        window: Window,
        graphics: WindowedContext,
        setup: WindowSetup,
        host: &'a mut dyn Host,
        ended: EventLoopProxy<GameEnded>,
    ) -> Result<Self, Error> {
        let now = Instant::now();
        let gui = GUI::new(&graphics);
        let mut desk = Desk {
            window,
            gui,
            host,
            ended,
            stop: setup.stop,
            system: setup.language,
            words: Words::of_menus(setup.language),
            menu: setup.menu,
            backdrop: setup.backdrop.map(|backdrop| (backdrop, None)),
            game: None,
            is_resuming: false,
            is_leaving: false,
            unkept: None,
            volume: None,
            dragged: None,
            failed: None,
            pointer: Pointer::new(),
            start: now,
            due: now,
            shown: None,
            is_focused: false,
            held: Vec::new(),
            graphics,
        };
        desk.words = Words::of_menus(desk.language());
        if setup.begins {
            desk.begin(true)?
        } else {
            desk.open("main")
        }
        Ok(desk)
    }

    /// Whatever closed the window: the game ends between two ticks and closes its recording.
    pub fn end(mut self) -> Result<(), Error> {
        // The hand may wait for no more reports; the pointer is the desk's again.
        self.pointer.release(&self.window);
        self.keep();
        self.stop.set();
        if let Some(finished) = self.game.as_mut().and_then(Running::join) {
            let told = self.host.ended(&finished);
            finished?;
            told?;
        }
        self.failed.map_or(Ok(()), Err)
    }

    pub fn handle(&mut self, event: Event<'_, GameEnded>, flow: &mut ControlFlow) {
        match event {
            Event::WindowEvent { event, .. } => self.window_event(event, flow),
            Event::DeviceEvent { event: DeviceEvent::MouseMotion { delta }, .. } => {
                if let Some(by) = self.pointer.device_moved(delta) {
                    self.moved(by);
                }
            }
            Event::UserEvent(GameEnded) => self.game_ended(flow),
            Event::RedrawRequested(_) => self.shown = None,
            Event::MainEventsCleared => {
                if let Some(game) = &mut self.game {
                    game.outbox.send();
                }
                if self.stop.is_set() {
                    flow.set_exit();
                    return;
                }
                if self.unkept.is_some_and(|since| KEEP_AFTER <= since.elapsed()) {
                    self.keep();
                }
                if self.due <= Instant::now() {
                    self.draw();
                    self.due = (self.due + FRAME).max(Instant::now());
                }
                flow.set_wait_until(self.due);
            }
            _ => {}
        }
    }

    fn window_event(&mut self, event: WindowEvent<'_>, flow: &mut ControlFlow) {
        match event {
            WindowEvent::CloseRequested | WindowEvent::Destroyed => {
                self.say(RawInput::Closed);
                flow.set_exit();
            }
            WindowEvent::Resized(size) => {
                self.graphics.resize(size);
                self.shown = None;
            }
            WindowEvent::ScaleFactorChanged { new_inner_size, .. } => {
                self.graphics.resize(*new_inner_size);
                self.shown = None;
            }
            WindowEvent::Focused(is_focused) => {
                self.is_focused = is_focused;
                if !is_focused {
                    self.held.clear();
                    self.dragged = None;
                    self.say(RawInput::FocusLost);
                }
            }
            WindowEvent::CursorMoved { position, .. } => {
                match self.pointer.at(position, &self.window) {
                    Some(by) => self.moved(by),
                    None => self.point(flow),
                }
            }
            WindowEvent::MouseInput { state, button: which, .. } => {
                if let Some(which) = button(which) {
                    self.button(which, state == ElementState::Pressed, flow);
                }
            }
            WindowEvent::MouseWheel { delta, .. } if !self.is_menu_open() => {
                self.say(RawInput::Wheel { notches: notches(delta) });
            }
            WindowEvent::KeyboardInput { input, .. } => {
                let down = input.state == ElementState::Pressed;
                if let Some(key) = input.virtual_keycode.and_then(key) {
                    self.key(key, down, flow);
                }
            }
            _ => {}
        }
    }

    fn say(&mut self, report: RawInput) {
        if let Some(game) = &mut self.game {
            game.outbox.say(report);
        }
    }

    fn button(&mut self, button: Button, down: bool, flow: &mut ControlFlow) {
        if !down {
            self.dragged = None;
        }
        if self.is_menu_open() {
            if let (Button::Left, true, Some((line, share))) = (button, down, self.pointed()) {
                self.dragged = share.map(|_| line);
                self.hear(MenuInput::Press { line, share }, flow);
            }
            return;
        }
        let picked = if (button, down) == (Button::Left, true) { self.picked() } else { None };
        self.say(match picked {
            Some(option) => RawInput::Picked { option },
            None => RawInput::Button { button, down },
        });
    }

    fn key(&mut self, key: Key, down: bool, flow: &mut ControlFlow) {
        if self.is_menu_open() {
            // Repeats of a held key go on along the lines.
            if let Some(input) = menu_input(key).filter(|_| down) {
                self.hear(input, flow);
            }
            return;
        }
        let is_over = self.game.as_ref().is_some_and(Running::is_over);
        if is_over && down && matches!(key, Key::Escape | Key::Letter('q')) {
            flow.set_exit();
            return;
        }
        // Repeats of a held key are not reported.
        let was_down = self.held.contains(&key);
        if down == was_down {
            return;
        }
        if down {
            self.held.push(key);
            let now_s = self.now_s();
            let Some(game) = &mut self.game else { return };
            if key == Key::Letter('i') {
                game.shows_thoughts = !game.shows_thoughts;
                return;
            }
            if game.heard.as_mut().is_some_and(|heard| heard.turn(key, now_s)) {
                return;
            }
        } else {
            self.held.retain(|held| *held != key);
        }
        self.say(RawInput::Key { key, down });
    }

    /// The pointer moves in the window.
    fn point(&mut self, flow: &mut ControlFlow) {
        if !self.is_menu_open() {
            return;
        }
        let Some((line, share)) = self.pointed() else { return };
        match self.dragged {
            Some(dragged) if dragged == line => {
                // Pulled along a scale; what goes round is not turned by a trembling hand.
                let is_scale = self.panel().is_some_and(|panel| panel.lines[line].fill.is_some());
                if is_scale && share.is_some() {
                    self.hear(MenuInput::Press { line, share }, flow);
                }
            }
            Some(_) => {}
            None => self.hear(MenuInput::Over(line), flow),
        }
    }

    /// The line of the menu under the pointer.
    fn pointed(&self) -> Option<(usize, Option<f64>)> {
        let panel = self.panel()?;
        let size = self.window.inner_size().cast::<f64>();
        let layout = MenuLayout::new((size.width, size.height), panel.lines.len());
        layout.line_at(&panel, self.pointer.place()?)
    }

    fn panel(&self) -> Option<MenuPanel> {
        MenuPanel::new(self.menu.as_ref()?, &self.words)
    }

    /// The line of the options under a free pointer.
    fn picked(&self) -> Option<usize> {
        let (x, y) = self.pointer.place()?;
        let (_, hud) = self.shown.as_ref()?;
        let size = self.window.inner_size();
        hud::option_at(hud, (size.width as f32, size.height as f32), (x as f32, y as f32))
    }

    /// The mouse moved to the right and down [pixels].
    fn moved(&mut self, (right, down): (f64, f64)) {
        let factor = self.menu.as_ref().map_or(1.0, |menu| menu.settings.mouse_factor());
        let unit = factor / f64::from(self.window.inner_size().height.max(1));
        self.say(RawInput::Moved { right: right * unit, up: -down * unit });
    }

    fn is_menu_open(&self) -> bool {
        self.menu.as_ref().is_some_and(Menu::is_open)
    }

    fn open(&mut self, page: &str) {
        if let Some(menu) = &mut self.menu {
            menu.open(page);
        }
        // What was held when it opened is let go: its end would reach only the menu.
        self.held.clear();
        self.say(RawInput::FocusLost);
    }

    fn close(&mut self) {
        if let Some(menu) = &mut self.menu {
            menu.close();
        }
    }

    fn language(&self) -> Language {
        let system = self.system;
        self.menu.as_ref().map_or(system, |menu| menu.settings.language.language(system))
    }

    fn now_s(&self) -> f64 {
        self.start.elapsed().as_secs_f64()
    }

    /// Moves the menu, and does what it asks for.
    fn hear(&mut self, input: MenuInput, flow: &mut ControlFlow) {
        let Some(deed) = self.menu.as_mut().and_then(|menu| menu.hear(input)) else { return };
        match deed {
            Deed::Start | Deed::Again => {
                if let Err(error) = self.begin(deed == Deed::Again) {
                    self.complain(&error);
                }
            }
            Deed::Resume => {
                self.close();
                self.is_resuming = true;
                for down in [true, false] {
                    self.say(RawInput::Key { key: Key::Escape, down });
                }
            }
            Deed::Leave => self.leave(),
            Deed::Quit => {
                self.say(RawInput::Closed);
                flow.set_exit();
            }
            Deed::Changed => self.changed(),
        }
    }

    fn complain(&mut self, error: &Error) {
        log::warn!("{error}");
        let notice = self.words.fill("failed", "reason", &error.to_string());
        if let Some(menu) = &mut self.menu {
            menu.notice = Some(notice);
        }
    }

    /// A game begins in place of the one before.
    fn begin(&mut self, again: bool) -> Result<(), Error> {
        self.keep();
        self.game = None;
        let language = self.language();
        let settings = self.menu.as_ref().map(|menu| &menu.settings);
        let prepared = self.host.prepare(settings, language, again)?;
        let ended = self.ended.clone();
        let tell = move || {
            // A window that is gone need not be told.
            let _ = ended.send_event(GameEnded);
        };
        let game = Running::begin(prepared, &self.graphics, language, tell)?;
        self.game = Some(game);
        (self.is_resuming, self.is_leaving, self.volume) = (false, false, None);
        self.close();
        self.apply();
        Ok(())
    }

    /// The game ends, and the main menu opens.
    fn leave(&mut self) {
        match &self.game {
            Some(game) if !game.is_over() => {
                self.is_leaving = true;
                self.close();
                self.say(RawInput::Closed);
            }
            _ => {
                self.game = None;
                self.open("main");
            }
        }
    }

    fn game_ended(&mut self, flow: &mut ControlFlow) {
        self.pointer.release(&self.window);
        let now_s = self.now_s();
        let Some(game) = &mut self.game else { return };
        game.take_news(now_s);
        let has_result = game.board.over.is_some();
        let Some(finished) = game.join() else { return };
        let told = self.host.ended(&finished);
        let failed = finished.map_err(Error::from).and(told).err();
        match (failed, self.menu.is_some()) {
            (Some(error), true) => {
                self.game = None;
                self.open("main");
                self.complain(&error);
            }
            (Some(error), false) => {
                self.failed = Some(error);
                flow.set_exit();
            }
            // Everybody shall see who won.
            (None, _) if has_result && !self.is_leaving => self.open("over"),
            (None, true) if !self.stop.is_set() => {
                self.game = None;
                self.open("main");
            }
            // A game that was ended, not won, has nothing left to show.
            (None, _) => flow.set_exit(),
        }
    }

    /// Something was set.
    fn changed(&mut self) {
        self.unkept = Some(Instant::now());
        self.words = Words::of_menus(self.language());
        let is_full = self.menu.as_ref().is_some_and(|menu| menu.settings.full_screen);
        if is_full != self.window.fullscreen().is_some() {
            self.window.set_fullscreen(is_full.then_some(Fullscreen::Borderless(None)));
        }
        self.apply();
    }

    /// What is set becomes true in the game.
    fn apply(&mut self) {
        let language = self.language();
        let (Some(menu), Some(game)) = (&self.menu, &mut self.game) else { return };
        game.speak(language);
        // Keys turn it too: what is set acts when it is set.
        let volume = menu.settings.volume_factor();
        if let Some(heard) = game.heard.as_ref().filter(|_| self.volume != Some(volume)) {
            heard.set(volume);
            self.volume = Some(volume);
        }
    }

    /// Writes what is set, if it is not written.
    fn keep(&mut self) {
        if self.unkept.take().is_some()
            && let Some(menu) = &self.menu
        {
            self.host.keep(&menu.settings);
        }
    }

    /// What is drawn and written now.
    fn seen(&mut self) -> Option<(DrawList, Hud)> {
        let now_s = self.now_s();
        let panel = self.panel();
        let Some(game) = &mut self.game else {
            let (backdrop, _) = self.backdrop.as_ref()?;
            let list = (*backdrop.list).clone();
            return Some((list, Hud { menu: panel, ..Hud::default() }));
        };
        let view = game.view();
        let (list, mut hud) = game.seen(&view, now_s);
        if let Some(mut panel) = panel {
            if let (Some((title, _)), true) = (&hud.banner, game.is_over()) {
                panel.title.clone_from(title);
            }
            // The menu says it.
            (hud.banner, hud.help) = (None, None);
            (hud.hint, hud.help_hint) = (String::new(), String::new());
            hud.options.clear();
            hud.menu = Some(panel);
        }
        Some((list, hud))
    }

    fn draw(&mut self) {
        let now_s = self.now_s();
        if let Some(game) = &mut self.game {
            game.take_news(now_s);
            let is_paused = game.is_paused() && !game.is_over();
            self.is_resuming &= is_paused;
            if is_paused && !self.is_resuming && !self.is_leaving && !self.is_menu_open() {
                self.open("pause");
            }
        }
        self.hold_pointer();
        let Some((list, written)) = self.seen() else { return };
        let size = self.window.inner_size();
        let is_same = self.shown.as_ref().is_some_and(|(a, b)| (a, b) == (&list, &written));
        if is_same || size.width == 0 || size.height == 0 {
            return;
        }
        let viewport = Viewport::new_at_origo(size.width, size.height);
        let target = RenderTarget::screen(&self.graphics, size.width, size.height);
        let [r, g, b] = BACKGROUND;
        target.clear(ClearState::color_and_depth(r, g, b, 1.0, 1.0));
        self.gui.update(&mut [], now_s * 1e3, viewport, 1.0, |ui| {
            let layer = egui::LayerId::background();
            hud::paint(&ui.ctx().layer_painter(layer), &list, &written);
        });
        let stage = match (&mut self.game, &mut self.backdrop) {
            (Some(game), _) => &mut game.stage,
            (None, Some((backdrop, stage))) => {
                stage.get_or_insert_with(|| Stage::new(&self.graphics, &backdrop.table))
            }
            (None, None) => return,
        };
        let gui = &self.gui;
        let drawn = target.write::<CoreError>(|| {
            stage.draw(&list, viewport);
            gui.render()
        });
        match drawn.map(|_| self.graphics.swap_buffers()) {
            Ok(Ok(())) => self.shown = Some((list, written)),
            Ok(Err(error)) => log::warn!("the window shows nothing: {error}"),
            Err(error) => log::warn!("the window shows nothing: {error}"),
        }
    }

    /// While time stands still, something is to be chosen or no game goes on, the pointer belongs
    /// to the player's desk.
    fn hold_pointer(&mut self) {
        let goes_on = self.game.as_mut().is_some_and(|game| {
            let is_free = matches!(game.view().mode, HumanMode::Paused | HumanMode::Choosing);
            !is_free && !game.is_over()
        });
        let is_playing = self.is_focused && goes_on && !self.is_menu_open();
        if is_playing && !self.pointer.is_caught() {
            self.pointer.catch(&self.window);
        } else if !is_playing && self.pointer.is_caught() {
            self.pointer.release(&self.window);
        }
    }
}
