//! Full scale and no further.

use super::rig::*;
use glam::Vec3;
use hapticbillard::sound::{MixSettings, Onset, SoundClass};

/// Full scale less 3 dB.
const KNEE: f32 = 0.707_9;

#[test]
fn nothing_is_louder_than_full_scale() {
    for speed_m_s in [1.0, 10.0, 1e3, 1e9, f32::MAX] {
        let mut mixer = field();
        mixer.set_volume(4.0);
        for k in 0..64_u8 {
            let place = Vec3::new(0.1, 0.05 + f32::from(k) * 0.001, 0.0);
            let class = if k < 32 { SoundClass::BallClick } else { SoundClass::Cushion };
            mixer.start(u64::from(k), &Onset { class, ..click(place, speed_m_s) });
        }
        let heard = hear(&mut mixer, 9_600);
        let loudest = peak(&channel(&heard, 0)).max(peak(&channel(&heard, 1)));
        assert!(loudest <= 0.99, "{speed_m_s} m/s: {loudest}");
        assert!(loudest > if speed_m_s < 5.0 { 0.5 } else { 0.95 }, "{speed_m_s} m/s: {loudest}");
    }
}

#[test]
fn below_the_knee_nothing_is_changed() {
    let heard = |speed_m_s: f32, volume: f32| {
        let mut mixer = field();
        mixer.set_volume(volume);
        hear(&mut mixer, 2_000);
        channel(&heard(&mut mixer, &click(Vec3::Y, speed_m_s)), 0)
    };
    let (half, whole) = (heard(14.0, 0.5), heard(14.0, 1.0));
    assert!((0.4..KNEE).contains(&peak(&whole)), "{}", peak(&whole));
    // A factor of two is exact in binary numbers, whatever it is multiplied with.
    for (half, whole) in half.iter().zip(&whole) {
        assert_eq!(2.0 * half, *whole);
    }
}

#[test]
fn after_a_shout_it_is_transparent_again() {
    let (mut shouted, mut calm) = (field(), field());
    for place in [Vec3::Y * 0.1, Vec3::X * 0.1, Vec3::Z * 0.1] {
        shouted.start(0, &click(place, 20.0));
    }
    hear(&mut shouted, 24_000);
    hear(&mut calm, 24_000);
    let onset = click(Vec3::Y, 2.0);
    assert_eq!(heard(&mut shouted, &onset), heard(&mut calm, &onset));
}

#[test]
fn both_ears_are_held_back_alike() {
    // Else the picture would jump to the quieter side: the same sound, so soft that it is not held
    // back at all, has the same ratio of left to right.
    let heard = |volume: f32| {
        let settings = MixSettings { volume, ..MixSettings::default() };
        heard(&mut with(settings), &click(Vec3::new(0.3, 0.6, 0.0), 30.0))
    };
    let (held, free) = (heard(1.0), heard(1.0 / 1024.0));
    assert!(free.iter().flatten().all(|x| x.abs() < KNEE));
    let most = peak(&channel(&free, 0)).max(peak(&channel(&free, 1)));
    assert!(1024.0 * most > 1.0, "it is held back: {most}");
    for ([left, right], [free_left, free_right]) in held.iter().zip(&free) {
        let skew = left * free_right - right * free_left;
        assert!(skew.abs() <= 1e-6 * (left * free_right).abs().max(1e-12), "{left} {right}");
    }
}
