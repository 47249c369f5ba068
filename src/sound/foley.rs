//! Foley: what physics saw becomes what is heard.
//!
//! It hears facts and sees snapshots, in the order of their times. A fact says when, where and how
//! fast; the snapshots around it say along which line, and what nobody told: which balls roll or
//! slide, and where one that hopped met the cloth again.

use super::{Onset, ROLLING_MAX, Rolling, SoundClass};
use crate::ball::{BallPlace, BallState, Motion, POOL_RADIUS_M};
use crate::events::{Fact, FactKind, Topic, Topics};
use crate::ids::BallId;
use crate::physics::Snapshot;
use crate::units::Seconds;
use glam::{DVec3, Vec3};
use smallvec::SmallVec;
use std::sync::Arc;

/// A slower landing is not heard: balls hop a little from every cushion [m/s].
const LANDING_M_S: f64 = 0.08;
/// A slower ball is not heard to roll [m/s].
const ROLLING_M_S: f64 = 0.01;
/// Slower than this over the cloth counts as rolling [m/s].
const SLIP_M_S: f64 = 0.005;
/// When a ball that fell into a pocket begins to run through the gully [s].
const GULLY_AFTER_S: Seconds = 0.3;
/// When the next player chalks the tip, after everything has settled [s].
const CHALK_AFTER_S: Seconds = 0.9;
/// Sounds that are still to come, at most: balls on their way to the gully, chalk.
const LATER_MAX: usize = 32;
/// How fast a ball meets the floor that nobody saw fall [m/s]: from the height of a bed, 0.76 m.
const FLOOR_M_S: f64 = 3.9;
/// Snapshots farther from a fact say nothing about it [s].
const FAR_S: Seconds = 0.05;

/// Onsets between two snapshots.
pub type Onsets = SmallVec<[Onset; 4]>;
/// The balls that roll.
pub type Rollings = SmallVec<[Rolling; 16]>;

/// Turns facts and snapshots into what a mixer is told.
#[derive(Debug, Clone)]
pub struct Foley {
    /// Radius of each ball [m], in ascending order of id.
    radii: Vec<(BallId, f64)>,
    gravity_m_s2: f64,
    seed: u64,
    before: Arc<Snapshot>,
    /// Those that were heard to roll when last looked at, in ascending order.
    rolled: SmallVec<[BallId; 16]>,
    later: Vec<Onset>,
    /// Where each ball was last told to touch something [m], in ascending order of id.
    touched_m: Vec<(BallId, DVec3)>,
}

impl Foley {
    /// What it hears.
    pub const TOPICS: Topics = Topics::of(&[
        Topic::CueBallStruck,
        Topic::BallsCollided,
        Topic::CushionHit,
        Topic::BallPocketed,
        Topic::BallOffTable,
        Topic::Settled,
    ]);

    /// For these balls with their radii [m]. `first` is the world before the first fact; `seed`
    /// fixes what no two hits have in common.
    pub fn new(
        radii: impl IntoIterator<Item = (BallId, f64)>,
        gravity_m_s2: f64,
        seed: u64,
        first: Arc<Snapshot>,
    ) -> Self {
        let mut radii: Vec<_> = radii.into_iter().collect();
        radii.sort_by_key(|(id, _)| *id);
        Foley {
            radii,
            gravity_m_s2,
            seed,
            before: first,
            rolled: SmallVec::new(),
            later: Vec::new(),
            touched_m: Vec::new(),
        }
    }

    /// What a fact sounds like. `after` is the first snapshot at or behind it, if there is one.
    ///
    /// A ball that no snapshot shows falls where it last touched something, or in the middle of the
    /// table.
    pub fn hear(&mut self, fact: &Fact, after: Option<&Snapshot>) -> Option<Onset> {
        let at = fact.time_s;
        let away = |ball, point| self.away(ball, point, at, after);
        let (class, speed, position, axis) = match fact.kind {
            FactKind::CueBallStruck { ball, position_m, normal_speed_m_s, miscue, .. } => {
                let class = if miscue { SoundClass::Miscue } else { SoundClass::CueStrike };
                (class, normal_speed_m_s, position_m, away(ball, position_m))
            }
            FactKind::BallsCollided { a, b, position_m, normal_speed_m_s, .. } => {
                let axis = (away(b, position_m) - away(a, position_m)).normalize_or_zero();
                (SoundClass::BallClick, normal_speed_m_s, position_m, axis)
            }
            FactKind::CushionHit { ball, position_m, normal_speed_m_s, .. } => {
                (SoundClass::Cushion, normal_speed_m_s, position_m, away(ball, position_m))
            }
            FactKind::BallPocketed { ball, speed_m_s, .. } => {
                let seen = after.and_then(|after| after.ball(ball)).or(self.before.ball(ball));
                let position = seen.map_or_else(|| self.last_touch(ball), |state| state.position);
                (SoundClass::Pocket, speed_m_s, position, DVec3::ZERO)
            }
            FactKind::BallOffTable { ball } => {
                // One that came to rest beside the bed is slow, and so is silent.
                let seen = self.before.ball(ball);
                let flown = seen.map(|state| self.flown(state, at - self.before.time_s));
                let (speed, position) = match flown {
                    Some(state) => ((-state.velocity.z).max(0.0), state.position),
                    None => (FLOOR_M_S, self.last_touch(ball)),
                };
                (SoundClass::Floor, speed, position, DVec3::NEG_Z)
            }
            FactKind::BallPlaced { .. }
            | FactKind::HeadStringCrossed { .. }
            | FactKind::BallTouched { .. }
            | FactKind::BallsFrozen { .. } => return None,
            FactKind::Settled { .. } => {
                self.chalk(at, after);
                return None;
            }
        };
        self.touch(&fact.kind);
        let onset = self.onset(at, class, speed, position, axis);
        if class == SoundClass::Pocket && self.later.len() < LATER_MAX {
            let at = at + GULLY_AFTER_S;
            self.later.push(self.onset(at, SoundClass::Gully, speed, position, axis));
        }
        Some(onset)
    }

    /// Keeps where the balls of a contact are.
    fn touch(&mut self, kind: &FactKind) {
        let (balls, position_m) = match *kind {
            FactKind::CueBallStruck { ball, position_m, .. }
            | FactKind::CushionHit { ball, position_m, .. } => ([ball; 2], position_m),
            FactKind::BallsCollided { a, b, position_m, .. } => ([a, b], position_m),
            _ => return,
        };
        for ball in balls {
            match self.touched_m.binary_search_by_key(&ball, |(id, _)| *id) {
                Ok(place) => self.touched_m[place].1 = position_m,
                Err(place) => self.touched_m.insert(place, (ball, position_m)),
            }
        }
    }

    /// Where a ball last touched something, else the middle of the table [m].
    fn last_touch(&self, ball: BallId) -> DVec3 {
        let place = self.touched_m.binary_search_by_key(&ball, |(id, _)| *id);
        place.map_or(DVec3::ZERO, |place| self.touched_m[place].1)
    }

    /// Before about every other shot the tip is chalked, where the cue is.
    fn chalk(&mut self, settled_s: Seconds, after: Option<&Snapshot>) {
        let Some(cue) = after.and_then(|after| after.cue).or(self.before.cue) else { return };
        let at = settled_s + CHALK_AFTER_S;
        let onset = self.onset(at, SoundClass::Chalk, 0.0, cue.tip, DVec3::ZERO);
        if onset.seed.is_multiple_of(2) && self.later.len() < LATER_MAX {
            self.later.push(onset);
        }
    }

    /// What nobody told and the next snapshot shows: landings, balls that have come to the gully,
    /// in the order of their times; then the balls that roll, and those that have just stopped. One
    /// that is not newer than the one before shows nothing.
    pub fn see(&mut self, snapshot: &Arc<Snapshot>) -> (Onsets, Rollings) {
        if snapshot.time_s <= self.before.time_s {
            return (Onsets::new(), Rollings::new());
        }
        let mut onsets: Onsets =
            snapshot.balls.iter().filter_map(|ball| self.landing(ball, snapshot.time_s)).collect();
        let due = |onset: &Onset| onset.time_s <= snapshot.time_s;
        onsets.extend(self.later.iter().copied().filter(due));
        self.later.retain(|onset| !due(onset));
        onsets.sort_by(|a, b| a.time_s.total_cmp(&b.time_s));
        self.before = snapshot.clone();
        (onsets, self.rollings(snapshot))
    }

    /// What is still to come when nothing more is seen.
    pub fn rest(&mut self) -> Vec<Onset> {
        std::mem::take(&mut self.later)
    }

    fn onset(
        &self,
        time_s: Seconds,
        class: SoundClass,
        speed: f64,
        position: DVec3,
        axis: DVec3,
    ) -> Onset {
        // Of what happened alone, so that it sounds the same whenever it is heard again.
        let parts = [time_s, position.x, position.y, position.z];
        let seed = parts.iter().fold(self.seed ^ class as u64, |seed, part| mixed(seed, *part));
        Onset {
            time_s,
            class,
            speed_m_s: speed as f32,
            position_m: position.as_vec3(),
            axis: axis.as_vec3(),
            seed: (seed >> 32) as u32,
        }
    }

    fn radius_m(&self, ball: BallId) -> f64 {
        let place = self.radii.binary_search_by_key(&ball, |(id, _)| *id);
        place.map_or(POOL_RADIUS_M, |place| self.radii[place].1)
    }

    /// Unit vector from the point of a contact to the centre of a ball at the time of that contact.
    ///
    /// Both snapshots know the centre, up to what other contacts did in between; of these two the
    /// one is right whose centre is a radius from the point.
    fn away(&self, ball: BallId, point_m: DVec3, at: Seconds, after: Option<&Snapshot>) -> DVec3 {
        let radius_m = self.radius_m(ball);
        let known = [Some(&*self.before), after].into_iter().flatten();
        let lever = known
            .filter_map(|seen| {
                let (state, span_s) = (seen.ball(ball)?, at - seen.time_s);
                let lever = state.position + state.velocity * span_s - point_m;
                (span_s.abs() <= FAR_S).then_some(lever)
            })
            .min_by(|a, b| {
                let miss = |lever: &DVec3| (lever.length() - radius_m).abs();
                miss(a).total_cmp(&miss(b))
            });
        lever.map_or(DVec3::ZERO, |lever| lever.normalize_or_zero())
    }

    /// A ball that flies, `span_s` later.
    fn flown(&self, ball: &BallState, span_s: Seconds) -> BallState {
        let fall = DVec3::NEG_Z * self.gravity_m_s2;
        BallState {
            position: ball.position + ball.velocity * span_s + fall * (0.5 * span_s * span_s),
            velocity: ball.velocity + fall * span_s,
            ..*ball
        }
    }

    /// The landing of a ball that flew in the snapshot before, on the bed at z = 0 until `now`.
    fn landing(&self, ball: &BallState, now: Seconds) -> Option<Onset> {
        let flying = self.before.ball(ball.id).filter(|before| {
            before.motion == Motion::Airborne
                && before.place == BallPlace::OnTable
                && ball.place == BallPlace::OnTable
        })?;
        let (g, rise) = (self.gravity_m_s2, flying.velocity.z);
        let height = flying.position.z - self.radius_m(ball.id);
        if height < 0.0 || g <= 0.0 {
            return None;
        }
        let span_s = (rise + (rise * rise + 2.0 * g * height).sqrt()) / g;
        let landed = self.flown(flying, span_s);
        // A ball that still flies on is over the bed no longer than the arc says.
        let stopped = ball.velocity.z > landed.velocity.z + 0.5 * LANDING_M_S;
        let is_in_time = self.before.time_s + span_s <= now;
        (is_in_time && stopped && LANDING_M_S < -landed.velocity.z).then(|| {
            let foot = landed.position - DVec3::Z * self.radius_m(ball.id);
            let (at, speed) = (self.before.time_s + span_s, -landed.velocity.z);
            self.onset(at, SoundClass::Landing, speed, foot, DVec3::Z)
        })
    }

    fn rollings(&mut self, snapshot: &Snapshot) -> Rollings {
        let is_heard = |ball: &&BallState| {
            matches!(ball.motion, Motion::Rolling | Motion::Sliding)
                && ROLLING_M_S < ball.velocity.length()
        };
        let mut heard: SmallVec<[&BallState; 16]> = snapshot.on_table().filter(is_heard).collect();
        heard.sort_by(|a, b| b.velocity.length().total_cmp(&a.velocity.length()));
        // The fastest, if there are more than can be heard.
        heard.truncate(ROLLING_MAX);
        let mut rollings: Rollings = heard.iter().map(|ball| self.rolling(ball)).collect();
        let rolled = std::mem::take(&mut self.rolled);
        let stopped = rolled.iter().filter(|id| heard.iter().all(|ball| ball.id != **id));
        rollings.extend(stopped.filter_map(|id| snapshot.ball(*id)).map(|ball| Rolling {
            velocity_m_s: Vec3::ZERO,
            slip_m_s: 0.0,
            ..self.rolling(ball)
        }));
        self.rolled = heard.iter().map(|ball| ball.id).collect();
        rollings
    }

    fn rolling(&self, ball: &BallState) -> Rolling {
        let radius_m = self.radius_m(ball.id);
        let lever = DVec3::NEG_Z * radius_m;
        let slip = (ball.velocity + ball.angular_velocity.cross(lever)).truncate().length();
        Rolling {
            ball: ball.id,
            radius_m: radius_m as f32,
            position_m: ball.position.as_vec3(),
            velocity_m_s: ball.velocity.as_vec3(),
            slip_m_s: if slip < SLIP_M_S { 0.0 } else { slip as f32 },
        }
    }
}

/// The finish of SplitMix64 (Steele, Lea and Flood 2014) over a seed and a number's bits.
fn mixed(seed: u64, number: f64) -> u64 {
    let mut z = (seed ^ number.to_bits()).wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
