//! Reading and writing: the one place that opens files.
//!
//! Everything read is untrusted: its size is bounded before it is in memory. Everything written
//! appears whole under its name or not at all.

use crate::error::Error;
use hapticbillard::scene::{FILE_BYTES_MAX, Scene};
use hapticbillard::shipped;
use std::fs::{self, File};
use std::io::{self, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::{Component, Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

/// Largest mesh file that is read [bytes].
pub const MESH_BYTES_MAX: u64 = 64 << 20;

/// The text of the file at `path`, if it has at most `limit` bytes.
pub fn read_text(path: &Path, limit: u64) -> Result<String, Error> {
    let bytes = read_bytes(path, limit)?;
    String::from_utf8(bytes).map_err(|_| Error::NoText { path: path.to_path_buf() })
}

/// What is in the file at `path`, if it has at most `limit` bytes.
pub fn read_bytes(path: &Path, limit: u64) -> Result<Vec<u8>, Error> {
    let failed = |reason| Error::Read { path: path.to_path_buf(), reason };
    let file = File::open(path).map_err(failed)?;
    // A folder cannot be read, and a device may never end.
    if !file.metadata().map_err(failed)?.is_file() {
        return Err(Error::NoFile { path: path.to_path_buf() });
    }
    let mut bytes = Vec::new();
    file.take(limit + 1).read_to_end(&mut bytes).map_err(failed)?;
    if bytes.len() as u64 > limit {
        return Err(Error::TooLarge { path: path.to_path_buf(), limit });
    }
    Ok(bytes)
}

/// Opens a file that is read line by line, however long it is.
pub fn open_lines(path: &Path) -> Result<File, Error> {
    let failed = |reason| Error::Read { path: path.to_path_buf(), reason };
    let file = File::open(path).map_err(failed)?;
    // A pipe may be read, a folder cannot be.
    if file.metadata().map_err(failed)?.is_dir() {
        return Err(Error::NoFile { path: path.to_path_buf() });
    }
    Ok(file)
}

/// The text of a file that may be missing, if it has at most `limit` bytes.
pub fn read_if_there(path: &Path, limit: u64) -> Result<Option<String>, Error> {
    match read_text(path, limit) {
        Err(Error::Read { reason, .. }) if reason.kind() == io::ErrorKind::NotFound => Ok(None),
        read => read.map(Some),
    }
}

/// How many files that cannot be understood are kept beside each other.
const ASIDE: usize = 20;

/// Puts a file that cannot be understood aside, under another name, which is returned: somebody
/// may have written it.
pub fn put_aside(path: &Path) -> Result<PathBuf, Error> {
    let names = (1..=ASIDE).map(|n| {
        let mut aside = path.as_os_str().to_owned();
        aside.push(if n == 1 { ".bad".to_string() } else { format!(".bad{n}") });
        PathBuf::from(aside)
    });
    let mut free = names.filter(|name| !name.exists());
    let failed = |reason| Error::Write { path: path.to_path_buf(), reason };
    let many = || io::Error::other("there are too many files that were put aside");
    let aside = free.next().ok_or_else(|| failed(many()))?;
    fs::rename(path, &aside).map_err(failed)?;
    Ok(aside)
}

/// Writes a file whole: first under another name, then renamed.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    write_whole_by(path, |file| file.write_all(bytes))
}

/// The same for what is not in memory at once: `write` does it.
pub fn write_whole_by(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> Result<(), Error> {
    let failed = |reason| Error::Write { path: path.to_path_buf(), reason };
    let name = path
        .file_name()
        .ok_or_else(|| failed(io::Error::other("the path names no file")))?
        .to_string_lossy();
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    fs::create_dir_all(folder).map_err(failed)?;
    let draft = folder.join(format!(".{name}.{}.part", std::process::id()));
    let written = File::create(&draft)
        .and_then(|file| {
            let mut file = BufWriter::new(file);
            write(&mut file).and_then(|()| file.flush())?;
            file.get_ref().sync_all()
        })
        .and_then(|()| fs::rename(&draft, path));
    written.map_err(|reason| {
        // Best effort: the draft is of no use, and the first error is the one to report.
        let _ = fs::remove_file(&draft);
        failed(reason)
    })
}

/// A file that grows by whole lines, each on disk before the next is accepted.
///
/// It is named `….part` until it is finished: what a crash leaves behind is there to be read, and
/// is never taken for a whole one.
#[derive(Debug)]
pub struct LineWriter {
    file: File,
    draft: PathBuf,
    path: PathBuf,
}

impl LineWriter {
    /// Creates the file, and its folder.
    pub fn create(path: PathBuf) -> Result<Self, Error> {
        let failed = |reason| Error::Write { path: path.clone(), reason };
        if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
            fs::create_dir_all(folder).map_err(failed)?;
        }
        let draft = Self::draft_of(&path);
        let file = File::create(&draft).map_err(failed)?;
        Ok(LineWriter { file, draft, path })
    }

    /// Goes on behind the first `length` bytes of a file that was begun and not finished; what
    /// stands behind them is half a line, and is cut off.
    pub fn resume(path: PathBuf, length: u64) -> Result<Self, Error> {
        let draft = Self::draft_of(&path);
        let failed = |reason| Error::Write { path: draft.clone(), reason };
        let mut file = File::options().write(true).open(&draft).map_err(failed)?;
        if file.metadata().map_err(failed)?.len() < length {
            return Err(failed(io::Error::other("what was written is no longer there")));
        }
        file.set_len(length).and_then(|()| file.seek(SeekFrom::End(0))).map_err(failed)?;
        Ok(LineWriter { file, draft, path })
    }

    /// The name of a file until it is finished.
    pub fn draft_of(path: &Path) -> PathBuf {
        let mut draft = path.to_path_buf().into_os_string();
        draft.push(".part");
        PathBuf::from(draft)
    }

    /// Appends a line; the operating system has it when this returns. Returns its length [bytes].
    pub fn line(&mut self, text: &str) -> Result<u64, Error> {
        let failed = |reason| Error::Write { path: self.draft.clone(), reason };
        let mut bytes = Vec::with_capacity(text.len() + 1);
        bytes.extend_from_slice(text.as_bytes());
        bytes.push(b'\n');
        self.file.write_all(&bytes).map_err(failed)?;
        Ok(bytes.len() as u64)
    }

    /// Gives the file its name.
    pub fn finish(self) -> Result<(), Error> {
        let failed = |reason| Error::Write { path: self.path.clone(), reason };
        self.file.sync_all().map_err(failed)?;
        fs::rename(&self.draft, &self.path).map_err(failed)
    }
}

/// A scene with its text and where its meshes are.
#[derive(Debug, Clone)]
pub struct LoadedScene {
    /// The scene.
    pub scene: Scene,
    /// The text it was read from.
    pub text: String,
    /// The folder that its meshes are seen from; none for a shipped scene.
    pub folder: Option<PathBuf>,
}

/// The scene of this name: a shipped one, or a file.
pub fn load_scene(name: &str) -> Result<LoadedScene, Error> {
    if let Some(text) = shipped::scene(name) {
        let scene = Scene::parse(&format!("{name}.toml"), text)?;
        return Ok(LoadedScene { scene, text: text.to_string(), folder: None });
    }
    let path = Path::new(name);
    // A bare word that is no file was meant to be a shipped scene.
    if !path.exists() && path.extension().is_none() {
        let shipped = shipped::SCENES.iter().map(|(name, _)| *name).collect();
        return Err(Error::NoScene { name: name.to_string(), shipped });
    }
    let text = read_text(path, FILE_BYTES_MAX as u64)?;
    let scene = Scene::parse(name, &text)?;
    Ok(LoadedScene { scene, text, folder: path.parent().map(Path::to_path_buf) })
}

impl LoadedScene {
    /// The text of a mesh file that the scene names. Scenes come from anywhere, so a mesh must lie
    /// in the scene's own folder or below.
    pub fn read_mesh(&self, file: &str) -> Result<String, String> {
        let Some(folder) = &self.folder else {
            let shipped = shipped::mesh(file).map(String::from);
            return shipped.ok_or_else(|| String::from("no shipped mesh has this name"));
        };
        let inside = |part| matches!(part, Component::Normal(_) | Component::CurDir);
        if !Path::new(file).components().all(inside) {
            return Err(String::from("a mesh must lie in the scene's folder or below it"));
        }
        read_text(&folder.join(file), MESH_BYTES_MAX).map_err(|error| error.to_string())
    }
}

/// The folder for what the game keeps between runs: recordings and logs.
pub fn data_folder() -> Result<PathBuf, Error> {
    Ok(folders()?.data_dir().to_path_buf())
}

/// Where this system has the user's files of this program.
fn folders() -> Result<directories::ProjectDirs, Error> {
    directories::ProjectDirs::from("", "", "hapticbillard").ok_or(Error::NoHome)
}

/// The folder for the logs of games that were played.
pub fn logs_folder() -> Result<PathBuf, Error> {
    Ok(data_folder()?.join("logs"))
}

/// Makes a folder where there is none.
pub fn make_folder(path: &Path) -> Result<(), Error> {
    let failed = |reason| Error::Write { path: path.to_path_buf(), reason };
    fs::create_dir_all(path).map_err(failed)
}

/// Opens a file to write behind what is there; its folder is made where there is none.
pub fn append_to(path: &Path) -> Result<File, Error> {
    let failed = |reason| Error::Write { path: path.to_path_buf(), reason };
    if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        make_folder(folder)?;
    }
    File::options().create(true).append(true).open(path).map_err(failed)
}

/// The folder for the recordings of games that were played.
pub fn recordings_folder() -> Result<PathBuf, Error> {
    Ok(data_folder()?.join("recordings"))
}

/// Keeps a picture of a game in the folder for pictures, under the time of now. Returns where.
pub fn keep_picture(png: &[u8]) -> Result<PathBuf, Error> {
    let name = Path::new(&new_recording_name()).with_extension("png");
    let path = data_folder()?.join("pictures").join(name);
    write_whole(&path, png)?;
    Ok(path)
}

/// The file of what a player has set.
pub fn settings_file() -> Result<PathBuf, Error> {
    Ok(folders()?.config_dir().join("settings.toml"))
}

/// The file of the keys that a player has chosen.
pub fn keys_file() -> Result<PathBuf, Error> {
    Ok(folders()?.config_dir().join("keys.toml"))
}

/// What the processor of this machine calls itself, for reports of run time.
pub fn processor_name() -> String {
    let text = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let line = text.lines().find(|line| line.starts_with("model name"));
    let name = line.and_then(|line| line.split_once(':')).map(|(_, name)| name.trim().to_string());
    name.unwrap_or_else(|| format!("an unnamed {} processor", std::env::consts::ARCH))
}

/// The most memory that a process has had so far [KiB], from its status file under /proc; none if
/// it has ended or the system has no such file.
pub fn peak_memory_kib(status: &str) -> Option<u64> {
    memory_kib(status, "VmHWM")
}

/// The memory that a process has now [KiB].
pub fn resident_memory_kib(status: &str) -> Option<u64> {
    memory_kib(status, "VmRSS")
}

fn memory_kib(status: &str, key: &str) -> Option<u64> {
    let text = fs::read_to_string(status).ok()?;
    let line = text.lines().find(|line| line.starts_with(key))?;
    line.split_whitespace().nth(1)?.parse().ok()
}

/// Removes a folder in which nothing is.
pub fn remove_if_empty(path: &Path) {
    // One that is not there, or that holds something, stays as it is.
    let _ = fs::remove_dir(path);
}

/// Removes a file, if it is there.
pub fn remove(path: &Path) {
    // One that is not there is what is wanted.
    let _ = fs::remove_file(path);
}

/// The names of what is in a folder, in order; none if it cannot be read.
pub fn names_in(folder: &Path) -> Vec<String> {
    list(folder).unwrap_or_default()
}

/// The same.
///
/// # Errors
/// [`io::Error`] if the folder cannot be read.
pub fn list(folder: &Path) -> io::Result<Vec<String>> {
    let name = |entry: io::Result<fs::DirEntry>| Ok(entry?.file_name().to_string_lossy().into());
    let mut names: Vec<String> = fs::read_dir(folder)?.map(name).collect::<io::Result<_>>()?;
    names.sort();
    Ok(names)
}

/// A file name for a recording that begins now; names sort by age.
pub fn new_recording_name() -> String {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    recording_name(since.as_secs(), since.subsec_millis())
}

/// Now (UTC), as a log writes it.
pub fn time_of_now() -> String {
    let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    let ([year, month, day], [hour, minute, second]) = date_and_time(since.as_secs());
    let milliseconds = since.subsec_millis();
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}.{milliseconds:03}Z")
}

/// The date and time (UTC) of so many seconds after the beginning of 1970, as a file name.
fn recording_name(seconds: u64, milliseconds: u32) -> String {
    let ([year, month, day], [hour, minute, second]) = date_and_time(seconds);
    format!("{year:04}-{month:02}-{day:02}_{hour:02}{minute:02}{second:02}.{milliseconds:03}.jsonl")
}

/// Year, month and day, and hour, minute and second (UTC), of so many seconds after the beginning
/// of 1970.
fn date_and_time(seconds: u64) -> ([u64; 3], [u64; 3]) {
    // Days to years of 400, 100, 4 and 1, counted from the first of March (Fliegel and Van
    // Flandern 1968 do the same with other divisions).
    let days = seconds / 86_400 + 719_468;
    let (era, day_of_era) = (days / 146_097, days % 146_097);
    let year = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year + year / 4 - year / 100);
    let month_from_march = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * month_from_march + 2) / 5 + 1;
    let month = if month_from_march < 10 { month_from_march + 3 } else { month_from_march - 9 };
    let year = year + era * 400 + u64::from(month <= 2);
    ([year, month, day], [seconds / 3600 % 24, seconds / 60 % 60, seconds % 60])
}

/// Deletes all but the `keep` newest files that end in `.jsonl` in `folder`; names sort by age.
pub fn keep_newest(folder: &Path, keep: usize) -> Result<(), Error> {
    let failed = |reason| Error::Write { path: folder.to_path_buf(), reason };
    let mut names: Vec<PathBuf> = fs::read_dir(folder)
        .map_err(failed)?
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|extension| extension == "jsonl"))
        .collect();
    names.sort();
    let old = names.len().saturating_sub(keep);
    names[..old].iter().try_for_each(|path| fs::remove_file(path).map_err(failed))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn recordings_are_named_by_date_and_time() {
        assert_eq!(recording_name(0, 7), "1970-01-01_000000.007.jsonl");
        assert_eq!(recording_name(951_782_400, 0), "2000-02-29_000000.000.jsonl");
        assert_eq!(recording_name(1_798_761_599, 999), "2026-12-31_235959.999.jsonl");
    }
}
