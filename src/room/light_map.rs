//! Baked light as a picture of eight bits a channel.

use super::Room;
use super::lamp::{LAMP_HEIGHT_M, shades};
use super::texels::texels;
use glam::Vec3;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What a shipped light map was baked for.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BakedFor {
    /// [`Room::digest`].
    pub room: String,
    /// Rays per texel and round.
    pub samples: u32,
}

impl BakedFor {
    /// Reads a list of them in TOML, by the names of tables.
    ///
    /// # Errors
    /// The text is no such list.
    pub fn list(text: &str) -> Result<BTreeMap<String, BakedFor>, toml::de::Error> {
        toml::from_str(text)
    }
}

/// The brightest light that a map holds, in units of a white surface in full light. What is
/// brighter is white on any screen.
pub const LIGHT_MOST: f32 = 2.0;

/// Why baked light cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum LightMapError {
    /// The picture has another size than the room's map.
    #[error(
        "its picture has {width} x {height} texels, not {expected_width} x {expected_height}; \
         run `hapticbillard bake`"
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
    #[error("it was baked for a room {found}, not for {expected}; run `hapticbillard bake`")]
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

    /// Light that nobody baked: the lamps' as if nothing were in its way, and a little from
    /// everywhere. For rooms without a map that fits.
    pub fn unbaked(room: &Room) -> Self {
        let [width, height] = room.surfaces.size;
        let mut light = vec![Vec3::splat(0.03); (width * height) as usize];
        for texel in texels(&room.surfaces) {
            let (at, normal) = (texel.points[0].position, texel.points[0].normal);
            let mut sum = 0.0;
            for shade in shades() {
                let lamp = shade.extend(LAMP_HEIGHT_M).as_vec3();
                let way = lamp - at;
                let square = way.length_squared();
                let way = way / square.sqrt();
                sum += normal.dot(way).max(0.0) * way.z.max(0.0) / (0.35 + square);
            }
            light[texel.number as usize] = Vec3::new(0.92, 0.86, 0.74) * sum + 0.05;
        }
        LightMap::of(room.surfaces.size, &light)
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
