"""The keys of scenes. Made by ``python/generate.py`` from ``voussoir schema``: not to be edited."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Literal

import numpy.typing as npt

from ._plain import Value, Vector

if TYPE_CHECKING:
    from typing import Self

__all__ = [
    "Arch",
    "Axle",
    "Backing",
    "Ball",
    "Bar",
    "Barrel",
    "Block",
    "Box",
    "Bridge",
    "BridgePier",
    "BridgeSpan",
    "Building",
    "Buttresses",
    "Clump",
    "Column",
    "Combination",
    "ContactTolerances",
    "Dome",
    "DomeOpening",
    "Dowel",
    "End",
    "Fill",
    "Finger",
    "FlatArch",
    "Grip",
    "Groin",
    "Heading",
    "Interface",
    "Joint",
    "Lantern",
    "Lattice",
    "Leaves",
    "Line",
    "Load",
    "Material",
    "MaterialFactors",
    "Member",
    "Mesh",
    "Near",
    "OnRoad",
    "Opening",
    "Pier",
    "Plane",
    "Polyhedron",
    "Portal",
    "Prism",
    "PushingMass",
    "Requirements",
    "Rotation",
    "Site",
    "Soil",
    "Spectrum",
    "Sphere",
    "Stack",
    "Stage",
    "Strip",
    "Tendon",
    "Toothing",
    "Tower",
    "Train",
    "Wall",
]


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Heading(Value):
    """Project and people, for the first page of the record of an assessment. No answer
    depends on it; what is absent is a blank line there.

    Parameters
    ----------
    project : str, optional
        Name or number of the project.
    author : str, optional
        Who made the assessment.
    checker : str, optional
        Who checks it.
    revision : str, optional
        Revision, such as ``B``.
    date : str, optional
        Date of the revision, as it is to be read.

    Examples
    --------
    >>> import voussoir
    >>> heading = voussoir.Heading(project="Mill Lane", author="A. Mason", revision="B")
    >>> scene = voussoir.Scene().add(heading)
    >>> heading.project
    'Mill Lane'
    """

    _under: ClassVar[str | None] = "record"
    project: str | None = None
    author: str | None = None
    checker: str | None = None
    revision: str | None = None
    date: str | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Block(Value):
    """One rigid block.

    Parameters
    ----------
    id : str
        Unique name.
    shape : Box or Polyhedron or Mesh or Prism or Sphere or Clump or Plane
        Geometry in the block's own frame.
    at : three numbers, optional
        Where the origin of the block's frame lies, m.
    rotation_deg : Rotation, optional
        Rotation of the block about the origin of its frame, applied before ``at``.
    support : bool, optional
        Whether the block is held in place.
    material : str, optional
        Name of a material.
    density : float, optional
        Density, kg/m³; overrides the material's.
    mass : float, optional
        Mass, kg; overrides density × volume.
    centroid : three numbers, optional
        Centre of mass in the block's own frame, m; overrides the centroid of the shape.

    Examples
    --------
    >>> import voussoir
    >>> block = voussoir.Block(id="ball", shape=voussoir.Sphere(radius=0.05), material="rubber")
    >>> voussoir.Scene().add(block)
    <voussoir.Scene 1 block>
    """

    _under: ClassVar[str | None] = "blocks"
    id: str
    shape: Box | Polyhedron | Mesh | Prism | Sphere | Clump | Plane
    at: Vector | None = None
    rotation_deg: Rotation | None = None
    support: bool = False
    material: str | None = None
    density: float | None = None
    mass: float | None = None
    centroid: Vector | None = None

    @classmethod
    def box(
        cls,
        id: str,
        size: Vector,
        at: Vector | None = None,
        *,
        rotation_deg: Rotation | None = None,
        support: bool = False,
        material: str | None = None,
        density: float | None = None,
        mass: float | None = None,
        centroid: Vector | None = None,
    ) -> Block:
        """A box centred on the origin.

        Parameters
        ----------
        id : str
            Unique name.
        size : three numbers
            Full lengths along x, y, z.
        at : three numbers, optional
            Where the origin of the block's frame lies, m.
        rotation_deg : Rotation, optional
            Rotation of the block about the origin of its frame, applied before ``at``.
        support : bool, optional
            Whether the block is held in place.
        material : str, optional
            Name of a material.
        density : float, optional
            Density, kg/m³; overrides the material's.
        mass : float, optional
            Mass, kg; overrides density × volume.
        centroid : three numbers, optional
            Centre of mass in the block's own frame, m; overrides the centroid of the shape.
        """
        return cls(
            id=id, shape=Box(size=size), at=at, rotation_deg=rotation_deg, support=support,
            material=material, density=density, mass=mass, centroid=centroid,
        )

    @classmethod
    def polyhedron(
        cls,
        id: str,
        vertices: npt.ArrayLike,
        faces: Sequence[Sequence[int]],
        at: Vector | None = None,
        *,
        rotation_deg: Rotation | None = None,
        support: bool = False,
        material: str | None = None,
        density: float | None = None,
        mass: float | None = None,
        centroid: Vector | None = None,
    ) -> Block:
        """A closed polyhedron, convex or not.

        Parameters
        ----------
        id : str
            Unique name.
        vertices : array of shape (n, 3)
            Corners.
        faces : list of list of int
            Faces as loops of vertex indices, counter-clockwise seen from outside.
        at : three numbers, optional
            Where the origin of the block's frame lies, m.
        rotation_deg : Rotation, optional
            Rotation of the block about the origin of its frame, applied before ``at``.
        support : bool, optional
            Whether the block is held in place.
        material : str, optional
            Name of a material.
        density : float, optional
            Density, kg/m³; overrides the material's.
        mass : float, optional
            Mass, kg; overrides density × volume.
        centroid : three numbers, optional
            Centre of mass in the block's own frame, m; overrides the centroid of the shape.
        """
        return cls(
            id=id, shape=Polyhedron(vertices=vertices, faces=faces), at=at,
            rotation_deg=rotation_deg, support=support, material=material, density=density,
            mass=mass, centroid=centroid,
        )

    @classmethod
    def mesh(
        cls,
        id: str,
        path: str,
        at: Vector | None = None,
        *,
        rotation_deg: Rotation | None = None,
        support: bool = False,
        material: str | None = None,
        density: float | None = None,
        mass: float | None = None,
        centroid: Vector | None = None,
        scale: float | None = None,
        vertices: npt.ArrayLike | None = None,
        faces: Sequence[Sequence[int]] | None = None,
    ) -> Block:
        """A closed polyhedron, convex or not, in a file of its own: OBJ, PLY or STL with
        one mesh.

        Parameters
        ----------
        id : str
            Unique name.
        path : str
            The file, by its path from the folder of the scene, which it may not leave.
        at : three numbers, optional
            Where the origin of the block's frame lies, m.
        rotation_deg : Rotation, optional
            Rotation of the block about the origin of its frame, applied before ``at``.
        support : bool, optional
            Whether the block is held in place.
        material : str, optional
            Name of a material.
        density : float, optional
            Density, kg/m³; overrides the material's.
        mass : float, optional
            Mass, kg; overrides density × volume.
        centroid : three numbers, optional
            Centre of mass in the block's own frame, m; overrides the centroid of the shape.
        scale : float, optional
            Multiplies the coordinates of the file: 0.001 for a file in millimetres.
        vertices : array of shape (n, 3), optional
            Corners as the file has them. Results hold what was read, and so need no file; where it
            is given, no file is read.
        faces : list of list of int, optional
            Faces as the file has them, which go with ``vertices``.
        """
        return cls(
            id=id, shape=Mesh(path=path, scale=scale, vertices=vertices, faces=faces), at=at,
            rotation_deg=rotation_deg, support=support, material=material, density=density,
            mass=mass, centroid=centroid,
        )

    @classmethod
    def prism(
        cls,
        id: str,
        polygon: npt.ArrayLike,
        depth: float,
        at: Vector | None = None,
        *,
        rotation_deg: Rotation | None = None,
        support: bool = False,
        material: str | None = None,
        density: float | None = None,
        mass: float | None = None,
        centroid: Vector | None = None,
    ) -> Block:
        """A polygon in the x–z plane, extruded along y and centred on y = 0.

        Parameters
        ----------
        id : str
            Unique name.
        polygon : array of shape (n, 2)
            Corners (x, z) in order, either way round; need not be convex.
        depth : float
            Length along y.
        at : three numbers, optional
            Where the origin of the block's frame lies, m.
        rotation_deg : Rotation, optional
            Rotation of the block about the origin of its frame, applied before ``at``.
        support : bool, optional
            Whether the block is held in place.
        material : str, optional
            Name of a material.
        density : float, optional
            Density, kg/m³; overrides the material's.
        mass : float, optional
            Mass, kg; overrides density × volume.
        centroid : three numbers, optional
            Centre of mass in the block's own frame, m; overrides the centroid of the shape.
        """
        return cls(
            id=id, shape=Prism(polygon=polygon, depth=depth), at=at, rotation_deg=rotation_deg,
            support=support, material=material, density=density, mass=mass, centroid=centroid,
        )

    @classmethod
    def sphere(
        cls,
        id: str,
        radius: float,
        at: Vector | None = None,
        *,
        rotation_deg: Rotation | None = None,
        support: bool = False,
        material: str | None = None,
        density: float | None = None,
        mass: float | None = None,
        centroid: Vector | None = None,
    ) -> Block:
        """A sphere centred on the origin.

        Parameters
        ----------
        id : str
            Unique name.
        radius : float
            Radius.
        at : three numbers, optional
            Where the origin of the block's frame lies, m.
        rotation_deg : Rotation, optional
            Rotation of the block about the origin of its frame, applied before ``at``.
        support : bool, optional
            Whether the block is held in place.
        material : str, optional
            Name of a material.
        density : float, optional
            Density, kg/m³; overrides the material's.
        mass : float, optional
            Mass, kg; overrides density × volume.
        centroid : three numbers, optional
            Centre of mass in the block's own frame, m; overrides the centroid of the shape.
        """
        return cls(
            id=id, shape=Sphere(radius=radius), at=at, rotation_deg=rotation_deg,
            support=support, material=material, density=density, mass=mass, centroid=centroid,
        )

    @classmethod
    def clump(
        cls,
        id: str,
        spheres: Sequence[Ball],
        at: Vector | None = None,
        *,
        rotation_deg: Rotation | None = None,
        support: bool = False,
        material: str | None = None,
        density: float | None = None,
        mass: float | None = None,
        centroid: Vector | None = None,
    ) -> Block:
        """Spheres rigidly joined, apart, touching or overlapping; where they overlap there
        is mass once.

        Parameters
        ----------
        id : str
            Unique name.
        spheres : list of Ball
            The spheres.
        at : three numbers, optional
            Where the origin of the block's frame lies, m.
        rotation_deg : Rotation, optional
            Rotation of the block about the origin of its frame, applied before ``at``.
        support : bool, optional
            Whether the block is held in place.
        material : str, optional
            Name of a material.
        density : float, optional
            Density, kg/m³; overrides the material's.
        mass : float, optional
            Mass, kg; overrides density × volume.
        centroid : three numbers, optional
            Centre of mass in the block's own frame, m; overrides the centroid of the shape.
        """
        return cls(
            id=id, shape=Clump(spheres=spheres), at=at, rotation_deg=rotation_deg,
            support=support, material=material, density=density, mass=mass, centroid=centroid,
        )

    @classmethod
    def plane(
        cls,
        id: str,
        at: Vector | None = None,
        *,
        rotation_deg: Rotation | None = None,
        support: bool = False,
        material: str | None = None,
        density: float | None = None,
        mass: float | None = None,
        centroid: Vector | None = None,
        normal: Vector | None = None,
    ) -> Block:
        """An unbounded plane through the origin, solid behind it: ground or wall. Supports
        only. It is made a slab that reaches three times as far as the other blocks.

        Parameters
        ----------
        id : str
            Unique name.
        at : three numbers, optional
            Where the origin of the block's frame lies, m.
        rotation_deg : Rotation, optional
            Rotation of the block about the origin of its frame, applied before ``at``.
        support : bool, optional
            Whether the block is held in place.
        material : str, optional
            Name of a material.
        density : float, optional
            Density, kg/m³; overrides the material's.
        mass : float, optional
            Mass, kg; overrides density × volume.
        centroid : three numbers, optional
            Centre of mass in the block's own frame, m; overrides the centroid of the shape.
        normal : three numbers, optional
            Direction out of the ground, of any length; [0, 0, 1] where none is given.
        """
        return cls(
            id=id, shape=Plane(normal=normal), at=at, rotation_deg=rotation_deg,
            support=support, material=material, density=density, mass=mass, centroid=centroid,
        )


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Box(Value):
    """A box centred on the origin.

    Parameters
    ----------
    size : three numbers
        Full lengths along x, y, z.

    Examples
    --------
    >>> import voussoir
    >>> box = voussoir.Box(size=(4, 4, 1))
    >>> box.size
    (4, 4, 1)
    """

    _tag: ClassVar[str | None] = "box"
    size: Vector


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Polyhedron(Value):
    """A closed polyhedron, convex or not.

    Parameters
    ----------
    vertices : array of shape (n, 3)
        Corners.
    faces : list of list of int
        Faces as loops of vertex indices, counter-clockwise seen from outside.

    Examples
    --------
    >>> import voussoir
    >>> polyhedron = voussoir.Polyhedron(
    ...     vertices=[(0.0, 0.0, 0.0), (-25.031132967729032, 61.13067219967384, 40.0), (-27.354605945379106, 16.796166722890057, 30.769688183203307), (3.9802600440309734, 14.655948579139933, 32.05411819666589)],
    ...     faces=[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
    ... )
    >>> polyhedron.vertices
    [(0.0, 0.0, 0.0), (-25.031132967729032, 61.13067219967384, 40.0), (-27.354605945379106, 16.796166722890057, 30.769688183203307), (3.9802600440309734, 14.655948579139933, 32.05411819666589)]
    """

    _tag: ClassVar[str | None] = "polyhedron"
    vertices: npt.ArrayLike
    faces: Sequence[Sequence[int]]


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Mesh(Value):
    """A closed polyhedron, convex or not, in a file of its own: OBJ, PLY or STL with one
    mesh.

    Parameters
    ----------
    path : str
        The file, by its path from the folder of the scene, which it may not leave.
    scale : float, optional
        Multiplies the coordinates of the file: 0.001 for a file in millimetres.
    vertices : array of shape (n, 3), optional
        Corners as the file has them. Results hold what was read, and so need no file; where it
        is given, no file is read.
    faces : list of list of int, optional
        Faces as the file has them, which go with ``vertices``.

    Examples
    --------
    >>> import voussoir
    >>> mesh = voussoir.Mesh(path="meshes/frustum.obj", scale=0.001)
    >>> mesh.path
    'meshes/frustum.obj'
    """

    _tag: ClassVar[str | None] = "mesh"
    path: str
    scale: float | None = None
    vertices: npt.ArrayLike | None = None
    faces: Sequence[Sequence[int]] | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Prism(Value):
    """A polygon in the x–z plane, extruded along y and centred on y = 0.

    Parameters
    ----------
    polygon : array of shape (n, 2)
        Corners (x, z) in order, either way round; need not be convex.
    depth : float
        Length along y.

    Examples
    --------
    >>> import voussoir
    >>> prism = voussoir.Prism(polygon=[(0, 0), (2, 0), (2, 2)], depth=12)
    >>> prism.polygon
    [(0, 0), (2, 0), (2, 2)]
    """

    _tag: ClassVar[str | None] = "prism"
    polygon: npt.ArrayLike
    depth: float


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Sphere(Value):
    """A sphere centred on the origin.

    Parameters
    ----------
    radius : float
        Radius.

    Examples
    --------
    >>> import voussoir
    >>> sphere = voussoir.Sphere(radius=1)
    >>> sphere.radius
    1
    """

    _tag: ClassVar[str | None] = "sphere"
    radius: float


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Clump(Value):
    """Spheres rigidly joined, apart, touching or overlapping; where they overlap there is
    mass once.

    Parameters
    ----------
    spheres : list of Ball
        The spheres.

    Examples
    --------
    >>> import voussoir
    >>> clump = voussoir.Clump(
    ...     spheres=[voussoir.Ball(at=(0, 0, 0), radius=0.01), voussoir.Ball(at=(0.012, 0, 0), radius=0.008)],
    ... )
    >>> clump.spheres
    [Ball(at=(0, 0, 0), radius=0.01), Ball(at=(0.012, 0, 0), radius=0.008)]
    """

    _tag: ClassVar[str | None] = "clump"
    spheres: Sequence[Ball]


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Ball(Value):
    """A sphere of a clump.

    Parameters
    ----------
    at : three numbers
        Centre in the block's own frame, m.
    radius : float
        Radius, m.

    Examples
    --------
    >>> import voussoir
    >>> ball = voussoir.Ball(at=(0, 0, 0), radius=0.01)
    >>> ball.at
    (0, 0, 0)
    """

    at: Vector
    radius: float


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Plane(Value):
    """An unbounded plane through the origin, solid behind it: ground or wall. Supports
    only. It is made a slab that reaches three times as far as the other blocks.

    Parameters
    ----------
    normal : three numbers, optional
        Direction out of the ground, of any length; [0, 0, 1] where none is given.

    Examples
    --------
    >>> import voussoir
    >>> plane = voussoir.Plane(normal=(0, 0, 1))
    >>> plane.normal
    (0, 0, 1)
    """

    _tag: ClassVar[str | None] = "plane"
    normal: Vector | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Rotation(Value):
    """Turn by ``angle`` degrees about ``axis`` (right-handed; the axis need not be of unit
    length).

    Parameters
    ----------
    axis : three numbers
        Direction of the axis.
    angle : float
        Angle, degrees.

    Examples
    --------
    >>> import voussoir
    >>> rotation = voussoir.Rotation(axis=(0, 1, 0), angle=30)
    >>> rotation.axis
    (0, 1, 0)
    """

    axis: Vector
    angle: float


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Arch(Value):
    """An arch of voussoirs on two springers, or on buttresses.

    Parameters
    ----------
    prefix : str, optional
        Put before the ids of the blocks.
    at : three numbers, optional
        Where the origin of the template lies, m.
    material : str, optional
        Name of the material of all blocks.
    members : list of Member, optional
        Members that join its blocks, named without the prefix, with points about its origin.
    profile : {"circular", "pointed", "elliptical", "parabolic", "three_centred"}, optional
        Shape of the mid-line.

        * ``circular``: Part of a circle, by ``radius`` and ``embrace_deg``, or by ``span`` and
          ``rise``.
        * ``pointed``: Two arcs that meet at the crown, by ``radius`` and ``eccentricity``, or
          by ``span`` and ``rise``.
        * ``elliptical``: Half an ellipse, by ``span`` and ``rise``.
        * ``parabolic``: A parabola, by ``span`` and ``rise``.
        * ``three_centred``: Three arcs of 60° that run into each other, upright at the
          springings (basket handle, anse de panier), by ``span`` and ``rise``.

    radius : float, optional
        Radius of the mid-line, m (circular and pointed).
    embrace_deg : float, optional
        Angle at the centre between the two springing joints (circular, with ``radius``); 180
        where absent.
    eccentricity : float, optional
        Distance of the two centres from the axis, m (pointed, with ``radius``).
    span : float, optional
        Span of the mid-line: distance between its ends, m (every profile; then ``rise`` too).
        The clear span is smaller: ``intrados_span``.
    rise : float, optional
        Rise of the mid-line: height of its crown above its ends, m (with ``span``).
    intrados_span : float, optional
        Clear span: distance between the ends of the intrados, m, in place of ``span`` (then
        ``intrados_rise`` too).
    intrados_rise : float, optional
        Clear rise: height of the crown of the intrados (of its curve, where it is drawn with
        chords) above its ends, m (with ``intrados_span``).
    joints : {"radial", "vertical"}, optional
        Direction of the joints.

        * ``radial``: Normal to the mid-line (the crown joint of a pointed arch is vertical).
        * ``vertical``: Vertical.

    thickness : float
        Thickness, m, measured as ``thickness_along`` says.
    thickness_along : {"normal", "vertical"}, optional
        How the thickness is measured; ``normal`` with radial joints, ``vertical`` with vertical
        joints where absent.

        * ``normal``: Normal to the mid-line. With vertical joints (circular arches up to 180°):
          a ring between two circles, cut by vertical joints at equal angles of the intrados; the
          springing joints stay radial, the extrados is drawn as 4 chords a voussoir, 8 in the two
          outer ones.
        * ``vertical``: Along z (vertical joints only): intrados and extrados are the mid-line
          moved down and up by half of it.

    depth : float
        Length along y, m.
    voussoirs : int
        Number of voussoirs in the whole arch; even for a pointed arch, whose crown joint is
        vertical.
    buttresses : Buttresses, optional
        Free blocks under the springings in place of the springers.
    springers : bool, optional
        Whether it has springers of its own, yes where absent; without them it stands on what
        else the scene has there.

    Examples
    --------
    >>> import voussoir
    >>> arch = voussoir.Arch(radius=1, thickness=0.2, depth=1, voussoirs=16, material="unit")
    >>> voussoir.Scene().add(arch)
    <voussoir.Scene 0 blocks, 1 template>
    """

    _tag: ClassVar[str | None] = "arch"
    _under: ClassVar[str | None] = "templates"
    prefix: str | None = None
    at: Vector | None = None
    material: str | None = None
    members: Sequence[Member] | None = None
    profile: Literal["circular", "pointed", "elliptical", "parabolic", "three_centred"] | None = None
    radius: float | None = None
    embrace_deg: float | None = None
    eccentricity: float | None = None
    span: float | None = None
    rise: float | None = None
    intrados_span: float | None = None
    intrados_rise: float | None = None
    joints: Literal["radial", "vertical"] | None = None
    thickness: float
    thickness_along: Literal["normal", "vertical"] | None = None
    depth: float
    voussoirs: int
    buttresses: Buttresses | None = None
    springers: bool | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Member(Value):
    """A member: a name and exactly one kind.

    Parameters
    ----------
    id : str
        Unique name.
    tie : Line, optional
        A rod, cable or chain that only pulls.
    strut : Line, optional
        A rod that only pushes.
    bar : Bar, optional
        A rod that pulls and pushes.
    tendon : Tendon, optional
        A cable over deviators: one tension along several points, without friction at them.
    strip : Strip, optional
        A strip bonded to one face of a run of blocks.
    dowel : Dowel, optional
        A dowel or key across a joint: shear at a point.
    soil : Soil, optional
        Soil behind a face: pressure up to the passive one.
    grip : Grip, optional
        A finger that presses on a point with a force of its own choice, up to its strength.
    toothing : Toothing, optional
        The friction of a toothed corner.

    Examples
    --------
    >>> import voussoir
    >>> member = voussoir.Member(
    ...     id="tie",
    ...     tie=voussoir.Line(between=(voussoir.End(block="wall", at=(-0.6, 0, 5.5)), voussoir.End(ground=(-5.6, 0, 5.5))), strength=15000),
    ... )
    >>> scene = voussoir.Scene().add(member)
    >>> member.id
    'tie'
    """

    _under: ClassVar[str | None] = "members"
    id: str
    tie: Line | None = None
    strut: Line | None = None
    bar: Bar | None = None
    tendon: Tendon | None = None
    strip: Strip | None = None
    dowel: Dowel | None = None
    soil: Soil | None = None
    grip: Grip | None = None
    toothing: Toothing | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Line(Value):
    """A tie or a strut.

    Parameters
    ----------
    between : two of End
        Its two ends.
    strength : float or "infinite"
        Greatest force, N, or ``"infinite"``.
    prestress : float, optional
        Force that it was given before the loads, N (tension in a tie, compression in a strut).
    stiffness : float, optional
        Stiffness EA / l, N/m.

    Examples
    --------
    >>> import voussoir
    >>> line = voussoir.Line(
    ...     between=(voussoir.End(block="wall", at=(-0.6, 0, 5.5)), voussoir.End(ground=(-5.6, 0, 5.5))),
    ...     strength=15000,
    ... )
    >>> line.between
    (End(block='wall', at=(-0.6, 0, 5.5)), End(ground=(-5.6, 0, 5.5)))
    """

    between: Sequence[End]
    strength: float | Literal["infinite"]
    prestress: float | None = None
    stiffness: float | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class End(Value):
    """Where a member ends: at a point of a block, or of the ground.

    Parameters
    ----------
    block : str, optional
        The block.
    at : three numbers, optional
        Where on the block, in scene coordinates, m.
    arm : bool, optional
        An arm of no weight carries the force from the block to ``at``, however far off that
        lies.
    ground : three numbers, optional
        A point that does not move, in place of ``block`` and ``at``, m.

    Examples
    --------
    >>> import voussoir
    >>> end = voussoir.End(ground=(-5.6, 0, 5.5))
    >>> end.ground
    (-5.6, 0, 5.5)
    """

    block: str | None = None
    at: Vector | None = None
    arm: bool = False
    ground: Vector | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Bar(Value):
    """A bar.

    Parameters
    ----------
    between : two of End
        Its two ends.
    tension : float or "infinite"
        Greatest tension, N, or ``"infinite"``.
    compression : float or "infinite"
        Greatest compression, N, or ``"infinite"``.
    prestress : float, optional
        Force that it was given before the loads, N; tension > 0.
    stiffness : float, optional
        Stiffness EA / l, N/m.

    Examples
    --------
    >>> import voussoir
    >>> bar = voussoir.Bar(
    ...     between=(voussoir.End(block="pier", at=(0, 0, 3)), voussoir.End(ground=(4, 0, 0))),
    ...     tension=20000,
    ...     compression=5000,
    ... )
    >>> bar.between
    (End(block='pier', at=(0, 0, 3)), End(ground=(4, 0, 0)))
    """

    between: Sequence[End]
    tension: float | Literal["infinite"]
    compression: float | Literal["infinite"]
    prestress: float | None = None
    stiffness: float | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Tendon(Value):
    """A tendon.

    Parameters
    ----------
    through : list of End
        Its ends and, between them, the points where it is deviated, in order.
    strength : float or "infinite"
        Greatest tension, N, or ``"infinite"``.
    prestress : float, optional
        Tension that it was given before the loads, N.
    stiffness : float, optional
        Stiffness EA / l of its whole length, N/m.

    Examples
    --------
    >>> import voussoir
    >>> tendon = voussoir.Tendon(
    ...     through=[voussoir.End(block="pier", at=(0, 0, 3)), voussoir.End(ground=(4, 0, 0))],
    ...     strength=100000,
    ...     prestress=30000,
    ... )
    >>> tendon.through
    [End(block='pier', at=(0, 0, 3)), End(ground=(4, 0, 0))]
    """

    through: Sequence[End]
    strength: float | Literal["infinite"]
    prestress: float | None = None
    stiffness: float | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Strip(Value):
    """A bonded strip: at every joint between neighbours of the run, a tension at the
    joint's edge on that face, normal to the joint.

    Parameters
    ----------
    blocks : list of str
        The blocks that it is bonded to, in order.
    face : {"extrados", "intrados", "+x", "-x", "+y", "-y", "+z", "-z"} or Near or int
        The face that it is bonded to.

        * ``extrados``: The outer face of a voussoir of an ``arch`` or ``barrel`` template.
        * ``intrados``: Its inner face.
        * ``+x``: The face that looks most along +x.
        * ``-x``: The face that looks most along −x.
        * ``+y``: The face that looks most along +y.
        * ``-y``: The face that looks most along −y.
        * ``+z``: The face that looks most along +z.
        * ``-z``: The face that looks most along −z.

    width : float
        Width, m.
    strength : float or "infinite"
        Greatest tension of the fibres per width, N/m, or ``"infinite"``.
    debonding : float, optional
        Tension per width at which it comes off, N/m; not decisive where absent.
    development : float, optional
        Nothing is carried at joints nearer than this to a free end of the strip, m.

    Examples
    --------
    >>> import voussoir
    >>> strip = voussoir.Strip(
    ...     blocks=["v00", "v01", "v02"],
    ...     face="intrados",
    ...     width=0.1,
    ...     strength=40000,
    ... )
    >>> strip.blocks
    ['v00', 'v01', 'v02']
    """

    blocks: Sequence[str]
    face: Literal["extrados", "intrados", "+x", "-x", "+y", "-y", "+z", "-z"] | Near | int
    width: float
    strength: float | Literal["infinite"]
    debonding: float | None = None
    development: float | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Near(Value):
    """The face nearest to a point.

    Parameters
    ----------
    near : three numbers
        The point, m.

    Examples
    --------
    >>> import voussoir
    >>> near = voussoir.Near(near=(0, 0.15, 3))
    >>> near.near
    (0, 0.15, 3)
    """

    near: Vector


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Dowel(Value):
    """A dowel.

    Parameters
    ----------
    blocks : two of str
        The two blocks.
    at : three numbers
        Where it crosses the joint, m.
    normal : three numbers, optional
        Normal of the joint; that of the contact of the two blocks nearest to ``at`` where
        absent.
    strength : float or "infinite"
        Greatest shear force, N, or ``"infinite"``.

    Examples
    --------
    >>> import voussoir
    >>> dowel = voussoir.Dowel(blocks=("v03", "v04"), at=(1, 0, 2), strength=8000)
    >>> dowel.blocks
    ('v03', 'v04')
    """

    blocks: Sequence[str]
    at: Vector
    normal: Vector | None = None
    strength: float | Literal["infinite"]


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Soil(Value):
    """Soil behind a face.

    Parameters
    ----------
    block : str
        The block that it presses on.
    face : {"extrados", "intrados", "+x", "-x", "+y", "-y", "+z", "-z"} or Near or int
        The face that it presses on.

        * ``extrados``: The outer face of a voussoir of an ``arch`` or ``barrel`` template.
        * ``intrados``: Its inner face.
        * ``+x``: The face that looks most along +x.
        * ``-x``: The face that looks most along −x.
        * ``+y``: The face that looks most along +y.
        * ``-y``: The face that looks most along −y.
        * ``+z``: The face that looks most along +z.
        * ``-z``: The face that looks most along −z.

    direction : three numbers
        Direction in which it presses.
    surface : float
        Height z of the soil's surface, m.
    unit_weight : float
        Weight of the soil per volume, N/m³.
    k : float
        Coefficient of passive pressure.

    Examples
    --------
    >>> import voussoir
    >>> soil = voussoir.Soil(
    ...     block="abutment",
    ...     face="left",
    ...     direction=(1, 0, 0),
    ...     surface=3,
    ...     unit_weight=18000,
    ...     k=3,
    ... )
    >>> soil.block
    'abutment'
    """

    block: str
    face: Literal["extrados", "intrados", "+x", "-x", "+y", "-y", "+z", "-z"] | Near | int
    direction: Vector
    surface: float
    unit_weight: float
    k: float


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Grip(Value):
    """A grip: one finger, or several that all press with the same force.

    Parameters
    ----------
    block : str
        The block that is gripped.
    at : three numbers, optional
        Where the finger touches it, m.
    normal : three numbers, optional
        Direction in which the finger presses, into the block.
    fingers : list of Finger, optional
        Several fingers, in place of ``at`` and ``normal``.
    arm : bool, optional
        An arm of no weight carries the force from where a finger touches to the block.
    friction : float
        Coefficient of friction between fingers and block.
    strength : float or "infinite"
        Greatest normal force of each finger, N. The fingers apply it.

    Examples
    --------
    >>> import voussoir
    >>> grip = voussoir.Grip(
    ...     block="cube",
    ...     friction=0.5,
    ...     strength=9.6,
    ...     fingers=[voussoir.Finger(at=(-0.05, 0, 0), normal=(1, 0, 0)), voussoir.Finger(at=(0.05, 0, 0), normal=(-1, 0, 0))],
    ... )
    >>> grip.block
    'cube'
    """

    block: str
    at: Vector | None = None
    normal: Vector | None = None
    fingers: Sequence[Finger] | None = None
    arm: bool = False
    friction: float
    strength: float | Literal["infinite"]


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Finger(Value):
    """One of several fingers.

    Parameters
    ----------
    at : three numbers
        Where it touches the block, m.
    normal : three numbers
        Direction in which it presses, into the block.

    Examples
    --------
    >>> import voussoir
    >>> finger = voussoir.Finger(at=(-0.05, 0, 0), normal=(1, 0, 0))
    >>> finger.at
    (-0.05, 0, 0)
    """

    at: Vector
    normal: Vector


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Toothing(Value):
    """The friction of a toothed corner (Circolare 7/2019, eq. C8.7.1.2): ``F = 0.4 n (n +
    1) Φ μ l² t w`` with ``Φ = block_height / overlap``.

    Parameters
    ----------
    block : str
        The block that is held: the wall.
    courses : int
        Number of toothed courses n.
    block_height : float
        Height of a course, m.
    overlap : float
        Overlap l of the stones, m.
    friction : float
        Coefficient of friction μ between the stones.
    thickness : float
        Thickness t of the wall, m.
    unit_weight : float
        Weight w of the masonry per volume, N/m³.
    height : float
        Height z at which it acts, m.
    direction : three numbers
        Direction in which it pulls the block.

    Examples
    --------
    >>> import voussoir
    >>> toothing = voussoir.Toothing(
    ...     block="wall",
    ...     courses=8,
    ...     block_height=0.2,
    ...     overlap=0.15,
    ...     friction=0.5,
    ...     thickness=0.3,
    ...     unit_weight=18000,
    ...     height=1.6,
    ...     direction=(0, 1, 0),
    ... )
    >>> toothing.block
    'wall'
    """

    block: str
    courses: int
    block_height: float
    overlap: float
    friction: float
    thickness: float
    unit_weight: float
    height: float
    direction: Vector


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Buttresses(Value):
    """Free rectangular blocks ``buttress_left`` and ``buttress_right`` under the
    springings, inner face flush with the intrados, on a support ``ground``.

    Parameters
    ----------
    width : float
        Width along x, m.
    height : float
        Height, m.

    Examples
    --------
    >>> import voussoir
    >>> buttresses = voussoir.Buttresses(width=1.6, height=4)
    >>> buttresses.width
    1.6
    """

    width: float
    height: float


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Barrel(Value):
    """A barrel vault: an arch drawn out along y, laid in running bond.

    Parameters
    ----------
    prefix : str, optional
        Put before the ids of the blocks.
    at : three numbers, optional
        Where the origin of the template lies, m.
    material : str, optional
        Name of the material of all blocks.
    members : list of Member, optional
        Members that join its blocks, named without the prefix, with points about its origin.
    profile : {"circular", "pointed", "elliptical", "parabolic", "three_centred"}, optional
        Shape of the mid-line.

        * ``circular``: Part of a circle, by ``radius`` and ``embrace_deg``, or by ``span`` and
          ``rise``.
        * ``pointed``: Two arcs that meet at the crown, by ``radius`` and ``eccentricity``, or
          by ``span`` and ``rise``.
        * ``elliptical``: Half an ellipse, by ``span`` and ``rise``.
        * ``parabolic``: A parabola, by ``span`` and ``rise``.
        * ``three_centred``: Three arcs of 60° that run into each other, upright at the
          springings (basket handle, anse de panier), by ``span`` and ``rise``.

    radius : float, optional
        Radius of the mid-line, m (circular and pointed).
    embrace_deg : float, optional
        Angle at the centre between the two springing joints (circular, with ``radius``); 180
        where absent.
    eccentricity : float, optional
        Distance of the two centres from the axis, m (pointed, with ``radius``).
    span : float, optional
        Span of the mid-line: distance between its ends, m (every profile; then ``rise`` too).
        The clear span is smaller: ``intrados_span``.
    rise : float, optional
        Rise of the mid-line: height of its crown above its ends, m (with ``span``).
    intrados_span : float, optional
        Clear span: distance between the ends of the intrados, m, in place of ``span`` (then
        ``intrados_rise`` too).
    intrados_rise : float, optional
        Clear rise: height of the crown of the intrados (of its curve, where it is drawn with
        chords) above its ends, m (with ``intrados_span``).
    thickness : float
        Thickness normal to the mid-line, m.
    depth : float
        Length of the vault along y, m.
    voussoirs : int
        Number of strips from springing to springing; even for a pointed vault.
    courses : int
        Number of whole blocks along y.
    springers : bool, optional
        Whether it has springers of its own, yes where absent; without them it stands on what
        else the scene has there.

    Examples
    --------
    >>> import voussoir
    >>> barrel = voussoir.Barrel(
    ...     radius=1,
    ...     thickness=0.15,
    ...     depth=2,
    ...     voussoirs=16,
    ...     courses=3,
    ...     material="stone",
    ... )
    >>> voussoir.Scene().add(barrel)
    <voussoir.Scene 0 blocks, 1 template>
    """

    _tag: ClassVar[str | None] = "barrel"
    _under: ClassVar[str | None] = "templates"
    prefix: str | None = None
    at: Vector | None = None
    material: str | None = None
    members: Sequence[Member] | None = None
    profile: Literal["circular", "pointed", "elliptical", "parabolic", "three_centred"] | None = None
    radius: float | None = None
    embrace_deg: float | None = None
    eccentricity: float | None = None
    span: float | None = None
    rise: float | None = None
    intrados_span: float | None = None
    intrados_rise: float | None = None
    thickness: float
    depth: float
    voussoirs: int
    courses: int
    springers: bool | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Bridge(Value):
    """A masonry arch bridge in its plane, with piers and fill.

    Parameters
    ----------
    prefix : str, optional
        Put before the ids of the blocks.
    at : three numbers, optional
        Where the origin of the template lies, m.
    material : str, optional
        Name of the material of all blocks.
    members : list of Member, optional
        Members that join its blocks, named without the prefix, with points about its origin.
    spans : list of BridgeSpan
        The spans from left to right.
    piers : list of BridgePier, optional
        The piers between them, one fewer.
    width : float
        Width of the bridge along y, m.
    fill : Fill, optional
        What lies on the arches.
    springers : bool, optional
        Whether it has springers of its own, yes where absent; without them it stands on what
        else the scene has there.

    Examples
    --------
    >>> import voussoir
    >>> bridge = voussoir.Bridge(
    ...     spans=[voussoir.BridgeSpan(clear_span=6.55, rise=1.428, thickness=0.22, voussoirs=40)],
    ...     width=3.8,
    ...     material="ring",
    ...     fill=voussoir.Fill(cover=0.165, unit_weight=18000, passive=1.5),
    ... )
    >>> voussoir.Scene().add(bridge)
    <voussoir.Scene 0 blocks, 1 template>
    """

    _tag: ClassVar[str | None] = "bridge"
    _under: ClassVar[str | None] = "templates"
    prefix: str | None = None
    at: Vector | None = None
    material: str | None = None
    members: Sequence[Member] | None = None
    spans: Sequence[BridgeSpan]
    piers: Sequence[BridgePier] | None = None
    width: float
    fill: Fill | None = None
    springers: bool | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class BridgeSpan(Value):
    """A span of a bridge.

    Parameters
    ----------
    profile : {"circular", "pointed", "elliptical", "parabolic", "three_centred"}, optional
        Shape of the intrados.

        * ``circular``: Part of a circle, by ``radius`` and ``embrace_deg``, or by ``span`` and
          ``rise``.
        * ``pointed``: Two arcs that meet at the crown, by ``radius`` and ``eccentricity``, or
          by ``span`` and ``rise``.
        * ``elliptical``: Half an ellipse, by ``span`` and ``rise``.
        * ``parabolic``: A parabola, by ``span`` and ``rise``.
        * ``three_centred``: Three arcs of 60° that run into each other, upright at the
          springings (basket handle, anse de panier), by ``span`` and ``rise``.

    clear_span : float, optional
        Clear span: distance between the ends of the intrados, m. Needed unless ``intrados`` is
        given.
    rise : float, optional
        Clear rise: height of the crown of the intrados above the springings, m. Needed unless
        ``intrados`` is given.
    intrados : array of shape (n, 2), optional
        Points of the intrados as surveyed (x, z in m, from any origin), from the left springing
        to the right one, which lie level, in place of profile, clear span and rise. Joints lie
        at the points where there are as many, one more than voussoirs, else evenly along the
        curve through them.
    thickness : float
        Thickness of all rings together, m; at the crown where they are thicker at the
        springings.
    springing_thickness : float, optional
        Thickness of all rings together at the springings, m, normal to the intrados; between
        crown and springing it changes in proportion to the place along the ring. That of the
        crown where absent.
    rings : int, optional
        Number of rings, with friction between them; 1 where absent.
    voussoirs : int
        Number of voussoirs of a ring.

    Examples
    --------
    >>> import voussoir
    >>> bridgespan = voussoir.BridgeSpan(clear_span=5, rise=1.5, thickness=0.5, voussoirs=21)
    >>> bridgespan.clear_span
    5
    """

    profile: Literal["circular", "pointed", "elliptical", "parabolic", "three_centred"] | None = None
    clear_span: float | None = None
    rise: float | None = None
    intrados: npt.ArrayLike | None = None
    thickness: float
    springing_thickness: float | None = None
    rings: int | None = None
    voussoirs: int


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class BridgePier(Value):
    """A pier: a free block between two spans, its top cut along their springing joints.

    Parameters
    ----------
    width : float
        Distance between the two springings of the intrados, m.
    height : float
        Height from the foot to the springings, m.
    foot : float, optional
        Width at the foot, m; that at the springings where absent.

    Examples
    --------
    >>> import voussoir
    >>> bridgepier = voussoir.BridgePier(width=1.5, height=3)
    >>> bridgepier.width
    1.5
    """

    width: float
    height: float
    foot: float | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Fill(Value):
    """What lies on the arches of a bridge.

    Parameters
    ----------
    cover : float
        Thickness over the crown of the highest extrados, to the surface of the road at that
        crown, m.
    unit_weight : float
        Weight per volume, N/m³.
    gradient : float, optional
        Rise of the road per metre towards +x.
    passive : float, optional
        Passive pressure: at a depth z an arch that moves into the fill meets up to ``passive``
        × unit weight × z. None where neither this nor ``friction_deg`` is given. Active
        pressure is left out.
    friction_deg : float, optional
        Angle of friction of the fill, degrees, in place of ``passive``: half of tan²(45° +
        φ/2), for the whole of it needs more movement than arches make.
    dispersal : float, optional
        How far a load spreads on either side per metre of depth, m; 0.5, 1 horizontally to 2
        vertically, where neither this nor ``dispersal_deg`` is given.
    dispersal_deg : float, optional
        The angle from the vertical at which a load spreads, degrees, in place of ``dispersal``,
        which is its tangent.
    distribution : {"even", "boussinesq"}, optional
        How it is distributed over the length that it spreads to.

        * ``even``: Evenly.
        * ``boussinesq``: As the pressure in an elastic half-space below the patch, cut off
          where the spread ends, and raised in proportion so that nothing of the load is lost.

    backing : Backing, optional
        Heavier and stiffer fill, or masonry, over the springings.
    parapets : float, optional
        Weight of both parapets per metre of the bridge, N/m.
    action : str, optional
        The action that its weight, with backing as fill and parapets, belongs to in
        combinations; ``dead`` where absent.

    Examples
    --------
    >>> import voussoir
    >>> fill = voussoir.Fill(cover=0.165, unit_weight=18000, passive=1.5)
    >>> fill.cover
    0.165
    """

    cover: float
    unit_weight: float
    gradient: float | None = None
    passive: float | None = None
    friction_deg: float | None = None
    dispersal: float | None = None
    dispersal_deg: float | None = None
    distribution: Literal["even", "boussinesq"] | None = None
    backing: Backing | None = None
    parapets: float | None = None
    action: str | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Backing(Value):
    """Backing over the springings: fill of its own, which weighs and resists and carries
    nothing itself; or masonry, which is blocks. Masonry stands in level courses over the
    piers, between the extrados on both sides, named ``backing_1_c00``,
    ``backing_1_c01``, … over ``pier_1`` from below; with ``behind`` also at the ends,
    between extrados and a vertical back, as ``backing_left_c00``, … and
    ``backing_right_c00``, … on supports ``abutment_left`` and ``abutment_right``.

    Parameters
    ----------
    height : float
        Height of its level top above the springings, m; as fill nothing of it counts above the
        road.
    unit_weight : float, optional
        Weight per volume, N/m³, of backing as fill.
    passive : float, optional
        Passive coefficient of the chords whose middle lies below its top, with the unit weight
        of the fill; that of the fill where absent. Of backing as fill.
    masonry : str, optional
        Name of a material: the backing is masonry of it.
    behind : float, optional
        How far masonry reaches behind the outer ends of the first and the last springing, m;
        where absent there is none at the ends.

    Examples
    --------
    >>> import voussoir
    >>> backing = voussoir.Backing(height=1.1, masonry="rubble", behind=0.8)
    >>> backing.height
    1.1
    """

    height: float
    unit_weight: float | None = None
    passive: float | None = None
    masonry: str | None = None
    behind: float | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Column(Value):
    """Blocks on top of each other.

    Parameters
    ----------
    prefix : str, optional
        Put before the ids of the blocks.
    at : three numbers, optional
        Where the origin of the template lies, m.
    material : str, optional
        Name of the material of all blocks.
    members : list of Member, optional
        Members that join its blocks, named without the prefix, with points about its origin.
    blocks : int
        Number of blocks.
    size : three numbers
        Size of one block along x, y, z, m.

    Examples
    --------
    >>> import voussoir
    >>> column = voussoir.Column(blocks=3, size=(1, 1, 0.3), material="stone")
    >>> voussoir.Scene().add(column)
    <voussoir.Scene 0 blocks, 1 template>
    """

    _tag: ClassVar[str | None] = "column"
    _under: ClassVar[str | None] = "templates"
    prefix: str | None = None
    at: Vector | None = None
    material: str | None = None
    members: Sequence[Member] | None = None
    blocks: int
    size: Vector


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Dome(Value):
    """A spherical dome of rings.

    Parameters
    ----------
    prefix : str, optional
        Put before the ids of the blocks.
    at : three numbers, optional
        Where the origin of the template lies, m.
    material : str, optional
        Name of the material of all blocks.
    members : list of Member, optional
        Members that join its blocks, named without the prefix, with points about its origin.
    radius : float
        Radius of the mid-surface at the corners, m.
    thickness : float
        Thickness along the radius at the corners, m.
    rings : int
        Number of rings, the keystone not counted.
    segments : int
        Number of voussoirs in a ring, at least 3.
    springing_deg : float, optional
        Angle between the axis and the lowest bed joint; 90 (a hemisphere) where absent.
    oculus_deg : float, optional
        Angle between the axis and the edge of the oculus; where absent the dome is closed by a
        keystone as wide as a ring is high.
    openings : list of DomeOpening, optional
        Voussoirs that are left out.
    lantern : Lantern, optional
        A drum with a slab upon the edge of the oculus (with ``oculus_deg``).
    springers : bool, optional
        Whether it has springers of its own, yes where absent; without them it stands on what
        else the scene has there.

    Examples
    --------
    >>> import voussoir
    >>> dome = voussoir.Dome(radius=5, thickness=0.5, rings=7, segments=12, material="stone")
    >>> voussoir.Scene().add(dome)
    <voussoir.Scene 0 blocks, 1 template>
    """

    _tag: ClassVar[str | None] = "dome"
    _under: ClassVar[str | None] = "templates"
    prefix: str | None = None
    at: Vector | None = None
    material: str | None = None
    members: Sequence[Member] | None = None
    radius: float
    thickness: float
    rings: int
    segments: int
    springing_deg: float | None = None
    oculus_deg: float | None = None
    openings: Sequence[DomeOpening] | None = None
    lantern: Lantern | None = None
    springers: bool | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class DomeOpening(Value):
    """An opening in a dome: some segments of some rings.

    Parameters
    ----------
    rings : two of int
        The first and the last ring, from 0 at the springing.
    segments : two of int
        The first and the last segment, from 0; the first may be the greater, where the opening
        passes the meridian of segment 0.

    Examples
    --------
    >>> import voussoir
    >>> domeopening = voussoir.DomeOpening(rings=(1, 2), segments=(0, 1))
    >>> domeopening.rings
    (1, 2)
    """

    rings: Sequence[int]
    segments: Sequence[int]


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Lantern(Value):
    """A lantern: an upright drum of blocks ``lantern_00``, …, on the upper bed of the last
    ring, one a segment, and a slab ``lantern_cap`` upon them.

    Parameters
    ----------
    height : float
        Height of the drum above the highest corner of the dome, m.
    cap : float
        Thickness of the slab, m.

    Examples
    --------
    >>> import voussoir
    >>> lantern = voussoir.Lantern(height=1.5, cap=0.3)
    >>> lantern.height
    1.5
    """

    height: float
    cap: float


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class FlatArch(Value):
    """A flat arch (platbande) between two abutments.

    Parameters
    ----------
    prefix : str, optional
        Put before the ids of the blocks.
    at : three numbers, optional
        Where the origin of the template lies, m.
    material : str, optional
        Name of the material of all blocks.
    members : list of Member, optional
        Members that join its blocks, named without the prefix, with points about its origin.
    span : float
        Distance between the abutments at mid-height, m.
    height : float
        Height, m.
    depth : float
        Length along y, m.
    voussoirs : int
        Number of voussoirs, equally wide at mid-height.
    center_depth : float, optional
        Depth below mid-height of the point through which all joints pass, m; more than half the
        height. Vertical joints where absent.

    Examples
    --------
    >>> import voussoir
    >>> flatarch = voussoir.FlatArch(span=3, height=1, depth=1, voussoirs=3, material="stone")
    >>> voussoir.Scene().add(flatarch)
    <voussoir.Scene 0 blocks, 1 template>
    """

    _tag: ClassVar[str | None] = "flat_arch"
    _under: ClassVar[str | None] = "templates"
    prefix: str | None = None
    at: Vector | None = None
    material: str | None = None
    members: Sequence[Member] | None = None
    span: float
    height: float
    depth: float
    voussoirs: int
    center_depth: float | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Groin(Value):
    """A groin (cross) vault over a square bay.

    Parameters
    ----------
    prefix : str, optional
        Put before the ids of the blocks.
    at : three numbers, optional
        Where the origin of the template lies, m.
    material : str, optional
        Name of the material of all blocks.
    members : list of Member, optional
        Members that join its blocks, named without the prefix, with points about its origin.
    profile : {"circular", "pointed", "elliptical", "parabolic", "three_centred"}, optional
        Shape of the intrados of both barrels; its springing joints must be level.

        * ``circular``: Part of a circle, by ``radius`` and ``embrace_deg``, or by ``span`` and
          ``rise``.
        * ``pointed``: Two arcs that meet at the crown, by ``radius`` and ``eccentricity``, or
          by ``span`` and ``rise``.
        * ``elliptical``: Half an ellipse, by ``span`` and ``rise``.
        * ``parabolic``: A parabola, by ``span`` and ``rise``.
        * ``three_centred``: Three arcs of 60° that run into each other, upright at the
          springings (basket handle, anse de panier), by ``span`` and ``rise``.

    clear_span : float
        Clear span of both barrels, m.
    rise : float
        Rise of their intrados, m.
    thickness : float
        Thickness normal to the intrados, m.
    side : float
        Side of the bay, m; at least the clear span and twice the thickness.
    voussoirs : int
        Number of strips of a web from springing to springing, even.
    springers : bool, optional
        Whether it has springers of its own, yes where absent; without them it stands on what
        else the scene has there.

    Examples
    --------
    >>> import voussoir
    >>> groin = voussoir.Groin(
    ...     clear_span=4,
    ...     rise=2,
    ...     thickness=0.4,
    ...     side=5,
    ...     voussoirs=16,
    ...     material="stone",
    ... )
    >>> voussoir.Scene().add(groin)
    <voussoir.Scene 0 blocks, 1 template>
    """

    _tag: ClassVar[str | None] = "groin"
    _under: ClassVar[str | None] = "templates"
    prefix: str | None = None
    at: Vector | None = None
    material: str | None = None
    members: Sequence[Member] | None = None
    profile: Literal["circular", "pointed", "elliptical", "parabolic", "three_centred"] | None = None
    clear_span: float
    rise: float
    thickness: float
    side: float
    voussoirs: int
    springers: bool | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Lattice(Value):
    """A pile of equal spheres on a lattice.

    Parameters
    ----------
    prefix : str, optional
        Put before the ids of the blocks.
    at : three numbers, optional
        Where the origin of the template lies, m.
    material : str, optional
        Name of the material of all blocks.
    members : list of Member, optional
        Members that join its blocks, named without the prefix, with points about its origin.
    packing : {"fcc", "square", "triangular", "bed"}, optional
        How the spheres lie.

        * ``fcc``: A tetrahedral pile of close-packed triangular layers (face-centred cubic);
          two edges of the bed point along x and 60° from it.
        * ``square``: A pyramid of square layers, each in the pockets of the one below (the same
          lattice, seen along a cube's side).
        * ``triangular``: A triangular pile of discs: one row above the other in the x–z plane.
        * ``bed``: One square layer of spheres in the pockets of the bed and nothing above,
          whatever ``layers``.

    radius : float
        Radius of every sphere, m.
    layers : int
        Free layers above the bed.
    side : int, optional
        Spheres along a side of the bed; by default one more than there are layers, so that a
        pile ends in one sphere.

    Examples
    --------
    >>> import voussoir
    >>> lattice = voussoir.Lattice(packing="square", radius=0.05, layers=3, material="glass")
    >>> voussoir.Scene().add(lattice)
    <voussoir.Scene 0 blocks, 1 template>
    """

    _tag: ClassVar[str | None] = "lattice"
    _under: ClassVar[str | None] = "templates"
    prefix: str | None = None
    at: Vector | None = None
    material: str | None = None
    members: Sequence[Member] | None = None
    packing: Literal["fcc", "square", "triangular", "bed"] | None = None
    radius: float
    layers: int
    side: int | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Leaves(Value):
    """A wall of two leaves, tied by through stones.

    Parameters
    ----------
    prefix : str, optional
        Put before the ids of the blocks.
    at : three numbers, optional
        Where the origin of the template lies, m.
    material : str, optional
        Name of the material of all blocks.
    members : list of Member, optional
        Members that join its blocks, named without the prefix, with points about its origin.
    size : three numbers
        Size of a whole block along x, y, z, m.
    hollow : float
        Width of the hollow between the leaves, m.
    courses : int
        Number of courses.
    blocks : int
        Number of whole blocks in a course.
    through_every : int, optional
        Every so many courses, counted from the ground, one is of through stones; without it
        there are none.
    base : bool, optional
        Whether it has a support of its own, yes where absent; without it stands on what else
        the scene has there.

    Examples
    --------
    >>> import voussoir
    >>> leaves = voussoir.Leaves(
    ...     size=(0.6, 0.25, 0.3),
    ...     hollow=0.2,
    ...     courses=6,
    ...     blocks=4,
    ...     through_every=3,
    ...     material="stone",
    ... )
    >>> voussoir.Scene().add(leaves)
    <voussoir.Scene 0 blocks, 1 template>
    """

    _tag: ClassVar[str | None] = "leaves"
    _under: ClassVar[str | None] = "templates"
    prefix: str | None = None
    at: Vector | None = None
    material: str | None = None
    members: Sequence[Member] | None = None
    size: Vector
    hollow: float
    courses: int
    blocks: int
    through_every: int | None = None
    base: bool | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Portal(Value):
    """An arch on two piers; with buttresses the section of a nave.

    Parameters
    ----------
    prefix : str, optional
        Put before the ids of the blocks.
    at : three numbers, optional
        Where the origin of the template lies, m.
    material : str, optional
        Name of the material of all blocks.
    members : list of Member, optional
        Members that join its blocks, named without the prefix, with points about its origin.
    profile : {"circular", "pointed", "elliptical", "parabolic", "three_centred"}, optional
        Shape of the intrados; its springing joints must be level.

        * ``circular``: Part of a circle, by ``radius`` and ``embrace_deg``, or by ``span`` and
          ``rise``.
        * ``pointed``: Two arcs that meet at the crown, by ``radius`` and ``eccentricity``, or
          by ``span`` and ``rise``.
        * ``elliptical``: Half an ellipse, by ``span`` and ``rise``.
        * ``parabolic``: A parabola, by ``span`` and ``rise``.
        * ``three_centred``: Three arcs of 60° that run into each other, upright at the
          springings (basket handle, anse de panier), by ``span`` and ``rise``.

    clear_span : float
        Clear span, m.
    rise : float
        Rise of the intrados, m.
    thickness : float
        Thickness of the arch normal to the intrados, m.
    depth : float
        Length along y, m.
    voussoirs : int
        Number of voussoirs.
    pier : Pier
        The piers, or walls, below the springings.
    buttress : Pier, optional
        Stands against the outer face of each pier: blocks ``buttress_left_00``, …, with no more
        than contact and friction between them.
    base : bool, optional
        Whether it has a support of its own, yes where absent; without it stands on what else
        the scene has there.

    Examples
    --------
    >>> import voussoir
    >>> portal = voussoir.Portal(
    ...     clear_span=3,
    ...     rise=1.5,
    ...     thickness=0.4,
    ...     depth=1,
    ...     voussoirs=15,
    ...     pier=voussoir.Pier(width=1.2, height=3, courses=6),
    ...     material="stone",
    ... )
    >>> voussoir.Scene().add(portal)
    <voussoir.Scene 0 blocks, 1 template>
    """

    _tag: ClassVar[str | None] = "portal"
    _under: ClassVar[str | None] = "templates"
    prefix: str | None = None
    at: Vector | None = None
    material: str | None = None
    members: Sequence[Member] | None = None
    profile: Literal["circular", "pointed", "elliptical", "parabolic", "three_centred"] | None = None
    clear_span: float
    rise: float
    thickness: float
    depth: float
    voussoirs: int
    pier: Pier
    buttress: Pier | None = None
    base: bool | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Pier(Value):
    """A pier: equal boxes upon each other.

    Parameters
    ----------
    width : float
        Width along x, m.
    height : float
        Height, m.
    courses : int, optional
        Number of blocks; 1 where absent.

    Examples
    --------
    >>> import voussoir
    >>> pier = voussoir.Pier(width=0.5, height=3, courses=6)
    >>> pier.width
    0.5
    """

    width: float
    height: float
    courses: int | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Stack(Value):
    """Blocks on top of each other, each shifted against the one below.

    Parameters
    ----------
    prefix : str, optional
        Put before the ids of the blocks.
    at : three numbers, optional
        Where the origin of the template lies, m.
    material : str, optional
        Name of the material of all blocks.
    members : list of Member, optional
        Members that join its blocks, named without the prefix, with points about its origin.
    blocks : int
        Number of blocks.
    size : three numbers
        Size of one block along x, y, z, m.
    shift : float, optional
        Shift of each block against the one below, m. The lowest block reaches from x = 0 to its
        length. A stack of n leans until n × shift exceeds the length of a block.
    harmonic : float, optional
        Overhang over the edge of a table (x ≤ 0) as a multiple of the harmonic one: block k,
        counted from the top, has its right end at harmonic × length × Σ 1/(2j), j = k … blocks.
        At 1 every joint is critical.

    Examples
    --------
    >>> import voussoir
    >>> stack = voussoir.Stack(blocks=10, size=(1, 1, 0.2), shift=0.1000001, material="stone")
    >>> voussoir.Scene().add(stack)
    <voussoir.Scene 0 blocks, 1 template>
    """

    _tag: ClassVar[str | None] = "stack"
    _under: ClassVar[str | None] = "templates"
    prefix: str | None = None
    at: Vector | None = None
    material: str | None = None
    members: Sequence[Member] | None = None
    blocks: int
    size: Vector
    shift: float | None = None
    harmonic: float | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Tower(Value):
    """A hollow tower with bonded corners.

    Parameters
    ----------
    prefix : str, optional
        Put before the ids of the blocks.
    at : three numbers, optional
        Where the origin of the template lies, m.
    material : str, optional
        Name of the material of all blocks.
    members : list of Member, optional
        Members that join its blocks, named without the prefix, with points about its origin.
    size : two numbers
        Outer size along x and y, m.
    thickness : float
        Thickness of the walls, m.
    course : float
        Height of a course, m.
    courses : int
        Number of courses.
    blocks : int, optional
        Number of blocks of a wall in a course; 1 where absent.
    base : bool, optional
        Whether it has a support of its own, yes where absent; without it stands on what else
        the scene has there.

    Examples
    --------
    >>> import voussoir
    >>> tower = voussoir.Tower(
    ...     size=(3, 2),
    ...     thickness=0.5,
    ...     course=0.5,
    ...     courses=6,
    ...     material="stone",
    ... )
    >>> voussoir.Scene().add(tower)
    <voussoir.Scene 0 blocks, 1 template>
    """

    _tag: ClassVar[str | None] = "tower"
    _under: ClassVar[str | None] = "templates"
    prefix: str | None = None
    at: Vector | None = None
    material: str | None = None
    members: Sequence[Member] | None = None
    size: Vector
    thickness: float
    course: float
    courses: int
    blocks: int | None = None
    base: bool | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Wall(Value):
    """A wall of one leaf in running bond.

    Parameters
    ----------
    prefix : str, optional
        Put before the ids of the blocks.
    at : three numbers, optional
        Where the origin of the template lies, m.
    material : str, optional
        Name of the material of all blocks.
    members : list of Member, optional
        Members that join its blocks, named without the prefix, with points about its origin.
    size : three numbers
        Size of a whole block along x, y, z, m.
    courses : int
        Number of free courses.
    blocks : int
        Length of the foot in whole blocks.
    first : {"whole", "half"}, optional
        How the lowest free course ends.

        * ``whole``: With a whole block.
        * ``half``: With half a block.

    base : {"slab", "course", "none"}, optional
        What the wall stands on.

        * ``slab``: One support ``base`` under the whole foot, as high as a course.
        * ``course``: A course of supports ``base_<block>`` that continues the bond downwards.
        * ``none``: Nothing: the scene provides it.

    rake_left : float, optional
        How far the left end moves in from one course to the next, in blocks (0.5: half a
        block).
    rake_right : float, optional
        How far the right end moves in from one course to the next, in blocks.
    openings : list of Opening, optional
        Rectangular openings. Nothing is added above them: a wide opening needs the bond, or the
        reader, to carry what is over it.

    Examples
    --------
    >>> import voussoir
    >>> wall = voussoir.Wall(
    ...     size=(1, 1, 0.5),
    ...     courses=8,
    ...     blocks=3,
    ...     first="half",
    ...     material="brick",
    ... )
    >>> voussoir.Scene().add(wall)
    <voussoir.Scene 0 blocks, 1 template>
    """

    _tag: ClassVar[str | None] = "wall"
    _under: ClassVar[str | None] = "templates"
    prefix: str | None = None
    at: Vector | None = None
    material: str | None = None
    members: Sequence[Member] | None = None
    size: Vector
    courses: int
    blocks: int
    first: Literal["whole", "half"] | None = None
    base: Literal["slab", "course", "none"] | None = None
    rake_left: float | None = None
    rake_right: float | None = None
    openings: Sequence[Opening] | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Opening(Value):
    """A rectangular opening: what lies in it is left out.

    Parameters
    ----------
    x : float
        Left edge, m from the left end of the foot.
    z : float
        Sill, m above the foot; a multiple of the course height.
    width : float
        Width, m.
    height : float
        Height, m; a multiple of the course height.

    Examples
    --------
    >>> import voussoir
    >>> opening = voussoir.Opening(x=6, z=5.25, width=4, height=8.75)
    >>> opening.x
    6
    """

    x: float
    z: float
    width: float
    height: float


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Interface(Value):
    """A contact given by hand, for joints that were discretised elsewhere. Detection skips
    the pair. Without points: the normal across which edges or corners of the pair meet
    where several are possible.

    Parameters
    ----------
    between : two of str
        The ids of the two blocks.
    points : array of shape (n, 3), optional
        Corners of the contact, m, in scene coordinates: a convex polygon, an edge (two points)
        or one point. None where only the normal of a touch is given that is found.
    normal : three numbers, optional
        Normal from the first block into the second; may be left out where three or more points
        span a plane, and is then turned so that it points from the first block's centre to the
        second's. Where a plane is spanned and a normal given, the plane gives the direction and
        the normal the side.
    friction : float or "infinite", optional
        Friction of this interface; overrides the joint rules.

    Examples
    --------
    >>> import voussoir
    >>> interface = voussoir.Interface(
    ...     between=("floor", "left"),
    ...     points=[(-1, 0, 0)],
    ...     normal=(0, 0, 1),
    ... )
    >>> scene = voussoir.Scene().add(interface)
    >>> interface.between
    ('floor', 'left')
    """

    _under: ClassVar[str | None] = "interfaces"
    between: Sequence[str]
    points: npt.ArrayLike | None = None
    normal: Vector | None = None
    friction: float | Literal["infinite"] | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class ContactTolerances(Value):
    """Contact tolerances, relative to the size (bounding-box diagonal) of the smaller block
    of a pair; a gap beside a support to that of the free block, for a support is as
    large as it was drawn.

    Parameters
    ----------
    gap : float, optional
        Faces closer than this × size touch; 1 to 100 times it is reported as a near miss.
        Default 0.0001.
    angle_deg : float, optional
        Faces touch only if their normals are opposite within this angle, degrees; faces that
        are not plane may lean by their twist besides. Default 1.
    min_area : float, optional
        Contacts smaller than this × size² are ignored and counted. Default 1e-09.

    Examples
    --------
    >>> import voussoir
    >>> contacttolerances = voussoir.ContactTolerances(gap=0.001, angle_deg=2)
    >>> scene = voussoir.Scene().add(contacttolerances)
    >>> contacttolerances.gap
    0.001
    """

    _under: ClassVar[str | None] = "contact"
    gap: float | None = None
    angle_deg: float | None = None
    min_area: float | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Site(Value):
    """The site.

    Parameters
    ----------
    slv : Spectrum
        Spectrum of the limit state of safeguarding life (SLV).
    slc : Spectrum, optional
        Spectrum of the limit state of preventing collapse (SLC).
    q : float, optional
        Behaviour factor of the linear check; 2 where nothing is said.
    damping_percent : float, optional
        Damping of the mechanism, in percent of the critical one; 5 where nothing is said.
    building : Building, optional
        The building, where the mechanism stands above the ground.

    Examples
    --------
    >>> import voussoir
    >>> site = voussoir.Site(
    ...     slv=voussoir.Spectrum(a_g=1.6, f_0=2.4, s=1.2, t_c_star=0.3, c_c=1.37),
    ...     slc=voussoir.Spectrum(a_g=2.1, f_0=2.45, s=1.17, t_c_star=0.32, c_c=1.36),
    ... )
    >>> scene = voussoir.Scene().add(site)
    >>> site.slv
    Spectrum(a_g=1.6, f_0=2.4, s=1.2, t_c_star=0.3, c_c=1.37)
    """

    _under: ClassVar[str | None] = "site"
    slv: Spectrum
    slc: Spectrum | None = None
    q: float | None = None
    damping_percent: float | None = None
    building: Building | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Spectrum(Value):
    """An elastic spectrum of horizontal acceleration (NTC 2018, 3.2.3.2.1). The period at
    which its branch of constant velocity begins is given as ``t_c``, or by ``t_c_star``
    and ``c_c``.

    Parameters
    ----------
    a_g : float
        Peak acceleration on rock, a_g, m/s².
    f_0 : float
        Greatest amplification, F0.
    s : float
        Soil and topography, S = S_S S_T.
    t_c_star : float, optional
        T_C*, s: on rock.
    c_c : float, optional
        C_C, by which the soil lengthens T_C*.
    t_c : float, optional
        T_C, s.
    t_b : float, optional
        T_B, s; T_C / 3 where nothing is said.
    t_d : float, optional
        T_D, s; 4 a_g / g + 1.6 where nothing is said.

    Examples
    --------
    >>> import voussoir
    >>> spectrum = voussoir.Spectrum(a_g=1.6, f_0=2.4, s=1.2, t_c_star=0.3, c_c=1.37)
    >>> spectrum.a_g
    1.6
    """

    a_g: float
    f_0: float
    s: float
    t_c_star: float | None = None
    c_c: float | None = None
    t_c: float | None = None
    t_b: float | None = None
    t_d: float | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Building(Value):
    """The building in which a mechanism stands above the ground.

    Parameters
    ----------
    t_1 : float
        Period of its first mode, s.
    storeys : int
        Number of storeys.
    height : float
        Height of the building above its foundation, m.
    z : float
        Height of the mechanism's base above the foundation, m.
    damping_percent : float, optional
        Damping of the building, in percent of the critical one; 5 where nothing is said.
    amplification : float, optional
        By how much a floor amplifies at its own period, before the damping of the mechanism
        counts: what the Circolare writes as 1.1 ξ^−0.5. It is not computed, for the unit of ξ
        in it is not beyond doubt; without it the floor spectrum is known at period 0 alone.

    Examples
    --------
    >>> import voussoir
    >>> building = voussoir.Building(t_1=0.4, storeys=3, height=10.5, z=7)
    >>> building.t_1
    0.4
    """

    t_1: float
    storeys: int
    height: float
    z: float
    damping_percent: float | None = None
    amplification: float | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Stage(Value):
    """What one stage changes. Names are ids of blocks, members and loads; ``*`` stands for
    any letters, so that ``"r2_*"`` is a ring.

    Parameters
    ----------
    name : str, optional
        A name for people; its number where nothing is said.
    add : list of str, optional
        Blocks, members and loads that come.
    remove : list of str, optional
        Blocks, members and loads that go; members and loads on a block go with it.
    hold : list of str, optional
        Free blocks that are held in place from now on, as by a crane or a prop.
    release : list of str, optional
        Blocks that a stage held and that are left to themselves.
    add_one_by_one : list of str, optional
        In place of ``add``: a stage for each of these blocks, in the order of the scene, which
        adds that block.
    remove_one_by_one : list of str, optional
        In place of ``remove``: a stage for each of these blocks, in the order of the scene,
        which removes that block.

    Examples
    --------
    >>> import voussoir
    >>> stage = voussoir.Stage(add_one_by_one=["v*"])
    >>> scene = voussoir.Scene().add(stage)
    >>> stage.add_one_by_one
    ['v*']
    """

    _under: ClassVar[str | None] = "stages"
    name: str | None = None
    add: Sequence[str] | None = None
    remove: Sequence[str] | None = None
    hold: Sequence[str] | None = None
    release: Sequence[str] | None = None
    add_one_by_one: Sequence[str] | None = None
    remove_one_by_one: Sequence[str] | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Train(Value):
    """Axles at fixed distances that drive over the road of a ``bridge`` template along x.
    ``limit --moving`` alone asks for it: the forces of the axles, where they stand, are
    its live load.

    Parameters
    ----------
    axles : list of Axle
        The axles; at least one.
    path : two numbers
        Where the train's own origin goes: x in the scene at the start and at the end of the
        way, m. Both directions of travel take this way; for all axles of both to pass the whole
        bridge it begins a train's length before it and ends one behind it.
    step : float
        Distance between two positions on the way, m; the last step may be shorter.
    action : str, optional
        The action that it belongs to in combinations; ``live`` where absent.

    Examples
    --------
    >>> import voussoir
    >>> train = voussoir.Train(
    ...     axles=[voussoir.Axle(at=0, force=1000)],
    ...     path=(-3.2, 3.2),
    ...     step=0.1,
    ... )
    >>> scene = voussoir.Scene().add(train)
    >>> train.axles
    [Axle(at=0, force=1000)]
    """

    _under: ClassVar[str | None] = "train"
    axles: Sequence[Axle]
    path: Vector
    step: float
    action: str | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Axle(Value):
    """An axle of a train.

    Parameters
    ----------
    at : float
        Where it stands in the train that travels towards +x, from the train's origin, m.
        Towards −x the train is turned round, so that it stands as far on the other side.
    force : float or three numbers
        How hard it presses.
    patch : float, optional
        Length of its patch on the road, m; 0.3 where absent. Default 0.3.
    across : float, optional
        Width of its patch across the bridge, m, as of a load on the road.

    Examples
    --------
    >>> import voussoir
    >>> axle = voussoir.Axle(at=0, force=1000)
    >>> axle.at
    0
    """

    at: float
    force: float | Vector
    patch: float | None = None
    across: float | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Combination(Value):
    """A combination of actions. Every action of the scene has a factor in it, by
    ``factors`` or by the preset, or stands in ``without``.

    Parameters
    ----------
    name : str
        Its name.
    source : str, optional
        Where its factors come from; that of the preset where nothing is said.
    preset : str, optional
        Factors of a code: a word of ``voussoir schema presets``. Actions of weights, dead loads
        and fill are permanent, all others variable.
    superimposed : list of str, optional
        With a preset: permanent actions that are superimposed, where the code tells them from
        others.
    favourable : list of str, optional
        With a preset: permanent actions that act favourably.
    psi : dict of names to float, optional
        With a preset: ψ by which accompanying variable actions are multiplied beside their
        factor, by action; an action named here is variable. Variable actions without a ψ lead.
    factors : dict of names to float, optional
        Partial factors on loads, by action.
    without : list of str, optional
        Actions that do not act.
    materials : MaterialFactors, optional
        Partial factors that strengths are divided by.

    Examples
    --------
    >>> import voussoir
    >>> combination = voussoir.Combination(name="STR", preset="en1990_road_str")
    >>> scene = voussoir.Scene().add(combination)
    >>> combination.name
    'STR'
    """

    _under: ClassVar[str | None] = "combinations"
    name: str
    source: str | None = None
    preset: str | None = None
    superimposed: Sequence[str] | None = None
    favourable: Sequence[str] | None = None
    psi: dict[str, float] | None = None
    factors: dict[str, float] | None = None
    without: Sequence[str] | None = None
    materials: MaterialFactors | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class MaterialFactors(Value):
    """Partial factors that strengths are divided by; 1 where nothing is said.

    Parameters
    ----------
    friction : float, optional
        On the coefficient of friction (tan φ).
    cohesion : float, optional
        On the cohesion.
    tension : float, optional
        On the tensile strength.
    compression : float, optional
        On the compressive strength.
    members : float, optional
        On the strengths of members: ties, struts, strips, soil, …

    Examples
    --------
    >>> import voussoir
    >>> materialfactors = voussoir.MaterialFactors(members=1.25)
    >>> materialfactors.members
    1.25
    """

    friction: float | None = None
    cohesion: float | None = None
    tension: float | None = None
    compression: float | None = None
    members: float | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Requirements(Value):
    """The least values that are enough. A question that is asked with a requirement of its
    own keeps it.

    Parameters
    ----------
    load_factor : float, optional
        Load factor λ of the live load or the train.
    tilt_deg : float, optional
        Tilt, degrees.
    alpha_0 : float, optional
        Load factor α0 of an earthquake.
    geometric_factor : float, optional
        Geometric safety factor of an arch or wall.
    site : float, optional
        Share of the earthquake of the site, ζ_E: what the mechanism has over what is demanded.

    Examples
    --------
    >>> import voussoir
    >>> requirements = voussoir.Requirements(load_factor=1)
    >>> scene = voussoir.Scene().add(requirements)
    >>> requirements.load_factor
    1
    """

    _under: ClassVar[str | None] = "require"
    load_factor: float | None = None
    tilt_deg: float | None = None
    alpha_0: float | None = None
    geometric_factor: float | None = None
    site: float | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Material(Value):
    """What blocks are made of.

    Parameters
    ----------
    density : float
        Density, kg/m³.
    young : float, optional
        Young's modulus, Pa, of what touches at points: spheres by Hertz. ``state`` alone asks
        for it; rigid where it is left out.
    poisson : float, optional
        Poisson's ratio, above −1 and at most 0.5; given with ``young``.
    action : str, optional
        The action that the weight of its blocks belongs to in combinations; ``dead`` where
        absent.

    Examples
    --------
    >>> import voussoir
    >>> material = voussoir.Material(density=1)
    >>> material.density
    1
    """

    density: float
    young: float | None = None
    poisson: float | None = None
    action: str | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Joint(Value):
    """An exception: the joints between two materials, or between two blocks. What it leaves
    out is as in the default.

    Parameters
    ----------
    between : two of str, optional
        Two material names, in either order.
    blocks : two of str, optional
        Two block ids, in either order.
    friction : float or "infinite", optional
        Coefficient of friction μ ≥ 0, or ``"infinite"`` (no sliding).
    friction_angle_deg : float, optional
        Friction angle in degrees, in place of ``friction``.
    cohesion : float, optional
        Cohesion, Pa: shear resistance without any pressure.
    tension : float, optional
        Tensile strength, Pa. Beyond cohesion / friction it has no effect.
    compression : float, optional
        Compressive strength, Pa.
    pore_pressure : float, optional
        Pressure of the water in the joint, Pa.
    rolling_arm : float, optional
        Rolling arm, m, of contacts at points and edges.
    normal_stiffness : float, optional
        Pressure by which the joint closes one metre, Pa/m.
    shear_stiffness : float, optional
        Shear stress by which its sides move one metre along it before it slides, Pa/m.

    Examples
    --------
    >>> import voussoir
    >>> joint = voussoir.Joint(blocks=("b01", "b02"), friction=0.4)
    >>> scene = voussoir.Scene().add(joint)
    >>> joint.blocks
    ('b01', 'b02')
    """

    _under: ClassVar[str | None] = "overrides"
    between: Sequence[str] | None = None
    blocks: Sequence[str] | None = None
    friction: float | Literal["infinite"] | None = None
    friction_angle_deg: float | None = None
    cohesion: float | None = None
    tension: float | None = None
    compression: float | None = None
    pore_pressure: float | None = None
    rolling_arm: float | None = None
    normal_stiffness: float | None = None
    shear_stiffness: float | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Load(Value):
    """One load: a ``force`` and/or ``moment`` on a ``block``, or an ``acceleration`` or
    ``weight`` on one block or all free blocks.

    Parameters
    ----------
    id : str, optional
        A name by which stages add and remove it.
    action : str, optional
        The action that it belongs to in combinations; ``dead`` or ``live``, as its list, where
        absent.
    block : str, optional
        The loaded block; every free block where absent (``acceleration`` and ``weight`` only).
    force : three numbers, optional
        Force, N.
    moment : three numbers, optional
        Moment, N·m.
    at : three numbers or {"centroid"}, optional
        Where the force acts: a point of the scene, m, or ``"centroid"`` (the default).

        * ``centroid``: The block's centre of mass.

    road : OnRoad, optional
        Where on the road of a ``bridge`` template the force presses, in place of ``block`` and
        ``at``: the fill spreads it.
    arm : bool, optional
        An arm of no weight carries the force from the block to ``at``, however far off that
        lies. Without it such a force is taken for a mistake.
    massless : bool, optional
        Of a dead load along gravity: no mass stands behind it (the thrust of a vault, the pull
        of a cable), so that an earthquake does not push it. ``kinematic`` takes other loads
        along gravity for weights.
    acceleration : three numbers, optional
        Body force: mass × this acceleration, m/s².
    weight : three numbers, optional
        Body force as multiples of the block's own weight.

    Examples
    --------
    >>> import voussoir
    >>> load = voussoir.Load(weight=(1, 0, 0))
    >>> load.weight
    (1, 0, 0)
    """

    id: str | None = None
    action: str | None = None
    block: str | None = None
    force: Vector | None = None
    moment: Vector | None = None
    at: Vector | Literal["centroid"] | None = None
    road: OnRoad | None = None
    arm: bool = False
    massless: bool = False
    acceleration: Vector | None = None
    weight: Vector | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class OnRoad(Value):
    """A stretch of the road of a bridge.

    Parameters
    ----------
    x : float
        Where its middle lies, x in the scene, m.
    patch : float, optional
        Its length, m; 0.3 where absent. Default 0.3.
    across : float, optional
        Its width across the bridge, m. The width that carries it is this with the spread to
        either side, at most that of the bridge; all of the bridge where absent.

    Examples
    --------
    >>> import voussoir
    >>> onroad = voussoir.OnRoad(x=-4)
    >>> onroad.x
    -4
    """

    x: float
    patch: float | None = None
    across: float | None = None


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class PushingMass(Value):
    """A mass that an earthquake pushes against a block, and that rests elsewhere.

    Parameters
    ----------
    block : str
        The block that it pushes.
    at : three numbers
        Where: a point of the scene, m.
    mass : float
        Mass, kg.

    Examples
    --------
    >>> import voussoir
    >>> pushingmass = voussoir.PushingMass(block="wall", at=(0, 0.1, 3), mass=1200)
    >>> scene = voussoir.Scene().add(pushingmass)
    >>> pushingmass.block
    'wall'
    """

    _under: ClassVar[str | None] = "masses"
    block: str
    at: Vector
    mass: float


class SceneMethods:
    """What is added to a scene by the keys of its file."""

    if TYPE_CHECKING:

        def add(self, *things: Value) -> Self: ...
        def _joint(self, rule: Joint) -> Self: ...
        def _load(self, kind: str, load: Load) -> Self: ...
        def _material(self, name: str, values: Material) -> Self: ...

    def box(
        self,
        id: str,
        size: Vector,
        at: Vector | None = None,
        *,
        rotation_deg: Rotation | None = None,
        support: bool = False,
        material: str | None = None,
        density: float | None = None,
        mass: float | None = None,
        centroid: Vector | None = None,
    ) -> Self:
        """Add :meth:`Block.box`: a box centred on the origin."""
        return self.add(Block.box(
            id=id, size=size, at=at, rotation_deg=rotation_deg, support=support,
            material=material, density=density, mass=mass, centroid=centroid,
        ))

    def polyhedron(
        self,
        id: str,
        vertices: npt.ArrayLike,
        faces: Sequence[Sequence[int]],
        at: Vector | None = None,
        *,
        rotation_deg: Rotation | None = None,
        support: bool = False,
        material: str | None = None,
        density: float | None = None,
        mass: float | None = None,
        centroid: Vector | None = None,
    ) -> Self:
        """Add :meth:`Block.polyhedron`: a closed polyhedron, convex or not."""
        return self.add(Block.polyhedron(
            id=id, vertices=vertices, faces=faces, at=at, rotation_deg=rotation_deg,
            support=support, material=material, density=density, mass=mass, centroid=centroid,
        ))

    def prism(
        self,
        id: str,
        polygon: npt.ArrayLike,
        depth: float,
        at: Vector | None = None,
        *,
        rotation_deg: Rotation | None = None,
        support: bool = False,
        material: str | None = None,
        density: float | None = None,
        mass: float | None = None,
        centroid: Vector | None = None,
    ) -> Self:
        """Add :meth:`Block.prism`: a polygon in the x–z plane, extruded along y and centred
        on y = 0.
        """
        return self.add(Block.prism(
            id=id, polygon=polygon, depth=depth, at=at, rotation_deg=rotation_deg,
            support=support, material=material, density=density, mass=mass, centroid=centroid,
        ))

    def sphere(
        self,
        id: str,
        radius: float,
        at: Vector | None = None,
        *,
        rotation_deg: Rotation | None = None,
        support: bool = False,
        material: str | None = None,
        density: float | None = None,
        mass: float | None = None,
        centroid: Vector | None = None,
    ) -> Self:
        """Add :meth:`Block.sphere`: a sphere centred on the origin."""
        return self.add(Block.sphere(
            id=id, radius=radius, at=at, rotation_deg=rotation_deg, support=support,
            material=material, density=density, mass=mass, centroid=centroid,
        ))

    def joint(
        self,
        *,
        between: Sequence[str] | None = None,
        blocks: Sequence[str] | None = None,
        friction: float | Literal["infinite"] | None = None,
        friction_angle_deg: float | None = None,
        cohesion: float | None = None,
        tension: float | None = None,
        compression: float | None = None,
        pore_pressure: float | None = None,
        rolling_arm: float | None = None,
        normal_stiffness: float | None = None,
        shear_stiffness: float | None = None,
    ) -> Self:
        """An exception: the joints between two materials, or between two blocks. What it
        leaves out is as in the default.

        Without ``between`` and ``blocks`` it holds for all joints that have no rule of their own.

        Parameters
        ----------
        between : two of str, optional
            Two material names, in either order.
        blocks : two of str, optional
            Two block ids, in either order.
        friction : float or "infinite", optional
            Coefficient of friction μ ≥ 0, or ``"infinite"`` (no sliding).
        friction_angle_deg : float, optional
            Friction angle in degrees, in place of ``friction``.
        cohesion : float, optional
            Cohesion, Pa: shear resistance without any pressure.
        tension : float, optional
            Tensile strength, Pa. Beyond cohesion / friction it has no effect.
        compression : float, optional
            Compressive strength, Pa.
        pore_pressure : float, optional
            Pressure of the water in the joint, Pa.
        rolling_arm : float, optional
            Rolling arm, m, of contacts at points and edges.
        normal_stiffness : float, optional
            Pressure by which the joint closes one metre, Pa/m.
        shear_stiffness : float, optional
            Shear stress by which its sides move one metre along it before it slides, Pa/m.
        """
        return self._joint(Joint(
            between=between, blocks=blocks, friction=friction,
            friction_angle_deg=friction_angle_deg, cohesion=cohesion, tension=tension,
            compression=compression, pore_pressure=pore_pressure, rolling_arm=rolling_arm,
            normal_stiffness=normal_stiffness, shear_stiffness=shear_stiffness,
        ))

    def load(
        self,
        kind: Literal["dead", "live"],
        block: str | None = None,
        *,
        id: str | None = None,
        action: str | None = None,
        force: Vector | None = None,
        moment: Vector | None = None,
        at: Vector | Literal["centroid"] | None = None,
        road: OnRoad | None = None,
        arm: bool = False,
        massless: bool = False,
        acceleration: Vector | None = None,
        weight: Vector | None = None,
    ) -> Self:
        """One load: a ``force`` and/or ``moment`` on a ``block``, or an ``acceleration`` or
        ``weight`` on one block or all free blocks.

        Parameters
        ----------
        kind : str
            ``dead`` loads always act; ``live`` loads are multiplied by the load factor.
        id : str, optional
            A name by which stages add and remove it.
        action : str, optional
            The action that it belongs to in combinations; ``dead`` or ``live``, as its list, where
            absent.
        block : str, optional
            The loaded block; every free block where absent (``acceleration`` and ``weight`` only).
        force : three numbers, optional
            Force, N.
        moment : three numbers, optional
            Moment, N·m.
        at : three numbers or {"centroid"}, optional
            Where the force acts: a point of the scene, m, or ``"centroid"`` (the default).

            * ``centroid``: The block's centre of mass.

        road : OnRoad, optional
            Where on the road of a ``bridge`` template the force presses, in place of ``block`` and
            ``at``: the fill spreads it.
        arm : bool, optional
            An arm of no weight carries the force from the block to ``at``, however far off that
            lies. Without it such a force is taken for a mistake.
        massless : bool, optional
            Of a dead load along gravity: no mass stands behind it (the thrust of a vault, the pull
            of a cable), so that an earthquake does not push it. ``kinematic`` takes other loads
            along gravity for weights.
        acceleration : three numbers, optional
            Body force: mass × this acceleration, m/s².
        weight : three numbers, optional
            Body force as multiples of the block's own weight.
        """
        return self._load(kind, Load(
            id=id, action=action, block=block, force=force, moment=moment, at=at, road=road,
            arm=arm, massless=massless, acceleration=acceleration, weight=weight,
        ))

    def member(
        self,
        id: str,
        *,
        tie: Line | None = None,
        strut: Line | None = None,
        bar: Bar | None = None,
        tendon: Tendon | None = None,
        strip: Strip | None = None,
        dowel: Dowel | None = None,
        soil: Soil | None = None,
        grip: Grip | None = None,
        toothing: Toothing | None = None,
    ) -> Self:
        """A member: a name and exactly one kind.

        Parameters
        ----------
        id : str
            Unique name.
        tie : Line, optional
            A rod, cable or chain that only pulls.
        strut : Line, optional
            A rod that only pushes.
        bar : Bar, optional
            A rod that pulls and pushes.
        tendon : Tendon, optional
            A cable over deviators: one tension along several points, without friction at them.
        strip : Strip, optional
            A strip bonded to one face of a run of blocks.
        dowel : Dowel, optional
            A dowel or key across a joint: shear at a point.
        soil : Soil, optional
            Soil behind a face: pressure up to the passive one.
        grip : Grip, optional
            A finger that presses on a point with a force of its own choice, up to its strength.
        toothing : Toothing, optional
            The friction of a toothed corner.
        """
        return self.add(Member(
            id=id, tie=tie, strut=strut, bar=bar, tendon=tendon, strip=strip, dowel=dowel,
            soil=soil, grip=grip, toothing=toothing,
        ))

    def interface(
        self,
        between: Sequence[str],
        points: npt.ArrayLike | None = None,
        *,
        normal: Vector | None = None,
        friction: float | Literal["infinite"] | None = None,
    ) -> Self:
        """A contact given by hand, for joints that were discretised elsewhere. Detection
        skips the pair. Without points: the normal across which edges or corners of the
        pair meet where several are possible.

        Parameters
        ----------
        between : two of str
            The ids of the two blocks.
        points : array of shape (n, 3), optional
            Corners of the contact, m, in scene coordinates: a convex polygon, an edge (two points)
            or one point. None where only the normal of a touch is given that is found.
        normal : three numbers, optional
            Normal from the first block into the second; may be left out where three or more points
            span a plane, and is then turned so that it points from the first block's centre to the
            second's. Where a plane is spanned and a normal given, the plane gives the direction and
            the normal the side.
        friction : float or "infinite", optional
            Friction of this interface; overrides the joint rules.
        """
        return self.add(Interface(
            between=between, points=points, normal=normal, friction=friction,
        ))

    def contact(
        self,
        *,
        gap: float | None = None,
        angle_deg: float | None = None,
        min_area: float | None = None,
    ) -> Self:
        """Contact tolerances, relative to the size (bounding-box diagonal) of the smaller
        block of a pair; a gap beside a support to that of the free block, for a support
        is as large as it was drawn.

        Parameters
        ----------
        gap : float, optional
            Faces closer than this × size touch; 1 to 100 times it is reported as a near miss.
            Default 0.0001.
        angle_deg : float, optional
            Faces touch only if their normals are opposite within this angle, degrees; faces that
            are not plane may lean by their twist besides. Default 1.
        min_area : float, optional
            Contacts smaller than this × size² are ignored and counted. Default 1e-09.
        """
        return self.add(ContactTolerances(
            gap=gap, angle_deg=angle_deg, min_area=min_area,
        ))

    def material(
        self,
        name: str,
        density: float,
        *,
        young: float | None = None,
        poisson: float | None = None,
        action: str | None = None,
    ) -> Self:
        """What blocks are made of.

        Parameters
        ----------
        name : str
            What blocks and templates call it.
        density : float
            Density, kg/m³.
        young : float, optional
            Young's modulus, Pa, of what touches at points: spheres by Hertz. ``state`` alone asks
            for it; rigid where it is left out.
        poisson : float, optional
            Poisson's ratio, above −1 and at most 0.5; given with ``young``.
        action : str, optional
            The action that the weight of its blocks belongs to in combinations; ``dead`` where
            absent.
        """
        return self._material(name, Material(
            density=density, young=young, poisson=poisson, action=action,
        ))
