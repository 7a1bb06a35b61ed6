"""Scenes: read from files, given as plain values, or built in code."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from . import _core
from ._errors import InputError
from ._plain import without_none

Vector: TypeAlias = Sequence[float] | npt.NDArray[np.float64]
"""Three numbers."""

SceneLike: TypeAlias = "Scene | str | os.PathLike[str] | Mapping[str, Any]"
"""A scene, the path of its file, or what stands in one."""

Friction: TypeAlias = float | Literal["infinite"]


def _three(vector: Vector) -> list[float]:
    return [float(x) for x in vector]


class Scene:
    """Blocks that only touch, with their joints and loads.

    Built in code, block by block, or read by :func:`load`. Units are SI: m, kg, s, N; z points up.
    Methods that add something return the scene, so that they can be written one after the other.

    Parameters
    ----------
    name : str
        A name for people.
    friction : float or "infinite", optional
        Coefficient of friction of every joint without an exception.
    density : float, optional
        kg/m³, of blocks that are added without a density, a mass or a material.
    gravity : three numbers, optional
        m/s²; 9.81 downward where nothing is said.
    """

    __slots__ = ("_core", "_density")

    def __init__(
        self,
        name: str = "",
        *,
        friction: Friction | None = None,
        density: float | None = None,
        gravity: Vector | None = None,
    ) -> None:
        self._core = _core.Scene()
        self._density = density
        if name:
            self._core.set("name", name)
        if gravity is not None:
            self._core.set("gravity", _three(gravity))
        if friction is not None:
            self._core.set("joint", {"friction": friction})

    @classmethod
    def _of(cls, core: _core.Scene) -> Scene:
        scene = cls.__new__(cls)
        scene._core = core
        scene._density = None
        return scene

    # ------------------------------------------------------------------ blocks

    def _spec(
        self,
        id: str,
        shape: Mapping[str, Any],
        at: Vector | None,
        rotation: tuple[Vector, float] | None,
        support: bool,
        density: float | None,
        mass: float | None,
        material: str | None,
        centroid: Vector | None,
    ) -> dict[str, Any]:
        spec: dict[str, Any] = {"id": id, "shape": shape}
        if density is None and mass is None and material is None:
            density = self._density
        if at is not None:
            spec["at"] = _three(at)
        if rotation is not None:
            spec["rotation_deg"] = {"axis": _three(rotation[0]), "angle": float(rotation[1])}
        if support:
            spec["support"] = True
        if density is not None:
            spec["density"] = density
        if mass is not None:
            spec["mass"] = mass
        if material is not None:
            spec["material"] = material
        if centroid is not None:
            spec["centroid"] = _three(centroid)
        return spec

    def box(
        self,
        id: str,
        size: Vector,
        at: Vector | None = None,
        *,
        rotation: tuple[Vector, float] | None = None,
        support: bool = False,
        density: float | None = None,
        mass: float | None = None,
        material: str | None = None,
    ) -> Scene:
        """Add a box.

        Parameters
        ----------
        size : three numbers
            Full lengths along x, y, z, m.
        at : three numbers, optional
            Its centre, m.
        rotation : (axis, angle), optional
            About its centre, degrees, right-handed.
        support : bool
            Whether it is held in place.
        density : float, optional
            kg/m³.
        mass : float, optional
            kg, in place of density × volume.
        """
        shape = {"box": {"size": _three(size)}}
        self._core.add_block(
            self._spec(id, shape, at, rotation, support, density, mass, material, None)
        )
        return self

    def sphere(
        self,
        id: str,
        radius: float,
        at: Vector | None = None,
        *,
        support: bool = False,
        density: float | None = None,
        mass: float | None = None,
        material: str | None = None,
    ) -> Scene:
        """Add a sphere of this radius (m) around ``at`` (m)."""
        shape = {"sphere": {"radius": radius}}
        self._core.add_block(self._spec(id, shape, at, None, support, density, mass, material, None))
        return self

    def polyhedron(
        self,
        id: str,
        vertices: npt.ArrayLike,
        faces: Iterable[Sequence[int]],
        at: Vector | None = None,
        *,
        rotation: tuple[Vector, float] | None = None,
        support: bool = False,
        density: float | None = None,
        mass: float | None = None,
        material: str | None = None,
        centroid: Vector | None = None,
    ) -> Scene:
        """Add a closed polyhedron, convex or not.

        Parameters
        ----------
        vertices : array of shape (n, 3)
            Corners in the block's own frame, m.
        faces : loops of indices into ``vertices``
            Counter-clockwise seen from outside.
        at, rotation
            Where the frame lies: turned about its origin first, then moved.
        centroid : three numbers, optional
            Centre of mass in the block's own frame, m, in place of that of the shape.
        """
        shape = {"sphere": {"radius": 1.0}}
        self._core.add_polyhedron(
            self._spec(id, shape, at, rotation, support, density, mass, material, centroid),
            np.ascontiguousarray(vertices, dtype=np.float64),
            [list(map(int, face)) for face in faces],
        )
        return self

    def prism(
        self,
        id: str,
        polygon: npt.ArrayLike,
        depth: float,
        at: Vector | None = None,
        *,
        rotation: tuple[Vector, float] | None = None,
        support: bool = False,
        density: float | None = None,
        mass: float | None = None,
        material: str | None = None,
    ) -> Scene:
        """Add a polygon of the x–z plane, shape (n, 2), m, extruded by ``depth`` (m) along y."""
        corners = np.asarray(polygon, dtype=np.float64).tolist()
        shape = {"prism": {"polygon": corners, "depth": depth}}
        self._core.add_block(
            self._spec(id, shape, at, rotation, support, density, mass, material, None)
        )
        return self

    def block(self, **values: Any) -> Scene:
        """Add a block as scene files have it: ``block(id="b", shape={"clump": …}, density=2400)``."""
        self._core.add_block(values)
        return self

    def template(self, kind: str, **values: Any) -> Scene:
        """Add a structure given by a few numbers: ``template("arch", voussoirs=27, …)``.

        ``voussoir generate`` lists the kinds, ``voussoir generate arch --help`` the numbers of one.
        """
        self._core.add("templates", {kind: values})
        return self

    # ------------------------------------------------------- joints and loads

    def joint(
        self,
        *,
        between: tuple[str, str] | None = None,
        blocks: tuple[str, str] | None = None,
        friction: Friction | None = None,
        friction_angle_deg: float | None = None,
        cohesion: float | None = None,
        tension: float | None = None,
        compression: float | None = None,
        pore_pressure: float | None = None,
        rolling_arm: float | None = None,
    ) -> Scene:
        """Say how joints resist: all of them, or those ``between`` two materials or of two ``blocks``.

        ``friction`` is a coefficient, strengths and pressures are in Pa, ``rolling_arm`` in m.
        """
        rule = without_none(
            friction=friction,
            friction_angle_deg=friction_angle_deg,
            cohesion=cohesion,
            tension=tension,
            compression=compression,
            pore_pressure=pore_pressure,
            rolling_arm=rolling_arm,
        )
        if between is None and blocks is None:
            self._core.set("joint", rule)
        else:
            where = without_none(
                between=None if between is None else list(between),
                blocks=None if blocks is None else list(blocks),
            )
            self._core.add("overrides", {**where, **rule})
        return self

    def load(
        self,
        kind: Literal["live", "dead"],
        block: str | None = None,
        *,
        force: Vector | None = None,
        moment: Vector | None = None,
        at: Vector | None = None,
        arm: bool = False,
        acceleration: Vector | None = None,
        weight: Vector | None = None,
    ) -> Scene:
        """Add a load: ``"dead"`` ones are always there, ``"live"`` ones are multiplied by the load
        factor.

        Parameters
        ----------
        block : str, optional
            The loaded block; every free one where ``acceleration`` or ``weight`` is given alone.
        force, moment : three numbers, optional
            N, N·m.
        at : three numbers, optional
            Where the force acts, m, in the scene; the block's centre of mass where nothing is said.
        arm : bool
            Whether an arm without weight carries the force to a point off the block.
        acceleration : three numbers, optional
            m/s².
        weight : three numbers, optional
            Multiples of each block's own weight.
        """
        if kind not in ("live", "dead"):
            raise InputError(f"a load is live or dead, not {kind!r}", "loads")
        load: dict[str, Any] = without_none(block=block)
        for key, value in (
            ("force", force),
            ("moment", moment),
            ("at", at),
            ("acceleration", acceleration),
            ("weight", weight),
        ):
            if value is not None:
                load[key] = _three(value)
        if arm:
            load["arm"] = True
        self._core.add(kind, load)
        return self

    def member(self, **values: Any) -> Scene:
        """Add a tie, strut, tendon, dowel or the like, as scene files have it:
        ``member(id="t", tie={…})``."""
        self._core.add("members", values)
        return self

    def interface(
        self,
        a: str,
        b: str,
        points: npt.ArrayLike,
        *,
        normal: Vector | None = None,
        friction: Friction | None = None,
    ) -> Scene:
        """Give a contact by hand: corners of shape (n, 3), m; contacts of the pair are not searched."""
        spec: dict[str, Any] = {
            "between": [a, b],
            "points": np.asarray(points, dtype=np.float64).tolist(),
        }
        if normal is not None:
            spec["normal"] = _three(normal)
        if friction is not None:
            spec["friction"] = friction
        self._core.add("interfaces", spec)
        return self

    def material(self, name: str, density: float) -> Scene:
        """Name a material of this density, kg/m³."""
        materials = self._core.plain().get("materials", {})
        self._core.set("materials", {**materials, name: {"density": density}})
        return self

    def contact(
        self,
        *,
        gap: float | None = None,
        angle_deg: float | None = None,
        min_area: float | None = None,
    ) -> Scene:
        """Say when faces touch, relative to the size of the smaller block of a pair."""
        self._core.set("contact", without_none(gap=gap, angle_deg=angle_deg, min_area=min_area))
        return self

    # ------------------------------------------------------------- to look at

    @property
    def name(self) -> str:
        """A name for people."""
        return self._core.name()

    @name.setter
    def name(self, name: str) -> None:
        self._core.set("name", name)

    def copy(self) -> Scene:
        """A scene that can be changed without changing this one."""
        other = Scene._of(self._core.copy())
        other._density = self._density
        return other

    def to_dict(self) -> dict[str, Any]:
        """What stands in the file of the scene, as plain values."""
        data: dict[str, Any] = json.loads(self._core.json())
        return data

    def to_json(self) -> str:
        """The file of the scene."""
        return self._core.json()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the scene to a file, which the command reads as well."""
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.to_json())

    def inspect(self) -> dict[str, Any]:
        """The scene as it was resolved, with every contact: ``"format": "voussoir-model/1"``."""
        return self._core.inspect()

    def __repr__(self) -> str:
        blocks, templates = self._core.counts()
        name = f"{self.name!r}: " if self.name else ""
        plural = "" if templates == 1 else "s"
        more = f", {templates} template{plural}" if templates else ""
        return f"<voussoir.Scene {name}{blocks} block{'' if blocks == 1 else 's'}{more}>"

    def __copy__(self) -> Scene:
        return self.copy()

    def __deepcopy__(self, memo: dict[int, Any]) -> Scene:
        return self.copy()

    def __reduce__(self) -> tuple[Any, ...]:
        return (_restored, (self.to_dict(), self._density))


def _restored(data: dict[str, Any], density: float | None) -> Scene:
    scene = load(data)
    scene._density = density
    return scene


def load(
    scene: SceneLike,
    *,
    folder: str | os.PathLike[str] | None = None,
    allow_outside: bool = False,
) -> Scene:
    """Read a scene.

    Parameters
    ----------
    scene : path, mapping or Scene
        The file, or what stands in one; arrays of numpy may stand for lists. A scene is copied.
    folder : path, optional
        Where meshes are looked for that the scene names: the folder of the file, or the current one.
    allow_outside : bool
        Whether paths of meshes may leave that folder.

    Raises
    ------
    InputError
        With the place and the remedy.
    """
    if isinstance(scene, Scene):
        return scene.copy()
    if isinstance(scene, Mapping):
        return Scene._of(_core.Scene.of(dict(scene), os.fspath(folder or ""), allow_outside))
    path = os.fspath(scene)
    if folder is None:
        return Scene._of(_core.Scene.read(path, allow_outside))
    with open(path, encoding="utf-8") as file:
        return Scene._of(_core.Scene.parse(path, file.read(), os.fspath(folder), allow_outside))


def load_foreign(
    *paths: str | os.PathLike[str],
    supports: Iterable[str] = (),
    support_below: float | None = None,
    support_files: Iterable[str | os.PathLike[str]] = (),
    friction: Friction | None = None,
    density: float | None = None,
    scale: float = 1.0,
    up: Literal["x", "y", "z", "-x", "-y", "-z"] = "z",
    gap: float | None = None,
    angle_deg: float | None = None,
    stored_interfaces: bool = True,
) -> Scene:
    """Make a scene from files of other programs: COMPAS JSON, OBJ, PLY, STL.

    Parameters
    ----------
    supports : ids of blocks
        Held in place, beside those that the file names.
    support_below : float, optional
        Blocks whose lowest corner lies below this height are held, m.
    support_files : paths
        All their blocks are held.
    friction : float or "infinite", optional
        Of every joint.
    density : float, optional
        kg/m³, in place of what the file says.
    scale : float
        Multiplies coordinates: 0.001 for a file in millimetres.
    up : str
        The axis of the file that points up.
    gap, angle_deg : float, optional
        When faces touch, as in :meth:`Scene.contact`.
    stored_interfaces : bool
        Keep those of the file in place of contacts that are detected.
    """
    scene, _ = _core.import_scene(
        [os.fspath(path) for path in paths],
        supports=list(supports),
        support_below=support_below,
        support_files=[os.fspath(path) for path in support_files],
        friction=float("inf") if friction == "infinite" else friction,
        density=density,
        scale=scale,
        up=up,
        gap=gap,
        angle_deg=angle_deg,
        stored_interfaces=stored_interfaces,
    )
    return Scene._of(scene)


def core(scene: SceneLike) -> _core.Scene:
    """What questions are asked of."""
    return scene._core if isinstance(scene, Scene) else load(scene)._core


