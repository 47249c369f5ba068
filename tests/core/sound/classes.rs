use super::measure::{RATE_HZ, Spectrum, blows, centroid_hz, peak, peak_db, rms_db, sound};
use hapticbillard::sound::SoundClass;
use hapticbillard::sound::SoundClass::{
    BallClick, Chalk, CueStrike, Cushion, Floor, Gully, Landing, Miscue, Pocket,
};
use hapticbillard::sound::parameters::{
    CUE_STRIKE, CUSHION, ClassParameters, POCKET_DROP, class_parameters,
};
use std::f32::consts::PI;

fn samples_of(seconds: f32) -> usize {
    (seconds * RATE_HZ) as usize
}

/// Every mode of a row stands out at its place: twice what is around it, and no louder frequency
/// near it.
#[track_caller]
fn check_modes(samples: &[f32], row: &ClassParameters) {
    // Begins softly: a sudden begin has every frequency in it.
    let begin = samples_of(0.004) as f32;
    let soft =
        |(i, x): (usize, &f32)| x * (0.5 - 0.5 * libm::cosf(PI * (i as f32 / begin).min(1.0)));
    let samples: Vec<f32> = samples.iter().enumerate().map(soft).collect();
    let spectrum = Spectrum::of(&samples, RATE_HZ);
    for mode in row.modes {
        let hz = f64::from(mode.frequency_hz);
        let peak_hz = spectrum.peak_hz(0.92 * hz, 1.08 * hz);
        assert!((peak_hz / hz - 1.0).abs() < 0.05, "the mode of {hz} Hz is at {peak_hz} Hz");
        let width_hz = 6.0;
        let at = spectrum.between(peak_hz - width_hz, peak_hz + width_hz);
        let beside = spectrum.between(0.88 * hz - width_hz, 0.88 * hz + width_hz);
        assert!(at > 1.2 * beside, "{hz} Hz: {at} and beside it {beside}");
    }
}

#[test]
fn harder_is_louder_and_brighter() {
    for class in SoundClass::ALL.into_iter().filter(|class| class.is_impact()) {
        for variant in 1..5 {
            let mut last = (f32::NEG_INFINITY, 0.0);
            for speed_m_s in [0.05, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0] {
                let samples = sound(class, speed_m_s, variant);
                let now = (peak_db(&samples), centroid_hz(&samples));
                assert!(now.0 > last.0 + 3.0, "{class:?} at {speed_m_s} m/s: {now:?} {last:?}");
                // A miscue's hiss and its blows change places.
                let brighter = class == Miscue || now.1 > 0.99 * last.1;
                assert!(brighter, "{class:?} at {speed_m_s} m/s: {now:?} {last:?}");
                last = now;
            }
        }
    }
}

#[test]
fn a_tip_is_dull_and_the_shaft_rings() {
    for variant in 0..16 {
        for speed_m_s in [0.5, 2.0, 6.0] {
            let samples = sound(CueStrike, speed_m_s, variant);
            let low = Spectrum::of(&samples, RATE_HZ).part(0.0, 1_000.0);
            assert!(low > 0.7, "{speed_m_s} m/s, variant {variant}: {low}");
        }
        // What rings longest are the modes of the shaft.
        check_modes(&sound(CueStrike, 4.0, variant)[samples_of(0.004)..], &CUE_STRIKE);
        let duller = centroid_hz(&sound(CueStrike, 2.0, variant));
        assert!(duller < 0.5 * centroid_hz(&sound(BallClick, 2.0, variant)), "{duller} Hz");
    }
}

#[test]
fn a_miscue_is_several_contacts_and_a_scrape() {
    let (mut all, count) = (0, 64);
    for variant in 0..count {
        let samples = sound(Miscue, 2.0, variant);
        let contacts = blows(&samples[..samples_of(0.015)], samples_of(0.001), 0.3).len();
        all += contacts;
        // Above the modes of the shaft only the scrape is left.
        let scrape = Spectrum::of(&samples, RATE_HZ).part(5_000.0, 7_000.0);
        assert!(scrape > 0.005, "{scrape}");
    }
    let mean = all as f64 / f64::from(count);
    assert!((2.5..6.5).contains(&mean), "{mean} contacts in the mean");
}

#[test]
fn the_rail_rings_at_its_modes() {
    for variant in 0..16 {
        check_modes(&sound(Cushion, 2.0, variant)[samples_of(0.008)..], &CUSHION);
    }
}

#[test]
fn a_cushion_grows_as_the_speed_to_1_2_and_its_blow_gets_shorter() {
    let level = |speed_m_s| peak_db(&sound(Cushion, speed_m_s, 3));
    let more = level(2.0) - level(1.0);
    // 7.2 dB, and a little for the shorter contact.
    assert!((6.5..10.5).contains(&more), "{more} dB");
    assert!(sound(Cushion, 5.0, 3).len() < sound(Cushion, 0.5, 3).len());
}

#[test]
fn a_ball_drops_143_ms_after_it_met_the_leather() {
    for variant in 0..16 {
        let samples = sound(Pocket, 1.0, variant);
        let (before, drop) = samples.split_at(samples_of(0.1425));
        let quiet = &before[samples_of(0.05)..];
        assert!(rms_db(quiet) < rms_db(before) - 30.0, "{} dB SPL", rms_db(quiet));
        // A third of the thump's peak is reached within its first contact.
        let loud = drop.iter().position(|x| x.abs() > 0.3 * peak(drop)).unwrap();
        assert!(loud < samples_of(0.005), "{loud} samples after 142.5 ms");

        let leather = Spectrum::of(before, RATE_HZ);
        assert!(leather.part(150.0, 1_200.0) > 0.6, "{}", leather.part(150.0, 1_200.0));
        check_modes(&drop[samples_of(0.03)..], &POCKET_DROP);
    }
    // However slow it was, it falls as deep.
    let thump = |speed_m_s| peak(&sound(Pocket, speed_m_s, 1)[samples_of(0.1425)..]);
    assert_eq!(thump(0.0), thump(3.0));
}

#[test]
fn bounces_come_twice_as_fast_each_time() {
    let samples = sound(Floor, 3.0, 1);
    // The change from sample to sample has more of the clicks than of the boards.
    let changes: Vec<f32> = samples.windows(2).map(|two| two[1] - two[0]).collect();
    let bounces = blows(&changes, samples_of(0.01), 0.1);
    assert!(bounces.len() >= 3, "{bounces:?}");
    let gaps: Vec<f32> = bounces.windows(2).map(|two| (two[1] - two[0]) as f32).collect();
    // 2 e v/g: 0.306 s after 3 m/s.
    assert!((gaps[0] / RATE_HZ - 0.306).abs() < 0.01, "{gaps:?}");
    assert!((gaps[1] / gaps[0] - 0.5).abs() < 0.05, "{gaps:?}");
    // Wood under it: low modes as well as the click.
    let low = Spectrum::of(&samples, RATE_HZ).part(60.0, 350.0);
    assert!(low > 0.1, "{low}");
}

#[test]
fn a_landing_is_a_thud() {
    let thud = centroid_hz(&sound(Landing, 1.0, 1));
    assert!((150.0..900.0).contains(&thud), "{thud} Hz");
}

#[test]
fn a_ball_in_the_gully_gets_faster_and_meets_others() {
    for variant in 1..5 {
        let samples = sound(Gully, 1.0, variant);
        let length_s = samples.len() as f32 / RATE_HZ;
        assert!((1.4..2.6).contains(&length_s), "{length_s} s");
        let early = &samples[samples_of(0.2)..samples_of(0.6)];
        let late = &samples[samples_of(1.0)..samples_of(1.4)];
        assert!(rms_db(late) > rms_db(early) + 1.0);
        assert!(centroid_hz(late) > 1.1 * centroid_hz(early));
        let knock = peak(&samples[samples_of(1.4)..]);
        assert!(knock > 1.2 * peak(&samples[..samples_of(1.35)]), "{knock} Pa");
    }
}

#[test]
fn chalk_is_some_soft_strokes() {
    for variant in 0..16 {
        let samples = sound(Chalk, 1.0, variant);
        let strokes = blows(&samples, samples_of(0.1), 0.3).len();
        assert!((2..=4).contains(&strokes), "{strokes} strokes");
        let centre = centroid_hz(&samples);
        assert!((3_000.0..7_000.0).contains(&centre), "{centre} Hz");
        assert!(peak_db(&samples) < 62.0);
    }
    assert_eq!(sound(Chalk, 0.0, 1), sound(Chalk, 5.0, 1));
}

#[test]
fn every_class_has_a_row_that_can_be_heard() {
    for class in SoundClass::ALL {
        let row = class_parameters(class);
        assert_eq!(row.contact.is_none(), class == Chalk);
        for (contact, speed_m_s) in
            row.contact.iter().flat_map(|c| [0.02, 1.0, 30.0].map(|v| (c, v)))
        {
            let length_s = contact.length.at_s(speed_m_s);
            assert!((1e-4..0.01).contains(&length_s), "{class:?} at {speed_m_s} m/s: {length_s} s");
        }
        let level = peak_db(&sound(class, 1.0, 1));
        assert!((40.0..115.0).contains(&level), "{class:?}: {level} dB SPL");
    }
}

#[test]
fn a_ball_touches_wood_for_408_us_and_a_ball_for_390() {
    for (class, expected_us) in [(BallClick, 390.0), (Floor, 408.0)] {
        let length_us = class_parameters(class).contact.unwrap().length.at_s(1.0) * 1e6;
        assert!((length_us - expected_us).abs() < 1.0, "{class:?}: {length_us} us");
    }
}
