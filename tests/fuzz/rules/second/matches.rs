//! Matches of computer players on a simulated table, watched by the second judge.

use super::watched::{Met, Watched};
use super::{GAMES, SecondJudge, number, report};
use hapticbillard::cast::Cast;
use hapticbillard::events::{Event, Source, Topic, Topics};
use hapticbillard::hash::StateHash;
use hapticbillard::lockstep::{self, Setup};
use hapticbillard::physics::Snapshot;
use hapticbillard::rules::{GameKind, game, topics};
use hapticbillard::scene::{Overrides, Scene};
use hapticbillard::shipped;
use hapticbillard::tick::{Delivered, Outcome, Participant};
use hapticbillard::units::Tick;
use std::sync::{Arc, Mutex};
use std::time::Instant;

const SCENE: &str = "eight_ball_headless";
/// A match that is longer has no end [ticks].
const LIMIT: u64 = 10_000_000;

#[test]
fn a_second_judge_agrees_on_simulated_matches() {
    let matches = number("SECOND_MATCHES", 3);
    for (kind, second) in GAMES {
        let (met, start) = (Arc::new(Mutex::new(Met::default())), Instant::now());
        for seed in 1..=matches {
            simulate(kind, second, seed, &met);
        }
        let met = met.lock().unwrap();
        report(kind, &met, start);
        assert_eq!(met.games, matches, "{kind}: a match came to no end");
    }
}

fn simulate(kind: GameKind, second: SecondJudge, seed: u64, met: &Arc<Mutex<Met>>) {
    let text = shipped::scene(SCENE).unwrap().replace("paper-eight-ball", kind.id());
    let mut scene = Scene::parse(SCENE, &text).unwrap();
    Overrides { seed: Some(seed), ..Overrides::default() }.apply(&mut scene);
    let table = scene.build_table(&mut |_| Err("no files".into())).unwrap();
    let cast = Cast::new(&scene, Arc::new(table)).unwrap();
    let watched = Watched::new(kind, game(kind).judge, second);
    let shadow = Shadow { kind, seed, watched, met: met.clone() };
    let setup = Setup { observers: vec![Box::new(shadow)], ..Setup::headless(Tick(LIMIT)) };
    lockstep::run(cast, setup).unwrap();
}

/// A referee of its own, who hears what the match's referee hears and says nothing.
struct Shadow {
    kind: GameKind,
    seed: u64,
    watched: Watched,
    met: Arc<Mutex<Met>>,
}

impl Participant for Shadow {
    fn source(&self) -> Source {
        Source::Runtime
    }

    fn topics(&self) -> Topics {
        topics(self.kind).or(Topics::of(&[Topic::Command, Topic::Verdict]))
    }

    fn start(&mut self, table: &Snapshot) -> Outcome {
        self.watched.begin(table.on_table().map(|ball| ball.id));
        Outcome::default()
    }

    fn collect(&mut self, delivered: &Delivered) -> Outcome {
        let mut met = self.met.lock().unwrap();
        for stamped in delivered.events.iter() {
            let result = match &stamped.event {
                Event::Fact(fact) => self.watched.handle(fact, &mut met),
                Event::Command(command) => {
                    self.watched.obey(stamped.stamp.source, command, &mut met)
                }
                Event::Verdict(verdict) => {
                    met.games += u64::from(verdict.next_player.is_none());
                    let own = self.watched.referee.verdict();
                    assert_eq!(own, Some(verdict), "{} {}", self.kind, self.seed);
                    Ok(())
                }
                _ => Ok(()),
            };
            result
                .unwrap_or_else(|problem| panic!("{}, match {}: {problem}", self.kind, self.seed));
        }
        Outcome::default()
    }

    fn hash(&self, _: &mut StateHash) {}
}
