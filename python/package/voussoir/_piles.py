"""Many small assemblies from arrays: shapes made ready once, put anywhere."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._answers import Array, fixed
from ._ask import Progress
from ._errors import InputError
from ._progress import shown
from ._scene import SceneLike, load

if TYPE_CHECKING:
    import pandas


@dataclass(frozen=True, eq=False)
class Piled:
    """The answer of :meth:`Piles.assess` about n piles, in their order.

    Attributes
    ----------
    verdicts : array of str, shape (n,)
        ``stable``, ``conditional``, ``unstable``, ``undecided`` or ``error``.
    margins : array of shape (n,)
        The greatest horizontal acceleration, in multiples of gravity, that each pile bears in every
        direction: the lower end of its bracket; NaN where there is none.
    brackets : array of shape (n, 2)
        Lower and upper ends of the margins.
    by : array of str, shape (n,)
        What decided: ``statics`` where contacts form no closed chain, else ``program``.
    errors : dict of int to str
        Why a pile has no answer.
    findings : dict of int to list of str
        What was found about the contacts of a pile: overlaps, gaps, near misses.

    Examples
    --------
    >>> import voussoir
    >>> shapes = voussoir.Scene("shapes", friction=0.6, density=2400)
    >>> shapes = shapes.box("ground", (4, 4, 0.2), support=True).box("brick", (0.4, 0.4, 0.2))
    >>> at = [[(0, 0, -0.1), (0, 0, 0.1), (lean, 0, 0.3)] for lean in (0.1, 0.3)]
    >>> told = voussoir.Piles(shapes).assess([[0, 1, 1], [0, 1, 1]], at)
    >>> told.stands.tolist(), told.by.tolist()
    ([True, False], ['statics', 'statics'])
    """

    verdicts: npt.NDArray[np.str_]
    margins: Array
    brackets: Array
    by: npt.NDArray[np.str_]
    errors: dict[int, str]
    findings: dict[int, list[str]]

    def __len__(self) -> int:
        return len(self.verdicts)

    @property
    def stands(self) -> npt.NDArray[np.bool_]:
        """Whether each stands; shape (n,)."""
        return fixed(self.verdicts == "stable", np.bool_)

    def to_frame(self) -> pandas.DataFrame:
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

    Parameters
    ----------
    shapes : Scene, path or mapping
        The scene. It gives materials, joints, gravity and contact tolerances, too; loads, members
        and joints by the names of blocks are refused.

    Examples
    --------
    >>> import voussoir
    >>> shapes = voussoir.Scene("shapes", friction=0.6, density=2400)
    >>> shapes = shapes.box("ground", (4, 4, 0.2), support=True).box("brick", (0.4, 0.4, 0.2))
    >>> piles = voussoir.Piles(shapes)
    >>> at = [[(0, 0, -0.1), (0, 0, 0.1), (lean, 0, 0.3)] for lean in (0.1, 0.3)]
    >>> told = piles.assess([[0, 1, 1], [0, 1, 1]], at, margin=True)
    >>> [str(v) for v in told.verdicts], round(float(told.margins[0]), 6)
    (['stable', 'unstable'], 0.6)
    """

    def __init__(self, shapes: SceneLike) -> None:
        self._scene = load(shapes)
        self._core = _core.Piles(self._scene._core)

    def __reduce__(self) -> tuple[Any, ...]:
        return (Piles, (self._scene,))

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
        which : array of int, shape (n, b)
            The shape of each block, from 0; -1 for none.
        at : array of shape (n, b, 3)
            Where the origin of the scene of shapes comes, m.
        turn : array of shape (n, b, 4), optional
            Rotation of each block about that origin: quaternions w, x, y, z.
        masses : array of shape (n, b), optional
            Masses in place of those of the shapes, kg.
        margin : bool
            Ask for the greatest horizontal acceleration that is borne in every direction.
        threads : int
            0 for one a processor. More than four a processor are not started.
        progress : callable or bool
            Called with the work done, the total and a text; ``True`` for a bar of tqdm.

        Returns
        -------
        Piled
            A pile that cannot be asked about has the verdict ``error``, with the reason in ``errors``.

        Raises
        ------
        InputError
            An array of another shape.
        """
        shape = np.ascontiguousarray(which, dtype=np.int64)
        if shape.ndim != 2:
            raise InputError(f"which has the shape (n, b), not {shape.shape}", "which")

        def as_given(name: str, values: npt.ArrayLike, *more: int) -> Array:
            array: Array = np.ascontiguousarray(values, dtype=np.float64)
            if array.shape != (*shape.shape, *more):
                wanted = (*shape.shape, *more)
                raise InputError(f"{name} has the shape {wanted}, not {array.shape}", name)
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
            fixed(verdicts, np.str_),
            lower,
            fixed(np.column_stack([lower, upper])),
            fixed(by, np.str_),
            dict(errors),
            dict(findings),
        )
