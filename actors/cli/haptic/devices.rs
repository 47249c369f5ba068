//! `hapticbillard haptic devices`: what a scene can ask for, what is built in, and what is there.

use crate::cli::{Status, json_line};
use clap::Args;
use hapticbillard::haptic::DeviceSpec;
use hapticbillard::scene::HapticDevice;
use hapticbillard_actors::error::Error;
use hapticbillard_actors::haptic::{Listed, list, open};
use serde_json::{Value, json};
use std::io::Write;

const EXAMPLE: &str = "\
A scene names its device in [haptic], such as device = \"mouse\"; `haptic check --device NAME` tries
one. Devices that can be plugged in are looked for.

  simulated, mouse     need nothing
  recorded:FILE        made by `haptic check --record FILE`, `haptic simulate --stroke 1 --record
                       FILE` or `play --record-device FILE`; a scene's lies in its folder
  haply                a Haply Inverse3 whose service runs on this machine (open the Haply Hub)
  haply:HOST:PORT      the same elsewhere

Examples:
  hapticbillard haptic devices
  hapticbillard haptic devices --json";

/// Lists the haptic devices that a scene can name.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct DevicesArgs {
    /// Prints JSON lines.
    #[arg(long)]
    pub json: bool,
}

/// Whether a device is there.
enum There {
    /// It needs nothing to be.
    Always,
    /// It answers, and is this.
    Yes(DeviceSpec),
    /// It does not.
    No(String),
}

/// Lists them.
pub fn run(args: &DevicesArgs, out: &mut dyn Write) -> Result<Status, Error> {
    let devices = list();
    let mut found = 0;
    for device in &devices {
        let there = look_for(device);
        found += u32::from(matches!(there, There::Yes(_)));
        if args.json {
            json_line(out, &line(device, &there))?;
        } else {
            writeln!(out, "{:<14} {}; {}", device.name, device.about, words(device, &there))?;
        }
    }
    if args.json {
        let built_in = devices.iter().filter(|device| device.is_built_in).count();
        let summary = json!({ "devices": devices.len(), "built_in": built_in, "found": found });
        json_line(out, &json!({ "summary": summary }))?;
    }
    Ok(Status::Success)
}

fn look_for(device: &Listed) -> There {
    match HapticDevice::named(device.name) {
        Some(named @ (HapticDevice::Haply(_) | HapticDevice::OpenHaptics(_))) => match open(&named)
        {
            Ok(Some(opened)) => There::Yes(opened.device.spec()),
            Ok(None) => There::Always,
            Err(why) => There::No(why.to_string()),
        },
        _ => There::Always,
    }
}

fn line(device: &Listed, there: &There) -> Value {
    let spec = match there {
        There::Yes(spec) => Some(*spec),
        There::Always | There::No(_) => device.spec,
    };
    let spec = spec.map(|spec| {
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
    let (is_there, why) = match there {
        There::Always => (None, None),
        There::Yes(_) => (Some(true), None),
        There::No(why) => (Some(false), Some(why)),
    };
    json!({
        "name": device.name,
        "about": device.about,
        "built_in": device.is_built_in,
        "spec": spec,
        "found": is_there,
        "why": why,
    })
}

fn words(device: &Listed, there: &There) -> String {
    match (there, device.spec) {
        _ if !device.is_built_in => "not built in".to_string(),
        (There::No(why), _) => format!("not found: {why}"),
        (There::Yes(spec), _) => {
            format!("found: {}, {:.1} ms late", numbers(spec), spec.latency_s * 1000.0)
        }
        (There::Always, Some(spec)) => format!("like a {}", numbers(&spec)),
        (There::Always, None) => "like the one that was recorded".to_string(),
    }
}

fn numbers(spec: &DeviceSpec) -> String {
    format!(
        "{}: {} N, {} N for long, {} N/m, {} Hz",
        spec.model, spec.force_max_n, spec.force_continuous_n, spec.stiffness_max_n_m, spec.rate_hz
    )
}
