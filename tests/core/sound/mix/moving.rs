//! Doppler, and balls that come and go.

use super::rig::*;
use glam::Vec3;
use hapticbillard::sound::{Listener, Mixer};

/// Tells a ball every 5 ms, and the listener with it if `led` keeps both together.
fn pass(from_m: Vec3, velocity_m_s: Vec3, led: bool, frames: usize) -> Vec<f32> {
    let mut mixer = field();
    let mut heard = Vec::new();
    while heard.len() < frames {
        let place = from_m + velocity_m_s * (heard.len() as f32 / RATE_HZ);
        mixer.roll(&rolling(2, place, velocity_m_s));
        if led {
            mixer.set_listener(Listener { position_m: place - from_m, ..HEAD });
        }
        heard.extend(channel(&hear(&mut mixer, 240), 0));
    }
    heard
}

/// Every eighth frame: the ball rumbles far below 3 kHz.
const COARSE: usize = 8;

/// How much faster the sound of a ball comes in than that of one with the same noise that keeps its
/// distance: the stretch with which the one is most like the other.
fn pitch(from_m: Vec3, velocity_m_s: Vec3) -> f64 {
    let moving = pass(from_m, velocity_m_s, false, 30_000);
    let still = pass(from_m, velocity_m_s, true, 30_000);
    let still: Vec<f32> = still.into_iter().step_by(COARSE).collect();
    let likeness = |pitch: f64| {
        let stretched: Vec<f32> = (0..1_200)
            .map(|i| {
                let frame = 14_000.0 + (i * COARSE) as f64 / pitch;
                let (whole, part) = (frame as usize, (frame % 1.0) as f32);
                moving[whole] * (1.0 - part) + moving[whole + 1] * part
            })
            .collect();
        let size = energy(&stretched).sqrt();
        let like = still[400..].windows(stretched.len()).map(|own| {
            let sum: f32 = own.iter().zip(&stretched).map(|(a, b)| a * b).sum();
            f64::from(sum) / (size * energy(own).sqrt())
        });
        like.fold(0.0, f64::max)
    };
    let pitches = (0..=120).map(|i| 0.94 + 0.001 * f64::from(i));
    let (best, like) =
        pitches.map(|pitch| (pitch, likeness(pitch))).max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
    assert!(like > 0.8, "{best} {like}");
    best
}

#[test]
fn at_10_metres_a_second_the_pitch_is_2_9_per_cent_up_and_down() {
    let towards = pitch(Vec3::new(0.0, 8.0, 0.0), Vec3::new(0.0, -10.0, 0.0));
    let away = pitch(Vec3::new(0.0, 1.0, 0.0), Vec3::new(0.0, 10.0, 0.0));
    assert!((towards - 1.029).abs() < 0.0015, "{towards}");
    assert!((away - 0.971).abs() < 0.0015, "{away}");
    let across = pitch(Vec3::new(-3.5, 15.0, 0.0), Vec3::new(10.0, 0.0, 0.0));
    assert!((across - 1.0).abs() < 0.0025, "{across}");
}

#[test]
fn a_ball_that_is_not_told_of_fades_within_a_fifth_of_a_second() {
    let mut mixer = field();
    mixer.roll(&rolling(1, Vec3::Y, Vec3::X));
    let heard = channel(&hear(&mut mixer, 24_000), 0);
    let level = |from: usize| energy(&heard[from..from + 480]).sqrt();
    assert!(level(4_000) > 0.0);
    // Not cut off: in the middle of the fade it is between.
    let fading = level(4_900) / level(4_000);
    assert!(fading < 1.0 && level(7_000) < 1e-4 * level(4_000), "{fading} {}", level(7_000));
    assert_eq!(mixer.work().rolling, 0);
}

#[test]
fn a_ball_that_is_put_elsewhere_does_not_click() {
    let settle = |mixer: &mut Mixer, place: Vec3| {
        let mut heard = Vec::new();
        for _ in 0..40 {
            mixer.roll(&rolling(1, place, Vec3::new(1e-2, 1.0, 0.0)));
            heard.extend(channel(&hear(mixer, 240), 0));
        }
        heard
    };
    let mut mixer = field();
    let before = settle(&mut mixer, Vec3::new(-1.0, 1.0, 0.0));
    let after = settle(&mut mixer, Vec3::new(0.5, 0.8, 0.0));
    let usual = steepest(&before[4_800..]).max(steepest(&after[4_800..]));
    assert!(steepest(&after[..2_000]) < 1.3 * usual);
}

#[test]
fn a_ball_at_rest_takes_no_slot_and_the_twenty_fifth_is_refused() {
    let mut mixer = field();
    mixer.roll(&rolling(1, Vec3::Y, Vec3::ZERO));
    assert_eq!(mixer.work().rolling, 0);
    for ball in 0..25 {
        mixer.roll(&rolling(ball, Vec3::Y, Vec3::X));
    }
    assert_eq!((mixer.work().rolling, mixer.work().refused), (24, 1));
    for _ in 0..40 {
        for ball in 0..25 {
            mixer.roll(&rolling(ball, Vec3::Y, Vec3::ZERO));
        }
        hear(&mut mixer, 480);
    }
    assert_eq!(mixer.work().rolling, 0);
}
