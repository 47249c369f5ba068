//! Absurd orders: whatever a mixer is told, numbers from -1 to 1 come out.

use super::rig::*;
use glam::Vec3;
use hapticbillard::ids::BallId;
use hapticbillard::sound::{
    Listener, MixSettings, Mode, Onset, Rolling, Room, SoundClass, Told, render_offline,
};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Some numbers that are wrong, and some that are right.
fn number(random: &mut Pcg64Mcg) -> f32 {
    const ODD: [f32; 12] = [
        0.0,
        -0.0,
        1e-40,
        1e-20,
        -1.0,
        1e9,
        -1e20,
        f32::MAX,
        f32::MIN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::NAN,
    ];
    if random.random_bool(0.3) {
        ODD[random.random_range(0..ODD.len())]
    } else {
        random.random_range(-3.0..3.0)
    }
}

fn vector(random: &mut Pcg64Mcg) -> Vec3 {
    if random.random_bool(0.2) {
        // Any bits at all.
        return Vec3::from_array(std::array::from_fn(|_| f32::from_bits(random.next_u32())));
    }
    Vec3::new(number(random), number(random), number(random))
}

fn told(random: &mut Pcg64Mcg, frame: u64) -> Told {
    const CLASSES: [SoundClass; 5] = [
        SoundClass::BallClick,
        SoundClass::Cushion,
        SoundClass::Pocket,
        SoundClass::Miscue,
        SoundClass::Gully,
    ];
    match random.random_range(0..10) {
        0..5 => Told::Start {
            at_frame: match random.random_range(0..20) {
                0 => u64::MAX,
                1 => 0,
                _ => frame + random.random_range(0..2_000),
            },
            onset: Onset {
                time_s: f64::from(number(random)),
                class: CLASSES[random.random_range(0..CLASSES.len())],
                speed_m_s: number(random),
                position_m: vector(random),
                axis: vector(random),
                seed: random.next_u32(),
            },
        },
        5..8 => Told::Roll(Rolling {
            ball: BallId(random.random_range(0..40)),
            radius_m: number(random),
            position_m: vector(random),
            velocity_m_s: vector(random),
            slip_m_s: number(random),
        }),
        8 => Told::Listener(Listener { position_m: vector(random), right: vector(random) }),
        _ if random.random_bool(0.5) => Told::Volume(number(random)),
        _ => {
            Told::Mode(if random.random_bool(0.5) { Mode::Loudspeakers } else { Mode::Headphones })
        }
    }
}

fn play(seed: u64, frames: u64) -> Vec<[f32; 2]> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let rate_hz = [8_000.0, 44_100.0, 48_000.0, 192_000.0, f32::NAN, -1.0, 1e30];
    let room = [None, Some(Room::CELLAR)][random.random_range(0..2)];
    let mut mixer = with(MixSettings {
        rate_hz: rate_hz[random.random_range(0..rate_hz.len())],
        room,
        room_tone: random.random_bool(0.5),
        volume: number(&mut random),
        ..MixSettings::default()
    });
    let mut score = Vec::new();
    let mut frame = 0;
    while frame < frames {
        frame += random.random_range(0..200);
        score.push((frame, told(&mut random, frame)));
    }
    let mut out = Vec::new();
    let hand_on = |run: &[[f32; 2]]| -> Result<(), std::convert::Infallible> {
        out.extend_from_slice(run);
        Ok(())
    };
    let Ok(()) = render_offline(&mut mixer, score, frames, hand_on);
    // And in the end it is a mixer as before: the wrong numbers left no trace.
    mixer.set_mode(Mode::Headphones);
    mixer.set_listener(HEAD);
    mixer.set_volume(1.0);
    hear(&mut mixer, 200_000);
    let again = heard(&mut mixer, &click(Vec3::Y, 1.0));
    let loudest = peak(&channel(&again, 0));
    assert!((1e-3..0.5).contains(&loudest), "seed {seed}: {loudest}, {:?}", mixer.work());
    out
}

#[test]
fn whatever_it_is_told_a_mixer_says_numbers_from_minus_one_to_one() {
    let mut loud = 0;
    for seed in 0..16 {
        let out = play(seed, 20_000);
        assert_eq!(out.len(), 20_000);
        for (frame, [left, right]) in out.iter().enumerate() {
            let fine = |x: f32| (-1.0..=1.0).contains(&x);
            assert!(fine(*left) && fine(*right), "seed {seed}, frame {frame}: {left} {right}");
        }
        loud += usize::from(peak(&channel(&out, 0)) > 0.01);
        if seed < 3 {
            assert!(play(seed, 20_000) == out, "seed {seed}");
        }
    }
    assert!(loud > 5, "{loud}");
}

#[test]
fn a_mixer_that_is_told_nothing_is_silent() {
    let out = hear(&mut cellar(), 10_000);
    assert!(peak(&channel(&out, 0)) < 1e-15 && peak(&channel(&out, 1)) < 1e-15);
}
