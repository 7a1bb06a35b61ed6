"""Solids of Rhino and of IFC: written by rhino3dm and ifcopenshell, read by `voussoir.import_file`."""

import pathlib

import pytest

import voussoir


def corners(scene: voussoir.Scene, name: str) -> list[list[float]]:
    block = next(b for b in scene.to_dict()["blocks"] if b["id"] == name)
    vertices: list[list[float]] = block["shape"]["polyhedron"]["vertices"]
    return vertices


def test_rhino_layers_are_supports_and_densities(tmp_path: pathlib.Path) -> None:
    rhino3dm = pytest.importorskip("rhino3dm")
    model = rhino3dm.File3dm()
    model.Settings.ModelUnitSystem = rhino3dm.UnitSystem.Centimeters
    layers = {}
    for name in ("ground", "stone"):
        layer = rhino3dm.Layer()
        layer.Name = name
        layers[name] = model.Layers.Add(layer)

    def add(name: str, layer: str, low: float, high: float) -> None:
        box = rhino3dm.BoundingBox(rhino3dm.Point3d(0, 0, low), rhino3dm.Point3d(100, 50, high))
        shape = rhino3dm.Brep.CreateFromBox(rhino3dm.Box(box))
        attributes = rhino3dm.ObjectAttributes()
        attributes.Name, attributes.LayerIndex = name, layers[layer]
        model.Objects.AddBrep(shape, attributes)

    add("bed", "ground", -20, 0)
    add("block one", "stone", 0, 40.1)
    sheet = rhino3dm.Mesh()
    for x, y in ((0, 0), (1, 0), (0, 1)):
        sheet.Vertices.Add(x, y, 0)
    sheet.Faces.AddFace(0, 1, 2)
    model.Objects.AddMesh(sheet, rhino3dm.ObjectAttributes())
    path = tmp_path / "pier.3dm"
    assert model.Write(str(path), 7)

    with pytest.warns(UserWarning, match="not closed"):
        scene = voussoir.import_file(
            path, friction=0.6, layers={"ground": "support", "stone": "block,density=2400"}
        )
    blocks = {b["id"]: b for b in scene.to_dict()["blocks"]}
    assert set(blocks) == {"bed", "block one"} and blocks["bed"]["support"]
    top = max(z for _, _, z in corners(scene, "block one"))
    assert top == pytest.approx(0.401, rel=1e-15)
    answer = voussoir.assess(scene)
    assert answer.verdict == "stable"
    assert scene.to_dict()["materials"]["stone"]["density"] == 2400


def test_elements_of_a_building_are_blocks(tmp_path: pathlib.Path) -> None:
    ifcopenshell = pytest.importorskip("ifcopenshell")
    api = pytest.importorskip("ifcopenshell.api")
    model = ifcopenshell.file()
    api.run("root.create_entity", model, ifc_class="IfcProject", name="p")
    api.run("unit.assign_unit", model, length={"is_metric": True, "raw": "MILLIMETRES"})
    context = api.run("context.add_context", model, context_type="Model")
    body = api.run(
        "context.add_context", model, context_type="Model", context_identifier="Body",
        target_view="MODEL_VIEW", parent=context,
    )
    for name, kind, low in (("slab", "IfcSlab", 0.0), ("wall", "IfcWall", 0.25)):
        element = api.run("root.create_entity", model, ifc_class=kind, name=name)
        api.run("geometry.edit_object_placement", model, product=element)
        points = [(x, y, low + z) for z in (0.0, 0.25) for x, y in ((0, 0), (2, 0), (2, 1), (0, 1))]
        faces = [(3, 2, 1, 0), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
        shape = api.run(
            "geometry.add_mesh_representation", model, context=body, vertices=[points], faces=[faces]
        )
        api.run("geometry.assign_representation", model, product=element, representation=shape)
    path = tmp_path / "house.ifc"
    model.write(str(path))

    scene = voussoir.import_file(path, friction=0.6, density=2000, layers={"IfcSlab": "support"})
    blocks = {b["id"]: b for b in scene.to_dict()["blocks"]}
    assert set(blocks) == {"slab", "wall"} and blocks["slab"]["support"]
    assert max(z for _, _, z in corners(scene, "wall")) == pytest.approx(0.5, rel=1e-12)
    assert voussoir.assess(scene).verdict == "stable"


def test_what_is_not_read_says_the_way_round(tmp_path: pathlib.Path) -> None:
    path = tmp_path / "part.step"
    path.write_text("ISO-10303-21;")
    with pytest.raises(voussoir.InputError) as refused:
        voussoir.import_file(path)
    assert refused.value.remedy is not None and "OBJ" in refused.value.remedy
