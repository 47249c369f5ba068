//! The renderer: a window on the main thread, and pictures without one.
//!
//! Graphics belong to one thread, so nothing here is a message: events come in through a channel
//! ([`crate::event_manager::Sink`]), the world and the hand's view through slots, and what devices
//! say goes out through a channel. What is drawn is decided by the core, `hapticbillard::renderer`.

mod advice;

mod balls;

mod desk;

mod felt;

mod film;

mod game_thread;

mod heard;

mod hud;

mod keys;

mod stylus;
pub use stylus::{DeskStylus, StylusPort};

mod wheel;

mod gl_window;

mod materials;

mod menu;

mod meshes;

mod meters;

mod offscreen;

mod outbox;

mod painter;

mod pointer;

mod room;

mod room_light;

mod running;

mod seeker;

mod shadows;

mod stage;
/// What stands still.
mod still;

mod textures;

mod thoughts;

mod window;

pub use felt::FeltSetup;
pub use heard::HeardSetup;
pub use offscreen::{Studio, card};
pub use room_light::{decode_light, encode_light, shipped_light};
pub use running::{GameSetup, Play, Ports, Prepared};
pub use textures::number_layer;
pub use window::{Backdrop, Host, NoWindow, TakeUp, WindowSetup, show};

use hapticbillard::picture::PictureSettings;
use hapticbillard::renderer::{DrawList, Hud};
use hapticbillard::table::Table;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};
use std::sync::Arc;

/// Why there is no picture, and what to do about it; one line.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct NoPicture(pub String);

/// A picture as a PNG file, with what is written over it.
///
/// # Errors
/// [`NoPicture`] if this machine has no OpenGL.
pub fn png(
    table: &Arc<Table>,
    list: &DrawList,
    hud: &Hud,
    settings: &PictureSettings,
    size: (u32, u32),
) -> Result<Vec<u8>, NoPicture> {
    encoded(&Studio::new(table)?.written(list, hud, settings, size)?, size)
}

/// Pixels as a PNG file, rows from the top, without their opacity.
///
/// # Errors
/// [`NoPicture`] if there are not as many as the size says.
pub fn encoded(rows: &[[u8; 4]], size: (u32, u32)) -> Result<Vec<u8>, NoPicture> {
    let bytes: Vec<u8> = rows.iter().flat_map(|[r, g, b, _]| [*r, *g, *b]).collect();
    let mut file = Vec::new();
    PngEncoder::new(&mut file)
        .write_image(&bytes, size.0, size.1, ExtendedColorType::Rgb8)
        .map_err(|error| NoPicture(format!("cannot write a PNG picture: {error}")))?;
    Ok(file)
}
