"""A case as `hapticbillard report --cases` writes it, and what every peer does with one.

A peer reads one case from standard input and prints a JSON line for each run (see README.md).
"""

from __future__ import annotations

import json
import math
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, Protocol

Vector = tuple[float, float, float]
Positions = list[Vector]

# A short run is repeated until it has taken so long in all [s], but not more often than this.
ENOUGH_S = 0.02
REPEATS_MAX = 5


@dataclass(frozen=True)
class Rub:
    """Newton's restitution and Coulomb's friction coefficient."""

    restitution: float
    friction: float


@dataclass(frozen=True)
class Ball:
    """A solid ball at the start, in SI units."""

    radius_m: float
    mass_kg: float
    position_m: Vector
    velocity_m_s: Vector
    angular_velocity_rad_s: Vector
    gravity: bool
    spring: tuple[Vector, float, float] | None  # anchor [m], stiffness [N/m], damping [N s/m]


@dataclass(frozen=True)
class Plane:
    """A half space."""

    surface: str
    point_m: Vector
    normal: Vector
    rub: Rub


@dataclass(frozen=True)
class Part:
    """The triangles of one kind of surface."""

    surface: str
    rub: Rub
    vertices_m: list[Vector]
    faces: list[tuple[int, int, int]]


@dataclass(frozen=True)
class Case:
    """A scene of the report in numbers."""

    scene: str
    until_s: float
    steps_ms: list[float]
    looks_s: list[float]
    gravity_m_s2: float
    ball: Rub
    rolling_resistance: float
    spin_deceleration_rad_s2: float
    bed_m: tuple[float, float] | None
    planes: list[Plane]
    parts: list[Part]
    starts: list[list[Ball]]

    @property
    def cloth(self) -> Rub | None:
        """What balls lie on, if there is a cloth."""
        grounds = [*self.planes, *self.parts]
        return next((ground.rub for ground in grounds if ground.surface == "cloth"), None)

    @property
    def cushion(self) -> Rub | None:
        """What balls run into, if there are cushions."""
        grounds = [*self.planes, *self.parts]
        return next((ground.rub for ground in grounds if ground.surface == "cushion"), None)

    @property
    def flies(self) -> bool:
        """Whether a ball is off the cloth, or leaves it, at the start."""
        return any(
            ball.velocity_m_s[2] > 0 or ball.position_m[2] > ball.radius_m + 1e-9
            for balls in self.starts
            for ball in balls
        )


def parse(line: str) -> Case:
    """The case in a line of the export."""
    data: dict[str, Any] = json.loads(line)
    law, ground = data["law"], data["ground"]

    def rubbed(made: Any, fields: dict[str, Any]) -> Any:
        return made(**{**fields, "rub": Rub(**fields["rub"])})

    return Case(
        scene=data["scene"],
        until_s=data["until_s"],
        steps_ms=data["steps_ms"],
        looks_s=data["looks_s"],
        gravity_m_s2=law["gravity_m_s2"],
        ball=Rub(**law["ball"]),
        rolling_resistance=law["rolling_resistance"],
        spin_deceleration_rad_s2=law["spin_deceleration_rad_s2"],
        bed_m=ground["bed_m"],
        planes=[rubbed(Plane, plane) for plane in ground["planes"]],
        parts=[rubbed(Part, part) for part in ground["parts"]],
        starts=[[Ball(**ball) for ball in start["balls"]] for start in data["starts"]],
    )


def say(**fields: Any) -> None:
    """Prints a line for the script that started this program."""
    print(json.dumps(fields), flush=True)


class World(Protocol):
    """A world that is moved in steps."""

    def steps(self, count: int) -> None:
        """Moves it by so many steps."""

    def positions(self) -> Positions:
        """Where the balls are, in the order of the case."""


def looks(case: Case, world: World, h: float) -> list[Positions]:
    """Where the balls are at each look; between two steps they go straight."""
    done, before = 0, world.positions()
    after, seen = before, []
    for at_s in case.looks_s:
        wanted = math.ceil(at_s / h - 1e-6)
        if wanted > done:
            if wanted - 1 > done:
                world.steps(wanted - 1 - done)
            before = world.positions()
            world.steps(1)
            after, done = world.positions(), wanted
        part = 1.0 - (done - at_s / h)
        seen.append(
            [
                tuple(a + part * (b - a) for a, b in zip(one, other, strict=True))
                for one, other in zip(before, after, strict=True)
            ]
        )
    return seen


# A centre this close to its place on cloth rolls on it [m]; engines let balls sink.
ON_CLOTH_M = 3e-3


def rolls(
    case: Case, ball: Ball, height_m: float, velocity: Vector, spin: Vector, h: float
) -> tuple[Vector, Vector]:
    """Velocity and spin after what cloth takes from them in a step, for engines without that law.

    A ball whose slip friction can stop in a step rolls; friction slows slip by 7/2 mu g.
    """
    if case.cloth is None or abs(height_m - ball.radius_m) > ON_CLOTH_M:
        return velocity, spin
    (x, y, z), (a, b, c) = velocity, spin
    radius, gravity = ball.radius_m, case.gravity_m_s2
    slip, speed = math.hypot(x - radius * b, y + radius * a), math.hypot(x, y)
    if slip < 3.5 * case.cloth.friction * gravity * h and speed > 0:
        kept = max(0.0, 1.0 - case.rolling_resistance * gravity * h / speed)
        x, y, a, b = kept * x, kept * y, kept * a, kept * b
    c = math.copysign(max(0.0, abs(c) - case.spin_deceleration_rad_s2 * h), c)
    return (x, y, z), (a, b, c)


def timed(run: Callable[[], Callable[[], Any]]) -> tuple[Any, list[float]]:
    """The result of a run and its processor times [s]. `run` prepares; what it returns is timed."""
    times: list[float] = []
    while True:
        go = run()
        begin = time.process_time()
        result = go()
        times.append(time.process_time() - begin)
        if sum(times) > ENOUGH_S or len(times) == REPEATS_MAX:
            return result, times


def in_steps(
    case: Case,
    setting: str,
    make: Callable[[list[Ball], float], World],
    limit_s: float,
    remark: str = "",
) -> None:
    """Runs every step of a case, the coarsest first, until a run would take too long."""
    costs_s, last_ms = 0.0, math.inf
    for step_ms in case.steps_ms:
        if costs_s * last_ms / step_ms > limit_s:
            say(setting=setting, step_ms=step_ms, left_out="too dear")
            continue
        costs_s, last_ms = 0.0, step_ms
        for number, balls in enumerate(case.starts):

            def run(balls: list[Ball] = balls, h: float = step_ms * 1e-3) -> Callable[[], Any]:
                world = make(balls, h)
                return lambda: looks(case, world, h)

            seen, times = timed(run)
            costs_s = max(costs_s, *times)
            say(
                setting=setting,
                step_ms=step_ms,
                start=number,
                cpu_us_per_s=[took * 1e6 / case.until_s for took in times],
                looks_m=seen,
                remark=remark,
            )


def from_outside() -> Iterator[tuple[Case, float]]:
    """The cases on standard input, and how long a run of one start may take [s]."""
    limit_s = float(sys.argv[1])
    for line in sys.stdin:
        yield parse(line), limit_s
