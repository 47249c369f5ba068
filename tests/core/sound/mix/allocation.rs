//! Nothing is allocated after the beginning.

use super::rig::*;
use crate::counting::calls;
use glam::Vec3;
use hapticbillard::sound::{Listener, Mode, SoundClass};

#[test]
fn nothing_that_a_callback_does_allocates() {
    let mut mixer = cellar();
    let mut out = [[0.0; 2]; 512];
    let before = calls();
    for step in 0..300_u16 {
        let t = f32::from(step);
        let place = Vec3::new(libm::sinf(t), libm::cosf(t), 0.0);
        for k in 0..if step % 50 == 0 { 100 } else { 2 } {
            let mut onset = click(place, 0.2 + t * 0.01);
            onset.class = SoundClass::ALL[(usize::from(step) + k) % SoundClass::ALL.len()];
            mixer.start(mixer.frame() + k as u64 * 40, &onset);
        }
        for ball in 0..30 {
            mixer.roll(&rolling(ball, place * 0.5, Vec3::X));
        }
        mixer.set_listener(Listener { position_m: place * 0.01 * t, right: Vec3::Y });
        mixer.set_volume(0.01 * t);
        mixer.set_mode(if step % 100 < 50 { Mode::Headphones } else { Mode::Loudspeakers });
        mixer.mix(&mut out);
    }
    let work = mixer.work();
    assert_eq!(calls() - before, 0);
    assert!(work.stolen > 0 && work.merged > 0 && work.rolling == 24, "{work:?}");
}
