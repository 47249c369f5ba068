//! Carom: both other balls, the second after some cushions. Ways are tried, not solved for.

use super::chance::{CAROM_RAD, CUSHION_RAD, both, gain};
use super::cushion::cushions;
use super::pot::chance;
use super::way::Window;
use super::{Idea, IdeaKind, Position, line};
use crate::ai::geometry::{signed_angle, turned};
use crate::ai::plan::LineEnd;
use crate::ai::speed::{BALL_PER_TIP_SPEED, launch_by_cushions};
use crate::ids::BallId;
use glam::DVec2;
use smallvec::SmallVec;

/// Cuts that are tried on a ball that is met directly; evenly spaced distances of its middle from
/// the way.
const CUTS: i32 = 31;
/// Directions that are tried by a cushion first.
const AZIMUTHS: u32 = 480;
/// Most cushions before the first ball.
const CUSHIONS_BEFORE: usize = 3;
/// Most cushions in all.
const CUSHIONS: usize = 6;
/// The cue ball's spin at the first ball, over that of rolling, and the height of the tip that
/// makes about that.
const SPINS: [(f64, f64); 3] = [(1.0, 0.4), (0.0, -0.1), (-0.7, -0.4)];
/// Harder strokes are not proposed: speed of the tip [m/s].
const TIP_MOST_M_S: f64 = 7.0;
/// Speed that the cue ball shall have when it meets the last ball [m/s].
const ARRIVAL_M_S: f64 = 0.3;

/// Where the cue ball is, where to, and how it got there.
#[derive(Debug, Clone)]
struct Trail {
    points: SmallVec<[DVec2; 8]>,
    direction: DVec2,
}

impl Trail {
    fn new(from: DVec2, direction: DVec2) -> Self {
        Trail { points: SmallVec::from_slice(&[from]), direction }
    }

    fn end(&self) -> DVec2 {
        self.points[self.points.len() - 1]
    }

    fn length_m(&self) -> f64 {
        self.points.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
    }

    /// Goes to the next cushion and is mirrored there; false if there is none.
    fn bounce(&mut self, position: &Position<'_>) -> bool {
        let from = self.end();
        let next = cushions(position)
            .into_iter()
            .filter(|cushion| cushion.at_m * self.direction[cushion.axis] > 1e-9)
            .map(|c| (c.axis, ((c.at_m - from[c.axis]) / self.direction[c.axis]).max(0.0)))
            .reduce(|best, next| if next.1 < best.1 { next } else { best });
        let Some((axis, distance)) = next else { return false };
        self.points.push(from + self.direction * distance);
        self.direction[axis] = -self.direction[axis];
        true
    }

    /// Distance to the ghost at a ball at `at` if that comes before the next cushion [m], and how
    /// far off the ball's middle the way leads, to the left positive [m].
    fn meets(&self, position: &Position<'_>, at: DVec2) -> Option<(f64, f64)> {
        let apart = 2.0 * position.radius();
        let to = at - self.end();
        let (along, aside) = (to.dot(self.direction), self.direction.perp_dot(to));
        let half = (apart * apart - aside * aside).max(0.0).sqrt();
        (along > 0.0 && aside.abs() < apart && along > half).then(|| (along - half, -aside))
    }
}

/// Both balls in either order.
pub(super) fn both_balls(position: &Position<'_>, found: &mut Vec<Idea>) {
    let apart = 2.0 * position.radius();
    for (first, at) in position.lying(&position.goal.legal) {
        let distance = position.cue.distance(at);
        let Some(full) = (at - position.cue).try_normalize() else { continue };
        for step in -(CUTS / 2)..=CUTS / 2 {
            let aside = apart * 0.97 * f64::from(step) / f64::from(CUTS / 2);
            let turn = libm::asin((aside / distance.max(apart)).clamp(-1.0, 1.0));
            follow(position, first, at, Trail::new(position.cue, turned(full, turn)), found);
        }
        for step in 0..AZIMUTHS {
            let azimuth = std::f64::consts::TAU * f64::from(step) / f64::from(AZIMUTHS);
            let mut trail = Trail::new(position.cue, turned(DVec2::X, azimuth));
            for _ in 0..CUSHIONS_BEFORE {
                if nearest(position, &trail).is_some() || !trail.bounce(position) {
                    break;
                }
                follow(position, first, at, trail.clone(), found);
            }
        }
    }
}

/// The ball that a trail meets before its next cushion.
fn nearest(position: &Position<'_>, trail: &Trail) -> Option<BallId> {
    position
        .view
        .balls
        .iter()
        .filter_map(|ball| Some((ball.id, trail.meets(position, ball.position)?.0)))
        .reduce(|best, next| if next.1 < best.1 { next } else { best })
        .map(|(ball, _)| ball)
}

/// If the trail meets `first` next: where the cue ball goes from there with each spin.
fn follow(position: &Position<'_>, first: BallId, at: DVec2, trail: Trail, found: &mut Vec<Idea>) {
    let Some((distance, _)) = trail.meets(position, at) else { return };
    if nearest(position, &trail) != Some(first) {
        return;
    }
    let ghost = trail.end() + trail.direction * distance;
    if !position.view.bed.holds(ghost, position.radius() - 1e-6) {
        return;
    }
    let normal = (at - ghost) / (2.0 * position.radius());
    let across = trail.direction - normal * trail.direction.dot(normal);
    for (spin, height_offset) in SPINS {
        // What slides at first ends with 5/7 of its velocity and 2/7 of that of its spin.
        let leaves = across * (5.0 / 7.0) + trail.direction * (2.0 / 7.0 * spin);
        let share = leaves.length();
        if share < 0.1 {
            continue;
        }
        let mut before = trail.clone();
        before.points.push(ghost);
        let after = Trail::new(ghost, leaves / share);
        found.extend(
            to_second(position, first, normal, &before, after, share)
                .map(|idea| Idea { height_offset, ..idea }),
        );
    }
}

/// On to the other ball, by as many cushions as it takes.
fn to_second(
    position: &Position<'_>,
    first: BallId,
    normal: DVec2,
    before: &Trail,
    mut after: Trail,
    share: f64,
) -> Option<Idea> {
    let cushions_before = before.points.len() - 2;
    let mut others = position.view.balls.iter().filter(|ball| ball.id != first);
    let (second, at) = others.next().map(|ball| (ball.id, ball.position))?;
    let mut bounces = 0;
    let (distance, aside) = loop {
        if let Some(met) = after.meets(position, at) {
            break met;
        }
        if cushions_before + bounces >= CUSHIONS || !after.bounce(position) {
            return None;
        }
        bounces += 1;
    };
    let last = after.end() + after.direction * distance;
    after.points.push(last);

    let apart = 2.0 * position.radius();
    let ghost = before.end();
    let direction = (before.points[1] - position.cue).try_normalize()?;
    let arrived = (ghost - before.points[before.points.len() - 2]).try_normalize()?;
    let cut_rad = signed_angle(arrived, normal);
    let (to_ball_m, to_end_m) = (before.length_m(), after.length_m());
    let cushions = cushions_before + bounces;
    let gain = gain(to_ball_m, cut_rad, position.radius());
    let coarse_before = gain * CUSHION_RAD * (cushions_before as f64).sqrt();
    let coarse_after = both(CAROM_RAD, CUSHION_RAD * (bounces as f64).sqrt());
    let coarse = both(coarse_before, coarse_after);
    let allowed = Window { right: -(apart + aside) / to_end_m, left: (apart - aside) / to_end_m };
    let legs = |trail: &Trail| -> SmallVec<[f64; 8]> {
        trail.points.windows(2).map(|pair| pair[0].distance(pair[1])).collect()
    };
    let off_first = launch_by_cushions(&legs(&after), ARRIVAL_M_S);
    let tip = launch_by_cushions(&legs(before), off_first / share) / BALL_PER_TIP_SPEED;
    if tip > TIP_MOST_M_S {
        return None;
    }
    let ways = [(before, first), (&after, second)];
    Some(Idea {
        kind: IdeaKind::Carom,
        first: Some(first),
        ball: Some(second),
        pocket: None,
        direction,
        ghost,
        first_way: Some(normal),
        cut_rad,
        to_ball_m,
        to_end_m,
        cushions: cushions as u8,
        height_offset: 0.0,
        speed_least_m_s: tip,
        chance: chance(gain * position.sigma_rad, coarse, allowed),
        lines: ways
            .into_iter()
            .flat_map(|(trail, ball)| {
                trail.points.windows(2).map(move |pair| line(pair[0], pair[1], LineEnd::Ball(ball)))
            })
            .collect(),
    })
}
