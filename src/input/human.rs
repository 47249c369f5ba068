//! A person, whatever is in their hands: a mouse, a keyboard, a gamepad, a stylus.
//!
//! Of devices only what they mean comes here ([`HandInput`]); which key is which action stands in
//! [`Bindings`]. In a turn:
//!
//! | | while aiming | while placing | while stroking |
//! |---|---|---|---|
//! | mouse | turns the cue | moves the ball | moves the tip along the shaft |
//! | `stroke` held | a stroke | puts the ball down | let go: back to aiming |
//! | `mouse_moves_tip` held | the mouse moves the tip | | |
//! | `tip_left` and so on | move the tip | move the ball | |
//! | `turn_left`, `turn_right` | turn the cue | | |
//! | `strike` | held: the tip is pulled back | puts the ball down | let go: the stroke |
//! | `raise`, `lower`, wheel with `wheel_raises` | raise the butt | | |
//! | left stick | turns the cue, raises the butt | moves the ball | |
//! | right stick | moves the tip | | |
//! | right trigger | pulls the tip back | | let go quickly: the stroke |
//! | `fine` held | a tenth of everything | a tenth | |
//!
//! A call is proposed from the aim: the first legal ball that it meets, and the pocket nearest to
//! that ball's way. `next_pocket` and `next_ball` go on from there, backwards with `fine`; `safety`
//! and `push_out` call those, or take that back. It is said when the stroke begins.
//!
//! At any time `look` looks round with the mouse or the right stick, and the wheel zooms. Who waits
//! for rolling balls or for somebody else holds `hurry`, and time runs faster. `camera` lets the
//! eye be led by hand: the mouse looks, and what moves the tip moves the eye.
//!
//! Where there is a stylus it strikes, and the mouse turns and raises its workspace.
//!
//! [`Bindings`]: super::Bindings

mod acts;

mod ahead;
use ahead::Ahead;

mod eye;

mod fly;

mod keys;
use keys::KeyStroke;

mod pad;
use pad::Sticks;

mod says;

mod stylus;
pub use stylus::STYLUS;

use super::calling::Calling;
use super::camera::Camera;
use super::drive::Steering;
use super::feel::{
    AIM_RAD_PER_HEIGHT, ELEVATION_RAD_PER_NOTCH, FINE, LOOK_RAD_PER_HEIGHT, OFFSET_PER_HEIGHT,
    PLACING_M_PER_HEIGHT, ZOOM_PER_NOTCH,
};
use super::hand_over::{HandOver, StylusWord};
use super::held::Held;
use super::placing::Placing;
use super::tip::{Tip, address_path, stroke_path};
use super::{Action, HandInput, View, sight};
use crate::ball::POOL_RADIUS_M;
use crate::cue::{Aim, CuePath, TIP_RADIUS_M};
use crate::events::{Command, Event, Fact, FactKind, Source, Topic, Topics, Turn, Zone};
use crate::hash::StateHash;
use crate::ids::{BallId, PlayerId};
use crate::physics::Snapshot;
use crate::table::Table;
use crate::tick::{Delivered, Frame, Inflow, Outcome, Participant};
use crate::units::Tick;
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// Where the person stands in a turn.
#[derive(Debug, Clone)]
enum Stage {
    /// Somebody else is at the table.
    Waiting,
    /// One of the options must be taken.
    Choosing,
    /// A ball is in hand.
    Placing(Placing),
    /// The cue is at the address.
    Aiming,
    /// The cue is held for a stroke. Boxed: it is much larger than the others.
    Stroking(Box<Tip>),
    /// A ball was struck and the cue is withdrawn.
    Struck,
}

/// The hand of one or two people who share their devices.
#[derive(Debug, Clone)]
pub struct Human {
    players: Vec<PlayerId>,
    table: Arc<Table>,
    radius_m: f64,
    tip_radius_m: f64,
    /// Where the cue ball lay at first: it is put back there where no bed has a head spot [m].
    tee: DVec2,
    /// Any ball can be put anywhere, and shots can be taken back.
    is_practice: bool,
    /// The table as it was last seen.
    seen: Arc<Snapshot>,

    stage: Stage,
    turn: Option<Arc<Turn>>,
    calling: Calling,
    /// How the cue is held; its elevation is at least what clears balls and rails.
    aim: Aim,
    /// What the player raised the butt to [rad].
    raised_rad: f64,
    /// Middle of the cue ball that is aimed at [m].
    centre: DVec3,
    /// A stroke by a key or a trigger, while there is one.
    key_stroke: Option<KeyStroke>,
    /// The way of the tip in the last tick of a stroke.
    path: Option<CuePath>,
    strength_m_s: f64,
    ghost: Option<(DVec3, DVec2)>,

    /// What is seen ahead while aiming.
    ahead: Ahead,

    /// The stylus beside the mouse.
    stylus: Option<HandOver>,
    /// The mouse is what moves the stylus.
    is_mouse_felt: bool,
    /// How it leads the camera.
    steering: Steering,
    /// How much faster than usual.
    stylus_speed: f64,

    held: Held,
    /// A gamepad's sticks, and the trigger that strokes.
    sticks: Sticks,
    camera: Camera,
    /// From where the player likes to look.
    view: View,
    /// Whoever only looks on looks round without holding anything.
    only_looks: bool,
    /// A pocket is called by pointing at this point of the bed [m].
    pointing: Option<DVec2>,
    overlay: bool,
    paused: bool,
    /// The last answer said that time stands still: the frame of the next one is not used.
    was_paused: bool,
    /// Commands that wait for the next frame.
    pending: Frame,
    /// The aim is not what physics was told last.
    is_aim_new: bool,
}

impl Human {
    /// A hand that plays for `players` on `table`.
    pub fn new(players: Vec<PlayerId>, table: Arc<Table>) -> Self {
        let camera = Camera::new(table.bed.as_ref());
        Human {
            players,
            table,
            radius_m: POOL_RADIUS_M,
            tip_radius_m: TIP_RADIUS_M,
            tee: DVec2::ZERO,
            is_practice: false,
            seen: Arc::default(),
            stage: Stage::Waiting,
            turn: None,
            calling: Calling::default(),
            aim: Aim::default(),
            raised_rad: 0.0,
            centre: DVec3::ZERO,
            key_stroke: None,
            path: None,
            strength_m_s: 0.0,
            ghost: None,
            ahead: Ahead::default(),
            stylus: None,
            is_mouse_felt: false,
            steering: Steering::default(),
            stylus_speed: 1.0,
            held: Held::default(),
            sticks: Sticks::default(),
            camera,
            view: View::Usual,
            only_looks: false,
            pointing: None,
            overlay: false,
            paused: false,
            was_paused: false,
            pending: Frame::new(),
            is_aim_new: false,
        }
    }

    /// Whether there is anybody to play for.
    pub fn plays(&self) -> bool {
        !self.players.is_empty()
    }

    /// The same for a cue ball of another radius [m].
    #[must_use]
    pub fn with_ball_radius(mut self, radius_m: f64) -> Self {
        self.radius_m = radius_m;
        self
    }

    /// The same with a tip of another radius [m].
    #[must_use]
    pub fn with_tip_radius(mut self, radius_m: f64) -> Self {
        self.tip_radius_m = radius_m;
        self
    }

    /// What the player does in `tick`, given what the hand heard since the tick before.
    pub fn inflow(&mut self, tick: Tick, heard: &[HandInput]) -> Inflow {
        self.inflow_beside(tick, heard, None)
    }

    /// The same beside what a stylus says, if it says something.
    ///
    /// While time stands still it is asked on and on for one tick; what it answers then counts
    /// only as far as pause and quit go, so commands wait for the frame after.
    pub fn inflow_beside(
        &mut self,
        tick: Tick,
        heard: &[HandInput],
        word: Option<&StylusWord>,
    ) -> Inflow {
        // Where the eye was a tick ago is known before anything leads it.
        self.camera.step();
        let mut up = 0.0;
        let mut quit = false;
        for input in heard {
            quit |= self.take(*input, &mut up);
        }
        self.hold_keys();
        self.hold_sticks();
        self.hold_trigger();
        if let Some(word) = word {
            self.follow_stylus(tick, word);
        }
        self.fly_by_keys();
        if !self.paused {
            up += self.key_movement();
            self.move_tip(tick, up);
        }
        self.show_aim(tick);
        self.look_ahead(tick);
        self.follow_with_camera();

        let frame = if self.was_paused { Frame::new() } else { std::mem::take(&mut self.pending) };
        self.was_paused = self.paused;
        // A person may act in any tick.
        let next = Some(tick.after(1));
        Inflow { frame, next, paused: self.paused, hurried: self.is_hurried(), quit }
    }

    /// Takes one thing; adds to `up` what moves the tip. True if the game shall end.
    fn take(&mut self, input: HandInput, up: &mut f64) -> bool {
        match input {
            HandInput::Moved { right, up: upwards } => self.moved(right, upwards, up),
            HandInput::Wheel { notches } => self.wheel(notches),
            HandInput::Act { action, down } => {
                self.held.act(action, down);
                match (action, down) {
                    (Action::Stroke, false) => self.release(std::mem::take(up)),
                    (Action::Strike, false) => self.release_key(),
                    (_, true) => return self.begin(action),
                    (_, false) => {}
                }
            }
            HandInput::Stick { stick, at } => self.sticks.put(stick, at),
            HandInput::Trigger(pressed) => self.sticks.pull(pressed),
            HandInput::Picked { option } => self.pick(option),
            HandInput::Aid(aid) => self.ahead.aid = aid,
            HandInput::Points { right, up } => self.pointed_at(DVec2::new(right, up)),
            HandInput::Hold(aim) => self.hold_so(aim),
            HandInput::Steering(steering) => self.steering = steering,
            HandInput::StylusSpeed(factor) => self.stylus_speed = factor,
            HandInput::Paused(paused) => self.set_paused(paused),
            HandInput::FocusLost => self.forget(),
            HandInput::PadLost => {
                self.forget();
                self.set_paused(true);
            }
            HandInput::Closed => return true,
        }
        false
    }

    /// Everything counts as let go.
    fn forget(&mut self) {
        self.held.forget();
        self.sticks = Sticks::default();
        self.let_go();
    }

    fn fine(&self) -> f64 {
        if self.held.has(Action::Fine) { FINE } else { 1.0 }
    }

    fn moved(&mut self, right: f64, upwards: f64, stroke: &mut f64) {
        if self.looks_round() {
            self.camera.look(-right * LOOK_RAD_PER_HEIGHT, -upwards * LOOK_RAD_PER_HEIGHT);
            return;
        }
        if self.paused {
            return;
        }
        let fine = self.fine();
        if self.pointing.is_none() && self.turn_workspace(-right * AIM_RAD_PER_HEIGHT * fine, 0.0) {
            return;
        }
        match &mut self.stage {
            Stage::Waiting | Stage::Struck | Stage::Choosing => {}
            Stage::Aiming if self.pointing.is_some() => {
                self.point_on(DVec2::new(right, upwards) * PLACING_M_PER_HEIGHT);
            }
            Stage::Placing(placing) => {
                let by = DVec2::new(right, upwards) * (PLACING_M_PER_HEIGHT * fine);
                placing.moved(by, self.table.bed.as_ref(), self.radius_m);
            }
            Stage::Aiming if self.held.has(Action::MouseMovesTip) => {
                self.shift_tip(
                    right * OFFSET_PER_HEIGHT * fine,
                    upwards * OFFSET_PER_HEIGHT * fine,
                );
            }
            Stage::Aiming => {
                let turned = self.aim.azimuth_rad - right * AIM_RAD_PER_HEIGHT * fine;
                let change = |aim: &mut Aim| aim.azimuth_rad = turned;
                self.change_aim(change);
            }
            Stage::Stroking(_) => *stroke += upwards,
        }
    }

    fn wheel(&mut self, notches: f64) {
        if self.held.has(Action::WheelRaises) {
            self.raise(notches * ELEVATION_RAD_PER_NOTCH * self.fine());
        } else {
            self.camera.zoom(libm::pow(ZOOM_PER_NOTCH, notches));
        }
    }

    /// Changes how the cue is held, if it is held to aim, and keeps it clear of everything.
    fn change_aim(&mut self, change: impl FnOnce(&mut Aim)) {
        if !matches!(self.stage, Stage::Aiming) || self.stylus_leads() {
            return;
        }
        let mut aim = self.aim;
        change(&mut aim);
        aim = aim.limited();
        let cue_ball = self.cue_ball();
        let needed = sight::elevation_needed(aim, self.centre, cue_ball, &self.seen, &self.table);
        aim.elevation_rad = self.raised_rad.max(needed);
        if aim == self.aim {
            return;
        }
        self.aim = aim;
        self.is_aim_new = true;
        self.sight();
    }

    fn sight(&mut self) {
        let (seen, bed) = (&self.seen, self.table.bed.as_ref());
        self.ghost = sight::ghost(seen, bed, self.cue_ball(), self.centre, self.aimed_along());
        self.follow_with_call();
    }

    /// A hand takes the cue, or puts a ball down.
    fn press(&mut self) {
        if self.paused || self.camera.is_free() {
            return;
        }
        let is_free = !self.stylus_leads();
        if self.pointing.take().is_some() {
            return;
        }
        match &mut self.stage {
            Stage::Placing(placing) if !placing.is_put => {
                placing.is_put = true;
                let Placing { ball, at: position_m, zone, .. } = *placing;
                self.command(Command::PlaceBall { ball, position_m, zone });
            }
            // Who strikes with a stylus announces with a click.
            Stage::Aiming => {
                self.announce();
                if is_free {
                    self.stage = Stage::Stroking(Box::new(Tip::new()));
                }
            }
            _ => {}
        }
    }

    /// A hand that strokes lets go, after a movement `up` in this tick. The tip lags the hand: a
    /// hand that has gone through the ball has made its stroke, and the tip follows.
    fn release(&mut self, up: f64) {
        match &mut self.stage {
            // A key or a trigger strikes.
            Stage::Stroking(_) if self.key_stroke.is_some() => {}
            Stage::Stroking(tip) if tip.is_hand_through(up) => tip.let_go(up),
            _ => self.let_go(),
        }
    }

    /// The cue is held no more, as far as a stroke goes: one that has met nothing is none.
    fn let_go(&mut self) {
        self.pointing = None;
        if matches!(self.stage, Stage::Stroking(_)) {
            self.stage = Stage::Aiming;
            (self.path, self.key_stroke) = (None, None);
            // Shown at once, even if time stands still from here on: no solid cue is left behind.
            self.is_aim_new = true;
        }
        self.disarm_stylus();
    }

    /// Moves the tip by one tick of a stroke.
    fn move_tip(&mut self, tick: Tick, up: f64) {
        let contact = self.contact();
        let Stage::Stroking(tip) = &mut self.stage else { return };
        if tip.has_arrived_alone() {
            // It met nothing.
            self.let_go();
            return;
        }
        if let Some(stretch) = tip.step(up) {
            let path = stroke_path(&self.aim, contact, stretch, tick.start_s());
            self.path = Some(path.clone());
            self.command(Command::MoveCue(Arc::new(path)));
        }
    }

    /// Shows the cue at the address, if it is held differently than before.
    fn show_aim(&mut self, tick: Tick) {
        if self.is_aim_new && matches!(self.stage, Stage::Aiming) {
            self.is_aim_new = false;
            let path = address_path(&self.aim, self.contact(), tick.start_s());
            self.command(Command::MoveCue(Arc::new(path)));
        }
    }

    fn contact(&self) -> DVec3 {
        self.aim.tip_of_radius_at_contact(self.tip_radius_m, self.centre, self.radius_m)
    }

    fn say(&mut self, event: Event) {
        self.pending.push(event.into());
    }

    fn command(&mut self, command: Command) {
        self.say(Event::Command(command));
    }

    /// Takes one event of a tick's mail.
    fn hear(&mut self, event: &Event, tick: Tick) {
        match event {
            Event::Turn(turn) if self.players.contains(&turn.player) => {
                self.begin_turn(turn.clone());
            }
            Event::Turn(_) | Event::Verdict(_) => self.leave_table(),
            Event::Fact(fact) => self.hear_fact(fact, tick),
            _ => {}
        }
    }

    fn hear_fact(&mut self, fact: &Fact, tick: Tick) {
        match fact.kind {
            FactKind::BallPlaced { ball, ok, .. } => self.placed(ball, ok),
            FactKind::CueBallStruck { .. }
                if matches!(self.stage, Stage::Aiming) && self.stylus_leads() =>
            {
                self.stylus_struck(fact);
            }
            FactKind::CueBallStruck { .. } | FactKind::BallTouched { .. }
                if matches!(self.stage, Stage::Stroking(_)) =>
            {
                self.withdraw(fact, tick);
            }
            FactKind::Settled { .. } if matches!(self.stage, Stage::Struck) => self.leave_table(),
            _ => {}
        }
    }

    fn begin_turn(&mut self, turn: Arc<Turn>) {
        let same = self
            .turn
            .as_ref()
            .is_some_and(|own| (own.player, own.shot_number) == (turn.player, turn.shot_number));
        // The referee calls again after a refused placement: the ball is still in hand.
        if same && matches!(self.stage, Stage::Placing(_)) {
            self.turn = Some(turn);
            return;
        }
        self.leave_table();
        let zone = match turn.ball_in_hand.zone() {
            // A cue ball that is nowhere must be put down whatever the turn says.
            None if sight::place_of(&self.seen, turn.cue_ball).is_none() => Some(Zone::Anywhere),
            zone => zone,
        };
        let (must_choose, cue_ball) = (!turn.options.is_empty(), turn.cue_ball);
        self.turn = Some(turn);
        self.calling = Calling::default();
        match zone {
            _ if must_choose => self.stage = Stage::Choosing,
            Some(zone) => self.hold(cue_ball, zone),
            None => self.address(),
        }
    }

    /// The ball that is struck in this turn.
    fn cue_ball(&self) -> BallId {
        self.turn.as_ref().map_or(BallId::CUE, |turn| turn.cue_ball)
    }

    /// Puts the cue behind the cue ball.
    fn address(&mut self) {
        let lies = sight::place_of(&self.seen, self.cue_ball());
        let (Some(centre), Some(turn)) = (lies, &self.turn) else {
            return;
        };
        let bed = self.table.bed.as_ref();
        let first = sight::first_aim(turn, &self.seen, bed, centre.truncate());
        self.stage = Stage::Aiming;
        self.centre = centre;
        self.raised_rad = 0.0;
        self.aim = Aim::along(first);
        self.address_with_stylus();
        if self.stylus_leads() {
            return;
        }
        self.change_aim(|_| {});
        self.is_aim_new = true;
        self.sight();
    }

    /// A ball was struck: takes the cue back before it can touch it again.
    fn withdraw(&mut self, fact: &Fact, tick: Tick) {
        self.strength_m_s = self.path_speed(fact);
        self.withdraw_cue(tick);
        self.path = None;
        self.stage = Stage::Struck;
    }

    /// The turn is over, or another begins.
    fn leave_table(&mut self) {
        if matches!(self.stage, Stage::Aiming | Stage::Stroking(_) | Stage::Struck) {
            self.command(Command::LiftCue);
        }
        self.stage = Stage::Waiting;
        (self.turn, self.pointing) = (None, None);
        self.path = None;
        self.is_aim_new = false;
        self.ghost = None;
    }
}

impl Participant for Human {
    fn source(&self) -> Source {
        Source::Input
    }

    fn topics(&self) -> Topics {
        Topics::of(&[
            Topic::BallPlaced,
            Topic::CueBallStruck,
            Topic::BallTouched,
            Topic::Settled,
            Topic::Verdict,
            Topic::Turn,
        ])
    }

    fn start(&mut self, table: &Snapshot) -> Outcome {
        self.seen = Arc::new(table.clone());
        self.tee = sight::place_of(table, BallId::CUE).map_or(DVec2::ZERO, DVec3::truncate);
        Outcome::default()
    }

    /// Hears only: what a person does enters by frames, so that a recording holds all of it.
    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        self.seen = delivered.table.clone();
        for stamped in delivered.events.iter() {
            self.hear(&stamped.event, delivered.tick);
        }
        Outcome::default()
    }

    /// Nothing: what a person intends is known to nobody until it enters.
    fn hash(&self, _hash: &mut StateHash) {}
}
