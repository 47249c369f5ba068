//! The haptic renderer: what a hand feels of cue and table, computed once per millisecond.
//!
//! [`Servo::tick`] is the whole of it: a pure function of its own state, of what the device says
//! and of the newest [`HapticScene`]. Whoever has a clock calls it: a real-time thread, the
//! callback of a vendor's library, or a test. It never allocates, locks, logs, blocks or panics.
//!
//! Behind the servo stands a [`Device`]: a simulated one, a recorded one ([`RecordedDevice`]), or a
//! real one, whose messages are read here where they are text ([`Inverse3`]), and which others talk
//! to.
//!
//! Two frames. The *device frame* has its origin in the middle of the workspace, x to the right, y
//! up, z towards the user [m]; effects, devices and forces live in it. The *world* is the game's,
//! z up; balls, table and tip live in it. The [`Reach`] says how one is laid into the other.
//!
//! The servo sends no impulse to the physics. The truth of a stroke is physics', which follows the
//! [`StylusSample`]s; the servo solves the same contact with the same law for the hand alone.

mod device;
mod effect;
mod report;
mod scene;
mod settings;

mod servo;

mod world;

mod reach;

mod tip;

mod mesh;
mod obstacles;
mod proxy;

mod strike;
mod transient;

mod effect_force;

mod anchor;

mod safety;

pub mod simulated;

mod recorded;
mod recording;

mod inverse3;

pub mod openhaptics;

mod rehearsal;

pub mod telemetry;

pub use anchor::{Anchor, Anchors, Leads, THRESHOLD_M, WHEEL_STIFFNESS_N_M};
pub use device::{Buttons, Device, DeviceSpec, DeviceState, DeviceStatus, Force};
pub use effect::{EFFECTS_MAX, Effect, EffectSet, Region};
pub use inverse3::{Format, INVERSE3, Inverse3, Inverse3Trouble};
pub use mesh::HapticMesh;
pub use recorded::RecordedDevice;
pub use recording::{
    DeviceRecording, DeviceRecordingError, READINGS_MAX, Reading, RecordingProblem,
    RecordingReader, RecordingWriter,
};
pub use rehearsal::Rehearsal;
pub use report::{
    ButtonEdge, ContactEvent, Counters, SafetyFlags, ServoReport, StylusSample, Touched,
    WorkspacePose,
};
pub use scene::{BALLS_MAX, CueBody, HapticBall, HapticScene, Reach};
pub use servo::Servo;
pub use settings::{
    CouplingSettings, ReachSettings, SafetySettings, ServoSettings, TransientSettings,
    stiffness_for,
};
