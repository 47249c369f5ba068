//! What a mixer is told, in the order of its frames, by a callback and by a file alike.

use super::{Listener, Mixer, Onset, Rolling};

/// Something that a mixer is told, and from which frame on it holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Told {
    /// The frame of the stream; one that is mixed already means at once.
    pub at_frame: u64,
    /// What.
    pub what: What,
}

/// What a mixer is told. A plain value, for a ring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum What {
    /// A sound begins.
    Onset(Onset),
    /// The newest state of a ball.
    Rolling(Rolling),
    /// Where it is heard from.
    Listener(Listener),
    /// Factor of the whole.
    Volume(f32),
}

/// Things told between two frames at most: who tells more is heard in the next block.
const TOLD_MAX: usize = 4096;

/// Mixes the next frames, and on the way tells the mixer everything exactly at its frame.
///
/// `next_before` gives the next thing whose frame lies before the one it is asked for, once each, in
/// order. It is the same for a ring and for a list, and so is what is heard: where a stream is cut
/// into blocks changes no bit.
pub fn perform(
    mixer: &mut Mixer,
    mut next_before: impl FnMut(u64) -> Option<Told>,
    out: &mut [[f32; 2]],
) {
    let end = mixer.frame() + out.len() as u64;
    let mut rest = out;
    for _ in 0..TOLD_MAX {
        let Some(told) = next_before(end) else { break };
        let ahead = told.at_frame.saturating_sub(mixer.frame());
        let (now, later) = rest.split_at_mut(rest.len().min(ahead as usize));
        if !now.is_empty() {
            mixer.mix(now);
        }
        rest = later;
        tell(mixer, &told);
    }
    if !rest.is_empty() {
        mixer.mix(rest);
    }
}

fn tell(mixer: &mut Mixer, told: &Told) {
    match &told.what {
        What::Onset(onset) => mixer.start(told.at_frame, onset),
        What::Rolling(rolling) => mixer.roll(rolling),
        What::Listener(listener) => mixer.set_listener(*listener),
        What::Volume(volume) => mixer.set_volume(*volume),
    }
}
