//! How long two bodies touch.

use super::parameters::Material;

/// E/(1-ν²) of both bodies as springs in series [Pa] (Hertz 1882).
fn stiffness_pa(a: Material, b: Material) -> f32 {
    let compliance = |m: Material| (1.0 - m.poisson * m.poisson) / m.young_pa;
    1.0 / (compliance(a) + compliance(b))
}

/// Length of an elastic contact [s].
///
/// τ = 2.87 (m² / (R E² v))^(1/5): `mass_kg` m and `radius_m` R are the reduced ones of both bodies
/// (half of each for equal balls, those of the ball for a flat body at rest), v = `speed_m_s` the
/// speed of approach. Hertz 1882; Gugan, Am. J. Phys. 68 (2000) 920, found that it holds for balls
/// that lose energy too. Infinite for v = 0.
pub fn hertz_s(mass_kg: f32, radius_m: f32, bodies: [Material; 2], speed_m_s: f32) -> f32 {
    let e = stiffness_pa(bodies[0], bodies[1]);
    2.87 * libm::powf(mass_kg / e * (mass_kg / e) / (radius_m * speed_m_s), 0.2)
}
