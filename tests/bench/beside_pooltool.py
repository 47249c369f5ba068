"""The exact solver beside pooltool: the same shots, in turn, in one run.

    python tests/bench/beside_pooltool.py target/release/hapticbillard [SHOTS [ROUNDS]]

Needs pooltool 0.6: `pip install --no-deps -r tests/peers/requirements/pooltool.txt`. The program
draws the shots (`simulate --bench --json`: breaks of fifteen balls at 8 to 10 m/s, and two or three
balls at 0.5 to 5 m/s, until rest on its full mesh, flight included) and times them; pooltool starts
from the same positions, velocities and spins on a table of the same size, in the plane, with its
default models. A last group is drawn and struck by pooltool on the table that it comes with, seven
feet long; the program goes on from there on its own seven-foot table. Processor time of one thread,
after pooltool has compiled itself. Rounds alternate; only ratios within one run mean anything.
Errors against run time, scene by scene: tests/peers.
"""

import json
import math
import pathlib
import random
import statistics
import subprocess
import sys
import tempfile
import time

import numpy
import pooltool
from pooltool.events import EventType
from pooltool.objects.table.specs import PocketTableSpecs

LENGTH_M, WIDTH_M = 2.54, 1.27
SLIDING = 2
RADIUS_M = 0.028575
SCENE = """
[scene]
name = "The table that pooltool comes with"
[table]
preset = "pool-7ft"
[physics]
"""


def of_the_program(program, shots):
    """Shots by group: balls, processor time [us], events; and the summary."""
    command = [program, "simulate", "--bench", str(shots), "--json"]
    output = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    lines = [json.loads(line) for line in output.splitlines()]
    groups = {}
    for line in lines[:-1]:
        groups.setdefault(line["group"], []).append(line)
    return groups, {group["group"]: group for group in lines[-1]["summary"]["groups"]}


def turned(vector):
    """Its x runs along the table, pooltool's y does."""
    x, y, z = vector
    return numpy.array([-y, x, z])


def system(balls):
    """The same balls in pooltool."""
    table = pooltool.Table.from_table_specs(PocketTableSpecs(l=LENGTH_M, w=WIDTH_M))
    made = {}
    for ball in balls:
        x, y, z = turned(ball["position_m"])
        name = "cue" if str(ball["id"]) == "0" else str(ball["id"])
        one = pooltool.Ball.create(name, xy=(x + WIDTH_M / 2, y + LENGTH_M / 2))
        if any(ball["velocity_m_s"]):
            one.state.rvw[1] = turned(ball["velocity_m_s"])
            one.state.rvw[2] = turned(ball["angular_velocity_rad_s"])
            one.state.s = SLIDING
        made[name] = one
    cue = pooltool.Cue(cue_ball_id="cue")
    return pooltool.System(cue=cue, table=table, balls=made)


def struck_by_pooltool(draw, count):
    """Shots of two or three balls on its own table, cut by up to 60 degrees at 0.5 to 5 m/s, the
    tip up to 0.3 radii off the middle."""
    shots = []
    while len(shots) < count:
        table = pooltool.Table.default()
        places, room = [], 2.5 * RADIUS_M
        wanted = draw.choice([2, 3])
        while len(places) < wanted:
            sides = (table.w - room, table.l - room)
            place = tuple(draw.uniform(room, side) for side in sides)
            if all(math.dist(place, other) > room for other in places):
                places.append(place)
        names = ["cue", "1", "2"]
        balls = {name: pooltool.Ball.create(name, xy=place) for name, place in zip(names, places)}
        world = pooltool.System(cue=pooltool.Cue(cue_ball_id="cue"), table=table, balls=balls)
        phi = pooltool.aim.at_ball(world, "1", cut=draw.uniform(-60, 60))
        tip = [draw.uniform(-0.3, 0.3) for _ in range(2)]
        world.strike(V0=draw.uniform(0.5, 5), phi=phi, a=tip[0], b=tip[1])
        shots.append(world)
    return shots


def line(world):
    """The balls of a shot that pooltool has played as the program reads them: just struck."""

    def ours(vector):
        return [float(vector[1]), float(-vector[0]), float(vector[2])]

    middle = numpy.array([world.table.w / 2, world.table.l / 2, 0.0])
    balls = []
    for number, name in enumerate(world.balls):
        place, velocity, spin = world.balls[name].history.states[0].rvw
        if name == "cue":
            blow = next(e for e in world.events if e.event_type == EventType.STICK_BALL)
            struck = next(agent for agent in blow.agents if agent.id == name)
            velocity, spin = struck.final.state.rvw[1:]
        ball = {"id": number, "position_m": ours(place - middle)}
        ball["position_m"][2] = RADIUS_M
        balls.append(ball | {"velocity_m_s": ours(velocity), "angular_velocity_rad_s": ours(spin)})
    return json.dumps({"balls": balls})


def beside_its_own(program, count, turn):
    """The group that pooltool draws."""
    worlds = struck_by_pooltool(random.Random(turn), count)
    theirs, events = zip(*played(worlds))
    with tempfile.TemporaryDirectory() as folder:
        scene, batch = pathlib.Path(folder, "scene.toml"), pathlib.Path(folder, "shots.jsonl")
        scene.write_text(SCENE)
        batch.write_text("".join(line(world) + "\n" for world in worlds))
        command = [program, "simulate", "--scene", scene, "--batch", batch, "--bench", "1"]
        command.append("--json")
        output = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    summary = json.loads(output.splitlines()[-1])["summary"]
    own, mean = summary["cpu_us_per_shot"], statistics.mean(theirs)
    print(
        f"round {turn}, struck by pooltool, {count} shots: {own['mean']:.1f} us a shot"
        f" ({summary['events_per_shot']:.0f} events);"
        f" pooltool {mean:.0f} us ({statistics.mean(events):.0f} events):"
        f" {mean / own['mean']:.0f} times as long"
        f" (of the medians {statistics.median(theirs) / own['median']:.0f});"
        f" fixed-step at 4 ms {summary['fixed_step']['ratio']:.1f} times as long",
        flush=True,
    )


def of_pooltool(shots):
    """Processor time [us] and events of each shot."""
    return played(system(shot["balls"]) for shot in shots)


def played(worlds):
    """Processor time [us] and events of each."""
    results = []
    for world in worlds:
        begin = time.thread_time()
        pooltool.simulate(world, inplace=True)
        results.append(((time.thread_time() - begin) * 1e6, len(world.events)))
    return results


def main():
    program = sys.argv[1]
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    rounds = int(sys.argv[3]) if len(sys.argv) > 3 else 3
    # Every path of pooltool's code is compiled once, and not measured.
    groups, _ = of_the_program(program, min(count, 20))
    for shots in groups.values():
        of_pooltool(shots)

    for turn in range(1, rounds + 1):
        groups, summary = of_the_program(program, count)
        for name, shots in groups.items():
            own = [shot["cpu_us"] for shot in shots]
            theirs, events = zip(*of_pooltool(shots))
            mean, their_mean = statistics.mean(own), statistics.mean(theirs)
            median, their_median = statistics.median(own), statistics.median(theirs)
            stepper = summary[name]["fixed_step"]["ratio"]
            print(
                f"round {turn}, {name}, {len(shots)} shots: {mean:.1f} us a shot"
                f" ({statistics.mean(shot['events'] for shot in shots):.0f} events);"
                f" pooltool {their_mean:.0f} us ({statistics.mean(events):.0f} events):"
                f" {their_mean / mean:.0f} times as long"
                f" (of the medians {their_median / median:.0f});"
                f" fixed-step at 4 ms {stepper:.1f} times as long",
                flush=True,
            )
        beside_its_own(program, count, turn)


main()
