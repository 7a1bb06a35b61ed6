"""Scenes built in code, answers as objects, files, errors."""

from __future__ import annotations

import copy
import html
import json
import pickle
import xml.etree.ElementTree
from pathlib import Path

import numpy as np
import pytest
import voussoir


def table(friction: float = 0.6) -> voussoir.Scene:
    """A slender block on a table: it tips at tan θ = 0.4 / 1, or slides at tan θ = friction."""
    scene = voussoir.Scene("Table", friction=friction, density=2400)
    scene.box("table", (2, 2, 0.2), (0, 0, -0.1), support=True)
    return scene.box("block", (0.4, 0.4, 1), (0, 0, 0.5))


def cube(size: float) -> tuple[np.ndarray, list[list[int]]]:  # type: ignore[type-arg]
    half = size / 2
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float) * half
    faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    return corners, faces


def test_closed_forms() -> None:
    tips = voussoir.tilt(table(), toward=(1, 0))
    assert tips.tan_tilt.value == pytest.approx(0.4, rel=1e-7)
    slides = voussoir.tilt(table(0.3), toward=(1, 0))
    assert slides.tan_tilt.value == pytest.approx(0.3, rel=1e-6)
    pushed = voussoir.limit(table().load("live", weight=(1, 0, 0)))
    assert float(pushed.load_factor) == pytest.approx(0.4, rel=1e-7)
    assert pushed.load_factor.lower <= pushed.load_factor.value <= pushed.load_factor.upper
    assert pushed.verdict is voussoir.Verdict.STABLE
    assert pushed.mechanism is not None and pushed.mechanism.moving == ["block"]


def test_corners_of_numpy_are_those_of_a_box() -> None:
    corners, faces = cube(1.0)
    scene = voussoir.Scene(friction=0.5, density=1000)
    scene.box("ground", (4, 4, 1), (0, 0, -0.5), support=True)
    scene.polyhedron("cube", corners, faces, at=(0, 0, 0.5))
    boxes = voussoir.Scene(friction=0.5, density=1000)
    boxes.box("ground", (4, 4, 1), (0, 0, -0.5), support=True).box("cube", (1, 1, 1), (0, 0, 0.5))
    one, other = voussoir.assess(scene), voussoir.assess(boxes)
    np.testing.assert_allclose(one.blocks.mass, other.blocks.mass, rtol=1e-12)
    assert one.verdict and other.verdict
    shape = scene.to_dict()["blocks"][1]["shape"]["polyhedron"]
    assert shape["vertices"] == corners.tolist() and shape["faces"] == faces


def test_a_mapping_with_arrays_is_the_file(structures: Path) -> None:
    path = structures / "block-in-groove.json"
    data = json.loads(path.read_text())
    for block in data["blocks"]:
        for key, value in block.items():
            if isinstance(value, list):
                block[key] = np.array(value)
    one, other = voussoir.limit(data, keep_all=True), voussoir.limit(path, keep_all=True)
    assert one.load_factor == other.load_factor
    assert np.array_equal(one.forces, other.forces)


def test_forces_hold_every_block(structures: Path) -> None:
    answer = voussoir.assess(structures / "oppenheim-arch.json")
    evidence = answer.certificate.forces
    index = {id: k for k, id in enumerate(answer.blocks.ids)}
    held = np.zeros((len(index), 3))
    for (a, b), resultant in zip(evidence.between, evidence.resultants()):
        held[index[a]] -= resultant
        held[index[b]] += resultant
    free = ~answer.blocks.supports
    weight = answer.blocks.mass[free] * 9.81
    np.testing.assert_allclose(held[free, 2], weight, rtol=1e-9)
    np.testing.assert_allclose(held[free, :2], 0, atol=1e-9 * weight.max())
    # Pressing along the normals, inside the cones of friction 0.7 and more.
    for k, (_, points, forces) in enumerate(evidence):
        along = forces @ answer.axes[k].T
        assert (along[:, 2] >= 0).all() and len(points) == len(forces)
    assert answer.offsets[0] == 0 and answer.offsets[-1] == len(answer.forces)
    assert not evidence.couples.size


def test_arrays_are_made_once_and_are_views_after() -> None:
    answer = voussoir.assess(table())
    forces = answer.certificate.forces
    assert answer.forces is forces.forces
    (_, points, first), *_ = forces
    assert first.base is not None and np.shares_memory(first, forces.forces)
    assert np.shares_memory(points, forces.points)
    assert forces.forces.dtype == np.float64 and forces.forces.flags.c_contiguous


def test_saved_answers_are_proved_and_forged_ones_refused(tmp_path: Path) -> None:
    answer = voussoir.assess(table())
    file = tmp_path / "result.json"
    answer.save(file)
    proved = voussoir.check(file)
    assert isinstance(proved, voussoir.Verification)
    assert proved and proved.confirmed and proved.grade != "refuted" and "holds" in str(proved)
    again = voussoir.load_answer(file)
    assert isinstance(again, voussoir.Assessment) and again.verdict is answer.verdict
    assert np.array_equal(again.forces, answer.forces)
    data = json.loads(file.read_text())
    certificate = data["evidence"]["assess"]["standing"]["certificate"]
    certificate["forces"][0]["forces"][0][2] *= 1.5
    file.write_text(json.dumps(data))
    refused = voussoir.check(file)
    assert isinstance(refused, voussoir.Verification) and refused.grade == "refuted" and not refused
    other = voussoir.check(answer, table().box("more", (0.4, 0.4, 1), (0, 0, 1.5)))
    assert isinstance(other, voussoir.Verification) and not other.confirmed


def test_mistakes_are_findings(structures: Path) -> None:
    found = voussoir.check(structures / "gapped-column.json")
    assert isinstance(found, voussoir.Inspection) and not found
    assert [f.code for f in found.mistakes] == ["floating"]
    assert voussoir.check(table())
    heavy = table().load("dead", acceleration=(0, 0, -9810))
    with pytest.warns(voussoir.SceneWarning):
        voussoir.assess(voussoir.load(structures.parent / "tests/mistakes/gravity-upwards.json"))
    assert heavy.to_dict()["loads"]["dead"][0]["acceleration"] == [0, 0, -9810]


@pytest.mark.parametrize(
    ("change", "path", "words", "remedy"),
    [
        ({"densty": 1}, "blocks[1].densty", "unknown key", "density"),
        ({"density": -2400}, "blocks[1].density", "must be > 0, got -2400", "kg/m³"),
        ({"density": float("nan")}, "blocks[1].density", "must be a finite number", None),
        ({"at": [0, 0, float("inf")]}, "blocks[1].at", "finite", None),
        ({"material": "ston"}, "blocks[1].material", "ston", None),
    ],
)
def test_errors_name_place_and_remedy(
    change: dict[str, object], path: str, words: str, remedy: str | None
) -> None:
    data = table().to_dict()
    data["blocks"][1].update(change)
    with pytest.raises(voussoir.InputError) as caught:
        voussoir.assess(data)
    error = caught.value
    assert error.path.startswith(path) and words in error.message, error
    assert remedy is None or (error.remedy is not None and remedy in error.remedy)
    assert isinstance(error, ValueError) and path in str(error)


def test_numbers_that_are_none_are_named() -> None:
    with pytest.raises(voussoir.InputError) as caught:
        table().box("odd", (1, 1, 1), (0, 0, float("nan")))
    assert caught.value.path == "blocks[2].at[2]" and "finite" in caught.value.message, caught.value
    with pytest.raises(voussoir.InputError) as caught:
        voussoir.tilt(table(), toward=(1, float("-inf"), 0))
    assert "finite" in caught.value.message, caught.value


def test_errors_of_files_have_lines(tmp_path: Path) -> None:
    file = tmp_path / "scene.json"
    file.write_text(table().to_json().replace('"table"', '"block"', 1))
    with pytest.raises(voussoir.InputError) as caught:
        voussoir.assess(file)
    assert caught.value.line is not None and str(file) in caught.value.place
    with pytest.raises(voussoir.InputError):
        voussoir.load(tmp_path / "absent.json")
    with pytest.raises(voussoir.InputError) as caught:
        voussoir.assess(table(), law="dry")  # type: ignore[arg-type]
    assert "dry" in caught.value.message
    with pytest.raises(voussoir.InputError):
        voussoir.limit(table())
    with pytest.raises(voussoir.InputError) as caught:
        voussoir.Scene().box("a", (1, 1, 1)).polyhedron("b", np.zeros((4, 2)), [[0, 1, 2]])
    assert caught.value.path.startswith("blocks[1].shape.polyhedron.vertices")


def test_scenes_are_values(tmp_path: Path) -> None:
    scene = table()
    other = scene.copy()
    other.box("more", (1, 1, 1), (5, 0, 0.5), support=True)
    assert len(scene.to_dict()["blocks"]) == 2 and len(other.to_dict()["blocks"]) == 3
    assert copy.deepcopy(scene).to_dict() == scene.to_dict()
    assert pickle.loads(pickle.dumps(scene)).to_dict() == scene.to_dict()
    scene.save(tmp_path / "scene.json")
    assert voussoir.load(tmp_path / "scene.json").to_dict() == scene.to_dict()
    assert repr(scene) == "<voussoir.Scene 'Table': 2 blocks>"
    # A scene that changes after a question is asked anew.
    before = voussoir.tilt(scene, toward=(1, 0)).tan_tilt.value
    scene.joint(friction=0.1)
    after = voussoir.tilt(scene, toward=(1, 0)).tan_tilt.value
    assert before == pytest.approx(0.4) and after == pytest.approx(0.1)


def test_pages_and_drawings(tmp_path: Path) -> None:
    answer = voussoir.assess(table())
    page = answer.report(tmp_path / "page.html")
    assert (tmp_path / "page.html").read_text(encoding="utf-8") == page
    framed = answer._repr_html_()
    assert framed.startswith('<iframe sandbox="allow-scripts"') and "http://" not in framed[:200]
    assert "allow-same-origin" not in framed[: framed.index("srcdoc")]
    srcdoc = framed.split('srcdoc="', 1)[1].split('"', 1)[0]
    assert html.unescape(srcdoc) == page
    assert xml.etree.ElementTree.fromstring(answer._repr_svg_()).tag.endswith("svg")
    assert answer.svg("top") != answer.svg("front")
    answer.vtk(tmp_path / "answer.vtp")
    assert "PolyData" in (tmp_path / "answer.vtp").read_text()
    answer.gltf(tmp_path / "answer.gltf")
    assert json.loads((tmp_path / "answer.gltf").read_text())["asset"]["version"] == "2.0"
    answer.gltf(tmp_path / "answer.glb")
    assert (tmp_path / "answer.glb").read_bytes()[:4] == b"glTF"
    answer.obj(tmp_path / "answer.obj")
    assert (tmp_path / "answer.obj").read_text().count("\no ") == len(answer.blocks.ids)
    assert answer.table("blocks").splitlines()[0].startswith("id") or "block" in answer.table("blocks")
    assert answer.title.startswith("Table") and "stands" in str(answer)


def test_pandas_has_every_point() -> None:
    pandas = pytest.importorskip("pandas")
    answer = voussoir.assess(table())
    frame = answer.to_frame()
    assert isinstance(frame, pandas.DataFrame) and len(frame) == len(answer.forces)
    assert frame["fz"].sum() == pytest.approx(0.4 * 0.4 * 1 * 2400 * 9.81)


def test_templates_are_those_of_files(structures: Path) -> None:
    path = structures / "semicircular-arch-thick.json"
    data = json.loads(path.read_text())
    (template,) = data["templates"]
    built = voussoir.Scene(data["name"])
    for kind, values in template.items():
        built.template(kind, **values)
    built.joint(**data["joints"]["default"])
    for name, material in data["materials"].items():
        built.material(name, material["density"])
    same = voussoir.load(path).to_dict()
    del same["source"]
    assert built.to_dict() == same
    assert voussoir.assess(built).equilibrium_error == voussoir.assess(path).equilibrium_error
    with pytest.raises(voussoir.InputError) as caught:
        built.template("arsch", voussoirs=3)
    assert caught.value.path.startswith("templates[1]")


def test_film() -> None:
    falls = voussoir.simulate(table(0.6).joint(friction=0.0).load("dead", "block", force=(2000, 0, 0)))
    times, poses = falls.film
    assert falls.fate == "falls" and poses.shape == (len(times), 2, 7)
    assert (np.diff(times) > 0).all() and poses[-1, 1, 0] > poses[0, 1, 0]
    asked = voussoir.simulate(table(), frames=5, film=False, fast=True)
    assert asked.fate == "stands" and asked.verdict and asked.frames[1].shape[1:] == (2, 7)


def test_blocks_on_ground_that_moves() -> None:
    pytest.importorskip("pandas", reason="pandas is not installed")
    still = voussoir.shake(table(), pulse={"jump": {"velocity": 0.05}}, fast=True, seconds=0.5)
    assert still.fate in ("rests", "moves") and still.overturned is None
    frame = still.to_frame()
    assert list(frame["block"]) == ["block"] and (frame["greatest_over_thickness"] > 0).all()
    times, poses = still.film
    assert poses.shape == (len(times), 2, 7)
    rows = np.array([[0.0, 0.0], [1.0, 0.5], [0.0, 0.0]])
    asked = voussoir.shake(
        table(), accelerations=rows, step=0.1, scale=0.5, fast=True, seconds=0.3, film=False
    )
    record = asked.to_dict()["answer"]["shaken"]["asked"]["ground"]["record"]
    assert record["components"] == [[0.0, 1.0, 0.0], [0.0, 0.5, 0.0]] and record["step"] == 0.1
    with pytest.raises(voussoir.InputError):
        voussoir.shake(table())


def test_contacts_and_members_of_scenes_in_code(structures: Path) -> None:
    apart = table()
    apart.box("upper", (0.4, 0.4, 1), (0, 0, 1.505))
    assert isinstance(found := voussoir.check(apart), voussoir.Inspection)
    assert "near_miss" in {f.code for f in found.mistakes}
    assert voussoir.check(apart.contact(gap=1e-2))
    tied = json.loads((structures / "tied-arch.json").read_text())
    built = voussoir.load({k: v for k, v in tied.items() if k != "members"})
    for member in tied["members"]:
        built.member(**member)
    assert built.to_dict() == voussoir.load(tied).to_dict()
    answer = voussoir.limit(built)
    assert answer.load_factor.value == pytest.approx(0.1140764611, rel=1e-6)
    (tie,) = answer.members
    least = voussoir.thrust(built, member=tied["members"][0]["id"])
    assert least.least is not None and tie


def test_words_that_nobody_knows() -> None:
    for ask in (
        lambda: voussoir.simulate(table(), law="dry"),  # type: ignore[arg-type]
        lambda: voussoir.assess(table(), simulate="perhaps"),  # type: ignore[arg-type]
        lambda: voussoir.assess(table(), worst={"nothing": (0, 1)}),
        lambda: table().load("alive"),  # type: ignore[arg-type]
    ):
        with pytest.raises(voussoir.InputError):
            ask()


def test_builders_are_the_keys_of_files(structures: Path) -> None:
    built = voussoir.Scene("Built", friction=0.7)
    plain = voussoir.Scene("Built", friction=0.7)
    built.material("stone", 2400).add(voussoir.Arch(radius=1, thickness=0.1, depth=1, voussoirs=9, material="stone"))
    plain.material("stone", 2400).template("arch", radius=1, thickness=0.1, depth=1, voussoirs=9, material="stone")
    turned = voussoir.Rotation(axis=(0, 1, 0), angle=30)
    built.add(voussoir.Block.box("b", np.ones(3), at=(0, 0, 5), rotation_deg=turned, density=2000))
    shape = {"box": {"size": [1, 1, 1]}}
    rotation = {"axis": [0, 1, 0], "angle": 30}
    plain.block(id="b", shape=shape, at=[0, 0, 5], rotation_deg=rotation, density=2000)
    ends = (voussoir.End(block="b", at=(0, 0, 5)), voussoir.End(ground=(3, 0, 0)))
    tie = voussoir.Line(between=ends, strength=1000)
    assert built.copy().member("t", tie=tie).to_dict() == built.add(voussoir.Member(id="t", tie=tie)).to_dict()
    line = {"between": [{"block": "b", "at": [0, 0, 5]}, {"ground": [3, 0, 0]}], "strength": 1000}
    assert built.to_dict() == plain.add(voussoir.Member(id="t", tie=line)).to_dict()  # type: ignore[arg-type]
    # Where neither has a density, that of the scene; a mesh is read as it is added.
    meshes = structures / "meshes"
    stone = voussoir.Block.mesh("stone", str(meshes / "frustum.obj"))
    scene = voussoir.Scene(density=2000).add(stone, voussoir.Column(blocks=2, size=(1, 1, 1)))
    data = scene.to_dict()
    assert data["blocks"][0]["density"] == 2000 and data["blocks"][0]["shape"]["mesh"]["vertices"]
    assert data["templates"][0]["column"]["material"] in data["materials"]
    with pytest.raises(voussoir.InputError) as caught:
        scene.add(voussoir.Block.mesh("other", str(meshes / "nothing.obj")))
    assert caught.value.path == "blocks[1].shape.mesh.path" and len(scene.to_dict()["blocks"]) == 1


def test_every_key_of_an_answer_is_an_attribute(structures: Path) -> None:
    answer = voussoir.kinematic(structures / "overturning-wall.json", toward=(1, 0))
    keys = answer.to_dict()["answer"]["kinematic"]
    assert answer.fc == keys["fc"] and answer.numbers.a0 == keys["numbers"]["a0"] == answer.a0
    assert answer.demand is not None and answer.demand.checks[0]["ratio"] == answer.demand.checks[0].ratio
    assert answer.demand.to_dict()["ratio"] == keys["numbers"]["demand"]["ratio"]
    with pytest.raises(KeyError):
        answer.demand["nothing"]
    assert answer.no_curve is None and voussoir.kinematic(table(), toward=(1, 0), linear=True).no_curve is None
    left = voussoir.settle(structures / "spreading-arch.json", out={"springer_*": 0.02}, time_limit=1e-6)
    assert left.status == "open" and left.why


def test_plots(monkeypatch: pytest.MonkeyPatch) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    stands = voussoir.assess(table())
    axes = stands.plot()
    blocks, forces = axes.collections
    assert len(blocks.get_paths()) == 12 and len(forces.get_paths()) == 1
    assert axes.get_title() == stands.title and axes.get_xlabel() == "x, m"
    assert stands.plot(axes, view="top") is axes and axes.get_ylabel() == "y, m"
    with pytest.raises(voussoir.InputError) as caught:
        stands.plot(view="below")
    assert caught.value.path == "view"
    pushed = table().load("live", weight=(1, 0, 0))
    # The mechanism has no forces; the block is displaced.
    assert len(voussoir.limit(pushed).plot().collections) == 1
    path = voussoir.push(pushed, ("block", (0, 0, 1)), (1, 0, 0))
    (line,) = path.plot().lines
    assert np.array_equal(line.get_ydata(), path.load_factor)
    state = voussoir.state(table().joint(friction=0.6, normal_stiffness=1e9))
    assert state.plot().collections and state.to_frame() is not None


def test_a_page_outside_of_notebooks_goes_to_the_browser(monkeypatch: pytest.MonkeyPatch) -> None:
    opened: list[str] = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    answer = voussoir.assess(table())
    answer.show()
    (address,) = opened
    assert Path(address.removeprefix("file://")).read_text(encoding="utf-8") == answer.report()


def test_files_in_other_units_and_axes(tmp_path: Path) -> None:
    corners, faces = cube(1000.0)
    file = tmp_path / "cube.obj"
    # y points up: the upper cube lies at y = 1000.
    rows = ["o lower", *(f"v {x} {y} {z}" for x, y, z in corners)]
    rows += ["f " + " ".join(str(k + 1) for k in face) for face in faces]
    rows += ["o upper", *(f"v {x} {y + 1000} {z}" for x, y, z in corners)]
    rows += ["f " + " ".join(str(k + 9) for k in face) for face in faces]
    file.write_text("\n".join(rows) + "\n")
    scene = voussoir.import_file(
        file, scale=0.001, up="y", support_below=-0.4, friction=0.6, density=1000
    )
    with pytest.warns(UserWarning, match="no friction"):
        voussoir.import_file(file, scale=0.001, up="y", support_below=-0.4, density=1000)
    answer = voussoir.assess(scene)
    assert answer.verdict and answer.blocks.mass.tolist() == pytest.approx([1000, 1000])
    assert answer.blocks.centroid[1].tolist() == pytest.approx([0, 0, 1], abs=1e-12)
