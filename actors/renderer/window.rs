//! The window: its own loop on the main thread, the game beside it on another.

use super::felt::{FeltScreen, FeltSetup};
use super::heard::{HeardScreen, HeardSetup};
use super::hud;
use super::outbox::Outbox;
use super::pointer::Pointer;
use super::stage::{BACKGROUND, Stage};
use crate::conductor::RunError;
use crate::event_manager::Sink;
use crate::pacer::StopFlag;
use hapticbillard::ids::GameKind;
use hapticbillard::input::{Button, HumanMode, HumanView, Key, RawInput};
use hapticbillard::physics::Snapshot;
use hapticbillard::renderer::{
    DrawList, Hud, Playhead, Radii, Scoreboard, ThoughtsPanel, Words, draw_thoughts,
};
use hapticbillard::rules::{Language, Texts};
use hapticbillard::table::Table;
use hapticbillard::tick::{Delivered, Finished};
use std::panic::{self, AssertUnwindSafe};
use std::sync::Arc;
use std::sync::atomic::AtomicU64;
use std::thread;
use std::time::{Duration, Instant};
use three_d::context::{HasContext, RENDERER};
use three_d::{ClearState, Context, CoreError, GUI, RenderTarget, SurfaceSettings, Viewport};
use three_d::{WindowedContext, egui};
use winit::dpi::PhysicalSize;
use winit::event::{DeviceEvent, ElementState, Event, MouseButton, MouseScrollDelta};
use winit::event::{VirtualKeyCode, WindowEvent};
use winit::event_loop::{ControlFlow, EventLoop, EventLoopBuilder};
use winit::platform::run_return::EventLoopExtRunReturn;
use winit::window::{Fullscreen, Window, WindowBuilder};

/// Reports that may wait for the hand, which empties the channel every tick; see [`Outbox`].
const REPORTS: usize = 1024;
/// Batches of events that may wait for a picture; what does not fit is counted as dropped.
const MAIL: usize = 4096;
/// A picture takes at least so long: 60 a second are enough.
const FRAME: Duration = Duration::from_micros(16_600);
/// Pixels of a touchpad's scrolling that count as one notch of a wheel.
const PIXELS_PER_NOTCH: f64 = 40.0;

/// Why there is no window.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct NoWindow(pub String);

/// What a window shows.
pub struct WindowSetup {
    /// Its title.
    pub title: String,
    /// Size of the picture [pixels].
    pub size: (u32, u32),
    /// Fills the whole screen.
    pub fullscreen: bool,
    /// The table.
    pub table: Arc<Table>,
    /// The balls' radii.
    pub radii: Radii,
    /// The world before the first tick.
    pub first: Arc<Snapshot>,
    /// Names of player 1 and player 2.
    pub names: Vec<String>,
    /// What is played, if anything.
    pub game: Option<GameKind>,
    /// Seconds of the game per second.
    pub speed: f64,
    /// The language of everything written.
    pub language: Language,
    /// Ends the game between two ticks.
    pub stop: StopFlag,
    /// The haptic device; none where a scene has none.
    pub felt: Option<FeltSetup>,
    /// Sound; none where a scene has none.
    pub heard: Option<HeardSetup>,
}

/// The game's ends of what joins it with its window.
pub struct Ports {
    /// What devices say.
    pub raw: flume::Receiver<RawInput>,
    /// What the hand sees and does.
    pub view: triple_buffer::Input<HumanView>,
    /// The newest state of the world.
    pub world: triple_buffer::Input<Arc<Snapshot>>,
    /// Where events for the scoreboard go.
    pub sink: Sink,
}

/// The window's ends.
struct Screen {
    outbox: Outbox,
    view: triple_buffer::Output<HumanView>,
    world: triple_buffer::Output<Arc<Snapshot>>,
    mail: flume::Receiver<Delivered>,
    playhead: Playhead,
    board: Scoreboard,
    texts: Texts,
    words: Words,
    radii: Radii,
    table: Arc<Table>,
    felt: Option<FeltScreen>,
    heard: Option<HeardScreen>,
    shows_thoughts: bool,
}

/// The game is over: its thread has nothing more to say.
struct GameEnded;

/// Shows `game` in a window until it is closed, and waits until the game has ended in order.
///
/// The window stays when the game is over, so that everybody sees who won.
///
/// # Errors
/// [`NoWindow`] if there can be no window; the game was not begun then.
pub fn show<G>(mut setup: WindowSetup, game: G) -> Result<Result<Finished, RunError>, NoWindow>
where
    G: FnOnce(Ports) -> Result<Finished, RunError> + Send + 'static,
{
    let (mut events, window) = open(&setup)?;
    let graphics = graphics(&window)?;
    let (raw_in, raw) = flume::bounded(REPORTS);
    let (view_in, view) = triple_buffer::triple_buffer(&HumanView::default());
    let (world_in, world) = triple_buffer::triple_buffer(&setup.first);
    let (mail_in, mail) = flume::bounded(MAIL);
    let sink =
        Sink { topics: Scoreboard::topics(), mail: mail_in, dropped: Arc::new(AtomicU64::new(0)) };
    let ports = Ports { raw, view: view_in, world: world_in, sink };

    let texts = Texts::new(setup.language);
    let texts = match &setup.names[..] {
        [one, two] => texts.with_names(one, two),
        [one] => texts.with_names(one, ""),
        _ => texts,
    };
    let texts = match setup.game {
        Some(game) => texts.for_game(game),
        None => texts,
    };
    let screen = Screen {
        outbox: Outbox::new(raw_in),
        view,
        world,
        mail,
        playhead: Playhead::new(setup.first.clone(), setup.speed),
        board: Scoreboard::new(setup.names.clone()),
        texts,
        words: Words::new(setup.language),
        radii: setup.radii.clone(),
        table: setup.table.clone(),
        felt: setup.felt.take().map(FeltScreen::new),
        heard: setup.heard.take().map(HeardScreen::new),
        shows_thoughts: false,
    };

    let ended = events.create_proxy();
    let thread = thread::Builder::new()
        .name("game".into())
        .spawn(move || {
            let finished = panic::catch_unwind(AssertUnwindSafe(|| game(ports)));
            // A window that is gone need not be told.
            let _ = ended.send_event(GameEnded);
            finished
        })
        .map_err(|error| NoWindow(format!("no thread for the game: {error}")))?;

    let mut desk = Desk::new(window, graphics, screen, &setup);
    events.run_return(|event, _, flow| desk.handle(event, flow));
    drop(desk);

    // Whatever closed the window: the game ends between two ticks and closes its recording.
    setup.stop.set();
    match thread.join() {
        Ok(Ok(finished)) => Ok(finished),
        Ok(Err(payload)) | Err(payload) => panic::resume_unwind(payload),
    }
}

/// An event loop and a window.
fn open(setup: &WindowSetup) -> Result<(EventLoop<GameEnded>, Window), NoWindow> {
    // The library panics where there is no display server; here that is no defect.
    let hook = panic::take_hook();
    panic::set_hook(Box::new(|_| {}));
    let built = panic::catch_unwind(|| EventLoopBuilder::<GameEnded>::with_user_event().build());
    panic::set_hook(hook);
    let events = built.map_err(|_| NoWindow("the display does not answer".into()))?;
    let (width, height) = setup.size;
    let window = WindowBuilder::new()
        .with_title(&setup.title)
        .with_inner_size(PhysicalSize::new(width, height))
        .with_min_inner_size(PhysicalSize::new(320, 200))
        .with_fullscreen(setup.fullscreen.then_some(Fullscreen::Borderless(None)))
        .build(&events)
        .map_err(|error| NoWindow(error.to_string()))?;
    Ok((events, window))
}

/// OpenGL in the window: smooth edges from a graphics card, plain ones from a processor.
fn graphics(window: &Window) -> Result<WindowedContext, NoWindow> {
    let smooth = SurfaceSettings { vsync: false, multisamples: 4, ..SurfaceSettings::default() };
    let plain = SurfaceSettings { multisamples: 0, ..smooth };
    let make = |settings| WindowedContext::from_winit_window(window, settings);
    match make(smooth) {
        Ok(context) if !is_software(&context) => return Ok(context),
        Ok(_) | Err(_) => {}
    }
    make(plain).map_err(|error| NoWindow(format!("no OpenGL: {error}")))
}

#[allow(unsafe_code)]
fn is_software(context: &Context) -> bool {
    // SAFETY: the context was just made current on this thread; reading a string changes nothing.
    let name = unsafe { context.get_parameter_string(RENDERER) }.to_lowercase();
    ["llvmpipe", "softpipe", "swrast", "software"].iter().any(|word| name.contains(word))
}

/// The window with all that is drawn into it.
struct Desk {
    window: Window,
    graphics: WindowedContext,
    stage: Stage,
    gui: GUI,
    screen: Screen,
    pointer: Pointer,
    stop: StopFlag,
    start: Instant,
    due: Instant,
    /// What the window shows now; none if it must be drawn again.
    shown: Option<(DrawList, Hud)>,
    is_focused: bool,
    is_over: bool,
    held: Vec<Key>,
}

impl Screen {
    /// What is drawn and written at `now_s`.
    fn seen(&mut self, view: &HumanView, now_s: f64) -> (DrawList, Hud) {
        let (mut list, mut written) = self.drawn(view, now_s);
        if let Some(insight) = self.board.insight.as_ref().filter(|_| self.shows_thoughts) {
            draw_thoughts(insight, &self.radii, &mut list);
            let name = self.board.name(insight.player);
            let panel = ThoughtsPanel::new(insight, name, &self.texts, &self.words);
            written.thoughts = Some(panel);
        }
        if let Some(heard) = &mut self.heard {
            heard.listen_at(&list.camera);
            heard.write(&mut written, &self.words, now_s);
        }
        (list, written)
    }

    fn drawn(&mut self, view: &HumanView, now_s: f64) -> (DrawList, Hud) {
        let (world, radii) = (self.playhead.shown(now_s), &self.radii);
        let Some(felt) = &mut self.felt else {
            let written = Hud::new(&self.board, view, &self.texts, &self.words);
            return (DrawList::new(&world, view, radii), written);
        };
        let view = felt.view(view, &world, &self.table, radii, now_s);
        let mut list = DrawList::new(&world, &view, radii);
        felt.draw(&mut list);
        let written = Hud::new(&self.board, &view, &self.texts, &self.words);
        (list, felt.write(written, &view, &self.words))
    }
}

impl Desk {
    fn new(window: Window, graphics: WindowedContext, screen: Screen, setup: &WindowSetup) -> Self {
        let stage = Stage::new(&graphics, &setup.table);
        let gui = GUI::new(&graphics);
        let now = Instant::now();
        Desk {
            window,
            graphics,
            stage,
            gui,
            screen,
            pointer: Pointer::new(),
            stop: setup.stop.clone(),
            start: now,
            due: now,
            shown: None,
            is_focused: false,
            is_over: false,
            held: Vec::new(),
        }
    }

    fn handle(&mut self, event: Event<'_, GameEnded>, flow: &mut ControlFlow) {
        match event {
            Event::WindowEvent { event, .. } => self.window_event(event, flow),
            Event::DeviceEvent { event: DeviceEvent::MouseMotion { delta }, .. } => {
                if let Some(by) = self.pointer.device_moved(delta) {
                    self.moved(by);
                }
            }
            Event::UserEvent(GameEnded) => {
                self.is_over = true;
                self.pointer.release(&self.window);
                // A game that was ended, not won, has nothing left to show.
                self.take_news();
                if self.stop.is_set() || self.screen.board.over.is_none() {
                    flow.set_exit();
                }
            }
            Event::RedrawRequested(_) => self.shown = None,
            Event::MainEventsCleared => {
                self.screen.outbox.send();
                if self.stop.is_set() {
                    flow.set_exit();
                    return;
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
                self.screen.outbox.say(RawInput::Closed);
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
                    self.screen.outbox.say(RawInput::FocusLost);
                }
            }
            WindowEvent::CursorMoved { position, .. } => {
                if let Some(by) = self.pointer.at(position, &self.window) {
                    self.moved(by);
                }
            }
            WindowEvent::MouseInput { state, button, .. } => {
                let button = match button {
                    MouseButton::Left => Button::Left,
                    MouseButton::Right => Button::Right,
                    MouseButton::Middle => Button::Middle,
                    MouseButton::Other(_) => return,
                };
                let down = state == ElementState::Pressed;
                let picked =
                    if (button, down) == (Button::Left, true) { self.picked() } else { None };
                self.screen.outbox.say(match picked {
                    Some(option) => RawInput::Picked { option },
                    None => RawInput::Button { button, down },
                });
            }
            WindowEvent::MouseWheel { delta, .. } => {
                let notches = match delta {
                    MouseScrollDelta::LineDelta(_, lines) => f64::from(lines),
                    MouseScrollDelta::PixelDelta(pixels) => pixels.y / PIXELS_PER_NOTCH,
                };
                self.screen.outbox.say(RawInput::Wheel { notches });
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

    fn key(&mut self, key: Key, down: bool, flow: &mut ControlFlow) {
        if self.is_over && down && matches!(key, Key::Escape | Key::Letter('q')) {
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
            if key == Key::Letter('i') {
                self.screen.shows_thoughts = !self.screen.shows_thoughts;
                return;
            }
            let now_s = self.start.elapsed().as_secs_f64();
            if let Some(heard) = &mut self.screen.heard
                && heard.turn(key, now_s)
            {
                return;
            }
        } else {
            self.held.retain(|held| *held != key);
        }
        self.screen.outbox.say(RawInput::Key { key, down });
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
        let height = f64::from(self.window.inner_size().height.max(1));
        self.screen.outbox.say(RawInput::Moved { right: right / height, up: -down / height });
    }

    /// Takes what happened since the last picture.
    fn take_news(&mut self) {
        let screen = &mut self.screen;
        for delivered in screen.mail.try_iter() {
            for stamped in delivered.events.iter() {
                screen.board.hear(&stamped.event);
            }
        }
        let now_s = self.start.elapsed().as_secs_f64();
        let state = screen.world.read().clone();
        screen.playhead.take(&state, now_s);
        if let Some(felt) = &mut screen.felt {
            felt.take(now_s);
        }
    }

    fn draw(&mut self) {
        self.take_news();
        let view = self.screen.view.read().clone();
        // While time stands still, something is to be chosen or the game is over, the pointer
        // belongs to the player's desk.
        let is_free = matches!(view.mode, HumanMode::Paused | HumanMode::Choosing);
        let is_playing = self.is_focused && !self.is_over && !is_free;
        if is_playing && !self.pointer.is_caught() {
            self.pointer.catch(&self.window);
        } else if !is_playing && self.pointer.is_caught() {
            self.pointer.release(&self.window);
        }

        let (list, written) = self.screen.seen(&view, self.start.elapsed().as_secs_f64());
        let size = self.window.inner_size();
        let is_same = self.shown.as_ref().is_some_and(|(a, b)| (a, b) == (&list, &written));
        if is_same || size.width == 0 || size.height == 0 {
            return;
        }
        let viewport = Viewport::new_at_origo(size.width, size.height);
        let target = RenderTarget::screen(&self.graphics, size.width, size.height);
        let [r, g, b] = BACKGROUND;
        target.clear(ClearState::color_and_depth(r, g, b, 1.0, 1.0));
        let time_ms = self.start.elapsed().as_secs_f64() * 1e3;
        self.gui.update(&mut [], time_ms, viewport, 1.0, |ui| {
            let layer = egui::LayerId::background();
            hud::paint(&ui.ctx().layer_painter(layer), &list, &written);
        });
        let (stage, gui) = (&mut self.stage, &self.gui);
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
}

impl Drop for Desk {
    fn drop(&mut self) {
        // The hand may wait for no more reports; the pointer is the desk's again.
        self.pointer.release(&self.window);
    }
}

/// The keys that the game knows.
fn key(code: VirtualKeyCode) -> Option<Key> {
    use VirtualKeyCode as Code;
    Some(match code {
        Code::Left => Key::Left,
        Code::Right => Key::Right,
        Code::Up => Key::Up,
        Code::Down => Key::Down,
        Code::Space => Key::Space,
        Code::Return | Code::NumpadEnter => Key::Enter,
        Code::Escape => Key::Escape,
        Code::Tab => Key::Tab,
        Code::LShift | Code::RShift => Key::Shift,
        Code::LControl | Code::RControl => Key::Control,
        Code::PageUp => Key::PageUp,
        Code::PageDown => Key::PageDown,
        Code::F1 => Key::Help,
        Code::Key1 | Code::Numpad1 => Key::Letter('1'),
        Code::Key2 | Code::Numpad2 => Key::Letter('2'),
        Code::Key3 | Code::Numpad3 => Key::Letter('3'),
        Code::B => Key::Letter('b'),
        Code::C => Key::Letter('c'),
        Code::F => Key::Letter('f'),
        Code::H => Key::Letter('h'),
        Code::I => Key::Letter('i'),
        Code::M => Key::Letter('m'),
        Code::O => Key::Letter('o'),
        Code::P => Key::Letter('p'),
        Code::Q => Key::Letter('q'),
        Code::R => Key::Letter('r'),
        Code::S => Key::Letter('s'),
        Code::T => Key::Letter('t'),
        Code::U => Key::Letter('u'),
        Code::V => Key::Letter('v'),
        Code::Plus | Code::Equals | Code::NumpadAdd => Key::Letter('+'),
        Code::Minus | Code::NumpadSubtract => Key::Letter('-'),
        _ => return None,
    })
}
