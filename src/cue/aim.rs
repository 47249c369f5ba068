//! Aim: where the cue points and where its tip will meet the cue ball, whoever holds it.

use super::{TIP_RADIUS_M, shaft_radius};
use glam::{DVec2, DVec3};

/// Largest distance of the contact point from the middle of the ball, in ball radii. Beyond
/// about 0.55 R a chalked tip slips off (a miscue).
pub const OFFSET_LIMIT: f64 = 0.5;

/// How far the shaft stays away from balls that it passes over, besides the tip's radius [m].
const SHAFT_MARGIN_M: f64 = 0.003;

/// How a cue is held against the cue ball.
#[derive(Debug, Default, Clone, Copy, PartialEq)]
pub struct Aim {
    /// Horizontal direction of the stroke, anticlockwise from +x [rad].
    pub azimuth_rad: f64,
    /// How far the butt is raised [rad]; 0 is a level cue.
    pub elevation_rad: f64,
    /// Contact point right of the middle as the player sees it, in ball radii.
    pub side_offset: f64,
    /// Contact point above the middle, at right angles to the shaft, in ball radii.
    pub height_offset: f64,
}

impl Aim {
    /// A level cue through the middle of the ball, along a horizontal direction.
    pub fn along(direction: DVec2) -> Self {
        Aim { azimuth_rad: libm::atan2(direction.y, direction.x), ..Aim::default() }
    }

    /// The same with an offset that lies within [`OFFSET_LIMIT`]; its direction stays.
    pub fn limited(mut self) -> Self {
        let size = libm::hypot(self.side_offset, self.height_offset);
        if size > OFFSET_LIMIT {
            self.side_offset *= OFFSET_LIMIT / size;
            self.height_offset *= OFFSET_LIMIT / size;
        }
        self
    }

    /// Unit vector along the shaft, from butt to tip; points down if the butt is raised.
    pub fn direction(&self) -> DVec3 {
        let (sin_a, cos_a) = libm::sincos(self.azimuth_rad);
        let (sin_e, cos_e) = libm::sincos(self.elevation_rad);
        DVec3::new(cos_e * cos_a, cos_e * sin_a, -sin_e)
    }

    /// Unit vector to the player's right, horizontal.
    pub fn right(&self) -> DVec3 {
        let (sin_a, cos_a) = libm::sincos(self.azimuth_rad);
        DVec3::new(sin_a, -cos_a, 0.0)
    }

    /// Unit vector upwards, at right angles to shaft and [`Aim::right`].
    pub fn up(&self) -> DVec3 {
        self.right().cross(self.direction())
    }

    /// Unit vector from the middle of the ball to where the tip meets it.
    ///
    /// `n = −√(1 − s² − h²) d + s r + h u`: `d` along the shaft, `r` right, `u` up, `s` and `h` the
    /// offsets. A middle hit gives −d.
    pub fn contact_normal(&self) -> DVec3 {
        let Aim { side_offset: s, height_offset: h, .. } = self.limited();
        self.direction() * -(1.0 - s * s - h * h).sqrt() + self.right() * s + self.up() * h
    }

    /// How far the shaft's axis passes the middle of the ball to the right and above [m], at
    /// right angles to the shaft.
    pub fn axis_offset(&self, ball_radius_m: f64) -> (f64, f64) {
        let Aim { side_offset, height_offset, .. } = self.limited();
        let apart = ball_radius_m + TIP_RADIUS_M;
        (side_offset * apart, height_offset * apart)
    }

    /// Where the tip meets the ball [m].
    pub fn contact_point(&self, ball_centre: DVec3, ball_radius_m: f64) -> DVec3 {
        ball_centre + self.contact_normal() * ball_radius_m
    }

    /// Centre of a pool cue's tip sphere when it meets the ball [m]: both spheres share the normal.
    pub fn tip_at_contact(&self, ball_centre: DVec3, ball_radius_m: f64) -> DVec3 {
        self.tip_of_radius_at_contact(TIP_RADIUS_M, ball_centre, ball_radius_m)
    }

    /// The same for a tip of another radius [m].
    pub fn tip_of_radius_at_contact(
        &self,
        tip_radius_m: f64,
        ball_centre: DVec3,
        ball_radius_m: f64,
    ) -> DVec3 {
        ball_centre + self.contact_normal() * (ball_radius_m + tip_radius_m)
    }

    /// The same, pulled back along the shaft by `distance_m` [m].
    pub fn tip_pulled_back(
        &self,
        ball_centre: DVec3,
        ball_radius_m: f64,
        distance_m: f64,
    ) -> DVec3 {
        self.tip_at_contact(ball_centre, ball_radius_m) - self.direction() * distance_m
    }
}

/// Smallest elevation at which the cue of `aim` passes over the balls behind the cue ball [rad];
/// its own elevation does not matter. Up to a quarter turn: more than a hand holds.
///
/// The shaft's axis passes the cue ball's middle at `a = (R + ρ) s` to the right and
/// `b = (R + ρ) h` above, with s and h the offsets of the tip and ρ its radius. A ball at the
/// distance `k` behind and `l` to the right is `√((k sin θ + b)² + (l − a)²)` away from the axis,
/// which must be at least `R + ρ`, or R and the shaft's radius there if that is more:
/// `sin θ ≥ (√((R + ρ)² − (l − a)²) − b) / k`. Nothing behind gives 0.
pub fn elevation_over_balls(
    cue_ball: DVec2,
    aim: &Aim,
    others: impl IntoIterator<Item = DVec2>,
    ball_radius_m: f64,
) -> f64 {
    let aim = Aim { elevation_rad: 0.0, ..aim.limited() };
    let direction = aim.direction().truncate();
    let (right_m, above_m) = aim.axis_offset(ball_radius_m);
    let steepest = others
        .into_iter()
        .filter_map(|ball| {
            let back = (cue_ball - ball).dot(direction);
            let beside = (ball - cue_ball).perp_dot(direction) - right_m;
            let reach = ball_radius_m + shaft_radius(back).max(TIP_RADIUS_M) + SHAFT_MARGIN_M;
            let behind = 0.0 < back && back < super::CUE_LENGTH_M && beside.abs() < reach;
            behind.then(|| ((reach * reach - beside * beside).sqrt() - above_m) / back)
        })
        .fold(0.0, f64::max);
    libm::asin(steepest.min(1.0))
}
