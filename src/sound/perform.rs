//! What runs in an audio callback.

use super::{Mixer, Told};

/// Things told between two frames at most: who tells more is heard in the next block.
const TOLD_MAX: usize = 8192;

/// Mixes the next frames, and on the way tells the mixer everything exactly at its frame, or at
/// once if that is over.
///
/// `next_before` gives the next thing whose frame lies before the one it is asked for, once each,
/// in order. Where a stream is cut into blocks changes no bit, and it is the same as
/// [`super::render_offline`] gives.
pub fn perform(
    mixer: &mut Mixer,
    mut next_before: impl FnMut(u64) -> Option<(u64, Told)>,
    out: &mut [[f32; 2]],
) {
    let end = mixer.frame() + out.len() as u64;
    let mut rest = out;
    for _ in 0..TOLD_MAX {
        let Some((at_frame, told)) = next_before(end) else { break };
        let ahead = at_frame.saturating_sub(mixer.frame());
        let (now, later) = rest.split_at_mut(rest.len().min(ahead as usize));
        mixer.mix(now);
        rest = later;
        mixer.tell(&told);
    }
    mixer.mix(rest);
}
