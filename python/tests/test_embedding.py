"""Safe inside other programs: values that can be sent and not be changed, options that are refused
by name, threads and memory within bounds, processes that fork."""

from __future__ import annotations

import copy
import math
import multiprocessing
import os
import pickle
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import voussoir


def table() -> voussoir.Scene:
    scene = voussoir.Scene("Table", friction=0.6, density=2400)
    scene.box("ground", (2, 2, 0.2), (0, 0, -0.1), support=True)
    return scene.box("block", (0.4, 0.4, 1), (0, 0, 0.5))


def pushed() -> voussoir.Scene:
    return table().load("live", weight=(1, 0, 0))


def elastic() -> voussoir.Scene:
    return table().joint(friction=0.6, normal_stiffness=1e9)


def arch() -> voussoir.Scene:
    shape = voussoir.Arch(radius=1, thickness=0.15, depth=1, voussoirs=9)
    return voussoir.Scene("Arch", friction=0.7, density=2400).add(shape)


def bridge() -> voussoir.Scene:
    span = voussoir.BridgeSpan(clear_span=6, rise=1.5, thickness=0.3, voussoirs=20)
    fill = voussoir.Fill(cover=0.3, unit_weight=18_000)
    train = voussoir.Train(axles=[voussoir.Axle(at=0, force=1000)], path=(-3, 3), step=1)
    scene = voussoir.Scene("Bridge", friction=0.6, density=2000)
    return scene.add(voussoir.Bridge(spans=[span], width=3, fill=fill), train)


def grains() -> voussoir.Scene:
    lattice = voussoir.Lattice(packing="square", radius=1, layers=1, side=2)
    return voussoir.Scene("Grains", friction=0.3, density=2500).add(lattice)


def combined() -> voussoir.Scene:
    return pushed().add(voussoir.Combination(name="ultimate", factors={"dead": 1, "live": 1.5}))


LEAST = {"tilt": {"toward": [[1, 0, 0]], "require": 15}}
JUMP = {"jump": {"velocity": 0.05}}
THICKNESS = "/templates/0/arch/thickness"
ANSWERS: dict[str, Callable[[], voussoir.Answer]] = {
    "assess": lambda: voussoir.assess(arch()),
    "assess, simulated": lambda: voussoir.assess(table(), simulate=True),
    "assess, out of time": lambda: voussoir.assess(arch(), time_limit=1e-9),
    "limit": lambda: voussoir.limit(pushed()),
    "moving": lambda: voussoir.moving(bridge(), law="associative"),
    "tilt": lambda: voussoir.tilt(table(), all=4),
    "critical": lambda: voussoir.critical(arch(), THICKNESS, (0.05, 0.2), scan=4, law="associative"),
    "thrust": lambda: voussoir.thrust(arch()),
    "settle": lambda: voussoir.settle(arch(), out={"springer_*": 0.02}),
    "push": lambda: voussoir.push(pushed(), ("block", (0, 0, 1)), (1, 0, 0)),
    "kinematic": lambda: voussoir.kinematic(table(), toward=(1, 0)),
    "stages": lambda: voussoir.stages(table(), any_order=True),
    "without": lambda: voussoir.without(arch()),
    "state": lambda: voussoir.state(elastic()),
    "simulate": lambda: voussoir.simulate(table(), fast=True, frames=3),
    "shake": lambda: voussoir.shake(table(), pulse=JUMP, fast=True, seconds=0.3),
    "repose": lambda: voussoir.repose(grains(), all=2),
    "combinations": lambda: voussoir.combinations(combined(), "limit"),
    "meet": lambda: voussoir.meet(table(), LEAST, "/joints/default/friction", (0.1, 0.6)),
}


def arrays(value: Any) -> list[np.ndarray[Any, Any]]:
    """All arrays that a value shows."""
    if isinstance(value, np.ndarray):
        return [value]
    if isinstance(value, (list, tuple)):
        return [array for item in value for array in arrays(item)]
    if isinstance(value, dict):
        return arrays(list(value.values()))
    if type(value).__module__.startswith("voussoir.") and not isinstance(value, (str, voussoir.Scene)):
        shown = [k for k in dir(value) if not k.startswith("_")]
        return [a for k in shown if not callable(inner := getattr(value, k)) for a in arrays(inner)]
    return []


@pytest.mark.parametrize("question", ANSWERS)
def test_answers_are_values(question: str) -> None:
    answer = ANSWERS[question]()
    again = pickle.loads(pickle.dumps(answer))
    assert type(again) is type(answer) and again.to_json() == answer.to_json()
    assert str(again) == str(answer) and again.report() == answer.report()
    found = arrays(answer)
    assert found and not any(array.flags.writeable for array in found)
    others = arrays(again)
    assert len(found) == len(others)
    assert all(np.array_equal(a, b, equal_nan=a.dtype.kind == "f") for a, b in zip(found, others))
    with pytest.raises(ValueError, match="read-only"):
        answer.forces[...] = 0
    assert copy.deepcopy(answer).to_json() == copy.copy(answer).to_json() == answer.to_json()


def test_answers_about_many_scenes_are_values() -> None:
    sweep = voussoir.sweep(PLAN, arch())
    assert pickle.loads(pickle.dumps(sweep)).to_csv() == sweep.to_csv()
    heaps = voussoir.heaps("funnel", seeds=[3], grains=30, skip_margin=True)
    again = pickle.loads(pickle.dumps(heaps))
    assert again.to_json() == heaps.to_json()
    assert again.scenes[0].to_dict() == heaps.scenes[0].to_dict()
    many = voussoir.assess_many([table(), arch()], margin="tilt")
    assert np.array_equal(pickle.loads(pickle.dumps(many)).margins, many.margins)
    piles = voussoir.Piles(table())
    assert pickle.loads(pickle.dumps(piles)).shapes == ["ground", "block"]
    piled = piles.assess([[0, 1]], [[(0, 0, 0), (0, 0, 0)]], margin=True)
    assert piled.verdicts[0] == "stable"
    for told in (sweep, heaps, many, piled):
        found = arrays(told)
        assert found and not any(a.flags.writeable for a in found), told


def test_pieces_of_scenes_are_values() -> None:
    stage = voussoir.Stage(name="first", add=["a"])
    assert pickle.loads(pickle.dumps(stage)) == stage != voussoir.Stage(name="second", add=["a"])
    one, other = (voussoir.Block.box("a", size) for size in ((1, 2, 3), np.array([1, 2, 3])))
    assert one == other and hash(one) == hash(other)
    with pytest.raises(AttributeError):
        stage.name = "other"  # type: ignore[misc]
    with pytest.raises(TypeError, match="Fill"):
        table().add(voussoir.Fill(cover=1, unit_weight=1))
    with pytest.raises(TypeError):
        voussoir.Arch(radius=1, thicknes=0.1, depth=1, voussoirs=9)  # type: ignore[call-arg]


NAN = math.nan
PLAN = {"question": {"assess": {}}, "vary": [{"pointer": THICKNESS, "values": [0.12, 0.15]}]}
REFUSED: list[tuple[str, Callable[[], object]]] = [
    ("time_limit", lambda: voussoir.assess(table(), time_limit=-1)),
    ("time_limit", lambda: voussoir.assess(table(), time_limit=0)),
    ("time_limit", lambda: voussoir.limit(pushed(), time_limit=NAN)),
    ("threads", lambda: voussoir.simulate(table(), threads=-1)),
    ("threads", lambda: voussoir.assess_many([table()], threads=-1)),
    ("threads", lambda: voussoir.sweep(PLAN, arch(), threads=-2)),
    ("threads", lambda: voussoir.heaps("funnel", threads=-1)),
    ("threads", lambda: voussoir.Piles(table()).assess([[0]], [[(0, 0, 0)]], threads=-1)),
    ("tilt.toward[0][0]", lambda: voussoir.tilt(table(), toward=(NAN, 0))),
    ("tilt.all", lambda: voussoir.tilt(table(), all=-1)),
    ("assess.law", lambda: voussoir.assess(table(), law="dry")),  # type: ignore[arg-type]
    ("simulate", lambda: voussoir.assess(table(), simulate="perhaps")),  # type: ignore[arg-type]
    ("worst", lambda: voussoir.assess(table(), worst={"friction": (NAN, 1)})),
    ("critical.between[0]", lambda: voussoir.critical(arch(), THICKNESS, (NAN, 1))),
    ("thrust.direction[0]", lambda: voussoir.thrust(arch(), direction=(NAN, 0))),
    ("settle.moves[0].way[2]", lambda: voussoir.settle(arch(), {"springer_left": (0, 0, NAN)})),
    ("push.control.point[0]", lambda: voussoir.push(pushed(), ("block", (NAN, 0, 0)), (1, 0, 0))),
    ("kinematic.fc", lambda: voussoir.kinematic(table(), fc=NAN)),
    ("stages.hands", lambda: voussoir.stages(table(), any_order=True, hands=-1)),
    ("state.at[0]", lambda: voussoir.state(elastic(), at=[NAN])),
    ("simulate.seconds", lambda: voussoir.simulate(table(), seconds=NAN)),
    ("shake.ground.scale", lambda: voussoir.shake(table(), pulse=JUMP, scale=NAN)),
    ("combinations.ask.limit.require", lambda: voussoir.combinations(combined(), {"limit": {"require": NAN}})),
    ("meet.between[0]", lambda: voussoir.meet(table(), LEAST, "/joints/default/friction", (NAN, 1))),
    ("limit.require", lambda: voussoir.limit(pushed(), require=NAN)),
    ("repose.moving_mass", lambda: voussoir.repose(grains(), moving_mass=NAN)),
    ("up", lambda: voussoir.import_file("a.obj", up="w")),  # type: ignore[arg-type]
    ("kind", lambda: table().load("alive")),  # type: ignore[arg-type]
    ("margin", lambda: voussoir.assess_many([table()], margin="none")),  # type: ignore[arg-type]
    ("which", lambda: voussoir.Piles(table()).assess([0], [(0, 0, 0)])),
]


@pytest.mark.parametrize(("path", "ask"), REFUSED, ids=[path for path, _ in REFUSED])
def test_errors_of_options_name_the_parameter(path: str, ask: Callable[[], object]) -> None:
    with pytest.raises(voussoir.InputError) as caught:
        ask()
    assert caught.value.path == path, caught.value


WRONG: list[Callable[[], object]] = [
    lambda: voussoir.assess(5),  # type: ignore[arg-type]
    lambda: voussoir.assess(None),  # type: ignore[arg-type]
    lambda: voussoir.assess([table()]),  # type: ignore[arg-type]
    lambda: voussoir.assess(table(), time_limit="soon"),  # type: ignore[arg-type]
    lambda: voussoir.assess(table(), threads=1.5),  # type: ignore[arg-type]
    lambda: voussoir.assess(table(), progress=3),  # type: ignore[arg-type]
    lambda: voussoir.tilt(table(), toward="x"),  # type: ignore[arg-type]
    lambda: voussoir.tilt(table(), law=1),  # type: ignore[arg-type]
    lambda: voussoir.critical(table(), 1, (0, 1)),  # type: ignore[arg-type]
    lambda: voussoir.settle(table(), {"ground": 1}),  # type: ignore[dict-item]
    lambda: voussoir.Scene().box("a", 1),  # type: ignore[arg-type]
    lambda: voussoir.Scene().box("a", (1, 1)),
    lambda: voussoir.Scene().box("a", ("1", 1, 1)),  # type: ignore[arg-type]
    lambda: voussoir.Scene().box(1, (1, 1, 1)),  # type: ignore[arg-type]
    lambda: voussoir.Scene().polyhedron("a", [[0, 0]], [[0, 1, 2]]),
    lambda: voussoir.Scene().polyhedron("a", np.zeros((4, 3)), [[0, 1.5, 2]]),  # type: ignore[list-item]
    lambda: voussoir.Scene(friction="some"),  # type: ignore[arg-type]
    lambda: voussoir.Scene().add({"id": "a"}),  # type: ignore[arg-type]
    lambda: voussoir.assess({"format": "voussoir-scene/1", "blocks": {1, 2}}),
    lambda: voussoir.assess({"format": "voussoir-scene/1", "name": object()}),
]


@pytest.mark.parametrize("ask", WRONG, ids=range(len(WRONG)))
def test_wrong_types_are_refused(ask: Callable[[], object]) -> None:
    with pytest.raises((TypeError, ValueError, AttributeError, voussoir.VoussoirError)) as caught:
        ask()
    assert "PanicException" not in type(caught.value).__name__


def resident() -> int:
    """Bytes of memory that this process holds."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def threads() -> int:
    return len(os.listdir("/proc/self/task"))


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="memory as Linux counts it")
def test_ten_thousand_calls_hold_no_more_memory() -> None:
    scene = table()

    def calls(count: int) -> None:
        for _ in range(count):
            assert voussoir.assess(scene).forces.shape == (4, 3)

    calls(1000)
    before, at_work = resident(), threads()
    calls(10_000)
    assert resident() - before < 4 << 20, f"{(resident() - before) / 1e6:.1f} MB"
    # The last worker may still be ending.
    assert threads() <= at_work + 1


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="threads as Linux counts them")
def test_no_more_threads_than_four_a_processor() -> None:
    at_rest, most = threads(), 0

    def look(*_: object) -> None:
        nonlocal most
        most = max(most, threads())

    voussoir.assess_many([arch()] * 3000, threads=100_000, progress=look)
    voussoir.simulate(table(), threads=100_000, fine=True, progress=look)
    # One works while this one waits.
    assert 0 < most <= at_rest + 1 + 4 * (os.cpu_count() or 1)


def verdict(scene: voussoir.Scene) -> voussoir.Assessment:
    return voussoir.assess(scene)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork")
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_a_fork_asks_as_its_parent_does() -> None:
    here = voussoir.assess_many([table(), arch()], threads=2)
    with multiprocessing.get_context("fork").Pool(2) as pool:
        there = pool.map(verdict, [table(), arch()] * 4)
    assert [answer.verdict.value for answer in there] == here.verdicts.tolist() * 4
    assert all(isinstance(answer, voussoir.Assessment) and voussoir.check(answer) for answer in there)
    child = os.fork()
    if child == 0:
        many = voussoir.assess_many([table(), arch()], threads=2)
        os._exit(0 if many.verdicts.tolist() == here.verdicts.tolist() else 1)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
