//! One quarter of a table's body, x ≥ 0 and y ≥ 0, as triangles.
//!
//! Neighbouring parts share their boundary points bit by bit, so that the whole is closed once the
//! quarter and its three mirror images are joined. Open are only its cuts at x = 0 and y = 0.

use super::flat::{Candidate, fill, grid};
use super::parameters::{PocketParameters, TableParameters};
use super::plan::{Detail, Jaw, Plan};
use super::pocket::{self, Rim};
use super::pocketless;
use glam::{DVec2, DVec3};

/// Which pocket of the quarter.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Hole {
    /// In the corner.
    Corner,
    /// In the middle of the long rail.
    Side,
}

/// What a triangle of the body is part of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Part {
    /// The flat cloth between the cushions.
    Bed,
    /// The cushion at +y and its two facings.
    LongCushion,
    /// The cushion at +x and its facings.
    FootCushion,
    /// The rounded edge of the slate in a pocket.
    Lip(Hole),
    /// The wall of a pocket below the cloth.
    Wall(Hole),
    /// The wall of a pocket between cloth and top of the rail.
    Back(Hole),
    /// The bottom of a pocket.
    Bottom(Hole),
    /// The flat top of the rails.
    RailTop,
    /// The outer side of the rails and their rounded edge.
    RailSide,
    /// The outer side of the frame under the rails.
    Frame,
    /// The underside.
    Underside,
}

/// A triangle of the body, anticlockwise seen from outside.
#[derive(Debug, Clone, Copy)]
pub(super) struct Triangle {
    pub corners: [DVec3; 3],
    pub part: Part,
}

/// Collects triangles and turns each so that its normal points out of the solid.
#[derive(Debug, Default)]
pub(super) struct Body {
    pub triangles: Vec<Triangle>,
}

impl Body {
    /// Adds a triangle whose normal points to the side of `outward`.
    pub fn triangle(&mut self, part: Part, corners: [DVec3; 3], outward: DVec3) {
        // The cuts must lie exactly in the mirror planes; cos(90°) leaves a trace.
        let [a, b, c] = corners.map(|p| DVec3::new(snap(p.x), snap(p.y), p.z));
        if a == b || b == c || c == a {
            return;
        }
        let turned = (b - a).cross(c - a).dot(outward) < 0.0;
        let corners = if turned { [a, c, b] } else { [a, b, c] };
        self.triangles.push(Triangle { corners, part });
    }

    /// Joins two lines of equally many points by a strip. `outward` gets the middle of a triangle.
    pub fn strip(
        &mut self,
        part: impl Fn(usize) -> Part,
        lower: &[DVec3],
        upper: &[DVec3],
        outward: impl Fn(DVec3) -> DVec3,
    ) {
        for (i, (low, high)) in lower.windows(2).zip(upper.windows(2)).enumerate() {
            for corners in [[low[0], low[1], high[1]], [low[0], high[1], high[0]]] {
                let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
                self.triangle(part(i), corners, outward(middle));
            }
        }
    }

    /// Fills a boundary, given in space and in the coordinates of its surface.
    pub fn sheet(
        &mut self,
        part: Part,
        boundary: &[(DVec3, DVec2)],
        candidates: &[Candidate],
        lift: impl Fn(DVec2) -> DVec3,
        outward: impl Fn(DVec3) -> DVec3,
    ) -> Option<()> {
        let flat: Vec<DVec2> = boundary.iter().map(|(_, p)| *p).collect();
        let filled = fill(&flat, candidates)?;
        let space = |i: usize| boundary.get(i).map_or_else(|| lift(filled.points[i]), |(p, _)| *p);
        for triangle in &filled.triangles {
            let corners = triangle.map(space);
            let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
            self.triangle(part, corners, outward(middle));
        }
        Some(())
    }
}

fn snap(value: f64) -> f64 {
    if value.abs() < 1e-12 { 0.0 } else { value }
}

/// From `a` to `b` in `count` steps, both ends included.
pub(super) fn steps(a: DVec3, b: DVec3, count: usize) -> Vec<DVec3> {
    let mut points: Vec<DVec3> = (0..count).map(|i| a.lerp(b, i as f64 / count as f64)).collect();
    points.push(b);
    points
}

/// How many steps of about `length` go from `a` to `b`.
fn count(a: DVec3, b: DVec3, length: f64) -> usize {
    ((a.distance(b) / length).round() as usize).max(1)
}

/// One end of a cushion, as space points.
#[derive(Debug, Clone)]
pub(super) struct End {
    /// Ends of all lines of the profile.
    pub points: Vec<DVec3>,
    /// Number of the line where the facing meets the cylinder on the top cloth.
    pub star: usize,
    /// Back edge of the facing, from there down to the cloth.
    pub back: Vec<DVec3>,
    /// Lower edge of the facing, from the foot of the cushion to the pocket.
    pub lower: Vec<DVec3>,
}

impl End {
    fn new(plan: &Plan, jaw: &Jaw, detail: &Detail, place: impl Fn(DVec3) -> DVec3) -> Option<End> {
        let meeting = jaw.entry(plan.top_z0, plan.top_slope)?;
        let star = plan.profile.iter().rposition(|p| (p.v - meeting.y).abs() < 1e-9)?;
        let mut points = Vec::new();
        for (j, p) in plan.profile.iter().enumerate() {
            let u = if j <= star { jaw.u(p.v, p.z) } else { jaw.cylinder_u(p.v)? };
            points.push(place(DVec3::new(u, p.v, p.z)));
        }
        let heights = 4;
        let mut back = vec![points[star]];
        for k in 1..=heights {
            let z = plan.profile[star].z * (1.0 - k as f64 / heights as f64);
            back.push(place(jaw.entry(z, 0.0)?));
        }
        let lower = steps(points[0], back[heights], detail.pocket_front / 8);
        Some(End { points, star, back, lower })
    }

    /// The part of the end on the pocket's cylinder, from the facing to the wood.
    pub fn on_cylinder(&self) -> &[DVec3] {
        &self.points[self.star..]
    }
}

/// Builds the quarter; `None` if its lines cross.
pub(super) fn quarter(table: &TableParameters, detail: &Detail) -> Option<Body> {
    match table.pockets() {
        Some(pockets) => pocketed(table, pockets, detail),
        None => pocketless::quarter(table, detail),
    }
}

fn pocketed(
    table: &TableParameters,
    pockets: [&PocketParameters; 2],
    detail: &Detail,
) -> Option<Body> {
    let plan = Plan::new(table, pockets, detail)?;
    let noses = 0.5 * DVec2::new(table.length_m, table.width_m);
    let long = |p: DVec3| DVec3::new(p.x, noses.y + p.y, p.z);
    let foot = |p: DVec3| DVec3::new(noses.x + p.y, p.x, p.z);
    let long_side = End::new(&plan, &plan.long_side, detail, |p| long(DVec3::new(-p.x, p.y, p.z)))?;
    let long_corner = End::new(&plan, &plan.long_corner, detail, long)?;
    let foot_corner = End::new(&plan, &plan.foot_corner, detail, foot)?;
    let foot_middle: Vec<DVec3> =
        plan.profile.iter().map(|p| foot(DVec3::new(0.0, p.v, p.z))).collect();

    let mut body = Body::default();
    let long_lines = cushion(
        &mut body,
        Part::LongCushion,
        &long_side.points,
        &long_corner.points,
        detail.grid_m,
    );
    let foot_lines =
        cushion(&mut body, Part::FootCushion, &foot_middle, &foot_corner.points, detail.grid_m);
    facing(&mut body, Part::LongCushion, &long_side, plan.side_centre)?;
    facing(&mut body, Part::LongCushion, &long_corner, plan.corner_centre)?;
    facing(&mut body, Part::FootCushion, &foot_corner, plan.corner_centre)?;

    let corner = Rim::corner(&plan, detail, &foot_corner, &long_corner);
    let side = Rim::side(table, &plan, detail, &long_side);
    for rim in [&corner, &side] {
        pocket::build(&mut body, table, detail, rim)?;
    }
    // Up the foot rail, round the corner pocket, back along the long rail, round the side pocket.
    let mut edge = foot_lines[0].clone();
    edge.extend_from_slice(&foot_corner.lower[1..]);
    edge.extend_from_slice(&corner.front[1..]);
    edge.extend(long_corner.lower.iter().rev().skip(1));
    edge.extend(long_lines[0].iter().rev().skip(1));
    edge.extend_from_slice(&long_side.lower[1..]);
    edge.extend(side.front.iter().rev().skip(1));
    bed(&mut body, detail, &edge, &[&corner, &side])?;
    // Along pockets and cushions from x = 0 to y = 0.
    let last = plan.profile.len() - 1;
    let mut inner = side.wood.clone();
    inner.extend(long_lines[last].iter().skip(1));
    inner.extend(corner.wood.iter().rev().skip(1));
    inner.extend(foot_lines[last].iter().rev().skip(1));
    frame(&mut body, table, detail, &inner, &[&corner, &side])?;
    Some(body)
}

/// Sweeps the profile from one end to the other; returns the points of each line.
fn cushion(
    body: &mut Body,
    part: Part,
    start: &[DVec3],
    end: &[DVec3],
    grid_m: f64,
) -> Vec<Vec<DVec3>> {
    let count = count(start[0], end[0], grid_m);
    let lines: Vec<Vec<DVec3>> = start.iter().zip(end).map(|(a, b)| steps(*a, *b, count)).collect();
    sweep(body, part, &lines);
    lines
}

/// Joins the lines of a cushion, each of equally many points, to its surface.
pub(super) fn sweep(body: &mut Body, part: Part, lines: &[Vec<DVec3>]) {
    let [first, .., last] = lines else { return };
    let (foot, wood, end) = (first[0], last[0], first[first.len() - 1]);
    // A line inside the rubber, seen from which the whole profile faces outward.
    let core_point = (foot + wood) * 0.5;
    let core = DVec3::new(core_point.x, core_point.y, 0.9 * wood.z);
    let along = (end - foot) * DVec3::new(1.0, 1.0, 0.0);
    let axis = if along.x.abs() > along.y.abs() { DVec3::X } else { DVec3::Y };
    for pair in lines.windows(2) {
        body.strip(|_| part, &pair[0], &pair[1], |p| (p - core).reject_from_normalized(axis));
    }
}

/// The facing of a jaw: flat, between the end of the cushion and the wall of the pocket.
fn facing(body: &mut Body, part: Part, end: &End, pocket_centre: DVec2) -> Option<()> {
    let rim = end.points[..=end.star].iter().chain(&end.back[1..]);
    let lower = &end.lower[1..end.lower.len() - 1];
    let points: Vec<DVec3> = rim.chain(lower.iter().rev()).copied().collect();
    // Coordinates in the plane: along the lower edge, and up.
    let origin = end.points[0];
    let along = (end.back[end.back.len() - 1] - origin).normalize();
    let normal_out = pocket_centre.extend(0.0) - origin;
    let up = (points[end.star] - origin).reject_from_normalized(along).normalize();
    let boundary: Vec<(DVec3, DVec2)> = points
        .iter()
        .map(|p| (*p, DVec2::new((*p - origin).dot(along), (*p - origin).dot(up))))
        .collect();
    let flat: Vec<DVec2> = boundary.iter().map(|(_, p)| *p).collect();
    let lift = |p: DVec2| origin + along * p.x + up * p.y;
    body.sheet(part, &boundary, &grid(&flat, 0.015), lift, |_| normal_out)
}

/// The cloth inside `edge`, which runs from y = 0 round to x = 0 along the feet of the cushions and
/// the rims of the pockets.
pub(super) fn bed(body: &mut Body, detail: &Detail, edge: &[DVec3], rims: &[&Rim]) -> Option<()> {
    let step = detail.grid_m;
    let (on_y0, on_x0) = (*edge.first()?, *edge.last()?);
    let mut points = grid_line(DVec3::ZERO, on_y0, step);
    points.extend(edge.iter().skip(1));
    points.extend(grid_line(DVec3::ZERO, on_x0, step).iter().rev().skip(1));
    points.pop();

    let boundary: Vec<(DVec3, DVec2)> = points.iter().map(|p| (*p, p.truncate())).collect();
    let flat: Vec<DVec2> = boundary.iter().map(|(_, p)| *p).collect();
    let mut candidates = grid(&flat, step);
    for rim in rims {
        candidates.extend(rim.around(0.012, 0.012));
        candidates.extend(rim.around(0.035, 0.028));
    }
    body.sheet(Part::Bed, &boundary, &candidates, |p| p.extend(0.0), |_| DVec3::Z)
}

/// From `a` to `b` with the points in between at whole multiples of `step`, where they have room.
fn grid_line(a: DVec3, b: DVec3, step: f64) -> Vec<DVec3> {
    let along = (b - a).normalize();
    let length = a.distance(b);
    let mut points = vec![a];
    let mut i = 1;
    while (i as f64 + 0.4) * step < length {
        points.push(a + along * (i as f64 * step));
        i += 1;
    }
    points.push(b);
    points
}

/// Rails, outer side and underside. `inner` is the inner edge of the rails, from x = 0 to y = 0.
pub(super) fn frame(
    body: &mut Body,
    table: &TableParameters,
    detail: &Detail,
    inner: &[DVec3],
    rims: &[&Rim],
) -> Option<()> {
    let edge = table.rail_edge_radius_m;
    let top = table.rail_height_m;
    let step = detail.grid_m;
    let quarter_turn = core::f64::consts::FRAC_PI_2;
    let mut rows: Vec<Vec<DVec3>> = (0..=detail.edge)
        .map(|k| {
            let d = direction_of_edge(quarter_turn * k as f64 / detail.edge as f64);
            outline(table, detail, edge * (1.0 - d.x), top - edge * (1.0 - d.y))
        })
        .collect();
    let rail_rows = rows.len();
    // The rail ends where the slate lies; below it the frame.
    rows.push(outline(table, detail, 0.0, -0.055_f64.min(0.5 * table.body_depth_m)));
    rows.push(outline(table, detail, 0.0, -table.body_depth_m));
    let bend = DVec2::new(table.outer_x_m(), table.outer_y_m())
        - DVec2::splat(table.outer_corner_radius_m);
    let outward = |p: DVec3| {
        let core = p.truncate().min(bend).extend(p.z.min(top - edge));
        p - core
    };
    for (k, pair) in rows.windows(2).enumerate() {
        let part = if k < rail_rows { Part::RailSide } else { Part::Frame };
        body.strip(|_| part, &pair[0], &pair[1], outward);
    }

    // Top of the rails: along y = 0 outwards, round the outline, along x = 0 inwards, and back
    // along pockets and cushions.
    let first = &rows[0];
    let (out_y0, out_x0) = (first[0], first[first.len() - 1]);
    let (back_x0, wood_y0) = (*inner.first()?, *inner.last()?);
    let mut points = steps(wood_y0, out_y0, count(wood_y0, out_y0, step));
    points.extend(first.iter().skip(1));
    points.extend(steps(out_x0, back_x0, count(out_x0, back_x0, step)).iter().skip(1));
    points.extend(inner.iter().skip(1));
    points.pop();
    flat_part(body, Part::RailTop, &points, DVec3::Z, step, rims)?;

    let last = &rows[rows.len() - 1];
    let (out_y0, out_x0) = (last[0], last[last.len() - 1]);
    let middle = DVec3::new(0.0, 0.0, out_y0.z);
    let mut points = grid_line(middle, out_y0, 2.0 * step);
    points.extend(last.iter().skip(1));
    points.extend(grid_line(middle, out_x0, 2.0 * step).iter().rev().skip(1));
    points.pop();
    flat_part(body, Part::Underside, &points, DVec3::NEG_Z, 2.0 * step, &[])
}

fn flat_part(
    body: &mut Body,
    part: Part,
    points: &[DVec3],
    normal: DVec3,
    step: f64,
    rims: &[&Rim],
) -> Option<()> {
    let z = points.first()?.z;
    let boundary: Vec<(DVec3, DVec2)> = points.iter().map(|p| (*p, p.truncate())).collect();
    let flat: Vec<DVec2> = boundary.iter().map(|(_, p)| *p).collect();
    let mut candidates = Vec::new();
    for rim in rims {
        candidates.extend(rim.around(0.02, 0.025));
    }
    candidates.extend(grid(&flat, 0.5 * step));
    body.sheet(part, &boundary, &candidates, |p| p.extend(z), |_| normal)
}

/// Direction on the rounded edge: from up (0) to sideways (a quarter turn); x outward, y up.
fn direction_of_edge(angle: f64) -> DVec2 {
    DVec2::new(libm::sin(angle), libm::cos(angle))
}

/// The outline of the table at height `z`, moved inwards by `inset`, from y = 0 to x = 0.
pub(super) fn outline(table: &TableParameters, detail: &Detail, inset: f64, z: f64) -> Vec<DVec3> {
    let outer = DVec2::new(table.outer_x_m(), table.outer_y_m());
    let radius = table.outer_corner_radius_m;
    let bend = outer - DVec2::splat(radius);
    let chords = 2 * detail.edge;
    let arc = |k: usize| {
        let angle = core::f64::consts::FRAC_PI_2 * k as f64 / chords as f64;
        (bend + (radius - inset) * super::plan::direction(angle)).extend(z)
    };
    let start = DVec3::new(outer.x - inset, 0.0, z);
    let end = DVec3::new(0.0, outer.y - inset, z);
    let mut points = grid_line(start, arc(0), detail.grid_m);
    points.extend((1..=chords).map(arc));
    points.extend(grid_line(end, arc(chords), detail.grid_m).iter().rev().skip(1));
    points
}
