"""Plots with matplotlib, and pages in notebooks and browsers."""

from __future__ import annotations

import os
import sys
import tempfile
import webbrowser
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ._errors import InputError

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ._answers import Answer

# To the right, upwards, towards the eye.
VIEWS = {
    "front": ("x", "z", "-y"),
    "back": ("-x", "z", "y"),
    "left": ("-y", "z", "-x"),
    "right": ("y", "z", "x"),
    "top": ("x", "y", "z"),
}
STONE, LINE, FORCE = "#d9d2c5", "#5b5346", "#b3261e"


def _axes(axes: Axes | None) -> Axes:
    if axes is None:
        import matplotlib.pyplot as plt

        axes = plt.subplots()[1]
    return axes


def _along(points: npt.NDArray[np.float64], word: str) -> npt.NDArray[np.float64]:
    column: npt.NDArray[np.float64] = points[..., "xyz".index(word[-1])]
    return -column if word[0] == "-" else column


def structure(answer: Answer, axes: Axes | None, view: str) -> Axes:
    """Blocks, the nearest last, and the resultants of the joints at their centres of pressure."""
    if view not in VIEWS:
        raise InputError(f"unknown value {view!r}", "view", f"one of {', '.join(VIEWS)}")
    from matplotlib.collections import LineCollection, PolyCollection

    axes = _axes(axes)
    right, up, near = VIEWS[view]
    corners, faces = _mesh(answer._core.obj())
    flat = np.column_stack([_along(corners, right), _along(corners, up)])
    order = sorted(faces, key=lambda face: float(_along(corners[face], near).mean()))
    shapes = [flat[face] for face in order]
    axes.add_collection(PolyCollection(shapes, facecolors=STONE, edgecolors=LINE, linewidths=0.6))
    forces = answer.certificate.forces
    sums = forces.resultants()
    greatest = float(np.linalg.norm(sums, axis=1).max(initial=0.0))
    if greatest > 0 and answer.mechanism is None:
        size = float(np.ptp(flat, axis=0).max())
        lines = []
        for (_, points, own), total in zip(forces, sums):
            weights = np.linalg.norm(own, axis=1)
            if weights.sum() > 0:
                at = (points * weights[:, None]).sum(axis=0) / weights.sum()
                half = 0.06 * size * total / greatest
                ends = np.array([at - half, at + half])
                lines.append(np.column_stack([_along(ends, right), _along(ends, up)]))
        axes.add_collection(LineCollection(lines, colors=FORCE, linewidths=1.2, zorder=3))
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.set_xlabel(f"{right}, m")
    axes.set_ylabel(f"{up}, m")
    axes.set_title(answer.title, fontsize="medium", wrap=True)
    return axes


def _mesh(obj: str) -> tuple[npt.NDArray[np.float64], list[list[int]]]:
    """Corners and faces of a file of displaced blocks."""
    rows = [line.split() for line in obj.splitlines()]
    corners = [[float(x) for x in row[1:4]] for row in rows if row[:1] == ["v"]]
    faces = [[int(x.split("/")[0]) - 1 for x in row[1:]] for row in rows if row[:1] == ["f"]]
    return np.array(corners).reshape(-1, 3), faces


def curve(axes: Axes | None, x: Any, y: Any, across: str, upwards: str) -> Axes:
    """A line through points."""
    axes = _axes(axes)
    axes.plot(x, y, marker=".", color=FORCE)
    axes.set_xlabel(across)
    axes.set_ylabel(upwards)
    return axes


def page(answer: Answer) -> None:
    """The page of an answer, below the cell of a notebook or in a browser."""
    interactive: Any = sys.modules.get("IPython")
    shell = interactive.get_ipython() if interactive else None
    if shell is not None and hasattr(shell, "kernel"):
        interactive.display.display(interactive.display.HTML(answer._repr_html_()))
        return
    handle, path = tempfile.mkstemp(prefix="voussoir-", suffix=".html")
    os.close(handle)
    answer.report(path)
    webbrowser.open(f"file://{path}")
