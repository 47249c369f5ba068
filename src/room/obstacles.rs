//! What a camera and a ball cannot go through: boxes round the furniture, and the cellar itself.

use super::shell::{PANEL_DEPTH_M, RIB_DEPTH_M, vault};
use super::{EAST_M, RIBS_M, Room, WEST_M, WIDE_M};
use crate::mesh::{Face, Mesh, Surface};
use glam::DVec3;

/// A box that nothing goes through [m].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Obstacle {
    /// Its least corner.
    pub least: DVec3,
    /// Its greatest corner.
    pub most: DVec3,
}

impl Obstacle {
    /// The shortest way out for a sphere that is in it, into a place that is `free`; zero outside.
    fn way_out(&self, point: DVec3, radius: f64, free: impl Fn(DVec3) -> bool) -> DVec3 {
        let nearest = point.clamp(self.least, self.most);
        let away = point - nearest;
        let distance = away.length();
        if radius <= distance {
            return DVec3::ZERO;
        }
        if 0.0 < distance {
            return away * ((radius - distance) / distance);
        }
        // Its middle is inside: out through the nearest side, never down into the floor.
        let sides = [
            (point.x - self.least.x, DVec3::NEG_X),
            (self.most.x - point.x, DVec3::X),
            (point.y - self.least.y, DVec3::NEG_Y),
            (self.most.y - point.y, DVec3::Y),
            (self.most.z - point.z, DVec3::Z),
        ];
        let (depth, way) = sides
            .into_iter()
            .filter(|(depth, way)| free(point + *way * (depth + radius)))
            .reduce(|best, side| if side.0 < best.0 { side } else { best })
            .unwrap_or((0.0, DVec3::Z));
        way * (depth + radius)
    }
}

impl Room {
    /// How far a sphere must be moved so that it lies within the cellar and outside of furniture
    /// [m]; zero where it may be. The table is not part of it.
    pub fn outside(&self, point: DVec3, radius: f64) -> DVec3 {
        let mut at = self.within(point, radius);
        // Out of one thing may be into the next; what is still stuck then stays where it was led.
        for _ in 0..4 {
            let before = at;
            for obstacle in &self.obstacles {
                let free = |place: DVec3| self.within(place, radius).distance(place) < 1e-9;
                at += obstacle.way_out(at, radius, free);
            }
            at = self.within(at, radius);
            if at == before {
                break;
            }
        }
        at - point
    }

    /// The nearest place between walls, floor and vault; pilasters are walls everywhere.
    fn within(&self, point: DVec3, radius: f64) -> DVec3 {
        let side = WIDE_M - RIB_DEPTH_M - 0.04 - radius;
        let x = point.x.clamp(WEST_M + 0.1 + radius, EAST_M - 0.02 - radius);
        let y = point.y.clamp(-side, side);
        let top = vault(y, RIB_DEPTH_M + radius) + self.floor_m;
        let z = point.z.clamp(self.floor_m + radius, top.max(self.floor_m + radius));
        DVec3::new(x, y, z)
    }

    /// A coarse body for balls that leave the table: walls, vault, furniture; faces look into the
    /// room. The floor is the table's own.
    pub fn collision(&self) -> Mesh {
        let mut mesh = Mesh::default();
        let at = |x: f64, y: f64, z: f64| DVec3::new(x, y, z + self.floor_m);
        let side = WIDE_M - PANEL_DEPTH_M;
        let outline: Vec<(f64, f64)> = core::iter::once((-side, 0.0))
            .chain((0..=8).map(|k| {
                let y = side * (f64::from(k) / 4.0 - 1.0);
                (y, vault(y, 0.0))
            }))
            .chain([(side, 0.0)])
            .collect();
        for pair in outline.windows(2) {
            let [(y, z), (v, w)] = [pair[0], pair[1]];
            let corners = [at(WEST_M, y, z), at(EAST_M, y, z), at(EAST_M, v, w), at(WEST_M, v, w)];
            // Seen from inside they run the other way round.
            let [a, b, c, d] = corners;
            face(&mut mesh, [d, c, b, a], Surface::Obstacle);
            for (x, is_west) in [(WEST_M, true), (EAST_M, false)] {
                let [low, high] = [at(x, y, 0.0), at(x, v, 0.0)];
                let corners = [low, high, at(x, v, w), at(x, y, z)];
                let [a, b, c, d] = corners;
                if (y - v).abs() > 1e-9 {
                    let turned = if is_west { corners } else { [d, c, b, a] };
                    face(&mut mesh, turned, Surface::Obstacle);
                }
            }
        }
        let pilasters = RIBS_M.iter().flat_map(|&x| {
            [-1.0, 1.0].map(|sign| {
                let (a, c) = (sign * (WIDE_M - RIB_DEPTH_M), sign * side);
                Obstacle {
                    least: at(x - 0.18, a.min(c), 0.0),
                    most: at(x + 0.18, a.max(c), vault(WIDE_M - RIB_DEPTH_M, 0.0)),
                }
            })
        });
        for obstacle in self.obstacles.iter().copied().chain(pilasters) {
            solid(&mut mesh, &obstacle);
        }
        mesh
    }
}

fn face(mesh: &mut Mesh, corners: [DVec3; 4], surface: Surface) {
    let first = mesh.vertices.len() as u32;
    mesh.vertices.extend(corners);
    for corners in [[first, first + 1, first + 2], [first, first + 2, first + 3]] {
        mesh.faces.push(Face { corners, surface });
    }
}

/// The sides and the top of a box; it stands on something.
fn solid(mesh: &mut Mesh, obstacle: &Obstacle) {
    let Obstacle { least: a, most: c } = *obstacle;
    let corner = |x: f64, y: f64| [DVec3::new(x, y, a.z), DVec3::new(x, y, c.z)];
    let ring = [corner(a.x, a.y), corner(c.x, a.y), corner(c.x, c.y), corner(a.x, c.y)];
    for k in 0..4 {
        let (this, next) = (ring[k], ring[(k + 1) % 4]);
        face(mesh, [this[0], next[0], next[1], this[1]], Surface::Obstacle);
    }
    face(mesh, ring.map(|pair| pair[1]), Surface::Obstacle);
}
