//! The runtime in the window: what is measured while its panel is shown, and the panel in pixels.

use super::hud::{ACTIVE, FAINT, FOUL, Pen, TEXT};
use super::outbox::Outbox;
use crate::meters::{Meters, Recent};
use hapticbillard::events::Event;
use hapticbillard::renderer::{MeterBoard, MetersPanel, QueueReading, Readings, Words};
use hapticbillard::tick::Delivered;
use hapticbillard::units::Tick;
use std::sync::Arc;
use std::time::Instant;
use three_d::egui::{Align2, Color32, Rect, pos2, vec2};

/// Pictures that count at a time: some seconds.
const PICTURES: usize = 256;
/// The panel's width, and the height of a row.
const WIDTH: f32 = 392.0;
const ROW: f32 = 16.5;
/// Size of its letters.
const SIZE: f32 = 12.5;
/// Width of a column of numbers.
const COLUMN: f32 = 66.0;

/// The window's end of the meters; it measures only while it is shown.
pub struct MetersScreen {
    meters: Arc<Meters>,
    shown: Option<Shown>,
}

struct Shown {
    board: MeterBoard,
    pictures: Recent,
    waits: Recent,
    /// The oldest fact that no picture has shown yet.
    unseen: Option<Tick>,
}

impl MetersScreen {
    /// Not shown yet.
    pub fn new(meters: Arc<Meters>) -> Self {
        MetersScreen { meters, shown: None }
    }

    /// Measures from now on, or no longer.
    pub fn show(&mut self, is_shown: bool) {
        if self.shown.is_some() == is_shown {
            return;
        }
        self.meters.switch(is_shown);
        self.shown = is_shown.then(|| Shown {
            board: MeterBoard::default(),
            pictures: Recent::of(PICTURES),
            waits: Recent::of(PICTURES),
            unseen: None,
        });
    }

    /// Now, while it is shown.
    pub fn now(&self) -> Option<Instant> {
        self.shown.as_ref().map(|_| Instant::now())
    }

    /// Mail has come for the next picture.
    pub fn hear(&mut self, delivered: &Delivered) {
        if let Some(shown) = self.shown.as_mut().filter(|shown| shown.unseen.is_none()) {
            let is_fact = |event: &Event| matches!(event, Event::Fact(_));
            let has_fact = delivered.events.iter().any(|stamped| is_fact(&stamped.event));
            shown.unseen = has_fact.then_some(delivered.tick);
        }
    }

    /// Looks at the queues before they are emptied.
    pub fn look(&mut self, outbox: &Outbox) {
        if let Some(shown) = &mut self.shown {
            let mut queues = self.meters.queues();
            queues.push(outbox.reading());
            shown.board.take(numbered(queues));
        }
    }

    /// A picture is there that was begun then; `begun` is none if it would have been the same.
    pub fn drawn(&mut self, begun: Option<Instant>) {
        let Some(shown) = &mut self.shown else { return };
        let unseen = shown.unseen.take();
        if let Some(begun) = begun {
            shown.pictures.note(begun.elapsed());
            if let Some(since) = unseen.and_then(|tick| self.meters.begin_of(tick)) {
                shown.waits.note(since.elapsed());
            }
        }
    }

    /// The panel, while it is shown.
    pub fn panel(&mut self, words: &Words, now_s: f64) -> Option<MetersPanel> {
        let Shown { board, pictures, waits, .. } = self.shown.as_mut()?;
        if board.is_due(now_s) {
            let readings = Readings {
                tick: self.meters.ticks().spread(),
                newest: self.meters.newest(),
                picture: pictures.spread(),
                pictures: pictures.noted(),
                shown: waits.spread(),
                queues: Vec::new(),
            };
            board.renew(readings, now_s);
        }
        board.panel(words)
    }
}

/// Two of the same name are told apart.
fn numbered(mut queues: Vec<QueueReading>) -> Vec<QueueReading> {
    for i in (1..queues.len()).rev() {
        let before = queues[..i].iter().filter(|other| other.name == queues[i].name).count();
        if 0 < before {
            queues[i].name = format!("{} {}", queues[i].name, before + 1);
        }
    }
    queues
}

impl Pen<'_> {
    /// The panel above the bottom left corner.
    pub fn meters(&self, panel: &MetersPanel) {
        let (row, pad) = (ROW * self.unit, 12.0 * self.unit);
        let width = WIDTH * self.unit;
        let rows = (panel.rows.len() + panel.queues.len()) as f32 + 2.9;
        let size = vec2(width, rows * row + 2.0 * pad);
        let corner = self.screen.left_bottom() + vec2(14.0, -40.0) * self.unit - vec2(0.0, size.y);
        self.panel(Rect::from_min_size(corner, size));
        let (left, right) = (corner.x + pad, corner.x + width - pad);
        let mut y = corner.y + pad;
        self.text(pos2(left, y), Align2::LEFT_TOP, &panel.title, 15.5, ACTIVE);
        y += 1.4 * row;
        for (name, value) in &panel.rows {
            self.text(pos2(left, y), Align2::LEFT_TOP, name, SIZE, FAINT);
            let at = pos2(left + 112.0 * self.unit, y);
            self.text(at, Align2::LEFT_TOP, value, SIZE, TEXT);
            y += row;
        }
        y += 0.5 * row;
        let [name, values @ ..] = &panel.head;
        self.queue(name, values, [left, right, y], FAINT);
        for queue in &panel.queues {
            y += row;
            let colour = if queue.stands_out { FOUL } else { TEXT };
            self.queue(&queue.name, &queue.values, [left, right, y], colour);
        }
    }

    fn queue(&self, name: &str, values: &[String; 3], [left, right, y]: [f32; 3], colour: Color32) {
        self.text(pos2(left, y), Align2::LEFT_TOP, name, SIZE, colour);
        for (column, value) in values.iter().rev().enumerate() {
            let at = pos2(right - column as f32 * COLUMN * self.unit, y);
            self.text(at, Align2::RIGHT_TOP, value, SIZE, colour);
        }
    }
}
