//! A player's thoughts in pixels: chances on the table, and a panel that explains them.

use super::hud::{ACTIVE, FAINT, Pen, TEXT};
use glam::DVec3;
use hapticbillard::input::CameraPose;
use hapticbillard::renderer::{Label, LegendRow, ThoughtRow, ThoughtsPanel};
use three_d::egui::{Align2, Color32, Rect, Stroke, pos2, vec2};

/// Width of the panel.
const WIDTH: f32 = 300.0;
/// Height of a row.
const ROW: f32 = 19.0;
/// Width of a column of numbers.
const COLUMN: f32 = 56.0;
/// Length of a line in the legend.
const SAMPLE: f32 = 30.0;

fn colour_of(colour: [f32; 3]) -> Color32 {
    let [r, g, b] = colour.map(|channel| (channel * 255.0).round() as u8);
    Color32::from_rgb(r, g, b)
}

impl Pen<'_> {
    /// Letters at a place of the world, on a dark patch.
    pub fn label(&self, label: &Label, camera: &CameraPose) {
        let [x, y, z] = label.at.map(f64::from);
        let aspect = f64::from(self.screen.width() / self.screen.height());
        let Some([right, down]) = camera.place_of(DVec3::new(x, y, z), aspect) else { return };
        let size = self.screen.size();
        let at = self.screen.left_top() + vec2(right as f32 * size.x, down as f32 * size.y);
        let height = if label.is_bold { 17.0 } else { 13.0 };
        let (font, colour) = (self.font(height), colour_of(label.colour));
        let galley = self.painter.layout_no_wrap(label.text.clone(), font, colour);
        let patch = Rect::from_center_size(at, galley.size() + vec2(8.0, 2.0) * self.unit);
        self.painter.rect_filled(patch, 4.0 * self.unit, Color32::from_black_alpha(185));
        self.painter.galley(at - 0.5 * galley.size(), galley, colour);
    }

    /// The panel on the right, so far below the top.
    pub fn thoughts(&self, panel: &ThoughtsPanel, top: f32) {
        let (row, pad) = (ROW * self.unit, 12.0 * self.unit);
        let width = WIDTH * self.unit;
        let head = if panel.head.is_empty() { 0.0 } else { row };
        let rows = (panel.legend.len() + panel.rows.len()) as f32 * row;
        let size = vec2(width, 2.0 * pad + 1.4 * row + rows + 0.5 * row + head);
        let corner = self.screen.right_top() + vec2(-14.0 - WIDTH, top) * self.unit;
        self.panel(Rect::from_min_size(corner, size));
        let (left, right) = (corner.x + pad, corner.x + width - pad);
        let mut y = corner.y + pad;
        self.text(pos2(left, y), Align2::LEFT_TOP, &panel.title, 15.5, ACTIVE);
        y += 1.4 * row;
        for line in &panel.legend {
            self.sample(line, left, y);
            y += row;
        }
        y += 0.5 * row;
        for (column, name) in panel.head.iter().rev().enumerate() {
            let at = pos2(right - column as f32 * COLUMN * self.unit, y);
            self.text(at, Align2::RIGHT_TOP, name, 12.5, FAINT);
        }
        y += head;
        for thought in &panel.rows {
            self.thought(thought, left, right, y);
            y += row;
        }
    }

    /// A line as it is drawn on the table, and what it means.
    fn sample(&self, line: &LegendRow, left: f32, y: f32) {
        let stroke = Stroke::new(2.6 * self.unit, colour_of(line.colour));
        let middle = y + 0.45 * ROW * self.unit;
        let length = SAMPLE * self.unit;
        let pieces = if line.is_dashed { 3 } else { 1 };
        let step = length / pieces as f32;
        let dash = if line.is_dashed { 0.6 * step } else { step };
        for piece in 0..pieces {
            let from = left + piece as f32 * step;
            self.painter.line_segment([pos2(from, middle), pos2(from + dash, middle)], stroke);
        }
        let at = pos2(left + length + 10.0 * self.unit, y);
        self.text(at, Align2::LEFT_TOP, &line.text, 13.5, TEXT);
    }

    fn thought(&self, thought: &ThoughtRow, left: f32, right: f32, y: f32) {
        let colour = if thought.is_chosen { ACTIVE } else { TEXT };
        self.text(pos2(left, y), Align2::LEFT_TOP, &thought.text, 13.5, colour);
        for (column, value) in thought.values.iter().rev().enumerate() {
            let at = pos2(right - column as f32 * COLUMN * self.unit, y);
            self.text(at, Align2::RIGHT_TOP, value, 13.5, colour);
        }
    }
}
