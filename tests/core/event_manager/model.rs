//! A model that anybody can check by eye, and random scripts to hold the event manager against it.
//!
//! The model keeps one list of all that waits and looks through the whole of it at every tick. It
//! knows nothing of queues, shared batches and masks of interest.

use super::event;
use hapticbillard::event_manager::{EventManager, LIMIT, Publication, SubscriberId};
use hapticbillard::events::{Command, Event, Source, Stamp, Stamped, Topic, Topics};
use hapticbillard::hash::Digest;
use hapticbillard::ids::PlayerId;
use hapticbillard::tick::Outcome;
use hapticbillard::units::Tick;
use proptest::prelude::*;
use std::collections::BTreeMap;

/// Who answers at the end of a tick.
const SEATS: [Source; 3] = [Source::Rules, Source::Ai(PlayerId(1)), Source::Ai(PlayerId(2))];
/// Every order in which three answers can arrive.
const ARRIVALS: [[usize; 3]; 6] =
    [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
/// What [`event`] makes.
const TOPICS: [Topic; 4] = [Topic::Menu, Topic::Player, Topic::HeadStringCrossed, Topic::Command];

/// What is published: which event, how much later, with which label.
type Say = (u8, u64, Option<u32>);

/// A participant's answer.
#[derive(Debug, Clone)]
struct Reply {
    publish: Vec<Say>,
    cancel: Vec<u32>,
    /// How many ticks later it wants to be called; zero is in the past.
    wake: Option<u64>,
}

/// What happens in one tick.
#[derive(Debug, Clone)]
struct Moment {
    input: Vec<Say>,
    facts: Vec<u8>,
    replies: [Reply; 3],
    /// Somebody stops listening after the tick.
    leaves: Option<usize>,
}

/// A game of random events.
#[derive(Debug, Clone)]
struct Script {
    /// What each of three participants and two sinks wants to hear: bits into [`TOPICS`].
    wishes: [u8; 5],
    moments: Vec<Moment>,
}

fn scripts() -> impl Strategy<Value = Script> {
    // Labels from a small set, so that they are often taken back, by the right one or another.
    let say = || (any::<u8>(), 0u64..12, prop::option::of(0u32..3));
    let says = |most| prop::collection::vec(say(), 0..most);
    let reply = move || {
        let cancel = prop::collection::vec(0u32..3, 0..2);
        (says(4), cancel, prop::option::weighted(0.3, 0u64..9))
            .prop_map(|(publish, cancel, wake)| Reply { publish, cancel, wake })
    };
    let facts = prop::collection::vec(any::<u8>(), 0..5);
    let leaves = prop::option::weighted(0.05, 0usize..5);
    let moment = (says(3), facts, [reply(), reply(), reply()], leaves)
        .prop_map(|(input, facts, replies, leaves)| Moment { input, facts, replies, leaves });
    let quiet = Just(Moment {
        input: Vec::new(),
        facts: Vec::new(),
        replies: [(); 3].map(|()| Reply { publish: Vec::new(), cancel: Vec::new(), wake: None }),
        leaves: None,
    });
    let moments = prop::collection::vec(prop_oneof![2 => moment, 1 => quiet], 1..25);
    ([0u8..16, 0..16, 0..16, 0..16, 0..16], moments)
        .prop_map(|(wishes, moments)| Script { wishes, moments })
}

fn topics(wish: u8) -> Topics {
    let wanted = TOPICS.iter().enumerate().filter(|(bit, _)| wish & (1 << bit) != 0);
    wanted.fold(Topics::NONE, |all, (_, topic)| all.or(Topics::of(&[*topic])))
}

fn publication((what, delay_ticks, label): Say) -> Publication {
    Publication { event: event(what), delay_ticks, label }
}

fn outcome(tick: Tick, reply: &Reply) -> Outcome {
    Outcome {
        publish: reply.publish.iter().map(|say| publication(*say)).collect(),
        cancel: reply.cancel.iter().copied().collect(),
        wake: reply.wake.map(|ticks| tick.after(ticks)),
    }
}

/// Everything that a run shows to anybody.
#[derive(Debug, Default, PartialEq)]
struct Seen {
    /// Who got what in which tick, in the order of delivery.
    mail: Vec<(Tick, SubscriberId, Vec<Stamped>)>,
    /// After each tick: when something is due next, and the commands that are due then.
    next: Vec<(Tick, Option<Tick>, Vec<Command>)>,
    refused: u64,
}

/// Plays a script with the real event manager. With `jumps` a tick in which nothing happens and
/// nothing is due is left out.
fn play(script: &Script, arrival: [usize; 3], jumps: bool, filler: usize) -> Seen {
    let mut manager = EventManager::new();
    let mut everybody = Vec::new();
    for (source, wish) in SEATS.iter().zip(script.wishes) {
        everybody.push(manager.register(*source, topics(wish)));
    }
    everybody.extend(script.wishes[3..].iter().map(|wish| manager.subscribe(topics(*wish))));
    let mut seen = Seen::default();
    for _ in 0..filler {
        let far = Publication { event: event(0), delay_ticks: u64::MAX, label: Some(9) };
        manager.publish(Source::Runtime, Tick(1), far).unwrap();
    }

    for tick in (1..=script.moments.len() as u64 + 24).map(Tick) {
        let moment = script.moments.get(tick.0 as usize - 1);
        let idle = moment.is_none_or(|moment| moment.input.is_empty() && moment.facts.is_empty());
        let due = manager.next_due().is_some_and(|due| due <= tick);
        if jumps && idle && !due {
            continue;
        }
        if let Some(moment) = moment {
            // What does not fit is refused, and the rest of its kind with it, as the runtime does.
            let _ = moment.input.iter().try_for_each(|say| {
                manager.publish(Source::Input, tick, publication(*say)).map(drop)
            });
            let facts = moment.facts.iter().map(|what| event(*what));
            let _ = manager.publish_now(Source::Physics, tick, facts);
        }
        for delivery in manager.seal(tick) {
            seen.mail.push((tick, delivery.to, delivery.events.to_vec()));
        }
        if let Some(moment) = moment.filter(|_| !jumps) {
            for who in arrival {
                let outcome = outcome(tick, &moment.replies[who]);
                let _ = manager.answer(everybody[who], tick, outcome, Digest(0));
            }
            if let Some(id) = moment.leaves {
                manager.unsubscribe(everybody[id]);
            }
        }
        let sealed = manager.sealed();
        seen.next.push((tick, sealed.next_due, sealed.commands.to_vec()));
    }
    seen.refused = manager.refused();
    seen
}

/// The model.
#[derive(Default)]
struct Model {
    listeners: Vec<(Topics, Option<Tick>)>,
    waiting: Vec<(Stamp, Event, Option<u32>)>,
    sequences: BTreeMap<Source, u64>,
    /// Places in the queue that are taken for ever.
    filler: usize,
    refused: u64,
}

impl Model {
    /// Whether there was room.
    fn say(&mut self, source: Source, tick: Tick, (what, delay, label): Say) -> bool {
        if self.filler + self.waiting.len() >= LIMIT {
            self.refused += 1;
            return false;
        }
        let sequence = self.sequences.entry(source).or_insert(0);
        let stamp = Stamp { tick: Tick(tick.0 + delay), source, sequence: *sequence };
        *sequence += 1;
        self.waiting.push((stamp, event(what), label));
        true
    }

    fn is_wanted(&self, event: &Event) -> bool {
        self.listeners.iter().any(|(topics, _)| topics.contains(event.topic()))
    }

    fn tick(&mut self, tick: Tick, moment: Option<&Moment>, seen: &mut Seen) {
        if let Some(moment) = moment {
            let _ = moment.input.iter().all(|say| self.say(Source::Input, tick, *say));
            for fact in &moment.facts {
                let wanted = self.is_wanted(&event(*fact));
                if !self.say(Source::Physics, tick, (*fact, 0, None)) {
                    break;
                }
                // What nobody wants to hear takes no room, but it counts.
                if !wanted {
                    self.waiting.pop();
                }
            }
        }
        let mut due: Vec<Stamped> = self
            .waiting
            .iter()
            .filter(|(stamp, ..)| stamp.tick <= tick)
            .map(|(stamp, event, _)| Stamped { stamp: *stamp, event: event.clone() })
            .collect();
        self.waiting.retain(|(stamp, ..)| tick < stamp.tick);
        due.sort_by_key(|stamped| (stamped.stamp.source, stamped.stamp.sequence));
        for (index, (topics, wake)) in self.listeners.iter_mut().enumerate() {
            let mail = due.iter().filter(|stamped| topics.contains(stamped.event.topic()));
            let mail: Vec<Stamped> = mail.cloned().collect();
            let woken = wake.is_some_and(|wake| wake <= tick);
            if woken {
                *wake = None;
            }
            if woken || !mail.is_empty() {
                seen.mail.push((tick, SubscriberId(index), mail));
            }
        }
        if let Some(moment) = moment {
            for (index, (source, reply)) in SEATS.iter().zip(&moment.replies).enumerate() {
                self.waiting.retain(|(stamp, _, label)| {
                    stamp.source != *source || !label.is_some_and(|l| reply.cancel.contains(&l))
                });
                let next = Tick(tick.0 + 1);
                if reply.publish.iter().all(|say| self.say(*source, next, *say)) {
                    self.listeners[index].1 = reply.wake.map(|ticks| Tick(tick.0 + ticks.max(1)));
                }
            }
            if let Some(leaver) = moment.leaves {
                self.listeners[leaver] = (Topics::NONE, None);
            }
        }
        self.tell_next(tick, seen);
    }

    fn tell_next(&self, tick: Tick, seen: &mut Seen) {
        let events = self.waiting.iter().map(|(stamp, ..)| stamp.tick);
        let wakes = self.listeners.iter().filter_map(|(_, wake)| *wake);
        let far = (0 < self.filler).then_some(Tick(u64::MAX));
        let next = events.chain(wakes).chain(far).min();
        let mut commands: Vec<(Stamp, Command)> = self
            .waiting
            .iter()
            .filter(|(stamp, ..)| Some(stamp.tick) <= next)
            .filter_map(|(stamp, event, _)| match event {
                Event::Command(command) => Some((*stamp, command.clone())),
                _ => None,
            })
            .collect();
        commands.sort_by_key(|(stamp, _)| *stamp);
        seen.next.push((tick, next, commands.into_iter().map(|(_, command)| command).collect()));
    }
}

fn expected(script: &Script, filler: usize) -> Seen {
    let mut model = Model { filler, ..Model::default() };
    model.listeners = script.wishes.map(|wish| (topics(wish), None)).to_vec();
    let mut seen = Seen::default();
    for tick in 1..=script.moments.len() as u64 + 24 {
        model.tick(Tick(tick), script.moments.get(tick as usize - 1), &mut seen);
    }
    seen.refused = model.refused;
    seen
}

proptest! {
    #[test]
    fn whatever_is_said_and_taken_back_arrives_as_the_model_says(script in scripts()) {
        let expected = expected(&script, 0);
        for arrival in ARRIVALS {
            prop_assert_eq!(&play(&script, arrival, false, 0), &expected);
        }
    }

    #[test]
    fn ticks_without_news_can_be_left_out(script in scripts()) {
        // Nobody answers here, so a tick without news is one in which nothing is published.
        let mut script = script;
        for moment in &mut script.moments {
            moment.leaves = None;
            for reply in &mut moment.replies {
                *reply = Reply { publish: Vec::new(), cancel: Vec::new(), wake: None };
            }
        }
        let every = play(&script, ARRIVALS[0], false, 0);
        let jumping = play(&script, ARRIVALS[0], true, 0);
        prop_assert!(jumping.next.len() <= every.next.len());
        prop_assert_eq!(jumping.mail, every.mail);
    }
}

proptest! {
    // Filling the queue takes some milliseconds.
    #![proptest_config(ProptestConfig { cases: 12, ..ProptestConfig::default() })]

    #[test]
    fn a_full_queue_refuses_what_comes_and_loses_nothing_that_waits(
        script in scripts(),
        room in 0usize..30,
    ) {
        let filler = LIMIT - room;
        let expected = expected(&script, filler);
        prop_assert_eq!(&play(&script, ARRIVALS[0], false, filler), &expected);
    }
}

/// The scripts reach what they are meant to reach, or nothing was tested.
#[test]
fn random_scripts_cancel_delay_wake_and_overflow() {
    use proptest::strategy::ValueTree;
    use proptest::test_runner::TestRunner;
    let mut runner = TestRunner::deterministic();
    let (mut mail, mut empty, mut commands, mut refused, mut taken_back) = (0, 0, 0, 0, 0);
    for _ in 0..60 {
        let script = scripts().new_tree(&mut runner).unwrap().current();
        let seen = expected(&script, 0);
        mail += seen.mail.len();
        empty += seen.mail.iter().filter(|(_, _, events)| events.is_empty()).count();
        commands += seen.next.iter().filter(|(_, _, commands)| !commands.is_empty()).count();
        let mut patient = script.clone();
        for moment in &mut patient.moments {
            moment.replies.iter_mut().for_each(|reply| reply.cancel.clear());
        }
        taken_back += usize::from(expected(&patient, 0).next != seen.next);
    }
    for _ in 0..6 {
        let script = scripts().new_tree(&mut runner).unwrap().current();
        refused += expected(&script, LIMIT - 3).refused;
    }
    assert!(mail > 1000 && empty > 20 && commands > 100, "{mail} {empty} {commands}");
    assert!(refused > 10 && taken_back > 10, "{refused} {taken_back}");
}
