"""The report's cases in MuJoCo, whose contacts are soft: springs as short as the step allows.

Rolling resistance is either MuJoCo's own, a torque that also brakes a ball that slides, or applied
from outside, as the report's law has it.
"""

from __future__ import annotations

import math
from itertools import combinations

import mujoco
import numpy
from case import Ball, Case, Positions, Rub, from_outside, in_steps, rolls, say

# Bodies that meet are together for so many steps.
CONTACT_STEPS = 6
# Friction stops slip within so many steps. Where it is stiffer, MuJoCo's convex law of friction
# lifts a ball that slides off the cloth: by 4 cm with 2 steps and a strong backspin.
FRICTION_STEPS = 6
# Contacts of few balls are listed one by one, which gives friction a stiffness of its own.
MOST_LISTED = 20
# With more balls, a step from outside costs more in Python than in MuJoCo.
MOST_HELPED = 3
RIGID = 'solimp="0.9999 0.9999 0.001"'


def damping_ratio(restitution: float) -> float:
    """The damping ratio at which a spring that does not pull throws back so much of a speed.

    Schwager and Poeschel 2007, "Coefficient of restitution and linear-dashpot model revisited".
    """

    def thrown(ratio: float) -> float:
        swing = math.sqrt(1.0 - ratio * ratio)
        turn = math.atan2(2.0 * ratio * swing, 2.0 * ratio * ratio - 1.0)
        return math.exp(-ratio / swing * turn)

    low, high = 0.0, 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if thrown(middle) > restitution else (low, middle)
    return low


class Contacts:
    """The attributes of contacts."""

    def __init__(self, case: Case, h: float, own_rolling: bool) -> None:
        self.case, self.h, self.own_rolling = case, h, own_rolling

    def spring(self, rub: Rub, surface: str) -> str:
        if surface == "cloth" and not self.case.flies:
            # What stays on the cloth needs no bounce.
            return f"{2 * self.h} 1"
        omega = math.pi / (CONTACT_STEPS * self.h)
        return f"{-omega * omega} {-2 * damping_ratio(rub.restitution) * omega}"

    def friction(self, rub: Rub, surface: str) -> tuple[int, float, float, float]:
        """Dimensions of the contact; sliding, spinning and rolling friction, the latter in m."""
        if surface != "cloth" or not self.own_rolling:
            return (3 if rub.friction else 1), rub.friction, 0.0, 0.0
        radius, gravity = self.case.starts[0][0].radius_m, self.case.gravity_m_s2
        spinning = 0.4 * radius * radius * self.case.spin_deceleration_rad_s2 / gravity
        return 6, rub.friction, spinning, 1.4 * radius * self.case.rolling_resistance

    def pair(self, one: str, other: str, rub: Rub, surface: str) -> str:
        size, sliding, spinning, rolling = self.friction(rub, surface)
        return (
            f'<pair geom1="{one}" geom2="{other}" condim="{size}"'
            f' friction="{sliding} {sliding} {spinning} {rolling} {rolling}" {RIGID}'
            f' solref="{self.spring(rub, surface)}" solreffriction="{FRICTION_STEPS * self.h} 1"/>'
        )

    def geom(self, rub: Rub, surface: str) -> str:
        size, sliding, spinning, rolling = self.friction(rub, surface)
        return (
            f'condim="{size}" friction="{sliding} {spinning} {rolling}" {RIGID}'
            f' solref="{self.spring(rub, surface)}" priority="{int(surface != "ball")}"'
        )


def numbers(values: tuple[float, ...]) -> str:
    return " ".join(map(repr, values))


def joints(ball: Ball) -> tuple[tuple[float, ...], str]:
    """Where the body stands in the file and how it is free to move."""
    if ball.spring is None:
        return ball.position_m, "<freejoint/>"
    anchor, stiffness, damping = ball.spring
    axes = ("1 0 0", "0 1 0", "0 0 1")
    made = (
        f'<joint type="slide" axis="{axis}" stiffness="{stiffness}" damping="{damping}"/>'
        for axis in axes
    )
    return anchor, "".join(made)


def model(case: Case, balls: list[Ball], h: float, own_rolling: bool, integrator: str) -> str:
    """The world in MuJoCo's language."""
    contacts = Contacts(case, h, own_rolling)
    listed = len(balls) <= MOST_LISTED
    bodies, pairs = [], []
    mask = 'contype="0" conaffinity="0"' if listed else ""
    for number, plane in enumerate(case.planes):
        own = mask if listed else contacts.geom(plane.rub, plane.surface)
        bodies.append(
            f'<geom name="plane{number}" type="plane" size="0 0 1" pos="{numbers(plane.point_m)}"'
            f' zaxis="{numbers(plane.normal)}" {own}/>'
        )
    for number, ball in enumerate(balls):
        place, free = joints(ball)
        own = mask if listed else contacts.geom(case.ball, "ball")
        weight = "" if ball.gravity else 'gravcomp="1"'
        bodies.append(
            f'<body pos="{numbers(place)}" {weight}>{free}<geom name="ball{number}" type="sphere"'
            f' size="{ball.radius_m}" mass="{ball.mass_kg}" {own}/></body>'
        )
        if listed:
            pairs += [
                contacts.pair(f"plane{at}", f"ball{number}", plane.rub, plane.surface)
                for at, plane in enumerate(case.planes)
            ]
    if listed:
        pairs += [
            contacts.pair(f"ball{one}", f"ball{other}", case.ball, "ball")
            for one, other in combinations(range(len(balls)), 2)
        ]
    return (
        f'<mujoco><option timestep="{h}" gravity="0 0 {-case.gravity_m_s2}" cone="elliptic"'
        f' integrator="{integrator}" tolerance="1e-12" iterations="100"/>'
        f"<worldbody>{''.join(bodies)}</worldbody><contact>{''.join(pairs)}</contact></mujoco>"
    )


class World:
    """A world of MuJoCo; helped, it is moved step by step."""

    def __init__(
        self, case: Case, balls: list[Ball], h: float, helped: bool, integrator: str = "Euler"
    ) -> None:
        self.case, self.balls, self.h, self.helped = case, balls, h, helped
        own_rolling = case.cloth is not None and case.cloth.friction > 0 and not helped
        text = model(case, balls, h, own_rolling, integrator)
        self.model = mujoco.MjModel.from_xml_string(text)
        self.data = mujoco.MjData(self.model)
        for number, ball in enumerate(balls):
            if ball.spring is None:
                at = 6 * number
                self.data.qvel[at : at + 3] = ball.velocity_m_s
                self.data.qvel[at + 3 : at + 6] = ball.angular_velocity_rad_s
            else:
                offset = numpy.subtract(ball.position_m, ball.spring[0])
                self.data.qpos[3 * number : 3 * number + 3] = offset
                self.data.qvel[3 * number : 3 * number + 3] = ball.velocity_m_s
        mujoco.mj_forward(self.model, self.data)

    def steps(self, count: int) -> None:
        if not self.helped:
            mujoco.mj_step(self.model, self.data, nstep=count)
            return
        for _ in range(count):
            self.lose()
            mujoco.mj_step(self.model, self.data)

    def lose(self) -> None:
        """Rolling resistance and the decay of spin by the report's laws."""
        data = self.data
        for number, ball in enumerate(self.balls):
            at, turn = 6 * number, 7 * number + 3
            place = data.qpos[turn - 3 : turn]
            # MuJoCo spins about axes that turn with the body; a ball looks the same turned back.
            spin = numpy.empty(3)
            mujoco.mju_rotVecQuat(spin, data.qvel[at + 3 : at + 6], data.qpos[turn : turn + 4])
            data.qpos[turn : turn + 4] = (1.0, 0.0, 0.0, 0.0)
            velocity = data.qvel[at : at + 3]
            data.qvel[at : at + 3], data.qvel[at + 3 : at + 6] = rolls(
                self.case, ball, place[2], velocity.tolist(), spin.tolist(), self.h
            )

    def positions(self) -> Positions:
        if self.balls[0].spring is None:
            return [tuple(row[:3]) for row in self.data.qpos.reshape(-1, 7).tolist()]
        anchors = (ball.spring[0] for ball in self.balls if ball.spring)
        offsets = self.data.qpos.reshape(-1, 3).tolist()
        return [
            tuple(a + b for a, b in zip(anchor, offset, strict=True))
            for anchor, offset in zip(anchors, offsets, strict=True)
        ]


def main() -> None:
    for case, limit_s in from_outside():
        if case.parts:
            say(cannot_express="it meets the convex hull of a mesh, not the mesh")
            continue
        if any(ball.spring for ball in case.starts[0]):
            for integrator in ("Euler", "RK4"):

                def free(balls: list[Ball], h: float, integrator: str = integrator) -> World:
                    return World(case, balls, h, helped=False, integrator=integrator)

                in_steps(case, integrator, free, limit_s)
            continue
        on_cloth = case.cloth is not None and case.cloth.friction > 0
        remark = "its own rolling friction brakes sliding balls too" if on_cloth else ""
        in_steps(
            case,
            "own rolling friction" if on_cloth else "",
            lambda balls, h: World(case, balls, h, helped=False),
            limit_s,
            remark,
        )
        if on_cloth and len(case.starts[0]) <= MOST_HELPED:
            in_steps(
                case,
                "helped",
                lambda balls, h: World(case, balls, h, helped=True),
                limit_s,
                "rolling resistance and the decay of spin are applied from outside, in Python",
            )


main()
