"""What each feature adds: size of the program, crates, cold starts, memory.

    python3 tests/builds/run.py [--out tests/report/builds.json] [--build none all]

Needs Python 3.9, Rust and a Unix. Builds the program in release with each set of features, strips a
copy, counts the crates that are linked, and runs it. `hapticbillard report --builds FILE` prints the
result in its chapter of what is left out. Building takes most of an hour on a slow machine the first
time; nothing else should run beside the last minute.

A cold start is a process from its beginning to its end: `replay` of a recording that holds nothing but
its header makes the table, the simulation, the referee, both players and all actors, and quits before
the first tick; `simulate` of one ball runs it until it rests. Times are the medians of 20.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import statistics
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
TARGET = ROOT / "target"
PACKAGE = "hapticbillard-actors"
STARTS = 20
GAMES = 5
# What is built, by its name in the report. The last are the default features.
FEATURES = [
    ("none", []),
    ("renderer", ["renderer"]),
    ("sound", ["sound"]),
    ("rtkit", ["rtkit"]),
    ("gamepad", ["gamepad"]),
    ("all", ["gamepad", "renderer", "sound", "rtkit"]),
]


def cargo(*arguments: str) -> str:
    done = subprocess.run(["cargo", *arguments], cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True)
    return done.stdout


def crates(features: list[str]) -> int:
    """Packages that are linked into the program, those of the project included."""
    tree = cargo("tree", "--locked", "--package", PACKAGE, "--no-default-features", "--features",
                 ",".join(features), "--edges", "normal,no-proc-macro", "--prefix", "none",
                 "--format", "{p}")
    return len({line.removesuffix(" (*)") for line in tree.splitlines()})


def build(name: str, features: list[str]) -> Path:
    cargo("build", "--release", "--locked", "--package", PACKAGE, "--no-default-features",
          "--features", ",".join(features))
    program = TARGET / "builds" / f"hapticbillard-{name}"
    program.parent.mkdir(parents=True, exist_ok=True)
    shutil.copy(TARGET / "release" / "hapticbillard", program)
    subprocess.run(["strip", program], check=True)
    return program


def run(command: list[str]) -> tuple[float, float, int]:
    """Its user time and whole processor time [ms], and the most memory that it had [KiB].

    It begins as a copy of this script, so that less than some 15 MiB of memory is not told apart.
    """
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                             stdin=subprocess.DEVNULL)
    _, status, used = os.wait4(child.pid, 0)
    # Popen would wait for it once more.
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        raise SystemExit(f"{command} ended with {child.returncode}")
    return used.ru_utime * 1e3, (used.ru_utime + used.ru_stime) * 1e3, used.ru_maxrss


def header(program: Path) -> Path:
    """A recording of the headless game that ends before its first tick."""
    folder = TARGET / "builds" / "recordings"
    shutil.rmtree(folder, ignore_errors=True)
    subprocess.run([program, "match", "--games", "1", "--record", folder], check=True,
                   stdout=subprocess.DEVNULL)
    whole = next(folder.iterdir())
    file = TARGET / "builds" / "header.jsonl"
    with open(whole, encoding="utf-8") as lines:
        file.write_text(lines.readline(), encoding="utf-8")
    return file


def medians(command: list[str], times: int) -> dict:
    runs = [run(command) for _ in range(times)]
    user, whole, memory = (statistics.median(column) for column in zip(*runs))
    return {"user_ms": round(user, 1), "cpu_ms": round(whole, 1), "peak_kib": int(memory)}


def measure(program: Path) -> dict:
    return {
        "bytes": program.stat().st_size,
        "headless_start": medians([program, "replay", header(program)], STARTS),
        "one_ball": medians([program, "simulate", "--scene", "one_ball"], STARTS),
        "game": medians([program, "match", "--games", "1"], GAMES),
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=ROOT / "tests" / "report" / "builds.json")
    names = [name for name, _ in FEATURES]
    parser.add_argument("--build", nargs="+", choices=names, default=names,
                        help="build and run only these; of the others crates are counted")
    arguments = parser.parse_args()
    out = arguments.out
    # Built first: nothing is measured beside a compiler.
    programs = {name: build(name, features) for name, features in FEATURES
                if name in arguments.build}
    builds = [{"features": name, "crates": crates(features),
               "program": measure(programs[name]) if name in programs else None}
              for name, features in FEATURES]
    text = json.dumps({"starts": STARTS, "builds": builds}, indent=1)
    draft = out.with_suffix(".part")
    draft.write_text(text + "\n", encoding="utf-8")
    draft.replace(out)
    print(text)


if __name__ == "__main__":
    main()
