//! A case, as `hapticbillard report --cases` writes it; only what this program reads of it.

use serde::Deserialize;

pub type Vector = [f64; 3];

#[derive(Deserialize)]
pub struct Case {
    pub until_s: f64,
    pub steps_ms: Vec<f64>,
    pub looks_s: Vec<f64>,
    pub law: Law,
    pub ground: Ground,
    pub starts: Vec<Start>,
}

#[derive(Deserialize)]
pub struct Law {
    pub gravity_m_s2: f64,
    pub ball: Rub,
    pub rolling_resistance: f64,
    pub spin_deceleration_rad_s2: f64,
}

#[derive(Deserialize, Clone, Copy)]
pub struct Rub {
    pub restitution: f64,
    pub friction: f64,
}

#[derive(Deserialize)]
pub struct Ground {
    pub planes: Vec<Plane>,
    pub parts: Vec<Part>,
}

impl Ground {
    /// What balls lie on, if there is a cloth.
    pub fn cloth(&self) -> Option<Rub> {
        let planes = self.planes.iter().map(|plane| (&plane.surface, plane.rub));
        let mut all = planes.chain(self.parts.iter().map(|part| (&part.surface, part.rub)));
        all.find(|(surface, _)| *surface == "cloth").map(|(_, rub)| rub)
    }
}

#[derive(Deserialize)]
pub struct Plane {
    pub surface: String,
    pub point_m: Vector,
    pub normal: Vector,
    pub rub: Rub,
}

#[derive(Deserialize)]
pub struct Part {
    pub surface: String,
    pub rub: Rub,
    pub vertices_m: Vec<Vector>,
    pub faces: Vec<[u32; 3]>,
}

#[derive(Deserialize)]
pub struct Start {
    pub balls: Vec<Ball>,
}

#[derive(Deserialize)]
pub struct Ball {
    pub radius_m: f64,
    pub mass_kg: f64,
    pub position_m: Vector,
    pub velocity_m_s: Vector,
    pub angular_velocity_rad_s: Vector,
    pub gravity: bool,
    /// Anchor [m], stiffness [N/m], damping [N s/m].
    pub spring: Option<(Vector, f64, f64)>,
}
