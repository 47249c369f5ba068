use super::measure::{RATE_HZ, Spectrum, peak, rms_db};
use glam::Vec3;
use hapticbillard::ids::BallId;
use hapticbillard::sound::parameters::{BALL_RADIUS_M, ROLLING};
use hapticbillard::sound::{Rolling, RollingVoice, RoomTone};
use std::f64::consts::TAU;

fn told(speed_m_s: f32, slip_m_s: f32) -> Rolling {
    Rolling {
        ball: BallId(1),
        radius_m: BALL_RADIUS_M,
        position_m: Vec3::ZERO,
        velocity_m_s: Vec3::new(0.6, 0.8, 0.0) * speed_m_s,
        slip_m_s,
    }
}

/// A ball that has moved like this for a while.
fn rolling_at(speed_m_s: f32, slip_m_s: f32, seconds: f32, rate_hz: f32) -> Vec<f32> {
    let mut voice = RollingVoice::new(BALL_RADIUS_M, 7, rate_hz);
    voice.tell(&told(speed_m_s, slip_m_s));
    let mut samples = vec![0.0; (0.2 * rate_hz) as usize];
    voice.fill(&mut samples);
    samples.resize((seconds * rate_hz) as usize, 0.0);
    voice.fill(&mut samples);
    samples
}

#[test]
fn the_centre_is_in_proportion_to_the_speed() {
    let centre =
        |speed_m_s| Spectrum::of(&rolling_at(speed_m_s, 0.0, 8.0, RATE_HZ), RATE_HZ).centroid_hz();
    let at_1_m_s = centre(1.0);
    assert!((250.0..350.0).contains(&at_1_m_s), "{at_1_m_s} Hz");
    for speed_m_s in [0.5, 2.0] {
        let ratio = centre(speed_m_s) / at_1_m_s;
        assert!((ratio / f64::from(speed_m_s) - 1.0).abs() < 0.1, "{speed_m_s} m/s: {ratio}");
    }
    // And stays within what cloth and slate answer to.
    assert!(centre(10.0) < 1.1 * centre(3.0));
}

#[test]
fn the_level_grows_as_the_speed_to_1_5() {
    let level = |speed_m_s| rms_db(&rolling_at(speed_m_s, 0.0, 8.0, RATE_HZ));
    let at_1_m_s = level(1.0);
    assert!((at_1_m_s - ROLLING.level_db).abs() < 1.0, "{at_1_m_s} dB SPL");
    for speed_m_s in [0.1_f32, 0.5, 2.0, 8.0] {
        let expected = 30.0 * libm::log10f(speed_m_s);
        let more = level(speed_m_s) - at_1_m_s;
        assert!((more - expected).abs() < 1.0, "{speed_m_s} m/s: {more}, not {expected} dB");
    }
}

#[test]
fn the_level_does_not_depend_on_the_rate() {
    let level = rms_db(&rolling_at(1.0, 0.5, 8.0, RATE_HZ));
    for rate_hz in [22_050.0, 44_100.0, 96_000.0, 192_000.0] {
        let other = rms_db(&rolling_at(1.0, 0.5, 8.0, rate_hz));
        assert!((other - level).abs() < 1.0, "{rate_hz} Hz: {other} and {level} dB SPL");
    }
}

#[test]
fn a_turn_of_the_ball_is_heard() {
    for speed_m_s in [1.0, 2.0] {
        let samples = rolling_at(speed_m_s, 0.0, 60.0, RATE_HZ);
        // The power in pieces of 5 ms: 200 a second.
        let power: Vec<f32> =
            samples.chunks(240).map(|piece| piece.iter().map(|x| x * x).sum()).collect();
        let mean = power.iter().sum::<f32>() / power.len() as f32;
        let power: Vec<f32> = power.iter().map(|p| p - mean).collect();
        let beat_hz = Spectrum::of(&power, 200.0).peak_hz(2.0, 30.0);
        let turns_hz = f64::from(speed_m_s) / (TAU * f64::from(BALL_RADIUS_M));
        assert!((beat_hz - turns_hz).abs() < 0.1, "{beat_hz} Hz, not {turns_hz}");
    }
}

#[test]
fn sliding_adds_6_db_and_a_hiss() {
    let spectrum = |slip| Spectrum::of(&rolling_at(1.0, slip, 8.0, RATE_HZ), RATE_HZ);
    let more = |band: [f64; 2], from: f32, to: f32| {
        let energy = |slip| spectrum(slip).between(band[0], band[1]);
        10.0 * libm::log10(energy(to) / energy(from))
    };
    let rumble = more([80.0, 600.0], 0.0, 0.5);
    assert!((rumble - 6.0).abs() < 0.5, "{rumble} dB");
    let hiss = [1_500.0, 2_500.0];
    assert!(more(hiss, 0.0, 0.5) > 6.0);
    let twice = more(hiss, 1.0, 2.0);
    assert!((twice - 6.0).abs() < 1.0, "{twice} dB for twice the slip");
}

#[test]
fn a_ball_that_stops_fades_to_nothing() {
    let mut voice = RollingVoice::new(BALL_RADIUS_M, 7, RATE_HZ);
    let mut samples = vec![0.0; 9_600];
    voice.fill(&mut samples);
    assert!(voice.is_silent() && peak(&samples) == 0.0);

    voice.tell(&told(2.0, 1.0));
    voice.fill(&mut samples);
    assert!(!voice.is_silent());
    let loud = peak(&samples);
    let steps =
        |samples: &[f32]| samples.windows(2).map(|two| (two[1] - two[0]).abs()).fold(0.0, f32::max);
    let step = steps(&samples[4_800..]);

    voice.tell(&told(0.0, 0.0));
    voice.fill(&mut samples);
    assert!(steps(&samples) <= 1.2 * step, "no click while it fades");
    assert!(peak(&samples[4_800..]) < 0.01 * loud, "gone within 100 ms");
    voice.fill(&mut samples);
    assert!(voice.is_silent() && peak(&samples) == 0.0, "nothing is left of it");
}

#[test]
fn absurd_balls_make_finite_sounds() {
    for radius_m in [f32::NAN, 0.0, -1.0, 1e-30, f32::INFINITY] {
        for rate_hz in [f32::NAN, 0.0, 8_000.0, 192_000.0, f32::INFINITY] {
            let mut voice = RollingVoice::new(radius_m, 1, rate_hz);
            let values = [f32::NAN, f32::INFINITY, f32::MAX, -1.0, 1e-40, 1e9];
            for (speed_m_s, slip_m_s) in values.iter().flat_map(|&a| values.map(|b| (a, b))) {
                voice.tell(&told(speed_m_s, slip_m_s));
                for _ in 0..300 {
                    let sample = voice.next();
                    assert!(sample.abs() < 1e3, "{radius_m} {rate_hz} {speed_m_s} {slip_m_s}");
                }
            }
            assert!(voice.loudness().is_finite());
        }
    }
}

#[test]
fn a_quiet_room_is_soft_low_and_its_own() {
    let room = |seed, rate_hz: f32| {
        let mut tone = RoomTone::new(seed, rate_hz);
        let samples: Vec<f32> = (0..(8.0 * rate_hz) as usize).map(|_| tone.next()).collect();
        samples
    };
    for rate_hz in [44_100.0, 48_000.0, 96_000.0] {
        let samples = room(1, rate_hz);
        let level = rms_db(&samples);
        assert!((30.0..38.0).contains(&level), "{level} dB SPL");
        let low = Spectrum::of(&samples, rate_hz).part(20.0, 500.0);
        assert!(low > 0.9, "{low}");
    }
    assert_eq!(room(1, RATE_HZ), room(1, RATE_HZ));
    assert_ne!(room(1, RATE_HZ), room(2, RATE_HZ));
}
