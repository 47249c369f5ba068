//! The computer player in its turn: IDLE, LAZING, AIMING, SHOOTING, ANALYZING, DONE (paper,
//! section 5.4).
//!
//! It acts by commands alone and waits for nothing without a wake, so it never stalls: what does
//! not happen in time is tried again.

use super::choose::{Outlook, call, choose};
use super::hold::{self, Clearance};
use super::noise::StrokeNoise;
use super::place::placements;
use super::plan::{Goal, Plan, plan_shot};
use super::stroke::{Stroke, approach, resting_pose, withdrawal};
use super::view::TableView2d;
use crate::cue::{Aim, CuePath};
use crate::events::{
    Choice, Command, Event, FactKind, PlayerReport, PlayerState, Source, Topic, Topics, Turn,
    TurnAfter, Zone,
};
use crate::hash::StateHash;
use crate::ids::{BallId, PlayerId};
use crate::physics::{Profile, Snapshot};
use crate::table::{Bed, Pocket};
use crate::tick::{Delivered, Outcome, Participant};
use crate::units::Tick;
use glam::DVec2;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::fmt;
use std::sync::Arc;

/// The pause before a turn [ticks].
const LAZING_TICKS: std::ops::RangeInclusive<u64> = 400..=1200;
/// How long the answer to a placement may take [ticks].
const PLACING_TICKS: u64 = 100;
/// How often the cue ball is put down in vain until it is played as it lies.
const PLACING_TRIES: u32 = 40;
/// How long after a stroke's end its contact may still be reported [ticks].
const CONTACT_TICKS: u64 = 3;
/// How often the player aims anew in one go if the stroke met nothing.
const REAIMS: u32 = 3;
/// The longest that a shot is watched [ticks]: two minutes.
const ANALYZING_TICKS: u64 = 120_000;
/// How well a computer plays.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub enum Level {
    /// As the paper's: geometry from above, no look into the future.
    #[default]
    Paper,
    /// Simulates the few best shots.
    Club,
    /// Searches.
    Champion,
}

/// What distinguishes one computer player from another.
#[derive(Debug, Clone, PartialEq)]
pub struct PlayerSettings {
    /// How well it plays.
    pub level: Level,
    /// Seed of everything it leaves to chance.
    pub seed: u64,
    /// Throw compensation f: a cut β is aimed as (1 + f) β (paper, section 5.4.2).
    pub throw_factor: f64,
    /// Error of its strokes, as a multiple of the Computer Pool Olympiad's; 0 is a perfect arm.
    pub noise: f64,
}

impl PlayerSettings {
    /// The paper's player, with the throw compensation that fits a profile's contact laws.
    pub fn paper(seed: u64, profile: Profile) -> Self {
        let throw_factor = throw_factor(profile);
        PlayerSettings { level: Level::Paper, seed, throw_factor, noise: 0.0 }
    }
}

/// Throw compensation f that fits a profile: under `2009` what the paper's player learned
/// (figure 5.5), under `standard` what hits best.
fn throw_factor(profile: Profile) -> f64 {
    match profile {
        Profile::Standard => 0.07,
        Profile::Paper2009 => 0.45,
    }
}

/// The cue ball is being put down.
#[derive(Debug, Clone, PartialEq)]
struct Placing {
    zone: Zone,
    /// Spots that are left to try, the best last.
    spots: Vec<DVec2>,
    tries: u32,
}

/// A computer player.
#[derive(Clone)]
pub struct Player {
    id: PlayerId,
    settings: PlayerSettings,
    bed: Bed,
    pockets: Vec<Pocket>,
    ball_radius_m: f64,
    clearance: Clearance,

    rng: Pcg64Mcg,
    state: PlayerState,
    /// When the state is left at the latest; none only while idle and not placing.
    due: Option<Tick>,
    turn: Option<Arc<Turn>>,
    placing: Option<Placing>,
    /// The zone into which the cue ball was put in this turn.
    played_from: Option<Zone>,
    reaims: u32,
    /// The other player was asked to play again, and this one has not played since.
    has_asked: bool,
    plan: Option<Plan>,
    stroke: Option<Stroke>,
}

impl fmt::Debug for Player {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Player")
            .field("id", &self.id)
            .field("state", &self.state)
            .field("due", &self.due)
            .field("plan", &self.plan)
            .finish_non_exhaustive()
    }
}

impl Player {
    /// A player who waits for a turn on this table.
    pub fn new(
        id: PlayerId,
        settings: PlayerSettings,
        bed: Bed,
        pockets: Vec<Pocket>,
        ball_radius_m: f64,
        clearance: Clearance,
    ) -> Self {
        // Two players with one seed shall not play alike.
        let rng = Pcg64Mcg::seed_from_u64(settings.seed ^ (u64::from(id.0) << 56));
        Player {
            id,
            settings,
            bed,
            pockets,
            ball_radius_m,
            clearance,
            rng,
            state: PlayerState::Idle,
            due: None,
            turn: None,
            placing: None,
            played_from: None,
            reaims: 0,
            has_asked: false,
            plan: None,
            stroke: None,
        }
    }

    /// Where the player stands in its turn.
    pub fn state(&self) -> PlayerState {
        self.state
    }

    /// What it decided in this turn, with the ways it examined.
    pub fn plan(&self) -> Option<&Plan> {
        self.plan.as_ref()
    }

    /// How it is going to strike, or has struck, in this turn.
    pub fn stroke(&self) -> Option<&Stroke> {
        self.stroke.as_ref()
    }

    fn look(&self, table: &Snapshot) -> TableView2d {
        TableView2d::of(table, &self.bed, &self.pockets, self.ball_radius_m)
    }

    /// Takes one event of a tick's mail.
    fn hear(&mut self, event: &Event, delivered: &Delivered, out: &mut Outcome) {
        match event {
            // The referee calls again after a refused placement; by then the next is under way.
            Event::Turn(turn) if self.is_preparing(turn) => {}
            Event::Turn(turn) if turn.player == self.id => {
                self.leave_table(out);
                self.begin_turn(turn.clone(), delivered, out);
            }
            Event::Turn(_) => self.leave_table(out),
            Event::Verdict(verdict) => {
                if self.state == PlayerState::Analyzing {
                    self.finish(delivered.tick, out);
                } else if verdict.turn == TurnAfter::End {
                    self.leave_table(out);
                }
            }
            Event::Fact(fact) => match fact.kind {
                FactKind::BallPlaced { ball: BallId::CUE, ok, .. } => {
                    self.placed(ok, delivered, out);
                }
                FactKind::CueBallStruck { .. } if self.state == PlayerState::Shooting => {
                    self.withdraw(delivered, out);
                }
                FactKind::Settled { .. } if self.state == PlayerState::Analyzing => {
                    self.finish(delivered.tick, out);
                }
                _ => {}
            },
            _ => {}
        }
    }

    /// Whether this very turn has begun and its shot has not.
    fn is_preparing(&self, turn: &Turn) -> bool {
        let same = self
            .turn
            .as_ref()
            .is_some_and(|own| (own.player, own.shot_number) == (turn.player, turn.shot_number));
        same && match self.state {
            PlayerState::Idle => self.placing.is_some(),
            PlayerState::Lazing | PlayerState::Aiming | PlayerState::Shooting => true,
            PlayerState::Analyzing | PlayerState::Done => false,
        }
    }

    /// Goes on when a state has lasted long enough.
    fn go_on(&mut self, delivered: &Delivered, out: &mut Outcome) {
        if self.due.is_none_or(|due| delivered.tick < due) {
            return;
        }
        match self.state {
            PlayerState::Idle if self.placing.is_some() => self.place_next(delivered, out),
            PlayerState::Idle if self.must_choose() => self.choose(delivered, out),
            PlayerState::Idle => self.due = None,
            PlayerState::Lazing if self.must_choose() => self.choose(delivered, out),
            PlayerState::Lazing => self.aim(delivered, out),
            PlayerState::Aiming => self.shoot(delivered, out),
            PlayerState::Shooting => self.missed(delivered, out),
            PlayerState::Analyzing => self.finish(delivered.tick, out),
            PlayerState::Done => self.leave_table(out),
        }
    }

    fn begin_turn(&mut self, turn: Arc<Turn>, delivered: &Delivered, out: &mut Outcome) {
        let lies_there = self.look(&delivered.table).cue_ball.is_some();
        let zone = match turn.ball_in_hand.zone() {
            // A cue ball that is nowhere must be put down whatever the turn says.
            None if !lies_there => Some(Zone::Anywhere),
            zone => zone,
        };
        self.turn = Some(turn);
        match zone {
            // Nobody takes the ball up before it is decided how it goes on.
            _ if self.must_choose() => self.laze(delivered.tick, out),
            Some(zone) => {
                self.placing = Some(Placing { zone, spots: Vec::new(), tries: 0 });
                self.place_next(delivered, out);
            }
            None => self.laze(delivered.tick, out),
        }
    }

    fn must_choose(&self) -> bool {
        self.turn.as_ref().is_some_and(|turn| !turn.options.is_empty())
    }

    /// Takes one of the options; if nobody answers, it is said again.
    fn choose(&mut self, delivered: &Delivered, out: &mut Outcome) {
        let Some(turn) = self.turn.clone() else { return };
        let view = self.look(&delivered.table);
        let goal = Goal::of(&turn, &view, None);
        let outlook = Outlook::of(&view, &goal, self.settings.throw_factor);
        if let Some(choice) = choose(&turn.options, outlook, self.has_asked) {
            self.has_asked = choice == Choice::AskAgain;
            command(Command::Choose(choice), out);
        }
        self.report(PlayerState::Idle, out);
        self.due = Some(delivered.tick.after(PLACING_TICKS));
    }

    /// Puts the cue ball on the next of the spots, and thinks of new ones if there is none left.
    fn place_next(&mut self, delivered: &Delivered, out: &mut Outcome) {
        let view = self.look(&delivered.table);
        let (Some(mut placing), Some(turn)) = (self.placing.take(), self.turn.clone()) else {
            return;
        };
        if placing.tries >= PLACING_TRIES && view.cue_ball.is_some() {
            self.laze(delivered.tick, out);
            return;
        }
        if placing.spots.is_empty() {
            let goal = Goal::of(&turn, &view, Some(placing.zone));
            let f = self.settings.throw_factor;
            placing.spots = placements(&view, placing.zone, &goal, f, &mut self.rng);
            placing.spots.reverse();
        }
        if let Some(position_m) = placing.spots.pop() {
            let zone = placing.zone;
            command(Command::PlaceBall { ball: BallId::CUE, position_m, zone }, out);
        }
        placing.tries += 1;
        self.placing = Some(placing);
        self.due = Some(delivered.tick.after(PLACING_TICKS));
    }

    fn placed(&mut self, ok: bool, delivered: &Delivered, out: &mut Outcome) {
        match &self.placing {
            Some(placing) if ok => {
                self.played_from = Some(placing.zone);
                self.placing = None;
                self.laze(delivered.tick, out);
            }
            Some(_) => self.place_next(delivered, out),
            None => {}
        }
    }

    fn laze(&mut self, now: Tick, out: &mut Outcome) {
        self.reaims = 0;
        self.due = Some(now.after(self.rng.random_range(LAZING_TICKS)));
        self.report(PlayerState::Lazing, out);
    }

    /// Decides once, from above, and begins to lead the cue to the ball.
    fn aim(&mut self, delivered: &Delivered, out: &mut Outcome) {
        let view = self.look(&delivered.table);
        let Some(turn) = self.turn.clone() else {
            self.leave_table(out);
            return;
        };
        let Some(cue_ball) = view.cue_ball else {
            // It is gone, which no rule asks for: put it down again.
            self.leave_table(out);
            self.begin_turn(turn, delivered, out);
            return;
        };

        let goal = Goal::of(&turn, &view, self.played_from);
        let mut plan = plan_shot(&view, cue_ball, &goal, self.settings.throw_factor, &mut self.rng);
        let stroke = self.stroke_for(&mut plan, &view);
        // It is heard long before the tip has come to the ball.
        if let Some(call) = call(&plan, turn.calls) {
            command(Command::Call(call), out);
        }
        self.has_asked = false;
        let from = delivered.table.cue.unwrap_or_else(|| resting_pose(self.id, &self.bed));
        let path = approach(&from, &stroke, delivered.tick.end_s());
        self.plan = Some(plan);
        self.stroke = Some(stroke);
        self.due = path.end_s().map(Tick::containing);
        self.report(PlayerState::Aiming, out);
        move_cue(path, out);
    }

    /// Holds the cue over rails and balls, through the middle of the cue ball, and errs as much as
    /// the settings ask for.
    fn stroke_for(&mut self, plan: &mut Plan, view: &TableView2d) -> Stroke {
        let mut aim = Aim::along(plan.direction);
        let over_rail = (self.clearance)(plan.cue_ball, aim.azimuth_rad);
        aim.elevation_rad = hold::elevation(view, plan.cue_ball, plan.direction, over_rail);
        plan.speed_m_s = hold::tip_speed(plan.speed_m_s, aim.elevation_rad);
        let noise = StrokeNoise::olympiad(self.settings.noise);
        let (aim, speed_m_s) = noise.err(aim, plan.speed_m_s, self.ball_radius_m, &mut self.rng);
        plan.speed_m_s = speed_m_s;
        let centre = plan.cue_ball.extend(self.ball_radius_m);
        Stroke::at_ball(aim.limited(), centre, self.ball_radius_m, plan.speed_m_s)
    }

    fn shoot(&mut self, delivered: &Delivered, out: &mut Outcome) {
        let Some(stroke) = self.stroke else {
            self.leave_table(out);
            return;
        };
        let path = stroke.path(delivered.tick.end_s());
        self.due = path.end_s().map(|end_s| Tick::containing(end_s).after(CONTACT_TICKS));
        self.report(PlayerState::Shooting, out);
        move_cue(path, out);
    }

    /// The stroke met nothing: aims anew, and after a few times collects itself first.
    fn missed(&mut self, delivered: &Delivered, out: &mut Outcome) {
        if self.reaims < REAIMS {
            self.reaims += 1;
            self.aim(delivered, out);
        } else {
            command(Command::LiftCue, out);
            self.report(PlayerState::Idle, out);
            self.laze(delivered.tick, out);
        }
    }

    /// The ball is on its way: takes the cue back before it can touch it again.
    fn withdraw(&mut self, delivered: &Delivered, out: &mut Outcome) {
        let from = delivered.table.cue.or_else(|| self.stroke.map(|stroke| stroke.address()));
        if let Some(from) = from {
            move_cue(withdrawal(&from, delivered.tick.end_s()), out);
        }
        self.due = Some(delivered.tick.after(ANALYZING_TICKS));
        self.report(PlayerState::Analyzing, out);
    }

    /// The shot is over.
    fn finish(&mut self, now: Tick, out: &mut Outcome) {
        command(Command::LiftCue, out);
        self.due = Some(now.after(1));
        self.report(PlayerState::Done, out);
    }

    /// Gives up the turn, if it is at the table at all.
    fn leave_table(&mut self, out: &mut Outcome) {
        match self.state {
            PlayerState::Idle | PlayerState::Done => {}
            PlayerState::Analyzing => {
                command(Command::LiftCue, out);
                self.report(PlayerState::Done, out);
            }
            PlayerState::Lazing | PlayerState::Aiming | PlayerState::Shooting => {
                command(Command::LiftCue, out);
            }
        }
        self.report(PlayerState::Idle, out);
        self.due = None;
        self.placing = None;
        self.played_from = None;
        self.turn = None;
    }

    fn report(&mut self, state: PlayerState, out: &mut Outcome) {
        if self.state != state {
            self.state = state;
            let report = PlayerReport { player: self.id, state };
            out.publish.push(Event::Player(report).into());
        }
    }
}

impl Participant for Player {
    fn source(&self) -> Source {
        Source::Ai(self.id)
    }

    fn topics(&self) -> Topics {
        Topics::of(&[
            Topic::BallPlaced,
            Topic::CueBallStruck,
            Topic::Settled,
            Topic::Verdict,
            Topic::Turn,
        ])
    }

    fn start(&mut self, _table: &Snapshot) -> Outcome {
        Outcome::default()
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        let mut out = Outcome::default();
        for stamped in delivered.events.iter() {
            self.hear(&stamped.event, delivered, &mut out);
        }
        self.go_on(delivered, &mut out);
        out.wake = self.due;
        out
    }

    fn hash(&self, hash: &mut StateHash) {
        hash.u64(self.state as u64);
        hash.u64(self.due.map_or(u64::MAX, |due| due.0));
        hash.u64(u64::from(self.has_asked) << 32 | u64::from(self.reaims));
        let rng = self.rng.state();
        hash.u64(rng as u64);
        hash.u64((rng >> 64) as u64);
        hash.u64(self.played_from.map_or(0, |zone| 1 + zone as u64));
        if let Some(turn) = &self.turn {
            hash.u64(u64::from(turn.shot_number));
            hash.u64(turn.shot as u64);
            hash.u64(turn.ball_in_hand as u64);
            hash.u64(u64::from(turn.groups.is_some()));
            turn.legal_first.iter().for_each(|ball| hash.u64(u64::from(ball.0)));
            turn.options.iter().for_each(|choice| hash.u64(1 + *choice as u64));
        }
        if let Some(placing) = &self.placing {
            hash.u64(1 + placing.zone as u64);
            hash.u64(u64::from(placing.tries));
            hash.u64(placing.spots.len() as u64);
            placing.spots.iter().for_each(|spot| hash.vec3(spot.extend(0.0)));
        }
        if let Some(stroke) = &self.stroke {
            hash.vec3(stroke.contact);
            hash.vec3(stroke.aim.direction());
            hash.f64(stroke.speed_m_s);
        }
    }
}

fn command(command: Command, out: &mut Outcome) {
    out.publish.push(Event::Command(command).into());
}

fn move_cue(path: CuePath, out: &mut Outcome) {
    command(Command::MoveCue(Arc::new(path)), out);
}
