//! A ball into a pocket by one cushion.

use super::chance::CUSHION_RAD;
use super::cushion::{bent, cushions};
use super::mouth::entries;
use super::pot::{chance, meeting};
use super::way::window;
use super::{CHANCE_LEAST, Idea, IdeaKind, Position, line};
use crate::ai::plan::LineEnd;
use crate::ai::speed::{BALL_PER_TIP_SPEED, before_meeting, launch_speed, launch_to_pocket};
use crate::ids::BallId;
use crate::table::Pocket;
use glam::DVec2;
use smallvec::smallvec;

/// Own balls by one cushion.
pub(super) fn banks(position: &Position<'_>, found: &mut Vec<Idea>) {
    for (ball, at) in position.lying(&position.goal.own) {
        for pocket in &position.view.pockets {
            for cushion in cushions(position) {
                found.extend(bank(position, ball, at, pocket, cushion));
            }
        }
    }
    found.retain(|idea| idea.kind != IdeaKind::Bank || idea.chance >= CHANCE_LEAST);
}

/// The best of the ways by this cushion.
fn bank(
    position: &Position<'_>,
    ball: BallId,
    at: DVec2,
    pocket: &Pocket,
    cushion: super::cushion::Cushion,
) -> Option<Idea> {
    // Seen in the cushion the way is straight, and turns to the other side.
    let image = cushion.image(at);
    let of = |entry: super::mouth::Entry| {
        let way = bent(position, at, &[cushion], entry.target)?;
        let bounce = way.points[1];
        let legs = way.legs();
        let out = (bounce - at).try_normalize()?;
        let stroke = meeting(position, position.cue, at, out)?;
        let first_leg = window(position, at, bounce, &[ball])?;
        window(position, bounce, entry.target, &[ball])?;
        let free = window(position, position.cue, stroke.ghost, &[ball])?;

        let gain = stroke.gain(position);
        let allowed = entry.window.passed_on(1.0).and(first_leg).and(free.passed_on(gain));
        // What is coarse about the cushion acts on the second part of the way only.
        let coarse = CUSHION_RAD * legs[1] / (legs[0] + legs[1]);
        let object_m_s = before_meeting(stroke.cut_rad, launch_to_pocket(&legs));
        Some(Idea {
            kind: IdeaKind::Bank,
            first: Some(ball),
            ball: Some(ball),
            pocket: Some(pocket.id),
            direction: stroke.direction,
            ghost: stroke.ghost,
            first_way: Some(out),
            cut_rad: stroke.cut_rad,
            to_ball_m: stroke.to_ghost_m,
            to_end_m: legs.iter().sum(),
            cushions: 1,
            height_offset: 0.0,
            speed_least_m_s: launch_speed(stroke.to_ghost_m, object_m_s) / BALL_PER_TIP_SPEED,
            chance: chance(gain * position.sigma_rad, coarse, allowed),
            lines: smallvec![
                line(position.cue, stroke.ghost, LineEnd::Ball(ball)),
                line(at, bounce, LineEnd::Pocket(ball, pocket.id)),
                line(bounce, entry.target, LineEnd::Pocket(ball, pocket.id)),
            ],
        })
    };
    entries(position, image, pocket, &[ball])
        .into_iter()
        .filter_map(of)
        .reduce(|best, next| if next.chance > best.chance { next } else { best })
}
