//! Planning a shot by vector geometry alone (paper, section 5.4.1).
//!
//! For every own ball and every pocket: can the cue ball go to where it must meet the ball, can the
//! ball go from there to the pocket, and what does the shot cost? The smallest cost is played.

use super::fallback;
use super::geometry::{is_free, signed_angle, turned};
use super::speed;
use super::view::TableView2d;
use crate::cue::{Aim, elevation_over_balls};
use crate::events::{ShotKind, Turn, Zone};
use crate::ids::{BallId, PocketId};
use crate::table::Pocket;
use glam::DVec2;
use rand::Rng;

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// Largest cut that is played [rad].
pub const CUT_LIMIT_RAD: f64 = 70.0 * DEGREE;
/// Largest commanded cut, the throw's compensation included [rad]. A right angle is a miss.
pub(super) const COMMANDED_LIMIT_RAD: f64 = 85.0 * DEGREE;
/// Largest angle between a ball's way and a corner pocket's heading [rad]: along the rail is 45°.
const ENTRY_LIMIT_CORNER_RAD: f64 = 52.0 * DEGREE;
/// The same for a side pocket, whose far jaw turns slanting balls away [rad].
const ENTRY_LIMIT_SIDE_RAD: f64 = 50.0 * DEGREE;

/// Cost of a way as long as the table.
const DISTANCE_COST: f64 = 1.0;
/// Cost of a cut of [`CUT_SCALE_RAD`]; grows with its square.
const CUT_COST: f64 = 1.5;
/// See [`CUT_COST`] [rad].
const CUT_SCALE_RAD: f64 = 60.0 * DEGREE;
/// Cost of coming to the pocket at [`ENTRY_SCALE_RAD`] to its heading; grows with its square.
const ENTRY_COST: f64 = 0.8;
/// See [`ENTRY_COST`] [rad].
const ENTRY_SCALE_RAD: f64 = 45.0 * DEGREE;
/// Penalty if less than a ball's radius is free between cue ball and object ball.
const CLOSE_COST: f64 = 0.6;
/// Penalty if the cue ball may follow into the pocket: a cut below [`FOLLOW_CUT_RAD`] with the
/// pocket nearer than [`FOLLOW_DISTANCE_M`].
const FOLLOW_COST: f64 = 0.4;
/// See [`FOLLOW_COST`] [rad].
const FOLLOW_CUT_RAD: f64 = 3.0 * DEGREE;
/// See [`FOLLOW_COST`] [m].
const FOLLOW_DISTANCE_M: f64 = 0.5;
/// Penalty for a cue that must be raised by a radian over balls behind the cue ball. Not in the
/// paper, whose cue passed through them.
const RAISED_COST: f64 = 2.0;

/// What a shot must achieve.
#[derive(Debug, Clone, PartialEq)]
pub struct Goal {
    /// The kind of shot.
    pub shot: ShotKind,
    /// Balls that the player wants to pocket.
    pub own: Vec<BallId>,
    /// Balls that the cue ball may meet first; they contain the own ones.
    pub legal: Vec<BallId>,
}

impl Goal {
    /// What a turn asks for on this table. `played_from` is the zone that the cue ball was put
    /// into, if it was in hand: from the kitchen, balls in the kitchen may not be met first.
    pub fn of(turn: &Turn, view: &TableView2d, played_from: Option<Zone>) -> Self {
        let head_string_x = view.bed.head_string_x();
        let behind_line = |id| {
            played_from == Some(Zone::Kitchen)
                && view.position(id).is_some_and(|ball| ball.x < head_string_x)
        };
        let lies_there = |id: &BallId| view.position(*id).is_some();
        let mut legal: Vec<_> = turn.legal_first.iter().copied().filter(lies_there).collect();
        if legal.is_empty() {
            legal = view.balls.iter().map(|ball| ball.id).collect();
        }
        if !legal.iter().all(|id| behind_line(*id)) {
            legal.retain(|id| !behind_line(*id));
        }
        // Where groups are played, the 8 is wanted only when nothing else is left.
        let mut own = legal.clone();
        if turn.groups.is_some() && own.len() > 1 {
            own.retain(|id| *id != BallId::EIGHT);
        }
        Goal { shot: turn.shot, own, legal }
    }
}

/// What sort of shot a plan is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlanKind {
    /// An own ball into a pocket.
    Pot,
    /// Only meet a legal ball, directly.
    Contact,
    /// Only meet a legal ball, by way of one cushion.
    Kick,
    /// Nothing can be reached: the least bad.
    Desperate,
    /// Open the rack.
    Break,
}

/// Where a line of the plan ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LineEnd {
    /// From the cue ball to a ball.
    Ball(BallId),
    /// From this ball to a pocket.
    Pocket(BallId, PocketId),
}

/// A way that was examined; the renderer can show it (paper, figure 5.2).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Where it begins [m].
    pub from: DVec2,
    /// Where it ends [m].
    pub to: DVec2,
    /// What it leads to.
    pub end: LineEnd,
    /// No other ball is in the way.
    pub free: bool,
    /// It belongs to the shot that is played.
    pub chosen: bool,
}

/// A ball, a pocket, and how to bring one to the other. Its ways are not examined yet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Candidate {
    /// The ball.
    pub ball: BallId,
    /// Its pocket.
    pub pocket: PocketId,
    /// Where the ball is sent [m].
    pub pocket_target: DVec2,
    /// Middle of the cue ball when it meets the ball, throw compensated [m].
    pub ghost: DVec2,
    /// Unit vector from the cue ball to the ghost.
    pub direction: DVec2,
    /// Cut β: from the cue ball's direction to the ball's wanted one, anticlockwise positive [rad].
    pub cut_rad: f64,
    /// Cut that is aimed for, (1 + f) β: cue ball's direction against the line of centres [rad].
    pub commanded_cut_rad: f64,
    /// Entry angle ε between the ball's way and the pocket's heading, not negative [rad].
    pub entry_rad: f64,
    /// Cue ball to ghost [m].
    pub to_ball_m: f64,
    /// Ball to pocket [m].
    pub to_pocket_m: f64,
    /// See [`cost`].
    pub cost: f64,
}

/// A shot that is going to be played.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// What sort of shot.
    pub kind: PlanKind,
    /// The ball that the cue ball shall meet; none on a table without object balls.
    pub target: Option<BallId>,
    /// The pocket it shall go to; only for a pot.
    pub pocket: Option<PocketId>,
    /// Where the cue ball lies [m].
    pub cue_ball: DVec2,
    /// Middle of the cue ball when it meets the target [m].
    pub ghost: DVec2,
    /// Horizontal unit vector of the stroke.
    pub direction: DVec2,
    /// Cut β, anticlockwise positive [rad].
    pub cut_rad: f64,
    /// Cut that is aimed for [rad].
    pub commanded_cut_rad: f64,
    /// Speed of the tip at contact [m/s].
    pub speed_m_s: f64,
    /// The cost by which it was chosen; 0 if it was not a pot.
    pub cost: f64,
    /// All ways that were examined.
    pub lines: Vec<Line>,
}

/// How bad a shot is (paper, section 5.4.1); the smallest is played.
///
/// `1.0 (d₁ + d₂)/L + 1.5 (β/60°)² + 0.8 (ε/45°)² + 0.6 [gap < R] + 0.4 [β < 3° and d₂ < 0.5 m]`
/// with d₁, d₂ cue ball to ghost and ball to pocket, L the bed's length, gap what is free between
/// both balls. The factors are the paper's list with weights of our own.
pub fn cost(
    to_ball_m: f64,
    to_pocket_m: f64,
    cut_rad: f64,
    entry_rad: f64,
    gap_m: f64,
    view: &TableView2d,
) -> f64 {
    let distance = DISTANCE_COST * (to_ball_m + to_pocket_m) / view.bed.length_m;
    let cut = cut_rad / CUT_SCALE_RAD;
    let entry = entry_rad / ENTRY_SCALE_RAD;
    let close = if gap_m < view.ball_radius_m { CLOSE_COST } else { 0.0 };
    let follows = cut_rad.abs() < FOLLOW_CUT_RAD && to_pocket_m < FOLLOW_DISTANCE_M;
    distance
        + CUT_COST * cut * cut
        + ENTRY_COST * entry * entry
        + close
        + if follows { FOLLOW_COST } else { 0.0 }
}

/// Where a ball at `ball` is sent so that it falls: the middle of the mouth, or the opening if it
/// already hangs in the jaws.
fn target_of(pocket: &Pocket, ball: DVec2, ball_radius_m: f64) -> DVec2 {
    let mouth = pocket.target();
    if (mouth - ball).dot(pocket.heading) < ball_radius_m { pocket.centre } else { mouth }
}

/// How to bring `ball` into `pocket` from a cue ball at `cue`, other balls left out of account.
///
/// None if the cut is too thin, the pocket is too slanting or the ghost is not on the bed. The
/// throw turns the object ball back towards the cue ball's way, so the line of centres is turned
/// away from it until the commanded cut is `(1 + f) β` (paper, section 5.4.2).
pub fn candidate(
    view: &TableView2d,
    cue: DVec2,
    ball: BallId,
    pocket: &Pocket,
    throw_factor: f64,
) -> Option<Candidate> {
    let radius = view.ball_radius_m;
    let position = view.position(ball)?;
    let pocket_target = target_of(pocket, position, radius);
    let way = (pocket_target - position).try_normalize()?;
    let entry_rad = signed_angle(pocket.heading, way).abs();
    let entry_limit =
        if pocket.id.is_side() { ENTRY_LIMIT_SIDE_RAD } else { ENTRY_LIMIT_CORNER_RAD };
    // A ball in the jaws falls from any side that pushes it in.
    if entry_rad > entry_limit && pocket_target != pocket.centre {
        return None;
    }

    // β depends a little on where the ghost is, which depends on β: five rounds settle it.
    let mut normal = way;
    let mut direction = (position - 2.0 * radius * normal - cue).try_normalize()?;
    let mut cut_rad = signed_angle(direction, way);
    for _ in 0..5 {
        if cut_rad.abs() > CUT_LIMIT_RAD {
            return None;
        }
        normal = turned(way, throw_factor * cut_rad);
        direction = (position - 2.0 * radius * normal - cue).try_normalize()?;
        cut_rad = signed_angle(direction, way);
    }
    let ghost = position - 2.0 * radius * normal;
    let commanded_cut_rad = signed_angle(direction, normal);
    if cut_rad.abs() > CUT_LIMIT_RAD
        || commanded_cut_rad.abs() > COMMANDED_LIMIT_RAD
        || !view.bed.holds(ghost, radius - 1e-6)
    {
        return None;
    }

    let (to_ball_m, to_pocket_m) = (cue.distance(ghost), position.distance(pocket_target));
    let gap_m = cue.distance(position) - 2.0 * radius;
    let others = view.balls.iter().map(|other| other.position);
    let raised = elevation_over_balls(cue, &Aim::along(direction), others, radius);
    let cost = cost(to_ball_m, to_pocket_m, cut_rad, entry_rad, gap_m, view) + RAISED_COST * raised;
    Some(Candidate {
        ball,
        pocket: pocket.id,
        pocket_target,
        ghost,
        direction,
        cut_rad,
        commanded_cut_rad,
        entry_rad,
        to_ball_m,
        to_pocket_m,
        cost,
    })
}

/// Whether the ball's way to the pocket is free.
pub(super) fn pocket_is_free(view: &TableView2d, shot: &Candidate) -> bool {
    view.position(shot.ball)
        .is_some_and(|ball| is_free(view, ball, shot.pocket_target, Some(shot.ball)))
}

/// Whether both ways of a candidate are free.
pub(super) fn is_open(view: &TableView2d, cue: DVec2, shot: &Candidate) -> bool {
    is_free(view, cue, shot.ghost, Some(shot.ball)) && pocket_is_free(view, shot)
}

/// The cheapest open pot from a cue ball at `cue`.
pub(super) fn best_pot(
    view: &TableView2d,
    cue: DVec2,
    own: &[BallId],
    throw_factor: f64,
) -> Option<Candidate> {
    own.iter()
        .flat_map(|ball| view.pockets.iter().map(move |pocket| (*ball, pocket)))
        .filter_map(|(ball, pocket)| candidate(view, cue, ball, pocket, throw_factor))
        .filter(|shot| is_open(view, cue, shot))
        .min_by(|a, b| a.cost.total_cmp(&b.cost))
}

/// Decides what to play from a cue ball at `cue`.
///
/// # Examples
/// ```
/// use glam::DVec2;
/// use hapticbillard::ai::{Goal, PlanKind, SeenBall, TableView2d, plan_shot};
/// use hapticbillard::ball::POOL_RADIUS_M;
/// use hapticbillard::events::ShotKind;
/// use hapticbillard::ids::BallId;
/// use hapticbillard::table::Table;
/// use rand::SeedableRng;
/// use rand_pcg::Pcg64Mcg;
///
/// let table = Table::preset("pool-9ft")?;
/// let (one, cue_ball) = (BallId(1), DVec2::ZERO);
/// let view = TableView2d {
///     cue_ball: Some(cue_ball),
///     balls: vec![SeenBall { id: one, position: DVec2::new(0.9, 0.3) }],
///     ball_radius_m: POOL_RADIUS_M,
///     bed: table.bed.ok_or("no bed")?,
///     pockets: table.pockets,
/// };
/// let goal = Goal { shot: ShotKind::Normal, own: vec![one], legal: vec![one] };
/// let plan = plan_shot(&view, cue_ball, &goal, 0.0, &mut Pcg64Mcg::seed_from_u64(1));
/// assert_eq!(plan.kind, PlanKind::Pot);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn plan_shot(
    view: &TableView2d,
    cue: DVec2,
    goal: &Goal,
    throw_factor: f64,
    rng: &mut impl Rng,
) -> Plan {
    if goal.shot == ShotKind::Break {
        return fallback::break_shot(view, cue, rng);
    }
    let mut plan = match best_pot(view, cue, &goal.own, throw_factor) {
        Some(shot) => Plan {
            kind: PlanKind::Pot,
            target: Some(shot.ball),
            pocket: Some(shot.pocket),
            cue_ball: cue,
            ghost: shot.ghost,
            direction: shot.direction,
            cut_rad: shot.cut_rad,
            commanded_cut_rad: shot.commanded_cut_rad,
            speed_m_s: speed::pot_strength(
                shot.to_ball_m,
                shot.commanded_cut_rad,
                shot.to_pocket_m,
                rng,
            ),
            cost: shot.cost,
            lines: Vec::new(),
        },
        None => fallback::contact_shot(view, cue, &goal.legal, rng),
    };
    plan.lines = examined_lines(view, cue, &goal.own, Some(&plan));
    plan
}

/// Every way from the cue ball to an own ball and from there to a pocket (paper, figure 5.2); those
/// of a pot that is played are chosen.
pub(super) fn examined_lines(
    view: &TableView2d,
    cue: DVec2,
    own: &[BallId],
    played: Option<&Plan>,
) -> Vec<Line> {
    let mut lines = Vec::new();
    for &ball in own {
        let Some(position) = view.position(ball) else { continue };
        let plan = played.filter(|plan| plan.target == Some(ball));
        let pot = plan.filter(|plan| plan.kind == PlanKind::Pot);
        let (chosen, to_ball) = (plan.is_some(), pot.map_or(position, |pot| pot.ghost));
        lines.push(Line {
            from: cue,
            to: to_ball,
            end: LineEnd::Ball(ball),
            free: is_free(view, cue, to_ball, Some(ball)),
            chosen,
        });
        lines.extend(view.pockets.iter().map(|pocket| {
            let to = target_of(pocket, position, view.ball_radius_m);
            Line {
                from: position,
                to,
                end: LineEnd::Pocket(ball, pocket.id),
                free: is_free(view, position, to, Some(ball)),
                chosen: plan.is_some_and(|plan| plan.pocket == Some(pocket.id)),
            }
        }));
    }
    lines
}
