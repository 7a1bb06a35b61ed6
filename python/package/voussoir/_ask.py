"""The questions, asked as the command asks them."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._answers import (
    Assessment,
    Combinations,
    Critical,
    Kinematic,
    Limit,
    Meet,
    Moving,
    Packing,
    Path,
    Shaken,
    Simulation,
    Stages,
    State,
    Thrust,
    Tilt,
    of_core,
    Without,
)
from ._errors import SceneWarning
from ._progress import shown
from ._plain import Vector
from ._scene import SceneLike, _three, core

Law: TypeAlias = Literal["coulomb", "associative"]
"""How joints slide: ``coulomb`` is dry friction; ``associative`` asks for the bound alone."""

Progress: TypeAlias = Callable[[float, float, str], object] | bool
"""Called with how much is done, of how much, and words; ``True`` shows a bar of tqdm."""

Worst: TypeAlias = Mapping[str, tuple[float, float]]
"""Ranges by name: ``friction``, ``density``, ``density:MATERIAL``, ``load``, or a JSON pointer."""


def _ranges(worst: Worst | None) -> list[str]:
    return [f"{name}={low!r}..{high!r}" for name, (low, high) in (worst or {}).items()]


def _ask(
    scene: SceneLike,
    question: dict[str, Any],
    *,
    progress: Progress = False,
    **manner: Any,
) -> _core.Answer:
    with shown(progress) as tell:
        answer = _core.ask(core(scene), question, progress=tell, **manner)
    for _, text, is_implausible, _ in answer.warnings():
        if is_implausible:
            warnings.warn(text, SceneWarning, stacklevel=3)
    words = answer.left_out_words()
    if words is not None:
        warnings.warn(words, SceneWarning, stacklevel=3)
    return answer


def assess(
    scene: SceneLike,
    *,
    law: Law = "coulomb",
    worst: Worst | None = None,
    simulate: bool | Literal["in doubt"] = False,
    keep_all: bool = False,
    time_limit: float | None = None,
    threads: int = 1,
    progress: Progress = False,
) -> Assessment:
    """Does it stand under its dead load?

    Parameters
    ----------
    scene : Scene, path or mapping
        The scene, the path of its file, or what stands in one.
    law : {"coulomb", "associative"}
        How joints slide: dry friction, or opening by friction times slip; the second finds the
        bound alone, and is faster.
    worst : mapping of names to (least, greatest), optional
        The worst case within ranges: ``{"friction": (0.5, 0.7), "density": (2000, 2400)}``. Names:
        ``friction``, ``density``, ``density:MATERIAL``, ``load``, or a JSON pointer.
    simulate : bool or "in doubt"
        Simulate it in time as well: always, or where the verdict is conditional or undecided.
    threads : int
        Threads of the simulation; 0 for one a processor. More than four a processor are not
        started. The answer does not depend on them.
    keep_all : bool
        Do without reductions, such as those by symmetry; nothing is neglected by them.
    time_limit : float, optional
        Seconds after which the best answer so far is given, more than 0.
    progress : callable or bool
        Called with the work done, the total and a text; ``True`` for a bar of tqdm.

    Returns
    -------
    Assessment
        ``verdict``, ``equilibrium_error``, ``forces``, ``mechanism``, ``certificate``, ...

    Raises
    ------
    InputError
        The scene or an option cannot be used as it is.
    VoussoirError
        There is no answer; :class:`TimeIsUp` where there was no time for one.

    References
    ----------
    R. K. Livesley, Int. J. Num. Meth. Eng. 12 (1978); J. Heyman, Int. J. Solids Struct. 2
    (1966); ``docs/guide/law.md``.

    Examples
    --------
    >>> import voussoir
    >>> arch = voussoir.Scene("Arch", friction=0.7, density=2400)
    >>> arch = arch.add(voussoir.Arch(radius=1, thickness=0.15, depth=1, voussoirs=9))
    >>> answer = voussoir.assess(arch)
    >>> print(answer.title)
    Arch: stands
    >>> answer.forces[:, 2].shape
    (40,)
    """
    beside = simulate if isinstance(simulate, str) else "always" if simulate else "never"
    answer = _ask(
        scene,
        {"assess": {"law": law}},
        worst=_ranges(worst),
        simulate=beside,
        film=beside != "never",
        keep_all=keep_all,
        time_limit=time_limit,
        threads=threads,
        progress=progress,
    )
    return Assessment(answer)


def limit(
    scene: SceneLike,
    *,
    law: Law = "coulomb",
    worst: Worst | None = None,
    require: float | None = None,
    skip_dead: bool = False,
    sensitivity: bool = False,
    keep_all: bool = False,
    time_limit: float | None = None,
    progress: Progress = False,
) -> Limit:
    """How large may the live load grow?

    Parameters
    ----------
    scene : Scene, path or mapping
        The scene, the path of its file, or what stands in one.
    law : {"coulomb", "associative"}
        How joints slide: dry friction, or opening by friction times slip; the second finds the
        bound alone, and is faster.
    worst : mapping of names to (least, greatest), optional
        The worst case within ranges: ``{"friction": (0.5, 0.7), "density": (2000, 2400)}``. Names:
        ``friction``, ``density``, ``density:MATERIAL``, ``load``, or a JSON pointer.
    require : float, optional
        A load factor below this is not enough: ``answer.required`` says whether it is met. That of the
        scene where none is given.
    skip_dead : bool
        Do not ask whether it stands without its live load.
    sensitivity : bool
        Tell how the load factor changes with every number that was assumed.
    keep_all : bool
        Do without reductions, such as those by symmetry; nothing is neglected by them.
    time_limit : float, optional
        Seconds after which the best answer so far is given, more than 0.
    progress : callable or bool
        Called with the work done, the total and a text; ``True`` for a bar of tqdm.

    Returns
    -------
    Limit
        ``load_factor`` with ``value``, ``lower``, ``upper`` and the bound ``associative``.

    Raises
    ------
    InputError
        The scene or an option cannot be used as it is; it has no live load.
    VoussoirError
        There is no answer; :class:`TimeIsUp` where there was no time for one.

    References
    ----------
    D. C. Drucker, J. Appl. Mech. 21 (1954); R. K. Livesley, Int. J. Num. Meth. Eng. 12 (1978);
    with dry friction M. C. Ferris, F. Tin-Loi, Int. J. Mech. Sci. 43 (2001), M. Gilbert, C.
    Casapulla, H. M. Ahmed, Comput. Struct. 84 (2006); ``docs/guide/law.md``.

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    >>> table = table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5))
    >>> answer = voussoir.limit(table.load("live", weight=(1, 0, 0)))
    >>> round(answer.load_factor.value, 6)
    0.4
    """
    options: dict[str, Any] = {"law": law, "skip_dead": skip_dead, "sensitivity": sensitivity, **_given(require=require)}
    answer = _ask(
        scene,
        {"limit": options},
        worst=_ranges(worst),
        keep_all=keep_all,
        time_limit=time_limit,
        progress=progress,
    )
    return Limit(answer)


def moving(
    scene: SceneLike,
    *,
    law: Law = "coulomb",
    require: float | None = None,
    skip_dead: bool = False,
    every_value: bool = False,
    keep_all: bool = False,
    time_limit: float | None = None,
    progress: Progress = False,
) -> Moving:
    """How heavy may the train of the scene be that drives over it?

    All positions are asked, in both directions of travel, and more around the least.

    Parameters
    ----------
    scene : Scene, path or mapping
        The scene, the path of its file, or what stands in one.
    law : {"coulomb", "associative"}
        How joints slide: dry friction, or opening by friction times slip; the second finds the
        bound alone, and is faster.
    require : float, optional
        A load factor below this is not enough: ``answer.required`` says whether it is met. That of the
        scene where none is given.
    skip_dead : bool
        Do not ask whether it stands without the train.
    every_value : bool
        Compute every position; by default the others are only shown to be no lower.
    keep_all : bool
        Do without reductions, such as those by symmetry; nothing is neglected by them.
    time_limit : float, optional
        Seconds after which the best answer so far is given, more than 0.
    progress : callable or bool
        Called with the work done, the total and a text; ``True`` for a bar of tqdm.

    Returns
    -------
    Moving
        ``load_factor`` of the worst position, its ``x`` and ``travel``.

    Raises
    ------
    InputError
        The scene or an option cannot be used as it is; it has no train.
    VoussoirError
        There is no answer; :class:`TimeIsUp` where there was no time for one.

    References
    ----------
    ``docs/bridges.md``.

    Examples
    --------
    >>> import voussoir
    >>> span = voussoir.BridgeSpan(clear_span=6, rise=1.5, thickness=0.3, voussoirs=20)
    >>> fill = voussoir.Fill(cover=0.3, unit_weight=18_000)
    >>> bridge = voussoir.Scene("Bridge", friction=0.6, density=2000)
    >>> bridge = bridge.add(voussoir.Bridge(spans=[span], width=3, fill=fill))
    >>> axle = voussoir.Axle(at=0, force=1000)
    >>> bridge = bridge.add(voussoir.Train(axles=[axle], path=(-3, 3), step=1))
    >>> round(voussoir.moving(bridge, law="associative").load_factor.value, 1)
    203.1
    """
    options: dict[str, Any] = {"law": law, "skip_dead": skip_dead, "every_value": every_value}
    options |= _given(require=require)
    return Moving(
        _ask(
            scene,
            {"moving": options},
            keep_all=keep_all,
            time_limit=time_limit,
            progress=progress,
        )
    )


def _given(**options: Any) -> dict[str, Any]:
    """Those options that are given."""
    return {key: value for key, value in options.items() if value is not None}


def _directions(toward: Sequence[Vector] | Vector | None, all: int | None) -> dict[str, Any]:
    if toward is None:
        return {"all": 8 if all is None else all}
    # One direction is a list of one.
    listed = np.atleast_2d(np.asarray(toward, dtype=np.float64)).tolist()
    directions = [[*direction, 0.0][:3] for direction in listed]
    return {"toward": directions} if all is None else {"toward": directions, "all": all}


def tilt(
    scene: SceneLike,
    *,
    toward: Sequence[Vector] | Vector | None = None,
    all: int | None = None,
    law: Law = "coulomb",
    require: float | None = None,
    skip_dead: bool = False,
    sensitivity: bool = False,
    keep_all: bool = False,
    time_limit: float | None = None,
    progress: Progress = False,
) -> Tilt:
    """At what tilt of the ground does it fall?

    Parameters
    ----------
    scene : Scene, path or mapping
        The scene, the path of its file, or what stands in one.
    toward : (x, y), (x, y, z), or several of them, optional
        Directions in which the ground tilts.
    all : int, optional
        This many directions instead, evenly spread, the first along x. Default 8.
    law : {"coulomb", "associative"}
        How joints slide: dry friction, or opening by friction times slip; the second finds the
        bound alone, and is faster.
    require : float, optional
        A tilt, degrees, below this is not enough: ``answer.required`` says whether it is met. That of the
        scene where none is given.
    skip_dead : bool
        Do not ask whether it stands when level.
    sensitivity : bool
        Tell how the least tilt changes with every number that was assumed.
    keep_all : bool
        Do without reductions, such as those by symmetry; nothing is neglected by them.
    time_limit : float, optional
        Seconds after which the best answer so far is given, more than 0.
    progress : callable or bool
        Called with the work done, the total and a text; ``True`` for a bar of tqdm.

    Returns
    -------
    Tilt
        ``tilt_deg``, ``tan_tilt``, ``toward``; all in ``directions``.

    Raises
    ------
    InputError
        The scene or an option cannot be used as it is.
    VoussoirError
        There is no answer; :class:`TimeIsUp` where there was no time for one.

    References
    ----------
    As of :func:`limit`: a tilt is a live load across gravity; ``docs/guide/law.md``.

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    >>> table = table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5))
    >>> round(voussoir.tilt(table, toward=(1, 0)).tilt_deg.value, 3)
    21.801
    """
    options = {"law": law, "skip_dead": skip_dead, "sensitivity": sensitivity, **_directions(toward, all)}
    options |= _given(require=require)
    answer = _ask(
        scene, {"tilt": options}, keep_all=keep_all, time_limit=time_limit, progress=progress
    )
    return Tilt(answer)


def critical(
    scene: SceneLike,
    vary: str,
    between: tuple[float, float],
    *,
    scan: int | None = None,
    law: Law = "coulomb",
    keep_all: bool = False,
    time_limit: float | None = None,
    progress: Progress = False,
) -> Critical:
    """At what value of a number in the scene does the verdict change?

    Parameters
    ----------
    scene : Scene, path or mapping
        The scene, the path of its file, or what stands in one.
    vary : str
        JSON pointer of the number: ``/templates/0/arch/thickness``.
    between : (float, float)
        The range, in the number's own unit.
    scan : int, optional
        Values that are scanned, both ends among them. Default 33.
    law : {"coulomb", "associative"}
        How joints slide: dry friction, or opening by friction times slip; the second finds the
        bound alone, and is faster.
    keep_all : bool
        Do without reductions, such as those by symmetry; nothing is neglected by them.
    time_limit : float, optional
        Seconds after which the best answer so far is given, more than 0.
    progress : callable or bool
        Called with the work done, the total and a text; ``True`` for a bar of tqdm.

    Returns
    -------
    Critical
        ``values``, each with the nearest proved values ``lower`` and ``upper``.

    Raises
    ------
    InputError
        The scene or an option cannot be used as it is.
    VoussoirError
        There is no answer; :class:`TimeIsUp` where there was no time for one.

    References
    ----------
    ``docs/guide/questions.md``.

    Examples
    --------
    >>> import voussoir
    >>> arch = voussoir.Scene("Arch", friction=0.7, density=2400)
    >>> arch = arch.add(voussoir.Arch(radius=1, thickness=0.15, depth=1, voussoirs=9))
    >>> thickness = "/templates/0/arch/thickness"
    >>> answer = voussoir.critical(arch, thickness, (0.05, 0.2), scan=4, law="associative")
    >>> round(answer.value, 4)
    0.1015
    """
    options: dict[str, Any] = {"law": law, "vary": vary, "between": list(between)}
    if scan is not None:
        options["scan"] = scan
    answer = _ask(
        scene, {"critical": options}, keep_all=keep_all, time_limit=time_limit, progress=progress
    )
    return Critical(answer)


def thrust(
    scene: SceneLike,
    *,
    support: str | None = None,
    direction: Vector | None = None,
    member: str | None = None,
    require: float | None = None,
    law: Law = "coulomb",
    keep_all: bool = False,
    time_limit: float | None = None,
    progress: Progress = False,
) -> Thrust:
    """What are the least and the greatest thrust on a support?

    Parameters
    ----------
    scene : Scene, path or mapping
        The scene, the path of its file, or what stands in one.
    support : str, optional
        Id of the support; the first that carries a free block where none is named.
    direction : (x, y) or (x, y, z), optional
        Outwards from the blocks' centre of mass where none is given.
    member : str, optional
        Id of a member: the force in it in place of a thrust.
    require : float, optional
        A geometric safety factor below this is not enough: ``answer.required`` says whether it is
        met.
    law : {"coulomb", "associative"}
        How joints slide: dry friction, or opening by friction times slip; the second finds the
        bound alone, and is faster.
    keep_all : bool
        Do without reductions, such as those by symmetry; nothing is neglected by them.
    time_limit : float, optional
        Seconds after which the best answer so far is given, more than 0.
    progress : callable or bool
        Called with the work done, the total and a text; ``True`` for a bar of tqdm.

    Returns
    -------
    Thrust
        ``least`` and ``greatest``, N; ``geometric_factor``; ``line_of_thrust``.

    Raises
    ------
    InputError
        The scene or an option cannot be used as it is.
    VoussoirError
        There is no answer; :class:`TimeIsUp` where there was no time for one.

    References
    ----------
    J. Heyman, Int. J. Solids Struct. 2 (1966); ``docs/guide/questions.md``.

    Examples
    --------
    >>> import voussoir
    >>> arch = voussoir.Scene("Arch", friction=0.7, density=2400)
    >>> arch = arch.add(voussoir.Arch(radius=1, thickness=0.15, depth=1, voussoirs=9))
    >>> answer = voussoir.thrust(arch)
    >>> round(answer.least.value), round(answer.greatest.value)
    (1839, 2519)
    """
    options: dict[str, Any] = {"law": law, "range": True, **_given(require=require)}
    if support is not None:
        options["support"] = support
    if direction is not None:
        options["direction"] = [*_three(direction), 0.0][:3]
    if member is not None:
        options["member"] = member
    answer = _ask(
        scene, {"thrust": options}, keep_all=keep_all, time_limit=time_limit, progress=progress
    )
    return Thrust(answer)


def settle(
    scene: SceneLike,
    moves: Mapping[str, Vector] | None = None,
    *,
    out: Mapping[str, float] | None = None,
    turns_deg: Mapping[str, Vector] | None = None,
    at: Sequence[float] = (),
    keep: str | os.PathLike[str] | None = None,
    keep_all: bool = False,
    time_limit: float | None = None,
    progress: Progress = False,
) -> Path:
    """How far may supports move before it falls?

    Parameters
    ----------
    scene : Scene, path or mapping
        The scene, the path of its file, or what stands in one.
    moves : mapping of ids to (x, y, z), optional
        Displacement of each support while the parameter goes from 0 to 1, m; ``*`` stands for any
        letters of an id: ``{"pier_*": (0, 0, -0.1)}``.
    out : mapping of ids to float, optional
        Displacement outwards of each of several supports, m: horizontally away from the mean of
        the centres of mass of all that the name fits: ``{"springer_*": 0.05}``.
    turns_deg : mapping of ids to (x, y, z), optional
        Rotation of each support: axis × angle in degrees, about its centre of mass.
    at : sequence of float
        Values of the parameter, 0 to 1, that become points of the curve.
    keep : path, optional
        A checkpoint: every point is written as soon as it is proved; the same call resumes.
    keep_all : bool
        Do without reductions, such as those by symmetry; nothing is neglected by them.
    time_limit : float, optional
        Seconds after which the best answer so far is given, more than 0.
    progress : callable or bool
        Called with the work done, the total and a text; ``True`` for a bar of tqdm.

    Returns
    -------
    Path
        ``status``, ``value``, ``falls_at``, ``least_reaction``, ``parameter``, ``events``.

    Raises
    ------
    InputError
        The scene or an option cannot be used as it is.
    VoussoirError
        There is no answer; :class:`TimeIsUp` where there was no time for one.

    References
    ----------
    ``docs/path.md``.

    Examples
    --------
    >>> import voussoir
    >>> arch = voussoir.Scene("Arch", friction=0.7, density=2400)
    >>> arch = arch.add(voussoir.Arch(radius=1, thickness=0.15, depth=1, voussoirs=9))
    >>> answer = voussoir.settle(arch, out={"springer_*": 0.1})
    >>> answer.status, round(answer.falls_at, 4), float(answer.parameter[0])
    ('falls', 0.6083, 0.0)
    """
    ways, outwards, turns = dict(moves or {}), dict(out or {}), dict(turns_deg or {})
    listed = []
    for support in dict.fromkeys([*ways, *outwards, *turns]):
        move: dict[str, Any] = {"support": support, "way": _three(ways.get(support, (0, 0, 0)))}
        if support in outwards:
            move["out"] = float(outwards[support])
        if support in turns:
            move["turn_deg"] = _three(turns[support])
        listed.append(move)
    question = {"settle": {"moves": listed, "at": [float(v) for v in at]}}
    return Path(
        _ask(
            scene,
            question,
            keep=keep,
            keep_all=keep_all,
            time_limit=time_limit,
            progress=progress,
        )
    )


def push(
    scene: SceneLike,
    control: tuple[str, Vector],
    toward: Vector,
    *,
    at: Sequence[float] = (),
    keep: str | os.PathLike[str] | None = None,
    keep_all: bool = False,
    time_limit: float | None = None,
    progress: Progress = False,
) -> Path:
    """How does the load factor fall as the structure displaces?

    Parameters
    ----------
    scene : Scene, path or mapping
        The scene, the path of its file, or what stands in one.
    control : (id of a block, (x, y, z))
        The point of that block, m, whose displacement is the parameter.
    toward : (x, y, z)
        Direction in which its displacement is measured.
    at : sequence of float
        Displacements that become points of the curve, m.
    keep : path, optional
        A checkpoint: every point is written as soon as it is proved; the same call resumes.
    keep_all : bool
        Do without reductions, such as those by symmetry; nothing is neglected by them.
    time_limit : float, optional
        Seconds after which the best answer so far is given, more than 0.
    progress : callable or bool
        Called with the work done, the total and a text; ``True`` for a bar of tqdm.

    Returns
    -------
    Path
        ``parameter`` (m) and ``load_factor``, arrays; ``status``, ``value``, ``events``.

    Raises
    ------
    InputError
        The scene or an option cannot be used as it is.
    VoussoirError
        There is no answer; :class:`TimeIsUp` where there was no time for one.

    References
    ----------
    ``docs/path.md``.

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    >>> table = table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5))
    >>> table = table.load("live", weight=(1, 0, 0))
    >>> answer = voussoir.push(table, ("block", (0, 0, 1)), (1, 0, 0))
    >>> answer.status, answer.load_factor[[0, -1]].round(3).tolist()
    ('vanishes', [0.4, -0.0])
    """
    block, point = control
    options = {
        "control": {"block": block, "point": _three(point)},
        "toward": _three(toward),
        "at": [float(v) for v in at],
    }
    return Path(
        _ask(
            scene,
            {"push": options},
            keep=keep,
            keep_all=keep_all,
            time_limit=time_limit,
            progress=progress,
        )
    )


def kinematic(
    scene: SceneLike,
    *,
    toward: Vector | Sequence[Vector] | None = None,
    all: int | None = None,
    control: tuple[str, Vector] | None = None,
    fc: float | None = None,
    at: Sequence[float] = (),
    linear: bool = False,
    require: float | None = None,
    site: float | None = None,
    verify: Literal["linear", "displacement"] | None = None,
    law: Law = "coulomb",
    skip_dead: bool = False,
    sensitivity: bool = False,
    keep_all: bool = False,
    time_limit: float | None = None,
    progress: Progress = False,
) -> Kinematic:
    """At what earthquake acceleration does a mechanism start, and what follows?

    Parameters
    ----------
    scene : Scene, path or mapping
        The scene, the path of its file, or what stands in one.
    toward : (x, y), (x, y, z), or several of them, optional
        Directions in which the earthquake pushes.
    all : int, optional
        This many directions instead, evenly spread, the first along x. Default 8.
    control : (id of a block, (x, y, z)), optional
        The point of that block, m, whose displacement measures the motion.
    fc : float, optional
        Factor of confidence. Default 1.35.
    at : sequence of float
        Displacements of the control point that become points of the curve, m.
    linear : bool
        The linear analysis alone, without a curve.
    require : float, optional
        A load factor α0 below this is not enough: ``answer.required`` says whether it is met. That of the
        scene where none is given.
    site : float, optional
        The same for the share ζ_E of the earthquake of the site. Default 1.
    verify : {"linear", "displacement"}, optional
        The verification that governs at the site; both where none is given.
    law : {"coulomb", "associative"}
        How joints slide: dry friction, or opening by friction times slip; the second finds the
        bound alone, and is faster.
    skip_dead : bool
        Do not ask whether it stands without the earthquake.
    sensitivity : bool
        Tell how the load factor of the worst direction changes with every number that was assumed.
    keep_all : bool
        Do without reductions, such as those by symmetry; nothing is neglected by them.
    time_limit : float, optional
        Seconds after which the best answer so far is given, more than 0.
    progress : callable or bool
        Called with the work done, the total and a text; ``True`` for a bar of tqdm.

    Returns
    -------
    Kinematic
        ``alpha0``, ``a0`` (m/s²), ``participation``, ``capacity``, ``demand``.

    Raises
    ------
    InputError
        The scene or an option cannot be used as it is.
    VoussoirError
        There is no answer; :class:`TimeIsUp` where there was no time for one.

    References
    ----------
    NTC 2018; Circolare 21 January 2019 n. 7, C8.7.1.2.1; ``docs/kinematic.md``.

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    >>> table = table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5))
    >>> answer = voussoir.kinematic(table, toward=(1, 0), fc=1, linear=True)
    >>> round(answer.alpha0.value, 6), round(answer.a0, 3)
    (0.4, 3.924)
    """
    options: dict[str, Any] = {
        "law": law,
        **_directions(toward, all),
        "at": [float(v) for v in at],
        "linear": linear,
        "skip_dead": skip_dead, "sensitivity": sensitivity,
        **_given(require=require, site=site, verify=verify),
    }
    if control is not None:
        options["control"] = {"block": control[0], "point": _three(control[1])}
    if fc is not None:
        options["fc"] = float(fc)
    question = {"kinematic": options}
    return Kinematic(
        _ask(scene, question, keep_all=keep_all, time_limit=time_limit, progress=progress)
    )


def stages(
    scene: SceneLike,
    *,
    any_order: bool = False,
    order: Sequence[str] = (),
    hands: int | None = None,
    tries: int | None = None,
    toward: Vector | Sequence[Vector] | None = None,
    all: int | None = None,
    skip_margin: bool = False,
    skip_held: bool = False,
    law: Law = "coulomb",
    keep_all: bool = False,
    time_limit: float | None = None,
    progress: Progress = False,
) -> Stages:
    """Does every stage of construction stand, and with what margin?

    Parameters
    ----------
    scene : Scene, path or mapping
        The scene, the path of its file, or what stands in one.
    any_order : bool
        In place of the stages of the scene: an order in which its free blocks can be placed one by
        one, so that it stands all the time with as few of them held as possible.
    order : sequence of str
        The same for a given order: every free block once, ``*`` for any letters of an id.
    hands : int, optional
        So many blocks can be held at a time; any number where none is given.
    tries : int, optional
        Sets of blocks that the search looks at, at most. Default 5000.
    toward : (x, y), (x, y, z), or several of them, optional
        Directions of tilts, where a stage has no live load.
    all : int, optional
        This many directions instead, evenly spread, the first along x. Default 8.
    skip_margin : bool
        No load factors and no tilts.
    skip_held : bool
        No least forces on what stages hold.
    law : {"coulomb", "associative"}
        How joints slide: dry friction, or opening by friction times slip; the second finds the
        bound alone, and is faster.
    keep_all : bool
        Do without reductions, such as those by symmetry; nothing is neglected by them.
    time_limit : float, optional
        Seconds after which the best answer so far is given, more than 0.
    progress : callable or bool
        Called with the work done, the total and a text; ``True`` for a bar of tqdm.

    Returns
    -------
    Stages
        ``verdict`` and name (``worst``) of the worst stage; all in ``result.list``.

    Raises
    ------
    InputError
        The scene or an option cannot be used as it is.
    VoussoirError
        There is no answer; :class:`TimeIsUp` where there was no time for one.

    References
    ----------
    ``docs/stages.md``.

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    >>> table = table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5))
    >>> answer = voussoir.stages(table.box("upper", (0.4, 0.4, 1), at=(0, 0, 1.5)), any_order=True)
    >>> answer.order, answer.most_held
    (['block', 'upper'], 0)
    """
    options: dict[str, Any] = {
        "law": law,
        "any_order": any_order,
        "order": [order] if isinstance(order, str) else list(order),
        **({} if hands is None else {"hands": hands}),
        **({} if tries is None else {"tries": tries}),
        # No tilts are asked for where an order is.
        **(
            {}
            if (any_order or order) and toward is None and all is None
            else _directions(toward, all)
        ),
        "skip_margin": skip_margin,
        "skip_held": skip_held,
    }
    question = {"stages": options}
    return Stages(
        _ask(scene, question, keep_all=keep_all, time_limit=time_limit, progress=progress)
    )


def without(
    scene: SceneLike,
    *,
    law: Law = "coulomb",
    keep_all: bool = False,
    time_limit: float | None = None,
    progress: Progress = False,
) -> Without:
    """Which single blocks may be removed without a collapse?

    Parameters
    ----------
    scene : Scene, path or mapping
        The scene, the path of its file, or what stands in one.
    law : {"coulomb", "associative"}
        How joints slide: dry friction, or opening by friction times slip; the second finds the
        bound alone, and is faster.
    keep_all : bool
        Do without reductions, such as those by symmetry; nothing is neglected by them.
    time_limit : float, optional
        Seconds after which the best answer so far is given, more than 0.
    progress : callable or bool
        Called with the work done, the total and a text; ``True`` for a bar of tqdm.

    Returns
    -------
    Without
        ``removable`` ids; ``each`` with the verdict on the others.

    Raises
    ------
    InputError
        The scene or an option cannot be used as it is.
    VoussoirError
        There is no answer; :class:`TimeIsUp` where there was no time for one.

    References
    ----------
    ``docs/stages.md``.

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    >>> table = table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5))
    >>> voussoir.without(table.box("upper", (0.4, 0.4, 1), at=(0, 0, 1.5))).removable
    ['upper']
    """
    return Without(
        _ask(
            scene,
            {"without": {"law": law}},
            keep_all=keep_all,
            time_limit=time_limit,
            progress=progress,
        )
    )


def state(
    scene: SceneLike,
    *,
    control: tuple[str, Vector] | None = None,
    at: Sequence[float] = (),
    quadrature: Literal["area", "corners"] = "area",
    dead_only: bool = False,
    require: float | None = None,
    keep_all: bool = False,
    time_limit: float | None = None,
    progress: Progress = False,
) -> State:
    """What forces and displacements follow from the stiffness of the joints?

    Parameters
    ----------
    scene : Scene, path or mapping
        The scene, the path of its file, or what stands in one.
    control : (id of a block, (x, y, z)), optional
        The point of that block, m, whose displacement along the live load is the curve.
    at : sequence of float
        Load factors that become points of the curve.
    quadrature : {"area", "corners"}
        Where joints with an area are integrated.
    dead_only : bool
        The state under the dead load alone.
    require : float, optional
        A load factor below this counts as failure.
    keep_all : bool
        Do without reductions, such as those by symmetry; nothing is neglected by them.
    time_limit : float, optional
        Seconds after which the best answer so far is given, more than 0.
    progress : callable or bool
        Called with the work done, the total and a text; ``True`` for a bar of tqdm.

    Returns
    -------
    State
        ``displacements`` (m), ``rotations`` (rad), ``joint_states``, ``frequencies`` (Hz), ``curve``.

    Raises
    ------
    InputError
        The scene or an option cannot be used as it is; joints have no stiffness.
    VoussoirError
        There is no answer; :class:`TimeIsUp` where there was no time for one.

    References
    ----------
    A. Signorini, Sopra alcune questioni di elastostatica (1933); ``docs/state.md``.

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    >>> table = table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5))
    >>> answer = voussoir.state(table.joint(friction=0.6, normal_stiffness=1e9))
    >>> round(float(answer.displacements["block"][2]), 9)
    -2.3544e-05
    """
    options: dict[str, Any] = {
        "quadrature": quadrature,
        "at": [float(v) for v in at],
        "dead_only": dead_only,
    }
    if control is not None:
        options["control"] = {"block": control[0], "point": _three(control[1])}
    if require is not None:
        options["require"] = float(require)
    return State(
        _ask(
            scene,
            {"state": options},
            keep_all=keep_all,
            time_limit=time_limit,
            progress=progress,
        )
    )


def simulate(
    scene: SceneLike,
    *,
    fast: bool = False,
    fine: bool = False,
    seconds: float | None = None,
    to_the_end: bool = False,
    load_factor: float = 0.0,
    frames: int = 0,
    film: bool = True,
    skip_verdict: bool = False,
    law: Law = "coulomb",
    keep_all: bool = False,
    time_limit: float | None = None,
    threads: int = 1,
    progress: Progress = False,
) -> Simulation:
    """What happens in time, and does it agree with the verdict?

    Parameters
    ----------
    scene : Scene, path or mapping
        The scene, the path of its file, or what stands in one.
    fast, fine : bool
        Fast steps only, or fine ones from the start.
    seconds : float, optional
        Time to simulate at most, s.
    to_the_end : bool
        Until then although the outcome is clear.
    load_factor : float
        This factor × the live loads is added.
    frames : int
        This many frames, evenly spread over the time allowed, are kept in the result.
    film : bool
        Keep a film, for ``answer.film`` and the page.
    skip_verdict : bool
        Do not ask for the verdict as well.
    law : {"coulomb", "associative"}
        How joints slide: dry friction, or opening by friction times slip; the second finds the
        bound alone, and is faster.
    threads : int
        Threads of the simulation; 0 for one a processor. More than four a processor are not
        started. The answer does not depend on them.
    keep_all : bool
        Do without reductions, such as those by symmetry; nothing is neglected by them.
    time_limit : float, optional
        Seconds after which the best answer so far is given, more than 0.
    progress : callable or bool
        Called with the work done, the total and a text; ``True`` for a bar of tqdm.

    Returns
    -------
    Simulation
        ``fate``, ``collapse`` (s), ``film``; observed, not proved.

    Raises
    ------
    InputError
        The scene or an option cannot be used as it is.
    VoussoirError
        There is no answer; :class:`TimeIsUp` where there was no time for one.

    References
    ----------
    ``docs/guide/simulation.md``.

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    >>> table = table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5))
    >>> answer = voussoir.simulate(table, fast=True)
    >>> answer.fate, answer.verdict.value
    ('stands', 'stable')
    """
    options: dict[str, Any] = {
        "fast": fast,
        "fine": fine,
        "to_the_end": to_the_end,
        "load_factor": load_factor,
    }
    if seconds is not None:
        options["seconds"] = seconds
    answer = _ask(
        scene,
        {"simulate": options},
        verdict=None if skip_verdict else law,
        frames=frames,
        film=film,
        keep_all=keep_all,
        time_limit=time_limit,
        threads=threads,
        progress=progress,
    )
    return Simulation(answer)


def shake(
    scene: SceneLike,
    *,
    pulse: Mapping[str, Any] | None = None,
    accelerations: ArrayLike | None = None,
    step: float | None = None,
    name: str = "record",
    scale: float = 1.0,
    toward: Vector = (1.0, 0.0, 0.0),
    fast: bool = False,
    seconds: float | None = None,
    to_the_end: bool = False,
    frames: int = 0,
    film: bool = True,
    keep_all: bool = False,
    time_limit: float | None = None,
    threads: int = 1,
    progress: Progress = False,
) -> Shaken:
    """What do all blocks do on ground that moves? One time history, not a proof.

    Parameters
    ----------
    scene : Scene, path or mapping
        The scene, the path of its file, or what stands in one.
    pulse : mapping, optional
        A formula: ``{"half_sine": {"acceleration": 3, "duration": 0.5}}`` (m/s², s), ``sine`` and
        ``rectangle`` alike, ``{"jump": {"velocity": 0.5}}`` (m/s).
    accelerations : array of shape (n,) or (n, 1 to 3), optional
        A record in its place, m/s²: towards ``toward``, to the left of it, up.
    step : float, optional
        Seconds between two samples of the record.
    name : str
        Name of the record.
    scale : float
        Multiplies the motion.
    toward : (x, y, z)
        Where the first component points.
    fast : bool
        Fast steps.
    seconds : float, optional
        Time to simulate at most, s.
    to_the_end : bool
        Until then although the outcome is clear.
    frames : int
        This many frames are kept in the result.
    film : bool
        Keep a film, for ``answer.film`` and the page.
    threads : int
        Threads of the simulation; 0 for one a processor. More than four a processor are not
        started. The answer does not depend on them.
    keep_all : bool
        Do without reductions, such as those by symmetry; nothing is neglected by them.
    time_limit : float, optional
        Seconds after which the best answer so far is given, more than 0.
    progress : callable or bool
        Called with the work done, the total and a text; ``True`` for a bar of tqdm.

    Returns
    -------
    Shaken
        ``fate``, ``overturned``, ``motions`` of all blocks, ``film``.

    Raises
    ------
    InputError
        The scene or an option cannot be used as it is.
    VoussoirError
        There is no answer; :class:`TimeIsUp` where there was no time for one.

    References
    ----------
    ``docs/ground.md``.

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table = table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    >>> table = table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5))
    >>> sine = {"sine": {"acceleration": 1, "duration": 0.5}}
    >>> voussoir.shake(table, pulse=sine, fast=True).fate
    'rests'
    """
    ground: dict[str, Any] = {"scale": float(scale)}
    if pulse is not None:
        ground["pulse"] = dict(pulse)
    if accelerations is not None:
        samples = np.atleast_2d(np.asarray(accelerations, dtype=np.float64).T)
        ground["record"] = {
            "name": name,
            "step": float(step if step is not None else 0.0),
            "components": samples.tolist(),
        }
    options: dict[str, Any] = {
        "ground": ground,
        "toward": _three(toward),
        "fast": fast,
        "to_the_end": to_the_end,
    }
    if seconds is not None:
        options["seconds"] = seconds
    answer = _ask(
        scene,
        {"shake": options},
        frames=frames,
        film=film,
        keep_all=keep_all,
        time_limit=time_limit,
        threads=threads,
        progress=progress,
    )
    return Shaken(answer)


def repose(
    scene: SceneLike,
    *,
    toward: Sequence[Vector] | Vector | None = None,
    all: int | None = None,
    moving_mass: float = 0.0,
    law: Law = "coulomb",
    keep_all: bool = False,
    time_limit: float | None = None,
    progress: Progress = False,
) -> Packing:
    """How steep may a packing of grains be: the greatest tilt that it bears as it lies.

    Parameters
    ----------
    scene : Scene, path or mapping
        The scene, the path of its file, or what stands in one.
    toward : (x, y), (x, y, z), or several of them, optional
        Directions of the tilt.
    all : int, optional
        This many directions instead, evenly spread, the first along x. Default 8.
    moving_mass : float
        Share of the grains' mass that has to move, 0 to 1.
    law : {"coulomb", "associative"}
        How joints slide: dry friction, or opening by friction times slip; the second finds the
        bound alone, and is faster.
    keep_all : bool
        Do without reductions, such as those by symmetry; nothing is neglected by them.
    time_limit : float, optional
        Seconds after which the best answer so far is given, more than 0.
    progress : callable or bool
        Called with the work done, the total and a text; ``True`` for a bar of tqdm.

    Returns
    -------
    Packing
        ``tilt_deg`` and ``toward`` of the least direction; ``directions``.

    Raises
    ------
    InputError
        The scene or an option cannot be used as it is.
    VoussoirError
        There is no answer; :class:`TimeIsUp` where there was no time for one.

    References
    ----------
    ``docs/grains.md``.

    Examples
    --------
    >>> import voussoir
    >>> grains = voussoir.Scene("Grains", friction=0.3, density=2500)
    >>> grains = grains.add(voussoir.Lattice(packing="square", radius=1, layers=1, side=2))
    >>> round(voussoir.repose(grains, all=4).tilt_deg.value, 4)
    35.2644
    """
    options = {"law": law, "moving_mass": moving_mass, **_directions(toward, all)}
    answer = _ask(
        scene, {"repose": options}, keep_all=keep_all, time_limit=time_limit, progress=progress
    )
    return Packing(answer)


def combinations(
    scene: SceneLike,
    ask: str | Mapping[str, Any] = "limit",
    *,
    only: Sequence[str] = (),
    keep_all: bool = False,
    time_limit: float | None = None,
    progress: Progress = False,
) -> Combinations:
    """What is the answer to a question in every combination of actions?

    Parameters
    ----------
    scene : Scene, path or mapping
        The scene, the path of its file, or what stands in one.
    ask : str or mapping
        The question, ``"assess"``, ``"limit"``, ``"moving"``, ``"tilt"`` or ``"kinematic"``, or with
        its options: ``{"limit": {"law": "associative"}}``.
    only : sequence of str
        Names of combinations; all where none is named.
    keep_all : bool
        Do without reductions, such as those by symmetry; nothing is neglected by them.
    time_limit : float, optional
        Seconds after which the best answer so far is given, more than 0.
    progress : callable or bool
        Called with the work done, the total and a text; ``True`` for a bar of tqdm.

    Returns
    -------
    Combinations
        ``governing``, the name of the worst; all in ``each``.

    Raises
    ------
    InputError
        The scene or an option cannot be used as it is.
    VoussoirError
        There is no answer; :class:`TimeIsUp` where there was no time for one.

    References
    ----------
    ``docs/guide/requirements.md``.

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
    question = {"combinations": {"ask": _nested(ask), "only": list(only)}}
    answer = _ask(
        scene, question, keep_all=keep_all, time_limit=time_limit, progress=progress
    )
    return Combinations(answer)


def meet(
    scene: SceneLike,
    ask: str | Mapping[str, Any],
    vary: str,
    between: tuple[float, float],
    *,
    scan: int | None = None,
    keep_all: bool = False,
    time_limit: float | None = None,
    progress: Progress = False,
) -> Meet:
    """At what value of a number in the scene is what is required of a question met?

    Parameters
    ----------
    scene : Scene, path or mapping
        The scene, the path of its file, or what stands in one.
    ask : str or mapping
        The question, ``"assess"``, ``"limit"``, ``"moving"``, ``"tilt"`` or ``"kinematic"``, or with
        its options: ``{"limit": {"law": "associative"}}``.
        What is required stands among them, as ``"require"``, or in the scene.
    vary : str
        JSON pointer of the number: ``/templates/0/arch/thickness``.
    between : (float, float)
        The range, in the number's own unit.
    scan : int, optional
        Values that are scanned, both ends among them. Default 9.
    keep_all : bool
        Do without reductions, such as those by symmetry; nothing is neglected by them.
    time_limit : float, optional
        Seconds after which the best answer so far is given, more than 0.
    progress : callable or bool
        Called with the work done, the total and a text; ``True`` for a bar of tqdm.

    Returns
    -------
    Meet
        ``changes``, each with the nearest proved values on both sides.

    Raises
    ------
    InputError
        The scene or an option cannot be used as it is.
    VoussoirError
        There is no answer; :class:`TimeIsUp` where there was no time for one.

    References
    ----------
    ``docs/guide/requirements.md``.

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
    options = {"ask": _nested(ask), "vary": vary, "between": list(between), **_given(scan=scan)}
    question = {"meet": options}
    answer = _ask(
        scene, question, keep_all=keep_all, time_limit=time_limit, progress=progress
    )
    return Meet(answer)


def _nested(ask: str | Mapping[str, Any]) -> Mapping[str, Any]:
    return {ask: {}} if isinstance(ask, str) else ask


def load_answer(path: str | os.PathLike[str]) -> Any:
    """Read a result that :meth:`Answer.save` or ``voussoir --save`` wrote.

    Its proof is derived again; what only a solver can compute again is left to :func:`check`.

    Parameters
    ----------
    path : path
        The file.

    Returns
    -------
    Answer
        Of the class of its question.

    Raises
    ------
    InputError
        The file is not a result of this version.
    VoussoirError
        Its evidence does not prove what it claims.

    References
    ----------
    ``docs/answers.md``.

    Examples
    --------
    >>> import pathlib, tempfile, voussoir
    >>> arch = voussoir.Scene("Arch", friction=0.7, density=2400)
    >>> arch = arch.add(voussoir.Arch(radius=1, thickness=0.15, depth=1, voussoirs=9))
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "arch.json"
    >>> voussoir.assess(arch).save(path)
    >>> voussoir.load_answer(path).verdict.value
    'stable'
    """
    with open(path, encoding="utf-8") as file:
        return of_core(_core.Answer.read(os.fspath(path), file.read()))
