//! A desk with a mouse, a keyboard and a display, and the recording that grows while somebody
//! plays at it.
//!
//! Nothing here is timed by how fast the window is: every movement is judged by what the recording
//! says came of it, and waiting ends with what is waited for.

use glam::DVec2;
use hapticbillard::cast::Cast;
use hapticbillard::cue::CuePiece;
use hapticbillard::events::{
    Command as Wanted, Event, FactKind, Source, Topics, Turn, Verdict, Zone,
};
use hapticbillard::hash::StateHash;
use hapticbillard::ids::{BallId, PlayerId};
use hapticbillard::input::feel::{
    ADDRESS_GAP_M, AIM_RAD_PER_HEIGHT, FINE, OFFSET_PER_HEIGHT, PLACING_M_PER_HEIGHT,
    STROKE_M_PER_HEIGHT,
};
use hapticbillard::lockstep;
use hapticbillard::physics::Snapshot;
use hapticbillard::replay::Recording;
use hapticbillard::scene::Scene;
use hapticbillard::table::Table;
use hapticbillard::tick::{Delivered, FrameSource, Inflow, Outcome, Participant};
use hapticbillard::units::Tick;
use hapticbillard_actors::game::Stage;
use std::cell::RefCell;
use std::io::{BufRead, BufReader};
use std::ops::Deref;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::{Arc, Mutex};

/// Size of the window [pixels]: small, because a processor draws it.
pub const SIZE: (u32, u32) = (640, 400);
const HEIGHT: f64 = SIZE.1 as f64;
/// Seconds of the game per second while somebody holds the cue: slow, so that a window that draws
/// ten pictures a second still feels the hand evenly. Waiting is cut short with `f`.
pub const SPEED: f64 = 0.5;
/// Time between two movements of a stroke [s].
const STEP_S: f64 = 0.008;
/// Time between two looks at the recording [s].
const LOOK_S: f64 = 0.05;
/// Whatever a window has not done after so long it does not do [s].
const PATIENCE_S: f64 = 180.0;
/// How long a movement may take to be seen before it counts as lost [s].
const LOST_S: f64 = 4.0;
/// Off by less than this is aimed [rad]: 0.4 mm at the far end of the table.
const AIMED_RAD: f64 = 2e-4;

/// One stroke that met the cue ball.
#[derive(Debug, Clone, Copy)]
pub struct Struck {
    /// By whom.
    pub player: PlayerId,
    /// How far above the ball's middle the tip met it, in ball radii.
    pub height: f64,
}

/// What has happened in a game, and the table at the end of it.
#[derive(Default, Clone)]
pub struct Seen {
    /// The last call to the table.
    pub turn: Option<(Tick, Arc<Turn>)>,
    /// When this shot was called first: a refused placement is called again.
    pub called: Tick,
    /// The ball in hand was put down.
    pub is_placed: bool,
    /// What the rules said of every shot.
    pub verdicts: Vec<Arc<Verdict>>,
    /// Every contact of tip and cue ball.
    pub strokes: Vec<Struck>,
    /// A stroke was made and nothing was said of it yet.
    pub is_rolling: bool,
    /// The table.
    pub table: Arc<Snapshot>,
}

#[derive(Clone, Default)]
struct Watcher(Arc<Mutex<Seen>>);

impl Watcher {
    fn seen(&self) -> Seen {
        self.0.lock().unwrap().clone()
    }
}

impl Participant for Watcher {
    fn source(&self) -> Source {
        Source::Runtime
    }

    fn topics(&self) -> Topics {
        Topics::ALL
    }

    fn start(&mut self, table: &Snapshot) -> Outcome {
        self.0.lock().unwrap().table = Arc::new(table.clone());
        Outcome::default()
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        let mut seen = self.0.lock().unwrap();
        for stamped in delivered.events.iter() {
            match &stamped.event {
                Event::Turn(turn) => {
                    let before = seen.turn.as_ref().map(|(_, before)| before.shot_number);
                    if before != Some(turn.shot_number) {
                        seen.called = delivered.tick;
                    }
                    seen.turn = Some((delivered.tick, turn.clone()));
                    seen.is_placed = false;
                }
                Event::Verdict(verdict) => {
                    seen.verdicts.push(verdict.clone());
                    seen.is_rolling = false;
                }
                Event::Fact(fact) => match fact.kind {
                    FactKind::BallPlaced { ok, .. } => seen.is_placed = ok,
                    FactKind::CueBallStruck { position_m, .. } => {
                        let player = seen.turn.as_ref().map(|(_, turn)| turn.player).unwrap();
                        // A ball at rest lies with its middle a radius above the bed.
                        let radius_m = hapticbillard::ball::POOL_RADIUS_M;
                        let height = position_m.z / radius_m - 1.0;
                        seen.strokes.push(Struck { player, height });
                        seen.is_rolling = true;
                    }
                    _ => {}
                },
                _ => {}
            }
        }
        seen.table = delivered.table.clone();
        Outcome::default()
    }

    fn hash(&self, _: &mut StateHash) {}
}

/// A recording that goes on: after its last frame nobody has quit.
struct SoFar(Recording);

impl FrameSource for SoFar {
    fn inflow(&mut self, tick: Tick) -> Inflow {
        let next = self.0.next_after(tick);
        Inflow { frame: self.0.frame(tick), next, ..Inflow::default() }
    }
}

/// Stops a process that this test started.
pub struct Running(pub Child);

impl Drop for Running {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// What was read of the growing recording.
#[derive(Default)]
struct Read {
    bytes: usize,
    recording: Option<Recording>,
}

/// Mouse and keyboard at a display.
pub struct Hands {
    /// Where the window is shown.
    pub display: String,
    /// Where pictures of it are kept.
    pub pictures: PathBuf,
}

impl Hands {
    /// Real events, in order; `sleep` among them takes time.
    fn events(&self, words: &[String]) -> String {
        let output = Command::new("xdotool")
            .env("DISPLAY", &self.display)
            .args(words)
            .stderr(Stdio::inherit())
            .output()
            .unwrap();
        assert!(output.status.success(), "xdotool {words:?}");
        String::from_utf8_lossy(&output.stdout).into_owned()
    }

    /// Real events, in words between blanks.
    pub fn event(&self, words: &str) -> String {
        self.events(&words.split(' ').map(String::from).collect::<Vec<_>>())
    }

    /// These keys, one after the other, each after the picture of the one before.
    pub fn keys(&self, keys: &[&str]) {
        for key in keys {
            self.event(&format!("key {key} sleep 0.3"));
        }
    }

    /// Looks again and again until something is there; nothing after so many seconds.
    fn within<T>(&self, seconds: f64, mut look: impl FnMut() -> Option<T>) -> Option<T> {
        for _ in 0..(seconds / LOOK_S) as u32 {
            let found = look();
            if found.is_some() {
                return found;
            }
            let slept = Command::new("sleep").arg(LOOK_S.to_string()).status();
            assert!(slept.is_ok_and(|status| status.success()), "sleep");
        }
        look()
    }

    /// The same for what must come.
    pub fn until<T>(&self, what: &str, look: impl FnMut() -> Option<T>) -> T {
        self.within(PATIENCE_S, look).unwrap_or_else(|| {
            self.picture("in_vain.png");
            panic!("waited {PATIENCE_S} s in vain: {what}")
        })
    }

    /// Keeps what the display shows, for whoever wants to see it.
    pub fn picture(&self, name: &str) {
        // Only where the tool is there: nothing depends on it.
        let _ = Command::new("import")
            .env("DISPLAY", &self.display)
            .args(["-window", "root", self.pictures.join(name).to_str().unwrap()])
            .status();
    }

    /// Waits for the window, makes it small and gives it the keyboard.
    pub fn find_window(&self) {
        let search = "search --onlyvisible --name HapticBillard";
        let find = || {
            let output = Command::new("xdotool")
                .env("DISPLAY", &self.display)
                .args(search.split(' '))
                .output()
                .ok()?;
            let text = String::from_utf8_lossy(&output.stdout).into_owned();
            text.lines().next().map(String::from)
        };
        let id = self.until("a window", find);
        let (width, height) = SIZE;
        self.event(&format!("windowsize --sync {id} {width} {height} windowmove {id} 0 0"));
        // Beside the menus: a pointer over a line chooses that.
        self.event(&format!("windowfocus {id} mousemove {} {}", width - 20, height - 20));
    }
}

/// The desk.
pub struct Desk {
    hands: Hands,
    /// The recording.
    pub file: PathBuf,
    scene: Scene,
    table: Arc<Table>,
    read: RefCell<Read>,
}

impl Deref for Desk {
    type Target = Hands;

    fn deref(&self) -> &Hands {
        &self.hands
    }
}

impl Desk {
    /// A desk where a game has begun that is recorded into this file: what is played, and on which
    /// table, its first line says.
    pub fn new(hands: Hands, file: PathBuf) -> Self {
        let part = part_of(&file);
        let recording = hands.until("the first line of a recording", || {
            let text = std::fs::read_to_string(&part).ok()?;
            Recording::parse(&text[..=text.find('\n')?]).ok()
        });
        let stage = Stage::of_recording(&recording).unwrap();
        let (scene, table) = (stage.scene, stage.table);
        Desk { hands, file, scene, table, read: RefCell::default() }
    }

    /// The table that is played on.
    pub fn table(&self) -> &Table {
        &self.table
    }

    /// Looks at the recording so far: whole lines only.
    fn look<T>(&self, at: impl FnOnce(&Recording) -> Option<T>) -> Option<T> {
        let text = std::fs::read_to_string(&self.file)
            .or_else(|_| std::fs::read_to_string(part_of(&self.file)))
            .ok()?;
        let end = text.rfind('\n')? + 1;
        let mut read = self.read.borrow_mut();
        if read.bytes < end {
            // Only what is new, with the header before it.
            let first = text.find('\n')? + 1;
            let from = read.bytes.max(first);
            let new = Recording::parse(&[&text[..first], &text[from..end]].concat()).unwrap();
            match &mut read.recording {
                Some(known) => {
                    known.frames.extend(new.frames);
                    known.hashes.extend(new.hashes);
                    known.end = new.end;
                }
                None => read.recording = Some(new),
            }
            read.bytes = end;
        }
        at(read.recording.as_ref()?)
    }

    /// What comes of the recording so far, until somebody at the mouse must act. A game is
    /// determined by what enters it, so this is known before the window gets there.
    pub fn foresee(&self) -> Seen {
        let recording =
            self.until("a recording", || self.look(|recording| Some(recording.clone())));
        let cast = Cast::new(&self.scene, self.table.clone()).unwrap();
        let watcher = Watcher::default();
        let setup = lockstep::Setup {
            input: Some(Box::new(SoFar(recording))),
            observers: vec![Box::new(watcher.clone())],
            ..lockstep::Setup::headless(Tick(7_200_000))
        };
        lockstep::run(cast, setup).unwrap();
        watcher.seen()
    }

    /// The last tick in which anything happened: physics saw something, or somebody acted.
    fn last_tick(&self) -> Tick {
        self.look(|recording| Some(recording.last_tick())).unwrap_or_default()
    }

    /// Waits, with the time running fast, until the window has got to a turn.
    pub fn reach(&self, turn: Tick) {
        // The facts that end a shot come a few ticks before the next turn, which is no fact.
        let is_there = || turn <= self.last_tick().after(4);
        if is_there() {
            return;
        }
        self.event("keydown f");
        self.until("the next turn", || is_there().then_some(()));
        self.event("keyup f");
    }

    /// The last path that the cue was led along since `from`, when, and whether it was solid.
    fn cue(&self, from: Tick) -> Option<(Tick, CuePiece, bool)> {
        self.look(|recording| {
            recording.frames.range(from..).rev().find_map(|(tick, frame)| {
                frame.iter().rev().find_map(|publication| match &publication.event {
                    Event::Command(Wanted::MoveCue(path)) => {
                        Some((*tick, path.pieces[0], path.solid))
                    }
                    _ => None,
                })
            })
        })
    }

    /// Where the cue ball was put down last since `from`, and when.
    fn placed(&self, from: Tick) -> Option<(Tick, DVec2)> {
        self.look(|recording| {
            recording.frames.range(from..).rev().find_map(|(tick, frame)| {
                frame.iter().rev().find_map(|publication| match &publication.event {
                    Event::Command(Wanted::PlaceBall { position_m, .. }) => {
                        Some((*tick, *position_m))
                    }
                    _ => None,
                })
            })
        })
    }

    /// The address at which the cue is held, once it is told and moves no more.
    fn address(&self, from: Tick) -> Option<(Tick, CuePiece)> {
        let mut last = None;
        self.within(LOST_S, || {
            let now = self.cue(from).filter(|(.., is_solid)| !is_solid)?.0;
            let is_still = last == Some(now);
            last = Some(now);
            is_still.then_some(())
        })?;
        self.cue(from).filter(|(.., is_solid)| !is_solid).map(|(tick, piece, _)| (tick, piece))
    }

    /// Moves the mouse, to the right and down [pixels], in steps that a hand could make.
    fn moved(&self, right: f64, down: f64) {
        let steps = (right.abs().max(down.abs()) / 40.0).ceil().max(1.0);
        let mut words = Vec::new();
        let mut done = (0.0, 0.0);
        for step in 1..=steps as u32 {
            let to = f64::from(step) / steps;
            let to = ((right * to).round(), (down * to).round());
            words.push(format!("mousemove_relative -- {} {}", to.0 - done.0, to.1 - done.1));
            words.push("sleep 0.03".into());
            done = to;
        }
        self.event(&words.join(" "));
    }

    /// Moves the cue ball in hand to `place` and puts it down; whether the rules liked it the
    /// recording says.
    pub fn place(&self, place: DVec2, seen: &Seen, zone: Zone) {
        let bed = self.table.bed.unwrap();
        let held = self.placed(seen.called).map(|(_, place)| place);
        let lies = seen.table.on_table().find(|ball| ball.id == BallId::CUE);
        let lies = lies.map(|ball| ball.position.truncate());
        let lies = lies.filter(|place| bed.in_zone(zone, *place));
        let held = held.or(lies).unwrap_or(bed.head_spot());
        let by = (place - held) / PLACING_M_PER_HEIGHT * HEIGHT;
        self.moved(by.x, -by.y);
        let before = self.placed(seen.called).map(|(tick, _)| tick);
        self.until("the cue ball is put down", || {
            self.event("click 1");
            self.within(LOST_S, || {
                let now = self.placed(seen.called).map(|(tick, _)| tick);
                (before < now).then_some(())
            })
        });
    }

    /// Waits until the cue is at the ball in this turn.
    pub fn take_cue(&self, seen: &Seen) {
        let from = self.placed(seen.called).map_or(seen.called, |(tick, _)| tick);
        self.until("the cue is at the ball", || self.cue(from));
    }

    /// Turns the cue until the recording shows it pointing along `way`.
    pub fn aim(&self, seen: &Seen, way: DVec2) {
        for attempt in 0..40 {
            let Some((told, piece)) = self.address(seen.called) else { continue };
            let off = piece.direction.truncate().angle_to(way);
            if off.abs() < AIMED_RAD {
                return;
            }
            let pixels = -off / AIM_RAD_PER_HEIGHT * HEIGHT;
            if attempt == 0 || 3.0 < pixels.abs() {
                self.moved(pixels, 0.0);
            } else {
                self.event("keydown shift");
                self.moved(pixels / FINE, 0.0);
                self.event("keyup shift");
            }
            self.within(LOST_S, || self.cue(told.after(1)));
        }
        self.picture("in_vain.png");
        panic!("the aim does not come to {way}");
    }

    /// Raises the tip above the middle with the right button and the mouse, to this height of its
    /// contact at least, in ball radii.
    pub fn raise_tip(&self, seen: &Seen, height: f64) {
        for _ in 0..40 {
            let Some((told, piece)) = self.address(seen.called) else { continue };
            let radius_m = hapticbillard::ball::POOL_RADIUS_M;
            let contact = piece.position + piece.direction * ADDRESS_GAP_M;
            let off = height + 0.1 - (contact.z / radius_m - 1.0);
            if off < 0.1 {
                return;
            }
            self.event("mousedown 3");
            self.moved(0.0, -off / OFFSET_PER_HEIGHT * HEIGHT);
            self.event("mouseup 3");
            self.within(LOST_S, || self.cue(told.after(1)));
        }
        self.picture("in_vain.png");
        panic!("the tip does not rise");
    }

    /// Pulls back and pushes through the ball, the tip at about this speed [m/s]. Whether the ball
    /// was struck.
    pub fn stroke(&self, seen: &Seen, speed_m_s: f64) -> bool {
        let Some((told, piece)) = self.address(seen.called) else { return false };
        let contact = piece.position + piece.direction * ADDRESS_GAP_M;
        let pixels = |metres: f64| metres / STROKE_M_PER_HEIGHT * HEIGHT;
        let pull_m = (0.1 + 0.06 * speed_m_s).min(0.34);
        self.event("mousedown 1");
        // How far the tip is behind the ball, once it stands.
        let behind_m = || {
            let (_, piece, is_solid) = self.cue(told.after(1))?;
            let stands = piece.velocity.length() == 0.0 && piece.acceleration.length() == 0.0;
            (is_solid && stands).then(|| (contact - piece.position).dot(piece.direction))
        };
        let mut is_back = false;
        for _ in 0..20 {
            let Some(behind_m) = self.within(LOST_S, behind_m) else { break };
            is_back = pull_m - 0.01 < behind_m;
            if is_back {
                break;
            }
            let before = self.last_tick();
            self.moved(0.0, pixels(pull_m - behind_m).max(1.0));
            self.within(LOST_S, || (before < self.last_tick()).then_some(()));
        }
        if !is_back {
            self.event("mouseup 1");
            return false;
        }
        // Movements are whole pixels: what is left over goes into the next.
        let step = pixels(speed_m_s * SPEED * STEP_S);
        let (mut gone, mut done) = (0.0f64, 0.0f64);
        let mut words = Vec::new();
        while gone < pixels(pull_m + 0.12) {
            gone += step;
            let by = gone.round() - done;
            done += by;
            words.push(format!("mousemove_relative -- 0 {} sleep {STEP_S}", -by));
        }
        words.push("mouseup 1".into());
        self.event(&words.join(" "));
        // What physics saw has a hash: nothing moves but what the tip met.
        let is_struck = |recording: &Recording| recording.hashes.range(told..).next().map(|_| ());
        self.within(LOST_S, || self.look(is_struck)).is_some()
    }
}

/// Where a recording grows.
fn part_of(file: &Path) -> PathBuf {
    let mut part = file.to_path_buf().into_os_string();
    part.push(".part");
    part.into()
}

/// Whether a tool that this test needs is there.
pub fn has(tool: &str) -> bool {
    let found = Command::new("sh").args(["-c", &format!("command -v {tool}")]).output();
    found.is_ok_and(|output| output.status.success())
}

/// A display of its own.
pub fn display() -> Option<(Running, String)> {
    let mut server = Command::new("Xvfb")
        // Without a reset when the last client leaves: the next one would be refused meanwhile.
        .args(["-displayfd", "1", "-screen", "0", "800x600x24", "-nolisten", "tcp", "-noreset"])
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .ok()?;
    let mut line = String::new();
    BufReader::new(server.stdout.take()?).read_line(&mut line).ok()?;
    let number = line.trim().to_string();
    (!number.is_empty()).then(|| (Running(server), format!(":{number}")))
}
