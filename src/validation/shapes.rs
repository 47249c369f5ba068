//! What the values of a setup look like.

use glam::DVec3;
use serde::Deserialize;

/// A ball at the start.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BallEntry {
    pub id: i64,
    pub m: f64,
    #[serde(rename = "R")]
    pub radius_m: f64,
    pub position_m: DVec3,
    pub velocity_m_s: DVec3,
    pub angular_velocity_rad_s: DVec3,
    pub inertia_factor: Option<f64>,
}

/// A half space.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Wall {
    pub point_m: DVec3,
    pub normal: DVec3,
}

/// A hollow cylinder with balls inside.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Cylinder {
    pub point_m: DVec3,
    pub axis: DVec3,
    pub radius_m: f64,
}

/// A body of triangles.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MeshEntry {
    pub vertices_m: Vec<DVec3>,
    pub triangles: Vec<[u32; 3]>,
}

/// Many starts on a line.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Repeat {
    pub count: u32,
    pub first_start_m: DVec3,
    pub last_start_m: DVec3,
    #[serde(default)]
    pub mirror_z: bool,
}

/// A cue; what a law does not need may be absent.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CueEntry {
    pub mass_kg: Option<f64>,
    pub speed_m_s: Option<f64>,
    pub direction: DVec3,
    pub contact_from_centre_m: DVec3,
    pub e_tip: Option<f64>,
    pub mu_tip: Option<f64>,
    pub end_mass_kg: Option<f64>,
    #[serde(rename = "impulse_Ns")]
    pub impulse_ns: Option<f64>,
}

/// Friction that falls with the slip.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Curve {
    pub a: f64,
    pub b: f64,
    pub c_s_m: f64,
}

/// Frames of random length.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RandomFrames {
    pub seed: u64,
    pub min_s: f64,
    pub max_s: f64,
}

/// Time stands still.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Pause {
    pub at_s: f64,
    pub steps: u32,
}

/// A gas of balls on a grid.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Grid {
    pub count: [u32; 3],
    pub m: f64,
    #[serde(rename = "R")]
    pub radius_m: f64,
    pub spacing_m: f64,
    pub first_m: DVec3,
    pub speed_m_s: f64,
}

/// The break in which narrow tests are counted.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BreakScene {
    pub bed_length_m: f64,
    pub bed_width_m: f64,
    pub cue_start_m: [f64; 2],
    pub cue_speed_m_s: f64,
    pub apex_m: [f64; 2],
    #[serde(rename = "ball_R_m")]
    pub ball_radius_m: f64,
    pub gap_m: f64,
    #[serde(rename = "T_s")]
    pub step_s: f64,
    pub end_time_s: f64,
}

/// One number or several.
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
pub(super) enum Numbers {
    One(f64),
    Many(Vec<f64>),
}

impl Numbers {
    pub fn list(self) -> Vec<f64> {
        match self {
            Numbers::One(number) => vec![number],
            Numbers::Many(list) => list,
        }
    }
}

/// Topspin at contact over that of rolling, falling with the speed.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Topspin {
    pub at_rest: f64,
    pub per_m_s: f64,
    pub lowest: f64,
}
