//! Volume and mute, turned by the window and looked at by the actor.

use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

/// How much a press of a key changes the volume.
const STEP: f32 = 0.1;
/// The loudest.
const MOST: f32 = 2.0;

/// What a player can turn.
#[derive(Debug)]
pub struct Knobs {
    volume: AtomicU32,
    is_muted: AtomicBool,
}

impl Knobs {
    /// With this volume: 1 is as in the world.
    pub fn new(volume: f32) -> Self {
        Knobs { volume: AtomicU32::new(volume.to_bits()), is_muted: AtomicBool::new(false) }
    }

    /// What is heard: 0 while it is muted.
    pub fn volume(&self) -> f32 {
        if self.is_muted() { 0.0 } else { self.set() }
    }

    /// Whether it is muted.
    pub fn is_muted(&self) -> bool {
        self.is_muted.load(Ordering::Relaxed)
    }

    fn set(&self) -> f32 {
        f32::from_bits(self.volume.load(Ordering::Relaxed))
    }

    /// A step louder, or softer; whoever turns it wants to hear it.
    pub fn turn(&self, is_louder: bool) {
        let step = if is_louder { STEP } else { -STEP };
        // In whole steps, so that up and down lead back.
        let steps = ((self.set() + step) / STEP).round();
        self.volume.store((steps * STEP).clamp(0.0, MOST).to_bits(), Ordering::Relaxed);
        self.is_muted.store(false, Ordering::Relaxed);
    }

    /// Silent, or as before.
    pub fn mute(&self) {
        self.is_muted.fetch_xor(true, Ordering::Relaxed);
    }
}
