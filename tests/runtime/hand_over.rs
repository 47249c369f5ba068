//! From the stylus to the mouse and back in a whole game: the device is lost in an armed stroke.

use super::cli::folder;
use super::hearing::Hears;
use hapticbillard::events::{Event, Fact, FactKind, Health, MenuAction, Source, Topic, Topics};
use hapticbillard::haptic::simulated::{Guide, HandModel, HandScript, SimulatedDevice};
use hapticbillard::haptic::{
    Buttons, Device, DeviceSpec, DeviceState, DeviceStatus, Force, Servo, ServoSettings,
};
use hapticbillard::hash::StateHash;
use hapticbillard::input::feel::STROKE_M_PER_HEIGHT;
use hapticbillard::input::{Action, HandInput, HumanMode, HumanView, STYLUS};
use hapticbillard::physics::Snapshot;
use hapticbillard::replay::Recording;
use hapticbillard::tick::{Delivered, End, FrameSource, Inflow, Outcome, Pace, Participant};
use hapticbillard::units::{TICK_S, Tick};
use hapticbillard_actors::event_manager::Sink;
use hapticbillard_actors::files::load_scene;
use hapticbillard_actors::game::{Driver, Headless, Stage, play_headless};
use hapticbillard_actors::haptic::{AllPorts, Body, Orders, Signs, Stylus, WorldPort};
use hapticbillard_actors::input::WindowHand;
use hapticbillard_actors::runtime::{self, InputPort, Setup};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

const SCENE: &str = r#"
[scene]
name = "Mouse and stylus"
[physics]
solver = "event-driven"
[table]
preset = "pool-9ft"
[[ball]]
id = 0
position_m = [-0.4, 0.0]
[[ball]]
id = 1
position_m = [0.4, 0.1]
[cue]
[rules]
game = "free-play"
[[player]]
name = "One"
kind = "human"
[input]
profile = "default"
[haptic]
device = "simulated"
"#;

/// A device that is lost when its front button was held for so many ticks, and until it is found.
struct Losing {
    device: SimulatedDevice,
    left: u32,
    is_found: Arc<AtomicBool>,
}

impl Device for Losing {
    fn spec(&self) -> DeviceSpec {
        self.device.spec()
    }

    fn read(&mut self, dt: f64) -> DeviceState {
        let state = self.device.read(dt);
        self.left -= u32::from(self.left > 0 && state.buttons.has(Buttons::FRONT));
        let is_lost = self.left == 0 && !self.is_found.load(Ordering::SeqCst);
        let status = if is_lost { DeviceStatus::Lost } else { DeviceStatus::Ready };
        DeviceState { status, ..state }
    }

    fn write(&mut self, force: Force) {
        self.device.write(force);
    }
}

/// A person at a desk, and the servo's body in step with the game.
struct Person {
    hand: WindowHand,
    body: Body,
    table: triple_buffer::Output<Arc<Snapshot>>,
    world: WorldPort,
    signs: Arc<Signs>,
    raw: flume::Sender<HandInput>,
    view: triple_buffer::Output<HumanView>,
    is_found: Arc<AtomicBool>,
    paused: u32,
    stroked: u32,
}

impl Person {
    /// What the person does at mouse and keyboard.
    fn act(&mut self) {
        let mode = self.view.read().mode;
        let stroke = |raw: &flume::Sender<HandInput>, m_s: f64| {
            raw.send(HandInput::Moved { right: 0.0, up: m_s * TICK_S / STROKE_M_PER_HEIGHT })
        };
        let sent = match (mode, self.paused, self.stroked) {
            // Waits a little in the pause, then goes on.
            (HumanMode::Paused, ..) => {
                self.paused += 1;
                let down = self.paused == 5;
                self.raw.send(HandInput::Act { action: Action::Pause, down })
            }
            (HumanMode::Aiming, 1.., 0..50) => {
                self.stroked += 1;
                let down = self.stroked == 50;
                self.raw.send(HandInput::Act { action: Action::Stroke, down })
            }
            (HumanMode::Stroking, _, 50..250) => {
                self.stroked += 1;
                stroke(&self.raw, -1.0)
            }
            (HumanMode::Stroking, ..) => stroke(&self.raw, 1.5),
            // The stroke is made: somebody plugs the device in again.
            (HumanMode::Watching, _, 250..) => {
                self.is_found.store(true, Ordering::SeqCst);
                Ok(())
            }
            _ => Ok(()),
        };
        sent.unwrap();
    }
}

impl FrameSource for Person {
    fn inflow(&mut self, tick: Tick) -> Inflow {
        if self.table.update() {
            self.world.show(self.table.output_buffer());
        }
        self.signs.beat();
        self.body.turn(TICK_S);
        self.act();
        let inflow = self.hand.inflow(tick);
        let mode = self.view.read().mode;
        // The stylus has the cue again: that is all.
        let quit = self.stroked > 0 && mode == HumanMode::HoldingStylus;
        Inflow { quit, ..inflow }
    }
}

impl Participant for Person {
    fn source(&self) -> Source {
        self.hand.source()
    }

    fn topics(&self) -> Topics {
        self.hand.topics()
    }

    fn start(&mut self, table: &Snapshot) -> Outcome {
        self.hand.start(table)
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        self.hand.collect(delivered)
    }

    fn hash(&self, hash: &mut StateHash) {
        self.hand.hash(hash);
    }
}

/// A person whose device is lost in the middle of a stroke, and where the world is shown to it.
fn person(stage: &Stage) -> (Person, triple_buffer::Input<Arc<Snapshot>>) {
    let plan = stage.haptic().unwrap().unwrap();
    let (effects, reach) = (plan.effects, plan.reach);
    let orders = Orders { effects, reach, stiffness_max_n_m: 500.0 };
    let AllPorts { servo, stylus, world, signs, .. } = AllPorts::new(orders, plan.bodies);
    signs.hold(true);
    let guide = Guide::Script(HandScript::stroke(1.2, 0.3));
    let is_found = Arc::new(AtomicBool::new(false));
    let device = SimulatedDevice::new(DeviceSpec::OMNI, HandModel::ARM, guide);
    let device = Losing { device, left: 40, is_found: is_found.clone() };
    let rendered = Servo::new(ServoSettings::of(&DeviceSpec::OMNI)).among(plan.mesh.unwrap());
    let body = Body::new(Box::new(device), rendered, servo);
    let (shown, table) = triple_buffer::triple_buffer(&Arc::<Snapshot>::default());
    let (raw, reports) = flume::unbounded();
    let (seen, view) = triple_buffer::triple_buffer(&HumanView::default());
    let human = stage.cast().unwrap().human.unwrap();
    let hand = WindowHand::new(human, reports, seen).with_stylus(Stylus::new(stylus), None);
    let (paused, stroked) = (0, 0);
    let person = Person { hand, body, table, world, signs, raw, view, is_found, paused, stroked };
    (person, shown)
}

#[test]
fn a_device_lost_in_an_armed_stroke_pauses_the_mouse_strikes_the_device_comes_back_and_all_replays()
{
    let folder = folder("hand_over");
    let (file, recording) = (folder.join("scene.toml"), folder.join("game.jsonl"));
    std::fs::write(&file, SCENE).unwrap();
    let stage = Stage::new(&load_scene(file.to_str().unwrap()).unwrap(), "hand_over").unwrap();
    let (person, shown) = person(&stage);
    let (health, menus) = (Hears::of(Topic::Health), Hears::of(Topic::Menu));
    let (mail, facts) = flume::unbounded::<Delivered>();
    let sink = Sink::new("test", Topics::of(&[Topic::CueBallStruck]), mail);
    let setup = Setup {
        pace: Pace::EveryTick,
        input: InputPort::Hand(Box::new(person)),
        record: Some((recording.clone(), stage.header())),
        observers: vec![Box::new(health.clone()), Box::new(menus.clone())],
        sinks: vec![sink],
        world: Some(shown),
        ..Setup::headless(Tick(60_000))
    };
    let finished = runtime::run(stage.cast().unwrap(), setup).unwrap();
    assert_eq!(finished.end, End::Quit, "the stylus never had the cue again");

    let told = health.heard(|event| match event {
        Event::Health(health) => Some((**health).clone()),
        _ => None,
    });
    let is_lost =
        |health: &Health| matches!(health, Health::ActorFailed { actor, .. } if actor == STYLUS);
    let is_back =
        |health: &Health| matches!(health, Health::ActorRestarted { actor } if actor == STYLUS);
    assert!(told.len() <= 2 && is_lost(&told[0]), "{told:?}");
    assert!(told[1..].iter().all(is_back), "{told:?}");
    let menus = menus.heard(|event| match event {
        Event::Menu(action) => Some(*action),
        _ => None,
    });
    assert_eq!(menus, [MenuAction::Pause, MenuAction::Resume]);
    // One stroke, the mouse's: an arm at 1.2 m/s would make 6.6.
    let told = facts.iter().flat_map(|delivered| delivered.events.to_vec());
    let speeds: Vec<f64> = told
        .filter_map(|stamped| match stamped.event {
            Event::Fact(Fact {
                kind: FactKind::CueBallStruck { normal_speed_m_s, .. }, ..
            }) => Some(normal_speed_m_s),
            _ => None,
        })
        .collect();
    assert!(speeds.len() == 1 && (speeds[0] / 1.5 - 1.0).abs() < 0.1, "{speeds:?}");

    let recorded = Recording::parse(&std::fs::read_to_string(&recording).unwrap()).unwrap();
    let hashes = recorded.hashes.len() as u64;
    let stage = Stage::of_recording(&recorded).unwrap();
    let replay = Some(Arc::new(recorded));
    for driver in [Driver::Lockstep, Driver::Actors] {
        let how = Headless { driver, replay: replay.clone(), verify: true, ..Headless::default() };
        let (replayed, _) = play_headless(&stage, how).unwrap();
        assert_eq!(replayed.verified, hashes, "{driver:?}");
    }
}
