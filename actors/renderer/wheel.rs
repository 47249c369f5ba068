//! The wheel menu and the pointer of a stylus, in pixels.

use super::hud::{ACTIVE, FAINT, Pen, TEXT};
use hapticbillard::renderer::WheelPanel;
use three_d::egui::{Align2, Color32, Pos2, Stroke, pos2, vec2};

const GROUND: Color32 = Color32::from_rgba_premultiplied(7, 8, 10, 214);
const MEANT: Color32 = Color32::from_rgba_premultiplied(74, 58, 22, 236);
const SPOKE: Color32 = Color32::from_rgba_premultiplied(40, 40, 40, 120);

impl Pen<'_> {
    pub(super) fn wheel(&self, wheel: &WheelPanel) {
        let centre = place(wheel.centre);
        for item in &wheel.items {
            let spoke = Stroke::new(2.0 * self.unit, if item.is_meant { ACTIVE } else { SPOKE });
            self.painter.line_segment([centre, place(item.at)], spoke);
        }
        self.painter.circle_filled(centre, wheel.hub as f32, GROUND);
        self.painter.circle_stroke(centre, wheel.hub as f32, Stroke::new(self.unit, FAINT));
        for item in &wheel.items {
            let (at, radius) = (place(item.at), item.radius as f32);
            let (ground, colour) = if item.is_meant { (MEANT, ACTIVE) } else { (GROUND, TEXT) };
            self.painter.circle_filled(at, radius, ground);
            let edge = Stroke::new(1.5 * self.unit, if item.is_meant { ACTIVE } else { SPOKE });
            self.painter.circle_stroke(at, radius, edge);
            let lines: Vec<&str> = item.text.split('\n').collect();
            for (n, line) in lines.iter().enumerate() {
                let down = (n as f32 - 0.5 * (lines.len() as f32 - 1.0)) * 15.0 * self.unit;
                self.text(at + vec2(0.0, down), Align2::CENTER_CENTER, line, 13.5, colour);
            }
        }
        self.pointer(place(wheel.pointer));
    }

    /// Where a stylus points.
    pub(super) fn pointer(&self, at: Pos2) {
        let radius = 7.0 * self.unit;
        self.painter.circle_stroke(at, radius, Stroke::new(3.5 * self.unit, Color32::BLACK));
        self.painter.circle_stroke(at, radius, Stroke::new(2.0 * self.unit, ACTIVE));
        self.painter.circle_filled(at, 2.0 * self.unit, ACTIVE);
    }
}

fn place([x, y]: [f64; 2]) -> Pos2 {
    pos2(x as f32, y as f32)
}
