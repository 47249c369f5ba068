//! What does not move, prepared once: planes, flat patches, their edges and corners, in a grid.
//!
//! Coplanar neighbours of one surface are one patch, so seams do not exist: neither for rolling nor
//! for detection. An edge between two patches, or at the border of an open mesh, is a feature of
//! its own, and so is a corner where such edges meet. The grid lists for each cell everything that
//! a ball whose centre is in it can touch; cells where nothing is in reach, or nothing but the bed,
//! know how far around them that holds, and are passed in leaps.

use crate::mesh::{Mesh, Surface};
use crate::physics::fixed_step::narrow::triangle_meets_box;
use crate::physics::fixed_step::spatial_hash::Bounds;
use crate::physics::tolerance;
use crate::table::{Bed, Plane, Pocket, Table};
use glam::{DVec3, IVec3};
use smallvec::SmallVec;
use std::collections::BTreeMap;

/// Most cells along one axis; bounds the memory of huge meshes.
const CELLS_MAX: i32 = 96;

/// A part of the terrain that a ball can touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Feature {
    /// A half space.
    Plane(u32),
    /// A flat patch of faces.
    Patch(u32),
    /// An edge.
    Edge(u32),
    /// A corner.
    Corner(u32),
}

/// Faces in one plane that hang together.
#[derive(Debug, Clone, Copy)]
pub struct Patch {
    /// Unit normal, as the first face is oriented.
    pub normal: DVec3,
    /// Distance of its plane from the origin along the normal [m].
    pub offset: f64,
    /// What it is made of.
    pub surface: Surface,
}

/// Where patches meet or a mesh ends.
#[derive(Debug, Clone)]
pub struct Edge {
    /// Its first end [m].
    pub from: DVec3,
    /// Unit vector to its second end.
    pub along: DVec3,
    /// Its length [m].
    pub length_m: f64,
    /// The patches that it borders, and for each the unit vector in its plane from the edge
    /// inwards.
    pub sides: SmallVec<[(u32, DVec3); 2]>,
    /// Both sides lie in one plane: nothing to collide with, but what carries a ball changes.
    pub flat: bool,
    /// What it counts as.
    pub surface: Surface,
    bounds: Bounds,
}

/// Where edges meet.
#[derive(Debug, Clone)]
pub struct Corner {
    /// Where [m].
    pub point: DVec3,
    /// The patches around it.
    pub patches: SmallVec<[u32; 6]>,
    /// What it counts as.
    pub surface: Surface,
}

/// The faces of one patch in one cell.
#[derive(Debug, Clone, Copy)]
pub struct Group {
    /// The patch.
    pub patch: u32,
    first: u32,
    count: u32,
    /// Box around the faces.
    pub bounds: Bounds,
}

#[derive(Debug, Clone, Copy, Default)]
struct Cell {
    groups: (u32, u32),
    edges: (u32, u32),
    corners: (u32, u32),
}

/// The fixed part of a world; shared by all clones of a simulation.
#[derive(Debug, Default)]
pub struct Terrain {
    /// Half spaces.
    pub planes: Vec<Plane>,
    /// Patches.
    pub patches: Vec<Patch>,
    /// Edges.
    pub edges: Vec<Edge>,
    /// Corners.
    pub corners: Vec<Corner>,
    /// The playing area.
    pub bed: Option<Bed>,
    /// Pockets.
    pub pockets: Vec<Pocket>,
    /// Nothing is below this [m].
    pub lowest_m: f64,
    triangles: Vec<[DVec3; 3]>,
    /// The patch that most faces belong to; cells with nothing else in reach are passed in leaps by
    /// balls that it carries.
    main: u32,
    origin: DVec3,
    cell_m: DVec3,
    count: IVec3,
    cells: Vec<Cell>,
    groups: Vec<Group>,
    cell_triangles: Vec<u32>,
    cell_edges: Vec<u32>,
    cell_corners: Vec<u32>,
    /// Cells around each, itself included, in which nothing is in reach; 0 where something is.
    empty: Vec<u8>,
    /// The same with the main patch left aside.
    bare: Vec<u8>,
}

impl Terrain {
    /// Prepares a table for balls up to `radius_m`.
    pub fn new(table: &Table, radius_m: f64) -> Self {
        let mut terrain = Terrain {
            planes: table
                .planes
                .iter()
                .map(|plane| Plane { normal: plane.normal.normalize_or(DVec3::Z), ..*plane })
                .collect(),
            bed: table.bed,
            pockets: table.pockets.clone(),
            ..Terrain::default()
        };
        let of_vertices = table.mesh.vertices.iter().map(|vertex| vertex.z);
        let of_planes = table.planes.iter().map(|plane| plane.point.z);
        terrain.lowest_m = of_vertices.chain(of_planes).fold(0.0, f64::min);
        if !table.mesh.faces.is_empty() {
            let faces = merge(&table.mesh, &mut terrain);
            terrain.fill_grid(&faces, radius_m);
        }
        terrain
    }

    /// What a feature is made of.
    pub fn surface(&self, feature: Feature) -> Surface {
        match feature {
            Feature::Plane(i) => self.planes[i as usize].surface,
            Feature::Patch(i) => self.patches[i as usize].surface,
            Feature::Edge(i) => self.edges[i as usize].surface,
            Feature::Corner(i) => self.corners[i as usize].surface,
        }
    }

    /// x of the head string [m].
    pub fn head_string_x(&self) -> Option<f64> {
        self.bed.map(|bed| bed.head_string_x())
    }

    /// The cell that holds `point`; outside of the grid it has coordinates that do not exist.
    pub fn cell_of(&self, point: DVec3) -> IVec3 {
        ((point - self.origin) / self.cell_m)
            .floor()
            .clamp(DVec3::splat(-2.0), self.count.as_dvec3() + 1.0)
            .as_ivec3()
    }

    fn index(&self, cell: IVec3) -> Option<usize> {
        let inside = cell.cmpge(IVec3::ZERO).all() && cell.cmplt(self.count).all();
        inside.then(|| ((cell.z * self.count.y + cell.y) * self.count.x + cell.x) as usize)
    }

    /// How many cells around `cell`, itself included, hold nothing in reach of a ball that
    /// `on_main` says is carried by the main patch; 0 if this one does. Outside of the grid: 1.
    pub fn leap(&self, cell: IVec3, on_main: bool) -> i32 {
        let rings = if on_main { &self.bare } else { &self.empty };
        self.index(cell).map_or(1, |index| i32::from(rings[index]))
    }

    /// How many cells the grid has along an axis.
    pub fn cells_along(&self, axis: usize) -> i32 {
        self.count[axis]
    }

    /// The corners of a block of cells [m]; infinite where it goes beyond the grid.
    pub fn block(&self, low: IVec3, high: IVec3) -> (DVec3, DVec3) {
        let min = self.origin + low.as_dvec3() * self.cell_m;
        let max = self.origin + (high + 1).as_dvec3() * self.cell_m;
        (
            DVec3::select(low.cmplt(IVec3::ZERO), DVec3::NEG_INFINITY, min),
            DVec3::select(high.cmpge(self.count), DVec3::INFINITY, max),
        )
    }

    /// Whether a mesh exists at all.
    pub fn has_mesh(&self) -> bool {
        !self.cells.is_empty()
    }

    /// The number of the main patch.
    pub fn main_patch(&self) -> Feature {
        Feature::Patch(self.main)
    }

    /// The faces of each patch that a ball in `cell` can reach.
    pub fn groups_in(&self, cell: IVec3) -> &[Group] {
        let range = self.index(cell).map_or((0, 0), |index| self.cells[index].groups);
        &self.groups[range.0 as usize..range.1 as usize]
    }

    /// The edges that a ball in `cell` can reach.
    pub fn edges_in(&self, cell: IVec3) -> &[u32] {
        let range = self.index(cell).map_or((0, 0), |index| self.cells[index].edges);
        &self.cell_edges[range.0 as usize..range.1 as usize]
    }

    /// The corners that a ball in `cell` can reach.
    pub fn corners_in(&self, cell: IVec3) -> &[u32] {
        let range = self.index(cell).map_or((0, 0), |index| self.cells[index].corners);
        &self.cell_corners[range.0 as usize..range.1 as usize]
    }

    /// Box around an edge.
    pub fn edge_bounds(&self, edge: u32) -> &Bounds {
        &self.edges[edge as usize].bounds
    }

    /// Whether the foot of the perpendicular from `point` lies in one of the faces of a group.
    pub fn holds(&self, group: &Group, point: DVec3) -> bool {
        let normal = self.patches[group.patch as usize].normal;
        let range = group.first as usize..(group.first + group.count) as usize;
        self.cell_triangles[range].iter().any(|triangle| {
            let [a, b, c] = self.triangles[*triangle as usize];
            let side = |from: DVec3, to: DVec3| (to - from).cross(point - from).dot(normal);
            let (ab, bc, ca) = (side(a, b), side(b, c), side(c, a));
            (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0)
        })
    }

    /// Everything no farther than `reach_m` from `centre`: feature, unit normal towards the centre,
    /// distance [m]; one of each direction, in a fixed order.
    pub fn near(&self, centre: DVec3, reach_m: f64) -> SmallVec<[(Feature, DVec3, f64); 4]> {
        let mut found: SmallVec<[(Feature, DVec3, f64); 4]> = SmallVec::new();
        let mut note = |feature: Feature, normal: DVec3, distance: f64| {
            let same = |(_, other, _): &(Feature, DVec3, f64)| {
                other.dot(normal) > 1.0 - tolerance::SAME_NORMAL
            };
            if distance <= reach_m && !found.iter().any(same) {
                found.push((feature, normal, distance));
            }
        };
        for (number, plane) in self.planes.iter().enumerate() {
            let distance = (centre - plane.point).dot(plane.normal);
            note(Feature::Plane(number as u32), plane.normal, distance);
        }
        let cell = self.cell_of(centre);
        for group in self.groups_in(cell) {
            let patch = &self.patches[group.patch as usize];
            let height = patch.normal.dot(centre) - patch.offset;
            if height.abs() <= reach_m && self.holds(group, centre) {
                let normal = if height < 0.0 { -patch.normal } else { patch.normal };
                note(Feature::Patch(group.patch), normal, height.abs());
            }
        }
        for number in self.edges_in(cell) {
            let edge = &self.edges[*number as usize];
            let along = (centre - edge.from).dot(edge.along);
            if !edge.flat && 0.0 <= along && along <= edge.length_m {
                let offset = centre - edge.from - edge.along * along;
                let distance = offset.length();
                note(Feature::Edge(*number), offset.normalize_or(DVec3::Z), distance);
            }
        }
        for number in self.corners_in(cell) {
            let offset = centre - self.corners[*number as usize].point;
            note(Feature::Corner(*number), offset.normalize_or(DVec3::Z), offset.length());
        }
        found
    }

    /// Whether a contact with `feature` belongs to a lasting contact with `held`.
    pub fn belongs(&self, feature: Feature, held: Feature) -> bool {
        if feature == held {
            return true;
        }
        let patches = |feature: Feature| -> SmallVec<[u32; 6]> {
            match feature {
                Feature::Plane(_) => SmallVec::new(),
                Feature::Patch(patch) => SmallVec::from_slice(&[patch]),
                Feature::Edge(edge) => {
                    self.edges[edge as usize].sides.iter().map(|(patch, _)| *patch).collect()
                }
                Feature::Corner(corner) => self.corners[corner as usize].patches.clone(),
            }
        };
        match (feature, held) {
            // Neighbouring edges and corners are features of their own.
            (Feature::Edge(_), Feature::Edge(_)) => false,
            (Feature::Corner(corner), Feature::Edge(edge)) => {
                let (point, edge) =
                    (self.corners[corner as usize].point, &self.edges[edge as usize]);
                point == edge.from || point.distance(edge.from + edge.along * edge.length_m) < 1e-12
            }
            _ => {
                let of_held = patches(held);
                patches(feature).iter().any(|patch| of_held.contains(patch))
            }
        }
    }

    fn fill_grid(&mut self, faces: &[u32], radius_m: f64) {
        let reach = DVec3::splat(radius_m * 1.001 + 1e-6);
        let corners = || self.triangles.iter().flatten().copied();
        let low = corners().fold(DVec3::INFINITY, DVec3::min) - reach;
        let high = corners().fold(DVec3::NEG_INFINITY, DVec3::max) + reach;
        let size = high - low;
        let wanted = 2.0 * radius_m;
        self.origin = low;
        self.count = (size / wanted).ceil().as_ivec3().clamp(IVec3::ONE, IVec3::splat(CELLS_MAX));
        self.cell_m = size / self.count.as_dvec3();

        let total = (self.count.x * self.count.y * self.count.z) as usize;
        let mut groups: Vec<Vec<(u32, u32)>> = vec![Vec::new(); total];
        let mut edges: Vec<Vec<u32>> = vec![Vec::new(); total];
        let mut corner_lists: Vec<Vec<u32>> = vec![Vec::new(); total];
        for (number, triangle) in self.triangles.iter().enumerate() {
            self.visit(triangle, reach.x, |cell| groups[cell].push((faces[number], number as u32)));
        }
        for (number, edge) in self.edges.iter().enumerate() {
            let end = edge.from + edge.along * edge.length_m;
            self.visit(&[edge.from, end, end], reach.x, |cell| edges[cell].push(number as u32));
        }
        for (number, corner) in self.corners.iter().enumerate() {
            self.visit(&[corner.point; 3], reach.x, |cell| corner_lists[cell].push(number as u32));
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
                let bounds = bounds_of(points);
                let (patch, count) = (run[0].0, run.len() as u32);
                self.groups.push(Group { patch, first, count, bounds });
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

fn bounds_of(points: impl Iterator<Item = DVec3>) -> Bounds {
    let start = Bounds { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };
    points.fold(start, |b, p| Bounds { min: b.min.min(p), max: b.max.max(p) })
}

/// Which of the surfaces around an edge or corner it counts as.
fn rank(surface: Surface) -> u8 {
    match surface {
        Surface::Cushion(_) => 6,
        Surface::Pocket(_) => 5,
        Surface::Wood => 4,
        Surface::Obstacle => 3,
        Surface::Cloth => 2,
        Surface::PocketBottom(_) => 1,
        Surface::Floor => 0,
    }
}

/// Merges coplanar neighbours into patches and finds edges and corners; returns each face's patch.
fn merge(mesh: &Mesh, terrain: &mut Terrain) -> Vec<u32> {
    // Corners at the same place are one, whatever their numbers.
    let mut places: BTreeMap<[u64; 3], u32> = BTreeMap::new();
    let mut points: Vec<DVec3> = Vec::new();
    let welded: Vec<u32> = mesh
        .vertices
        .iter()
        .map(|vertex| {
            let key = (*vertex + 0.0).to_array().map(f64::to_bits);
            *places.entry(key).or_insert_with(|| {
                points.push(*vertex);
                points.len() as u32 - 1
            })
        })
        .collect();
    struct Flat {
        corners: [u32; 3],
        normal: DVec3,
        surface: Surface,
    }
    let mut flats: Vec<Flat> = Vec::new();
    for face in &mesh.faces {
        let corners = face.corners.map(|corner| welded[corner as usize]);
        let [a, b, c] = corners.map(|corner| points[corner as usize]);
        // Faces without area touch nothing.
        if let Some(normal) = (b - a).cross(c - a).try_normalize() {
            flats.push(Flat { corners, normal, surface: face.surface });
        }
    }

    let mut around: BTreeMap<(u32, u32), SmallVec<[u32; 2]>> = BTreeMap::new();
    for (number, flat) in flats.iter().enumerate() {
        let [a, b, c] = flat.corners;
        for (a, b) in [(a, b), (b, c), (c, a)] {
            around.entry((a.min(b), a.max(b))).or_default().push(number as u32);
        }
    }

    // Spread from a first face to all neighbours that lie in its plane.
    let mut patch_of = vec![u32::MAX; flats.len()];
    for seed in 0..flats.len() {
        if patch_of[seed] != u32::MAX {
            continue;
        }
        let patch = terrain.patches.len() as u32;
        let (normal, surface) = (flats[seed].normal, flats[seed].surface);
        let offset = normal.dot(points[flats[seed].corners[0] as usize]);
        terrain.patches.push(Patch { normal, offset, surface });
        patch_of[seed] = patch;
        let mut open = vec![seed];
        while let Some(face) = open.pop() {
            let [a, b, c] = flats[face].corners;
            for (a, b) in [(a, b), (b, c), (c, a)] {
                for other in &around[&(a.min(b), a.max(b))] {
                    let other = *other as usize;
                    let flat = &flats[other];
                    let level = |corner: &u32| {
                        (normal.dot(points[*corner as usize]) - offset).abs() <= tolerance::MERGE_M
                    };
                    if patch_of[other] == u32::MAX
                        && flat.surface == surface
                        && flat.normal.dot(normal).abs() > 1.0 - tolerance::MERGE_NORMAL
                        && flat.corners.iter().all(level)
                    {
                        patch_of[other] = patch;
                        open.push(other);
                    }
                }
            }
        }
    }

    let mut ends: BTreeMap<u32, (SmallVec<[u32; 6]>, Surface)> = BTreeMap::new();
    for ((a, b), faces) in &around {
        let mut sides: SmallVec<[(u32, DVec3); 2]> = SmallVec::new();
        let (from, to) = (points[*a as usize], points[*b as usize]);
        let along = (to - from).normalize_or(DVec3::X);
        let mut inner = faces.len() == 2;
        for face in faces {
            let flat = &flats[*face as usize];
            let third = flat.corners.iter().find(|corner| **corner != *a && **corner != *b);
            let apex = points[*third.unwrap_or(a) as usize] - from;
            let inwards = (apex - along * apex.dot(along)).normalize_or(flat.normal);
            sides.push((patch_of[*face as usize], inwards));
        }
        let normals: SmallVec<[DVec3; 2]> =
            faces.iter().map(|face| flats[*face as usize].normal).collect();
        let flat = inner
            && normals[0].dot(normals[1]).abs() > 1.0 - tolerance::MERGE_NORMAL
            && sides[0].1.dot(sides[1].1) < 0.0;
        inner &= flat && sides[0].0 == sides[1].0;
        if inner {
            continue;
        }
        let surfaces = faces.iter().map(|face| flats[*face as usize].surface);
        let surface = surfaces.max_by_key(|s| rank(*s)).unwrap_or(Surface::Obstacle);
        if !flat {
            for end in [*a, *b] {
                let (patches, counts_as) =
                    ends.entry(end).or_insert_with(|| (SmallVec::new(), surface));
                for (patch, _) in &sides {
                    if !patches.contains(patch) {
                        patches.push(*patch);
                    }
                }
                if rank(*counts_as) < rank(surface) {
                    *counts_as = surface;
                }
            }
        }
        terrain.edges.push(Edge {
            from,
            along,
            length_m: from.distance(to),
            sides,
            flat,
            surface,
            bounds: bounds_of([from, to].into_iter()),
        });
    }
    for (end, (patches, surface)) in ends {
        terrain.corners.push(Corner { point: points[end as usize], patches, surface });
    }
    terrain.triangles =
        flats.iter().map(|flat| flat.corners.map(|corner| points[corner as usize])).collect();
    patch_of
}
