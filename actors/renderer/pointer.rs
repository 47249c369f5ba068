//! The pointer: movements of the mouse that never end at the edge of a window.

use winit::dpi::PhysicalPosition;
use winit::window::{CursorGrabMode, Window};

/// How a window gets movements out of its system.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Held {
    /// The pointer is free.
    Free,
    /// The system locks it and reports movements of the device.
    Locked,
    /// It stays inside, and is put back to the middle before it reaches an edge.
    PutBack,
}

/// A pointer that is caught while somebody plays.
#[derive(Debug)]
pub struct Pointer {
    held: Held,
    last: Option<PhysicalPosition<f64>>,
    /// Where it was put back to, until it is seen there.
    put_to: Option<PhysicalPosition<f64>>,
}

impl Pointer {
    /// A free pointer.
    pub fn new() -> Self {
        Pointer { held: Held::Free, last: None, put_to: None }
    }

    /// Whether it is caught.
    pub fn is_caught(&self) -> bool {
        self.held != Held::Free
    }

    /// Where it is in the window [pixels], while it is free.
    pub fn place(&self) -> Option<(f64, f64)> {
        self.last.filter(|_| !self.is_caught()).map(|place| (place.x, place.y))
    }

    /// Catches it; what a system cannot do it goes without.
    pub fn catch(&mut self, window: &Window) {
        self.held = if window.set_cursor_grab(CursorGrabMode::Locked).is_ok() {
            Held::Locked
        } else {
            // Where it cannot be confined either, putting it back is enough.
            let _ = window.set_cursor_grab(CursorGrabMode::Confined);
            Held::PutBack
        };
        window.set_cursor_visible(false);
    }

    /// Sets it free.
    pub fn release(&mut self, window: &Window) {
        // It is free already where it could not be caught.
        let _ = window.set_cursor_grab(CursorGrabMode::None);
        window.set_cursor_visible(true);
        *self = Pointer { last: self.last, ..Pointer::new() };
    }

    /// The device moved by so many of its counts: a movement to the right and down, if those are
    /// what counts.
    pub fn device_moved(&self, delta: (f64, f64)) -> Option<(f64, f64)> {
        (self.held == Held::Locked).then_some(delta)
    }

    /// The pointer is here now: a movement to the right and down [pixels].
    pub fn at(&mut self, place: PhysicalPosition<f64>, window: &Window) -> Option<(f64, f64)> {
        if self.held != Held::PutBack {
            self.last = Some(place);
            return None;
        }
        let (moved, put) = self.follow(place, window.inner_size().into());
        if let Some(middle) = put
            && window.set_cursor_position(middle).is_err()
        {
            self.put_to = None;
        }
        moved
    }

    /// The movement to `place` in a window of this size, and where to put the pointer back to.
    fn follow(
        &mut self,
        place: PhysicalPosition<f64>,
        (width, height): (f64, f64),
    ) -> (Option<(f64, f64)>, Option<PhysicalPosition<f64>>) {
        let apart = |a: PhysicalPosition<f64>, b: PhysicalPosition<f64>| (a.x - b.x, a.y - b.y);
        let square = |(x, y): (f64, f64)| x * x + y * y;
        // Reports from before it was put back may still be under way: they are near the old place.
        if let (Some(put), Some(last)) = (self.put_to, self.last)
            && square(apart(place, put)) < square(apart(place, last))
        {
            self.put_to = None;
            self.last = Some(put);
        }
        let moved = self.last.map(|last| apart(place, last)).filter(|by| *by != (0.0, 0.0));
        self.last = Some(place);
        let middle = PhysicalPosition::new((0.5 * width).floor(), (0.5 * height).floor());
        let away = apart(place, middle);
        let is_far = 0.25 * width < away.0.abs() || 0.25 * height < away.1.abs();
        if is_far && self.put_to.is_none() {
            self.put_to = Some(middle);
            return (moved, Some(middle));
        }
        (moved, None)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: (f64, f64) = (800.0, 600.0);

    fn place(x: f64, y: f64) -> PhysicalPosition<f64> {
        PhysicalPosition::new(x, y)
    }

    #[test]
    fn a_pointer_that_is_put_back_loses_no_movement() {
        let mut pointer = Pointer { held: Held::PutBack, ..Pointer::new() };
        assert_eq!(pointer.follow(place(400.0, 300.0), SIZE), (None, None));
        assert_eq!(pointer.follow(place(500.0, 300.0), SIZE), (Some((100.0, 0.0)), None));
        let (moved, put) = pointer.follow(place(610.0, 300.0), SIZE);
        assert_eq!((moved, put), (Some((110.0, 0.0)), Some(place(400.0, 300.0))));
        // A report that was under way, then the first from the middle.
        assert_eq!(pointer.follow(place(630.0, 300.0), SIZE), (Some((20.0, 0.0)), None));
        assert_eq!(pointer.follow(place(405.0, 302.0), SIZE), (Some((5.0, 2.0)), None));
    }
}
