//! Building: grids of points become triangles with normals, grain and a place in the light map.
//!
//! Everything in the room is a grid, a rectangle of rows and columns of points: a plank has 2 × 2,
//! a turned leg goes round, a vault bends. So one function knows how normals, textures and light
//! maps are laid on.

use super::Finish;
use super::chart::Chart;
use glam::{DAffine3, DVec2, DVec3};

/// Shares of a surface that are no area [m²]: two rows at one place are a sharp edge.
const NO_AREA_M2: f64 = 1e-10;

/// A corner of the room's triangles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vertex {
    /// Where it is [m].
    pub position: DVec3,
    /// Unit normal.
    pub normal: DVec3,
    /// Coordinates of the grain [m], u along it.
    pub grain: DVec2,
    /// Coordinates in the light map [texels].
    pub light: DVec2,
    /// What it is made of: a number of [`super::Surfaces::finishes`].
    pub finish: u16,
    /// Its chart.
    pub chart: u16,
}

/// Parts of the room that are hidden where they would be in the way.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Group {
    /// Walls, floor, furniture, apron and legs of the table: always there.
    Standing,
    /// What hangs from the vault or carries it: hidden from an eye above it.
    Ceiling,
    /// The lamp over the table: hidden where it would cover the table.
    Lamp,
    /// The upper side of the table, which others draw: it takes and gives light.
    TableTop,
}

/// Collects the triangles of a room.
#[derive(Debug, Default)]
pub(super) struct Builder {
    pub vertices: Vec<Vertex>,
    pub triangles: Vec<([u32; 3], Group)>,
    pub charts: Vec<Chart>,
    pub finishes: Vec<Finish>,
    place: DAffine3,
    group: Option<Group>,
}

/// How a grid is laid on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lay {
    /// Texels of the light map per metre.
    pub per_m: f64,
    /// The grain runs along rows, not columns.
    pub along_rows: bool,
    /// The last column is the first one again.
    pub is_round: bool,
    /// The grain lies on the planes of the world, so that it goes on from one part to the next.
    pub is_planar: bool,
}

impl Lay {
    /// Texels per metre, grain along columns.
    pub const fn of(per_m: f64) -> Self {
        Lay { per_m, along_rows: false, is_round: false, is_planar: false }
    }

    /// The same with the grain along the rows.
    pub const fn across(self) -> Self {
        Lay { along_rows: true, ..self }
    }

    /// The same with the grain on the planes of the world.
    pub const fn planar(self) -> Self {
        Lay { is_planar: true, ..self }
    }
}

impl Builder {
    /// What is built from here on belongs to this group.
    pub fn begin(&mut self, group: Group) {
        self.group = Some(group);
        self.place = DAffine3::IDENTITY;
    }

    /// What is built from here on stands here, turned about the vertical by this angle.
    pub fn stand(&mut self, at: DVec3, turn_rad: f64) {
        let (sin, cos) = libm::sincos(turn_rad);
        self.place = DAffine3::from_cols(
            DVec3::new(cos, sin, 0.0),
            DVec3::new(-sin, cos, 0.0),
            DVec3::Z,
            at,
        );
    }

    /// Where things are built now.
    pub fn place(&self) -> DAffine3 {
        self.place
    }

    /// How high the place is where things are built now [m].
    pub fn floor(&self) -> f64 {
        self.place.translation.z
    }

    /// What is built from here on stands here within a place.
    pub fn stand_in(&mut self, place: DAffine3, at: DVec3) {
        self.place = place * DAffine3::from_translation(at);
    }

    /// What is built from here on is leant by this angle about its own x axis, from y towards z.
    pub fn lean(&mut self, by_rad: f64) {
        let (sin, cos) = libm::sincos(by_rad);
        let leant = DAffine3::from_cols(
            DVec3::X,
            DVec3::new(0.0, cos, sin),
            DVec3::new(0.0, -sin, cos),
            DVec3::ZERO,
        );
        self.place *= leant;
    }

    /// The number of a finish.
    pub fn finish(&mut self, finish: Finish) -> u16 {
        let known = self.finishes.iter().position(|other| *other == finish);
        known.unwrap_or_else(|| {
            self.finishes.push(finish);
            self.finishes.len() - 1
        }) as u16
    }

    /// A chart of this size [texels].
    pub fn chart(&mut self, columns: u32, rows: u32) -> u16 {
        self.charts.push(Chart::of(columns, rows));
        self.charts.len() as u16 - 1
    }

    /// Adds a triangle of three vertices.
    pub fn triangle(&mut self, corners: [u32; 3]) {
        self.triangles.push((corners, self.group.unwrap_or(Group::Standing)));
    }

    /// Adds a grid: rows of equally many points. Seen from outside, columns run to the right and
    /// rows upwards. It becomes one chart; two rows at one place are a sharp edge.
    pub fn grid(&mut self, rows: &[Vec<DVec3>], finish: Finish, lay: Lay) {
        let finish = self.finish(finish);
        let (height, width) = (rows.len(), rows.first().map_or(0, Vec::len));
        if height < 2 || width < 2 {
            return;
        }
        let rows: Vec<Vec<DVec3>> = rows
            .iter()
            .map(|row| row.iter().map(|p| self.place.transform_point3(*p)).collect())
            .collect();
        let along = lengths(width, |j| widest(&rows, |row| row[j].distance(row[j - 1])));
        let up = lengths(height, |i| longest(&rows[i], &rows[i - 1]));
        let texels = |length: &[f64]| {
            let length = length.last().copied().unwrap_or(0.0);
            ((length * lay.per_m).ceil() as u32 + 1).clamp(2, 250)
        };
        let (columns, lines) = (texels(&along), texels(&up));
        let chart = self.chart(columns, lines);
        let share = |length: &[f64], i: usize| {
            let whole = length.last().copied().unwrap_or(0.0);
            if whole > 0.0 { length[i] / whole } else { 0.0 }
        };
        let first = self.vertices.len() as u32;
        for i in 0..height {
            for j in 0..width {
                let light = DVec2::new(
                    share(&along, j) * f64::from(columns - 1),
                    share(&up, i) * f64::from(lines - 1),
                );
                let normal = normal(&rows, i, j, lay.is_round);
                let grain = match (lay.is_planar, lay.along_rows) {
                    (true, _) => on_plane(rows[i][j], normal),
                    (false, true) => DVec2::new(up[i], along[j]),
                    (false, false) => DVec2::new(along[j], up[i]),
                };
                self.vertices.push(Vertex {
                    position: rows[i][j],
                    normal,
                    grain,
                    light,
                    finish,
                    chart,
                });
            }
        }
        let number = |i: usize, j: usize| first + (i * width + j) as u32;
        for i in 1..height {
            for j in 1..width {
                let corners =
                    [number(i - 1, j - 1), number(i - 1, j), number(i, j), number(i, j - 1)];
                for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
                    let triangle = [corners[a], corners[b], corners[c]];
                    let [p, q, r] = triangle.map(|n| self.vertices[n as usize].position);
                    if NO_AREA_M2 < (q - p).cross(r - p).length() {
                        self.triangle(triangle);
                    }
                }
            }
        }
    }

    /// A flat parallelogram from `corner` along `u` and `v`; it faces along `u × v`.
    pub fn quad(&mut self, corner: DVec3, u: DVec3, v: DVec3, finish: Finish, lay: Lay) {
        let rows = [vec![corner, corner + u], vec![corner + v, corner + u + v]];
        self.grid(&rows, finish, lay);
    }

    /// A box between two corners, but for the faces that nobody sees: letters of `without` are `b`
    /// for the bottom, `t` top, `w` at the least x, `e` at the greatest, `s` at the least y, `n` at
    /// the greatest.
    pub fn cuboid(&mut self, least: DVec3, most: DVec3, without: &str, finish: Finish, lay: Lay) {
        let size = most - least;
        let (x, y, z) = (DVec3::X * size.x, DVec3::Y * size.y, DVec3::Z * size.z);
        let faces = [
            ('b', least + y, x, -y),
            ('t', least + z, x, y),
            ('w', least + y, -y, z),
            ('e', least + x, y, z),
            ('s', least, x, z),
            ('n', most - z, -x, z),
        ];
        for (_, corner, u, v) in faces.into_iter().filter(|face| !without.contains(face.0)) {
            // Grain runs along the longer side.
            let is_across = v.length() > u.length();
            let lay = Lay { along_rows: lay.along_rows != is_across, ..lay };
            self.quad(corner, u, v, finish, lay);
        }
    }

    /// A body turned about the vertical: radius and height along its outline [m], which runs
    /// upwards where the body is on the inner side. A point that is there twice is a sharp edge.
    pub fn lathe(&mut self, outline: &[(f64, f64)], chords: usize, finish: Finish, lay: Lay) {
        let rows: Vec<Vec<DVec3>> = outline
            .iter()
            .map(|&(radius, z)| {
                let at = |k: usize| {
                    let turn = core::f64::consts::TAU * (k % chords) as f64 / chords as f64;
                    let (sin, cos) = libm::sincos(turn);
                    DVec3::new(radius * cos, radius * sin, z)
                };
                (0..=chords).map(at).collect()
            })
            .collect();
        self.grid(&rows, finish, Lay { is_round: true, ..lay });
    }

    /// A rod between two points.
    pub fn rod(&mut self, from: DVec3, to: DVec3, radius: f64, finish: Finish, lay: Lay) {
        let way = (to - from).normalize_or(DVec3::Z);
        let aside = way.any_orthonormal_vector();
        let up = way.cross(aside);
        let ring = |middle: DVec3| -> Vec<DVec3> {
            (0..=8)
                .map(|k| {
                    let (sin, cos) = libm::sincos(core::f64::consts::TAU * f64::from(k % 8) / 8.0);
                    middle + (aside * cos + up * sin) * radius
                })
                .collect()
        };
        let lay = Lay { is_round: true, along_rows: true, ..lay };
        self.grid(&[ring(from), ring(to)], finish, lay);
    }
}

/// Coordinates on the plane of the world that a surface is nearest to.
fn on_plane(p: DVec3, normal: DVec3) -> DVec2 {
    let n = normal.abs();
    if n.z > n.x.max(n.y) {
        DVec2::new(p.x, p.y)
    } else if n.x > n.y {
        DVec2::new(p.y, p.z)
    } else {
        DVec2::new(p.x, p.z)
    }
}

/// Sums of `step` from 1 on, 0 first.
fn lengths(count: usize, step: impl Fn(usize) -> f64) -> Vec<f64> {
    let mut sums = vec![0.0];
    for i in 1..count {
        sums.push(sums[i - 1] + step(i));
    }
    sums
}

fn widest(rows: &[Vec<DVec3>], of: impl Fn(&Vec<DVec3>) -> f64) -> f64 {
    rows.iter().map(of).fold(0.0, f64::max)
}

fn longest(a: &[DVec3], b: &[DVec3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
}

/// The normal of a grid's point: the sum over the faces round it, weighted by their area.
fn normal(rows: &[Vec<DVec3>], i: usize, j: usize, is_round: bool) -> DVec3 {
    let (height, width) = (rows.len() as i64, rows[0].len() as i64);
    let mut sum = DVec3::ZERO;
    for (di, dj) in [(0, 0), (0, -1), (-1, 0), (-1, -1)] {
        let (low, mut left) = (i as i64 + di, j as i64 + dj);
        if is_round && left < 0 {
            left = width - 2;
        }
        if is_round && left == width - 1 {
            left = 0;
        }
        if low < 0 || left < 0 || height - 1 <= low || width - 1 <= left {
            continue;
        }
        let at = |di: i64, dj: i64| rows[(low + di) as usize][(left + dj) as usize];
        let face = (at(1, 1) - at(0, 0)).cross(at(1, 0) - at(0, 1));
        sum += if NO_AREA_M2 < face.length() { face } else { DVec3::ZERO };
    }
    sum.normalize_or(DVec3::Z)
}
