"""compas_cra (Kao et al. 2022): does the assembly stand? Its load factor by bisection on the tilt that has the same effect.

The package asks for a verdict under vertical weight. A live load of lambda times the weight along x is vertical weight after a turn by
atan(lambda), so the scene is turned and the verdict asked again: `STEPS` times, which is counted in full.

`rbe` (rigid-block equilibrium) is the static question that voussoir answers: its penalty formulation always has a solution, and the scene
counts as standing while the largest tension stays below `TENSION` of the largest pressure. `cra` couples forces and motions; its answer is
the solver's success. It is asked for verdicts only: where joints slide its load factor is another number.
"""

import contextlib
import io
from time import perf_counter

import numpy as np


# What the penalty leaves of tension at 0.999 and at 1.001 of the load factor, of the largest pressure: 0.9e-5 and 18e-5 on the arch of 20
# voussoirs, 11e-5 and 17e-5 on that of 400, 5e-5 and 10e-5 on the wall of 10 x 10.
TENSION = 1.5e-4
STEPS = 14
GREATEST = 1.0


def assembly(model, load_factor, block_type):
    """The compas assembly, turned so that weight + load_factor x weight along x points down."""
    from compas.geometry import Frame, Point, Vector
    from compas_cra.datastructures import CRA_Assembly

    down = np.array([load_factor, 0.0, -1.0]) / np.hypot(1.0, load_factor)
    x = np.array([-down[2], 0.0, down[0]])
    turn = np.stack([x, [0.0, 1.0, 0.0], -down])
    structure = CRA_Assembly()
    for center, mass, support in zip(model.centroid @ turn.T, model.mass / model.mass[~model.support].mean(), model.support):
        node = structure.add_block(block_type(center, mass))
        structure.graph.node_attribute(node, "is_support", bool(support))
    starts = np.flatnonzero(np.diff(model.face, prepend=-1))
    points, frames = model.point @ turn.T, model.frame @ turn.T
    for start, end in zip(starts, [*starts[1:], len(model.face)]):
        frame = Frame(Point(*points[start]), Vector(*frames[start, 0]), Vector(*frames[start, 1]))
        corners = [Point(*p) for p in points[start:end]]
        structure.add_to_interfaces(int(model.first[start]), int(model.second[start]), 1.0, corners, frame)
    return structure


def stands(model, load_factor, method, block_type):
    """(verdict, seconds building, seconds solving, the engine's word)"""
    from compas_cra.equilibrium import cra_native, cra_problem, rbe_problem
    from compas_cra.nlp import solve_nlp

    mu = float(model.mu[0])
    start = perf_counter()
    structure = assembly(model, load_factor, block_type)
    if method == "rbe":
        problem, layout = rbe_problem(structure, mu=mu, density=1.0)
        options = None
    else:
        problem, layout = cra_problem(structure, mu=mu, density=1.0)
        options = cra_native._CRA_OPTIONS
    built = perf_counter()
    result = solve_nlp(problem, backend="native", options=options)
    solved = perf_counter()
    verdict = bool(result.success)
    if method == "rbe":
        verdict = verdict and float(np.max(result.x[layout["f"]][1::4])) <= TENSION * float(np.max(result.x[layout["f"]][0::4]))
    return verdict, built - start, solved - built, result.status_message


def block_class():
    """A compas block that knows its mass and its centre of mass; its mesh is never asked for."""
    from compas.geometry import Point
    from compas_assembly.datastructures import Block

    class Weighed(Block):
        def __init__(self, center, mass):
            super().__init__()
            self.known = Point(*center), float(mass)

        def center(self):
            return self.known[0]

        def volume(self):
            return self.known[1]

    return Weighed


def coupled_peer(method, load_factor=None):
    """The load factor by bisection, or one verdict at `load_factor`."""

    def run(model):
        block_type = block_class()
        with contextlib.redirect_stdout(io.StringIO()):
            if load_factor is not None:
                verdict, build, solve, word = stands(model, load_factor, method, block_type)
                return None, build, solve, f"{'stands' if verdict else 'does not stand'} ({word})"
            low, high, build, solve = 0.0, GREATEST, 0.0, 0.0
            for _ in range(STEPS):
                middle = (low + high) / 2.0
                verdict, b, s, _ = stands(model, middle, method, block_type)
                build, solve = build + b, solve + s
                low, high = (middle, high) if verdict else (low, middle)
            return (low + high) / 2.0, build, solve, f"{STEPS} verdicts"

    return run
