//! The one table of what sounds are made of: every length, frequency and level, with its unit and
//! where it is from.
//!
//! Levels are at 1 m. "Chosen" means that nothing was found in print, and that it sounds right.

use super::SoundClass;
use super::contact::hertz_s;

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

/// How long a contact lasts.
#[derive(Debug, Clone, Copy)]
pub enum Length {
    /// Of a ball and another one at rest, as the materials say ([`super::contact::hertz_s`]).
    HertzBall(Material),
    /// Of a ball and a flat body at rest, likewise.
    HertzFlat(Material),
    /// `at_1_m_s_s` · v^`exponent`, within limits.
    Power {
        /// At 1 m/s [s].
        at_1_m_s_s: f32,
        /// Of the speed [1].
        exponent: f32,
        /// Shortest and longest [s].
        limits_s: [f32; 2],
    },
}

impl Length {
    /// At a speed of approach [s].
    pub fn at_s(self, speed_m_s: f32) -> f32 {
        let (mass_kg, radius_m) = (BALL_MASS_KG, BALL_RADIUS_M);
        match self {
            Length::HertzBall(other) => {
                hertz_s(0.5 * mass_kg, 0.5 * radius_m, [RESIN, other], speed_m_s)
            }
            Length::HertzFlat(other) => hertz_s(mass_kg, radius_m, [RESIN, other], speed_m_s),
            Length::Power { at_1_m_s_s, exponent, limits_s: [shortest, longest] } => {
                (at_1_m_s_s * libm::powf(speed_m_s, exponent)).clamp(shortest, longest)
            }
        }
    }
}

/// How a ball is struck.
#[derive(Debug, Clone, Copy)]
pub struct Contact {
    /// How long it lasts.
    pub length: Length,
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
    /// Its peak, if an infinitely short blow of 1 m/s struck it [dB SPL]. A longer blow gives less,
    /// the less the higher the mode: so soft hits are dull.
    pub level_db: f32,
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
    /// Root mean square when it is loudest, at 1 m/s [dB SPL].
    pub level_db: f32,
}

/// What a class of sounds is made of: one row of the table.
#[derive(Debug, Clone, Copy)]
pub struct ClassParameters {
    /// The contact; none where nothing is struck.
    pub contact: Option<Contact>,
    /// Modes and noise grow as the speed to this power [1].
    pub speed_exponent: f32,
    /// What rings.
    pub modes: &'static [Mode],
    /// What hisses.
    pub noise: &'static [Band],
}

const fn mode(frequency_hz: f32, t60_s: f32, level_db: f32) -> Mode {
    Mode { frequency_hz, t60_s, level_db }
}

const fn band(low_hz: f32, high_hz: f32, rise_s: f32, t60_s: f32, level_db: f32) -> Band {
    Band { low_hz, high_hz, rise_s, t60_s, level_db }
}

const fn power(at_1_m_s_s: f32, exponent: f32, limits_s: [f32; 2]) -> Length {
    Length::Power { at_1_m_s_s, exponent, limits_s }
}

/// Two balls: 390 µs at 1 m/s. The mode is the lowest of a ball that an impact excites, ₀S₂ (Lamb
/// 1882): garnish, some 35 dB below the click.
pub const BALL_CLICK: ClassParameters = ClassParameters {
    contact: Some(Contact {
        length: Length::HertzBall(RESIN),
        rise: 0.5,
        sphere: 0.5 * (1.0 + BALL_RESTITUTION),
    }),
    speed_exponent: 1.0,
    modes: &[mode(16_500.0, 0.005, 107.0)],
    noise: &[],
};

/// A tip at a ball. Contact of 1 to 2 ms, soft tips 3, hard ones 0.8 ms (Alciatore, high-speed
/// video of cue tips); the ball leaves with a third more than the speed of the cue (0.54 kg,
/// restitution 0.75). Leather gives back slowly. The shaft rings along its length: n c/2L with
/// c = 4.5 km/s in maple and L = 1.47 m; levels chosen, about 20 dB below the blow.
pub const CUE_STRIKE: ClassParameters = ClassParameters {
    contact: Some(Contact { length: power(1.7e-3, -0.2, [0.8e-3, 3e-3]), rise: 0.4, sphere: 1.33 }),
    speed_exponent: 1.0,
    modes: &[mode(1_530.0, 0.040, 76.0), mode(3_061.0, 0.030, 80.0), mode(4_592.0, 0.025, 84.0)],
    noise: &[],
};

/// A tip that slips off: a few short contacts and a scrape (chosen).
pub const MISCUE: ClassParameters = ClassParameters {
    contact: Some(Contact {
        length: power(0.5e-3, -0.2, [0.3e-3, 0.8e-3]),
        rise: 0.4,
        sphere: 0.25,
    }),
    speed_exponent: 1.0,
    modes: &[mode(1_530.0, 0.050, 76.0), mode(3_061.0, 0.040, 76.0), mode(4_592.0, 0.030, 74.0)],
    noise: &[band(1_500.0, 6_000.0, 0.002, 0.060, 66.0)],
};

/// Fewest and most contacts of a miscue.
pub const MISCUE_CONTACTS: [u8; 2] = [3, 5];

/// Between two contacts of a miscue [s].
pub const MISCUE_GAP_S: [f32; 2] = [1e-3, 3e-3];

/// A ball at a cushion: rubber for 3 to 6 ms, which gives back slowly; the rail of wood behind it
/// rings, the cloth hisses 20 dB below (chosen).
pub const CUSHION: ClassParameters = ClassParameters {
    contact: Some(Contact { length: power(5e-3, -0.25, [3e-3, 6e-3]), rise: 0.3, sphere: 1.7 }),
    speed_exponent: 1.2,
    modes: &[
        mode(90.0, 0.120, 72.0),
        mode(160.0, 0.100, 76.0),
        mode(240.0, 0.080, 79.0),
        mode(410.0, 0.060, 86.0),
    ],
    noise: &[band(500.0, 2_000.0, 0.001, 0.010, 56.0)],
};

/// A ball at the back of a pocket: leather (chosen).
pub const POCKET: ClassParameters = ClassParameters {
    contact: Some(Contact { length: power(4e-3, -0.2, [2e-3, 8e-3]), rise: 0.4, sphere: 1.2 }),
    speed_exponent: 1.2,
    modes: &[],
    noise: &[band(200.0, 900.0, 0.001, 0.015, 70.0)],
};

/// The same ball [`POCKET_DEPTH_M`] below, whatever its speed was (chosen).
pub const POCKET_DROP: ClassParameters = ClassParameters {
    contact: Some(Contact { length: power(3e-3, 0.0, [3e-3, 3e-3]), rise: 0.4, sphere: 1.3 }),
    speed_exponent: 0.0,
    modes: &[mode(70.0, 0.150, 74.0), mode(130.0, 0.150, 74.0)],
    noise: &[band(150.0, 600.0, 0.001, 0.030, 60.0)],
};

/// How far a ball falls in a pocket [m] (chosen); 143 ms of fall.
pub const POCKET_DEPTH_M: f32 = 0.1;

/// The end of the gully: the ball meets the wood of the tray, and the balls that lie there
/// (chosen). The click is Hertz's, a third as strong, behind a lid that takes what is above 2 kHz.
pub const GULLY: ClassParameters = ClassParameters {
    contact: Some(Contact { length: power(0.7e-3, -0.2, [0.5e-3, 2e-3]), rise: 0.5, sphere: 0.3 }),
    speed_exponent: 1.0,
    modes: &[mode(170.0, 0.090, 66.0), mode(290.0, 0.070, 68.0), mode(520.0, 0.050, 66.0)],
    noise: &[],
};

/// How long a ball is on its way through the gully [s] (chosen).
pub const GULLY_S: [f32; 2] = [1.4, 2.2];

/// How fast it begins and how fast it is in the end [m/s] (chosen).
pub const GULLY_SPEEDS_M_S: [f32; 2] = [0.5, 1.1];

/// A ball on cloth and slate, from above (chosen).
pub const LANDING: ClassParameters = ClassParameters {
    contact: Some(Contact { length: power(1.4e-3, -0.2, [0.8e-3, 3e-3]), rise: 0.5, sphere: 1.5 }),
    speed_exponent: 1.1,
    modes: &[mode(140.0, 0.060, 70.0), mode(310.0, 0.045, 72.0), mode(520.0, 0.035, 70.0)],
    noise: &[band(300.0, 1_500.0, 0.001, 0.015, 58.0)],
};

/// A ball on a floor of wood, at each bounce: 408 µs at 1 m/s. Modes of the boards chosen.
pub const FLOOR: ClassParameters = ClassParameters {
    contact: Some(Contact {
        length: Length::HertzFlat(WOOD),
        rise: 0.5,
        sphere: 1.0 + FLOOR_RESTITUTION,
    }),
    speed_exponent: 1.1,
    modes: &[
        mode(82.0, 0.200, 74.0),
        mode(137.0, 0.170, 76.0),
        mode(204.0, 0.130, 75.0),
        mode(296.0, 0.100, 74.0),
    ],
    noise: &[],
};

/// Restitution of a ball at the floor [1] (chosen).
pub const FLOOR_RESTITUTION: f32 = 0.5;

/// Chalk on a tip: a few strokes of scraping, equally loud at any speed (chosen).
pub const CHALK: ClassParameters = ClassParameters {
    contact: None,
    speed_exponent: 0.0,
    modes: &[],
    noise: &[band(2_200.0, 6_500.0, 0.050, 0.150, 44.0)],
};

/// Fewest and most strokes of the chalk.
pub const CHALK_STROKES: [u8; 2] = [2, 4];

/// From stroke to stroke [s].
pub const CHALK_GAP_S: [f32; 2] = [0.20, 0.28];

/// The row of a class.
pub fn class_parameters(class: SoundClass) -> &'static ClassParameters {
    match class {
        SoundClass::BallClick => &BALL_CLICK,
        SoundClass::CueStrike => &CUE_STRIKE,
        SoundClass::Miscue => &MISCUE,
        SoundClass::Cushion => &CUSHION,
        SoundClass::Pocket => &POCKET,
        SoundClass::Gully => &GULLY,
        SoundClass::Landing => &LANDING,
        SoundClass::Floor => &FLOOR,
        SoundClass::Chalk => &CHALK,
    }
}

/// The level of a whole sound grows as about the speed to this power: what a recording at another
/// speed is corrected by [1]. Acceleration noise grows faster than the blow, since a harder blow is
/// shorter too.
pub fn level_exponent(class: SoundClass) -> f32 {
    match class {
        SoundClass::BallClick | SoundClass::CueStrike | SoundClass::Floor => 1.35,
        other => class_parameters(other).speed_exponent,
    }
}

/// What a ball that runs over something sounds like.
#[derive(Debug, Clone, Copy)]
pub struct Rumble {
    /// Centre of the noise at 1 m/s [Hz]; it grows with the speed: the same roughness goes by
    /// faster.
    pub centre_hz: f32,
    /// Lowest and highest centre [Hz].
    pub centres_hz: [f32; 2],
    /// Root mean square at 1 m/s [dB SPL].
    pub level_db: f32,
    /// It grows as the speed to this power [1].
    pub speed_exponent: f32,
    /// How much a whole turn of the ball is heard [1].
    pub modulation: f32,
    /// What sliding adds to the rumble [dB], with a slip of [`Rumble::SLIDING_M_S`] and more.
    pub sliding_db: f32,
    /// Band of the hiss of sliding [Hz].
    pub hiss_hz: [f32; 2],
    /// Root mean square of the hiss for 1 m/s of slip [dB SPL]; it grows in proportion.
    pub hiss_db: f32,
}

impl Rumble {
    /// Slip with which all of the rumble of sliding is there [m/s] (chosen).
    pub const SLIDING_M_S: f32 = 0.5;
}

/// A ball on cloth. Stoelinga 2007 for what a listener takes from it: centre and level tell the
/// speed, the beat of a turn the size. Levels chosen.
pub const ROLLING: Rumble = Rumble {
    centre_hz: 250.0,
    centres_hz: [80.0, 600.0],
    level_db: 48.0,
    speed_exponent: 1.5,
    modulation: 0.1,
    sliding_db: 6.0,
    hiss_hz: [1_000.0, 3_000.0],
    hiss_db: 46.0,
};

/// A ball in a channel of wood, which is hollow and higher (chosen).
pub const GULLY_ROLLING: Rumble = Rumble {
    centre_hz: 420.0,
    centres_hz: [150.0, 700.0],
    level_db: 58.0,
    speed_exponent: 1.2,
    modulation: 0.3,
    sliding_db: 0.0,
    hiss_hz: [1_000.0, 3_000.0],
    hiss_db: 0.0,
};

/// A quiet room at night: some 25 dB(A), most of it low (chosen).
pub const ROOM_TONE: Band = band(40.0, 250.0, 0.0, f32::INFINITY, 36.0);
