//! The panel of the runtime: how long ticks and pictures take, and what waits in which queue.
//!
//! Numbers that change sixty times a second cannot be read, so the panel changes twice a second and
//! shows the longest each queue was since it last did.

use super::words::Words;
use crate::units::{Seconds, Tick};

/// How often the numbers change [s].
const RENEW_S: Seconds = 0.5;
/// Ticks of a second of the game.
const TICKS_PER_S: f64 = 1000.0;

/// How long something took in the last seconds.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Spread {
    /// Half of all were not longer [s].
    pub median_s: Seconds,
    /// 99 of 100 [s].
    pub p99_s: Seconds,
    /// None was [s].
    pub most_s: Seconds,
}

/// What waits in a queue.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct QueueReading {
    /// Its name.
    pub name: String,
    /// How much waits.
    pub waiting: u64,
    /// How much may wait.
    pub room: u64,
    /// Lost since the start.
    pub lost: u64,
}

/// What was measured.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Readings {
    /// How long ticks took.
    pub tick: Option<Spread>,
    /// The newest tick.
    pub newest: Tick,
    /// How long pictures took.
    pub picture: Option<Spread>,
    /// How many pictures there were.
    pub pictures: u64,
    /// From the tick of a fact to the end of the picture that it is in.
    pub shown: Option<Spread>,
    /// Every queue.
    pub queues: Vec<QueueReading>,
}

/// A line about a queue.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct QueueRow {
    /// Its name.
    pub name: String,
    /// What waited at most, what may wait, what was lost.
    pub values: [String; 3],
    /// It is full, or something was lost.
    pub stands_out: bool,
}

/// What the panel shows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MetersPanel {
    /// What it is.
    pub title: String,
    /// Names and values.
    pub rows: Vec<(String, String)>,
    /// What stands over the queues: their name, and their three values.
    pub head: [String; 4],
    /// A line each.
    pub queues: Vec<QueueRow>,
}

/// What is collected for the panel.
#[derive(Debug, Clone, Default)]
pub struct MeterBoard {
    /// The longest that each queue was since the panel changed.
    longest: Vec<QueueReading>,
    shown: Option<Shown>,
}

#[derive(Debug, Clone)]
struct Shown {
    readings: Readings,
    at_s: Seconds,
    /// Ticks and pictures in a second.
    rates_hz: Option<[f64; 2]>,
}

impl MeterBoard {
    /// Takes what waits now.
    pub fn take(&mut self, queues: Vec<QueueReading>) {
        for mut reading in queues {
            let seen = self.longest.iter_mut().find(|seen| seen.name == reading.name);
            match seen {
                Some(seen) => {
                    reading.waiting = reading.waiting.max(seen.waiting);
                    *seen = reading;
                }
                None => self.longest.push(reading),
            }
        }
    }

    /// Whether the panel changes now.
    pub fn is_due(&self, now_s: Seconds) -> bool {
        self.shown.as_ref().is_none_or(|shown| shown.at_s + RENEW_S <= now_s)
    }

    /// Changes the panel; the queues are those that were taken since it last did.
    pub fn renew(&mut self, readings: Readings, now_s: Seconds) {
        let queues = std::mem::take(&mut self.longest);
        let rates_hz = self.shown.as_ref().map(|before| {
            let passed_s = now_s - before.at_s;
            let ticks = readings.newest.0.saturating_sub(before.readings.newest.0);
            let pictures = readings.pictures.saturating_sub(before.readings.pictures);
            [ticks, pictures].map(|count| count as f64 / passed_s)
        });
        let readings = Readings { queues, ..readings };
        self.shown = Some(Shown { readings, at_s: now_s, rates_hz });
    }

    /// What the panel shows; none before it was renewed.
    pub fn panel(&self, words: &Words) -> Option<MetersPanel> {
        let Shown { readings, rates_hz, .. } = self.shown.as_ref()?;
        let none = || String::from("–");
        let spread = |spread: &Option<Spread>| match spread {
            Some(Spread { median_s, p99_s, most_s }) => words
                .fill("meters_spread", "median", &duration(*median_s))
                .replace("{p99}", &duration(*p99_s))
                .replace("{max}", &duration(*most_s)),
            None => none(),
        };
        let [ticks, pictures] = match rates_hz {
            Some([ticks, pictures]) => [
                words
                    .fill("meters_time_value", "hz", &format!("{ticks:.0}"))
                    .replace("{factor}", &format!("{:.2}", ticks / TICKS_PER_S)),
                words.fill("meters_pictures_value", "hz", &format!("{pictures:.0}")),
            ],
            None => [none(), none()],
        };
        let rows = [
            ("meters_time", ticks),
            ("meters_tick", spread(&readings.tick)),
            ("meters_pictures", pictures),
            ("meters_picture", spread(&readings.picture)),
            ("meters_shown", spread(&readings.shown)),
        ];
        let head = ["meters_queue", "meters_waiting", "meters_room", "meters_lost"];
        Some(MetersPanel {
            title: words.get("meters_title"),
            rows: rows.map(|(key, value)| (words.get(key), value)).into(),
            head: head.map(|key| words.get(key)),
            queues: readings.queues.iter().map(|queue| row(queue, words)).collect(),
        })
    }
}

fn row(queue: &QueueReading, words: &Words) -> QueueRow {
    QueueRow {
        name: name_of(&queue.name, words),
        values: [queue.waiting, queue.room, queue.lost].map(|value| value.to_string()),
        stands_out: 0 < queue.lost || (0 < queue.room && queue.room <= queue.waiting),
    }
}

/// What a queue is called; the second of its kind is `name 2`.
fn name_of(name: &str, words: &Words) -> String {
    if let Some((kind, number)) = name.rsplit_once(' ')
        && number.parse::<u32>().is_ok()
    {
        return format!("{} {number}", name_of(kind, words));
    }
    let key = format!("queue_{}", name.replace(' ', "_"));
    Some(words.get(&key)).filter(|known| *known != key).unwrap_or_else(|| name.to_string())
}

/// Three digits or so, in a unit that fits.
fn duration(seconds: Seconds) -> String {
    match seconds {
        s if s < 1e-3 => format!("{:.0} µs", s * 1e6),
        s if s < 1e-1 => format!("{:.1} ms", s * 1e3),
        s => format!("{:.0} ms", s * 1e3),
    }
}
