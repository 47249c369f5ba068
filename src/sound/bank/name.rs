//! What the name of a sound file says.

use crate::sound::SoundClass;
use std::fmt;
use std::str::FromStr;
use thiserror::Error;

/// The name of a recording: `CLASS_vSPEED_VARIANT.wav`, such as `ball_click_v2.5_3.wav`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClipName {
    /// What sounds.
    pub class: SoundClass,
    /// At which speed of approach [m/s].
    pub speed_m_s: f32,
    /// Which of several.
    pub variant: u32,
}

/// Why a name says nothing.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum NameError {
    /// It is built otherwise.
    #[error("the name is not CLASS_vSPEED_VARIANT.wav, such as ball_click_v2.5_1.wav")]
    Form,
    /// There is no such class.
    #[error("{class:?} is no class of sounds; there are {}", names())]
    Class {
        /// What stands there.
        class: String,
    },
    /// The speed is none that a recording can stand for.
    #[error("a speed of {speed:?} m/s is not between 0.05 and 30 m/s")]
    Speed {
        /// What stands there.
        speed: String,
    },
}

fn names() -> String {
    SoundClass::ALL.map(SoundClass::name).join(", ")
}

impl fmt::Display for ClipName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}_v{}_{}.wav", self.class.name(), self.speed_m_s, self.variant)
    }
}

impl FromStr for ClipName {
    type Err = NameError;

    fn from_str(text: &str) -> Result<Self, NameError> {
        let stem = text.len().checked_sub(4).filter(|&at| text.is_char_boundary(at));
        let (stem, extension) = text.split_at(stem.ok_or(NameError::Form)?);
        if !extension.eq_ignore_ascii_case(".wav") {
            return Err(NameError::Form);
        }
        let (rest, variant) = stem.rsplit_once('_').ok_or(NameError::Form)?;
        let (class, speed) = rest.rsplit_once("_v").ok_or(NameError::Form)?;
        let variant = variant.parse().map_err(|_| NameError::Form)?;
        let known = SoundClass::ALL.into_iter().find(|known| known.name() == class);
        let class = known.ok_or_else(|| NameError::Class { class: class.to_string() })?;
        let range = super::RECORDED_SPEED_MIN_M_S..=super::SPEED_MAX_M_S;
        let speed_m_s = speed.parse().ok().filter(|speed| range.contains(speed));
        let speed_m_s = speed_m_s.ok_or_else(|| NameError::Speed { speed: speed.to_string() })?;
        Ok(ClipName { class, speed_m_s, variant })
    }
}
