//! A gamepad: what it says, what its trigger strokes, what is felt of a contact.

use super::desk::{Desk, free_play};
use glam::DVec2;
use hapticbillard::events::{Fact, FactKind};
use hapticbillard::ids::BallId;
use hapticbillard::input::feel::{KEY_SPEED_LEAST_M_S, KEY_SPEED_MOST_M_S};
use hapticbillard::input::{HumanMode, PadAxis, PadButton, PadInput, PadQueue, RawInput, Rumble};

fn axis(axis: PadAxis, value: f64) -> RawInput {
    RawInput::Pad(PadInput::Axis { axis, value })
}

/// Presses the trigger within 100 ms, holds it for 400 ms, and lets it go within so many; what was
/// shown before and what was made [m/s].
fn stroke(pressed: f64, back_ms: u32) -> (f64, f64) {
    let mut desk = Desk::new(&free_play(&[(0, -0.4, 0.0), (1, 0.9, 0.5)]));
    desk.wait(400);
    for n in 1..=100 {
        desk.tick(&[axis(PadAxis::RightTrigger, pressed * f64::from(n) / 100.0)]);
    }
    desk.wait(400);
    let shown = desk.view().strength_m_s;
    for n in 1..=back_ms {
        let left = 1.0 - f64::from(n) / f64::from(back_ms);
        desk.tick(&[axis(PadAxis::RightTrigger, pressed * left)]);
    }
    desk.wait_until(3000, |desk| desk.mode() != HumanMode::Stroking);
    (shown, desk.view().strength_m_s)
}

#[test]
fn a_trigger_strokes_as_hard_as_it_was_held() {
    let mut speeds = Vec::new();
    for pressed in [0.15, 0.3, 0.5, 0.7, 0.85, 1.0] {
        for back_ms in [1, 30, 80] {
            let (shown, made) = stroke(pressed, back_ms);
            let off = (made - shown).abs();
            // A finger that takes its time makes it softer.
            let share = if back_ms < 50 { 0.07 } else { 0.15 };
            assert!(
                off < share * shown + 0.02,
                "{pressed} in {back_ms} ms: {made}, not {shown} m/s"
            );
            speeds.push(made);
        }
    }
    let least = speeds.iter().copied().fold(f64::INFINITY, f64::min);
    let most = speeds.iter().copied().fold(0.0, f64::max);
    println!("strokes by trigger: {least:.2} to {most:.2} m/s: {speeds:.2?}");
    assert!(least < KEY_SPEED_LEAST_M_S + 0.08 && 0.95 * KEY_SPEED_MOST_M_S < most);
}

#[test]
fn a_trigger_that_is_eased_off_strikes_nothing() {
    let mut desk = Desk::new(&free_play(&[(0, -0.4, 0.0), (1, 0.9, 0.5)]));
    desk.wait(400);
    desk.tick(&[axis(PadAxis::RightTrigger, 0.8)]);
    desk.wait(400);
    assert_eq!(desk.mode(), HumanMode::Stroking);
    for n in 0..2000 {
        desk.tick(&[axis(PadAxis::RightTrigger, 0.8 - 0.0004 * f64::from(n))]);
    }
    assert_eq!((desk.mode(), desk.tips()), (HumanMode::Aiming, 0));
    // A gamepad that goes in the middle of a stroke leaves no cue in the air, and stops time.
    desk.tick(&[axis(PadAxis::RightTrigger, 0.9)]);
    desk.wait(100);
    desk.tick(&[RawInput::Pad(PadInput::Lost)]);
    desk.wait(500);
    assert_eq!((desk.mode(), desk.tips()), (HumanMode::Paused, 0));
    let start = |down| RawInput::Pad(PadInput::Button { button: PadButton::Start, down });
    desk.tick(&[start(true)]);
    desk.tick(&[start(false)]);
    desk.wait(500);
    assert_eq!((desk.mode(), desk.tips()), (HumanMode::Aiming, 0));
}

#[test]
fn sticks_turn_raise_and_shift_finely_with_a_shoulder() {
    let mut desk = Desk::new(&free_play(&[(0, -0.4, 0.0), (1, 0.9, 0.5)]));
    desk.wait(400);
    let aim = |desk: &Desk| desk.view().aim;
    let before = aim(&desk);
    desk.tick(&[axis(PadAxis::LeftX, -1.0)]);
    desk.wait(99);
    desk.tick(&[axis(PadAxis::LeftX, 0.05)]);
    let coarse = aim(&desk).azimuth_rad - before.azimuth_rad;
    assert!((coarse - 0.12).abs() < 1e-9, "a tenth of a second at 1.2 rad/s: {coarse}");
    let shoulder = |down| RawInput::Pad(PadInput::Button { button: PadButton::LeftShoulder, down });
    desk.tick(&[shoulder(true), axis(PadAxis::LeftX, -1.0)]);
    desk.wait(99);
    desk.tick(&[shoulder(false), axis(PadAxis::LeftX, 0.0)]);
    let fine = aim(&desk).azimuth_rad - before.azimuth_rad - coarse;
    assert!((fine - 0.1 * coarse).abs() < 1e-9, "{fine}");
    desk.tick(&[axis(PadAxis::LeftY, 1.0), axis(PadAxis::RightY, -1.0)]);
    desk.wait(200);
    let now = aim(&desk);
    assert!(now.elevation_rad > before.elevation_rad && now.height_offset < -0.04, "{now:?}");
    desk.tick(&[axis(PadAxis::LeftY, 0.0), axis(PadAxis::RightY, 0.0)]);
    let still = aim(&desk);
    desk.wait(100);
    assert_eq!(aim(&desk), still);
}

/// A thousand movements a second and 200 edges, looked at 20 times a second.
#[test]
fn all_edges_come_in_order_and_of_an_axis_one_place_a_look() {
    let mut queue = PadQueue::default();
    let (mut said, mut heard): (Vec<PadInput>, Vec<PadInput>) = Default::default();
    let mut last = DVec2::ZERO;
    for ms in 0..2000u32 {
        let place = DVec2::from_angle(f64::from(ms) * 0.01);
        queue.say(PadInput::Axis { axis: PadAxis::LeftX, value: place.x });
        queue.say(PadInput::Axis { axis: PadAxis::LeftY, value: place.y });
        if ms % 10 == 3 {
            let button = [PadButton::A, PadButton::B, PadButton::X][(ms / 10) as usize % 3];
            let edge = PadInput::Button { button, down: ms % 20 == 3 };
            queue.say(edge);
            said.push(edge);
        }
        if ms % 50 == 49 {
            let look = queue.take();
            let of = |wanted| {
                let value = move |report: &PadInput| match report {
                    PadInput::Axis { axis, value } if *axis == wanted => Some(*value),
                    _ => None,
                };
                look.iter().filter_map(value).collect::<Vec<_>>()
            };
            let (x, y) = (of(PadAxis::LeftX), of(PadAxis::LeftY));
            assert_eq!((x.len(), y.len()), (1, 1), "at most one place");
            last = DVec2::new(x[0], y[0]);
            assert_eq!(last, place, "the newest");
            let edges = look.into_iter().filter(|report| matches!(report, PadInput::Button { .. }));
            heard.extend(edges);
        }
    }
    assert_eq!(said.len(), 200);
    assert_eq!(heard, said);
    assert!(queue.take().is_empty() && queue.lost() == 0 && last != DVec2::ZERO);
}

#[test]
fn what_nobody_looks_at_is_lost_and_counted() {
    let mut queue = PadQueue::default();
    for n in 0..5000 {
        queue.say(PadInput::Button { button: PadButton::A, down: n % 2 == 0 });
    }
    let left = queue.take();
    assert_eq!(left[0], PadInput::Lost);
    assert_eq!(left.len() as u64 - 1 + queue.lost(), 5000);
}

#[test]
fn a_harder_contact_is_felt_harder_and_a_soft_one_not_at_all() {
    let tip = |speed: f64| FactKind::CueBallStruck {
        ball: BallId::CUE,
        push: false,
        moving: false,
        player: None,
        miscue: false,
        position_m: glam::DVec3::ZERO,
        normal_speed_m_s: speed,
    };
    let felt = |kind| Rumble::of(&Fact { time_s: 0.0, kind }).map(|rumble| rumble.strength);
    assert_eq!(felt(tip(0.1)), None);
    assert_eq!(felt(tip(30.0)), Some(1.0));
    let strengths: Vec<f64> = (1..20).filter_map(|n| felt(tip(f64::from(n) * 0.5))).collect();
    assert!(strengths.is_sorted() && strengths[0] > 0.15, "{strengths:?}");
    let balls = FactKind::BallsCollided {
        a: BallId::CUE,
        b: BallId(1),
        in_kitchen: false,
        position_m: glam::DVec3::ZERO,
        normal_speed_m_s: 8.0,
    };
    assert_eq!(felt(balls), Some(0.5), "what the hand holds is felt most");
    assert_eq!(felt(FactKind::BallOffTable { ball: BallId::CUE }), None);
}
