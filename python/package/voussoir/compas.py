"""To and from COMPAS: assemblies of compas_assembly and compas_cra, block models of compas_dem,
plain meshes.

Forces come back under the names that compas_cra writes, so that its viewers show them: on every
edge ``interfaces`` (``contacts`` of a block model) with ``forces`` of ``c_np``, ``c_nn``, ``c_u``,
``c_v`` at their corners, on every node ``displacement``: velocity and spin of the mechanism.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from typing import Any, Literal

import numpy as np

from . import _core
from ._answers import Answer, Assessment, Certificate
from ._ask import Law, assess
from ._scene import Friction, Scene

__all__ = ["from_assembly", "solve", "to_assembly"]


def from_assembly(
    assembly: Any,
    *,
    supports: Iterable[Any] = (),
    support_below: float | None = None,
    friction: Friction | None = None,
    density: float | None = None,
    scale: float = 1.0,
    up: Literal["x", "y", "z", "-x", "-y", "-z"] = "z",
    gap: float | None = None,
    angle_deg: float | None = None,
    stored_interfaces: bool = True,
    name: str | None = None,
) -> Scene:
    """A scene of an assembly.

    Parameters
    ----------
    assembly
        An ``Assembly`` or ``CRA_Assembly``, a ``BlockModel``, meshes (a list, nested as you like),
        or the path of a file that ``compas.json_dump`` wrote.
    supports : nodes, or places in the list of meshes
        Held in place, beside those that the assembly names.
    friction : float or "infinite"
        Of every joint.
    density : float
        kg/m³, in place of what the assembly says.
    stored_interfaces : bool
        Keep the assembly's own in place of contacts that are detected.

    Other parameters are those of :func:`voussoir.load_foreign`. The id of a block is its node, or
    its place in the list.
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
) -> Any:
    """Write the forces and the mechanism of an answer on the edges and nodes of its assembly.

    Parameters
    ----------
    answer
        About a scene that :func:`from_assembly` made, without ``scale`` and ``up``.
    assembly
        The same assembly or block model; it is changed and returned.
    certificate : Certificate, optional
        Another than the answer's own: ``answer.dry``, ``answer.certificate_at(3)``.
    scale : float
        Multiplies velocities and spins.

    Edges that are missing are added, interfaces that were there are replaced. Compression is
    ``c_np``; forces act on the second node of an edge, along the axes of the interface's frame.
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
    found: dict[tuple[Any, Any], list[Any]] = {}
    forces = evidence.forces
    axes, areas = answer.axes, answer.areas
    for k, ((a, b), points, own) in enumerate(forces):
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
        found.setdefault(edge, []).append(
            make(points.tolist(), frame.tolist(), float(areas[k]), components)
        )
    for edge, listed in found.items():
        if not graph.has_edge(edge):
            graph.add_edge(*edge)
        graph.edge_attribute(edge, attribute, listed)
        if not is_model:
            # Where older viewers look.
            graph.edge_attribute(edge, "interface", listed[0])
    rates = evidence.rates
    motion = scale * np.hstack([rates.velocity, rates.spin]) if rates.blocks else np.zeros((0, 6))
    moving = dict(zip(rates.blocks, motion.tolist()))
    for key, node in nodes.items():
        graph.node_attribute(node, "displacement", moving.get(key, [0.0] * 6))
    return assembly


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
    """Assess an assembly and write the answer on it: what a remote procedure call needs, with
    nothing but COMPAS data in and out (``compas.rpc.Proxy("voussoir.compas").solve(assembly)``).

    ``options`` are those of :func:`from_assembly`. ``assembly.attributes`` gets ``voussoir``:
    ``verdict``, ``equilibrium_error`` and the first line of the answer.
    """
    answer: Assessment = assess(from_assembly(assembly, **options), law=law)
    to_assembly(answer, assembly)
    assembly.attributes["voussoir"] = {
        "verdict": answer.verdict.value,
        "equilibrium_error": [answer.equilibrium_error.lower, answer.equilibrium_error.upper],
        "title": answer.title,
    }
    return assembly
