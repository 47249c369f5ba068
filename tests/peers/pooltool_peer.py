"""The report's cases in pooltool, which goes from event to event and has no step.

Sliding, rolling and spinning have the report's laws and numbers, and so has the impact of two balls
in the plane. Cushions have laws of their own: every model that pooltool ships is run.
"""

from __future__ import annotations

import bisect
from collections.abc import Callable
from typing import Any

import numpy
import pooltool
from case import Ball, Case, Positions, from_outside, say, timed
from pooltool.events import EventType
from pooltool.objects.table.specs import BilliardTableSpecs
from pooltool.physics.engine import PhysicsEngine
from pooltool.physics.evolve import evolve_ball_motion
from pooltool.physics.resolve.ball_ball.friction import AverageBallBallFriction
from pooltool.physics.resolve.ball_ball.frictional_inelastic import FrictionalInelastic
from pooltool.physics.resolve.ball_ball.frictionless_elastic import FrictionlessElastic
from pooltool.physics.resolve.ball_cushion import ball_lcushion_models
from pooltool.physics.resolve.resolver import default_resolver

# A table without cushions in reach is so long and wide [m].
ENDLESS_M = 30.0
# Height of a cushion's nose over the diameter of a ball, as in the report.
NOSE = 0.635
# Pooltool wants friction and weight; so little friction changes nothing that can be told.
NO_FRICTION = 1e-14
SOME_GRAVITY_M_S2 = 9.81
RESTING, SLIDING = 0, 2
# More balls than this take minutes for each event.
MOST_BALLS = 100


def cannot(case: Case) -> str | None:
    """Why pooltool does not know what a case asks for."""
    if any(ball.spring for balls in case.starts for ball in balls):
        return "it has no springs"
    if case.parts:
        return "it has no meshes: a ball vanishes where it meets the circle of a pocket"
    if case.flies:
        return "its balls cannot leave the cloth"
    return None


def system(case: Case, balls: list[Ball]) -> pooltool.System:
    """The same balls in pooltool; its origin is a corner of the table."""
    width, length = case.bed_m or (ENDLESS_M, ENDLESS_M)
    radius = balls[0].radius_m
    table = pooltool.Table.from_table_specs(
        BilliardTableSpecs(l=length, w=width, cushion_height=2 * NOSE * radius)
    )
    cloth, cushion = case.cloth, case.cushion or case.ball
    gravity = case.gravity_m_s2 or SOME_GRAVITY_M_S2
    parameters = {
        "m": balls[0].mass_kg,
        "R": radius,
        "u_s": (cloth.friction if cloth else 0) or NO_FRICTION,
        "u_r": (case.rolling_resistance if cloth else 0) or NO_FRICTION,
        # Spin decays by 5/2 u_sp g / R, and u_sp is this times R.
        "u_sp_proportionality": case.spin_deceleration_rad_s2 / (2.5 * gravity),
        "u_b": case.ball.friction or NO_FRICTION,
        "e_b": case.ball.restitution,
        "e_c": cushion.restitution,
        "f_c": cushion.friction or NO_FRICTION,
        "g": gravity,
    }
    made = {}
    for number, ball in enumerate(balls):
        x, y, _ = ball.position_m
        one = pooltool.Ball.create(str(number), xy=(x + width / 2, y + length / 2), **parameters)
        if any(ball.velocity_m_s) or any(ball.angular_velocity_rad_s):
            one.state.rvw[1] = ball.velocity_m_s
            one.state.rvw[2] = ball.angular_velocity_rad_s
            one.state.s = SLIDING
        made[str(number)] = one
    return pooltool.System(cue=pooltool.Cue(cue_ball_id="0"), table=table, balls=made)


def engine(case: Case, model: str) -> PhysicsEngine:
    """The report's law between balls, and one of pooltool's for cushions."""
    resolver = default_resolver()
    ideal = case.ball.friction == 0 and case.ball.restitution == 1
    resolver.ball_ball = (
        FrictionlessElastic() if ideal else FrictionalInelastic(friction=AverageBallBallFriction())
    )
    resolver.ball_linear_cushion = {
        str(key): made for key, made in ball_lcushion_models.items()
    }[model]()
    return PhysicsEngine(resolver=resolver)


def positions(case: Case, balls: list[Ball], world: pooltool.System) -> list[Positions]:
    """Where the balls are at each look."""
    width, length = case.bed_m or (ENDLESS_M, ENDLESS_M)
    corner = numpy.array([width / 2, length / 2, 0.0])
    looks: list[Positions] = [[] for _ in case.looks_s]
    for number, start in enumerate(balls):
        ball = world.balls[str(number)]
        times = [state.t for state in ball.history]
        for look, at_s in zip(looks, case.looks_s, strict=True):
            state = ball.history[bisect.bisect_right(times, at_s) - 1]
            law = ball.params
            rvw, _ = evolve_ball_motion(
                state=state.s,
                rvw=state.rvw.copy(),
                R=law.R,
                m=law.m,
                u_s=law.u_s,
                u_sp=law.u_sp,
                u_r=law.u_r,
                g=law.g,
                t=at_s - state.t,
            )
            x, y, _ = (float(value) for value in rvw[0] - corner)
            # Its balls keep their height.
            look.append((x, y, start.position_m[2]))
    return looks


def run(case: Case, setting: str, model: str, remark: str) -> bool:
    """Runs every start with a model of cushions; says whether a ball met one."""
    met = False
    for number, balls in enumerate(case.starts):

        def prepared(balls: list[Ball] = balls) -> Callable[[], Any]:
            world, laws = system(case, balls), engine(case, model)
            return lambda: pooltool.simulate(
                world, engine=laws, inplace=True, t_final=case.until_s
            )

        # Once for the compiler.
        prepared()()
        world, times = timed(prepared)
        met |= any(event.event_type == EventType.BALL_LINEAR_CUSHION for event in world.events)
        say(
            setting=setting,
            step_ms=None,
            start=number,
            cpu_us_per_s=[took * 1e6 / case.until_s for took in times],
            looks_m=positions(case, balls, world),
            remark=remark,
        )
    return met


def main() -> None:
    for case, _ in from_outside():
        why = cannot(case)
        if why:
            say(cannot_express=why)
        elif len(case.starts[0]) > MOST_BALLS:
            say(setting="", step_ms=None, left_out="too dear: it asks every pair of balls")
        elif case.cushion is None:
            run(case, "", "unrealistic", "")
        else:
            for model in map(str, ball_lcushion_models):
                if not run(case, model, model, "the cushion's law is the one that is named"):
                    break


main()
