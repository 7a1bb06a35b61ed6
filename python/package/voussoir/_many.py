"""Many scenes at once: plans over parameters, batches, heaps."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from . import _core
from ._answers import Array, Finding, Verification, _verification, _write, fixed
from ._ask import Law, Progress
from ._answers import Answer
from ._errors import InputError
from ._progress import shown
from ._scene import Scene, SceneLike, core, load

if TYPE_CHECKING:
    import pandas


# ----------------------------------------------------------------------- batch


@dataclass(frozen=True, eq=False)
class Many:
    """The answer of :func:`assess_many` about n scenes, in their order.

    Attributes
    ----------
    verdicts : array of str, shape (n,)
        ``stable``, ``conditional``, ``unstable``, ``undecided`` or ``error``.
    equilibrium_error : array of shape (n, 2)
        Bracket of the least equilibrium error, in multiples of gravity.
    margins : array of shape (n,)
        The margin that was asked for; NaN where there is none.
    brackets : array of shape (n, 2)
        Lower and upper ends of the margins.
    status : array of str, shape (n,)
        What became of each margin: ``found``, ``unbounded``, ``impossible``, ...
    errors : dict of int to str
        Why a scene has no answer.

    Examples
    --------
    >>> import voussoir
    >>> def pile(shift):
    ...     scene = voussoir.Scene(friction=0.6, density=2400)
    ...     scene.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    ...     return scene.box("a", (1, 1, 1), (0, 0, 0.5)).box("b", (1, 1, 1), (shift, 0, 1.5))
    >>> many = voussoir.assess_many([pile(0.4), pile(0.6)])
    >>> many.verdicts.tolist(), many.stands.tolist()
    (['stable', 'unstable'], [True, False])
    """

    verdicts: npt.NDArray[np.str_]
    equilibrium_error: Array
    margins: Array
    brackets: Array
    status: npt.NDArray[np.str_]
    errors: dict[int, str]

    def __len__(self) -> int:
        return len(self.verdicts)

    @property
    def stands(self) -> npt.NDArray[np.bool_]:
        """Whether each stands; shape (n,)."""
        return fixed(self.verdicts == "stable", np.bool_)

    def to_frame(self) -> pandas.DataFrame:
        """One row a scene."""
        import pandas

        return pandas.DataFrame(
            {
                "verdict": self.verdicts,
                "equilibrium_error": self.equilibrium_error[:, 1],
                "margin": self.margins,
                "margin_lower": self.brackets[:, 0],
                "margin_upper": self.brackets[:, 1],
                "margin_status": self.status,
            }
        )


def _column(told: Any) -> tuple[npt.NDArray[np.str_], Array, Array, dict[int, str]]:
    status, value, lower, upper, errors = told
    brackets = fixed(np.column_stack([lower, upper]))
    return fixed(status, np.str_), value, brackets, dict(errors)


def assess_many(
    scenes: Iterable[SceneLike],
    *,
    margin: Literal["equilibrium_error", "limit", "tilt"] = "equilibrium_error",
    toward: Sequence[float] | None = None,
    law: Law = "coulomb",
    keep_all: bool = False,
    threads: int = 0,
    progress: Progress = False,
) -> Many:
    """Assess many scenes on threads.

    Parameters
    ----------
    scenes : iterable of Scene, path or mapping
        n scenes.
    margin : {"equilibrium_error", "limit", "tilt"}
        What ``margins`` holds: minus the least equilibrium error in multiples of gravity (0 where
        forces exist, less where it falls), the load factor on the live load, or the tilt in degrees.
    toward : (x, y) or (x, y, z), optional
        Direction of the tilt; the least of eight where none is given.
    law : {"coulomb", "associative"}
        How joints slide: dry friction, or opening by friction times slip.
    keep_all : bool
        Do without reductions, such as those by symmetry.
    threads : int
        0 for one a processor. More than four a processor are not started.
    progress : callable or bool
        Called with the work done, the total and a text; ``True`` for a bar of tqdm.

    Returns
    -------
    Many
        A scene that cannot be asked about has the verdict ``error``, with the reason in ``errors``.

    Raises
    ------
    InputError
        A scene that cannot be read, or an option that cannot be used.

    References
    ----------
    ``docs/guide/law.md``.

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    >>> slender = table.copy().box("block", (0.2, 0.4, 1), at=(0, 0, 0.5))
    >>> sturdy = table.copy().box("block", (0.4, 0.4, 1), at=(0, 0, 0.5))
    >>> many = voussoir.assess_many([slender, sturdy], margin="tilt", toward=(1, 0))
    >>> many.margins.round(3).tolist()
    [11.31, 21.801]
    """
    questions: list[dict[str, Any]] = [{"assess": {"law": law}}]
    if margin == "limit":
        questions.append({"limit": {"law": law}})
    elif margin == "tilt":
        directions = {} if toward is None else {"toward": [[*map(float, toward), 0.0][:3]]}
        questions.append({"tilt": {"law": law, **directions}})
    elif margin != "equilibrium_error":
        hint = "one of equilibrium_error, limit, tilt"
        raise InputError(f"unknown value {margin!r}", "margin", hint)
    listed = [core(scene) for scene in scenes]
    with shown(progress) as tell:
        told = _core.ask_many(
            listed, questions, keep_all=keep_all, threads=threads, progress=tell
        )
    verdicts, _, equilibrium_error, errors = _column(told[0])
    if margin == "equilibrium_error":
        margins, brackets = fixed(-equilibrium_error[:, 1]), fixed(-equilibrium_error[:, ::-1])
        return Many(verdicts, equilibrium_error, margins, brackets, verdicts, errors)
    status, value, brackets, more = _column(told[1])
    return Many(verdicts, equilibrium_error, value, brackets, status, {**more, **errors})


# ---------------------------------------------------------------------- sweeps


class Sweep:
    """The answer of :func:`sweep`: rows, and what they have in common.

    Examples
    --------
    >>> import voussoir
    >>> arch = voussoir.Scene("Arch", friction=0.7, density=2400).load("live", weight=(1, 0, 0))
    >>> arch = arch.add(voussoir.Arch(radius=1, thickness=0.2, depth=1, voussoirs=9))
    >>> thickness = {"pointer": "/templates/0/arch/thickness", "values": [0.15, 0.2]}
    >>> rows = voussoir.sweep({"question": {"limit": {}}, "vary": [thickness]}, arch)
    >>> len(rows), rows.status, bool(rows.values[0] < rows.values[1])
    (2, ['found', 'found'], True)
    """

    def __init__(self, rows: _core.Rows, output: str | None) -> None:
        self._core = rows
        self.output = output
        """The file of rows, where it was named; the command continues and merges such files."""

    def __reduce__(self) -> tuple[Any, ...]:
        return (_sweep_restored, (self._core.state(), self.output))

    def __len__(self) -> int:
        return len(self._core)

    def __str__(self) -> str:
        return self._core.text()

    def __repr__(self) -> str:
        return f"<voussoir.Sweep {self._core.text(brief=True).strip()}>"

    @property
    def parameters(self) -> dict[str, Any]:
        """What varies, by name: an array of numbers or a list of words, one a row."""
        return self._core.parameters()

    @property
    def values(self) -> Array:
        """The load factor, tilt (degrees), thrust (N) of each row; NaN where there is none."""
        values: Array = self._core.answers()["value"]
        return values

    @property
    def status(self) -> list[str]:
        """What became of each row."""
        status: list[str] = self._core.answers()["status"]
        return status

    @property
    def summary(self) -> dict[str, Any]:
        """Counts, quantiles, what matters, the fragility curve."""
        return self._core.summary()

    def to_json(self) -> str:
        """The summary, as ``--json`` prints it."""
        return self._core.json()

    def to_frame(self) -> pandas.DataFrame:
        """One row a scene: what varies, then ``status``, ``value``, ``lower``, ``upper``, …"""
        import pandas

        answers = self._core.answers()
        row = answers.pop("row")
        return pandas.DataFrame(
            {**self._core.parameters(), **answers}, index=pandas.Index(row, name="row")
        )

    def to_csv(self) -> str:
        """The table that ``--csv`` writes."""
        return self._core.csv()

    def svg(self, kind: Literal["line", "heat", "fragility"] | None = None) -> str:
        """A chart; of the kind that suits the rows where none is named."""
        return self._core.svg(kind)

    def report(self, path: str | os.PathLike[str] | None = None) -> str:
        """A page for a browser, written to a file as well where one is named."""
        page = self._core.page()
        if path is not None:
            _write(path, page)
        return page

    def _repr_svg_(self) -> str:
        return self._core.svg()


def _sweep_restored(state: str, output: str | None) -> Sweep:
    return Sweep(_core.Rows.restored(state), output)


def sweep(
    plan: str | os.PathLike[str] | Mapping[str, Any],
    scene: SceneLike | None = None,
    *,
    output: str | os.PathLike[str] | None = None,
    restart: bool = False,
    threads: int = 0,
    allow_outside: bool = False,
    progress: Progress = False,
) -> Sweep:
    """Ask one question of many scenes that differ in a few numbers or words.

    Parameters
    ----------
    plan : path or mapping
        A plan file, or what stands in one: ``{"question": {"limit": {}}, "vary": [{"pointer":
        "/templates/0/arch/thickness", "from": 0.1, "to": 0.2, "count": 11}]}``. Each of ``vary`` has
        a JSON ``pointer``, a ``name``, and ``values``, or ``from``, ``to`` and ``count``, or
        ``normal`` or ``lognormal`` with ``sampling``; ``voussoir schema plan`` has all keys.
    scene : Scene, path or mapping, optional
        Beside a mapping, which then needs no ``"scene"``.
    output : path, optional
        The file of rows: each is written as it ends, and the same call continues after a stop.
    restart : bool
        Begin again where rows of another plan are in the file.
    threads : int
        0 for one a processor. More than four a processor are not started. Rows do not depend on it.
    allow_outside : bool
        Whether paths in a plan file may leave its folder.
    progress : callable or bool
        Called with the work done, the total and a text; ``True`` for a bar of tqdm.

    Returns
    -------
    Sweep
        ``parameters``, ``values``, ``status``, ``summary``; ``to_frame``, ``svg``, ``report``.

    Raises
    ------
    InputError
        The plan or the scene cannot be used as it is.

    References
    ----------
    ``docs/guide/sweeps.md``.

    Examples
    --------
    >>> import voussoir
    >>> arch = voussoir.Scene("Arch", friction=0.7, density=2400).load("live", weight=(1, 0, 0))
    >>> arch = arch.add(voussoir.Arch(radius=1, thickness=0.2, depth=1, voussoirs=9))
    >>> friction = {"pointer": "/joints/default/friction", "values": [0.5, 0.7]}
    >>> voussoir.sweep({"question": {"limit": {}}, "vary": [friction]}, arch).status
    ['found', 'found']
    """
    with tempfile.TemporaryDirectory(prefix="voussoir-") as folder, shown(progress) as tell:
        rows = os.path.join(folder, "rows.jsonl") if output is None else os.fspath(output)
        if isinstance(plan, Mapping):
            whole = {"format": "voussoir-sweep/1", "scene": "scene", **plan}
            subject = scene if scene is not None else plan.get("scene")
            if subject is None:
                raise InputError("a plan of plain values needs a scene beside it", "scene")
            if not isinstance(whole["scene"], str):
                whole["scene"] = "scene"
            found = _core.sweep_scene(
                whole, core(subject), rows, threads=threads, restart=restart, progress=tell
            )
        else:
            if scene is not None:
                raise InputError("a plan file names its scene itself", "scene")
            found = _core.sweep_file(
                os.fspath(plan),
                rows,
                allow_outside=allow_outside,
                threads=threads,
                restart=restart,
                progress=tell,
            )
    return Sweep(found, None if output is None else os.fspath(output))


# ----------------------------------------------------------------------- heaps


class Heaps:
    """The answer of :func:`heaps`: heaps that flowed and came to rest, one a seed.

    Examples
    --------
    >>> import voussoir
    >>> heaps = voussoir.heaps("funnel", grains=30, seeds=[3], skip_margin=True)
    >>> len(heaps), len(heaps.scenes)
    (1, 1)
    """

    def __init__(self, heaps: _core.Heaps) -> None:
        self._core = heaps
        self._data: dict[str, Any] = heaps.plain()

    def __reduce__(self) -> tuple[Any, ...]:
        return (_heaps_restored, (self._core.state(),))

    def __len__(self) -> int:
        return len(self._data["heaps"])

    def __str__(self) -> str:
        return self._core.text()

    def __repr__(self) -> str:
        return f"<voussoir.Heaps {self._core.text(brief=True).strip()}>"

    @property
    def angle_deg(self) -> float | None:
        """Mean angle of the heaps, degrees; None where one of them has none: see ``no_angle``."""
        return self._data.get("angle_deg")

    @property
    def no_angle(self) -> str | None:
        """Why there is no angle of repose; None where there is one."""
        return self._data.get("no_angle")

    @property
    def spread_deg(self) -> tuple[float, float] | None:
        """Least and greatest angle, degrees."""
        spread = self._data.get("spread_deg")
        return None if spread is None else (spread[0], spread[1])

    @property
    def figures(self) -> dict[str, float]:
        """Means over the seeds of what a drum, a hopper, a shear box or a cell shows, by name."""
        return {figure["name"]: figure["mean"] for figure in self._data.get("figures", [])}

    @property
    def margins_deg(self) -> Array:
        """The tilt downhill that each heap at rest still bears, degrees; NaN where none was found."""
        margins = [(h.get("margin") or {}).get("margin_deg") for h in self._data["heaps"]]
        return fixed([np.nan if m is None else m for m in margins])

    @property
    def scenes(self) -> list[Scene]:
        """The heaps as they lie."""
        return [Scene._of(scene) for scene in self._core.scenes()]

    def to_dict(self) -> dict[str, Any]:
        """All of it as plain values."""
        return self._data

    def to_json(self) -> str:
        """The same, as ``--json`` prints it."""
        return self._core.json()

    def to_frame(self) -> pandas.DataFrame:
        """One row a heap."""
        import pandas

        keys = (
            "seed",
            "rested",
            "grains",
            "discarded",
            "angle_deg",
            "no_angle",
            "r_squared",
            "avalanche_deg",
        )
        rows = [{key: heap.get(key) for key in keys} for heap in self._data["heaps"]]
        frame = pandas.DataFrame(rows, columns=list(keys))
        frame["margin_deg"] = self.margins_deg
        return frame


def _heaps_restored(state: str) -> Heaps:
    return Heaps(_core.Heaps.restored(state))


def heaps(
    protocol: Literal["drain", "funnel", "cylinder", "tilt", "drum", "hopper", "shear", "cell"],
    *,
    seeds: int | Sequence[int] = 1,
    skip_margin: bool = False,
    keep_all: bool = False,
    threads: int = 0,
    progress: Progress = False,
    **values: Any,
) -> Heaps:
    """Make heaps of grains and measure their angle of repose, or what a drum, a hopper, a
    shear box or a cell shows, as ``voussoir repose PROTOCOL --question repose`` does.

    Parameters
    ----------
    protocol : {"drain", "funnel", "cylinder", "tilt", "drum", "hopper", "shear", "cell"}
        How the grains flow.
    seeds : int or sequence of int
        This many seeds from 0 on, or these.
    skip_margin : bool
        Do not ask for the static margin of the heaps at rest.
    keep_all : bool
        Do without reductions, such as those by symmetry.
    threads : int
        0 for one a processor. More than four a processor are not started.
    progress : callable or bool
        Called with the work done, the total and a text; ``True`` for a bar of tqdm.
    **values
        ``grains=400``, ``grain="clump"``, ``elongation``, ``corners``, ``diameter`` (m), ``sizes``,
        ``friction``, ``wall_friction``, ``rolling_arm``, ``restitution``, ``density``, ``size``,
        ``rate``, ``pressure``, ``stiffness``, ``drop``, ``floor``. A grading curve is
        ``sizes=[[0.002, 0], [0.004, 0.4], [0.008, 1]]`` with ``diameter`` the unit of lengths.

    Returns
    -------
    Heaps
        ``angle_deg``, ``margins_deg``, ``scenes``, ``to_frame``.

    Raises
    ------
    InputError
        A value that no protocol can have.

    References
    ----------
    ``docs/grains.md``.

    Examples
    --------
    >>> import voussoir
    >>> len(voussoir.heaps("funnel", grains=30, seeds=1, skip_margin=True))
    1
    """
    listed = list(range(seeds)) if isinstance(seeds, int) else [int(s) for s in seeds]
    with shown(progress) as tell:
        return Heaps(
            _core.heaps(
                {"kind": protocol, **values},
                listed,
                skip_margin=skip_margin,
                keep_all=keep_all,
                threads=threads,
                progress=tell,
            )
        )


# ----------------------------------------------------------------------- check


@dataclass(frozen=True)
class Inspection:
    """What was found in a scene: mistakes, near misses, overlaps, loose blocks. True where there is
    no mistake.

    Attributes
    ----------
    findings : list of Finding
        All findings.

    Examples
    --------
    >>> import voussoir
    >>> scene = voussoir.Scene(friction=0.6, density=2400).box("ground", (1, 1, 1), support=True)
    >>> found = voussoir.check(scene.box("block", (1, 1, 1), at=(0, 0, 1.004)))
    >>> bool(found), [f.code for f in found.mistakes]
    (False, ['near_miss', 'unjoined', 'floating'])
    """

    findings: list[Finding]

    @property
    def mistakes(self) -> list[Finding]:
        """Those that are likely mistakes."""
        return [finding for finding in self.findings if finding.is_mistake]

    def __bool__(self) -> bool:
        """Whether there is no mistake."""
        return not self.mistakes

    def __str__(self) -> str:
        return "\n".join(str(finding) for finding in self.findings)


def check(
    what: Answer | SceneLike, scene: SceneLike | None = None
) -> Verification | Inspection:
    """Verify an answer from its scene, or look for mistakes in a scene.

    Parameters
    ----------
    what : Answer, Scene, mapping or path
        An answer, a scene, or the file of one of them.
    scene : Scene, path or mapping, optional
        Verify the answer for this scene instead of its own.

    Returns
    -------
    Verification or Inspection
        Of an answer, of a scene; each is true where all is well.

    Raises
    ------
    InputError
        The file is neither a result nor a scene.

    References
    ----------
    ``docs/guide/proofs.md``.

    Examples
    --------
    >>> import voussoir
    >>> arch = voussoir.Scene("Arch", friction=0.7, density=2400)
    >>> arch = arch.add(voussoir.Arch(radius=1, thickness=0.15, depth=1, voussoirs=9))
    >>> bool(voussoir.check(arch)), bool(voussoir.check(voussoir.assess(arch)))
    (True, True)
    """
    if isinstance(what, Answer):
        other = None if scene is None else core(scene)
        return _verification(what._core.verify(other))
    if isinstance(what, (str, os.PathLike)):
        with open(what, encoding="utf-8", errors="replace") as file:
            text = file.read()
        if _core.is_result(text):
            other = None if scene is None else core(scene)
            return _verification(_core.check_saved(os.fspath(what), text, other))
    if scene is not None:
        raise InputError("only answers are verified from a scene", "scene")
    return Inspection([Finding(*each) for each in load(what)._core.findings()])
