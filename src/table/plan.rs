//! The plan of a table: where the lines of cushions, jaws and pockets run.
//!
//! A cushion has a frame of its own: `u` along its nose line towards a pocket, `v` from the nose
//! line back into the rail, `z` up. The plan knows one quarter of the table, x ≥ 0 and y ≥ 0; the
//! rest are its mirror images.

use super::parameters::{PocketParameters, TableParameters};
use glam::{DVec2, DVec3};

/// How finely round things are divided.
#[derive(Debug, Clone, Copy)]
pub(super) struct Detail {
    /// Chords of the nose below its front.
    pub nose_below: usize,
    /// Chords of the nose above its front.
    pub nose_above: usize,
    /// Chords of a pocket's front arc, where balls drop.
    pub pocket_front: usize,
    /// Chords of a pocket's back arc.
    pub pocket_back: usize,
    /// Chords of the rounded edge of the slate.
    pub lip: usize,
    /// Rows of a pocket's wall below the lip.
    pub pocket_rows: usize,
    /// Rings of a pocket's bottom.
    pub bottom_rings: usize,
    /// Chords of the rail's outer edge and of the table's outer corner.
    pub edge: usize,
    /// Distance of the points of flat parts [m].
    pub grid_m: f64,
}

/// Unit vector at `angle` [rad] from +x.
pub(super) fn direction(angle: f64) -> DVec2 {
    DVec2::new(libm::cos(angle), libm::sin(angle))
}

/// A jaw: the plane that ends a cushion at a pocket, in the cushion's frame with `u` towards the
/// pocket.
#[derive(Debug, Clone, Copy)]
pub(super) struct Jaw {
    /// u of the nose tip [m].
    pub tip: f64,
    /// Height of the nose [m].
    pub nose: f64,
    /// Direction of the jaw in plan.
    pub along: DVec2,
    /// Tangent of the back draft.
    pub draft: f64,
    /// Middle of the pocket in (u, v) [m].
    pub centre: DVec2,
    /// Radius of the pocket above the slate [m].
    pub radius: f64,
    /// Radius of the vertical cut of the slate [m].
    pub cut: f64,
}

impl Jaw {
    /// u where the plane cuts the line of given `v` and `z`: (u − tip) sin φ − v cos φ =
    /// (z − nose) tan δ, φ the turn from the nose line to the jaw, δ the back draft.
    pub fn u(&self, v: f64, z: f64) -> f64 {
        self.tip + (v * self.along.x + (z - self.nose) * self.draft) / self.along.y
    }

    /// Where the plane enters the pocket's cylinder on the line z = z0 + slope v: (u, v, z).
    pub fn entry(&self, z0: f64, slope: f64) -> Option<DVec3> {
        let start = DVec2::new(self.u(0.0, z0), 0.0);
        let step = DVec2::new(self.u(1.0, z0 + slope) - start.x, 1.0);
        let (a, b) = (step.length_squared(), step.dot(start - self.centre));
        let c = (start - self.centre).length_squared() - self.radius * self.radius;
        let root = b * b - a * c;
        if root <= 0.0 || c <= 0.0 {
            return None;
        }
        let v = (-b - root.sqrt()) / a;
        Some((start + step * v).extend(z0 + slope * v))
    }

    /// u where the line of given `v` enters the pocket's cylinder.
    pub fn cylinder_u(&self, v: f64) -> Option<f64> {
        let off = v - self.centre.y;
        let root = self.radius * self.radius - off * off;
        (root > 0.0).then(|| self.centre.x - root.sqrt())
    }
}

/// A point of a cushion's cross section: v and z [m].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ProfilePoint {
    pub v: f64,
    pub z: f64,
}

/// Lines of one quarter of a table.
#[derive(Debug, Clone)]
pub(super) struct Plan {
    /// Middle of the corner pocket in plan [m].
    pub corner_centre: DVec2,
    /// Middle of the side pocket in plan [m].
    pub side_centre: DVec2,
    /// The jaw that ends the long cushion at the corner; u = x, v = y − width / 2.
    pub long_corner: Jaw,
    /// The jaw that ends the foot cushion at the corner; u = y, v = x − length / 2.
    pub foot_corner: Jaw,
    /// The jaw that ends the long cushion at the side pocket; u = −x, v = y − width / 2.
    pub long_side: Jaw,
    /// Cross section of the cushions, from the foot on the cloth over the nose to the wood.
    pub profile: Vec<ProfilePoint>,
    /// Height where the plane of the top cloth cuts v = 0 [m].
    pub top_z0: f64,
    /// Slope of the top cloth, dz/dv.
    pub top_slope: f64,
}

/// Radius of a pocket above the slate: the vertical cut and the rounding of its edge [m].
pub(super) fn rim_radius(table: &TableParameters, pocket: &PocketParameters) -> f64 {
    pocket.radius_m + table.drop_radius_m
}

/// Middle of the corner pocket in plan, in the quarter x > 0, y > 0 [m].
pub(super) fn corner_centre(table: &TableParameters, corner: &PocketParameters) -> DVec2 {
    let noses = 0.5 * DVec2::new(table.length_m, table.width_m);
    let cut = corner.mouth_m * 0.5f64.sqrt();
    let depth = (corner.shelf_m + corner.radius_m) * 0.5f64.sqrt();
    noses + DVec2::splat(depth - 0.5 * cut)
}

/// Middle of the side pocket in plan, at y > 0 [m].
pub(super) fn side_centre(table: &TableParameters, side: &PocketParameters) -> DVec2 {
    DVec2::new(0.0, 0.5 * table.width_m + side.shelf_m + side.radius_m)
}

impl Plan {
    /// Draws the plan of a table with pockets; `None` if its lines do not meet.
    pub fn new(
        table: &TableParameters,
        [corner, side]: [&PocketParameters; 2],
        detail: &Detail,
    ) -> Option<Plan> {
        let noses = 0.5 * DVec2::new(table.length_m, table.width_m);
        let corner_centre = corner_centre(table, corner);
        let side_centre = side_centre(table, side);
        let cut = corner.mouth_m * 0.5f64.sqrt();
        let jaw = |pocket: &PocketParameters, tip: f64, centre: DVec2| Jaw {
            tip,
            nose: table.nose_height_m(),
            along: direction((180.0 - pocket.cut_angle_deg).to_radians()),
            draft: libm::tan(pocket.back_draft_deg.to_radians()),
            centre,
            radius: rim_radius(table, pocket),
            cut: pocket.radius_m,
        };
        let from_corner = corner_centre - noses;
        let long_corner = jaw(corner, noses.x - cut, DVec2::new(corner_centre.x, from_corner.y));
        let foot_corner = jaw(corner, noses.y - cut, DVec2::new(corner_centre.y, from_corner.x));
        let long_side = jaw(side, -0.5 * side.mouth_m, DVec2::new(0.0, side_centre.y - noses.y));

        let (mut profile, top_z0, top_slope) = nose_profile(table, detail);
        // The top cloth gets a line where each jaw meets its pocket's cylinder: there the facing
        // ends and the wall of the pocket begins.
        for jaw in [&long_corner, &long_side] {
            let v = jaw.entry(top_z0, top_slope)?.y;
            if v <= table.nose_radius_m || v >= table.cushion_width_m {
                return None;
            }
            profile.push(ProfilePoint { v, z: top_z0 + top_slope * v });
        }
        profile.push(ProfilePoint { v: table.cushion_width_m, z: table.rail_height_m });
        let tail = profile.len() - 3;
        profile[tail..].sort_by(|a, b| a.v.total_cmp(&b.v));
        Some(Plan {
            corner_centre,
            side_centre,
            long_corner,
            foot_corner,
            long_side,
            profile,
            top_z0,
            top_slope,
        })
    }
}

/// The cross section from the foot to the end of the nose's rounding, and the line z = z0 + slope v
/// of the top cloth. The rounding touches both flat parts without a kink.
pub(super) fn nose_profile(
    table: &TableParameters,
    detail: &Detail,
) -> (Vec<ProfilePoint>, f64, f64) {
    let radius = table.nose_radius_m;
    let centre = DVec2::new(radius, table.nose_height_m());
    // A line from `point` that touches the circle: its normal makes the angle with the line to the
    // centre whose cosine is radius over distance.
    let tangent_angle = |point: DVec2, side: f64| {
        let to = point - centre;
        libm::atan2(to.y, to.x) + side * libm::acos(radius / to.length())
    };
    let foot = DVec2::new(table.cushion_foot_m, 0.0);
    let wood = DVec2::new(table.cushion_width_m, table.rail_height_m);
    // Angles are measured from the front of the nose, up positive.
    let below = core::f64::consts::PI + tangent_angle(foot, -1.0);
    let above = core::f64::consts::PI - tangent_angle(wood, 1.0);
    let mut profile = vec![ProfilePoint { v: foot.x, z: 0.0 }];
    let on_nose = |angle: f64| {
        let p = centre + radius * DVec2::new(-libm::cos(angle), libm::sin(angle));
        ProfilePoint { v: p.x, z: p.y }
    };
    profile.extend(
        (1..=detail.nose_below)
            .rev()
            .map(|i| on_nose(-below * i as f64 / detail.nose_below as f64)),
    );
    profile.push(ProfilePoint { v: 0.0, z: centre.y });
    profile.extend(
        (1..=detail.nose_above).map(|i| on_nose(above * i as f64 / detail.nose_above as f64)),
    );
    let end = profile[profile.len() - 1];
    let slope = (wood.y - end.z) / (wood.x - end.v);
    (profile, end.z - slope * end.v, slope)
}
