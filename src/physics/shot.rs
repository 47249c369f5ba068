//! A stroke in the language of players, and what came of it.

use super::event_driven::Segment;
use super::fixed_step::{Knot, between};
use super::{Ledger, PhysicsError, Simulation, Work};
use crate::ball::{BallPlace, BallState};
use crate::cue::{Aim, CuePath, CuePiece};
use crate::events::Fact;
use crate::ids::BallId;
use crate::units::Seconds;
use glam::DVec3;

/// The tip sets out this far from the ball [m].
const RUN_UP_M: f64 = 0.005;

/// A slower tip would take more than five seconds for its run-up [m/s].
const SPEED_LEAST_M_S: f64 = 0.001;

/// After the contact the tip brakes for this long, then the cue is lifted [s].
const FOLLOW_THROUGH_S: Seconds = 0.02;

/// A stroke at the cue ball.
///
/// Draw: struck below its middle, the cue ball comes back from the ball it hits.
///
/// ```
/// use glam::DVec3;
/// use hapticbillard::ball::{Ball, BallState, POOL_RADIUS_M};
/// use hapticbillard::ids::BallId;
/// use hapticbillard::physics::{PhysicsSettings, Simulation, Strike};
/// use hapticbillard::table::Table;
///
/// let one = BallId(1);
/// let balls = [(BallId::CUE, 0.0), (one, 0.5)].map(|(id, x)| {
///     (Ball::pool(id), BallState::at_rest(id, DVec3::new(x, 0.0, POOL_RADIUS_M)))
/// });
/// let start =
///     Simulation::from_parts(&Table::plane(), balls.to_vec(), &PhysicsSettings::default())?;
/// let draw = Strike { speed_m_s: 3.0, height_offset: -0.5, ..Strike::CENTRE };
/// let end = start.strike(draw)?.run_until_rest()?.end;
/// let x = |id| end.sample(id, end.now_s()).map(|ball| ball.position.x);
/// assert!(x(BallId::CUE) < Some(0.3) && Some(1.0) < x(one));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strike {
    /// Speed of the tip at the contact [m/s].
    pub speed_m_s: f64,
    /// Direction on the table [°]: 0 towards the foot (+x), 90 to the left (+y).
    pub azimuth_deg: f64,
    /// How steeply the cue points down [°].
    pub elevation_deg: f64,
    /// Where the tip hits the ball, from its middle to the right as the player sees it, over the
    /// ball's radius.
    pub side_offset: f64,
    /// The same upwards: positive makes follow, negative draw.
    pub height_offset: f64,
}

impl Default for Strike {
    fn default() -> Self {
        Strike::CENTRE
    }
}

impl Strike {
    /// A level stroke through the middle, towards the foot, at 1 m/s.
    pub const CENTRE: Strike = Strike {
        speed_m_s: 1.0,
        azimuth_deg: 0.0,
        elevation_deg: 0.0,
        side_offset: 0.0,
        height_offset: 0.0,
    };

    /// The stroke of a cue that is held so, at this speed of the tip [m/s].
    pub fn held(aim: &Aim, speed_m_s: f64) -> Self {
        const DEGREE: f64 = core::f64::consts::PI / 180.0;
        let aim = aim.limited();
        Strike {
            speed_m_s,
            azimuth_deg: aim.azimuth_rad / DEGREE,
            elevation_deg: aim.elevation_rad / DEGREE,
            side_offset: aim.side_offset,
            height_offset: aim.height_offset,
        }
    }

    /// Unit vector along the shaft, from butt to tip.
    pub fn direction(&self) -> DVec3 {
        let radians = |degrees: f64| degrees * (core::f64::consts::PI / 180.0);
        let (sin_a, cos_a) = libm::sincos(radians(self.azimuth_deg));
        let (sin_e, cos_e) = libm::sincos(radians(self.elevation_deg));
        DVec3::new(cos_e * cos_a, cos_e * sin_a, -sin_e)
    }

    /// The path of a tip of radius `tip_radius_m` that makes this stroke at a ball at `ball` [m] of
    /// radius `radius_m`, from `start_s` on: straight along the shaft at constant speed, and braked
    /// after the contact.
    pub fn path(
        &self,
        ball: DVec3,
        radius_m: f64,
        tip_radius_m: f64,
        start_s: Seconds,
    ) -> Result<CuePath, PhysicsError> {
        let Strike { speed_m_s: speed, side_offset: side, height_offset: height, .. } = *self;
        if !(speed.is_finite() && SPEED_LEAST_M_S <= speed) {
            let allowed = "the tip's speed must be at least 0.001 m/s";
            return Err(PhysicsError::Setting { key: "speed_m_s", value: speed, allowed });
        }
        for (key, value) in
            [("azimuth_deg", self.azimuth_deg), ("elevation_deg", self.elevation_deg)]
        {
            if !value.is_finite() {
                let allowed = "an angle must be a number";
                return Err(PhysicsError::Setting { key, value, allowed });
            }
        }
        let offset = (side * side + height * height).sqrt();
        if !(offset < 1.0) {
            return Err(PhysicsError::Miss { offset });
        }

        let direction = self.direction();
        let radians = self.azimuth_deg * (core::f64::consts::PI / 180.0);
        let (sin, cos) = libm::sincos(radians);
        let right = DVec3::new(sin, -cos, 0.0);
        let up = right.cross(direction);
        let behind = (1.0 - offset * offset).sqrt();
        // From the ball's centre to where the tip's centre is at the contact.
        let outwards = right * side + up * height - direction * behind;
        let contact = ball + outwards * (radius_m + tip_radius_m);

        let run_up_s = RUN_UP_M / speed;
        let velocity = direction * speed;
        let piece = |start_s, duration_s, position, acceleration| CuePiece {
            start_s,
            duration_s,
            position,
            velocity,
            acceleration,
            direction,
            direction_end: direction,
        };
        let braking = velocity * (-1.0 / FOLLOW_THROUGH_S);
        let pieces = [
            piece(start_s, run_up_s, contact - direction * RUN_UP_M, DVec3::ZERO),
            piece(start_s + run_up_s, FOLLOW_THROUGH_S, contact, braking),
        ];
        Ok(CuePath { solid: true, pieces: pieces.into_iter().collect() })
    }
}

/// What came of a stroke.
///
/// ```
/// use hapticbillard::events::FactKind;
/// use hapticbillard::ids::BallId;
/// use hapticbillard::physics::{Simulation, Strike};
/// use hapticbillard::rack::Rack;
/// use hapticbillard::table::Table;
///
/// let start = Simulation::new(Table::preset("pool-9ft")?, Rack::nine_ball(1))?;
/// let shot = start.strike(Strike { speed_m_s: 8.0, ..Strike::CENTRE })?.run_until_rest()?;
///
/// // Facts are in time order and know their time exactly.
/// let hit = |kind: &FactKind| matches!(kind, FactKind::BallsCollided { a: BallId::CUE, .. });
/// let first = shot.facts.iter().find(|fact| hit(&fact.kind)).ok_or("no ball was hit")?;
/// let cue_ball = shot.trajectory(BallId::CUE).at(first.time_s).ok_or("no cue ball")?;
/// println!("{:.4} s: {} m/s after the first contact", first.time_s, cue_ball.velocity.length());
/// # assert!(cue_ball.velocity.length() > 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Shot {
    /// What happened, in time order.
    pub facts: Vec<Fact>,
    /// When everything had settled [s].
    pub end_s: Seconds,
    /// Energy and momentum.
    pub ledger: Ledger,
    /// What was computed.
    pub work: Work,
    /// The world after the shot.
    pub end: Simulation,
    pub(super) ids: Vec<BallId>,
    pub(super) tracks: Tracks,
}

/// Where the balls went, in the order of their ids.
#[derive(Debug, Clone)]
pub(super) enum Tracks {
    /// Straight from grid time to grid time, and broken where a ball touched something.
    Knots(Vec<Vec<Knot>>),
    /// Exactly.
    Segments(Vec<Vec<Segment>>),
}

impl Shot {
    /// Where a ball went; empty if nobody knows it.
    pub fn trajectory(&self, ball: BallId) -> Trajectory<'_> {
        let place = self.ids.binary_search(&ball).ok();
        let track = match &self.tracks {
            Tracks::Knots(tracks) => {
                Track::Knots(place.and_then(|place| tracks.get(place)).map_or(&[], |t| t))
            }
            Tracks::Segments(tracks) => {
                Track::Segments(place.and_then(|place| tracks.get(place)).map_or(&[], |t| t))
            }
        };
        Trajectory { ball, track, end_s: self.end_s }
    }
}

/// The way of one ball.
#[derive(Debug, Clone, Copy)]
pub struct Trajectory<'a> {
    ball: BallId,
    track: Track<'a>,
    end_s: Seconds,
}

#[derive(Debug, Clone, Copy)]
enum Track<'a> {
    Knots(&'a [Knot]),
    Segments(&'a [Segment]),
}

impl<'a> Trajectory<'a> {
    /// When it begins [s]; none if it is empty.
    fn start_s(&self) -> Option<Seconds> {
        match self.track {
            Track::Knots(knots) => knots.first().map(|knot| knot.time_s),
            Track::Segments(segments) => segments.first().map(|segment| segment.start_s),
        }
    }

    /// The state at a time; none outside of the shot.
    pub fn at(&self, time_s: Seconds) -> Option<BallState> {
        let start = self.start_s()?;
        match self.track {
            Track::Knots(knots) => {
                let last = knots.last()?;
                if !(start <= time_s && time_s <= last.time_s) {
                    return None;
                }
                let next = knots.partition_point(|knot| knot.time_s <= time_s);
                let from = &knots[next.saturating_sub(1)];
                let to = knots.get(next).unwrap_or(from);
                Some(between(self.ball, from, to, time_s))
            }
            Track::Segments(segments) => {
                if !(start <= time_s && time_s <= self.end_s) {
                    return None;
                }
                let next = segments.partition_point(|segment| segment.start_s <= time_s);
                let segment = &segments[next.saturating_sub(1)];
                Some(segment.state(self.ball, BallPlace::OnTable, time_s))
            }
        }
    }

    /// States every `dt` seconds, from the start to the end of the shot.
    pub fn every(self, dt: Seconds) -> impl Iterator<Item = BallState> + 'a {
        let start = self.start_s().unwrap_or(0.0);
        let counts = if dt > 0.0 { 0..u64::MAX } else { 0..0 };
        counts.map_while(move |n| self.at(start + n as f64 * dt))
    }
}
