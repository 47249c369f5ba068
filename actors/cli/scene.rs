//! `hapticbillard scene`: what a scene will start.

use super::haptic::check::write_rights;
use super::{Status, json_line};
use clap::Args;
use hapticbillard::scene::{HapticDevice, PlanKind};
use hapticbillard_actors::error::Error;
use hapticbillard_actors::files::load_scene;
use hapticbillard_actors::haptic::{Asked, HAPTIC, Obtained, probe};
use serde_json::json;
use std::io::Write;

const EXAMPLE: &str = "\
What a scene file does not name does not exist: this command shows what is left.

Examples:
  hapticbillard scene eight_ball
  hapticbillard scene my_table.toml --json";

/// Shows what a scene will start, which physics it has, and what was left out and why.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLE)]
pub struct SceneArgs {
    /// A shipped scene (see `scenes`) or a scene file.
    #[arg(value_name = "SCENE")]
    pub scene: String,

    /// Prints JSON lines: one per line of the plan, then the summary.
    #[arg(long)]
    pub json: bool,
}

/// Prints the plan.
pub fn run(args: &SceneArgs, out: &mut dyn Write) -> Result<Status, Error> {
    let loaded = load_scene(&args.scene)?;
    let scene = &loaded.scene;
    let plan = scene.plan();
    // What the thread would get is asked of the operating system, by a thread that ends at once.
    let is_felt = plan.iter().any(|line| line.kind == PlanKind::Actor && line.name == HAPTIC);
    let servo = scene.haptic.as_ref().filter(|_| is_felt).map(|section| {
        let asked = Asked::by(section);
        let is_vendors = matches!(section.device, HapticDevice::OpenHaptics(_));
        (asked, if is_vendors { Obtained::VENDORS } else { probe(&asked) })
    });
    let lines = |kind| plan.iter().filter(move |line| line.kind == kind);
    if args.json {
        plan.iter().try_for_each(|line| json_line(out, line))?;
        let summary = json!({ "summary": {
            "file": scene.file,
            "name": scene.about.name,
            "seed": scene.about.seed,
            "balls": scene.ball_count(),
            "meshes": scene.meshes_needed(),
            "actors": lines(PlanKind::Actor).count(),
            "terms": lines(PlanKind::Term).count(),
            "left_out": lines(PlanKind::LeftOut).count(),
            "servo": servo.map(|(asked, obtained)| json!({
                "core": asked.core,
                "priority": asked.priority,
                "lock_memory": asked.lock_memory,
                "spin_us": asked.spin_us,
                "obtained": obtained,
            })),
        }});
        json_line(out, &summary)?;
        return Ok(Status::Success);
    }
    writeln!(out, "{}: {}", scene.about.name, scene.about.description)?;
    for (kind, title) in [
        (PlanKind::Actor, "starts"),
        (PlanKind::Term, "computes"),
        (PlanKind::LeftOut, "leaves out"),
    ] {
        if lines(kind).count() > 0 {
            writeln!(out, "\n{title}")?;
        }
        for line in lines(kind) {
            writeln!(out, "  {:<20} {}", line.name, line.detail)?;
        }
    }
    if let Some((asked, obtained)) = servo {
        writeln!(out, "\nthe servo's thread")?;
        write_rights(asked, &obtained, out)?;
    }
    Ok(Status::Success)
}
