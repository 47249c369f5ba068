//! Sixty-four voices and no more.

use super::rig::*;
use glam::Vec3;
use hapticbillard::sound::{Mixer, SoundClass, VOICES_MAX};

/// On a half circle in front of the head, each at its own place.
fn around(k: usize) -> Vec3 {
    let angle = k as f32 * 0.04;
    Vec3::new(libm::cosf(angle), libm::sinf(angle), 0.0)
}

/// A pocket sounds long enough for a full house.
fn full_house() -> Mixer {
    let mut mixer = field();
    for k in 0..VOICES_MAX {
        let mut onset = click(around(k), 1.0 + k as f32 * 0.01);
        onset.class = SoundClass::Pocket;
        onset.seed = k as u32;
        mixer.start(k as u64 * 10, &onset);
    }
    hear(&mut mixer, 800);
    assert_eq!(mixer.work().voices, VOICES_MAX);
    assert_eq!((mixer.work().stolen, mixer.work().merged), (0, 0));
    mixer
}

#[test]
fn the_sixty_fifth_voice_takes_the_place_of_the_quietest_without_a_click() {
    let (mut mixer, mut without) = (full_house(), full_house());
    // Far away in front of it: nothing of itself is heard for 58 ms.
    let mut loud = click(Vec3::Y * 20.0, 20.0);
    loud.class = SoundClass::Cushion;
    mixer.start(mixer.frame(), &loud);
    assert_eq!((mixer.work().voices, mixer.work().stolen), (VOICES_MAX, 1));
    let (with, without) = (hear(&mut mixer, 2_700), hear(&mut without, 2_700));
    for ear in 0..2 {
        let (with, without) = (channel(&with, ear), channel(&without, ear));
        let missing: Vec<f32> = with.iter().zip(&without).map(|(a, b)| b - a).collect();
        assert!(peak(&missing) > 0.0);
        // The quietest it was, and it left within 3 ms, not at once.
        assert!(peak(&missing) < 0.1 * peak(&without));
        assert!(steepest(&with) < 1.05 * steepest(&without));
        assert!(peak(&missing[..2]) < 0.1 * peak(&missing));
    }
}

#[test]
fn a_sound_that_would_be_the_quietest_does_not_begin() {
    let (mut mixer, mut without) = (full_house(), full_house());
    let mut quiet = click(Vec3::Y * 20.0, 0.05);
    quiet.class = SoundClass::Chalk;
    mixer.start(mixer.frame(), &quiet);
    assert_eq!(mixer.work().stolen, 1);
    assert_eq!(hear(&mut mixer, 20_000), hear(&mut without, 20_000));
}

#[test]
fn hits_within_a_millisecond_are_one_only_when_there_is_no_slot() {
    let mut mixer = field();
    for k in 0..VOICES_MAX {
        mixer.start(100 + k as u64 % 40, &click(around(k), 1.0));
    }
    assert_eq!((mixer.work().voices, mixer.work().merged), (VOICES_MAX, 0));
    mixer.start(120, &click(around(5), 1.0));
    assert_eq!((mixer.work().voices, mixer.work().merged, mixer.work().stolen), (VOICES_MAX, 1, 0));
    // Two milliseconds later nothing is like it.
    mixer.start(300, &click(around(5), 1.0));
    assert_eq!((mixer.work().merged, mixer.work().stolen), (1, 1));
}

#[test]
fn a_merged_hit_is_heard_with_the_power_of_both() {
    // All but one so far away that they come much later.
    let levels: Vec<f64> = [false, true]
        .map(|twice| {
            let mut mixer = field();
            mixer.start(200, &click(Vec3::Y, 1.0));
            for k in 1..VOICES_MAX {
                mixer.start(0, &click(around(k) * 60.0, 4.0 + k as f32));
            }
            if twice {
                mixer.start(210, &click(Vec3::Y, 1.0));
                assert_eq!(mixer.work().merged, 1);
            }
            energy(&channel(&hear(&mut mixer, 1_500), 0)).sqrt()
        })
        .into();
    let more = decibel(levels[1] / levels[0]);
    assert!((more - 3.0).abs() < 0.1, "{more} dB");
}

#[test]
fn voices_end_free_their_slots_and_leave_no_slow_numbers() {
    let mut mixer = full_house();
    hear(&mut mixer, 100_000);
    assert_eq!(mixer.work().voices, 0);
    let silence = hear(&mut mixer, 20_000);
    assert!(peak(&channel(&silence, 0)) < 1e-9);

    // The tails of the filters of a room fall for ever.
    let mut mixer = cellar();
    mixer.start(0, &click(Vec3::Y, 1.0));
    mixer.roll(&rolling(1, Vec3::Y, Vec3::X));
    let out = hear(&mut mixer, 500_000);
    assert!(!out.iter().flatten().any(|x| x.is_subnormal()));
    assert!(peak(&channel(&out[400_000..], 0)) < 1e-15);
}

#[test]
fn what_is_too_soft_to_be_heard_takes_no_slot() {
    let mut mixer = field();
    for k in 0..2 * VOICES_MAX {
        mixer.start(0, &click(around(k), 0.019));
    }
    assert_eq!(mixer.work(), Default::default());
    mixer.start(0, &click(Vec3::Y, 1.0));
    assert_eq!((mixer.work().voices, mixer.work().begun), (1, 1));
}
