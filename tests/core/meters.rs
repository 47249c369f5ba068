//! The panel of the runtime.

use hapticbillard::renderer::{MeterBoard, MetersPanel, QueueReading, Readings, Spread, Words};
use hapticbillard::rules::Language;
use hapticbillard::units::Tick;

fn queue(name: &str, waiting: u64, room: u64, lost: u64) -> QueueReading {
    QueueReading { name: name.into(), waiting, room, lost }
}

/// What the panel shows after a second at this many ticks and pictures.
fn after_a_second(ticks: u64, pictures: u64, language: Language) -> MetersPanel {
    let mut board = MeterBoard::default();
    assert_eq!(board.panel(&Words::new(language)), None);
    board.renew(Readings { newest: Tick(500), pictures: 7, ..Readings::default() }, 10.0);
    assert!(!board.is_due(10.4) && board.is_due(10.5));
    board.take(vec![queue("ai", 1, 2, 0), queue("ai 2", 0, 2, 0), queue("mail window", 0, 9, 0)]);
    board.take(vec![queue("ai", 0, 2, 0), queue("mail window", 9, 9, 0), queue("own", 0, 5, 3)]);
    board.take(vec![queue("mail window", 1, 9, 0)]);
    let readings = Readings {
        tick: Some(Spread { median_s: 21.4e-6, p99_s: 1.24e-3, most_s: 0.25 }),
        newest: Tick(500 + ticks),
        pictures: 7 + pictures,
        ..Readings::default()
    };
    board.renew(readings, 11.0);
    board.panel(&Words::new(language)).unwrap()
}

#[test]
fn the_panel_shows_rates_spreads_and_the_longest_that_each_queue_was() {
    let panel = after_a_second(990, 58, Language::English);
    let values: Vec<&str> = panel.rows.iter().map(|(_, value)| value.as_str()).collect();
    let expected = [
        "990 ticks/s: 0.99 × real time",
        "median 21 µs, p99 1.2 ms, max 250 ms",
        "58 a second",
        "–",
        "–",
    ];
    assert_eq!(values, expected);
    let queues: Vec<(&str, [&str; 3], bool)> = panel
        .queues
        .iter()
        .map(|row| (row.name.as_str(), row.values.each_ref().map(String::as_str), row.stands_out))
        .collect();
    let expected = [
        ("computer player", ["1", "2", "0"], false),
        ("computer player 2", ["0", "2", "0"], false),
        // It was full.
        ("mail for the window", ["9", "9", "0"], true),
        // A name without words is shown as it is; what was lost stands out.
        ("own", ["0", "5", "3"], true),
    ];
    assert_eq!(queues, expected);
}

#[test]
fn the_panel_speaks_both_languages() {
    let [english, german] = Language::ALL.map(|language| after_a_second(1000, 60, language));
    let texts = |panel: &MetersPanel| {
        let rows = panel.rows.iter().map(|(name, _)| name.clone());
        let queues = panel.queues[..3].iter().map(|row| row.name.clone());
        rows.chain(panel.head.clone()).chain([panel.title.clone()]).chain(queues).collect()
    };
    let [english, german]: [Vec<String>; 2] = [texts(&english), texts(&german)];
    for (english, german) in english.iter().zip(&german) {
        assert!(english != german && !german.contains("meters_") && !german.contains("queue_"));
    }
}
