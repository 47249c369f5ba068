//! Baked light as a picture of eight bits a channel.

use super::Room;
use glam::Vec3;

/// The brightest light that a map holds, in units of a white surface in full light. What is
/// brighter is white on any screen.
pub const LIGHT_MOST: f32 = 2.0;

/// Why baked light cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum LightMapError {
    /// The picture has another size than the room's map.
    #[error(
        "its picture has {width} x {height} texels and the room {expected_width} x {expected_height}; run `hapticbillard bake`"
    )]
    Size {
        /// Its width.
        width: u32,
        /// Its height.
        height: u32,
        /// The room's width.
        expected_width: u32,
        /// The room's height.
        expected_height: u32,
    },
    /// It was baked for another room.
    #[error(
        "it was baked for a room {found}, and this one is {expected}; run `hapticbillard bake`"
    )]
    Room {
        /// The digest that it was baked for.
        found: String,
        /// That of the room.
        expected: String,
    },
}

/// The light of a room. A channel keeps `255 √(light / LIGHT_MOST)`: the eye sees steps in the dark
/// better than in the light.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LightMap {
    /// Width and height [texels].
    pub size: [u32; 2],
    /// Rows from v = 0; red, green, blue.
    pub texels: Vec<[u8; 3]>,
}

impl LightMap {
    /// From light.
    pub(super) fn of(size: [u32; 2], light: &[Vec3]) -> Self {
        let byte = |x: f32| ((x / LIGHT_MOST).clamp(0.0, 1.0).sqrt() * 255.0 + 0.5) as u8;
        LightMap { size, texels: light.iter().map(|light| light.to_array().map(byte)).collect() }
    }

    /// The light of a texel.
    pub fn light(&self, x: u32, y: u32) -> [f32; 3] {
        self.texels[(y * self.size[0] + x) as usize].map(|byte| {
            let root = f32::from(byte) / 255.0;
            root * root * LIGHT_MOST
        })
    }

    /// Whether it is that of a room, given what it was baked for.
    ///
    /// # Errors
    /// It is not; the sentence goes on from what names the map.
    pub fn fits(&self, room: &Room, digest: &str) -> Result<(), LightMapError> {
        let [width, height] = self.size;
        let [expected_width, expected_height] = room.surfaces.size;
        let expected = room.digest().to_string();
        if digest != expected {
            return Err(LightMapError::Room { found: digest.to_owned(), expected });
        }
        if self.size != room.surfaces.size {
            return Err(LightMapError::Size { width, height, expected_width, expected_height });
        }
        Ok(())
    }
}
