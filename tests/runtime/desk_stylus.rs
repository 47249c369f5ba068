//! A stylus that points at menus while no game has its device.

use glam::{DVec2, DVec3};
use hapticbillard::haptic::{Buttons, Device, DeviceSpec, DeviceState, Force};
use hapticbillard::input::{Button, StylusMouse, StylusSays};
use hapticbillard_actors::haptic::Opened;
use hapticbillard_actors::renderer::DeskStylus;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU8, AtomicU64, Ordering};
use std::time::{Duration, Instant};

const WINDOW: DVec2 = DVec2::new(1600.0, 1200.0);

/// What test and device know of each other.
#[derive(Default)]
struct Wires {
    /// To the right of the middle [mm], and what is held.
    x_mm: AtomicU64,
    held: AtomicU8,
    was_pushed: AtomicBool,
    is_gone: AtomicBool,
}

struct Wired(Arc<Wires>);

impl Device for Wired {
    fn spec(&self) -> DeviceSpec {
        DeviceSpec::OMNI
    }

    fn read(&mut self, _: f64) -> DeviceState {
        let x_mm = self.0.x_mm.load(Ordering::SeqCst) as f64;
        DeviceState {
            position: DVec3::X * (x_mm * 1e-3),
            buttons: Buttons(self.0.held.load(Ordering::SeqCst)),
            ..DeviceState::default()
        }
    }

    fn write(&mut self, force: Force) {
        if force != Force::ZERO {
            self.0.was_pushed.store(true, Ordering::SeqCst);
        }
    }
}

impl Drop for Wired {
    fn drop(&mut self) {
        self.0.is_gone.store(true, Ordering::SeqCst);
    }
}

#[test]
fn a_stylus_points_and_clicks_without_a_game_without_force_and_is_let_go() {
    let wires = Arc::new(Wires::default());
    let mut stylus = DeskStylus::start(Opened::new(Wired(wires.clone()))).unwrap();
    let mut mouse = StylusMouse::default();
    // Where it lies at first it has not pointed to.
    std::thread::sleep(Duration::from_millis(20));
    assert!(stylus.says(&mut mouse, WINDOW).is_empty());
    let mut said = Vec::new();
    let start = Instant::now();
    let mut until = |what: StylusSays| {
        while said.last() != Some(&what) {
            assert!(start.elapsed() < Duration::from_secs(60), "{what:?} in vain: {said:?}");
            said.extend(stylus.says(&mut mouse, WINDOW));
            std::thread::sleep(Duration::from_millis(2));
        }
        std::mem::take(&mut said)
    };
    // 160 mm are 1600 pixels; the middle is at 800.
    for x_mm in [20, 60] {
        wires.x_mm.store(x_mm, Ordering::SeqCst);
        until(StylusSays::Points(DVec2::new(800.0 + 10.0 * x_mm as f64, 600.0)));
    }
    let button = Button::Left;
    for down in [true, false] {
        wires.held.store(u8::from(down), Ordering::SeqCst);
        assert_eq!(until(StylusSays::Button { button, down }).len(), 1);
    }
    for down in [true, false] {
        wires.held.store(2 * u8::from(down), Ordering::SeqCst);
        assert_eq!(until(StylusSays::Rear { down }).len(), 1);
    }
    drop(stylus);
    assert!(wires.is_gone.load(Ordering::SeqCst), "the device is still open");
    assert!(!wires.was_pushed.load(Ordering::SeqCst));
}
