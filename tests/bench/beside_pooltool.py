"""The exact solver beside pooltool: the same shots, in turn, in one run.

    python tests/bench/beside_pooltool.py target/release/hapticbillard [SHOTS [ROUNDS]]

Needs pooltool 0.6: `pip install --no-deps -r tests/peers/requirements/pooltool.txt`. The program
draws the shots (`simulate --bench --json`: breaks of fifteen balls at 8 to 10 m/s, and two or three
balls at 0.5 to 5 m/s, until rest on its full mesh, flight included) and times them; pooltool starts
from the same positions, velocities and spins on a table of the same size, in the plane, with its
default models. Processor time of one thread, after pooltool has compiled itself. Rounds alternate;
only ratios within one run mean anything. Errors against run time, scene by scene: tests/peers.
"""

import json
import statistics
import subprocess
import sys
import time

import numpy
import pooltool
from pooltool.objects.table.specs import PocketTableSpecs

LENGTH_M, WIDTH_M = 2.54, 1.27
SLIDING = 2


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


def of_pooltool(shots):
    """Processor time [us] and events of each shot."""
    results = []
    for shot in shots:
        world = system(shot["balls"])
        begin = time.thread_time()
        pooltool.simulate(world, inplace=True)
        results.append(((time.thread_time() - begin) * 1e6, len(world.events)))
    return results


def main():
    program = sys.argv[1]
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    rounds = int(sys.argv[3]) if len(sys.argv) > 3 else 3
    # Every path of pooltool's code is compiled once, and not measured.
    groups, _ = of_the_program(program, count)
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


main()
