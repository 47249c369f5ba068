//! The paper's computer player, without physics: its table is made of positions.

mod plan;
mod player;
mod stroke;

use glam::DVec2;
use hapticbillard::ai::{SeenBall, TableView2d};
use hapticbillard::ball::POOL_RADIUS_M;
use hapticbillard::ids::{BallId, PocketId};
use hapticbillard::table::{Bed, Pocket};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

pub const R: f64 = POOL_RADIUS_M;
pub const BED: Bed = Bed { length_m: 2.54, width_m: 1.27 };

/// Six pockets with mouths of 116 and 128 mm.
pub fn pockets() -> Vec<Pocket> {
    let (x, y) = (0.5 * BED.length_m, 0.5 * BED.width_m);
    let corner = |id, sx: f64, sy: f64| {
        let cut = 0.116 / 2.0_f64.sqrt();
        Pocket {
            id,
            mouth: [DVec2::new(sx * (x - cut), sy * y), DVec2::new(sx * x, sy * (y - cut))],
            centre: DVec2::new(sx * (x + 0.02), sy * (y + 0.02)),
            radius_m: 0.06,
            heading: DVec2::new(sx, sy).normalize(),
        }
    };
    let side = |id, sy: f64| Pocket {
        id,
        mouth: [DVec2::new(-0.064, sy * y), DVec2::new(0.064, sy * y)],
        centre: DVec2::new(0.0, sy * (y + 0.045)),
        radius_m: 0.06,
        heading: DVec2::new(0.0, sy),
    };
    vec![
        corner(PocketId::Hl, -1.0, 1.0),
        corner(PocketId::Hr, -1.0, -1.0),
        side(PocketId::Ml, 1.0),
        side(PocketId::Mr, -1.0),
        corner(PocketId::Fl, 1.0, 1.0),
        corner(PocketId::Fr, 1.0, -1.0),
    ]
}

/// A table seen from above.
pub fn view(cue_ball: DVec2, balls: &[(u16, DVec2)]) -> TableView2d {
    TableView2d {
        cue_ball: Some(cue_ball),
        balls: balls.iter().map(|(id, p)| SeenBall { id: BallId(*id), position: *p }).collect(),
        ball_radius_m: R,
        bed: BED,
        pockets: pockets(),
    }
}

/// A random table with `count` object balls, none of which touches another.
pub fn random_view(seed: u64, count: u16) -> TableView2d {
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    let mut table = view(DVec2::ZERO, &[]);
    let half = 0.5 * DVec2::new(BED.length_m, BED.width_m) - DVec2::splat(R + 0.002);
    let mut free_spot = |table: &TableView2d| loop {
        let spot = DVec2::new(rng.random_range(-half.x..half.x), rng.random_range(-half.y..half.y));
        if table.has_room(spot) {
            return spot;
        }
    };
    for id in 1..=count {
        let position = free_spot(&table);
        table.balls.push(SeenBall { id: BallId(id), position });
    }
    table.cue_ball = Some(free_spot(&table));
    table
}
