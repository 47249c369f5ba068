//! Shots that pocket nothing: the break, and a legal contact when no pot is open.

use super::geometry::{is_free, turned};
use super::plan::{Plan, PlanKind};
use super::speed;
use super::view::TableView2d;
use crate::ids::BallId;
use glam::DVec2;
use rand::Rng;

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// Cuts at which a ball is tried if it cannot be met fully [rad], smallest first.
const CONTACT_CUTS_RAD: [f64; 13] = [
    0.0,
    15.0 * DEGREE,
    -15.0 * DEGREE,
    30.0 * DEGREE,
    -30.0 * DEGREE,
    45.0 * DEGREE,
    -45.0 * DEGREE,
    60.0 * DEGREE,
    -60.0 * DEGREE,
    70.0 * DEGREE,
    -70.0 * DEGREE,
    78.0 * DEGREE,
    -78.0 * DEGREE,
];

/// How far from a pocket's mouth a cushion can be played [m].
const KICK_FROM_POCKET_M: f64 = 0.09;

/// Full at the apex ball: the one nearest to the foot spot.
pub(super) fn break_shot(view: &TableView2d, cue: DVec2, rng: &mut impl Rng) -> Plan {
    let spot = view.bed.foot_spot();
    let apex = view
        .balls
        .iter()
        .min_by(|a, b| a.position.distance(spot).total_cmp(&b.position.distance(spot)));
    let at = apex.map_or(spot, |ball| ball.position);
    let direction = toward(cue, at);
    let ghost = at - 2.0 * view.ball_radius_m * direction;
    let speed_m_s = speed::break_strength(rng);
    plan(PlanKind::Break, apex.map(|ball| ball.id), cue, ghost, direction, speed_m_s)
}

/// Meets a legal ball: the nearest that can be met directly, else by one cushion, else the nearest
/// whatever lies in the way.
pub(super) fn contact_shot(
    view: &TableView2d,
    cue: DVec2,
    legal: &[BallId],
    rng: &mut impl Rng,
) -> Plan {
    let mut balls: Vec<(BallId, DVec2)> =
        legal.iter().filter_map(|id| Some((*id, view.position(*id)?))).collect();
    // The sort is stable: of two equally near balls the one with the smaller number.
    balls.sort_by(|a, b| cue.distance(a.1).total_cmp(&cue.distance(b.1)));

    for &(ball, position) in &balls {
        if let Some((ghost, cut_rad)) = direct_ghost(view, cue, ball, position) {
            let direction = toward(cue, ghost);
            let way = (position - ghost) / (2.0 * view.ball_radius_m);
            let to_rail_m = to_rail(view, position, way);
            let speed = speed::contact_strength(cue.distance(ghost), 0, to_rail_m, rng);
            let mut plan = plan(PlanKind::Contact, Some(ball), cue, ghost, direction, speed);
            (plan.cut_rad, plan.commanded_cut_rad) = (cut_rad, cut_rad);
            return plan;
        }
    }

    let kick = balls
        .iter()
        .flat_map(|&(ball, position)| {
            (0..4).filter_map(move |rail| Some((ball, kick(view, cue, ball, position, rail)?)))
        })
        .min_by(|a, b| a.1.length_m.total_cmp(&b.1.length_m));
    if let Some((ball, kick)) = kick {
        let speed = speed::contact_strength(kick.length_m, 1, 0.5 * view.bed.width_m, rng);
        return plan(PlanKind::Kick, Some(ball), cue, kick.ghost, kick.direction, speed);
    }

    let (ball, at) = match balls.first() {
        Some(&(ball, position)) => (Some(ball), position),
        // No ball to meet at all: up the table, away from the pockets.
        None => (None, DVec2::new(0.5 * view.bed.length_m, 0.5 * cue.y)),
    };
    let direction = toward(cue, at);
    let ghost = at - 2.0 * view.ball_radius_m * direction;
    let speed = speed::contact_strength(cue.distance(at), 0, 0.5 * view.bed.width_m, rng);
    plan(PlanKind::Desperate, ball, cue, ghost, direction, speed)
}

/// Where the cue ball meets `ball` directly, as fully as the others allow, and that cut [rad].
fn direct_ghost(
    view: &TableView2d,
    cue: DVec2,
    ball: BallId,
    position: DVec2,
) -> Option<(DVec2, f64)> {
    let distance = 2.0 * view.ball_radius_m;
    let full = toward(cue, position);
    CONTACT_CUTS_RAD.into_iter().find_map(|cut| {
        // The ghost seen from the ball; the true cut is larger the nearer the cue ball is.
        let ghost = position - distance * turned(full, cut);
        let direction = toward(cue, ghost);
        let normal = (position - ghost) / distance;
        let meets = normal.dot(direction) > 0.15;
        let open = meets
            && view.bed.holds(ghost, view.ball_radius_m - 1e-6)
            && is_free(view, cue, ghost, Some(ball));
        open.then(|| (ghost, super::geometry::signed_angle(direction, normal)))
    })
}

struct Kick {
    ghost: DVec2,
    direction: DVec2,
    length_m: f64,
}

/// One cushion to a full hit, by the mirror image of the ball behind the line on which the cue
/// ball's middle bounces.
fn kick(
    view: &TableView2d,
    cue: DVec2,
    ball: BallId,
    position: DVec2,
    rail: usize,
) -> Option<Kick> {
    let radius = view.ball_radius_m;
    let half = view.bed.half() - DVec2::splat(radius);
    let axis = rail / 2;
    let line = if rail.is_multiple_of(2) { half[axis] } else { -half[axis] };
    let mut image = position;
    image[axis] = 2.0 * line - position[axis];

    let reach = (image - cue)[axis];
    if reach.abs() < radius || (line - cue[axis]) * reach <= 0.0 {
        return None;
    }
    let bounce = cue + (image - cue) * ((line - cue[axis]) / reach);
    let away = view
        .pockets
        .iter()
        .flat_map(|pocket| [pocket.mouth[0], pocket.mouth[1], pocket.target()])
        .all(|mouth| mouth.distance(bounce) > KICK_FROM_POCKET_M);
    let back = (position - bounce).try_normalize()?;
    let ghost = position - 2.0 * radius * back;
    let open = away
        && bounce.distance(position) > 2.0 * radius
        && view.bed.holds(bounce, radius - 1e-6)
        && view.bed.holds(ghost, radius - 1e-6)
        && is_free(view, cue, bounce, None)
        && is_free(view, bounce, ghost, Some(ball));
    let length_m = cue.distance(bounce) + bounce.distance(ghost);
    open.then(|| Kick { ghost, direction: toward(cue, bounce), length_m })
}

/// How far a ball goes along `way` until it meets a rail [m].
fn to_rail(view: &TableView2d, from: DVec2, way: DVec2) -> f64 {
    let half = view.bed.half();
    (0..2)
        .filter(|axis| way[*axis].abs() > 1e-9)
        .map(|axis| (half[axis] * way[axis].signum() - from[axis]) / way[axis])
        .fold(view.bed.length_m, f64::min)
        .max(0.0)
}

fn toward(from: DVec2, to: DVec2) -> DVec2 {
    (to - from).normalize_or(DVec2::X)
}

fn plan(
    kind: PlanKind,
    target: Option<BallId>,
    cue_ball: DVec2,
    ghost: DVec2,
    direction: DVec2,
    speed_m_s: f64,
) -> Plan {
    Plan {
        kind,
        target,
        pocket: None,
        cue_ball,
        ghost,
        direction,
        cut_rad: 0.0,
        commanded_cut_rad: 0.0,
        speed_m_s,
        cost: 0.0,
        lines: Vec::new(),
    }
}
