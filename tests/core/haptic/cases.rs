//! The shipped catalogue of the closed loop.

use hapticbillard::physics::SolverKind;
use hapticbillard::shipped;
use hapticbillard::validation::{Catalogue, Status, run};
use serde_json::{Value, json};

#[test]
fn every_shipped_haptic_case_passes() {
    let catalogue = Catalogue::parse(shipped::HAPTIC_CASES).unwrap();
    assert_eq!(catalogue.cases.len(), 15);
    for case in &catalogue.cases {
        let outcome = run(case, SolverKind::EventDriven).unwrap();
        assert_eq!(outcome.status, Status::Pass, "{outcome:?}");
    }
}

/// A shipped case with one key of its setup changed, in every run.
fn changed(id: &str, key: &str, value: Value) -> Result<Status, String> {
    let mut catalogue: Value = serde_json::from_str(shipped::HAPTIC_CASES).unwrap();
    let cases = catalogue["cases"].as_array().unwrap();
    let mut case = cases.iter().find(|case| case["id"] == id).unwrap().clone();
    for run in case["setup"]["runs"].as_array_mut().unwrap() {
        run[key] = value.clone();
    }
    catalogue["cases"] = json!([case]);
    let wrong = |error: hapticbillard::validation::CatalogueError| error.to_string();
    let catalogue = Catalogue::parse(&catalogue.to_string()).map_err(wrong)?;
    run(&catalogue.cases[0], SolverKind::EventDriven).map(|outcome| outcome.status).map_err(wrong)
}

#[test]
fn the_cases_can_fail() {
    for (id, key, value) in [
        ("H1", "b_Ns_m", json!(0.9)),
        ("H4", "B_Ns_m", json!(1.2)),
        ("H5", "delay_samples", json!(1)),
        ("H7", "K_N_m", json!(700.0)),
        ("H8", "T_s", json!(0.004)),
        ("H9", "coulomb_N", json!(2.0)),
        ("H10", "alpha_max_Ns_m", json!(0.01)),
        ("H11", "speed_m_s", json!(0.25)),
        ("H12", "force_limit_N", json!(9.0)),
        ("H13", "T_s", json!(0.0005)),
        ("H14", "m_kg", json!(0.05)),
        ("H15", "coulomb_N", json!(0.001)),
    ] {
        assert_eq!(changed(id, key, value), Ok(Status::Fail), "{id}: {key}");
    }
}

#[test]
fn no_file_asks_for_a_year_of_work_or_breaks_the_bench() {
    let refused = |id, key, value| changed(id, key, value).is_err();
    assert!(refused("H7", "phases", json!(1_000_000_000_u64)));
    assert!(refused("H7", "m_kg", json!(0.0)));
    assert!(refused("H8", "duration_s", json!(1e9)));
    assert!(refused("H8", "push", json!({ "from_m": 0.0, "to_m": 1.0, "ramp_s": 0.0 })));
    assert!(refused("H8", "hand", json!({ "type": "rigid", "m_kg": 0, "b_Ns_m": 1, "k_N_m": 1 })));
    assert!(refused("H8", "hand", json!({ "type": "claw" })));
    assert_eq!(changed("H1", "T_s", json!(1e-9)), Ok(Status::Unsupported));
    assert_eq!(changed("H3", "delay_samples", json!(1000)), Ok(Status::Unsupported));
    for (id, key, value) in [
        ("H1", "m_kg", json!(1e-300)),
        ("H7", "K_N_m", json!(1e11)),
        ("H8", "K_N_m", json!(1e11)),
        ("H8", "m_kg", json!(1e-200)),
    ] {
        assert!(changed(id, key, value.clone()).is_ok(), "{id}: {key} = {value}");
    }
}
