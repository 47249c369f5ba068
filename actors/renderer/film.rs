//! The film of the last shot, in the window.

use hapticbillard::events::{Fact, FactKind};
use hapticbillard::input::{Action, BallWay, HandInput, HumanView};
use hapticbillard::physics::Snapshot;
use hapticbillard::renderer::{Hud, Reel, Scoreboard, Screening, Words};
use hapticbillard::table::Table;
use std::sync::Arc;

/// Films what happens, and shows it.
pub struct FilmScreen {
    frames: flume::Receiver<Arc<Snapshot>>,
    reel: Reel,
    shown: Option<Screening>,
}

impl FilmScreen {
    /// Films what comes here.
    pub fn new(frames: flume::Receiver<Arc<Snapshot>>) -> Self {
        FilmScreen { frames, reel: Reel::default(), shown: None }
    }

    /// Takes what came since the last picture.
    pub fn take(&mut self) {
        self.frames.try_iter().for_each(|frame| self.reel.take(&frame));
    }

    /// A fact says where shots begin and end.
    pub fn hear(&mut self, fact: &Fact) {
        match fact.kind {
            FactKind::CueBallStruck { ball, .. } => self.reel.struck(ball),
            FactKind::Settled { .. } => self.reel.settled(fact.time_s),
            _ => {}
        }
    }

    /// Whether there is one.
    pub fn has_film(&self) -> bool {
        self.reel.has_film()
    }

    /// The ways of the balls in the film that is shown, or in the last shot.
    pub fn ways(&self) -> &[BallWay] {
        self.shown.as_ref().map_or_else(|| self.reel.ways(), |shown| shown.film().ways())
    }

    /// The shot is taken back.
    pub fn forget(&mut self) {
        self.reel.forget();
    }

    /// Shows it.
    pub fn begin(&mut self, table: &Arc<Table>) {
        let film = self.reel.film();
        self.shown = film.map(|film| Screening::new(film, table.clone()));
    }

    /// Shows it no longer; whether it was shown.
    pub fn end(&mut self) -> bool {
        self.shown.take().is_some()
    }

    /// Whether it was shown to its end.
    pub fn is_over(&self) -> bool {
        self.shown.as_ref().is_some_and(Screening::is_over)
    }

    /// Whoever sees it does something.
    pub fn onlook(&mut self, input: HandInput) {
        self.shown.iter_mut().for_each(|shown| shown.hear(input));
    }

    /// It goes slower, faster, or stands still.
    pub fn turn(&mut self, action: Action) {
        self.shown.iter_mut().for_each(|shown| shown.turn(action));
    }

    /// The picture `dt` seconds after the last one, while it is shown.
    pub fn seen(&mut self, dt: f64) -> Option<(Snapshot, HumanView)> {
        let shown = self.shown.as_mut()?;
        shown.pass(dt);
        Some(shown.seen())
    }

    /// What is written over it.
    pub fn written(&self, board: &Scoreboard, is_by_pad: bool, words: &Words) -> Hud {
        let Some(shown) = &self.shown else { return Hud::default() };
        let hud = Hud::of_film(board, shown.place_s(), shown.rate(), words);
        if is_by_pad { Hud { hint: words.get("film_hint_pad"), ..hud } } else { hud }
    }
}
