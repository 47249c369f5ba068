//! A whole game in a real window: a virtual display, real mouse and key events, and the recording
//! to judge by.
//!
//! The player here knows only what the growing recording says: replaying it so far shows the table
//! at the player's next turn.

/// Display, mouse, keyboard and the growing recording.
mod desk;

use crate::cli::folder;
use desk::{Desk, Hands, Running, SPEED, Seen, display, has};
use glam::DVec2;
use hapticbillard::ai::{Goal, TableView2d, plan_shot};
use hapticbillard::ball::POOL_RADIUS_M;
use hapticbillard::events::{Foul, ShotKind, TurnAfter, Verdict};
use hapticbillard::ids::PlayerId;
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;
use std::path::Path;
use std::process::{Command, Stdio};

/// How far above the middle the tip meets the ball in the stroke with follow, in ball radii.
const FOLLOW: f64 = 0.25;
/// A game may end before everything has been shown, with the 8 in a pocket too early.
const GAMES_MAX: u64 = 4;
/// More strokes than any game takes.
const STROKES_MAX: u32 = 300;

/// What a whole game must have shown; all of it is read off the recording.
#[derive(Debug, PartialEq)]
struct Shown {
    break_stroke: bool,
    tip_offset: bool,
    pot: bool,
    foul: bool,
    computer: bool,
    end: bool,
}

impl Shown {
    fn of(seen: &Seen) -> Self {
        let own: Vec<_> =
            seen.verdicts.iter().filter(|verdict| verdict.player == Some(PlayerId::ONE)).collect();
        let strokes = || seen.strokes.iter().filter(|stroke| stroke.player == PlayerId::ONE);
        Shown {
            break_stroke: seen.verdicts.first().is_some_and(|verdict| {
                verdict.player == Some(PlayerId::ONE) && !verdict.fouls.contains(&Foul::NoContact)
            }),
            tip_offset: strokes().any(|stroke| 0.8 * FOLLOW < stroke.height),
            pot: own.iter().any(|verdict| verdict.legal && !verdict.pocketed.is_empty()),
            foul: own.iter().any(|verdict| !verdict.legal),
            computer: seen.strokes.iter().any(|stroke| stroke.player == PlayerId::TWO),
            end: seen.verdicts.last().is_some_and(|verdict| verdict.turn == TurnAfter::End),
        }
    }

    const ALL: Shown = Shown {
        break_stroke: true,
        tip_offset: true,
        pot: true,
        foul: true,
        computer: true,
        end: true,
    };
}

/// The foul on purpose.
fn is_meant(verdict: &Verdict) -> bool {
    verdict.player == Some(PlayerId::ONE) && verdict.fouls.contains(&Foul::NoContact)
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

/// Where to put a cue ball in hand.
fn free_place(view: &TableView2d, is_break: bool) -> DVec2 {
    let start = if is_break { DVec2::new(-0.7, 0.08) } else { view.bed.head_spot() };
    (0..400)
        .map(|i| start + DVec2::new(-0.02 * f64::from(i / 20), 0.03 * f64::from(i % 20 - 10)))
        .find(|place| view.has_room(*place))
        .unwrap()
}

/// Plays until the game is over.
fn play(desk: &Desk) -> Seen {
    let table = desk.table();
    let mut random = Pcg64Mcg::seed_from_u64(5);
    for stroke in 0..STROKES_MAX {
        let seen = desk.foresee();
        if seen.verdicts.last().is_some_and(|verdict| verdict.turn == TurnAfter::End) {
            return seen;
        }
        let (tick, turn) = seen.turn.clone().expect("a turn");
        // A shot that was made has a verdict, or its balls roll for ever: then nobody is called.
        assert!(!seen.is_rolling, "balls that never come to rest");
        assert_eq!(turn.player, PlayerId::ONE, "the computer waits for nobody");
        desk.reach(tick);

        let bed = table.bed.unwrap();
        let view = TableView2d::of(&seen.table, &bed, &table.pockets, POOL_RADIUS_M);
        let in_hand = turn.ball_in_hand.zone();
        if let Some(zone) = in_hand
            && !seen.is_placed
        {
            desk.place(free_place(&view, turn.shot == ShotKind::Break), &seen, zone);
            continue;
        }
        desk.take_cue(&seen);
        let cue_ball = view.cue_ball.unwrap();
        let goal = Goal::of(&turn, &view, in_hand);
        let plan = plan_shot(&view, cue_ball, &goal, 0.07, &mut random);
        let shown = Shown::of(&seen);
        let is_break = turn.shot == ShotKind::Break;
        // After the first pot a foul on purpose: softly, where no ball is.
        let is_foul = shown.pot && !is_break && !seen.verdicts.iter().any(|v| is_meant(v));
        let (way, speed_m_s) = if is_foul {
            (emptiest(&view, cue_ball), 0.2)
        } else {
            (plan.direction, plan.speed_m_s)
        };
        desk.aim(&seen, way);
        // The first stroke after the break is made with follow.
        if !is_break && !shown.tip_offset {
            desk.raise_tip(&seen, FOLLOW);
        }
        let is_struck = desk.stroke(&seen, speed_m_s);
        let what = match (is_struck, is_foul) {
            (false, _) => "no stroke",
            (true, true) => "a foul on purpose",
            (true, false) => "a stroke",
        };
        println!("{stroke}: shot {}, {:?}: {what}", turn.shot_number, plan.kind);
    }
    desk.picture("in_vain.png");
    panic!("the game does not end");
}

/// What a player has set who starts the program for the second time.
const SETTINGS: &str = "welcomed = true\ngame = \"eight_ball\"\nplayer_1 = \"human\"\n\
    player_2 = \"computer\"\nstrength_2 = 50\nlanguage = \"english\"\n";

/// Starts the program, plays one game from its main menu in a window, sees the last shot again,
/// goes back to the main menu and leaves; what the finished recording holds.
fn game(folder: &Path, display: &str) -> Seen {
    let [config, data] = ["config", "data"].map(|name| folder.join(name));
    std::fs::create_dir_all(config.join("hapticbillard")).unwrap();
    std::fs::write(config.join("hapticbillard/settings.toml"), SETTINGS).unwrap();
    let recordings = data.join("hapticbillard/recordings");
    let known = files(&recordings).len();
    let window = Command::new(env!("CARGO_BIN_EXE_hapticbillard"))
        .args(["play", "--speed", &SPEED.to_string()])
        .env("DISPLAY", display)
        .env_remove("WAYLAND_DISPLAY")
        .env("XDG_CONFIG_HOME", &config)
        .env("XDG_DATA_HOME", &data)
        .env("LIBGL_ALWAYS_SOFTWARE", "1")
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let mut window = Running(window);
    let hands = Hands { display: display.into(), pictures: folder.into() };
    hands.find_window();
    hands.event("sleep 2");
    hands.picture("main.png");

    // The options and back; then the game against the weakest computer, whose steadier kin often
    // run the table before a person has shown anything.
    hands.keys(&["Down", "Down", "Return"]);
    hands.picture("options.png");
    hands.keys(&["Escape", "Up", "Up", "Return", "Up", "Up"]);
    hands.keys(&["Left"; 11]);
    hands.keys(&["Down", "Down"]);
    hands.picture("mode.png");
    hands.keys(&["Return"]);
    let part = hands.until("a recording", || {
        let new = files(&recordings).into_iter().find(|file| file.ends_with(".part"));
        new.filter(|_| known < files(&recordings).len())
    });
    let file = recordings.join(part.trim_end_matches(".part"));
    let desk = Desk::new(hands, file.clone());

    play(&desk);

    // The recording is closed while the window still shows who won. From there the last shot is
    // seen again; another key leads back, to the main menu, and out.
    desk.event("keydown f");
    desk.until("the end of the recording", || file.exists().then_some(()));
    desk.event("keyup f sleep 1");
    desk.picture("over.png");
    desk.keys(&["Down", "Return"]);
    desk.event("sleep 2");
    desk.picture("replay.png");
    desk.keys(&["Escape", "Down", "Down", "Return"]);
    desk.event("sleep 1");
    desk.picture("main_again.png");
    desk.keys(&["Up", "Return"]);
    let status = window.0.wait().unwrap();
    assert!(status.success(), "{status}");
    let kept = std::fs::read_to_string(config.join("hapticbillard/settings.toml")).unwrap();
    assert!(kept.contains("strength_2 = 0"), "what was set is kept: {kept}");

    let checked = Command::new(env!("CARGO_BIN_EXE_hapticbillard"))
        .args(["replay", file.to_str().unwrap(), "--verify", "--headless", "--json"])
        .output()
        .unwrap();
    assert!(checked.status.success(), "{}", String::from_utf8_lossy(&checked.stdout));
    desk.foresee()
}

/// The names of the files in a folder, if it is there.
fn files(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect()
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
    let mut last = None;
    for number in 1..=GAMES_MAX {
        let shown = Shown::of(&game(&folder, &display));
        println!("game {number}: {shown:?}");
        // Nothing that the player can make sure of may be missing in any game.
        assert!(shown.break_stroke && shown.end, "{shown:?}");
        if shown == Shown::ALL {
            return;
        }
        last = Some(shown);
    }
    panic!("no game showed everything: {last:?}");
}
