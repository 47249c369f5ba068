//! A whole game in a real window: a virtual display, real mouse and key events, and the recording
//! to judge by.
//!
//! The player here knows only what the growing recording says. A game is determined by what enters
//! it, so replaying the recording so far shows the table at the player's next turn, before the
//! window gets there.

use crate::cli::folder;
use glam::DVec2;
use hapticbillard::ai::{Goal, TableView2d, plan_shot};
use hapticbillard::ball::POOL_RADIUS_M;
use hapticbillard::cast::Cast;
use hapticbillard::cue::CuePiece;
use hapticbillard::events::{
    Command as Wanted, Event, FactKind, Foul, ShotKind, Source, Topics, Turn, Verdict,
};
use hapticbillard::hash::StateHash;
use hapticbillard::ids::{BallId, PlayerId};
use hapticbillard::input::feel::{
    ADDRESS_GAP_M, AIM_RAD_PER_HEIGHT, FINE, OFFSET_PER_HEIGHT, PLACING_M_PER_HEIGHT,
    STROKE_M_PER_HEIGHT,
};
use hapticbillard::lockstep;
use hapticbillard::physics::Snapshot;
use hapticbillard::replay::{RecordedInput, Recording};
use hapticbillard::scene::Scene;
use hapticbillard::table::Table;
use hapticbillard::tick::{Delivered, Outcome, Participant};
use hapticbillard::units::Tick;
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::{Arc, Mutex};

/// Size of the window [pixels]: small, because a processor draws it.
const SIZE: (u32, u32) = (640, 400);
const HEIGHT: f64 = SIZE.1 as f64;
/// Seconds of the game per second.
const SPEED: f64 = 2.0;
/// Time between two movements of a stroke [s].
const STEP_S: f64 = 0.008;

/// What has happened in a game, and the table at the end of it.
#[derive(Default, Clone)]
struct Seen {
    turn: Option<(Tick, Arc<Turn>)>,
    is_placed: bool,
    verdicts: Vec<Arc<Verdict>>,
    strikes: usize,
    table: Arc<Snapshot>,
}

#[derive(Clone, Default)]
struct Watcher(Arc<Mutex<Seen>>);

impl Participant for Watcher {
    fn source(&self) -> Source {
        Source::Runtime
    }

    fn topics(&self) -> Topics {
        Topics::ALL
    }

    fn start(&mut self, _: &Snapshot) -> Outcome {
        Outcome::default()
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        let mut seen = self.0.lock().unwrap();
        seen.table = delivered.table.clone();
        for stamped in delivered.events.iter() {
            match &stamped.event {
                Event::Turn(turn) => {
                    seen.turn = Some((delivered.tick, turn.clone()));
                    seen.is_placed = false;
                }
                Event::Verdict(verdict) => seen.verdicts.push(verdict.clone()),
                Event::Fact(fact) => match fact.kind {
                    FactKind::BallPlaced { ok, .. } => seen.is_placed = ok,
                    FactKind::CueBallStruck { .. } => seen.strikes += 1,
                    _ => {}
                },
                _ => {}
            }
        }
        Outcome::default()
    }

    fn hash(&self, _: &mut StateHash) {}
}

/// Stops a process that this test started.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

struct Desk {
    display: String,
    file: PathBuf,
    scene: Scene,
    table: Arc<Table>,
}

impl Desk {
    /// Real events, in order; `sleep` among them takes time.
    fn events(&self, words: &[String]) {
        let status = Command::new("xdotool")
            .env("DISPLAY", &self.display)
            .args(words)
            .stdout(Stdio::null())
            .status()
            .unwrap();
        assert!(status.success(), "xdotool {words:?}");
    }

    fn event(&self, words: &str) {
        self.events(&words.split(' ').map(String::from).collect::<Vec<_>>());
    }

    fn wait(&self, seconds: f64) {
        self.event(&format!("sleep {seconds}"));
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
        let words = words.join(" ");
        self.event(&words);
    }

    /// The recording so far: whole lines only.
    fn recording(&self) -> Option<Recording> {
        let mut part = self.file.clone().into_os_string();
        part.push(".part");
        let text = std::fs::read_to_string(&self.file)
            .or_else(|_| std::fs::read_to_string(PathBuf::from(part)))
            .ok()?;
        let end = text.rfind('\n')?;
        Recording::parse(&text[..=end]).ok()
    }

    /// What comes of the recording so far, until somebody at the mouse must act.
    fn foresee(&self) -> Option<Seen> {
        let recording = Arc::new(self.recording()?);
        let cast = Cast::new(&self.scene, self.table.clone()).unwrap();
        let watcher = Watcher::default();
        let setup = lockstep::Setup {
            input: Some(Box::new(RecordedInput(recording))),
            observers: vec![Box::new(watcher.clone())],
            ..lockstep::Setup::headless(Tick(7_200_000))
        };
        lockstep::run(cast, setup).unwrap();
        let seen = watcher.0.lock().unwrap().clone();
        Some(seen)
    }

    /// The last path that the cue was led along, and when.
    fn cue(&self) -> Option<(Tick, CuePiece)> {
        let recording = self.recording()?;
        recording.frames.iter().rev().find_map(|(tick, frame)| {
            frame.iter().rev().find_map(|publication| match &publication.event {
                Event::Command(Wanted::MoveCue(path)) => Some((*tick, path.pieces[0])),
                _ => None,
            })
        })
    }

    /// Waits until the recording has reached a tick; its hashes tell.
    fn reach(&self, tick: Tick) {
        for _ in 0..1200 {
            let now = self.recording().and_then(|recording| {
                let hash = recording.hashes.last_key_value().map(|(tick, _)| *tick);
                let frame = recording.frames.last_key_value().map(|(tick, _)| *tick);
                hash.max(frame)
            });
            if now.is_some_and(|now| tick <= now.after(3)) {
                return;
            }
            self.wait(0.05);
        }
        panic!("the window does not get to tick {}", tick.0);
    }

    /// Puts the cue ball down where there is room.
    fn place(&self, seen: &Seen) {
        let bed = self.table.bed.unwrap();
        let view = TableView2d::of(&seen.table, &bed, &self.table.pockets, POOL_RADIUS_M);
        let home = view.cue_ball.unwrap_or(bed.head_spot());
        let turn = &seen.turn.as_ref().unwrap().1;
        let start = if turn.shot == ShotKind::Break { DVec2::new(-0.7, 0.08) } else { home };
        let place = (0..400)
            .map(|i| start + DVec2::new(-0.02 * f64::from(i / 20), 0.03 * f64::from(i % 20 - 10)))
            .find(|place| view.has_room(*place))
            .unwrap();
        let by = (place - home) / PLACING_M_PER_HEIGHT * HEIGHT;
        self.moved(by.x, -by.y);
        self.event("click 1");
        self.wait(0.3);
    }

    /// Turns the cue until the recording shows it within a fifth of a milliradian.
    fn aim(&self, way: DVec2) {
        for attempt in 0..8 {
            let now = self.cue().unwrap().1.direction.truncate();
            let off = now.angle_to(way);
            if off.abs() < 2e-4 {
                return;
            }
            let pixels = -off / AIM_RAD_PER_HEIGHT * HEIGHT;
            if attempt == 0 || pixels.abs() > 3.0 {
                self.moved(pixels, 0.0);
            } else {
                self.event("keydown shift");
                self.wait(0.05);
                self.moved(pixels / FINE, 0.0);
                self.event("keyup shift");
            }
            self.wait(0.15);
        }
    }

    /// Pulls back and pushes through the ball, the tip at this speed [m/s].
    fn stroke(&self, speed_m_s: f64) {
        let pull_m = (0.1 + 0.06 * speed_m_s).min(0.38);
        let pixels = |metres: f64| metres / STROKE_M_PER_HEIGHT * HEIGHT;
        let mut words = vec![String::from("mousedown 1 sleep 0.08")];
        let steps = 12;
        let back = pixels(pull_m - ADDRESS_GAP_M) / f64::from(steps);
        words.extend(
            (0..steps)
                .map(|_| format!("mousemove_relative -- 0 {} sleep 0.012", back.round().max(1.0))),
        );
        words.push("sleep 0.12".into());
        // Movements are whole pixels: what is left over goes into the next.
        let step = pixels(speed_m_s * SPEED * STEP_S);
        let (mut gone, mut done) = (0.0f64, 0.0f64);
        while gone < pixels(pull_m + 0.12) {
            gone += step;
            let by = gone.round() - done;
            done += by;
            words.push(format!("mousemove_relative -- 0 {} sleep {STEP_S}", -by));
        }
        words.push("mouseup 1".into());
        self.event(&words.join(" "));
    }
}

/// Whether a tool that this test needs is there.
fn has(tool: &str) -> bool {
    let found = Command::new("sh").args(["-c", &format!("command -v {tool}")]).output();
    found.is_ok_and(|output| output.status.success())
}

fn display() -> Option<(Running, String)> {
    let mut server = Command::new("Xvfb")
        .args(["-displayfd", "1", "-screen", "0", "800x600x24", "-nolisten", "tcp"])
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .ok()?;
    let mut line = String::new();
    BufReader::new(server.stdout.take()?).read_line(&mut line).ok()?;
    let number = line.trim().to_string();
    (!number.is_empty()).then(|| (Running(server), format!(":{number}")))
}

fn window(desk: &Desk) -> Option<()> {
    for _ in 0..200 {
        let found = Command::new("xdotool")
            .env("DISPLAY", &desk.display)
            .args(["search", "--name", "HapticBillard"])
            .output()
            .ok()?;
        let text = String::from_utf8_lossy(&found.stdout).trim().to_string();
        if let Some(id) = text.lines().next() {
            desk.event(&format!("windowfocus {id} mousemove 320 200"));
            return Some(());
        }
        desk.wait(0.1);
    }
    None
}

fn scene_text() -> String {
    let text = hapticbillard::shipped::scene("eight_ball").unwrap();
    text.replace("width = 1280", &format!("width = {}", SIZE.0))
        .replace("height = 720", &format!("height = {}", SIZE.1))
}

/// The foul on purpose.
fn is_meant(verdict: &Verdict) -> bool {
    verdict.fouls.contains(&Foul::NoContact)
}

/// The direction from the cue ball in which a soft stroke is farthest from every ball.
fn emptiest(view: &TableView2d, cue_ball: DVec2) -> DVec2 {
    let room = |way: &DVec2| {
        let away = view.balls.iter().map(|ball| {
            let to = ball.position - cue_ball;
            (to - *way * to.dot(*way).clamp(0.0, 0.7)).length()
        });
        // A cushion would send it somewhere else.
        let end = cue_ball + *way * 0.5;
        let is_inside = view.bed.holds(end, view.ball_radius_m);
        away.fold(f64::INFINITY, f64::min) - if is_inside { 0.0 } else { 0.3 }
    };
    let ways = (0..72).map(|i| DVec2::from_angle(f64::from(i) * std::f64::consts::TAU / 72.0));
    ways.max_by(|a, b| room(a).total_cmp(&room(b))).unwrap()
}

fn play(desk: &Desk) -> Seen {
    let mut random = Pcg64Mcg::seed_from_u64(5);
    let (mut own, mut has_followed) = (0, false);
    for _ in 0..150 {
        let Some(seen) = desk.foresee() else {
            desk.wait(0.1);
            continue;
        };
        let Some((tick, turn)) = seen.turn.clone() else {
            desk.wait(0.1);
            continue;
        };
        if seen.verdicts.last().is_some_and(|verdict| verdict.next_player.is_none()) {
            return seen;
        }
        assert_eq!(turn.player, PlayerId::ONE, "the computer waits for nobody");
        if turn.shot_number > 1 {
            desk.reach(tick);
            desk.wait(0.3);
        }
        let in_hand = turn.ball_in_hand.zone();
        if in_hand.is_some() && !seen.is_placed {
            desk.place(&seen);
            continue;
        }
        let told = desk.cue().filter(|(told, _)| tick <= *told);
        if told.is_none() {
            // The cue is not at the ball yet.
            desk.wait(0.1);
            continue;
        }
        let bed = desk.table.bed.unwrap();
        let view = TableView2d::of(&seen.table, &bed, &desk.table.pockets, POOL_RADIUS_M);
        let cue_ball = view.cue_ball.unwrap();
        let goal = Goal::of(&turn, &view, in_hand);
        let plan = plan_shot(&view, cue_ball, &goal, 0.07, &mut random);
        let (mut way, mut speed_m_s) = (plan.direction, plan.speed_m_s);
        let mine = |verdict: &&Arc<Verdict>| verdict.player == Some(PlayerId::ONE);
        let has_fouled = seen.verdicts.iter().filter(mine).any(|verdict| is_meant(verdict));
        if own > 0 && !has_fouled {
            // A foul on purpose: softly, where no ball is.
            way = emptiest(&view, cue_ball);
            speed_m_s = 0.2;
        }
        desk.aim(way);
        if !has_followed && own > 0 && has_fouled {
            has_followed = true;
            // Follow: the tip above the middle, by the right button and the mouse.
            desk.event("mousedown 3");
            desk.wait(0.1);
            desk.moved(0.0, -0.3 / OFFSET_PER_HEIGHT * HEIGHT);
            desk.event("mouseup 3");
            desk.wait(0.2);
            let tip = desk.cue().unwrap().1.position;
            let height_m = tip.z - POOL_RADIUS_M;
            assert!(height_m > 0.15 * POOL_RADIUS_M, "the tip is {height_m} m above the middle");
        }
        let before = seen.strikes;
        desk.stroke(speed_m_s * 1.1);
        desk.wait(0.4);
        own += usize::from(desk.foresee().is_some_and(|seen| seen.strikes > before));
    }
    panic!("the game does not end");
}

/// Breaks, aims, offsets the tip, pots and fouls in a window, against the computer, to the end.
#[test]
fn a_whole_game_is_played_in_a_window_with_mouse_and_keys() {
    if std::env::var_os("WINDOW_TESTS").is_none() {
        println!("skipped: it plays in real time; `make window` runs it");
        return;
    }
    if !has("Xvfb") || !has("xdotool") {
        println!("skipped: Xvfb and xdotool are not installed (apt-get install xvfb xdotool)");
        return;
    }
    let folder = folder("whole_game");
    let Some((_server, display)) = display() else {
        println!("skipped: Xvfb does not start");
        return;
    };
    let scene_file = folder.join("eight_ball_small.toml");
    std::fs::write(&scene_file, scene_text()).unwrap();
    let file = folder.join("game.jsonl");
    let text = scene_text();
    let scene = Scene::parse("eight_ball_small.toml", &text).unwrap();
    let table = Arc::new(Table::preset("pool-9ft").unwrap());
    let desk = Desk { display: display.clone(), file: file.clone(), scene, table };
    let game = Command::new(env!("CARGO_BIN_EXE_hapticbillard"))
        .args(["play", "--scene", scene_file.to_str().unwrap()])
        .args(["--record", file.to_str().unwrap(), "--speed", &SPEED.to_string()])
        .env("DISPLAY", &display)
        .env_remove("WAYLAND_DISPLAY")
        .env("LIBGL_ALWAYS_SOFTWARE", "1")
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let mut game = Running(game);
    window(&desk).expect("a window");
    desk.wait(1.0);

    play(&desk);

    // The recording is closed while the window still shows who won; q closes it.
    for _ in 0..1200 {
        if file.exists() {
            break;
        }
        desk.wait(0.05);
    }
    assert!(file.exists(), "the recording has no end");
    picture(&display, &folder.join("over.png"));
    desk.event("key q");
    let status = game.0.wait().unwrap();
    assert!(status.success(), "{status}");

    let checked = Command::new(env!("CARGO_BIN_EXE_hapticbillard"))
        .args(["replay", file.to_str().unwrap(), "--verify", "--headless", "--json"])
        .output()
        .unwrap();
    assert!(checked.status.success(), "{}", String::from_utf8_lossy(&checked.stdout));

    let seen = desk.foresee().unwrap();
    let own = || seen.verdicts.iter().filter(|verdict| verdict.player == Some(PlayerId::ONE));
    assert!(own().any(|verdict| is_meant(verdict)), "the foul");
    assert!(own().any(|verdict| verdict.legal && !verdict.pocketed.is_empty()), "a pot");
    assert!(seen.verdicts.iter().any(|verdict| verdict.player == Some(PlayerId::TWO)));
    assert!(seen.verdicts.last().is_some_and(|verdict| verdict.next_player.is_none()), "an end");
    assert!(seen.table.ball(BallId::EIGHT).is_some());
}

/// Keeps what the display shows, for whoever wants to see it.
fn picture(display: &str, file: &Path) {
    // Only where the tool is there: nothing depends on it.
    let _ = Command::new("import")
        .env("DISPLAY", display)
        .args(["-window", "root", file.to_str().unwrap()])
        .status();
}
