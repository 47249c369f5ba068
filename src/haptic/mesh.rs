//! The fixed world as a finger feels it: faces in a grid of cells, and half spaces.
//!
//! Made once, before the servo begins; a look-up allocates nothing.

use crate::table::{Plane, Table};
use glam::DVec3;

/// Edge of a cell [m]: a few tip radii.
const CELL_M: f64 = 0.04;
/// Most cells of the grid; a larger world has larger cells.
const CELLS_MAX: f64 = 4e6;
/// Most entries of all cells together: many faces that each cross the whole world would fill every
/// cell of it.
const MEMBERS_MAX: f64 = 8e6;

/// Everything fixed that can be felt.
#[derive(Debug, Clone, Default)]
pub struct HapticMesh {
    faces: Vec<[DVec3; 3]>,
    planes: Vec<Plane>,
    /// Lower corner of the grid [m].
    low: DVec3,
    cell_m: f64,
    count: [usize; 3],
    /// Where each cell begins in `members`; one more than there are cells.
    begins: Vec<u32>,
    members: Vec<u32>,
}

impl HapticMesh {
    /// The faces that balls touch, the trim of a pool table, and the planes.
    pub fn of(table: &Table) -> Self {
        let mut mesh = table.mesh.clone();
        mesh.append(&table.trim());
        let faces = (0..mesh.faces.len()).map(|index| mesh.corners(index)).collect();
        HapticMesh::new(faces, table.planes.clone())
    }

    /// These faces and planes.
    pub fn new(faces: Vec<[DVec3; 3]>, planes: Vec<Plane>) -> Self {
        let mut mesh = HapticMesh { faces, planes, ..HapticMesh::default() };
        if mesh.faces.is_empty() {
            return mesh;
        }
        let corners = || mesh.faces.iter().flatten();
        let low = corners().fold(DVec3::INFINITY, |low, corner| low.min(*corner));
        let high = corners().fold(DVec3::NEG_INFINITY, |high, corner| high.max(*corner));
        let size = high - low;
        let cells = |edge: f64| {
            size.to_array().iter().map(|side| libm::floor(side / edge) + 1.0).product::<f64>()
        };
        // At most: a face may begin anywhere in a cell.
        let listed = |[a, b, c]: &[DVec3; 3], edge: f64| {
            let size = a.max(*b).max(*c) - a.min(*b).min(*c);
            size.to_array().iter().map(|side| libm::floor(side / edge) + 2.0).product::<f64>()
        };
        let members = |edge: f64| mesh.faces.iter().map(|face| listed(face, edge)).sum::<f64>();
        let mut cell_m = CELL_M;
        while cells(cell_m) > CELLS_MAX || cells(cell_m) > 1.0 && members(cell_m) > MEMBERS_MAX {
            cell_m *= 2.0;
        }
        (mesh.low, mesh.cell_m) = (low, cell_m);
        mesh.count = size.to_array().map(|side| libm::floor(side / cell_m) as usize + 1);
        mesh.sort_into_cells();
        mesh
    }

    fn sort_into_cells(&mut self) {
        let cells: usize = self.count.iter().product();
        let spans: Vec<[[usize; 2]; 3]> = self
            .faces
            .iter()
            .map(|corners| {
                let [a, b, c] = *corners;
                self.span(a.min(b).min(c), a.max(b).max(c))
            })
            .collect();
        let mut begins = vec![0_u32; cells + 1];
        for span in &spans {
            self.each_cell(span, |cell| begins[cell + 1] += 1);
        }
        for cell in 0..cells {
            begins[cell + 1] += begins[cell];
        }
        let mut next = begins.clone();
        let mut members = vec![0; begins[cells] as usize];
        for (face, span) in spans.iter().enumerate() {
            self.each_cell(span, |cell| {
                members[next[cell] as usize] = face as u32;
                next[cell] += 1;
            });
        }
        (self.begins, self.members) = (begins, members);
    }

    /// The cells of a box, axis by axis: first and last, cut to the grid.
    fn span(&self, low: DVec3, high: DVec3) -> [[usize; 2]; 3] {
        let mut span = [[0; 2]; 3];
        for (i, ends) in span.iter_mut().enumerate() {
            let place = |x: f64| libm::floor((x - self.low[i]) / self.cell_m).max(0.0) as usize;
            *ends = [place(low[i]), place(high[i]).min(self.count[i] - 1)];
        }
        span
    }

    fn each_cell(&self, span: &[[usize; 2]; 3], mut visit: impl FnMut(usize)) {
        for z in span[2][0]..=span[2][1] {
            for y in span[1][0]..=span[1][1] {
                for x in span[0][0]..=span[0][1] {
                    visit((z * self.count[1] + y) * self.count[0] + x);
                }
            }
        }
    }

    /// Calls `visit` with the nearest point of every face within `reach_m` of `centre`; a face may
    /// be visited more than once.
    pub(super) fn each_near(&self, centre: DVec3, reach_m: f64, mut visit: impl FnMut(DVec3)) {
        if self.faces.is_empty() {
            return;
        }
        let high = self.low + DVec3::from_array(self.count.map(|n| n as f64)) * self.cell_m;
        let reach = DVec3::splat(reach_m);
        let is_outside =
            (centre + reach).cmplt(self.low).any() || (centre - reach).cmpgt(high).any();
        if is_outside {
            return;
        }
        let span = self.span(centre - reach, centre + reach);
        self.each_cell(&span, |cell| {
            let (begin, end) = (self.begins[cell] as usize, self.begins[cell + 1] as usize);
            for face in &self.members[begin..end] {
                let point = nearest(&self.faces[*face as usize], centre);
                if point.distance_squared(centre) <= reach_m * reach_m {
                    visit(point);
                }
            }
        });
    }

    /// The half spaces.
    pub(super) fn planes(&self) -> &[Plane] {
        &self.planes
    }

    /// How many faces it has.
    pub fn face_count(&self) -> usize {
        self.faces.len()
    }
}

/// The point of a triangle nearest to `p` (Ericson, Real-Time Collision Detection, 5.1.5).
fn nearest([a, b, c]: &[DVec3; 3], p: DVec3) -> DVec3 {
    let (ab, ac, ap) = (*b - *a, *c - *a, p - *a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return *a;
    }
    let bp = p - *b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return *b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return *a + ab * (d1 / (d1 - d3));
    }
    let cp = p - *c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return *c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return *a + ac * (d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        return *b + (*c - *b) * ((d4 - d3) / (d4 - d3 + d5 - d6));
    }
    let scale = 1.0 / (va + vb + vc);
    *a + ab * (vb * scale) + ac * (vc * scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The nearest point by brute force: over a fine net of the triangle.
    fn by_force(corners: &[DVec3; 3], p: DVec3) -> f64 {
        let n = 200;
        let mut best = f64::INFINITY;
        for i in 0..=n {
            for j in 0..=n - i {
                let (u, v) = (f64::from(i) / f64::from(n), f64::from(j) / f64::from(n));
                let point = corners[0] * (1.0 - u - v) + corners[1] * u + corners[2] * v;
                best = best.min(point.distance(p));
            }
        }
        best
    }

    #[test]
    fn the_nearest_point_is_nearest_from_every_side() {
        let corners = [DVec3::ZERO, DVec3::new(1.0, 0.1, 0.0), DVec3::new(0.3, 0.8, 0.2)];
        for i in 0..60 {
            let angle = f64::from(i) * 0.7;
            let p = DVec3::new(
                0.4 + 1.2 * libm::cos(angle),
                0.3 + 1.2 * libm::sin(1.3 * angle),
                0.5 * libm::sin(2.1 * angle),
            );
            let found = nearest(&corners, p).distance(p);
            let force = by_force(&corners, p);
            assert!(found <= force + 1e-12 && force < found + 0.01, "{found} {force}");
        }
    }

    #[test]
    fn many_large_faces_cost_little() {
        let slope = [DVec3::ZERO, DVec3::splat(6.0), DVec3::new(6.0, 6.0, 5.9)];
        let mesh = HapticMesh::new(vec![slope; 2_000], Vec::new());
        assert!(mesh.members.len() as f64 <= MEMBERS_MAX, "{}", mesh.members.len());
        let mut seen = 0;
        mesh.each_near(DVec3::splat(3.0), 0.1, |_| seen += 1);
        assert!(seen >= 2_000, "{seen}");
        // The table of a game keeps its small cells.
        assert_eq!(HapticMesh::of(&Table::preset("pool-9ft").unwrap()).cell_m, CELL_M);
    }

    #[test]
    fn the_grid_finds_what_a_walk_over_all_faces_finds() {
        let table = Table::preset("pool-9ft").unwrap();
        let mesh = HapticMesh::of(&table);
        for i in 0..200 {
            let k = f64::from(i);
            let centre = DVec3::new(
                1.6 * libm::sin(k * 0.37),
                0.9 * libm::cos(k * 0.91),
                0.05 * libm::sin(k * 1.7),
            );
            let reach = 0.03;
            let mut seen = 0.0_f64;
            mesh.each_near(centre, reach, |point| seen = seen.max(reach - point.distance(centre)));
            let walked = mesh.faces.iter().map(|face| nearest(face, centre).distance(centre));
            let expected = walked.fold(0.0_f64, |most, distance| most.max(reach - distance));
            assert_eq!(seen, expected);
        }
    }
}
