//! A game as a race: who needs how many more balls, and what that is worth.
//!
//! Each ball falls with the same chance q, and a miss passes the turn. With n balls to go for the
//! shooter and m for the other, the shooter wins with
//! `w(n, m) = q w(n − 1, m) + (1 − q)(1 − w(m, n))`, w(0, m) = 1; where both need the same balls,
//! `w(n) = q w(n − 1) + (1 − q)(1 − w(n))`. It is what is left of a game tree when positions are
//! forgotten; the position decides about the next ball alone.

use crate::ai::ideas::Idea;
use crate::ai::noise::StrokeNoise;
use crate::ai::settings::Level;
use crate::events::{BallOn, Group, Groups};
use crate::ids::{BallId, GameKind};
use crate::rules::State;

/// More balls to go than anybody needs: 100 points of straight pool and some penalties.
const MOST: usize = 140;
/// Points that a pot of snooker brings on average: a red and a colour in turn.
const POINTS_PER_POT: f64 = 3.5;

/// How races end.
#[derive(Debug, Clone)]
pub struct Races {
    game: GameKind,
    /// Chance of a ball of an average position.
    pub pot: f64,
    /// w(n, m) in rows of n.
    own: Vec<f64>,
    /// w(n) of shared balls.
    shared: Vec<f64>,
}

/// Who needs how much.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Standing {
    /// The shooter needs so many, the other so many.
    Own(usize, usize),
    /// So many balls are left, and the last one wins.
    Shared(usize),
}

/// What the shooter's next ball decides: the chance to win after each.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prospects {
    /// The ball falls.
    pub pot: f64,
    /// It does not, and the other goes on from an average position.
    pub miss: f64,
    /// Nothing falls, and the other finds no pot.
    pub safe: f64,
    /// A foul.
    pub foul: f64,
}

impl Prospects {
    /// What a pot of this chance is worth.
    pub fn of_pot(&self, chance: f64) -> f64 {
        chance * self.pot + (1.0 - chance) * self.miss
    }

    /// What a safety is worth that meets its ball with this chance.
    pub fn of_contact(&self, chance: f64) -> f64 {
        chance * self.safe + (1.0 - chance) * self.foul
    }

    /// What an idea is worth that does what it is meant to and then leaves a position of `value`.
    pub fn of_idea(&self, idea: &Idea, value: f64) -> f64 {
        match idea.pocket {
            Some(_) => idea.chance * value + (1.0 - idea.chance) * self.miss,
            None => value,
        }
    }
}

impl Races {
    /// The races of a game between two players of this level who err so much.
    pub fn new(game: GameKind, level: Level, noise: &StrokeNoise) -> Self {
        let times = noise.azimuth_rad / StrokeNoise::OLYMPIAD.azimuth_rad;
        // Ball for ball what such a player pots, as measured in tournaments.
        let pool = match level {
            Level::Champion => (0.99 - 0.06 * times).clamp(0.35, 0.97),
            Level::Club | Level::Paper => (0.93 - 0.08 * times).clamp(0.35, 0.95),
        };
        let pot = match game {
            GameKind::Snooker => pool - 0.1,
            GameKind::FreeCarom => pool - 0.15,
            GameKind::ThreeCushion => 0.5 * pool,
            _ => pool,
        };
        let mut own = vec![0.0; (MOST + 1) * (MOST + 1)];
        let miss = 1.0 - pot;
        own.iter_mut().take(MOST + 1).for_each(|w| *w = 1.0);
        for sum in 2..=2 * MOST {
            for n in 1..=MOST.min(sum - 1) {
                let m = sum - n;
                if MOST < m {
                    continue;
                }
                let hit = pot * own[(n - 1) * (MOST + 1) + m];
                let other = pot * own[(m - 1) * (MOST + 1) + n];
                own[n * (MOST + 1) + m] =
                    (hit + miss - miss * other - miss * miss) / (1.0 - miss * miss);
            }
        }
        let mut shared = vec![1.0; MOST + 1];
        for n in 1..=MOST {
            shared[n] = (pot * shared[n - 1] + miss) / (1.0 + miss);
        }
        Races { game, pot, own, shared }
    }

    /// What the next ball of whoever shoots decides. Of the shooter's balls and of the other's so
    /// many are shut in; each counts for one more ball that must be played.
    pub fn prospects(&self, state: &State, shut_in: [f64; 2]) -> Prospects {
        let standing = self.standing(state);
        let (n, m) = match standing {
            Standing::Own(n, m) => (n as f64, m as f64),
            Standing::Shared(n) => (n as f64, n as f64),
        };
        let (own, other) = (n + shut_in[0], m + shut_in[1]);
        let win = |own: f64, other: f64| match standing {
            Standing::Own(..) => self.own_at(own, other),
            Standing::Shared(_) => self.shared_at(own),
        };
        // The last ball wins, whatever else is shut in.
        let after = |balls: f64, own: f64, other: f64| {
            if balls <= 1.0 { 1.0 } else { win(own - 1.0, other) }
        };
        let other_after = after(m, other, own);
        // Half of what an average position is worth, and almost a sure ball.
        let with =
            |chance: f64| 1.0 - (chance * other_after + (1.0 - chance) * (1.0 - win(own, other)));
        Prospects {
            pot: after(n, own, other),
            miss: 1.0 - win(other, own),
            safe: with(0.5 * self.pot),
            foul: with(0.5 + 0.5 * self.pot),
        }
    }

    /// w(n, m) between whole numbers, linearly.
    fn own_at(&self, n: f64, m: f64) -> f64 {
        let at = |n: usize, m: usize| self.own[n.min(MOST) * (MOST + 1) + m.min(MOST)];
        between(n, |n| between(m, |m| at(n, m)))
    }

    /// w(n) between whole numbers, linearly.
    fn shared_at(&self, n: f64) -> f64 {
        between(n, |n| self.shared[n.min(MOST)])
    }

    fn standing(&self, state: &State) -> Standing {
        let (own, other) = (state.score.of(state.player), state.score.of(state.player.other()));
        let to_go = |target: i32, score: i32| usize::try_from(target - score).unwrap_or(0).max(1);
        let left = state.on_table.len().max(1);
        match self.game {
            GameKind::PaperEightBall | GameKind::WpaEightBall => eight_ball(state),
            GameKind::WpaNineBall => Standing::Shared(left),
            GameKind::Straight => Standing::Own(to_go(100, own), to_go(100, other)),
            GameKind::FreeCarom => Standing::Own(to_go(30, own), to_go(30, other)),
            GameKind::ThreeCushion => Standing::Own(to_go(15, own), to_go(15, other)),
            GameKind::Snooker => snooker(state, own - other),
            GameKind::FreePlay | GameKind::Training => Standing::Own(left, left),
        }
    }
}

/// Between the values at the whole numbers around `x`, which is not negative.
fn between(x: f64, at: impl Fn(usize) -> f64) -> f64 {
    let below = libm::floor(x.max(0.0));
    let share = x.max(0.0) - below;
    let below = below as usize;
    (1.0 - share) * at(below) + share * at(below + 1)
}

fn eight_ball(state: &State) -> Standing {
    let left = |group: Group| group.among(&state.on_table).count() + 1;
    match state.groups.unwrap_or_default() {
        Groups::Assigned { .. } => {
            let groups = state.groups.unwrap_or_default();
            let own = groups.of(state.player).map_or(8, left);
            let other = groups.of(state.player.other()).map_or(8, left);
            Standing::Own(own, other)
        }
        Groups::Open => {
            let (a, b) = (left(Group::Solids), left(Group::Stripes));
            Standing::Own(a.min(b), a.max(b))
        }
    }
}

/// Who has so many points more wins as soon as the other cannot get level with what is left.
fn snooker(state: &State, lead: i32) -> Standing {
    let reds = state.on_table.iter().filter(|ball| BallOn::Red.is(**ball)).count() as i32;
    let value = |ball: &BallId| i32::from(ball.0) - 14;
    let colours: i32 = match reds {
        0 => state.on_table.iter().filter(|ball| BallOn::Colour.is(**ball)).map(value).sum(),
        _ => 27,
    };
    let left = 8 * reds + colours;
    let pots = |points: i32| {
        let pots = libm::ceil((f64::from(points) / 2.0 + 0.5) / POINTS_PER_POT);
        (pots.max(1.0)) as usize
    };
    Standing::Own(pots(left - lead), pots(left + lead))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::PlayerId;

    #[test]
    fn a_race_obeys_its_equation() {
        let races = Races::new(GameKind::WpaEightBall, Level::Club, &StrokeNoise::OLYMPIAD);
        let w = |n: usize, m: usize| races.own[n * (MOST + 1) + m];
        let q = races.pot;
        for (n, m) in [(1, 1), (3, 7), (8, 2), (100, 99)] {
            let expected = q * w(n - 1, m) + (1.0 - q) * (1.0 - w(m, n));
            assert!((w(n, m) - expected).abs() < 1e-12, "{n} {m}");
        }
        let v = |n: usize| races.shared[n];
        for n in [1, 4, 9] {
            assert!((v(n) - (q * v(n - 1) + (1.0 - q) * (1.0 - v(n)))).abs() < 1e-12);
        }
    }

    #[test]
    fn fewer_balls_to_go_are_better_and_a_foul_is_the_worst() {
        let races = Races::new(GameKind::WpaEightBall, Level::Club, &StrokeNoise::OLYMPIAD);
        let state = |own: u16, other: u16| State {
            player: PlayerId::ONE,
            groups: Some(Groups::Assigned { one: Group::Solids }),
            on_table: (1..=own).chain([8]).chain(9..9 + other).map(BallId).collect(),
            ..State::default()
        };
        let few = races.prospects(&state(1, 5), [0.0; 2]);
        let many = races.prospects(&state(5, 1), [0.0; 2]);
        assert!(many.pot < few.pot && many.miss < few.miss);
        for prospects in [few, many] {
            let Prospects { pot, miss, safe, foul } = prospects;
            assert!(foul < miss && miss < safe && safe < pot, "{prospects:?}");
        }
        assert_eq!(races.prospects(&state(0, 5), [0.0; 2]).pot, 1.0);
        let shut_in = |own, other| races.prospects(&state(4, 4), [own, other]);
        let (open, own, other) = (shut_in(0.0, 0.0), shut_in(1.3, 0.0), shut_in(0.0, 1.3));
        assert!(own.pot < open.pot && open.pot < other.pot);
        assert!(own.miss < open.miss && open.miss < other.miss);
    }
}
