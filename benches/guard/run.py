#!/usr/bin/env python3
"""Count the instructions of twelve questions and compare them with the table beside this file.

``benches/guard/run.py [BINARY] [--write]``: BINARY is ``target/debug/voussoir``, what the tests build; the
table holds for it. Needs valgrind. Instructions are the same on a busy machine and a quiet one; another
compiler, and processors with other vector units, count otherwise. Exit code 1 where a question grew by more
than 3 %.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
TABLE = HERE / "instructions.csv"
GROWN = 0.03


def template(kind: str, **keys: object) -> dict:
    return {
        "format": "voussoir-scene/1",
        "joints": {"default": {"friction": 0.6}},
        "templates": [{kind: keys}],
        "loads": {"live": [{"weight": [1, 0, 0]}]},
    }


ARCH = template("arch", radius=5, thickness=0.8, depth=1, voussoirs=27)
ARCH_50 = template("arch", radius=5, thickness=0.8, depth=1, voussoirs=50)
WALL_4 = template("wall", size=[1, 0.5, 0.4], courses=4, blocks=4)
WALL = template("wall", size=[1, 0.5, 0.4], courses=10, blocks=10)
WALL_20 = template("wall", size=[1, 0.5, 0.4], courses=20, blocks=20)

# What is asked of what; a name is a scene of structures/.
QUESTIONS: dict[str, tuple[list[str], object]] = {
    "start": (["--version"], None),
    "assess arch 27": (["assess"], ARCH),
    "limit arch 27": (["limit"], ARCH),
    "limit arch 50": (["limit"], ARCH_50),
    "assess wall 10 x 10": (["assess"], WALL),
    "limit wall 4 x 4": (["limit"], WALL_4),
    "assess wall 20 x 20": (["assess"], WALL_20),
    "tilt column": (["tilt"], "column"),
    "thrust arch": (["thrust"], "semicircular-arch-thick"),
    "state block": (["state"], "block-on-bed"),
    "assess dome": (["assess"], "dome-with-oculus"),
    "check wall 10 x 10": (["check"], WALL),
}


def count(command: list[str]) -> int:
    """Instructions of a command."""
    with tempfile.TemporaryDirectory() as folder:
        run = subprocess.run(
            ["valgrind", "--tool=callgrind", f"--callgrind-out-file={folder}/out", *command],
            capture_output=True,
            text=True,
            env={**os.environ, "RAYON_NUM_THREADS": "1"},
        )
    found = re.search(r"Collected : (\d+)", run.stderr)
    # 2: the question was not asked at all.
    if found is None or run.returncode == 2:
        sys.exit(f"{' '.join(command)}: valgrind counted nothing:\n{run.stderr[-2000:]}")
    return int(found.group(1))


def counts(binary: Path) -> dict[str, int]:
    result = {}
    with tempfile.TemporaryDirectory() as folder:
        for name, (words, scene) in QUESTIONS.items():
            command = [str(binary), *words]
            if isinstance(scene, dict):
                file = Path(folder) / f"{len(result)}.json"
                file.write_text(json.dumps(scene))
                command.append(str(file))
            elif isinstance(scene, str):
                command.append(str(ROOT / "structures" / f"{scene}.json"))
            result[name] = count(command)
    return result


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n\n")[0])
    parser.add_argument("binary", nargs="?", type=Path, default=ROOT / "target/debug/voussoir")
    parser.add_argument("--write", action="store_true", help="make the counts the table")
    options = parser.parse_args()
    now = counts(options.binary.resolve())
    if options.write:
        with TABLE.open("w", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows([("question", "instructions"), *now.items()])
        return 0
    with TABLE.open(newline="") as file:
        known = {row["question"]: int(row["instructions"]) for row in csv.DictReader(file)}
    grown = []
    for name, number in now.items():
        before = known.get(name)
        change = "new" if before is None else f"{100 * (number / before - 1):+.1f} %"
        print(f"{name:22} {number / 1e6:10.1f} M  {change}")
        if before is not None and number > (1 + GROWN) * before:
            grown.append(name)
    if grown:
        print(f"grew by more than {100 * GROWN:.0f} %: {', '.join(grown)}")
    return 1 if grown else 0


if __name__ == "__main__":
    sys.exit(main())
