#!/usr/bin/env python3
"""What every direct dependency costs to build, from the page that `cargo build --timings` writes.

usage: dependency-costs.py target/cargo-timings/cargo-timing.html

For each: seconds of its own units, and with all that would not be there without it. Seconds are those during
which a unit was being compiled, two of them at a time on two cores.
"""

import json
import re
import subprocess
import sys

page = open(sys.argv[1]).read()
units = json.loads(re.search(r"const UNIT_DATA = (\[.*?\]);", page, re.S).group(1))
seconds = {}
for unit in units:
    key = (unit["name"], unit["version"])
    seconds[key] = seconds.get(key, 0) + unit["duration"]
command = ["cargo", "metadata", "--format-version", "1", "--locked"]
data = json.loads(subprocess.check_output(command))
package = {p["id"]: (p["name"], p["version"]) for p in data["packages"]}
needs = {
    node["id"]: [d["pkg"] for d in node["deps"] if any(k["kind"] != "dev" for k in d["dep_kinds"])]
    for node in data["resolve"]["nodes"]
}
ours = {p for p in data["workspace_members"] if package[p][0] not in ("voussoir-python", "features")}


def reached(without):
    seen, waiting = set(), list(ours)
    while waiting:
        here = waiting.pop()
        for there in needs[here]:
            if there not in seen and there != without:
                seen.add(there)
                waiting.append(there)
    return seen


def total(ids):
    return sum(seconds.get(key, 0) for key in {package[i] for i in ids})


everything = reached(None)
direct = {d for o in ours for d in needs[o] if d not in ours}
rows = []
for d in direct:
    users = sorted(package[o][0].removeprefix("voussoir-") for o in ours if d in needs[o])
    alone = total(everything - reached(d))
    rows.append((alone, seconds.get(package[d], 0), package[d][0], ", ".join(users)))
print("| dependency | own, s | with what comes with it, s | used by |\n|---|---|---|---|")
for alone, own, name, users in sorted(rows, reverse=True):
    print(f"| {name} | {own:.1f} | {alone:.1f} | {users} |")
print(f"\nall dependencies {total(everything - ours):.0f} s, the house {total(ours):.0f} s")
