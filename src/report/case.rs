//! A scene in numbers, so that other programs run the very same thing and are held to the same
//! truth.

use super::catalogue::{Norm, Scene};
use super::method::{Method, STEPS_MS};
use super::trial::{LOOKS, Prepared};
use crate::ball::{Ball, BallState};
use crate::hash::{Digest, StateHash};
use crate::mesh::Surface;
use crate::physics::{Contact, Parameters};
use crate::units::Seconds;
use glam::DVec3;
use serde::Serialize;
use serde_json::json;
use std::collections::BTreeMap;

/// A scene with its ground, its laws, its starts and the truth.
#[derive(Debug, Clone, Serialize)]
pub struct SceneCase {
    /// The scene.
    pub scene: &'static str,
    /// What it shows, in a few words.
    pub title: &'static str,
    /// Tells whether two cases ask the same: of everything but the truth and further starts.
    pub digest: Digest,
    /// How long it is compared [s].
    pub until_s: Seconds,
    /// How an error becomes one number: `worst` or `mean_square`, at the worst of the looks.
    pub norm: &'static str,
    /// How far the truth may be off [m].
    pub reference_error_m: f64,
    /// Steps that methods are run with [ms].
    pub steps_ms: [f64; STEPS_MS.len()],
    /// When the error is looked at [s].
    pub looks_s: Vec<Seconds>,
    /// The laws.
    pub law: Law,
    /// What balls lie on and run into.
    pub ground: Ground,
    /// The starts.
    pub starts: Vec<CaseStart>,
}

/// Restitution of the normal speed and Coulomb's friction coefficient.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Rub {
    /// Newton's restitution.
    pub restitution: f64,
    /// Coulomb's friction coefficient.
    pub friction: f64,
}

/// The numbers of the laws that do not belong to a surface.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Law {
    /// Gravity, downwards [m/s²].
    pub gravity_m_s2: f64,
    /// Between two balls.
    pub ball: Rub,
    /// Deceleration of a rolling ball over gravity.
    pub rolling_resistance: f64,
    /// Deceleration of the spin about the vertical [rad/s²].
    pub spin_deceleration_rad_s2: f64,
}

/// What balls lie on and run into.
#[derive(Debug, Clone, Serialize)]
pub struct Ground {
    /// Length along x and width along y between the noses of cushions, if there are any [m].
    pub bed_m: Option<[f64; 2]>,
    /// Half spaces.
    pub planes: Vec<GroundPlane>,
    /// Meshes, one for each kind of surface.
    pub parts: Vec<Part>,
}

/// A half space.
#[derive(Debug, Clone, Serialize)]
pub struct GroundPlane {
    /// What it is: `cloth`, `cushion` and so on.
    pub surface: &'static str,
    /// Somewhere on it [m].
    pub point_m: DVec3,
    /// Out of it.
    pub normal: DVec3,
    /// Between it and a ball.
    pub rub: Rub,
}

/// The triangles of one kind of surface.
#[derive(Debug, Clone, Serialize)]
pub struct Part {
    /// What it is.
    pub surface: &'static str,
    /// Between it and a ball.
    pub rub: Rub,
    /// Corners [m].
    pub vertices_m: Vec<DVec3>,
    /// Numbers of three corners each, anticlockwise seen from outside.
    pub faces: Vec<[u32; 3]>,
}

/// Balls at the start, and where they should be at each look.
#[derive(Debug, Clone, Serialize)]
pub struct CaseStart {
    /// The balls.
    pub balls: Vec<CaseBall>,
    /// At each look, each ball [m].
    pub truth_m: Vec<Vec<DVec3>>,
}

/// A solid ball at the start.
#[derive(Debug, Clone, Serialize)]
pub struct CaseBall {
    /// Radius [m].
    pub radius_m: f64,
    /// Mass [kg].
    pub mass_kg: f64,
    /// Centre [m].
    pub position_m: DVec3,
    /// Velocity [m/s].
    pub velocity_m_s: DVec3,
    /// Angular velocity [rad/s].
    pub angular_velocity_rad_s: DVec3,
    /// Whether it has weight.
    pub gravity: bool,
    /// Anchor [m], stiffness [N/m] and damping [N s/m] of its spring, if it has one.
    pub spring: Option<(DVec3, f64, f64)>,
}

impl Prepared {
    /// The scene in numbers.
    pub fn case(&self) -> SceneCase {
        let Scene { id, title, norm, .. } = self.scene;
        let parameters = self.parameters(Method::EventDriven);
        let law = Law {
            gravity_m_s2: parameters.gravity_m_s2,
            ball: rub(parameters.ball),
            rolling_resistance: parameters.rolling_resistance,
            spin_deceleration_rad_s2: parameters.spin_deceleration_rad_s2,
        };
        let ground = self.ground(&parameters);
        let starts: Vec<CaseStart> = self
            .starts
            .iter()
            .zip(&self.truth)
            .map(|(balls, truth)| CaseStart {
                balls: balls.iter().map(case_ball).collect(),
                truth_m: truth.looks.clone(),
            })
            .collect();
        let first = starts.first().map(|start| &start.balls);
        let asked = json!([id, self.until_s, law, ground, first]).to_string();
        let mut hash = StateHash::new();
        hash.bytes(asked.as_bytes());
        SceneCase {
            scene: id,
            title,
            digest: hash.finish(),
            until_s: self.until_s,
            norm: match norm {
                Norm::Worst => "worst",
                Norm::MeanSquare => "mean_square",
            },
            reference_error_m: self.reference_error_m,
            steps_ms: STEPS_MS,
            looks_s: (1..=LOOKS).map(|look| self.look_s(look)).collect(),
            law,
            ground,
            starts,
        }
    }

    fn ground(&self, parameters: &Parameters) -> Ground {
        let table = &self.table;
        let mut parts: BTreeMap<&'static str, Part> = BTreeMap::new();
        let mut numbers: BTreeMap<(&'static str, u32), u32> = BTreeMap::new();
        for face in &table.mesh.faces {
            let surface = surface_name(face.surface);
            let part = parts.entry(surface).or_insert_with(|| Part {
                surface,
                rub: rub(parameters.surface(face.surface)),
                vertices_m: Vec::new(),
                faces: Vec::new(),
            });
            part.faces.push(face.corners.map(|corner| {
                *numbers.entry((surface, corner)).or_insert_with(|| {
                    part.vertices_m.push(table.mesh.vertices[corner as usize]);
                    (part.vertices_m.len() - 1) as u32
                })
            }));
        }
        let plane = |plane: &crate::table::Plane| GroundPlane {
            surface: surface_name(plane.surface),
            point_m: plane.point,
            normal: plane.normal,
            rub: rub(parameters.surface(plane.surface)),
        };
        Ground {
            bed_m: table.bed.map(|bed| [bed.length_m, bed.width_m]),
            planes: table.planes.iter().map(plane).collect(),
            parts: parts.into_values().collect(),
        }
    }
}

fn rub(contact: Contact) -> Rub {
    Rub { restitution: contact.restitution, friction: contact.friction }
}

fn case_ball((ball, state): &(Ball, BallState)) -> CaseBall {
    CaseBall {
        radius_m: ball.radius_m,
        mass_kg: ball.mass_kg,
        position_m: state.position,
        velocity_m_s: state.velocity,
        angular_velocity_rad_s: state.angular_velocity,
        gravity: ball.flags.gravity,
        spring: ball
            .spring
            .map(|spring| (spring.anchor_m, spring.stiffness_n_m, spring.damping_ns_m)),
    }
}

fn surface_name(surface: Surface) -> &'static str {
    match surface {
        Surface::Cloth => "cloth",
        Surface::Cushion(_) => "cushion",
        Surface::Pocket(_) => "pocket",
        Surface::PocketBottom(_) => "pocket bottom",
        Surface::Wood => "wood",
        Surface::Floor => "floor",
        Surface::Obstacle => "obstacle",
    }
}
