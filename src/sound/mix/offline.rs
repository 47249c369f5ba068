//! Mixing without a sound card, as fast as it goes.

use super::{Listener, Mixer, Mode};
use crate::sound::{Onset, Rolling};

/// One thing that a mixer is told: a plain value that a ring can carry.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Told {
    /// [`Mixer::start`].
    Start {
        /// When it leaves its place.
        at_frame: u64,
        /// What.
        onset: Onset,
    },
    /// [`Mixer::roll`].
    Roll(Rolling),
    /// [`Mixer::set_listener`].
    Listener(Listener),
    /// [`Mixer::set_volume`].
    Volume(f32),
    /// [`Mixer::set_mode`].
    Mode(Mode),
}

impl Mixer {
    /// Takes one of the things that a mixer can be told.
    pub fn tell(&mut self, told: &Told) {
        match told {
            Told::Start { at_frame, onset } => self.start(*at_frame, onset),
            Told::Roll(rolling) => self.roll(rolling),
            Told::Listener(listener) => self.set_listener(*listener),
            Told::Volume(volume) => self.set_volume(*volume),
            Told::Mode(mode) => self.set_mode(*mode),
        }
    }
}

/// Mixes up to frame `end`, and hands the frames on in runs of up to 4 096. Tells each thing of
/// `score` at its frame, or at once if that is over; frames must not fall, and what is due at `end`
/// or later is left.
///
/// # Errors
/// What `hand_on` says ends it.
pub fn render_offline<E>(
    mixer: &mut Mixer,
    score: impl IntoIterator<Item = (u64, Told)>,
    end: u64,
    mut hand_on: impl FnMut(&[[f32; 2]]) -> Result<(), E>,
) -> Result<(), E> {
    let mut run = vec![[0.0; 2]; 4_096];
    let mut mix_to = |mixer: &mut Mixer, frame: u64| {
        while mixer.frame() < frame {
            let frames = (frame - mixer.frame()).min(run.len() as u64) as usize;
            mixer.mix(&mut run[..frames]);
            hand_on(&run[..frames])?;
        }
        Ok(())
    };
    for (frame, told) in score {
        if frame >= end {
            break;
        }
        mix_to(mixer, frame)?;
        mixer.tell(&told);
    }
    mix_to(mixer, end)
}
