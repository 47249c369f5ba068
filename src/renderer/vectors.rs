//! What moves, as arrows: velocity, axis of spin, and slip on the cloth (paper, figure 2.1).

use super::draw_list::{DrawList, Radii, Solid, SolidShape};
use crate::physics::Snapshot;
use glam::DVec3;

/// Length of an arrow per speed [s]: a ball at 2 m/s has one of 16 cm.
const LENGTH_S: f64 = 0.08;
/// Slower is drawn as nothing [m/s].
const LEAST_M_S: f64 = 0.01;
const SHAFT_M: f32 = 0.0022;
const HEAD_M: f64 = 0.018;
const HEAD_RADIUS_M: f32 = 0.0062;
/// Colours as in the paper: velocity blue, axis of spin green, slip violet.
const VELOCITY: [f32; 4] = [0.30, 0.55, 1.0, 0.95];
const SPIN: [f32; 4] = [0.35, 0.95, 0.35, 0.95];
const SLIP: [f32; 4] = [0.80, 0.35, 1.0, 0.95];

/// Adds the arrows of every ball that moves.
///
/// The velocity begins at the top of the ball, the axis of spin in its middle, as long as the speed
/// of its surface, and the slip where it touches the cloth: `v + ω × r`, where `r` points from the
/// middle to the cloth. A ball in the air has none.
pub fn draw_vectors(world: &Snapshot, radii: &Radii, list: &mut DrawList) {
    for ball in world.on_table() {
        let radius_m = radii.of(ball.id);
        let top = ball.position + DVec3::Z * radius_m;
        arrow(list, top, ball.velocity, VELOCITY);
        arrow(list, ball.position, ball.angular_velocity * radius_m, SPIN);
        if ball.position.z < 1.05 * radius_m {
            let lever = DVec3::NEG_Z * radius_m;
            let slip = ball.velocity + ball.angular_velocity.cross(lever);
            arrow(list, ball.position + lever * 0.97, slip.with_z(0.0), SLIP);
        }
    }
}

/// An arrow at a place, for a speed [m/s] and its direction.
fn arrow(list: &mut DrawList, from: DVec3, speed: DVec3, colour: [f32; 4]) {
    let way = speed * LENGTH_S;
    if !(LEAST_M_S < speed.length()) {
        return;
    }
    let to = from + way;
    // A short one is all head.
    let neck = to - way.normalize() * HEAD_M.min(way.length());
    list.solids.push(Solid::between(SolidShape::Cylinder, from, neck, SHAFT_M, colour).over());
    list.solids.push(Solid::between(SolidShape::Cone, neck, to, HEAD_RADIUS_M, colour).over());
}
