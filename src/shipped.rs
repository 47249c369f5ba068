//! Configuration that is compiled in.

/// Tables by name: their parameters as TOML.
pub const TABLES: &[(&str, &str)] = &[("pool-9ft", include_str!("../config/tables/pool-9ft.toml"))];

/// Parameters of the shipped table `name`, as TOML.
pub fn table(name: &str) -> Option<&'static str> {
    TABLES.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}
