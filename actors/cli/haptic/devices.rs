//! `hapticbillard haptic devices`: what a scene can ask for, and what is built in.

use crate::cli::{Status, json_line};
use clap::Args;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::haptic::list;
use serde_json::json;
use std::io::Write;

const EXAMPLE: &str = "\
A scene names its device in [haptic], such as device = \"mouse\". Where several devices hang on
OpenHaptics, device = \"openhaptics:NAME\" names the one that the vendor's program calls NAME. The
OpenHaptics library is looked for where the system looks for libraries; the environment variable
HAPTICBILLARD_LIBHD names another file. No device is pushed by this command.

A Haply Inverse3 is looked for at its service on this machine, which the Haply Hub starts; device =
\"haply:HOST:PORT\" names another one. A recording is made by `haptic check --record FILE`, `haptic
simulate --stroke 1 --record FILE` or `play --record-device FILE`, and lies in the scene's folder or
below.

Examples:
  hapticbillard haptic devices
  hapticbillard haptic devices --json
  HAPTICBILLARD_LIBHD=/opt/OpenHaptics/lib/libHD.so hapticbillard haptic devices";

/// Lists the haptic devices that a scene can name.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct DevicesArgs {
    /// Prints JSON lines.
    #[arg(long)]
    pub json: bool,
}

/// Lists them.
pub fn run(args: &DevicesArgs, out: &mut dyn Write) -> Result<Status, Error> {
    let devices = list();
    for device in &devices {
        if args.json {
            let spec = device.spec.map(|spec| {
                json!({
                    "model": spec.model,
                    "workspace_m": spec.workspace_m.to_array(),
                    "force_max_n": spec.force_max_n,
                    "force_continuous_n": spec.force_continuous_n,
                    "stiffness_max_n_m": spec.stiffness_max_n_m,
                    "rate_hz": spec.rate_hz,
                    "latency_s": spec.latency_s,
                })
            });
            let line = json!({
                "name": device.name,
                "about": device.about,
                "built_in": true,
                "spec": spec,
                "says": device.says,
            });
            json_line(out, &line)?;
        } else {
            let how = match device.spec {
                Some(spec) => format!(
                    "{}{}: {} N, {} N for long, {} N/m, {} Hz",
                    if device.says.is_some() { "" } else { "like a " },
                    spec.model,
                    spec.force_max_n,
                    spec.force_continuous_n,
                    spec.stiffness_max_n_m,
                    spec.rate_hz
                ),
                None if device.name.starts_with("recorded") => "like the recorded one".to_string(),
                None => "not there".to_string(),
            };
            writeln!(out, "{:<14} {}; {how}", device.name, device.about)?;
            if let Some(says) = &device.says {
                writeln!(out, "{:<14} {says}", "")?;
            }
        }
    }
    if args.json {
        let there = devices.iter().filter(|device| device.spec.is_some()).count();
        let count = devices.len();
        let summary = json!({ "devices": count, "built_in": count, "there": there });
        json_line(out, &json!({ "summary": summary }))?;
    }
    Ok(Status::Success)
}
