//! The sound actor: passes on what happens to a mixer that runs in the audio callback.
//!
//! It is a sink: outside the tick, outside the hash, and whatever becomes of it the game is the
//! same. Facts come as mail, the world and the listener through slots; what they sound like is
//! decided by the core, `hapticbillard::sound`. To the callback leads a ring, back come counters. A
//! thread of its own keeps the device open, and opens it again when it was lost.

mod backend;
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

use hapticbillard::physics::Snapshot;
use hapticbillard::scene::{Scene, SoundMode, SoundSection};
use hapticbillard::sound::{Foley, MixSettings, Mode, Room};
use std::sync::Arc;
use std::time::Duration;

/// The name of the actor in what the player is told.
pub const SOUND: &str = "sound";

/// How long a device that is not there is left alone before it is tried again.
const RETRY: Duration = Duration::from_secs(1);

/// What `scene` asks to be heard, in a game that runs at `pace` seconds a second; none if it asks
/// for nothing. `first` is the world before the first tick.
pub fn plan(scene: &Scene, foley: Foley, first: Arc<Snapshot>, pace: f64) -> Option<Plan> {
    let section = scene.sound.as_ref()?;
    let wiring = Wiring {
        backend: system(),
        device: section.device.clone(),
        settings: mix_settings(section),
        retry: RETRY,
        allocator: None,
    };
    let knobs = Arc::new(Knobs::new(section.volume as f32));
    Some(Plan { wiring, foley, first, pace, knobs })
}

/// How it is mixed; the rate is the stream's.
pub fn mix_settings(section: &SoundSection) -> MixSettings {
    MixSettings {
        mode: match section.mode {
            SoundMode::Headphones => Mode::Headphones,
            SoundMode::Loudspeakers => Mode::Loudspeakers,
        },
        room: section.room.then_some(Room::CELLAR),
        volume: section.volume as f32,
        ..MixSettings::default()
    }
}
