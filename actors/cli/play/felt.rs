//! What a game in a window needs of the haptic device: the servo's plan, and who looks on.

use hapticbillard::haptic::{ReachSettings, ServoReport};
use hapticbillard::renderer::{FeltLook, FeltTool};
use hapticbillard_actors::error::Error;
use hapticbillard_actors::game::Stage;
use hapticbillard_actors::haptic::{Plan, Telemetry, Watch};
use hapticbillard_actors::renderer::{FeltSetup, StylusPort};
use std::path::Path;

/// A servo before it starts.
pub struct Watched {
    /// What it is made of.
    pub plan: Plan,
    /// Its ends of what looks on.
    pub watch: Watch,
    /// The window's end.
    pub shown: FeltSetup,
    /// The file that every tick goes to.
    pub telemetry: Option<Telemetry>,
}

/// What the scene asks to be felt, if anything. `leads`: nobody else plays at mouse and keyboard.
pub fn felt(stage: &Stage, leads: bool, file: Option<&Path>) -> Result<Option<Watched>, Error> {
    let (Some(plan), Some(section)) = (stage.haptic()?, &stage.scene.haptic) else {
        return match file {
            None => Ok(None),
            Some(_) => {
                let problem = "there is no haptic device in this scene";
                Err(Error::input("--telemetry", problem, "play a scene with [haptic]"))
            }
        };
    };
    let mut watch = Watch::default();
    let (picture, report) = triple_buffer::triple_buffer(&ServoReport::default());
    watch.picture = Some(picture);
    let telemetry = Telemetry::of(&mut watch, file)?;
    let spec = plan.opened.device.spec();
    let stylus = plan.opened.points.then(|| {
        let (told, buttons) = std::mem::take(&mut watch).with_buttons();
        watch = told;
        StylusPort { buttons, workspace_m: spec.workspace_m }
    });
    let tool = if stage.scene.cue.is_some() { FeltTool::Cue } else { FeltTool::Stylus };
    let shown = FeltSetup {
        report,
        timing: watch.timing.clone(),
        look: FeltLook::new(tool, spec.force_max_n, &ReachSettings::default()),
        device: format!("{}, {}", section.device.name(), spec.model),
        overlay: section.overlay,
        leads,
        has_turns: !stage.scene.human_players().is_empty(),
        by_mouse: plan.opened.mouse.is_some(),
        stylus,
    };
    Ok(Some(Watched { plan, watch, shown, telemetry }))
}
