//! The paper's computer player, without physics: its table is made of positions.

mod adviser;
mod blind;
mod ideas;
mod learn;
mod mind;
mod plan;
mod player;
mod searching;
mod stroke;

use glam::DVec2;
use hapticbillard::ai::{Clearance, SeenBall, TableView2d};
use hapticbillard::ball::POOL_RADIUS_M;
use hapticbillard::cue::Aim;
use hapticbillard::ids::BallId;
use hapticbillard::table::{Bed, Pocket, Table};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::sync::{Arc, OnceLock};

pub const R: f64 = POOL_RADIUS_M;
pub const BED: Bed = Bed { length_m: 2.54, width_m: 1.27 };

/// The table that is played on.
pub fn table() -> &'static Table {
    static TABLE: OnceLock<Table> = OnceLock::new();
    TABLE.get_or_init(|| Table::preset("pool-9ft").expect("a shipped table"))
}

pub fn pockets() -> Vec<Pocket> {
    table().pockets.clone()
}

/// How steep the cue must be to clear the rails.
pub fn clearance() -> Clearance {
    Arc::new(|cue_ball, azimuth_rad| {
        table().clearance_elevation(cue_ball, &Aim { azimuth_rad, ..Aim::default() })
    })
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
