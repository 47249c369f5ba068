//! Cuts, volume and modes without clicks.

use super::rig::*;
use glam::Vec3;
use hapticbillard::sound::{Listener, Mixer, Mode, SoundClass};

/// A ball that rolls on the spot, and pockets that sound.
fn sounding() -> Mixer {
    let mut mixer = field();
    for k in 0..3_u8 {
        let mut onset = click(Vec3::new(f32::from(k) - 1.0, 1.0, 0.0), 1.0);
        onset.class = SoundClass::Gully;
        mixer.start(0, &onset);
    }
    roll_on(&mut mixer, 4_800);
    mixer
}

fn roll_on(mixer: &mut Mixer, frames: usize) -> Vec<[f32; 2]> {
    let mut heard = Vec::new();
    for _ in 0..frames / 480 {
        // It goes round in a circle of a centimetre.
        let turn = mixer.frame() as f32 / 480.0;
        let way = Vec3::new(libm::sinf(turn), libm::cosf(turn), 0.0);
        mixer.roll(&rolling(1, Vec3::new(0.3, 1.0, 0.0), way));
        heard.extend(hear(mixer, 480));
    }
    heard
}

/// The steepest slope while `change` acts is not that of a click.
#[track_caller]
fn does_not_click(change: impl Fn(&mut Mixer)) {
    let (mut changed, mut calm) = (sounding(), sounding());
    change(&mut changed);
    let (changed_first, calm) = (roll_on(&mut changed, 960), roll_on(&mut calm, 9_600));
    let changed_later = roll_on(&mut changed, 9_600);
    for ear in 0..2 {
        let usual = steepest(&channel(&calm, ear)).max(steepest(&channel(&changed_later, ear)));
        let now = steepest(&channel(&changed_first, ear));
        assert!(now < 1.3 * usual, "ear {ear}: {now} against {usual}");
    }
    assert!(changed_later != calm);
}

#[test]
fn a_cut_of_the_camera_does_not_click() {
    does_not_click(|mixer| {
        mixer.set_listener(Listener { position_m: Vec3::new(0.5, 2.5, 0.3), right: Vec3::NEG_X });
    });
    does_not_click(|mixer| {
        mixer.set_listener(Listener { position_m: Vec3::ZERO, right: Vec3::NEG_X });
    });
}

#[test]
fn a_walk_of_the_camera_does_not_click() {
    does_not_click(|mixer| {
        let turned = Vec3::new(0.97, 0.243, 0.0).normalize();
        mixer.set_listener(Listener { position_m: Vec3::new(0.1, -0.3, 0.1), right: turned });
    });
}

#[test]
fn volume_and_mode_change_without_a_click() {
    does_not_click(|mixer| mixer.set_volume(0.0));
    does_not_click(|mixer| mixer.set_volume(0.5));
    does_not_click(|mixer| mixer.set_mode(Mode::Loudspeakers));
}

#[test]
fn the_volume_rises_in_small_steps() {
    let (mut half, mut whole) = (sounding(), sounding());
    half.set_volume(0.5);
    let (half, whole) = (roll_on(&mut half, 2_400), roll_on(&mut whole, 2_400));
    let factors: Vec<f32> = half
        .iter()
        .zip(&whole)
        .filter(|(_, whole)| whole[0].abs() > 1e-4)
        .map(|(half, whole)| half[0] / whole[0])
        .collect();
    assert!(factors.len() > 200);
    assert!(factors[0] > 0.9 && (factors[factors.len() - 1] - 0.5).abs() < 1e-3);
    assert!(factors.windows(2).all(|pair| pair[1] <= pair[0] + 1e-3));
}

#[test]
fn who_stands_elsewhere_hears_a_long_sound_from_there() {
    let mut mixer = field();
    let mut onset = click(Vec3::new(0.6, 0.0, 0.0), 1.0);
    onset.class = SoundClass::Gully;
    mixer.start(0, &onset);
    let level = |heard: &[[f32; 2]], ear| energy(&channel(heard, ear));
    let before = hear(&mut mixer, 9_600);
    mixer.set_listener(Listener { position_m: Vec3::ZERO, right: Vec3::NEG_X });
    hear(&mut mixer, 1_000);
    let after = hear(&mut mixer, 9_600);
    assert!(level(&before, 1) > 1.5 * level(&before, 0));
    assert!(level(&after, 0) > 1.5 * level(&after, 1));
}

#[test]
fn a_sound_that_has_not_begun_is_heard_wholly_as_the_listener_then_is() {
    let turn = |mixer: &mut Mixer| {
        mixer.set_listener(Listener { position_m: Vec3::new(0.5, 2.0, 0.3), right: Vec3::NEG_X });
        mixer.set_mode(Mode::Loudspeakers);
    };
    let onset = click(Vec3::new(0.3, 0.6, 0.0), 2.0);
    let (mut before, mut after) = (cellar(), cellar());
    before.start(1_000, &onset);
    for mixer in [&mut before, &mut after] {
        turn(mixer);
    }
    after.start(1_000, &onset);
    let (before, after) = (hear(&mut before, 4_000), hear(&mut after, 4_000));
    assert!(after.iter().any(|[left, _]| left.abs() > 1e-3));
    assert!(before == after);
}
