use crate::bytes::{check_line, text};
use hapticbillard::cast::Cast;
use hapticbillard::lockstep::{self, Lockstep};
use hapticbillard::physics::Simulation;
use hapticbillard::replay::{Line, RecordedInput, Recording};
use hapticbillard::rules::Referee;
use hapticbillard::scene::Scene;
use hapticbillard::table::Table;
use hapticbillard::units::Tick;
use std::sync::Arc;

/// A game is replayed up to this tick, in so many steps at most.
const LIMIT: u64 = 2_000;
const STEPS: usize = 300;

/// The scene that is replayed in, whatever scene the recording holds: scenes are a target of their
/// own. Two hands play, so that no time is spent on computers.
const SCENE: &str = "[scene]\nname = \"two\"\n[physics]\n[table]\npreset = \"pool-9ft\"\n\
    [balls]\nrack = \"eight-ball\"\n[cue]\n[rules]\ngame = \"paper-eight-ball\"\n\
    [[player]]\nname = \"A\"\nkind = \"recorded\"\n[[player]]\nname = \"B\"\nkind = \"recorded\"\n\
    [input]\n[actors]\ninput = \"recorded:game.jsonl\"\n";

/// What every replay begins with: to make it takes much longer than a replay.
struct Stage {
    scene: Scene,
    table: Arc<Table>,
    simulation: Simulation,
    referee: Option<Referee>,
}

thread_local! {
    static STAGE: Stage = {
        let scene = Scene::parse("two.toml", SCENE).expect("this scene is right");
        let table = scene.build_table(&mut |_| Err("no files".into())).expect("a shipped table");
        let table = Arc::new(table);
        let Cast { simulation, referee, .. } = Cast::new(&scene, table.clone()).expect("a game");
        Stage { scene, table, simulation, referee }
    };
}

pub fn run(data: &[u8]) {
    let recording = match Recording::parse(&text(data)) {
        Ok(recording) => recording,
        Err(error) => return check_line(&error.to_string()),
    };
    // Written again it says the same.
    let again = Recording::parse(&written(&recording)).expect("what was written is read");
    assert_eq!(recording, again);
    if let Some(cast) = cast(&recording) {
        replay(cast, recording);
    }
}

fn written(recording: &Recording) -> String {
    let frame = |(tick, publish): (&Tick, &_)| {
        (*tick, Line::Frame { tick: *tick, publish: Clone::clone(publish) })
    };
    let mut lines: Vec<(Tick, Line)> = recording.frames.iter().map(frame).collect();
    lines.extend(recording.hashes.iter().map(|(tick, hash)| (*tick, Line::Hash(hash.clone()))));
    lines.sort_by_key(|(tick, _)| *tick);
    let end = recording.end.map(|(tick, reason)| Line::End { tick, reason });
    std::iter::once(Line::Recording(recording.header.clone()))
        .chain(lines.into_iter().map(|(_, line)| line))
        .chain(end)
        .map(|line| line.to_json() + "\n")
        .collect()
}

/// Who takes part, as the recording changes it; none if computers would.
fn cast(recording: &Recording) -> Option<Cast> {
    STAGE.with(|stage| {
        let mut scene = stage.scene.clone();
        recording.header.overrides.apply(&mut scene);
        scene.players.iter().for_each(|player| check_line(&format!("{} wins", player.name)));
        if scene.players.iter().any(|player| player.kind.is_computer()) {
            return None;
        }
        let is_same = scene.rules == stage.scene.rules && scene.about == stage.scene.about;
        if is_same && scene.balls == stage.scene.balls {
            return Some(stage.cast());
        }
        let cast = Cast::new(&scene, stage.table.clone());
        cast.inspect_err(|error| check_line(&error.to_string())).ok()
    })
}

impl Stage {
    fn cast(&self) -> Cast {
        Cast {
            table: self.table.clone(),
            simulation: self.simulation.clone(),
            referee: self.referee.clone(),
            players: Vec::new(),
            human: None,
            adviser: None,
            names: vec!["A".into(), "B".into()],
        }
    }
}

fn replay(cast: Cast, recording: Recording) {
    let recording = Arc::new(recording);
    let setup = lockstep::Setup {
        input: Some(Box::new(RecordedInput(recording.clone()))),
        verify: Some(recording),
        ..lockstep::Setup::headless(Tick(LIMIT))
    };
    let mut game = match Lockstep::new(cast, setup) {
        Ok(game) => game,
        Err(error) => return check_line(&error.to_string()),
    };
    for _ in 0..STEPS {
        match game.step() {
            Ok(None) => {}
            Ok(Some(_)) => return,
            Err(error) => return check_line(&error.to_string()),
        }
    }
}
