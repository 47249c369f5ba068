//! The grid over the terrain: what a ball in a cell can touch, and how far around it is empty.

use super::{Cell, Group, Listed, Round, Terrain, bounds_of};
use crate::physics::fixed_step::narrow::triangle_meets_box;
use crate::physics::fixed_step::spatial_hash::Bounds;
use glam::{DVec3, IVec3};
use std::collections::BTreeMap;

/// Most cells along one axis; bounds the memory of huge meshes.
const CELLS_MAX: i32 = 96;

/// Most cells for each face and edge; bounds the time that small meshes take to prepare.
const CELLS_PER_PART: i32 = 16;

impl Terrain {
    pub(super) fn fill_grid(&mut self, radius_m: f64) {
        self.radius_m = radius_m;
        if self.triangles.is_empty() {
            return;
        }
        let reach = DVec3::splat(radius_m * 1.001 + 1e-6);
        let corners = || self.triangles.iter().flatten().copied();
        let low = corners().fold(DVec3::INFINITY, DVec3::min) - reach;
        let high = corners().fold(DVec3::NEG_INFINITY, DVec3::max) + reach;
        let size = high - low;
        let cells =
            |side: f64| (size / side).ceil().as_ivec3().clamp(IVec3::ONE, IVec3::splat(CELLS_MAX));
        // Not more cells than what they describe is worth.
        let most = CELLS_PER_PART.saturating_mul((self.triangles.len() + self.edges.len()) as i32);
        let mut side = 2.0 * radius_m;
        while cells(side).element_product() > most {
            side *= 1.25;
        }
        self.origin = low;
        self.count = cells(side);
        self.cell_m = size / self.count.as_dvec3();

        let total = (self.count.x * self.count.y * self.count.z) as usize;
        let mut groups: Vec<Vec<(u32, u32)>> = vec![Vec::new(); total];
        let mut edges: Vec<Vec<Listed>> = vec![Vec::new(); total];
        let mut corner_lists: Vec<Vec<Listed>> = vec![Vec::new(); total];
        for (number, triangle) in self.triangles.iter().enumerate() {
            let patch = self.faces[number];
            self.visit(triangle, reach.x, |cell| groups[cell].push((patch, number as u32)));
        }
        for (number, edge) in self.edges.iter().enumerate() {
            let end = edge.from + edge.along * edge.length_m;
            let around = Round::of([edge.from, end].into_iter());
            let listed = Listed { number: number as u32, around };
            self.visit(&[edge.from, end, end], reach.x, |cell| edges[cell].push(listed));
        }
        for (number, corner) in self.corners.iter().enumerate() {
            let around = Round { middle: corner.point, radius_m: 0.0 };
            let listed = Listed { number: number as u32, around };
            self.visit(&[corner.point; 3], reach.x, |cell| corner_lists[cell].push(listed));
        }

        // Which patch is named most often in cells that name nothing else.
        let mut alone: BTreeMap<u32, u32> = BTreeMap::new();
        let single = |cell: usize| {
            let first = groups[cell].first()?.0;
            let same = groups[cell].iter().all(|(patch, _)| *patch == first);
            (same && edges[cell].is_empty() && corner_lists[cell].is_empty()).then_some(first)
        };
        for cell in 0..total {
            if let Some(patch) = single(cell) {
                *alone.entry(patch).or_default() += 1;
            }
        }
        let most = alone.iter().max_by_key(|(patch, count)| (**count, u32::MAX - **patch));
        self.main = most.map_or(u32::MAX, |(patch, _)| *patch);
        let nothing = |cell: usize| {
            groups[cell].is_empty() && edges[cell].is_empty() && corner_lists[cell].is_empty()
        };
        let empty: Vec<bool> = (0..total).map(nothing).collect();
        let bare: Vec<bool> =
            (0..total).map(|cell| empty[cell] || single(cell) == Some(self.main)).collect();
        self.empty = rings(&empty, self.count);
        self.bare = rings(&bare, self.count);

        for cell in 0..total {
            let mut own = Cell::default();
            own.groups.0 = self.groups.len() as u32;
            groups[cell].sort_unstable();
            for run in groups[cell].chunk_by(|a, b| a.0 == b.0) {
                let first = self.cell_triangles.len() as u32;
                self.cell_triangles.extend(run.iter().map(|(_, triangle)| *triangle));
                let points =
                    run.iter().flat_map(|(_, triangle)| self.triangles[*triangle as usize]);
                let (bounds, around) = (bounds_of(points.clone()), Round::of(points));
                let (patch, count) = (run[0].0, run.len() as u32);
                self.groups.push(Group { patch, first, count, bounds, around });
            }
            own.groups.1 = self.groups.len() as u32;
            own.edges.0 = self.cell_edges.len() as u32;
            self.cell_edges.append(&mut edges[cell]);
            own.edges.1 = self.cell_edges.len() as u32;
            own.corners.0 = self.cell_corners.len() as u32;
            self.cell_corners.append(&mut corner_lists[cell]);
            own.corners.1 = self.cell_corners.len() as u32;
            self.cells.push(own);
        }
    }

    /// Calls `found` for each cell in which a ball's centre may lie when it touches the triangle.
    fn visit(&self, triangle: &[DVec3; 3], reach: f64, mut found: impl FnMut(usize)) {
        let bounds = bounds_of(triangle.iter().copied());
        let last = self.count - 1;
        let low = self.cell_of(bounds.min - reach).clamp(IVec3::ZERO, last);
        let high = self.cell_of(bounds.max + reach).clamp(IVec3::ZERO, last);
        for z in low.z..=high.z {
            for y in low.y..=high.y {
                for x in low.x..=high.x {
                    let cell = IVec3::new(x, y, z);
                    let min = self.origin + cell.as_dvec3() * self.cell_m;
                    let cell_box = Bounds { min, max: min + self.cell_m };
                    if triangle_meets_box(triangle, &cell_box, reach)
                        && let Some(index) = self.index(cell)
                    {
                        found(index);
                    }
                }
            }
        }
    }
}

/// For each cell the number of rings around it, itself included, in which all cells are `free`.
/// Beyond the grid everything is.
fn rings(free: &[bool], count: IVec3) -> Vec<u8> {
    let mut ring: Vec<u8> = free.iter().map(|free| if *free { u8::MAX } else { 0 }).collect();
    let index = |x: i32, y: i32, z: i32| ((z * count.y + y) * count.x + x) as usize;
    // Chebyshev distance separates: axis by axis, there and back, would give the city distance;
    // the full neighbourhood in two passes gives it exactly.
    let neighbours: Vec<IVec3> = (0..27)
        .map(|k| IVec3::new(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1))
        .filter(|n| n.z < 0 || n.z == 0 && (n.y < 0 || n.y == 0 && n.x < 0))
        .collect();
    for forwards in [true, false] {
        let total = count.x * count.y * count.z;
        for step in 0..total {
            let place = if forwards { step } else { total - 1 - step };
            let cell =
                IVec3::new(place % count.x, place / count.x % count.y, place / (count.x * count.y));
            let mut least = ring[place as usize];
            for offset in &neighbours {
                let other = if forwards { cell + *offset } else { cell - *offset };
                if other.cmpge(IVec3::ZERO).all() && other.cmplt(count).all() {
                    least = least.min(ring[index(other.x, other.y, other.z)].saturating_add(1));
                }
            }
            ring[place as usize] = least;
        }
    }
    ring
}
