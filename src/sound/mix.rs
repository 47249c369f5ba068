//! Voices become two channels, as a head at the listener's place would hear them.

mod listener;
mod room;
mod settings;

pub use listener::Listener;
pub use room::Room;
pub use settings::{MixSettings, Mode};

use super::{Onset, Rolling};

/// Sounds that begin, balls that roll and a listener in; two channels out.
pub struct Mixer {
    settings: MixSettings,
    listener: Listener,
    frame: u64,
    begun: Vec<(u64, Onset)>,
}

/// Sounds at once, at most.
pub const VOICES_MAX: usize = 64;

impl Mixer {
    /// A mixer in silence; everything it will ever need is allocated here.
    pub fn new(settings: MixSettings) -> Mixer {
        let begun = Vec::with_capacity(VOICES_MAX);
        Mixer { settings, listener: Listener::default(), frame: 0, begun }
    }

    /// Begins a sound that leaves its place at `at_frame`; the way to the ears comes on top.
    pub fn start(&mut self, at_frame: u64, onset: &Onset) {
        if self.begun.len() < VOICES_MAX {
            self.begun.push((at_frame.max(self.frame), *onset));
        }
    }

    /// The newest state of one ball; a ball that is not told of for 100 ms fades.
    pub fn roll(&mut self, _rolling: &Rolling) {}

    /// Where it is heard from now on.
    pub fn set_listener(&mut self, listener: Listener) {
        self.listener = listener;
    }

    /// Factor of the whole, 0 to 4.
    pub fn set_volume(&mut self, volume: f32) {
        self.settings.volume = volume;
    }

    /// The next frame that is mixed.
    pub fn frame(&self) -> u64 {
        self.frame
    }

    /// The next frames: left and right, 1 is full scale.
    pub fn mix(&mut self, out: &mut [[f32; 2]]) {
        for sample in out {
            *sample = [0.0; 2];
            for (at, onset) in &self.begun {
                let rel = onset.position_m - self.listener.position_m;
                let gain = self.settings.volume * 0.02 / rel.length().max(0.3);
                let delay_s = rel.length() / 343.0;
                let t = (self.frame as f32 - *at as f32) / self.settings.rate_hz - delay_s;
                if (0.0..300e-6).contains(&t) {
                    let x = gain * onset.speed_m_s * libm::sinf(t / 300e-6 * 2.0 * 3.141_592_7);
                    sample[0] += x;
                    sample[1] += x;
                }
            }
            self.frame += 1;
        }
        let (frame, second) = (self.frame, self.settings.rate_hz as u64);
        self.begun.retain(|(at, _)| at + second > frame);
    }
}
