//! The next stroke: ideas, each with many touches, tried without noise; the best of them under the
//! player's own noise, by successive halving with common errors; and for the last few one more
//! look at the position that they leave.

use super::aim::{self, Touch};
use super::decision::{Considered, Decision, Deliberation, PlannedShot, Thoughts};
use super::trial::{self, Trial};
use super::value;
use super::world::World;
use super::{Mind, Outcome, Task, Workers};
use crate::ai::ideas::{Idea, IdeaKind, Repertoire, ideas};
use crate::ai::plan::Goal;
use crate::ai::settings::Level;
use crate::hash::seed_of;
use crate::ids::GameKind;

/// Hardest tip [m/s], but for a break.
const SPEED_MOST_M_S: f64 = 6.0;
/// Cushions before the second ball in three-cushion.
const THREE: u8 = 3;

/// How much is tried.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Breadth {
    /// Pots that are tried with all touches.
    leading: usize,
    /// Pots, other ways to pocket a ball, and shots that pocket nothing.
    ideas: [usize; 3],
    /// Speeds over the least one.
    speeds: &'static [f64],
    /// Contact points upwards, and to the right.
    heights: &'static [f64],
    sides: &'static [f64],
    /// Shots that are tried with noise.
    leaders: usize,
    /// How often in the first round.
    first_round: u32,
}

impl Breadth {
    /// What a number of simulations is enough for.
    fn of(level: Level, simulations: u32) -> Self {
        const CLUB: Breadth = Breadth {
            leading: 0,
            ideas: [4, 0, 2],
            speeds: &[1.25, 1.8],
            heights: &[0.0, -0.3, 0.3],
            sides: &[0.0],
            leaders: 10,
            first_round: 8,
        };
        const FULL: Breadth = Breadth {
            leading: 6,
            ideas: [10, 6, 10],
            speeds: &[1.12, 1.4, 1.8, 2.4, 3.2],
            heights: &[0.0, -0.2, -0.4, 0.2, 0.4],
            sides: &[0.0, -0.3, 0.3],
            leaders: 24,
            first_round: 8,
        };
        match (level, simulations) {
            (_, 0..=30) => {
                Breadth { ideas: [3, 0, 1], speeds: &[1.4], heights: &[0.0], leaders: 4, ..CLUB }
            }
            (Level::Paper | Level::Club, _) => CLUB,
            (_, 0..=300) => {
                Breadth { leading: 0, ideas: [4, 1, 4], leaders: 8, first_round: 4, ..FULL }
            }
            (_, 301..=1500) => Breadth {
                leading: 4,
                ideas: [6, 3, 6],
                speeds: &[1.12, 1.6, 2.4],
                heights: &[0.0, -0.3, 0.3],
                sides: &[0.0],
                leaders: 12,
                first_round: 8,
            },
            _ => FULL,
        }
    }
}

/// A shot that is still in question.
#[derive(Debug, Clone)]
struct Contender {
    trial: Trial,
    /// What it is worth before it was tried with noise.
    promise: f64,
    /// Whether it was no foul then.
    is_legal: bool,
    samples: u32,
    successes: u32,
    legals: u32,
    value_sum: f64,
}

impl Contender {
    fn value(&self) -> f64 {
        if self.samples == 0 { self.promise } else { self.value_sum / f64::from(self.samples) }
    }

    /// It was a foul whenever it was tried.
    fn is_foul(&self) -> bool {
        if self.samples == 0 { !self.is_legal } else { self.legals == 0 }
    }

    fn take(&mut self, outcome: &Outcome) {
        self.samples += 1;
        self.successes += u32::from(outcome.success);
        self.legals += u32::from(outcome.legal);
        self.value_sum += outcome.value;
    }
}

/// A search that is under way.
struct Search<'a> {
    mind: &'a Mind,
    task: &'a Task,
    world: &'a World,
    workers: &'a dyn Workers,
    ideas: Vec<Idea>,
    simulations: u32,
}

/// Decides about the next stroke.
pub fn shoot(
    mind: &Mind,
    task: &Task,
    world: &World,
    workers: &dyn Workers,
) -> Option<Deliberation> {
    let cue = world.view.cue_ball?;
    let goal = Goal::of(&world.turn, &world.view, task.played_from);
    let is_carom = world.view.pockets.is_empty();
    let repertoire = if mind.level == Level::Champion || is_carom {
        Repertoire::Full
    } else {
        Repertoire::Plain
    };
    let breadth = Breadth::of(mind.level, mind.simulations);
    let mut ideas = ideas(&world.view, cue, &goal, &mind.noise, repertoire);
    if mind.game == GameKind::ThreeCushion {
        ideas.retain(|idea| idea.kind != IdeaKind::Carom || THREE <= idea.cushions);
    }
    let ideas = of_each_kind(ideas, &breadth);
    let mut search = Search { mind, task, world, workers, ideas, simulations: 0 };
    let mut contenders = search.without_noise(&breadth);
    search.halve(&mut contenders, &breadth);
    search.conclude(contenders)
}

impl Search<'_> {
    /// What is tried: everything that costs one simulation, then what must be scanned, the first
    /// touch of every idea before the second of any; for half of the budget.
    fn tries(&self, breadth: &Breadth) -> Vec<(usize, Touch)> {
        // Where an open table is no gain, the break is a shot like any other.
        let is_soft = matches!(self.mind.game, GameKind::Straight | GameKind::Snooker);
        let break_m_s = (!is_soft).then(|| self.mind.break_speed_m_s());
        let mut tries: Vec<(bool, usize, usize, Touch)> = Vec::new();
        for (n, idea) in self.ideas.iter().enumerate() {
            let is_leading = n < breadth.leading && idea.kind == IdeaKind::Pot;
            let is_scanned = aim::is_worth_a_scan(idea);
            let touches = touches(idea, is_leading, break_m_s, breadth).enumerate();
            tries.extend(touches.map(|(rank, touch)| (is_scanned, rank, n, touch)));
        }
        // Stable: what costs little stays in the order of the ideas.
        tries.sort_by_key(|(is_scanned, rank, ..)| {
            (*is_scanned, if *is_scanned { *rank } else { 0 })
        });
        let mut left = self.mind.simulations / 2;
        let mut taken = Vec::new();
        for (is_scanned, _, n, touch) in tries {
            let cost = if is_scanned { aim::SCAN } else { 1 };
            // One of them is tried whatever it costs.
            if left < cost && !taken.is_empty() {
                break;
            }
            left = left.saturating_sub(cost);
            taken.push((n, touch));
        }
        taken
    }

    /// All ideas with their touches, tried as they are meant; the most promising first.
    fn without_noise(&mut self, breadth: &Breadth) -> Vec<Contender> {
        let tries = self.tries(breadth);
        let (mind, world, ideas) = (self.mind, self.world, &self.ideas);
        let outcomes = self.workers.run(tries.len(), &|job| {
            let (n, touch) = tries[job];
            aim::best(mind, world, &ideas[n], touch)
        });
        let prospects = value::prospects(mind, world);
        let mut contenders: Vec<Contender> = tries
            .iter()
            .zip(&outcomes)
            .map(|((n, _), outcome)| {
                self.simulations += outcome.simulations;
                let idea = &self.ideas[*n];
                let promise = match outcome.success {
                    true => prospects.of_idea(idea, outcome.value),
                    // It may still be the least bad.
                    false => 0.5 * outcome.value,
                };
                let trial = Trial { idea: *n, aim: outcome.aim, speed_m_s: outcome.speed_m_s };
                Contender {
                    trial,
                    promise,
                    is_legal: outcome.legal,
                    samples: 0,
                    successes: 0,
                    legals: 0,
                    value_sum: 0.0,
                }
            })
            .collect();
        // Stable: of equal ones the first that was thought of.
        contenders.sort_by(|a, b| b.promise.total_cmp(&a.promise));
        diverse(contenders, breadth.leaders, &self.ideas)
    }

    /// Tries the leaders under the player's noise: all a few times, the better half twice as
    /// often, and so on. All err in the same way, so that luck decides nothing.
    fn halve(&mut self, contenders: &mut [Contender], breadth: &Breadth) {
        let mut left = contenders.len();
        let (mut done, mut target) = (0, breadth.first_round);
        if self.mind.noise.is_none() {
            target = 1;
        }
        while 0 < left && !self.workers.is_cancelled() {
            target = target.min(done + self.left_over() / left as u32);
            let rounds = (target - done) as usize;
            if rounds == 0 {
                break;
            }
            let (mind, world, ideas, task) = (self.mind, self.world, &self.ideas, self.task);
            let leaders = &contenders[..left];
            let outcomes = self.workers.run(left * rounds, &|job| {
                let trial = &leaders[job / rounds].trial;
                let seed = seed_of(task.seed, u64::from(done) + (job % rounds) as u64);
                let stroke = (trial.aim, trial.speed_m_s);
                trial::with_noise(mind, world, &ideas[trial.idea], stroke, seed)
            });
            for (n, outcome) in outcomes.iter().enumerate() {
                contenders[n / rounds].take(outcome);
                self.simulations += outcome.simulations;
            }
            contenders[..left].sort_by(|a, b| b.value().total_cmp(&a.value()));
            if left <= 3 || mind.noise.is_none() {
                break;
            }
            left = left.div_ceil(2);
            (done, target) = (target, 2 * target);
        }
    }

    /// Simulations that are left.
    fn left_over(&self) -> u32 {
        self.mind.simulations.saturating_sub(self.simulations)
    }

    fn conclude(self, mut contenders: Vec<Contender>) -> Option<Deliberation> {
        // Nobody fouls on purpose while there is another way, however little the value of a
        // position thinks of it. Stable: otherwise the best stays the first.
        contenders.sort_by_key(Contender::is_foul);
        let first = contenders.first()?;
        let share = |count: u32, contender: &Contender| {
            if contender.samples == 0 {
                0.0
            } else {
                f64::from(count) / f64::from(contender.samples)
            }
        };
        let idea = self.ideas[first.trial.idea].clone();
        let shot = PlannedShot {
            aim: first.trial.aim,
            speed_m_s: first.trial.speed_m_s,
            call: trial::call(&idea, self.world.turn.calls),
            success: share(first.successes, first),
            value: first.value(),
            idea,
        };
        let considered = |(n, contender): (usize, &Contender)| Considered {
            idea: self.ideas[contender.trial.idea].clone(),
            aim: contender.trial.aim,
            speed_m_s: contender.trial.speed_m_s,
            success: share(contender.successes, contender),
            legal: share(contender.legals, contender),
            value: contender.value(),
            samples: contender.samples,
            chosen: n == 0,
        };
        let candidates = contenders.iter().enumerate().map(considered).collect();
        Some(Deliberation {
            decision: Decision::Shoot(Box::new(shot)),
            thoughts: Thoughts { candidates },
            simulations: self.simulations,
        })
    }
}

/// The best pots, other ways to pocket a ball, and others, in this order.
fn of_each_kind(ideas: Vec<Idea>, breadth: &Breadth) -> Vec<Idea> {
    let mut left = breadth.ideas;
    let mut kinds: [Vec<Idea>; 3] = Default::default();
    for idea in ideas {
        let kind = match idea.kind {
            IdeaKind::Pot => 0,
            _ if idea.pocket.is_some() => 1,
            IdeaKind::Carom | IdeaKind::Break => 0,
            _ => 2,
        };
        if 0 < left[kind] {
            left[kind] -= 1;
            kinds[kind].push(idea);
        }
    }
    kinds.into_iter().flatten().collect()
}

/// How an idea is tried; a break with up to so many m/s, if it is one to be played hard.
fn touches<'a>(
    idea: &'a Idea,
    is_leading: bool,
    break_m_s: Option<f64>,
    breadth: &'a Breadth,
) -> impl Iterator<Item = Touch> + 'a {
    let (most, least) = match break_m_s.filter(|_| idea.kind == IdeaKind::Break) {
        Some(hardest) => (hardest, 0.8 * hardest),
        None => (SPEED_MOST_M_S, idea.speed_least_m_s),
    };
    let sides = if is_leading { breadth.sides } else { &breadth.sides[..1] };
    let heights =
        if is_leading { breadth.heights } else { &breadth.heights[..breadth.heights.len().min(3)] };
    let speeds = breadth.speeds.iter().map(move |factor| (factor * least).min(most));
    let mut last = 0.0;
    speeds.filter(move |speed| *speed != std::mem::replace(&mut last, *speed)).flat_map(
        move |speed_m_s| {
            heights.iter().flat_map(move |height| {
                sides.iter().map(move |side| Touch { speed_m_s, side: *side, height: *height })
            })
        },
    )
}

/// The best ones, of which no idea has more than a third, and a fifth that pockets nothing.
fn diverse(contenders: Vec<Contender>, wanted: usize, ideas: &[Idea]) -> Vec<Contender> {
    let most = wanted.div_ceil(3);
    let (mut attacks, mut safeties) = (wanted - wanted / 5, wanted);
    let mut of_idea = vec![0; ideas.len()];
    let mut taken = Vec::with_capacity(wanted);
    let mut rest = Vec::new();
    for contender in contenders {
        let idea = contender.trial.idea;
        let count = &mut of_idea[idea];
        let share = match ideas[idea].pocket.is_some() {
            true => &mut attacks,
            false => &mut safeties,
        };
        if taken.len() < wanted && *count < most && 0 < *share {
            *count += 1;
            *share -= 1;
            taken.push(contender);
        } else {
            rest.push(contender);
        }
    }
    rest.truncate(wanted - taken.len());
    taken.append(&mut rest);
    taken
}
