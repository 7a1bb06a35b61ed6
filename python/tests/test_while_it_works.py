"""The interpreter is free while the library works: threads, Ctrl-C, progress, batches."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest
import voussoir


def pile(shift: float, boxes: int = 10) -> voussoir.Scene:
    """Boxes on top of each other, each shifted against the one below."""
    scene = voussoir.Scene(friction=0.6, density=2400)
    scene.box("ground", (4, 4, 0.2), (0, 0, -0.1), support=True)
    for k in range(boxes):
        scene.box(f"b{k}", (0.4, 0.4, 0.2), (shift * k, 0, 0.1 + 0.2 * k))
    return scene


def slow() -> voussoir.Scene:
    """Minutes of simulation."""
    return pile(0.001, 60)


def test_other_threads_go_on() -> None:
    ticks = 0
    stop = threading.Event()

    def count() -> None:
        nonlocal ticks
        while not stop.is_set():
            ticks += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    start = time.perf_counter()
    voussoir.simulate(pile(0.01), fine=True, skip_verdict=True)
    seconds = time.perf_counter() - start
    stop.set()
    thread.join()
    assert ticks > 50 * seconds, (ticks, seconds)


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
@pytest.mark.parametrize("verb", ["simulate", "critical", "assess_many", "sweep"])
def test_an_interrupt_is_heard_within_a_tenth_of_a_second(verb: str, structures: Path) -> None:
    def work() -> None:
        if verb == "simulate":
            voussoir.simulate(slow(), fine=True, to_the_end=True, seconds=1e4)
        elif verb == "critical":
            voussoir.critical(slow(), "/joints/default/friction", (0.01, 1.0), scan=100_000)
        elif verb == "assess_many":
            voussoir.assess_many([pile(0.001)] * 100_000)
        else:
            pointer = "/templates/0/arch/thickness"
            vary = [{"pointer": pointer, "from": 0.5, "to": 1.0, "count": 100_000}]
            voussoir.sweep({"question": {"limit": {}}, "vary": vary}, structures / "oppenheim-arch.json")

    sent = 0.0

    def interrupt() -> None:
        nonlocal sent
        time.sleep(0.5)
        sent = time.perf_counter()
        os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=interrupt).start()
    with pytest.raises(KeyboardInterrupt):
        work()
    late = time.perf_counter() - sent
    assert late < 0.1, f"{late:.3f} s"


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
def test_an_interrupt_ends_the_command(tmp_path: Path) -> None:
    file = tmp_path / "scene.json"
    slow().save(file)
    line = [sys.executable, "-m", "voussoir", "simulate", str(file), "--fine", "--to-the-end"]
    with subprocess.Popen(line + ["--seconds", "10000"], stdout=subprocess.DEVNULL) as process:
        time.sleep(1.0)
        process.send_signal(signal.SIGINT)
        assert process.wait(timeout=5) == -signal.SIGINT


def test_progress_is_told_and_may_stop_it() -> None:
    seen: list[tuple[float, float, str]] = []

    def tell(done: float, total: float, words: str) -> None:
        seen.append((done, total, words))

    voussoir.simulate(pile(0.01), fine=True, skip_verdict=True, progress=tell)
    assert seen and all(0 <= done <= total for done, total, _ in seen) and seen[0][2]

    class Enough(Exception):
        pass

    def enough(*_: object) -> None:
        raise Enough

    with pytest.raises(Enough):
        voussoir.simulate(slow(), fine=True, to_the_end=True, seconds=1e4, progress=enough)


def test_a_bar_of_tqdm(capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("tqdm")
    voussoir.simulate(pile(0.01), fine=True, skip_verdict=True, progress=True)
    assert "thickness" in capsys.readouterr().err


def test_time_limits_leave_answers_open(structures: Path) -> None:
    answer = voussoir.assess(structures / "oppenheim-arch.json", time_limit=1e-9)
    assert answer.verdict is voussoir.Verdict.UNDECIDED
    assert answer.doubt is not None and answer.doubt.cause == "time_limit" and answer.doubt.next


def test_batches_are_the_single_answers() -> None:
    shifts = np.linspace(0, 0.06, 14)
    scenes = [pile(shift) for shift in shifts]
    many = voussoir.assess_many(scenes, threads=2)
    single = [voussoir.assess(scene) for scene in scenes]
    assert many.verdicts.tolist() == [answer.verdict.value for answer in single]
    assert many.equilibrium_error[:, 1].tolist() == [answer.equilibrium_error.upper for answer in single]
    # The centre of the upper nine lies 5 shifts off that of the lowest, which is 0.2 m to its edge.
    assert many.stands.tolist() == [bool(5 * shift < 0.2) for shift in shifts]
    assert (many.margins[~many.stands] < -1e-6).all() and not many.errors


def test_piles_from_arrays_are_scenes() -> None:
    pytest.importorskip("pandas", reason="pandas is not installed")
    scene = voussoir.Scene("shapes", friction=0.6, density=2400)
    scene.box("ground", (4, 4, 0.2), support=True).box("brick", (0.4, 0.4, 0.2))
    piles = voussoir.Piles(scene)
    assert piles.shapes == ["ground", "brick"]
    shifts = np.linspace(0, 0.06, 14)
    which = np.tile([0] + [1] * 10, (14, 1))
    at = np.zeros((14, 11, 3))
    at[:, 0, 2] = -0.1
    at[:, 1:, 2] = 0.1 + 0.2 * np.arange(10)
    at[:, 1:, 0] = shifts[:, None] * np.arange(10)
    turn = np.tile([1.0, 0, 0, 0], (14, 11, 1))
    told = piles.assess(which, at, turn, margin=True, threads=2)
    assert told.stands.tolist() == [bool(5 * shift < 0.2) for shift in shifts]
    assert set(told.by) == {"statics"} and not told.errors and len(told.to_frame()) == 14
    assert not told.findings
    sunk = at.copy()
    sunk[0, 4:, 2] -= 0.003
    told_sunk = piles.assess(which, sunk, turn)
    assert list(told_sunk.findings) == [0] and "overlap" in told_sunk.findings[0][0]
    assert "overlap" in told_sunk.to_frame()["findings"][0]
    # The pile of ten tips about its foot: half its width less the way of its centre, over its height.
    expected = np.minimum((0.2 - 4.5 * shifts) / 1.0, 0.6)
    assert (told.margins[told.stands] <= expected[told.stands] + 1e-12).all()
    assert told.margins[0] == pytest.approx(0.2, rel=1e-12)
    which[0, 10], which[1, 3], at[2, 5, 1] = -1, 7, np.nan
    told = piles.assess(which, at, masses=np.where(which == 1, 5.0, 1.0), margin=True)
    assert told.margins[0] == pytest.approx(0.2 / 0.9, rel=1e-12)
    assert sorted(told.errors) == [1, 2] and "shape" in told.errors[1] and "pose" in told.errors[2]
    with pytest.raises(ValueError, match="at has the shape"):
        piles.assess(which, at[:, :3])
    with pytest.raises(voussoir.InputError, match="loads"):
        voussoir.Piles(scene.load("live", block="brick", force=(1, 0, 0)))


def test_margins_of_batches() -> None:
    unknown = pile(0.0, 1).joint(blocks=("b0", "nobody"), friction=0.1)
    many = voussoir.assess_many([pile(0.0, 4), pile(0.0, 8), unknown], margin="tilt", toward=(1, 0))
    # A pile of n boxes tips about its foot at half its width over half its height.
    expected = np.degrees(np.arctan([0.2 / 0.4, 0.2 / 0.8]))
    np.testing.assert_allclose(many.margins[:2], expected, rtol=1e-6)
    assert (many.brackets[:2, 0] <= many.margins[:2]).all()
    assert many.verdicts[2] == "error" and np.isnan(many.margins[2]) and "nobody" in many.errors[2]
    live = [pile(0.0, 1).load("live", weight=(1, 0, 0))]
    assert voussoir.assess_many(live, margin="limit").margins[0] == pytest.approx(0.6, rel=1e-6)
    with pytest.raises(ValueError, match="margin"):
        voussoir.assess_many(live, margin="none")  # type: ignore[arg-type]


def test_heaps_repeat() -> None:
    first = voussoir.heaps("funnel", seeds=[3], grains=40, skip_margin=True)
    again = voussoir.heaps("funnel", seeds=[3], grains=40, skip_margin=True)
    assert first.scenes[0].to_dict() == again.scenes[0].to_dict() and len(first) == 1
    with pytest.raises(voussoir.InputError):
        voussoir.heaps("funnel", grain="square")
