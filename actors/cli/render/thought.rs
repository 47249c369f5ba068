//! The moment in a game at which a computer player has decided on a stroke.

use hapticbillard::events::{Event, Insight, Source, Topics};
use hapticbillard::hash::StateHash;
use hapticbillard::input::HumanView;
use hapticbillard::lockstep::{Lockstep, Setup};
use hapticbillard::physics::Snapshot;
use hapticbillard::renderer::{Hud, Scoreboard, ThoughtsPanel, Words};
use hapticbillard::replay::{RecordedInput, Recording};
use hapticbillard::rules::{Language, Texts};
use hapticbillard::tick::{Delivered, FrameSource, Outcome, Participant};
use hapticbillard_actors::conductor::RunError;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::game::{LIMIT, Stage};
use std::sync::{Arc, Mutex, PoisonError};

/// What is known of the game, and how many strokes were decided on.
#[derive(Clone, Default)]
struct Watcher(Arc<Mutex<(Scoreboard, u32)>>);

impl Participant for Watcher {
    fn source(&self) -> Source {
        Source::Runtime
    }

    fn topics(&self) -> Topics {
        Scoreboard::topics()
    }

    fn start(&mut self, _: &Snapshot) -> Outcome {
        Outcome::default()
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        let mut seen = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        for stamped in delivered.events.iter() {
            seen.0.hear(&stamped.event);
            seen.1 += u32::from(matches!(stamped.event, Event::Insight(_)));
        }
        Outcome::default()
    }

    fn hash(&self, _: &mut StateHash) {}
}

/// A decision, and the world in which it was made.
pub struct Thought {
    /// What the player thought.
    pub insight: Arc<Insight>,
    /// The world.
    pub table: Arc<Snapshot>,
    board: Scoreboard,
    texts: Texts,
}

impl Thought {
    /// Plays a scene, or a recording of it, until players have decided on `number` strokes.
    ///
    /// # Errors
    /// The game cannot go on, or ends before.
    pub fn of(stage: &Stage, recording: Option<Recording>, number: u32) -> Result<Self, Error> {
        let names: Vec<String> =
            stage.scene.players.iter().map(|player| player.name.clone()).collect();
        let watcher = Watcher::default();
        let mut setup = Setup::headless(LIMIT);
        setup.observers.push(Box::new(watcher.clone()));
        setup.input = recording
            .map(|recording| Box::new(RecordedInput(Arc::new(recording))) as Box<dyn FrameSource>);
        let mut game = Lockstep::new(stage.cast()?, setup).map_err(RunError::from)?;
        loop {
            let is_over = game.step().map_err(RunError::from)?.is_some();
            let seen = watcher.0.lock().unwrap_or_else(PoisonError::into_inner);
            if let (Some(insight), true) = (&seen.0.insight, seen.1 >= number) {
                let texts = Texts::new(Language::English);
                let texts = match &names[..] {
                    [one, two] => texts.with_names(one, two),
                    _ => texts,
                };
                let texts = match stage.scene.rules {
                    Some(rules) => texts.for_game(rules.game),
                    None => texts,
                };
                let (insight, table) = (insight.clone(), game.table().clone());
                return Ok(Thought {
                    insight,
                    table,
                    board: Scoreboard { names, ..seen.0.clone() },
                    texts,
                });
            }
            if is_over {
                let problem = format!("only {} strokes are decided on in this game", seen.1);
                let fix = "ask for an earlier one; only computer players tell what they think";
                return Err(Error::input(format!("--thoughts {number}"), problem, fix));
            }
        }
    }

    /// What is written over the picture.
    pub fn written(&self) -> Hud {
        let words = Words::new(Language::English);
        let name = self.board.name(self.insight.player);
        let panel = ThoughtsPanel::new(&self.insight, name, &self.texts, &words);
        let hud = Hud::new(&self.board, &HumanView::default(), &self.texts, &words);
        // There is no window to press a key in.
        Hud { thoughts: Some(panel), help_hint: String::new(), ..hud }
    }
}
