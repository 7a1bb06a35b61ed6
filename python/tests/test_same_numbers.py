"""The objects hold what the command prints, to the last bit, over the scenes of the repository."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any, Literal

import pytest
import voussoir
from conftest import STRUCTURES

# Those that take more than a few seconds are the business of the library's own tests.
SLOW = {"column-1000", "leaning-tower-1000", "dome", "dome-with-oculus", "pile-of-discs"}
SCENES = sorted(
    path
    for path in STRUCTURES.glob("*.json")
    if path.stem not in SLOW and '"voussoir-scene/1"' in path.read_text()
)


def said(*arguments: str | Path) -> dict[str, Any]:
    """What the command prints as JSON."""
    line = [sys.executable, "-m", "voussoir", *map(str, arguments), "--json"]
    done = subprocess.run(line, capture_output=True, text=True)
    assert done.returncode in (0, 1, 3), done.stderr
    answer: dict[str, Any] = json.loads(done.stdout)
    return answer


def without_time(result: Any) -> Any:
    """A result without what no two runs share: the seconds, and the memory that they found."""
    if isinstance(result, dict):
        return {
            k: without_time(v)
            for k, v in result.items()
            if k not in ("timings", "seconds", "work", "check_seconds")
        }
    if isinstance(result, list):
        return [without_time(v) for v in result]
    return result


@pytest.mark.parametrize("path", SCENES, ids=lambda p: p.stem)
@pytest.mark.filterwarnings("ignore::voussoir.SceneWarning")
def test_assess(path: Path) -> None:
    expected = said("assess", path)
    answer = voussoir.assess(path)
    assert without_time(answer.to_dict()) == without_time(expected)
    assert answer.verdict == expected["answer"]["verdict"]
    assert answer.equilibrium_error.upper == expected["answer"]["equilibrium_error"]["upper"]
    listed = [f for c in expected["evidence"]["assess"]["standing"]["certificate"]["forces"] for f in c["forces"]]
    assert answer.forces.tolist() == listed


WALLS = {"running-bond-wall-40", "running-bond-wall", "wall-with-openings", "wall-with-two-openings"}
LIMITS = [p for p in SCENES if json.loads(p.read_text()).get("loads", {}).get("live")]


@pytest.mark.parametrize("path", LIMITS, ids=lambda p: p.stem)
@pytest.mark.filterwarnings("ignore::voussoir.SceneWarning")
def test_limit(path: Path) -> None:
    # Dry friction of large walls takes minutes.
    law: Literal["associative", "coulomb"] = "associative" if path.stem in WALLS else "coulomb"
    expected = said("limit", path, "--law", law)
    answer = voussoir.limit(path, law=law)
    assert without_time(answer.to_dict()) == without_time(expected)
    factor = expected["answer"]["load_factor"]
    for key in ("status", "value", "lower", "upper", "found"):
        assert getattr(answer.load_factor, key) == factor.get(key)
    assert answer.load_factor.associative.upper == factor["associative"].get("upper")


def test_the_other_verbs(structures: Path) -> None:
    table = structures / "block-on-tilting-table.json"
    tilt = voussoir.tilt(table)
    assert without_time(tilt.to_dict()) == without_time(said("tilt", table))
    assert len(tilt.directions) == 8
    toward = voussoir.tilt(table, toward=(1, 0))
    assert without_time(toward.to_dict()) == without_time(said("tilt", table, "--toward", "1,0"))

    arch = structures / "oppenheim-arch.json"
    thrust = voussoir.thrust(arch)
    assert without_time(thrust.to_dict()) == without_time(said("thrust", arch))
    assert thrust.least is not None and thrust.least.value is not None
    assert thrust.greatest is not None and thrust.greatest.value is not None
    assert thrust.least.value < thrust.greatest.value

    thick = structures / "semicircular-arch-thick.json"
    pointer, law = "/templates/0/arch/thickness", "associative"
    critical = voussoir.critical(thick, pointer, (0.05, 0.3), scan=5, law="associative")
    options = ["--vary", pointer, "--between", "0.05", "0.3", "--scan", "5", "--law", law]
    assert without_time(critical.to_dict()) == without_time(said("critical", thick, *options))
    assert critical.value is not None and abs(critical.value - 0.106720903551) < 1e-10

    thin = structures / "semicircular-arch-thin.json"
    fast = voussoir.simulate(thin, fast=True, film=False)
    assert without_time(fast.to_dict()) == without_time(said("simulate", thin, "--fast"))
    assert fast.fate == "falls" and fast.collapse is not None

    column = structures / "column.json"
    worst = voussoir.assess(column, worst={"friction": (0.5, 0.7), "density": (2000, 2400)})
    asked = said("assess", column, "--worst", "friction=0.5..0.7,density=2000..2400")
    assert without_time(worst.to_dict()) == without_time(asked)


def test_movements(structures: Path) -> None:
    pytest.importorskip("pandas", reason="pandas is not installed")
    arch = structures / "semicircular-arch-thick.json"
    scene = voussoir.load(arch)
    support = scene.inspect()["blocks"][-1]["id"]
    moves = {support: (0.02, 0.0, 0.0)}
    path = voussoir.settle(arch, moves)
    expected = said("settle", arch, "--move", f"{support}=0.02,0,0")
    assert without_time(path.to_dict()) == without_time(expected)
    assert path.status == expected["answer"]["path"]["status"]
    assert len(path.parameter) == len(expected["answer"]["curve"]["points"])
    assert len(path.to_frame()) == len(path.parameter)
    claimed = path.certificate_at(0)
    assert claimed.claims == "stable" and len(claimed.forces.forces)


def test_supports_that_move_outwards(structures: Path) -> None:
    arch = structures / "spreading-arch.json"
    path = voussoir.settle(arch, out={"springer_*": 0.02})
    expected = said("settle", arch, "--move", "springer_*=out:0.02")
    assert without_time(path.to_dict()) == without_time(expected)
    assert path.status == "reached"
    with pytest.raises(voussoir.InputError, match="`out` is undefined for a single support"):
        voussoir.settle(arch, out={"springer_left": 0.02})


def test_a_path_is_kept_and_taken_up(structures: Path, tmp_path: Path) -> None:
    arch, kept = structures / "spreading-arch.json", tmp_path / "kept.jsonl"
    whole = voussoir.settle(arch, {"springer_right": (0.12, 0, 0)}, keep=kept)
    lines = kept.read_text().splitlines()
    assert len(lines) > 4
    # A kill: half of the points, and a line that was being written.
    kept.write_text("\n".join(lines[: len(lines) // 2]) + '\n{"path":')
    again = voussoir.settle(arch, {"springer_right": (0.12, 0, 0)}, keep=kept)
    assert again.status == whole.status == "falls"
    assert again.value == pytest.approx(whole.value, rel=1e-9)
    assert len(again.parameter) == pytest.approx(len(whole.parameter), abs=2)
    assert voussoir.check(again)
    with pytest.raises(voussoir.VoussoirError, match="its rows are not those of"):
        voussoir.settle(arch, {"springer_right": (0.11, 0, 0)}, keep=kept)


def test_earthquakes(structures: Path) -> None:
    pytest.importorskip("pandas", reason="pandas is not installed")
    wall = structures / "overturning-wall.json"
    answer = voussoir.kinematic(wall, toward=(1, 0))
    expected = said("kinematic", wall, "--toward", "1,0")
    assert without_time(answer.to_dict()) == without_time(expected)
    assert isinstance(answer, voussoir.Kinematic) and answer.no_curve is None
    assert answer.alpha0.value is not None and answer.a0 is not None
    assert answer.participation is not None and answer.capacity is not None
    # One block: everything takes part.
    assert abs(answer.participation["e_star"] - 1.0) < 1e-9
    assert abs(answer.a0 - answer.alpha0.value * 9.81 / answer.fc) < 1e-9
    assert len(answer.to_frame()) == len(answer.participation["masses"])


def test_stages(structures: Path) -> None:
    pytest.importorskip("pandas", reason="pandas is not installed")
    arch = structures / "arch-without-centring.json"
    answer = voussoir.stages(arch, toward=(1, 0))
    expected = said("stages", arch, "--toward", "1,0")
    assert without_time(answer.to_dict()) == without_time(expected)
    assert isinstance(answer, voussoir.Stages)
    assert (answer.stand_first, answer.stages, answer.worst) == (4, 20, "add v04")
    assert answer.verdict is voussoir.Verdict.UNSTABLE
    table = answer.to_frame()
    assert list(table["verdict"][:5]) == ["stable"] * 4 + ["unstable"]
    assert table["tilt_deg"][:4].notna().all()
    frame = structures / "a-frame-stands.json"
    assert voussoir.without(frame).removable == []
    built = voussoir.stages(arch, any_order=True, skip_held=True)
    assert (built.least_held, built.most_held, answer.order) == (1, 1, None)
    assert built.order is not None and sorted(built.order) == [f"v{k:02}" for k in range(20)]
    same = voussoir.stages(arch, order=built.order, skip_held=True)
    assert (same.most_held, same.order) == (1, built.order)


def test_joints_that_yield(structures: Path) -> None:
    pytest.importorskip("pandas", reason="pandas is not installed")
    bed = structures / "block-on-bed.json"
    answer = voussoir.state(bed)
    assert without_time(answer.to_dict()) == without_time(said("state", bed))
    assert isinstance(answer, voussoir.State) and answer.verdict
    # N / (k A): 39.24 kN on 1 m² of 1e9 Pa/m.
    assert answer.displacements["block"] == pytest.approx([0, 0, -3.924e-5], rel=1e-9, abs=1e-15)
    assert answer.rotations["block"] == pytest.approx([0, 0, 0], abs=1e-12)
    factors, ways = answer.curve
    assert factors[0] == 0 and ways.shape == (len(factors), 3)
    assert answer.load_factor is not None and answer.residuals is not None
    assert len(answer.frequencies) and answer.events
    assert list(answer.to_frame()["normal_force"]) == pytest.approx([39240.0])
    assert voussoir.state(bed, dead_only=True).load_factor is None


@pytest.mark.filterwarnings("ignore::voussoir.SceneWarning")
def test_what_is_required(structures: Path) -> None:
    pytest.importorskip("pandas", reason="pandas is not installed")
    bridge = structures / "bridge-two-spans.json"
    answer = voussoir.combinations(bridge, {"moving": {"law": "associative"}}, only=["STR"])
    expected = said("combinations", bridge, "--law", "associative", "--only", "STR")
    assert without_time(answer.to_dict()) == without_time(expected)
    assert answer.governing == "STR" and len(answer.to_frame()) == 1
    prestwood = structures / "bridge-prestwood.json"
    train = structures / "bridge-single-axle.json"
    required = voussoir.moving(train, require=150, law="associative").required
    assert required is not None and required.quantity == "load_factor" and required.least == 150
    required = voussoir.limit(prestwood, require=1e9, law="associative").required
    assert required is not None and required.met is False
    assert voussoir.assess(bridge).required is None


def test_packings_and_sweeps(structures: Path, tmp_path: Path) -> None:
    pile = structures / "tetrahedral-pile.json"
    packing = voussoir.repose(pile, all=4)
    assert without_time(packing.packing) == without_time(said("repose", pile, "--all", "4"))

    plan = structures / "sweeps" / "buttress-width.json"
    rows = tmp_path / "rows.jsonl"
    expected = said("sweep", plan, "--output", rows)
    sweep = voussoir.sweep(plan, threads=2)
    assert without_time(json.loads(sweep.to_json())) == without_time(expected)
    listed = [json.loads(line) for line in rows.read_text().splitlines()[1:]]
    listed.sort(key=lambda row: int(row["row"]))
    assert sweep.values.tolist() == [row["value"] for row in listed]
    # The same plan in code, with a scene that was built in code.
    data = json.loads(plan.read_text())
    del data["scene"]
    again = voussoir.sweep(data, structures / "buttressed-arch.json")
    assert again.values.tolist() == sweep.values.tolist()
