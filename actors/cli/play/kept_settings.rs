//! What a player has set, from one run to the next.

use hapticbillard::menu::Settings;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::{put_aside, read_if_there, settings_file, write_whole};
use std::path::PathBuf;

/// A file of settings is shorter [bytes].
const BYTES_MAX: u64 = 64 << 10;

/// Where settings are kept; nowhere if what is there can be neither read nor put aside.
pub struct Kept(Option<PathBuf>);

impl Kept {
    /// What was kept, and where it will be; the usual where nothing was.
    pub fn load() -> (Settings, Kept) {
        match settings_file() {
            Ok(path) => Self::load_from(path),
            Err(error) => {
                tracing::warn!("nothing that is set is kept: {error}");
                (Settings::default(), Kept(None))
            }
        }
    }

    /// A file that cannot be understood is put aside: somebody may have written it.
    fn load_from(path: PathBuf) -> (Settings, Kept) {
        let problem = match read_if_there(&path, BYTES_MAX) {
            Ok(None) => return (Settings::default(), Kept(Some(path))),
            Ok(Some(text)) => match Settings::parse(&text) {
                Ok(settings) => return (settings, Kept(Some(path))),
                Err(problem) => format!("{}: {problem}", path.display()),
            },
            Err(error) => error.to_string(),
        };
        match put_aside(&path) {
            Ok(aside) => {
                tracing::warn!("{problem}; it is {} now", aside.display());
                (Settings::default(), Kept(Some(path)))
            }
            Err(error) => {
                tracing::warn!("{problem}; it stays, and nothing that is set is kept: {error}");
                (Settings::default(), Kept(None))
            }
        }
    }

    /// Keeps what is set; a player who cannot keep it plays all the same.
    pub fn keep(&self, settings: &Settings) {
        let Some(path) = &self.0 else { return };
        if let Err(error) = Self::write(path, settings) {
            tracing::warn!("what is set is not kept: {error}");
        }
    }

    fn write(path: &std::path::Path, settings: &Settings) -> Result<(), Error> {
        write_whole(path, settings.to_toml().as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hapticbillard::menu::{GameChoice, Setting};
    use std::fs;

    #[test]
    fn what_is_set_is_there_the_next_time_and_a_broken_file_is_put_aside() {
        let name = format!("hapticbillard-settings-{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        let path = folder.join("settings.toml");
        let load = || Kept::load_from(path.clone());
        assert_eq!(load().0, Settings::default());
        let mut settings = Settings::default();
        settings.put(Setting::Volume, 3);
        settings.game = GameChoice::Snooker;
        load().1.keep(&settings);
        assert_eq!(load().0, settings);

        // An older file may lack keys.
        fs::write(&path, "game = \"nine_ball\"\n").unwrap();
        let older = Settings { game: GameChoice::NineBall, ..Settings::default() };
        assert_eq!(load().0, older);

        // No game, no text, far too long: each is there still, under another name.
        let bad = [b"game = \"croquet\"\n".to_vec(), vec![0xff, 0xfe], vec![b'#'; 1 << 20]];
        for (n, bytes) in bad.iter().enumerate() {
            fs::write(&path, bytes).unwrap();
            let (settings, kept) = load();
            assert_eq!(settings, Settings::default());
            kept.keep(&settings);
            let ending = if n == 0 { "bad".to_string() } else { format!("bad{}", n + 1) };
            let aside = folder.join(format!("settings.toml.{ending}"));
            assert_eq!(fs::read(aside).unwrap(), *bytes);
        }

        // What can be neither read nor put aside is not written over.
        fs::remove_file(&path).unwrap();
        for n in 4..=20 {
            fs::write(folder.join(format!("settings.toml.bad{n}")), "").unwrap();
        }
        fs::write(&path, "game = 3\n").unwrap();
        let (settings, kept) = load();
        kept.keep(&settings);
        assert_eq!(fs::read_to_string(&path).unwrap(), "game = 3\n");
        fs::remove_dir_all(folder).unwrap();
    }
}
