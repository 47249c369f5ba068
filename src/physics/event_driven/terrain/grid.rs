//! The grid over the terrain: what a ball in a cell can touch, and how far around it is empty.
//!
//! Cells are as wide as a ball; where many things are in reach, as in a pocket, a cell is cut into
//! eight, again and again. A cell lists what a ball with its centre in it can touch: nothing that
//! is too far, no face that the centre is not over, and no edge or corner beside which something
//! else is nearer wherever in the cell the centre is.

use super::plan::Lists;
use super::{Block, Group, Listed, Node, Terrain, bounds_of};
use glam::{DVec3, IVec3};
use std::collections::BTreeMap;

/// Most cells along one axis; bounds the memory of huge meshes.
const CELLS_MAX: i32 = 96;

/// Most cells for each face and edge; bounds the time that small meshes take to prepare.
const CELLS_PER_PART: i32 = 16;

/// A cell may be cut in two along each axis so many times.
const CUTS: i32 = 3;

/// A cell that lists more than this is cut, if it may be.
const LISTED_MAX: usize = 24;

/// Something is beside a feature if it is by this much [m]; far more than a ball is ever pressed
/// into a face.
pub const BESIDE_M: f64 = 1e-4;

/// What is in reach of a ball somewhere in a box.
#[derive(Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Parts {
    /// Patches of which no border is in reach: wherever the centre is, its foot is inside.
    whole: Vec<u32>,
    triangles: Vec<u32>,
    edges: Vec<u32>,
    corners: Vec<u32>,
}

impl Parts {
    /// Adds other parts; each is listed once, in ascending order.
    pub fn join(&mut self, other: Parts) {
        for (list, more) in [
            (&mut self.triangles, other.triangles),
            (&mut self.edges, other.edges),
            (&mut self.corners, other.corners),
        ] {
            list.extend(more);
            list.sort_unstable();
            list.dedup();
        }
    }

    fn len(&self) -> usize {
        self.triangles.len() + self.edges.len() + self.corners.len()
    }
}

/// A box of space.
pub(super) struct Space {
    pub middle: DVec3,
    pub half: DVec3,
    /// How far from it a ball with its centre in it reaches [m].
    pub reach_m: f64,
}

impl Space {
    /// How far it extends from its middle along a unit vector [m].
    fn along(&self, direction: DVec3) -> f64 {
        direction.abs().dot(self.half)
    }

    /// Whether a ball with its centre in it reaches a box.
    fn reaches(&self, low: DVec3, high: DVec3) -> bool {
        let reach = self.half + self.reach_m;
        low.cmple(self.middle + reach).all() && high.cmpge(self.middle - reach).all()
    }
}

impl Terrain {
    pub(super) fn fill_grid(&mut self, radius_m: f64) {
        self.radius_m = radius_m;
        // Without balls nothing is ever met.
        if self.triangles.is_empty() || radius_m <= 0.0 {
            return;
        }
        let reach = DVec3::splat(self.reach_m());
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
        self.count = cells(side) << CUTS;
        self.cell_m = size / self.count.as_dvec3();
        self.inverse_cell = self.count.as_dvec3() / size;

        let cells = self.list_parts();
        self.find_leaps(&cells);
        self.plans = self.draw_plans(&cells, CUTS);
        self.nodes = vec![Node::default(); cells.len()];
        // What a cell's list took is free again before the next is filled.
        let mut last = (Parts::default(), Listed::default());
        for (index, parts) in cells.into_iter().enumerate() {
            let low = self.cell_at(index) << CUTS;
            self.fill(index, parts, low, 1 << CUTS, &mut last);
        }
        self.lists.shrink();
        self.nodes.shrink_to_fit();
    }

    /// The coarse cell with this number.
    fn cell_at(&self, index: usize) -> IVec3 {
        let (count, index) = (self.count >> CUTS, index as i32);
        IVec3::new(index % count.x, index / count.x % count.y, index / (count.x * count.y))
    }

    /// What each coarse cell has in reach.
    fn list_parts(&self) -> Vec<Parts> {
        let count = self.count >> CUTS;
        let mut cells: Vec<Parts> = Vec::new();
        cells.resize_with(count.element_product() as usize, Parts::default);
        for (number, triangle) in self.triangles.iter().enumerate() {
            self.visit(triangle, |cell, space| {
                if self.is_over(number as u32, space) {
                    cells[cell].triangles.push(number as u32);
                }
            });
        }
        for (number, edge) in self.edges.iter().enumerate() {
            let end = edge.from + edge.along * edge.length_m;
            self.visit(&[edge.from, end], |cell, space| {
                if self.is_at_edge(number as u32, space) {
                    cells[cell].edges.push(number as u32);
                }
            });
        }
        for (number, corner) in self.corners.iter().enumerate() {
            self.visit(&[corner.point], |cell, space| {
                if self.is_at_corner(number as u32, space) {
                    cells[cell].corners.push(number as u32);
                }
            });
        }
        cells
    }

    /// Finds the main patch, and how far around each coarse cell nothing is in reach.
    fn find_leaps(&mut self, cells: &[Parts]) {
        // Which patch is named most often in cells that name nothing else.
        let mut alone: BTreeMap<u32, u32> = BTreeMap::new();
        let patch_of = |triangle: &u32| self.faces[*triangle as usize];
        let single = |parts: &Parts| {
            let first = patch_of(parts.triangles.first()?);
            let same = parts.triangles.iter().all(|triangle| patch_of(triangle) == first);
            (same && parts.edges.is_empty() && parts.corners.is_empty()).then_some(first)
        };
        for patch in cells.iter().filter_map(single) {
            *alone.entry(patch).or_default() += 1;
        }
        let most = alone.iter().max_by_key(|(patch, count)| (**count, u32::MAX - **patch));
        let main = most.map_or(u32::MAX, |(patch, _)| *patch);
        let empty: Vec<bool> = cells.iter().map(|parts| parts.len() == 0).collect();
        let bare: Vec<bool> =
            cells.iter().map(|parts| parts.len() == 0 || single(parts) == Some(main)).collect();
        let count = self.count >> CUTS;
        self.main = main;
        self.empty = rings(&empty, count);
        self.bare = rings(&bare, count);
    }

    /// Lists what a cell has in reach, or cuts it if that is too much. `last` is what was listed
    /// last: neighbours often list the same, and then once.
    fn fill(
        &mut self,
        node: usize,
        parts: Parts,
        low: IVec3,
        size: i32,
        last: &mut (Parts, Listed),
    ) {
        if size > 1 && parts.len() > LISTED_MAX {
            let (first, half) = (self.nodes.len(), size / 2);
            self.nodes[node].children = first as u32;
            self.nodes.resize(first + 8, Node::default());
            for child in 0..8 {
                let low = low + IVec3::new(child & 1, child >> 1 & 1, child >> 2) * half;
                let space = self.space(low, half);
                let kept = self.kept(&parts, &space);
                self.fill(first + child as usize, kept, low, half, last);
            }
            return;
        }
        let parts = self.with_whole(parts, &self.space(low, size));
        if parts != last.0 {
            let mut lists = core::mem::take(&mut self.lists);
            let listed = self.list(&parts, &mut lists);
            self.lists = lists;
            *last = (parts, listed);
        }
        self.nodes[node] = Node { children: 0, listed: last.1 };
    }

    /// What of some parts a ball with its centre in `space` can touch.
    pub(super) fn kept(&self, parts: &Parts, space: &Space) -> Parts {
        Parts {
            whole: Vec::new(),
            triangles: kept(&parts.triangles, |part| self.is_over(part, space)),
            edges: kept(&parts.edges, |part| self.is_at_edge(part, space)),
            corners: kept(&parts.corners, |part| self.is_at_corner(part, space)),
        }
    }

    /// Parts with the triangles of a patch replaced by the patch, where no border of it is in
    /// reach.
    pub(super) fn with_whole(&self, mut parts: Parts, space: &Space) -> Parts {
        let patch_of = |triangle: &u32| self.faces[*triangle as usize];
        let mut patches: Vec<u32> = parts.triangles.iter().map(patch_of).collect();
        patches.sort_unstable();
        patches.dedup();
        let bordered = |patch: u32| {
            let edge = |edge: &u32| {
                self.edges[*edge as usize].sides.iter().any(|(side, _)| *side == patch)
            };
            parts.edges.iter().any(edge)
                || parts
                    .corners
                    .iter()
                    .any(|corner| self.corners[*corner as usize].patches.contains(&patch))
        };
        let over = |patch: u32| {
            parts.triangles.iter().any(|triangle| {
                patch_of(triangle) == patch
                    && self.sides[*triangle as usize]
                        .iter()
                        .all(|side| side.inside_m(space.middle) >= 0.0)
            })
        };
        patches.retain(|patch| !bordered(*patch) && over(*patch));
        parts.triangles.retain(|triangle| !patches.contains(&patch_of(triangle)));
        parts.whole = patches;
        parts
    }

    /// Forgets a patch, but not its edges.
    pub(super) fn without(&self, mut parts: Parts, patch: u32) -> Parts {
        parts.triangles.retain(|triangle| self.faces[*triangle as usize] != patch);
        parts.whole.retain(|other| *other != patch);
        parts
    }

    /// Appends parts to `lists` and says where; triangles come patch by patch.
    pub(super) fn list(&self, parts: &Parts, lists: &mut Lists) -> Listed {
        let mut triangles: Vec<(u32, u32)> =
            parts.triangles.iter().map(|part| (self.faces[*part as usize], *part)).collect();
        triangles.sort_unstable();
        let groups = lists.groups.len() as u32;
        for run in triangles.chunk_by(|a, b| a.0 == b.0) {
            let first = lists.triangles.len() as u32;
            lists.triangles.extend(run.iter().map(|(_, triangle)| *triangle));
            lists.groups.push(Group { patch: run[0].0, first, count: run.len() as u32 });
        }
        lists.groups.extend(parts.whole.iter().map(|patch| Group {
            patch: *patch,
            first: 0,
            count: 0,
        }));
        lists.groups[groups as usize..].sort_unstable_by_key(|group| group.patch);
        let (edges, corners) = (lists.edges.len() as u32, lists.corners.len() as u32);
        lists.edges.extend_from_slice(&parts.edges);
        lists.corners.extend_from_slice(&parts.corners);
        Listed {
            groups: (groups, lists.groups.len() as u32),
            edges: (edges, lists.edges.len() as u32),
            corners: (corners, lists.corners.len() as u32),
        }
    }

    fn space(&self, low: IVec3, size: i32) -> Space {
        let half = 0.5 * f64::from(size) * self.cell_m;
        let middle = self.origin + low.as_dvec3() * self.cell_m + half;
        Space { middle, half, reach_m: self.reach_m() }
    }

    /// How far a ball reaches, and a little more [m].
    pub(super) fn reach_m(&self) -> f64 {
        self.radius_m * 1.001 + 1e-6
    }

    /// Whether a ball with its centre in `space` can touch a triangle, its foot being inside.
    fn is_over(&self, triangle: u32, space: &Space) -> bool {
        let patch = &self.patches[self.faces[triangle as usize] as usize];
        let height = patch.normal.dot(space.middle) - patch.offset;
        if height.abs() > space.along(patch.normal) + space.reach_m {
            return false;
        }
        self.sides[triangle as usize]
            .iter()
            .all(|side| side.inside_m(space.middle) >= -space.along(side.inwards) - BESIDE_M)
    }

    /// Whether a ball with its centre in `space` can touch an edge, no face being nearer.
    fn is_at_edge(&self, number: u32, space: &Space) -> bool {
        let edge = &self.edges[number as usize];
        let offset = space.middle - edge.from;
        let along = offset.dot(edge.along);
        let beyond = space.along(edge.along) + BESIDE_M;
        let beside =
            |(_, inwards): &(u32, DVec3)| offset.dot(*inwards) > space.along(*inwards) + BESIDE_M;
        let far = space.reach_m + space.half.length();
        -beyond <= along
            && along <= edge.length_m + beyond
            && offset.length_squared() - along * along <= far * far
            && !edge.sides.iter().any(beside)
    }

    /// Whether a ball with its centre in `space` can touch a corner, no edge being nearer.
    fn is_at_corner(&self, number: u32, space: &Space) -> bool {
        let corner = &self.corners[number as usize];
        let offset = space.middle - corner.point;
        let far = space.reach_m + space.half.length();
        let beside = |away: &DVec3| offset.dot(*away) > space.along(*away) + BESIDE_M;
        offset.length_squared() <= far * far && !corner.away.iter().any(beside)
    }

    /// Calls `found` for each coarse cell from which a ball may reach the box around some points.
    fn visit(&self, points: &[DVec3], mut found: impl FnMut(usize, &Space)) {
        let (first, last) = bounds_of(points.iter().copied());
        let reach = self.reach_m();
        let count = self.count >> CUTS;
        let low = (self.place_of(first - reach) >> CUTS).clamp(IVec3::ZERO, count - 1);
        let high = (self.place_of(last + reach) >> CUTS).clamp(IVec3::ZERO, count - 1);
        for z in low.z..=high.z {
            for y in low.y..=high.y {
                for x in low.x..=high.x {
                    let space = self.space(IVec3::new(x, y, z) << CUTS, 1 << CUTS);
                    if space.reaches(first, last) {
                        found(((z * count.y + y) * count.x + x) as usize, &space);
                    }
                }
            }
        }
    }

    /// The smallest cell that holds `point`; outside of the grid its coordinates do not exist.
    pub fn place_of(&self, point: DVec3) -> IVec3 {
        let place = (point - self.origin) * self.inverse_cell;
        let place = place.clamp(DVec3::splat(-2.0), self.count.as_dvec3() + 1.0);
        // To the left of zero the whole part is not what is cut off.
        (place + 2.0).as_ivec3() - 2
    }

    /// The largest block around `place` that is known to have the same things in reach of a ball,
    /// the main patch left aside if `on_main` says that it carries the ball.
    pub fn block_at(&self, place: IVec3, on_main: bool) -> Block {
        let (cell, count) = (place >> CUTS, self.count >> CUTS);
        let mut block = Block { listed: None, low: cell << CUTS, high: (cell << CUTS) + LAST };
        if cell.cmplt(IVec3::ZERO).any() || cell.cmpge(count).any() {
            return block;
        }
        let index = ((cell.z * count.y + cell.y) * count.x + cell.x) as usize;
        let free = if on_main { self.bare[index] } else { self.empty[index] };
        if free > 0 {
            let around = i32::from(free) - 1;
            block.low = (cell - around) << CUTS;
            block.high = ((cell + around) << CUTS) + LAST;
            return block;
        }
        let (mut node, mut size) = (index, 1 << CUTS);
        while self.nodes[node].children > 0 {
            size /= 2;
            let upper = place.cmpge(block.low + size);
            node = self.nodes[node].children as usize + upper.bitmask() as usize;
            block.low = IVec3::select(upper, block.low + size, block.low);
        }
        block.high = block.low + (size - 1);
        block.listed = Some(self.nodes[node].listed);
        block
    }

    /// Whether any cell lists something where the centre of a ball is in a box.
    pub fn lists_between(&self, low: DVec3, high: DVec3) -> bool {
        let count = self.count >> CUTS;
        let (low, high) = (self.place_of(low) >> CUTS, self.place_of(high) >> CUTS);
        let (low, high) = (low.max(IVec3::ZERO), high.min(count - 1));
        (low.z..=high.z).any(|z| {
            (low.y..=high.y).any(|y| {
                (low.x..=high.x)
                    .any(|x| self.empty[((z * count.y + y) * count.x + x) as usize] == 0)
            })
        })
    }

    /// The corners of a block [m]; infinite where it goes beyond the grid.
    pub fn corners_of(&self, block: &Block) -> (DVec3, DVec3) {
        let min = self.origin + block.low.as_dvec3() * self.cell_m;
        let max = self.origin + (block.high + 1).as_dvec3() * self.cell_m;
        (
            DVec3::select(block.low.cmplt(IVec3::ZERO), DVec3::NEG_INFINITY, min),
            DVec3::select(block.high.cmpge(self.count), DVec3::INFINITY, max),
        )
    }

    /// How many of the smallest cells the grid has along an axis.
    pub fn cells_along(&self, axis: usize) -> i32 {
        self.count[axis]
    }
}

/// The last of the smallest cells in a coarse one.
const LAST: i32 = (1 << CUTS) - 1;

fn kept(parts: &[u32], keeps: impl Fn(u32) -> bool) -> Vec<u32> {
    parts.iter().copied().filter(|part| keeps(*part)).collect()
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
