//! What a player has set, from one run to the next.

use hapticbillard::menu::Settings;
use hapticbillard_actors::files::{put_aside, read_if_there, settings_file, write_whole};
use std::path::{Path, PathBuf};

/// What is kept; the usual where nothing is.
pub fn load() -> Settings {
    match settings_file() {
        Ok(path) => load_from(&path),
        Err(error) => {
            log::warn!("nothing that is set is kept: {error}");
            Settings::default()
        }
    }
}

/// Keeps what is set; a player who cannot keep it plays all the same.
pub fn keep(settings: &Settings) {
    let keep = |path: PathBuf| write_whole(&path, settings.to_toml().as_bytes());
    if let Err(error) = settings_file().and_then(keep) {
        log::warn!("what is set is not kept: {error}");
    }
}

fn load_from(path: &Path) -> Settings {
    let text = match read_if_there(path) {
        Ok(Some(text)) => text,
        Ok(None) => return Settings::default(),
        Err(error) => {
            log::warn!("{error}; the usual settings are used");
            return Settings::default();
        }
    };
    Settings::parse(&text).unwrap_or_else(|problem| {
        let file = path.display();
        match put_aside(path) {
            Ok(aside) => log::warn!("{file}: {problem}; it is {} now", aside.display()),
            Err(error) => log::warn!("{file}: {problem}; it cannot be put aside: {error}"),
        }
        Settings::default()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use hapticbillard::menu::{GameChoice, Setting};
    use std::fs;

    #[test]
    fn what_is_set_is_there_the_next_time_and_a_broken_file_is_put_aside() {
        let folder = tempfile();
        let path = folder.join("settings.toml");
        assert_eq!(load_from(&path), Settings::default());
        let mut settings = Settings::default();
        settings.put(Setting::Volume, 3);
        settings.game = GameChoice::Snooker;
        write_whole(&path, settings.to_toml().as_bytes()).unwrap();
        assert_eq!(load_from(&path), settings);

        // An older file may lack keys.
        fs::write(&path, "game = \"nine_ball\"\n").unwrap();
        let older = Settings { game: GameChoice::NineBall, ..Settings::default() };
        assert_eq!(load_from(&path), older);

        fs::write(&path, "game = \"croquet\"\n").unwrap();
        assert_eq!(load_from(&path), Settings::default());
        assert!(!path.exists());
        assert_eq!(fs::read_to_string(folder.join("settings.toml.bad")).unwrap().len(), 17);
        fs::remove_dir_all(folder).unwrap();
    }

    fn tempfile() -> PathBuf {
        let name = format!("hapticbillard-settings-{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        folder
    }
}
