//! Recordings and their replay.
