//! What happens in a window: devices, the menu, the game, the next picture.

mod aids;
mod devices;
mod drawing;

use super::gl_window::{GlWindow, NotShown};
use super::keys::{button, key, notches};
use super::painter::Painter;
use super::pointer::Pointer;
use super::running::Running;
use super::seeker::Seeker;
use super::stage::Stage;
use super::stylus::DeskStylus;
use super::window::{Backdrop, GameEnded, Host, WindowSetup};
use crate::conductor::RunError;
use crate::error::Error;
use crate::input::PadDriver;
use crate::pacer::StopFlag;
use hapticbillard::input::{
    Action, AimAid, Button, Controller, HandInput, RawInput, Steering, StylusMouse, View,
};
use hapticbillard::menu::{Begin, HapticChoice, Lobby, Order};
use hapticbillard::picture::PictureSettings;
use hapticbillard::renderer::{DrawList, Hud, MenuPanel, Words};
use hapticbillard::rules::Language;
use std::mem::{forget, replace};
use std::time::{Duration, Instant};
use three_d::{CoreError, GUI};
use winit::event::{DeviceEvent, ElementState, Event, WindowEvent};
use winit::event_loop::{ControlFlow, EventLoopProxy};
use winit::window::{Fullscreen, Window};

/// How long nothing is looked at when there was nothing new: nobody sees less.
const IDLE: Duration = Duration::from_millis(4);
/// How long it is said where a picture went, or that a gamepad is gone.
const SAID: Duration = Duration::from_secs(4);
/// How long it is said what is wrong with a file of keys: a path and a line are to be read.
const SAID_LONG: Duration = Duration::from_secs(20);
/// What was set is written when nothing more was set for so long: a scale is pulled in many steps.
const KEEP_AFTER: Duration = Duration::from_millis(700);

/// So often everything may be lost before a picture is shown.
const LOSSES: u32 = 5;
/// How long a card is left alone that loses everything again.
const LOSS_PAUSE: Duration = Duration::from_millis(500);

/// Why nothing can be drawn.
fn no_stage(error: CoreError) -> Error {
    RunError::Start(format!("OpenGL: {error}")).into()
}

/// The window with all that is drawn into it.
pub(super) struct Desk<'a> {
    gui: GUI,
    painter: Painter,
    host: &'a mut dyn Host,
    ended: EventLoopProxy<GameEnded>,
    stop: StopFlag,
    system: Language,
    /// How pictures are drawn without a menu.
    picture: PictureSettings,
    lobby: Lobby,
    /// The language of everything, its words of the menus, and those over a picture.
    spoken: Language,
    words: Words,
    over: Words,
    /// What is seen behind the main menu, and what the graphics card holds of it; none before it
    /// is needed.
    backdrop: Option<(DrawList, Stage)>,
    game: Option<Running>,
    /// What was set and is not written yet.
    unkept: Option<Instant>,
    /// The volume and the help to aim that the game was last told.
    volume: Option<f32>,
    aid: Option<AimAid>,
    /// What went wrong with a game that no menu can tell of.
    failed: Option<Error>,
    pointer: Pointer,
    pads: Option<PadDriver>,
    start: Instant,
    due: Instant,
    /// The window shall fill the screen, as it is set.
    is_full: bool,
    /// The panel of the runtime is shown.
    shows_meters: bool,
    /// The next picture is kept in a file.
    wants_picture: bool,
    /// What is said of that, and until when.
    said: Option<(String, Instant)>,
    /// What the window shows now; none if it must be drawn again.
    shown: Option<(DrawList, Hud)>,
    is_focused: bool,
    /// From where the player likes to look.
    view: View,
    /// Who looks for a stylus that no game has.
    seeker: Seeker,
    /// That stylus, and what it is as a mouse.
    stylus: Option<DeskStylus>,
    stylus_mouse: StylusMouse,
    /// It was moved later than the mouse.
    is_by_stylus: bool,
    /// The device that it is one of.
    haptic: Option<HapticChoice>,
    steering: Option<Steering>,
    /// How often everything was lost since the last picture that was shown.
    losses: u32,
    /// After what the card holds, which goes while there is still a context.
    graphics: GlWindow,
    /// Last, since it outlives what is drawn into it.
    window: Window,
}

impl<'a> Desk<'a> {
    /// A window that begins with what its setup says.
    ///
    /// # Errors
    /// Why the game that shall begin at once cannot.
    pub fn new(
        window: Window,
        graphics: GlWindow,
        setup: WindowSetup,
        host: &'a mut dyn Host,
        ended: EventLoopProxy<GameEnded>,
    ) -> Result<Self, Error> {
        let now = Instant::now();
        let gui = GUI::new(&graphics);
        let painter = Painter::new(&graphics).map_err(no_stage)?;
        let mut desk = Desk {
            window,
            gui,
            painter,
            host,
            ended,
            stop: setup.stop,
            system: setup.language,
            picture: setup.picture,
            spoken: setup.language,
            words: Words::of_menus(setup.language).with_keys(&setup.keys.0),
            over: Words::new(setup.language).with_keys(&setup.keys.0),
            is_full: setup.menu.as_ref().is_some_and(|menu| menu.settings.full_screen),
            lobby: Lobby::new(setup.menu).with_bindings(setup.keys.0),
            shows_meters: false,
            backdrop: None,
            game: None,
            unkept: None,
            volume: None,
            aid: None,
            failed: None,
            pointer: Pointer::new(),
            pads: setup.pads,
            start: now,
            due: now,
            wants_picture: false,
            said: None,
            shown: None,
            is_focused: false,
            view: View::Usual,
            seeker: Seeker::default(),
            stylus: None,
            stylus_mouse: StylusMouse::default(),
            is_by_stylus: false,
            haptic: None,
            steering: None,
            losses: 0,
            graphics,
        };
        desk.speak();
        desk.lobby.resize(desk.size());
        if let Some(problem) = setup.keys.1 {
            let said = desk.over.fill("keys_bad", "problem", &problem);
            desk.said = Some((said, now + SAID_LONG));
        }
        if setup.begins {
            desk.begin(Begin::Again)?
        } else {
            desk.lobby.open_main();
            desk.unkept = desk.lobby.welcome().then_some(now);
            desk.set_up_backdrop()?;
            desk.take_up_stylus();
        }
        Ok(desk)
    }

    /// Whatever closed the window: the game ends between two ticks and closes its recording.
    pub fn end(mut self) -> Result<(), Error> {
        // The hand may wait for no more reports; the pointer is the desk's again.
        self.pointer.release(&self.window);
        self.free_stylus();
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
                    self.moved(by, flow);
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
                self.hear_pads(flow);
                self.hear_stylus(flow);
                if self.unkept.is_some_and(|since| KEEP_AFTER <= since.elapsed()) {
                    self.keep();
                    self.change_stylus();
                }
                if self.due <= Instant::now() {
                    let is_new = match self.draw() {
                        Err(NotShown::Lost) => {
                            if let Err(error) = self.renew() {
                                self.failed = Some(error);
                                flow.set_exit();
                                return;
                            }
                            true
                        }
                        Err(error) => {
                            tracing::warn!("the window shows nothing: {error}");
                            true
                        }
                        Ok(is_new) => is_new,
                    };
                    let period =
                        Duration::from_secs_f64(self.picture_settings().frame_limit.period_s());
                    let wait = if is_new { period } else { period.max(IDLE) };
                    let now = Instant::now();
                    // Without a limit nothing is made up for.
                    self.due = (self.due + wait).max(if is_new { now } else { now + IDLE });
                }
                flow.set_wait_until(self.due);
            }
            _ => {}
        }
    }

    fn window_event(&mut self, event: WindowEvent<'_>, flow: &mut ControlFlow) {
        match event {
            WindowEvent::CloseRequested | WindowEvent::Destroyed => {
                self.hear(RawInput::Closed, flow);
            }
            WindowEvent::Resized(size) => {
                self.graphics.resize(size);
                self.lobby.resize(self.size());
                self.shown = None;
            }
            WindowEvent::ScaleFactorChanged { new_inner_size, .. } => {
                self.graphics.resize(*new_inner_size);
                self.lobby.resize(self.size());
                self.shown = None;
            }
            WindowEvent::Focused(is_focused) => {
                self.is_focused = is_focused;
                if !is_focused {
                    self.hear(RawInput::FocusLost, flow);
                }
            }
            WindowEvent::CursorMoved { position, .. } => {
                self.is_by_stylus = false;
                match self.pointer.at(position, &self.window) {
                    Some(by) => self.moved(by, flow),
                    None => {
                        let orders = self.lobby.point(self.pointed());
                        self.obey(orders, flow);
                    }
                }
            }
            WindowEvent::MouseInput { state, button: which, .. } => {
                if let Some(button) = button(which) {
                    let down = state == ElementState::Pressed;
                    self.hear(RawInput::Button { button, down }, flow);
                }
            }
            WindowEvent::MouseWheel { delta, .. } => {
                self.hear(RawInput::Wheel { notches: notches(delta) }, flow);
            }
            WindowEvent::KeyboardInput { input, .. } => {
                if let Some(key) = input.virtual_keycode.and_then(key) {
                    let down = input.state == ElementState::Pressed;
                    self.hear(RawInput::Key { key, down }, flow);
                }
            }
            _ => {}
        }
    }

    /// A device says something.
    fn hear(&mut self, report: RawInput, flow: &mut ControlFlow) {
        let is_click = report == RawInput::Button { button: Button::Left, down: true };
        let report = match self.picked().filter(|_| is_click && !self.lobby.is_menu_open()) {
            Some(option) => RawInput::Picked { option },
            None => report,
        };
        let orders = self.lobby.hear(report, self.pointed());
        self.obey(orders, flow);
    }

    /// The mouse moved to the right and down [pixels].
    fn moved(&mut self, (right, down): (f64, f64), flow: &mut ControlFlow) {
        let height = f64::from(self.window.inner_size().height.max(1));
        self.hear(RawInput::Moved { right: right / height, up: -down / height }, flow);
    }

    fn obey(&mut self, orders: Vec<Order>, flow: &mut ControlFlow) {
        for order in orders {
            match order {
                Order::Tell(input) => self.tell(input),
                Order::Do(action) => self.act(action),
                Order::Say(key) => self.say(self.over.get(key)),
                Order::Replay(is_shown) => {
                    self.game.iter_mut().for_each(|game| game.screen(is_shown));
                }
                Order::Onlook(input) => {
                    self.game.iter_mut().for_each(|game| game.film.onlook(input));
                }
                Order::Begin(begin) => {
                    if let Err(error) = self.begin(begin) {
                        self.take_up_stylus();
                        self.complain(error, flow);
                    }
                }
                Order::Clear => {
                    self.game = None;
                    if let Err(error) = self.set_up_backdrop() {
                        self.complain(error, flow);
                    }
                }
                Order::Apply => self.changed(),
                Order::Rebound => {
                    self.host.keep_keys(self.lobby.bindings());
                    self.write_anew();
                }
                Order::Quit => flow.set_exit(),
            }
        }
    }

    fn tell(&mut self, input: HandInput) {
        if let Some(game) = &mut self.game {
            game.outbox.say(input);
        }
    }

    /// Does what is the window's to do.
    fn act(&mut self, action: Action) {
        if self.help_by(action) {
            return;
        }
        let now_s = self.now_s();
        match (action, &mut self.game) {
            // What stands there now is drawn again.
            (Action::Picture, _) => (self.wants_picture, self.shown) = (true, None),
            (Action::Meters, _) => self.shows_meters ^= true,
            (Action::Thoughts, Some(game)) => game.shows_thoughts ^= true,
            (_, Some(game)) if action.controller() == Controller::Sound => {
                game.heard.iter_mut().for_each(|heard| heard.turn(action, now_s));
            }
            _ => {}
        }
    }

    fn panel(&self) -> Option<MenuPanel> {
        MenuPanel::new(self.lobby.menu()?, &self.words)
    }

    fn language(&self) -> Language {
        let system = self.system;
        self.lobby.menu().map_or(system, |menu| menu.settings.language.language(system))
    }

    fn now_s(&self) -> f64 {
        self.start.elapsed().as_secs_f64()
    }

    /// A menu says what went wrong; without one nothing more is to be done.
    fn complain(&mut self, error: Error, flow: &mut ControlFlow) {
        tracing::warn!("{error}");
        if !self.lobby.complain(self.words.fill("failed", "reason", &error.to_string())) {
            self.failed = Some(error);
            flow.set_exit();
        }
    }

    /// A game begins in place of the one before.
    fn begin(&mut self, begin: Begin) -> Result<(), Error> {
        self.keep();
        // The device is the game's.
        self.game = None;
        self.free_stylus();
        self.view = View::Usual;
        let language = self.spoken;
        let settings = self.lobby.menu().map(|menu| &menu.settings);
        let prepared = self.host.prepare(settings, language, begin)?;
        let ended = self.ended.clone();
        let tell = move || {
            // A window that is gone need not be told.
            let _ = ended.send_event(GameEnded);
        };
        self.show_progress(0.1);
        let written = (language, self.lobby.bindings());
        let is_shaken = self.pads.is_some();
        let game = Running::begin(prepared, &self.graphics, written, is_shaken, tell)?;
        self.game = Some(game);
        (self.volume, self.aid, self.steering) = (None, None, None);
        self.lobby.began();
        self.apply();
        self.warm_up();
        Ok(())
    }

    /// A table behind the main menu, if there is one and it is not there yet.
    fn set_up_backdrop(&mut self) -> Result<(), Error> {
        if self.backdrop.is_none() && self.lobby.menu().is_some() {
            self.show_progress(0.1);
            let Backdrop { table, list } = self.host.backdrop()?;
            let stage = Stage::new(&self.graphics, &table).map_err(no_stage)?;
            self.backdrop = Some((list, stage));
            self.warm_up();
        }
        Ok(())
    }

    /// The graphics card lost everything: it gets it anew, and the game goes on.
    ///
    /// # Errors
    /// It is gone altogether.
    fn renew(&mut self) -> Result<(), Error> {
        self.losses += 1;
        if LOSSES < self.losses {
            return Err(RunError::Start(format!("{}, again and again", NotShown::Lost)).into());
        }
        tracing::warn!("{}; it gets everything anew", NotShown::Lost);
        // A card that comes back takes a while.
        if 1 < self.losses {
            std::thread::sleep(LOSS_PAUSE);
        }
        if let Err(error) = self.graphics.renew() {
            // It stays lost, and is asked again.
            tracing::warn!("{error}");
            return Ok(());
        }
        let graphics = &self.graphics;
        // What is dropped now would take things of the new context away, by their numbers.
        forget(replace(&mut self.gui, GUI::new(graphics)));
        forget(replace(&mut self.painter, Painter::new(graphics).map_err(no_stage)?));
        let backdrop = self.backdrop.as_mut().map(|(_, stage)| stage);
        for stage in backdrop.into_iter().chain(self.game.as_mut().map(|game| &mut game.stage)) {
            let anew = stage.anew(graphics).map_err(no_stage)?;
            forget(replace(stage, anew));
        }
        self.shown = None;
        self.warm_up();
        Ok(())
    }

    fn game_ended(&mut self, flow: &mut ControlFlow) {
        self.pointer.release(&self.window);
        let now_s = self.now_s();
        let Some(game) = &mut self.game else { return };
        game.take_news(now_s);
        let has_result = game.board.over.is_some();
        let Some(finished) = game.join() else { return };
        let told = self.host.ended(&finished);
        if let Err(error) = finished {
            self.lobby.open_main();
            self.obey(vec![Order::Clear], flow);
            self.take_up_stylus();
            self.complain(error.into(), flow);
            return;
        }
        if self.stop.is_set() {
            flow.set_exit();
        } else {
            let orders = self.lobby.ended(has_result);
            self.obey(orders, flow);
        }
        self.take_up_stylus();
        // What went wrong behind the game does not hide how it ended.
        if let Err(error) = told {
            self.complain(error, flow);
        }
    }

    /// Something was set.
    fn changed(&mut self) {
        self.unkept = Some(Instant::now());
        // The same things may look otherwise now.
        self.shown = None;
        self.speak();
        let is_full = self.lobby.menu().is_some_and(|menu| menu.settings.full_screen);
        if replace(&mut self.is_full, is_full) != is_full {
            self.window.set_fullscreen(is_full.then_some(Fullscreen::Borderless(None)));
        }
        self.apply();
    }

    /// Writes everything in the language that is set.
    fn speak(&mut self) {
        let language = self.language();
        if replace(&mut self.spoken, language) == language {
            return;
        }
        self.write_anew();
    }

    /// Writes everything anew: the language or the keys are others now.
    fn write_anew(&mut self) {
        let (language, bindings) = (self.spoken, self.lobby.bindings());
        self.words = Words::of_menus(language).with_keys(bindings);
        self.over = Words::new(language).with_keys(bindings);
        if let Some(game) = &mut self.game {
            game.speak(language, bindings);
        }
    }

    /// What is set becomes true in the game.
    fn apply(&mut self) {
        let (Some(menu), Some(game)) = (self.lobby.menu(), &mut self.game) else { return };
        let aid = menu.settings.aim_aid;
        if self.aid.replace(aid) != Some(aid) {
            game.outbox.say(HandInput::Aid(aid));
        }
        game.outbox.say(HandInput::StylusSpeed(menu.settings.stylus_factor()));
        let steering = menu.settings.steering;
        if self.steering.replace(steering) != Some(steering) {
            game.outbox.say(HandInput::Steering(steering));
        }
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
            && let Some(menu) = self.lobby.menu()
        {
            self.host.keep(&menu.settings);
        }
    }
}
