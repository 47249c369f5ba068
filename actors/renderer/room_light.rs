//! The light of a room: from the shipped file to the graphics card.

use hapticbillard::room::{BakedFor, LightMap, LightMapError, Room};
use image::codecs::png::{CompressionType, FilterType, PngDecoder, PngEncoder};
use image::{DynamicImage, ExtendedColorType, ImageDecoder, ImageEncoder};
use std::io::Cursor;
use three_d::*;

/// Why there is no baked light for a room; one line.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoLight {
    /// No light map of this table is shipped.
    #[error("none is shipped; `hapticbillard bake` makes one")]
    NotShipped,
    /// The list of what light was baked for is broken.
    #[error("the list of light maps cannot be read: {0}")]
    List(String),
    /// The picture is broken.
    #[error("its picture cannot be read: {0}; run `hapticbillard bake`")]
    Picture(String),
    /// It belongs to another room.
    #[error(transparent)]
    Other(#[from] LightMapError),
}

/// The shipped light of the room of this table.
///
/// # Errors
/// [`NoLight`] if there is none that fits.
pub fn shipped_light(table: &str, room: &Room) -> Result<LightMap, NoLight> {
    let list = BakedFor::list(hapticbillard_assets::LIGHT_LIST)
        .map_err(|error| NoLight::List(error.to_string()))?;
    let picture = hapticbillard_assets::LIGHT.iter().find(|(name, _)| *name == table);
    let (Some(baked), Some((_, picture))) = (list.get(table), picture) else {
        return Err(NoLight::NotShipped);
    };
    let map = decode_light(picture)?;
    map.fits(room, &baked.room)?;
    Ok(map)
}

/// Light out of a PNG picture.
///
/// # Errors
/// [`NoLight`] if it is none.
pub fn decode_light(picture: &[u8]) -> Result<LightMap, NoLight> {
    let broken = |error: image::ImageError| NoLight::Picture(error.to_string());
    let decoder = PngDecoder::new(Cursor::new(picture)).map_err(broken)?;
    let (width, height) = decoder.dimensions();
    let picture = DynamicImage::from_decoder(decoder).map_err(broken)?.into_rgb8();
    let texels = picture.pixels().map(|pixel| pixel.0).collect();
    Ok(LightMap { size: [width, height], texels })
}

/// Light as a PNG picture.
///
/// # Errors
/// [`NoLight`] if the library cannot write it.
pub fn encode_light(map: &LightMap) -> Result<Vec<u8>, NoLight> {
    let bytes: Vec<u8> = map.texels.iter().flatten().copied().collect();
    let [width, height] = map.size;
    let mut file = Vec::new();
    PngEncoder::new_with_quality(&mut file, CompressionType::Best, FilterType::Adaptive)
        .write_image(&bytes, width, height, ExtendedColorType::Rgb8)
        .map_err(|error| NoLight::Picture(error.to_string()))?;
    Ok(file)
}

/// Light on the graphics card, for all shaders.
pub struct RoomLight {
    map: Texture2D,
    mirror: Vec4,
    bed: Vec4,
    rails: Vec4,
    side: Vec3,
}

impl RoomLight {
    /// That of a room.
    pub fn new(context: &Context, room: &Room, map: &LightMap) -> Self {
        let four = |[a, b]: [glam::DVec2; 2]| vec4(a.x as f32, a.y as f32, b.x as f32, b.y as f32);
        RoomLight {
            map: texture(context, map),
            mirror: four(room.mirror()),
            bed: four(room.bed_light()),
            rails: four(room.rail_light()),
            side: room.side_light(map).into(),
        }
    }

    /// Tells a shader what it wants to know of it.
    pub fn tell(&self, program: &Program) {
        if program.requires_uniform("room_light") {
            program.use_texture("room_light", &self.map);
        }
        program.use_uniform_if_required("room_mirror", self.mirror);
        program.use_uniform_if_required("bed_light", self.bed);
        program.use_uniform_if_required("rail_light", self.rails);
        program.use_uniform_if_required("side_light", self.side);
    }
}

fn texture(context: &Context, map: &LightMap) -> Texture2D {
    // The library takes the first row for the upper one, at v = 1.
    let rows = map.texels.chunks_exact(map.size[0] as usize).rev();
    let texture = CpuTexture {
        name: "light".to_owned(),
        data: TextureData::RgbU8(rows.flatten().copied().collect()),
        width: map.size[0],
        height: map.size[1],
        min_filter: Interpolation::Linear,
        mag_filter: Interpolation::Linear,
        // Charts would run into each other.
        mipmap: None,
        wrap_s: Wrapping::ClampToEdge,
        wrap_t: Wrapping::ClampToEdge,
    };
    Texture2D::new(context, &texture)
}
