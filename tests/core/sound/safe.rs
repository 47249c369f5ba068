use super::measure::{RATE_HZ, Spectrum, peak, sound};
use glam::Vec3;
use hapticbillard::sound::{Bank, Onset, SoundClass, Voice};

const RATES_HZ: [f32; 5] = [8_000.0, 22_050.0, 44_100.0, 96_000.0, 192_000.0];

#[test]
fn the_same_seed_gives_the_same_bits_and_another_seed_others() {
    for class in SoundClass::ALL {
        let first = sound(class, 1.0, 1);
        assert_eq!(first, sound(class, 1.0, 1), "{class:?}");
        assert_ne!(first, sound(class, 1.0, 2), "{class:?}");
        assert_ne!(first, sound(class, 1.0, 1 << 31), "{class:?}");
    }
}

#[test]
fn no_two_hits_are_the_same_and_none_is_far_off() {
    let peaks: Vec<f32> =
        (0..256).map(|seed| peak(&sound(SoundClass::Cushion, 1.0, seed))).collect();
    let mut sorted = peaks.clone();
    sorted.sort_by(f32::total_cmp);
    sorted.dedup();
    assert_eq!(sorted.len(), peaks.len());
    let spread_db = 20.0 * libm::log10f(sorted[255] / sorted[0]);
    // Level 1.5 dB, modes 2 dB, both ways, and what the length of the contact does.
    assert!((2.0..9.0).contains(&spread_db), "{spread_db} dB");
}

#[test]
fn every_sound_ends_without_a_click_and_moves_no_air_on_the_whole() {
    for class in SoundClass::ALL {
        for speed_m_s in [0.1, 1.0, 8.0] {
            for rate_hz in RATES_HZ {
                let samples = Bank::synthesise(class, speed_m_s, 5, rate_hz);
                let what = format!("{class:?} at {speed_m_s} m/s, {rate_hz} Hz");
                let end = &samples[samples.len() - (0.002 * rate_hz) as usize..];
                let step = end.windows(2).map(|two| (two[1] - two[0]).abs()).fold(0.0, f32::max);
                assert!(step < 0.002 * peak(&samples), "{what}: a step of {step} Pa at the end");
                assert!(end.last().unwrap().abs() < 1e-4 * peak(&samples), "{what}");

                let below = Spectrum::of(&samples, rate_hz).part(0.0, 15.0);
                assert!(below < 0.005, "{what}: {below} of the energy is below hearing");
            }
        }
    }
}

#[test]
fn absurd_orders_give_finite_sounds_that_end() {
    let nan = Vec3::splat(f32::NAN);
    let huge = Vec3::splat(f32::MAX);
    let speeds = [0.0, -1.0, 1e-40, 0.02, 1e9, f32::MAX, f32::INFINITY, f32::NAN];
    let rates = [f32::NAN, -1.0, 0.0, 8_000.0, 11_025.0, 48_000.0, 192_000.0, 1e30];
    let places = [(nan, nan), (huge, huge), (Vec3::ZERO, Vec3::ZERO)];
    for class in SoundClass::ALL {
        for (i, speed_m_s) in speeds.into_iter().enumerate() {
            for (j, rate_hz) in rates.into_iter().enumerate() {
                let (position_m, axis) = places[(i + j) % places.len()];
                let time_s = f64::NAN;
                let onset = Onset { time_s, class, speed_m_s, position_m, axis, seed: 9 };
                check_sane(&onset, rate_hz);
            }
        }
    }
}

fn check_sane(onset: &Onset, rate_hz: f32) {
    let mut voice = Voice::begin(onset, Bank::EMPTY, rate_hz);
    assert!(voice.remaining() < 12 * 192_000, "{onset:?} lasts {} samples", voice.remaining());
    assert!((0.0..=1.0).contains(&voice.directivity(Vec3::X)), "{onset:?}");
    assert!(voice.directivity(onset.axis).is_finite());
    while !voice.is_over() {
        let sample = voice.next(Bank::EMPTY);
        let sane = sample.abs() < 1e4 && !sample.is_subnormal();
        assert!(sane, "{onset:?} at {rate_hz} Hz: {sample} Pa");
    }
    assert_eq!(voice.next(Bank::EMPTY), 0.0);
    assert_eq!(voice.loudness(Bank::EMPTY), 0.0);
}

#[test]
fn a_voice_is_small_and_can_be_read_in_any_pieces() {
    assert!(size_of::<Voice>() <= 1024, "{} bytes", size_of::<Voice>());
    for class in SoundClass::ALL {
        let whole = sound(class, 2.0, 4);
        let onset = Onset {
            time_s: 0.0,
            class,
            speed_m_s: 2.0,
            position_m: Vec3::ZERO,
            axis: Vec3::ZERO,
            seed: 4,
        };
        let mut voice = Voice::begin(&onset, Bank::EMPTY, RATE_HZ);
        let mut pieces = vec![0.0; whole.len()];
        pieces.chunks_mut(113).for_each(|piece| voice.fill(Bank::EMPTY, piece));
        assert_eq!(whole, pieces, "{class:?}");
    }
}

/// For stealing, an estimate within 12 dB is enough.
#[test]
fn the_loudness_to_come_is_estimated() {
    for class in SoundClass::ALL {
        for speed_m_s in [0.2, 1.0, 5.0] {
            let whole = sound(class, speed_m_s, 4);
            let onset = Onset {
                time_s: 0.0,
                class,
                speed_m_s,
                position_m: Vec3::ZERO,
                axis: Vec3::ZERO,
                seed: 4,
            };
            let mut voice = Voice::begin(&onset, Bank::EMPTY, RATE_HZ);
            for at in 0..whole.len() {
                // Not in the fade, where everything is soft.
                if at % 97 == 0 && at + 480 < whole.len() {
                    let (told, comes) = (voice.loudness(Bank::EMPTY), peak(&whole[at..]));
                    let what = format!("{class:?} at {speed_m_s} m/s, sample {at}");
                    assert!(told > 0.1 * comes, "{what}: told {told}, comes {comes}");
                    let loudest = peak(&whole);
                    assert!(
                        told < 8.0 * comes + 0.01 * loudest,
                        "{what}: told {told}, comes {comes}"
                    );
                }
                voice.next(Bank::EMPTY);
            }
        }
    }
}
