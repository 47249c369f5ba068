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
    /// There are discs at ±y and ±z too, so that one is seen however the ball lies.
    pub has_six: bool,
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

    /// The look of one of its balls for somebody who does not tell colours apart: other colours,
    /// each of another brightness where that can be, and a number that is seen from everywhere.
    /// What has no number has its points, or in carom 1 for the yellow ball and 2 for the red one.
    pub fn marked_look(self, ball: BallId) -> BallLook {
        let usual = self.look(ball);
        let number = match (self, ball.0) {
            (BallSet::Pool, _) => usual.number,
            (BallSet::Snooker, 1..=15) => Some(1),
            (BallSet::Snooker, 16..=21) => Some(ball.0 - 14),
            (BallSet::Carom, 1 | 2) => Some(ball.0),
            _ => None,
        };
        let colour = match (self, ball.0) {
            // After Okabe and Ito (2008), Color Universal Design; for pool in the order of the
            // usual colours.
            (BallSet::Pool, 1 | 9) => [0.94, 0.89, 0.26],
            (BallSet::Pool, 2 | 10) => [0.0, 0.45, 0.70],
            (BallSet::Pool, 3 | 11) => [0.84, 0.37, 0.0],
            (BallSet::Pool, 4 | 12) => [0.80, 0.47, 0.65],
            (BallSet::Pool, 5 | 13) => [0.90, 0.62, 0.0],
            (BallSet::Pool, 6 | 14) => [0.0, 0.62, 0.45],
            (BallSet::Pool, 7 | 15) => [0.34, 0.71, 0.91],
            _ => usual.colour,
        };
        BallLook { colour, number, has_six: number.is_some(), ..usual }
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
    BallLook { colour, is_striped: false, number: None, has_six: false }
}

/// The look of a carom ball: 1 is yellow, 2 red, the others are white.
fn carom_look(ball: BallId) -> BallLook {
    let colour = match ball.0 {
        1 => [0.96, 0.74, 0.05],
        2 => [0.72, 0.03, 0.05],
        _ => IVORY,
    };
    BallLook { colour, is_striped: false, number: None, has_six: false }
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
        has_six: false,
    }
}
