//! Games that are disturbed on purpose, and held against the same games that nobody disturbed.
//!
//! A game is played in lockstep first. Then actors play it, on any number of threads, while faults
//! strike them ([`Fault`](crate::crew::Fault)) and while their threads are jostled ([`Jostle`]).
//! What must come of it says [`survival`]: the game is the same, bit by bit, with every event and
//! every byte of its recording; or it stops in order, and everything up to there is on disk.

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
