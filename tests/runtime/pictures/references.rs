//! Pictures against stored ones, by a measure that sees as eyes do: structure by SSIM on
//! brightness, colours by their difference. Another driver may draw other pixels, but no other
//! picture.
//!
//! `UPDATE_PICTURES=1 cargo test -p hapticbillard-actors --test runtime references` stores them
//! anew; look at them before they are committed.

use super::{smooth, studio};
use glam::DVec3;
use hapticbillard::events::FactSet;
use hapticbillard::input::{CameraPose, HumanView};
use hapticbillard::picture::{PictureSettings, Preset, Shadows, Stereo};
use hapticbillard::renderer::{DrawList, Radii, draw_vectors};
use hapticbillard_actors::files::load_scene;
use hapticbillard_actors::game::Stage;
use hapticbillard_actors::renderer::encoded;
use image::RgbImage;
use std::path::{Path, PathBuf};

const SIZE: (u32, u32) = (256, 160);
/// Pictures that are more alike than this are the same; 1 is equality.
const ALIKE: f64 = 0.97;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/runtime/pictures/references")
}

/// Name, seconds into the break, eye, what it looks at, settings.
fn shots() -> Vec<(&'static str, f64, DVec3, DVec3, PictureSettings)> {
    let (near, spread) = (DVec3::new(0.25, -0.32, 0.22), DVec3::new(0.6, 0.0, 0.0));
    let usual = smooth();
    let preset = |preset: Preset| preset.applied(usual);
    let shadows = |shadows| PictureSettings { shadows, ..preset(Preset::High) };
    vec![
        ("rack", 0.0, DVec3::new(0.42, -0.1, 0.10), spread, preset(Preset::VeryHigh)),
        ("break_soft", 0.5, near, spread, shadows(Shadows::Soft)),
        ("break_off", 0.5, near, spread, shadows(Shadows::Off)),
        ("break_maps", 0.5, near, spread, shadows(Shadows::Maps)),
        ("break_volumes", 0.5, near, spread, shadows(Shadows::Volumes)),
        ("room", 0.5, DVec3::new(-2.6, -2.2, 0.9), DVec3::new(1.0, 0.6, 0.2), usual),
        ("very_low", 0.5, near, spread, preset(Preset::VeryLow)),
        ("marks", 0.5, near, spread, PictureSettings { marks: true, ..usual }),
        ("vectors", 0.5, near, spread, PictureSettings { vectors: true, ..usual }),
        ("anaglyph", 0.5, near, spread, PictureSettings { stereo: Stereo::Middle, ..usual }),
    ]
}

fn drawn() -> Option<Vec<(&'static str, RgbImage)>> {
    let stage = Stage::new(&load_scene("break_shot").unwrap(), "break_shot").unwrap();
    let mut studio = studio(&stage.table)?;
    let picture = |(name, at_s, eye, target, settings): (_, _, _, _, PictureSettings)| {
        let mut simulation = stage.simulation().unwrap();
        simulation.advance(at_s, FactSet::NONE, &mut Vec::new()).unwrap();
        let world = simulation.snapshot(at_s);
        let camera = CameraPose { eye, target, ..CameraPose::default() };
        let mut radii = Radii::default();
        radii.mark(settings.marks);
        let view = HumanView { camera, ..HumanView::default() };
        let mut list = DrawList::new(&world, &view, &radii);
        if settings.vectors {
            draw_vectors(&world, &radii, &mut list);
        }
        let rows = studio.pixels(&list, &settings, SIZE).unwrap();
        let bytes = rows.iter().flat_map(|[r, g, b, _]| [*r, *g, *b]).collect();
        (name, RgbImage::from_raw(SIZE.0, SIZE.1, bytes).unwrap())
    };
    Some(shots().into_iter().map(picture).collect())
}

fn alike(a: &RgbImage, b: &RgbImage) -> f64 {
    image_compare::rgb_hybrid_compare(a, b).unwrap().score
}

#[test]
fn pictures_are_as_they_were() {
    let Some(drawn) = drawn() else { return };
    if std::env::var_os("UPDATE_PICTURES").is_some() {
        for (name, picture) in &drawn {
            let rows: Vec<[u8; 4]> =
                picture.pixels().map(|p| [p.0[0], p.0[1], p.0[2], 255]).collect();
            let file = encoded(&rows, SIZE).unwrap();
            std::fs::write(folder().join(format!("{name}.png")), file).unwrap();
        }
    }
    let mut wrong = Vec::new();
    let stored: Vec<(&str, RgbImage)> = drawn
        .iter()
        .map(|(name, _)| {
            let file = folder().join(format!("{name}.png"));
            (*name, image::open(file).unwrap().to_rgb8())
        })
        .collect();
    for (name, picture) in &drawn {
        // It is like its own reference, and no other one is as like it.
        let scores: Vec<(f64, &str)> =
            stored.iter().map(|(other, stored)| (alike(picture, stored), *other)).collect();
        let best = scores.iter().max_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
        println!("{name}: {scores:.4?}");
        if best.1 != *name || best.0 < ALIKE {
            wrong.push(format!("{name}: most like {} with {:.4}", best.1, best.0));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
