use super::measure::{RATE_HZ, centroid_hz, peak_db, sound};
use glam::Vec3;
use hapticbillard::sound::SoundClass::BallClick;
use hapticbillard::sound::contact::hertz_s;
use hapticbillard::sound::parameters::{BALL_MASS_KG, BALL_RADIUS_M, RESIN};
use hapticbillard::sound::{Bank, Onset, Voice};

/// Enough that the chance in them is gone in the mean.
const VARIANTS: u32 = 32;

fn mean(measure: impl Fn(u32) -> f64) -> f64 {
    (0..VARIANTS).map(measure).sum::<f64>() / f64::from(VARIANTS)
}

#[test]
fn contacts_last_as_long_as_hertz_says() {
    for (speed_m_s, expected_us) in [(0.5, 448.0), (1.0, 390.0), (5.0, 283.0), (10.0, 246.0)] {
        let bodies = [RESIN; 2];
        let length_s = hertz_s(0.5 * BALL_MASS_KG, 0.5 * BALL_RADIUS_M, bodies, speed_m_s);
        assert!((length_s * 1e6 - expected_us).abs() < 1.0, "{speed_m_s} m/s: {length_s} s");
    }
}

/// Against the exact far field of two rigid spheres, reckoned apart from this program.
#[test]
fn level_and_brightness_are_those_of_two_spheres() {
    for (speed_m_s, level_db, expected_hz) in
        [(0.5, 89.0, 1800.0), (1.0, 98.0, 1960.0), (5.0, 117.0, 2350.0), (10.0, 124.0, 2490.0)]
    {
        let level = mean(|variant| f64::from(peak_db(&sound(BallClick, speed_m_s, variant))));
        assert!((level - level_db).abs() < 1.0, "{speed_m_s} m/s: {level} dB SPL");
        let centre = mean(|variant| centroid_hz(&sound(BallClick, speed_m_s, variant)));
        assert!((centre / expected_hz - 1.0).abs() < 0.03, "{speed_m_s} m/s: {centre} Hz");
        for variant in 0..VARIANTS {
            let centre = centroid_hz(&sound(BallClick, speed_m_s, variant));
            assert!((centre / expected_hz - 1.0).abs() < 0.15, "variant {variant}: {centre} Hz");
        }
    }
}

#[test]
fn five_times_the_speed_is_19_db_more() {
    for variant in 0..VARIANTS {
        let level = |speed_m_s| peak_db(&sound(BallClick, speed_m_s, variant));
        let more = level(5.0) - level(1.0);
        assert!((more - 19.0).abs() < 2.0, "{more} dB");
    }
}

#[test]
fn the_softest_touch_is_silent_and_hearing_begins_gently() {
    assert!(sound(BallClick, 0.0199, 1).is_empty());
    let just = peak_db(&sound(BallClick, 0.0202, 1));
    let twice = peak_db(&sound(BallClick, 0.04, 1));
    assert!(just < 20.0 && twice > 50.0, "{just} and {twice} dB SPL");
}

#[test]
fn level_and_brightness_do_not_depend_on_the_rate() {
    let at = |rate_hz: f32| {
        let samples = Bank::synthesise(BallClick, 5.0, 1, rate_hz);
        let centre = super::measure::Spectrum::of(&samples, rate_hz).centroid_hz();
        (peak_db(&samples), centre)
    };
    let (level, centre) = at(RATE_HZ);
    for rate_hz in [44_100.0, 88_200.0, 96_000.0, 192_000.0] {
        let (other, there) = at(rate_hz);
        assert!((other - level).abs() < 0.5, "{rate_hz} Hz: {other} and {level} dB SPL");
        assert!((there / centre - 1.0).abs() < 0.03, "{rate_hz} Hz: {there} and {centre} Hz");
    }
}

#[test]
fn a_click_goes_along_its_line_to_both_sides() {
    let click = |axis: Vec3| {
        let onset = Onset {
            time_s: 0.0,
            class: BallClick,
            speed_m_s: 1.0,
            position_m: Vec3::ZERO,
            axis,
            seed: 1,
        };
        Voice::begin(&onset, Bank::EMPTY, RATE_HZ)
    };
    let along = click(Vec3::X);
    assert_eq!(along.directivity(Vec3::X), 1.0);
    assert_eq!(along.directivity(Vec3::NEG_X), 1.0);
    assert_eq!(along.directivity(Vec3::Z), 0.25);
    let between = along.directivity(Vec3::new(0.6, 0.8, 0.0));
    assert!(0.6 < between && between < 0.7, "{between}");
    for unknown in [Vec3::ZERO, Vec3::NAN] {
        let all_round = click(unknown).directivity(Vec3::X);
        assert!(0.25 < all_round && all_round < 1.0, "{all_round}");
    }
}
