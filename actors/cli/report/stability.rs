//! Measures the chapters on chaos and stability.

use super::measure::budget;
use hapticbillard::physics::{Integrator, PhysicsError, PhysicsSettings, Profile};
use hapticbillard::report::{self, Cell, Form, Growth, HertzRow, Hop, Limit, Method, RestRow};
use hapticbillard_actors::error::Error;
use indicatif::ProgressBar;

/// How long breaks are followed while a disturbance grows [s].
const GROWTH_S: f64 = 2.0;
/// When breaks are compared as a whole [s].
pub const LOOK_S: f64 = 1.5;
/// Speed of two balls that meet by Hertz' law [m/s].
pub const HERTZ_M_S: f64 = 5.0;
/// Height of the drop that shows the first hop [m], and its restitution.
pub const DROP: (f64, f64) = (0.1, 0.5);
/// Steps of that drop [ms].
pub const DROP_STEPS_MS: [f64; 3] = [4.0, 1.0, 0.25];

/// What a cell may take [s].
const CELL_S: f64 = 5.0;

/// Everything of both chapters.
pub struct Table {
    /// Cases by methods.
    pub rows: Vec<Line>,
    /// For each integrator and damping: where it becomes unstable.
    pub limits: Vec<(Integrator, f64, Limit)>,
    /// How a lying ball trembles.
    pub rest: Vec<RestRow>,
    /// The time of contact [s] and what steps make of it.
    pub hertz: (f64, Vec<HertzRow>),
    /// What a dropped ball does, by form and step.
    pub hops: Vec<(Form, f64, Hop)>,
    /// What the solver itself makes of the drop, by integrator, profile and step.
    pub solver_hops: Vec<(Integrator, Profile, f64, Hop)>,
    /// How disturbances of breaks grow.
    pub growth: Vec<Growth>,
    /// What breaks have in common.
    pub spread: Vec<Result<report::Spread, (Method, PhysicsError)>>,
    /// Over how many racks.
    pub racks: usize,
}

/// A row of the table.
pub struct Line {
    /// Its name.
    pub id: String,
    /// What happens.
    pub title: String,
    /// What the numbers are.
    pub measures: &'static str,
    /// Damping over critical, of a spring.
    pub ratio: Option<f64>,
    /// One for each method.
    pub cells: Vec<(Method, Cell)>,
}

/// How many lines there are to be measured.
pub fn length() -> u64 {
    (report::CASES.len() + report::STIFFNESSES.len() * report::RATIOS.len()) as u64 + 5
}

/// Measures.
pub fn measure(quick: bool, bar: &ProgressBar) -> Result<Table, Error> {
    let mut rows = Vec::new();
    for ratio in report::RATIOS {
        for stiffness in report::STIFFNESSES {
            let cell = |method: Method| (method, report::spring_cell(stiffness, ratio, method));
            rows.push(Line {
                id: format!("spring_{stiffness:e}_{ratio}"),
                title: format!("spring of {stiffness:e} N/m, damping {ratio}"),
                measures: "place, over the first displacement, in 1 s",
                ratio: Some(ratio),
                cells: report::COLUMNS.map(cell).to_vec(),
            });
            bar.inc(1);
        }
    }
    for case in report::CASES {
        rows.push(Line {
            id: case.id.to_string(),
            title: case.title.to_string(),
            measures: case.measures,
            ratio: None,
            cells: report::COLUMNS
                .map(|method| (method, case.cell(method, &mut budget(CELL_S))))
                .to_vec(),
        });
        bar.inc(1);
    }
    let mut limits = Vec::new();
    for ratio in report::RATIOS {
        for integrator in report::INTEGRATORS {
            limits.push((integrator, ratio, report::spring_limit(integrator, ratio)?));
        }
    }
    bar.inc(1);
    let rest = report::rest_rows(if quick { 60.0 } else { 3600.0 })?;
    bar.inc(1);
    let hops = DROP_STEPS_MS.iter().flat_map(|step| {
        let (drop_m, restitution) = DROP;
        Form::ALL.map(|form| (form, *step, report::hop(form, drop_m, restitution, step / 1000.0)))
    });
    let growth =
        (0..3).map(|rack| report::growth(rack, GROWTH_S)).collect::<Result<Vec<_>, _>>()?;
    bar.inc(1);
    let racks = if quick { 10 } else { 60 };
    let mut methods = report::COLUMNS.to_vec();
    if !quick {
        methods.push(Method::FixedStep { integrator: Integrator::EulerCromer, step_ms: 0.1 });
    }
    let spread = methods
        .into_iter()
        .map(|method| report::spread(method, racks, LOOK_S).map_err(|error| (method, error)))
        .collect();
    bar.inc(2);
    Ok(Table {
        rows,
        limits,
        rest,
        hertz: report::hertz_rows(HERTZ_M_S),
        hops: hops.collect(),
        solver_hops: solver_hops()?,
        growth,
        spread,
        racks,
    })
}

fn solver_hops() -> Result<Vec<(Integrator, Profile, f64, Hop)>, Error> {
    let (drop_m, restitution) = DROP;
    let mut hops = Vec::new();
    for profile in [Profile::Standard, Profile::Paper2009] {
        for integrator in report::INTEGRATORS {
            for step_ms in DROP_STEPS_MS {
                let method = Method::FixedStep { integrator, step_ms };
                let settings = PhysicsSettings { profile, ..method.settings() };
                let hop = report::solver_hop(&settings, drop_m, restitution)?;
                hops.push((integrator, profile, step_ms, hop));
            }
        }
    }
    Ok(hops)
}
