//! The hash over a state, by which two runs are held against each other.
//!
//! Guaranteed: the same build with the same inputs gives the same hash, whatever the thread
//! schedule. Floats enter by their bits, so the smallest difference shows.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};
use std::fmt;
use xxhash_rust::xxh3::Xxh3;

/// Collects a state; feed it in a fixed order.
#[derive(Clone, Default)]
pub struct StateHash(Xxh3);

impl StateHash {
    /// An empty hash.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds raw bytes.
    pub fn bytes(&mut self, bytes: &[u8]) {
        self.0.update(bytes);
    }

    /// Adds an integer; use it for ids, counts, enum discriminants and flags too.
    pub fn u64(&mut self, value: u64) {
        self.0.update(&value.to_le_bytes());
    }

    /// Adds a float by its bits.
    pub fn f64(&mut self, value: f64) {
        self.u64(value.to_bits());
    }

    /// Adds a vector.
    pub fn vec3(&mut self, value: DVec3) {
        value.to_array().into_iter().for_each(|x| self.f64(x));
    }

    /// Adds a rotation.
    pub fn quat(&mut self, value: DQuat) {
        value.to_array().into_iter().for_each(|x| self.f64(x));
    }

    /// The hash so far.
    pub fn finish(&self) -> Digest {
        Digest(self.0.digest())
    }
}

/// A finished [`StateHash`]; 16 hexadecimal digits in text.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Digest(pub u64);

impl fmt::Display for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

impl Serialize for Digest {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Digest {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        u64::from_str_radix(&text, 16)
            .map(Digest)
            .map_err(|_| D::Error::custom(format!("'{text}' is no hash of 16 hexadecimal digits")))
    }
}

/// A seed for one part of a game, so that parts do not share their randomness.
///
/// SplitMix64 (Steele, Lea and Flood 2014) over seed and part.
pub fn seed_of(seed: u64, part: u64) -> u64 {
    let mut z = seed.wrapping_add(part.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
