//! Baking: the light that falls on every texel of a room, from its lamps and over several bounces.
//!
//! A texel keeps `E / π` [`E` the irradiance]: the radiance of a white surface in its place. First
//! the light straight from the lamps, with points sampled on them; then, bounce by bounce, a
//! gather: rays with a cosine distribution bring home the light of the texel they hit, as the last
//! bounce left it, times the colour there. So each bounce costs one ray per sample, and all
//! surfaces light each other without a matrix (radiosity by gathering; M. Cohen and J. Wallace,
//! "Radiosity and Realistic Image Synthesis", 1993, chapter 5).
//!
//! Samples are points of a low-discrepancy sequence (M. Roberts, "The unreasonable effectiveness
//! of quasirandom sequences", 2018), shifted for each texel, so a bake is the same every time and
//! on any number of threads. Tests hold it against closed forms: the light under a rectangular lamp
//! (worst texel, of the brightest) and a furnace whose walls shine and throw back;
//! `cargo core room::light -- --nocapture` prints the errors.

use super::bvh::Bvh;
use super::light_map::LightMap;
use super::texels::{Texel, texels};
use super::{Group, Room, Surfaces};
use glam::{Vec2, Vec2Swizzles, Vec3};
use std::collections::BTreeMap;

/// How often light is thrown back.
pub const BOUNCES: u32 = 4;
/// How far a ray starts from its surface [m].
const AWAY_M: f32 = 3e-4;
/// A texel of whose rays more than this share see the back of something lies inside of it.
const INSIDE: f32 = 0.25;
/// Brightest light that is thrown back, in units of a white surface in full light.
const BRIGHTEST: f32 = 3.0;
/// The farthest that anything is away [m].
const FAR_M: f32 = 1e3;
/// Where the picture of the room for mirrors is taken: a little over the middle of the bed [m].
const MIRROR_EYE: Vec3 = Vec3::new(0.0, 0.0, 0.12);

/// One round over all texels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pass {
    /// Straight from the lamps.
    Direct,
    /// Thrown back by surfaces, for the so-manieth time.
    Bounce(u32),
}

impl Pass {
    /// All, in their order.
    pub fn all() -> impl Iterator<Item = Pass> {
        core::iter::once(Pass::Direct).chain((1..=BOUNCES).map(Pass::Bounce))
    }
}

/// A lamp: the triangles of one chart that shines.
#[derive(Debug, Clone)]
struct Lamp {
    /// A corner, two edges, and where its share of the area ends, from 0 to 1.
    triangles: Vec<(Vec3, [Vec3; 2], f32)>,
    emission: Vec3,
    area: f32,
    middle: Vec3,
    radius: f32,
}

/// What a ray finds out about a triangle.
#[derive(Debug, Clone, Copy)]
struct Face {
    lights: [Vec2; 3],
    normal: Vec3,
    albedo: Vec3,
    emission: Vec3,
    group: Group,
}

/// A bake in progress. Rounds are run by the caller, on as many threads as it likes:
///
/// ```
/// use hapticbillard::room::{Baker, Pass, Room};
/// use hapticbillard::table::Table;
///
/// let room = Room::around(&Table::preset("pool-9ft")?).ok_or("no billiard table")?;
/// let mut baker = Baker::new(&room.surfaces, 1);
/// # let only_a_taste = 0;
/// # for pass in Pass::all().take(only_a_taste) {
/// for pass in Pass::all() {
/// # }
/// # for pass in Pass::all().take(only_a_taste) {
///     let light: Vec<_> = (0..baker.texels()).map(|k| baker.light(pass, k)).collect();
///     baker.take(pass, &light);
/// }
/// # }
/// let map = baker.finish(&room);
/// assert_eq!(map.size[0], 512);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Baker<'a> {
    surfaces: &'a Surfaces,
    bvh: Bvh,
    faces: Vec<Face>,
    lamps: Vec<Lamp>,
    texels: Vec<Texel>,
    samples: u32,
    direct: Vec<Vec3>,
    bounced: Vec<Vec3>,
    is_inside: Vec<bool>,
    /// Everything so far, over the whole map.
    total: Vec<Vec3>,
}

impl<'a> Baker<'a> {
    /// Makes ready; `samples` is the number of rays per texel and round.
    pub fn new(surfaces: &'a Surfaces, samples: u32) -> Self {
        let corners = |triangle: &[u32; 3]| {
            triangle.map(|n| surfaces.vertices[n as usize].position.as_vec3())
        };
        let soup: Vec<[Vec3; 3]> = surfaces.triangles.iter().map(|(t, _)| corners(t)).collect();
        let faces: Vec<Face> = surfaces
            .triangles
            .iter()
            .zip(&soup)
            .map(|((triangle, group), [a, b, c])| {
                let vertices = triangle.map(|n| &surfaces.vertices[n as usize]);
                let finish = &surfaces.finishes[usize::from(vertices[0].finish)];
                Face {
                    lights: vertices.map(|vertex| vertex.light.as_vec2()),
                    normal: (b - a).cross(c - a).normalize_or(Vec3::Z),
                    albedo: finish.colour.into(),
                    emission: finish.emission.into(),
                    group: *group,
                }
            })
            .collect();
        let texels = texels(surfaces);
        let count = texels.len();
        let [width, height] = surfaces.size;
        Baker {
            surfaces,
            bvh: Bvh::new(&soup),
            lamps: lamps(surfaces, &soup),
            faces,
            texels,
            samples: samples.max(1),
            direct: vec![Vec3::ZERO; count],
            bounced: vec![Vec3::ZERO; count],
            is_inside: vec![false; count],
            total: vec![Vec3::ZERO; (width * height) as usize],
        }
    }

    /// How many texels there are to compute in each round.
    pub fn texels(&self) -> usize {
        self.texels.len()
    }

    /// The light of texel `k`, and the share of its rays that saw the back of something.
    pub fn light(&self, pass: Pass, k: usize) -> (Vec3, f32) {
        let texel = &self.texels[k];
        match pass {
            Pass::Direct => (self.by_lamps(texel), 0.0),
            Pass::Bounce(round) => self.thrown_back(texel, round),
        }
    }

    /// Takes the light of all texels in a round.
    pub fn take(&mut self, pass: Pass, light: &[(Vec3, f32)]) {
        let into = if pass == Pass::Direct { &mut self.direct } else { &mut self.bounced };
        for (own, (light, _)) in into.iter_mut().zip(light) {
            *own = *light;
        }
        if pass != Pass::Direct {
            for (own, (_, inside)) in self.is_inside.iter_mut().zip(light) {
                *own = INSIDE < *inside;
            }
        }
        let sum: Vec<Vec3> = self.direct.iter().zip(&self.bounced).map(|(a, b)| a + b).collect();
        self.total = self.spread(&sum);
    }

    /// Column and row of texel `k` in the map.
    pub fn place(&self, k: usize) -> [u32; 2] {
        let width = self.surfaces.size[0];
        [self.texels[k].number % width, self.texels[k].number / width]
    }

    /// Goes on from light that was baked before: what surfaces throw back next is that of this map.
    pub fn go_on_from(&mut self, map: &LightMap) {
        let [width, height] = self.surfaces.size;
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        self.total = places.map(|(x, y)| map.light(x, y).into()).collect();
    }

    /// The light that a texel of the map has now.
    pub fn total(&self, x: u32, y: u32) -> Vec3 {
        self.total[(y * self.surfaces.size[0] + x) as usize]
    }

    /// The map of a room, with what its mirrors see.
    pub fn finish(&self, room: &Room) -> LightMap {
        let smooth = self.smooth();
        let sum: Vec<Vec3> = self.direct.iter().zip(&smooth).map(|(a, b)| a + b).collect();
        let mut map = self.spread(&sum);
        self.mirror(room, &mut map);
        LightMap::of(self.surfaces.size, &map)
    }

    fn by_lamps(&self, texel: &Texel) -> Vec3 {
        let place = texel.points[0].position;
        let lamps = (0u32..).zip(&self.lamps);
        let light = lamps.map(|(k, lamp)| {
            // At most so bright it can be here, and so many samples it is worth.
            let away = (place.distance(lamp.middle) - lamp.radius).max(0.05);
            let most =
                lamp.emission.max_element() * lamp.area / (core::f32::consts::PI * away * away);
            let samples = (self.samples as f32 * 2.0 * (most / 2.0).sqrt()) as u32;
            self.by_lamp(texel, lamp, samples.clamp(self.samples / 8 + 1, 2 * self.samples), k)
        });
        light.sum::<Vec3>() / core::f32::consts::PI
    }

    fn by_lamp(&self, texel: &Texel, lamp: &Lamp, samples: u32, number: u32) -> Vec3 {
        let shift = shift(texel.number, 100 + number);
        let mut sum = 0.0;
        for n in 0..samples {
            let [choice, r, s] = point_3(n, shift);
            let at = lamp.triangles.partition_point(|(_, _, end)| *end < choice);
            let (corner, edges, _) = lamp.triangles[at.min(lamp.triangles.len() - 1)];
            let point = &texel.points[n as usize % texel.points.len()];
            let root = r.sqrt();
            let on = corner + edges[0] * (root * (1.0 - s)) + edges[1] * (root * s);
            let from = point.position + point.flat * AWAY_M;
            let way = on - from;
            let square = way.length_squared();
            let distance = square.sqrt();
            let way = way / distance;
            let shining = edges[0].cross(edges[1]).normalize_or_zero();
            let (here, there) = (way.dot(point.normal), -way.dot(shining));
            if here <= 0.0 || there <= 0.0 || way.dot(point.flat) <= 0.0 {
                continue;
            }
            if !self.bvh.is_hidden(from, way, distance - 2.0 * AWAY_M) {
                sum += here * there / square.max(1e-4);
            }
        }
        lamp.emission * (lamp.area * sum / samples as f32)
    }

    fn thrown_back(&self, texel: &Texel, round: u32) -> (Vec3, f32) {
        let (mut sum, mut backs) = (Vec3::ZERO, 0);
        let shift = shift(texel.number, round);
        for n in 0..self.samples {
            let point = &texel.points[n as usize % texel.points.len()];
            let [r, s, _] = point_3(n, shift);
            let way = cosine(point.normal, r, s);
            if way.dot(point.flat) <= 0.0 {
                continue;
            }
            let from = point.position + point.flat * AWAY_M;
            let Some(hit) = self.bvh.first(from, way, FAR_M) else { continue };
            let face = &self.faces[hit.number as usize];
            if 0.0 < face.normal.dot(way) {
                backs += 1;
                continue;
            }
            // What is brighter than all that is looked at is seen by few rays: it is noise.
            sum += face.albedo * self.at(face, hit.weights).min(Vec3::splat(BRIGHTEST));
        }
        let count = self.samples as f32;
        (sum / count, backs as f32 / count)
    }

    /// The light of a face, between its texels.
    fn at(&self, face: &Face, [second, third]: [f32; 2]) -> Vec3 {
        let [a, b, c] = face.lights;
        let at = a + (b - a) * second + (c - a) * third - 0.5;
        let [width, height] = self.surfaces.size;
        let low = at.floor().max(Vec2::ZERO);
        let (x, y) = ((low.x as u32).min(width - 2), (low.y as u32).min(height - 2));
        let share = (at - Vec2::new(x as f32, y as f32)).clamp(Vec2::ZERO, Vec2::ONE);
        let texel = |dx: u32, dy: u32| self.total[((y + dy) * width + x + dx) as usize];
        let low = texel(0, 0).lerp(texel(1, 0), share.x);
        let high = texel(0, 1).lerp(texel(1, 1), share.x);
        low.lerp(high, share.y)
    }

    /// Light over the whole map: texels inside of things and round the charts get that of their
    /// neighbours.
    fn spread(&self, light: &[Vec3]) -> Vec<Vec3> {
        let [width, height] = self.surfaces.size;
        let mut map = vec![Vec3::ZERO; (width * height) as usize];
        // 0: nothing yet. Charts keep to themselves: the gutter is wide enough for one step.
        let mut owner = vec![0u32; map.len()];
        let mut inside = Vec::new();
        for ((texel, light), is_inside) in self.texels.iter().zip(light).zip(&self.is_inside) {
            if *is_inside {
                inside.push((texel.number, u32::from(texel.chart) + 1));
            } else {
                map[texel.number as usize] = *light;
                owner[texel.number as usize] = u32::from(texel.chart) + 1;
            }
        }
        let around = |number: u32| {
            let (x, y) = (number % width, number / width);
            let rows = y.saturating_sub(1)..=(y + 1).min(height - 1);
            rows.flat_map(move |v| {
                let columns = x.saturating_sub(1)..=(x + 1).min(width - 1);
                columns.map(move |u| (v * width + u) as usize)
            })
        };
        // Into what lies inside of things, from its edge on, within a chart.
        while !inside.is_empty() {
            let filled: Vec<(u32, u32, Vec3)> = inside
                .iter()
                .filter_map(|&(number, own)| {
                    let (sum, count) = around(number)
                        .filter(|n| owner[*n] == own)
                        .fold((Vec3::ZERO, 0.0), |sum, n| (sum.0 + map[n], sum.1 + 1.0));
                    (0.0 < count).then(|| (number, own, sum / count))
                })
                .collect();
            if filled.is_empty() {
                break;
            }
            for (number, own, light) in filled {
                (map[number as usize], owner[number as usize]) = (light, own);
            }
            inside.retain(|(number, _)| owner[*number as usize] == 0);
        }
        // And into the gutter.
        let gutter: Vec<(usize, Vec3)> = (0..width * height)
            .filter(|number| owner[*number as usize] == 0)
            .filter_map(|number| {
                let (sum, count) = around(number)
                    .filter(|n| owner[*n] != 0)
                    .fold((Vec3::ZERO, 0.0), |sum, n| (sum.0 + map[n], sum.1 + 1.0));
                (0.0 < count).then(|| (number as usize, sum / count))
            })
            .collect();
        for (number, light) in gutter {
            map[number] = light;
        }
        map
    }

    /// What surfaces throw back, without the noise between neighbours that look the same way.
    fn smooth(&self) -> Vec<Vec3> {
        let [width, height] = self.surfaces.size;
        let mut places = vec![u32::MAX; (width * height) as usize];
        for (k, texel) in self.texels.iter().enumerate() {
            if !self.is_inside[k] {
                places[texel.number as usize] = k as u32;
            }
        }
        let own = |k: usize| {
            let texel = &self.texels[k];
            let normal = texel.points[0].normal;
            let (x, y) = ((texel.number % width) as i64, (texel.number / width) as i64);
            let (mut sum, mut weights) = (Vec3::ZERO, 0.0);
            for (dx, dy) in (-2..=2).flat_map(|dy| (-2..=2).map(move |dx| (dx, dy))) {
                let (u, v) = (x + dx, y + dy);
                if u < 0 || v < 0 || i64::from(width) <= u || i64::from(height) <= v {
                    continue;
                }
                let place = places[(v * i64::from(width) + u) as usize];
                let Some(other) = self.texels.get(place as usize) else { continue };
                if other.chart != texel.chart {
                    continue;
                }
                let alike = other.points[0].normal.dot(normal).max(0.0);
                let near = 1.0 / (1.0 + (dx * dx + dy * dy) as f32);
                let weight = near * alike * alike * alike * alike;
                sum += self.bounced[place as usize] * weight;
                weights += weight;
            }
            if 0.0 < weights { sum / weights } else { self.bounced[k] }
        };
        (0..self.texels.len()).map(own).collect()
    }

    /// What is seen from over the table in every direction, but for lamp and table.
    fn mirror(&self, room: &Room, map: &mut [Vec3]) {
        let chart = room.mirror_chart();
        for (i, j) in (0..chart.rows).flat_map(|j| (0..chart.columns).map(move |i| (i, j))) {
            let mut sum = Vec3::ZERO;
            for n in 0..16 {
                let sub = |k: u32, at: u32, count: u32| {
                    let step = (k as f32 + 0.5) / 4.0 - 0.5;
                    (2.0 * (at as f32 + step) / (count - 1) as f32 - 1.0).clamp(-1.0, 1.0)
                };
                let at = Vec2::new(sub(n % 4, i, chart.columns), sub(n / 4, j, chart.rows));
                sum += self.seen(MIRROR_EYE, unfolded(at));
            }
            let number = (chart.y + j) * self.surfaces.size[0] + chart.x + i;
            map[number as usize] = sum / 16.0;
        }
    }

    /// What an eye sees of the room along a way, through lamp and table.
    fn seen(&self, eye: Vec3, way: Vec3) -> Vec3 {
        let mut from = eye;
        for _ in 0..24 {
            let Some(hit) = self.bvh.first(from, way, FAR_M) else { break };
            let face = &self.faces[hit.number as usize];
            let is_through = matches!(face.group, Group::Lamp | Group::TableTop);
            if is_through || 0.0 < face.normal.dot(way) {
                from += way * (hit.distance + AWAY_M);
                continue;
            }
            return face.emission + face.albedo * self.at(face, hit.weights);
        }
        Vec3::ZERO
    }
}

/// What shines.
fn lamps(surfaces: &Surfaces, soup: &[[Vec3; 3]]) -> Vec<Lamp> {
    let mut by_chart: BTreeMap<u16, Vec<usize>> = BTreeMap::new();
    for (number, (triangle, _)) in surfaces.triangles.iter().enumerate() {
        let vertex = &surfaces.vertices[triangle[0] as usize];
        if surfaces.finish_of(vertex).shines() {
            by_chart.entry(vertex.chart).or_default().push(number);
        }
    }
    let lamp = |numbers: &Vec<usize>| {
        let own = || numbers.iter().map(|number| soup[*number]);
        let area = |[a, b, c]: [Vec3; 3]| 0.5 * (b - a).cross(c - a).length();
        let whole: f32 = own().map(area).sum();
        let (least, most) =
            own().flatten().fold((Vec3::MAX, Vec3::MIN), |sum, p| (sum.0.min(p), sum.1.max(p)));
        let mut end = 0.0;
        let triangles = own().map(|[a, b, c]| {
            end += area([a, b, c]) / whole;
            (a, [b - a, c - a], end)
        });
        let vertex = &surfaces.vertices[surfaces.triangles[numbers[0]].0[0] as usize];
        Lamp {
            triangles: triangles.collect(),
            emission: surfaces.finish_of(vertex).emission.into(),
            area: whole,
            middle: 0.5 * (least + most),
            radius: 0.5 * least.distance(most),
        }
    };
    by_chart.values().map(lamp).collect()
}

/// Where a texel's samples begin.
fn shift(number: u32, round: u32) -> [u32; 3] {
    let mut z = u64::from(number) << 8 | u64::from(round);
    core::array::from_fn(|_| {
        z = z.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (x >> 32) as u32
    })
}

/// Point `n` of the sequence in three dimensions, from 0 to 1.
fn point_3(n: u32, shift: [u32; 3]) -> [f32; 3] {
    // 2^32 over the powers of 1.2207…, the root of x^4 = x + 1.
    const STEPS: [u32; 3] = [3_518_319_155, 2_882_110_345, 2_360_945_575];
    core::array::from_fn(|k| {
        let fixed = STEPS[k].wrapping_mul(n).wrapping_add(shift[k]);
        (fixed >> 8) as f32 / (1 << 24) as f32
    })
}

/// A direction about `normal` with a cosine distribution.
fn cosine(normal: Vec3, r: f32, s: f32) -> Vec3 {
    let (sin, cos) = libm::sincosf(core::f32::consts::TAU * r);
    let radius = s.sqrt();
    let (u, v) = normal.any_orthonormal_pair();
    u * (radius * cos) + v * (radius * sin) + normal * (1.0 - s).max(0.0).sqrt()
}

/// The direction at a place of an octahedron that was unfolded onto a square from −1 to 1.
fn unfolded(at: Vec2) -> Vec3 {
    let z = 1.0 - at.x.abs() - at.y.abs();
    let level = match z < 0.0 {
        true => (1.0 - at.yx().abs()) * Vec2::new(1f32.copysign(at.x), 1f32.copysign(at.y)),
        false => at,
    };
    level.extend(z).normalize()
}
