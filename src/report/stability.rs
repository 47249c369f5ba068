//! Where methods break: stiff springs, hard contacts, extremes of mass, size, speed and place.

mod cases;
mod hertz;
mod springs;

pub use cases::CASES;
pub use hertz::{HertzRow, hertz_rows};
pub use springs::{Limit, RATIOS, STIFFNESSES, spring_cell, spring_limit};

use super::method::Method;
use super::starts::{self, R, on_bed};
use super::trial::Patience;
use crate::events::FactSet;
use crate::ids::BallId;
use crate::physics::{Integrator, PhysicsError, PhysicsSettings, Profile, Simulation};
use crate::units::Seconds;
use glam::DVec3;

/// The methods of the table: the exact solver, each integrator at the paper's step, and the paper's
/// own with sub-steps and at a finer one.
pub const COLUMNS: [Method; 7] = [
    Method::EventDriven,
    Method::FixedStep { integrator: Integrator::EulerCromer, step_ms: 4.0 },
    Method::FixedStep { integrator: Integrator::Verlet, step_ms: 4.0 },
    Method::FixedStep { integrator: Integrator::PositionVerlet, step_ms: 4.0 },
    Method::FixedStep { integrator: Integrator::Rk4, step_ms: 4.0 },
    Method::SubSteps { integrator: Integrator::EulerCromer, step_ms: 4.0 },
    Method::FixedStep { integrator: Integrator::EulerCromer, step_ms: 1.0 },
];

/// Below this share of its scale an error is rounding.
const EXACT: f64 = 1e-9;
/// An error that is this much larger in the second half grows.
const GROWS: f64 = 1.5;
/// An error of so many scales is no bounded one.
const APART: f64 = 100.0;

/// What a method does in a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Class {
    /// The error is rounding.
    Exact,
    /// There is an error, and it stays as it is.
    Bounded,
    /// It grows with time.
    Drifts,
    /// It has no bound.
    Diverges,
    /// The method gave up and said why.
    GivesUp,
    /// It took longer than it was given.
    TooSlow,
}

impl Class {
    /// In a word.
    pub fn word(self) -> &'static str {
        match self {
            Class::Exact => "exact",
            Class::Bounded => "bounded",
            Class::Drifts => "drifts",
            Class::Diverges => "diverges",
            Class::GivesUp => "gives up",
            Class::TooSlow => "too slow",
        }
    }
}

/// A case of the table.
#[derive(Clone, Copy)]
pub struct Case {
    /// Its name.
    pub id: &'static str,
    /// What happens.
    pub title: &'static str,
    /// What the number is.
    pub measures: &'static str,
    pub(super) run: fn(Method, Patience<'_>) -> Result<Measured, PhysicsError>,
}

/// Largest errors in the first and second half of a case, over the case's scale.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Measured {
    first: f64,
    second: f64,
    /// When patience ended, if it did [s].
    stopped_s: Option<Seconds>,
}

/// A cell of the table.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// What it does.
    pub class: Class,
    /// Its largest error, over the case's scale.
    pub error: f64,
    /// What the solver said if it gave up, or where the limit is.
    pub note: String,
}

impl Case {
    /// The cell of a method, as long as `patience` lasts.
    pub fn cell(&self, method: Method, patience: Patience<'_>) -> Cell {
        Cell::of((self.run)(method, patience))
    }
}

impl Cell {
    fn of(measured: Result<Measured, PhysicsError>) -> Cell {
        match measured {
            Ok(measured) => measured.cell(),
            // What is not finite any more has flown apart.
            Err(PhysicsError::NonFinite { .. }) => {
                Cell { class: Class::Diverges, error: f64::INFINITY, note: String::new() }
            }
            Err(error) => {
                Cell { class: Class::GivesUp, error: f64::INFINITY, note: error.to_string() }
            }
        }
    }
}

impl Measured {
    fn cell(self) -> Cell {
        let error = self.first.max(self.second);
        let class = if self.stopped_s.is_some() {
            Class::TooSlow
        } else if !(error < APART) {
            Class::Diverges
        } else if error <= EXACT {
            Class::Exact
        } else if self.second > GROWS * self.first {
            Class::Drifts
        } else {
            Class::Bounded
        };
        let note = self.stopped_s.map(|at| format!("stopped at {at:.3} s")).unwrap_or_default();
        Cell { class, error, note }
    }
}

/// Runs a world, as long as `patience` lasts, to `until_s` and takes the error at `looks` times;
/// one that is no number counts as infinite.
fn measure(
    patience: Patience<'_>,
    mut world: Simulation,
    until_s: Seconds,
    looks: u32,
    mut error: impl FnMut(&Simulation, Seconds) -> f64,
) -> Result<Measured, PhysicsError> {
    let mut measured = Measured::default();
    let mut facts = Vec::new();
    for look in 1..=looks {
        let at = until_s * f64::from(look) / f64::from(looks);
        if !patience() {
            measured.stopped_s = Some(world.now_s());
            break;
        }
        facts.clear();
        world.advance(at, FactSet::NONE, &mut facts)?;
        let now = error(&world, at).abs();
        let now = if now.is_nan() { f64::INFINITY } else { now };
        let half = if 2 * look <= looks { &mut measured.first } else { &mut measured.second };
        *half = half.max(now);
    }
    Ok(measured)
}

/// How a lying ball trembles.
#[derive(Debug, Clone, PartialEq)]
pub struct RestRow {
    /// Which method under which profile.
    pub what: String,
    /// For so long [s].
    pub lasts_s: Seconds,
    /// Highest above where it should lie, as seen at 60 frames a second [m].
    pub hop_m: f64,
    /// How often it is seen to rise from below to above the middle of its heights [Hz].
    pub seen_hz: f64,
}

/// A ball lies for `lasts_s`: the exact solver, the stepper with the same laws, and the paper's
/// profile of 2009 at some steps.
///
/// # Errors
/// [`PhysicsError`] if a solver does not get on.
pub fn rest_rows(lasts_s: Seconds) -> Result<Vec<RestRow>, PhysicsError> {
    let paper = |step_ms| {
        let method = Method::FixedStep { integrator: Integrator::EulerCromer, step_ms };
        PhysicsSettings { profile: Profile::Paper2009, ..method.settings() }
    };
    let mut rows = Vec::new();
    for (what, settings) in [
        ("event-driven, standard", COLUMNS[0].settings()),
        ("Euler-Cromer 4 ms, standard", COLUMNS[1].settings()),
        ("Euler-Cromer 4 ms, 2009", paper(4.0)),
        ("Euler-Cromer 3.9 ms, 2009", paper(3.9)),
        ("Euler-Cromer 1 ms, 2009", paper(1.0)),
        ("position Verlet 4 ms, 2009", {
            PhysicsSettings { integrator: Integrator::PositionVerlet, ..paper(4.0) }
        }),
    ] {
        let balls = vec![on_bed(0, 0.0, 0.0, DVec3::ZERO, DVec3::ZERO)];
        let mut world = Simulation::from_parts(&starts::cloth(), balls, &settings)?;
        let mut heights = Vec::new();
        let mut facts = Vec::new();
        for frame in 1..=(lasts_s * 60.0) as u32 {
            let at = f64::from(frame) / 60.0;
            facts.clear();
            world.advance(at, FactSet::NONE, &mut facts)?;
            let height = world.sample(BallId(0), at).map_or(f64::NAN, |ball| ball.position.z);
            heights.push(height - R);
        }
        let highest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let lowest = heights.iter().copied().fold(f64::INFINITY, f64::min);
        let middle = 0.5 * (highest + lowest);
        let rises = heights.windows(2).filter(|pair| pair[0] <= middle && middle < pair[1]).count();
        rows.push(RestRow {
            what: what.to_string(),
            lasts_s,
            hop_m: highest.max(-lowest).max(0.0),
            seen_hz: rises as f64 / lasts_s,
        });
    }
    Ok(rows)
}
