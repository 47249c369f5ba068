//! How pictures are drawn: what can be set, what a preset means, and how much detail a ball gets.
//!
//! Everything that costs time can be left out (paper, section 4.2). One struct of plain values,
//! [`PictureSettings`], is what the settings file, the pages of the menus and the command line
//! share; a [`PictureOption`] names one of its fields wherever that is written or set.

mod settings;
pub use settings::{
    Environment, FrameLimit, PictureError, PictureOption, PictureSettings, Shadows, Smoothing,
    Stereo,
};

mod preset;
pub use preset::Preset;

mod detail;
pub use detail::BallDetail;

mod bench;
pub use bench::{BenchRow, BenchTable, FrameTimes, bench_markdown, bench_rows};
