//! Under which contact laws lessons are given, and what the paper says of them.

use crate::physics::{PhysicsSettings, Profile, SolverKind};

/// Contact laws that a player meets.
#[derive(Debug, Clone, PartialEq)]
pub struct Condition {
    /// Short name, for files.
    pub id: &'static str,
    /// What distinguishes it.
    pub title: &'static str,
    /// How motion is computed.
    pub physics: PhysicsSettings,
    /// What the paper says of it, if it does.
    pub paper: Option<PaperFigures>,
}

/// Figures of section 5.4.3.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PaperFigures {
    /// Where f goes.
    pub factor: &'static str,
    /// E_c, mean size of the accepted errors [°].
    pub error_deg: f64,
    /// Hit rate of aimed shots, mean of 10.
    pub hits: &'static str,
}

/// All of them: the paper's own model as it was repaired, then this program's laws in steps and
/// exact. Back-dating means nothing to the exact solver, which has no steps.
pub fn conditions() -> Vec<Condition> {
    let paper = |factor, error_deg, hits| Some(PaperFigures { factor, error_deg, hits });
    let made = |id, title, (profile, solver), (friction, dated): (bool, bool), paper| {
        let physics = PhysicsSettings {
            solver,
            profile,
            ball_friction: friction,
            contact_back_dating: dated,
            ..PhysicsSettings::default()
        };
        Condition { id, title, physics, paper }
    };
    let old = (Profile::Paper2009, SolverKind::FixedStep);
    let steps = (Profile::Standard, SolverKind::FixedStep);
    let exact = (Profile::Standard, SolverKind::EventDriven);
    vec![
        made(
            "2009_no_friction_no_back_dating",
            "2009, no ball friction, no back-dating",
            old,
            (false, false),
            paper("< 0", 1.4, "-"),
        ),
        made(
            "2009_no_friction",
            "2009, no ball friction",
            old,
            (false, true),
            paper("0", 0.6, "80 %"),
        ),
        made("2009", "2009", old, (true, true), paper("0.45 ± 0.1", 2.1, "60 to 70 %")),
        made("2009_no_back_dating", "2009, no back-dating", old, (true, false), None),
        made("standard_steps", "standard, in steps", steps, (true, true), None),
        made(
            "standard_steps_no_back_dating",
            "standard, in steps, no back-dating",
            steps,
            (true, false),
            None,
        ),
        made(
            "standard_steps_no_friction",
            "standard, in steps, no ball friction",
            steps,
            (false, true),
            None,
        ),
        made(
            "standard_steps_no_friction_no_back_dating",
            "standard, in steps, no ball friction, no back-dating",
            steps,
            (false, false),
            None,
        ),
        made("standard", "standard, exact", exact, (true, true), None),
        made(
            "standard_no_friction",
            "standard, exact, no ball friction",
            exact,
            (false, true),
            None,
        ),
    ]
}
