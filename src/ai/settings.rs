//! What distinguishes one computer player from another: how far it looks, how steady its arm is,
//! how long it thinks.
//!
//! A level is a head: what a player considers and how far it looks. The arm is the noise of its
//! strokes, and by itself every level has the same one, so that two levels can be compared. A
//! strength between 0 and 100 moves all of it together:
//!
//! | strength | level | noise | simulations for a decision |
//! |---:|---|---:|---:|
//! | 0 | paper | 6.00 | – |
//! | 15 | paper | 4.59 | – |
//! | 30 | club | 3.51 | 30 |
//! | 50 | club | 2.45 | 200 |
//! | 70 | champion | 1.71 | 300 |
//! | 85 | champion | 1.31 | 1095 |
//! | 100 | champion | 1.00 | 4000 |
//!
//! The noise is in multiples of the Computer Pool Olympiad's, whose azimuth errs by 0.125°; between
//! the rows it falls, and the budget of a level rises, by the same factor for every point.

use super::noise::StrokeNoise;
use crate::physics::Profile;
use crate::scene::STRENGTH_MAX;

/// Noise of a player's strokes if nothing else is said, in multiples of the Olympiad's.
pub const NOISE_USUAL: f64 = 1.0;
/// That of strength 0: its azimuth errs by 0.75°, its speed by 0.45 m/s.
const NOISE_MAX: f64 = 6.0;
/// From this strength on a computer plays as the club's.
const CLUB_FROM: u8 = 30;
/// From this strength on as the champion.
const CHAMPION_FROM: u8 = 70;
/// Shots that the club's player simulates for a decision, at its weakest and at most.
const CLUB_SIMULATIONS: [f64; 2] = [30.0, 200.0];
/// The strength from which on it does the most.
const CLUB_USUAL: u8 = 50;
/// Shots that the champion simulates for a decision, at its weakest and at its strongest.
const CHAMPION_SIMULATIONS: [f64; 2] = [300.0, 4000.0];

/// How well a computer plays.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// As the paper's: geometry from above, no look into the future.
    #[default]
    Paper,
    /// Geometry proposes and aims, simulations of the best pots under its own noise decide.
    Club,
    /// Every kind of shot, aimed and chosen by simulation under its own noise; looks at the shot
    /// after.
    Champion,
}

impl Level {
    /// Whether it tries shots on a table of its own.
    pub fn simulates(self) -> bool {
        match self {
            Level::Paper => false,
            Level::Club | Level::Champion => true,
        }
    }

    /// The level of a computer's strength.
    fn of_strength(strength: u8) -> Self {
        match strength {
            0..CLUB_FROM => Level::Paper,
            CLUB_FROM..CHAMPION_FROM => Level::Club,
            CHAMPION_FROM.. => Level::Champion,
        }
    }
}

/// What distinguishes one computer player from another.
#[derive(Debug, Clone, PartialEq)]
pub struct PlayerSettings {
    /// How well it plays.
    pub level: Level,
    /// Seed of everything it leaves to chance.
    pub seed: u64,
    /// Throw compensation f: a cut β is aimed as (1 + f) β (paper, section 5.4.2).
    pub throw_factor: f64,
    /// Error of its strokes, as a multiple of the Computer Pool Olympiad's; 0 is a perfect arm.
    pub noise: f64,
    /// Shots that it may simulate for a decision; 0 for a level that does not.
    pub simulations: u32,
}

impl PlayerSettings {
    /// The paper's player with a perfect arm, and with the throw compensation that fits a profile's
    /// contact laws.
    pub fn paper(seed: u64, profile: Profile) -> Self {
        let throw_factor = throw_factor(profile);
        PlayerSettings { level: Level::Paper, seed, throw_factor, noise: 0.0, simulations: 0 }
    }

    /// The player of a level, with the usual arm and the level's usual budget.
    pub fn of_level(level: Level, seed: u64, profile: Profile) -> Self {
        let simulations = match level {
            Level::Paper => 0,
            Level::Club => simulations(level, CLUB_USUAL),
            Level::Champion => simulations(level, STRENGTH_MAX),
        };
        PlayerSettings { level, noise: NOISE_USUAL, simulations, ..Self::paper(seed, profile) }
    }

    /// A player of a strength from 0, a beginner with a shaky arm, to 100, the champion. What is
    /// more counts as 100.
    pub fn of_strength(strength: u8, seed: u64, profile: Profile) -> Self {
        let strength = strength.min(STRENGTH_MAX);
        let level = Level::of_strength(strength);
        let share = f64::from(strength) / f64::from(STRENGTH_MAX);
        let noise = between([NOISE_MAX, NOISE_USUAL], share);
        let simulations = simulations(level, strength);
        PlayerSettings { level, noise, simulations, ..Self::paper(seed, profile) }
    }

    /// How its strokes err.
    pub fn stroke_noise(&self) -> StrokeNoise {
        StrokeNoise::olympiad(self.noise)
    }
}

/// Shots that a player of a level simulates at a strength.
fn simulations(level: Level, strength: u8) -> u32 {
    let (bounds, from, to) = match level {
        Level::Paper => return 0,
        Level::Club => (CLUB_SIMULATIONS, CLUB_FROM, CLUB_USUAL),
        Level::Champion => (CHAMPION_SIMULATIONS, CHAMPION_FROM, STRENGTH_MAX),
    };
    let share = f64::from(strength.saturating_sub(from)) / f64::from(to - from);
    libm::round(between(bounds, share.min(1.0))) as u32
}

/// From the one at 0 to the other at 1, by the same factor everywhere.
fn between([low, high]: [f64; 2], share: f64) -> f64 {
    low * libm::pow(high / low, share)
}

/// Throw compensation f that fits a profile: under `2009` what the paper's player learned
/// (figure 5.5), under `standard` what hits best.
fn throw_factor(profile: Profile) -> f64 {
    match profile {
        Profile::Standard => 0.07,
        Profile::Paper2009 => 0.45,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(strength: u8) -> PlayerSettings {
        PlayerSettings::of_strength(strength, 1, Profile::Standard)
    }

    #[test]
    fn more_strength_is_a_steadier_arm_and_no_less_of_anything_else() {
        for strength in 0..STRENGTH_MAX {
            let (weak, strong) = (of(strength), of(strength + 1));
            assert!(strong.noise < weak.noise, "{strength}");
            assert!(weak.level <= strong.level, "{strength}");
            assert!(weak.simulations <= strong.simulations, "{strength}");
            assert_eq!(weak.simulations > 0, weak.level.simulates(), "{strength}");
        }
    }

    #[test]
    fn the_table_of_strengths_is_what_the_doc_says() {
        for (strength, level, noise, simulations) in [
            (0, Level::Paper, 6.0, 0),
            (15, Level::Paper, 4.59, 0),
            (30, Level::Club, 3.51, 30),
            (50, Level::Club, 2.45, 200),
            (70, Level::Champion, 1.71, 300),
            (85, Level::Champion, 1.31, 1095),
            (100, Level::Champion, 1.0, 4000),
        ] {
            let settings = of(strength);
            assert_eq!((settings.level, settings.simulations), (level, simulations), "{strength}");
            assert!((settings.noise - noise).abs() < 0.005, "{strength}: {}", settings.noise);
        }
        assert_eq!(of(100), PlayerSettings::of_level(Level::Champion, 1, Profile::Standard));
        assert_eq!(of(101), of(100));
        let club = PlayerSettings::of_level(Level::Club, 1, Profile::Standard);
        assert_eq!((club.simulations, club.noise), (200, 1.0));
    }
}
