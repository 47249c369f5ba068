//! Continuous cue motion: approach, stroke and withdrawal as paths of quadratic pieces.
//!
//! Every path has a continuous velocity. Approach and stroke begin and end at rest, and the stroke
//! begins exactly where the approach ends.

use crate::cue::{Aim, CuePath, CuePiece, CuePose};
use crate::ids::PlayerId;
use crate::table::Bed;
use crate::units::Seconds;
use glam::DVec3;
use smallvec::SmallVec;

/// The fastest tip of a computer [m/s]: the hardest break. A person at a mouse reaches 6 m/s with
/// half a window in 50 ms, and 12 m/s at most.
pub const TIP_SPEED_MAX_M_S: f64 = 10.0;

/// Duration of the approach [s].
const APPROACH_S: Seconds = 0.8;
/// How high the cue is led over the table on its way to the ball [m].
const APPROACH_LIFT_M: f64 = 0.16;
/// How far behind the address it comes down [m].
const APPROACH_BACK_M: f64 = 0.12;
/// Gap between tip and ball at the address [m].
const ADDRESS_GAP_M: f64 = 0.015;
/// Backswing of the softest stroke [m]; grows with the speed.
const BACKSWING_MIN_M: f64 = 0.10;
/// Backswing that each m/s of tip speed adds [s].
const BACKSWING_PER_SPEED_S: f64 = 0.045;
/// The longest backswing [m]: the length of a bridge.
const BACKSWING_MAX_M: f64 = 0.40;
/// Peak speed of the hand on its way back [m/s].
const BACKSWING_SPEED_M_S: f64 = 0.6;
/// How long before the contact the speed is already the planned one, as a way [m].
const STEADY_BEFORE_M: f64 = 0.035;
/// How long after the contact point it still is, as a way [m].
const STEADY_AFTER_M: f64 = 0.012;
/// Follow-through of the softest stroke, in which the cue comes to rest [m].
const FOLLOW_MIN_M: f64 = 0.06;
/// That of a hard one [m].
const FOLLOW_MAX_M: f64 = 0.10;
/// Follow-through that each m/s adds [s].
const FOLLOW_PER_SPEED_S: f64 = 0.01;
/// The hardest braking of the hand [m/s²]; a hard break follows through until then.
const FOLLOW_BRAKE_M_S2: f64 = 350.0;
/// In which time a withdrawn cue first comes to rest [s].
const BRAKE_S: Seconds = 0.025;
/// Duration of the withdrawal after that [s].
const WITHDRAW_S: Seconds = 0.5;
/// How far the cue is withdrawn along its shaft [m].
const WITHDRAW_BACK_M: f64 = 0.30;
/// How far it is lifted meanwhile [m].
const WITHDRAW_UP_M: f64 = 0.15;

/// A stroke: straight along the shaft, with the planned speed at contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// How the cue is held.
    pub aim: Aim,
    /// Centre of the tip sphere when it meets the ball [m].
    pub contact: DVec3,
    /// Speed of the tip from before to after the contact [m/s].
    pub speed_m_s: f64,
}

/// Motion along the shaft: where (0 is the contact, negative is behind) and how fast a phase
/// begins, and how long it lasts.
struct Phase {
    at_m: f64,
    speed_m_s: f64,
    duration_s: Seconds,
    acceleration_m_s2: f64,
}

impl Stroke {
    /// A stroke at a ball at rest. `speed_m_s` must be positive.
    pub fn at_ball(aim: Aim, ball_centre: DVec3, ball_radius_m: f64, speed_m_s: f64) -> Self {
        Stroke { aim, contact: aim.tip_at_contact(ball_centre, ball_radius_m), speed_m_s }
    }

    /// The address: where the approach ends and the stroke begins, at rest.
    pub fn address(&self) -> CuePose {
        let direction = self.aim.direction();
        CuePose {
            tip: self.contact - direction * ADDRESS_GAP_M,
            velocity: DVec3::ZERO,
            direction,
            solid: false,
        }
    }

    /// When the tip meets a ball that did not move, after the stroke's start [s].
    pub fn contact_after_s(&self) -> Seconds {
        let [back, turn, forward, steady, _] = self.phases();
        let before = back.duration_s + turn.duration_s + forward.duration_s;
        before - steady.at_m / self.speed_m_s
    }

    /// How long the stroke lasts [s].
    pub fn duration_s(&self) -> Seconds {
        self.phases().iter().map(|phase| phase.duration_s).sum()
    }

    /// The path of the tip, beginning at `start_s`.
    pub fn path(&self, start_s: Seconds) -> CuePath {
        let direction = self.aim.direction();
        let mut pieces = SmallVec::new();
        let mut begins_s = start_s;
        for phase in self.phases() {
            pieces.push(CuePiece {
                start_s: begins_s,
                duration_s: phase.duration_s,
                position: self.contact + direction * phase.at_m,
                velocity: direction * phase.speed_m_s,
                acceleration: direction * phase.acceleration_m_s2,
                direction,
                direction_end: direction,
            });
            begins_s += phase.duration_s;
        }
        CuePath { solid: true, pieces }
    }

    /// Back in two halves, forward to full speed, steady through the contact, to rest.
    ///
    /// A phase from speed u to v over the way s lasts 2 s/(u + v).
    fn phases(&self) -> [Phase; 5] {
        let speed = self.speed_m_s;
        let backswing = (BACKSWING_MIN_M + BACKSWING_PER_SPEED_S * speed).min(BACKSWING_MAX_M);
        let half_back = 0.5 * (backswing - ADDRESS_GAP_M);
        let run_up = backswing - STEADY_BEFORE_M;
        let follow = (FOLLOW_MIN_M + FOLLOW_PER_SPEED_S * speed)
            .min(FOLLOW_MAX_M)
            .max(speed * speed / (2.0 * FOLLOW_BRAKE_M_S2));

        let phase = |from: f64, to: f64, u: f64, v: f64| {
            let duration_s = 2.0 * (to - from) / (u + v);
            Phase { at_m: from, speed_m_s: u, duration_s, acceleration_m_s2: (v - u) / duration_s }
        };
        let address = -ADDRESS_GAP_M;
        let halfway = address - half_back;
        [
            phase(address, halfway, 0.0, -BACKSWING_SPEED_M_S),
            phase(halfway, -backswing, -BACKSWING_SPEED_M_S, 0.0),
            phase(-backswing, -backswing + run_up, 0.0, speed),
            phase(-STEADY_BEFORE_M, STEADY_AFTER_M, speed, speed),
            phase(STEADY_AFTER_M, STEADY_AFTER_M + follow, speed, 0.0),
        ]
    }
}

/// Where a player's cue stands when it is not at the table: beside the head end, each player on
/// their own side.
pub fn resting_pose(player: PlayerId, bed: &Bed) -> CuePose {
    /// Distance from the cushions [m].
    const BESIDE_M: f64 = 0.35;
    let side = if player.index() == 0 { 1.0 } else { -1.0 };
    let tip =
        DVec3::new(-0.5 * bed.length_m - BESIDE_M, side * (0.5 * bed.width_m + BESIDE_M), 0.1);
    let direction = DVec3::new(1.0, -0.5 * side, -0.3).normalize();
    CuePose { tip, velocity: DVec3::ZERO, direction, solid: false }
}

/// Leads the cue from where it rests to the address of a stroke, over the balls; not solid.
pub fn approach(from: &CuePose, stroke: &Stroke, start_s: Seconds) -> CuePath {
    let to = stroke.address();
    let above = to.tip - to.direction * APPROACH_BACK_M + DVec3::Z * APPROACH_LIFT_M;
    // With the butt up, the middle direction is never opposite to either end's.
    let tilted = (to.direction - DVec3::Z * 0.5).normalize_or(to.direction);
    // Rest at the end and continuity between the pieces are the spline's; at its start the cue
    // may still move, which it loses first.
    let mut pieces = SmallVec::new();
    let mut begins_s = start_s;
    let mut rest = from.tip;
    if from.velocity != DVec3::ZERO {
        let brake = braking(from, start_s);
        rest = brake.at(brake.end_s()).0;
        begins_s = brake.end_s();
        pieces.push(brake);
    }
    let knots = [(rest, from.direction), (above, tilted), (to.tip, to.direction)];
    spline(knots, begins_s, APPROACH_S, &mut pieces);
    CuePath { solid: false, pieces }
}

/// Takes the cue back and up from wherever it is and however it moves; not solid, so that it
/// cannot touch the cue ball again.
pub fn withdrawal(from: &CuePose, start_s: Seconds) -> CuePath {
    let brake = braking(from, start_s);
    let rest = brake.at(brake.end_s()).0;
    let back = rest - from.direction * (0.6 * WITHDRAW_BACK_M);
    let up = rest - from.direction * WITHDRAW_BACK_M + DVec3::Z * WITHDRAW_UP_M;
    let mut pieces: SmallVec<[CuePiece; 4]> = SmallVec::new();
    pieces.push(brake);
    let knots = [(rest, from.direction), (back, from.direction), (up, from.direction)];
    spline(knots, brake.end_s(), WITHDRAW_S, &mut pieces);
    CuePath { solid: false, pieces }
}

/// Straight to rest within [`BRAKE_S`].
fn braking(from: &CuePose, start_s: Seconds) -> CuePiece {
    CuePiece {
        start_s,
        duration_s: BRAKE_S,
        position: from.tip,
        velocity: from.velocity,
        acceleration: -from.velocity / BRAKE_S,
        direction: from.direction,
        direction_end: from.direction,
    }
}

/// A uniform quadratic B-spline from the first point by way of the second to the third, at rest at
/// both ends.
///
/// With control points P₀ P₀ P₁ P₂ P₂, piece i begins at (Pᵢ + Pᵢ₊₁)/2 with the velocity
/// (Pᵢ₊₁ − Pᵢ)/h and has the acceleration (Pᵢ₊₂ − 2 Pᵢ₊₁ + Pᵢ)/h². It stays in the triangle of
/// its points.
fn spline(
    [first, via, last]: [(DVec3, DVec3); 3],
    start_s: Seconds,
    duration_s: Seconds,
    pieces: &mut SmallVec<[CuePiece; 4]>,
) {
    let h = duration_s / 3.0;
    let inv_h = 1.0 / h;
    let points = [first, first, via, last, last];
    let knot = |i: usize| {
        let (a, b): ((DVec3, DVec3), (DVec3, DVec3)) = (points[i], points[i + 1]);
        (0.5 * (a.0 + b.0), (0.5 * (a.1 + b.1)).normalize_or(b.1))
    };
    for i in 0..3 {
        let (position, direction) = knot(i);
        pieces.push(CuePiece {
            start_s: start_s + h * i as f64,
            duration_s: h,
            position,
            velocity: (points[i + 1].0 - points[i].0) * inv_h,
            acceleration: (points[i + 2].0 - 2.0 * points[i + 1].0 + points[i].0) * (inv_h * inv_h),
            direction,
            direction_end: knot(i + 1).1,
        });
    }
}
