//! A pocket: rounded edge of the slate, wall and bottom below the cloth, wall above it.
//!
//! In front, where balls drop, the slate's edge is rounded down to the vertical cut. Behind, the
//! wall (the liner) comes straight down from the rail; the two blend under the jaws.

use super::flat::Candidate;
use super::parameters::TableParameters;
use super::plan::{Detail, Plan, direction};
use super::quarter::{Body, End, Hole, Part, steps};
use glam::{DVec2, DVec3};

/// Angle over which the rounded edge blends into the straight wall [rad].
const BLEND_RAD: f64 = 0.45;

/// The rim of a pocket, where it meets bed, cushions and rails.
#[derive(Debug, Clone)]
pub(super) struct Rim {
    pub hole: Hole,
    /// Middle in plan [m].
    pub centre: DVec2,
    /// Radius above the slate [m].
    radius: f64,
    /// Radius of the vertical cut [m].
    cut: f64,
    /// Angle of the direction from the bed into the pocket [rad].
    heading: f64,
    /// Front edge on the cloth: corner, from the foot cushion to the long one; side, from x = 0 to
    /// the long cushion.
    pub front: Vec<DVec3>,
    /// Back edge at the height of the cloth, from the end of `front` (corner) back to its start;
    /// side: from the end of `front` to x = 0.
    back: Vec<DVec3>,
    /// Edge on the top of the rail; corner: from the foot cushion to the long one; side: from
    /// x = 0 to the long cushion.
    pub wood: Vec<DVec3>,
    /// Edge above `back`, from its start to its end along jaws, cushion tops and wood.
    upper: Vec<DVec3>,
}

impl Rim {
    /// The rim of the corner pocket.
    pub fn corner(plan: &Plan, detail: &Detail, foot: &End, long: &End) -> Rim {
        let mut rim = Rim::bare(Hole::Corner, plan);
        let turn = 2.0 * core::f64::consts::PI;
        let (start, end) = (foot.back[foot.back.len() - 1], long.back[long.back.len() - 1]);
        let (a, b) = (rim.angle(start), rim.angle(end));
        rim.front = rim.arc(a, b - turn, detail.pocket_front, (start, end));
        rim.back = rim.arc(b, a, detail.pocket_back, (end, start));
        let (start, end) = (foot.points[foot.points.len() - 1], long.points[long.points.len() - 1]);
        let (a, b) = (rim.angle(start), rim.angle(end));
        rim.wood = rim.arc(a, b, detail.pocket_back * 3 / 4, (start, end));
        rim.upper = long.back.iter().rev().copied().collect();
        rim.upper.extend(long.on_cylinder().iter().skip(1));
        rim.upper.extend(rim.wood.iter().rev().skip(1));
        rim.upper.extend(foot.on_cylinder().iter().rev().skip(1));
        rim.upper.extend(foot.back.iter().skip(1));
        rim
    }

    /// The half of the side pocket's rim with x ≥ 0.
    pub fn side(table: &TableParameters, plan: &Plan, detail: &Detail, long: &End) -> Rim {
        let mut rim = Rim::bare(Hole::Side, plan);
        let half_turn = core::f64::consts::PI;
        let on_axis = |y: f64, z: f64| DVec3::new(0.0, rim.centre.y + y * rim.radius, z);
        let (front, behind) = (on_axis(-1.0, 0.0), on_axis(1.0, 0.0));
        let above = on_axis(1.0, table.rail_height_m);
        let end = long.back[long.back.len() - 1];
        let b = rim.angle(end);
        rim.front = rim.arc(-half_turn, b, detail.pocket_front / 2, (front, end));
        rim.back = rim.arc(b, 0.0, detail.pocket_back / 2, (end, behind));
        let end = long.points[long.points.len() - 1];
        rim.wood = rim.arc(0.0, rim.angle(end), detail.pocket_back * 3 / 8, (above, end));
        rim.upper = long.back.iter().rev().copied().collect();
        rim.upper.extend(long.on_cylinder().iter().skip(1));
        rim.upper.extend(rim.wood.iter().rev().skip(1));
        rim.upper.extend(steps(above, behind, 3).iter().skip(1));
        rim
    }

    fn bare(hole: Hole, plan: &Plan) -> Rim {
        let quarter_turn = core::f64::consts::FRAC_PI_2;
        let (centre, jaw, heading) = match hole {
            Hole::Corner => (plan.corner_centre, &plan.long_corner, 0.5 * quarter_turn),
            Hole::Side => (plan.side_centre, &plan.long_side, quarter_turn),
        };
        Rim {
            hole,
            centre,
            radius: jaw.radius,
            cut: jaw.cut,
            heading,
            front: Vec::new(),
            back: Vec::new(),
            wood: Vec::new(),
            upper: Vec::new(),
        }
    }

    /// Angle of a point seen from the middle, from the heading [rad], −π to π.
    fn angle(&self, point: DVec3) -> f64 {
        let (off, ahead) = (point.truncate() - self.centre, direction(self.heading));
        libm::atan2(ahead.perp_dot(off), ahead.dot(off))
    }

    /// A point of the cylinder, `angle` from the heading.
    fn on_cylinder(&self, angle: f64, radius: f64, z: f64) -> DVec3 {
        (self.centre + radius * direction(self.heading + angle)).extend(z)
    }

    fn arc(&self, from: f64, to: f64, count: usize, ends: (DVec3, DVec3)) -> Vec<DVec3> {
        let mut points = vec![ends.0];
        points.extend((1..count).map(|k| {
            let angle = from + (to - from) * k as f64 / count as f64;
            self.on_cylinder(angle, self.radius, ends.0.z)
        }));
        points.push(ends.1);
        points
    }

    /// Points on a circle `distance` outside the rim, about `spacing` apart.
    pub fn around(&self, distance: f64, spacing: f64) -> Vec<Candidate> {
        let radius = self.radius + distance;
        let half_turn = core::f64::consts::PI;
        let count = (half_turn * radius / spacing).round() as i32;
        // Symmetric about the heading, so that the corner's two sides look alike.
        (-count..count)
            .map(|k| {
                let angle = half_turn * (f64::from(k) + 0.5) / f64::from(count);
                (self.on_cylinder(angle, radius, 0.0).truncate(), spacing)
            })
            .collect()
    }
}

/// Builds the pocket inside its rim.
pub(super) fn build(
    body: &mut Body,
    table: &TableParameters,
    detail: &Detail,
    rim: &Rim,
) -> Option<()> {
    let ring: Vec<DVec3> = rim.front.iter().chain(rim.back.iter().skip(1)).copied().collect();
    let front_chords = rim.front.len() - 1;
    let blend_from = rim.angle(rim.back[0]).abs();
    // 1 where the edge is rounded, 0 where the wall is straight.
    let angles: Vec<f64> = ring.iter().map(|p| rim.angle(*p)).collect();
    let roundness: Vec<f64> = angles
        .iter()
        .map(|angle| {
            let s = ((blend_from - angle.abs()) / BLEND_RAD).clamp(0.0, 1.0);
            1.0 - s * s * (3.0 - 2.0 * s)
        })
        .collect();
    let row = |radius: f64, z: f64, scale: f64| -> Vec<DVec3> {
        let mut points: Vec<DVec3> = angles
            .iter()
            .zip(&roundness)
            .map(|(angle, s)| {
                let r = rim.radius + (radius - rim.radius) * s;
                rim.on_cylinder(*angle, r * scale, z)
            })
            .collect();
        // A closed ring ends where it began, bit by bit.
        if rim.hole == Hole::Corner {
            let last = points.len() - 1;
            points[last] = points[0];
        }
        points
    };

    let inward = |p: DVec3| rim.centre.extend(0.0) - DVec3::new(p.x, p.y, 0.0);
    let drop = table.drop_radius_m;
    let mut above = ring.clone();
    for k in 1..=detail.lip {
        let angle = core::f64::consts::FRAC_PI_2 * k as f64 / detail.lip as f64;
        let below = row(rim.radius - drop * libm::sin(angle), drop * (libm::cos(angle) - 1.0), 1.0);
        let part = |i| if i < front_chords { Part::Lip(rim.hole) } else { Part::Wall(rim.hole) };
        body.strip(part, &above, &below, |p| inward(p) + DVec3::Z * 0.5 * rim.radius);
        above = below;
    }
    for k in 1..=detail.pocket_rows {
        let s = k as f64 / detail.pocket_rows as f64;
        let below = row(rim.cut, -drop + (drop - table.pocket_depth_m) * s, 1.0);
        body.strip(|_| Part::Wall(rim.hole), &above, &below, inward);
        above = below;
    }
    for k in (1..detail.bottom_rings).rev() {
        let scale = k as f64 / detail.bottom_rings as f64;
        let within = row(rim.cut, -table.pocket_depth_m, scale);
        body.strip(|_| Part::Bottom(rim.hole), &above, &within, |_| DVec3::Z);
        above = within;
    }
    let middle = rim.centre.extend(-table.pocket_depth_m);
    for pair in above.windows(2) {
        body.triangle(Part::Bottom(rim.hole), [pair[0], pair[1], middle], DVec3::Z);
    }

    // The wall above the cloth, unrolled: length of arc along, height up.
    let points: Vec<DVec3> =
        rim.back.iter().rev().chain(&rim.upper[1..rim.upper.len() - 1]).copied().collect();
    let unroll = |p: &DVec3| DVec2::new(rim.radius * rim.angle(*p), p.z);
    let boundary: Vec<(DVec3, DVec2)> = points.iter().map(|p| (*p, unroll(p))).collect();
    let spacing = 0.5 * table.rail_height_m;
    let candidates: Vec<Candidate> = (-40i32..=40)
        .map(|k| (DVec2::new(0.5 * spacing * f64::from(k), spacing), 0.5 * spacing))
        .collect();
    let lift = |p: DVec2| rim.on_cylinder(p.x / rim.radius, rim.radius, p.y);
    body.sheet(Part::Back(rim.hole), &boundary, &candidates, lift, inward)
}
