//! Frames, and where the stream is cut.

use super::rig::*;
use glam::Vec3;
use hapticbillard::sound::{
    Listener, MixSettings, Mode, Room, STARTS_MAX, TOLD_MAX, Told, perform,
};
use std::collections::VecDeque;

#[test]
fn two_clicks_are_as_far_apart_as_they_were_told() {
    for apart in [1_u64, 2, 63, 64, 65, 100, 777, 4_801] {
        let mut mixer = field();
        let here = Vec3::new(0.3, 1.5, -0.4);
        for at in [130, 130 + 10_000 + apart] {
            mixer.start(at, &click(here, 2.0));
        }
        let heard = channel(&hear(&mut mixer, 20_000), 1);
        let found = lag(&heard[..5_000], &heard[10_000..], 5_000);
        assert!((found - apart as f64).abs() < 0.01, "{apart}: {found}");
    }
}

#[test]
fn a_sound_that_is_told_late_begins_at_once_and_one_from_far_ahead_is_refused() {
    let (mut late, mut now) = (field(), field());
    hear(&mut late, 1_000);
    hear(&mut now, 1_000);
    late.start(3, &click(Vec3::Y, 1.0));
    now.start(1_000, &click(Vec3::Y, 1.0));
    assert_eq!(hear(&mut late, 1_000), hear(&mut now, 1_000));
    assert_eq!((late.work().late, now.work().late), (1, 0));
    for at in [u64::MAX, 1_000_000_000] {
        now.start(at, &click(Vec3::Y, 1.0));
    }
    assert_eq!((now.work().refused, now.work().voices), (2, 0));
}

/// A busy second: clicks near and far, rolling balls, a listener that walks and jumps.
fn busy(settings: MixSettings, cuts: &[usize]) -> Vec<[f32; 2]> {
    let mut mixer = with(settings);
    let mut out = Vec::new();
    let mut cut = cuts.iter().cycle();
    for step in 0..200_u16 {
        let t = f32::from(step);
        // Too many at once, and too many one after the other.
        let (clicks, apart) = match step % 80 {
            7 => (100, 0),
            47 => (100, 60),
            _ => (1, 0),
        };
        for k in 0_u32..clicks {
            let at = mixer.frame() + u64::from(step % 7) * 11 + u64::from(k * apart);
            let k = k as f32;
            let place = Vec3::new(libm::sinf(t + k), libm::cosf(3.0 * t + k), 0.1);
            let onset = click(place, 0.3 + libm::fabsf(libm::sinf(5.0 * t)) + 0.01 * k);
            mixer.start(at, &onset);
        }
        for ball in 0..5_u16 {
            let angle = 0.02 * t + f32::from(ball);
            let place = Vec3::new(libm::sinf(angle), libm::cosf(angle), 0.03);
            mixer.roll(&rolling(ball, place, Vec3::new(place.y, -place.x, 0.0)));
        }
        let listener = Listener {
            position_m: Vec3::new(-1.0 + 0.01 * t, if step > 100 { 2.0 } else { 0.0 }, 0.7),
            right: Vec3::new(libm::sinf(0.03 * t), libm::cosf(0.03 * t), 0.0),
        };
        mixer.set_listener(listener);
        mixer.set_volume(0.5 + f32::from(step % 3) * 0.2);
        if step == 150 {
            mixer.set_mode(Mode::Loudspeakers);
        }
        let mut left = 240;
        while left > 0 {
            let frames = left.min(*cut.next().unwrap());
            out.extend(hear(&mut mixer, frames));
            left -= frames;
        }
    }
    let work = mixer.work();
    assert!(work.stolen > 20 && work.merged > 50 && work.rolling == 5, "{work:?}");
    out
}

#[test]
fn where_the_stream_is_cut_changes_no_bit() {
    for rate_hz in [48_000.0, 44_100.0] {
        let settings = MixSettings { rate_hz, room: Some(Room::CELLAR), ..MixSettings::default() };
        let whole = busy(settings, &[240]);
        assert!(energy(&channel(&whole, 0)) > 1e-3);
        for cuts in [&[1][..], &[7], &[64], &[113], &[1, 200, 3, 64, 65, 0, 31]] {
            assert!(busy(settings, cuts) == whole, "{rate_hz} Hz, {cuts:?}");
        }
    }
}

/// How many of `told`, all due at frame 0, each call of 64 frames takes.
fn taken_each_call(told: impl Iterator<Item = Told>) -> Vec<usize> {
    let mut mixer = cellar();
    let mut ring: VecDeque<(u64, Told)> = told.map(|told| (0, told)).collect();
    let mut taken = Vec::new();
    while !ring.is_empty() {
        let before = ring.len();
        perform(&mut mixer, |_| ring.pop_front(), &mut [[0.0; 2]; 64]);
        taken.push(before - ring.len());
        assert_eq!(mixer.frame(), 64 * taken.len() as u64);
    }
    taken
}

#[test]
fn what_is_told_after_a_stall_is_shared_among_the_calls_that_follow() {
    let onset = click(Vec3::Y, 1.0);
    let starts = (0..1000).map(|_| Told::Start { at_frame: 0, onset });
    assert_eq!(taken_each_call(starts), [STARTS_MAX, STARTS_MAX, STARTS_MAX, 232]);
    let turns = (0..1500).map(|_| Told::Volume(0.5));
    assert_eq!(taken_each_call(turns), [TOLD_MAX, 1500 - TOLD_MAX]);
}
