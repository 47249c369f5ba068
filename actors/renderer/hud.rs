//! The head-up display in pixels: what the core wrote, laid out for the size of the window.

use hapticbillard::ids::BallId;
use hapticbillard::renderer::{
    DrawList, FeltPanel, Gauge, Hud, Remaining, SeatPanel, TipDial, ball_look, force_colour,
};
use three_d::egui::{
    Align2, Color32, FontId, Painter, Pos2, Rect, Stroke, StrokeKind, Vec2, pos2, vec2,
};

const PANEL: Color32 = Color32::from_rgba_premultiplied(8, 9, 11, 190);
pub(super) const TEXT: Color32 = Color32::from_rgb(236, 234, 226);
pub(super) const FAINT: Color32 = Color32::from_rgb(176, 174, 166);
pub(super) const ACTIVE: Color32 = Color32::from_rgb(255, 205, 96);
pub(super) const FOUL: Color32 = Color32::from_rgb(255, 128, 108);

/// Draws the labels of a picture and the display over a window of the painter's size, so many times
/// as large as usual.
pub fn paint(painter: &Painter, list: &DrawList, hud: &Hud, scale: f32) {
    let screen = painter.clip_rect();
    let unit = unit_for(screen, scale);
    let pen = Pen { painter, screen, unit };
    for label in &list.labels {
        pen.label(label, &list.camera);
    }
    pen.seats(&hud.seats);
    pen.message(hud);
    pen.hint(hud);
    if let Some((title, text)) = &hud.lesson {
        pen.lesson(title, text);
    }
    pen.call(hud.call.as_deref());
    pen.options(&hud.options);
    if let Some(tip) = &hud.tip {
        pen.tip(tip, hud.elevation.as_deref());
    }
    if let Some(gauge) = &hud.strength {
        pen.strength(gauge);
    }
    if let Some(panel) = &hud.felt {
        pen.felt(panel, if hud.seats.is_empty() { 14.0 } else { 98.0 });
    }
    if let Some(panel) = &hud.thoughts {
        pen.thoughts(panel, if hud.seats.len() < 2 { 14.0 } else { 98.0 });
    }
    if let Some(panel) = &hud.meters {
        pen.meters(panel);
    }
    if let Some(wheel) = &hud.wheel {
        pen.wheel(wheel);
    }
    if let Some(menu) = &hud.menu {
        pen.menu(menu);
    }
    if let Some((title, rows)) = &hud.help {
        pen.help(title, rows);
    } else if let (Some((title, hint)), None) = (&hud.banner, &hud.menu) {
        pen.banner(title, hint);
    }
    if let Some([x, y]) = hud.pointer {
        pen.pointer(pos2(x as f32, y as f32));
    }
}

/// Draws how much is ready [0 to 1] into the middle of a window.
pub fn progress(painter: &Painter, text: &str, share: f32) {
    let screen = painter.clip_rect();
    let pen = Pen { painter, screen, unit: unit_of(screen) };
    let size = vec2(260.0, 6.0) * pen.unit;
    let bar = Rect::from_center_size(screen.center(), size);
    painter.rect_filled(bar, 0.5 * size.y, Color32::from_gray(58));
    let done = bar.with_max_x(bar.left() + share.clamp(0.0, 1.0) * size.x);
    painter.rect_filled(done, 0.5 * size.y, ACTIVE);
    let above = bar.center() - vec2(0.0, 22.0 * pen.unit);
    pen.text(above, Align2::CENTER_CENTER, text, 17.0, TEXT);
}

/// Where the lines of options stand in a window of this size: all of one height, in the middle.
fn option_lines(screen: Rect, scale: f32, count: usize) -> impl Iterator<Item = Rect> {
    let unit = unit_for(screen, scale);
    let size = vec2(620.0, 34.0) * unit;
    let top = screen.center() - vec2(0.5 * size.x, 0.5 * size.y * count as f32);
    (0..count).map(move |i| Rect::from_min_size(top + vec2(0.0, size.y * i as f32), size))
}

/// The option whose line is at this place of a window [pixels], counted from 0.
pub fn option_at(
    hud: &Hud,
    (width, height): (f32, f32),
    scale: f32,
    (x, y): (f32, f32),
) -> Option<usize> {
    let screen = Rect::from_min_size(Pos2::ZERO, vec2(width, height));
    option_lines(screen, scale, hud.options.len()).position(|line| line.contains(pos2(x, y)))
}

/// Everything grows with the window; readable at 1280 x 720 and below.
fn unit_of(screen: Rect) -> f32 {
    (screen.height() / 720.0).clamp(0.6, 3.0)
}

/// The same, so many times as large as usual, and never so large that two panels do not fit beside
/// each other.
fn unit_for(screen: Rect, scale: f32) -> f32 {
    (unit_of(screen) * scale).min((screen.width() / 640.0).max(0.6))
}

/// What everything is drawn with.
pub(super) struct Pen<'a> {
    pub painter: &'a Painter,
    pub screen: Rect,
    /// Pixels per unit of length: everything grows with the window.
    pub unit: f32,
}

impl Pen<'_> {
    /// How many times as large as usual everything is.
    fn largeness(&self) -> f32 {
        self.unit / unit_of(self.screen)
    }

    pub fn font(&self, size: f32) -> FontId {
        FontId::proportional(size * self.unit)
    }

    pub fn text(&self, at: Pos2, anchor: Align2, text: &str, size: f32, colour: Color32) -> Rect {
        self.painter.text(at, anchor, text, self.font(size), colour)
    }

    pub fn panel(&self, rect: Rect) {
        self.painter.rect_filled(rect, 7.0 * self.unit, PANEL);
    }

    fn seats(&self, seats: &[SeatPanel]) {
        let (width, height) = (286.0 * self.unit, 70.0 * self.unit);
        let margin = 14.0 * self.unit;
        for (index, seat) in seats.iter().enumerate() {
            let x = if index == 0 {
                self.screen.left() + margin
            } else {
                self.screen.right() - margin - width
            };
            let rect =
                Rect::from_min_size(pos2(x, self.screen.top() + margin), vec2(width, height));
            self.panel(rect);
            if seat.is_at_table {
                let stroke = Stroke::new(2.0 * self.unit, ACTIVE);
                self.painter.rect_stroke(rect, 7.0 * self.unit, stroke, StrokeKind::Inside);
            }
            let inner = rect.shrink2(vec2(12.0, 9.0) * self.unit);
            let colour = if seat.is_at_table { ACTIVE } else { TEXT };
            self.text(inner.left_top(), Align2::LEFT_TOP, &seat.name, 20.0, colour);
            let plays = match seat.score {
                Some(score) => score.to_string(),
                None => seat.plays.clone(),
            };
            self.text(inner.right_top(), Align2::RIGHT_TOP, &plays, 16.0, FAINT);
            if let Remaining::Balls(balls) = &seat.remaining {
                let radius = 11.5 * self.unit;
                for (i, ball) in balls.iter().enumerate() {
                    let x = inner.left() + radius + i as f32 * 2.4 * radius;
                    self.ball(pos2(x, inner.bottom() - radius + 2.0 * self.unit), radius, *ball);
                }
            }
        }
    }

    /// A ball as a small disc.
    fn ball(&self, middle: Pos2, radius: f32, ball: BallId) {
        let look = ball_look(ball);
        let colour = |[r, g, b]: [f32; 3]| {
            Color32::from_rgb((r * 255.0) as u8, (g * 255.0) as u8, (b * 255.0) as u8)
        };
        let ivory = colour(ball_look(BallId::CUE).colour);
        let base = if look.is_striped { ivory } else { colour(look.colour) };
        self.painter.circle_filled(middle, radius, base);
        if look.is_striped {
            let band = Rect::from_center_size(middle, vec2(1.78 * radius, 1.02 * radius));
            self.painter.rect_filled(band, 0.22 * radius, colour(look.colour));
        }
        self.painter.circle_stroke(middle, radius, Stroke::new(self.unit, Color32::from_gray(90)));
        if let Some(number) = look.number {
            self.painter.circle_filled(middle, 0.56 * radius, ivory);
            let size = if number < 10 { 11.0 } else { 9.0 };
            let text = number.to_string();
            self.text(middle, Align2::CENTER_CENTER, &text, size, Color32::BLACK);
        }
    }

    /// Lines of text under each other in a panel whose top middle is at `top`.
    fn paragraph(&self, top: Pos2, width: f32, lines: &[(String, f32, Color32)]) {
        let galleys: Vec<_> = lines
            .iter()
            .map(|(text, size, colour)| {
                let galley = self.painter.layout(text.clone(), self.font(*size), *colour, width);
                (galley, *colour)
            })
            .collect();
        let widest = galleys.iter().map(|(galley, _)| galley.size().x).fold(0.0, f32::max);
        let height: f32 = galleys.iter().map(|(galley, _)| galley.size().y).sum();
        let pad = vec2(14.0, 8.0) * self.unit;
        let size = vec2(widest, height) + 2.0 * pad;
        self.panel(Rect::from_min_size(top - vec2(0.5 * size.x, 0.0), size));
        let mut y = top.y + pad.y;
        for (galley, colour) in galleys {
            let x = top.x - 0.5 * galley.size().x;
            y += galley.size().y;
            self.painter.galley(pos2(x, y - galley.size().y), galley, colour);
        }
    }

    fn message(&self, hud: &Hud) {
        let first = if hud.is_foul { FOUL } else { TEXT };
        let lines: Vec<_> = hud
            .message
            .iter()
            .enumerate()
            .map(|(i, text)| {
                let (size, colour) = if i == 0 { (18.0, first) } else { (14.5, FAINT) };
                (text.clone(), size, colour)
            })
            .collect();
        if !lines.is_empty() {
            let top = self.screen.center_top() + vec2(0.0, 14.0 * self.unit);
            // Between the panels of the players.
            let width = (self.screen.width() - 660.0 * self.unit).max(260.0 * self.unit);
            self.paragraph(top, width, &lines);
        }
    }

    fn hint(&self, hud: &Hud) {
        let margin = 14.0 * self.unit;
        if !hud.hint.is_empty() {
            let bottom = self.screen.center_bottom() - vec2(0.0, margin + 34.0 * self.unit);
            let line = (hud.hint.clone(), 15.5, TEXT);
            self.paragraph(bottom, self.screen.width() * 0.6, &[line]);
        }
        if !hud.help_hint.is_empty() {
            let at = self.screen.left_bottom() + vec2(margin, -margin);
            self.text(at, Align2::LEFT_BOTTOM, &hud.help_hint, 14.0, FAINT);
        }
    }

    /// A lesson stands over the hint.
    fn lesson(&self, title: &str, text: &str) {
        let top = self.screen.center_bottom() - vec2(0.0, 140.0 * self.unit);
        let lines = [(title.to_string(), 14.5, ACTIVE), (text.to_string(), 19.0, TEXT)];
        self.paragraph(top, 640.0 * self.unit, &lines);
    }

    /// What is announced, above the hint.
    fn call(&self, call: Option<&str>) {
        if let Some(call) = call {
            let bottom = self.screen.center_bottom() - vec2(0.0, 92.0 * self.unit);
            let line = (call.to_string(), 15.5, ACTIVE);
            self.paragraph(bottom, self.screen.width() * 0.6, &[line]);
        }
    }

    fn options(&self, options: &[String]) {
        for (text, line) in
            options.iter().zip(option_lines(self.screen, self.largeness(), options.len()))
        {
            self.panel(line.shrink(2.0 * self.unit));
            let at = line.left_center() + vec2(16.0 * self.unit, 0.0);
            self.text(at, Align2::LEFT_CENTER, text, 17.0, TEXT);
        }
    }

    /// The cue ball from behind, with the spot where the tip meets it.
    fn tip(&self, tip: &TipDial, elevation: Option<&str>) {
        let radius = 44.0 * self.unit;
        let margin = 22.0 * self.unit;
        let middle = self.screen.right_bottom() - Vec2::splat(margin + radius);
        let ivory = Color32::from_rgb(238, 233, 216);
        self.painter.circle_filled(middle, radius, ivory);
        let line = Stroke::new(self.unit, Color32::from_gray(170));
        self.painter.circle_stroke(middle, radius * tip.limit as f32, line);
        self.painter.line_segment([middle - vec2(radius, 0.0), middle + vec2(radius, 0.0)], line);
        self.painter.line_segment([middle - vec2(0.0, radius), middle + vec2(0.0, radius)], line);
        let spot = middle + vec2(tip.side as f32, -tip.height as f32) * radius;
        self.painter.circle_filled(spot, 0.2 * radius, Color32::from_rgb(38, 92, 150));
        if let Some(text) = elevation {
            let at = middle - vec2(0.0, radius + 6.0 * self.unit);
            self.text(at, Align2::CENTER_BOTTOM, text, 14.0, FAINT);
        }
    }

    fn strength(&self, gauge: &Gauge) {
        let size = vec2(16.0, 190.0) * self.unit;
        let corner = self.screen.right_bottom() - vec2(160.0, 24.0) * self.unit;
        let rect = Rect::from_min_max(corner - size, corner);
        self.panel(rect.expand(3.0 * self.unit));
        let mut full = rect;
        full.set_top(rect.bottom() - rect.height() * gauge.fill as f32);
        let green = (1.0 - gauge.fill as f32).clamp(0.0, 1.0);
        let colour = Color32::from_rgb(235, (70.0 + 150.0 * green) as u8, 60);
        self.painter.rect_filled(full, 3.0 * self.unit, colour);
        let at = rect.center_top() - vec2(0.0, 8.0 * self.unit);
        self.text(at, Align2::CENTER_BOTTOM, &gauge.text, 15.0, TEXT);
    }

    /// The numbers of a haptic device, so far below the top.
    fn felt(&self, panel: &FeltPanel, top: f32) {
        let (row, pad) = (19.0 * self.unit, 12.0 * self.unit);
        let width = 350.0 * self.unit;
        let text_width = width - 2.0 * pad;
        let colour = if panel.is_acting { FOUL } else { FAINT };
        let acting: Vec<_> = panel
            .acting
            .iter()
            .map(|text| self.painter.layout(text.clone(), self.font(13.5), colour, text_width))
            .collect();
        let said: f32 = acting.iter().map(|galley| galley.size().y).sum();
        let gauge = if panel.force.is_some() { 14.0 * self.unit } else { 0.0 };
        let rows = row * (panel.rows.len() as f32 + 1.4);
        let size = vec2(width, rows + gauge + said + 2.0 * pad);
        let corner = self.screen.left_top() + vec2(14.0, top) * self.unit;
        self.panel(Rect::from_min_size(corner, size));
        let left = corner.x + pad;
        let mut y = corner.y + pad;
        self.text(pos2(left, y), Align2::LEFT_TOP, &panel.title, 15.5, ACTIVE);
        y += 1.4 * row;
        for (name, value) in &panel.rows {
            self.text(pos2(left, y), Align2::LEFT_TOP, name, 13.5, FAINT);
            let at = pos2(left + 112.0 * self.unit, y);
            self.text(at, Align2::LEFT_TOP, value, 13.5, TEXT);
            y += row;
        }
        if let Some(force) = &panel.force {
            let bar =
                Rect::from_min_size(pos2(left, y + self.unit), vec2(text_width, 6.0 * self.unit));
            self.painter.rect_filled(bar, 2.0 * self.unit, Color32::from_gray(45));
            let [r, g, b] = force_colour(force.fill).map(|channel| (channel * 255.0) as u8);
            let filled = bar.with_max_x(bar.left() + bar.width() * force.fill as f32);
            self.painter.rect_filled(filled, 2.0 * self.unit, Color32::from_rgb(r, g, b));
        }
        y += gauge;
        for galley in acting {
            let height = galley.size().y;
            self.painter.galley(pos2(left, y), galley, colour);
            y += height;
        }
    }

    fn banner(&self, title: &str, hint: &str) {
        let top = self.screen.center() - vec2(0.0, 70.0 * self.unit);
        let lines = [(title.to_string(), 46.0, ACTIVE), (hint.to_string(), 17.0, TEXT)];
        self.paragraph(top, self.screen.width() * 0.8, &lines);
    }

    /// As wide as its texts, and never wider or higher than the window.
    fn help(&self, title: &str, rows: &[(String, String)]) {
        let width_of = |text: &String| {
            self.painter.layout_no_wrap(text.clone(), self.font(15.5), TEXT).size().x
        };
        let keys_width = rows.iter().map(|(keys, _)| width_of(keys)).fold(0.0, f32::max);
        let does_width = rows.iter().map(|(_, does)| width_of(does)).fold(0.0, f32::max);
        let (row, pad, gap) = (27.0 * self.unit, 22.0 * self.unit, 26.0 * self.unit);
        let size = vec2(keys_width + gap + does_width + 2.0 * pad, row * (rows.len() as f32 + 2.0));
        let fits = (self.screen.size() / size).min_elem().min(1.0);
        if fits < 1.0 {
            // All lengths grow with the unit; a little less, because letters are whole pixels.
            let smaller = Pen { unit: 0.97 * fits * self.unit, ..*self };
            if 0.1 < smaller.unit {
                return smaller.help(title, rows);
            }
        }
        let rect = Rect::from_center_size(self.screen.center(), size);
        self.painter.rect_filled(rect, 9.0 * self.unit, PANEL);
        self.painter.rect_filled(rect, 9.0 * self.unit, PANEL);
        let left = rect.left() + pad;
        let mut y = rect.top() + 0.8 * row;
        self.text(pos2(left, y), Align2::LEFT_CENTER, title, 21.0, ACTIVE);
        for (keys, does) in rows {
            y += row;
            self.text(pos2(left, y), Align2::LEFT_CENTER, keys, 15.5, ACTIVE);
            let at = pos2(left + keys_width + gap, y);
            self.text(at, Align2::LEFT_CENTER, does, 15.5, TEXT);
        }
    }
}
