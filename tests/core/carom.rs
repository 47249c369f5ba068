//! Carom as it is played: the table without pockets, the three balls, whole turns in lockstep.

use crate::input::desk::{Desk, shipped};
use glam::{DVec2, DVec3};
use hapticbillard::ai::Stroke;
use hapticbillard::ball::CAROM_RADIUS_M;
use hapticbillard::cast::Cast;
use hapticbillard::cue::Aim;
use hapticbillard::events::{
    Choice, Command, Event, Fact, FactKind, FactSet, Foul, Spotting, Topic, Topics, Turn,
    TurnAfter, Verdict,
};
use hapticbillard::hash::StateHash;
use hapticbillard::ids::{BallId, GameKind, PlayerId, Rail};
use hapticbillard::input::HumanMode;
use hapticbillard::lockstep::{Lockstep, Setup};
use hapticbillard::physics::{Simulation, Snapshot};
use hapticbillard::rack::Rack;
use hapticbillard::rules::{Shot, State, judge, watch};
use hapticbillard::scene::Scene;
use hapticbillard::table::Table;
use hapticbillard::tick::{Delivered, FrameSource, Inflow, Outcome, Participant};
use hapticbillard::units::Tick;
use std::sync::{Arc, Mutex};

const WHITE: BallId = BallId(0);
const YELLOW: BallId = BallId(1);
const RED: BallId = BallId(2);

fn table_of(scene: &Scene) -> Arc<Table> {
    Arc::new(scene.build_table(&mut |_| Err("no mesh".into())).unwrap())
}

/// The scene's simulation with its balls at these places [m].
fn simulation(scene: &Scene, table: &Table, places: &Snapshot) -> Simulation {
    let mut balls = scene.build_balls(table).unwrap();
    for (ball, state) in &mut balls {
        *state = *places.ball(ball.id).unwrap();
    }
    Simulation::with_parameters(table, balls, &scene.physics, scene.parameters()).unwrap()
}

/// What a stroke does, from rest to rest.
fn facts_of(mut simulation: Simulation, stroke: &Stroke) -> Vec<Fact> {
    let path = stroke.path(0.0);
    let end_s = path.end_s().unwrap();
    simulation.apply(0.0, &Command::MoveCue(path.into())).unwrap();
    simulation.apply(end_s, &Command::LiftCue).unwrap();
    let mut facts = Vec::new();
    let settled = FactSet::of(&[Topic::Settled]);
    while !facts.iter().any(|fact: &Fact| fact.kind.topic() == Topic::Settled) {
        let limit = simulation.now_s() + 5.0;
        simulation.advance(limit, settled, &mut facts).unwrap();
        assert!(limit < 120.0, "never at rest: {facts:?}");
    }
    facts
}

fn verdict_of(game: GameKind, turn: &Turn, facts: &[Fact]) -> Verdict {
    let state =
        State { player: turn.player, shot: turn.shot, cue_ball: turn.cue_ball, ..State::default() };
    let mut shot = Shot::of(turn.cue_ball);
    facts.iter().for_each(|fact| watch(&mut shot, fact));
    judge(game, &state, None, &shot)
}

/// A level stroke at a ball, the cue raised as far as rail and balls ask for.
fn stroke(table: &Table, world: &Snapshot, ball: BallId, azimuth_rad: f64, speed: f64) -> Stroke {
    let centre = world.ball(ball).unwrap().position;
    let level = Aim { azimuth_rad, ..Aim::default() };
    let elevation_rad = table.clearance_elevation(centre.truncate(), &level).max(0.06);
    let aim = Aim { elevation_rad, ..level };
    Stroke::at_ball(aim, centre, CAROM_RADIUS_M, speed)
}

/// A scripted player for both seats: for each turn it finds a stroke of the kind that `plan` wants
/// and plays it.
struct Script {
    scene: Scene,
    table: Arc<Table>,
    game: GameKind,
    /// Whether the next shots shall score.
    plan: Vec<bool>,
    frames: Vec<(Tick, Command)>,
    turns: Vec<Arc<Turn>>,
    verdicts: Vec<Arc<Verdict>>,
    struck: Vec<BallId>,
}

impl Script {
    fn hear_turn(&mut self, turn: &Arc<Turn>, now: Tick, world: &Snapshot) {
        self.turns.push(turn.clone());
        let shots = self.turns.len() - 1;
        let Some(wanted) = self.plan.get(shots).copied() else { return };
        let tries = (0..720).flat_map(|k| [2.5, 4.0].map(|speed| (k, speed)));
        let found = tries.map(|(k, speed)| {
            // All round, a few degrees from one to the next.
            let azimuth = f64::from(k * 97 % 720) * std::f64::consts::TAU / 720.0;
            stroke(&self.table, world, turn.cue_ball, azimuth, speed)
        });
        let start = simulation(&self.scene, &self.table, world);
        let scores = |stroke: &Stroke| {
            let verdict = verdict_of(self.game, turn, &facts_of(start.clone(), stroke));
            let has_scored = verdict.turn != TurnAfter::Pass;
            verdict.legal && has_scored == wanted && verdict.options.is_empty()
        };
        let stroke = found.into_iter().find(scores).expect("some stroke does it");
        let start = now.after(5);
        let path = stroke.path(start.start_s());
        let end = Tick((path.end_s().unwrap() * 1000.0) as u64 + 2);
        self.frames.push((start, Command::MoveCue(path.into())));
        self.frames.push((end, Command::LiftCue));
    }
}

struct Seat(Arc<Mutex<Script>>);

impl FrameSource for Seat {
    fn inflow(&mut self, tick: Tick) -> Inflow {
        let mut script = self.0.lock().unwrap();
        let due = |frame: &&(Tick, Command)| frame.0 == tick;
        let frame = script.frames.iter().filter(due);
        let frame = frame.map(|(_, command)| Event::Command(command.clone()).into()).collect();
        script.frames.retain(|(at, _)| *at > tick);
        Inflow { frame, next: Some(tick.after(1)), ..Inflow::default() }
    }
}

impl Participant for Seat {
    fn source(&self) -> hapticbillard::events::Source {
        hapticbillard::events::Source::Input
    }

    fn topics(&self) -> Topics {
        Topics::of(&[Topic::Turn, Topic::Verdict, Topic::CueBallStruck])
    }

    fn start(&mut self, _: &Snapshot) -> Outcome {
        Outcome::default()
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        let mut script = self.0.lock().unwrap();
        for stamped in delivered.events.iter() {
            match &stamped.event {
                Event::Turn(turn) => script.hear_turn(turn, delivered.tick, &delivered.table),
                Event::Verdict(verdict) => script.verdicts.push(verdict.clone()),
                Event::Fact(Fact { kind: FactKind::CueBallStruck { ball, .. }, .. }) => {
                    script.struck.push(*ball);
                }
                _ => {}
            }
        }
        Outcome::default()
    }

    fn hash(&self, _: &mut StateHash) {}
}

/// Plays shots that score or miss as `plan` says; returns turns, verdicts and what was struck.
fn play(name: &str, plan: &[bool]) -> Script {
    let scene = shipped(name);
    let table = table_of(&scene);
    let game = scene.rules.as_ref().unwrap().game;
    let script = Arc::new(Mutex::new(Script {
        scene: scene.clone(),
        table: table.clone(),
        game,
        plan: plan.to_vec(),
        frames: Vec::new(),
        turns: Vec::new(),
        verdicts: Vec::new(),
        struck: Vec::new(),
    }));
    let mut setup = Setup::headless(Tick(1_000_000));
    setup.input = Some(Box::new(Seat(script.clone())));
    setup.observers.push(Box::new(Seat(script.clone())));
    let mut game = Lockstep::new(Cast::new(&scene, table).unwrap(), setup).unwrap();
    while script.lock().unwrap().turns.len() <= plan.len() {
        assert!(game.step().unwrap().is_none(), "the game ended");
    }
    drop(game);
    Arc::into_inner(script).unwrap().into_inner().unwrap()
}

#[test]
fn three_cushion_is_played_over_points_misses_and_both_cue_balls() {
    let script = play("three_cushion", &[true, false, true, false, true]);
    let points: Vec<i32> = script.verdicts.iter().map(|v| v.points.of(v.player.unwrap())).collect();
    assert_eq!(points, [1, 0, 1, 0, 1]);
    assert!(script.verdicts.iter().all(|verdict| verdict.legal));
    assert_eq!(script.struck, [WHITE, WHITE, YELLOW, YELLOW, WHITE]);
    let last = script.turns.last().unwrap();
    let score = last.score.unwrap();
    assert_eq!((score.one, score.two), (2, 1));
    assert_eq!((last.player, last.cue_ball), (PlayerId::ONE, WHITE));
    assert_eq!(last.on_table.as_slice(), [YELLOW, RED]);
    assert_eq!(script.turns[0].legal_first.as_slice(), [RED], "the break");
    assert_eq!(script.turns[2].legal_first.as_slice(), [WHITE, RED]);
}

#[test]
fn free_carom_is_played_too() {
    let script = play("free_carom", &[true, false, true]);
    assert_eq!(script.struck, [WHITE, WHITE, YELLOW]);
    let score = script.turns.last().unwrap().score.unwrap();
    assert_eq!((score.one, score.two), (1, 1));
}

#[test]
fn both_people_at_one_mouse_aim_with_their_own_ball() {
    let mut desk = Desk::new(&shipped("three_cushion"));
    desk.wait(3);
    assert_eq!(desk.mode(), HumanMode::Aiming);
    assert_eq!(desk.view().cue_ball, WHITE);
    let to_red = DVec2::new(1.42, 0.1825);
    let azimuth = libm::atan2(to_red.y, to_red.x);
    assert!((desk.view().aim.azimuth_rad - azimuth).abs() < 1e-9, "{:?}", desk.view().aim);
    desk.turn_to(azimuth + 0.002);
    desk.stroke(0.2, 1.0, 125);
    desk.wait_until(30_000, |desk| !desk.verdicts().is_empty());
    desk.wait(3);
    assert_eq!(desk.verdicts()[0].turn, TurnAfter::Pass);
    assert_eq!((desk.mode(), desk.view().cue_ball), (HumanMode::Aiming, YELLOW));
    let cue = desk.table().cue.unwrap();
    assert!(cue.tip.distance(desk.table().ball(YELLOW).unwrap().position) < 0.15);
    desk.stroke(0.2, 1.0, 125);
    let struck = |fact: &Fact| match fact.kind {
        FactKind::CueBallStruck { ball, .. } => Some(ball),
        _ => None,
    };
    desk.wait(100);
    let struck: Vec<BallId> = desk.facts().iter().filter_map(struck).collect();
    assert_eq!(struck, [WHITE, YELLOW]);
}

/// Balls at these places [m] on the carom table.
fn world(places: [(f64, f64); 3]) -> (Scene, Arc<Table>, Snapshot) {
    let scene = shipped("three_cushion");
    let table = table_of(&scene);
    let balls = Rack::carom(WHITE).place(&table).unwrap();
    let balls = balls.into_iter().zip(places).map(|((_, mut state), (x, y))| {
        state.position = DVec3::new(x, y, CAROM_RADIUS_M);
        state
    });
    let snapshot = Snapshot { balls: balls.collect(), ..Snapshot::default() };
    (scene, table, snapshot)
}

#[test]
fn balls_that_touch_at_rest_are_told_and_may_be_spotted() {
    // The white rolls softly to the yellow's place while the yellow lies at the red.
    let gap = 2.0 * CAROM_RADIUS_M + 2e-5;
    let (scene, table, places) = world([(-0.5, 0.3), (0.2, 0.0), (0.2 + gap, 0.0)]);
    let miss = stroke(&table, &places, WHITE, 3.0, 1.0);
    let facts = facts_of(simulation(&scene, &table, &places), &miss);
    let frozen = |fact: &&Fact| matches!(fact.kind, FactKind::BallsFrozen { .. });
    let told: Vec<_> = facts.iter().filter(frozen).map(|fact| fact.kind).collect();
    assert_eq!(told, [FactKind::BallsFrozen { a: YELLOW, b: RED }]);
    let turn = Turn { player: PlayerId::ONE, cue_ball: WHITE, ..Turn::default() };
    let verdict = verdict_of(GameKind::ThreeCushion, &turn, &facts);
    assert_eq!(verdict.options.as_slice(), [Choice::Accept, Choice::SpotFrozen]);
    assert_eq!(verdict.chooser, Some(PlayerId::TWO));
    assert_eq!(verdict.spot.as_slice(), [YELLOW, RED]);

    let mut spotted = simulation(&scene, &table, &places);
    let spotting = Spotting { balls: verdict.spot.clone(), cue_ball: YELLOW };
    spotted.apply(0.0, &Command::SpotBalls(spotting)).unwrap();
    spotted.advance(0.001, FactSet::NONE, &mut Vec::new()).unwrap();
    let lies = |ball| spotted.sample(ball, 0.001).unwrap().position.truncate();
    assert_eq!(lies(YELLOW), DVec2::new(-0.71, 0.0));
    assert_eq!(lies(RED), DVec2::new(0.71, 0.0));
}

#[test]
fn who_plays_at_a_touching_ball_fouls_and_who_plays_away_does_not() {
    let (scene, table, places) = world([(0.0, 0.0), (2.0 * CAROM_RADIUS_M, 0.0), (1.0, 0.5)]);
    let fouls = |azimuth| {
        let stroke = stroke(&table, &places, WHITE, azimuth, 2.0);
        let facts = facts_of(simulation(&scene, &table, &places), &stroke);
        let state = State { frozen_to_cue: [YELLOW].into_iter().collect(), ..State::default() };
        let mut shot = Shot::of(WHITE);
        facts.iter().for_each(|fact| watch(&mut shot, fact));
        judge(GameKind::ThreeCushion, &state, None, &shot).fouls
    };
    assert_eq!(fouls(0.3).as_slice(), [Foul::Push]);
    assert!(fouls(2.0).is_empty());
}

#[test]
fn a_ball_off_the_table_returns_to_its_spot_for_whoever_comes() {
    let (scene, table, places) = world([(0.3, 0.3), (-0.3, 0.3), (0.72, 0.0)]);
    let place = |cue_ball, ball| {
        let mut simulation = simulation(&scene, &table, &places);
        let spotting = Spotting { balls: [ball].into_iter().collect(), cue_ball };
        simulation.apply(0.0, &Command::SpotBalls(spotting)).unwrap();
        simulation.advance(0.001, FactSet::NONE, &mut Vec::new()).unwrap();
        simulation.sample(ball, 0.001).unwrap().position.truncate()
    };
    assert_eq!(place(WHITE, WHITE), DVec2::new(-0.71, 0.0));
    assert_eq!(place(YELLOW, WHITE), DVec2::ZERO);
    assert_eq!(place(WHITE, YELLOW), DVec2::ZERO);
    assert_eq!(place(WHITE, RED), DVec2::new(0.71, 0.0), "nothing is in the way but itself");
}

#[test]
fn the_table_has_four_plain_corners() {
    let table = Table::preset("carom-10ft").unwrap();
    assert!(table.pockets.is_empty());
    assert_eq!(table.mesh.open_edges(), []);
    // The noses are 37 mm high, 2.84 m and 1.42 m apart, and run into the corner.
    let at_nose = |p: &&DVec3| (p.z - 0.037).abs() < 2e-5;
    let noses: Vec<DVec3> = table.mesh.vertices.iter().filter(at_nose).copied().collect();
    let inner = noses.iter().filter(|p| p.x.abs() <= 1.42 + 1e-9 && p.y.abs() <= 0.71 + 1e-9);
    let corners =
        inner.filter(|p| (p.x.abs() - 1.42).abs() < 1e-9 && (p.y.abs() - 0.71).abs() < 1e-9);
    assert_eq!(corners.count(), 4);
    assert!(table.display().iter().all(|part| !["castings", "pockets"].contains(&part.name)));
}

#[test]
fn a_ball_driven_into_a_corner_comes_back_and_stays_on_the_bed() {
    let (scene, table, places) = world([(0.0, 0.0), (-1.0, 0.5), (-1.0, -0.5)]);
    for azimuth in [0.40, 0.4636, 0.47, 0.55] {
        let hard = stroke(&table, &places, WHITE, azimuth, 5.0);
        let facts = facts_of(simulation(&scene, &table, &places), &hard);
        let rails: Vec<Rail> = facts
            .iter()
            .filter_map(|fact| match fact.kind {
                FactKind::CushionHit { ball: WHITE, rail, .. } => Some(rail),
                _ => None,
            })
            .collect();
        assert!(rails.contains(&Rail::Foot) && rails.contains(&Rail::Left), "{azimuth}: {rails:?}");
        let gone = |fact: &Fact| {
            matches!(fact.kind, FactKind::BallPocketed { .. } | FactKind::BallOffTable { .. })
        };
        assert!(!facts.iter().any(gone), "{azimuth}");
    }
}

#[test]
fn the_papers_player_says_that_it_cannot_play_without_pockets() {
    let text = hapticbillard::shipped::scene("three_cushion").unwrap();
    let text = text.replacen("kind = \"human\"", "kind = \"paper\"", 1);
    let error = Scene::parse("carom.toml", &text).unwrap_err().to_string();
    assert!(error.contains("aims at pockets, and this table has none"), "{error}");
    assert!(error.contains("write kind = \"club\""), "{error}");
}

#[test]
fn who_breaks_has_the_ball_beside_the_head_spot() {
    let table = Table::preset("carom-10ft").unwrap();
    let places = |cue_ball| {
        let balls = Rack::carom(cue_ball).place(&table).unwrap();
        balls.into_iter().map(|(_, state)| state.position.truncate()).collect::<Vec<_>>()
    };
    let (head, beside) = (DVec2::new(-0.71, 0.0), DVec2::new(-0.71, -0.1825));
    assert_eq!(places(WHITE), [beside, head, DVec2::new(0.71, 0.0)]);
    assert_eq!(places(YELLOW), [head, beside, DVec2::new(0.71, 0.0)]);
    let text = hapticbillard::shipped::scene("free_carom").unwrap();
    let second = text.replace("game = \"free-carom\"", "game = \"free-carom\"\nfirst_player = 2");
    let scene = Scene::parse("carom.toml", &second).unwrap();
    let balls = scene.build_balls(&table).unwrap();
    assert_eq!(balls[1].1.position.truncate(), beside);
}
