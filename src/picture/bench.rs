//! The paper's tables of frames per second (section 4.4.1), row by row, and what a row is in words.

use super::{Environment, PictureSettings, Preset, Shadows, Smoothing};
use crate::quantile::nearest_rank;
use serde::Serialize;

/// A table of rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum BenchTable {
    /// Triangles of balls against both kinds of shadows.
    Triangles,
    /// Textures of balls, without shadows.
    Textures,
    /// Reflections and scratches against both kinds of shadows.
    Effects,
    /// What the paper does not have: no shadows, and soft ones.
    Others,
    /// The presets.
    Presets,
}

impl BenchTable {
    /// Its title.
    pub fn title(self) -> &'static str {
        match self {
            BenchTable::Triangles => "Triangles (texture 256)",
            BenchTable::Textures => "Texture (1280 triangles, no shadows)",
            BenchTable::Effects => "Effects (1280 triangles, texture 1024)",
            BenchTable::Others => "Not in the paper (texture 256)",
            BenchTable::Presets => "Presets",
        }
    }
}

/// A row: settings, and what the program of 2009 did with them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BenchRow {
    /// Where it stands.
    pub table: BenchTable,
    /// How its pictures are drawn.
    pub settings: PictureSettings,
    /// Frames per second of a GeForce 8600GT in 2009.
    pub fps_2009: Option<f64>,
    /// Which preset that is.
    pub preset: Option<Preset>,
}

/// All rows. Settings touch the balls only, as in the paper, but for the presets'.
pub fn bench_rows() -> Vec<BenchRow> {
    let plain = PictureSettings {
        shadows: Shadows::Off,
        triangles: 1280,
        texture: 256,
        environment: Environment::Off,
        normal_map: false,
        level_of_detail: false,
        smooth: Smoothing::Off,
        render_scale: 100,
        ..PictureSettings::default()
    };
    let row = |table, settings, fps_2009| BenchRow { table, settings, fps_2009, preset: None };
    let (maps, volumes) = (Shadows::Maps, Shadows::Volumes);
    let mut rows = Vec::new();
    for (triangles, fps) in [(320, [62.0, 55.0]), (1280, [59.0, 50.0]), (5120, [56.0, 4.0])] {
        for (shadows, fps) in [maps, volumes].into_iter().zip(fps) {
            let settings = PictureSettings { shadows, triangles, ..plain };
            rows.push(row(BenchTable::Triangles, settings, Some(fps)));
        }
    }
    for (texture, fps) in [(1024, 65.0), (256, 68.0), (64, 74.0)] {
        let settings = PictureSettings { texture, ..plain };
        rows.push(row(BenchTable::Textures, settings, Some(fps)));
    }
    for (environment, normal_map, fps) in
        [(Environment::Room, false, [56.0, 48.0]), (Environment::Off, true, [54.0, 47.0])]
    {
        for (shadows, fps) in [maps, volumes].into_iter().zip(fps) {
            let settings =
                PictureSettings { shadows, texture: 1024, environment, normal_map, ..plain };
            rows.push(row(BenchTable::Effects, settings, Some(fps)));
        }
    }
    for shadows in [Shadows::Off, Shadows::Soft] {
        for triangles in [320, 5120] {
            let settings = PictureSettings { shadows, triangles, ..plain };
            rows.push(row(BenchTable::Others, settings, None));
        }
    }
    rows.extend(Preset::ALL.map(|preset| BenchRow {
        table: BenchTable::Presets,
        settings: preset.applied(PictureSettings::default()),
        fps_2009: None,
        preset: Some(preset),
    }));
    rows
}

/// How long pictures took [ms].
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FrameTimes {
    /// Half of them were not longer.
    pub median: f64,
    /// 95 of 100 were not longer.
    pub p95: f64,
}

impl FrameTimes {
    /// From times [s]; none of nothing.
    pub fn of(times_s: &[f64]) -> Option<Self> {
        let mut sorted = times_s.to_vec();
        sorted.sort_by(f64::total_cmp);
        let at = |share: f64| Some(1e3 * nearest_rank(&sorted, share)?);
        Some(FrameTimes { median: at(0.5)?, p95: at(0.95)? })
    }
}

/// The tables in Markdown: each row with its frames per second beside those of 2009, for an eye
/// that moves or rests.
pub fn bench_markdown(
    measured: &[(BenchRow, FrameTimes)],
    device: &str,
    size: (u32, u32),
    is_moving: bool,
) -> String {
    let (width, height) = size;
    let eye = if is_moving { "moves" } else { "rests" };
    let mut text = format!("Device: {device}; {width} x {height} pixels; the eye {eye}.\n");
    let mut table = None;
    for (row, times) in measured {
        if table.replace(row.table) != Some(row.table) {
            text += &format!(
                "\n## {}\n\n| balls | median | p95 | frames/s | 2009 |\n|---|---|---|---|---|\n",
                row.table.title()
            );
        }
        let fps_2009 = row.fps_2009.map_or(String::from("–"), |fps| format!("{fps:.0}"));
        let FrameTimes { median, p95 } = *times;
        text += &format!(
            "| {} | {median:.1} ms | {p95:.1} ms | {:.0} | {fps_2009} |\n",
            row.name(),
            1e3 / median.max(1e-6)
        );
    }
    text
}

impl BenchRow {
    /// What is otherwise than in the rows beside it.
    pub fn name(&self) -> String {
        if let Some(preset) = self.preset {
            return preset.key().replace('_', " ");
        }
        let PictureSettings { triangles, texture, environment, normal_map, .. } = self.settings;
        let shadows = match self.settings.shadows {
            Shadows::Off => "no shadows",
            Shadows::Soft => "soft shadows",
            Shadows::Maps => "shadow maps",
            Shadows::Volumes => "shadow volumes",
        };
        let what = match self.table {
            BenchTable::Textures => return format!("{texture} x {texture}"),
            BenchTable::Effects if normal_map => String::from("scratches"),
            BenchTable::Effects if environment != Environment::Off => String::from("reflections"),
            _ => format!("{triangles} triangles"),
        };
        format!("{what}, {shadows}")
    }
}
