//! Strokes of a simulated hand on a simulated Omni, at the shipped settings.

use super::rig::{Felt, balls, drawn_back, play, stroke};
use crate::input::desk::{Desk, RATES_HZ};
use glam::DVec2;
use hapticbillard::cue::Aim;
use hapticbillard::events::FactKind;
use hapticbillard::haptic::simulated::{Guide, HandModel};
use hapticbillard::haptic::{ReachSettings, Rehearsal, telemetry};
use hapticbillard::ids::BallId;
use hapticbillard::input::HumanMode;
use hapticbillard::scene::Scene;

/// Phases of a stroke against the ticks.
const PHASES: u32 = 300;

fn aim() -> Aim {
    Aim { azimuth_rad: 0.3, elevation_rad: 0.06, ..Aim::default() }
}

/// The same stroke at so many phases.
fn strokes(ready: &Rehearsal, speed_m_s: f64, phases: u32) -> Vec<Felt> {
    let phase_s = |k: u32| 0.004 * (f64::from(k) + 0.5) / f64::from(phases);
    (0..phases).map(|k| play(ready, stroke(speed_m_s, phase_s(k)))).collect()
}

fn relative_deviation(values: impl Iterator<Item = f64> + Clone) -> f64 {
    let count = values.clone().count() as f64;
    let mean = values.clone().sum::<f64>() / count;
    let square = values.map(|value| (value - mean) * (value - mean)).sum::<f64>() / count;
    square.sqrt() / mean
}

#[test]
fn the_same_stroke_feels_the_same_at_any_phase_of_the_ticks() {
    for hand in [HandModel::GRIP, HandModel::ARM] {
        let ready = drawn_back(hand, &aim());
        for speed_m_s in [0.2, 0.5, 0.8] {
            let felt = strokes(&ready, speed_m_s, PHASES);
            let peak = relative_deviation(felt.iter().map(|felt| felt.peak_wanted_n));
            let impulse = relative_deviation(felt.iter().map(|felt| felt.impulse_ns));
            assert!(peak < 0.05 && impulse < 0.05, "{speed_m_s} m/s: {peak}, {impulse}");
            // It is felt at all, and more the faster it is.
            let least = felt.iter().map(|felt| felt.peak_sent_n).fold(f64::INFINITY, f64::min);
            assert!(least > 3.0 * speed_m_s, "{speed_m_s} m/s: {least} N");
        }
    }
}

#[test]
fn a_stroke_is_felt_within_a_tick_and_never_above_the_limit() {
    for hand in [HandModel::GRIP, HandModel::ARM] {
        let ready = drawn_back(hand, &aim());
        for speed_m_s in [0.2, 0.6, 1.0, 1.4, 2.0] {
            for felt in strokes(&ready, speed_m_s, PHASES / 5) {
                assert_eq!(felt.strikes, 1, "{speed_m_s}");
                let within = (-1e-12..=0.001 + 1e-12).contains(&felt.late_s);
                assert!(within, "{speed_m_s}: {} s", felt.late_s);
                assert!(felt.peak_sent_n <= 3.3, "{speed_m_s}: {} N", felt.peak_sent_n);
            }
        }
    }
}

#[test]
fn what_the_hand_feels_is_what_the_physics_does() {
    let ready = drawn_back(HandModel::FIRM, &aim());
    for speed_m_s in [0.2, 0.7, 1.5] {
        for felt in strokes(&ready, speed_m_s, PHASES / 10) {
            // The same law on the same ball: the closing speeds agree to rounding.
            let off = felt.contact.speed_m_s / felt.struck_m_s - 1.0;
            assert!(off.abs() < 1e-9, "{speed_m_s}: {off:e}");
        }
    }
}

/// A cue ball where the rig has it, in the exact solver, in front of somebody at a mouse.
fn desk() -> Desk {
    let table = hapticbillard::table::Table::preset("pool-9ft").unwrap();
    let place = |k: usize| balls(&table)[k].1.position;
    let text = format!(
        "[scene]\nname = \"Desk\"\n[physics]\n[table]\npreset = \"pool-9ft\"\n[cue]\n\
        [rules]\ngame = \"free-play\"\n[[player]]\nname = \"You\"\nkind = \"human\"\n\
        [input]\nprofile = \"default\"\n\
        [[ball]]\nid = 0\nposition_m = [{:?}, {:?}]\n[[ball]]\nid = 1\nposition_m = [{:?}, {:?}]\n",
        place(0).x,
        place(0).y,
        place(1).x,
        place(1).y
    );
    let mut desk = Desk::new(&Scene::parse("desk.toml", &text).unwrap());
    desk.wait(3);
    assert_eq!(desk.mode(), HumanMode::Aiming);
    desk
}

/// Velocity of the cue ball two ticks after a stroke with the mouse, how fast the tip was, and how
/// it was aimed.
fn mouse_stroke(tip_m_s: f64) -> (DVec2, f64, Aim) {
    mouse_stroke_at(tip_m_s, 1000, 0)
}

/// The same with a mouse that reports so often, begun so many ticks later.
fn mouse_stroke_at(tip_m_s: f64, rate_hz: u32, later: u64) -> (DVec2, f64, Aim) {
    let mut desk = desk();
    let aim = desk.view().aim;
    desk.wait(later);
    desk.stroke(0.38, tip_m_s, rate_hz);
    let struck = desk.facts().into_iter().find_map(|fact| match fact.kind {
        FactKind::CueBallStruck { .. } => Some(fact.time_s),
        _ => None,
    });
    let tip_m_s = desk.view().strength_m_s;
    let ball = desk.table().ball(BallId::CUE).unwrap();
    // Friction has acted since then; what it took is added again.
    let slid_s = desk.table().time_s - struck.unwrap();
    let velocity = ball.velocity.truncate();
    (velocity + velocity.normalize() * (0.2 * 9.81 * (slid_s - 0.002)), tip_m_s, aim)
}

#[test]
fn stylus_and_mouse_make_the_same_stroke() {
    let reach = ReachSettings::default();
    let gain = reach.scale * reach.stroke_gain;
    for hand_m_s in [0.2, 0.5, 1.0, 1.5, 2.0] {
        // A mouse on its short way does not quite reach what it is moved at.
        let (mouse, tip_m_s, aim) = mouse_stroke(hand_m_s * gain);
        assert!(tip_m_s > 0.9 * hand_m_s * gain);
        let hand_m_s = tip_m_s / gain;
        let ready = drawn_back(HandModel::ARM, &aim);
        for felt in strokes(&ready, hand_m_s, PHASES / 10) {
            let stylus = felt.ball.truncate();
            let speed = stylus.length() / mouse.length() - 1.0;
            assert!(speed.abs() < 0.02, "{hand_m_s} m/s: {stylus} and {mouse}, {speed}");
            let angle = mouse.angle_to(stylus).to_degrees();
            assert!(angle.abs() < 0.5, "{hand_m_s} m/s: {angle}°");
        }
    }
}

/// Mean and deviation of a hundred values, the deviation as a share of the mean.
fn spread(values: &[f64]) -> (f64, f64) {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    (mean, relative_deviation(values.iter().copied()))
}

#[test]
fn a_hundred_strokes_by_mouse_and_a_hundred_by_stylus_are_as_hard_and_as_straight() {
    let reach = ReachSettings::default();
    let gain = reach.scale * reach.stroke_gain;
    println!("tip m/s | ball by mouse m/s, spread, degrees | ball by stylus m/s, spread, degrees");
    for hand_m_s in [0.2, 1.0] {
        let mouse: Vec<(DVec2, f64, Aim)> = (0..100_u64)
            .map(|k| {
                let rate_hz = RATES_HZ[k as usize % RATES_HZ.len()];
                mouse_stroke_at(hand_m_s * gain, rate_hz, k / 3 % 17)
            })
            .collect();
        let (_, tip_m_s, aim) = mouse[0];
        let ready = drawn_back(HandModel::ARM, &aim);
        let stylus = strokes(&ready, tip_m_s / gain, 100);
        let along = DVec2::from_angle(aim.azimuth_rad);
        // Root mean square of the directions off the aim.
        let off = |ways: &[DVec2]| {
            let square = |way: &DVec2| along.angle_to(*way).to_degrees().powi(2);
            (ways.iter().map(square).sum::<f64>() / ways.len() as f64).sqrt()
        };
        let by_mouse: Vec<DVec2> = mouse.iter().map(|(ball, ..)| *ball).collect();
        let by_stylus: Vec<DVec2> = stylus.iter().map(|felt| felt.ball.truncate()).collect();
        let speeds = |ways: &[DVec2]| ways.iter().map(|way| way.length()).collect::<Vec<f64>>();
        let (mouse, stylus) = (spread(&speeds(&by_mouse)), spread(&speeds(&by_stylus)));
        let (off_mouse, off_stylus) = (off(&by_mouse), off(&by_stylus));
        println!(
            "{tip_m_s:.2} | {:.3}, {:.2} %, {off_mouse:.3} | {:.3}, {:.2} %, {off_stylus:.3}",
            mouse.0,
            100.0 * mouse.1,
            stylus.0,
            100.0 * stylus.1,
        );
        assert!((stylus.0 / mouse.0 - 1.0).abs() < 0.05);
        assert!(mouse.1 < 0.05 && stylus.1 < 0.05);
        assert!(off_mouse < 0.5 && off_stylus < 0.5);
    }
}

#[test]
fn a_hand_at_one_and_a_half_metres_a_second_breaks_harder_than_8_m_s() {
    let ready = drawn_back(HandModel::ARM, &aim());
    let felt = play(&ready, stroke(1.5, 0.0));
    assert!(felt.ball.length() > 8.0, "{}", felt.ball);
}

#[test]
fn the_same_stroke_gives_the_same_bits() {
    let told = || {
        let mut rig = drawn_back(HandModel::FIRM, &aim());
        *rig.device.guide_mut() = Guide::Script(stroke(0.9, 0.000_3));
        (0..300).map(|_| telemetry::row(&rig.tick().unwrap(), 0.0)).collect::<Vec<_>>()
    };
    assert_eq!(told(), told());
}
