//! What geometry proposes: shots that might be worth a simulation.
//!
//! Everything is seen from above and reckoned in straight lines; cushions are mirrors. What comes
//! of a shot really is left to a simulation.

mod bank;
mod carom;
mod chance;
mod combination;
mod contact;
mod cushion;
mod ease;
mod kick;
mod mouth;
mod opening;
mod pot;
mod second;
mod spots;
mod trace;
mod way;

pub use ease::shut_in;
pub use spots::{SPOTS, spots};

use super::noise::StrokeNoise;
use super::plan::{Goal, Line, LineEnd};
use super::view::TableView2d;
pub use crate::events::IdeaKind;

use crate::events::ShotKind;
use crate::ids::{BallId, PocketId};
use glam::DVec2;
use smallvec::SmallVec;

/// A shot that might be worth a simulation.
#[derive(Debug, Clone, PartialEq)]
pub struct Idea {
    /// What sort.
    pub kind: IdeaKind,
    /// The ball that the cue ball meets first.
    pub first: Option<BallId>,
    /// The ball that shall fall, or, where none falls, be met last.
    pub ball: Option<BallId>,
    /// The pocket that it shall fall into.
    pub pocket: Option<PocketId>,
    /// Where the cue ball sets out to; unit vector.
    pub direction: DVec2,
    /// Middle of the cue ball at its first meeting with a ball [m].
    pub ghost: DVec2,
    /// Where the first ball shall go, for pots and combinations, where that is what aiming is
    /// about; unit vector.
    pub first_way: Option<DVec2>,
    /// Cut at the first ball, anticlockwise positive [rad].
    pub cut_rad: f64,
    /// Way of the cue ball to the first ball [m].
    pub to_ball_m: f64,
    /// Way of balls from there to the end [m].
    pub to_end_m: f64,
    /// Cushions on both ways together.
    pub cushions: u8,
    /// Height at which the tip shall meet the cue ball, over its radius, as far as the idea depends
    /// on it (caroms): 0.4 makes it roll at once, 0 slide, less draw.
    pub height_offset: f64,
    /// Speed of the tip that just does it [m/s].
    pub speed_least_m_s: f64,
    /// Chance that it works for a player with this noise, estimated; for ranking.
    pub chance: f64,
    /// The ways, to be drawn.
    pub lines: SmallVec<[Line; 4]>,
}

/// Which ideas are wanted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Repertoire {
    /// Pots, and meeting a ball.
    Plain,
    /// Everything.
    Full,
}

/// Shots from a cue ball at `cue`, best chance first, to a thousandth. Never empty while there is
/// an object ball.
///
/// Of equal chances what pockets a ball comes first, in the order of balls and pockets; contacts
/// and breaks come in an order that makes the first few differ: near balls first, full and thin by
/// turns; kicks that only meet a ball come last. A break asks for [`IdeaKind::Break`] alone.
///
/// Where there are no pockets (carom), `cushions` counts those before the last ball is met: ideas
/// for three-cushion are those with at least three.
pub fn ideas(
    view: &TableView2d,
    cue: DVec2,
    goal: &Goal,
    noise: &StrokeNoise,
    repertoire: Repertoire,
) -> Vec<Idea> {
    let sigma_rad = chance::cue_ball_sigma_rad(noise, view.ball_radius_m);
    let position = Position { view, cue, goal, sigma_rad };
    let mut found = Vec::new();
    if goal.shot == ShotKind::Break && !view.pockets.is_empty() {
        opening::breaks(&position, &mut found);
    } else {
        pot::pots(&position, &mut found);
        contact::contacts(&position, &mut found);
    }
    if repertoire == Repertoire::Full && goal.shot != ShotKind::Break {
        combination::combinations(&position, &mut found);
        bank::banks(&position, &mut found);
        kick::kicks(&position, &mut found);
        carom::caroms(&position, &mut found);
    }
    if found.is_empty() {
        found.extend(contact::desperate(&position));
    }
    // Stable: of equal ones the first that was found.
    found.sort_by(|a, b| rank(b).total_cmp(&rank(a)).then_with(|| order(a).cmp(&order(b))));
    found
}

/// The chance as far as it matters for the order: to a thousandth.
fn rank(idea: &Idea) -> f64 {
    (1000.0 * idea.chance).round()
}

/// Of equal chances what pockets a ball comes first, and what goes straight before what does not.
fn order(idea: &Idea) -> (bool, IdeaKind) {
    let is_detour = idea.kind == IdeaKind::Kick && idea.pocket.is_none();
    (is_detour, idea.kind)
}

/// All pairs of `rows` and `columns`, those with the small sums of both numbers first.
fn diagonally(rows: usize, columns: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..rows + columns).flat_map(move |sum| {
        (0..=sum).map(move |row| (row, sum - row)).filter(move |(r, c)| *r < rows && *c < columns)
    })
}

/// Less likely combinations, banks and the like are no ideas.
const CHANCE_LEAST: f64 = 0.01;

/// What a player looks at.
#[derive(Debug, Clone, Copy)]
struct Position<'a> {
    view: &'a TableView2d,
    /// Where the cue ball lies [m].
    cue: DVec2,
    goal: &'a Goal,
    /// Standard deviation of the cue ball's direction [rad].
    sigma_rad: f64,
}

impl Position<'_> {
    fn radius(&self) -> f64 {
        self.view.ball_radius_m
    }

    /// The balls that may be met first, the nearest first.
    fn nearest_legal(&self) -> Vec<(BallId, DVec2)> {
        let mut balls: Vec<_> = self.lying(&self.goal.legal).collect();
        // Stable: of equally near ones that with the smaller number.
        balls.sort_by(|a, b| self.cue.distance(a.1).total_cmp(&self.cue.distance(b.1)));
        balls
    }

    /// Balls of a list that lie on the table, with their places.
    fn lying<'b>(&'b self, balls: &'b [BallId]) -> impl Iterator<Item = (BallId, DVec2)> + 'b {
        balls.iter().filter_map(|id| Some((*id, self.view.position(*id)?)))
    }
}

/// A free way, to be drawn.
fn line(from: DVec2, to: DVec2, end: LineEnd) -> Line {
    Line { from, to, end, free: true, chosen: false }
}
