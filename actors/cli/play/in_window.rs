//! A game in a window: the ports of both joined.

use super::felt::{Watched, felt};
use super::{PlayArgs, Status, recording, stop_at_interrupt, tidy_up};
use hapticbillard::ids::BallId;
use hapticbillard::input::{Human, HumanView, LedHuman, RawInput};
use hapticbillard::physics::Snapshot;
use hapticbillard::renderer::Radii;
use hapticbillard::replay::{RecordedInput, Recording};
use hapticbillard::rules::Language;
use hapticbillard::tick::{Finished, FrameSource, Inflow, Pace};
use hapticbillard::units::Tick;
use hapticbillard_actors::conductor::RunError;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::game::{LIMIT, Stage};
use hapticbillard_actors::haptic::{
    DeviceRecorder, FeltMouse, Plan, Recorded, Seat, Started, Stylus, Watch,
};
use hapticbillard_actors::input::{LedHand, WindowHand};
use hapticbillard_actors::pacer::{Tempo, describe};
use hapticbillard_actors::renderer::{HeardSetup, NoWindow, Ports, WindowSetup, show};
use hapticbillard_actors::runtime::{self, Felt, Heard, InputPort, Setup};
use hapticbillard_actors::sound;
use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;

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

/// Plays in a window, or says why there is none.
pub fn play_in_window(
    args: &PlayArgs,
    stage: &Stage,
    out: &mut dyn Write,
) -> Result<Result<Status, String>, Error> {
    if !has_display() {
        return Ok(Err("no display (DISPLAY and WAYLAND_DISPLAY are not set)".into()));
    }
    let record = recording(args);
    let mut felt = felt(stage, !stage.scene.has_hand(), args.telemetry.as_deref())?;
    let telemetry = felt.as_mut().and_then(|felt| felt.telemetry.take());
    let (record_device, speed) = (args.record_device.clone(), args.speed);
    let finished = match shown(stage, None, felt, record.clone(), record_device, speed)? {
        Ok(finished) => finished?,
        Err(NoWindow(why)) => return Ok(Err(format!("no window ({why})"))),
    };
    tidy_up(args, record.as_ref());
    writeln!(out, "{}", describe(finished.end))?;
    if let Some(telemetry) = telemetry {
        writeln!(out, "{}", telemetry.finish()?)?;
    }
    if let Some(path) = &record {
        writeln!(out, "recorded: {}", path.display())?;
    }
    Ok(Ok(Status::Success))
}

/// Plays a recording back in a window.
pub fn replay_in_window(stage: &Stage, recording: Arc<Recording>) -> Result<Status, Error> {
    match shown(stage, Some(recording), None, None, None, 1.0)? {
        Ok(finished) => finished.map(|_| Status::Success).map_err(Error::from),
        Err(NoWindow(why)) => {
            Err(Error::input("replay", format!("no window ({why})"), "add --headless"))
        }
    }
}

type Shown = Result<Result<Finished, RunError>, NoWindow>;

fn shown(
    stage: &Stage,
    replay: Option<Arc<Recording>>,
    felt: Option<Watched>,
    record: Option<PathBuf>,
    record_device: Option<PathBuf>,
    speed: f64,
) -> Result<Shown, Error> {
    let mut cast = stage.cast()?;
    let balls = stage.scene.build_balls(&stage.table)?;
    let radii = Radii::new(balls.iter().map(|(ball, _)| (ball.id, ball.radius_m)))
        .with_set(stage.scene.equipment().into())
        .with_tip(stage.scene.parameters().tip_radius_m);
    let renderer = stage.scene.renderer;
    let stop = stop_at_interrupt();
    let (mut plan, watch, shown) = match felt {
        Some(Watched { plan, watch, shown, .. }) => (Some(plan), watch, Some(shown)),
        None => (None, Watch::default(), None),
    };
    let first = Arc::new(cast.simulation.snapshot(0.0));
    let (line, heard) = heard(stage, first.clone(), speed)?;
    let setup = WindowSetup {
        title: format!("HapticBillard: {}", stage.scene.about.name),
        size: renderer.map_or((1280, 720), |section| (section.width, section.height)),
        fullscreen: renderer.is_some_and(|section| section.fullscreen),
        table: stage.table.clone(),
        first,
        names: cast.names.clone(),
        game: stage.scene.rules.map(|rules| rules.game),
        speed,
        language: language(),
        stop: stop.clone(),
        radii: radii.clone(),
        felt: shown,
        heard,
    };
    let hand = cast.human.take().filter(|_| replay.is_none());
    let table = stage.table.clone();
    let record = record.map(|path| (path, stage.header()));
    let physics_thread = stage.scene.physics.thread;
    let mouse = plan.as_mut().and_then(|plan| plan.opened.mouse.take());
    let (plan, recorder) = tapped(plan, record_device)?;
    let has_cue = stage.scene.cue.is_some();
    let players = stage.scene.human_players();
    let tip_radius_m = stage.scene.parameters().tip_radius_m;
    let game = move |ports: Ports| {
        let Ports { raw, view, world, sink } = ports;
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
            None if haptic.is_some() => {
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
            sound: line,
            haptic,
            physics_thread,
            workers: 2,
            stop,
            ..Setup::headless(LIMIT)
        };
        runtime::run(cast, setup)
    };
    let shown = show(setup, game);
    if let Some(Recorded { readings, lost }) = recorder.map(DeviceRecorder::finish).transpose()? {
        log::info!("recorded {readings} readings of the haptic device, {lost} lost");
    }
    Ok(shown)
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
            log::warn!("{error}; the game is played without sound");
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
    raw: flume::Receiver<RawInput>,
    view: triple_buffer::Input<HumanView>,
    seen: Vec<RawInput>,
}

impl FrameSource for Spectator {
    fn inflow(&mut self, tick: Tick) -> Inflow {
        self.seen.clear();
        self.seen.extend(self.raw.try_iter());
        let own = self.eye.inflow(tick, &self.seen);
        self.view.write(self.eye.view());
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
