//! The shipped catalogue of the closed loop.

use hapticbillard::physics::SolverKind;
use hapticbillard::shipped;
use hapticbillard::validation::{Catalogue, Status, run};

#[test]
fn every_shipped_haptic_case_passes() {
    let catalogue = Catalogue::parse(shipped::HAPTIC_CASES).unwrap();
    assert_eq!(catalogue.cases.len(), 15);
    for case in &catalogue.cases {
        let outcome = run(case, SolverKind::EventDriven).unwrap();
        assert_eq!(outcome.status, Status::Pass, "{outcome:?}");
    }
}
