use crate::bytes::{check_line, text};
use hapticbillard::rules::{ScenarioStatus, read_scenarios, run_scenario};

pub fn run(data: &[u8]) {
    let scenarios = match read_scenarios(&text(data)) {
        Ok(scenarios) => scenarios,
        Err(error) => return check_line(&error.to_string()),
    };
    for scenario in &scenarios {
        let result = run_scenario(scenario);
        let is_fine = result.status == ScenarioStatus::Pass;
        assert_eq!(result.differences.is_empty(), is_fine, "{result:?}");
        for difference in &result.differences {
            check_line(&difference.problem);
        }
    }
}
