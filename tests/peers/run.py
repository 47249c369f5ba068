"""Other programs on the report's cases, measured in one run with the report.

    python3 tests/peers/run.py [--quick] [--only SCENE ...] [--programs NAME ...]

Needs Python 3.11 and Rust. Everything is built, installed and written under target/peers: the
results to peers.json, the report with them to report/REPORT.md. What cannot be installed or built
is said so in the results. See README.md.
"""

from __future__ import annotations

import argparse
import datetime
import json
import math
import os
import platform
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
TARGET = ROOT / "target" / "peers"
VENV = TARGET / "venv"
PYTHON = VENV / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
RAPIER = TARGET / "rapier" / "release" / "rapier-peer"
PROGRAM = ROOT / "target" / "release" / "hapticbillard"

# A finer step is left out if a run of one start would take longer [s]: in a quick run, and else.
LIMIT_S = {True: 0.2, False: 1.0}
# No program gets longer for a scene [s]: in a quick run, and else.
PATIENCE_S = {True: 300.0, False: 900.0}
# A ball farther away has flown apart [m]; the report's own limit.
FAR_M = 1e4


@dataclass(frozen=True)
class Peer:
    """Another program."""

    name: str
    package: str | None  # on PyPI; None for rapier, which is built here
    about: str


PEERS = [
    Peer(
        "pooltool",
        "pooltool-billiards",
        "From event to event, in Python with compiled parts; its compiler runs before the clock. "
        "Sliding, rolling, spinning and the impact of two free balls are the report's laws. In an "
        "impact the cloth does not bear the balls, several balls at once are taken in pairs, and "
        "cushions have laws of their own: all that it ships are run.",
    ),
    Peer(
        "rapier",
        None,
        "Rigid bodies in steps, in Rust: length unit 5 cm, 8 iterations, Coulomb friction, ground "
        "as stiff as the step allows. Friction at an impact does not feel the "
        "rebound. Rolling resistance and the decay of spin are applied from outside.",
    ),
    Peer(
        "MuJoCo",
        "mujoco",
        "Soft contacts in steps, in C: springs that part after 6 steps, damped for the restitution "
        "that is asked for; elliptic friction cone. Its law of friction lifts sliding balls a "
        "little off the cloth.",
    ),
    Peer(
        "PyBullet",
        "pybullet",
        "Rigid bodies in steps, in C++, each step called from Python: double precision, 50 "
        "iterations, cone friction, no damping, impacts above 1 mm/s bounce.",
    ),
]


def last_line(text: str | None) -> str:
    lines = [line.strip() for line in (text or "").splitlines() if line.strip()]
    return lines[-1][:300] if lines else "no message"


def attempt(command: list[str | Path], **options: Any) -> str | None:
    """Runs a command; what it says last if it fails."""
    done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT, **options)
    errors = [line for line in done.stderr.splitlines() if line.lower().startswith("error")]
    return None if done.returncode == 0 else last_line(errors[0] if errors else done.stderr)


def install(peer: Peer) -> str | None:
    """Installs or builds a program; why it cannot be."""
    print(f"installing {peer.name}", flush=True)
    if peer.package is None:
        manifest, target = HERE / "rapier" / "Cargo.toml", TARGET / "rapier"
        command = ["cargo", "build", "--quiet", "--release", "--locked"]
        problem = attempt([*command, "--manifest-path", manifest, "--target-dir", target])
    else:
        needs = HERE / "requirements" / f"{peer.name.lower()}.txt"
        pip = [PYTHON, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
        problem = attempt([*pip, "--no-deps", "--requirement", needs])
        module = peer.name.lower()
        problem = problem or attempt([PYTHON, "-c", f"import {module}"], env=environment())
    return problem and f"did not install: {problem}"


def version(peer: Peer) -> str:
    if peer.package is None:
        lines = (HERE / "rapier" / "Cargo.toml").read_text().splitlines()
        return next(line.split('"')[1].lstrip("=") for line in lines if line.startswith("rapier3d"))
    code = f"import importlib.metadata as m; print(m.version({peer.package!r}))"
    done = subprocess.run([PYTHON, "-c", code], check=True, capture_output=True, text=True)
    return done.stdout.strip()


def environment() -> dict[str, str]:
    """One thread, the same order of sets in every process, and settings kept out of the home."""
    home = TARGET / "home"
    home.mkdir(parents=True, exist_ok=True)
    fixed = {"OMP_NUM_THREADS": "1", "PYTHONHASHSEED": "0", "HOME": str(home)}
    return {**os.environ, **fixed, "XDG_CONFIG_HOME": str(home / "config")}


def run(peer: Peer, line: str, quick: bool) -> tuple[list[dict[str, Any]], str | None]:
    """What a program prints for a case, and how it broke off if it did."""
    script = [PYTHON, HERE / f"{peer.name.lower()}_peer.py"] if peer.package else [RAPIER]
    command = [*script, str(LIMIT_S[quick])]
    problem: str | None = None
    try:
        done = subprocess.run(
            command,
            input=line,
            capture_output=True,
            text=True,
            env=environment(),
            cwd=TARGET,
            timeout=PATIENCE_S[quick],
        )
        text = done.stdout
        if done.returncode != 0:
            problem = f"ended with {done.returncode}: {last_line(done.stderr)}"
    except subprocess.TimeoutExpired as late:
        text = (late.stdout or b"").decode()
        problem = f"was stopped after {PATIENCE_S[quick]:.0f} s of a scene"
    answers = []
    for answer in text.splitlines():
        try:
            answers.append(json.loads(answer))
        except json.JSONDecodeError:
            continue  # a banner, or a line that was cut off
    return [answer for answer in answers if isinstance(answer, dict)], problem


def error_m(case: dict[str, Any], answer: dict[str, Any]) -> tuple[float, float | None]:
    """The error of a run by the report's norm, and when a ball flew apart if one did [s]."""
    worst = 0.0
    truth = case["starts"][answer["start"]]["truth_m"]
    for at_s, places, wanted in zip(case["looks_s"], answer["looks_m"], truth, strict=True):
        if not all(x is not None and abs(x) < FAR_M for place in places for x in place):
            return math.inf, at_s
        apart = [math.dist(one, other) for one, other in zip(places, wanted, strict=True)]
        if case["norm"] == "worst":
            worst = max(worst, *apart)
        else:
            worst = max(worst, math.sqrt(sum(off * off for off in apart) / len(apart)))
    return worst, None


def rows(case: dict[str, Any], peer: Peer, answers: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """A row for each setting and step."""
    grouped: dict[tuple[str, float | None], list[dict[str, Any]]] = {}
    for answer in answers:
        key = (answer.get("setting", ""), answer.get("step_ms"))
        grouped.setdefault(key, []).append(answer)
    made = []
    for (setting, step_ms), runs in grouped.items():
        row = {
            "scene": case["scene"],
            "digest": case["digest"],
            "program": peer.name,
            "setting": setting,
            "step_ms": step_ms,
            "starts": 0,
            "error_m": None,
            "cpu_us_per_s": None,
            "status": "ok",
            "remark": runs[0].get("remark", ""),
        }
        made.append(row)
        for word, status in (("cannot_express", "cannot_express"), ("left_out", "left_out")):
            if word in runs[0]:
                row.update(status=status, remark=runs[0][word])
        if row["status"] != "ok":
            continue
        judged = [error_m(case, answer) for answer in runs]
        row["starts"] = len(runs)
        errors = sorted(error for error, apart in judged if apart is None)
        times = sorted(time for answer in runs for time in answer["cpu_us_per_s"])
        row["error_m"] = errors[len(errors) // 2] if errors else None
        row["cpu_us_per_s"] = [times[len(times) // 2], times[0], times[-1]]
        apart = [at_s for _, at_s in judged if at_s is not None]
        if apart:
            remark = f"at {apart[0]:.4f} s: diverged: a ball is not within {FAR_M:.0f} m"
            row.update(status="failed", remark=remark)
        elif len(runs) < len(case["starts"]):
            remark = f"only {len(runs)} of {len(case['starts'])} starts were run"
            row.update(status="failed", remark=remark)
    return made


def broken(case: dict[str, Any], peer: Peer, problem: str) -> dict[str, Any]:
    """The row of a program that broke off."""
    return {
        "scene": case["scene"],
        "digest": case["digest"],
        "program": peer.name,
        "setting": "",
        "step_ms": None,
        "starts": 0,
        "error_m": None,
        "cpu_us_per_s": None,
        "status": "failed",
        "remark": problem,
    }


def processor() -> str:
    info = Path("/proc/cpuinfo")
    lines = info.read_text().splitlines() if info.exists() else []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()


def results(
    cases: Path, peers: list[Peer], problems: dict[str, str | None], quick: bool
) -> dict[str, Any]:
    """What every program makes of every case."""
    made: list[dict[str, Any]] = []
    for line in cases.read_text().splitlines():
        case = json.loads(line)
        for peer in peers:
            if problems[peer.name]:
                continue
            answers, problem = run(peer, line + "\n", quick)
            made += rows(case, peer, answers)
            if problem or not answers:
                made.append(broken(case, peer, problem or "it printed nothing"))
            print(f"{case['scene']}: {peer.name}, {len(answers)} runs {problem or ''}", flush=True)
    date = datetime.date.today().isoformat()
    return {
        "made": f"{date}, {processor()}, Python {platform.python_version()}",
        "programs": [
            {
                "name": peer.name,
                "version": None if problems[peer.name] else version(peer),
                "about": peer.about,
                "problem": problems[peer.name],
            }
            for peer in peers
        ],
        "rows": made,
    }


def write(file: Path, made: dict[str, Any]) -> None:
    """Writes a line for each row, whole or not at all."""
    rows = ",\n".join("  " + json.dumps(row, allow_nan=False) for row in made["rows"])
    head = json.dumps({key: made[key] for key in ("made", "programs")}, indent=1)
    draft = file.with_suffix(".part")
    draft.write_text(f'{head[:-2]},\n "rows": [\n{rows}\n ]\n}}\n')
    draft.replace(file)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="fewer starts and coarser steps")
    parser.add_argument("--only", nargs="+", metavar="SCENE", help="only these scenes")
    parser.add_argument("--programs", nargs="+", metavar="NAME", help="only these programs")
    wanted = parser.parse_args()
    peers = [peer for peer in PEERS if not wanted.programs or peer.name in wanted.programs]
    if wanted.programs and len(peers) < len(set(wanted.programs)):
        parser.error(f"--programs: write {', '.join(peer.name for peer in PEERS)}")
    TARGET.mkdir(parents=True, exist_ok=True)

    print("building the report", flush=True)
    build = ["cargo", "build", "--quiet", "--release", "--locked"]
    build += ["--package", "hapticbillard-actors", "--bin", "hapticbillard"]
    subprocess.run(build, check=True, cwd=ROOT)
    if not PYTHON.exists():
        subprocess.run([sys.executable, "-m", "venv", VENV], check=True)
    problems = {peer.name: install(peer) for peer in peers}

    flags = ["--quick"] * wanted.quick + (["--only", *wanted.only] if wanted.only else [])
    cases = TARGET / "cases.jsonl"
    subprocess.run([PROGRAM, "report", "--cases", cases, *flags], check=True, cwd=ROOT)
    file = TARGET / "peers.json"
    write(file, results(cases, peers, problems, wanted.quick))
    report = [PROGRAM, "report", "--out", TARGET / "report", "--peers", file, *flags]
    subprocess.run(report, check=True, cwd=ROOT)


if __name__ == "__main__":
    main()
