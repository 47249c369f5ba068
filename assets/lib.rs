//! Data only: what the window shows and cannot compute in time. See `CREDITS.md` beside this file.

/// Where everything in this package comes from.
pub const CREDITS: &str = include_str!("CREDITS.md");

/// Light maps of the room, by the names of tables, as PNG pictures; `make light` bakes them anew.
pub const LIGHT: &[(&str, &[u8])] = &[
    ("pool-7ft", include_bytes!("light/pool-7ft.png")),
    ("pool-8ft", include_bytes!("light/pool-8ft.png")),
    ("pool-9ft", include_bytes!("light/pool-9ft.png")),
    ("carom-10ft", include_bytes!("light/carom-10ft.png")),
    ("snooker-12ft", include_bytes!("light/snooker-12ft.png")),
];

/// What each of them was baked for, in TOML.
pub const LIGHT_LIST: &str = include_str!("light/light.toml");
