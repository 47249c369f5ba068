//! Walls that answer.

use super::rig::*;
use glam::Vec3;
use hapticbillard::sound::{MixSettings, Mixer, Room};

/// What the room adds to a click.
fn answer(room: Room, place: Vec3, frames: usize) -> Vec<f32> {
    let hear_in = |room: Option<Room>| {
        let mut mixer = with(MixSettings { room, ..MixSettings::default() });
        mixer.start(0, &click(place, 1.0));
        channel(&hear(&mut mixer, frames), 0)
    };
    let (with, without) = (hear_in(Some(room)), hear_in(None));
    with.iter().zip(&without).map(|(with, without)| with - without).collect()
}

#[test]
fn the_first_answer_comes_by_way_of_the_nearest_wall() {
    let room = Room::CELLAR;
    let place = Vec3::new(0.0, 1.0, 0.0);
    let answer = answer(room, place, 4_096);
    // By the floor: 0.78 m down, 0.78 m up, 1 m along.
    let way_m = (1.0_f32 + 1.56 * 1.56).sqrt();
    let frame = (way_m / SOUND_M_S * RATE_HZ) as usize;
    let most = peak(&answer);
    let first = answer.iter().position(|x| x.abs() > 0.02 * most).unwrap();
    assert!(first.abs_diff(frame) < 8, "{first} {frame}");
}

#[test]
fn the_room_dies_away_in_its_time() {
    for t60_s in [0.3, 0.4, 0.8] {
        let room = Room { t60_s, ..Room::CELLAR };
        let answer = answer(room, Vec3::new(0.0, 1.0, 0.0), 48_000);
        // Schroeder's backward integral, from -10 to -40 dB.
        let total = energy(&answer);
        let mut left = total;
        let mut at = [0.0; 2];
        for (frame, x) in answer.iter().enumerate() {
            left -= f64::from(*x) * f64::from(*x);
            for (time, part) in at.iter_mut().zip([0.1, 1e-4]) {
                if left > part * total {
                    *time = frame as f64 / f64::from(RATE_HZ);
                }
            }
        }
        let found_s = 2.0 * (at[1] - at[0]);
        let ratio = found_s / f64::from(t60_s);
        assert!((0.6..1.15).contains(&ratio), "{t60_s} s: {found_s} s");
    }
}

#[test]
fn the_answer_of_the_room_is_as_loud_as_its_walls_make_it() {
    // Far field over direct sound at 1 m: 16π (1 - α) / (S α), without the lowest and the highest
    // notes, which walls treat otherwise.
    let place = Vec3::new(0.0, 1.0, 0.0);
    let direct = energy(&channel(&heard(&mut field(), &click(place, 1.0)), 0));
    let ratio = energy(&answer(Room::CELLAR, place, 48_000)) / direct;
    let absorption = 1.0 - libm::exp(-0.161 * 91.0 / (132.4 * 0.4));
    let right = 16.0 * std::f64::consts::PI * (1.0 - absorption) / (132.4 * absorption);
    let off_db = decibel((ratio / right).sqrt());
    assert!(off_db.abs() < 4.0, "{ratio} {right}");
}

#[test]
fn the_room_answers_both_ears_alike_but_not_with_the_same() {
    let mut mixer = cellar();
    let heard = heard(&mut mixer, &click(Vec3::new(0.0, 1.0, 0.0), 2.0));
    let (left, right) = (channel(&heard[2_400..], 0), channel(&heard[2_400..], 1));
    let balance = decibel((energy(&left) / energy(&right)).sqrt());
    assert!(balance.abs() < 2.0, "{balance} dB");
    let product: f64 = left.iter().zip(&right).map(|(a, b)| f64::from(*a) * f64::from(*b)).sum();
    assert!(product.abs() < 0.5 * (energy(&left) * energy(&right)).sqrt());
}

#[test]
fn a_room_that_cannot_be_is_an_open_field() {
    let wrong = [
        Room { low_m: Vec3::NAN, ..Room::CELLAR },
        Room { high_m: Room::CELLAR.low_m, ..Room::CELLAR },
        Room { high_m: Vec3::splat(1e30), ..Room::CELLAR },
        Room { t60_s: 0.0, ..Room::CELLAR },
        Room { t60_s: f32::NAN, ..Room::CELLAR },
    ];
    let listen = |mixer: &mut Mixer| heard(mixer, &click(Vec3::Y, 1.0));
    let open = listen(&mut field());
    for room in wrong {
        let mut mixer = with(MixSettings { room: Some(room), ..MixSettings::default() });
        assert!(listen(&mut mixer) == open, "{room:?}");
    }
    assert!(listen(&mut cellar()) != open);
}
