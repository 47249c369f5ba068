//! The grid over the terrain: what a ball in a cell can touch, and how far around it is empty.
//!
//! Cells are as wide as a ball; where many things are in reach, as in a pocket, a cell is cut into
//! eight, again and again. A cell lists what a ball with its centre in it can touch: nothing that
//! is too far, no face that the centre is not over, and no edge or corner beside which something
//! else is nearer wherever in the cell the centre is. A cell is cut when a ball first comes there:
//! most never are, and cutting all took most of the time and memory that a table needs.

use super::coarse::Reach;
use super::plan::{LEVEL, Lists};
use super::{Block, Found, Group, Listed, Terrain};
use glam::{DVec3, IVec3};
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// Most cells along one axis; bounds the memory of huge meshes.
const CELLS_MAX: i32 = 96;

/// Most cells for each face and edge; bounds the time that small meshes take to prepare.
const CELLS_PER_PART: i32 = 16;

/// A cell may be cut in two along each axis so many times.
pub(super) const CUTS: i32 = 3;

/// A cell that lists more than this is cut, if it may be.
const LISTED_MAX: usize = 12;

/// Something is beside a feature if it is by this much [m]; far more than a ball is ever pressed
/// into a face.
pub const BESIDE_M: f64 = 1e-4;

/// What is in reach of a ball somewhere in a box.
#[derive(Debug, Default, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Parts {
    /// Patches of which no border is in reach: wherever the centre is, its foot is inside.
    whole: Vec<u32>,
    triangles: Vec<u32>,
    edges: Vec<u32>,
    corners: Vec<u32>,
}

impl Parts {
    /// A patch of which no border is in reach, and nothing else.
    pub fn set_whole(&mut self, patch: u32) {
        self.whole.push(patch);
    }

    pub fn clear(&mut self) {
        for list in [&mut self.whole, &mut self.triangles, &mut self.edges, &mut self.corners] {
            list.clear();
        }
    }

    /// The same as `==`, and quicker for short lists.
    pub fn is(&self, other: &Parts) -> bool {
        let same =
            |a: &[u32], b: &[u32]| a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a == b);
        same(&self.triangles, &other.triangles)
            && same(&self.edges, &other.edges)
            && same(&self.corners, &other.corners)
            && same(&self.whole, &other.whole)
    }

    /// Each once, in ascending order.
    fn sort(&mut self) {
        for list in [&mut self.triangles, &mut self.edges, &mut self.corners] {
            list.sort_unstable();
            list.dedup();
        }
    }

    pub fn view(&self) -> Reach<'_> {
        Reach { triangles: &self.triangles, edges: &self.edges, corners: &self.corners }
    }
}

/// A coarse cell, cut as finely as what is in its reach demands.
#[derive(Debug, Default)]
pub(super) struct Cut {
    /// The cell itself, then its parts.
    nodes: Vec<Node>,
    pub lists: Lists,
}

/// A cell: what it lists, or eight smaller ones.
#[derive(Debug, Clone, Copy, Default)]
struct Node {
    /// The first of its parts; 0 if it is not cut.
    children: u32,
    listed: Listed,
}

/// A box of space.
pub(super) struct Space {
    pub middle: DVec3,
    half: DVec3,
    /// How far from it a ball with its centre in it reaches [m].
    reach_m: f64,
    /// No ball with its centre in it reaches farther than this from its middle [m].
    far_m: f64,
    /// See [`BESIDE_M`] [m].
    beside_m: f64,
}

impl Space {
    pub fn new(middle: DVec3, half: DVec3, reach_m: f64) -> Self {
        Space { middle, half, reach_m, far_m: reach_m + half.length(), beside_m: BESIDE_M }
    }

    /// A box for what is to be asked of boxes of size `part` in it: whatever is in reach of one of
    /// them is in reach of this one, rounding included.
    pub fn of_parts(middle: DVec3, half: DVec3, part: DVec3, reach_m: f64) -> Self {
        /// Far more than rounding adds [m].
        const SLACK_M: f64 = 1e-9;
        let far_m = reach_m + part.length() + (half - part).length() + SLACK_M;
        let beside_m = BESIDE_M + SLACK_M;
        Space { middle, half, reach_m: reach_m + SLACK_M, far_m, beside_m }
    }

    /// How far it extends from its middle along a unit vector [m].
    fn along(&self, direction: DVec3) -> f64 {
        direction.abs().dot(self.half)
    }

    /// Whether a ball with its centre in it reaches a box.
    pub fn reaches(&self, low: DVec3, high: DVec3) -> bool {
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

        self.coarse = self.list_coarse();
        self.find_leaps();
        self.plans = self.draw_plans();
        let cells = (self.count >> CUTS).element_product() as usize;
        self.cuts.resize_with(cells, OnceLock::new);
    }

    /// The coarse cell with this number.
    fn cell_at(&self, index: usize) -> IVec3 {
        let (count, index) = (self.count >> CUTS, index as i32);
        IVec3::new(index % count.x, index / count.x % count.y, index / (count.x * count.y))
    }

    /// Finds the main patch, and how far around each coarse cell nothing is in reach.
    fn find_leaps(&mut self) {
        // Which patch is named most often in cells that name nothing else.
        let mut alone: BTreeMap<u32, u32> = BTreeMap::new();
        let count = self.count >> CUTS;
        let cells = || (0..count.element_product() as usize).map(|cell| self.coarse.of(cell));
        for patch in cells().filter_map(|parts| self.only_patch(parts)) {
            *alone.entry(patch).or_default() += 1;
        }
        // Balls roll on what is level, be the walls of a room larger.
        let is_level = |patch: u32| 1.0 - LEVEL <= self.patches[patch as usize].normal.z.abs();
        let most = alone
            .iter()
            .max_by_key(|(patch, count)| (is_level(**patch), **count, u32::MAX - **patch));
        let main = most.map_or(u32::MAX, |(patch, _)| *patch);
        let empty: Vec<bool> = cells().map(|parts| parts.len() == 0).collect();
        let bare: Vec<bool> =
            cells().map(|parts| parts.len() == 0 || self.only_patch(parts) == Some(main)).collect();
        self.main = main;
        self.empty = rings(&empty, count);
        self.bare = rings(&bare, count);
    }

    /// A coarse cell, cut; the first who asks has it done.
    pub(super) fn cut(&self, cell: usize) -> &Cut {
        self.cuts[cell].get_or_init(|| {
            let mut cut = Box::new(Cut { nodes: vec![Node::default()], lists: Lists::default() });
            let mut last = (Parts::default(), Listed::default());
            let (parts, low) = (self.coarse.of(cell), self.cell_at(cell) << CUTS);
            self.fill(&mut cut, (0, 1 << CUTS), parts, low, &mut last);
            cut.lists.shrink();
            cut.nodes.shrink_to_fit();
            cut
        })
    }

    /// Lists what a cell has in reach, or cuts it if that is too much. `last` is what was listed
    /// last: neighbours often list the same, and then once.
    fn fill(
        &self,
        cut: &mut Cut,
        (node, size): (usize, i32),
        parts: Reach,
        low: IVec3,
        last: &mut (Parts, Listed),
    ) {
        if size > 1 && parts.len() > LISTED_MAX {
            let (first, half) = (cut.nodes.len(), size / 2);
            cut.nodes[node].children = first as u32;
            cut.nodes.resize(first + 8, Node::default());
            for child in 0..8 {
                let low = low + IVec3::new(child & 1, child >> 1 & 1, child >> 2) * half;
                let mut kept = Parts::default();
                self.keep(parts, &self.space(low, half), &mut kept);
                self.fill(cut, (first + child as usize, half), kept.view(), low, last);
            }
            return;
        }
        let mut parts = Parts {
            whole: Vec::new(),
            triangles: parts.triangles.to_vec(),
            edges: parts.edges.to_vec(),
            corners: parts.corners.to_vec(),
        };
        self.find_whole(&mut parts, &self.space(low, size));
        if parts != last.0 {
            let listed = self.list(&parts, &mut cut.lists);
            *last = (parts, listed);
        }
        cut.nodes[node] = Node { children: 0, listed: last.1 };
    }

    /// Adds what of some parts a ball with its centre in `space` can touch.
    pub(super) fn keep(&self, parts: Reach, space: &Space, kept: &mut Parts) {
        let triangles = parts.triangles.iter().filter(|part| self.is_over(**part, space));
        let edges = parts.edges.iter().filter(|part| self.is_at_edge(**part, space));
        let corners = parts.corners.iter().filter(|part| self.is_at_corner(**part, space));
        kept.triangles.extend(triangles);
        kept.edges.extend(edges);
        kept.corners.extend(corners);
    }

    /// The patch of all parts, if they are nothing else and reach no border of it.
    pub(super) fn only_patch(&self, parts: Reach) -> Option<u32> {
        let patch_of = |triangle: &u32| self.faces[*triangle as usize];
        let first = patch_of(parts.triangles.first()?);
        let same = parts.triangles.iter().all(|triangle| patch_of(triangle) == first);
        (same && parts.edges.is_empty() && parts.corners.is_empty()).then_some(first)
    }

    /// Whether a ball with its centre in `space` touches this patch wherever in it the centre is,
    /// its foot being inside of one of these triangles, which belong to the patch.
    pub(super) fn is_whole(&self, patch: u32, triangles: &[u32], space: &Space) -> bool {
        self.is_in_height(patch, space)
            && triangles.iter().any(|triangle| self.is_inside(*triangle, space.middle))
    }

    /// Whether the foot of the perpendicular from `point` is inside of a triangle.
    fn is_inside(&self, triangle: u32, point: DVec3) -> bool {
        self.sides[triangle as usize].iter().all(|side| side.inside_m(point) >= 0.0)
    }

    /// Whether a ball with its centre in `space` can touch the plane of a patch.
    fn is_in_height(&self, patch: u32, space: &Space) -> bool {
        let patch = &self.patches[patch as usize];
        let height = patch.normal.dot(space.middle) - patch.offset;
        height.abs() <= space.along(patch.normal) + space.reach_m
    }

    /// What of these layers of cells a ball with its centre in `space` can touch.
    pub(super) fn keep_of(&self, layers: &[Reach], space: &Space) -> Parts {
        let mut parts = Parts::default();
        layers.iter().for_each(|layer| self.keep(*layer, space, &mut parts));
        if layers.len() > 1 {
            parts.sort();
        }
        parts
    }

    /// Replaces the triangles of a patch by the patch, where no border of it is in reach.
    pub(super) fn find_whole(&self, parts: &mut Parts, space: &Space) {
        let Parts { whole, triangles, edges, corners } = parts;
        let patch_of = |triangle: &u32| self.faces[*triangle as usize];
        whole.extend(triangles.iter().map(patch_of));
        whole.sort_unstable();
        whole.dedup();
        let bordered = |patch: u32| {
            let edge = |edge: &u32| {
                self.edges[*edge as usize].sides.iter().any(|(side, _)| *side == patch)
            };
            let corner = |corner: &u32| self.corners[*corner as usize].patches.contains(&patch);
            edges.iter().any(edge) || corners.iter().any(corner)
        };
        let over = |patch: u32| {
            triangles.iter().any(|triangle| {
                patch_of(triangle) == patch && self.is_inside(*triangle, space.middle)
            })
        };
        whole.retain(|patch| !bordered(*patch) && over(*patch));
        triangles.retain(|triangle| !whole.contains(&patch_of(triangle)));
    }

    /// Forgets a patch, but not its edges.
    pub(super) fn forget(&self, patch: u32, parts: &mut Parts) {
        parts.triangles.retain(|triangle| self.faces[*triangle as usize] != patch);
        parts.whole.retain(|other| *other != patch);
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

    pub(super) fn space(&self, low: IVec3, size: i32) -> Space {
        let half = 0.5 * f64::from(size) * self.cell_m;
        let middle = self.origin + low.as_dvec3() * self.cell_m + half;
        Space::new(middle, half, self.reach_m())
    }

    /// How far a ball reaches, and a little more [m].
    pub(super) fn reach_m(&self) -> f64 {
        self.radius_m * 1.001 + 1e-6
    }

    /// Whether a ball with its centre in `space` can touch a triangle, its foot being inside.
    pub(super) fn is_over(&self, triangle: u32, space: &Space) -> bool {
        self.is_in_height(self.faces[triangle as usize], space)
            && self.sides[triangle as usize].iter().all(|side| {
                side.inside_m(space.middle) >= -space.along(side.inwards) - space.beside_m
            })
    }

    /// Whether a ball with its centre in `space` can touch an edge, no face being nearer.
    pub(super) fn is_at_edge(&self, number: u32, space: &Space) -> bool {
        let edge = &self.edges[number as usize];
        let offset = space.middle - edge.from;
        let along = offset.dot(edge.along);
        let beyond = space.along(edge.along) + space.beside_m;
        let beside = |(_, inwards): &(u32, DVec3)| {
            offset.dot(*inwards) > space.along(*inwards) + space.beside_m
        };
        -beyond <= along
            && along <= edge.length_m + beyond
            && offset.length_squared() - along * along <= space.far_m * space.far_m
            && !edge.sides.iter().any(beside)
    }

    /// Whether a ball with its centre in `space` can touch a corner, no edge being nearer.
    pub(super) fn is_at_corner(&self, number: u32, space: &Space) -> bool {
        let corner = &self.corners[number as usize];
        let offset = space.middle - corner.point;
        let beside = |away: &DVec3| offset.dot(*away) > space.along(*away) + space.beside_m;
        offset.length_squared() <= space.far_m * space.far_m && !corner.away.iter().any(beside)
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
        let mut block = Block { found: None, low: cell << CUTS, high: (cell << CUTS) + LAST };
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
        let nodes = &self.cut(index).nodes;
        let (mut node, mut size) = (&nodes[0], 1 << CUTS);
        while node.children > 0 {
            size /= 2;
            let upper = place.cmpge(block.low + size);
            node = &nodes[node.children as usize + upper.bitmask() as usize];
            block.low = IVec3::select(upper, block.low + size, block.low);
        }
        block.high = block.low + (size - 1);
        block.found = Some(Found { cell: index as u32, listed: node.listed });
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
    let strides: Vec<i32> =
        neighbours.iter().map(|n| (n.z * count.y + n.y) * count.x + n.x).collect();
    let total = count.x * count.y * count.z;
    for forwards in [true, false] {
        for step in 0..total {
            let place = if forwards { step } else { total - 1 - step };
            if ring[place as usize] == 0 {
                continue;
            }
            let cell =
                IVec3::new(place % count.x, place / count.x % count.y, place / (count.x * count.y));
            let mut least = ring[place as usize];
            if cell.cmpge(IVec3::ONE).all() && cell.cmplt(count - 1).all() {
                // All neighbours are in the grid.
                for offset in &strides {
                    let other = if forwards { place + offset } else { place - offset };
                    least = least.min(ring[other as usize].saturating_add(1));
                }
                ring[place as usize] = least;
                continue;
            }
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
