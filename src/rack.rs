//! Racks: which balls stand where when a game begins.
//!
//! A rack is a recipe; [`Rack::place`] turns it into balls on a table. Racked balls stand a few
//! hundredths of a millimetre apart, each a little off its place: a perfectly tight rack neither
//! exists nor has a unique break.

mod carom;
mod next;
mod sight;
mod spots;

pub use next::{CueBallGoes, NextRack, next_rack};
pub use sight::{From, Sight};
pub use spots::{Occupied, Spots};

use crate::ball::{Ball, BallPlace, BallState, POOL_RADIUS_M, SNOOKER_RADIUS_M};
use crate::events::Zone;
use crate::ids::BallId;
use crate::table::{Bed, Table};
use glam::DVec2;
use rand::{Rng, SeedableRng, seq::SliceRandom};
use rand_pcg::Pcg64Mcg;

/// Distance that a racked ball may stand off its place [m]; gaps are 0 to four times this.
pub const JITTER_MAX_M: f64 = 0.0125e-3;

/// Why balls cannot be racked.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RackError {
    /// The table has no spots.
    #[error("table '{table}' has no bed to rack balls on; name a table preset or place each ball")]
    NoBed {
        /// Its name.
        table: String,
    },
    /// Two balls have one name.
    #[error("ball {id} is placed twice; every ball needs an id of its own")]
    Twice {
        /// The name.
        id: BallId,
    },
}

/// Which balls stand where when a game begins.
///
/// ```
/// use hapticbillard::ids::BallId;
/// use hapticbillard::rack::Rack;
/// use hapticbillard::table::Table;
///
/// let table = Table::preset("pool-9ft")?;
/// let balls = Rack::eight_ball(7).place(&table)?;
/// assert_eq!(balls.len(), 16);
/// assert_eq!(balls[0].0.id, BallId::CUE);
///
/// // One seed, one rack; another seed shuffles it otherwise.
/// assert_eq!(balls, Rack::eight_ball(7).place(&table)?);
/// assert_ne!(balls, Rack::eight_ball(8).place(&table)?);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Rack {
    layout: Layout,
}

#[derive(Debug, Clone, PartialEq)]
enum Layout {
    EightBall { seed: u64 },
    NineBall { seed: u64 },
    Snooker { seed: u64 },
    Carom { cue_ball: BallId },
    Balls(Vec<(Ball, BallState)>),
}

impl Rack {
    /// Fifteen balls in a triangle, its apex on the foot spot: the 8 in the middle of the third
    /// row, a solid and a stripe in the back corners, the rest as the seed shuffles them (WPA rule
    /// 3.2). The cue ball stands on the head spot.
    pub fn eight_ball(seed: u64) -> Rack {
        Rack { layout: Layout::EightBall { seed } }
    }

    /// Nine balls in a diamond: the 1 on the foot spot, the 9 in the middle, the rest as the seed
    /// shuffles them (WPA rule 2.2). The cue ball stands on the head spot.
    pub fn nine_ball(seed: u64) -> Rack {
        Rack { layout: Layout::NineBall { seed } }
    }

    /// Snooker: the colours on their spots, fifteen reds in a triangle whose apex stands as near
    /// behind the pink as it can (rules of the WPBSA). The cue ball stands in the D, in the
    /// middle between brown and yellow.
    pub fn snooker(seed: u64) -> Rack {
        Rack { layout: Layout::Snooker { seed } }
    }

    /// The rack that is set up in the same way for the `serial`-th time, counted from 0: each
    /// stands a little otherwise. Balls that were listed lie as they were listed.
    pub fn again(&self, serial: u32) -> Rack {
        let seed = self.seed(serial);
        let layout = match &self.layout {
            Layout::EightBall { .. } => Layout::EightBall { seed },
            Layout::NineBall { .. } => Layout::NineBall { seed },
            Layout::Snooker { .. } => Layout::Snooker { seed },
            Layout::Carom { cue_ball } => Layout::Carom { cue_ball: *cue_ball },
            Layout::Balls(balls) => Layout::Balls(balls.clone()),
        };
        Rack { layout }
    }

    /// What is left to chance when balls are racked for the `serial`-th time.
    pub fn seed(&self, serial: u32) -> u64 {
        let first = match &self.layout {
            Layout::EightBall { seed } | Layout::NineBall { seed } | Layout::Snooker { seed } => {
                *seed
            }
            Layout::Carom { .. } | Layout::Balls(_) => 0,
        };
        if serial == 0 {
            return first;
        }
        let mut random = Pcg64Mcg::seed_from_u64(first);
        random.advance(u128::from(serial));
        random.next_u64()
    }

    /// The white (0), the yellow (1) and the red (2) of carom, ready for the break of who strikes
    /// `cue_ball`: the red on the foot spot, the opponent's ball on the head spot, the own one
    /// beside it (rules of the UMB).
    pub fn carom(cue_ball: BallId) -> Rack {
        Rack { layout: Layout::Carom { cue_ball } }
    }

    /// These balls, just as they are.
    pub fn from_balls(balls: Vec<(Ball, BallState)>) -> Rack {
        Rack { layout: Layout::Balls(balls) }
    }

    /// The balls on this table, in the order of their ids.
    pub fn place(&self, table: &Table) -> Result<Vec<(Ball, BallState)>, RackError> {
        let bed = || table.bed.ok_or_else(|| RackError::NoBed { table: table.name.clone() });
        match &self.layout {
            Layout::Balls(balls) => sorted(balls.clone()),
            Layout::EightBall { seed } => {
                let (bed, mut random) = (bed()?, Pcg64Mcg::seed_from_u64(*seed));
                let order = eight_ball_order(&mut random);
                pool(&bed, &[1, 2, 3, 4, 5], order, random)
            }
            Layout::NineBall { seed } => {
                let (bed, mut random) = (bed()?, Pcg64Mcg::seed_from_u64(*seed));
                let order = nine_ball_order(&mut random);
                pool(&bed, &[1, 2, 3, 2, 1], order, random)
            }
            Layout::Snooker { seed } => snooker(&bed()?, Pcg64Mcg::seed_from_u64(*seed)),
            Layout::Carom { cue_ball } => {
                let places = carom::carom_start(&bed()?, *cue_ball);
                sorted(places.map(|(id, place)| standing(Ball::carom(id), place)).into())
            }
        }
    }
}

/// Pool balls in rows from the foot spot, and the cue ball on the head spot.
fn pool(
    bed: &Bed,
    rows: &[u16],
    order: Vec<u16>,
    mut random: Pcg64Mcg,
) -> Result<Vec<(Ball, BallState)>, RackError> {
    let mut balls = vec![standing(Ball::pool(BallId::CUE), bed.head_spot())];
    for (id, place) in order.into_iter().zip(places(rows, bed.foot_spot(), POOL_RADIUS_M)) {
        balls.push(standing(Ball::pool(BallId(id)), place + jitter(&mut random)));
    }
    sorted(balls)
}

/// Snooker's 22 balls.
fn snooker(bed: &Bed, mut random: Pcg64Mcg) -> Result<Vec<(Ball, BallState)>, RackError> {
    let mut balls = vec![standing(Ball::snooker(BallId::CUE), bed.home(Zone::D))];
    for colour in (16..=21).map(BallId) {
        balls.push(standing(Ball::snooker(colour), Spots::Snooker.of(bed, colour)));
    }
    let apex = Spots::Snooker.of(bed, BallId(20)) + DVec2::X * pitch(SNOOKER_RADIUS_M);
    for (id, place) in (1..=15).zip(places(&[1, 2, 3, 4, 5], apex, SNOOKER_RADIUS_M)) {
        balls.push(standing(Ball::snooker(BallId(id)), place + jitter(&mut random)));
    }
    sorted(balls)
}

/// A point of a square, drawn into the circle, so that no pair can come too near [m].
fn jitter(random: &mut Pcg64Mcg) -> DVec2 {
    let off = DVec2::new(unit(random), unit(random));
    off / off.length().max(1.0) * JITTER_MAX_M
}

/// A number from −1 to 1.
fn unit(random: &mut Pcg64Mcg) -> f64 {
    (random.next_u64() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

/// Ids row by row from the apex, each row from right to left.
fn eight_ball_order(random: &mut Pcg64Mcg) -> Vec<u16> {
    let mut others: Vec<u16> = (1..=15).filter(|id| *id != BallId::EIGHT.0).collect();
    others.shuffle(random);
    // The last of each group goes to a back corner; a coin decides which to which.
    let mut take = |stripe: bool| {
        let found = others.iter().rposition(|id| (*id > BallId::EIGHT.0) == stripe);
        found.map(|index| others.remove(index))
    };
    let mut corners = [take(false), take(true)];
    if random.next_u64() & 1 == 1 {
        corners.swap(0, 1);
    }
    let mut order = others;
    order.insert(4, BallId::EIGHT.0);
    if let [Some(right), Some(left)] = corners {
        order.insert(10, right);
        order.push(left);
    }
    order
}

fn nine_ball_order(random: &mut Pcg64Mcg) -> Vec<u16> {
    let mut order: Vec<u16> = (2..=8).collect();
    order.shuffle(random);
    order.insert(0, 1);
    order.insert(4, 9);
    order
}

/// Distance of racked neighbours [m]: those that both step towards each other do not overlap.
fn pitch(radius_m: f64) -> f64 {
    2.0 * (radius_m + JITTER_MAX_M) + 1e-9
}

/// Places row by row from the apex towards the foot rail.
fn places(rows: &[u16], apex: DVec2, radius_m: f64) -> impl Iterator<Item = DVec2> {
    let pitch = pitch(radius_m);
    let row_pitch = 0.75f64.sqrt() * pitch;
    rows.iter().enumerate().flat_map(move |(row, count)| {
        (0..*count).map(move |i| {
            let across = (f64::from(i) - 0.5 * f64::from(count - 1)) * pitch;
            apex + DVec2::new(row as f64 * row_pitch, across)
        })
    })
}

/// A ball at rest on the cloth.
fn standing(ball: Ball, place: DVec2) -> (Ball, BallState) {
    let state = BallState::at_rest(ball.id, place.extend(ball.radius_m));
    (ball, state)
}

fn sorted(mut balls: Vec<(Ball, BallState)>) -> Result<Vec<(Ball, BallState)>, RackError> {
    balls.sort_by_key(|(ball, _)| ball.id);
    match balls.windows(2).find(|pair| pair[0].0.id == pair[1].0.id) {
        Some(pair) => Err(RackError::Twice { id: pair[0].0.id }),
        None => Ok(balls),
    }
}

/// The first two balls that share space, and how deeply [m]. Balls that do not collide or are not
/// on the table are passed over.
pub fn overlaps(balls: &[(Ball, BallState)]) -> Option<(BallId, BallId, f64)> {
    let is_there = |(ball, state): &&(Ball, BallState)| {
        ball.flags.collide && state.place == BallPlace::OnTable
    };
    let present: Vec<_> = balls.iter().filter(is_there).collect();
    for (i, (ball, state)) in present.iter().enumerate() {
        for (other, other_state) in &present[i + 1..] {
            let reach = ball.radius_m + other.radius_m;
            let depth = reach - state.position.distance(other_state.position);
            if depth > 0.0 {
                return Some((ball.id, other.id, depth));
            }
        }
    }
    None
}

/// Where a ball of `radius` is spotted: on the foot spot, or on the long string as near behind it
/// as the occupied places allow; if there is no room, as near before it (WPA
/// rule 1.4). All in metres.
pub fn spot_position(bed: &Bed, occupied: &[Occupied], radius: f64) -> DVec2 {
    nearest_on_line(bed, bed.foot_spot(), occupied, radius)
}

/// The free place nearest behind `spot` on the line to the foot rail, or else nearest before it;
/// the spot itself if it is free, or if the whole line is full. All in metres.
fn nearest_on_line(bed: &Bed, spot: DVec2, occupied: &[Occupied], radius: f64) -> DVec2 {
    // A spotted ball stands as close as can be without touching.
    let gap = 1e-6;
    let is_free = |x: f64| {
        let here = DVec2::new(x, spot.y);
        bed.holds(here, radius)
            && occupied.iter().all(|(_, place, other)| place.distance(here) > radius + other)
    };
    // The nearest free place is the spot itself or touches one of the balls.
    let mut candidates = vec![spot.x];
    for (_, place, other) in occupied {
        let reach = radius + other + gap;
        let off = place.y - spot.y;
        let half = (reach * reach - off * off).max(0.0).sqrt();
        candidates.extend([place.x - half, place.x + half]);
    }
    let free: Vec<f64> = candidates.into_iter().filter(|x| is_free(*x)).collect();
    let behind = free.iter().copied().filter(|x| spot.x <= *x).min_by(f64::total_cmp);
    let before = free.iter().copied().filter(|x| *x < spot.x).max_by(f64::total_cmp);
    DVec2::new(behind.or(before).unwrap_or(spot.x), spot.y)
}
