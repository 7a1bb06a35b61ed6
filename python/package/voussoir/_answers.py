"""Answers as typed objects. Numbers are those of the command, to the last bit."""

from __future__ import annotations

import html
import os
from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar, TypeAlias

import numpy as np
import numpy.typing as npt

from . import _core
from ._scene import Scene

if TYPE_CHECKING:
    import pandas

Array: TypeAlias = npt.NDArray[np.float64]


class Verdict(str, Enum):
    """Does it stand?"""

    STABLE = "stable"
    """Forces inside the friction cones balance every block, and the loads produce them."""
    CONDITIONAL = "conditional"
    """Such forces exist, but they need self-stress. Not safe."""
    UNSTABLE = "unstable"
    """It falls: proved by a mechanism."""
    UNDECIDED = "undecided"
    """Neither proof closes; see ``answer.doubt``."""

    def __str__(self) -> str:
        return self.value

    def __bool__(self) -> bool:
        """Whether it stands: true for ``stable`` alone."""
        return self is Verdict.STABLE


@dataclass(frozen=True)
class Bracket:
    """A number between two ends."""

    lower: float
    """The lower end; minus infinity where there is none."""
    upper: float
    """The upper end; infinity where there is none."""


@dataclass(frozen=True)
class Bound:
    """A load factor for joints that open as they slide: never below the one with dry friction."""

    status: str
    """``found``, ``unbounded``, ``impossible``, ``undecided``."""
    value: float | None
    lower: float | None
    upper: float | None

    @classmethod
    def _of(cls, data: dict[str, Any]) -> Bound:
        return cls(data["status"], data.get("value"), data.get("lower"), data.get("upper"))


@dataclass(frozen=True)
class LoadFactor:
    """A load factor, or a tilt: its tangent or its angle in degrees."""

    status: str
    """``found``, ``unbounded``, ``impossible``, ``at_least``, ``not_at_rest``, ``undecided``."""
    law: str
    """The law of sliding that ``value`` holds for: ``coulomb`` is dry friction."""
    value: float | None
    """The one to use; ``None`` where none was found."""
    lower: float | None
    """Lower end of its bracket."""
    upper: float | None
    """Upper end of its bracket."""
    found: str | None
    """How the value with dry friction was found."""
    associative: Bound
    """The bound."""

    @classmethod
    def _of(cls, data: dict[str, Any]) -> LoadFactor:
        return cls(
            data["status"],
            data["law"],
            data.get("value"),
            data.get("lower"),
            data.get("upper"),
            data.get("found"),
            Bound._of(data["associative"]),
        )

    def __float__(self) -> float:
        """The value; infinite where there is no limit, not a number where there is none."""
        if self.value is not None:
            return self.value
        return float("inf") if self.status == "unbounded" else float("nan")


@dataclass(frozen=True)
class Finding:
    """Something to be known although the work went on."""

    code: str
    """What kind of thing it is: ``units``, ``overlap``, ``near_miss``, …"""
    text: str
    """One sentence with its numbers."""
    is_implausible: bool
    """Whether another scene is likely meant."""
    is_mistake: bool
    """Whether it is likely a mistake in the scene."""

    def __str__(self) -> str:
        return self.text


@dataclass(frozen=True)
class Doubt:
    """Why an answer is undecided."""

    cause: str
    evidence: str
    next: str
    """The one thing to do."""


@dataclass(frozen=True)
class JointMotion:
    """A joint of a mechanism."""

    between: tuple[str, str]
    motion: str
    """``hinge``, ``slide``, ``hinge_and_slide``, ``part``, ``crush``."""
    at: tuple[float, float, float]
    """Where, m."""


@dataclass(frozen=True)
class Mechanism:
    """How it fails, in words; ``Rates`` has it in numbers."""

    moving: list[str]
    """Moving blocks, the fastest first."""
    joints: list[JointMotion]
    members: list[dict[str, Any]]
    """Members that yield, go slack or slide."""


@dataclass(frozen=True, eq=False)
class Rates:
    """The motion of a mechanism (any common scale); blocks at rest are left out."""

    blocks: list[str]
    """Ids, n of them."""
    velocity: Array
    """Of the centres of mass, shape (n, 3)."""
    spin: Array
    """Shape (n, 3)."""


@dataclass(frozen=True, eq=False)
class Forces:
    """The forces of a certificate. They act on the second block of each joint."""

    between: list[tuple[str, str]]
    """The two blocks of each joint, m of them."""
    offsets: npt.NDArray[np.int64]
    """Joint ``k`` has the points ``offsets[k]`` to ``offsets[k + 1]``; shape (m + 1,)."""
    points: Array
    """Contact points, m; shape (n, 3)."""
    forces: Array
    """Force at each point, N; shape (n, 3)."""
    couples: Array
    """Couple at each point, N·m; shape (n, 3), or (0, 3) where there are none."""

    def __len__(self) -> int:
        return len(self.between)

    def __iter__(self) -> Iterator[tuple[tuple[str, str], Array, Array]]:
        """Joint by joint: its blocks, its points, its forces (views, not copies)."""
        for k, pair in enumerate(self.between):
            own = slice(int(self.offsets[k]), int(self.offsets[k + 1]))
            yield pair, self.points[own], self.forces[own]

    def resultants(self) -> Array:
        """The sum of the forces of each joint, N; shape (m, 3)."""
        sums = np.concatenate([np.zeros((1, 3)), np.cumsum(self.forces, axis=0)])
        total: Array = sums[self.offsets[1:]] - sums[self.offsets[:-1]]
        return total

    def to_pandas(self) -> pandas.DataFrame:
        """One row a contact point: ``a``, ``b``, ``joint``, ``x``, ``y``, ``z`` (m), ``fx``, ``fy``,
        ``fz`` (N)."""
        import pandas

        joint = np.repeat(np.arange(len(self)), np.diff(self.offsets))
        ids = np.asarray(self.between, dtype=object).reshape(-1, 2)[joint]
        frame = {"a": ids[:, 0], "b": ids[:, 1], "joint": joint}
        for k, axis in enumerate("xyz"):
            frame[axis] = self.points[:, k]
        for k, axis in enumerate("xyz"):
            frame[f"f{axis}"] = self.forces[:, k]
        return pandas.DataFrame(frame)


@dataclass(frozen=True, eq=False)
class Certificate:
    """The evidence for an answer, checked on the scene by nothing that found it."""

    claim: dict[str, Any] | None
    """What is claimed; ``None`` where it is undecided."""
    verified: list[str]
    """What the check found, in words and numbers."""
    forces: Forces
    """The static side."""
    rates: Rates
    """The kinematic side."""

    @property
    def claims(self) -> str | None:
        """What is claimed, in a word: ``stable``, ``load_factor``, …"""
        return next(iter(self.claim), None) if isinstance(self.claim, dict) else self.claim


@dataclass(frozen=True, eq=False)
class Blocks:
    """The blocks of a scene as it was resolved, n of them."""

    ids: list[str]
    supports: npt.NDArray[np.bool_]
    """Whether each is held in place; shape (n,)."""
    mass: Array
    """kg; shape (n,)."""
    centroid: Array
    """Centres of mass, m; shape (n, 3)."""


@dataclass(frozen=True)
class Verification:
    """What the check of a saved answer found, from its scene alone."""

    confirmed: bool
    """Whether it claims something, every part holds, and nothing stayed open."""
    grade: Any
    """The weakest of what it rests on: ``"exact"``, ``{"to_rounding": number}``, ``"computed"`` (and
    computed again), ``"unchecked"``, ``"refuted"``, ``"nothing"`` (nothing is claimed)."""
    parts: list[dict[str, Any]]
    """``title``, ``grade``, ``fails``, ``holds``, ``open`` of every part."""
    answer: dict[str, Any] | None
    """The answer as it follows from the evidence."""
    text: str
    """All of it, in words."""

    def __bool__(self) -> bool:
        return self.confirmed

    def __str__(self) -> str:
        return self.text


class Answer:
    """What every answer has. ``str(answer)`` is what the command prints."""

    question: ClassVar[str] = ""

    def __init__(self, core: _core.Answer) -> None:
        self._core = core

    # ------------------------------------------------------------------- words

    @cached_property
    def _answer(self) -> dict[str, Any]:
        answer: dict[str, Any] = self._core.part("answer")
        return answer

    @property
    def title(self) -> str:
        """The first line of the answer."""
        return self._core.text(brief=True).strip()

    def text(self, *, verbose: bool = False) -> str:
        """The answer in words, as the command prints it."""
        return self._core.text(verbose=verbose)

    def __str__(self) -> str:
        return self._core.text()

    def __repr__(self) -> str:
        return f"<voussoir.{type(self).__name__} {self.title}>"

    # ----------------------------------------------------------------- numbers

    @property
    def verdict(self) -> Verdict | None:
        """Does it stand? Of a load factor or a tilt: without the live load, where that was asked."""
        word = self._answer.get("verdict")
        return None if word is None else Verdict(word)

    @property
    def proof(self) -> Any:
        """``"exact"``, or ``{"to_rounding": number}`` with the number that the proof rests on;
        ``None`` where nothing is proved."""
        return self._answer.get("proof")

    @property
    def sensitivity(self) -> list[dict[str, Any]]:
        """How the value changes with every number that was assumed, the one that matters most first;
        empty where that was not asked. Keys as in the JSON of the command."""
        found: dict[str, Any] = self._answer.get("sensitivity", {})
        return list(found.get("numbers", []))

    @property
    def warnings(self) -> list[Finding]:
        """What is to be known about the scene and its answer."""
        return [Finding(*each) for each in self._core.warnings()]

    @property
    def doubt(self) -> Doubt | None:
        """Why it is undecided, where it is."""
        doubt = self._core.part("doubt")
        return None if doubt is None else Doubt(doubt["cause"], doubt["evidence"], doubt["next"])

    @property
    def scene(self) -> Scene:
        """The scene that was asked about."""
        return Scene._of(self._core.scene())

    @cached_property
    def blocks(self) -> Blocks:
        """The blocks as they were resolved."""
        ids, supports, mass, centroid = self._core.blocks()
        return Blocks(ids, np.asarray(supports, dtype=np.bool_), mass, centroid)

    def _certificate(self, which: str) -> Certificate | None:
        told = self._core.claim(which)
        forces, rates = self._core.forces(which), self._core.rates(which)
        if told is None or forces is None or rates is None:
            return None
        return Certificate(told[0], told[1], Forces(*forces), Rates(*rates))

    @cached_property
    def certificate(self) -> Certificate:
        """The evidence for the verdict, or for the bound on a load factor."""
        certificate = self._certificate("answer")
        assert certificate is not None
        return certificate

    @property
    def forces(self) -> Array:
        """The forces of the certificate at all contact points, N; shape (points, 3). They act on the
        second block of their joint; joint ``k`` has the rows ``offsets[k]`` to ``offsets[k + 1]``."""
        return self.certificate.forces.forces

    @property
    def points(self) -> Array:
        """Where the forces act, m; shape (points, 3)."""
        return self.certificate.forces.points

    @property
    def offsets(self) -> npt.NDArray[np.int64]:
        """Where the points of each joint begin; shape (joints + 1,)."""
        return self.certificate.forces.offsets

    @property
    def joints(self) -> list[tuple[str, str]]:
        """The two blocks of each joint."""
        return self.certificate.forces.between

    @cached_property
    def axes(self) -> Array:
        """The axes of each joint, shape (joints, 3, 3): rows ``t1``, ``t2`` and the normal ``n`` from
        its first block into its second, right-handed. Components of forces are
        ``forces @ axes[k].T``."""
        axes: Array = self._core.frames()[0].reshape(-1, 3, 3)
        return axes

    @cached_property
    def areas(self) -> Array:
        """The area of each joint that touches, m²; shape (joints,)."""
        return self._core.frames()[1]

    @property
    def mechanism(self) -> Mechanism | None:
        """How it fails, where that is part of the answer."""
        words = self._core.part("mechanism")
        if words is None:
            return None
        joints = [
            JointMotion(tuple(j["between"]), j["motion"], tuple(j["at"])) for j in words["joints"]
        ]
        return Mechanism(list(words["moving"]), joints, list(words.get("members", ())))

    @property
    def members(self) -> list[dict[str, Any]]:
        """The forces in ties, struts and the like, of the forces that prove the answer."""
        members: list[dict[str, Any]] = self._core.part("members")
        return members

    # ------------------------------------------------------------------- files

    def to_dict(self) -> dict[str, Any]:
        """The result file as plain values."""
        import json

        data: dict[str, Any] = json.loads(self.to_json())
        return data

    def to_json(self) -> str:
        """The result file, as ``--json`` prints it."""
        return self._core.json()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the result with its scene and its proof, for :func:`check` and ``voussoir check``."""
        _write(path, self._core.json())

    def report(self, path: str | os.PathLike[str] | None = None) -> str:
        """The answer as a page for a browser (HTML, without any connection to a network), written to
        a file as well where one is named."""
        page = self._core.page()
        if path is not None:
            _write(path, page)
        return page

    def svg(self, view: str | None = None) -> str:
        """A drawing: from ``front``, ``back``, ``left``, ``right``, ``top``, ``corner``, or from a
        direction such as ``"1,-2,0.5"``."""
        return self._core.svg(view)

    def vtk(self, path: str | os.PathLike[str]) -> None:
        """Write a file for ParaView (``.vtp``)."""
        _write(path, self._core.vtp())

    def gltf(self, path: str | os.PathLike[str]) -> None:
        """Write blocks, mechanisms and films for programs that architects use (glTF 2.0): binary where
        the name ends with ``.glb``, else text."""
        if os.fspath(path).lower().endswith(".glb"):
            with open(path, "wb") as file:
                file.write(self._core.glb())
        else:
            _write(path, self._core.gltf())

    def obj(self, path: str | os.PathLike[str]) -> None:
        """Write the displaced blocks (``.obj``)."""
        _write(path, self._core.obj())

    def table(self, which: str = "joints") -> str:
        """A table with commas: ``joints``, ``blocks``, ``members``."""
        return self._core.csv(which)

    def to_pandas(self) -> pandas.DataFrame:
        """The forces of the certificate, one row a contact point."""
        return self.certificate.forces.to_pandas()

    def check(self, scene: Scene | None = None) -> Verification:
        """Prove the answer from its scene, or from another."""
        return _verification(self._core.verify(None if scene is None else scene._core))

    def _repr_svg_(self) -> str:
        return self._core.svg()

    def _repr_html_(self) -> str:
        """The page, in a frame that may run its own scripts and reach nothing else."""
        page = html.escape(self._core.page(), quote=True)
        return (
            f'<iframe sandbox="allow-scripts" srcdoc="{page}" title="{html.escape(self.title)}" '
            'style="width: 100%; height: 640px; border: 0"></iframe>'
        )


def _verification(told: tuple[dict[str, Any], str]) -> Verification:
    data, text = told
    confirmed, grade, parts = data["confirmed"], data["grade"], data["parts"]
    return Verification(confirmed, grade, parts, data.get("answer"), text)


def _write(path: str | os.PathLike[str], text: str) -> None:
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


class Assessment(Answer):
    """Does it stand under its dead load?"""

    question = "assess"

    @property
    def verdict(self) -> Verdict:
        """Does it stand?"""
        return Verdict(self._answer["verdict"])

    @property
    def equilibrium_error(self) -> Bracket:
        """The least equilibrium error, in multiples of gravity: 0 where admissible forces exist."""
        return _bracket(self._answer["equilibrium_error"])

    @property
    def law(self) -> str | None:
        """It stands: for which law of sliding."""
        return self._answer.get("law")

    @property
    def simulation(self) -> dict[str, Any] | None:
        """What happened in time, where that was asked as well."""
        seen: dict[str, Any] | None = self._core.part("simulation")
        return seen


def _bracket(data: dict[str, Any]) -> Bracket:
    lower, upper = data.get("lower"), data.get("upper")
    return Bracket(-np.inf if lower is None else lower, np.inf if upper is None else upper)


class Limit(Answer):
    """How large may the live load grow?"""

    question = "limit"

    @property
    def load_factor(self) -> LoadFactor:
        """The load factor on the live load."""
        return LoadFactor._of(self._answer["load_factor"])

    @cached_property
    def dry(self) -> Certificate | None:
        """The evidence for the value with dry friction, where it is another than the bound's."""
        return self._certificate("dry")

    @cached_property
    def dead_load(self) -> Certificate | None:
        """The evidence for the verdict without the live load."""
        return self._certificate("dead_load")


class Moving(Answer):
    """How heavy may a train be? The least load factor of all its positions is the answer."""

    question = "moving"

    @property
    def _own(self) -> dict[str, Any]:
        own: dict[str, Any] = self._answer["moving"]
        return own

    @property
    def load_factor(self) -> LoadFactor:
        """The least load factor on the forces of the axles."""
        return LoadFactor._of(self._own["load_factor"])

    @property
    def x(self) -> float:
        """Where the train's origin is there, m."""
        return float(self._own["x"])

    @property
    def travel(self) -> str:
        """Which way it goes there: ``forward`` (towards +x) or ``backward``."""
        return str(self._own["travel"])

    @property
    def axles(self) -> list[dict[str, Any]]:
        """The axles on the spans there: ``axle`` (from 0), ``x`` (m), ``force`` (N), ``share``."""
        axles: list[dict[str, Any]] = self._own["axles"]
        return axles


class Tilt(Answer):
    """At what tilt of the ground does it fall? The least of all directions is the answer."""

    question = "tilt"

    @property
    def tilt_deg(self) -> LoadFactor:
        """The tilt in degrees."""
        return LoadFactor._of(self._answer["tilt_deg"])

    @property
    def tan_tilt(self) -> LoadFactor:
        """Its tangent: the load factor on the weight sideways."""
        return LoadFactor._of(self._answer["tan_tilt"])

    @property
    def toward(self) -> tuple[float, float, float]:
        """The direction of the least tilt."""
        x, y, z = self._answer["toward"]
        return (x, y, z)

    @property
    def directions(self) -> list[tuple[tuple[float, float, float], LoadFactor]]:
        """Every direction asked for, with its tilt in degrees."""
        listed = self._core.part("directions") or [self._answer]
        return [(tuple(d["toward"]), LoadFactor._of(d["tilt_deg"])) for d in listed]


@dataclass(frozen=True)
class CriticalValue:
    """A value at which the verdict flips, between the nearest proved ones."""

    value: float
    lower: float
    """The nearest value below whose verdict is proved."""
    upper: float
    """The nearest value above whose verdict is proved."""
    below: Verdict
    """The verdict below."""
    above: Verdict
    """The verdict above."""


class Critical(Answer):
    """At what value of a number in the scene does the verdict flip?"""

    question = "critical"

    @property
    def values(self) -> list[CriticalValue]:
        """The flips, in order."""
        return [
            CriticalValue(
                c["value"], c["lower"], c["upper"], Verdict(c["below"]), Verdict(c["above"])
            )
            for c in self._answer["critical"]
        ]

    @property
    def value(self) -> float | None:
        """The first flip; ``None`` where there is none."""
        return self.values[0].value if self.values else None

    @property
    def scan(self) -> list[dict[str, Any]]:
        """Every value that was scanned, with its verdict."""
        scan: list[dict[str, Any]] = self._core.part("critical")["scan"]
        return scan


class Thrust(Answer):
    """How hard does it push a support, or what is the force in a member, at least and at most?"""

    question = "thrust"

    @property
    def _thrust(self) -> dict[str, Any] | None:
        return self._answer.get("thrust")

    @property
    def stands(self) -> bool:
        """Whether there is a range at all; where not, ``verdict`` says why."""
        return self._thrust is not None

    @property
    def least(self) -> Bound | None:
        """The least thrust, N."""
        return None if self._thrust is None else Bound._of(self._thrust["least"])

    @property
    def greatest(self) -> Bound | None:
        """The greatest thrust, N."""
        return None if self._thrust is None else Bound._of(self._thrust["greatest"])

    @property
    def support(self) -> str | None:
        """The support that is pushed."""
        return None if self._thrust is None else self._thrust.get("support")

    @property
    def geometric_factor(self) -> Any:
        """The geometric safety factor, where it was asked and found."""
        return None if self._thrust is None else self._thrust.get("geometric_factor")

    @cached_property
    def certificate(self) -> Certificate:
        """The evidence for the least thrust; of a scene that does not stand, for its verdict."""
        certificate = self._certificate("least") or self._certificate("answer")
        assert certificate is not None
        return certificate

    @cached_property
    def greatest_certificate(self) -> Certificate | None:
        """The evidence for the greatest thrust."""
        return self._certificate("greatest")


class Path(Answer):
    """A movement followed: of supports (``settle``), or of the structure under its live load
    (``push``)."""

    @property
    def _path(self) -> dict[str, Any]:
        path: dict[str, Any] = self._answer["path"]
        return path

    @property
    def question(self) -> str:  # type: ignore[override]
        """``settle`` or ``push``."""
        return str(self._core.question())

    @property
    def status(self) -> str:
        """``reached``, ``falls``, ``vanishes``, ``slides``, ``open``."""
        return str(self._path["status"])

    @property
    def value(self) -> float | None:
        """The last value of the parameter that is proved: a share of the movement, or a way in m."""
        return self._path.get("value")

    @property
    def falls_at(self) -> float | None:
        """The value at which it is proved to fall."""
        return self._path.get("falls_at")

    @property
    def least_reaction(self) -> dict[str, float] | None:
        """What the supports are pushed with as they begin to move."""
        return self._path.get("least_reaction")

    @property
    def why(self) -> str | None:
        """Why it was not followed any further."""
        return self._path.get("why")

    @cached_property
    def _result(self) -> dict[str, Any]:
        result: dict[str, Any] = self._core.part("path")
        return result

    @property
    def events(self) -> list[dict[str, Any]]:
        """What happened on the way: hinges that open and close, jumps, the fall."""
        events: list[dict[str, Any]] = self._result["events"]
        return events

    @property
    def parameter(self) -> Array:
        """The parameter at every point of the curve; shape (n,)."""
        return np.array([p["value"] for p in self._result["points"]], dtype=np.float64)

    @property
    def load_factor(self) -> Array:
        """The load factor at every point of the curve (NaN for ``settle``); shape (n,)."""
        points = self._result["points"]
        return np.array([p.get("load_factor", np.nan) for p in points], dtype=np.float64)

    def certificate_at(self, point: int) -> Certificate:
        """The evidence for a point of the curve."""
        certificate = self._certificate(f"path/{range(len(self._result['points']))[point]}")
        assert certificate is not None
        return certificate

    def to_pandas(self) -> pandas.DataFrame:
        """The curve, one row a point, as ``--csv`` writes it."""
        import io

        import pandas

        return pandas.read_csv(io.StringIO(self._core.csv("path")))


class Kinematic(Answer):
    """Under an earthquake: at what acceleration does it start to move, and what then?"""

    question = "kinematic"

    @property
    def _own(self) -> dict[str, Any]:
        own: dict[str, Any] = self._answer["kinematic"]
        return own

    @property
    def _numbers(self) -> dict[str, Any]:
        numbers: dict[str, Any] = self._own["numbers"]
        return numbers

    @property
    def toward(self) -> tuple[float, float, float]:
        """The worst direction asked for."""
        x, y, z = self._own["toward"]
        return (x, y, z)

    @property
    def alpha0(self) -> LoadFactor:
        """The share of all weights that, pushing that way, sets it moving."""
        return LoadFactor._of(self._own["alpha0"])

    @property
    def confidence(self) -> float:
        """The factor of confidence FC."""
        return float(self._own["fc"])

    @property
    def a0(self) -> float | None:
        """α0 g / (e* FC), m/s²; ``None`` where α0 was not found."""
        return self._numbers.get("a0")

    @property
    def participation(self) -> dict[str, Any] | None:
        """What of the mass takes part: ``e_star``, ``mass`` (M*, kg), δ of every mass."""
        return self._numbers.get("participation")

    @property
    def capacity(self) -> dict[str, Any] | None:
        """What the capacity curve gives where it vanishes: ``d0`` (m), limit states."""
        return self._numbers.get("capacity")

    @property
    def demand(self) -> dict[str, Any] | None:
        """What the site demands, where the scene has one: ``ratio`` and the checks."""
        return self._numbers.get("demand")

    @property
    def no_curve(self) -> str | None:
        """Why there is no capacity curve."""
        return self._own.get("no_curve")

    def to_pandas(self) -> pandas.DataFrame:
        """The masses that move, one row a mass."""
        import pandas

        return pandas.DataFrame((self.participation or {}).get("masses", []))


class Stages(Answer):
    """Does every stage of its construction stand, and how safely?"""

    question = "stages"

    @property
    def _own(self) -> dict[str, Any]:
        own: dict[str, Any] = self._answer["stages"]
        return own

    @property
    def worst(self) -> str:
        """The worst stage."""
        return str(self._own["worst"])

    @property
    def worst_verdict(self) -> Verdict:
        """Its verdict."""
        return Verdict(self._own["verdict"])

    @property
    def count(self) -> int:
        """How many stages there are."""
        return int(self._own["stages"])

    @property
    def stand_first(self) -> int:
        """How many stand, from the first on."""
        return int(self._own["stand_first"])

    @property
    def order(self) -> list[str] | None:
        """Of an order: the blocks as they are placed; empty where none was found."""
        order = self.to_dict()["answer"]["each_stage"].get("order")
        return None if order is None else [p["block"] for p in order.get("placed", [])]

    @property
    def most_held(self) -> int | None:
        """Of an order: the most blocks that are held at a time."""
        return self._own.get("most_held")

    @property
    def least_held(self) -> int | None:
        """Of an order: with fewer held at a time a search found none (computed, not proved)."""
        return self._own.get("least_held")

    def to_pandas(self) -> pandas.DataFrame:
        """The stages, one row a stage: name, verdict, blocks, load factor, tilt in degrees."""
        import pandas

        def margin(stage: dict[str, Any], key: str) -> float | None:
            value: float | None = stage.get("margin", {}).get(key, {}).get("value")
            return value

        rows = [
            {
                "name": stage["name"],
                "verdict": stage["verdict"]["verdict"],
                "blocks": stage["blocks"],
                "held": stage.get("held", []),
                "load_factor": margin(stage, "load_factor"),
                "tilt_deg": margin(stage, "tilt_deg"),
            }
            for stage in self.to_dict()["answer"]["each_stage"]["list"]
        ]
        return pandas.DataFrame(rows)


class Without(Answer):
    """Which single blocks may be taken out with everything left standing?"""

    question = "without"

    @property
    def _own(self) -> dict[str, Any]:
        own: dict[str, Any] = self._answer["without"]
        return own

    @property
    def removable(self) -> list[str]:
        """The blocks without which the others stand."""
        return list(self._own["removable"])

    def to_pandas(self) -> pandas.DataFrame:
        """The blocks, one row a block: the verdict on what is left, and what moves then."""
        import pandas

        rows = [
            {"block": w["block"], "verdict": w["verdict"], "moving": w.get("moving", [])}
            for w in self._own["each"]
        ]
        return pandas.DataFrame(rows)


class State(Answer):
    """Which forces and displacements follow from the stiffness of the joints?"""

    question = "state"

    @property
    def _own(self) -> dict[str, Any]:
        own: dict[str, Any] = self._answer["state"]
        return own

    @property
    def verdict(self) -> Verdict:
        """``stable`` where the forces of the state balance every block; else what ``assess`` says."""
        return Verdict(self._own["verdict"])

    @property
    def proof(self) -> Any:
        """How exactly it is proved that it stands; ``None`` where no state was found."""
        return self._own.get("proof")

    @property
    def displacements(self) -> dict[str, Array]:
        """Under the dead load, of the centre of mass of every free block, m; shape (3,) each."""
        said = self._own.get("displacements", [])
        return {d["block"]: np.array(d["displacement"], dtype=np.float64) for d in said}

    @property
    def rotations(self) -> dict[str, Array]:
        """Under the dead load, the rotation vector of every free block, rad; shape (3,) each."""
        said = self._own.get("displacements", [])
        return {d["block"]: np.array(d["rotation"], dtype=np.float64) for d in said}

    @property
    def frequencies(self) -> Array:
        """Lowest frequencies of small motion about the state, Hz, ascending."""
        return np.array(self._own.get("frequencies", []), dtype=np.float64)

    @property
    def residuals(self) -> dict[str, float] | None:
        """What is left of balance, of Signorini's and of Coulomb's conditions."""
        return self._own.get("residuals")

    @property
    def load_factor(self) -> dict[str, Any] | None:
        """Along a live load: ``value``, ``reached``, how the path ended, the bound."""
        return self._own.get("load_factor")

    @property
    def curve(self) -> tuple[Array, Array]:
        """Load factors, shape (n,), and displacements of the control point, m, shape (n, 3)."""
        points = self._own.get("curve", [])
        factors = np.array([p["load_factor"] for p in points], dtype=np.float64)
        ways = [p["displacement"] for p in points]
        return factors, np.array(ways, dtype=np.float64).reshape(-1, 3)

    @property
    def events(self) -> list[dict[str, Any]]:
        """What happens to joints on the way."""
        events: list[dict[str, Any]] = self._own.get("events", [])
        return events

    def to_pandas(self) -> pandas.DataFrame:
        """The joints under the dead load, a row each: blocks, forces in N, pressure in Pa, …"""
        import pandas

        rows = [{**j, "between": " | ".join(j["between"])} for j in self._own.get("joints", [])]
        return pandas.DataFrame(rows)


class Simulation(Answer):
    """What happens in time? A second opinion, not a proof."""

    question = "simulate"

    @property
    def fate(self) -> str:
        """``stands``, ``falls``, ``undecided``: observed, not proved."""
        return str(self._answer["fate"])

    @cached_property
    def simulation(self) -> dict[str, Any]:
        """All of what was seen: ``collapse`` (s), ``runs``, ``agreement``, ``first_motion``, …"""
        seen: dict[str, Any] = self._core.part("simulation")
        return seen

    @property
    def collapse(self) -> float | None:
        """When the first block had fallen, s."""
        return self.simulation.get("collapse")

    @cached_property
    def film(self) -> tuple[Array, Array]:
        """Times, s, shape (frames,), and poses, shape (frames, blocks, 7): centre of mass (m), then
        the rotation from the start as a quaternion w, x, y, z."""
        times, poses = self._core.film()
        return times, poses.reshape(len(times), -1, 7)

    @cached_property
    def frames(self) -> tuple[Array, Array]:
        """The same at the times of ``frames=``."""
        seen = self._core.part("frames")
        times = np.array([f["time"] for f in seen], dtype=np.float64)
        poses = np.array([f["blocks"] for f in seen], dtype=np.float64)
        return times, poses.reshape(len(times), -1, 7)


class Shaken(Answer):
    """What do all blocks do on ground that moves? One history, not a proof."""

    question = "shake"

    @property
    def _own(self) -> dict[str, Any]:
        own: dict[str, Any] = self._answer["shaken"]
        return own

    @property
    def fate(self) -> str:
        """``rests``, ``moves``, ``overturns``: observed, not proved."""
        return str(self._own["fate"])

    @property
    def overturned(self) -> tuple[str, float] | None:
        """The first block that overturned or fell, and when, s."""
        block = self._own.get("overturned")
        return None if block is None else (str(block), float(self._own["overturned_at"]))

    def to_pandas(self) -> pandas.DataFrame:
        """The free blocks, a row each: thickness (m), greatest way and what is left over it, when
        (s), greatest turn (degrees)."""
        import pandas

        return pandas.DataFrame(self._own["blocks"])

    @cached_property
    def film(self) -> tuple[Array, Array]:
        """Times, s, shape (frames,), and poses, shape (frames, blocks, 7): centre of mass (m), then
        the rotation from the start as a quaternion w, x, y, z."""
        times, poses = self._core.film()
        return times, poses.reshape(len(times), -1, 7)


class Packing(Answer):
    """How steep may a packing of grains be?"""

    question = "repose"

    def to_json(self) -> str:
        """The answer as ``--json`` prints it; :meth:`save` writes the proof of its least direction."""
        text = self._core.packing_json()
        assert text is not None
        return text

    @cached_property
    def packing(self) -> dict[str, Any]:
        """The same as plain values."""
        import json

        packing: dict[str, Any] = json.loads(self.to_json())
        return packing

    @property
    def angle(self) -> LoadFactor:
        """The angle of maximum stability in the least direction, degrees."""
        return LoadFactor._of(self._answer["tilt_deg"])

    @property
    def directions(self) -> list[dict[str, Any]]:
        """Every direction asked for."""
        directions: list[dict[str, Any]] = self.packing["directions"]
        return directions


_KINDS: dict[str, type[Answer]] = {
    "assess": Assessment,
    "limit": Limit,
    "moving": Moving,
    "tilt": Tilt,
    "critical": Critical,
    "thrust": Thrust,
    "settle": Path,
    "push": Path,
    "kinematic": Kinematic,
    "stages": Stages,
    "without": Without,
    "simulate": Simulation,
    "shake": Shaken,
    "state": State,
}


def of_core(core: _core.Answer) -> Answer:
    """The typed object of an answer."""
    return _KINDS.get(core.question(), Answer)(core)
