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
from ._answers import Array, Finding, Verification, _verification, _write
from ._ask import Law, Progress
from ._answers import Answer
from ._progress import shown
from ._scene import Scene, SceneLike, core, load

if TYPE_CHECKING:
    import pandas


# ----------------------------------------------------------------------- batch


@dataclass(frozen=True, eq=False)
class Many:
    """The answers about n scenes, in their order."""

    verdicts: npt.NDArray[np.str_]
    """``stable``, ``conditional``, ``unstable``, ``undecided`` or ``error``; shape (n,)."""
    equilibrium_error: Array
    """Bracket of the least equilibrium error, in multiples of gravity; shape (n, 2)."""
    margins: Array
    """The margin that was asked for: how far from falling; NaN where there is none; shape (n,)."""
    brackets: Array
    """Lower and upper ends of the margins; shape (n, 2)."""
    status: npt.NDArray[np.str_]
    """What became of each margin: ``found``, ``unbounded``, ``impossible``, …; shape (n,)."""
    errors: dict[int, str]
    """Why a scene has no answer."""

    def __len__(self) -> int:
        return len(self.verdicts)

    @property
    def stands(self) -> npt.NDArray[np.bool_]:
        """Whether each stands; shape (n,)."""
        stands: npt.NDArray[np.bool_] = self.verdicts == "stable"
        return stands

    def to_pandas(self) -> pandas.DataFrame:
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
    return np.asarray(status, dtype=np.str_), value, np.column_stack([lower, upper]), dict(errors)


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
    """Assess many scenes on threads, without any text in between.

    Parameters
    ----------
    scenes : scenes, paths or mappings
    margin : "equilibrium_error", "limit" or "tilt"
        What ``margins`` holds: minus the least equilibrium_error in multiples of gravity (0 where forces
        exist, less where it falls), the load factor on the live load, or the tilt in degrees.
    toward : two or three numbers, optional
        The direction of the tilt; the least of eight where none is given.
    threads : int
        0 for as many as there are processors.

    A scene that cannot be asked about is ``error``, and ``errors`` says why; nothing is raised.
    """
    questions: list[dict[str, Any]] = [{"assess": {"law": law}}]
    if margin == "limit":
        questions.append({"limit": {"law": law}})
    elif margin == "tilt":
        directions = {} if toward is None else {"toward": [[*map(float, toward), 0.0][:3]]}
        questions.append({"tilt": {"law": law, **directions}})
    elif margin != "equilibrium_error":
        raise ValueError(f"margin is equilibrium error, limit or tilt, not {margin!r}")
    listed = [core(scene) for scene in scenes]
    with shown(progress) as tell:
        told = _core.ask_many(
            listed, questions, keep_all=keep_all, threads=threads, progress=tell
        )
    verdicts, _, equilibrium_error, errors = _column(told[0])
    if margin == "equilibrium_error":
        return Many(verdicts, equilibrium_error, -equilibrium_error[:, 1], -equilibrium_error[:, ::-1], verdicts, errors)
    status, value, brackets, more = _column(told[1])
    return Many(verdicts, equilibrium_error, value, brackets, status, {**more, **errors})


# ---------------------------------------------------------------------- sweeps


class Sweep:
    """The rows of a sweep and what they have in common."""

    def __init__(self, rows: _core.Rows, output: str | None) -> None:
        self._core = rows
        self.output = output
        """The file of rows, where it was named; the command continues and merges such files."""

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

    def to_pandas(self) -> pandas.DataFrame:
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
    """Ask a question of many scenes that differ in a few numbers or words.

    Parameters
    ----------
    plan : path or mapping
        A plan file, or what stands in one: ``{"question": {"limit": {}}, "vary": [{"pointer":
        "/templates/0/arch/thickness", "from": 0.1, "to": 0.2, "count": 11}]}``.
    scene : scene, path or mapping
        Beside a mapping, which then needs no ``"scene"``.
    output : path, optional
        The file of rows: each is written as it ends, and the same call continues after a stop.
    restart : bool
        Begin again where rows of another plan are in the file.
    threads : int
        0 for as many as there are processors; rows do not depend on it.
    """
    with tempfile.TemporaryDirectory(prefix="voussoir-") as folder, shown(progress) as tell:
        rows = os.path.join(folder, "rows.jsonl") if output is None else os.fspath(output)
        if isinstance(plan, Mapping):
            whole = {"format": "voussoir-sweep/1", "scene": "scene", **plan}
            subject = scene if scene is not None else plan.get("scene")
            if subject is None:
                raise ValueError("a plan of plain values needs a scene beside it")
            if not isinstance(whole["scene"], str):
                whole["scene"] = "scene"
            found = _core.sweep_scene(
                whole, core(subject), rows, threads=threads, restart=restart, progress=tell
            )
        else:
            if scene is not None:
                raise ValueError("a plan file names its scene itself")
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
    """Heaps that flowed and came to rest, one a seed."""

    def __init__(self, heaps: _core.Heaps) -> None:
        self._core = heaps
        self._data: dict[str, Any] = heaps.plain()

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
        """Means over the seeds of what a drum, a hopper or a shear box shows, by name."""
        return {figure["name"]: figure["mean"] for figure in self._data.get("figures", [])}

    @property
    def margins_deg(self) -> Array:
        """The tilt downhill that each heap at rest still bears, degrees; NaN where none was found."""
        margins = [(h.get("margin") or {}).get("margin_deg") for h in self._data["heaps"]]
        return np.array([np.nan if m is None else m for m in margins], dtype=np.float64)

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

    def to_pandas(self) -> pandas.DataFrame:
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


def heaps(
    protocol: Literal["drain", "funnel", "cylinder", "tilt", "drum", "hopper", "shear"],
    *,
    seeds: int | Sequence[int] = 1,
    skip_margin: bool = False,
    keep_all: bool = False,
    threads: int = 0,
    progress: Progress = False,
    **values: Any,
) -> Heaps:
    """Make heaps of grains and measure their angle of repose, or what a drum, a hopper or a shear
    box shows: what the command does with
    ``repose PROTOCOL --question repose``.

    Parameters
    ----------
    seeds : int or numbers
        So many seeds from 0 on, or these.
    skip_margin : bool
        Do not ask for the static margin of the heaps at rest.
    values
        ``grains=400``, ``grain="clump"``, ``elongation``, ``corners``, ``diameter`` (m), ``sizes``,
        ``friction``, ``wall_friction``, ``rolling_arm``, ``restitution``, ``density``, ``size``,
        ``rate``, ``pressure``, ``drop``, ``floor``. A grading curve is ``sizes=[[0.002, 0], [0.004, 0.4], [0.008, 1]]``
        with ``diameter`` the unit of lengths.
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
    """What was looked for in a scene: mistakes, near misses, overlaps, loose blocks."""

    findings: list[Finding]
    """All that is to be known."""

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
    """Prove a saved answer from its scene, or look for mistakes in a scene.

    Parameters
    ----------
    what : answer, scene, or the path of one of them
    scene : scene, optional
        Prove the answer from this scene instead of its own.
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
        raise ValueError("only answers are proved from a scene")
    return Inspection([Finding(*each) for each in load(what)._core.findings()])
