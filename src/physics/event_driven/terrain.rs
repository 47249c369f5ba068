//! What does not move, prepared once: planes, flat patches, their edges and corners, in a grid.
//!
//! Coplanar neighbours of one surface are one patch, so seams do not exist: neither for rolling nor
//! for detection. An edge between two patches, or at the border of an open mesh, is a feature of
//! its own, and so is a corner where such edges meet. The grid lists for each cell everything that
//! a ball whose centre is in it can touch; cells where nothing is in reach, or nothing but the bed,
//! know how far around them that holds, and are passed in leaps.

mod coarse;
mod grid;
mod patches;
mod plan;

pub use grid::BESIDE_M;
pub use plan::{Plan, Plans};

use crate::mesh::Surface;
use crate::physics::tolerance;
use crate::rack::Spots;
use crate::table::{Bed, Plane, Pocket, Table};
use coarse::Coarse;
use glam::{DVec3, IVec3};
use grid::Cut;
use plan::Lists;
use smallvec::SmallVec;
use std::sync::OnceLock;

/// Triangles of one patch overlap by this, so that no foot falls between them [m].
const SEAM_M: f64 = 1e-12;

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
    /// A ball around all of its faces: its middle [m], and its radius [m].
    pub middle: DVec3,
    /// See `middle`.
    pub extent_m: f64,
}

impl Patch {
    /// Whether anything within `reach_m` of a point may belong to it; no more than a rough look.
    #[inline]
    pub fn may_reach(&self, point: DVec3, reach_m: f64) -> bool {
        let reach = reach_m + self.extent_m;
        (point - self.middle).length_squared() <= reach * reach
    }
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
}

/// Where edges meet.
#[derive(Debug, Clone)]
pub struct Corner {
    /// Where [m].
    pub point: DVec3,
    /// The patches around it.
    pub patches: SmallVec<[u32; 6]>,
    /// Unit vectors along its edges, away from it.
    pub away: SmallVec<[DVec3; 6]>,
    /// What it counts as.
    pub surface: Surface,
}

/// The faces of one patch in one cell.
#[derive(Debug, Clone, Copy)]
pub struct Group {
    /// The patch.
    pub patch: u32,
    first: u32,
    /// How many; 0 if the foot is inside of the patch wherever in the cell the centre is.
    count: u32,
}

impl Group {
    fn is_whole(&self) -> bool {
        self.count == 0
    }
}

/// A side of a triangle, as the line that a foot inside of the triangle is not beyond.
#[derive(Debug, Clone, Copy)]
struct Side {
    /// Unit vector in the plane of the triangle.
    inwards: DVec3,
    /// Distance of the side from the origin along it [m].
    offset: f64,
}

impl Side {
    /// How far `point` is inside [m].
    fn inside_m(&self, point: DVec3) -> f64 {
        point.dot(self.inwards) - self.offset
    }
}

/// The sides of a triangle that has an area.
fn sides_of(triangle: &[DVec3; 3]) -> [Side; 3] {
    let [a, b, c] = *triangle;
    [(a, b, c), (b, c, a), (c, a, b)].map(|(from, to, third)| {
        let along = (to - from).normalize_or(DVec3::X);
        let across = third - from;
        let inwards = (across - along * across.dot(along)).normalize_or(DVec3::ZERO);
        Side { inwards, offset: inwards.dot(from) }
    })
}

/// A block of cells.
#[derive(Debug, Clone, Copy)]
pub struct Block {
    /// What is in reach; none if nothing is.
    found: Option<Found>,
    /// Its first and last smallest cell along each axis.
    pub low: IVec3,
    /// See `low`.
    pub high: IVec3,
}

/// What a coarse cell lists somewhere.
#[derive(Debug, Clone, Copy)]
struct Found {
    cell: u32,
    listed: Listed,
}

/// Ranges of the lists of parts.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Listed {
    groups: (u32, u32),
    edges: (u32, u32),
    corners: (u32, u32),
}

/// What is in reach.
#[derive(Debug, Clone, Copy)]
pub struct InReach<'a> {
    /// The faces of each patch.
    pub groups: &'a [Group],
    /// Numbers of edges.
    pub edges: &'a [u32],
    /// Numbers of corners.
    pub corners: &'a [u32],
    triangles: &'a [u32],
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
    /// Where balls return to.
    pub spots: Spots,
    /// Pockets.
    pub pockets: Vec<Pocket>,
    /// Nothing is below this [m].
    pub lowest_m: f64,
    triangles: Vec<[DVec3; 3]>,
    /// The sides of each triangle.
    sides: Vec<[Side; 3]>,
    /// The patch of each triangle.
    faces: Vec<u32>,
    /// The largest ball that the grid is made for [m].
    radius_m: f64,
    /// The patch that most faces belong to; cells with nothing else in reach are passed in leaps by
    /// balls that it carries.
    main: u32,
    /// Where the grid begins [m].
    origin: DVec3,
    /// Size of the smallest cells [m].
    cell_m: DVec3,
    /// 1 over it [1/m].
    inverse_cell: DVec3,
    /// How many of them there are along each axis.
    count: IVec3,
    /// What each coarse cell has in reach.
    coarse: Coarse,
    /// The coarse cells, each cut when a ball first comes there.
    cuts: Vec<OnceLock<Box<Cut>>>,
    /// The main patch seen from above, if it is level.
    plans: Option<Plans>,
    /// Coarse cells around each, itself included, in which nothing is in reach; 0 where something
    /// is.
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
            spots: table.spots,
            pockets: table.pockets.clone(),
            ..Terrain::default()
        };
        let of_vertices = table.mesh.vertices.iter().map(|vertex| vertex.z);
        let of_planes = table.planes.iter().map(|plane| plane.point.z);
        terrain.lowest_m = of_vertices.chain(of_planes).fold(0.0, f64::min);
        if !table.mesh.faces.is_empty() {
            terrain.faces = patches::merge(&table.mesh, &mut terrain);
            terrain.sides = terrain.triangles.iter().map(sides_of).collect();
            terrain.bound_patches();
        }
        terrain.fill_grid(radius_m);
        terrain
    }

    /// The same table prepared for balls up to another radius.
    pub fn for_balls_of(&self, radius_m: f64) -> Self {
        let mut terrain = Terrain {
            planes: self.planes.clone(),
            patches: self.patches.clone(),
            edges: self.edges.clone(),
            corners: self.corners.clone(),
            pockets: self.pockets.clone(),
            triangles: self.triangles.clone(),
            sides: self.sides.clone(),
            faces: self.faces.clone(),
            bed: self.bed,
            spots: self.spots,
            lowest_m: self.lowest_m,
            ..Terrain::default()
        };
        terrain.fill_grid(radius_m);
        terrain
    }

    /// The largest ball that it is prepared for [m].
    pub fn radius_m(&self) -> f64 {
        self.radius_m
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

    /// Whether a mesh exists at all.
    pub fn has_mesh(&self) -> bool {
        !self.cuts.is_empty()
    }

    /// The number of the main patch.
    pub fn main_patch(&self) -> Feature {
        Feature::Patch(self.main)
    }

    /// What a ball in a block can reach, if there is anything.
    pub fn in_block(&self, block: &Block) -> Option<InReach<'_>> {
        block.found.map(|found| self.cut(found.cell as usize).lists.of(&found.listed))
    }

    /// The plans of the main patch, for balls of that radius.
    pub fn plans(&self, radius_m: f64) -> Option<&Plans> {
        self.plans.as_ref().filter(|_| radius_m == self.radius_m)
    }

    /// Leaves only the grid.
    #[cfg(test)]
    pub fn forget_plans(&mut self) {
        self.plans = None;
    }

    /// Whether the foot of the perpendicular from `point` lies in one of the faces of a group.
    pub fn holds(&self, lists: &InReach, group: &Group, point: DVec3) -> bool {
        let range = group.first as usize..(group.first + group.count) as usize;
        group.is_whole()
            || lists.triangles[range].iter().any(|triangle| {
                self.sides[*triangle as usize].iter().all(|side| side.inside_m(point) >= -SEAM_M)
            })
    }

    /// Whether the foot of the perpendicular from `point` lies in the main patch, if that is near.
    pub fn main_holds(&self, lists: &InReach, point: DVec3) -> bool {
        let mut groups = lists.groups.iter();
        groups.any(|group| group.patch == self.main && self.holds(lists, group, point))
    }

    /// Everything no farther than `reach_m` from `centre`: feature, unit normal towards the centre,
    /// distance [m]; one of each direction, in a fixed order.
    pub fn near(&self, centre: DVec3, reach_m: f64) -> SmallVec<[(Feature, DVec3, f64); 4]> {
        self.near_but(centre, reach_m, false)
    }

    /// The same; if `but_main` says that nobody wants to hear of the main patch, it may be left
    /// out, which is quick where nothing else is in reach.
    pub fn near_but(
        &self,
        centre: DVec3,
        reach_m: f64,
        but_main: bool,
    ) -> SmallVec<[(Feature, DVec3, f64); 4]> {
        let mut found: SmallVec<[(Feature, DVec3, f64); 4]> = SmallVec::new();
        let note = |found: &mut SmallVec<[(Feature, DVec3, f64); 4]>,
                    feature: Feature,
                    normal: DVec3,
                    distance: f64| {
            let same = |(_, other, _): &(Feature, DVec3, f64)| {
                other.dot(normal) > 1.0 - tolerance::SAME_NORMAL
            };
            if distance <= reach_m && !found.iter().any(same) {
                found.push((feature, normal, distance));
            }
        };
        for (number, plane) in self.planes.iter().enumerate() {
            let distance = (centre - plane.point).dot(plane.normal);
            note(&mut found, Feature::Plane(number as u32), plane.normal, distance);
        }
        if !self.has_mesh() {
            return found;
        }
        let zone = if but_main { self.zone_around(centre) } else { None };
        let around = || self.in_block(&self.block_at(self.place_of(centre), but_main));
        let Some(lists) = zone.or_else(around) else { return found };
        for group in lists.groups {
            let patch = &self.patches[group.patch as usize];
            let height = patch.normal.dot(centre) - patch.offset;
            if height.abs() <= reach_m
                && patch.may_reach(centre, reach_m)
                && self.holds(&lists, group, centre)
            {
                let normal = if height < 0.0 { -patch.normal } else { patch.normal };
                note(&mut found, Feature::Patch(group.patch), normal, height.abs());
            }
        }
        // A little more, for the root's rounding: `note` decides.
        let reach_square = reach_m * reach_m * (1.0 + 1e-12);
        for number in lists.edges {
            let edge = &self.edges[*number as usize];
            let along = (centre - edge.from).dot(edge.along);
            let offset = centre - edge.from - edge.along * along;
            if !edge.flat
                && 0.0 <= along
                && along <= edge.length_m
                && offset.length_squared() <= reach_square
            {
                let distance = offset.length();
                note(&mut found, Feature::Edge(*number), offset.normalize_or(DVec3::Z), distance);
            }
        }
        for number in lists.corners {
            let corner = Feature::Corner(*number);
            let offset = centre - self.corners[*number as usize].point;
            // Beside an edge that ends here, the edge is nearer: a third point would hold a ball
            // that is free to turn about two.
            let ends = |(at, ..): &(Feature, DVec3, f64)| {
                matches!(at, Feature::Edge(_)) && self.belongs(corner, *at)
            };
            if offset.length_squared() <= reach_square && !found.iter().any(ends) {
                note(&mut found, corner, offset.normalize_or(DVec3::Z), offset.length());
            }
        }
        found
    }

    /// Leaves out of a list of contacts the borders of the faces in it: where the foot of a ball
    /// lies inside of a face its edges and corners are farther away, by less than what counts as
    /// touching only because the foot is near them. The ball turns from one to the other in one
    /// contact, not in two.
    pub fn leave_out_borders(&self, contacts: &mut SmallVec<[(Feature, DVec3, f64); 4]>) {
        if contacts.len() < 2 {
            return;
        }
        let of = |border: Feature, inner: Feature| {
            let can = matches!(border, Feature::Edge(_) | Feature::Corner(_));
            can && matches!(inner, Feature::Patch(_)) && self.belongs(border, inner)
        };
        let all = contacts.clone();
        contacts.retain(|(feature, _, _)| !all.iter().any(|(other, _, _)| of(*feature, *other)));
    }

    /// What a ball that the main patch carries has in reach, if it is as large as the largest.
    fn zone_around(&self, centre: DVec3) -> Option<InReach<'_>> {
        let plans = self.plans.as_ref()?;
        let carried = (centre.z - plans.height_m).abs() <= tolerance::SUPPORT_M;
        let zone = plans.carried.zone_at(centre.truncate()).filter(|_| carried)?;
        Some(plans.carried.in_zone(zone))
    }

    /// Whether a contact with `feature` belongs to a lasting contact with `held`.
    pub fn belongs(&self, feature: Feature, held: Feature) -> bool {
        if feature == held {
            return true;
        }
        let of_edge = |edge: u32, patch: u32| {
            self.edges[edge as usize].sides.iter().any(|(side, _)| *side == patch)
        };
        let of_corner =
            |corner: u32, patch: u32| self.corners[corner as usize].patches.contains(&patch);
        match (feature, held) {
            (Feature::Edge(edge), Feature::Patch(patch))
            | (Feature::Patch(patch), Feature::Edge(edge)) => of_edge(edge, patch),
            (Feature::Corner(corner), Feature::Patch(patch))
            | (Feature::Patch(patch), Feature::Corner(corner)) => of_corner(corner, patch),
            (Feature::Edge(edge), Feature::Corner(corner)) => {
                self.corners[corner as usize].patches.iter().any(|patch| of_edge(edge, *patch))
            }
            (Feature::Corner(a), Feature::Corner(b)) => {
                self.corners[a as usize].patches.iter().any(|patch| of_corner(b, *patch))
            }
            (Feature::Corner(corner), Feature::Edge(edge)) => {
                let (point, edge) =
                    (self.corners[corner as usize].point, &self.edges[edge as usize]);
                point == edge.from || point.distance(edge.from + edge.along * edge.length_m) < 1e-12
            }
            // Neighbouring edges are features of their own.
            (Feature::Edge(_), Feature::Edge(_))
            | (Feature::Patch(_), Feature::Patch(_))
            | (Feature::Plane(_), _)
            | (_, Feature::Plane(_)) => false,
        }
    }
}

impl Lists {
    #[inline]
    fn of(&self, listed: &Listed) -> InReach<'_> {
        let range = |(from, to): (u32, u32)| from as usize..to as usize;
        InReach {
            groups: &self.groups[range(listed.groups)],
            edges: &self.edges[range(listed.edges)],
            corners: &self.corners[range(listed.corners)],
            triangles: &self.triangles,
        }
    }
}

/// The corners of the box around some points.
fn bounds_of(points: impl Iterator<Item = DVec3>) -> (DVec3, DVec3) {
    let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    points.fold(start, |(low, high), p| (low.min(p), high.max(p)))
}
