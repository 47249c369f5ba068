//! What can be set of a picture.

use super::Preset;
use serde::{Deserialize, Serialize};

/// How shadows are made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Shadows {
    /// None.
    Off,
    /// Computed for each ball: soft, and dark where it touches.
    Soft,
    /// The scene as each lamp sees it (paper, section 4.3.3).
    Maps,
    /// The bodies of darkness behind the balls (paper, section 4.3.3).
    Volumes,
}

/// What balls and polished parts reflect.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Environment {
    /// Nothing but a highlight of each lamp.
    Off,
    /// The room, the lamps and the cloth.
    Room,
    /// And the cushions, the rails and the other balls.
    All,
}

/// Whether edges are smooth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Smoothing {
    /// One sample a pixel.
    Off,
    /// Four, unless a processor draws the pictures.
    Auto,
    /// Four samples a pixel.
    On,
}

impl Smoothing {
    /// Whether there are several samples a pixel.
    pub fn is_on(self, by_processor: bool) -> bool {
        match self {
            Smoothing::Off => false,
            Smoothing::Auto => !by_processor,
            Smoothing::On => true,
        }
    }
}

/// Two pictures in one for red and cyan glasses, and which eye has the place of the picture that
/// one eye would see.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Stereo {
    /// One picture for both eyes.
    Off,
    /// The left eye.
    Left,
    /// The nose: both eyes are beside it.
    Middle,
    /// The right eye.
    Right,
}

/// How many pictures a second there are at most; a picture that would be the same is not drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FrameLimit {
    /// 30.
    Thirty,
    /// 60.
    Sixty,
    /// 120.
    HundredTwenty,
    /// As many as can be drawn.
    Off,
}

impl FrameLimit {
    /// How long a picture takes at least [s].
    pub fn period_s(self) -> f64 {
        match self {
            FrameLimit::Thirty => 1.0 / 30.0,
            // A little less: so that a screen of 60 Hz never waits for one.
            FrameLimit::Sixty => 0.0166,
            FrameLimit::HundredTwenty => 1.0 / 120.0,
            FrameLimit::Off => 0.0,
        }
    }
}

/// Everything that is set of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct PictureSettings {
    /// The room round a table, in its baked light.
    pub room: bool,
    /// How shadows are made.
    pub shadows: Shadows,
    /// Most triangles of a ball: 320, 1280 or 5120.
    pub triangles: u16,
    /// Side of the textures on balls [pixels]: 64, 256 or 1024.
    pub texture: u16,
    /// What balls reflect.
    pub environment: Environment,
    /// Fine scratches on balls that are seen from near.
    pub normal_map: bool,
    /// The nap of the cloth where it is seen from near, and the grain of wood.
    pub cloth_detail: bool,
    /// Balls that are far away get fewer triangles, no scratches and no reflections.
    pub level_of_detail: bool,
    /// Smooth edges.
    pub smooth: Smoothing,
    /// Width and height of what is drawn [% of the window's].
    pub render_scale: u8,
    /// How many pictures a second.
    pub frame_limit: FrameLimit,
    /// Size of everything that is written over the picture [%].
    pub hud_scale: u8,
    /// Two pictures in one.
    pub stereo: Stereo,
    /// Balls are told apart without their colours.
    pub marks: bool,
    /// Arrows at balls: velocity, axis of spin, slip on the cloth (paper, figure 2.1).
    pub vectors: bool,
}

impl Default for PictureSettings {
    fn default() -> Self {
        Preset::Medium.applied(PictureSettings {
            room: true,
            shadows: Shadows::Soft,
            triangles: 1280,
            texture: 256,
            environment: Environment::Room,
            normal_map: false,
            cloth_detail: true,
            level_of_detail: true,
            smooth: Smoothing::Auto,
            render_scale: 100,
            frame_limit: FrameLimit::Sixty,
            hud_scale: 100,
            stereo: Stereo::Off,
            marks: false,
            vectors: false,
        })
    }
}

/// What is wrong with options of a picture; one line.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum PictureError {
    /// There is no `key=value`.
    #[error("'{text}' is no option: write key=value, as in shadows=volumes")]
    Form {
        /// What was written.
        text: String,
    },
    /// There is no such option.
    #[error("there is no option '{key}': there are {}", keys())]
    Key {
        /// What was written.
        key: String,
    },
    /// It cannot be that.
    #[error("{key}={value}: expected one of {}", values(*option))]
    Value {
        /// Which option.
        option: PictureOption,
        /// Its name.
        key: &'static str,
        /// What was written.
        value: String,
    },
}

fn keys() -> String {
    PictureOption::ALL.map(PictureOption::key).join(", ")
}

fn values(option: PictureOption) -> String {
    option.values().join(", ")
}

/// One thing that can be set of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PictureOption {
    /// [`PictureSettings::room`].
    Room,
    /// [`PictureSettings::shadows`].
    Shadows,
    /// [`PictureSettings::triangles`].
    Triangles,
    /// [`PictureSettings::texture`].
    Texture,
    /// [`PictureSettings::environment`].
    Environment,
    /// [`PictureSettings::normal_map`].
    NormalMap,
    /// [`PictureSettings::cloth_detail`].
    ClothDetail,
    /// [`PictureSettings::level_of_detail`].
    LevelOfDetail,
    /// [`PictureSettings::smooth`].
    Smooth,
    /// [`PictureSettings::render_scale`].
    RenderScale,
    /// [`PictureSettings::frame_limit`].
    FrameLimit,
    /// [`PictureSettings::hud_scale`].
    HudScale,
    /// [`PictureSettings::stereo`].
    Stereo,
    /// [`PictureSettings::marks`].
    Marks,
    /// [`PictureSettings::vectors`].
    Vectors,
}

const SHADOWS: [Shadows; 4] = [Shadows::Off, Shadows::Soft, Shadows::Maps, Shadows::Volumes];
const TRIANGLES: [u16; 3] = [320, 1280, 5120];
const TEXTURES: [u16; 3] = [64, 256, 1024];
const ENVIRONMENTS: [Environment; 3] = [Environment::Off, Environment::Room, Environment::All];
const SMOOTHINGS: [Smoothing; 3] = [Smoothing::Off, Smoothing::Auto, Smoothing::On];
const SCALES: [u8; 6] = [50, 60, 70, 80, 90, 100];
const LIMITS: [FrameLimit; 4] =
    [FrameLimit::Thirty, FrameLimit::Sixty, FrameLimit::HundredTwenty, FrameLimit::Off];
const HUD_SCALES: [u8; 5] = [75, 100, 125, 150, 200];
const STEREOS: [Stereo; 4] = [Stereo::Off, Stereo::Left, Stereo::Middle, Stereo::Right];

/// Where a value stands in a list; at its front if it does not.
fn place<T: PartialEq>(list: &[T], value: T) -> usize {
    list.iter().position(|one| *one == value).unwrap_or(0)
}

/// Where the number that comes nearest stands in a list: a file may say anything.
fn nearest<T: Copy + Into<u32>>(list: &[T], value: T) -> usize {
    let away = |one: T| one.into().abs_diff(value.into());
    (0..list.len()).min_by_key(|place| away(list[*place])).unwrap_or(0)
}

impl PictureOption {
    /// All.
    pub const ALL: [PictureOption; 15] = [
        PictureOption::Room,
        PictureOption::Shadows,
        PictureOption::Triangles,
        PictureOption::Texture,
        PictureOption::Environment,
        PictureOption::NormalMap,
        PictureOption::ClothDetail,
        PictureOption::LevelOfDetail,
        PictureOption::Smooth,
        PictureOption::RenderScale,
        PictureOption::FrameLimit,
        PictureOption::HudScale,
        PictureOption::Stereo,
        PictureOption::Marks,
        PictureOption::Vectors,
    ];

    /// Its name in files and on the command line.
    pub fn key(self) -> &'static str {
        match self {
            PictureOption::Room => "room",
            PictureOption::Shadows => "shadows",
            PictureOption::Triangles => "triangles",
            PictureOption::Texture => "texture",
            PictureOption::Environment => "environment",
            PictureOption::NormalMap => "normal_map",
            PictureOption::ClothDetail => "cloth_detail",
            PictureOption::LevelOfDetail => "level_of_detail",
            PictureOption::Smooth => "smooth",
            PictureOption::RenderScale => "render_scale",
            PictureOption::FrameLimit => "frame_limit",
            PictureOption::HudScale => "hud_scale",
            PictureOption::Stereo => "stereo",
            PictureOption::Marks => "marks",
            PictureOption::Vectors => "vectors",
        }
    }

    /// What it can be, in order.
    pub fn values(self) -> &'static [&'static str] {
        match self {
            PictureOption::Shadows => &["off", "soft", "maps", "volumes"],
            PictureOption::Triangles => &["320", "1280", "5120"],
            PictureOption::Texture => &["64", "256", "1024"],
            PictureOption::Environment => &["off", "room", "all"],
            PictureOption::Smooth => &["off", "auto", "on"],
            PictureOption::RenderScale => &["50", "60", "70", "80", "90", "100"],
            PictureOption::FrameLimit => &["30", "60", "120", "off"],
            PictureOption::HudScale => &["75", "100", "125", "150", "200"],
            PictureOption::Stereo => &["off", "left", "middle", "right"],
            PictureOption::Room
            | PictureOption::NormalMap
            | PictureOption::ClothDetail
            | PictureOption::LevelOfDetail
            | PictureOption::Marks
            | PictureOption::Vectors => &["off", "on"],
        }
    }
}

impl PictureSettings {
    /// Which of its [values](PictureOption::values) an option has.
    pub fn place(&self, option: PictureOption) -> usize {
        match option {
            PictureOption::Room => self.room.into(),
            PictureOption::Shadows => place(&SHADOWS, self.shadows),
            PictureOption::Triangles => nearest(&TRIANGLES, self.triangles),
            PictureOption::Texture => nearest(&TEXTURES, self.texture),
            PictureOption::Environment => place(&ENVIRONMENTS, self.environment),
            PictureOption::NormalMap => self.normal_map.into(),
            PictureOption::ClothDetail => self.cloth_detail.into(),
            PictureOption::LevelOfDetail => self.level_of_detail.into(),
            PictureOption::Smooth => place(&SMOOTHINGS, self.smooth),
            PictureOption::RenderScale => nearest(&SCALES, self.render_scale),
            PictureOption::FrameLimit => place(&LIMITS, self.frame_limit),
            PictureOption::HudScale => nearest(&HUD_SCALES, self.hud_scale),
            PictureOption::Stereo => place(&STEREOS, self.stereo),
            PictureOption::Marks => self.marks.into(),
            PictureOption::Vectors => self.vectors.into(),
        }
    }

    /// Gives an option one of its values; beyond them, the last.
    pub fn put(&mut self, option: PictureOption, place: usize) {
        let place = place.min(option.values().len() - 1);
        match option {
            PictureOption::Room => self.room = place == 1,
            PictureOption::Shadows => self.shadows = SHADOWS[place],
            PictureOption::Triangles => self.triangles = TRIANGLES[place],
            PictureOption::Texture => self.texture = TEXTURES[place],
            PictureOption::Environment => self.environment = ENVIRONMENTS[place],
            PictureOption::NormalMap => self.normal_map = place == 1,
            PictureOption::ClothDetail => self.cloth_detail = place == 1,
            PictureOption::LevelOfDetail => self.level_of_detail = place == 1,
            PictureOption::Smooth => self.smooth = SMOOTHINGS[place],
            PictureOption::RenderScale => self.render_scale = SCALES[place],
            PictureOption::FrameLimit => self.frame_limit = LIMITS[place],
            PictureOption::HudScale => self.hud_scale = HUD_SCALES[place],
            PictureOption::Stereo => self.stereo = STEREOS[place],
            PictureOption::Marks => self.marks = place == 1,
            PictureOption::Vectors => self.vectors = place == 1,
        }
    }

    /// The value of an option, as it is written.
    pub fn value(&self, option: PictureOption) -> &'static str {
        option.values()[self.place(option)]
    }

    /// The same with every number one of those that there are, whatever a file said.
    #[must_use]
    pub fn sound(mut self) -> Self {
        for option in PictureOption::ALL {
            self.put(option, self.place(option));
        }
        self
    }

    /// Reads one `key=value`.
    ///
    /// # Errors
    /// [`PictureError`]: what is wrong, and what there is.
    pub fn read(&mut self, text: &str) -> Result<(), PictureError> {
        let (key, value) = text
            .split_once('=')
            .map(|(key, value)| (key.trim(), value.trim()))
            .ok_or_else(|| PictureError::Form { text: text.into() })?;
        let option = PictureOption::ALL
            .into_iter()
            .find(|option| option.key() == key)
            .ok_or_else(|| PictureError::Key { key: key.into() })?;
        let place = option.values().iter().position(|known| *known == value);
        let place = place.ok_or_else(|| PictureError::Value {
            option,
            key: option.key(),
            value: value.into(),
        })?;
        self.put(option, place);
        Ok(())
    }

    /// Whether a table may be drawn from one picture of itself from above: nothing on it is so fine
    /// that it would be missed, and no shadow is a part of its surface.
    pub fn is_table_plain(&self) -> bool {
        !self.cloth_detail && matches!(self.shadows, Shadows::Off | Shadows::Soft)
    }

    /// Size of what is drawn for a window of this size [pixels].
    pub fn drawn_size(&self, (width, height): (u32, u32)) -> (u32, u32) {
        let scale = u32::from(SCALES[self.place(PictureOption::RenderScale)]);
        let scaled = |length: u32| (length.saturating_mul(scale) / 100).max(1);
        (scaled(width), scaled(height))
    }
}
