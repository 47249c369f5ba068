//! The haptic actor: the control plane of a servo that runs on a thread of its own.
//!
//! The thread turns [`hapticbillard::haptic::Servo`] at 1 kHz and hears and says everything through
//! slots and rings; it never sees a message. The actor looks at it some times a second: it lowers
//! the stiffness to what the achieved lateness allows, and tells the player what is wrong. Thread
//! and device outlive it in a [`Seat`]; a control that dies has let go of the dead man's switch.

mod body;
mod clock;
mod control;
mod device;
mod haply;
mod keeper;
pub mod openhaptics;
mod ports;
#[cfg(all(target_os = "linux", feature = "rtkit"))]
mod realtime_kit;
mod recording;
mod rights;
mod seat;
mod spool;
mod stylus;
mod telemetry;
mod thread;
mod timing;
mod turns;

pub use body::Body;
pub use control::{Haptic, Look, Looked, allowed};
pub use device::{FeltMouse, Listed, MouseMove, MousePort, NoDevice, Opened, list, open};
pub use haply::NoHaply;
pub use keeper::{Joins, Keeper, keep, keep_and_tell};
pub use ports::{
    AllPorts, Balls, ControlPorts, Orders, ServoPorts, Signs, StylusPorts, TickTold, Watch,
    WorldPort,
};
pub use recording::{DeviceRecorder, Recorded, load as load_recording};
pub use rights::{Asked, Core, Grant, Obtained, Refusal, obtain, probe, release};
pub use seat::{Held, Lay, Plan, Seat, Started};
pub use stylus::{Stylus, frame_of};
pub use telemetry::{Telemetry, Written};
pub use thread::{NoServo, ServoThread};
pub use timing::{OVERRUN_NS, Timing};
pub use turns::{Call, Called, Explain, Scheduler, Turns};

use glam::DVec3;
use hapticbillard::ball::{Ball, BallState};
use hapticbillard::cue::Aim;
use hapticbillard::haptic::{EffectSet, HapticMesh, Reach, ReachSettings};
use hapticbillard::ids::BallId;
use hapticbillard::scene::{HapticDevice, HapticSection, Scene};
use hapticbillard::table::Table;
use std::path::{Component, Path};
use std::sync::Arc;

/// The name of the actor in what the player is told.
pub const HAPTIC: &str = "haptic";

/// What `scene` asks to be felt; none if it asks for nothing. What it names is seen from `folder`.
///
/// # Errors
/// [`NoDevice`] if this build does not know the device, or it is not there.
pub fn plan(
    scene: &Scene,
    folder: Option<&Path>,
    table: &Table,
    balls: &[(Ball, BallState)],
) -> Result<Option<Plan>, NoDevice> {
    let Some(section) = &scene.haptic else { return Ok(None) };
    let Some(opened) = open(&seen_from(folder, &section.device)?)? else { return Ok(None) };
    let parameters = scene.parameters();
    let settings = reach_settings(section);
    let lay = scene.cue.is_some().then_some(Lay { settings, parameters });
    Ok(Some(Plan {
        opened,
        asked: Asked::by(section),
        mesh: Some(Arc::new(HapticMesh::of(table))),
        effects: EffectSet::default(),
        reach: reach(scene, balls, lay.as_ref(), &settings),
        lay,
        bodies: balls.iter().map(|(ball, _)| ball.clone()).collect(),
    }))
}

/// Scenes come from anywhere, so a recording must lie in the scene's own folder or below.
fn seen_from(folder: Option<&Path>, device: &HapticDevice) -> Result<HapticDevice, NoDevice> {
    let HapticDevice::Recorded(file) = device else { return Ok(device.clone()) };
    let inside = |part| matches!(part, Component::Normal(_) | Component::CurDir);
    if !Path::new(file).components().all(inside) {
        return Err(NoDevice::Recording {
            path: file.into(),
            problem: "a recording must lie in the scene's folder or below it".to_string(),
        });
    }
    let path = folder.unwrap_or(Path::new("")).join(file);
    Ok(HapticDevice::Recorded(path.to_string_lossy().into_owned()))
}

/// How the workspace is laid into the world: as the scene says, or as it is by default.
fn reach_settings(section: &HapticSection) -> ReachSettings {
    let usual = ReachSettings::default();
    ReachSettings {
        scale: section.scale.unwrap_or(usual.scale),
        stroke_gain: section.stroke_gain.unwrap_or(usual.stroke_gain),
        ..usual
    }
}

/// How far the workspace in front of a cue ball is lowered at first [rad]: the cue clears the rail.
const ELEVATION_RAD: f64 = 0.06;

/// The workspace in front of the cue ball where it can be struck; otherwise round all balls; none
/// without balls.
fn reach(
    scene: &Scene,
    balls: &[(Ball, BallState)],
    lay: Option<&Lay>,
    settings: &ReachSettings,
) -> Option<Reach> {
    let cue_ball = balls.iter().find(|(ball, _)| ball.id == BallId::CUE);
    if let (Some(lay), Some((_, state))) = (lay, cue_ball) {
        let aim = Aim { elevation_rad: ELEVATION_RAD, ..Aim::default() };
        return Some(lay.to(1, state.position, &aim));
    }
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for (ball, state) in balls {
        low = low.min(state.position - ball.radius_m);
        high = high.max(state.position + ball.radius_m);
    }
    let tip_radius_m = scene.parameters().tip_radius_m;
    (!balls.is_empty()).then(|| Reach::around(1, low, high, tip_radius_m, settings))
}
