//! A stretch of a path: where it leaves a box, what it may meet, where it is.

use crate::physics::event_driven::closing::{self, Relative};
use crate::physics::event_driven::terrain::{BESIDE_M, Corner, Edge};
use crate::physics::tolerance;
use crate::units::Seconds;
use glam::{DVec2, DVec3};

/// A stretch of the path inside one cell.
#[derive(Clone, Copy)]
pub struct Slice {
    /// When it begins [s].
    pub start: Seconds,
    /// How long it is [s].
    pub length: Seconds,
    /// Centre where it begins [m].
    pub position: DVec3,
    /// Velocity there [m/s].
    pub velocity: DVec3,
    /// Acceleration [m/s²].
    pub acceleration: DVec3,
}

impl Slice {
    /// When it ends [s].
    pub fn end(&self) -> Seconds {
        self.start + self.length
    }

    /// Cuts it where it leaves a box, and says through which side; none if it ends inside.
    pub fn cut_at(&mut self, min: DVec3, max: DVec3) -> Option<(usize, bool)> {
        self.cut_along(min.to_array(), max.to_array())
    }

    /// Cuts it where it leaves a box that has no top and no bottom.
    pub fn cut_at_sides(&mut self, min: DVec2, max: DVec2) -> Option<(usize, bool)> {
        self.cut_along(min.to_array(), max.to_array())
    }

    fn cut_along<const AXES: usize>(
        &mut self,
        min: [f64; AXES],
        max: [f64; AXES],
    ) -> Option<(usize, bool)> {
        let (position, velocity) = (self.position.to_array(), self.velocity.to_array());
        let acceleration = self.acceleration.to_array();
        let whole = self.length;
        let mut side = None;
        for axis in 0..AXES {
            let (x, v, a) = (position[axis], velocity[axis], acceleration[axis]);
            // Which sides it crosses at all, its ends and the turn between them say without a root.
            let end = x + (v + 0.5 * a * whole) * whole;
            let turns = v * a < 0.0 && v.abs() < a.abs() * whole;
            let turn = if turns { x - 0.5 * v * v / a } else { x };
            let least = if x < end { x } else { end };
            let most = if x < end { end } else { x };
            if least < min[axis] || turn < min[axis] {
                self.cut(
                    closing::falling_quadratic(x - min[axis], v, a, self.length),
                    &mut side,
                    (axis, false),
                );
            }
            if max[axis] < most || max[axis] < turn {
                self.cut(
                    closing::falling_quadratic(max[axis] - x, -v, -a, self.length),
                    &mut side,
                    (axis, true),
                );
            }
        }
        side
    }

    /// Ends it at a time through a side, if that comes first.
    fn cut(
        &mut self,
        time: Option<Seconds>,
        side: &mut Option<(usize, bool)>,
        through: (usize, bool),
    ) {
        if let Some(time) = time
            && (time < self.length || side.is_none())
        {
            self.length = time;
            *side = Some(through);
        }
    }

    /// Whether a path that leaves the grid along an axis may come back.
    pub fn returns(&self, axis: usize, up: bool) -> bool {
        let sign = if up { 1.0 } else { -1.0 };
        sign * self.velocity[axis] < 0.0 || sign * self.acceleration[axis] < 0.0
    }

    /// A ball around it: it lies within the triangle of its ends and its control point.
    pub fn span(&self, radius_m: f64) -> Span {
        let bend = self.acceleration * (0.25 * self.length * self.length);
        let half = self.velocity * (0.5 * self.length) + bend;
        let middle = self.position + half;
        let square = half.length_squared().max(bend.length_squared());
        let half_m = square.sqrt();
        Span {
            middle,
            reach_m: half_m + radius_m + tolerance::SUPPORT_M,
            beside_m: half_m + BESIDE_M,
        }
    }

    /// Centre at a time after its begin [m].
    pub fn at(&self, time: Seconds) -> DVec3 {
        self.position + (self.velocity + self.acceleration * (0.5 * time)) * time
    }

    /// The path seen from a point.
    pub fn relative_to(&self, point: DVec3) -> Relative {
        Relative {
            offset: self.position - point,
            velocity: self.velocity,
            acceleration: self.acceleration,
        }
    }
}

/// A ball around a stretch of the path of the centre.
pub struct Span {
    pub middle: DVec3,
    /// How far from the middle the moving ball can touch something [m].
    pub reach_m: f64,
    /// How far beside a feature the middle must be for all of the path to be [m].
    beside_m: f64,
}

impl Span {
    /// Whether an edge may be met: beside one of its faces the face is nearer.
    pub fn may_meet_edge(&self, edge: &Edge) -> bool {
        let offset = self.middle - edge.from;
        let along = offset.dot(edge.along);
        let beside = |(_, inwards): &(u32, DVec3)| offset.dot(*inwards) > self.beside_m;
        -self.beside_m <= along
            && along <= edge.length_m + self.beside_m
            && offset.length_squared() - along * along <= self.reach_m * self.reach_m
            && !edge.sides.iter().any(beside)
    }

    /// Whether a corner may be met: beside one of its edges the edge is nearer.
    pub fn may_meet_corner(&self, corner: &Corner) -> bool {
        let offset = self.middle - corner.point;
        let beside = |away: &DVec3| offset.dot(*away) > self.beside_m;
        offset.length_squared() <= self.reach_m * self.reach_m && !corner.away.iter().any(beside)
    }
}
