"""Scenes: read from files, given as plain values, or built in code."""

from __future__ import annotations

import dataclasses
import json
import os
import warnings
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from . import _core
from ._errors import InputError
from ._models import as_obj
from ._plain import Value, Vector
from ._scene_keys import Joint, Load, Material, SceneMethods

if TYPE_CHECKING:
    from typing import Self

SceneLike: TypeAlias = "Scene | str | os.PathLike[str] | Mapping[str, Any]"
"""A scene, the path of its file, or what stands in one."""

Friction: TypeAlias = float | Literal["infinite"]

Up: TypeAlias = Literal["x", "y", "z", "-x", "-y", "-z"]
"""An axis of a file that points up."""

ONE = ("contact", "record", "require", "site", "train")
"""Keys of a scene with one value."""


def _three(vector: Vector) -> list[float]:
    return [float(x) for x in vector]


class Scene(SceneMethods):
    """Rigid blocks with their joints, loads and members.

    Units are SI: m, kg, s, N; z points up. Methods that add something return the scene. What scene
    files may hold has a class of the same name and keys: :class:`Block`, templates such as
    :class:`Arch`, :class:`Dome` and :class:`Wall`, :class:`Member`, :class:`Stage`, :class:`Train`,
    :class:`Site`.

    Parameters
    ----------
    name : str
        A name for people.
    friction : float or "infinite", optional
        Coefficient of friction of all joints that have no rule of their own.
    density : float, optional
        kg/m³, of blocks and templates that are added without a density, mass or material.
    gravity : three numbers, optional
        m/s². Default (0, 0, -9.81).

    Examples
    --------
    >>> import voussoir
    >>> table = voussoir.Scene("Table", friction=0.6, density=2400)
    >>> table.box("ground", (2, 2, 0.2), at=(0, 0, -0.1), support=True)
    <voussoir.Scene 'Table': 1 block>
    >>> table.box("block", (0.4, 0.4, 1), at=(0, 0, 0.5)).load("live", weight=(1, 0, 0))
    <voussoir.Scene 'Table': 2 blocks>
    >>> round(float(voussoir.limit(table).load_factor), 6)
    0.4

    See Also
    --------
    load : read a scene file.
    import_file : read files of other programs.
    """

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

    # ------------------------------------------------------------------- parts

    def add(self, *things: Value) -> Self:
        """Add blocks, templates, members, interfaces, stages, masses, combinations of actions; set
        the train, the site, what is required.

        Parameters
        ----------
        *things : Block, Arch, Member, Stage, Train, ...
            Objects of the classes that scene files have.

        Raises
        ------
        InputError
            A value that no scene can have, with its place.

        Examples
        --------
        >>> import voussoir
        >>> scene = voussoir.Scene("Arch", friction=0.7, density=2400)
        >>> scene.add(voussoir.Arch(radius=1, thickness=0.15, depth=1, voussoirs=9))
        <voussoir.Scene 'Arch': 0 blocks, 1 template>
        """
        for thing in things:
            under = thing._under if isinstance(thing, Value) else None
            if under is None:
                raise TypeError(f"a {type(thing).__name__} is no block, template, member or the like")
            put = self._core.set if under in ONE else self._core.add
            put(under, self._with_density(thing))
        return self

    def _with_density(self, thing: Value) -> Value:
        """The same with the density of the scene, where it has none of its own."""
        keys = ("density", "mass", "material")
        missing = all(getattr(thing, key, None) is None for key in keys)
        if self._density is None or not missing:
            return thing
        if thing._under == "templates":
            self.material("default", self._density)
            return dataclasses.replace(thing, material="default")  # type: ignore[type-var]
        if thing._under == "blocks":
            return dataclasses.replace(thing, density=self._density)  # type: ignore[type-var]
        return thing

    def block(self, **values: Any) -> Self:
        """Add a block by the keys of scene files, as plain values.

        Parameters
        ----------
        **values
            As of :class:`Block`: ``block(id="b", shape={"sphere": {"radius": 1}}, density=2400)``.
        """
        self._core.add("blocks", values)
        return self

    def template(self, kind: str, **values: Any) -> Self:
        """Add a template by the keys of scene files, as plain values.

        Parameters
        ----------
        kind : str
            ``"arch"``, ``"dome"``, ``"wall"``, ...: ``voussoir generate`` lists them.
        **values
            As of :class:`Arch`, :class:`Dome`, :class:`Wall`, ...
        """
        self._core.add("templates", {kind: values})
        return self

    def _joint(self, rule: Joint) -> Self:
        if rule.between is None and rule.blocks is None:
            self._core.set("joint", rule)
        else:
            self._core.add("overrides", rule)
        return self

    def _load(self, kind: str, load: Load) -> Self:
        if kind not in ("live", "dead"):
            raise InputError(f"must be 'live' or 'dead', got {kind!r}", "kind")
        self._core.add(kind, load)
        return self

    def _material(self, name: str, values: Material) -> Self:
        self._core.set("materials", {**self._core.plain().get("materials", {}), name: values})
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
        """The scene as it was resolved, with every contact.

        Returns
        -------
        dict
            ``blocks``: ``id``, ``support``, ``mass`` (kg), ``centroid`` (m), ``dead`` and ``live``
            with the ``force`` (N) and ``moment`` (N·m) of the loads; ``interfaces``: ``between``
            (indices of blocks), ``kind``, axes ``t1``, ``t2``, ``n``, ``points`` (m), ``area`` (m²),
            ``friction``; ``members``; ``findings``.

        Raises
        ------
        InputError
            The scene cannot be resolved: a block has no density, no block is a support, ...

        Examples
        --------
        >>> import voussoir
        >>> scene = voussoir.Scene(friction=0.6, density=1000).box("ground", (2, 2, 1), support=True)
        >>> model = scene.box("block", (1, 1, 1), at=(0, 0, 1)).inspect()
        >>> [block["id"] for block in model["blocks"]], model["interfaces"][0]["area"]
        (['ground', 'block'], 1.0)
        """
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
        The file, or what stands in one; numpy arrays may stand for lists. A scene is copied.
    folder : path, optional
        Where meshes are looked for that the scene names: the folder of the file, or the current one.
    allow_outside : bool
        Whether paths of meshes may leave that folder.

    Returns
    -------
    Scene

    Raises
    ------
    InputError
        The scene cannot be used as it is; with the place and the remedy.

    References
    ----------
    ``docs/guide/scenes.md``.

    Examples
    --------
    >>> import voussoir
    >>> ball = {"id": "ball", "shape": {"sphere": {"radius": 0.1}}, "density": 1100}
    >>> voussoir.load({"format": "voussoir-scene/1", "blocks": [ball]})
    <voussoir.Scene 1 block>
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


def import_file(
    *paths: str | os.PathLike[str],
    supports: Iterable[str] = (),
    support_below: float | None = None,
    support_files: Iterable[str | os.PathLike[str]] = (),
    friction: Friction | None = None,
    density: float | None = None,
    scale: float | None = None,
    up: Up | None = None,
    gap: float | None = None,
    angle_deg: float | None = None,
    stored_interfaces: bool = True,
    depth: float | None = None,
    layers: Mapping[str, str | Mapping[str, Any]] | None = None,
) -> Scene:
    """Make a scene of files of other programs: drawings, meshes, robots, packing lists, grains.

    Rhino's ``.3dm`` is read by rhino3dm, IFC by ifcopenshell, where they are installed.

    Parameters
    ----------
    *paths : paths
        One file, or several with some blocks each.
    supports : ids of blocks
        Held in place, beside those that the file names.
    support_below : float, optional
        Blocks whose lowest corner lies below this height are held, m.
    support_files : paths
        All their blocks are held.
    friction : float or "infinite", optional
        Coefficient of friction of every joint.
    density : float, optional
        kg/m³, in place of what the file says.
    scale : float, optional
        Multiplies coordinates: 0.001 for a file in millimetres; by default the unit that the file
        names.
    up : {"x", "y", "z", "-x", "-y", "-z"}, optional
        The axis of the file that points up; by default y of glTF, z of others.
    gap, angle_deg : float, optional
        When faces touch, as in :class:`ContactTolerances`.
    stored_interfaces : bool
        Keep those of the file in place of contacts that are detected.
    depth : float, optional
        Thickness of the blocks of a plane drawing (DXF), m.
    layers : mapping of str or mapping, optional
        What layers of a drawing, of a model of Rhino, or classes of IFC stand for: ``"support"``, ``"block,density=2400"``,
        ``"tie,strength=50000"``, ``"load,force=0:-1000"``, ``"ignore"``, or the same as a mapping
        (``{"role": "block", "density": 2400}``). Layers that are not named hold blocks.

    Returns
    -------
    Scene

    Warns
    -----
    UserWarning
        For what was left out, and for what is missing before a question can be asked.

    Raises
    ------
    InputError
        A file that cannot be read, or an option that no file can have.

    References
    ----------
    ``docs/guide/vault.md``.

    Examples
    --------
    A tetrahedron in millimetres:

    >>> import pathlib, tempfile, voussoir
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "stone.obj"
    >>> corners = "v 0 0 0\\nv 600 0 0\\nv 0 600 0\\nv 0 0 600\\n"
    >>> _ = path.write_text("o stone\\n" + corners + "f 1 3 2\\nf 1 2 4\\nf 2 3 4\\nf 3 1 4\\n")
    >>> scene = voussoir.import_file(path, scale=0.001, density=2400, friction=0.6)
    >>> scene.to_dict()["blocks"][0]["shape"]["polyhedron"]["vertices"][1]
    [0.6, 0.0, 0.0]
    """
    files = [os.fspath(path) for path in paths]
    name = data = None
    for file in files:
        solids = as_obj(file)
        if solids is None:
            continue
        if len(files) > 1:
            raise InputError(f"{file}: import it alone, files of this kind hold whole models")
        data, unit = solids
        files, name, scale = [], os.path.basename(file), unit if scale is None else scale
    scene, findings = _core.import_scene(
        files,
        name=name,
        data=data,
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
        depth=depth,
        layers=json.dumps(dict(layers or {})),
    )
    for code, text, is_implausible, _ in findings:
        if is_implausible or code in ("left_out", "missing"):
            warnings.warn(text, stacklevel=2)
    return Scene._of(scene)


def core(scene: SceneLike) -> _core.Scene:
    """What questions are asked of."""
    return scene._core if isinstance(scene, Scene) else load(scene)._core
