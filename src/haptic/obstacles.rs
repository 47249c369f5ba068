//! What keeps a sphere out: faces, planes and balls, each as a nearest point.

use super::mesh::HapticMesh;
use super::scene::BALLS_MAX;
use glam::DVec3;

/// A ball that is touched.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Round {
    /// Its place among the balls of the world.
    pub index: usize,
    /// Centre [m].
    pub centre: DVec3,
    /// Radius [m].
    pub radius_m: f64,
}

/// What a sphere touches there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Obstacle {
    /// A face or plane.
    Face,
    /// The ball of this index.
    Ball(usize),
}

/// A place where a sphere is too deep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Touch {
    /// Unit vector out of the obstacle.
    pub normal: DVec3,
    /// How deep [m].
    pub depth_m: f64,
    /// What it is.
    pub obstacle: Obstacle,
}

/// Everything that keeps a sphere out in one tick.
#[derive(Debug, Clone, Copy)]
pub(super) struct Obstacles<'a> {
    /// The fixed world.
    pub mesh: Option<&'a HapticMesh>,
    /// The balls that only yield to physics; none where [`None`].
    pub balls: [Option<Round>; BALLS_MAX],
}

impl Obstacles<'_> {
    /// Where a sphere about `centre` is deepest, if it is deeper than `least_m` anywhere. `side`
    /// is the way out of something whose surface goes through the centre.
    pub fn deepest(
        &self,
        centre: DVec3,
        radius_m: f64,
        least_m: f64,
        side: DVec3,
    ) -> Option<Touch> {
        let mut worst: Option<Touch> = None;
        let mut take = |normal: DVec3, depth_m: f64, obstacle: Obstacle| {
            if depth_m > least_m && worst.is_none_or(|worst| worst.depth_m < depth_m) {
                worst = Some(Touch { normal, depth_m, obstacle });
            }
        };
        if let Some(mesh) = self.mesh {
            mesh.each_near(centre, radius_m, |point| {
                let out = centre - point;
                take(out.normalize_or(side), radius_m - out.length(), Obstacle::Face);
            });
            for plane in mesh.planes() {
                let height = (centre - plane.point).dot(plane.normal);
                take(plane.normal, radius_m - height, Obstacle::Face);
            }
        }
        for ball in self.balls.iter().flatten() {
            let out = centre - ball.centre;
            let depth_m = radius_m + ball.radius_m - out.length();
            take(out.normalize_or(side), depth_m, Obstacle::Ball(ball.index));
        }
        worst
    }

    /// Where a sphere comes to that goes from `from` to `to` in steps so short that it does not get
    /// through a face, each of which moves it out of whatever it is in. The normals of what was
    /// touched go to `each`, the last at the end.
    pub fn swept(
        &self,
        from: DVec3,
        to: DVec3,
        radius_m: f64,
        side: DVec3,
        mut each: impl FnMut(&Touch),
    ) -> DVec3 {
        /// Longest step as a share of the radius, and most steps.
        const STEP: f64 = 0.5;
        const STEPS_MAX: f64 = 40.0;
        let count = (from.distance(to) / (STEP * radius_m)).ceil().clamp(1.0, STEPS_MAX);
        let step = (to - from) / count;
        let mut centre = from;
        for _ in 1..count as u32 {
            centre = self.pushed_out(centre + step, radius_m, side, &mut each);
        }
        // A step that is the whole way ends just there.
        let last = if count == 1.0 { to } else { centre + step };
        self.pushed_out(last, radius_m, side, &mut each)
    }

    /// `centre`, moved out of whatever it is in. What was touched first is the second value; the
    /// normals go to `each`.
    pub fn pushed_out(
        &self,
        mut centre: DVec3,
        radius_m: f64,
        side: DVec3,
        mut each: impl FnMut(&Touch),
    ) -> DVec3 {
        // Rounding leaves a sphere that was pushed out this deep [m].
        const LEAST_M: f64 = 1e-9;
        const PASSES: usize = 8;
        for _ in 0..PASSES {
            let Some(touch) = self.deepest(centre, radius_m, LEAST_M, side) else { break };
            centre += touch.normal * touch.depth_m;
            each(&touch);
        }
        centre
    }
}
