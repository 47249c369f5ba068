//! Sound: the actor in front of a speaker of our own, and the system's real audio library.

/// The system's audio library, without hardware.
#[cfg(all(target_os = "linux", feature = "sound"))]
mod alsa;
/// The program.
#[cfg(feature = "sound")]
mod program;
/// A sound card of our own.
pub mod speaker;

use super::counting;
use hapticbillard::events::{Event, Fact, FactKind, FactSet, Health, Source, Stamp, Stamped};
use hapticbillard::physics::Simulation;
use hapticbillard::sound::{Bank, MixSettings, Mixer, Mode, SoundClass, Told, render_offline};
use hapticbillard::tick::{Delivered, Pace};
use hapticbillard::units::Tick;
use hapticbillard_actors::event_manager::Sink;
use hapticbillard_actors::files::load_scene;
use hapticbillard_actors::game::Stage;
use hapticbillard_actors::pacer::Tempo;
use hapticbillard_actors::runtime::{self, Heard, Setup};
use hapticbillard_actors::sound::{
    Callback, Knobs, NoSound, NotBuilt, Plan, Seat, Sound, Started, Wiring, Work, score,
};
use kameo::mailbox;
use kameo::prelude::*;
use speaker::{RATE_HZ, Speaker};
use std::sync::Arc;
use std::time::{Duration, Instant};

pub fn stage(name: &str) -> Stage {
    Stage::new(&load_scene(name).unwrap(), name).unwrap()
}

/// Sound of a scene through a speaker, which is tried again soon when it is gone.
pub fn plan(stage: &Stage, speaker: &Speaker) -> Plan {
    let first = Arc::new(stage.simulation().unwrap().snapshot(0.0));
    let wiring = Wiring {
        backend: speaker.backend(),
        device: None,
        settings: MixSettings::default(),
        recordings: None,
        retry: Duration::from_millis(20),
        allocator: None,
    };
    let foley = stage.foley(first.clone()).unwrap();
    Plan { wiring, foley, first, pace: 1.0, knobs: Arc::new(Knobs::new(1.0, Mode::Headphones)) }
}

/// The same, ready for a game.
pub fn heard_through(stage: &Stage, speaker: &Speaker) -> Heard {
    let Started { seat, world, .. } = Seat::start(plan(stage, speaker)).unwrap();
    Heard { seat, world }
}

pub fn peak(heard: &[[f32; 2]]) -> f32 {
    heard.as_flattened().iter().fold(0.0, |peak, sample| peak.max(sample.abs()))
}

#[test]
fn a_game_in_real_time_is_heard() {
    let stage = stage("break_shot");
    let speaker = Speaker::new();
    let heard = heard_through(&stage, &speaker);
    speaker.wait_until_open();
    let running = speaker.run();
    let setup = Setup {
        pace: Pace::EveryTick,
        tempo: Tempo::RealTime(1.0),
        sound: Some(heard),
        workers: 2,
        ..Setup::headless(Tick(900))
    };
    runtime::run(stage.cast().unwrap(), setup).unwrap();
    drop(running);
    assert_eq!(speaker.opened(), 1);
    // A break is loud; the room is silent before it.
    assert!(peak(&speaker.heard()) > 0.02, "{}", peak(&speaker.heard()));
}

/// The actor by hand: physics runs tick by tick, the speaker plays block by block.
struct Bench {
    control: ActorRef<Sound>,
    sink: Sink,
    world: triple_buffer::Input<Arc<hapticbillard::physics::Snapshot>>,
    speaker: Speaker,
    simulation: Simulation,
    tick: u64,
    facts: Vec<Fact>,
    /// Keeps the line.
    seat: Arc<Seat>,
}

impl Bench {
    fn new(stage: &Stage) -> Self {
        let speaker = Speaker::new();
        let Started { seat, world, .. } = Seat::start(plan(stage, &speaker)).unwrap();
        let control = Sound::new(&seat).unwrap();
        let control = Sound::spawn_with_mailbox(control, mailbox::bounded(4));
        speaker.wait_until_open();
        let simulation = stage.simulation().unwrap();
        let (sink, facts) = (seat.sink(), Vec::new());
        Bench { control, sink, world, speaker, simulation, tick: 0, facts, seat }
    }

    /// A millisecond of the game, passed on `late` milliseconds later.
    async fn tick(&mut self, passes_on: bool) {
        self.tick += 1;
        let tick = Tick(self.tick);
        let mut facts = Vec::new();
        self.simulation.advance(tick.end_s(), FactSet::NONE, &mut facts).unwrap();
        let table = Arc::new(self.simulation.snapshot(tick.end_s()));
        self.world.write(table.clone());
        if !facts.is_empty() {
            let stamp = |sequence| Stamp { tick, source: Source::Physics, sequence };
            let events = facts
                .iter()
                .enumerate()
                .map(|(i, fact)| Stamped { stamp: stamp(i as u64), event: Event::Fact(*fact) });
            let mail = Delivered { tick, events: events.collect(), table };
            self.sink.mail.try_send(mail).unwrap();
            self.facts.extend(facts);
        }
        if passes_on {
            assert_eq!(self.control.ask(Work).await.unwrap().0, []);
        }
    }
}

/// The first frames of sounds behind a silence.
fn beginnings(heard: &[[f32; 2]]) -> Vec<usize> {
    let mut found = Vec::new();
    let mut silent = usize::MAX / 2;
    for (i, frame) in heard.iter().enumerate() {
        if frame[0].abs() > 1e-6 {
            if silent > 600 {
                found.push(i);
            }
            silent = 0;
        } else {
            silent += 1;
        }
    }
    found
}

#[tokio::test(flavor = "multi_thread")]
async fn two_clicks_are_as_far_apart_as_physics_has_them_and_soon_enough() {
    // Two pairs that meet as hard and as far from each ear, one below the other, at 0.1 and 0.25 s;
    // nothing rolls, because everything flies without gravity.
    let text = "[scene]\nname = \"x\"\n[physics]\ngravity_m_s2 = 0.0\n[sound]\n\
        [[ball]]\nid = 0\nposition_m = [-0.357150, 0, 0.3]\nvelocity_m_s = [3, 0, 0]\n\
        [[ball]]\nid = 1\nposition_m = [0, 0, 0.3]\n\
        [[ball]]\nid = 2\nposition_m = [-0.807150, 0, 1.3]\nvelocity_m_s = [3, 0, 0]\n\
        [[ball]]\nid = 3\nposition_m = [0, 0, 1.3]\n";
    let folder = super::cli::folder("two_clicks");
    let file = folder.join("scene.toml");
    std::fs::write(&file, text).unwrap();
    let mut bench = Bench::new(&stage(file.to_str().unwrap()));
    let mut played = 0;
    for ms in 1..=400_u64 {
        // The actor is called every other millisecond, the stream takes 512 frames at a time.
        bench.tick(ms.is_multiple_of(2)).await;
        while (played + 512) * 1000 <= ms * u64::from(RATE_HZ) {
            bench.speaker.play(512);
            played += 512;
        }
    }
    let is_hit = |fact: &&Fact| matches!(fact.kind, FactKind::BallsCollided { .. });
    let hits: Vec<f64> = bench.facts.iter().filter(is_hit).map(|fact| fact.time_s).collect();
    let heard = beginnings(&bench.speaker.heard());
    assert_eq!((hits.len(), heard.len()), (2, 2), "{hits:?} {heard:?}");
    let rate = f64::from(RATE_HZ);
    let apart = (heard[1] - heard[0]) as f64 - (hits[1] - hits[0]) * rate;
    // The clicks themselves differ by chance, also in how steeply they begin.
    assert!(apart.abs() <= 2.0, "{apart} frames");
    // Two periods, five milliseconds, two till the actor is called, and the way to the ear.
    let way_s = 2.1 / 343.0;
    let late_s = heard[0] as f64 / rate - hits[0];
    assert!(late_s <= 2.0 * 512.0 / rate + 0.007 + way_s, "{late_s} s");
}

#[tokio::test(flavor = "multi_thread")]
async fn who_changes_from_headphones_to_loudspeakers_hears_the_next_sound_so() {
    let mut heard = Vec::new();
    for changes in [0, 1, 2] {
        let mut bench = Bench::new(&stage("break_shot"));
        (0..changes).for_each(|_| bench.seat.knobs().change_mode());
        for ms in 1..=400_u64 {
            bench.tick(ms.is_multiple_of(2)).await;
            if ms.is_multiple_of(10) {
                bench.speaker.play(480);
            }
        }
        heard.push(bench.speaker.heard());
    }
    assert!(peak(&heard[0]) > 0.02);
    assert!(heard[0] != heard[1], "the mode changes nothing");
    assert!(heard[0] == heard[2], "there and back is not the same");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_device_that_ran_dry_is_counted_for_the_window() {
    let mut bench = Bench::new(&stage("break_shot"));
    bench.tick(true).await;
    assert_eq!(bench.seat.knobs().ran_dry(), 0);
    bench.speaker.run_dry();
    bench.speaker.run_dry();
    bench.tick(true).await;
    bench.tick(true).await;
    assert_eq!(bench.seat.knobs().ran_dry(), 2);
}

/// Whether the player was told that nothing is heard, or that it is heard again.
async fn told(control: &ActorRef<Sound>) -> Option<bool> {
    // The line tries again after pauses of up to a minute, each twice the one before: what a busy
    // machine loses between unplugging and plugging comes back doubled.
    let start = Instant::now();
    while start.elapsed() < Duration::from_secs(150) {
        for health in control.ask(Work).await.unwrap().0 {
            match health {
                Health::ActorFailed { .. } => return Some(false),
                Health::ActorRestarted { .. } => return Some(true),
                _ => {}
            }
        }
        tokio::time::sleep(Duration::from_millis(1)).await;
    }
    None
}

#[tokio::test(flavor = "multi_thread")]
async fn a_new_control_says_again_that_nothing_is_heard() {
    let speaker = Speaker::new();
    speaker.unplug();
    let Started { seat, .. } = Seat::start(plan(&stage("break_shot"), &speaker)).unwrap();
    let spawn = async || loop {
        // The one before lets go in a moment of its own, after its end.
        if let Some(control) = Sound::new(&seat) {
            return Sound::spawn_with_mailbox(control, mailbox::bounded(4));
        }
        tokio::time::sleep(Duration::from_millis(1)).await;
    };
    let control = spawn().await;
    assert_eq!(told(&control).await, Some(false));
    control.kill();
    control.wait_for_shutdown().await;
    let control = spawn().await;
    assert_eq!(control.ask(Work).await.unwrap().0.len(), 1);
    speaker.plug();
    assert_eq!(told(&control).await, Some(true));
}

#[test]
fn a_full_ring_drops_and_counts_and_a_callback_never_allocates() {
    let stage = stage("break_shot");
    let score = score(&stage, None, RATE_HZ, 2.0).unwrap();
    let mixer = || {
        let settings = MixSettings {
            room: Some(hapticbillard::sound::Room::CELLAR),
            ..MixSettings::default()
        };
        Mixer::new(settings, Arc::new(Bank::default()))
    };
    let (mut callback, mut tell, counters) = Callback::new(mixer(), RATE_HZ, Some(counting::calls));
    let mut told = score.told.iter().copied().peekable();
    let mut heard = Vec::new();
    let mut block = vec![[0.0_f32; 2]; 512];
    while heard.len() < 2 * RATE_HZ as usize {
        while !tell.is_full() {
            let Some(due) = told.next() else { break };
            tell.push(due).unwrap();
        }
        callback.fill(block.as_flattened_mut(), 2, |sample| sample);
        heard.extend_from_slice(&block);
    }
    assert_eq!(counters.allocations(), 0);
    assert_eq!(counters.frames(), heard.len() as u64);
    assert!(counters.work.count() > 100 && counters.share.most() > 0);
    let mut file = Vec::new();
    let end = heard.len() as u64;
    render_offline(&mut mixer(), score.told, end, |frames| {
        file.extend_from_slice(frames);
        Ok::<(), ()>(())
    })
    .unwrap();
    assert!(file == heard);
}

#[test]
fn other_formats_and_channels_get_the_same_samples() {
    let stage = stage("break_shot");
    let told = score(&stage, None, RATE_HZ, 1.0).unwrap().told;
    let play = |channels: usize| -> Vec<i16> {
        let mixer = Mixer::new(MixSettings::default(), Arc::new(Bank::default()));
        let (mut callback, mut tell, _) = Callback::new(mixer, RATE_HZ, None);
        told.iter().take(4000).for_each(|due| tell.push(*due).unwrap());
        let mut out = vec![7_i16; 40_000 * channels];
        callback.fill(&mut out, channels, |sample| (sample * 32_767.0) as i16);
        out
    };
    let (two, one, four) = (play(2), play(1), play(4));
    assert!(two.iter().any(|sample| sample.abs() > 300));
    for ((two, one), four) in two.chunks(2).zip(&one).zip(four.chunks(4)) {
        assert!(((i32::from(two[0]) + i32::from(two[1])) / 2 - i32::from(*one)).abs() <= 1);
        assert_eq!(four, [two[0], two[1], 0, 0]);
    }
}

#[test]
fn every_class_of_an_ordinary_game_is_in_some_score() {
    let mut classes = Vec::new();
    for (scene, seconds) in [("break_shot", 12.0), ("eight_ball_headless", 60.0)] {
        let told = score(&stage(scene), None, RATE_HZ, seconds).unwrap().told;
        classes.extend(told.iter().filter_map(|(_, told)| match told {
            Told::Start { onset, .. } => Some(onset.class),
            _ => None,
        }));
        assert!(told.iter().any(|(_, told)| matches!(told, Told::Roll(_))));
        assert!(told.is_sorted_by_key(|(at_frame, _)| *at_frame));
    }
    for class in [
        SoundClass::BallClick,
        SoundClass::CueStrike,
        SoundClass::Cushion,
        SoundClass::Pocket,
        SoundClass::Gully,
        SoundClass::Landing,
        SoundClass::Chalk,
    ] {
        assert!(classes.contains(&class), "{class:?}");
    }
}

#[test]
fn without_the_feature_there_is_one_sentence() {
    use hapticbillard_actors::sound::Backend;
    assert_eq!(NotBuilt.outputs(), Err(NoSound::NotBuilt));
    assert!(NoSound::NotBuilt.to_string().contains("feature `sound`"));
}
