//! The keys that a player has chosen, from one run to the next.

use hapticbillard::input::Bindings;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::{keys_file, put_aside, read_if_there, write_whole};
use std::path::PathBuf;

/// A file of keys is shorter [bytes].
const BYTES_MAX: u64 = 64 << 10;

/// Where keys are kept; nowhere on a system without a folder for it.
pub struct KeptKeys {
    path: Option<PathBuf>,
    /// What is there cannot be understood.
    is_bad: bool,
}

impl KeptKeys {
    /// The keys of the player over the usual ones. The player is told of a file that cannot be
    /// understood, and plays with the usual ones.
    pub fn load() -> (Bindings, Option<String>, KeptKeys) {
        match keys_file() {
            Ok(path) => Self::load_from(path),
            Err(error) => {
                tracing::warn!("keys that are chosen are not kept: {error}");
                (Bindings::shipped(), None, KeptKeys { path: None, is_bad: false })
            }
        }
    }

    fn load_from(path: PathBuf) -> (Bindings, Option<String>, KeptKeys) {
        let usual = Bindings::shipped();
        let read = read_if_there(&path, BYTES_MAX).map_err(|error| error.to_string());
        let file = path.display().to_string();
        let read = read.and_then(|text| match text {
            Some(text) => usual.with_file(&file, &text).map_err(|error| error.to_string()),
            None => Ok(usual.clone()),
        });
        let is_bad = read.is_err();
        let kept = KeptKeys { path: Some(path), is_bad };
        match read {
            Ok(bindings) => (bindings, None, kept),
            Err(problem) => {
                tracing::warn!("{problem}; the usual keys are taken");
                (usual, Some(problem), kept)
            }
        }
    }

    /// Keeps what keys mean; a player who cannot keep it plays all the same. A file that could not
    /// be understood is put aside first: somebody has written it.
    pub fn keep(&mut self, bindings: &Bindings) {
        if let Err(error) = self.write(bindings) {
            tracing::warn!("the keys are not kept: {error}");
        }
    }

    fn write(&mut self, bindings: &Bindings) -> Result<(), Error> {
        let Some(path) = &self.path else { return Ok(()) };
        if self.is_bad {
            let aside = put_aside(path)?;
            tracing::info!("the keys that could not be read are {} now", aside.display());
            self.is_bad = false;
        }
        write_whole(path, bindings.to_toml().as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hapticbillard::input::{Action, Beside, Control, Key};
    use std::fs;

    #[test]
    fn keys_are_there_the_next_time_and_a_bad_file_is_told_and_stays() {
        let name = format!("hapticbillard-keys-{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        let path = folder.join("keys.toml");
        let load = || KeptKeys::load_from(path.clone());
        let (mut bindings, said, mut kept) = load();
        assert_eq!((&bindings, said), (&Bindings::shipped(), None));
        bindings.bind(Action::TurnLeft, Control::Key(Key::Letter('j')), Beside::Instead);
        kept.keep(&bindings);
        assert_eq!(load().0, bindings);

        // No TOML, no text, far too long, a name that there is not: the usual keys are taken, and
        // it is said where.
        let bad: [&[u8]; 4] = [b"turn_left = [\n", &[0xff, 0xfe], &[b'#'; 1 << 20], b"jump = []\n"];
        for bytes in bad {
            fs::write(&path, bytes).unwrap();
            let (usual, said, _) = load();
            assert_eq!(usual, Bindings::shipped());
            assert!(said.unwrap().contains("keys.toml"));
            assert_eq!(fs::read(&path).unwrap(), bytes, "it stays");
        }
        // Who chooses keys now finds the old file beside it.
        let (_, _, mut kept) = load();
        kept.keep(&bindings);
        assert_eq!(load().0, bindings);
        assert_eq!(fs::read(folder.join("keys.toml.bad")).unwrap(), b"jump = []\n");
        fs::remove_dir_all(folder).unwrap();
    }
}
