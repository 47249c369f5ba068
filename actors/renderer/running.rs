//! One game beside its window: its thread, and the window's ends of what joins them.

use super::advice::{AdviceScreen, Answer, NoAdvice};
use super::felt::{FeltScreen, FeltSetup};
use super::film::FilmScreen;
use super::game_thread::GameThread;
use super::heard::{HeardScreen, HeardSetup};
use super::meters::MetersScreen;
use super::outbox::Outbox;
use super::stage::Stage;
use crate::conductor::RunError;
use crate::event_manager::Sink;
use crate::meters::Meters;
use glam::DVec2;
use hapticbillard::ai::Adviser;
use hapticbillard::events::{Command, Event, Topic, Topics};
use hapticbillard::ids::GameKind;
use hapticbillard::input::{
    Bindings, HandInput, HumanMode, HumanView, Room, Rumble, StylusMouse, StylusSays, Tutor,
};
use hapticbillard::physics::Snapshot;
use hapticbillard::picture::PictureSettings;
use hapticbillard::renderer::{
    DrawList, HelpOf, Hud, Mount, Playhead, Radii, Scoreboard, ThoughtsPanel, Words, draw_thoughts,
    draw_vectors,
};
use hapticbillard::room;
use hapticbillard::rules::{Language, Texts};
use hapticbillard::table::Table;
use hapticbillard::tick::{Delivered, Finished};
use std::sync::Arc;
use three_d::Context;

/// Reports that may wait for the hand, which empties the channel every tick; see [`Outbox`].
const REPORTS: usize = 1024;
/// Batches of events that may wait for a picture; what does not fit is counted as dropped.
const MAIL: usize = 4096;

/// States that may wait to be filmed: 16 s, in which no picture was drawn.
const FILM: usize = 4096;

/// What a window shows of a game.
pub struct GameSetup {
    /// The table.
    pub table: Arc<Table>,
    /// The balls' radii.
    pub radii: Radii,
    /// The world before the first tick.
    pub first: Arc<Snapshot>,
    /// Names of player 1 and player 2.
    pub names: Vec<String>,
    /// What is played, if anything.
    pub game: Option<GameKind>,
    /// Seconds of the game per second.
    pub speed: f64,
    /// The haptic device; none where a scene has none.
    pub felt: Option<FeltSetup>,
    /// Sound; none where a scene has none.
    pub heard: Option<HeardSetup>,
    /// Who tells a person what to play.
    pub adviser: Option<Adviser>,
    /// Somebody shows how to play.
    pub is_lesson: bool,
}

/// The game's ends of what joins it with its window.
pub struct Ports {
    /// What devices say.
    pub raw: flume::Receiver<HandInput>,
    /// What the hand sees and does.
    pub view: triple_buffer::Input<HumanView>,
    /// The newest state of the world.
    pub world: triple_buffer::Input<Arc<Snapshot>>,
    /// States of the world, in order, for a film.
    pub film: flume::Sender<Arc<Snapshot>>,
    /// Where events for the scoreboard go.
    pub sink: Sink,
    /// What is measured while its panel is shown.
    pub meters: Arc<Meters>,
}

/// Plays a game on a thread of its own.
pub type Play = Box<dyn FnOnce(Ports) -> Result<Finished, RunError> + Send>;

/// A game that can begin.
pub struct Prepared {
    /// What is shown of it.
    pub setup: GameSetup,
    /// The game.
    pub play: Play,
}

/// A game that has begun.
pub struct Running {
    /// What the graphics card holds of it.
    pub stage: Stage,
    /// What is said to it.
    pub outbox: Outbox,
    /// How it stands.
    pub board: Scoreboard,
    /// Sound, where it is heard.
    pub heard: Option<HeardScreen>,
    /// What the computer thinks is shown.
    pub shows_thoughts: bool,
    /// Where the balls of the last shot went is shown.
    pub shows_traces: bool,
    /// What is measured.
    pub meters: MetersScreen,
    /// Who tells a person what to play, if there is somebody.
    pub advice: Option<AdviceScreen>,
    /// Somebody who shows how to play.
    pub tutor: Option<Tutor>,
    /// Shots that can be seen again.
    pub film: FilmScreen,
    /// How its pictures are drawn.
    pub picture: PictureSettings,
    /// The hardest contact since somebody took it, for a gamepad.
    pub shake: Option<Rumble>,
    view: triple_buffer::Output<HumanView>,
    world: triple_buffer::Output<Arc<Snapshot>>,
    mail: flume::Receiver<Delivered>,
    playhead: Playhead,
    mount: Mount,
    room: Room,
    drawn_s: f64,
    names: Vec<String>,
    game: Option<GameKind>,
    texts: Texts,
    words: Words,
    radii: Radii,
    table: Arc<Table>,
    felt: Option<FeltScreen>,
    thread: GameThread,
}

impl Running {
    /// Begins a game; `ended` is called on its thread when it is over. `is_shaken`: a gamepad
    /// wants to know of contacts.
    ///
    /// # Errors
    /// The system gives no thread.
    pub fn begin(
        prepared: Prepared,
        context: &Context,
        (language, bindings): (Language, &Bindings),
        is_shaken: bool,
        ended: impl FnOnce() + Send + 'static,
    ) -> Result<Self, RunError> {
        let Prepared { setup, play } = prepared;
        let (raw_in, raw) = flume::bounded(REPORTS);
        let (view_in, view) = triple_buffer::triple_buffer(&HumanView::default());
        let (world_in, world) = triple_buffer::triple_buffer(&setup.first);
        let (mail_in, mail) = flume::bounded(MAIL);
        let advice = setup.adviser.map(|adviser| AdviceScreen::new(adviser, &setup.first));
        let also = advice.as_ref().map_or(Topics::NONE, AdviceScreen::topics);
        let also = if setup.is_lesson { also.or(Tutor::topics()) } else { also };
        let (film_in, film) = flume::bounded(FILM);
        let contacts = [Topic::CueBallStruck, Topic::BallsCollided, Topic::CushionHit];
        let contacts = if is_shaken { Topics::of(&contacts) } else { Topics::NONE };
        let sink = Sink::new("window", Scoreboard::topics().or(contacts).or(also), mail_in);
        let meters = Arc::new(Meters::default());
        let measured = meters.clone();
        let ports =
            Ports { raw, view: view_in, world: world_in, film: film_in, sink, meters: measured };
        let thread = GameThread::begin(|| play(ports), ended, raw_in.clone())?;
        let stage = Stage::new(context, &setup.table)
            .map_err(|error| RunError::Start(format!("OpenGL: {error}")))?;
        let stands = room::obstacles(&setup.table).into_iter().map(|one| (one.least, one.most));
        let room = Room::round(setup.table.bed.as_ref()).with(stands);
        Ok(Running {
            stage,
            outbox: Outbox::new(raw_in),
            board: Scoreboard::new(setup.names.clone()),
            heard: setup.heard.map(HeardScreen::new),
            shows_thoughts: false,
            shows_traces: false,
            advice,
            tutor: setup.is_lesson.then(Tutor::default),
            film: FilmScreen::new(film),
            meters: MetersScreen::new(meters),
            picture: PictureSettings::default(),
            shake: None,
            view,
            world,
            mail,
            playhead: Playhead::new(setup.first, setup.speed),
            mount: Mount::default(),
            room,
            drawn_s: 0.0,
            texts: texts(language, &setup.names, setup.game),
            words: Words::new(language).with_keys(bindings),
            names: setup.names,
            game: setup.game,
            radii: setup.radii,
            table: setup.table,
            felt: setup.felt.map(FeltScreen::new),
            thread,
        })
    }

    /// Writes everything in this language and with these keys from now on.
    pub fn speak(&mut self, language: Language, bindings: &Bindings) {
        self.texts = texts(language, &self.names, self.game);
        self.words = Words::new(language).with_keys(bindings);
    }

    /// Waits for the end of the game. A panic of its thread goes on here; none if it has ended
    /// before.
    pub fn join(&mut self) -> Option<Result<Finished, RunError>> {
        self.thread.join()
    }

    /// What a stylus says to a window of this size [pixels] since the last time.
    pub fn stylus_says(&mut self, mouse: &mut StylusMouse, window: DVec2) -> Vec<StylusSays> {
        self.felt.as_mut().map_or_else(Vec::new, |felt| felt.says(mouse, window))
    }

    /// What the player sees and does.
    pub fn view(&mut self) -> HumanView {
        self.view.read().clone()
    }

    /// The last shot is seen again, or no longer.
    pub fn screen(&mut self, is_shown: bool) {
        if is_shown {
            self.film.begin(&self.table);
        } else if self.film.end()
            && let Some(tutor) = &mut self.tutor
        {
            tutor.saw_replay();
        }
    }

    /// What came of the question what to play, once.
    pub fn take_advice(&mut self) -> Option<Answer> {
        let table = self.world.read().clone();
        let is_aiming = self.view.read().mode == HumanMode::Aiming;
        let turn = self.board.turn.as_ref().filter(|_| is_aiming && !self.board.is_rolling);
        self.advice.as_mut()?.take(turn, &table)
    }

    /// Asks what to play, if that can be asked now.
    pub fn ask_advice(&mut self) -> Result<(), NoAdvice> {
        let table = self.world.read().clone();
        let mode = self.view.read().mode;
        let advice = self.advice.as_mut().ok_or(NoAdvice::Nobody)?;
        let turn = self.board.turn.clone().filter(|_| mode == HumanMode::Aiming);
        advice.ask(turn.ok_or(NoAdvice::NotNow)?, &table)
    }

    /// What the player is doing.
    pub fn mode(&mut self) -> HumanMode {
        self.view.read().mode
    }

    /// Takes what happened since the last picture.
    pub fn take_news(&mut self, now_s: f64) {
        self.meters.look(&self.outbox);
        for delivered in self.mail.try_iter() {
            self.meters.hear(&delivered);
            if let Some(advice) = &mut self.advice {
                advice.hear(&delivered);
            }
            for stamped in delivered.events.iter() {
                self.board.hear(&stamped.event);
                if let Some(tutor) = &mut self.tutor {
                    tutor.hear(&stamped.event);
                }
                if matches!(stamped.event, Event::Command(Command::Undo)) {
                    self.film.forget();
                }
                if let Event::Fact(fact) = &stamped.event {
                    self.film.hear(fact);
                    let felt = Rumble::of(fact).into_iter().chain(self.shake);
                    self.shake = felt.max_by(|a, b| a.strength.total_cmp(&b.strength));
                }
            }
        }
        let state = self.world.read().clone();
        self.playhead.take(&state, now_s);
        self.film.take();
        if let Some(felt) = &mut self.felt {
            felt.take(now_s);
        }
    }

    /// What is drawn and written at `now_s`, for somebody who holds a gamepad or not.
    pub fn seen(&mut self, view: &HumanView, is_by_pad: bool, now_s: f64) -> (DrawList, Hud) {
        let dt = now_s - std::mem::replace(&mut self.drawn_s, now_s);
        if let Some((world, view)) = self.film.seen(dt) {
            let view = self.mount.carry(view, &world);
            let view = self.hung(view, dt);
            self.radii.mark(self.picture.marks);
            let mut list = DrawList::new(&world, &view, &self.radii);
            if self.picture.vectors {
                draw_vectors(&world, &self.radii, &mut list);
            }
            if self.shows_traces {
                list.show_traces(self.film.ways(), view.cue_ball, &self.radii);
            }
            return (list, self.film.written(&self.board, is_by_pad, &self.words));
        }
        let (mut list, mut written) = self.drawn(view, now_s, dt);
        if self.shows_traces {
            list.show_traces(self.film.ways(), view.cue_ball, &self.radii);
        }
        if let Some(advice) = self.advice.as_ref().and_then(AdviceScreen::shown) {
            draw_thoughts(&advice.insight, &self.radii, &mut list);
        }
        if is_by_pad {
            written = written.for_pad(view, &self.words);
        }
        if let Some(tutor) = &mut self.tutor {
            tutor.see(view);
            written = written.with_lesson(tutor, view, is_by_pad, &self.words);
        }
        if let Some(insight) = self.board.insight.as_ref().filter(|_| self.shows_thoughts) {
            draw_thoughts(insight, &self.radii, &mut list);
            let name = self.board.name(insight.player);
            let panel = ThoughtsPanel::new(insight, name, &self.texts, &self.words);
            written.thoughts = Some(panel);
        }
        if let Some(heard) = &mut self.heard {
            heard.listen_at(&list.camera);
            heard.write(&mut written, &self.words, now_s);
        }
        written.meters = self.meters.panel(&self.words, now_s);
        (list, written)
    }

    /// What there is to press in it.
    pub fn help(&self, is_by_pad: bool) -> HelpOf {
        match &self.felt {
            Some(felt) if felt.is_by_mouse() => HelpOf::Felt,
            _ if is_by_pad => HelpOf::Pad,
            _ => HelpOf::Keys,
        }
    }

    /// The eye hangs where it is wanted.
    fn hung(&mut self, mut view: HumanView, dt: f64) -> HumanView {
        view.camera = self.mount.hang(&view.camera, &self.room, dt);
        view
    }

    fn drawn(&mut self, view: &HumanView, now_s: f64, dt: f64) -> (DrawList, Hud) {
        self.radii.mark(self.picture.marks);
        let world = self.playhead.shown(now_s);
        let mut view = self.mount.carry(view.clone(), &world);
        if let Some(felt) = &mut self.felt {
            view = felt.view(&view, &world, &self.table, &self.radii, now_s);
        }
        let (view, radii) = (self.hung(view, dt), &self.radii);
        let Some(felt) = &mut self.felt else {
            let written = Hud::new(&self.board, &view, &self.texts, &self.words);
            let mut list = DrawList::new(&world, &view, radii);
            if self.picture.vectors {
                draw_vectors(&world, radii, &mut list);
            }
            return (list, written);
        };
        let mut list = DrawList::new(&world, &view, radii);
        if self.picture.vectors {
            draw_vectors(&world, radii, &mut list);
        }
        felt.draw(&mut list);
        let written = Hud::new(&self.board, &view, &self.texts, &self.words);
        (list, felt.write(written, &view, &self.words))
    }
}

fn texts(language: Language, names: &[String], game: Option<GameKind>) -> Texts {
    let texts = Texts::new(language);
    let texts = match names {
        [one, two] => texts.with_names(one, two),
        [one] => texts.with_names(one, ""),
        _ => texts,
    };
    match game {
        Some(game) => texts.for_game(game),
        None => texts,
    }
}
