//! One game from a scene, by either driver: what `play`, `match` and `replay` have in common.

use crate::conductor::RunError;
use crate::error::Error;
use crate::files::{LineWriter, LoadedScene};
use crate::haptic;
use crate::pacer::StopFlag;
use crate::runtime::{self, InputPort};
use crate::sound;
use crate::stopwatch::{Stopwatch, Timed};
use hapticbillard::cast::Cast;
use hapticbillard::ids::GameKind;
use hapticbillard::lockstep;
use hapticbillard::physics::{Simulation, Snapshot};
use hapticbillard::replay::{self, Header, Line, RecordedInput, Recording};
use hapticbillard::scene::{Overrides, Scene};
use hapticbillard::sound::Foley;
use hapticbillard::table::Table;
use hapticbillard::tally::{Scorer, Tally};
use hapticbillard::tick::{Finished, FrameSource, Participant};
use hapticbillard::units::Tick;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

/// Which runtime plays a game; both give the same output.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Driver {
    /// All cores in one thread, in virtual time: the reference.
    Lockstep,
    /// One actor per core.
    #[default]
    Actors,
}

/// The longest game without a window [ticks]: a day of simulated time.
pub const LIMIT: Tick = Tick(86_400_000);

/// A scene that is ready to be played, as often as wanted.
pub struct Stage {
    /// The scene, with what was changed about it.
    pub scene: Scene,
    /// Its table; all games share it.
    pub table: Arc<Table>,
    header: Header,
    /// What other files are seen from.
    folder: Option<PathBuf>,
}

impl Stage {
    /// Builds the table of a scene.
    ///
    /// # Errors
    /// What is wrong with the scene or its meshes.
    pub fn new(loaded: &LoadedScene, name: &str) -> Result<Self, Error> {
        let mut files = BTreeMap::new();
        let table = loaded.scene.build_table(&mut |file| {
            let text = loaded.read_mesh(file)?;
            files.insert(file.to_string(), text.clone());
            Ok(text)
        })?;
        let header = Header {
            version: replay::VERSION,
            program: format!("hapticbillard {}", env!("CARGO_PKG_VERSION")),
            scene_name: name.to_string(),
            scene: loaded.text.clone(),
            files,
            overrides: Overrides::default(),
        };
        let (scene, folder) = (loaded.scene.clone(), loaded.folder.clone());
        Ok(Stage { scene, table: Arc::new(table), header, folder })
    }

    /// The scene of a recording.
    ///
    /// # Errors
    /// What is wrong with the recorded scene.
    pub fn of_recording(recording: &Recording) -> Result<Self, Error> {
        let header = recording.header.clone();
        let mut scene = Scene::parse(&header.scene_name, &header.scene)?;
        let table = scene.build_table(&mut |file| {
            let text = header.files.get(file).cloned();
            text.ok_or_else(|| "the recording does not hold this file".to_string())
        })?;
        header.overrides.apply(&mut scene);
        Ok(Stage { scene, table: Arc::new(table), header, folder: None })
    }

    /// The same for another game, if one is given.
    ///
    /// # Errors
    /// The scene has not what that game needs.
    pub fn for_game(self, game: Option<GameKind>) -> Result<Self, Error> {
        let Some(game) = game else { return Ok(self) };
        let stage = self.with(Overrides { game: Some(game), ..Overrides::default() });
        let what = format!("--game {game}");
        if stage.scene.equipment() != self.scene.equipment() {
            let problem = "is played with other balls, on another table than this scene's";
            return Err(Error::input(what, problem, "choose a scene of that game with --scene"));
        }
        match (stage.scene.rules, stage.scene.misfit(game)) {
            (None, _) => Err(Error::input(what, "the scene has no rules", "choose another scene")),
            (_, Some((problem, fix))) => Err(Error::input(what, problem, fix)),
            (Some(_), None) => Ok(stage),
        }
    }

    /// The same with changes.
    pub fn with(&self, overrides: Overrides) -> Self {
        let mut scene = self.scene.clone();
        overrides.apply(&mut scene);
        let header = Header { overrides, ..self.header.clone() };
        Stage { scene, table: self.table.clone(), header, folder: self.folder.clone() }
    }

    /// The header of a recording of this game.
    pub fn header(&self) -> Header {
        self.header.clone()
    }

    /// The simulation alone, without anybody who plays.
    ///
    /// # Errors
    /// What does not fit together.
    pub fn simulation(&self) -> Result<Simulation, Error> {
        let balls = self.scene.build_balls(&self.table)?;
        let (physics, parameters) = (&self.scene.physics, self.scene.parameters());
        Ok(Simulation::with_parameters(&self.table, balls, physics, parameters)?)
    }

    /// What the scene asks to be felt, if anything.
    ///
    /// # Errors
    /// A device that is not built in, or balls that do not fit the table.
    pub fn haptic(&self) -> Result<Option<haptic::Plan>, Error> {
        let balls = self.scene.build_balls(&self.table)?;
        Ok(haptic::plan(&self.scene, self.folder.as_deref(), &self.table, &balls)?)
    }

    /// What the scene asks to be heard, if anything, in a game that runs at `pace` seconds a
    /// second. `first` is the world before the first tick.
    ///
    /// # Errors
    /// Balls that do not fit the table, recordings outside of the scene's folder.
    pub fn sound(&self, first: Arc<Snapshot>, pace: f64) -> Result<Option<sound::Plan>, Error> {
        let foley = self.foley(first.clone())?;
        Ok(sound::plan(&self.scene, self.folder.as_deref(), foley, first, pace)?)
    }

    /// What makes sounds of this game's facts. `first` is the world before the first one.
    ///
    /// # Errors
    /// Balls that do not fit the table.
    pub fn foley(&self, first: Arc<Snapshot>) -> Result<Foley, Error> {
        let balls = self.scene.build_balls(&self.table)?;
        let radii = balls.iter().map(|(ball, _)| (ball.id, ball.radius_m));
        let gravity_m_s2 = self.scene.physics.gravity_m_s2;
        Ok(Foley::new(radii, gravity_m_s2, self.scene.about.seed, first))
    }

    /// The cores of this game.
    ///
    /// # Errors
    /// What does not fit together.
    pub fn cast(&self) -> Result<Cast, Error> {
        Ok(Cast::new(&self.scene, self.table.clone())?)
    }
}

/// How a game without a window is run.
#[derive(Default)]
pub struct Headless {
    /// The runtime.
    pub driver: Driver,
    /// Where the recording goes.
    pub record: Option<PathBuf>,
    /// A recording that stands in for whoever acted.
    pub replay: Option<Arc<Recording>>,
    /// Whether the run is checked against it.
    pub verify: bool,
    /// Measures how long computer players think.
    pub stopwatch: Option<Stopwatch>,
    /// Who else watches.
    pub observers: Vec<Box<dyn Participant>>,
    /// Ends a game of actors between two ticks.
    pub stop: StopFlag,
}

/// Plays a game as fast as possible.
///
/// # Errors
/// [`Error`] if it cannot begin, go on, or be recorded.
pub fn play_headless(stage: &Stage, how: Headless) -> Result<(Finished, Tally), Error> {
    let mut cast = stage.cast()?;
    let scorer = Scorer::default();
    let mut observers: Vec<Box<dyn Participant>> = Vec::new();
    if let Some(stopwatch) = how.stopwatch {
        // Observers are registered right behind the players, so the order stays the same.
        let timed = |player| Box::new(Timed::new(player, stopwatch.clone())) as Box<_>;
        observers.extend(cast.players.drain(..).map(timed));
    }
    observers.push(Box::new(scorer.clone()));
    observers.extend(how.observers);
    let source = how.replay.clone().map(|recording| {
        let source: Box<dyn FrameSource> = Box::new(RecordedInput(recording));
        source
    });
    let verify = how.replay.filter(|_| how.verify);
    let finished = match how.driver {
        Driver::Actors => {
            let input = source.map_or(InputPort::None, InputPort::StandIn);
            let record = how.record.map(|path| (path, stage.header()));
            let physics_thread = stage.scene.physics.thread;
            let base = runtime::Setup::headless(LIMIT);
            let setup = runtime::Setup {
                input,
                record,
                verify,
                observers,
                physics_thread,
                stop: how.stop,
                ..base
            };
            runtime::run(cast, setup)?
        }
        Driver::Lockstep => {
            let mut file = how.record.map(LineWriter::create).transpose()?;
            let mut failed = None;
            let mut write = |line: &Line| {
                if let Some(file) = &mut file
                    && failed.is_none()
                {
                    failed = file.line(&line.to_json()).err();
                }
            };
            write(&Line::Recording(stage.header()));
            let base = lockstep::Setup::headless(LIMIT);
            let record: Option<&mut dyn FnMut(&Line)> = Some(&mut write);
            let setup = lockstep::Setup { input: source, record, verify, observers, ..base };
            let finished = lockstep::run(cast, setup).map_err(RunError::from)?;
            match (failed, file) {
                (Some(error), _) => return Err(error),
                (None, Some(file)) => file.finish()?,
                (None, None) => {}
            }
            finished
        }
    };
    Ok((finished, scorer.tally()))
}
