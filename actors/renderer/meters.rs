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

#[cfg(test)]
mod tests {
    use super::*;
    use hapticbillard::events::{Fact, FactKind, Source, Stamp, Stamped};
    use hapticbillard::ids::BallId;
    use hapticbillard::rules::Language;

    fn mail(tick: Tick) -> Delivered {
        let fact = Fact { time_s: 0.0, kind: FactKind::HeadStringCrossed { ball: BallId::CUE } };
        let stamp = Stamp { tick, source: Source::Physics, sequence: 0 };
        let events = Arc::from([Stamped { stamp, event: Event::Fact(fact) }]);
        Delivered { tick, events, table: Arc::default() }
    }

    #[test]
    fn what_is_not_shown_is_not_measured_and_what_is_shown_is() {
        let meters = Arc::new(Meters::default());
        let mut screen = MetersScreen::new(meters.clone());
        let words = Words::new(Language::English);
        screen.hear(&mail(Tick(1)));
        screen.drawn(screen.now());
        assert!(meters.now().is_none() && screen.now().is_none());
        assert_eq!(screen.panel(&words, 0.0), None);

        screen.show(true);
        let begun = meters.now().unwrap();
        meters.note_tick(Tick(7), begun);
        let (sender, _receiver) = flume::bounded(8);
        screen.look(&Outbox::new(sender));
        screen.hear(&mail(Tick(7)));
        screen.drawn(screen.now());
        let panel = screen.panel(&words, 1.0).unwrap();
        assert!(panel.rows[1].1.contains("median"), "a tick: {panel:?}");
        assert!(panel.rows[3].1.contains("median"), "a picture: {panel:?}");
        assert!(panel.rows[4].1.contains("median"), "a fact: {panel:?}");
        assert_eq!(panel.queues[0].values, ["0", "8", "0"]);

        screen.show(false);
        assert!(meters.now().is_none());
        assert_eq!(screen.panel(&words, 2.0), None);
    }
}
