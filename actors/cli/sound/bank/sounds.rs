//! Which sounds there are to be written.

use glam::Vec3;
use hapticbillard::ids::BallId;
use hapticbillard::sound::parameters::BALL_RADIUS_M;
use hapticbillard::sound::{Bank, ClipName, Rolling, RollingVoice, RoomTone, SoundClass};

/// How long what lasts is written [s].
const LASTING_S: u32 = 3;

/// Where what lasts is written.
const LASTING_FOLDER: &str = "lasting";

/// A sound that can be written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sound {
    /// A sound that begins and ends.
    Clip(ClipName),
    /// A ball on cloth, with its slip [m/s].
    Ball { speed_m_s: f32, slip_m_s: f32 },
    /// A quiet room.
    Room,
}

/// The speeds that a class is written at [m/s].
fn speeds_m_s(class: SoundClass) -> &'static [f32] {
    match class {
        SoundClass::BallClick => &[0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0],
        SoundClass::CueStrike => &[0.5, 1.0, 2.0, 4.0, 8.0],
        SoundClass::Miscue => &[1.0, 3.0],
        SoundClass::Cushion => &[0.2, 0.5, 1.0, 2.0, 5.0],
        SoundClass::Pocket => &[0.3, 1.0, 3.0],
        SoundClass::Landing => &[0.5, 1.0, 2.0],
        SoundClass::Floor => &[1.0, 2.0, 4.0],
        SoundClass::Gully | SoundClass::Chalk => &[1.0],
    }
}

/// All of them, with `variants` of each speed.
pub fn all(variants: u32) -> Vec<Sound> {
    let mut sounds = Vec::new();
    for class in SoundClass::ALL {
        for &speed_m_s in speeds_m_s(class) {
            let clip = |variant| Sound::Clip(ClipName { class, speed_m_s, variant });
            sounds.extend((1..=variants).map(clip));
        }
    }
    for (speed_m_s, slip_m_s) in
        [(0.2, 0.0), (0.5, 0.0), (1.0, 0.0), (2.0, 0.0), (5.0, 0.0), (1.0, 0.5), (3.0, 3.0)]
    {
        sounds.push(Sound::Ball { speed_m_s, slip_m_s });
    }
    sounds.push(Sound::Room);
    sounds
}

impl Sound {
    /// Its file, from the folder of the bank on.
    pub fn file(&self) -> String {
        match self {
            Sound::Clip(name) => name.to_string(),
            Sound::Ball { speed_m_s, slip_m_s: 0.0 } => {
                format!("{LASTING_FOLDER}/rolling_v{speed_m_s}.wav")
            }
            Sound::Ball { speed_m_s, slip_m_s } => {
                format!("{LASTING_FOLDER}/sliding_v{speed_m_s}_slip{slip_m_s}.wav")
            }
            Sound::Room => format!("{LASTING_FOLDER}/room.wav"),
        }
    }

    /// What it is.
    pub fn class(&self) -> &'static str {
        match self {
            Sound::Clip(name) => name.class.name(),
            Sound::Ball { slip_m_s: 0.0, .. } => "rolling",
            Sound::Ball { .. } => "sliding",
            Sound::Room => "room",
        }
    }

    /// Its speed, if it has one [m/s].
    pub fn speed_m_s(&self) -> Option<f32> {
        match self {
            Sound::Clip(ClipName { speed_m_s, .. }) | Sound::Ball { speed_m_s, .. } => {
                Some(*speed_m_s)
            }
            Sound::Room => None,
        }
    }

    /// Its pressure at 1 m [Pa].
    pub fn render(&self, rate_hz: u32) -> Vec<f32> {
        let rate = rate_hz as f32;
        let mut samples = vec![0.0; (LASTING_S * rate_hz) as usize];
        match *self {
            Sound::Clip(ClipName { class, speed_m_s, variant }) => {
                return Bank::synthesise(class, speed_m_s, variant, rate);
            }
            Sound::Ball { speed_m_s, slip_m_s } => {
                let mut voice = RollingVoice::new(BALL_RADIUS_M, 1, rate);
                voice.tell(&Rolling {
                    ball: BallId(0),
                    radius_m: BALL_RADIUS_M,
                    position_m: Vec3::ZERO,
                    velocity_m_s: Vec3::X * speed_m_s,
                    slip_m_s,
                });
                voice.fill(&mut samples);
            }
            Sound::Room => {
                let mut room = RoomTone::new(1, rate);
                samples.iter_mut().for_each(|sample| *sample = room.next());
            }
        }
        samples
    }
}
