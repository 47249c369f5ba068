//! A ball of the exact solver: its segment, what it lies on, and what will happen to it.

use super::segment::{Course, Segment};
use super::sweep::Meeting;
use super::terrain::Feature;
use crate::ball::{Ball, BallPlace, BallState};
use crate::hash::StateHash;
use crate::physics::laws::Mover;
use crate::units::Seconds;
use glam::DVec3;
use smallvec::SmallVec;

/// What ends a ball's segment, if nobody else does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Own {
    /// Its law ends by itself [s].
    Ends(Seconds),
    /// It meets the terrain, or leaves what carries it.
    Meets(Meeting),
}

/// What is only told when it happens.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Report {
    /// The base crosses the head string towards the foot.
    HeadString,
    /// The ball sinks below the bed.
    Depth,
}

/// A ball.
#[derive(Debug, Clone)]
pub struct Body {
    /// What it is made of.
    pub ball: Ball,
    /// How it moves now.
    pub segment: Segment,
    /// How it moved before; somebody may look a little back.
    before: Segment,
    /// Where it is in the game's sense.
    pub place: BallPlace,
    /// Where it was before, and since when it is where it is now.
    placed: (BallPlace, Seconds),
    /// What it lies on.
    pub held: SmallVec<[Feature; 2]>,
    /// What ends its segment.
    pub own: Own,
    /// What is told next, and when.
    pub report: (Seconds, Report),
    /// Its base is on the head string or behind it, and has not crossed since.
    pub behind: bool,
    /// Rails that it has been away from since it last touched them, a bit each.
    pub clear_rails: u8,
    /// Rails that it has touched and not parted from, a bit each.
    pub held_rails: u8,
    /// Since when contacts are counted, and how many there were.
    pub busy: (Seconds, u32),
    /// The part of the terrain that it met last.
    pub met: Option<Feature>,
    /// In lasting contact: what else it met, and when [s].
    pub brushed: Option<(Feature, Seconds)>,
    /// It sleeps on several supports or on other balls, and wakes when one of them changes.
    pub leans: bool,
    /// In lasting contact: since when it lies nearly still [s].
    pub quiet_since: Seconds,
    /// In lasting contact: mechanical energy that it should have at the next step [J].
    pub target_j: f64,
}

impl Body {
    /// A ball in the given state.
    pub fn new(ball: Ball, state: &BallState) -> Self {
        let still = Segment::still(0.0, state.position, state.orientation.normalize());
        let segment = Segment {
            velocity: state.velocity,
            angular_velocity: state.angular_velocity,
            course: Course::Flying,
            ..still
        };
        Body {
            ball,
            segment,
            before: segment,
            place: state.place,
            placed: (state.place, 0.0),
            held: SmallVec::new(),
            own: Own::Ends(f64::INFINITY),
            report: (f64::INFINITY, Report::HeadString),
            behind: false,
            clear_rails: 0,
            held_rails: 0,
            busy: (0.0, 0),
            met: None,
            brushed: None,
            leans: false,
            quiet_since: 0.0,
            target_j: 0.0,
        }
    }

    /// Whether it takes part in the simulation.
    pub fn in_play(&self) -> bool {
        self.place == BallPlace::OnTable
    }

    /// Whether it touches other things.
    pub fn solid(&self) -> bool {
        self.in_play() && self.ball.flags.collide
    }

    /// Whether it neither moves nor will by itself.
    pub fn is_still(&self) -> bool {
        let s = &self.segment;
        !self.in_play()
            || s.course == Course::Rest
            || s.swing.is_none()
                && s.velocity == DVec3::ZERO
                && s.acceleration == DVec3::ZERO
                && s.angular_velocity == DVec3::ZERO
    }

    /// Whether its centre stays where it is.
    pub fn stands(&self) -> bool {
        let s = &self.segment;
        !s.swings() && s.velocity == DVec3::ZERO && s.acceleration == DVec3::ZERO
    }

    /// As the contact laws see it at `at`.
    pub fn mover(&self, at: Seconds) -> Mover {
        let s = &self.segment;
        Mover::new(&self.ball, s.velocity_at(at), s.angular_velocity_at(at))
    }

    /// What it met just now besides what it lies on. To the last bit that may lie beyond the end
    /// of it, and then it would be met again and again at one moment.
    pub fn brushes(&self, at: Seconds) -> Option<Feature> {
        self.brushed.filter(|(_, met)| *met == at).map(|(feature, _)| feature)
    }

    /// When its own event comes [s].
    pub fn own_s(&self) -> Seconds {
        match self.own {
            Own::Ends(at) => at,
            Own::Meets(meeting) => meeting.at,
        }
    }

    /// When anything happens to it that no other ball has a part in [s].
    pub fn alone_s(&self) -> Seconds {
        self.own_s().min(self.report.0)
    }

    /// Speed, or speed of its skin if it spins faster, at `at` [m/s].
    pub fn liveliness(&self, at: Seconds) -> f64 {
        let s = &self.segment;
        s.velocity_at(at).length().max(s.angular_velocity_at(at).length() * self.ball.radius_m)
    }

    /// Goes on along another segment.
    pub fn turn_into(&mut self, segment: Segment) {
        self.before = self.segment;
        self.segment = segment;
    }

    /// Changes where it is in the game's sense.
    pub fn put(&mut self, place: BallPlace, at: Seconds) {
        self.placed = (self.place, at);
        self.place = place;
    }

    /// The state at a time not long before the one reached.
    pub fn sample(&self, at: Seconds) -> BallState {
        let early = at < self.segment.start_s && self.before.start_s <= at;
        let segment = if early { &self.before } else { &self.segment };
        let place = if at < self.placed.1 { self.placed.0 } else { self.place };
        segment.state(self.ball.id, place, at.max(segment.start_s))
    }

    /// Adds everything that decides its future to `hash`; it meets another ball at `pair_s`.
    pub fn hash(&self, pair_s: Seconds, hash: &mut StateHash) {
        hash.u64(u64::from(self.ball.id.0));
        hash.u64(self.place as u64);
        let rails = u64::from(self.clear_rails) << 8 | u64::from(self.held_rails);
        hash.u64(rails << 1 | u64::from(self.behind));
        self.segment.hash(hash);
        hash.f64(pair_s);
        hash.f64(self.own_s());
    }
}
