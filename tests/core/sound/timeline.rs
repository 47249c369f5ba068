//! Late by the same lead, whatever the stream does; never in the past, and all in their own order.

use hapticbillard::sound::{Stream, Timeline};

const RATE: f64 = 48_000.0;
const PERIOD: u32 = 512;

/// A stream that is read at real time `time_s`: its counter moves by whole periods.
fn at(time_s: f64) -> Stream {
    let blocks = (time_s * RATE / f64::from(PERIOD)).floor() as u64 + 1;
    Stream { now: blocks * u64::from(PERIOD), period: PERIOD }
}

/// How much later than its place in an ideal stream an onset is heard [s].
fn delay_s(frame: u64, time_s: f64) -> f64 {
    frame as f64 / RATE - time_s
}

#[test]
fn two_onsets_are_as_far_apart_as_physics_has_them() {
    let mut line = Timeline::new(RATE, 1.0);
    // Told in ticks, each up to three milliseconds late.
    let times = [0.5, 0.500_031, 0.512_4, 0.5309, 0.61, 0.7777];
    let frames: Vec<u64> = times
        .iter()
        .zip([0.0, 0.001, 0.002, 0.003, 0.0005, 0.0])
        .map(|(time_s, late_s)| line.onset(*time_s, at(time_s + late_s)))
        .collect();
    for (frame, time_s) in frames.iter().zip(times) {
        let apart = (time_s - times[0]) * RATE;
        assert!(((frame - frames[0]) as f64 - apart).abs() <= 1.0, "{frames:?}");
    }
}

#[test]
fn an_onset_told_after_a_later_one_keeps_its_distance() {
    let mut line = Timeline::new(RATE, 1.0);
    // Facts of a tick, then a landing within it, then the next tick.
    let times = [1.000_9, 1.000_2, 1.000_5, 1.001_3];
    let frames = times.map(|time_s| line.onset(time_s, at(1.001)));
    for (frame, time_s) in frames.iter().zip(times) {
        let apart = (time_s - times[0]) * RATE;
        assert!((*frame as f64 - frames[0] as f64 - apart).abs() <= 1.0, "{frames:?}");
    }
    // A ball's state does not hold back an onset, nor the other way round.
    let state = line.state(1.002, at(1.002));
    let onset = line.onset(1.001_8, at(1.002));
    assert!(onset < state && frames[3] < onset, "{onset} {state}");
}

#[test]
fn an_onset_whose_own_frame_is_over_is_not_put_into_the_past() {
    let mut line = Timeline::new(RATE, 1.0);
    let late = at(1.1);
    line.onset(1.1, late);
    assert!(late.now <= line.onset(1.05, late));
}

#[test]
fn the_lead_is_at_most_two_periods_and_five_milliseconds() {
    let most = 2.0 * f64::from(PERIOD) / RATE + 0.005 + 1e-4;
    for start_ms in 0..40 {
        let mut line = Timeline::new(RATE, 1.0);
        let time_s = 3.0 + f64::from(start_ms) * 1e-3;
        let frame = line.onset(time_s, at(time_s));
        assert!(at(time_s).now <= frame && delay_s(frame, time_s) <= most);
    }
}

#[test]
fn after_a_pause_a_lag_or_a_hurry_it_is_in_time_again_and_never_in_the_past() {
    let most = 3.0 * f64::from(PERIOD) / RATE + 0.016;
    // The game's time against the stream's: stands, lags, runs at eight times, at a quarter.
    for (game_s, pace) in [(0.0_f64, 1.0), (5.0, 1.0), (-0.2, 1.0), (1.0, 8.0), (1.0, 0.25)] {
        let mut line = Timeline::new(RATE, 1.0);
        let mut last = line.onset(1.0, at(1.0));
        for i in 0..300 {
            let real_s = 1.0 + 0.003 * f64::from(i);
            let time_s = 1.0 + game_s.max(0.0) + 0.003 * f64::from(i) * pace;
            let real_s = real_s + f64::max(-game_s, 0.0);
            let stream = at(real_s);
            let frame = line.onset(time_s, stream);
            let ahead = (frame - stream.now) as f64 / RATE;
            assert!(stream.now <= frame && last <= frame && ahead <= most, "{game_s} {pace}");
            last = frame;
        }
    }
}

#[test]
fn clocks_that_drift_apart_meet_again_in_every_silence() {
    let mut line = Timeline::new(RATE, 1.0);
    for shot in 0..200 {
        // One second of 300 ppm too fast a stream after the other.
        let time_s = f64::from(shot);
        let frame = line.onset(time_s, at(time_s * 1.000_3));
        let ahead = frame - at(time_s * 1.000_3).now;
        assert_eq!(ahead, u64::from(PERIOD) + 240, "shot {shot}");
    }
}

#[test]
fn in_slow_motion_sounds_are_as_far_apart_as_pictures() {
    let mut line = Timeline::new(RATE, 0.25);
    let first = line.onset(1.0, at(1.0));
    let second = line.onset(1.01, at(1.04));
    assert_eq!(second - first, 1920);
}

#[test]
fn what_is_no_time_is_no_trap() {
    let mut line = Timeline::new(RATE, 1.0);
    for time_s in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300] {
        let frame = line.onset(time_s, at(1.0));
        assert!((at(1.0).now..at(1.2).now).contains(&frame), "{time_s}: {frame}");
    }
}
