"""Runs the scenes of structures/ in MuJoCo, as `voussoir assess --model` writes them, and compares with the
verdicts: what stands may not move, what falls must. Needs `pip install mujoco`.

    python benches/run_in_mujoco.py target/release/voussoir [NAME ...]
"""

import pathlib
import re
import subprocess
import sys
import tempfile

import mujoco
import numpy as np

# Greatest number of bodies, √(size / gravity) that are simulated, and what counts as moving, in sizes.
BODIES, TIME, MOVED = 300, 4.0, 0.01


def moves(path: pathlib.Path) -> float:
    """How far the block that moves farthest goes, in sizes of the scene."""
    model = mujoco.MjModel.from_xml_path(str(path))
    if model.nbody > BODIES:
        raise ValueError(f"more than {BODIES} bodies")
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    start, size = data.xpos.copy(), model.stat.extent
    span = TIME * np.sqrt(size / np.linalg.norm(model.opt.gravity))
    for _ in range(int(span / model.opt.timestep)):
        mujoco.mj_step(model, data)
    free = [k for k in range(1, model.nbody) if model.body_jntnum[k] > 0]
    return max(np.linalg.norm(data.xpos[free] - start[free], axis=1), default=0.0) / size


def main() -> None:
    program, *names = sys.argv[1:]
    root = pathlib.Path(__file__).parent.parent / "structures"
    names = names or sorted(p.stem for p in root.glob("*.json") if p.stem != "expected")
    agree, differ = {0: 0, 1: 0}, []
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            path = pathlib.Path(folder) / f"{name}.xml"
            asked = [program, "assess", root / f"{name}.json", "--model", path, "--quiet"]
            run = subprocess.run(asked, capture_output=True, text=True, check=False)
            notes = re.findall(r"note: --model: (.*)", run.stderr)
            try:
                way = moves(path)
            except (ValueError, OSError) as e:
                print(f"{name}: not run: {str(e).splitlines()[0]}")
                continue
            if run.returncode in agree and (way > MOVED) == (run.returncode == 1):
                agree[run.returncode] += 1
            else:
                differ.append(name)
                verdict = run.stdout.strip().rsplit(": ", 1)[-1]
                print(f"{name}: {verdict}; moves {way:.4f} sizes ({'; '.join(notes) or 'all of it'})", flush=True)
    print(f"stand and rest {agree[0]}, fall and move {agree[1]}, differ {len(differ)}")


if __name__ == "__main__":
    main()
