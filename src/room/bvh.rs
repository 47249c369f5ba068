//! Rays against many triangles: a tree of boxes, split where the surface area heuristic says.
//!
//! Source: I. Wald, "On fast construction of SAH-based bounding volume hierarchies" (2007), binned;
//! T. Möller and B. Trumbore, "Fast, minimum storage ray/triangle intersection" (1997).

use glam::Vec3;

/// Triangles of a leaf, at most.
const LEAF: usize = 4;
/// Places where a node may be split, along each axis.
const BINS: usize = 12;
/// How deep the tree may be; the rest becomes a leaf.
const DEEP: usize = 48;

/// A triangle as rays want it.
#[derive(Debug, Clone, Copy)]
struct Triangle {
    corner: Vec3,
    edges: [Vec3; 2],
    number: u32,
}

#[derive(Debug, Clone, Copy)]
struct Node {
    least: Vec3,
    most: Vec3,
    /// The first triangle of a leaf; the second child of any other node, whose first one follows.
    first: u32,
    /// Triangles of a leaf; 0 for any other node.
    count: u32,
}

/// Where a ray meets a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Hit {
    /// How far away [m].
    pub distance: f32,
    /// Which triangle.
    pub number: u32,
    /// Barycentric weights of its second and third corner.
    pub weights: [f32; 2],
}

/// The tree.
#[derive(Debug, Clone, Default)]
pub(super) struct Bvh {
    nodes: Vec<Node>,
    triangles: Vec<Triangle>,
}

#[derive(Debug, Clone, Copy)]
struct Bounds(Vec3, Vec3);

impl Bounds {
    const NONE: Bounds = Bounds(Vec3::MAX, Vec3::MIN);

    fn with(self, other: Bounds) -> Bounds {
        Bounds(self.0.min(other.0), self.1.max(other.1))
    }

    fn of(triangle: &Triangle) -> Bounds {
        let [b, c] = triangle.edges.map(|edge| triangle.corner + edge);
        Bounds(triangle.corner.min(b).min(c), triangle.corner.max(b).max(c))
    }

    /// Half its surface.
    fn area(self) -> f32 {
        let size = (self.1 - self.0).max(Vec3::ZERO);
        size.x * size.y + size.y * size.z + size.z * size.x
    }
}

impl Bvh {
    /// Over triangles, which are named by their place in the list.
    pub fn new(triangles: &[[Vec3; 3]]) -> Self {
        let mut bvh = Bvh {
            nodes: Vec::new(),
            triangles: (0u32..)
                .zip(triangles)
                .map(|(number, &[a, b, c])| Triangle { corner: a, edges: [b - a, c - a], number })
                .collect(),
        };
        bvh.build(0, triangles.len(), 0);
        bvh
    }

    fn build(&mut self, from: usize, to: usize, depth: usize) {
        let all = self.triangles[from..to].iter().map(Bounds::of).fold(Bounds::NONE, Bounds::with);
        let index = self.nodes.len();
        let leaf =
            Node { least: all.0, most: all.1, first: from as u32, count: (to - from) as u32 };
        self.nodes.push(leaf);
        if to - from <= LEAF || DEEP <= depth {
            return;
        }
        let Some(middle) = self.split(from, to, all) else { return };
        self.build(from, middle, depth + 1);
        self.nodes[index].first = self.nodes.len() as u32;
        self.nodes[index].count = 0;
        self.build(middle, to, depth + 1);
    }

    /// Sorts the triangles of a node into two halves; none if it is cheaper whole.
    fn split(&mut self, from: usize, to: usize, all: Bounds) -> Option<usize> {
        let middle = |triangle: &Triangle| {
            let Bounds(least, most) = Bounds::of(triangle);
            0.5 * (least + most)
        };
        let own = &self.triangles[from..to];
        let centres = own.iter().map(middle).fold(Bounds::NONE, |sum, p| sum.with(Bounds(p, p)));
        let size = centres.1 - centres.0;
        let mut best: Option<(f32, usize, usize)> = None;
        for axis in 0..3 {
            if size[axis] <= 1e-6 {
                continue;
            }
            let bin = |triangle: &Triangle| {
                let share = (middle(triangle)[axis] - centres.0[axis]) / size[axis];
                ((share * BINS as f32) as usize).min(BINS - 1)
            };
            let mut bins = [(0usize, Bounds::NONE); BINS];
            for triangle in own {
                let slot = &mut bins[bin(triangle)];
                *slot = (slot.0 + 1, slot.1.with(Bounds::of(triangle)));
            }
            for cut in 1..BINS {
                let sum = |bins: &[(usize, Bounds)]| {
                    bins.iter().fold((0, Bounds::NONE), |a, b| (a.0 + b.0, a.1.with(b.1)))
                };
                let (low, high) = (sum(&bins[..cut]), sum(&bins[cut..]));
                let cost = low.0 as f32 * low.1.area() + high.0 as f32 * high.1.area();
                if 0 < low.0 && 0 < high.0 && best.is_none_or(|best| cost < best.0) {
                    best = Some((cost, axis, cut));
                }
            }
        }
        let (cost, axis, cut) = best?;
        if (to - from) as f32 * all.area() < cost && to - from <= 4 * LEAF {
            return None;
        }
        let is_low = |triangle: &Triangle| {
            let share = (middle(triangle)[axis] - centres.0[axis]) / size[axis];
            ((share * BINS as f32) as usize).min(BINS - 1) < cut
        };
        // Stable, so that the tree is the same on every machine.
        let (low, high): (Vec<Triangle>, Vec<Triangle>) = own.iter().partition(|t| is_low(t));
        let at = from + low.len();
        self.triangles[from..at].copy_from_slice(&low);
        self.triangles[at..to].copy_from_slice(&high);
        Some(at)
    }

    /// The first triangle on a ray, up to a distance [m].
    pub fn first(&self, from: Vec3, way: Vec3, limit: f32) -> Option<Hit> {
        self.walk::<false>(from, way, limit)
    }

    /// Whether anything lies on a ray nearer than this [m].
    pub fn is_hidden(&self, from: Vec3, way: Vec3, limit: f32) -> bool {
        self.walk::<true>(from, way, limit).is_some()
    }

    fn walk<const ANY: bool>(&self, from: Vec3, way: Vec3, limit: f32) -> Option<Hit> {
        let inverse = way.recip();
        let mut found: Option<Hit> = None;
        let mut limit = limit;
        let mut open = [0u32; DEEP + 4];
        let mut count = usize::from(!self.nodes.is_empty());
        while 0 < count {
            count -= 1;
            let index = open[count];
            let node = &self.nodes[index as usize];
            if !enters(node, from, inverse, limit) {
                continue;
            }
            if node.count == 0 {
                let children = [index + 1, node.first];
                // The nearer one is looked at first.
                let far = |child: u32| {
                    let node = &self.nodes[child as usize];
                    (0.5 * (node.least + node.most) - from).dot(way)
                };
                let is_swapped = far(children[0]) < far(children[1]);
                open[count] = children[usize::from(is_swapped)];
                open[count + 1] = children[usize::from(!is_swapped)];
                count += 2;
                continue;
            }
            let first = node.first as usize;
            for triangle in &self.triangles[first..first + node.count as usize] {
                if let Some((distance, weights)) = meet(triangle, from, way, limit) {
                    limit = distance;
                    found = Some(Hit { distance, number: triangle.number, weights });
                    if ANY {
                        return found;
                    }
                }
            }
        }
        found
    }
}

fn enters(node: &Node, from: Vec3, inverse: Vec3, limit: f32) -> bool {
    let (a, b) = ((node.least - from) * inverse, (node.most - from) * inverse);
    let near = a.min(b).max_element().max(0.0);
    let far = a.max(b).min_element();
    near <= far * 1.000_001 && near < limit
}

fn meet(triangle: &Triangle, from: Vec3, way: Vec3, limit: f32) -> Option<(f32, [f32; 2])> {
    let [u, v] = triangle.edges;
    let across = way.cross(v);
    let volume = u.dot(across);
    if volume.abs() < 1e-14 {
        return None;
    }
    let inverse = volume.recip();
    let away = from - triangle.corner;
    let second = away.dot(across) * inverse;
    if !(0.0..=1.0).contains(&second) {
        return None;
    }
    let along = away.cross(u);
    let third = way.dot(along) * inverse;
    if third < 0.0 || 1.0 < second + third {
        return None;
    }
    let distance = v.dot(along) * inverse;
    (0.0 < distance && distance < limit).then_some((distance, [second, third]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn random(seed: &mut u32) -> f32 {
        *seed = seed.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        (*seed >> 8) as f32 / (1 << 24) as f32
    }

    #[test]
    fn the_tree_finds_what_a_search_through_all_finds() {
        let mut seed = 7;
        let point = |seed: &mut u32, scale: f32| {
            Vec3::new(random(seed), random(seed), random(seed)) * scale
        };
        let triangles: Vec<[Vec3; 3]> = (0..700)
            .map(|_| {
                let at = point(&mut seed, 10.0);
                [at, at + point(&mut seed, 1.0), at + point(&mut seed, 1.0)]
            })
            .collect();
        let bvh = Bvh::new(&triangles);
        let mut hits = 0;
        for _ in 0..2000 {
            let from = point(&mut seed, 10.0);
            let way = (point(&mut seed, 2.0) - 1.0).normalize_or(Vec3::X);
            let slow = bvh
                .triangles
                .iter()
                .filter_map(|t| meet(t, from, way, 5.0).map(|hit| (hit.0, t.number)))
                .min_by(|a, b| a.0.total_cmp(&b.0));
            let fast = bvh.first(from, way, 5.0);
            assert_eq!(fast.map(|hit| hit.number), slow.map(|hit| hit.1));
            assert_eq!(bvh.is_hidden(from, way, 5.0), slow.is_some());
            hits += usize::from(slow.is_some());
        }
        assert!((400..1900).contains(&hits), "{hits}");
    }
}
