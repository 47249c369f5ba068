//! Finds the HD library at run time and binds it. Nothing is linked: a program without it is
//! complete.
//!
//! A library that was loaded is never unloaded, since the driver behind it fails when it is loaded
//! a second time.

use super::NoOpenHaptics;
use super::hd::Hd;
use libloading::Library;
use std::error::Error;
use std::path::{Path, PathBuf};

/// The environment variable that names the library. A scene cannot: it is data, and must not
/// choose what code is run.
pub const VARIABLE: &str = "HAPTICBILLARD_LIBHD";

/// The names that the system's loader is asked for, in this order.
#[cfg(windows)]
const NAMES: &[&str] = &["HD.dll"];
#[cfg(target_os = "macos")]
const NAMES: &[&str] = &["libHD.dylib"];
#[cfg(not(any(windows, target_os = "macos")))]
const NAMES: &[&str] = &["libHD.so", "libHD.so.3.4.0", "libHD.so.3.0.0"];

/// A library that was found.
#[derive(Clone, Copy)]
pub struct Loaded {
    /// Its functions.
    pub hd: &'static Hd,
    /// The name under which it was found.
    pub name: &'static Path,
}

/// Which library the environment names, if any.
pub fn named() -> Option<PathBuf> {
    std::env::var_os(VARIABLE).filter(|name| !name.is_empty()).map(PathBuf::from)
}

/// Loads this library, or the first that is there.
///
/// # Errors
/// [`NoOpenHaptics::NoLibrary`] with the system's reason for each name,
/// [`NoOpenHaptics::NoFunction`] if it is something else.
pub fn load(library: Option<&Path>) -> Result<Loaded, NoOpenHaptics> {
    let names: Vec<&Path> = match library {
        Some(library) => vec![library],
        None => NAMES.iter().map(Path::new).collect(),
    };
    let mut tried = Vec::new();
    for name in names {
        match open(name) {
            Ok(library) => return bind(library, name),
            Err(error) => tried.push(format!("{} ({})", name.display(), reason(name, &error))),
        }
    }
    Err(NoOpenHaptics::NoLibrary { tried: tried.join(", ") })
}

/// What the system says, without the name that it says it about.
fn reason(name: &Path, error: &libloading::Error) -> String {
    let reason = error.source().map_or(error.to_string(), ToString::to_string);
    let about = format!("{}: ", name.display());
    reason.strip_prefix(&about).map_or(reason.clone(), String::from)
}

fn bind(library: Library, name: &Path) -> Result<Loaded, NoOpenHaptics> {
    let library: &'static Library = Box::leak(Box::new(library));
    let hd = Hd::bind(library).map_err(|(function, error)| NoOpenHaptics::NoFunction {
        library: name.display().to_string(),
        function,
        reason: reason(name, &error),
    })?;
    Ok(Loaded { hd: Box::leak(Box::new(hd)), name: Box::leak(name.into()) })
}

#[cfg(unix)]
#[allow(unsafe_code)]
fn open(name: &Path) -> Result<Library, libloading::Error> {
    use libloading::os::unix;
    // Its parts look for each other's functions everywhere.
    let flags = unix::RTLD_LAZY | unix::RTLD_GLOBAL;
    // SAFETY: whoever installed the vendor's library trusts what it does when it is loaded.
    unsafe { unix::Library::open(Some(name), flags) }.map(Library::from)
}

#[cfg(not(unix))]
#[allow(unsafe_code)]
fn open(name: &Path) -> Result<Library, libloading::Error> {
    // SAFETY: whoever installed the vendor's library trusts what it does when it is loaded.
    unsafe { Library::new(name) }
}
