//! Grain: what a surface looks like from near, as tiles that repeat.
//!
//! Each tile multiplies a colour and is 1 on average, so that light baked from the colour alone is
//! the light of what is seen.

use crate::noise::{between, lattice};

/// A pattern that repeats every [`Grain::tile_m`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Grain {
    /// Nothing: metal, glass, paint.
    Plain,
    /// Bricks with mortar, four by thirteen.
    Brick,
    /// Floor boards along u.
    Boards,
    /// Wood along u.
    Wood,
    /// Narrow panels along v.
    Panels,
    /// Plaster, slate, cork: clouds and crumbs.
    Plaster,
    /// Leather: small cells.
    Leather,
    /// Dressed stone.
    Stone,
}

/// Side of a tile [pixels].
pub const TILE_SIDE: u32 = 256;

impl Grain {
    /// All, in the order of their layers.
    pub const ALL: [Grain; 8] = [
        Grain::Plain,
        Grain::Brick,
        Grain::Boards,
        Grain::Wood,
        Grain::Panels,
        Grain::Plaster,
        Grain::Leather,
        Grain::Stone,
    ];

    /// Its layer in a stack of tiles.
    pub fn layer(self) -> usize {
        Grain::ALL.iter().position(|other| *other == self).unwrap_or_default()
    }

    /// Width and height of its tile [m].
    pub fn tile_m(self) -> [f64; 2] {
        match self {
            Grain::Plain => [1.0, 1.0],
            Grain::Brick => [1.0, 0.975],
            Grain::Boards => [2.24, 1.12],
            Grain::Wood => [1.2, 0.4],
            Grain::Panels => [0.88, 1.2],
            Grain::Plaster => [1.0, 1.0],
            Grain::Leather => [0.25, 0.25],
            Grain::Stone => [1.1, 1.1],
        }
    }

    /// Its tile, rows from v = 0, red, green and blue, 128 is 1; nothing is brighter than 2.
    pub fn tile(self) -> Vec<[u8; 3]> {
        let side = f64::from(TILE_SIDE);
        let mut tones: Vec<[f64; 3]> = (0..TILE_SIDE * TILE_SIDE)
            .map(|i| {
                let (x, y) = (f64::from(i % TILE_SIDE) + 0.5, f64::from(i / TILE_SIDE) + 0.5);
                self.tone(x / side, y / side)
            })
            .collect();
        for channel in 0..3 {
            let mean = tones.iter().map(|tone| tone[channel]).sum::<f64>() / tones.len() as f64;
            tones.iter_mut().for_each(|tone| tone[channel] /= mean);
        }
        tones.iter().map(|tone| tone.map(|x| (x * 128.0).clamp(0.0, 255.0) as u8)).collect()
    }

    /// What the colour is multiplied with at a place of the tile, from 0 to 1 both ways; its mean
    /// is not 1 yet.
    fn tone(self, u: f64, v: f64) -> [f64; 3] {
        match self {
            Grain::Plain => [1.0; 3],
            Grain::Brick => brick(u, v),
            Grain::Boards => boards(u, v),
            Grain::Wood => [wood(u, v, 0.0, 1.0); 3],
            Grain::Panels => panels(u, v),
            Grain::Plaster => {
                let clouds = noise(u, v, 4) + 0.5 * noise(u, v, 11) + 0.35 * noise(u, v, 47);
                [0.70 + 0.28 * clouds + 0.12 * noise(u, v, 128); 3]
            }
            Grain::Leather => {
                let cells = (noise(u, v, 21) - 0.5).abs() * 2.0;
                [0.72 + 0.4 * smooth(0.0, 0.3, cells) + 0.2 * noise(u, v, 5); 3]
            }
            Grain::Stone => {
                let crumbs = 0.4 * noise(u, v, 90) + 0.4 * noise(u, v, 31) + noise(u, v, 6);
                let x = 0.62 + 0.42 * crumbs;
                [x, x * (0.98 + 0.04 * noise(u, v, 3)), x * (0.94 + 0.1 * noise(u, v, 5))]
            }
        }
    }
}

fn brick(u: f64, v: f64) -> [f64; 3] {
    let (across, courses) = (4.0, 13.0);
    let y = v * courses;
    let course = y.floor();
    let x = u * across + if course as i64 % 2 == 0 { 0.0 } else { 0.5 };
    let column = x.floor() as i64 % 4;
    // Distances to the edges [m], waved a little: old bricks.
    let wave = 0.004 * (noise(u, v, 40) - 0.5) + 0.003 * (noise(u, v, 97) - 0.5);
    let (fx, fy) = (x - x.floor(), y - course);
    let edge = (fx.min(1.0 - fx) * 0.25).min(fy.min(1.0 - fy) * 0.075) + wave;
    let is_brick = smooth(0.003, 0.0065, edge);
    let own = |salt: i64| lattice(column, course as i64 + salt * 100);
    let crumbs = 0.5 * noise(u, v, 128) + 0.5 * noise(u, v, 53);
    let tone = (0.62 + 0.62 * own(1)) * (0.78 + 0.44 * crumbs);
    // Some are burnt darker, some yellower.
    let warm = 0.85 + 0.3 * own(2);
    let body = [tone, tone * warm, tone * warm * (0.9 + 0.2 * own(3))];
    let mortar = 0.85 + 0.4 * noise(u, v, 110);
    let joint = [mortar * 0.95, mortar * 1.7, mortar * 2.0];
    core::array::from_fn(|k| joint[k] + (body[k] - joint[k]) * is_brick)
}

/// Light and dark years and pores of wood along u; `salt` chooses the tree.
fn wood(u: f64, v: f64, salt: f64, per_tile: f64) -> f64 {
    let bend = 0.22 * noise(u + salt, v + salt, 3) + 0.05 * noise(u + salt, v, 9);
    let year = (7.0 * per_tile * (v + bend)).rem_euclid(1.0);
    let rings = (1.0 - year * year) * (year * 10.0).min(1.0);
    let pores = noise_of(u * 10.0, v * 190.0, (10, 190));
    let tone = noise_of(u * 3.0 + salt, v * 8.0, (3, 8));
    0.55 + 0.35 * rings + 0.30 * pores + 0.28 * tone
}

fn boards(u: f64, v: f64) -> [f64; 3] {
    let y = v * 8.0;
    let board = y.floor() as i64;
    // Each board has its own tree, its own colour, and ends somewhere else.
    let own = |salt: i64| lattice(board, salt);
    let end = (u + own(4)).rem_euclid(1.0);
    let half = if end < 0.5 { 0 } else { 7 };
    let fy = y - y.floor();
    let to_joint =
        (fy.min(1.0 - fy) * 0.14).min((end.min(1.0 - end)).min((end - 0.5).abs()) * 2.24);
    let joint = smooth(0.0006, 0.0045, to_joint);
    let tint = 0.70 + 0.62 * lattice(board, 20 + half);
    let grain = wood(u, v * 1.9, own(6) * 5.0 + half as f64, 2.0);
    let worn = 0.86 + 0.28 * noise(u, v, 7);
    let x = grain * tint * worn * (0.22 + 0.78 * joint);
    [x, x * (0.94 + 0.12 * own(8)), x * (0.88 + 0.22 * own(8))]
}

fn panels(u: f64, v: f64) -> [f64; 3] {
    let x = u * 8.0;
    let panel = x.floor() as i64;
    let fx = x - x.floor();
    let groove = smooth(0.0, 0.05, fx.min(1.0 - fx));
    let bead = 1.0 + 0.35 * smooth(0.10, 0.06, fx) * smooth(0.03, 0.055, fx);
    let own = lattice(panel, 3);
    let tone = wood(v, u, own * 9.0, 3.0) * (0.85 + 0.3 * own);
    [tone * bead * (0.25 + 0.75 * groove); 3]
}

fn smooth(from: f64, to: f64, x: f64) -> f64 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Smooth noise of so many cells a tile.
fn noise(u: f64, v: f64, cells: i64) -> f64 {
    noise_of(u * cells as f64, v * cells as f64, (cells, cells))
}

/// Smooth noise that repeats after these numbers of cells.
fn noise_of(x: f64, y: f64, (across, up): (i64, i64)) -> f64 {
    between(x, y, |i, j| lattice(i.rem_euclid(across) + 7 * across, j.rem_euclid(up)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_are_one_on_average_and_go_on_at_their_edges() {
        for grain in Grain::ALL {
            let tile = grain.tile();
            let side = TILE_SIDE as usize;
            for channel in 0..3 {
                let sum: f64 = tile.iter().map(|t| f64::from(t[channel]) + 0.5).sum();
                let mean = sum / tile.len() as f64 / 128.0;
                assert!((mean - 1.0).abs() < 0.02, "{grain:?}: {mean}");
            }
            // Neighbours across an edge differ no more than neighbours inside do.
            let step = |a: usize, b: usize| (f64::from(tile[a][0]) - f64::from(tile[b][0])).abs();
            let mean = |of: &dyn Fn(usize) -> f64| (0..side).map(of).sum::<f64>() / side as f64;
            let inner =
                mean(&|k| (1..side).map(|i| step(i * side + k, (i - 1) * side + k)).sum::<f64>())
                    / (side - 1) as f64;
            let seam = mean(&|k| step(k, (side - 1) * side + k));
            assert!(seam <= 4.0 * inner + 6.0, "{grain:?} up: {seam} {inner}");
            let seam = mean(&|k| step(k * side, k * side + side - 1));
            let inner =
                mean(&|k| (1..side).map(|i| step(k * side + i, k * side + i - 1)).sum::<f64>())
                    / (side - 1) as f64;
            assert!(seam <= 4.0 * inner + 6.0, "{grain:?} along: {seam} {inner}");
        }
    }
}
