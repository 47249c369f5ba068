//! The window: its own loop on the main thread, menus in it, and one game after the other beside
//! it on a thread of its own.

use super::desk::Desk;
use super::gl_window::GlWindow;
use super::running::Prepared;
use super::stylus::DeskStylus;
use crate::conductor::RunError;
use crate::error::Error;
use crate::input::PadDriver;
use crate::pacer::StopFlag;
use hapticbillard::input::Bindings;
use hapticbillard::menu::{Begin, Menu, Settings};
use hapticbillard::picture::PictureSettings;
use hapticbillard::renderer::DrawList;
use hapticbillard::rules::Language;
use hapticbillard::table::Table;
use hapticbillard::tick::Finished;
use std::panic;
use std::path::PathBuf;
use std::sync::Arc;
use winit::dpi::PhysicalSize;
use winit::event_loop::{EventLoop, EventLoopBuilder};
use winit::platform::run_return::EventLoopExtRunReturn;
use winit::window::{Fullscreen, Window, WindowBuilder};

/// Why there is no window.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct NoWindow(pub String);

/// A window before it opens.
pub struct WindowSetup {
    /// Its title.
    pub title: String,
    /// Size of the picture [pixels].
    pub size: (u32, u32),
    /// How pictures are drawn where there are no menus to set it.
    pub picture: PictureSettings,
    /// The language of the player's system.
    pub language: Language,
    /// Ends everything between two ticks.
    pub stop: StopFlag,
    /// Menus; without them the window is there for one game.
    pub menu: Option<Menu>,
    /// What keys mean, and what is wrong with the player's own.
    pub keys: (Bindings, Option<String>),
    /// Gamepads, where there may be some.
    pub pads: Option<PadDriver>,
    /// It fills the screen whatever the menus say.
    pub fullscreen: bool,
    /// A game begins at once, before any menu.
    pub begins: bool,
}

/// A table that nobody plays at.
pub struct Backdrop {
    /// The table.
    pub table: Arc<Table>,
    /// What is seen of it.
    pub list: DrawList,
}

/// Takes up a stylus for menus; none if the device has none that points. The error is read by the
/// player.
pub type TakeUp = Box<dyn FnOnce() -> Result<Option<DeskStylus>, Error> + Send>;

/// Who runs the games of a window.
pub trait Host {
    /// Makes ready the game that is to begin; the last one once more is the first one at first.
    ///
    /// # Errors
    /// Why it cannot be played; the player reads it.
    fn prepare(
        &mut self,
        settings: Option<&Settings>,
        language: Language,
        begin: Begin,
    ) -> Result<Prepared, Error>;

    /// What is seen behind the main menu; asked for when it first opens.
    ///
    /// # Errors
    /// Balls that do not fit the table.
    fn backdrop(&mut self) -> Result<Backdrop, Error>;

    /// How the stylus of the device that is set is taken up, for menus while no game has it; none
    /// if none is set. A device that is not there lets a while pass, so it is done elsewhere.
    fn stylus(&mut self, settings: &Settings) -> Option<TakeUp>;

    /// A game has ended.
    ///
    /// # Errors
    /// What could not be finished after it.
    fn ended(&mut self, finished: &Result<Finished, RunError>) -> Result<(), Error>;

    /// The player wants to keep a picture, which is a PNG file. Returns where it is.
    ///
    /// # Errors
    /// It could not be written.
    fn picture(&mut self, png: &[u8]) -> Result<PathBuf, Error>;

    /// What is set shall be there the next time.
    fn keep(&mut self, settings: &Settings);

    /// What keys mean shall be so the next time.
    fn keep_keys(&mut self, bindings: &Bindings);
}

/// The game is over: its thread has nothing more to say.
pub(super) struct GameEnded;

/// Shows games in a window until it is closed, and waits until the last one has ended in order.
///
/// # Errors
/// [`NoWindow`] if there can be no window; no game was begun then. Inside: what went wrong with a
/// game, where no menu could say it.
pub fn show(setup: WindowSetup, host: &mut dyn Host) -> Result<Result<(), Error>, NoWindow> {
    let (mut events, window) = open(&setup)?;
    // Smooth edges are drawn beside it, so that they can be switched.
    let graphics = GlWindow::new(&window)?;
    let mut desk = match Desk::new(window, graphics, setup, host, events.create_proxy()) {
        Ok(desk) => desk,
        Err(error) => return Ok(Err(error)),
    };
    events.run_return(|event, _, flow| desk.handle(event, flow));
    Ok(desk.end())
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
    let is_full = setup.fullscreen || setup.menu.as_ref().is_some_and(|m| m.settings.full_screen);
    let window = WindowBuilder::new()
        .with_title(&setup.title)
        .with_inner_size(PhysicalSize::new(width, height))
        .with_min_inner_size(PhysicalSize::new(320, 200))
        .with_fullscreen(is_full.then_some(Fullscreen::Borderless(None)))
        .build(&events)
        .map_err(|error| NoWindow(error.to_string()))?;
    Ok((events, window))
}
