//! Gamepads: the driver's thread in front of a mock device.

/// The desk of the core's tests. Of the devices there only the gamepad is used here.
#[allow(dead_code)]
#[path = "../core/input/desk.rs"]
mod desk;
#[allow(dead_code)]
#[path = "../core/menu/games.rs"]
mod games;

use crate::mocks::pad::PadDesk;
use games::{Device, whole_game};
use hapticbillard::input::{PadAxis, PadButton, PadInput, Rumble};
use hapticbillard_actors::input::{PadDriver, PadSource};
use std::time::Duration;

#[test]
fn whole_game_by_gamepad_only() {
    let pad = PadDesk::new();
    let port = move |done: &[PadInput]| {
        pad.does(done);
        pad.driver.take()
    };
    whole_game(Device::Pad, Box::new(port));
}

/// 1 kHz of both sticks with 200 edges among them, and a window that looks now and then.
#[test]
fn every_edge_comes_through_the_thread_and_of_each_axis_the_newest_place() {
    let pad = PadDesk::new();
    let (mut said, mut heard) = (Vec::new(), Vec::new());
    for ms in 0..2000u32 {
        let value = f64::from(ms) * 1e-3 - 1.0;
        let mut done = vec![
            PadInput::Axis { axis: PadAxis::LeftX, value },
            PadInput::Axis { axis: PadAxis::RightY, value: -value },
        ];
        if ms % 10 == 0 {
            let edge = PadInput::Button { button: PadButton::A, down: ms % 20 == 0 };
            said.push(edge);
            done.push(edge);
        }
        pad.does(&done);
        if ms % 50 == 49 {
            let look = pad.driver.take();
            let is_edge = |report: &PadInput| matches!(report, PadInput::Button { .. });
            let places: Vec<_> = look.iter().copied().filter(|one| !is_edge(one)).collect();
            let newest = [
                PadInput::Axis { axis: PadAxis::LeftX, value },
                PadInput::Axis { axis: PadAxis::RightY, value: -value },
            ];
            assert_eq!(places, newest);
            heard.extend(look.into_iter().filter(is_edge));
        }
    }
    assert_eq!(said.len(), 200);
    assert_eq!(heard, said);
}

#[test]
fn a_shake_reaches_the_device_and_a_driver_without_a_device_does_nothing() {
    let pad = PadDesk::new();
    let rumble = Rumble { strength: 0.5, duration_ms: 80 };
    pad.driver.shake(rumble);
    assert_eq!(pad.shaken.recv_timeout(Duration::from_secs(20)), Ok(rumble));

    /// Never opened.
    struct Nothing;
    impl PadSource for Nothing {
        fn next(&mut self, _: Duration) -> Option<PadInput> {
            None
        }
        fn shake(&mut self, _: Rumble) {}
    }
    let driver = PadDriver::start(|| Err::<Nothing, _>("no such system".into())).unwrap();
    driver.shake(rumble);
    assert!(driver.take().is_empty());
}
