//! The event manager delivers everything once, in stamp order, exactly when it is due, whatever
//! the order of arrival.

mod model;

use hapticbillard::event_manager::{EventManager, LIMIT, Publication};
use hapticbillard::events::{
    Command, Event, Fact, FactKind, MenuAction, PlayerReport, PlayerState, Source, Stamped, Topic,
    Topics, Zone,
};
use hapticbillard::hash::Digest;
use hapticbillard::ids::{BallId, PlayerId};
use hapticbillard::tick::Outcome;
use hapticbillard::units::Tick;
use proptest::prelude::*;
use smallvec::smallvec;
use std::sync::Arc;

const SOURCES: [Source; 3] = [Source::Rules, Source::Ai(PlayerId(1)), Source::Ai(PlayerId(2))];

fn event(number: u8) -> Event {
    match number % 4 {
        0 => Event::Menu(MenuAction::Pause),
        1 => Event::Command(Command::PlaceBall {
            ball: BallId(u16::from(number)),
            position_m: Default::default(),
            zone: Zone::Anywhere,
        }),
        2 => Event::Player(PlayerReport { player: PlayerId::ONE, state: PlayerState::Lazing }),
        _ => Event::Fact(Fact {
            time_s: f64::from(number),
            kind: FactKind::HeadStringCrossed { ball: BallId(u16::from(number)) },
        }),
    }
}

/// What each source publishes at each tick: (what, delay).
type Script = Vec<[Vec<(u8, u64)>; 3]>;

/// Runs a script, handing the sources' answers over in the order `permutation` says, and returns
/// all that a subscriber to everything got, batch by batch.
fn deliver(script: &Script, permutation: [usize; 3]) -> Vec<(Tick, Arc<[Stamped]>)> {
    let mut manager = EventManager::new();
    let seats = SOURCES.map(|source| manager.register(source, Topics::NONE));
    let sink = manager.subscribe(Topics::ALL);
    let mut batches = Vec::new();
    let last = script.len() as u64 + 64;
    for tick in (1..=last).map(Tick) {
        for delivery in manager.seal(tick) {
            assert_eq!(delivery.to, sink);
            batches.push((tick, delivery.events));
        }
        if let Some(answers) = script.get(tick.0 as usize - 1) {
            for who in permutation {
                let publish = answers[who].iter().map(|&(what, delay_ticks)| Publication {
                    event: event(what),
                    delay_ticks,
                    label: None,
                });
                let outcome = Outcome { publish: publish.collect(), ..Outcome::default() };
                manager.answer(seats[who], tick, outcome, Digest(0)).unwrap();
            }
        }
    }
    batches
}

fn script() -> impl Strategy<Value = Script> {
    let answer = prop::collection::vec((any::<u8>(), 0u64..40), 0..4);
    let tick = [answer.clone(), answer.clone(), answer];
    prop::collection::vec(tick, 1..20)
}

proptest! {
    #[test]
    fn everything_arrives_once_in_order_and_exactly_when_due(script in script()) {
        let batches = deliver(&script, [0, 1, 2]);
        let mut expected = 0;
        for (tick, answers) in script.iter().enumerate() {
            for (who, answer) in answers.iter().enumerate() {
                for &(what, delay) in answer {
                    expected += 1;
                    // Published in tick t, so due in t + 1 and the delay later.
                    let due = Tick(tick as u64 + 2 + delay);
                    let (_, batch) = batches.iter().find(|(at, _)| *at == due).unwrap();
                    let arrived = batch.iter().any(|stamped| {
                        stamped.event == event(what) && stamped.stamp.source == SOURCES[who]
                    });
                    prop_assert!(arrived);
                }
            }
        }
        prop_assert_eq!(batches.iter().map(|(_, batch)| batch.len()).sum::<usize>(), expected);
        for (tick, batch) in &batches {
            prop_assert!(batch.iter().all(|stamped| stamped.stamp.tick == *tick));
            prop_assert!(batch.is_sorted_by(|a, b| a.stamp < b.stamp));
        }
    }

    #[test]
    fn order_of_arrival_does_not_matter(script in script()) {
        let first = deliver(&script, [0, 1, 2]);
        for permutation in [[0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
            prop_assert_eq!(&deliver(&script, permutation), &first);
        }
    }
}

#[test]
fn a_subscriber_gets_its_topics_and_nothing_else() {
    let mut manager = EventManager::new();
    let menus = manager.subscribe(Topics::of(&[Topic::Menu]));
    let all = manager.subscribe(Topics::of(&[Topic::Menu, Topic::Player]));
    manager.publish_now(Source::Physics, Tick(1), (0..8).map(event)).unwrap();
    let deliveries = manager.seal(Tick(1));
    let count = |id| deliveries.iter().find(|d| d.to == id).map(|d| d.events.len());
    assert_eq!(count(menus), Some(2));
    assert_eq!(count(all), Some(4), "facts were subscribed by nobody");
}

#[test]
fn what_nobody_subscribed_to_is_not_built() {
    let mut manager = EventManager::new();
    manager.subscribe(Topics::of(&[Topic::Menu]));
    assert!(!manager.interest().contains(Topic::HeadStringCrossed));
    manager.publish_now(Source::Physics, Tick(1), [event(3), event(7)]).unwrap();
    assert!(manager.seal(Tick(1)).is_empty());
    // It counts all the same: stamps do not depend on who listens.
    manager.publish_now(Source::Physics, Tick(2), [event(0)]).unwrap();
    assert_eq!(manager.seal(Tick(2))[0].events[0].stamp.sequence, 2);
}

#[test]
fn one_batch_is_shared_by_all_who_want_all_of_it() {
    let mut manager = EventManager::new();
    manager.subscribe(Topics::ALL);
    manager.subscribe(Topics::of(&[Topic::Menu]));
    manager.publish_now(Source::Physics, Tick(1), [event(0)]).unwrap();
    let deliveries = manager.seal(Tick(1));
    assert!(Arc::ptr_eq(&deliveries[0].events, &deliveries[1].events));
}

#[test]
fn a_delayed_event_can_be_taken_back_by_its_publisher_only() {
    let mut manager = EventManager::new();
    let [rules, ai, _] = SOURCES.map(|source| manager.register(source, Topics::ALL));
    let later = |label| Outcome {
        publish: vec![Publication { event: event(0), delay_ticks: 10, label: Some(label) }],
        ..Outcome::default()
    };
    let cancel = |label| Outcome { cancel: smallvec![label], ..Outcome::default() };
    manager.answer(rules, Tick(1), later(7), Digest(0)).unwrap();
    assert_eq!(manager.next_due(), Some(Tick(12)));
    manager.answer(ai, Tick(2), cancel(7), Digest(0)).unwrap();
    assert_eq!(manager.next_due(), Some(Tick(12)), "the label is another source's");
    manager.answer(rules, Tick(3), cancel(7), Digest(0)).unwrap();
    assert_eq!(manager.next_due(), None);
}

#[test]
fn a_wake_calls_with_an_empty_batch_and_only_once() {
    let mut manager = EventManager::new();
    let ai = manager.register(SOURCES[1], Topics::NONE);
    let wake = |tick| Outcome { wake: Some(tick), ..Outcome::default() };
    manager.answer(ai, Tick(1), wake(Tick(5)), Digest(0)).unwrap();
    assert_eq!(manager.next_due(), Some(Tick(5)));
    assert!(manager.seal(Tick(4)).is_empty());
    assert!(manager.seal(Tick(5))[0].events.is_empty());
    assert!(manager.seal(Tick(6)).is_empty());
    // A wake in the past would stop the clock.
    manager.answer(ai, Tick(9), wake(Tick(3)), Digest(0)).unwrap();
    assert_eq!(manager.next_due(), Some(Tick(10)));
}

#[test]
fn a_full_queue_refuses_and_counts() {
    let mut manager = EventManager::new();
    manager.subscribe(Topics::ALL);
    let many = std::iter::repeat_n(event(0), LIMIT);
    manager.publish_now(Source::Physics, Tick(1), many).unwrap();
    let error = manager.publish(Source::Rules, Tick(1), event(0).into()).unwrap_err();
    assert!(error.to_string().contains("the event queue is full at tick 1"));
    assert_eq!(manager.refused(), 1);
}
