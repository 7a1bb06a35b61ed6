"""To and from COMPAS: assemblies of compas_assembly and compas_cra, block models of compas_dem,
plain meshes.

Forces come back under the names that compas_cra writes, so that its viewers show them: on every
edge ``interfaces`` (``contacts`` of a block model) with ``forces`` of ``c_np``, ``c_nn``, ``c_u``,
``c_v`` at their corners, on every node ``displacement``: velocity and spin of the mechanism.

>>> import voussoir
>>> from compas.datastructures import Mesh
>>> from compas.geometry import Box, Frame
>>> boxes = [Box(1, 1, 1, Frame([0, 0, z], [1, 0, 0], [0, 1, 0])) for z in (0, 1)]
>>> meshes = [Mesh.from_shape(box) for box in boxes]
>>> scene = voussoir.compas.from_assembly(meshes, supports=[0], friction=0.6, density=2400)
>>> voussoir.assess(scene).verdict.value
'stable'
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Sequence
from typing import Any, Literal

import numpy as np

from . import _core
from ._answers import Answer, Assessment, Certificate
from ._ask import Law, assess, limit, settle
from ._errors import InputError
from ._scene import Friction, Scene, Up

__all__ = ["from_assembly", "from_problem", "solve", "solve_problem", "to_assembly", "to_results"]

# Rows of the rotation from the axes of a file to those of a scene, as `import` has it.
ROTATIONS: dict[Up, list[list[float]]] = {
    "x": [[0, 0, -1], [0, 1, 0], [1, 0, 0]],
    "y": [[1, 0, 0], [0, 0, -1], [0, 1, 0]],
    "z": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
    "-x": [[0, 0, 1], [0, 1, 0], [-1, 0, 0]],
    "-y": [[1, 0, 0], [0, 0, 1], [0, -1, 0]],
    "-z": [[1, 0, 0], [0, -1, 0], [0, 0, -1]],
}


def from_assembly(
    assembly: Any,
    *,
    supports: Iterable[Any] = (),
    support_below: float | None = None,
    friction: Friction | None = None,
    density: float | None = None,
    scale: float = 1.0,
    up: Up = "z",
    gap: float | None = None,
    angle_deg: float | None = None,
    stored_interfaces: bool = True,
    name: str | None = None,
) -> Scene:
    """A scene of an assembly.

    Parameters
    ----------
    assembly : Assembly, CRA_Assembly, BlockModel, meshes or path
        Of compas_assembly, compas_cra, compas_dem; meshes as a list, nested or not; or a file that
        ``compas.json_dump`` wrote.
    supports : nodes, or indices of meshes
        Held in place, beside those that the assembly names.
    support_below : float, optional
        Blocks whose lowest corner lies below this height are held, m.
    friction : float or "infinite", optional
        Coefficient of friction of every joint.
    density : float, optional
        kg/m³, in place of what the assembly says.
    scale : float
        Multiplies coordinates: 0.001 for an assembly in millimetres.
    up : {"x", "y", "z", "-x", "-y", "-z"}
        The axis of the assembly that points up.
    gap, angle_deg : float, optional
        When faces touch, as in :class:`voussoir.ContactTolerances`.
    stored_interfaces : bool
        Keep the assembly's own in place of contacts that are detected.
    name : str, optional
        Name of the scene; that of the assembly where none is given.

    Returns
    -------
    Scene
        The id of a block is its node, or its index.

    Raises
    ------
    InputError
        The assembly or an option cannot be used as it is.

    Examples
    --------
    >>> import voussoir
    >>> from compas.datastructures import Mesh
    >>> from compas.geometry import Box, Frame
    >>> boxes = [Box(1000, 1000, 1000, Frame([0, 0, z], [1, 0, 0], [0, 1, 0])) for z in (0, 1000)]
    >>> scene = voussoir.compas.from_assembly(
    ...     [Mesh.from_shape(box) for box in boxes],
    ...     supports=[0],
    ...     scale=0.001,
    ...     friction=0.6,
    ...     density=2400,
    ... )
    >>> voussoir.assess(scene).verdict.value
    'stable'
    """
    if isinstance(assembly, (str, os.PathLike)):
        with open(assembly, "rb") as file:
            data = file.read()
    else:
        import compas

        if not hasattr(assembly, "__data__") and not hasattr(assembly, "to_data"):
            assembly = list(assembly)
        data = compas.json_dumps(assembly, minimal=True).encode()
    core, _ = _core.import_scene(
        [],
        name="assembly.json",
        data=data,
        supports=[str(support) for support in supports],
        support_below=support_below,
        friction=float("inf") if friction == "infinite" else friction,
        density=density,
        scale=scale,
        up=up,
        gap=gap,
        angle_deg=angle_deg,
        stored_interfaces=stored_interfaces,
    )
    scene = Scene._of(core)
    if name is None:
        attributes = getattr(assembly, "attributes", None) or {}
        name = attributes.get("name") or getattr(assembly, "name", None)
    if isinstance(name, str):
        scene.name = name
    return scene


def to_assembly(
    answer: Answer,
    assembly: Any,
    certificate: Certificate | None = None,
    *,
    scale: float = 1.0,
    up: Up = "z",
    magnify: float = 1.0,
) -> Any:
    """Write the forces and the mechanism of an answer on the edges and nodes of its assembly.

    Parameters
    ----------
    answer : Answer
        About a scene that :func:`from_assembly` made.
    assembly : Assembly, CRA_Assembly or BlockModel
        The same assembly; it is changed and returned.
    certificate : Certificate, optional
        Another than the answer's own: ``answer.dry``, ``answer.certificate_at(3)``.
    scale, up
        As for :func:`from_assembly`: points, frames, areas and velocities come back in the units
        and axes of the assembly. Forces are in N, moments in N·m.
    magnify : float
        Multiplies velocities and spins.

    Returns
    -------
    Assembly, CRA_Assembly or BlockModel
        Edges that are missing are added, interfaces that were there are replaced. Compression is
        ``c_np``; forces act on the second node of an edge, along the axes of the interface's frame.

    Raises
    ------
    KeyError
        A block of the answer is no node of the assembly.

    Examples
    --------
    >>> import voussoir
    >>> from compas.geometry import Box, Frame
    >>> from compas_assembly.datastructures import Assembly, Block
    >>> assembly = Assembly()
    >>> for node, z in enumerate((0, 1000)):
    ...     box = Box(1000, 1000, 1000, Frame([0, 0, z], [1, 0, 0], [0, 1, 0]))
    ...     _ = assembly.add_block(Block.from_shape(box), node=node, is_support=node == 0)
    >>> scene = voussoir.compas.from_assembly(assembly, scale=0.001, friction=0.6, density=1000)
    >>> _ = voussoir.compas.to_assembly(voussoir.assess(scene), assembly, scale=0.001)
    >>> (interface,) = assembly.graph.edge_attribute((0, 1), "interfaces")
    >>> round(sum(force["c_np"] for force in interface.forces), 3), round(interface.size)
    (9810.0, 1000000)
    """
    evidence = answer.certificate if certificate is None else certificate
    graph = assembly.graph
    nodes = {str(node): node for node in graph.nodes()}
    is_model = hasattr(assembly, "elements")
    attribute = "contacts" if is_model else "interfaces"
    make = _contact_class() if is_model else _interface_class()
    for edge in list(graph.edges()):
        if graph.edge_attribute(edge, attribute):
            graph.edge_attribute(edge, attribute, [])
    back = np.array(ROTATIONS[up], dtype=np.float64)
    found = _contacts(answer, evidence, graph, make, back, scale)
    for edge, listed in found.items():
        if not graph.has_edge(edge):
            graph.add_edge(*edge)
        graph.edge_attribute(edge, attribute, listed)
        if not is_model:
            # Where older viewers look.
            graph.edge_attribute(edge, "interface", listed[0])
    rates = evidence.rates
    motion = magnify * np.hstack([rates.velocity @ back / scale, rates.spin @ back])
    moving = dict(zip(rates.blocks, motion.tolist()))
    for key, node in nodes.items():
        graph.node_attribute(node, "displacement", moving.get(key, [0.0] * 6))
    return assembly


def _contacts(
    answer: Answer, evidence: Certificate, graph: Any, make: Any, back: Any, scale: float
) -> dict[tuple[Any, Any], list[Any]]:
    """The contacts of every edge of a graph, with their forces."""
    nodes = {str(node): node for node in graph.nodes()}
    axes, areas = answer.axes, answer.areas / scale**2
    found: dict[tuple[Any, Any], list[Any]] = {}
    for k, ((a, b), points, own) in enumerate(evidence.forces):
        edge, frame, sign = (nodes[a], nodes[b]), axes[k], 1.0
        if not graph.has_edge(edge) and graph.has_edge(edge[::-1]):
            # The frame turns with the edge: its normal points from the first node to the second.
            edge, sign = edge[::-1], -1.0
            frame = frame * np.array([[1.0], [-1.0], [-1.0]])
        along = sign * own @ frame.T
        components = [
            {"c_np": max(n, 0.0), "c_nn": max(-n, 0.0), "c_u": u, "c_v": v}
            for u, v, n in along.tolist()
        ]
        place, own_axes = (points @ back / scale).tolist(), (frame @ back).tolist()
        found.setdefault(edge, []).append(make(place, own_axes, float(areas[k]), components))
    return found


def _interface_class() -> Any:
    from compas.geometry import Frame
    from compas_assembly.datastructures import Interface

    def make(
        points: Sequence[Any], axes: Sequence[Any], size: float, forces: list[dict[str, float]]
    ) -> Any:
        frame = Frame(np.mean(points, axis=0).tolist(), axes[0], axes[1])
        return Interface(size=size, points=points, frame=frame, forces=forces)

    return make


def _contact_class() -> Any:
    from compas.geometry import Frame
    from compas_dem.interactions import contact as kinds

    def make(
        points: Sequence[Any], axes: Sequence[Any], size: float, forces: list[dict[str, float]]
    ) -> Any:
        frame = Frame(np.mean(points, axis=0).tolist(), axes[0], axes[1])
        if len(points) == 1:
            return kinds.VertexContact(point=points[0], frame=frame, forces=forces)
        if len(points) == 2:
            return kinds.EdgeContact(points=points, frame=frame, forces=forces)
        return kinds.FrictionContact(points=points, frame=frame, size=size, forces=forces)

    return make


def solve(assembly: Any, *, law: Law = "coulomb", **options: Any) -> Any:
    """Assess an assembly and write the answer on it: a remote procedure call with nothing but
    COMPAS data in and out (``compas.rpc.Proxy("voussoir.compas").solve(assembly)``).

    Parameters
    ----------
    assembly : Assembly, CRA_Assembly or BlockModel
        It is changed and returned.
    law : {"coulomb", "associative"}
        How joints slide.
    **options
        Those of :func:`from_assembly`.

    Returns
    -------
    Assembly, CRA_Assembly or BlockModel
        With the forces of :func:`to_assembly`; ``assembly.attributes["voussoir"]`` has ``verdict``,
        ``equilibrium_error`` and the first line of the answer, ``title``.

    Raises
    ------
    InputError
        The assembly or an option cannot be used as it is.

    Examples
    --------
    >>> import voussoir
    >>> from compas.geometry import Box, Frame
    >>> from compas_assembly.datastructures import Assembly, Block
    >>> assembly = Assembly()
    >>> for node, z in enumerate((0, 1)):
    ...     box = Box(1, 1, 1, Frame([0, 0, z], [1, 0, 0], [0, 1, 0]))
    ...     _ = assembly.add_block(Block.from_shape(box), node=node, is_support=node == 0)
    >>> solved = voussoir.compas.solve(assembly, friction=0.6, density=1000)
    >>> solved.attributes["voussoir"]["verdict"]
    'stable'
    """
    answer: Assessment = assess(from_assembly(assembly, **options), law=law)
    to_assembly(answer, assembly, scale=options.get("scale", 1.0), up=options.get("up", "z"))
    assembly.attributes["voussoir"] = {
        "verdict": answer.verdict.value,
        "equilibrium_error": [answer.equilibrium_error.lower, answer.equilibrium_error.upper],
        "title": answer.title,
    }
    return assembly


def from_problem(
    problem: Any,
    *,
    live: Iterable[str] = (),
    density: float | None = None,
    stored_interfaces: bool = True,
) -> Scene:
    """A scene of a problem of compas_dem: its model, contact model and loads. Lengths are in m,
    forces in N, z points up.

    Parameters
    ----------
    problem : Problem
        With its model. The contact model gives friction, cohesion and tensile strength, Pa.
    live : names of boundary conditions
        Their loads are multiplied by the load factor; all others are dead loads.
    density : float, optional
        kg/m³, in place of the materials of the blocks.
    stored_interfaces : bool
        Keep the contacts of the model, where they were computed.

    Returns
    -------
    Scene
        The id of a block is its node.

    Raises
    ------
    InputError
        The problem has no contact model, or no boundary condition of a name in ``live``.

    Examples
    --------
    >>> import voussoir
    >>> from compas.geometry import Box, Frame
    >>> from compas_dem.models import BlockModel
    >>> from compas_dem.problem import Problem
    >>> boxes = [Box(1, 1, 1, Frame([0, 0, z], [1, 0, 0], [0, 1, 0])) for z in (0, 1)]
    >>> model = BlockModel.from_boxes(boxes)
    >>> next(iter(model.elements())).is_support = True
    >>> problem = Problem(model)
    >>> problem.set_contact_model("MohrCoulomb", mu=0.6)
    >>> push = problem.add_boundary_condition("push")
    >>> _ = push.add_point_load(1, [1000, 0, 0])
    >>> scene = voussoir.compas.from_problem(problem, live=["push"], density=1000)
    >>> round(voussoir.limit(scene).load_factor.value, 4)
    5.886
    """
    law = problem.contact_properties.contact_model
    if law is None:
        raise InputError("the problem has no contact model", "problem", "problem.set_contact_model")
    live = list(live)
    unknown = set(live) - {condition.name for condition in problem.boundary_conditions}
    if unknown:
        raise InputError(f"no boundary condition is named {sorted(unknown)[0]!r}", "live")
    model = problem.model
    scene = from_assembly(model, density=density, stored_interfaces=stored_interfaces)
    scene.joint(friction=law.mu, cohesion=law.c, tension=law.t_c)
    blocks = {block.graphnode: block for block in model.elements()}
    for condition in problem.boundary_conditions:
        kind: Literal["dead", "live"] = "live" if condition.name in live else "dead"
        for body in condition.body_forces:
            scene.load(kind, acceleration=body.acceleration)
        for at in condition.point_loads:
            scene.load(kind, str(at.block_index), force=at.force, moment=at.moment, at=at.point)
        for face in condition.surface_loads:
            mesh = blocks[face.block_index].modelgeometry
            force = mesh.face_area(face.face_index) * np.array(face.load, dtype=np.float64)
            centre = list(mesh.face_center(face.face_index))
            scene.load(kind, str(face.block_index), force=force, at=centre)
    return scene


def to_results(answer: Answer, problem: Any, certificate: Certificate | None = None) -> Any:
    """An answer as results of compas_dem, under the names that its other solvers use.

    Parameters
    ----------
    answer : Answer
        About a scene that :func:`from_problem` made.
    problem : Problem
        The same problem; it is not changed.
    certificate : Certificate, optional
        Another than the answer's own: ``answer.dry``, ``answer.certificate_at(3)``.

    Returns
    -------
    Results
        Contacts with their forces, N, on edges; on nodes the ``transformation`` by the rates of the
        mechanism, to any common scale; in ``metadata`` the ``verdict`` and ``title``.

    Raises
    ------
    KeyError
        A block of the answer is no node of the model.

    Examples
    --------
    >>> import voussoir
    >>> from compas.geometry import Box, Frame
    >>> from compas_dem.models import BlockModel
    >>> from compas_dem.problem import Problem
    >>> boxes = [Box(1, 1, 1, Frame([0, 0, z], [1, 0, 0], [0, 1, 0])) for z in (0, 1)]
    >>> model = BlockModel.from_boxes(boxes)
    >>> next(iter(model.elements())).is_support = True
    >>> problem = Problem(model)
    >>> problem.set_contact_model("MohrCoulomb", mu=0.6)
    >>> push = problem.add_boundary_condition("push")
    >>> _ = push.add_point_load(1, [1000, 0, 0])
    >>> scene = voussoir.compas.from_problem(problem, density=1000)
    >>> results = voussoir.compas.to_results(voussoir.assess(scene), problem)
    >>> [round(f) + 0 for f in results.resultant_global((0, 1))], results.metadata["verdict"]
    ([-1000, 0, 9810], 'stable')
    """
    from compas_dem.problem.results import Results

    evidence = answer.certificate if certificate is None else certificate
    graph = problem.model.graph
    results = Results(model_id=str(problem.model.guid), problem_id=str(problem.guid))
    make = _contact_class()
    for edge, listed in _contacts(answer, evidence, graph, make, np.eye(3), 1.0).items():
        local, total = np.sum([_resultants(contact) for contact in listed], axis=0)
        kind = {1: "point_contact", 2: "edge_contact"}.get(len(listed[0].points), "face_contact")
        results.set_edge(edge, kind, True)
        results.set_edge(edge, "contact_data", listed[0])
        results.set_edge(edge, "contact_frame", listed[0].frame)
        results.set_edge(edge, "contact_points", [list(p) for c in listed for p in c.points])
        results.set_edge(edge, "contact_polygon", getattr(listed[0], "polygon", None))
        results.set_edge(edge, "resultant_global", total.tolist())
        results.set_edge(edge, "resultant_local", local.tolist())
        results.set_edge(edge, "force_magnitude", float(np.linalg.norm(total)))
    rates, blocks = evidence.rates, answer.blocks
    centres = dict(zip(blocks.ids, blocks.centroid))
    moving = {id: (v, w) for id, v, w in zip(rates.blocks, rates.velocity, rates.spin)}
    for node in graph.nodes():
        velocity, spin = moving.get(str(node), (np.zeros(3), np.zeros(3)))
        motion = _motion(velocity, spin, centres[str(node)])
        results.set_node(node, "transformation", motion)
    results.metadata["verdict"] = None if answer.verdict is None else answer.verdict.value
    results.metadata["title"] = answer.title
    return results


def _resultants(contact: Any) -> Any:
    """The resultant of a contact along the axes of its frame, and along those of the scene."""
    components = [[f["c_u"], f["c_v"], f["c_np"] - f["c_nn"]] for f in contact.forces]
    local = np.sum(components, axis=0)
    frame = contact.frame
    return local, local @ np.array([frame.xaxis, frame.yaxis, frame.zaxis])


def _motion(velocity: Any, spin: Any, centre: Any) -> Any:
    """The rotation by a spin about a centre, and the displacement of that centre."""
    from compas.geometry import Rotation, Transformation, Translation

    turn = Rotation.from_axis_angle_vector(spin.tolist(), point=centre.tolist())
    return Transformation((Translation.from_vector(velocity.tolist()) * turn).matrix)


def solve_problem(
    problem: Any, *, live: Iterable[str] = (), law: Law = "coulomb", **options: Any
) -> Any:
    """Solve a problem of compas_dem in the place of ``problem.solve()``.

    Prescribed displacements and rotations of supports are followed as :func:`voussoir.settle` does;
    else loads in ``live`` are increased as by :func:`voussoir.limit`; else it is assessed.

    Parameters
    ----------
    problem : Problem
        With its model and contact model; it is not changed, and needs no solver.
    live : names of boundary conditions
        Their loads are multiplied by the load factor; all others are dead loads.
    law : {"coulomb", "associative"}
        How joints slide; without effect on displacements.
    **options
        Those of :func:`from_problem`.

    Returns
    -------
    Results
        Those of :func:`to_results`; ``metadata`` has ``load_factor``, or ``falls_at`` as a share of
        the displacements, too.

    Raises
    ------
    InputError
        The problem cannot be used as it is.

    Examples
    --------
    >>> import voussoir
    >>> from compas.geometry import Box, Frame
    >>> from compas_dem.models import BlockModel
    >>> from compas_dem.problem import Problem
    >>> boxes = [Box(1, 1, 1, Frame([0, 0, z], [1, 0, 0], [0, 1, 0])) for z in (0, 1)]
    >>> model = BlockModel.from_boxes(boxes)
    >>> next(iter(model.elements())).is_support = True
    >>> problem = Problem(model)
    >>> problem.set_contact_model("MohrCoulomb", mu=0.6)
    >>> push = problem.add_boundary_condition("push")
    >>> _ = push.add_point_load(1, [1000, 0, 0])
    >>> results = voussoir.compas.solve_problem(problem, live=["push"], density=1000)
    >>> round(results.metadata["load_factor"], 4)
    5.886
    """
    live = list(live)
    scene = from_problem(problem, live=live, **options)
    moves: dict[str, list[float]] = {}
    turns: dict[str, list[float]] = {}
    for condition in problem.boundary_conditions:
        for entry in condition.displacements:
            if hasattr(entry, "translation"):
                moves[str(entry.block_index)] = [x or 0.0 for x in entry.translation]
            else:
                turns[str(entry.block_index)] = [math.degrees(x or 0.0) for x in entry.rotation]
    if moves or turns:
        path = settle(scene, moves, turns_deg=turns)
        results = to_results(path, problem, path.certificate_at(-1))
        results.metadata["falls_at"] = path.falls_at
    elif live:
        found = limit(scene, law=law)
        results = to_results(found, problem)
        results.metadata["load_factor"] = found.load_factor.value
    else:
        results = to_results(assess(scene, law=law), problem)
    results.metadata["mu"] = problem.contact_properties.contact_model.mu
    return results
