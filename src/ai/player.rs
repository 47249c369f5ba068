//! The computer player in its turn: IDLE, LAZING, AIMING, SHOOTING, ANALYZING, DONE (paper,
//! section 5.4).
//!
//! It acts by commands alone and waits for nothing without a wake, so it never stalls: what does
//! not happen in time is tried again. All levels go through the same states and strike alike. The
//! paper's player decides at the end of its pause, from what lies there; the others ask their
//! [`Mind`] at its beginning, and decide as the paper's does where that finds nothing.

mod hear;
mod search;
mod strike;
mod turn;

use super::hold::Clearance;
use super::mind::{Deliberation, Mind};
use super::plan::Plan;
use super::settings::PlayerSettings;
use super::stroke::Stroke;
use super::thinker::Thinker;
use super::view::TableView2d;
use crate::events::{Command, Event, PlayerReport, PlayerState, Source, Topic, Topics, Turn, Zone};
use crate::hash::StateHash;
use crate::ids::{BallId, PlayerId};
use crate::physics::Snapshot;
use crate::rules::{self, Referee};
use crate::table::{Bed, Pocket};
use crate::tick::{Delivered, Outcome, Participant};
use crate::units::Tick;
use glam::DVec2;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use search::Search;
use std::fmt;
use std::sync::Arc;

/// The pause before a turn [ticks].
const LAZING_TICKS: std::ops::RangeInclusive<u64> = 400..=1200;

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
    /// Who searches; the paper's player does not.
    search: Option<Search>,

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
            .field("level", &self.settings.level)
            .field("state", &self.state)
            .field("due", &self.due)
            .field("plan", &self.plan)
            .finish_non_exhaustive()
    }
}

impl Player {
    /// A player who waits for a turn on this table, and plays as the paper's.
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
            search: None,
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

    /// The same who searches. `referee` is that of the game, before the game: the player leads its
    /// own from there by what everybody hears.
    #[must_use]
    pub fn with_mind(mut self, mind: Arc<Mind>, referee: Referee) -> Self {
        self.search = Some(Search::new(mind, referee));
        self
    }

    /// The same whose thinking is done by `thinker`; nothing changes for a player without a mind.
    #[must_use]
    pub fn with_thinker(mut self, thinker: Arc<dyn Thinker>) -> Self {
        self.search = self.search.map(|search| search.with_thinker(thinker));
        self
    }

    /// What distinguishes it from others.
    pub fn settings(&self) -> &PlayerSettings {
        &self.settings
    }

    /// Where the player stands in its turn.
    pub fn state(&self) -> PlayerState {
        self.state
    }

    /// What it decided in this turn by geometry alone, with the ways it examined.
    pub fn plan(&self) -> Option<&Plan> {
        self.plan.as_ref()
    }

    /// What its search has answered in this turn, if it has one.
    pub fn deliberation(&self) -> Option<&Arc<Deliberation>> {
        self.search.as_ref()?.deliberation()
    }

    /// How it is going to strike, or has struck, in this turn.
    pub fn stroke(&self) -> Option<&Stroke> {
        self.stroke.as_ref()
    }

    /// The ball that it strikes.
    fn cue_ball(&self) -> BallId {
        self.turn.as_ref().map_or(BallId::CUE, |turn| turn.cue_ball)
    }

    fn look(&self, table: &Snapshot) -> TableView2d {
        let cue_ball = self.cue_ball();
        TableView2d::with_cue_ball(table, cue_ball, &self.bed, &self.pockets, self.ball_radius_m)
    }

    /// How long the next pause is.
    fn pause_ticks(&mut self) -> u64 {
        self.rng.random_range(LAZING_TICKS)
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
        let own = Topics::of(&[
            Topic::BallPlaced,
            Topic::CueBallStruck,
            Topic::Settled,
            Topic::Verdict,
            Topic::Turn,
        ]);
        match &self.search {
            None => own,
            // Who looks ahead must know how the game stands, as far as anybody can know it.
            Some(search) => {
                let heard = rules::topics(search.game()).or(Topics::of(&[Topic::Command]));
                own.or(heard)
            }
        }
    }

    fn start(&mut self, table: &Snapshot) -> Outcome {
        if let Some(search) = &mut self.search {
            search.start(table);
        }
        Outcome::default()
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        let mut out = Outcome::default();
        if let Some(search) = &mut self.search {
            search.hear(delivered);
        }
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
        if let Some(search) = &self.search {
            search.hash(hash);
        }
    }
}

fn command(command: Command, out: &mut Outcome) {
    out.publish.push(Event::Command(command).into());
}
