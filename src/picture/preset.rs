//! Presets: how much a machine is asked for.

use super::{Environment, PictureSettings, Shadows, Smoothing};

/// A choice of everything that costs time. What is a matter of taste or of the eye (stereo, marks,
/// arrows, the size of writing, the limit of pictures) stays as it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Preset {
    /// For a processor that draws alone and has something else to do.
    VeryLow,
    /// For a processor that draws alone.
    Low,
    /// As shipped.
    Medium,
    /// For a graphics card.
    High,
    /// Everything, whatever it costs.
    VeryHigh,
}

impl Preset {
    /// All, the cheapest first.
    pub const ALL: [Preset; 5] =
        [Preset::VeryLow, Preset::Low, Preset::Medium, Preset::High, Preset::VeryHigh];

    /// Its name on the command line, and the key of its name in the texts.
    pub fn key(self) -> &'static str {
        match self {
            Preset::VeryLow => "very_low",
            Preset::Low => "low",
            Preset::Medium => "medium",
            Preset::High => "high",
            Preset::VeryHigh => "very_high",
        }
    }

    /// The settings with what the preset chooses.
    #[must_use]
    pub fn applied(self, settings: PictureSettings) -> PictureSettings {
        let cheap = PictureSettings {
            room: true,
            shadows: Shadows::Soft,
            triangles: 320,
            texture: 64,
            environment: Environment::Off,
            normal_map: false,
            cloth_detail: false,
            level_of_detail: true,
            smooth: Smoothing::Off,
            render_scale: 100,
            ..settings
        };
        match self {
            Preset::VeryLow => {
                PictureSettings { room: false, shadows: Shadows::Off, render_scale: 60, ..cheap }
            }
            Preset::Low => cheap,
            Preset::Medium => PictureSettings {
                triangles: 1280,
                texture: 256,
                environment: Environment::Room,
                cloth_detail: true,
                smooth: Smoothing::Auto,
                ..cheap
            },
            Preset::High => PictureSettings {
                triangles: 1280,
                texture: 1024,
                environment: Environment::All,
                normal_map: true,
                cloth_detail: true,
                smooth: Smoothing::Auto,
                ..cheap
            },
            Preset::VeryHigh => PictureSettings {
                triangles: 5120,
                texture: 1024,
                environment: Environment::All,
                normal_map: true,
                cloth_detail: true,
                level_of_detail: false,
                smooth: Smoothing::On,
                ..cheap
            },
        }
    }

    /// The preset that chooses what is set; none if nobody chooses so.
    pub fn of(settings: &PictureSettings) -> Option<Preset> {
        Preset::ALL.into_iter().find(|preset| preset.applied(*settings) == *settings)
    }
}
