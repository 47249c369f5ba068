//! Coplanar neighbours become one patch; what remains between patches are edges and corners.

use super::{Corner, Edge, Patch, Terrain};
use crate::mesh::{Mesh, Surface};
use crate::physics::tolerance;
use glam::DVec3;
use smallvec::SmallVec;
use std::collections::BTreeMap;

/// A face with an area.
struct Flat {
    corners: [u32; 3],
    normal: DVec3,
    surface: Surface,
    /// Its border, cut wherever a corner of a neighbour lies on it.
    border: SmallVec<[(u32, u32); 3]>,
}

/// The faces at each stretch of border, which is named by its ends in ascending order.
struct Around(Vec<((u32, u32), u32)>);

impl Around {
    fn new(flats: &[Flat]) -> Self {
        let stretches = |(number, flat): (u32, &Flat)| {
            let named = |(a, b): &(u32, u32)| ((*a.min(b), *a.max(b)), number);
            flat.border.iter().map(named).collect::<SmallVec<[_; 3]>>()
        };
        let mut around: Vec<_> = (0..).zip(flats).flat_map(stretches).collect();
        around.sort_unstable();
        Around(around)
    }

    /// Each stretch with its faces, in ascending order.
    fn stretches(&self) -> impl Iterator<Item = &[((u32, u32), u32)]> {
        self.0.chunk_by(|one, two| one.0 == two.0)
    }

    /// The faces at a stretch.
    fn faces(&self, (a, b): (u32, u32)) -> impl Iterator<Item = u32> {
        let ends = (a.min(b), a.max(b));
        let first = self.0.partition_point(|(other, _)| *other < ends);
        self.0[first..].iter().take_while(move |(other, _)| *other == ends).map(|(_, face)| *face)
    }
}

/// How near to an edge a corner lies on it [m].
const ON_EDGE_M: f64 = 1e-9;

/// Merges coplanar neighbours into patches and finds edges and corners; returns each face's patch.
pub(super) fn merge(mesh: &Mesh, terrain: &mut Terrain) -> Vec<u32> {
    let (points, mut flats) = weld(mesh);
    let around = cut_borders(&points, &mut flats);
    let patch_of = spread(&points, &flats, &around, terrain);
    find_edges(&points, &flats, &around, &patch_of, terrain);
    terrain.triangles =
        flats.iter().map(|flat| flat.corners.map(|corner| points[corner as usize])).collect();
    patch_of
}

impl Terrain {
    /// Finds a ball around each patch.
    pub(super) fn bound_patches(&mut self) {
        let mut boxes = vec![(DVec3::INFINITY, DVec3::NEG_INFINITY); self.patches.len()];
        for (triangle, patch) in self.triangles.iter().zip(&self.faces) {
            let (low, high) = &mut boxes[*patch as usize];
            for corner in triangle {
                (*low, *high) = (low.min(*corner), high.max(*corner));
            }
        }
        for (patch, (low, high)) in self.patches.iter_mut().zip(&boxes) {
            patch.middle = 0.5 * (*low + *high);
            patch.extent_m = tolerance::MERGE_M;
        }
        for (triangle, patch) in self.triangles.iter().zip(&self.faces) {
            let patch = &mut self.patches[*patch as usize];
            for corner in triangle {
                let far = corner.distance(patch.middle) + tolerance::MERGE_M;
                patch.extent_m = patch.extent_m.max(far);
            }
        }
    }
}

/// Corners at the same place are one, whatever their numbers; faces without area touch nothing.
fn weld(mesh: &Mesh) -> (Vec<DVec3>, Vec<Flat>) {
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
    let mut flats: Vec<Flat> = Vec::new();
    for face in &mesh.faces {
        let corners = face.corners.map(|corner| welded[corner as usize]);
        let [a, b, c] = corners.map(|corner| points[corner as usize]);
        if let Some(normal) = (b - a).cross(c - a).try_normalize() {
            let [a, b, c] = corners;
            let border = [(a, b), (b, c), (c, a)].into_iter().collect();
            flats.push(Flat { corners, normal, surface: face.surface, border });
        }
    }
    (points, flats)
}

/// Cuts open borders at the corners of neighbours: a large face beside two small ones. Returns the
/// stretches that are left.
fn cut_borders(points: &[DVec3], flats: &mut [Flat]) -> Around {
    let around = Around::new(flats);
    let open: Vec<((u32, u32), u32)> =
        around.stretches().filter_map(|faces| (faces.len() == 1).then_some(faces[0])).collect();
    let mut corners: Vec<u32> = open.iter().flat_map(|((a, b), _)| [*a, *b]).collect();
    let x = |corner: &u32| points[*corner as usize].x;
    corners.sort_unstable_by(|a, b| x(a).total_cmp(&x(b)).then(a.cmp(b)));
    corners.dedup();
    let mut is_cut = false;
    for ((a, b), face) in open {
        let (from, to) = (points[a as usize], points[b as usize]);
        let Some(along) = (to - from).try_normalize() else { continue };
        let length = from.distance(to);
        let (low, high) = (from.x.min(to.x) - ON_EDGE_M, from.x.max(to.x) + ON_EDGE_M);
        let first = corners.partition_point(|corner| x(corner) < low);
        let mut cuts: Vec<(f64, u32)> = corners[first..]
            .iter()
            .take_while(|corner| x(corner) <= high)
            .filter_map(|corner| {
                let offset = points[*corner as usize] - from;
                let t = offset.dot(along);
                let on = (offset - along * t).length() <= ON_EDGE_M;
                (on && ON_EDGE_M < t && t < length - ON_EDGE_M).then_some((t, *corner))
            })
            .collect();
        if cuts.is_empty() {
            continue;
        }
        cuts.sort_unstable_by(|one, two| one.0.total_cmp(&two.0));
        let stops: Vec<u32> =
            [a].into_iter().chain(cuts.into_iter().map(|(_, corner)| corner)).chain([b]).collect();
        is_cut = true;
        let border = &mut flats[face as usize].border;
        border.retain(|ends| *ends != (a, b) && *ends != (b, a));
        border.extend(stops.windows(2).map(|pair| (pair[0], pair[1])));
    }
    if is_cut { Around::new(flats) } else { around }
}

/// Spreads from a first face to all neighbours that lie in its plane; returns each face's patch.
fn spread(points: &[DVec3], flats: &[Flat], around: &Around, terrain: &mut Terrain) -> Vec<u32> {
    let mut patch_of = vec![u32::MAX; flats.len()];
    for seed in 0..flats.len() {
        if patch_of[seed] != u32::MAX {
            continue;
        }
        let patch = terrain.patches.len() as u32;
        let (normal, surface) = (flats[seed].normal, flats[seed].surface);
        let offset = normal.dot(points[flats[seed].corners[0] as usize]);
        let (middle, extent_m) = (DVec3::ZERO, f64::INFINITY);
        terrain.patches.push(Patch { normal, offset, surface, middle, extent_m });
        patch_of[seed] = patch;
        let mut open = vec![seed];
        while let Some(face) = open.pop() {
            for ends in &flats[face].border {
                for other in around.faces(*ends) {
                    let other = other as usize;
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
    patch_of
}

/// Edges where patches meet or a mesh ends, and the corners where such edges meet.
fn find_edges(
    points: &[DVec3],
    flats: &[Flat],
    around: &Around,
    patch_of: &[u32],
    terrain: &mut Terrain,
) {
    let mut ends: BTreeMap<u32, Corner> = BTreeMap::new();
    for stretch in around.stretches() {
        let (a, b) = stretch[0].0;
        let faces: SmallVec<[u32; 2]> = stretch.iter().map(|(_, face)| *face).collect();
        let (from, to) = (points[a as usize], points[b as usize]);
        let along = (to - from).normalize_or(DVec3::X);
        let mut sides: SmallVec<[(u32, DVec3); 2]> = SmallVec::new();
        for face in &faces {
            let flat = &flats[*face as usize];
            let across = |corner: u32| {
                let offset = points[corner as usize] - from;
                offset - along * offset.dot(along)
            };
            let farthest = flat
                .corners
                .map(across)
                .into_iter()
                .max_by(|p, q| p.length_squared().total_cmp(&q.length_squared()));
            let inwards = farthest.unwrap_or(flat.normal).normalize_or(flat.normal);
            sides.push((patch_of[*face as usize], inwards));
        }
        let level = |one: u32, two: u32| {
            let (p, q) = (flats[one as usize].normal, flats[two as usize].normal);
            p.dot(q).abs() > 1.0 - tolerance::MERGE_NORMAL
        };
        let flat =
            matches!(faces[..], [one, two] if level(one, two)) && sides[0].1.dot(sides[1].1) < 0.0;
        if flat && sides[0].0 == sides[1].0 {
            continue;
        }
        let surfaces = faces.iter().map(|face| flats[*face as usize].surface);
        let surface = surfaces.max_by_key(|s| s.rank()).unwrap_or(Surface::Obstacle);
        if !flat {
            for (end, away) in [(a, along), (b, -along)] {
                let corner = ends.entry(end).or_insert_with(|| Corner {
                    point: points[end as usize],
                    patches: SmallVec::new(),
                    away: SmallVec::new(),
                    surface,
                });
                for (patch, _) in &sides {
                    if !corner.patches.contains(patch) {
                        corner.patches.push(*patch);
                    }
                }
                corner.away.push(away);
                if corner.surface.rank() < surface.rank() {
                    corner.surface = surface;
                }
            }
        }
        terrain.edges.push(Edge { from, along, length_m: from.distance(to), sides, flat, surface });
    }
    terrain.corners.extend(ends.into_values());
}
