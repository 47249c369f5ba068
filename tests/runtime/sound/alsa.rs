//! The system's audio library, without hardware: its file plugin writes what the real callback of
//! the real stream gives. The library reads its configuration once a process, so each of these
//! plays in a process of its own, which is this program again.
//!
//! Nothing paces the file plugin: a stream runs some hundred times as fast as time. So everything
//! is told by frames, and the callback waits for whoever tells.
//!
//! `SOUND_MINUTES=10 cargo test --release -p hapticbillard-actors --test runtime sound_long --
//! --nocapture` plays that many minutes of real games, and holds the callback to a quarter of its
//! period.

use super::super::{cli::folder, counting};
use super::{RATE_HZ, peak, stage};
use hapticbillard::scene::Overrides;
use hapticbillard::sound::{Bank, MixSettings, Mixer, Room, Told, render_offline};
use hapticbillard::tick::Pace;
use hapticbillard::units::Tick;
use hapticbillard_actors::pacer::Tempo;
use hapticbillard_actors::runtime::{self, Heard, Setup};
use hapticbillard_actors::sound::{
    Backend, Callback, Counters, Due, NoSound, Seat, Started, Wiring, score, system,
};
use std::path::Path;
use std::process::{Command, Output};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

const SYSTEM: &str = "/usr/share/alsa/alsa.conf";

/// A configuration whose default output is a WAV file.
fn configure(folder: &Path) -> (String, String) {
    assert!(
        Path::new(SYSTEM).exists(),
        "{SYSTEM} is missing, so that nothing can be played: install the library's configuration \
         (on Debian libasound2-data)"
    );
    let wave = folder.join("out.wav").display().to_string();
    let configuration = folder.join("asound.conf");
    // Without a slave of 16 bits the plugin writes what its header does not say.
    let text = format!(
        "<{SYSTEM}>\npcm.!default {{ type plug slave {{ format S16_LE rate {RATE_HZ} channels 2\n\
         pcm {{ type file slave.pcm {{ type null }} file \"{wave}\" format \"wav\" perm 0644 }} \
         }} }}\n"
    );
    std::fs::write(&configuration, text).unwrap();
    (configuration.display().to_string(), wave)
}

/// Says which of the tests below a process is there for; in others they do nothing.
const CHILD: &str = "SOUND_CHILD";

fn is_child(name: &str) -> bool {
    std::env::var(CHILD).is_ok_and(|child| child == name)
}

/// Runs one of the tests below in a process of its own.
fn child(name: &str, environment: &[(&str, &str)]) -> Output {
    let output = Command::new(std::env::current_exe().unwrap())
        .args([&format!("sound::alsa::{name}"), "--exact", "--nocapture"])
        .env(CHILD, name)
        .envs(environment.iter().copied())
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{name}: {said}");
    output
}

/// The largest share of its period that 99 of 100 callbacks may take [1/1000].
const SHARE_MAX: u64 = 250;

/// How many minutes somebody wants to be played.
fn asked_minutes() -> Option<f64> {
    std::env::var("SOUND_MINUTES").ok().map(|text| text.parse().unwrap())
}

fn minutes() -> f64 {
    asked_minutes().unwrap_or(0.1)
}

/// The break, and then games one after another until the time is full.
fn games(frames: u64) -> Vec<Due> {
    let (mut told, mut from, mut seed) = (Vec::new(), 0, 0);
    while from < frames {
        let stage = match seed {
            0 => stage("break_shot"),
            _ => stage("eight_ball_headless")
                .with(Overrides { seed: Some(seed), ..Overrides::default() }),
        };
        let limit_s = (frames - from) as f64 / f64::from(RATE_HZ);
        let game = score(&stage, None, RATE_HZ, limit_s).unwrap();
        told.extend(game.told.into_iter().map(|(at_frame, told)| match told {
            Told::Start { at_frame, onset } => {
                (from + at_frame, Told::Start { at_frame: from + at_frame, onset })
            }
            told => (from + at_frame, told),
        }));
        // A second of silence between two games.
        from += ((game.end_s + 1.0) * f64::from(RATE_HZ)) as u64;
        seed += 1;
    }
    told.retain(|(at_frame, _)| *at_frame < frames);
    told
}

fn mixer() -> Mixer {
    let settings = MixSettings { room: Some(Room::CELLAR), ..MixSettings::default() };
    Mixer::new(settings, Arc::new(Bank::default()))
}

/// Everything before this frame has been told.
static TOLD: AtomicU64 = AtomicU64::new(0);
/// What has been mixed.
static COUNTERS: OnceLock<Arc<Counters>> = OnceLock::new();
/// Far more than is mixed at a time.
const AHEAD: u64 = 8192;

/// Waits until what comes next has been told; how often the allocator was used until then.
fn calls_once_told() -> u64 {
    let mixed = || COUNTERS.get().map_or(u64::MAX - AHEAD, |counters| counters.frames());
    while TOLD.load(Ordering::Acquire) < mixed() + AHEAD {
        std::thread::sleep(Duration::from_micros(20));
    }
    counting::calls()
}

#[test]
fn plays_games_into_a_file() {
    if !is_child("plays_games_into_a_file") {
        return;
    }
    let frames = (minutes() * 60.0 * f64::from(RATE_HZ)) as u64;
    let told = games(frames);
    let mut ends = None;
    let mut make = |rate_hz: u32| {
        assert_eq!(rate_hz, RATE_HZ);
        let (callback, tell, counters) = Callback::new(mixer(), rate_hz, Some(calls_once_told));
        ends = Some((tell, counters));
        callback
    };
    let playing = system().open(None, &mut make).unwrap();
    let (mut tell, counters) = ends.unwrap();
    COUNTERS.set(counters.clone()).unwrap();
    let begun = Instant::now();
    let mut rest = told.iter().copied().peekable();
    while counters.frames() < frames {
        while let Some(due) = rest.peek() {
            if tell.push(*due).is_err() {
                break;
            }
            rest.next();
        }
        let next = rest.peek().map_or(u64::MAX / 2, |(at_frame, _)| *at_frame);
        TOLD.store(next, Ordering::Release);
        std::thread::sleep(Duration::from_micros(50));
        assert!(begun.elapsed() < Duration::from_secs(1800), "the stream stands still");
    }
    // Nobody holds the callback up any more.
    TOLD.store(u64::MAX, Ordering::Release);
    drop(playing);
    println!(
        "{frames} frames in blocks of {}; allocations {}, late {}, dropped {}; processor time \
         of a callback: median {} us, 99 % {} us, most {} us; share of its period: median {:.1} %, \
         99 % {:.1} %, most {:.1} %",
        counters.period(),
        counters.allocations(),
        counters.late(),
        counters.dropped(),
        counters.work.quantile(0.5) / 1000,
        counters.work.quantile(0.99) / 1000,
        counters.work.most() / 1000,
        counters.share.quantile(0.5) as f64 / 10.0,
        counters.share.quantile(0.99) as f64 / 10.0,
        counters.share.most() as f64 / 10.0,
    );
    assert_eq!((counters.allocations(), counters.late()), (0, 0));
    // Only who asks for it has a machine that does nothing else.
    let share = counters.share.quantile(0.99);
    assert!(asked_minutes().is_none() || share < SHARE_MAX, "99 % take {share} / 1000");
}

#[test]
fn sound_long() {
    let folder = folder("sound_long");
    let (configuration, wave) = configure(&folder);
    let played = child("plays_games_into_a_file", &[("ALSA_CONFIG_PATH", &configuration)]);
    let said = String::from_utf8_lossy(&played.stdout);
    eprintln!("{}", said.lines().find(|line| line.contains("allocations")).unwrap());

    let frames = (minutes() * 60.0 * f64::from(RATE_HZ)) as u64;
    let mut file = hound::WavReader::open(&wave).unwrap();
    assert_eq!((file.spec().channels, file.spec().sample_rate), (2, RATE_HZ));
    let mut samples = file.samples::<i16>();
    let (mut at, mut loud) = (0_u64, 0.0_f32);
    render_offline(&mut mixer(), games(frames), frames, |run| {
        loud = loud.max(peak(run));
        for sample in run.as_flattened() {
            let played = f32::from(samples.next().unwrap().unwrap());
            let apart = (played - sample * 32_768.0).abs();
            assert!(apart <= 1.0, "sample {at}: {played} against {}", sample * 32_768.0);
            at += 1;
        }
        Ok::<(), ()>(())
    })
    .unwrap();
    assert!(at == 2 * frames && loud > 0.05, "{at} {loud}");
    // It may be large.
    std::fs::remove_file(&wave).unwrap();
}

fn wiring(backend: Box<dyn Backend>) -> Wiring {
    let retry = Duration::from_millis(20);
    Wiring {
        backend,
        device: None,
        settings: MixSettings::default(),
        recordings: None,
        retry,
        allocator: None,
    }
}

#[test]
fn plays_a_game_in_real_time() {
    if !is_child("plays_a_game_in_real_time") {
        return;
    }
    let stage = stage("break_shot");
    let plan = super::plan(&stage, &super::Speaker::new());
    let plan = hapticbillard_actors::sound::Plan { wiring: wiring(system()), ..plan };
    let Started { seat, world, .. } = Seat::start(plan).unwrap();
    let setup = Setup {
        pace: Pace::EveryTick,
        tempo: Tempo::RealTime(1.0),
        sound: Some(Heard { seat, world }),
        workers: 2,
        ..Setup::headless(Tick(800))
    };
    runtime::run(stage.cast().unwrap(), setup).unwrap();
}

#[test]
fn a_game_plays_through_the_real_library() {
    let folder = folder("sound_game");
    let (configuration, wave) = configure(&folder);
    child("plays_a_game_in_real_time", &[("ALSA_CONFIG_PATH", &configuration)]);
    let mut file = hound::WavReader::open(&wave).unwrap();
    let loudest = file.samples::<i16>().map(|sample| sample.unwrap().unsigned_abs()).max();
    assert!(loudest > Some(600), "{loudest:?}");
    std::fs::remove_file(&wave).unwrap();
}

#[test]
fn finds_no_card() {
    if !is_child("finds_no_card") {
        return;
    }
    let mut make = |_| unreachable!("there is nothing to open");
    let error = system().open(None, &mut make).err().unwrap();
    println!("{error}");
    assert!(matches!(error, NoSound::NoDevice(_) | NoSound::Refused { .. }), "{error:?}");
    assert_eq!(error.to_string().lines().count(), 1);
    let nobody = system().open(Some("nobody"), &mut make).err();
    assert_eq!(nobody, Some(NoSound::NotThere { name: "nobody".into() }));
}

#[test]
fn without_a_card_there_is_an_error_of_one_line_and_the_library_says_nothing() {
    let folder = folder("sound_no_card");
    configure(&folder);
    let configuration = folder.join("none.conf");
    std::fs::write(&configuration, format!("<{SYSTEM}>\npcm.!default {{ type hw card 31 }}\n"))
        .unwrap();
    let output = child("finds_no_card", &[("ALSA_CONFIG_PATH", configuration.to_str().unwrap())]);
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
}
