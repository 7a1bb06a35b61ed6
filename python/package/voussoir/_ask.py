"""The verbs: every question goes through the library's one door, as the command's do."""

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
    Critical,
    Kinematic,
    Limit,
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
from ._scene import SceneLike, Vector, _three, core

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
    law : "coulomb" or "associative"
        Whether the loads must produce the forces that hold it, or such forces need only exist.
    worst : mapping of names to ranges, optional
        Ask about the worst case: ``{"friction": (0.5, 0.7), "density": (2000, 2400)}``.
    simulate : bool or "in doubt"
        Run it in time as well, always or where the verdict is conditional or undecided.
    keep_all : bool
        Leave nothing out that symmetry or missing friction make needless.
    time_limit : float, optional
        Stop trying after so many seconds, with the best bracket so far.
    threads : int
        Of the simulation; 0 for as many as there are processors.
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
    skip_dead: bool = False,
    sensitivity: bool = False,
    keep_all: bool = False,
    time_limit: float | None = None,
    progress: Progress = False,
) -> Limit:
    """How large may the live load grow?

    ``skip_dead`` leaves out whether it stands without its live load; ``sensitivity`` tells how the
    load factor changes with every number that was assumed; other parameters are those of
    :func:`assess`.
    """
    options: dict[str, Any] = {"law": law, "skip_dead": skip_dead, "sensitivity": sensitivity}
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
    skip_dead: bool = False,
    every_value: bool = False,
    keep_all: bool = False,
    time_limit: float | None = None,
    progress: Progress = False,
) -> Moving:
    """How heavy may the train of the scene be that drives over it?

    Every position of it is asked, in both directions of travel, and more around the least, which
    is the answer. With dry friction all but the worst are asked only whether they bear the same,
    unless ``every_value`` is set. Other parameters are those of :func:`limit`.
    """
    options: dict[str, Any] = {"law": law, "skip_dead": skip_dead, "every_value": every_value}
    return Moving(
        _ask(
            scene,
            {"moving": options},
            keep_all=keep_all,
            time_limit=time_limit,
            progress=progress,
        )
    )


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
    skip_dead: bool = False,
    sensitivity: bool = False,
    keep_all: bool = False,
    time_limit: float | None = None,
    progress: Progress = False,
) -> Tilt:
    """At what tilt of the ground does it fall?

    Parameters
    ----------
    toward : one direction or several, optional
        ``(x, y)`` or ``(x, y, z)``.
    all : int, optional
        So many directions evenly spread, the first along x; 8 where nothing is said.
    sensitivity : bool
        How the least tilt changes with every number that was assumed.
    """
    options = {
        "law": law,
        "skip_dead": skip_dead,
        "sensitivity": sensitivity,
        **_directions(toward, all),
    }
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
    """At what value of a number in the scene does the verdict flip?

    Parameters
    ----------
    vary : str
        JSON pointer of the number: ``/templates/0/arch/thickness``.
    between : two numbers
        The range.
    scan : int, optional
        Values that are scanned, both ends among them; 33 where nothing is said.
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
    law: Law = "coulomb",
    keep_all: bool = False,
    time_limit: float | None = None,
    progress: Progress = False,
) -> Thrust:
    """How hard does it push a support, at least and at most?

    Parameters
    ----------
    support : str, optional
        The first one that carries a free block where none is named.
    direction : (x, y) or (x, y, z), optional
        Outwards from the blocks' centre of mass where none is given.
    member : str, optional
        The force in this member of the scene in place of a thrust.
    """
    options: dict[str, Any] = {"law": law, "range": True}
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
    """How far may supports move until it falls?

    Parameters
    ----------
    moves : ids of supports to three numbers, optional
        The way of each while the parameter goes from 0 to 1, m; ``*`` stands for any letters of a
        name: ``{"pier_*": (0, 0, -0.1)}``.
    out : ids of supports to numbers, optional
        The way outwards of each of several supports, m: horizontally away from the mean of the
        centres of mass of all that the name fits: ``{"springer_*": 0.05}``.
    turns_deg : ids of supports to three numbers, optional
        Axis × angle in degrees, about the centre of mass.
    at : numbers from 0 to 1
        Values of the parameter that become points of the curve.
    keep : path, optional
        Every point is in this file as soon as it is proved; the same call takes it up again after a
        kill at any point.
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
    """How does the load factor fall as it moves?

    Parameters
    ----------
    control : (id of a block, three numbers)
        The point whose way is the parameter, m.
    toward : three numbers
        The direction in which its way is measured.
    at : numbers
        Ways that become points of the curve, m.
    keep : path, optional
        As of :func:`settle`.
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
    law: Law = "coulomb",
    skip_dead: bool = False,
    sensitivity: bool = False,
    keep_all: bool = False,
    time_limit: float | None = None,
    progress: Progress = False,
) -> Kinematic:
    """Under an earthquake: at what acceleration does it start to move, and what then?

    Parameters
    ----------
    toward : two or three numbers, or several of them, optional
        Directions of the earthquake.
    all : int, optional
        This many directions instead, evenly spread; 8 where nothing is said.
    control : (id of a block, three numbers), optional
        The point whose way measures the motion.
    fc : float, optional
        Factor of confidence; 1.35 where nothing is said.
    at : numbers
        Ways of the control point that become points of the curve, m.
    linear : bool
        The linear analysis alone, without a curve.
    sensitivity : bool
        How the worst α0 changes with every number that was assumed.
    """
    options: dict[str, Any] = {
        "law": law,
        **_directions(toward, all),
        "at": [float(v) for v in at],
        "linear": linear,
        "skip_dead": skip_dead,
        "sensitivity": sensitivity,
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
    """Does every stage of its construction stand, and how safely?

    Parameters
    ----------
    any_order : bool
        In place of the stages of the scene: an order in which its free blocks can be placed one by
        one, so that it stands all the time with as few of them held as can be.
    order : sequence of str
        The same for a given order: every free block once, ``*`` for any letters of a name.
    hands : int, optional
        So many blocks can be held at a time; any number where nothing is said.
    tries : int, optional
        Sets of blocks that the search looks at, at most; 5000 where nothing is said.
    toward : two or three numbers, or several of them, optional
        Directions of tilts, where a stage has no live load.
    all : int, optional
        This many directions instead, evenly spread; 8 where nothing is said.
    skip_margin : bool
        No load factors and no tilts.
    skip_held : bool
        No least forces on what stages hold.
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
    """Which single blocks may be taken out with everything left standing?"""
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
    """Which forces and displacements follow from the stiffness of the joints?

    Parameters
    ----------
    control : (id of a block, three numbers), optional
        The point whose way along the live load is the curve.
    at : numbers
        Load factors that become points of the curve.
    quadrature : {"area", "corners"}
        Where joints with an area are integrated.
    dead_only : bool
        The state under the dead load alone.
    require : float, optional
        A load factor below this counts as failure.
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
    """What happens in time, and does the verdict say the same?

    Parameters
    ----------
    fast, fine : bool
        Fast steps only, or fine ones from the start.
    seconds : float, optional
        Time to simulate at most, s.
    to_the_end : bool
        Until then although the outcome is clear.
    load_factor : float
        So many times the live loads are added.
    frames : int
        So many frames, evenly spread over the time allowed, are kept in the result.
    film : bool
        Keep a film of what happened, for ``answer.film`` and the page.
    skip_verdict : bool
        Do not ask for the verdict as well.
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
    """What do all blocks do on ground that moves? One history, not a proof.

    Parameters
    ----------
    pulse : mapping, optional
        A formula: ``{"half_sine": {"acceleration": 3, "duration": 0.5}}`` (m/s², s), ``sine`` and
        ``rectangle`` alike, ``{"jump": {"velocity": 0.5}}`` (m/s).
    accelerations : array, optional
        A record in its place: samples in m/s², shape (n,) or (n, 1 to 3): towards ``toward``, to the
        left of it, up.
    step : float
        Seconds between two samples.
    scale : float
        The motion is multiplied by this.
    fast : bool
        Fast steps.
    seconds : float, optional
        Time to simulate at most, s.
    frames : int
        So many times are kept in the result.
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
    """How steep may a packing of grains be: the greatest tilt of gravity that it bears as it lies.

    ``moving_mass`` is the share of the grains' mass that has to move, ``toward`` and ``all`` are
    those of :func:`tilt`.
    """
    options = {"law": law, "moving_mass": moving_mass, **_directions(toward, all)}
    answer = _ask(
        scene, {"repose": options}, keep_all=keep_all, time_limit=time_limit, progress=progress
    )
    return Packing(answer)


def load_answer(path: str | os.PathLike[str]) -> Any:
    """Read a result that :meth:`Answer.save` or ``--save`` wrote. Nothing is proved by reading it:
    :func:`check` does that."""
    with open(path, encoding="utf-8") as file:
        return of_core(_core.Answer.read(os.fspath(path), file.read()))
