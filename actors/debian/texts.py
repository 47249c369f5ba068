"""The licence texts of all libraries that are linked into the program, each text once.

    python3 actors/debian/texts.py FILE

Their packages must have been fetched, as after a build. A package without a text of its own is named
with the licence that it states.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
TEXTS = ("licen", "copying", "copyright", "notice", "unlicense", "ofl")


def cargo(*arguments: str) -> str:
    done = subprocess.run(["cargo", *arguments], cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True)
    return done.stdout


def linked() -> set[tuple[str, str]]:
    """Name and version of each package that is linked."""
    tree = cargo("tree", "--locked", "--package", "hapticbillard-actors", "--edges",
                 "normal,no-proc-macro", "--prefix", "none", "--format", "{p}")
    named = (line.split(" ") for line in tree.splitlines())
    return {(name, version.removeprefix("v")) for name, version, *_ in named}


def texts_of(folder: Path) -> list[str]:
    files = [file for file in folder.rglob("*")
             if file.is_file() and file.name.lower().startswith(TEXTS) and file.suffix != ".rs"]
    return [file.read_text(encoding="utf-8", errors="replace").strip() for file in sorted(files)]


def main() -> None:
    wanted = linked()
    packages = json.loads(cargo("metadata", "--locked", "--format-version", "1"))["packages"]
    owners: dict[str, list[str]] = {}
    without = []
    for package in packages:
        name = f"{package['name']} {package['version']}"
        if (package["name"], package["version"]) not in wanted or package["source"] is None:
            continue
        texts = texts_of(Path(package["manifest_path"]).parent)
        for text in texts:
            owners.setdefault(text, []).append(name)
        if not texts:
            authors = ", ".join(package["authors"]) or "its authors"
            without.append(f"{name}: {package['license']}, by {authors}; {package['repository']}")
    with open(sys.argv[1], "w", encoding="utf-8") as out:
        out.write("Libraries that state a licence and ship no text of it:\n\n")
        out.writelines(f"  {line}\n" for line in sorted(without))
        for text, names in sorted(owners.items(), key=lambda item: item[1]):
            out.write(f"\n{'=' * 80}\n{', '.join(sorted(set(names)))}\n{'=' * 80}\n\n{text}\n")


if __name__ == "__main__":
    main()
