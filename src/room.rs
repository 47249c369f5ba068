//! The room round a table: a vaulted cellar with a bar, furniture and the lamp (paper, section
//! 4.1.3), all generated, and the light in it, baked.
//!
//! The frame is the table's: the middle of the bed is the origin, x runs along it, z up, the floor
//! lies as far below as the table is high. The room is the same for every table; what the table
//! throws back and what it shades is not, so each table has a light map of its own.
//!
//! [`Room::around`] makes the triangles, [`Baker`] computes the light that falls on them,
//! [`LightMap`] keeps it. Nothing here is kept by a scene: without a picture there is no room.

mod bake;

mod bar;

mod builder;

mod bvh;

mod chart;

mod finish;

mod furniture;

mod grain;

mod lamp;

mod light_map;

mod obstacles;

mod shell;

mod table_light;

mod texels;

pub use bake::{Baker, Pass};
pub use builder::{Group, Vertex};
pub use chart::Chart;
pub use finish::Finish;
pub use grain::{Grain, TILE_SIDE};
pub use lamp::{LAMP_HEIGHT_M, LAMP_PITCH_M, lamp_opacity};
pub use light_map::{BakedFor, LIGHT_MOST, LightMap, LightMapError};
pub use obstacles::Obstacle;

use crate::hash::{Digest, StateHash};
use crate::table::Table;
use builder::Builder;
use glam::{DVec2, DVec3};
use table_light::{FromAbove, TableLight};

/// Where the walls are [m]: behind the head of the table, behind its foot, and beside it.
pub const WEST_M: f64 = -4.4;
/// See [`WEST_M`].
pub const EAST_M: f64 = 5.2;
/// See [`WEST_M`].
pub const WIDE_M: f64 = 3.6;
/// Where the vault begins, and its highest line, above the floor [m].
const SPRING_M: f64 = 2.2;
/// See [`SPRING_M`].
const CROWN_M: f64 = 3.05;
/// Where ribs carry the vault [m].
const RIBS_M: [f64; 3] = [-2.0, 0.4, 2.8];

/// Width of a light map [texels].
pub const LIGHT_WIDTH: u32 = 512;
/// Side of the picture of the room that mirrors see [texels].
const MIRROR_SIDE: u32 = 48;
/// Changes whenever light is computed in another way, so that old light is not taken for new.
const RECIPE: u64 = 1;

/// Triangles that light each other.
#[derive(Debug, Clone, Default)]
pub struct Surfaces {
    /// Corners of the triangles; their places in the light map are texels of the whole map.
    pub vertices: Vec<Vertex>,
    /// Triangles as triples of vertices, anticlockwise seen from the room, with their groups.
    pub triangles: Vec<([u32; 3], Group)>,
    /// What vertices are made of.
    pub finishes: Vec<Finish>,
    /// Rectangles of the light map.
    pub charts: Vec<Chart>,
    /// Width and height of the light map [texels].
    pub size: [u32; 2],
}

impl Surfaces {
    /// Parallelograms, each by a corner, two edges and what it is made of; it faces along the cross
    /// product of the edges.
    pub fn of_quads(quads: &[([DVec3; 3], Finish)], per_m: f64) -> Self {
        let mut b = Builder::default();
        for ([corner, u, v], finish) in quads {
            b.quad(*corner, *u, *v, *finish, builder::Lay::of(per_m));
        }
        Surfaces::of(b)
    }

    fn of(mut b: Builder) -> Self {
        let rows = chart::pack(&mut b.charts, LIGHT_WIDTH);
        for vertex in &mut b.vertices {
            let chart = &b.charts[usize::from(vertex.chart)];
            // The middle of the first texel.
            vertex.light += DVec2::new(f64::from(chart.x) + 0.5, f64::from(chart.y) + 0.5);
        }
        Surfaces {
            vertices: b.vertices,
            triangles: b.triangles,
            finishes: b.finishes,
            charts: b.charts,
            size: [LIGHT_WIDTH, rows.next_multiple_of(8)],
        }
    }

    /// What a vertex is made of.
    pub fn finish_of(&self, vertex: &Vertex) -> &Finish {
        &self.finishes[usize::from(vertex.finish)]
    }
}

/// A room round a table.
#[derive(Debug, Clone)]
pub struct Room {
    /// Its triangles, and those of the table.
    pub surfaces: Surfaces,
    /// The floor below the cloth [m], negative.
    pub floor_m: f64,
    /// Half the outer size of the table [m].
    pub outer: DVec2,
    /// Boxes round the furniture.
    pub obstacles: Vec<Obstacle>,
    table: TableLight,
    mirror: u16,
}

impl Room {
    /// The room of a billiard table; none round anything else.
    pub fn around(table: &Table) -> Option<Room> {
        let parameters = table.parameters.as_ref()?;
        let floor_m = -parameters.bed_height_m;
        let mut b = Builder::default();
        b.begin(Group::Standing);
        bar::build(&mut b, floor_m);
        furniture::build(&mut b, floor_m);
        lamp::build(&mut b, CROWN_M + floor_m);
        let table_light = table_light::build(&mut b, parameters, &table.display());
        // Walls last: they are drawn in this order, and everything else hides them.
        shell::build(&mut b, floor_m);
        let mirror = b.chart(MIRROR_SIDE, MIRROR_SIDE);
        Some(Room {
            surfaces: Surfaces::of(b),
            floor_m,
            outer: DVec2::new(parameters.outer_x_m(), parameters.outer_y_m()),
            obstacles: obstacles(table),
            table: table_light,
            mirror,
        })
    }

    /// Where the vault is highest, above the cloth [m]: from above it nothing hides the table.
    pub fn crown_m(&self) -> f64 {
        CROWN_M + self.floor_m
    }

    /// Where the light of the bed is in the map: offset and factor that make shares of its width
    /// and height of x and y [m].
    pub fn bed_light(&self) -> [DVec2; 2] {
        self.seen_from_above(&self.table.bed)
    }

    /// The same for rails, cushions, castings and sights.
    pub fn rail_light(&self) -> [DVec2; 2] {
        self.seen_from_above(&self.table.rails)
    }

    fn seen_from_above(&self, place: &FromAbove) -> [DVec2; 2] {
        let chart = &self.surfaces.charts[usize::from(place.chart)];
        [(corner(chart) + place.middle) / self.size(), place.scale / self.size()]
    }

    /// The light on the sides of the rails, on average, in a map.
    pub fn side_light(&self, map: &LightMap) -> [f32; 3] {
        let charts = self.table.sides.iter().map(|side| &self.surfaces.charts[usize::from(*side)]);
        let (mut sum, mut count) = ([0.0; 3], 0.0);
        for chart in charts {
            // The upper rows lie under the rail; the middle one is lit as the rail is.
            let y = chart.y + chart.rows / 2;
            for x in chart.x..chart.x + chart.columns {
                let light = map.light(x, y);
                sum = core::array::from_fn(|k| sum[k] + light[k]);
                count += 1.0;
            }
        }
        sum.map(|x| x / f32::max(count, 1.0))
    }

    /// Where in the map the picture of the room is that mirrors over the table see: an octahedron
    /// unfolded, by its middle and half side as shares of width and height.
    pub fn mirror(&self) -> [DVec2; 2] {
        let half = 0.5 * f64::from(MIRROR_SIDE - 1);
        [(corner(self.mirror_chart()) + half) / self.size(), half / self.size()]
    }

    fn mirror_chart(&self) -> &Chart {
        &self.surfaces.charts[usize::from(self.mirror)]
    }

    /// Size of the light map [texels].
    fn size(&self) -> DVec2 {
        DVec2::from(self.surfaces.size.map(f64::from))
    }

    /// What light belongs to: everything that it depends on but how often it was asked.
    pub fn digest(&self) -> Digest {
        let mut hash = StateHash::new();
        hash.u64(RECIPE);
        hash.u64(u64::from(self.surfaces.size[1]));
        for vertex in &self.surfaces.vertices {
            // In hundredths of a millimetre and of a texel: no rounding of a machine shows.
            let whole = |p: DVec3| (p * 1e5).round().to_array().map(|x| x as i64 as u64);
            whole(vertex.position).into_iter().for_each(|x| hash.u64(x));
            whole(vertex.normal * 0.01).into_iter().for_each(|x| hash.u64(x));
            whole(vertex.light.extend(0.0) * 0.001).into_iter().for_each(|x| hash.u64(x));
            let finish = self.surfaces.finish_of(vertex);
            for channel in finish.colour.into_iter().chain(finish.emission) {
                hash.u64(u64::from(channel.to_bits()));
            }
        }
        for (corners, group) in &self.surfaces.triangles {
            corners.iter().for_each(|corner| hash.u64(u64::from(*corner)));
            hash.u64(*group as u64);
        }
        hash.finish()
    }
}

/// Boxes round the furniture in the room of a table; none where there is no room. It takes no room
/// to know them.
pub fn obstacles(table: &Table) -> Vec<Obstacle> {
    let Some(parameters) = &table.parameters else { return Vec::new() };
    let floor = DVec3::new(0.0, 0.0, -parameters.bed_height_m);
    let standing = bar::obstacles().into_iter().chain(furniture::obstacles());
    standing.map(|one| Obstacle { least: one.least + floor, most: one.most + floor }).collect()
}

/// The middle of a chart's first texel [texels].
fn corner(chart: &Chart) -> DVec2 {
    DVec2::new(f64::from(chart.x) + 0.5, f64::from(chart.y) + 0.5)
}
