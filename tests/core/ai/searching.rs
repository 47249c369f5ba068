//! Players that search: when they think, what ends it, and that they play what they decided, by
//! the real simulation.

use glam::DVec2;
use hapticbillard::ai::{
    Decision, Deliberation, Idea, IdeaKind, Inline, Mind, PlannedShot, Player, Stroke, Task,
    TaskKind, Thinker, Thinking, Thoughts,
};
use hapticbillard::ball::BallPlace;
use hapticbillard::cast::Cast;
use hapticbillard::cue::Aim;
use hapticbillard::events::{
    BallInHand, Call, CallKind, Command, Event, Fact, FactKind, PlayerState, Source, Stamp,
    Stamped, TouchedBy, Turn, Verdict, Zone,
};
use hapticbillard::hash::{Digest, StateHash};
use hapticbillard::ids::{BallId, PlayerId};
use hapticbillard::lockstep::{self, Setup};
use hapticbillard::physics::Snapshot;
use hapticbillard::rules::Referee;
use hapticbillard::scene::{Overrides, PlayerKind, Scene};
use hapticbillard::shipped;
use hapticbillard::tally::Scorer;
use hapticbillard::tick::{Delivered, Outcome, Participant};
use hapticbillard::units::Tick;
use smallvec::smallvec;
use std::sync::{Arc, Mutex};

const ME: PlayerId = PlayerId::ONE;

/// What happened to a question.
#[derive(Debug, Clone, PartialEq)]
enum News {
    Begun(TaskKind),
    Finished(TaskKind),
    Dropped(TaskKind),
}

type Answer = Arc<dyn Fn(&Mind, &Task) -> Decision + Send + Sync>;

/// Somebody who answers at once, and writes down what is asked.
#[derive(Clone)]
struct Oracle {
    answer: Answer,
    news: Arc<Mutex<Vec<News>>>,
    tasks: Arc<Mutex<Vec<Task>>>,
}

impl Oracle {
    fn new(answer: impl Fn(&Mind, &Task) -> Decision + Send + Sync + 'static) -> Self {
        Oracle { answer: Arc::new(answer), news: Arc::default(), tasks: Arc::default() }
    }

    fn tell(&self, news: News) {
        self.news.lock().unwrap().push(news);
    }

    fn told(&self) -> Vec<News> {
        std::mem::take(&mut *self.news.lock().unwrap())
    }

    fn last_task(&self) -> Task {
        self.tasks.lock().unwrap().last().unwrap().clone()
    }
}

impl Thinker for Oracle {
    fn begin(&self, mind: &Arc<Mind>, task: Task) -> Box<dyn Thinking> {
        self.tell(Begun(task.kind));
        self.tasks.lock().unwrap().push(task.clone());
        Box::new(Asked { oracle: self.clone(), mind: mind.clone(), task, finished: false })
    }
}

struct Asked {
    oracle: Oracle,
    mind: Arc<Mind>,
    task: Task,
    finished: bool,
}

impl Thinking for Asked {
    fn finish(mut self: Box<Self>) -> Deliberation {
        self.finished = true;
        self.oracle.tell(Finished(self.task.kind));
        let decision = (self.oracle.answer)(&self.mind, &self.task);
        Deliberation { decision, thoughts: Thoughts::default(), simulations: 0 }
    }
}

impl Drop for Asked {
    fn drop(&mut self) {
        if !self.finished {
            self.oracle.tell(Dropped(self.task.kind));
        }
    }
}

/// A stroke along +x that asks for nothing.
fn shot(aim: Aim, speed_m_s: f64, call: Option<Call>) -> Decision {
    let idea = Idea {
        kind: IdeaKind::Desperate,
        first: None,
        ball: None,
        pocket: None,
        direction: DVec2::X,
        ghost: DVec2::ZERO,
        first_way: None,
        cut_rad: 0.0,
        to_ball_m: 0.0,
        to_end_m: 0.0,
        cushions: 0,
        height_offset: 0.0,
        speed_least_m_s: 1.0,
        chance: 0.0,
        lines: smallvec![],
    };
    Decision::Shoot(Box::new(PlannedShot { idea, aim, speed_m_s, call, success: 0.0, value: 0.0 }))
}

/// The shipped scene for two computers with other players, and the noise of their strokes.
fn cast(players: [PlayerKind; 2], noise: f64, seed: u64) -> Cast {
    cast_of("wpa_eight_ball", players, noise, seed)
}

fn cast_of(scene: &str, players: [PlayerKind; 2], noise: f64, seed: u64) -> Cast {
    let mut scene = Scene::parse(scene, shipped::scene(scene).unwrap()).unwrap();
    let overrides = Overrides {
        players: players.map(Into::into).to_vec(),
        seed: Some(seed),
        noise: Some(noise),
        ..Overrides::default()
    };
    overrides.apply(&mut scene);
    (scene.input, scene.renderer, scene.haptic) = (None, None, None);
    let table = Arc::new(scene.build_table(&mut |_| Err("no meshes".into())).unwrap());
    Cast::new(&scene, table).unwrap()
}

/// A player at a table that does not move, with an oracle; the mail is written by hand.
struct Desk {
    player: Player,
    oracle: Oracle,
    referee: Referee,
    table: Snapshot,
    now: Tick,
    wake: Option<Tick>,
    said: Vec<Command>,
}

impl Desk {
    fn new(oracle: Oracle) -> Self {
        let Cast { players, referee, simulation, .. } =
            cast([PlayerKind::Club, PlayerKind::Paper], 0.0, 3);
        let player = players.into_iter().next().unwrap().with_thinker(Arc::new(oracle.clone()));
        let (referee, table) = (referee.unwrap(), simulation.snapshot(0.0));
        let (now, wake, said) = (Tick(1), None, Vec::new());
        let mut desk = Desk { player, oracle, referee, table, now, wake, said };
        desk.player.start(&desk.table);
        let first = desk.referee.start(&desk.table);
        let events: Vec<Event> = first.publish.into_iter().map(|told| told.event).collect();
        desk.deliver(&events);
        desk
    }

    /// The cue ball lies, and it is this player's turn.
    fn at_the_table(oracle: Oracle) -> Self {
        let mut desk = Desk::new(oracle);
        while !desk.said.iter().any(|command| matches!(command, Command::PlaceBall { .. })) {
            desk.wait();
        }
        desk.put_down();
        desk.oracle.told();
        desk
    }

    /// The cue ball is put down where the player wanted it last.
    fn put_down(&mut self) {
        let at = self.said.iter().rev().find_map(|command| match command {
            Command::PlaceBall { position_m, .. } => Some(*position_m),
            _ => None,
        });
        let height_m = self.table.balls[1].position.z;
        self.table.balls[0].position = at.unwrap().extend(height_m);
        self.table.balls[0].place = BallPlace::OnTable;
        self.fact(FactKind::BallPlaced { ball: BallId::CUE, zone: Zone::Kitchen, ok: true });
    }

    fn deliver(&mut self, events: &[Event]) {
        let stamp = Stamp { tick: self.now, source: Source::Physics, sequence: 0 };
        let events = events.iter().map(|event| Stamped { stamp, event: event.clone() }).collect();
        self.table.time_s = self.now.end_s();
        let table = Arc::new(self.table.clone());
        let outcome = self.player.collect(&Delivered { tick: self.now, events, table });
        self.wake = outcome.wake;
        self.said.extend(outcome.publish.into_iter().filter_map(|told| match told.event {
            Event::Command(command) => Some(command),
            _ => None,
        }));
        self.now = self.now.after(1);
    }

    fn fact(&mut self, kind: FactKind) {
        self.deliver(&[Event::Fact(Fact { time_s: self.now.end_s(), kind })]);
    }

    /// Lets the time pass until the player wants to be woken.
    fn wait(&mut self) {
        self.now = self.wake.expect("it waits for mail").max(self.now);
        self.deliver(&[]);
    }

    fn digest(&self) -> Digest {
        let mut hash = StateHash::new();
        self.player.hash(&mut hash);
        hash.finish()
    }
}

use News::{Begun, Dropped, Finished};
use TaskKind::{Place, Shoot};

#[test]
fn a_search_begins_with_the_pause_and_is_waited_for_at_its_end() {
    let spots = [DVec2::new(-0.9, 0.1), DVec2::new(-0.8, -0.2)];
    let aim = Aim { azimuth_rad: 0.1, elevation_rad: 0.2, side_offset: 0.1, height_offset: -0.2 };
    let call = Call::Kind(CallKind::Safety);
    let called = call.clone();
    let oracle = Oracle::new(move |_, task| match task.kind {
        Place(_) => Decision::Place(spots.to_vec()),
        _ => shot(aim, 3.25, Some(called.clone())),
    });
    let mut desk = Desk::new(oracle);
    assert_eq!(desk.oracle.told(), [Begun(Place(Zone::Kitchen))]);
    assert!(desk.wake.unwrap().0 >= 400 && desk.said.is_empty());
    // The first spot is refused, the second one is taken without asking again.
    desk.wait();
    assert_eq!(desk.oracle.told(), [Finished(Place(Zone::Kitchen))]);
    desk.fact(FactKind::BallPlaced { ball: BallId::CUE, zone: Zone::Kitchen, ok: false });
    let placed =
        |spot| Command::PlaceBall { ball: BallId::CUE, position_m: spot, zone: Zone::Kitchen };
    assert_eq!(desk.said, spots.map(placed));
    assert!(desk.oracle.told().is_empty());

    // It thinks again from where the ball lies now, of the game as it now stands.
    desk.put_down();
    assert_eq!(desk.oracle.told(), [Begun(Shoot)]);
    let task = desk.oracle.last_task();
    assert_eq!(task.lies[0].position.truncate(), spots[1]);
    assert_eq!(task.played_from, Some(Zone::Kitchen));
    assert_eq!(task.turn.player, ME);
    let state = task.referee.state();
    assert_eq!((state.player, state.on_table.len()), (ME, 15));
    assert_eq!(desk.player.state(), PlayerState::Lazing);
    desk.wait();
    assert_eq!(desk.oracle.told(), [Finished(Shoot)]);
    assert_eq!(desk.player.state(), PlayerState::Aiming);
    let stroke = desk.player.stroke().unwrap();
    assert_eq!((stroke.aim, stroke.speed_m_s), (aim, 3.25));
    assert!(desk.said.contains(&Command::Call(call)));
    assert!(desk.player.plan().is_none() && desk.player.deliberation().is_some());
}

#[test]
fn a_table_that_changes_ends_a_search_and_begins_another() {
    let placed = FactKind::BallPlaced { ball: BallId(3), zone: Zone::Anywhere, ok: true };
    let touched = FactKind::BallTouched { ball: BallId(3), by: TouchedBy::Hand };
    let is_fallback = |_: &Mind, _: &Task| Decision::Nothing;
    for fact in [placed, touched] {
        let mut desk = Desk::at_the_table(Oracle::new(is_fallback));
        let due = desk.wake;
        desk.table.balls[3].position.x += 0.1;
        desk.fact(fact);
        assert_eq!(desk.oracle.told(), [Dropped(Shoot), Begun(Shoot)], "{fact:?}");
        assert_eq!(desk.oracle.last_task().lies, desk.table.balls);
        assert_ne!(desk.wake, due, "it takes its time again");
    }

    let turn = |player| {
        let ball_in_hand = BallInHand::None;
        Event::Turn(Arc::new(Turn { player, ball_in_hand, shot_number: 9, ..Turn::default() }))
    };
    let mut desk = Desk::at_the_table(Oracle::new(is_fallback));
    desk.deliver(&[turn(PlayerId::TWO)]);
    assert_eq!(desk.oracle.told(), [Dropped(Shoot)]);
    assert_eq!((desk.player.state(), desk.wake), (PlayerState::Idle, None));

    let mut desk = Desk::at_the_table(Oracle::new(is_fallback));
    desk.deliver(&[turn(ME)]);
    assert_eq!(desk.oracle.told(), [Dropped(Shoot), Begun(Shoot)]);

    let over = hapticbillard::events::TurnAfter::End;
    let mut desk = Desk::at_the_table(Oracle::new(is_fallback));
    desk.deliver(&[Event::Verdict(Arc::new(Verdict { turn: over, ..Verdict::default() }))]);
    assert_eq!(desk.oracle.told(), [Dropped(Shoot)]);
}

#[test]
fn who_finds_nothing_plays_as_the_papers_player_would() {
    let mut desk = Desk::at_the_table(Oracle::new(|_, _| Decision::Nothing));
    desk.wait();
    assert_eq!(desk.player.state(), PlayerState::Aiming);
    assert!(desk.player.plan().is_some() && desk.player.stroke().is_some());
}

#[test]
fn a_clone_in_the_middle_of_a_thought_thinks_again_and_plays_the_same() {
    let oracle = Oracle::new(|mind, task| {
        let Deliberation { decision, simulations, .. } = mind.deliberate(task, &Inline);
        assert_eq!(matches!(decision, Decision::Shoot(_)), task.kind == Shoot);
        assert!(simulations > 0);
        decision
    });
    let mut desk = Desk::at_the_table(oracle);
    let mut other = Desk {
        player: desk.player.clone(),
        oracle: desk.oracle.clone(),
        referee: desk.referee.clone(),
        table: desk.table.clone(),
        said: desk.said.clone(),
        ..desk
    };
    assert_eq!(desk.digest(), other.digest());
    desk.wait();
    assert_eq!(desk.oracle.told(), [Finished(Shoot)]);
    other.wait();
    assert_eq!(other.oracle.told(), [Begun(Shoot), Finished(Shoot)]);
    assert_eq!((desk.digest(), &desk.said), (other.digest(), &other.said));
    assert!(desk.player.stroke().is_some());
}

/// A stroke that met a ball, and the speed at which tip and ball came together [m/s].
struct Struck {
    stroke: Stroke,
    ball: BallId,
    normal_m_s: f64,
}

/// A player under observation: how it meant to strike, and how the tip met the ball.
struct Watched {
    player: Player,
    strokes: Arc<Mutex<Vec<Struck>>>,
}

impl Participant for Watched {
    fn source(&self) -> Source {
        self.player.source()
    }

    fn topics(&self) -> hapticbillard::events::Topics {
        self.player.topics()
    }

    fn start(&mut self, table: &Snapshot) -> Outcome {
        self.player.start(table)
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        let shoots = self.player.state() == PlayerState::Shooting;
        let struck = delivered.events.iter().find_map(|stamped| match stamped.event {
            Event::Fact(Fact {
                kind: FactKind::CueBallStruck { ball, normal_speed_m_s, .. },
                ..
            }) => Some((ball, normal_speed_m_s)),
            _ => None,
        });
        if let (true, Some((ball, normal_m_s)), Some(stroke)) =
            (shoots, struck, self.player.stroke())
        {
            self.strokes.lock().unwrap().push(Struck { stroke: *stroke, ball, normal_m_s });
        }
        self.player.collect(delivered)
    }

    fn hash(&self, hash: &mut StateHash) {
        self.player.hash(hash);
    }
}

/// Plays a game; the strokes and the score.
fn play(mut cast: Cast, change: impl Fn(Player) -> Player, limit: Tick) -> (Vec<Struck>, Scorer) {
    let strokes: Arc<Mutex<Vec<Struck>>> = Arc::default();
    let watched = |player| Watched { player: change(player), strokes: strokes.clone() };
    let scorer = Scorer::default();
    let mut observers: Vec<Box<dyn Participant>> = Vec::new();
    observers.extend(cast.players.drain(..).map(|player| Box::new(watched(player)) as Box<_>));
    observers.push(Box::new(scorer.clone()));
    lockstep::run(cast, Setup { observers, ..Setup::headless(limit) }).unwrap();
    let strokes = std::mem::take(&mut *strokes.lock().unwrap());
    (strokes, scorer)
}

#[test]
fn the_tip_meets_the_ball_as_planned_up_to_the_hardest_stroke() {
    // Strokes of every sort, each with what was planned.
    let planned: Arc<Mutex<Vec<(Aim, f64)>>> = Arc::default();
    let plans = planned.clone();
    let oracle = Oracle::new(move |_, task| match task.kind {
        Shoot => {
            let part = |n: u32| f64::from((task.seed >> (8 * n)) as u8) / 255.0;
            let aim = Aim {
                azimuth_rad: 6.0 * part(0),
                elevation_rad: 0.2 + 0.5 * part(1),
                side_offset: 0.6 * part(2) - 0.3,
                height_offset: 0.6 * part(3) - 0.3,
            };
            let speed_m_s = 0.3 + 10.5 * part(4);
            plans.lock().unwrap().push((aim, speed_m_s.min(hapticbillard::ai::TIP_SPEED_MAX_M_S)));
            shot(aim, speed_m_s, None)
        }
        _ => Decision::Nothing,
    });
    let players = [PlayerKind::Club, PlayerKind::Club];
    let thinker = Arc::new(oracle);
    let with = |player: Player| player.with_thinker(thinker.clone());
    let (strokes, _) = play(cast(players, 0.0, 5), with, Tick(600_000));
    let planned = planned.lock().unwrap();
    let mut met = 0;
    for (Struck { stroke, ball, normal_m_s }, (aim, speed_m_s)) in strokes.iter().zip(&*planned) {
        assert_eq!((stroke.aim, stroke.speed_m_s), (*aim, *speed_m_s));
        // A cue that is pulled back over another ball may touch that.
        if *ball != BallId::CUE {
            continue;
        }
        met += 1;
        let along = -aim.contact_normal().dot(aim.direction());
        let error = normal_m_s / (speed_m_s * along) - 1.0;
        assert!(error.abs() < 1e-3, "{aim:?} at {speed_m_s} m/s: {error}");
    }
    assert!(met > 20, "{met} of {} strokes", strokes.len());
}

#[test]
fn no_level_moves_a_cue_faster_than_a_person_can() {
    use hapticbillard::input::feel;
    for speed_m_s in [0.3, 2.0, 4.0, 5.5, hapticbillard::ai::TIP_SPEED_MAX_M_S] {
        let aim = Aim { elevation_rad: 0.1, ..Aim::default() };
        let stroke = Stroke::at_ball(aim, DVec2::ZERO.extend(0.03), 0.03, speed_m_s);
        for piece in &stroke.path(0.0).pieces {
            let fastest = piece.velocity.length().max(piece.at(piece.end_s()).1.length());
            assert!(fastest <= speed_m_s.max(0.6) + 1e-9, "{fastest}");
            assert!(fastest < feel::STROKE_SPEED_MAX_M_S);
            let hardest = piece.acceleration.length();
            assert!(hardest < feel::STROKE_ACCELERATION_MAX_M_S2, "{speed_m_s}: {hardest}");
            let back = (stroke.contact - piece.position).dot(aim.direction());
            assert!(back <= feel::PULL_MAX_M + 1e-9, "{speed_m_s}: {back}");
        }
    }
}

#[test]
fn what_a_searching_player_believes_of_the_game_is_what_the_referee_says() {
    // Players that do all sorts of things wrong see fouls, balls in hand, choices and racks.
    for game in ["wpa_eight_ball", "nine_ball", "straight", "snooker", "three_cushion"] {
        let oracle = Oracle::new(|_, _| Decision::Nothing);
        let thinker = Arc::new(oracle.clone());
        let with = |player: Player| player.with_thinker(thinker.clone());
        let players = [PlayerKind::Club, PlayerKind::Champion];
        let (strokes, _) = play(cast_of(game, players, 8.0, 2), with, Tick(400_000));
        assert!(strokes.len() > 10, "{game}: {}", strokes.len());
        let tasks = oracle.tasks.lock().unwrap();
        assert!(tasks.len() >= strokes.len());
        for task in tasks.iter() {
            let (state, turn) = (task.referee.state(), &task.turn);
            assert_eq!(state.player, turn.player, "{game}");
            assert_eq!(state.on_table, turn.on_table, "{game}");
            assert_eq!((state.groups, state.cue_ball), (turn.groups, turn.cue_ball), "{game}");
            assert_eq!((state.on, &state.options), (turn.on, &turn.options), "{game}");
        }
    }
}

#[test]
fn every_level_plays_carom_but_the_papers() {
    let players = [PlayerKind::Club, PlayerKind::Computer(0)];
    let (strokes, scorer) = play(cast_of("free_carom", players, 1.0, 2), |p| p, Tick(200_000));
    assert!(strokes.len() > 5, "{}", strokes.len());
    let [one, two] = scorer.tally().shots;
    assert!(one > 0 && two > 0, "each with a ball of its own");

    let mut scene = Scene::parse("c", shipped::scene("free_carom").unwrap()).unwrap();
    let players = vec![PlayerKind::Paper.into(), PlayerKind::Club.into()];
    Overrides { players, ..Overrides::default() }.apply(&mut scene);
    let table = Arc::new(scene.build_table(&mut |_| Err("no meshes".into())).unwrap());
    let error = Cast::new(&scene, table).err().unwrap().to_string();
    assert!(error.contains("who aims at pockets, and this table has none"), "{error}");
}
