//! The cue ball by one cushion or two to a ball.

use super::chance::CUSHION_RAD;
use super::cushion::{Bent, Cushion, bent, cushions, image};
use super::mouth::{Entry, entries};
use super::pot::{Meeting, chance, meeting};
use super::way::{Window, window};
use super::{CHANCE_LEAST, Idea, IdeaKind, Position, line};
use crate::ai::plan::LineEnd;
use crate::ai::speed::{
    BALL_PER_TIP_SPEED, before_meeting, launch_by_cushions, launch_speed, launch_to_pocket,
};
use crate::ids::{BallId, PocketId};
use glam::DVec2;
use smallvec::SmallVec;

/// How far a ball that is only met shall go at least [m].
const GOES_M: f64 = 0.8;

/// Own balls into pockets by one cushion; legal balls to be met by one or two.
pub(super) fn kicks(position: &Position<'_>, found: &mut Vec<Idea>) {
    let cushions = cushions(position);
    for (ball, at) in position.lying(&position.goal.own) {
        for pocket in &position.view.pockets {
            for entry in entries(position, at, pocket, &[ball]) {
                found.extend(cushions.iter().filter_map(|cushion| {
                    pot(position, ball, at, pocket.id, &entry, *cushion)
                        .filter(|idea| idea.chance >= CHANCE_LEAST)
                }));
            }
        }
    }
    for (ball, at) in position.lying(&position.goal.legal) {
        for (i, first) in cushions.iter().enumerate() {
            found.extend(meet(position, ball, at, &[*first]));
            for (j, second) in cushions.iter().enumerate() {
                if i != j {
                    found.extend(meet(position, ball, at, &[*first, *second]));
                }
            }
        }
    }
}

/// How the cue ball goes by cushions to a meeting, and how far it may turn.
fn way_to(
    position: &Position<'_>,
    meeting: &Meeting,
    by: &[Cushion],
    ball: BallId,
) -> Option<(Bent, Window)> {
    let way = bent(position, position.cue, by, meeting.ghost)?;
    let last = way.points.len() - 2;
    let first_leg = window(position, position.cue, way.points[1], &[])?;
    for pair in way.points[1..=last].windows(2) {
        window(position, pair[0], pair[1], &[])?;
    }
    window(position, way.points[last], meeting.ghost, &[ball])?;
    // Seen in the mirrors the way is straight; what is near its last part bounds how far it turns.
    let free = window(position, way.image, meeting.ghost, &[ball])?;
    // Every mirror changes left and right.
    let first_leg = if by.len() % 2 == 1 { first_leg.passed_on(1.0) } else { first_leg };
    Some((way, free.and(first_leg)))
}

fn idea(
    position: &Position<'_>,
    ball: BallId,
    meeting: &Meeting,
    way: &Bent,
    first_way: DVec2,
    object_m_s: f64,
) -> Option<Idea> {
    let legs = way.legs();
    let arrival = before_meeting(meeting.cut_rad, object_m_s);
    Some(Idea {
        kind: IdeaKind::Kick,
        first: Some(ball),
        ball: None,
        pocket: None,
        direction: (way.points[1] - position.cue).try_normalize()?,
        ghost: meeting.ghost,
        first_way: Some(first_way),
        cut_rad: meeting.cut_rad,
        to_ball_m: legs.iter().sum(),
        to_end_m: GOES_M,
        cushions: legs.len() as u8 - 1,
        height_offset: 0.0,
        speed_least_m_s: launch_by_cushions(&legs, arrival) / BALL_PER_TIP_SPEED,
        chance: 0.0,
        lines: way
            .points
            .windows(2)
            .map(|pair| line(pair[0], pair[1], LineEnd::Ball(ball)))
            .collect::<SmallVec<_>>(),
    })
}

/// What is coarse about the cushions, as an error of the straight way seen in the mirrors [rad].
fn coarse_rad(way: &Bent) -> f64 {
    let legs = way.legs();
    let total: f64 = legs.iter().sum();
    let mut square = 0.0;
    for first in 1..legs.len() {
        let after: f64 = legs[first..].iter().sum();
        let error = CUSHION_RAD * after / total;
        square += error * error;
    }
    square.sqrt()
}

fn pot(
    position: &Position<'_>,
    ball: BallId,
    at: DVec2,
    pocket: PocketId,
    entry: &Entry,
    cushion: Cushion,
) -> Option<Idea> {
    let met = meeting(position, image(position.cue, &[cushion]), at, entry.way)?;
    let (way, free) = way_to(position, &met, &[cushion], ball)?;
    let to_end_m = at.distance(entry.target);
    let gain = met.gain(position);
    let allowed = entry.window.and(free.passed_on(gain));
    let object_m_s = launch_to_pocket(&[to_end_m]);
    let mut idea = idea(position, ball, &met, &way, entry.way, object_m_s)?;
    idea.ball = Some(ball);
    idea.pocket = Some(pocket);
    idea.to_end_m = to_end_m;
    idea.chance = chance(gain * position.sigma_rad, gain * coarse_rad(&way), allowed);
    idea.lines.push(line(at, entry.target, LineEnd::Pocket(ball, pocket)));
    Some(idea)
}

/// The cue ball to the middle of a ball.
fn meet(position: &Position<'_>, ball: BallId, at: DVec2, by: &[Cushion]) -> Option<Idea> {
    let from = image(position.cue, by);
    let direction = (at - from).try_normalize()?;
    let met = meeting(position, from, at, direction)?;
    let (way, free) = way_to(position, &met, by, ball)?;
    let edge = libm::asin((2.0 * position.radius() / from.distance(at)).min(1.0));
    let mut idea = idea(position, ball, &met, &way, direction, launch_speed(GOES_M, 0.0))?;
    let allowed = Window { right: -edge, left: edge }.and(free);
    idea.chance = chance(position.sigma_rad, coarse_rad(&way), allowed);
    Some(idea)
}
