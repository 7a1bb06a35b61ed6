"""Times voussoir and the peers on the same scenes, side by side, and writes the table.

    python run.py --voussoir ../../target/release/voussoir --out ../../docs/peers

Every run is a process of its own on one thread; the medians of `--repeat` runs count (one run where it takes longer than 20 s).
Tools take turns within a repetition, so that a slow moment of the machine meets all of them.
"""

import argparse
import csv
import json
import os
import platform
import statistics
import subprocess
import sys
import tempfile
from importlib.metadata import version
from pathlib import Path
from time import perf_counter

from model import load
from peers import PEERS
from reference import reference

HERE = Path(__file__).resolve().parent
PUSH = {"live": [{"weight": [1, 0, 0]}]}
SCENES = {
    **{
        f"arch-{n}": (["arch", "radius=5", "thickness=0.8", "depth=1", f"voussoirs={n}", "--friction", "0.7"], f"semicircular arch of {n} voussoirs")
        for n in (20, 100, 400)
    },
    **{
        f"wall-{n}": (["wall", "size=[1,0.5,0.4]", f"courses={n}", f"blocks={n}", "first=half", "base=course", "--friction", "0.6"],
                      f"wall of {n} × {n} blocks pushed in its plane")
        for n in (10, 20, 40)
    },
}
LONG = 20.0
ONE_THREAD = {k: "1" for k in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "RAYON_NUM_THREADS")}
VERDICTS = {"voussoir-verdict": "voussoir assess --law associative", "voussoir-coulomb": "voussoir assess (dry friction)"}
COLUMNS = ["scene", "tool", "cone", "load_factor", "error", "process", "read", "build", "solve", "runs", "word"]


def timed(command, limit):
    """(seconds, standard output), or what stopped it."""
    start = perf_counter()
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=limit, env={**os.environ, **ONE_THREAD}, cwd=HERE)
    except subprocess.TimeoutExpired:
        return None, f"not done after {limit:g} s"
    seconds = perf_counter() - start
    if done.returncode not in (0, 1) or not done.stdout:
        last = (done.stderr.strip().splitlines() or [""])[-1]
        return None, f"failed ({done.returncode}): {last[:100]}"
    return seconds, done.stdout


def voussoir(program, scene, tool, limit):
    """One run of voussoir: whole process with the proof printed, stages from its own result."""
    verb = {"voussoir": ["limit", scene, "--law", "associative", "--skip-dead"], "voussoir-verdict": ["assess", scene, "--law", "associative"],
            "voussoir-coulomb": ["assess", scene]}[tool]
    seconds, text = timed([program, *verb, "--json"], limit)
    if seconds is None:
        return {"word": text}
    result = json.loads(text)
    stages = result["timings"]
    engine = sum(a["seconds"] for a in result["trace"])
    rest = stages["resolve"] + stages["detect"] + max(stages["solve"] - engine, 0.0) + stages["check"]
    answer = result["answer"]
    found = answer.get("load_factor", {})
    word = found.get("status") or {"stable": "stands"}.get(answer["verdict"], answer["verdict"])
    ends = (found.get("lower"), found.get("upper"))
    if tool == "voussoir-coulomb":
        # Its fixed points are no attempts of the trace.
        rest, engine = stages["resolve"] + stages["detect"] + stages["check"], stages["solve"]
    return {"value": found.get("value"), "ends": ends, "process": seconds, "read": stages["read"], "build": rest, "solve": engine, "word": word}


def peer(name, model, limit):
    """One run of a peer."""
    seconds, text = timed([sys.executable, str(HERE / "one.py"), name, model], limit)
    if seconds is None:
        return {"word": text}
    return {"process": seconds, **json.loads(text.strip().splitlines()[-1])}


def measure(program, scene, model, tools, repeat, limit):
    """Median run of each tool."""
    runs = {tool: [] for tool in tools}
    for _ in range(repeat):
        for tool in tools:
            earlier = runs[tool]
            if earlier and (earlier[0].get("process") is None or earlier[0]["process"] > LONG):
                continue
            own = tool.startswith("voussoir")
            runs[tool].append(voussoir(program, scene, tool, limit) if own else peer(tool, model, limit))
    medians = {}
    for tool, list_ in runs.items():
        middle = dict(list_[0])
        for key in ("process", "read", "build", "solve"):
            if key in middle:
                middle[key] = statistics.median(run[key] for run in list_)
        medians[tool] = {**middle, "runs": len(list_)}
    return medians


def shown(seconds):
    """Seconds with three digits."""
    if seconds is None:
        return "–"
    return f"{seconds * 1e3:.3g} ms" if seconds < 0.9995 else f"{seconds:.3g} s"


def ratio(other, own):
    """How many times as long."""
    return "–" if other is None else f"{other / own:.3g}"


def rows_of(scene, truth, medians):
    """What the CSV file holds."""
    for tool, run in medians.items():
        cone = "second-order" if tool.startswith("voussoir") else PEERS[tool][1]
        value = run.get("value")
        error = None if value is None or truth is None else abs(value - truth) / truth
        yield dict(scene=scene, tool=tool, cone=cone, load_factor=value, error=error, process=run.get("process"), read=run.get("read"),
                   build=run.get("build"), solve=run.get("solve"), runs=run["runs"], word=run["word"])


def markdown(rows, own):
    """One table: a line a tool, ratios to voussoir's line."""
    yield "| tool | cone | λ | error | process | build | solve | process ÷ voussoir | solve ÷ voussoir |"
    yield "|---|---|---|---|---|---|---|---|---|"
    for row in rows:
        value = row["word"] if row["load_factor"] is None else f"{row['load_factor']:.10f}"
        error = "–" if row["error"] is None else f"{row['error']:.1e}"
        cells = [row["tool"], row["cone"], value, error, shown(row["process"]), shown(row["build"]), shown(row["solve"]),
                 ratio(row["process"], own["process"]), ratio(row["solve"], own["solve"])]
        yield "| " + " | ".join(cells) + " |"


def judged(rows, own):
    """Where a peer takes less time, in words."""
    for row in rows:
        if row is own or row["process"] is None:
            continue
        total = lambda r: r["build"] + r["solve"]
        faster = [what for what, mine, theirs in (("the whole process", own["process"], row["process"]), ("solving", own["solve"], row["solve"]),
                                                  ("building and solving", total(own), total(row))) if theirs < mine]
        if faster and row["error"] is not None:
            worse = row["error"] > own["error"]
            kind = f"at an error {row['error'] / own['error']:.2g} times as large" if worse else "at an equal or better error"
            by = f"{own['solve'] / row['solve']:.2f} in solving, {total(own) / total(row):.2f} in building and solving"
            yield f"* `{row['scene']}`, `{row['tool']}`: faster in {' and '.join(faster)} (by factors of {by}) {kind}."


def machine():
    """What it ran on."""
    lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines() if Path("/proc/cpuinfo").exists() else []
    name = next((l.split(":", 1)[1].strip() for l in lines if l.startswith("model name")), platform.processor())
    return f"{name}, {os.cpu_count()} processors, {platform.system()} {platform.release()}, Python {platform.python_version()}"


def main():
    """Everything."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--voussoir", default=str(HERE / "../../target/release/voussoir"))
    parser.add_argument("--out", default=str(HERE / "../../docs/peers"), help="table.md and table.csv go there")
    parser.add_argument("--scenes", nargs="*", default=list(SCENES), choices=list(SCENES))
    parser.add_argument("--peers", nargs="*", default=list(PEERS), choices=list(PEERS))
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--limit", type=float, default=120.0, help="seconds after which a run is given up")
    args = parser.parse_args()
    program, out = str(Path(args.voussoir).resolve()), Path(args.out)
    out.mkdir(parents=True, exist_ok=True)
    factors = ["voussoir", *(p for p in args.peers if not p.endswith("verdict"))]
    verdicts = [*VERDICTS, *(p for p in args.peers if p.endswith("verdict"))]
    everything, text, faster = [], [], []
    loads = [os.getloadavg()[0]]
    with tempfile.TemporaryDirectory() as folder:
        for name in args.scenes:
            template, title = SCENES[name]
            scene, model = str(Path(folder, f"{name}.json")), str(Path(folder, f"{name}.model.json"))
            made = json.loads(subprocess.run([program, "generate", *template], check=True, capture_output=True, text=True).stdout)
            Path(scene).write_text(json.dumps({**made, "loads": PUSH}), encoding="utf-8")
            Path(model).write_text(subprocess.run([program, "check", scene, "--json"], check=True, capture_output=True, text=True).stdout)
            truth, outside, wrong = reference(load(model))
            medians = measure(program, scene, model, factors, args.repeat, args.limit)
            ends = medians["voussoir"].get("ends") or (None, None)
            rows = list(rows_of(name, truth, medians))
            decided = list(rows_of(name, None, measure(program, scene, model, verdicts, args.repeat, args.limit)))
            loads.append(os.getloadavg()[0])
            everything += rows + decided
            faster += judged(rows, rows[0])
            text += [f"### {title[0].upper()}{title[1:]}", "", f"Reference λ = {truth:.13f} (forces outside their cones by {outside:.0e} block weights, multipliers by {wrong:.0e}); "
                     f"voussoir's certified bracket [{ends[0]:.12f}, {ends[1]:.12f}].", "", *markdown(rows, rows[0]), "",
                     "Verdict under dead load alone:", "", *markdown(decided, decided[0]), ""]
            print("\n".join(text[-len(rows) - len(decided) - 11:]), flush=True)
            with open(out / "table.csv", "w", newline="", encoding="utf-8") as file:
                writer = csv.DictWriter(file, COLUMNS)
                writer.writeheader()
                writer.writerows(everything)
    packages = ", ".join(f"{p} {version(p)}" for p in ("cvxpy", "clarabel", "ecos", "scs", "highspy", "compas_cra", "numpy", "scipy"))
    own = subprocess.run([program, "--version"], check=True, capture_output=True, text=True).stdout.strip()
    judgement = faster or ["* No peer took less time than voussoir in any of the three."]
    head = [f"{machine()}. {own}; {packages}. Medians of {args.repeat} runs (one where a run takes more than {LONG:g} s), one thread, "
            f"each run given up after {args.limit:g} s. Load average while it ran: {min(loads):.1f} to {max(loads):.1f}.", "",
            "### Where a peer was faster", "", *judgement, ""]
    (out / "table.md").write_text("\n".join(head + text).rstrip() + "\n", encoding="utf-8")
    print("\n".join(head))


if __name__ == "__main__":
    main()
