// A world of rapier, in the precision of the `rapier` that is named where this file is included.

use super::case::{Case, Law, Rub, Start, Vector};
use rapier::prelude::{
    CoefficientCombineRule, ColliderBuilder, FrictionModel, GenericJointBuilder, JointAxesMask,
    JointAxis, MotorModel, PhysicsWorld, Real, RigidBodyBuilder, RigidBodyHandle, SharedShape,
    TriMeshFlags, Vector as Vec3,
};

/// Rapier's lengths are meant for bodies of a metre; a ball is a twentieth of that.
const LENGTH_UNIT: f64 = 0.05;
const ITERATIONS: usize = 8;
/// A ball this close to its place on cloth is on it [m]; rapier lets balls sink by 2 mm at coarse
/// steps.
const ON_CLOTH_M: Real = 3e-3;
/// A ball whose slip friction can stop in a step rolls; friction slows slip by 7/2 μ g.
const SLIP_OVER_GRIP: f64 = 3.5;

struct World {
    world: PhysicsWorld,
    balls: Vec<RigidBodyHandle>,
    radius: Real,
    losses: Option<Losses>,
}

/// What cloth takes from a ball in a step.
#[derive(Clone, Copy)]
struct Losses {
    /// From its speed when it rolls [m/s].
    rolling: Real,
    /// From its spin about the vertical [rad/s].
    spinning: Real,
    /// From its slip when it slides [m/s].
    sliding: Real,
}

fn vector(v: Vector) -> Vec3 {
    Vec3::new(v[0] as Real, v[1] as Real, v[2] as Real)
}

/// The contact of a ball and this surface gets the surface's numbers: rapier combines two numbers
/// by the stronger of two rules, and balls have the weakest.
fn rubbed(builder: ColliderBuilder, surface: Rub, law: &Law) -> ColliderBuilder {
    let rule = |own: f64, balls: f64| {
        if own < balls { CoefficientCombineRule::Min } else { CoefficientCombineRule::Max }
    };
    builder
        .friction(surface.friction as Real)
        .restitution(surface.restitution as Real)
        .friction_combine_rule(rule(surface.friction, law.ball.friction))
        .restitution_combine_rule(rule(surface.restitution, law.ball.restitution))
}

pub fn make(case: &Case, start: &Start, h: f64) -> Result<Box<dyn super::Engine>, String> {
    let law = &case.law;
    let mut world = PhysicsWorld::new();
    world.gravity = Vec3::new(0.0, 0.0, -law.gravity_m_s2 as Real);
    let parameters = &mut world.integration_parameters;
    parameters.dt = h as Real;
    parameters.length_unit = LENGTH_UNIT as Real;
    parameters.num_solver_iterations = ITERATIONS;
    parameters.friction_model = FrictionModel::Coulomb;
    // Stock cloth is so soft that a ball sinks by 0.07 mm, which is felt as a smaller ball.
    parameters.static_contact_softness.natural_frequency = 1.0 / h as Real;
    parameters.contact_recycling = false;
    for plane in &case.ground.planes {
        let shape = ColliderBuilder::new(SharedShape::halfspace(vector(plane.normal)));
        let shape = shape.translation(vector(plane.point_m));
        world.insert_collider(rubbed(shape, plane.rub, law), None);
    }
    for part in &case.ground.parts {
        let corners = part.vertices_m.iter().map(|corner| vector(*corner)).collect();
        let flags = TriMeshFlags::FIX_INTERNAL_EDGES;
        let shape = ColliderBuilder::trimesh_with_flags(corners, part.faces.clone(), flags)
            .map_err(|error| error.to_string())?;
        world.insert_collider(rubbed(shape, part.rub, law), None);
    }
    let mut balls = Vec::new();
    for ball in &start.balls {
        let body = RigidBodyBuilder::dynamic()
            .translation(vector(ball.position_m))
            .linvel(vector(ball.velocity_m_s))
            .angvel(vector(ball.angular_velocity_rad_s))
            .gravity_scale(if ball.gravity { 1.0 } else { 0.0 })
            .can_sleep(false);
        let shape = ColliderBuilder::ball(ball.radius_m as Real)
            .mass(ball.mass_kg as Real)
            .friction(law.ball.friction as Real)
            .restitution(law.ball.restitution as Real);
        let (handle, _) = world.insert(body, shape);
        if let Some((anchor, stiffness, damping)) = ball.spring {
            let fixed = world.insert_body(RigidBodyBuilder::fixed().translation(vector(anchor)));
            let mut joint = GenericJointBuilder::new(JointAxesMask::empty());
            for axis in [JointAxis::LinX, JointAxis::LinY, JointAxis::LinZ] {
                joint = joint
                    .motor_model(axis, MotorModel::ForceBased)
                    .motor_position(axis, 0.0, stiffness as Real, damping as Real);
            }
            world.insert_impulse_joint(fixed, handle, joint.build());
        }
        balls.push(handle);
    }
    let losses = case.ground.cloth().map(|cloth| Losses {
        rolling: (law.rolling_resistance * law.gravity_m_s2 * h) as Real,
        spinning: (law.spin_deceleration_rad_s2 * h) as Real,
        sliding: (SLIP_OVER_GRIP * cloth.friction * law.gravity_m_s2 * h) as Real,
    });
    let radius = start.balls.first().map_or(0.0, |ball| ball.radius_m) as Real;
    Ok(Box::new(World { world, balls, radius, losses }))
}

impl World {
    /// Rolling resistance and the decay of spin, which rapier does not know.
    fn lose(&mut self, losses: Losses) {
        for handle in &self.balls {
            let body = &mut self.world.bodies[*handle];
            if (body.translation().z - self.radius).abs() > ON_CLOTH_M {
                continue;
            }
            let (mut v, mut spin) = (body.linvel(), body.angvel());
            let slip = (v.x - self.radius * spin.y).hypot(v.y + self.radius * spin.x);
            let speed = v.x.hypot(v.y);
            if slip < losses.sliding && speed > 0.0 {
                let kept = (1.0 - losses.rolling / speed).max(0.0);
                v = Vec3::new(v.x * kept, v.y * kept, v.z);
                spin = Vec3::new(spin.x * kept, spin.y * kept, spin.z);
            }
            spin.z = spin.z.signum() * (spin.z.abs() - losses.spinning).max(0.0);
            body.set_linvel(v, false);
            body.set_angvel(spin, false);
        }
    }
}

impl super::Engine for World {
    fn step(&mut self) {
        if let Some(losses) = self.losses {
            self.lose(losses);
        }
        self.world.step();
    }

    fn positions(&self) -> Vec<Vector> {
        let place = |handle: &RigidBodyHandle| {
            let at = self.world.bodies[*handle].translation();
            [at.x as f64, at.y as f64, at.z as f64]
        };
        self.balls.iter().map(place).collect()
    }
}
