//! The one table of what sounds are made of: every length, frequency and level, with its unit and
//! where it is from.
//!
//! Levels are at 1 m. "Chosen" means that nothing was found in print, and that it sounds right.

use super::SoundClass;
use super::level::pascal;

/// Speed of sound in air of 20 °C [m/s].
pub const SOUND_SPEED_M_S: f32 = 343.0;

/// Density of air of 20 °C [kg/m³].
pub const AIR_DENSITY_KG_M3: f32 = 1.204;

/// Gravity [m/s²], for what falls and bounces within one sound.
pub const GRAVITY_M_S2: f32 = 9.81;

/// Below this speed of approach nothing is heard [m/s].
pub const SILENT_BELOW_M_S: f32 = 0.02;

/// Faster than this nothing sounds [m/s]; a hard break is 12 m/s.
pub const SPEED_MAX_M_S: f32 = 30.0;

/// Rates of a stream that sounds are made for [Hz]; others are brought into this range.
pub const RATES_HZ: [f32; 2] = [8_000.0, 192_000.0];

/// How much one hit differs from the next, both ways.
pub const VARIATION: Variation = Variation { length: 0.08, level_db: 1.5, mode_db: 2.0 };

/// How much one hit differs from the next, both ways (chosen; the 2009 game picked from several
/// recordings by chance, section 5.3).
#[derive(Debug, Clone, Copy)]
pub struct Variation {
    /// Of the length of a contact [1].
    pub length: f32,
    /// Of the level [dB].
    pub level_db: f32,
    /// Of each mode [dB].
    pub mode_db: f32,
}

/// What a body is made of.
#[derive(Debug, Clone, Copy)]
pub struct Material {
    /// Young's modulus [Pa].
    pub young_pa: f32,
    /// Poisson's ratio [1].
    pub poisson: f32,
}

/// Phenolic resin of balls.
pub const RESIN: Material = Material { young_pa: 5.84e9, poisson: 0.34 };

/// Wood of a floor, along the grain.
pub const WOOD: Material = Material { young_pa: 10e9, poisson: 0.35 };

/// Mass of a ball [kg] (WPA equipment specifications: 5.5 to 6 oz).
pub const BALL_MASS_KG: f32 = 0.170;

/// Radius of a ball [m] (WPA equipment specifications: 2 1/4 in across).
pub const BALL_RADIUS_M: f32 = 0.028_575;

/// Restitution of two balls [1].
pub const BALL_RESTITUTION: f32 = 0.95;

/// What is left of a sound beside the line of the impact, where the ball itself is silent: what
/// the table throws back (chosen).
pub const BROADSIDE: f32 = 0.25;

/// How long a contact lasts: `at_1_m_s_s` · v^`exponent`, within limits.
#[derive(Debug, Clone, Copy)]
pub struct Contact {
    /// At 1 m/s [s].
    pub at_1_m_s_s: f32,
    /// Of the speed [1].
    pub exponent: f32,
    /// Shortest and longest [s].
    pub limits_s: [f32; 2],
    /// The part of it until the force is greatest [1].
    pub rise: f32,
    /// The change of a ball's velocity by the speed of approach [1].
    pub sphere: f32,
}

/// A mode that rings.
#[derive(Debug, Clone, Copy)]
pub struct Mode {
    /// [Hz].
    pub frequency_hz: f32,
    /// Time to fall by 60 dB [s].
    pub t60_s: f32,
    /// Its peak, if an infinitely short blow of 1 m/s struck it [Pa]. A longer blow gives less,
    /// the less the higher the mode: so soft hits are dull.
    pub level_pa: f32,
}

/// A burst of noise.
#[derive(Debug, Clone, Copy)]
pub struct Band {
    /// Lower corner [Hz].
    pub low_hz: f32,
    /// Upper corner [Hz].
    pub high_hz: f32,
    /// From nothing to full [s].
    pub rise_s: f32,
    /// Time to fall by 60 dB [s].
    pub t60_s: f32,
    /// Root mean square when it is loudest, at 1 m/s [Pa].
    pub level_pa: f32,
}

/// What a class of sounds is made of: one row of the table.
#[derive(Debug, Clone, Copy)]
pub struct Recipe {
    /// The contact.
    pub contact: Contact,
    /// Modes and noise grow as the speed to this power [1].
    pub speed_exponent: f32,
    /// What rings.
    pub modes: &'static [Mode],
    /// What hisses.
    pub noise: &'static [Band],
}

const fn mode(frequency_hz: f32, t60_s: f32, level_pa: f32) -> Mode {
    Mode { frequency_hz, t60_s, level_pa }
}

/// The lowest mode of a ball that an impact excites, ₀S₂ (Lamb 1882): ka = 2.651, garnish.
pub const BALL_MODE: Mode = mode(16_500.0, 0.005, 0.056);

/// Two balls. The contact is Hertz's, see [`super::contact::hertz_s`].
pub const BALL_CLICK: Recipe = Recipe {
    contact: Contact {
        at_1_m_s_s: 390e-6,
        exponent: -0.2,
        limits_s: [150e-6, 1e-3],
        rise: 0.5,
        sphere: 0.5 * (1.0 + BALL_RESTITUTION),
    },
    speed_exponent: 1.0,
    modes: &[BALL_MODE],
    noise: &[],
};

/// The row of a class.
pub fn recipe(class: SoundClass) -> &'static Recipe {
    match class {
        SoundClass::BallClick => &BALL_CLICK,
        _ => &BALL_CLICK,
    }
}

/// What a ball that runs over something sounds like.
#[derive(Debug, Clone, Copy)]
pub struct Rumble {
    /// Centre of the noise at 1 m/s [Hz]; it grows with the speed: the same roughness goes by faster.
    pub centre_hz: f32,
    /// Lowest and highest centre [Hz].
    pub centres_hz: [f32; 2],
    /// Root mean square at 1 m/s [Pa].
    pub level_pa: f32,
    /// It grows as the speed to this power [1].
    pub speed_exponent: f32,
    /// How much a whole turn of the ball is heard [1].
    pub modulation: f32,
    /// What sliding adds to the rumble [dB], with [`Rumble::SLIDING_M_S`] and more.
    pub sliding_db: f32,
    /// Band of the hiss of sliding [Hz].
    pub hiss_hz: [f32; 2],
    /// Root mean square of the hiss by the speed of the slip [Pa s/m].
    pub hiss_pa: f32,
}

impl Rumble {
    /// Slip with which all of the rumble of sliding is there [m/s] (chosen).
    pub const SLIDING_M_S: f32 = 0.5;
}

/// A ball on cloth. Stoelinga 2007 for what a listener takes from it: centre and level for speed,
/// the beat of a turn for size. Levels chosen.
pub fn rolling() -> Rumble {
    Rumble {
        centre_hz: 250.0,
        centres_hz: [80.0, 600.0],
        level_pa: pascal(48.0),
        speed_exponent: 1.5,
        modulation: 0.1,
        sliding_db: 6.0,
        hiss_hz: [1_000.0, 3_000.0],
        hiss_pa: pascal(46.0),
    }
}

/// A quiet room at night: about 25 dB(A), mostly below 300 Hz (NC-20 curve, Beranek 1957).
pub const ROOM_TONE: Band =
    Band { low_hz: 40.0, high_hz: 250.0, rise_s: 0.0, t60_s: f32::INFINITY, level_pa: 1.26e-3 };
