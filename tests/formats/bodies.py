"""Write the models of robots and engines that the tests of importers read, with writers that are not ours, and
what those say of them (``expected.json`` in each folder): ``python bodies.py``, with mujoco 4.0, trimesh 5.2,
pygltflib 1.16, yourdfpy 0.0.60 and python-sdformat 0.4 installed."""

import base64
import itertools
import json
import math
import struct
from pathlib import Path

import mujoco
import numpy as np
import pygltflib
import pysdf
import trimesh
import yourdfpy

HERE = Path(__file__).resolve().parent


# What is expected: of each free block its mass, centre of mass and box; or words of an error or a finding.


def extent(kind, size, turn, at, vertices=None):
    """The box of a shape: exact, also of round ones."""
    if vertices is not None:
        points = vertices @ turn.T + at
        return points.min(0), points.max(0)
    if kind == "sphere":
        half = np.full(3, size[0])
    elif kind == "box":
        half = np.abs(turn) @ size
    else:
        across = np.sqrt(np.maximum(0.0, 1.0 - turn[:, 2] ** 2))
        half = np.abs(turn[:, 2]) * size[1] + across * size[0]
    return at - half, at + half


KINDS = {
    mujoco.mjtGeom.mjGEOM_BOX: "box",
    mujoco.mjtGeom.mjGEOM_SPHERE: "sphere",
    mujoco.mjtGeom.mjGEOM_CYLINDER: "cylinder",
    mujoco.mjtGeom.mjGEOM_MESH: "mesh",
    mujoco.mjtGeom.mjGEOM_PLANE: "plane",
}


def of_mujoco(model):
    """Blocks of a compiled model."""
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    blocks = {}
    for geom in range(model.ngeom):
        kind = KINDS[mujoco.mjtGeom(model.geom_type[geom])]
        root = model.body_weldid[model.geom_bodyid[geom]]
        if root == 0 or (model.geom_contype[geom] == 0 and model.geom_conaffinity[geom] == 0):
            continue
        vertices = None
        if kind == "mesh":
            mesh = model.geom_dataid[geom]
            first, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
            vertices = model.mesh_vert[first : first + count].astype(float)
        turn, at = data.geom_xmat[geom].reshape(3, 3), data.geom_xpos[geom]
        low, high = extent(kind, model.geom_size[geom], turn, at, vertices)
        name = model.body(root).name
        block = blocks.setdefault(name, {"low": low, "high": high})
        block["low"], block["high"] = np.minimum(block["low"], low), np.maximum(block["high"], high)
    for name, block in blocks.items():
        root = model.body(name).id
        mine = [b for b in range(model.nbody) if model.body_weldid[b] == root]
        block["mass"] = float(sum(model.body_mass[b] for b in mine))
        block["centre"] = sum(model.body_mass[b] * data.xipos[b] for b in mine) / block["mass"]
    return {n: {k: np.asarray(v).tolist() for k, v in b.items()} for n, b in blocks.items()}


def note(folder, name, **said):
    EXPECTED.setdefault(folder, {})[name] = said


EXPECTED = {}


# MJCF, as MuJoCo saves it.


def spec(name, timestep=0.002):
    made = mujoco.MjSpec()
    made.modelname = name
    made.option.timestep = timestep
    return made


def brick(made, name, pos, size, **more):
    body = made.worldbody.add_body(name=name, pos=pos)
    body.add_freejoint()
    body.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=size, **more)
    return body


def floor(made, **more):
    made.worldbody.add_geom(name="floor", type=mujoco.mjtGeom.mjGEOM_PLANE, size=[5, 5, 0.1], **more)


def save(made, name, **said):
    made.compile()
    path = HERE / "mjcf" / name
    path.write_text(made.to_xml().replace(str(HERE / "mjcf") + "/", ""))
    # Six digits are saved.
    note("mjcf", name, blocks=of_mujoco(mujoco.MjModel.from_xml_path(str(path))), **said)


made = spec("wall")
made.option.gravity = [0, 0, -9.80665]
floor(made, friction=[0.7, 0.005, 0.0001])
for course, k in itertools.product(range(3), range(3)):
    at = [0.2 * (course % 2) + 0.4 * k, 0.0, 0.1 + 0.2 * course]
    brick(made, f"brick-{course}-{k}", at, [0.2, 0.1, 0.1], density=2000, friction=[0.7, 0.005, 0.0001])
save(made, "wall.xml", gravity=[0, 0, -9.80665], friction=0.7, supports=["floor"])

# Frictions: the greater of two, or that of the higher priority.
made = spec("frictions")
floor(made, friction=[0.3, 0.005, 0.0001])
brick(made, "rough", [0, 0, 0.1], [0.1] * 3, friction=[0.9, 0.005, 0.0001], mass=3)
brick(made, "smooth", [1, 0, 0.1], [0.1] * 3, friction=[0.1, 0.005, 0.0001])
brick(made, "slippery", [2, 0, 0.1], [0.1] * 3, friction=[0.2, 0.005, 0.0001], priority=1)
save(
    made,
    "frictions.xml",
    pairs=[["rough", "floor", 0.9], ["smooth", "floor", 0.3], ["slippery", "floor", 0.2], ["slippery", "rough", 0.2]],
)

# Bodies of several shapes, one in another, with an inertial and masses of their own.
made = spec("welded")
floor(made)
body = brick(made, "dumbbell", [0, 0, 0.2], [0.1, 0.1, 0.1], density=500)
inner = body.add_body(name="inner", pos=[0.5, 0, 0], quat=[math.cos(0.3), 0, 0, math.sin(0.3)])
inner.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=[0.1, 0.05, 0.2], mass=7)
balls = made.worldbody.add_body(name="balls", pos=[0, 2, 0.3])
balls.add_freejoint()
balls.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[0.3, 0, 0])
balls.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[0.2, 0, 0], pos=[0.7, 0, 0])
weighed = made.worldbody.add_body(name="weighed", pos=[0, 4, 0.5])
weighed.add_freejoint()
weighed.explicitinertial, weighed.mass, weighed.ipos, weighed.inertia = True, 11, [0, 0, -0.25], [1, 1, 1]
weighed.add_geom(type=mujoco.mjtGeom.mjGEOM_CYLINDER, size=[0.3, 0.5, 0])
ledge = made.worldbody.add_body(name="ledge", pos=[0, -1, 0])
ledge.add_geom(name="left", type=mujoco.mjtGeom.mjGEOM_BOX, size=[0.2] * 3)
ledge.add_geom(name="right", type=mujoco.mjtGeom.mjGEOM_BOX, size=[0.2] * 3, pos=[0.3, 0, 0])
save(
    made,
    "welded.xml",
    supports=["floor", "ledge-left", "ledge-right"],
    findings=["\"dumbbell\" (2 shapes)", "\"weighed\" (", "inertials"],
)

# Meshes, inside and beside.
stone = trimesh.creation.icosahedron()
stone.apply_scale([0.3, 0.4, 0.5])
(HERE / "mjcf" / "meshes").mkdir(exist_ok=True)
stone.export(HERE / "mjcf" / "meshes" / "stone.stl")
made = spec("meshes")
made.meshdir = str(HERE / "mjcf" / "meshes")
floor(made)
wedge = [0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 0, 1, 1]
made.add_mesh(name="wedge", uservert=wedge)
made.add_mesh(name="stone", file="stone.stl", scale=[1, -2, 1])
for name, at in [("wedge", [1, 0, 0]), ("stone", [-2, 0, 1])]:
    body = made.worldbody.add_body(name=name, pos=at, quat=[0.9, 0.1, 0.3, -0.2])
    body.add_freejoint()
    body.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname=name, density=2500)
save(made, "meshes.xml", findings=["convex hulls"], single=True)

# Every way to say how a frame lies, in both units, with classes: as people write, compiled by MuJoCo.
TURNS = {
    "quat": 'quat="0.3 -0.5 0.7 0.2"',
    "axisangle": 'axisangle="1 -2 0.5 {a}"',
    "euler": 'euler="{a} {b} {c}"',
    "xyaxes": 'xyaxes="1 2 0.3 -2 1 0.4"',
    "zaxis": 'zaxis="0.3 -0.2 -0.9"',
    "down": 'zaxis="0 0 -1"',
}
for name, unit, sequence in [("radian", 1.0, "XzY"), ("degree", 180 / math.pi, "zyx")]:
    angles = {"a": 0.4 * unit, "b": -1.1 * unit, "c": 2.2 * unit}
    bodies = []
    for k, (turn, text) in enumerate(TURNS.items()):
        text = text.format(**angles)
        bodies.append(
            f'    <body name="{turn}" pos="{2 * k} 1 3" {text}>\n      <freejoint/>\n'
            f'      <geom class="slab" pos="0.1 0.2 0.3" {text}/>\n    </body>'
        )
    for kind in ["box", "cylinder"]:
        bodies.append(
            f'    <frame pos="0 0 {3 if kind == "box" else 6}" euler="{angles["c"]} 0 0">\n'
            f'      <body name="fromto-{kind}" pos="20 1 3" childclass="slab">\n        <freejoint/>\n'
            f'        <geom type="{kind}" fromto="0.1 0.2 0.3 -0.4 0.5 0.9" size="0.2"/>\n      </body>\n    </frame>'
        )
    text = f"""<mujoco model="{name}">
  <!-- {'<' * 300} -->
  <compiler angle="{name}" eulerseq="{sequence}"/>
  <default>
    <geom type="sphere" size="0.5"/>
    <default class="heavy">
      <geom density="3000"/>
      <default class="slab"><geom type="box" size="0.1 0.2 0.4"/></default>
    </default>
  </default>
  <worldbody>
    <geom name="floor" type="plane" size="1 1 1"/>
{chr(10).join(bodies)}
  </worldbody>
</mujoco>
"""
    (HERE / "mjcf" / f"{name}.xml").write_text(text)
    note("mjcf", f"{name}.xml", blocks=of_mujoco(mujoco.MjModel.from_xml_string(text)))


# One fault each.


def line(text, part):
    return 1 + text[: text.index(part)].count("\n")


def faulty(name, made, part, error=None, findings=None, change=None):
    made.compile()
    text = made.to_xml()
    if change:
        text = text.replace(*change)
    (HERE / "mjcf" / name).write_text(text)
    note("mjcf", name, line=line(text, part), **({"error": error} if error else {"findings": findings}))


made = spec("hinge")
floor(made)
door = made.worldbody.add_body(name="door", pos=[0, 0, 1])
door.add_joint(name="axle", type=mujoco.mjtJoint.mjJNT_HINGE)
door.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=[0.5, 0.05, 1])
faulty("fault-hinge.xml", made, "<joint", error=["axle", "door", "hinge"])

made = spec("capsule")
floor(made)
brick(made, "a", [0, 0, 0.5], [0.5] * 3)
pill = made.worldbody.add_body(name="pill", pos=[3, 0, 1])
pill.add_freejoint()
pill.add_geom(name="skin", type=mujoco.mjtGeom.mjGEOM_CAPSULE, size=[0.2, 0.5, 0])
faulty("fault-capsule.xml", made, '<geom name="skin"', error=["skin", "capsule"])

made = spec("massless")
floor(made)
brick(made, "feather", [0, 0, 0.5], [0.5] * 3, density=77)
faulty("fault-massless.xml", made, '<body name="feather"', error=["feather", "no mass"], change=('density="77"', 'density="0"'))

made = spec("tied")
floor(made)
brick(made, "a", [0, 0, 0.5], [0.5] * 3)
brick(made, "b", [2, 0, 0.5], [0.5] * 3)
made.add_equality(type=mujoco.mjtEq.mjEQ_WELD, name1="a", name2="b", objtype=mujoco.mjtObj.mjOBJ_BODY)
faulty("fault-equality.xml", made, "<weld", error=["equality"])

made = spec("filters")
floor(made)
brick(made, "a", [0, 0, 0.5], [0.5] * 3, contype=2).geoms[0].name = "masked"
brick(made, "b", [2, 0, 0.5], [0.5] * 3)
made.add_exclude(bodyname1="a", bodyname2="b")
faulty("fault-filters.xml", made, '<geom name="masked"', findings=["contype", "\"masked\"", "exclude a–b"])

made = spec("gone")
floor(made)
brick(made, "a", [0, 0, 0.5], [0.5] * 3)
faulty(
    "fault-mesh.xml",
    made,
    "<mesh",
    error=["gone.obj"],
    change=("<worldbody>", '<asset>\n    <mesh name="a" file="gone.obj"/>\n  </asset>\n\n  <worldbody>\n    <geom type="mesh" mesh="a"/>'),
)


# URDF, as yourdfpy writes it.


def pose(at=(0, 0, 0), rpy=(0, 0, 0)):
    matrix = trimesh.transformations.euler_matrix(*rpy, axes="sxyz")
    matrix[:3, 3] = at
    return matrix


def shape(**kinds):
    made = {
        "box": lambda size: yourdfpy.Box(size=np.array(size, dtype=float)),
        "sphere": lambda radius: yourdfpy.Sphere(radius=radius),
        "cylinder": lambda dims: yourdfpy.Cylinder(radius=dims[0], length=dims[1]),
        "mesh": lambda file: yourdfpy.Mesh(filename=file),
    }
    ((kind, value),) = kinds.items()
    return yourdfpy.Geometry(**{kind: made[kind](value)})


def link(name, geometry, origin=pose(), mass=None, centre=pose()):
    inertial = None if mass is None else yourdfpy.Inertial(mass=mass, origin=centre, inertia=np.eye(3))
    collisions = [yourdfpy.Collision(name=f"{name}-hull", origin=origin, geometry=geometry)] if geometry else []
    return yourdfpy.Link(name=name, inertial=inertial, collisions=collisions)


def robot(name, links, joints=(), change=None, blocks=None, part=None, **said):
    made = yourdfpy.Robot(name=name, links=links, joints=list(joints))
    path = HERE / "urdf" / f"{name}.urdf"
    yourdfpy.URDF(made, build_scene_graph=False, load_meshes=False).write_xml_file(str(path))
    text = path.read_text()
    if change:
        text = text.replace(*change)
        path.write_text(text)
    if part:
        said["line"] = line(text, part)
    if blocks:
        said["blocks"] = {n: {k: np.asarray(v).tolist() for k, v in b.items()} for n, b in blocks.items()}
    note("urdf", path.name, **said)


def joint(name, kind, parent, child, origin=pose(), **more):
    return yourdfpy.Joint(name=name, type=kind, parent=parent, child=child, origin=origin, **more)


def block(kind, size, matrix, mass, centre):
    low, high = extent(kind, np.array(size, dtype=float), matrix[:3, :3], matrix[:3, 3])
    return {"low": low, "high": high, "mass": mass, "centre": np.array(centre)[:3]}


crate = pose((0.1, 0.2, 0.3), (0.4, -0.5, 0.6))
robot(
    "crate",
    [link("crate", shape(box=[0.4, 0.6, 0.8]), crate, 5.0, pose((0.1, 0.0, 0.0)))],
    blocks={"crate": block("box", [0.2, 0.3, 0.4], crate, 5.0, (0.1, 0, 0))},
)
lifted = pose((1, 2, 3), (0.1, 0.2, 0.3))
robot(
    "stool",
    [
        link("world", None),
        link("slab", shape(box=[4, 4, 0.2]), pose((0, 0, -0.1)), 1.0),
        link("drum", shape(cylinder=[0.3, 1.0]), pose(), 20.0),
        link("ball", shape(sphere=0.25), pose((0, 0, 0.1)), 2.0),
    ],
    [
        joint("ground", "fixed", "world", "slab"),
        joint("on", "floating", "slab", "drum", pose((0, 0, 0.5))),
        joint("off", "floating", "drum", "ball", lifted),
    ],
    blocks={
        "drum": block("cylinder", [0.3, 0.5], pose((0, 0, 0.5)), 20.0, (0, 0, 0.5)),
        "ball": block("sphere", [0.25], pose((0, 0, 0.5)) @ lifted @ pose((0, 0, 0.1)), 2.0, (pose((0, 0, 0.5)) @ lifted)[:, 3]),
    },
    supports=["slab"],
)
robot(
    "beam",
    [link("left", shape(box=[1, 1, 1]), mass=1.0), link("right", shape(box=[1, 1, 1]), mass=3.0)],
    [joint("glue", "fixed", "left", "right", pose((2, 0, 0)))],
    blocks={"left": {"low": [-0.5] * 3, "high": [2.5, 0.5, 0.5], "mass": 4.0, "centre": [1.5, 0, 0]}},
    findings=["\"left\" (2 shapes)"],
)
(HERE / "urdf" / "meshes").mkdir(exist_ok=True)
stone.export(HERE / "urdf" / "meshes" / "stone.stl")
corners = np.asarray(stone.vertices, dtype=np.float32).astype(float)
robot(
    "stone",
    [link("stone", shape(mesh="package://stones/meshes/stone.stl"), mass=9.0)],
    blocks={"stone": {"low": corners.min(0), "high": corners.max(0), "mass": 9.0, "centre": [0, 0, 0]}},
    single=True,
)
robot(
    "fault-arm",
    [link("base", shape(box=[1, 1, 1]), mass=1.0), link("arm", shape(box=[1, 1, 1]), mass=1.0)],
    [joint("elbow", "continuous", "base", "arm", axis=np.array([0.0, 0.0, 1.0]))],
    part='<joint name="elbow"',
    error=["elbow", "continuous"],
)
robot("fault-weightless", [link("ghost", shape(box=[1, 1, 1]))], part="<link", findings=["\"ghost\"", "without a mass"])
robot(
    "fault-size",
    [link("flat", shape(box=[1, 1, 0]), mass=1.0)],
    part="<box",
    error=["box: size", "0"],
)
robot(
    "fault-orphan",
    [link("a", shape(box=[1, 1, 1]), mass=1.0), link("b", shape(box=[1, 1, 1]), mass=1.0)],
    [joint("glue", "fixed", "a", "b")],
    change=('<parent link="a"', '<parent link="nobody"'),
    part="<joint",
    error=["glue", "parent"],
)


# SDF, as python-sdformat writes it.


def sdf(name, *children, part=None, blocks=None, **said):
    made = pysdf.SDF(*children, version="1.9")
    path = HERE / "sdf" / f"{name}.sdf"
    made.to_file(str(path), pretty_print=True)
    if part:
        said["line"] = line(path.read_text(), part)
    if blocks:
        said["blocks"] = {n: {k: np.asarray(v).tolist() for k, v in b.items()} for n, b in blocks.items()}
    note("sdf", path.name, **said)


def words(values):
    return " ".join(repr(float(v)) for v in values)


def collision(geometry, mu=None, at=None, name="collision"):
    Part = pysdf.Collision
    parts = [pysdf.Pose(text=words(at))] if at is not None else []
    parts.append(pysdf.Geometry(geometry))
    if mu is not None:
        ode = Part.Surface.Friction.Ode(Part.Surface.Friction.Ode.Mu(text=str(mu)))
        parts.append(Part.Surface(Part.Surface.Friction(ode)))
    return Part(*parts, name=name)


Shapes = pysdf.Geometry


def cuboid(size):
    return Shapes.Box(Shapes.Box.Size(text=words(size)))


def inertial(mass):
    return pysdf.Link.Inertial(pysdf.Link.Inertial.Mass(text=str(mass)))


def model(name, *children, at=None, static=False):
    first = [pysdf.Pose(text=words(at))] if at is not None else []
    if static:
        first.append(pysdf.Model.Static(text="true"))
    return pysdf.Model(*first, *children, name=name)


ground = model("ground", pysdf.Link(collision(Shapes.Plane(Shapes.Plane.Normal(text="0 0 1")), 0.5), name="link"), static=True)
turned = (0.0, 0.0, 0.5, 0.0, 0.0, 0.7)
sdf(
    "crates",
    pysdf.World(
        pysdf.World.Gravity(text="0 0 -9.7"),
        ground,
        model("a", pysdf.Link(inertial(8), collision(cuboid([1, 2, 1]), 0.9), name="link"), at=turned),
        model("b", pysdf.Link(inertial(3), collision(cuboid([1, 1, 1]), 0.4), name="link"), at=(0, 0, 1.5, 0, 0, 0)),
        name="yard",
    ),
    blocks={
        "a": block("box", [0.5, 1, 0.5], pose(turned[:3], turned[3:]), 8.0, turned[:3]),
        "b": block("box", [0.5, 0.5, 0.5], pose((0, 0, 1.5)), 3.0, (0, 0, 1.5)),
    },
    supports=["ground"],
    gravity=[0, 0, -9.7],
    pairs=[["a", "ground", 0.5], ["a", "b", 0.4], ["b", "ground", 0.4]],
)
tilted = (1, 2, 3, 0.3, -0.4, 0.5)
inside = (0.5, 0, 0, 0, 0.2, 0)
sdf(
    "drums",
    model(
        "drums",
        pysdf.Link(pysdf.Pose(text=words(inside)), inertial(2), collision(Shapes.Cylinder(Shapes.Cylinder.Radius(text="0.2"), Shapes.Cylinder.Length(text="0.6"))), name="drum"),
        pysdf.Link(inertial(1), collision(Shapes.Sphere(Shapes.Sphere.Radius(text="0.1"))), name="ball"),
        at=tilted,
    ),
    blocks={
        "drums::drum": block("cylinder", [0.2, 0.3], pose(tilted[:3], tilted[3:]) @ pose(inside[:3], inside[3:]), 2.0, (pose(tilted[:3], tilted[3:]) @ pose(inside[:3]))[:, 3]),
        "drums::ball": block("sphere", [0.1], pose(tilted[:3]), 1.0, tilted[:3]),
    },
)


def fixed(parent, child, kind="fixed"):
    return pysdf.Joint(pysdf.Joint.Parent(text=parent), pysdf.Joint.Child(text=child), name="joint", type=kind)


def cube(name, at, mass=1):
    return pysdf.Link(pysdf.Pose(text=words(at)), inertial(mass), collision(cuboid([1, 1, 1])), name=name)


apart = (2, 0, 0, 0, 0, 0)
sdf(
    "pair",
    model("pair", cube("left", (0,) * 6), cube("right", apart, 3), cube("held", (0, 4, 0, 0, 0, 0)), fixed("left", "right"), fixed("world", "held")),
    blocks={"pair::left": {"low": [-0.5] * 3, "high": [2.5, 0.5, 0.5], "mass": 4.0, "centre": [1.5, 0, 0]}},
    supports=["pair::held"],
)
sdf(
    "fault-door",
    model("door", cube("frame", (0,) * 6), cube("leaf", apart), fixed("frame", "leaf", "revolute")),
    part="<joint",
    error=["joint", "revolute"],
)
sdf(
    "fault-frame",
    model("m", pysdf.Link(pysdf.Pose(text="0 0 0 0 0 0", relative_to="elsewhere"), collision(cuboid([1, 1, 1])), name="link")),
    part="<pose",
    error=["relative to", "elsewhere"],
)
sdf("fault-mass", model("m", pysdf.Link(collision(cuboid([1, 1, 1])), name="link")), part="<link", findings=["without a mass", "1 kg"])
sdf(
    "fault-mesh",
    model("m", pysdf.Link(collision(Shapes.Mesh(Shapes.Mesh.Uri(text="../../../etc/passwd"))), name="link")),
    part="<mesh",
    error=["leaves the folder"],
)


# glTF, by trimesh and by pygltflib.


def of_meshes(meshes):
    return {n: {"low": m.bounds[0].tolist(), "high": m.bounds[1].tolist(), "volume": float(m.volume)} for n, m in meshes.items()}


def gltf(name, scene, blocks, **said):
    path = HERE / "gltf" / name
    if name.endswith(".glb"):
        path.write_bytes(scene.export(file_type="glb"))
    else:
        for file, data in scene.export(file_type="gltf", merge_buffers=True).items():
            renamed = name if file == "model.gltf" else name.replace(".gltf", ".bin")
            if file == "model.gltf":
                data = data.replace(b"gltf_buffer.bin", renamed.replace(".gltf", ".bin").encode())
            (HERE / "gltf" / renamed).write_bytes(data)
    note("gltf", name, blocks=blocks, **said)


# The scene is z up here, y up in the file.
UP = trimesh.transformations.rotation_matrix(-math.pi / 2, [1, 0, 0])
arch = {}
for k in range(5):
    a, b = k * math.pi / 5, (k + 1) * math.pi / 5
    ring = [(r * math.cos(t), r * math.sin(t)) for r, t in [(4, a), (5, a), (5, b), (4, b)]]
    corners = [(x, y, z) for y in (0.0, 1.0) for x, z in ring]
    arch[f"v{k}"] = trimesh.convex.convex_hull(np.array(corners))
for name in ["arch.glb", "arch.gltf"]:
    scene = trimesh.Scene()
    for k, (part, mesh) in enumerate(arch.items()):
        scene.add_geometry(mesh, node_name=part, geom_name=f"g{k}", transform=UP)
    gltf(name, scene, of_meshes(arch))
box = trimesh.creation.box([1, 2, 3])
scene = trimesh.Scene()
places = {}
for k, angle in enumerate([0.0, 0.5, 1.0]):
    matrix = trimesh.transformations.rotation_matrix(angle, [1, 2, 3], [0, 0, 0])
    matrix[:3, 3] = [4 * k, 0, 0]
    scene.add_geometry(box, node_name=f"n{k}", geom_name="box", transform=UP @ matrix)
    places[f"n{k}"] = box.copy().apply_transform(matrix)
gltf("instances.glb", scene, of_meshes(places))


def triangles(mesh, nodes, name, change=None, **said):
    """One mesh and any nodes, by pygltflib."""
    points = np.asarray(mesh.vertices, dtype=np.float32)
    indices = np.asarray(mesh.faces, dtype=np.uint16)
    data = points.tobytes() + indices.tobytes()
    G = pygltflib
    made = G.GLTF2(
        scene=0,
        scenes=[G.Scene(nodes=[k for k, n in enumerate(nodes) if not n.pop("below", False)])],
        nodes=[G.Node(**n) for n in nodes],
        meshes=[G.Mesh(name="mesh", primitives=[G.Primitive(attributes=G.Attributes(POSITION=0), indices=1, material=0)])],
        materials=[G.Material(name="sandstone")],
        accessors=[
            G.Accessor(bufferView=0, componentType=G.FLOAT, count=len(points), type=G.VEC3, max=points.max(0).tolist(), min=points.min(0).tolist()),
            G.Accessor(bufferView=1, componentType=G.UNSIGNED_SHORT, count=indices.size, type=G.SCALAR),
        ],
        bufferViews=[
            G.BufferView(buffer=0, byteOffset=0, byteLength=points.nbytes, target=G.ARRAY_BUFFER),
            G.BufferView(buffer=0, byteOffset=points.nbytes, byteLength=indices.nbytes, target=G.ELEMENT_ARRAY_BUFFER),
        ],
        buffers=[G.Buffer(byteLength=len(data), uri="data:application/octet-stream;base64," + base64.b64encode(data).decode())],
    )
    if change:
        change(made)
    (HERE / "gltf" / name).write_text(made.to_json())
    note("gltf", name, **said)


upright = box.copy().apply_transform(UP)


def stands(k, height=0.0):
    return {"low": [2.0 * k - 0.5, -1.0, height - 1.5], "high": [2.0 * k + 0.5, 1.0, height + 1.5], "volume": 6.0}


triangles(
    upright,
    [
        {"name": "stone", "mesh": 0, "translation": [0, 4, 0], "extras": {"mass_kg": 120.0}},
        {"name": "group", "children": [2, 3], "translation": [2, 0, 0]},
        {"name": "base", "mesh": 0, "below": True, "extras": {"support": True, "material": "rock"}},
        {"name": "mirrored", "mesh": 0, "below": True, "translation": [2, 0, 0], "scale": [-1, 1, 1]},
    ],
    "extras.gltf",
    blocks={"stone": {**stands(0, 4.0), "mass": 120.0}, "mirrored": stands(2)},
    supports=["base"],
    findings=["2400 kg/m³, assumed"],
)
triangles(upright, [{"name": "a", "mesh": 0, "children": [1]}, {"name": "b", "mesh": 0, "children": [0], "below": True}], "fault-ring.gltf", error=["nodes[0]", "below itself"])
triangles(upright, [{"name": "a", "mesh": 0}], "fault-short.gltf", change=lambda g: setattr(g.accessors[0], "count", 4000), error=["accessors[0]", "beyond its buffer"])
triangles(upright, [{"name": "a", "mesh": 0}], "fault-draco.gltf", change=lambda g: setattr(g, "extensionsRequired", ["KHR_draco_mesh_compression"]), error=["KHR_draco_mesh_compression"])
triangles(
    upright,
    [{"name": "a", "mesh": 0, "extras": {"mass_kg": "heavy"}}, {"name": "b", "mesh": 1}],
    "fault-lines.gltf",
    change=lambda g: g.meshes.append(pygltflib.Mesh(name="line", primitives=[pygltflib.Primitive(attributes=pygltflib.Attributes(POSITION=0), mode=1)])),
    blocks={"a": stands(0)},
    findings=["meshes[1].primitives[0]", "nodes[0] \"a\": mass_kg"],
)

for folder, said in EXPECTED.items():
    (HERE / folder / "expected.json").write_text(json.dumps(said, indent=1, ensure_ascii=False) + "\n")
