//! The sound actor: passes on what happens to a mixer that runs in the audio callback.
//!
//! It is a sink: outside the tick, outside the hash, and whatever becomes of it the game is the
//! same. Facts come as mail, the world and the listener through slots; what they sound like is
//! decided by the core, `hapticbillard::sound`. To the callback leads a ring, back come counters. A
//! thread of its own keeps the device open, and opens it again when it was lost.

mod backend;
#[cfg(feature = "sound")]
pub mod bank_files;
mod callback;
#[cfg(feature = "sound")]
mod card;
mod control;
mod keeper;
mod knobs;
mod line;
mod score;
mod seat;
#[cfg(feature = "sound")]
mod wave;

pub use backend::{Backend, NoSound, NotBuilt, Output, Playing, system};
pub use callback::{Callback, Counters, Due, Loss, RING};
pub use control::{Sound, Work, Worked};
pub use keeper::{Joins, Keeper, keep};
pub use knobs::Knobs;
pub use line::{Line, News, Open, Wiring};
pub use score::{Score, score, score_of_facts};
pub use seat::{Held, Plan, Ports, Seat, Started};
#[cfg(feature = "sound")]
pub use wave::{Written, write_wave};

use crate::files::data_folder;
use hapticbillard::physics::Snapshot;
use hapticbillard::scene::{Scene, SoundMode, SoundSection};
use hapticbillard::sound::{Bank, Foley, MixSettings, Mode, Room};
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

/// The name of the actor in what the player is told.
pub const SOUND: &str = "sound";

/// How long a device that is not there is left alone before it is tried again.
const RETRY: Duration = Duration::from_secs(1);

/// Where a player's own recordings are looked for, in the folder of the player's data.
const RECORDINGS: &str = "sounds";

/// What `scene` asks to be heard, in a game that runs at `pace` seconds a second; none if it asks
/// for nothing. `first` is the world before the first tick; what the scene names is seen from
/// `folder`.
///
/// # Errors
/// [`NoSound`] if its recordings are not in that folder or below.
pub fn plan(
    scene: &Scene,
    folder: Option<&Path>,
    foley: Foley,
    first: Arc<Snapshot>,
    pace: f64,
) -> Result<Option<Plan>, NoSound> {
    let Some(section) = &scene.sound else { return Ok(None) };
    let wiring = Wiring {
        backend: system(),
        device: section.device.clone(),
        settings: mix_settings(section),
        recordings: recordings(section, folder)?,
        retry: RETRY,
        allocator: None,
    };
    let knobs = Arc::new(Knobs::new(section.volume as f32, mode(section)));
    Ok(Some(Plan { wiring, foley, first, pace, knobs }))
}

/// Scenes come from anywhere, so their recordings must lie in the scene's own folder or below. A
/// scene that names none gets the player's, if there are any.
fn recordings(section: &SoundSection, folder: Option<&Path>) -> Result<Option<PathBuf>, NoSound> {
    let Some(name) = &section.recordings else {
        let own = data_folder().ok().map(|folder| folder.join(RECORDINGS));
        return Ok(own.filter(|folder| folder.is_dir()));
    };
    let inside = |part| matches!(part, Component::Normal(_) | Component::CurDir);
    if !Path::new(name).components().all(inside) {
        return Err(NoSound::Recordings { name: name.clone() });
    }
    Ok(Some(folder.unwrap_or(Path::new("")).join(name)))
}

/// The recordings of a folder, for a stream of this rate [Hz]; what cannot be used is said in the
/// log, and synthesised.
///
/// # Errors
/// [`NoSound::NoRecordings`] if the folder cannot be listed.
pub fn bank(recordings: Option<&Path>, rate_hz: u32) -> Result<Bank, NoSound> {
    #[cfg(feature = "sound")]
    if let Some(folder) = recordings {
        let (bank, refused) = bank_files::read_folder(folder, rate_hz)?;
        refused.iter().for_each(|refused| tracing::warn!("{SOUND}: {refused}"));
        return Ok(bank);
    }
    let _ = (recordings, rate_hz);
    Ok(Bank::default())
}

/// How it is mixed; the rate is the stream's.
pub fn mix_settings(section: &SoundSection) -> MixSettings {
    MixSettings {
        mode: mode(section),
        room: section.room.then_some(Room::CELLAR),
        room_tone: section.room_tone,
        volume: section.volume as f32,
        ..MixSettings::default()
    }
}

fn mode(section: &SoundSection) -> Mode {
    match section.mode {
        SoundMode::Headphones => Mode::Headphones,
        SoundMode::Loudspeakers => Mode::Loudspeakers,
    }
}
