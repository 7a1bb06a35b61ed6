"""Solids of Rhino (``.3dm``) and of buildings (IFC) as OBJ, which the importer reads: an object a solid, its
layer or class as group. The readers are rhino3dm and ifcopenshell, where they are installed."""

from __future__ import annotations

import importlib
import os
import warnings
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ._errors import InputError

#: A face as corners in order, counter-clockwise seen from outside.
_Face = Sequence[Sequence[float]]

#: Name, layer, faces.
_Solid = tuple[str, str, list[_Face]]

#: Relative to the size of a face: a face of Rhino that is flatter is plane.
_FLAT = 1e-9


def as_obj(path: str) -> tuple[bytes, float] | None:
    """The solids of a file as OBJ and the metres in its unit; None for files that the importer reads itself.

    Raises
    ------
    InputError
        The reader is not installed, or the file holds no solids.
    """
    ending = os.path.splitext(path)[1].lower()
    if ending == ".3dm":
        solids, unit = _rhino(path)
    elif ending == ".ifc":
        solids, unit = _ifc(path)
    elif ending in (".stp", ".step"):
        raise InputError(
            f"{path}: STEP is not read", remedy="export OBJ or STL with one object a block, or .3dm"
        )
    else:
        return None
    text = _text(solids)
    if not text:
        raise InputError(f"{path}: no closed solid in this file")
    return text.encode(), unit


def _text(solids: Iterable[_Solid]) -> str:
    """OBJ: one corner a place within a solid."""
    lines: list[str] = []
    count = 0
    for name, layer, faces in solids:
        places: dict[tuple[float, ...], int] = {}
        for corner in (corner for face in faces for corner in face):
            places.setdefault(tuple(float(x) for x in corner), len(places) + 1)
        lines += [f"o {' '.join(name.split())}", f"g {' '.join(layer.split())}"]
        lines += [f"v {x!r} {y!r} {z!r}" for x, y, z in places]
        for face in faces:
            corners = (str(count + places[tuple(float(x) for x in c)]) for c in face)
            lines.append("f " + " ".join(corners))
        count += len(places)
    return "\n".join([*lines, ""]) if lines else ""


def _left_out(path: str, names: Sequence[str], why: str) -> None:
    if names:
        shown = ", ".join(names[:8]) + (", …" if len(names) > 8 else "")
        warnings.warn(f"{path}: {why}: {len(names)} ({shown})", stacklevel=4)


def _reader(path: str, name: str) -> Any:
    """A module that is not of this package, and of whose types nothing is asked."""
    try:
        return importlib.import_module(name)
    except ImportError:
        package = name.partition(".")[0]
        raise InputError(f"{path}: needs {package}", remedy=f"pip install {package}") from None


def _rhino(path: str) -> tuple[list[_Solid], float]:
    rhino3dm = _reader(path, "rhino3dm")
    model = rhino3dm.File3dm.Read(path)
    if model is None:
        raise InputError(f"{path}: rhino3dm cannot read this file")
    units = rhino3dm.UnitSystem
    unit = {
        units.Millimeters: 1e-3, units.Centimeters: 1e-2, units.Decimeters: 0.1, units.Meters: 1.0,
        units.Inches: 0.0254, units.Feet: 0.3048,
    }.get(model.Settings.ModelUnitSystem)
    if unit is None:
        warnings.warn(f"{path}: its unit is none of mm, cm, dm, m, in, ft; metres assumed", stacklevel=3)
        unit = 1.0
    solids: list[_Solid] = []
    others: list[str] = []
    open_ones: list[str] = []
    for item in model.Objects:
        name = item.Attributes.Name or str(item.Attributes.Id)
        layer = model.Layers[item.Attributes.LayerIndex].Name
        shape = item.Geometry
        if isinstance(shape, rhino3dm.Extrusion):
            shape = shape.ToBrep(True)
        if isinstance(shape, rhino3dm.Brep):
            faces = _of_brep(path, name, shape) if shape.IsSolid else None
        elif isinstance(shape, rhino3dm.Mesh):
            faces = _of_mesh(shape) if shape.IsClosed else None
        else:
            others.append(name)
            continue
        if faces is None:
            open_ones.append(name)
        else:
            solids.append((name, layer, faces))
    _left_out(path, open_ones, "surfaces and meshes that are not closed, left out")
    _left_out(path, others, "objects that are no solids, left out (explode blocks and groups in Rhino)")
    return solids, unit


def _of_mesh(mesh: Any) -> list[_Face]:
    points = [(p.X, p.Y, p.Z) for p in mesh.Vertices.ToPoint3dArray()]
    faces: list[_Face] = []
    for k in range(mesh.Faces.Count):
        # A triangle names its last corner twice.
        corners = list(dict.fromkeys(mesh.Faces[k]))
        faces.append([points[c] for c in corners])
    return faces


def _of_brep(path: str, name: str, brep: Any) -> list[_Face]:
    """Plane faces by their corners, others by the mesh with which Rhino shows them."""
    rhino3dm = _reader(path, "rhino3dm")
    faces: list[_Face] = []
    for k in range(len(brep.Faces)):
        face = brep.Faces[k]
        trims = list(face.OuterLoop.Trims)
        straight = all(t.EdgeIndex >= 0 and brep.Edges[t.EdgeIndex].IsLinear() for t in trims)
        corners: npt.NDArray[np.float64] = np.array([
            [p.X, p.Y, p.Z] for p in (brep.Vertices[t.StartVertexIndex].Location for t in trims)
        ])
        size = float(np.ptp(corners, axis=0).max())
        if len(face.Loops) == 1 and straight and face.IsPlanar(_FLAT * size):
            ring = corners.tolist()
            faces.append(ring[::-1] if face.OrientationIsReversed else ring)
            continue
        mesh = face.GetMesh(rhino3dm.MeshType.Any)
        if mesh is None:
            raise InputError(
                f"{path}: {name!r} has a curved face and no mesh",
                remedy="shade it in Rhino and save again, or mesh it",
            )
        faces += _of_mesh(mesh)
    return faces


def _ifc(path: str) -> tuple[list[_Solid], float]:
    ifcopenshell, geometry = _reader(path, "ifcopenshell"), _reader(path, "ifcopenshell.geom")
    model = ifcopenshell.open(path)
    settings = geometry.settings()
    settings.set("use-world-coords", True)
    solids: list[_Solid] = []
    # Openings and spaces are no bodies.
    bodies = [
        p for p in model.by_type("IfcElement")
        if p.Representation is not None and not p.is_a("IfcFeatureElement")
    ]
    bare: list[str] = []
    for product in bodies:
        name = product.Name or product.GlobalId
        try:
            shape = geometry.create_shape(settings, product)
        except RuntimeError:
            bare.append(name)
            continue
        points = np.asarray(shape.geometry.verts, dtype=float).reshape(-1, 3)
        triangles = np.asarray(shape.geometry.faces, dtype=int).reshape(-1, 3)
        solids.append((name, product.is_a(), [points[t].tolist() for t in triangles]))
    _left_out(path, bare, "elements without a body, left out")
    # ifcopenshell converts to metres.
    return solids, 1.0

