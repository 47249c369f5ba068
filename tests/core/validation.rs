//! The shipped catalogue, other catalogues, and wrong ones.

use hapticbillard::physics::SolverKind;
use hapticbillard::shipped;
use hapticbillard::validation::{Case, Catalogue, Outcome, Status, run};
use serde_json::{Value, json};

fn parse(cases: &Value) -> Result<Catalogue, String> {
    let text = json!({ "schema": "validation-cases/2", "cases": cases }).to_string();
    Catalogue::parse(&text).map_err(|error| error.to_string())
}

fn judged(case: &Case) -> Outcome {
    run(case, SolverKind::FixedStep).unwrap()
}

/// Runs one case, and says how it ended.
#[track_caller]
fn ends(case: Value, expected: Status) -> Outcome {
    let catalogue = parse(&json!([case])).unwrap();
    let outcome = judged(&catalogue.cases[0]);
    assert_eq!(outcome.status, expected, "{outcome:?}");
    outcome
}

#[track_caller]
fn refused(cases: Value, expected: &str) {
    let error = parse(&cases).map(|_| ()).unwrap_err();
    assert_eq!(error, expected);
}

fn ball(id: i32, position: [f64; 3], velocity: [f64; 3]) -> Value {
    json!({ "id": id, "m": 0.17, "R": 0.03, "position_m": position, "velocity_m_s": velocity,
        "angular_velocity_rad_s": [0, 0, 0] })
}

/// A stun shot at 30°, written once with the cue ball first and once with it last.
fn cut(first: bool, restitution: f64) -> Value {
    let (c, s) = (0.06 * 0.75_f64.sqrt(), 0.03);
    let cue = ball(7, [0.0, 0.0, 0.03], [2.0, 0.0, 0.0]);
    let object = ball(3, [c, s, 0.03], [0.0, 0.0, 0.0]);
    let balls = if first { json!([cue, object]) } else { json!([object, cue]) };
    // Along the line of centres 2 cos 30°; the rest stays with the cue ball.
    let along = 3.0_f64.sqrt() * 0.5 * (1.0 + restitution);
    let hit = [along * 0.75_f64.sqrt(), along * 0.5, 0.0];
    let left = [2.0 - hit[0], -hit[1], 0.0];
    let velocities = if first { json!([left, hit]) } else { json!([hit, left]) };
    json!({ "id": "X", "kind_of_run": "ball_ball_impact",
        "setup": { "balls": balls, "e_ball": restitution, "mu_ball": 0 },
        "expect": { "velocity_m_s": velocities }, "tolerance": { "rel": 1e-12 } })
}

#[test]
fn the_exact_solver_passes_every_shipped_case() {
    let catalogue = Catalogue::parse(shipped::CASES).unwrap();
    let mut passed = 0;
    for case in &catalogue.cases {
        let outcome = run(case, SolverKind::EventDriven).unwrap();
        // The constants of the haptic renderer have no runner.
        let expected = if case.id == "P07" { Status::Unsupported } else { Status::Pass };
        assert_eq!(outcome.status, expected, "{outcome:?}");
        passed += usize::from(outcome.status == Status::Pass);
    }
    assert_eq!(passed, 74);
}

#[test]
fn every_shipped_case_of_a_pure_law_passes() {
    let catalogue = Catalogue::parse(shipped::CASES).unwrap();
    assert_eq!(catalogue.cases.len(), 75);
    // These move balls with the solver and are judged by what a stepper may be off.
    let solved = ["A", "C05", "C06", "C07", "D06", "E01", "E03", "B11", "B12", "P09"];
    let mut passed = 0;
    for case in &catalogue.cases {
        let moves = solved.iter().any(|id| case.id.starts_with(id)) && case.id != "A11";
        // The haptic constants have no runner; P01 plays a whole break.
        if moves || case.id.starts_with('G') || ["P01", "P07"].contains(&&*case.id) {
            continue;
        }
        let outcome = judged(case);
        assert_eq!(outcome.status, Status::Pass, "{outcome:?}");
        passed += 1;
    }
    assert_eq!(passed, 41);
}

#[test]
fn results_follow_the_order_of_the_balls_in_the_file() {
    for restitution in [0.0, 0.61, 1.0] {
        ends(cut(true, restitution), Status::Pass);
        ends(cut(false, restitution), Status::Pass);
    }
}

#[test]
fn a_wrong_answer_fails_and_says_by_how_much() {
    let mut case = cut(true, 1.0);
    case["expect"]["velocity_m_s"][1][0] = json!(1.6);
    let outcome = ends(case, Status::Fail);
    assert_eq!(outcome.key.as_deref(), Some("velocity_m_s"));
    assert!((outcome.error.unwrap() - 0.1).abs() < 1e-12, "{outcome:?}");
    // On the scale of the vector's largest component.
    assert!((outcome.limit.unwrap() - 1.6e-12).abs() < 1e-24, "{outcome:?}");
}

#[test]
fn each_run_overlays_the_setup_and_null_is_not_asked() {
    let mut case = cut(true, 1.0);
    case["setup"]["runs"] = json!([{}, { "e_ball": 0.0 }, { "e_ball": 0.5, "law": "clamp_2009" }]);
    case["expect"] =
        json!({ "restitution": [1, 0, null], "separation_angle_deg": [90, null, null] });
    case["tolerance"] = json!({ "abs": 1e-12 });
    ends(case.clone(), Status::Pass);
    case["expect"]["restitution"] = json!([1, 0.5, null]);
    ends(case, Status::Fail);
}

#[test]
fn bands_bounds_and_entries_of_their_own_judge_a_key() {
    let mut case = cut(true, 0.5);
    case["expect"] = json!({ "measured_restitution": [0.4, 0.6], "max_energy_rel_error": 0,
        "model_restitution": 0.52 });
    case["tolerance"] = json!({ "rel": 1e-12, "measured_restitution": { "interval": true },
        "max_energy_rel_error": { "abs": 1e-12 }, "model_restitution": { "abs": 0.03 } });
    ends(case.clone(), Status::Pass);
    case["expect"]["measured_restitution"] = json!([0.51, 0.6]);
    ends(case, Status::Fail);
}

#[test]
fn a_stepper_is_asked_only_for_what_has_a_limit_of_its_own() {
    let shot = |tolerance: Value| {
        json!({ "id": "X", "kind_of_run": "single_ball_on_plane",
            "setup": { "balls": [ball(0, [0.0, 0.0, 0.03], [0.7, 0.0, 0.0])],
                "gravity_m_s2": [0, 0, -10], "mu_slide": 0.25 },
            "expect": { "roll_velocity_m_s": [0.5, 0, 0] }, "tolerance": tolerance })
    };
    let outcome = ends(shot(json!({ "rel": 1e-9 })), Status::Unsupported);
    assert!(outcome.reason.unwrap().contains("solver with steps"));
    ends(shot(json!({ "rel": 1e-9, "realtime_rel": 1e-6 })), Status::Pass);
    ends(shot(json!({ "rel": 1e-9, "realtime": { "roll_velocity_m_s": 1e-6 } })), Status::Pass);
}

#[test]
fn laws_of_a_run_change_what_comes_out() {
    let rolling = |law: &str| {
        let mut case = cut(true, 0.9);
        case["law"] = json!(law);
        case["setup"]["mu_ball"] = json!(0.06);
        case["setup"]["balls"][0]["angular_velocity_rad_s"] = json!([0, 66.7, 0]);
        case["expect"] = json!({ "throw_deg": 0 });
        ends(case, Status::Fail).error.unwrap()
    };
    let [constant, falls, clamp] =
        ["constant_friction", "speed_dependent_friction", "clamp_2009"].map(rolling);
    assert!(falls < constant && constant < clamp * 1.001, "{falls} {constant} {clamp}");
}

#[test]
fn springs_of_any_damping_follow_their_closed_forms() {
    for (damping, end) in [(0.0, 0.7), (3.0, 0.2), (20.0, 0.1)] {
        let (m, k) = (0.3, 250.0_f64);
        let (x, v) = stepped(m, k, damping, 0.01, 0.2, end);
        let case = json!({ "id": "X", "kind_of_run": "spring",
            "setup": { "mass_kg": m, "k_N_m": k, "c_Ns_m": damping, "anchor_m": 0.5,
                "x0_m": 0.51, "v0_m_s": 0.2, "end_time_s": end },
            "expect": { "x_m": x + 0.5, "v_m_s": v }, "tolerance": { "abs": 1e-8 } });
        ends(case, Status::Pass);
    }
}

/// A damped spring by small steps of the classical Runge-Kutta method.
fn stepped(m: f64, k: f64, c: f64, x: f64, v: f64, end: f64) -> (f64, f64) {
    let (steps, mut x, mut v) = (20_000, x, v);
    let h = end / f64::from(steps);
    let pull = |x: f64, v: f64| -(k * x + c * v) / m;
    for _ in 0..steps {
        let (k1, l1) = (v, pull(x, v));
        let (k2, l2) = (v + 0.5 * h * l1, pull(x + 0.5 * h * k1, v + 0.5 * h * l1));
        let (k3, l3) = (v + 0.5 * h * l2, pull(x + 0.5 * h * k2, v + 0.5 * h * l2));
        let (k4, l4) = (v + h * l3, pull(x + h * k3, v + h * l3));
        x += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
        v += h / 6.0 * (l1 + 2.0 * l2 + 2.0 * l3 + l4);
    }
    (x, v)
}

#[test]
fn a_sampled_wall_is_stable_up_to_its_limit_with_and_without_delay() {
    // A free mass without damping is never stable; with delay the limit falls.
    let limit = |delay: u32| {
        let case = json!({ "id": "X", "kind_of_run": "sampled_wall",
            "setup": { "mass_kg": 0.045, "b_Ns_m": 0.5, "T_s": 0.001, "delay_samples": delay },
            "expect": { "K_limit_N_m": 0 }, "tolerance": {} });
        ends(case, Status::Fail).error.unwrap()
    };
    // From the eigenvalues of the loop, computed independently.
    for (delay, expected) in [(0, 1_001.855_283_75), (1, 334.358_715), (2, 200.957_278)] {
        assert!((limit(delay) - expected).abs() < 1e-4, "{delay}: {}", limit(delay));
    }
}

#[test]
fn what_this_build_does_not_know_is_unsupported_or_an_error_with_its_place() {
    let case = json!({ "id": "X", "kind_of_run": "telekinesis", "setup": { "spoon": 1 },
        "expect": { "bent": true } });
    let outcome = ends(case, Status::Unsupported);
    assert!(outcome.reason.unwrap().contains("telekinesis"));

    let with = |change: fn(&mut Value)| {
        let mut case = cut(true, 1.0);
        change(&mut case);
        json!([case])
    };
    refused(
        with(|case| case["colour"] = json!("red")),
        "case X, key colour: is no key of a case; a case has the keys id, group, title, kind, \
         kind_of_run, law, setup, expect, tolerance, reference, formula, source, verified, note",
    );
    refused(
        with(|case| case["setup"]["e_bal"] = json!(1)),
        "case X, key e_bal: ball_ball_impact has no such key; it has balls, e_ball, mu_ball, \
         mu_curve, gravity_m_s2",
    );
    refused(
        with(|case| case["setup"]["balls"][0]["mass"] = json!(1)),
        "case X, key balls: unknown field `mass`, expected one of `id`, `m`, `R`, `position_m`, \
         `velocity_m_s`, `angular_velocity_rad_s`, `inertia_factor`; see another case with this \
         key",
    );
    refused(
        with(|case| case["setup"]["balls"][1]["id"] = json!(7)),
        "case X, key balls: two balls have the id 7; give each its own",
    );
    refused(
        with(|case| case["setup"]["e_ball"] = json!("high")),
        "case X, key e_ball: invalid type: string \"high\", expected f64; see another case with \
         this key",
    );
    refused(
        with(|case| case["expect"]["speed"] = json!(1)),
        "case X, key speed: ball_ball_impact cannot tell it; it can tell velocity_m_s, \
         angular_velocity_rad_s, stick, energy_lost_J, normal_impulse_Ns, tangential_impulse_Ns, \
         speed_m_s, separation_angle_deg, direction_1_deg, direction_1_from_line_deg, throw_deg, \
         throw_over_cut, learner_f, momentum_kg_m_s, centre_of_mass_velocity_m_s, restitution, \
         max_momentum_rel_error, max_energy_rel_error",
    );
    refused(
        with(|case| case["tolerance"]["speed"] = json!({ "abs": 1 })),
        "case X, key speed: is not expected; name a key of expect, rel, abs, realtime_rel or \
         realtime",
    );
    refused(
        with(|case| case["setup"]["runs"] = json!([{}, {}, {}])),
        "case X, key velocity_m_s: has not the shape of one value a run; write a list of 3 \
         values, null where nothing is stated",
    );
    refused(
        json!([cut(true, 1.0), cut(true, 1.0)]),
        "case X, key id: another case has this id; give each its own",
    );
    let error = Catalogue::parse("{\"cases\": [").unwrap_err().to_string();
    assert!(error.starts_with("no JSON: EOF") && !error.contains('\n'), "{error}");
}
