//! Games that are disturbed on purpose, and held against the same games that nobody disturbed.
//!
//! A game is played in lockstep first. Then actors play it, on any number of threads, while faults
//! strike them ([`Fault`](crate::crew::Fault)) and while their threads are jostled ([`Jostle`]).
//! What must come of it says [`survival`]: the game is the same, bit by bit, with every event and
//! every byte of its recording; or it stops in order, and everything up to there is on disk.
//!
//! # Who survives what
//!
//! | | killed, or panics | stalls, or answers late | is flooded with messages |
//! |---|---|---|---|
//! | computer player, input | another one, the game is the same (1) | the same (1) | the same (1) |
//! | recorder | another one goes on in the same file, byte for byte (1, 2) | (1) | (1) |
//! | sound | another one, heard again; the game is the same (3, 4) | (4) | (4) |
//! | haptic control | no force, another one, a soft start; the same game (4, 5) | (4) | (4) |
//! | haptic servo | no force; the player is told (5) | the force fades (5) | it reads no messages |
//! | window | the game ends in order (6); one that lags loses pictures (7) | (7) | (7) |
//! | all others, see below | the game stops in order, recorded up to there (1, 3) | (1) | (1) |
//! | haptic device | no force; in a stroke the game pauses, then the mouse (5, 8) | (5) | |
//! | sound card | silence, and sound again when it is back (3) | (9) | |
//! | disk | the game goes on, and writes what is missing when it can (2) | the game waits | |
//!
//! All others are physics, rules, event manager, conductor and observers: what they hold may not be
//! lost, and kameo can lose the queue of an actor that it restarts. Where a number stands alone the
//! game is the same.
//!
//! Tests: 1 `soak` (seeds choose who, what and when; the program's `soak --faults` is the same),
//! 2 `supervision`, 3 `failures`, 4 `soak` with sound and a hand, 5 `contact`, 6 `game_thread`,
//! 7 `failures` and `load`, 8 `hand_over`, 9 `sound_line`; all under `tests/runtime` but 6.

mod chatter;
mod jostle;
mod plan;
mod process;
mod saboteur;
mod trial;
mod witness;

pub use chatter::Chatter;
pub use jostle::Jostle;
pub use plan::{FaultKind, Planned, Survival, Victim, faults, survival};
pub use process::{Growth, MOMENTS_MIN, Use};
pub use saboteur::{Saboteur, Struck};
pub use trial::{Ended, Played, Reference, Trial, Wrong, end_of, play, reference};
pub use witness::{Seen, Witness};
