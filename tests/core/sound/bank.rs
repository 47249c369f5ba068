use super::measure::{RATE_HZ, peak, peak_db, sound};
use glam::Vec3;
use hapticbillard::sound::SoundClass::{BallClick, Cushion, Pocket};
use hapticbillard::sound::{
    Bank, ClipName, NameError, Onset, RECORDING_S_MAX, RecordingError, SoundClass, Voice,
};

fn onset(class: SoundClass, speed_m_s: f32, seed: u32) -> Onset {
    Onset { time_s: 0.0, class, speed_m_s, position_m: Vec3::ZERO, axis: Vec3::ZERO, seed }
}

fn played(bank: &Bank, onset: &Onset) -> Vec<f32> {
    let mut voice = Voice::begin(onset, bank, RATE_HZ);
    let mut samples = vec![0.0; voice.remaining() as usize];
    voice.fill(bank, &mut samples);
    assert!(voice.is_over());
    samples
}

/// Half a second of silence, then a tone that dies away, on a mean that is not zero.
fn recording(frequency_hz: f32) -> Vec<f32> {
    let tone = |i: usize| {
        let t = i as f32 / RATE_HZ;
        libm::sinf(std::f32::consts::TAU * frequency_hz * t) * libm::expf(-60.0 * t)
    };
    let silence = std::iter::repeat_n(0.0, RATE_HZ as usize / 2);
    silence.chain((0..RATE_HZ as usize).map(tone)).map(|x| 0.1 + 0.2 * x).collect()
}

#[test]
fn a_recording_stands_in_at_the_level_of_the_synthesis() {
    let mut bank = Bank::default();
    assert!(bank.is_empty() && bank.pick(&onset(BallClick, 1.0, 1)).is_none());
    bank.insert(BallClick, 1.0, &recording(500.0), RATE_HZ).unwrap();
    assert_eq!((bank.count(BallClick), bank.count(Cushion)), (1, 0));
    for speed_m_s in [0.2, 1.0, 5.0] {
        let clip = played(&bank, &onset(BallClick, speed_m_s, 1));
        let synthesis = sound(BallClick, speed_m_s, 1);
        assert_ne!(clip, synthesis);
        let off = peak_db(&clip) - peak_db(&synthesis);
        assert!(off.abs() < 3.0, "{speed_m_s} m/s: {off} dB from the synthesis");
    }
    // Other classes, and what is not heard, stay as they are.
    assert_eq!(played(&bank, &onset(Cushion, 1.0, 1)), sound(Cushion, 1.0, 1));
    assert!(Voice::begin(&onset(BallClick, 0.01, 1), &bank, RATE_HZ).is_over());
    assert!(Voice::begin(&onset(BallClick, f32::NAN, 1), &bank, RATE_HZ).is_over());
}

#[test]
fn a_recording_is_cut_to_its_sound() {
    let mut bank = Bank::default();
    bank.insert(Pocket, 1.0, &recording(300.0), RATE_HZ).unwrap();
    let clip = played(&bank, &onset(Pocket, 1.0, 1));
    let begins = clip.iter().position(|x| x.abs() > 0.1 * peak(&clip)).unwrap();
    assert!(begins < 60, "it begins {begins} samples late");
    let sum: f32 = clip.iter().sum();
    let all: f32 = clip.iter().map(|x| x.abs()).sum();
    assert!(sum.abs() < 0.05 * all, "no mean: {}", sum / all);
    assert_eq!(clip.last(), Some(&0.0));
}

#[test]
fn the_nearest_in_speed_is_played_one_of_several_by_chance() {
    let mut bank = Bank::default();
    for (speed_m_s, frequency_hz) in [(1.0, 300.0), (1.0, 400.0), (5.0, 500.0)] {
        bank.insert(Cushion, speed_m_s, &recording(frequency_hz), RATE_HZ).unwrap();
    }
    let plays = |speed_m_s: f32, seed: u32| {
        let clip = played(&bank, &onset(Cushion, speed_m_s, seed));
        super::measure::centroid_hz(&clip)
    };
    assert!((0..8).all(|seed| plays(4.0, seed) > 450.0), "the one of 5 m/s");
    let low = (0..64).filter(|&seed| plays(0.8, seed) < 350.0).count();
    assert!((16..48).contains(&low), "{low} of 64 times the first of two");
    assert!((0..64).all(|seed| plays(0.8, seed) < 450.0));
    assert_eq!(plays(0.8, 3), plays(0.8, 3));
}

#[test]
fn what_cannot_stand_in_is_refused() {
    let mut bank = Bank::default();
    let mut refused = |samples: &[f32]| bank.insert(Cushion, 1.0, samples, RATE_HZ).unwrap_err();
    assert_eq!(refused(&[]), RecordingError::Silent);
    assert_eq!(refused(&[0.0; 4800]), RecordingError::Silent);
    assert_eq!(refused(&[0.5; 4800]), RecordingError::Silent);
    assert_eq!(refused(&[0.1, f32::NAN]), RecordingError::NotFinite { sample: 1 });
    assert_eq!(refused(&[f32::INFINITY]), RecordingError::NotFinite { sample: 0 });
    let long = vec![0.1; (RECORDING_S_MAX * RATE_HZ) as usize + 1];
    assert_eq!(refused(&long), RecordingError::TooLong);
    assert!(bank.is_empty());
}

#[test]
fn names_say_what_a_recording_is() {
    for class in SoundClass::ALL {
        let name = ClipName { class, speed_m_s: 2.5, variant: 3 };
        assert_eq!(name.to_string().parse(), Ok(name));
    }
    let name = ClipName { class: BallClick, speed_m_s: 2.0, variant: 3 };
    assert_eq!(name.to_string(), "ball_click_v2_3.wav");
    assert_eq!("ball_click_v2.0_3.WAV".parse(), Ok(name));

    for text in ["", ".wav", "é.wav", "wav", "ball_click_v2_3.mp3", "ball_click_2_3.wav", "x🎱"]
    {
        assert_eq!(text.parse::<ClipName>(), Err(NameError::Form), "{text}");
    }
    let class = String::from("gong");
    assert_eq!("gong_v1_1.wav".parse::<ClipName>(), Err(NameError::Class { class }));
    for speed in ["fast", "nan", "inf", "-1", "0", "1e9"] {
        let wrong = NameError::Speed { speed: speed.to_string() };
        assert_eq!(format!("cushion_v{speed}_1.wav").parse::<ClipName>(), Err(wrong));
    }
}
