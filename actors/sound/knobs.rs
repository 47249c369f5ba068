//! Volume, mute and mode, turned by the window and looked at by the actor; and what the actor shows
//! there.

use hapticbillard::sound::Mode;
use std::sync::atomic::{AtomicBool, AtomicU32, AtomicU64, Ordering};

/// How much a press of a key changes the volume, as a share of what the scene says.
const STEP: f32 = 0.1;
/// The loudest share, and the loudest that a mixer plays.
const SHARE_MAX: f32 = 2.0;
const VOLUME_MAX: f32 = 4.0;

/// What a player can turn.
#[derive(Debug)]
pub struct Knobs {
    /// What the scene says; 1 is as in the world.
    scene: f32,
    share: AtomicU32,
    is_muted: AtomicBool,
    /// Mixed for loudspeakers, not for headphones.
    is_for_loudspeakers: AtomicBool,
    ran_dry: AtomicU64,
}

impl Knobs {
    /// For a scene with this volume and mode.
    pub fn new(scene: f32, mode: Mode) -> Self {
        // A scene that begins in silence can be turned up all the same.
        let (scene, share) = if 0.0 < scene { (scene, 1.0_f32) } else { (1.0, 0.0) };
        Knobs {
            scene,
            share: AtomicU32::new(share.to_bits()),
            is_muted: AtomicBool::new(false),
            is_for_loudspeakers: AtomicBool::new(mode == Mode::Loudspeakers),
            ran_dry: AtomicU64::new(0),
        }
    }

    /// How often the device ran dry.
    pub fn ran_dry(&self) -> u64 {
        self.ran_dry.load(Ordering::Relaxed)
    }

    /// It ran dry so many times more.
    pub fn note_ran_dry(&self, times: u64) {
        self.ran_dry.fetch_add(times, Ordering::Relaxed);
    }

    /// What it is mixed for.
    pub fn mode(&self) -> Mode {
        if self.is_for_loudspeakers.load(Ordering::Relaxed) {
            Mode::Loudspeakers
        } else {
            Mode::Headphones
        }
    }

    /// From headphones to loudspeakers, or back.
    pub fn change_mode(&self) {
        self.is_for_loudspeakers.fetch_xor(true, Ordering::Relaxed);
    }

    /// What is heard: 0 while it is muted.
    pub fn volume(&self) -> f32 {
        if self.is_muted() { 0.0 } else { self.scene * self.share() }
    }

    /// Whether it is muted.
    pub fn is_muted(&self) -> bool {
        self.is_muted.load(Ordering::Relaxed)
    }

    /// What is set, as a share of what the scene says.
    pub fn share(&self) -> f32 {
        f32::from_bits(self.share.load(Ordering::Relaxed))
    }

    /// A step louder, or softer; whoever turns it wants to hear it.
    pub fn turn(&self, is_louder: bool) {
        let step = if is_louder { STEP } else { -STEP };
        self.set(self.share() + step);
    }

    /// So much of what the scene says, as far as a mixer plays so loud.
    pub fn set(&self, share: f32) {
        // In whole steps, so that up and down lead back.
        let share = (share / STEP).round() * STEP;
        let most = (SHARE_MAX.min(VOLUME_MAX / self.scene) / STEP + 1e-3).floor() * STEP;
        self.share.store(share.clamp(0.0, most).to_bits(), Ordering::Relaxed);
        self.is_muted.store(false, Ordering::Relaxed);
    }

    /// Silent, or as before.
    pub fn mute(&self) {
        self.is_muted.fetch_xor(true, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn up_and_down_lead_back_and_mute_remembers() {
        let knobs = Knobs::new(3.0, Mode::Headphones);
        knobs.turn(true);
        knobs.turn(false);
        assert_eq!(knobs.volume(), 3.0);
        for _ in 0..30 {
            knobs.turn(true);
        }
        // A step more would be louder than a mixer plays.
        assert!((knobs.share() - 1.3).abs() < 1e-6, "{}", knobs.share());
        let loudest = knobs.volume();
        assert!(loudest <= VOLUME_MAX && VOLUME_MAX < loudest + 3.0 * STEP);
        knobs.mute();
        assert_eq!(knobs.volume(), 0.0);
        knobs.mute();
        assert_eq!(knobs.volume(), loudest);
        knobs.mute();
        for _ in 0..30 {
            knobs.turn(false);
        }
        assert_eq!((knobs.volume(), knobs.is_muted()), (0.0, false));
        let silent = Knobs::new(0.0, Mode::Headphones);
        assert_eq!(silent.volume(), 0.0);
        silent.turn(true);
        assert!(silent.volume() > 0.0);
    }

    #[test]
    fn the_mode_goes_there_and_back() {
        let knobs = Knobs::new(1.0, Mode::Loudspeakers);
        assert_eq!(knobs.mode(), Mode::Loudspeakers);
        knobs.change_mode();
        assert_eq!(knobs.mode(), Mode::Headphones);
        knobs.change_mode();
        assert_eq!(knobs.mode(), Mode::Loudspeakers);
    }
}
