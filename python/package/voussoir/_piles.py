"""Many small assemblies from arrays: shapes made ready once, put anywhere."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._answers import Array
from ._ask import Progress
from ._progress import shown
from ._scene import SceneLike, core

if TYPE_CHECKING:
    import pandas


@dataclass(frozen=True, eq=False)
class Piled:
    """The answers about n piles, in their order."""

    verdicts: npt.NDArray[np.str_]
    """``stable``, ``conditional``, ``unstable``, ``undecided`` or ``error``; shape (n,)."""
    margins: Array
    """The greatest horizontal acceleration, in multiples of gravity, that each pile bears in every
    direction: the lower end of its bracket; NaN where there is none; shape (n,)."""
    brackets: Array
    """Lower and upper ends of the margins; shape (n, 2)."""
    by: npt.NDArray[np.str_]
    """What decided: ``statics`` where contacts form no closed chain, else ``program``."""
    errors: dict[int, str]
    """Why a pile has no answer."""
    findings: dict[int, list[str]]
    """What was found about the contacts of a pile: overlaps, gaps, near misses, with their numbers."""

    def __len__(self) -> int:
        return len(self.verdicts)

    @property
    def stands(self) -> npt.NDArray[np.bool_]:
        """Whether each stands; shape (n,)."""
        stands: npt.NDArray[np.bool_] = self.verdicts == "stable"
        return stands

    def to_pandas(self) -> pandas.DataFrame:
        """One row a pile."""
        import pandas

        return pandas.DataFrame(
            {
                "verdict": self.verdicts,
                "margin": self.margins,
                "margin_upper": self.brackets[:, 1],
                "by": self.by,
                "findings": ["; ".join(self.findings.get(i, [])) for i in range(len(self))],
            }
        )


class Piles:
    """The blocks of a scene as shapes, each of which may be put anywhere, as often as wanted.

    >>> import numpy as np, voussoir
    >>> scene = voussoir.Scene("shapes", friction=0.6, density=2400)
    >>> _ = scene.box("ground", (4, 4, 0.2), support=True).box("brick", (0.4, 0.4, 0.2))
    >>> piles = voussoir.Piles(scene)
    >>> which = np.array([[0, 1, 1], [0, 1, 1]])
    >>> at = np.array([[(0, 0, -0.1), (0, 0, 0.1), (lean, 0, 0.3)] for lean in (0.1, 0.3)])
    >>> told = piles.assess(which, at, margin=True)
    >>> [str(v) for v in told.verdicts], round(float(told.margins[0]), 6)
    (['stable', 'unstable'], 0.6)

    The scene gives materials, joints, gravity and contact tolerances too; loads, members and joints
    by the names of blocks are refused.
    """

    def __init__(self, shapes: SceneLike) -> None:
        self._core = _core.Piles(core(shapes))

    @property
    def shapes(self) -> list[str]:
        """Names of the shapes; their places in this list are what ``which`` counts."""
        return self._core.ids()

    def assess(
        self,
        which: npt.ArrayLike,
        at: npt.ArrayLike,
        turn: npt.ArrayLike | None = None,
        masses: npt.ArrayLike | None = None,
        *,
        margin: bool = False,
        threads: int = 0,
        progress: Progress = False,
    ) -> Piled:
        """Does each of n piles of up to b blocks stand, and by how much?

        Parameters
        ----------
        which : whole numbers, shape (n, b)
            The shape of each block, counted from 0; -1 for none.
        at : shape (n, b, 3)
            Where the origin of the scene of shapes comes, m.
        turn : shape (n, b, 4), optional
            How each block is turned about that origin: quaternions w, x, y, z.
        masses : shape (n, b), optional
            Masses in kg, instead of those of the shapes.
        margin : bool
            Ask for the greatest horizontal acceleration that is borne in every direction.
        threads : int
            0 for as many as there are processors.

        A pile that cannot be asked about is ``error``, and ``errors`` says why; nothing is raised.
        """
        shape = np.ascontiguousarray(which, dtype=np.int64)
        if shape.ndim != 2:
            raise ValueError(f"which has the shape (n, b), not {shape.shape}")

        def as_given(name: str, values: npt.ArrayLike, *more: int) -> Array:
            array: Array = np.ascontiguousarray(values, dtype=np.float64)
            if array.shape != (*shape.shape, *more):
                wanted = (*shape.shape, *more)
                raise ValueError(f"{name} has the shape {wanted}, not {array.shape}")
            return array

        places = as_given("at", at, 3)
        turns = None if turn is None else as_given("turn", turn, 4)
        weights = None if masses is None else as_given("masses", masses)
        with shown(progress) as tell:
            told: Any = self._core.ask(
                shape, places, turns, weights, margin=margin, threads=threads, progress=tell
            )
        verdicts, lower, upper, by, errors, findings = told
        return Piled(
            np.asarray(verdicts, dtype=np.str_),
            lower,
            np.column_stack([lower, upper]),
            np.asarray(by, dtype=np.str_),
            dict(errors),
            dict(findings),
        )
