//! A game in a window: the ports of both joined.

use super::super::render;
use super::felt::{Watched, felt};
use super::kept_keys::KeptKeys;
use super::kept_settings::Kept;
use super::{PlayArgs, Status, recording, stop_at_interrupt, tidy_up};
use hapticbillard::ids::BallId;
use hapticbillard::input::{Bindings, CameraPose, HandInput, Human, HumanView, LedHuman};
use hapticbillard::menu::{Begin, HapticChoice, Menu, Pages, Settings};
use hapticbillard::physics::Snapshot;
use hapticbillard::renderer::{DrawList, Radii, Words, player_names};
use hapticbillard::replay::{RecordedInput, Recording};
use hapticbillard::rules::Language;
use hapticbillard::scene::{Overrides, Scene};
use hapticbillard::tick::{Finished, FrameSource, Inflow, Pace};
use hapticbillard::units::Tick;
use hapticbillard_actors::conductor::RunError;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::{LoadedScene, keep_picture, load_scene};
use hapticbillard_actors::game::{LIMIT, Stage};
use hapticbillard_actors::haptic::{
    DeviceRecorder, FeltMouse, Plan, Recorded, Seat, Started, Stylus, Telemetry, Watch,
};
use hapticbillard_actors::input::{LedHand, WindowHand, gamepads};
use hapticbillard_actors::pacer::{Tempo, describe};
use hapticbillard_actors::renderer::{
    Backdrop, DeskStylus, GameSetup, HeardSetup, Host, NoWindow, Ports, Prepared, TakeUp,
    WindowSetup, show,
};
use hapticbillard_actors::runtime::{self, Felt, Heard, InputPort, Setup};
use hapticbillard_actors::sound;
use std::hash::{BuildHasher, Hasher};
use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;

/// The scene of the tutorial.
const TUTORIAL: &str = "tutorial";
/// How far the table behind the main menu is to the left of the middle [m].
const ASIDE_M: f64 = -0.55;

/// Whether there is a display to open a window on.
pub fn has_display() -> bool {
    let is_set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    // Other systems always have one.
    !cfg!(all(unix, not(target_os = "macos"))) || is_set("DISPLAY") || is_set("WAYLAND_DISPLAY")
}

/// The language of the player's system.
fn language() -> Language {
    let chosen = ["LC_ALL", "LC_MESSAGES", "LANG"]
        .iter()
        .find_map(|name| std::env::var(name).ok().filter(|value| !value.is_empty()));
    match chosen {
        Some(locale) if locale.starts_with("de") => Language::German,
        _ => Language::English,
    }
}

/// Plays in a window, or says why there is none. `stage`: a game that begins at once; without it
/// the main menu opens.
pub fn play_in_window(
    args: &PlayArgs,
    stage: Option<Stage>,
    out: &mut dyn Write,
) -> Result<Result<Status, String>, Error> {
    if !has_display() {
        return Ok(Err("no display (DISPLAY and WAYLAND_DISPLAY are not set)".into()));
    }
    let (settings, kept) = Kept::load();
    let begins = stage.is_some();
    let stage = match stage {
        Some(stage) => stage,
        None => stage_of(&settings, Language::English)?,
    };
    let menu =
        Menu::new(Pages::shipped().map_err(|error| RunError::Start(error.to_string()))?, settings);
    let (bindings, said, kept_keys) = KeptKeys::load();
    let setup = WindowSetup { keys: (bindings, said), ..window(&stage, Some(menu), begins) };
    let mut house = House {
        args,
        stage,
        is_first: begins,
        is_set: !begins,
        is_lesson: false,
        record: None,
        recorder: None,
        telemetry: None,
        kept,
        kept_keys,
        out,
    };
    match show(setup, &mut house) {
        Ok(shown) => shown.map(|()| Ok(Status::Success)),
        Err(NoWindow(why)) => Ok(Err(format!("no window ({why})"))),
    }
}

/// Plays a recording back in a window.
pub fn replay_in_window(stage: &Stage, recording: Arc<Recording>) -> Result<Status, Error> {
    let mut replay = Replay { stage, recording: Some(recording) };
    let (bindings, said, _) = KeptKeys::load();
    let setup = WindowSetup { keys: (bindings, said), ..window(stage, None, true) };
    match show(setup, &mut replay) {
        Ok(shown) => shown.map(|()| Status::Success),
        Err(NoWindow(why)) => {
            Err(Error::input("replay", format!("no window ({why})"), "add --headless"))
        }
    }
}

/// The scene of the game that is set, with who plays it.
fn stage_of(settings: &Settings, language: Language) -> Result<Stage, Error> {
    let name = settings.game.scene();
    let overrides = Overrides {
        seed: Some(new_seed()),
        players: settings.entrants(),
        names: player_names(settings, &Words::of_menus(language)),
        ..Overrides::default()
    };
    let text = settings.scene_text();
    let scene = Scene::parse(&format!("{name}.toml"), &text)?;
    Ok(Stage::new(&LoadedScene { scene, text, folder: None }, name)?.with(overrides))
}

/// No game of the menus is like another.
fn new_seed() -> u64 {
    std::hash::RandomState::new().build_hasher().finish()
}

/// The table of a scene as it lies before the first stroke.
fn backdrop(stage: &Stage) -> Result<Backdrop, Error> {
    let first = stage.simulation()?.snapshot(0.0);
    // The menu is on the left.
    let view = HumanView { camera: CameraPose::default().aside(ASIDE_M), ..HumanView::default() };
    let list = DrawList::new(&first, &view, &radii(stage)?);
    Ok(Backdrop { table: stage.table.clone(), list })
}

fn radii(stage: &Stage) -> Result<Radii, Error> {
    Ok(render::radii(stage)?.with_tip(stage.scene.parameters().tip_radius_m))
}

fn window(stage: &Stage, menu: Option<Menu>, begins: bool) -> WindowSetup {
    let renderer = stage.scene.renderer;
    // Menus lead to other games.
    let title = match menu {
        None => format!("HapticBillard: {}", stage.scene.about.name),
        Some(_) => "HapticBillard".to_string(),
    };
    // Without menus pictures are as they were set in the last game with some.
    let picture = menu.as_ref().map_or_else(|| Kept::load().0.picture, |m| m.settings.picture);
    WindowSetup {
        title,
        picture,
        size: renderer.map_or((1280, 720), |section| (section.width, section.height)),
        fullscreen: renderer.is_some_and(|section| section.fullscreen),
        language: language(),
        stop: stop_at_interrupt(),
        menu,
        keys: (Bindings::shipped(), None),
        pads: gamepads(),
        begins,
    }
}

/// Runs the games of a window: what the command line asks for, then what the menus do.
struct House<'a> {
    args: &'a PlayArgs,
    /// The last game, or the one to begin with.
    stage: Stage,
    /// The next game is the one that the command line asks for.
    is_first: bool,
    /// The stage is as it was set in the menus.
    is_set: bool,
    /// It is the tutorial.
    is_lesson: bool,
    record: Option<PathBuf>,
    recorder: Option<DeviceRecorder>,
    telemetry: Option<Telemetry>,
    kept: Kept,
    kept_keys: KeptKeys,
    out: &'a mut dyn Write,
}

impl Host for House<'_> {
    fn prepare(
        &mut self,
        settings: Option<&Settings>,
        language: Language,
        begin: Begin,
    ) -> Result<Prepared, Error> {
        let is_first = std::mem::take(&mut self.is_first);
        match (begin, settings) {
            (Begin::Tutorial, _) => {
                self.stage = Stage::new(&load_scene(TUTORIAL)?, TUTORIAL)?;
                (self.is_set, self.is_lesson) = (true, true);
            }
            (Begin::Set, Some(settings)) => {
                self.stage = stage_of(settings, language)?;
                (self.is_set, self.is_lesson) = (true, false);
            }
            _ if !is_first => {
                let overrides = self.stage.header().overrides;
                self.stage = self.stage.with(Overrides { seed: Some(new_seed()), ..overrides });
            }
            _ => {}
        }
        let PlayArgs { telemetry, record_device, speed, .. } = self.args;
        // What the command line wants to be written is of one game; no other writes over it.
        let (telemetry, device) = match is_first {
            true => (telemetry.as_deref(), record_device.clone()),
            false => (None, None),
        };
        self.record = recording(self.args, is_first);
        let mut felt = felt(&self.stage, self.stage.scene.is_led(), telemetry)?;
        self.telemetry = felt.as_mut().and_then(|felt| felt.telemetry.take());
        let (mut prepared, recorder) =
            prepared(&self.stage, None, felt, self.record.clone(), device, *speed)?;
        prepared.setup.is_lesson = self.is_lesson;
        self.recorder = recorder;
        Ok(prepared)
    }

    fn backdrop(&mut self) -> Result<Backdrop, Error> {
        backdrop(&self.stage)
    }

    fn stylus(&mut self, settings: &Settings) -> Option<TakeUp> {
        // A scene of the command line may have a device that is not set.
        let stage = match settings.haptic {
            HapticChoice::None if self.is_set => return None,
            HapticChoice::None if self.stage.scene.haptic.is_none() => return None,
            HapticChoice::None => Some(self.stage.with(self.stage.header().overrides)),
            _ => None,
        };
        let settings = settings.clone();
        Some(Box::new(move || {
            let stage = stage.map_or_else(|| stage_of(&settings, Language::English), Ok)?;
            let plan = stage.haptic()?;
            let Some(opened) = plan.map(|plan| plan.opened).filter(|opened| opened.points) else {
                return Ok(None);
            };
            let fix = "end what uses the device, or choose none in the options";
            let started = DeskStylus::start(opened);
            started.map(Some).map_err(|error| Error::input("stylus", error.to_string(), fix))
        }))
    }

    fn ended(&mut self, finished: &Result<Finished, RunError>) -> Result<(), Error> {
        // All of it is done, whatever of it fails.
        let device = self.recorder.take().map(DeviceRecorder::finish).transpose();
        let telemetry = self.telemetry.take().map(Telemetry::finish).transpose();
        tidy_up(self.args, self.record.as_ref());
        let record = self.record.take();
        if let Ok(finished) = finished {
            writeln!(self.out, "{}", describe(finished.end))?;
            if let Ok(Some(telemetry)) = &telemetry {
                writeln!(self.out, "{telemetry}")?;
            }
            if let Some(path) = record {
                writeln!(self.out, "recorded: {}", path.display())?;
            }
            self.out.flush()?;
        }
        if let Some(Recorded { readings, lost }) = device? {
            tracing::info!("recorded {readings} readings of the haptic device, {lost} lost");
        }
        telemetry.map(|_| ())
    }

    fn picture(&mut self, png: &[u8]) -> Result<PathBuf, Error> {
        keep_picture(png)
    }

    fn keep(&mut self, settings: &Settings) {
        self.kept.keep(settings);
    }

    fn keep_keys(&mut self, bindings: &Bindings) {
        self.kept_keys.keep(bindings);
    }
}

/// A recording in a window.
struct Replay<'a> {
    stage: &'a Stage,
    recording: Option<Arc<Recording>>,
}

impl Host for Replay<'_> {
    fn prepare(&mut self, _: Option<&Settings>, _: Language, _: Begin) -> Result<Prepared, Error> {
        let recording = self.recording.take();
        Ok(prepared(self.stage, recording, None, None, None, 1.0)?.0)
    }

    fn backdrop(&mut self) -> Result<Backdrop, Error> {
        backdrop(self.stage)
    }

    fn stylus(&mut self, _: &Settings) -> Option<TakeUp> {
        None
    }

    fn ended(&mut self, _: &Result<Finished, RunError>) -> Result<(), Error> {
        Ok(())
    }

    fn picture(&mut self, png: &[u8]) -> Result<PathBuf, Error> {
        keep_picture(png)
    }

    fn keep(&mut self, _: &Settings) {}

    fn keep_keys(&mut self, _: &Bindings) {}
}

/// A game with all that it is joined to, ready to begin; and who records its device.
fn prepared(
    stage: &Stage,
    replay: Option<Arc<Recording>>,
    felt: Option<Watched>,
    record: Option<PathBuf>,
    record_device: Option<PathBuf>,
    speed: f64,
) -> Result<(Prepared, Option<DeviceRecorder>), Error> {
    let mut cast = stage.cast()?;
    let radii = radii(stage)?;
    let stop = stop_at_interrupt();
    let (mut plan, watch, shown) = match felt {
        Some(Watched { plan, watch, shown, .. }) => (Some(plan), watch, Some(shown)),
        None => (None, Watch::default(), None),
    };
    let first = Arc::new(cast.simulation.snapshot(0.0));
    let (line, heard) = heard(stage, first.clone(), speed)?;
    let setup = GameSetup {
        table: stage.table.clone(),
        first,
        names: cast.names.clone(),
        game: stage.scene.rules.map(|rules| rules.game),
        speed,
        radii: radii.clone(),
        felt: shown,
        heard,
        adviser: cast.adviser.take(),
        is_lesson: false,
    };
    let hand = cast.human.take().filter(|_| replay.is_none());
    let table = stage.table.clone();
    let record = record.map(|path| (path, stage.header()));
    let physics_thread = stage.scene.physics.thread;
    let mouse = plan.as_mut().and_then(|plan| plan.opened.mouse.take());
    let (plan, recorder) = tapped(plan, record_device)?;
    let has_cue = stage.scene.cue.is_some();
    let (players, is_led) = (stage.scene.human_players(), stage.scene.is_led());
    let tip_radius_m = stage.scene.parameters().tip_radius_m;
    let play = move |ports: Ports| {
        let Ports { raw, view, world, film, sink, meters } = ports;
        let started = plan.map(|plan| Seat::start_watched(plan, watch)).transpose();
        let started = started.map_err(|error| RunError::Start(error.to_string()))?;
        let (haptic, stylus) = match started {
            Some(Started { seat, world, stylus }) => (Some(Felt { seat, world }), Some(stylus)),
            None => (None, None),
        };
        let mouse = mouse.map(FeltMouse::new);
        let mouse = mouse.map(|mouse| if has_cue { mouse.striking() } else { mouse });
        let stylus = stylus.filter(|_| has_cue).map(Stylus::new);
        let input = match hand {
            Some(hand) => {
                let hand = hand.with_ball_radius(radii.of(BallId::CUE));
                let hand = WindowHand::new(hand, raw, view);
                let hand = match stylus {
                    Some(stylus) => hand.with_stylus(stylus, mouse),
                    None => hand,
                };
                InputPort::Hand(Box::new(hand))
            }
            None if haptic.is_some() && is_led => {
                let human = Human::new(players, table)
                    .with_ball_radius(radii.of(BallId::CUE))
                    .with_tip_radius(tip_radius_m);
                let core = LedHuman::new(human);
                InputPort::Hand(Box::new(LedHand::new(core, raw, view, mouse, stylus)))
            }
            None => {
                let recorded = replay.map(RecordedInput);
                // Nobody's hand: it looks round, and stops time.
                let eye = Human::new(Vec::new(), table);
                let who = Spectator { recorded, eye, raw, view, seen: Vec::new() };
                InputPort::StandIn(Box::new(who))
            }
        };
        let setup = Setup {
            pace: Pace::EveryTick,
            tempo: Tempo::RealTime(speed),
            input,
            record,
            sinks: vec![sink],
            world: Some(world),
            film: Some(film),
            sound: line,
            haptic,
            physics_thread,
            workers: 2,
            stop,
            meters: Some(meters),
            ..Setup::headless(LIMIT)
        };
        runtime::run(cast, setup)
    };
    Ok((Prepared { setup, play: Box::new(play) }, recorder))
}

/// What the scene asks to be heard, and the window's end of it. Without it the game is played in
/// silence.
fn heard(
    stage: &Stage,
    first: Arc<Snapshot>,
    pace: f64,
) -> Result<(Option<Heard>, Option<HeardSetup>), Error> {
    let Some(plan) = stage.sound(first, pace)? else { return Ok((None, None)) };
    let knobs = plan.knobs.clone();
    match sound::Seat::start(plan) {
        Ok(sound::Started { seat, world, listener }) => {
            Ok((Some(Heard { seat, world }), Some(HeardSetup { listener, knobs })))
        }
        Err(error) => {
            tracing::warn!("{error}; the game is played without sound");
            Ok((None, None))
        }
    }
}

/// The same plan, its device recorded where somebody wants that.
fn tapped(
    plan: Option<Plan>,
    record: Option<PathBuf>,
) -> Result<(Option<Plan>, Option<DeviceRecorder>), Error> {
    let Some(path) = record else { return Ok((plan, None)) };
    let Some(plan) = plan else {
        let fix = "leave it out, or play a scene with [haptic], such as haptic_touch";
        return Err(Error::input("--record-device", "the scene has no haptic device", fix));
    };
    let (opened, recorder) = DeviceRecorder::tap(plan.opened, path)?;
    Ok((Some(Plan { opened, ..plan }), Some(recorder)))
}

/// Nobody at mouse and keyboard plays: a recording does, or nobody; the camera is the spectator's.
struct Spectator {
    recorded: Option<RecordedInput>,
    eye: Human,
    raw: flume::Receiver<HandInput>,
    view: triple_buffer::Input<HumanView>,
    seen: Vec<HandInput>,
}

impl FrameSource for Spectator {
    fn inflow(&mut self, tick: Tick) -> Inflow {
        self.seen.clear();
        self.seen.extend(self.raw.try_iter());
        let own = self.eye.inflow(tick, &self.seen);
        self.view.write(HumanView { looks_on: true, ..self.eye.view() });
        let recorded = self.recorded.as_mut().map(|recorded| recorded.inflow(tick));
        let recorded = recorded.unwrap_or_default();
        // What the spectator's hand would publish is not part of the game.
        Inflow {
            frame: recorded.frame,
            next: own.next,
            paused: own.paused,
            hurried: own.hurried,
            quit: own.quit || recorded.quit,
        }
    }
}
