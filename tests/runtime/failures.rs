//! Who fails and what then: the design's table, cell by cell, on the real actors of real games.
//!
//! | fails | then | tests |
//! |---|---|---|
//! | Ai | replaced, nothing is lost | `computer_players_and_inputs_…` |
//! | Input | replaced, nothing is lost | the same, `a_hand_that_panics_…` |
//! | Input for good | the game stops in order | `supervision::when_the_input_dies_…` |
//! | Recorder | another one goes on | `supervision::a_recorder_that_dies_…` |
//! | Renderer | the game goes on | `whoever_only_listens_…` |
//! | Physics, Rules, EventManager, Conductor | the game stops in order | `whoever_must_not_…` |
//! | Haptic control | no force, another one, a soft start | `contact::a_killed_control_…` |
//! | Haptic servo | no force, the player is told | `contact::a_servo_that_panics_…` |
//! | device lost in an armed stroke | pause, then the mouse | `hand_over` |
//! | device lost otherwise | the mouse at once | `input::stylus` of the core tests |
//! | device lost, or says NaN | no force at that tick | `contact::a_device_that_is_lost_…` |
//! | the world stalls | the force fades | `contact::a_world_that_stalls_…` |
//! | Sound | another one, the game is the same | `sound_that_is_killed_…` |
//! | sound device | the game goes on, sound returns | `a_speaker_that_is_unplugged_…` |
//! | no sound device | silence, the player is told once | `without_a_speaker_…` |
//! | rights | the player is told, with the remedy | `what_is_refused_…`, `realtime_kit` |

use super::cli::folder;
use super::hearing::Hears;
use super::sound::speaker::Speaker;
use super::sound::{heard_through, peak};
use super::supervision::{draft, recorded, run, stage, undisturbed, verify};
use hapticbillard::events::{Event, Health, Source, Topic, Topics};
use hapticbillard::hash::StateHash;
use hapticbillard::input::HumanView;
use hapticbillard::physics::Snapshot;
use hapticbillard::renderer::{Hud, Scoreboard, Words};
use hapticbillard::rules::{Language, Texts};
use hapticbillard::tick::{Delivered, End, Frame, FrameSource, Inflow, Outcome, Pace, Participant};
use hapticbillard::units::Tick;
use hapticbillard_actors::crew::{Crew, Fault, Roster};
use hapticbillard_actors::event_manager::Sink;
use hapticbillard_actors::files::load_scene;
use hapticbillard_actors::game::Stage;
use hapticbillard_actors::haptic::{Asked, Core, Plan, Seat, Started};
use hapticbillard_actors::pacer::Tempo;
use hapticbillard_actors::recorder::Recorder;
use hapticbillard_actors::runtime::{self, Felt, InputPort, Setup};
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

/// Hears every event of a topic, and with every n-th kills whoever bears a name.
struct Killer {
    topic: Topic,
    every: u32,
    heard: u32,
    victim: &'static str,
    roster: Roster,
    killed: Arc<AtomicU32>,
}

impl Participant for Killer {
    fn source(&self) -> Source {
        Source::Runtime
    }

    fn topics(&self) -> Topics {
        Topics::of(&[self.topic])
    }

    fn start(&mut self, _: &Snapshot) -> Outcome {
        Outcome::default()
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        for _ in delivered.events.iter() {
            self.heard += 1;
            if self.heard.is_multiple_of(self.every) {
                let killed = self.roster.strike(self.victim, Fault::Kill);
                self.killed.fetch_add(killed as u32, Ordering::SeqCst);
            }
        }
        Outcome::default()
    }

    fn hash(&self, _: &mut StateHash) {}
}

/// A killer among those who watch a game, and how many it has killed.
fn with_killer(
    victim: &'static str,
    topic: Topic,
    every: u32,
    setup: Setup,
) -> (Setup, Arc<AtomicU32>) {
    let (crew, roster) = Crew::watched();
    let killed = Arc::new(AtomicU32::new(0));
    let killer = Killer { topic, every, heard: 0, victim, roster, killed: killed.clone() };
    let Setup { mut observers, .. } = setup;
    observers.push(Box::new(killer));
    (Setup { observers, crew, ..setup }, killed)
}

/// What the player was told of an actor: whether it is there.
fn told(listener: &Hears, name: &str) -> Vec<bool> {
    listener.heard(|event| match event {
        Event::Health(health) => match &**health {
            Health::ActorFailed { actor, .. } if actor == name => Some(false),
            Health::ActorRestarted { actor } if actor == name => Some(true),
            _ => None,
        },
        _ => None,
    })
}

/// A script without words, which is asked now and then.
struct Silent;

impl FrameSource for Silent {
    fn inflow(&mut self, tick: Tick) -> Inflow {
        Inflow { next: Some(tick.after(400)), ..Inflow::default() }
    }
}

#[test]
fn computer_players_and_inputs_that_are_killed_are_replaced_and_the_game_is_the_same() {
    let (reference, whole) = undisturbed("replaced");
    for (victim, topic, every) in
        [("ai", Topic::Player, 23), ("ai", Topic::Command, 40), ("input", Topic::Verdict, 5)]
    {
        let file = folder("replaced").join(format!("{victim}{every}.jsonl"));
        let listener = Hears::of(Topic::Health);
        let input = InputPort::StandIn(Box::new(Silent));
        let base = recorded(&file, Box::new(Recorder::start));
        let observers: Vec<Box<dyn Participant>> = vec![Box::new(listener.clone())];
        let base = Setup { input, observers, ..base };
        let (setup, killed) = with_killer(victim, topic, every, base);
        let finished = run(setup).unwrap();
        assert_eq!((finished.end, finished.hash), (reference.end, reference.hash.clone()));
        assert_eq!(std::fs::read_to_string(&file).unwrap(), whole, "{victim}");
        // Each is killed at least once, and whoever plays is told of each.
        let killed = killed.load(Ordering::SeqCst);
        let told = told(&listener, victim);
        assert!(killed > 1 && told.len() > 1, "{victim}: {killed}, {told:?}");
        assert!(told.chunks(2).all(|pair| pair == [false, true]), "{told:?}");
    }
}

/// Dies over one frame and goes on with the next.
struct Faint(u32);

impl FrameSource for Faint {
    fn inflow(&mut self, tick: Tick) -> Inflow {
        self.0 += 1;
        assert_ne!(self.0, 30, "the input is made to die here");
        Inflow { frame: Frame::new(), next: Some(tick.after(500)), ..Inflow::default() }
    }
}

#[test]
fn a_hand_that_panics_once_is_replaced_and_the_game_is_the_same() {
    let (reference, whole) = undisturbed("faints");
    let file = folder("faints").join("game.jsonl");
    let listener = Hears::of(Topic::Health);
    let setup = Setup {
        input: InputPort::StandIn(Box::new(Faint(0))),
        observers: vec![Box::new(listener.clone())],
        ..recorded(&file, Box::new(Recorder::start))
    };
    let finished = run(setup).unwrap();
    assert_eq!((finished.end, finished.hash), (reference.end, reference.hash));
    assert_eq!(std::fs::read_to_string(&file).unwrap(), whole);
    assert_eq!(told(&listener, "input"), [false, true]);
}

#[test]
fn whoever_must_not_lose_anything_stops_the_game_in_order_and_it_is_recorded_up_to_there() {
    for victim in ["physics", "rules", "event manager", "conductor"] {
        let file = folder("stops").join(format!("{victim}.jsonl"));
        let base = recorded(&file, Box::new(Recorder::start));
        let (setup, killed) = with_killer(victim, Topic::Verdict, 7, base);
        let line = run(setup).unwrap_err().to_string();
        assert_eq!(killed.load(Ordering::SeqCst), 1, "{victim}");
        assert!(
            line.to_lowercase().contains(victim) && line.contains(" stopped at tick "),
            "{line}"
        );
        assert_eq!(line.lines().count(), 1);
        verify(&draft(&file));
    }
}

#[test]
fn whoever_only_listens_can_go_and_the_game_is_the_same() {
    let (reference, _) = undisturbed("listeners");
    let file = folder("listeners").join("game.jsonl");
    // A window that is gone, and one that takes nothing.
    let (mail, gone) = flume::bounded(4);
    let (lagging, _kept) = flume::bounded(4);
    let sinks = [mail, lagging].map(|mail| Sink::new("test", Topics::ALL, mail));
    let dropped = sinks[1].dropped.clone();
    drop(gone);
    let sinks = Vec::from(sinks);
    let finished = run(Setup { sinks, ..recorded(&file, Box::new(Recorder::start)) }).unwrap();
    assert_eq!((finished.end, finished.hash), (reference.end, reference.hash));
    assert!(dropped.load(Ordering::SeqCst) > 10);
}

#[test]
fn what_is_refused_stands_in_the_players_window_with_what_would_help() {
    let stage = Stage::new(&load_scene("haptic_touch").unwrap(), "haptic_touch").unwrap();
    let asked = Asked { core: Core::Number(1023), priority: None, ..Asked::default() };
    let plan = Plan { asked, ..stage.haptic().unwrap().unwrap() };
    let Started { seat, world, .. } = Seat::start(plan).unwrap();
    let (mail, heard) = flume::unbounded::<Delivered>();
    let setup = Setup {
        pace: Pace::EveryTick,
        tempo: Tempo::RealTime(1.0),
        sinks: vec![Sink::new("test", Scoreboard::topics(), mail)],
        haptic: Some(Felt { seat, world }),
        ..Setup::headless(Tick(300))
    };
    runtime::run(stage.cast().unwrap(), setup).unwrap();
    let mut board = Scoreboard::default();
    for delivered in heard.iter() {
        delivered.events.iter().for_each(|stamped| board.hear(&stamped.event));
    }
    for language in [Language::English, Language::German] {
        let (texts, words) = (Texts::new(language), Words::new(language));
        let hud = Hud::new(&board, &HumanView::default(), &texts, &words);
        let line = hud.message.iter().find(|line| line.contains("core 1023")).unwrap();
        assert!(line.contains("name one in [haptic]"), "{line}");
    }
}

/// A recorded game with sound, fast but on a clock, and who hears what the player is told.
fn sounding(name: &str, speaker: &Speaker) -> (Setup, Hears, std::path::PathBuf) {
    let file = folder(name).join("game.jsonl");
    let listener = Hears::of(Topic::Health);
    let setup = Setup {
        sound: Some(heard_through(&stage(), speaker)),
        observers: vec![Box::new(listener.clone())],
        tempo: Tempo::RealTime(20.0),
        limit: Tick(60_000),
        workers: 2,
        ..recorded(&file, Box::new(Recorder::start))
    };
    (setup, listener, file)
}

#[test]
fn sound_that_is_killed_is_replaced_and_heard_again_and_the_game_is_the_same() {
    let quiet = Speaker::new();
    quiet.unplug();
    let (setup, _, file) = sounding("sound_lives", &quiet);
    let reference = run(setup).unwrap();
    let whole = std::fs::read_to_string(file).unwrap();

    let speaker = Speaker::new();
    let running = speaker.run();
    let (setup, listener, file) = sounding("sound_dies", &speaker);
    let (setup, killed) = with_killer("sound", Topic::CueBallStruck, 4, setup);
    let finished = run(setup).unwrap();
    drop(running);
    assert_eq!((finished.end, finished.hash), (reference.end, reference.hash));
    assert_eq!(std::fs::read_to_string(file).unwrap(), whole);
    let (killed, told) = (killed.load(Ordering::SeqCst), told(&listener, "sound"));
    assert!(killed > 0 && told.len() > 1, "{killed} {told:?}");
    assert!(told.chunks(2).all(|pair| [false, true].starts_with(pair)), "{told:?}");
    // The line outlives its controls.
    assert_eq!(speaker.opened(), 1);
    let heard = speaker.heard();
    let half = heard.len() / 2;
    assert!(peak(&heard[..half]) > 1e-3 && peak(&heard[half..]) > 1e-3);
}

#[test]
fn a_speaker_that_is_unplugged_in_a_game_stops_nothing_and_sounds_again_when_it_is_back() {
    let speaker = Speaker::new();
    let (setup, listener, _) = sounding("unplugged", &speaker);
    speaker.wait_until_open();
    let running = speaker.run();
    let hand = speaker.clone();
    let hand = std::thread::spawn(move || {
        while peak(&hand.heard()) < 1e-3 {
            std::thread::sleep(Duration::from_millis(10));
        }
        hand.unplug();
        std::thread::sleep(Duration::from_millis(300));
        hand.plug();
        hand.wait_until_open();
        hand.heard().len()
    });
    let finished = run(Setup { limit: Tick(100_000), ..setup }).unwrap();
    let back = hand.join().unwrap();
    drop(running);
    assert_eq!((finished.end, finished.tick), (End::Limit, Tick(100_000)));
    assert_eq!(told(&listener, "sound"), [false, true]);
    assert_eq!(speaker.opened(), 2);
    let heard = speaker.heard();
    assert!(peak(&heard[..back]) > 1e-3 && peak(&heard[back..]) > 1e-3);
}

#[test]
fn without_a_speaker_the_game_is_played_and_the_player_is_told_once() {
    let speaker = Speaker::new();
    speaker.unplug();
    let (setup, listener, _) = sounding("no_speaker", &speaker);
    run(Setup { limit: Tick(10_000), ..setup }).unwrap();
    assert_eq!(told(&listener, "sound"), [false]);
    let health = |event: &Event| matches!(event, Event::Health(_)).then(|| event.clone());
    let [told] = &listener.heard(health)[..] else { panic!("more than once") };
    let mut board = Scoreboard::default();
    board.hear(told);
    for language in [Language::English, Language::German] {
        let (texts, words) = (Texts::new(language), Words::new(language));
        let hud = Hud::new(&board, &HumanView::default(), &texts, &words);
        assert!(hud.message.iter().any(|line| line.contains("it is unplugged")), "{hud:?}");
    }
}
