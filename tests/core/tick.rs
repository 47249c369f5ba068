//! The clock: which ticks are visited, and in which order things happen in one.

use hapticbillard::events::{Fact, FactKind, Topic, Topics};
use hapticbillard::ids::BallId;
use hapticbillard::tick::{Clock, End, Frame, Next, Pace, Sealed};
use hapticbillard::units::Tick;

fn fact(time_s: f64) -> Fact {
    Fact { time_s, kind: FactKind::HeadStringCrossed { ball: BallId(1) } }
}

fn interest() -> Sealed {
    Sealed { interest: Topics::of(&[Topic::HeadStringCrossed]), ..Sealed::default() }
}

/// Runs a clock over a world in which facts happen at given times, and returns the sealed ticks.
fn sealed_ticks(pace: Pace, times: &[f64], due: Option<Tick>, limit: Tick) -> (Vec<u64>, End) {
    let mut clock = Clock::new(pace, limit, Sealed { next_due: due, ..interest() });
    let mut reached = 0.0;
    let mut sealed = Vec::new();
    let between = |from: f64, to: f64| -> Vec<Fact> {
        times.iter().filter(|&&t| from < t && t <= to).map(|&t| fact(t)).collect()
    };
    loop {
        let seal = match clock.next(None) {
            Next::Coast { limit, stop } => {
                assert!(stop.contains(Topic::HeadStringCrossed));
                let first = between(reached, limit.end_s()).first().map(|fact| fact.time_s);
                let tick = first.map_or(limit, Tick::containing);
                let facts = between(reached, tick.end_s());
                reached = tick.end_s();
                clock.coasted(tick, facts)
            }
            Next::Frame(tick) => {
                let Next::Advance { tick, .. } = clock.framed(tick, Frame::new()) else { panic!() };
                let facts = between(reached, tick.end_s());
                reached = tick.end_s();
                clock.advanced(facts)
            }
            Next::Finished(end) => return (sealed, end),
            other => panic!("{other:?}"),
        };
        if let Some(Next::Seal { tick, facts, .. }) = seal {
            assert!(facts.iter().all(|fact| fact.time_s <= tick.end_s()));
            sealed.push(tick.0);
            let due = due.filter(|due| tick < *due);
            clock.sealed(Sealed { next_due: due, ..interest() });
        }
    }
}

#[test]
fn a_jump_visits_facts_and_what_is_due_and_nothing_else() {
    let times = [0.0035, 0.0036, 0.010, 0.5];
    let (ticks, end) = sealed_ticks(Pace::Jump, &times, Some(Tick(20)), Tick(1000));
    assert_eq!((ticks, end), (vec![4, 10, 20, 500], End::Idle));
}

#[test]
fn facts_before_and_in_the_tick_that_is_due_arrive_with_it() {
    let (ticks, _) = sealed_ticks(Pace::Jump, &[0.0191, 0.0195], Some(Tick(20)), Tick(1000));
    assert_eq!(ticks, [20]);
}

#[test]
fn without_jumping_every_tick_is_visited() {
    let (ticks, end) = sealed_ticks(Pace::EveryTick, &[0.003], None, Tick(6));
    assert_eq!((ticks, end), (vec![1, 2, 3, 4, 5, 6], End::Limit));
}

#[test]
fn a_pause_stands_still_until_resumed() {
    let mut clock = Clock::new(Pace::EveryTick, Tick(9), interest());
    clock.pause();
    assert_eq!(clock.next(None), Next::Paused);
    assert_eq!(clock.next(None), Next::Paused);
    clock.resume();
    assert_eq!(clock.next(None), Next::Frame(Tick(1)));
}

#[test]
fn the_game_ends_with_the_tick_in_which_the_rules_end_it() {
    let mut clock = Clock::new(Pace::EveryTick, Tick(9), interest());
    assert_eq!(clock.next(None), Next::Frame(Tick(1)));
    clock.framed(Tick(1), Frame::new());
    clock.advanced(Vec::new());
    clock.sealed(Sealed { over: true, ..interest() });
    assert_eq!(clock.next(None), Next::Finished(End::Over));
    assert_eq!(clock.now(), Tick(1));
}
