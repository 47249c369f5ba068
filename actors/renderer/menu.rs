//! A page of a menu in pixels.

use super::hud::{ACTIVE, FAINT, FOUL, Pen, TEXT};
use hapticbillard::renderer::{Area, MenuLayout, MenuLine, MenuPanel};
use three_d::egui::{Align2, Color32, Rect, Shape, pos2, vec2};

const GROUND: Color32 = Color32::from_rgba_premultiplied(7, 8, 10, 214);
const MEANT: Color32 = Color32::from_rgba_premultiplied(62, 50, 22, 150);
const DEAD: Color32 = Color32::from_rgb(98, 97, 92);
const RAIL: Color32 = Color32::from_gray(58);

impl Pen<'_> {
    pub(super) fn menu(&self, panel: &MenuPanel) {
        let size = (f64::from(self.screen.width()), f64::from(self.screen.height()));
        let layout = MenuLayout::new(size, panel.lines.len());
        // Lengths are the menu's own: it shrinks where it would not fit.
        let pen = Pen { unit: layout.unit as f32, ..*self };
        pen.page(panel, &layout);
    }

    fn page(&self, panel: &MenuPanel, layout: &MenuLayout) {
        let page = rect(layout.page);
        self.painter.rect_filled(page, 10.0 * self.unit, GROUND);
        let edge = Rect::from_min_size(page.min, vec2(4.0 * self.unit, page.height()));
        self.painter.rect_filled(edge, 2.0 * self.unit, ACTIVE);

        let title = rect(layout.title());
        let at = pos2(rect(layout.line(0)).left() + 12.0 * self.unit, title.center().y);
        self.text(at, Align2::LEFT_CENTER, &panel.title, 34.0, ACTIVE);
        for (n, line) in panel.lines.iter().enumerate() {
            self.line(n, line, layout);
        }
        self.foot(panel, layout);
    }

    fn line(&self, n: usize, line: &MenuLine, layout: &MenuLayout) {
        let area = rect(layout.line(n));
        if line.is_meant {
            self.painter.rect_filled(area.shrink(2.0 * self.unit), 6.0 * self.unit, MEANT);
        }
        let colour = match (line.is_live, line.is_meant) {
            (false, _) => DEAD,
            (true, true) => ACTIVE,
            (true, false) => TEXT,
        };
        let at = area.left_center() + vec2(12.0 * self.unit, 0.0);
        self.text(at, Align2::LEFT_CENTER, &line.text, 20.0, colour);
        let Some(value) = &line.value else { return };
        match line.fill {
            Some(fill) => self.scale(n, value, fill as f32, colour, layout),
            None => self.choice(n, value, line, colour, layout),
        }
    }

    /// A value, between two arrows if there are others.
    fn choice(&self, n: usize, value: &str, line: &MenuLine, colour: Color32, at: &MenuLayout) {
        let area = rect(at.value(n));
        self.text(area.center(), Align2::CENTER_CENTER, value, 18.0, colour);
        if !line.is_choice {
            return;
        }
        let arrow = if line.is_live { FAINT } else { DEAD };
        let reach = 0.5 * area.width() - 10.0 * self.unit;
        for side in [-1.0, 1.0] {
            let middle = area.center() + vec2(side * reach, 0.0);
            let corner = |x: f32, y: f32| middle + vec2(side * x, y) * self.unit;
            let corners = vec![corner(5.0, 0.0), corner(-3.0, -6.0), corner(-3.0, 6.0)];
            self.painter.add(Shape::convex_polygon(corners, arrow, (0.0, arrow)));
        }
    }

    /// A scale with a handle, and its value.
    fn scale(&self, n: usize, value: &str, fill: f32, colour: Color32, layout: &MenuLayout) {
        let rail = rect(layout.scale(n));
        let round = 0.5 * rail.height();
        self.painter.rect_filled(rail, round, RAIL);
        let handle = pos2(rail.left() + fill * rail.width(), rail.center().y);
        let full = rail.with_max_x(handle.x);
        self.painter.rect_filled(full, round, colour.gamma_multiply(0.7));
        self.painter.circle_filled(handle, 1.15 * rail.height(), colour);
        let at = pos2(rect(layout.line(n)).right() - 6.0 * self.unit, rail.center().y);
        self.text(at, Align2::RIGHT_CENTER, value, 17.0, colour);
    }

    fn foot(&self, panel: &MenuPanel, layout: &MenuLayout) {
        let foot = rect(layout.foot()).shrink2(vec2(32.0, 10.0) * self.unit);
        let (text, colour) = match &panel.notice {
            Some(notice) => (notice, FOUL),
            None => (&panel.hint, FAINT),
        };
        let galley = self.painter.layout(text.clone(), self.font(13.5), colour, foot.width());
        self.painter.galley(foot.left_top(), galley, colour);
    }
}

fn rect(area: Area) -> Rect {
    let Area { x, y, width, height } = area;
    Rect::from_min_size(pos2(x as f32, y as f32), vec2(width as f32, height as f32))
}
