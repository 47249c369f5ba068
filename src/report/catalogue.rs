//! The scenes that every method is measured on.

use super::starts;
use crate::physics::Parameters;
use crate::physics::sample_shots::Start;
use crate::table::Table;
use crate::units::Seconds;
use glam::DVec3;

/// Where the balls are at a time, in the order of the start.
pub(super) type Answer = fn(&Start, &Parameters, Seconds) -> Vec<DVec3>;

/// A scene.
#[derive(Debug, Clone, Copy)]
pub struct Scene {
    /// Its name in tables and files.
    pub id: &'static str,
    /// What it shows, in a few words.
    pub title: &'static str,
    /// How long it is compared.
    pub until: Until,
    /// How an error becomes one number.
    pub norm: Norm,
    /// Whether the forces are smooth and nothing happens, so that integrators reach their orders.
    pub smooth: bool,
    /// How many starts.
    pub starts: usize,
    /// Smallest step that is affordable, in a minute and else [ms].
    pub least_step_ms: [f64; 2],
    pub(super) table: fn() -> Table,
    pub(super) start: fn(usize) -> Start,
    pub(super) parameters: fn(&mut Parameters),
    pub(super) answer: Option<Answer>,
}

/// How long a scene is compared. Whole multiples of 0.512 s, so that each of the 32 looks lies on
/// the grid of every step: between its grid times a stepper only draws a straight line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Until {
    /// So long [s].
    Time(Seconds),
    /// As long as the future can be told in double precision, but not longer than this [s].
    Horizon(Seconds),
}

/// How an error becomes one number [m]. It is taken at 32 times and the largest counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Norm {
    /// The ball that is off most.
    Worst,
    /// Root of the mean square over the balls.
    MeanSquare,
}

impl Norm {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Norm::Worst => "worst ball at the worst of 32 times",
            Norm::MeanSquare => "root mean square of the balls at the worst of 32 times",
        }
    }
}

const ONE_BALL: Scene = Scene {
    id: "sliding",
    title: "One ball slides, rolls and stops",
    until: Until::Time(9.216),
    norm: Norm::Worst,
    smooth: false,
    starts: 5,
    least_step_ms: [0.05, 0.01],
    table: starts::cloth,
    start: starts::sliding,
    parameters: starts::standard,
    answer: Some(starts::cloth_answer),
};

const TWO_BALLS: Scene = Scene {
    id: "cut",
    title: "Cut shot",
    until: Until::Time(2.048),
    starts: 9,
    table: starts::noses,
    start: starts::cut,
    answer: None,
    ..ONE_BALL
};

const SPRING: Scene = Scene {
    id: "spring_soft",
    title: "Ball on a soft spring, 30 N/m",
    until: Until::Time(1.024),
    smooth: true,
    starts: 3,
    table: starts::nothing,
    start: starts::soft_spring,
    answer: Some(starts::spring_answer),
    ..ONE_BALL
};

/// All scenes, the simple ones first.
pub const CATALOGUE: [Scene; 15] = [
    ONE_BALL,
    Scene {
        id: "draw",
        title: "Draw: backspin brings the ball back",
        until: Until::Time(3.072),
        start: starts::draw,
        ..ONE_BALL
    },
    Scene {
        id: "masse",
        title: "Masse: the ball runs a curve",
        until: Until::Time(3.072),
        start: starts::masse,
        ..ONE_BALL
    },
    TWO_BALLS,
    Scene {
        id: "cut_cushion",
        title: "Cut shot, then cushions",
        start: starts::cut_and_cushion,
        ..TWO_BALLS
    },
    Scene {
        id: "rail_first",
        title: "Cushion first, then the ball",
        until: Until::Time(1.536),
        start: starts::rail_first,
        ..TWO_BALLS
    },
    Scene {
        id: "jump",
        title: "Jump and landing",
        until: Until::Time(1.024),
        start: starts::jump,
        answer: None,
        ..ONE_BALL
    },
    Scene {
        id: "bounce",
        title: "Dropped, bounces to rest",
        until: Until::Time(1.024),
        start: starts::dropped,
        parameters: starts::without_friction,
        answer: Some(starts::dropped_answer),
        ..ONE_BALL
    },
    Scene {
        id: "pocket",
        title: "A rolling ball drops into a pocket of the mesh",
        until: Until::Time(0.512),
        starts: 3,
        least_step_ms: [0.2, 0.01],
        table: starts::pool,
        start: starts::pocket_drop,
        answer: None,
        ..ONE_BALL
    },
    SPRING,
    Scene { id: "spring", title: "Ball on a spring, 3000 N/m", start: starts::spring, ..SPRING },
    Scene {
        id: "spring_stiff",
        title: "Ball on a stiff spring, 300 000 N/m",
        until: Until::Time(0.512),
        start: starts::stiff_spring,
        ..SPRING
    },
    Scene {
        id: "cradle",
        title: "Five balls in line hand a blow on",
        until: Until::Time(0.512),
        table: starts::nothing,
        start: starts::cradle,
        parameters: starts::ideal,
        answer: Some(starts::cradle_answer),
        ..ONE_BALL
    },
    Scene {
        id: "break",
        title: "Break, up to its predictable horizon",
        until: Until::Horizon(2.048),
        starts: 3,
        least_step_ms: [0.2, 0.01],
        table: starts::noses,
        start: starts::racked,
        answer: None,
        ..ONE_BALL
    },
    Scene {
        id: "thousand",
        title: "A thousand balls in a square, up to their predictable horizon",
        until: Until::Horizon(0.512),
        norm: Norm::MeanSquare,
        starts: 1,
        least_step_ms: [1.0, 0.1],
        table: starts::square,
        start: starts::thousand,
        answer: None,
        ..ONE_BALL
    },
];
