use super::{Status, no_runtime};
use clap::Args;
use hapticbillard_actors::error::Error;
use std::io::Write;

/// The rule console.
#[derive(Debug, Clone, Args)]
pub struct RulesArgs {}

/// Judges.
pub fn run(_args: &RulesArgs, _out: &mut dyn Write) -> Result<Status, Error> {
    Err(no_runtime("rules"))
}
