//! What runs in an audio callback.

use super::{Mixer, Told};

/// Sounds begun in one call at most. After the game has stood still, all that was told meanwhile
/// may lie on one frame; to begin a sound costs some microseconds, and four times as many as there
/// are slots are enough for the ear.
pub const STARTS_MAX: usize = 256;
/// Things told in one call at most: twice what all balls of a table say in 20 ms.
pub const TOLD_MAX: usize = 1024;

/// Mixes the next frames, and on the way tells the mixer everything exactly at its frame, or at
/// once if that is over.
///
/// `next_before` gives the next thing whose frame lies before the one it is asked for, once each,
/// in order. Where a stream is cut into blocks changes no bit, and it is the same as
/// [`super::render_offline`] gives, as long as no call comes to [`STARTS_MAX`] or [`TOLD_MAX`]:
/// then the rest waits for the next call, so that none takes longer than it sounds.
pub fn perform(
    mixer: &mut Mixer,
    mut next_before: impl FnMut(u64) -> Option<(u64, Told)>,
    out: &mut [[f32; 2]],
) {
    let end = mixer.frame() + out.len() as u64;
    let mut rest = out;
    let mut starts = 0;
    for _ in 0..TOLD_MAX {
        if starts == STARTS_MAX {
            break;
        }
        let Some((at_frame, told)) = next_before(end) else { break };
        let ahead = at_frame.saturating_sub(mixer.frame());
        let (now, later) = rest.split_at_mut(rest.len().min(ahead as usize));
        mixer.mix(now);
        rest = later;
        mixer.tell(&told);
        starts += usize::from(matches!(told, Told::Start { .. }));
    }
    mixer.mix(rest);
}
