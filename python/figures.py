"""The figures of docs/python.md, measured here: ``python figures.py``, with the package installed.

The Armadillo Vault is read from a file that is named on the command line, where one is.
"""

from __future__ import annotations

import statistics
import sys
import time
import warnings

import numpy as np
import voussoir

warnings.simplefilter("ignore")


def overhead() -> None:
    """What ``limit`` takes beside reading, resolving, contacts, solving and checking."""
    arch = {"radius": 10, "thickness": 1.5, "depth": 1, "voussoirs": 27, "material": "stone"}
    data = {
        "format": "voussoir-scene/1",
        "materials": {"stone": {"density": 2400}},
        "joints": {"default": {"friction": 0.8}},
        "templates": [{"arch": arch}],
        "loads": {"live": [{"weight": [1, 0, 0]}]},
    }
    whole, beside = [], []
    for _ in range(200):
        start = time.perf_counter()
        answer = voussoir.limit(data)
        factor = answer.load_factor.value
        total = time.perf_counter() - start
        stages = answer.to_dict()["timings"]
        whole.append(total)
        beside.append(total - sum(stages.values()))
        assert factor is not None
    print(f"limit on an arch of 27 voussoirs from a dict: {1e3 * statistics.median(whole):.2f} ms, of it")
    print(f"  beside the library's own stages: {1e3 * statistics.median(beside):.2f} ms")


def pile(lean: float) -> voussoir.Scene:
    scene = voussoir.Scene(friction=0.6, density=2400)
    scene.box("ground", (4, 4, 0.2), (0, 0, -0.1), support=True)
    for k in range(9):
        scene.box(f"b{k}", (0.4, 0.4, 0.2), (lean * k, 0, 0.1 + 0.2 * k))
    return scene


def piles() -> None:
    """10,000 piles of 10 boxes, the ground among them."""
    start = time.perf_counter()
    scenes = [pile(lean) for lean in np.linspace(0, 0.05, 10_000)]
    built = time.perf_counter() - start
    start = time.perf_counter()
    many = voussoir.assess_many(scenes, threads=2)
    print(f"10,000 piles of 10 boxes: built in {built:.1f} s, ", end="")
    print(f"assessed on two threads in {time.perf_counter() - start:.1f} s, ", end="")
    print(f"{int(many.stands.sum())} stand")


def wall() -> None:
    """The forces of a wall of about 10,000 blocks."""
    scene = voussoir.Scene(friction=0.7).material("stone", 2000)
    scene.template("wall", size=[0.4, 0.2, 0.2], courses=100, blocks=100, material="stone")
    start = time.perf_counter()
    answer = voussoir.assess(scene, law="associative")
    asked = time.perf_counter() - start
    start = time.perf_counter()
    forces = answer.forces
    made = time.perf_counter() - start
    blocks = len(answer.blocks.ids)
    print(f"wall of {blocks} blocks: {answer.verdict}, assessed in {asked:.1f} s")
    print(f"  {forces.shape[0]} forces as an array in {1e3 * made:.1f} ms")


def armadillo(path: str) -> None:
    """From the file of an assembly to forces on its edges."""
    import compas
    from voussoir.compas import from_assembly, to_assembly

    start = time.perf_counter()
    assembly = compas.json_load(path)
    read = time.perf_counter()
    supports = [*range(8), *range(79, 89), *range(217, 228), *range(328, 332)]
    scene = from_assembly(assembly, friction=0.84, density=2400, supports=supports)
    ready = time.perf_counter()
    for law in ("associative", "coulomb"):
        begin = time.perf_counter()
        answer = voussoir.assess(scene, law=law)  # type: ignore[arg-type]
        asked = time.perf_counter()
        to_assembly(answer, assembly)
        end = time.perf_counter()
        print(f"Armadillo Vault, {law}: {answer.verdict}; file {read - start:.2f} s, ", end="")
        print(f"scene {ready - read:.2f} s, answer {asked - begin:.2f} s, ", end="")
        print(f"edges {end - asked:.2f} s: {ready - start + end - begin:.2f} s")


if __name__ == "__main__":
    overhead()
    piles()
    wall()
    for path in sys.argv[1:]:
        armadillo(path)
