//! How balls look: colour, stripe and number.

use crate::ids::BallId;
use crate::physics::Equipment;

/// The look of a ball. Its own frame: the discs with the number are at +x and −x, the stripe runs
/// round +z, and z is up where the number stands upright.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BallLook {
    /// Colour in sRGB, 0 to 1.
    pub colour: [f32; 3],
    /// Only a band has the colour; the rest is ivory.
    pub is_striped: bool,
    /// The number in the discs; none for balls without discs.
    pub number: Option<u16>,
}

/// The balls of a game.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub enum BallSet {
    /// Solids and stripes with numbers.
    #[default]
    Pool,
    /// Fifteen reds and six colours, without numbers.
    Snooker,
    /// White, yellow and red, without numbers.
    Carom,
}

impl From<Equipment> for BallSet {
    fn from(equipment: Equipment) -> Self {
        match equipment {
            Equipment::Pool => BallSet::Pool,
            Equipment::Snooker => BallSet::Snooker,
            Equipment::Carom => BallSet::Carom,
        }
    }
}

impl BallSet {
    /// The look of one of its balls.
    pub fn look(self, ball: BallId) -> BallLook {
        match self {
            BallSet::Pool => ball_look(ball),
            BallSet::Snooker => snooker_look(ball),
            BallSet::Carom => carom_look(ball),
        }
    }
}

/// The look of a snooker ball: 1 to 15 are red; yellow, green, brown, blue, pink, black follow.
fn snooker_look(ball: BallId) -> BallLook {
    let colour = match ball.0 {
        1..=15 => [0.66, 0.03, 0.05],
        16 => [0.95, 0.78, 0.08],
        17 => [0.02, 0.38, 0.20],
        18 => [0.36, 0.17, 0.06],
        19 => [0.04, 0.20, 0.62],
        20 => [0.95, 0.50, 0.58],
        21 => [0.025, 0.025, 0.03],
        _ => IVORY,
    };
    BallLook { colour, is_striped: false, number: None }
}

/// The look of a carom ball: 1 is yellow, 2 red, the others are white.
fn carom_look(ball: BallId) -> BallLook {
    let colour = match ball.0 {
        1 => [0.96, 0.74, 0.05],
        2 => [0.72, 0.03, 0.05],
        _ => IVORY,
    };
    BallLook { colour, is_striped: false, number: None }
}

/// Ivory, in sRGB.
pub(super) const IVORY: [f32; 3] = [0.93, 0.91, 0.84];

/// The look of a pool ball; balls beyond the 15 are ivory without a number.
pub fn ball_look(ball: BallId) -> BallLook {
    let colour = match ball.0 {
        1 | 9 => [0.96, 0.74, 0.05],
        2 | 10 => [0.05, 0.16, 0.55],
        3 | 11 => [0.80, 0.08, 0.07],
        4 | 12 => [0.30, 0.11, 0.42],
        5 | 13 => [0.93, 0.38, 0.04],
        6 | 14 => [0.03, 0.36, 0.17],
        7 | 15 => [0.43, 0.07, 0.09],
        8 => [0.025, 0.025, 0.03],
        _ => IVORY,
    };
    let is_numbered = (1..=15).contains(&ball.0);
    BallLook {
        colour,
        is_striped: (9..=15).contains(&ball.0),
        number: is_numbered.then_some(ball.0),
    }
}
