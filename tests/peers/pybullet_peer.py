"""The report's cases in PyBullet, in double precision and as rigid bodies (maximal coordinates).

Rolling resistance is either Bullet's own, a torque that also brakes a ball that slides, or applied
from outside, as the report's law has it. A spring's force is applied from outside in every step.
"""

from __future__ import annotations

import math

import pybullet as bullet
from case import Ball, Case, Positions, Rub, from_outside, in_steps, rolls

# With more balls, a step from outside costs more in Python than in Bullet.
MOST_HELPED = 3
# Contacts are kept while bodies are no farther apart [m].
BREAKING_M = 5e-4
# Slower impacts do not bounce [m/s].
BOUNCING_M_S = 1e-3
ITERATIONS = 50


def over(value: float, part: float) -> float:
    """Bullet multiplies the numbers of two bodies; this is the second factor."""
    return value / part if part > 0 else 0.0


class World:
    """A world of Bullet; helped, something is applied from outside in every step."""

    def __init__(self, case: Case, balls: list[Ball], h: float, helped: bool) -> None:
        self.case, self.balls, self.h, self.helped = case, balls, h, helped
        bullet.resetSimulation()
        bullet.setGravity(0, 0, -case.gravity_m_s2)
        bullet.setPhysicsEngineParameter(
            fixedTimeStep=h,
            numSubSteps=0,
            numSolverIterations=ITERATIONS,
            solverResidualThreshold=0,
            restitutionVelocityThreshold=BOUNCING_M_S,
            contactBreakingThreshold=BREAKING_M,
            enableConeFriction=1,
            deterministicOverlappingPairs=1,
        )
        self.ball = Rub(math.sqrt(case.ball.restitution), math.sqrt(case.ball.friction))
        if case.ball.friction == 0 and case.cloth is not None and case.cloth.friction > 0:
            raise ValueError("balls without friction have none on cloth either")
        for plane in case.planes:
            shape = bullet.createCollisionShape(bullet.GEOM_PLANE, planeNormal=plane.normal)
            self.fixed(shape, plane.point_m, plane.rub)
        for part in case.parts:
            shape = bullet.createCollisionShape(
                bullet.GEOM_MESH,
                vertices=part.vertices_m,
                indices=[corner for face in part.faces for corner in face],
                flags=bullet.GEOM_FORCE_CONCAVE_TRIMESH,
            )
            self.fixed(shape, (0, 0, 0), part.rub)
        self.bodies = [self.moving(ball) for ball in balls]

    def fixed(self, shape: int, place: tuple[float, ...], rub: Rub) -> None:
        body = bullet.createMultiBody(0, shape, basePosition=place, useMaximalCoordinates=1)
        bullet.changeDynamics(
            body,
            -1,
            restitution=over(rub.restitution, self.ball.restitution),
            lateralFriction=over(rub.friction, self.ball.friction),
        )

    def moving(self, ball: Ball) -> int:
        case = self.case
        shape = bullet.createCollisionShape(bullet.GEOM_SPHERE, radius=ball.radius_m)
        body = bullet.createMultiBody(
            ball.mass_kg, shape, basePosition=ball.position_m, useMaximalCoordinates=1
        )
        rolling = spinning = 0.0
        if case.cloth is not None and case.cloth.friction > 0 and not self.helped:
            # Torques over the normal force [m]; Bullet multiplies them by the cloth's friction.
            cloth = over(case.cloth.friction, self.ball.friction)
            rolling = over(1.4 * ball.radius_m * case.rolling_resistance, cloth)
            decay = case.spin_deceleration_rad_s2 / case.gravity_m_s2
            spinning = over(0.4 * ball.radius_m**2 * decay, cloth)
        bullet.changeDynamics(
            body,
            -1,
            restitution=self.ball.restitution,
            lateralFriction=self.ball.friction,
            rollingFriction=rolling,
            spinningFriction=spinning,
            linearDamping=0,
            angularDamping=0,
            activationState=bullet.ACTIVATION_STATE_DISABLE_SLEEPING,
        )
        bullet.resetBaseVelocity(body, ball.velocity_m_s, ball.angular_velocity_rad_s)
        if not ball.gravity:
            bullet.setGravity(0, 0, 0)
        return body

    def steps(self, count: int) -> None:
        for _ in range(count):
            if self.helped:
                self.help()
            bullet.stepSimulation()

    def help(self) -> None:
        """The force of springs, rolling resistance and the decay of spin, by the report's laws."""
        for body, ball in zip(self.bodies, self.balls, strict=True):
            place, _ = bullet.getBasePositionAndOrientation(body)
            velocity, spin = bullet.getBaseVelocity(body)
            if ball.spring is None:
                velocity, spin = rolls(self.case, ball, place[2], velocity, spin, self.h)
                bullet.resetBaseVelocity(body, velocity, spin)
                continue
            anchor, stiffness, damping = ball.spring
            force = [
                stiffness * (a - x) - damping * v
                for a, x, v in zip(anchor, place, velocity, strict=True)
            ]
            bullet.applyExternalForce(body, -1, force, place, bullet.WORLD_FRAME)

    def positions(self) -> Positions:
        return [bullet.getBasePositionAndOrientation(body)[0] for body in self.bodies]


def main() -> None:
    bullet.connect(bullet.DIRECT)
    for case, limit_s in from_outside():
        on_cloth = case.cloth is not None and case.cloth.friction > 0
        springs = any(ball.spring for ball in case.starts[0])
        if not springs:
            in_steps(
                case,
                "own rolling friction" if on_cloth else "",
                lambda balls, h: World(case, balls, h, helped=False),
                limit_s,
                "its own rolling friction brakes sliding balls too" if on_cloth else "",
            )
        if springs or on_cloth and len(case.starts[0]) <= MOST_HELPED:
            what = "the spring" if springs else "rolling resistance and the decay of spin"
            in_steps(
                case,
                "helped",
                lambda balls, h: World(case, balls, h, helped=True),
                limit_s,
                f"{what} applied from outside, in Python",
            )


main()
