//! Data only: what the window shows and cannot compute. See `CREDITS.md` beside this file.

/// Where everything in this package comes from.
pub const CREDITS: &str = include_str!("CREDITS.md");
