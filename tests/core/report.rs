//! The report: orders that are reached, who is best at what price, and what breaks.

/// Other programs on the same cases.
mod peers;

use crate::physics::scenes::{break_shot, pool, slow};
use hapticbillard::physics::{Integrator, PhysicsSettings, Profile, SolverKind};
use hapticbillard::report::{
    self, CATALOGUE, COLUMNS, Class, Form, Method, Prepared, Row, STIFFNESSES, Scene, Status,
    Tolerances,
};

const STEPS_MS: [f64; 6] = [4.0, 2.0, 1.0, 0.5, 0.2, 0.1];

fn scene(id: &str) -> Scene {
    CATALOGUE.into_iter().find(|scene| scene.id == id).unwrap()
}

fn row(prepared: &Prepared, method: Method) -> Row {
    let run = |start| prepared.watch(prepared.simulation(method, start).unwrap());
    let runs: Vec<_> = (0..prepared.starts()).map(run).collect();
    report::judge(prepared, method, &runs)
}

fn in_steps(prepared: &Prepared, integrator: Integrator, steps_ms: &[f64]) -> Vec<Row> {
    let method = |step_ms: &f64| Method::FixedStep { integrator, step_ms: *step_ms };
    steps_ms.iter().map(|step| row(prepared, method(step))).collect()
}

/// The order of an integrator in a scene over the steps of this file.
fn order(id: &str, integrator: Integrator) -> f64 {
    let prepared = Prepared::new(scene(id), 9).unwrap();
    let rows = in_steps(&prepared, integrator, &STEPS_MS);
    let name = Method::FixedStep { integrator, step_ms: 1.0 }.name();
    report::fitted_order(&rows, name, 4.0, prepared.reference_error_m).unwrap()
}

#[test]
fn on_a_spring_each_integrator_reaches_its_order_and_the_exact_solver_rounding() {
    for integrator in report::INTEGRATORS {
        let expected = Method::FixedStep { integrator, step_ms: 1.0 }.smooth_order().unwrap();
        let observed = order("spring_soft", integrator);
        assert!((observed - expected).abs() < 0.25, "{integrator:?}: {observed}");
    }
    for id in ["spring_soft", "spring", "spring_stiff"] {
        let exact = row(&Prepared::new(scene(id), 3).unwrap(), Method::EventDriven);
        assert!(exact.error_m.unwrap() < 1e-12, "{exact:?}");
    }
}

#[test]
fn with_events_euler_cromer_is_of_first_order() {
    for id in ["sliding", "draw", "masse", "jump", "bounce", "rail_first"] {
        let observed = order(id, Integrator::EulerCromer);
        assert!((0.8..1.2).contains(&observed), "{id}: {observed}");
    }
}

#[test]
fn where_balls_meet_each_other_no_integrator_is_better_than_first_order() {
    for integrator in report::INTEGRATORS {
        for id in ["cut", "cut_cushion"] {
            let observed = order(id, integrator);
            assert!((0.6..1.5).contains(&observed), "{id} {integrator:?}: {observed}");
        }
    }
}

#[test]
fn sliding_to_rolling_is_second_order_but_for_those_that_learn_of_a_force_late() {
    for (integrator, expected) in [
        (Integrator::EulerCromer, 1.0),
        (Integrator::PositionVerlet, 1.0),
        (Integrator::Verlet, 2.0),
        (Integrator::Rk4, 2.0),
    ] {
        let observed = order("sliding", integrator);
        assert!((observed - expected).abs() < 0.3, "{integrator:?}: {observed}");
    }
}

#[test]
fn sub_steps_take_most_of_the_error_of_verlet_and_none_of_euler_cromers() {
    let prepared = Prepared::new(scene("cut"), 9).unwrap();
    let left = |integrator| {
        let step_ms = 4.0;
        let whole = row(&prepared, Method::FixedStep { integrator, step_ms });
        let parts = row(&prepared, Method::SubSteps { integrator, step_ms });
        parts.error_m.unwrap() / whole.error_m.unwrap()
    };
    let verlet = left(Integrator::Verlet);
    assert!(verlet < 0.3, "{verlet}");
    // Its error lies in the sliding, not in the contact.
    let euler_cromer = left(Integrator::EulerCromer);
    assert!(euler_cromer > 0.5, "{euler_cromer}");
}

#[test]
fn finer_tolerances_come_nearer_where_something_hops() {
    let prepared = Prepared::new(scene("cut"), 3).unwrap();
    let off = |method| row(&prepared, method).error_m.unwrap();
    let fine = off(Method::Tolerances(Tolerances::Fine));
    assert!(fine <= off(Method::EventDriven), "{fine}");
    assert!(off(Method::EventDriven) <= 1e-5);
}

#[test]
fn patience_that_ends_stops_a_run_and_a_cell_and_says_where() {
    let prepared = Prepared::new(scene("cut"), 1).unwrap();
    let mut looks = 0;
    let mut twice = || {
        looks += 1;
        looks <= 2
    };
    let world = prepared.simulation(Method::EventDriven, 0).unwrap();
    let failure = prepared.watch_while(world, &mut twice).unwrap_err();
    assert!(failure.stopped && failure.at_s > 0.0 && failure.at_s < prepared.until_s);
    let row = report::judge(&prepared, Method::EventDriven, &[Err(failure)]);
    assert!(row.status.is_too_slow(), "{row:?}");
    let cell = report::CASES[0].cell(Method::EventDriven, &mut || false);
    assert!(cell.class == Class::TooSlow && !cell.note.is_empty(), "{cell:?}");
}

#[test]
fn a_haptic_wall_swings_up_where_the_eigenvalues_say_and_never_where_it_is_passive() {
    let mut known = 0;
    for point in report::loop_points() {
        let row = report::closed_loop(point);
        let (measured, theory) = (row.measured_n_m.unwrap(), row.theory_n_m.unwrap());
        assert!((measured / theory - 1.0).abs() < 0.02, "{row:?}");
        assert!(row.passive_n_m.is_none_or(|passive| theory > 0.999 * passive), "{row:?}");
        // Exact limits of the same loops that were computed elsewhere, to all digits given.
        for (hand, period_s, delay, exact) in [
            ("none", 0.001, 0, 200.1),
            ("none", 0.001, 1, 66.7),
            ("none", 0.001, 2, 40.0),
            ("none", 0.004, 0, 50.1),
            ("L", 0.001, 0, 2204.0),
            ("L", 0.001, 1, 736.0),
            ("L", 0.001, 2, 442.0),
            ("L", 0.004, 0, 555.0),
            ("G", 0.001, 0, 3325.0),
            ("G", 0.001, 1, 1163.0),
            ("G", 0.001, 2, 727.0),
            ("G", 0.004, 0, 912.0),
        ] {
            let found = (row.point.hand, row.point.period_s, row.point.delay);
            if found == (hand, period_s, delay) {
                assert!((theory / exact - 1.0).abs() < 0.002, "{exact}: {row:?}");
                known += 1;
            }
        }
    }
    assert_eq!(known, 12);
}

#[test]
fn the_solvers_position_verlet_hops_under_the_laws_of_2009_alone() {
    for integrator in report::INTEGRATORS {
        for profile in [Profile::Standard, Profile::Paper2009] {
            let method = Method::FixedStep { integrator, step_ms: 1.0 };
            let settings = PhysicsSettings { profile, ..method.settings() };
            let hop = report::solver_hop(&settings, 0.1, 0.5).unwrap();
            let share = hop.first_m / hop.truth_m;
            let paper = (integrator, profile) == (Integrator::PositionVerlet, Profile::Paper2009);
            assert_eq!(share > 1.5, paper, "{integrator:?} {profile:?}: {hop:?}");
            assert!(paper || (0.95..1.05).contains(&share), "{integrator:?}: {hop:?}");
        }
    }
}

#[test]
fn where_a_closed_form_exists_event_driven_meets_it_to_a_nanometre() {
    for scene in CATALOGUE {
        let prepared = Prepared::new(scene, 3).unwrap();
        if prepared.closed_form() {
            let exact = row(&prepared, Method::EventDriven);
            assert!(exact.error_m.unwrap() < 1e-9, "{exact:?}");
        }
        if scene.id == "break" {
            break;
        }
    }
}

#[test]
fn event_driven_is_on_the_front_of_error_and_work_in_every_scene() {
    for scene in CATALOGUE {
        if scene.id == "thousand" && !slow() {
            continue;
        }
        let prepared = Prepared::new(scene, 1).unwrap();
        let mut rows = vec![row(&prepared, Method::EventDriven)];
        for integrator in report::INTEGRATORS {
            rows.extend(in_steps(&prepared, integrator, &[16.0, 4.0, 1.0, 0.2]));
        }
        assert!(report::on_the_front(&rows[0], &rows), "{}: {:?}", scene.id, rows[0]);
        // And the front is no empty claim: fixed steps that are worse and dearer are not on it.
        assert!(rows.iter().any(|row| !report::on_the_front(row, &rows)), "{}", scene.id);
    }
}

#[test]
fn a_run_that_flies_apart_stays_in_the_table_and_says_when_and_how() {
    let prepared = Prepared::new(scene("spring_stiff"), 1).unwrap();
    let rows = in_steps(&prepared, Integrator::Rk4, &[16.0, 0.1]);
    let Status::Failed(failure) = &rows[0].status else { panic!("{:?}", rows[0]) };
    assert!(failure.at_s > 0.0 && !failure.how.is_empty(), "{failure:?}");
    assert_eq!(rows[1].status, Status::Ok);
}

#[test]
fn springs_become_unstable_where_theory_says() {
    for ratio in report::RATIOS {
        for integrator in report::INTEGRATORS {
            let limit = report::spring_limit(integrator, ratio).unwrap();
            assert!((limit.measured - limit.theory).abs() < 1e-3, "{integrator:?} {limit:?}");
        }
    }
    for stiffness in STIFFNESSES {
        for method in &COLUMNS[1..] {
            let cell = report::spring_cell(stiffness, 0.0, *method);
            let unstable = cell.class == Class::Diverges;
            assert_eq!(unstable, cell.note.contains("limit"), "{stiffness} {method:?} {cell:?}");
        }
    }
}

#[test]
fn however_stiff_a_spring_the_exact_solver_follows_it_to_rounding() {
    for ratio in report::RATIOS {
        for stiffness in STIFFNESSES {
            let cell = report::spring_cell(stiffness, ratio, Method::EventDriven);
            assert_eq!(cell.class, Class::Exact, "{stiffness} {ratio} {cell:?}");
        }
    }
}

#[test]
fn every_cell_of_the_extremes_is_measured_and_the_exact_solver_diverges_in_none() {
    for case in report::CASES {
        // Steps of 4 ms take most of a minute to find out that they are stuck.
        let many_contacts = case.id.starts_with("galperin_1e");
        let methods = if many_contacts && !slow() { &COLUMNS[..1] } else { &COLUMNS[..] };
        for method in methods.iter().copied() {
            let cell = case.cell(method, &mut || true);
            assert!(!cell.error.is_nan(), "{} {method:?}", case.id);
            let fails = matches!(cell.class, Class::Diverges | Class::GivesUp);
            let may = many_contacts && method != Method::EventDriven;
            assert!(may || !fails, "{} {method:?}: {cell:?}", case.id);
        }
    }
}

#[test]
fn a_lying_ball_trembles_as_in_2009_under_that_profile_alone() {
    let rows = report::rest_rows(20.0).unwrap();
    assert!(rows[..2].iter().all(|row| row.hop_m == 0.0 && row.seen_hz == 0.0), "{rows:?}");
    // The paper: below 0.1 mm, seen at 2 to 10 Hz.
    for row in &rows[2..4] {
        assert!((1e-6..1e-4).contains(&row.hop_m) && (2.0..10.0).contains(&row.seen_hz), "{row:?}");
    }
}

#[test]
fn verlet_by_places_hops_after_a_push_and_verlet_by_velocity_does_not() {
    for step_s in [4e-3, 1e-3] {
        for form in Form::ALL {
            let hop = report::hop(form, 0.1, 0.5, step_s);
            let share = hop.first_m / hop.truth_m;
            let hops = form == Form::PositionVerlet;
            assert_eq!(share > 1.5, hops, "{form:?}: {hop:?}");
            assert!(hops || (0.9..1.1).contains(&share), "{form:?}: {hop:?}");
        }
    }
}

#[test]
fn a_hertz_contact_needs_steps_far_below_its_time_and_gets_them_at_its_price() {
    let (contact_s, rows) = report::hertz_rows(5.0);
    assert!((2e-4..4e-4).contains(&contact_s), "{contact_s}");
    for row in rows {
        assert!(row.share > 0.01 || row.error.abs() < 1e-2, "{row:?}");
        assert!(row.share < 1.0 || row.error.abs() > 0.1, "{row:?}");
    }
}

#[test]
fn what_has_nothing_to_do_changes_no_bit_of_a_break() {
    let balls = break_shot(2e-5);
    let exact = PhysicsSettings { solver: SolverKind::EventDriven, ..PhysicsSettings::default() };
    let stepping = PhysicsSettings { solver: SolverKind::FixedStep, ..exact.clone() };
    for settings in [exact, stepping] {
        let idle = report::idle(pool(), &balls, &settings, 1.0).unwrap();
        assert_eq!((idle.compared, idle.differ), (16 * 9 * 40, 0), "{settings:?}");
    }
}

#[test]
fn a_row_is_the_same_twice() {
    let make = || {
        let prepared = Prepared::new(scene("break"), 1).unwrap();
        let rows = in_steps(&prepared, Integrator::Verlet, &[4.0]);
        (rows, row(&prepared, Method::EventDriven), prepared.until_s)
    };
    assert_eq!(make(), make());
}

#[test]
fn the_felt_wall_is_wrong_in_the_first_order_of_the_period() {
    let walls: Vec<_> = [500.0, 1000.0, 4000.0].map(report::felt_wall).into();
    for wall in &walls {
        assert!(wall.force_error > 0.5 * wall.theory, "{wall:?}");
        assert!(wall.force_error < 1.5 * wall.theory, "{wall:?}");
        // A held force gives energy.
        assert!(wall.speed_ratio.is_some_and(|ratio| ratio > 1.0), "{wall:?}");
    }
    let order = (walls[1].force_error / walls[2].force_error).log2() / 2.0;
    assert!((order - 1.0).abs() < 0.1, "{order}");
}
