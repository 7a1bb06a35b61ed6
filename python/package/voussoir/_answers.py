"""Answers as objects. Numbers are those of the command, to the last bit.

What stands under the keys of an answer is generated (``_answer_keys``); here is what Python adds:
arrays, certificates, files, tables and plots.
"""

from __future__ import annotations

import html
import os
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar, TypeAlias, TypeVar, overload

import numpy as np
import numpy.typing as npt

from . import _core
from . import _answer_keys as keys
from ._record import Verdict, _made
from ._scene import Scene

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes

Array: TypeAlias = npt.NDArray[np.float64]
T = TypeVar("T")
S = TypeVar("S", bound=np.generic)


@overload
def fixed(values: Any) -> Array: ...
@overload
def fixed(values: Any, dtype: type[S]) -> npt.NDArray[S]: ...
def fixed(values: Any, dtype: Any = np.float64) -> Any:
    """An array that is only read."""
    array = np.asarray(values, dtype=dtype)
    array.setflags(write=False)
    return array


@dataclass(frozen=True)
class Finding:
    """Something to know about a scene or its answer.

    Attributes
    ----------
    code : str
        What kind of thing it is: ``units``, ``overlap``, ``near_miss``, ...
    text : str
        One sentence with its numbers.
    is_implausible : bool
        Whether another scene is likely meant.
    is_mistake : bool
        Whether it is likely a mistake in the scene.

    Examples
    --------
    >>> import voussoir
    >>> scene = voussoir.Scene(friction=0.6, density=2400).box("ground", (1, 1, 1), support=True)
    >>> found = voussoir.check(scene.box("block", (1, 1, 1), at=(0, 0, 1.004)))
    >>> found.findings[0].code
    'near_miss'
    """

    code: str
    text: str
    is_implausible: bool
    is_mistake: bool

    def __str__(self) -> str:
        return self.text


@dataclass(frozen=True, eq=False)
class Rates:
    """The rates of a mechanism, to any common scale; blocks at rest are left out.

    Attributes
    ----------
    blocks : list of str
        Ids, n of them.
    velocity : array of shape (n, 3)
        Velocities of the centres of mass.
    spin : array of shape (n, 3)
        Spins.

    Examples
    --------
    >>> import voussoir
    >>> scene = voussoir.Scene(friction=0.6, density=2400).box("ground", (1, 1, 1), support=True)
    >>> rates = voussoir.assess(scene.box("block", (1, 1, 1), at=(0.6, 0, 1))).certificate.rates
    >>> rates.blocks, bool(rates.velocity[0, 2] < 0)
    (['block'], True)
    """

    blocks: list[str]
    velocity: Array
    spin: Array


@dataclass(frozen=True, eq=False)
class Forces:
    """The forces of a certificate, on the second block of each of m joints, at n contact points.

    Iteration gives joint by joint: its two blocks, its points, its forces (views, not copies).

    Attributes
    ----------
    between : list of (str, str)
        The two blocks of each joint.
    offsets : array of shape (m + 1,)
        Joint ``k`` has the points ``offsets[k]`` to ``offsets[k + 1]``.
    points : array of shape (n, 3)
        Contact points, m.
    forces : array of shape (n, 3)
        Force at each point, N.
    couples : array of shape (n, 3) or (0, 3)
        Couple at each point, N·m, where there are any.

    Examples
    --------
    >>> import voussoir
    >>> scene = voussoir.Scene(friction=0.6, density=1000).box("ground", (2, 2, 1), support=True)
    >>> forces = voussoir.assess(scene.box("block", (1, 1, 1), at=(0, 0, 1))).certificate.forces
    >>> for (a, b), points, own in forces:
    ...     print(a, b, points.shape, own.sum(axis=0).round(6) + 0.0)
    ground block (4, 3) [   0.    0. 9810.]
    >>> forces.resultants().shape
    (1, 3)
    """

    between: list[tuple[str, str]]
    offsets: npt.NDArray[np.int64]
    points: Array
    forces: Array
    couples: Array

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

    def to_frame(self) -> pandas.DataFrame:
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
    """The evidence for an answer, checked on the scene by nothing that found it.

    Attributes
    ----------
    claim : dict or None
        What is claimed; ``None`` where it is undecided.
    verified : list of str
        What the check found, in words and numbers.
    forces : Forces
        The static side: forces that balance every block.
    rates : Rates
        The kinematic side: a mechanism.

    Examples
    --------
    >>> import voussoir
    >>> arch = voussoir.Scene("Arch", friction=0.7, density=2400)
    >>> arch.add(voussoir.Arch(radius=1, thickness=0.15, depth=1, voussoirs=9))
    <voussoir.Scene 'Arch': 0 blocks, 1 template>
    >>> certificate = voussoir.assess(arch).certificate
    >>> certificate.claims, len(certificate.forces)
    ('stable', 10)
    """

    claim: dict[str, Any] | None
    verified: list[str]
    forces: Forces
    rates: Rates

    @property
    def claims(self) -> str | None:
        """What is claimed, in a word: ``stable``, ``load_factor``, ..."""
        return next(iter(self.claim), None) if isinstance(self.claim, dict) else self.claim


@dataclass(frozen=True, eq=False)
class Blocks:
    """The blocks of a scene as it was resolved, n of them.

    Attributes
    ----------
    ids : list of str
        Their ids.
    supports : array of bool, shape (n,)
        Whether each is held in place.
    mass : array of shape (n,)
        kg.
    centroid : array of shape (n, 3)
        Centres of mass, m.

    Examples
    --------
    >>> import voussoir
    >>> scene = voussoir.Scene(friction=0.6, density=1000).box("ground", (2, 2, 1), support=True)
    >>> blocks = voussoir.assess(scene.box("block", (1, 1, 1), at=(0, 0, 1))).blocks
    >>> blocks.ids, blocks.supports.tolist(), blocks.mass.tolist()
    (['ground', 'block'], [True, False], [4000.0, 1000.0])
    """

    ids: list[str]
    supports: npt.NDArray[np.bool_]
    mass: Array
    centroid: Array


@dataclass(frozen=True)
class Verification:
    """What the check of a saved answer found, from its scene alone. True where it is confirmed.

    Attributes
    ----------
    confirmed : bool
        Whether it claims something, every part holds, and nothing stayed open.
    grade : str or dict
        The weakest of what it rests on: ``"exact"``, ``{"to_rounding": number}``, ``"computed"``
        (and computed again), ``"unchecked"``, ``"refuted"``, ``"nothing"`` (nothing is claimed).
    parts : list of dict
        ``title``, ``grade``, ``fails``, ``holds``, ``open`` of every part.
    answer : dict or None
        The answer as it follows from the evidence.
    text : str
        All of it, in words.

    Examples
    --------
    >>> import voussoir
    >>> scene = voussoir.Scene(friction=0.6, density=1000).box("ground", (2, 2, 1), support=True)
    >>> answer = voussoir.assess(scene.box("block", (1, 1, 1), at=(0, 0, 1)))
    >>> bool(voussoir.check(answer))
    True
    """

    confirmed: bool
    grade: Any
    parts: list[dict[str, Any]]
    answer: dict[str, Any] | None
    text: str

    def __bool__(self) -> bool:
        return self.confirmed

    def __str__(self) -> str:
        return self.text


class Answer:
    """What every answer has. ``str(answer)`` is what the command prints.

    Answers are values: their arrays are only read, and they can be copied and pickled. An answer is
    proved again from its scene when a pickle is read.

    Examples
    --------
    >>> import pickle, voussoir
    >>> arch = voussoir.Scene("Arch", friction=0.7, density=2400)
    >>> arch.add(voussoir.Arch(radius=1, thickness=0.15, depth=1, voussoirs=9))
    <voussoir.Scene 'Arch': 0 blocks, 1 template>
    >>> answer = voussoir.assess(arch)
    >>> answer.verdict.value, answer.forces.shape, answer.offsets[:3].tolist()
    ('stable', (40, 3), [0, 4, 8])
    >>> pickle.loads(pickle.dumps(answer)).verdict is answer.verdict
    True
    """

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
    def sensitivity(self) -> keys.Sensitivity | None:
        """How the value changes with every number that was assumed, the one that matters most
        first; ``None`` where that was not asked."""
        return self._part("sensitivity", keys.Sensitivity)

    @property
    def required(self) -> keys.Required | None:
        """What was required of it by the question or the scene, and whether that is met."""
        return self._part("required", keys.Required)

    @property
    def warnings(self) -> list[Finding]:
        """What is to be known about the scene and its answer."""
        return [Finding(*each) for each in self._core.warnings()]

    @property
    def doubt(self) -> keys.Doubt | None:
        """Why it is undecided, where it is."""
        return self._part("doubt", keys.Doubt)

    @property
    def scene(self) -> Scene:
        """The scene that was asked about."""
        return Scene._of(self._core.scene())

    @cached_property
    def blocks(self) -> Blocks:
        """The blocks as they were resolved."""
        ids, supports, mass, centroid = self._core.blocks()
        return Blocks(ids, fixed(supports, np.bool_), mass, centroid)

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
    def mechanism(self) -> keys.Mechanism | None:
        """How it fails, where that is part of the answer; ``certificate.rates`` has its rates."""
        return self._part("mechanism", keys.Mechanism)

    @property
    def members(self) -> list[keys.MemberLine]:
        """The forces in ties, struts and the like, of the forces that prove the answer."""
        members: list[keys.MemberLine] = _made(list[keys.MemberLine], self._core.part("members"))
        return members

    def _part(self, name: str, kind: type[T]) -> T | None:
        """A part of the result, of this class; ``None`` where there is none."""
        part = self._core.part(name)
        return None if part is None else _made(kind, part)

    def __reduce__(self) -> tuple[Any, ...]:
        return (_restored, (type(self), self._core.state()))

    def __copy__(self) -> Answer:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Answer:
        return self

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

    def model(self, path: str | os.PathLike[str]) -> list[str]:
        """Write the blocks as a model of another program: of MuJoCo (``.xml``), of 3DEC (``.3ddat``).

        Returns
        -------
        list of str
            What of the scene is not in it, such as loads.
        """
        text, notes = self._core.model(os.path.splitext(path)[1].lstrip(".").lower())
        _write(path, text)
        return notes

    def table(self, which: str = "joints") -> str:
        """A table with commas: ``joints``, ``blocks``, ``members``."""
        return self._core.csv(which)

    def to_frame(self) -> pandas.DataFrame:
        """A table of pandas: the forces of the certificate, one row a contact point.

        Returns
        -------
        pandas.DataFrame
            ``a``, ``b``, ``joint``, ``x``, ``y``, ``z`` (m), ``fx``, ``fy``, ``fz`` (N).

        Raises
        ------
        ImportError
            pandas is not installed.
        """
        return self.certificate.forces.to_frame()

    def check(self, scene: Scene | None = None) -> Verification:
        """Prove the answer from its scene, or from another.

        Parameters
        ----------
        scene : Scene, optional
            Another scene that it is to hold for.
        """
        return _verification(self._core.verify(None if scene is None else scene._core))

    # -------------------------------------------------------------- to look at

    def plot(self, axes: Axes | None = None, *, view: str = "front") -> Axes:
        """Draw it with matplotlib: blocks, displaced by the mechanism where it falls, and the
        resultants of the joints.

        Parameters
        ----------
        axes : matplotlib.axes.Axes, optional
            Where to draw; new ones where none are given.
        view : {"front", "back", "left", "right", "top"}
            From where.

        Returns
        -------
        matplotlib.axes.Axes

        Raises
        ------
        ImportError
            matplotlib is not installed.
        """
        from ._plot import structure

        return structure(self, axes, view)

    def show(self) -> None:
        """Show the page: in a notebook below the cell, elsewhere in a browser."""
        from ._plot import page

        page(self)

    def _repr_svg_(self) -> str:
        return self._core.svg()

    def _repr_html_(self) -> str:
        """The page, in a frame that may run its own scripts and reach nothing else."""
        page = html.escape(self._core.page(), quote=True)
        return (
            f'<iframe sandbox="allow-scripts" srcdoc="{page}" title="{html.escape(self.title)}" '
            'style="width: 100%; height: 640px; border: 0"></iframe>'
        )


def _restored(kind: type[Answer], state: Any) -> Answer:
    return kind(_core.Answer.restored(*state))


def _verification(told: tuple[dict[str, Any], str]) -> Verification:
    data, text = told
    confirmed, grade, parts = data["confirmed"], data["grade"], data["parts"]
    return Verification(confirmed, grade, parts, data.get("answer"), text)


def _write(path: str | os.PathLike[str], text: str) -> None:
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


class Assessment(keys.AssessmentKeys, Answer):
    """The answer of :func:`assess`.

    Examples
    --------
    >>> import voussoir
    >>> arch = voussoir.Scene("Arch", friction=0.7, density=2400)
    >>> arch.add(voussoir.Arch(radius=1, thickness=0.15, depth=1, voussoirs=9))
    <voussoir.Scene 'Arch': 0 blocks, 1 template>
    >>> answer = voussoir.assess(arch)
    >>> answer.verdict.value, answer.equilibrium_error.lower, answer.law
    ('stable', 0.0, 'coulomb')
    """

    question = "assess"

    @property
    def simulation(self) -> keys.Simulated | None:
        """What happened in time, where that was asked as well."""
        return self._part("simulation", keys.Simulated)


class Limit(keys.LimitKeys, Answer):
    """The answer of :func:`limit`.

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    >>> table = table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5))
    >>> answer = voussoir.limit(table.load("live", weight=(1, 0, 0)))
    >>> answer.load_factor.status, round(answer.load_factor.value, 6), answer.verdict.value
    ('found', 0.4, 'stable')
    >>> answer.mechanism.moving
    ['block']
    """

    question = "limit"

    @cached_property
    def dry(self) -> Certificate | None:
        """The evidence for the value with dry friction, where it is another than the bound's."""
        return self._certificate("dry")

    @cached_property
    def dead_load(self) -> Certificate | None:
        """The evidence for the verdict without the live load."""
        return self._certificate("dead_load")


class Moving(keys.MovingKeys, Answer):
    """The answer of :func:`moving`: the least of all positions of the train.

    Examples
    --------
    >>> import voussoir
    >>> span = voussoir.BridgeSpan(clear_span=6, rise=1.5, thickness=0.3, voussoirs=20)
    >>> fill = voussoir.Fill(cover=0.3, unit_weight=18_000)
    >>> bridge = voussoir.Scene("Bridge", friction=0.6, density=2000)
    >>> bridge = bridge.add(voussoir.Bridge(spans=[span], width=3, fill=fill))
    >>> axle = voussoir.Axle(at=0, force=1000)
    >>> bridge = bridge.add(voussoir.Train(axles=[axle], path=(-3, 3), step=1))
    >>> answer = voussoir.moving(bridge, law="associative")
    >>> round(answer.load_factor.value, 1), answer.travel
    (203.1, 'forward')
    """

    question = "moving"


class Tilt(keys.TiltKeys, Answer):
    """The answer of :func:`tilt`: the least of all directions.

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    >>> table = table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5))
    >>> answer = voussoir.tilt(table, toward=[(1, 0), (0, 1)])
    >>> round(answer.tan_tilt.value, 6), answer.toward, len(answer.directions)
    (0.4, (1.0, 0.0, 0.0), 2)
    """

    question = "tilt"

    @property
    def directions(self) -> list[tuple[tuple[float, float, float], keys.LoadFactor]]:
        """Every direction asked for, with its tilt in degrees."""
        listed = self._core.part("directions") or [self._answer]
        return [(tuple(d["toward"]), keys.LoadFactor._of(d["tilt_deg"])) for d in listed]


class Critical(Answer):
    """The answer of :func:`critical`.

    Examples
    --------
    >>> import voussoir
    >>> arch = voussoir.Scene("Arch", friction=0.7, density=2400)
    >>> arch.add(voussoir.Arch(radius=1, thickness=0.15, depth=1, voussoirs=9))
    <voussoir.Scene 'Arch': 0 blocks, 1 template>
    >>> thickness = "/templates/0/arch/thickness"
    >>> answer = voussoir.critical(arch, thickness, (0.05, 0.2), scan=4, law="associative")
    >>> answer.values[0].below.value, answer.values[0].above.value, bool(0.09 < answer.value < 0.11)
    ('unstable', 'stable', True)
    """

    question = "critical"

    @property
    def values(self) -> list[keys.CriticalValue]:
        """Every value at which the verdict changes, in order."""
        return [keys.CriticalValue._of(c) for c in self._answer["critical"]]

    @property
    def value(self) -> float | None:
        """The first of them; ``None`` where there is none."""
        return self.values[0].value if self.values else None

    @cached_property
    def search(self) -> keys.CriticalResult:
        """The scan and both sides of every value."""
        return keys.CriticalResult._of(self._core.part("critical"))

    @property
    def scan(self) -> list[keys.ScanPoint]:
        """Every value that was scanned, with its verdict."""
        return self.search.scan

    def to_frame(self) -> pandas.DataFrame:
        """The scan, one row a value: ``value``, ``verdict``, ends of the equilibrium error."""
        import pandas

        return pandas.DataFrame(
            {
                "value": [p.value for p in self.scan],
                "verdict": [None if p.verdict is None else p.verdict.value for p in self.scan],
            }
        )


class Thrust(keys.ThrustKeys, Answer):
    """The answer of :func:`thrust`. Where the scene does not stand there is no range.

    Examples
    --------
    >>> import voussoir
    >>> arch = voussoir.Scene("Arch", friction=0.7, density=2400)
    >>> arch.add(voussoir.Arch(radius=1, thickness=0.15, depth=1, voussoirs=9))
    <voussoir.Scene 'Arch': 0 blocks, 1 template>
    >>> answer = voussoir.thrust(arch)
    >>> answer.support, bool(0 < answer.least.value < answer.greatest.value)
    ('springer_left', True)
    """

    question = "thrust"

    @property
    def stands(self) -> bool:
        """Whether there is a range at all; where not, ``verdict`` says why."""
        return "thrust" in self._answer

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

    @cached_property
    def line_of_thrust(self) -> keys.ThrustResult | None:
        """The lines of thrust of the least and of the greatest thrust, section by section."""
        return self._part("thrust", keys.ThrustResult)


class Path(keys.PathKeys, Answer):
    """The answer of :func:`settle` and :func:`push`: a movement followed point by point.

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    >>> table = table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5)).load("live", weight=(1, 0, 0))
    >>> answer = voussoir.push(table, ("block", (0, 0, 1)), (1, 0, 0))
    >>> answer.status, round(answer.value, 4), answer.parameter.shape == answer.load_factor.shape
    ('vanishes', 0.3857, True)
    """

    @property
    def question(self) -> str:  # type: ignore[override]
        """``settle`` or ``push``."""
        return str(self._core.question())

    @property
    def why(self) -> str | None:
        """Why it was not followed any further."""
        return self._part("why", keys.Why).path  # type: ignore[union-attr]

    @cached_property
    def result(self) -> keys.PathResult:
        """All points and events."""
        return keys.PathResult._of(self._core.part("path"))

    @property
    def events(self) -> list[keys.PathEvent]:
        """What happened on the way: hinges that open and close, jumps, the fall."""
        return self.result.events

    @cached_property
    def parameter(self) -> Array:
        """The parameter at every point of the curve: a share of the movement, or a displacement
        in m; shape (n,)."""
        return fixed([p.value for p in self.result.points])

    @cached_property
    def load_factor(self) -> Array:
        """The load factor at every point of the curve (NaN for ``settle``); shape (n,)."""
        factors = [p.load_factor for p in self.result.points]
        return fixed([np.nan if f is None else f for f in factors])

    def certificate_at(self, point: int) -> Certificate:
        """The evidence for a point of the curve.

        Parameters
        ----------
        point : int
            Its place on the curve, from 0; -1 for the last.
        """
        certificate = self._certificate(f"path/{range(len(self.parameter))[point]}")
        assert certificate is not None
        return certificate

    def to_frame(self) -> pandas.DataFrame:
        """The curve, one row a point, as ``--csv`` writes it."""
        import io

        import pandas

        return pandas.read_csv(io.StringIO(self._core.csv("path")))

    def plot(self, axes: Axes | None = None, *, view: str = "front") -> Axes:
        """Draw the curve of ``push``: the load factor against the displacement; the structure of
        ``settle``."""
        if self.question == "settle":
            return super().plot(axes, view=view)
        from ._plot import curve

        return curve(axes, self.parameter, self.load_factor, "displacement, m", "load factor")


class Kinematic(keys.KinematicKeys, Answer):
    """The answer of :func:`kinematic`: the worst of all directions.

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    >>> table = table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5))
    >>> answer = voussoir.kinematic(table, toward=(1, 0), fc=1, linear=True)
    >>> round(answer.a0, 3), answer.participation.masses[0].block
    (3.924, 'block')
    """

    question = "kinematic"

    @property
    def no_curve(self) -> str | None:
        """Why there is no capacity curve."""
        return self._part("why", keys.Why).no_curve  # type: ignore[union-attr]

    def to_frame(self) -> pandas.DataFrame:
        """The masses that move, one row a mass."""
        import pandas

        taking_part = self.participation
        return pandas.DataFrame(taking_part.to_dict()["masses"] if taking_part else [])


class Stages(keys.StagesKeys, Answer):
    """The answer of :func:`stages`.

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    >>> table = table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5))
    >>> table = table.add(voussoir.Stage(name="first", add=["block"]))
    >>> answer = voussoir.stages(table)
    >>> answer.verdict.value, answer.worst, round(answer.least_tilt_deg.value, 3)
    ('stable', 'first', 21.801)
    """

    question = "stages"

    @cached_property
    def result(self) -> keys.StagesResult:
        """Every stage."""
        return keys.StagesResult._of(self.to_dict()["answer"]["each_stage"])

    @property
    def order(self) -> list[str] | None:
        """Of an order: the blocks as they are placed; empty where none was found."""
        order = self.result.order
        return None if order is None else [p.block for p in order.placed]

    def to_frame(self) -> pandas.DataFrame:
        """The stages, one row a stage: name, verdict, blocks, load factor, tilt in degrees."""
        import pandas

        def margin(stage: keys.StageResult, key: str) -> float | None:
            value: float | None = (stage.margin or {}).get(key, {}).get("value")
            return value

        rows = [
            {
                "name": stage.name,
                "verdict": stage.verdict["verdict"],
                "blocks": stage.blocks,
                "held": stage.held,
                "load_factor": margin(stage, "load_factor"),
                "tilt_deg": margin(stage, "tilt_deg"),
            }
            for stage in self.result.list
        ]
        return pandas.DataFrame(rows)


class Without(keys.WithoutKeys, Answer):
    """The answer of :func:`without`.

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    >>> table = table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5))
    >>> answer = voussoir.without(table.box("upper", (0.4, 0.4, 1), at=(0, 0, 1.5)))
    >>> answer.removable, [(w.block, w.verdict.value) for w in answer.each]
    (['upper'], [('block', 'unstable'), ('upper', 'stable')])
    """

    question = "without"

    def to_frame(self) -> pandas.DataFrame:
        """The blocks, one row a block: the verdict on what is left, and what moves then."""
        import pandas

        rows = [{"block": w.block, "verdict": w.verdict.value, "moving": w.moving} for w in self.each]
        return pandas.DataFrame(rows)


class State(keys.StateKeys, Answer):
    """The answer of :func:`state`.

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    >>> table = table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5))
    >>> answer = voussoir.state(table.joint(friction=0.6, normal_stiffness=1e9))
    >>> round(answer.joint_states[0].normal_force, 2), len(answer.frequencies)
    (3767.04, 6)
    """

    question = "state"

    @property
    def _state(self) -> dict[str, Any]:
        state: dict[str, Any] = self._answer["state"]
        return state

    def _vectors(self, key: str) -> dict[str, Array]:
        return {d["block"]: fixed(d[key]) for d in self._state.get("displacements", [])}

    @cached_property
    def displacements(self) -> dict[str, Array]:
        """Under the dead load, of the centre of mass of every free block, m; shape (3,) each."""
        return self._vectors("displacement")

    @cached_property
    def rotations(self) -> dict[str, Array]:
        """Under the dead load, the rotation vector of every free block, rad; shape (3,) each."""
        return self._vectors("rotation")

    @cached_property
    def frequencies(self) -> Array:
        """Lowest frequencies of small motion about the state, Hz, ascending; shape (n,)."""
        return fixed(self._state.get("frequencies", []))

    @cached_property
    def curve(self) -> tuple[Array, Array]:
        """Load factors, shape (n,), and displacements of the control point, m, shape (n, 3)."""
        points = self._state.get("curve", [])
        factors = fixed([p["load_factor"] for p in points])
        return factors, fixed([p["displacement"] for p in points] or np.zeros((0, 3)))

    def to_frame(self) -> pandas.DataFrame:
        """The joints under the dead load, a row each: blocks, forces in N, pressure in Pa, ..."""
        import pandas

        rows = [{**j, "between": " | ".join(j["between"])} for j in self._state.get("joints", [])]
        return pandas.DataFrame(rows)

    def plot(self, axes: Axes | None = None, *, view: str = "front") -> Axes:
        """Draw the curve: the load factor against the displacement of the control point; the
        structure where there is no live load."""
        factors, ways = self.curve
        if len(factors) < 2:
            return super().plot(axes, view=view)
        from ._plot import curve

        lengths = np.linalg.norm(ways, axis=1)
        return curve(axes, lengths, factors, "displacement, m", "load factor")


class Simulation(keys.SimulationKeys, Answer):
    """The answer of :func:`simulate`: observed, not proved.

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    >>> table = table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5))
    >>> answer = voussoir.simulate(table, fast=True)
    >>> times, poses = answer.film
    >>> answer.fate, answer.verdict.value, poses.shape[1:]
    ('stands', 'stable', (2, 7))
    """

    question = "simulate"

    @cached_property
    def simulation(self) -> keys.Simulated:
        """All of what was observed."""
        return keys.Simulated._of(self._core.part("simulation"))

    @property
    def collapse(self) -> float | None:
        """When the first block had fallen, s."""
        return self.simulation.collapse

    @cached_property
    def film(self) -> tuple[Array, Array]:
        """Times, s, shape (frames,), and poses, shape (frames, blocks, 7): centre of mass (m), then
        the rotation from the start as a quaternion w, x, y, z."""
        return _film(self._core)

    @cached_property
    def frames(self) -> tuple[Array, Array]:
        """The same at the times of ``frames=``."""
        seen = self._core.part("frames")
        poses = fixed([f["blocks"] for f in seen])
        return fixed([f["time"] for f in seen]), poses.reshape(len(seen), -1, 7)


def _film(core: _core.Answer) -> tuple[Array, Array]:
    times, poses = core.film()
    return times, poses.reshape(len(times), -1, 7)


class Shaken(keys.ShakenKeys, Answer):
    """The answer of :func:`shake`: one time history, not a proof.

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    >>> table = table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5))
    >>> jump = {"jump": {"velocity": 0.05}}
    >>> answer = voussoir.shake(table, pulse=jump, fast=True, seconds=0.5)
    >>> answer.overturned is None, [m.block for m in answer.motions]
    (True, ['block'])
    """

    question = "shake"

    def to_frame(self) -> pandas.DataFrame:
        """The free blocks, a row each: thickness (m), greatest displacement and what is left over
        it, when (s), greatest rotation (degrees)."""
        import pandas

        return pandas.DataFrame([motion.to_dict() for motion in self.motions])

    @cached_property
    def film(self) -> tuple[Array, Array]:
        """Times, s, shape (frames,), and poses, shape (frames, blocks, 7): centre of mass (m), then
        the rotation from the start as a quaternion w, x, y, z."""
        return _film(self._core)


class Packing(keys.TiltKeys, Answer):
    """The answer of :func:`repose`.

    Examples
    --------
    >>> import voussoir
    >>> grains = voussoir.Scene("Grains", friction=0.3, density=2500)
    >>> grains = grains.add(voussoir.Lattice(packing="square", radius=1, layers=1, side=2))
    >>> answer = voussoir.repose(grains, all=4)
    >>> round(answer.tilt_deg.value, 4), len(answer.directions)
    (35.2644, 4)
    """

    question = "repose"

    def to_json(self) -> str:
        """The answer as ``--json`` prints it; :meth:`save` writes the proof of its least direction."""
        text = self._core.packing_json()
        assert text is not None
        return text

    @cached_property
    def packing(self) -> dict[str, Any]:
        """The same as plain values."""
        return self.to_dict()

    @property
    def directions(self) -> list[dict[str, Any]]:
        """Every direction asked for."""
        directions: list[dict[str, Any]] = self.packing["directions"]
        return directions


class Combinations(keys.CombinationsKeys, Answer):
    """The answer of :func:`combinations`.

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    >>> table = table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5))
    >>> table = table.load("live", weight=(1, 0, 0))
    >>> table = table.add(voussoir.Combination(name="ultimate", factors={"dead": 1, "live": 1.5}))
    >>> answer = voussoir.combinations(table, "limit")
    >>> answer.governing, round(answer.each[0].required.obtained, 4), answer.each[0].required.met
    ('ultimate', 0.2667, False)
    """

    question = "combinations"

    def to_frame(self) -> pandas.DataFrame:
        """The combinations, one row each: name, source, what is required and obtained."""
        import pandas

        rows = [c.to_dict() for c in self.each]
        return pandas.DataFrame([{k: v for k, v in r.items() if k != "answer"} for r in rows])


class Meet(keys.MeetKeys, Answer):
    """The answer of :func:`meet`.

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    >>> table = table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5))
    >>> tilt = {"tilt": {"toward": [[1, 0, 0]], "require": 15}}
    >>> (change,) = voussoir.meet(table, tilt, "/joints/default/friction", (0.1, 0.6)).changes
    >>> round(change.met_at, 4)
    0.2679
    """

    question = "meet"


_KINDS: dict[str, type[Answer]] = {
    "assess": Assessment,
    "combinations": Combinations,
    "meet": Meet,
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
