//! Left and right, near and far.

use super::rig::*;
use glam::Vec3;
use hapticbillard::sound::level::FULL_SCALE_PA;
use hapticbillard::sound::{Bank, MixSettings, Mixer, Onset, Voice};
use realfft::RealFftPlanner;

#[test]
fn twice_as_far_is_half_as_loud() {
    for from in [0.5, 1.0, 2.0, 4.0] {
        let level = |distance_m: f32| {
            let onset = click(Vec3::new(0.0, distance_m, 0.0), 1.0);
            energy(&channel(&heard(&mut field(), &onset), 0)).sqrt()
        };
        let fall = decibel(level(2.0 * from) / level(from));
        assert!((fall + 6.02).abs() < 0.5, "{from} m: {fall} dB");
    }
}

#[test]
fn each_metre_takes_2_9_milliseconds() {
    for rate_hz in [48_000.0, 44_100.0, 96_000.0] {
        let heard = |distance_m: f32| {
            let mut mixer = with(MixSettings { rate_hz, ..MixSettings::default() });
            channel(&heard(&mut mixer, &click(Vec3::new(0.0, distance_m, 0.0), 1.0)), 0)
        };
        let near = heard(1.0);
        for further_m in [0.5, 1.0, 3.0, 4.13] {
            let found = lag(&near, &heard(1.0 + further_m), 2_000);
            let right = f64::from(further_m / SOUND_M_S * rate_hz);
            assert!((found - right).abs() < 1.0, "{rate_hz} Hz, {further_m} m: {found} {right}");
        }
    }
}

#[test]
fn full_scale_is_the_pressure_that_it_stands_for() {
    // From the right loudspeaker alone, at 1 m, along the line of the impact.
    let onset = Onset { axis: Vec3::X, ..click(Vec3::X, 5.0) };
    let heard = channel(&heard(&mut loudspeakers(), &onset), 1);
    let mut voice = Voice::begin(&onset, Bank::EMPTY, RATE_HZ);
    let mut said = vec![0.0; heard.len()];
    voice.fill(Bank::EMPTY, &mut said);
    let off_db = decibel((energy(&heard) / energy(&said)).sqrt() * f64::from(FULL_SCALE_PA));
    assert!(off_db.abs() < 0.1, "{off_db} dB");
}

/// Level of the right ear over the left one at a frequency [dB].
fn level_difference_db(heard: &[[f32; 2]], frequency_hz: f32) -> f64 {
    let fft = RealFftPlanner::<f32>::new().plan_fft_forward(heard.len());
    let level = |ear: usize| {
        let mut spectrum = fft.make_output_vec();
        fft.process(&mut channel(heard, ear), &mut spectrum).unwrap();
        f64::from(spectrum[(frequency_hz / RATE_HZ * heard.len() as f32) as usize].norm())
    };
    decibel(level(1) / level(0))
}

#[test]
fn from_the_side_the_far_ear_is_in_the_shadow_of_the_head() {
    let heard = heard(&mut field(), &click(Vec3::new(2.0, 0.0, 0.0), 3.0));
    let difference = level_difference_db(&heard, 3_000.0);
    assert!((6.0..20.0).contains(&difference), "{difference} dB");
    // Low notes go round it.
    let low = level_difference_db(&heard, 200.0);
    assert!((0.0..3.0).contains(&low), "{low} dB");
}

/// Delay of an ear's answer to a click of one sample [frames]: its centre of mass, less what the
/// shadow of the head adds to that, (1 - α) / 2ω₀ with α of the angle from the ear's axis.
fn delay(answer: &[f32], towards: f64) -> f64 {
    let (mass, moment) = answer.iter().enumerate().fold((0.0, 0.0), |(mass, moment), (i, x)| {
        (mass + f64::from(*x), moment + f64::from(*x) * i as f64)
    });
    let alpha = 1.05 + 0.95 * libm::cos(1.2 * libm::acos(towards));
    moment / mass - (1.0 - alpha) * 0.0875 / (2.0 * 343.0) * f64::from(RATE_HZ)
}

#[test]
fn from_the_side_the_far_ear_hears_31_frames_later() {
    let later = |azimuth_deg: f32, distance_m: f32| {
        let angle = azimuth_deg.to_radians();
        let place = Vec3::new(libm::sinf(angle), libm::cosf(angle), 0.0) * distance_m;
        let heard = heard(&mut impulses(), &click(place, 1.0));
        let sine = f64::from(libm::sinf(angle));
        delay(&channel(&heard, 0), -sine) - delay(&channel(&heard, 1), sine)
    };
    for distance_m in [2.0, 5.0, 10.0] {
        let side = later(90.0, distance_m);
        assert!((side - 31.0).abs() < 1.0, "{distance_m} m: {side}");
    }
    // Woodworth: a/c (θ + sin θ).
    for azimuth_deg in [0.0, 15.0, 30.0, 60.0, 120.0, 150.0, 180.0_f32] {
        let sine = libm::sin(f64::from(azimuth_deg.to_radians()));
        let right = 0.0875 / 343.0 * 48_000.0 * (libm::asin(sine) + sine);
        let found = later(azimuth_deg, 5.0);
        assert!((found - right).abs() < 0.3, "{azimuth_deg}°: {found} {right}");
    }
}

#[test]
fn a_mirrored_source_is_heard_with_the_ears_swapped_and_nothing_else() {
    for make in [field, loudspeakers] {
        for place in [
            Vec3::new(2.0, 0.0, 0.0),
            Vec3::new(0.1, 0.7, -0.3),
            Vec3::new(0.04, 0.01, 0.0),
            Vec3::new(1.3, -2.1, 0.9),
        ] {
            let mirror = Vec3::new(-1.0, 1.0, 1.0);
            let axis = Vec3::new(0.6, 0.64, 0.48);
            let mut onset = click(place, 5.0);
            onset.axis = axis;
            let right = both(&mut make(), &onset, Vec3::new(-3.0, 2.0, 0.0));
            (onset.position_m, onset.axis) = (place * mirror, axis * mirror);
            let left = both(&mut make(), &onset, Vec3::new(3.0, 2.0, 0.0));
            let swapped: Vec<_> = left.iter().map(|[a, b]| [*b, *a]).collect();
            assert!(right == swapped, "{place}");
            assert!(right != left, "{place}");
        }
    }
}

/// A click and a ball that rolls away from there.
fn both(mixer: &mut Mixer, onset: &Onset, velocity: Vec3) -> Vec<[f32; 2]> {
    mixer.roll(&rolling(3, onset.position_m, velocity));
    heard(mixer, onset)
}

#[test]
fn between_loudspeakers_the_power_is_the_same_everywhere() {
    let powers: Vec<f64> = (0..=36_u8)
        .map(|i| {
            let angle = f32::from(i) * 10.0_f32.to_radians();
            let place = Vec3::new(libm::sinf(angle), libm::cosf(angle), 0.0) * 2.0;
            let heard = heard(&mut loudspeakers(), &click(place, 1.0));
            energy(&channel(&heard, 0)) + energy(&channel(&heard, 1))
        })
        .collect();
    for power in &powers {
        assert!((power / powers[0] - 1.0).abs() < 1e-3, "{powers:?}");
    }
    let from_the_right = heard(&mut loudspeakers(), &click(Vec3::X, 1.0));
    assert!(peak(&channel(&from_the_right, 0)) < 1e-6 * peak(&channel(&from_the_right, 1)));
}

#[test]
fn inside_the_head_it_is_no_louder_than_near_it() {
    let near = peak(&channel(&heard(&mut field(), &click(Vec3::Y * 0.3, 0.3)), 0));
    for place in [Vec3::ZERO, Vec3::X * 1e-20, Vec3::Y * 0.01, Vec3::X * 0.0875] {
        let inside = heard(&mut field(), &click(place, 0.3));
        for ear in 0..2 {
            let inside = peak(&channel(&inside, ear));
            assert!(inside > 0.1 * near && inside < 2.1 * near, "{place}: {inside} {near}");
        }
    }
}
