//! The stub of the vendor's HD library (`tests/stub_hd`): built once, and loaded anew by every
//! test, since a library is loaded only once into a process. Its script is set, and its log read,
//! through functions of its own.

#![allow(unsafe_code)]

use libloading::{Library, Symbol};
use std::ffi::{CStr, CString, c_char};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

/// The stub, with all functions.
pub fn whole() -> &'static Path {
    static BUILT: OnceLock<PathBuf> = OnceLock::new();
    BUILT.get_or_init(|| build("whole", &[]))
}

/// The stub without `hdUnschedule`.
pub fn lacking_one() -> &'static Path {
    static BUILT: OnceLock<PathBuf> = OnceLock::new();
    BUILT.get_or_init(|| build("lacking_one", &["--cfg", "lacks_one"]))
}

/// Compiles it with the compiler that stands beside the cargo which built this test.
fn build(name: &str, more: &[&str]) -> PathBuf {
    let beside = Path::new(env!("CARGO")).with_file_name("rustc");
    let compiler = if beside.exists() { beside } else { PathBuf::from("rustc") };
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/stub_hd/hd.rs");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let file =
        format!("{}stub_hd_{name}{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
    let sources = [&source, &source.with_file_name("script.rs"), &std::env::current_exe().unwrap()];
    if is_fresh(&folder.join(&file), &sources) {
        return folder.join(file);
    }
    let built = folder.join(format!("{}_{file}", std::process::id()));
    let output = Command::new(&compiler)
        .args(["--edition", "2024", "--crate-type", "cdylib", "--crate-name", "stub_hd"])
        .args(["-D", "warnings", "--check-cfg", "cfg(lacks_one)", "-C", "opt-level=1"])
        .args(more)
        .arg(&source)
        .arg("-o")
        .arg(&built)
        .output()
        .unwrap_or_else(|error| panic!("{}: {error}", compiler.display()));
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    // Two processes may build at the same time; either result is whole.
    let file = folder.join(file);
    std::fs::rename(&built, &file).unwrap();
    file
}

/// Whether a file is younger than what it is made of.
fn is_fresh(file: &Path, of: &[&PathBuf]) -> bool {
    let made = |path: &Path| path.metadata().and_then(|about| about.modified()).ok();
    made(file).is_some_and(|file| of.iter().all(|of| made(of).is_some_and(|of| of < file)))
}

/// A copy of the stub that this test alone uses.
pub struct StubHd {
    path: PathBuf,
    library: Library,
}

impl StubHd {
    /// A fresh one, for the test of this name, with this script.
    pub fn new(test: &str, script: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("libHD_{test}"));
        // Never into a file that may be loaded.
        let _ = std::fs::remove_file(&path);
        std::fs::copy(whole(), &path).unwrap();
        // SAFETY: the stub does nothing when it is loaded.
        let library = unsafe { Library::new(&path) }.unwrap();
        let stub = StubHd { path, library };
        let script = CString::new(script).unwrap();
        // SAFETY: the type is that of the stub's function.
        let set: Symbol<'_, unsafe extern "system" fn(*const c_char)> =
            unsafe { stub.library.get("stub_script") }.unwrap();
        // SAFETY: a C string.
        unsafe { set(script.as_ptr()) };
        stub
    }

    /// Its file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Puts the stylus at a place [mm], with these buttons held.
    pub fn place(&self, position_mm: [f64; 3], buttons: i32) {
        // SAFETY: the type is that of the stub's function.
        let place: Symbol<'_, extern "system" fn(f64, f64, f64, i32)> =
            unsafe { self.library.get("stub_place") }.unwrap();
        let [x, y, z] = position_mm;
        place(x, y, z, buttons);
    }

    fn given(&self) -> ([f64; 3], u64) {
        // SAFETY: the type is that of the stub's function.
        let given: Symbol<'_, unsafe extern "system" fn(*mut f64, *mut u64)> =
            unsafe { self.library.get("stub_given") }.unwrap();
        let (mut force_n, mut ticks) = ([0.0; 3], 0);
        // SAFETY: there is room.
        unsafe { given(force_n.as_mut_ptr(), &mut ticks) };
        (force_n, ticks)
    }

    /// The size of the force that it was given last [N].
    pub fn force_n(&self) -> f64 {
        glam::DVec3::from(self.given().0).length()
    }

    /// Its ticks since it was opened.
    pub fn ticks(&self) -> u64 {
        self.given().1
    }

    /// Whether its motors get what it is given.
    pub fn pushes(&self) -> bool {
        // SAFETY: the type is that of the stub's function.
        let pushes: Symbol<'_, extern "system" fn() -> u8> =
            unsafe { self.library.get("stub_pushes") }.unwrap();
        pushes() != 0
    }

    /// What was called so far, but for what is called in every tick.
    pub fn log(&self) -> Vec<String> {
        // SAFETY: the type is that of the stub's function.
        let log: Symbol<'_, extern "system" fn() -> *const c_char> =
            unsafe { self.library.get("stub_log") }.unwrap();
        // SAFETY: a C string that nobody frees.
        let log = unsafe { CStr::from_ptr(log()) };
        log.to_string_lossy().lines().map(String::from).collect()
    }
}
