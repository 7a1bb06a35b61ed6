"""To and from COMPAS, with its real packages."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import voussoir
from conftest import ROOT

compas = pytest.importorskip("compas", reason="compas is not installed")
DATA = ROOT / "tests" / "cases" / "compas"


def column(count: int = 3) -> list[Any]:
    from compas.geometry import Box, Frame

    frames = [Frame([0.05 * k, 0, k], [1, 0, 0], [0, 1, 0]) for k in range(count)]
    return [Box(1, 1, 1, frame) for frame in frames]


def carried(listed: list[Any]) -> np.ndarray[Any, Any]:
    """The force on the second block of interfaces, from what compas_cra would read of them."""
    total = np.zeros(3)
    for interface in listed:
        frame = interface.frame
        for force in interface.forces:
            total += np.array(frame.zaxis) * (force["c_np"] - force["c_nn"])
            total += np.array(frame.xaxis) * force["c_u"] + np.array(frame.yaxis) * force["c_v"]
    return total


def test_an_assembly_there_and_back() -> None:
    pytest.importorskip("compas_assembly", reason="compas_assembly is not installed")
    from compas_assembly.datastructures import Assembly, Block, Interface
    from voussoir.compas import from_assembly, solve, to_assembly

    assembly = Assembly("Column")
    for k, box in enumerate(column()):
        assembly.add_block(Block.from_shape(box), node=k, is_support=k == 0)
    # Against the order of the blocks, to be turned.
    assembly.graph.add_edge(2, 1)
    scene = from_assembly(assembly, friction=0.6, density=1000)
    assert scene.name == "Column"
    answer = voussoir.assess(scene)
    assert answer.verdict is voussoir.Verdict.STABLE
    assert to_assembly(answer, assembly) is assembly
    lower = assembly.graph.edge_attribute((0, 1), "interfaces")
    upper = assembly.graph.edge_attribute((2, 1), "interfaces")
    assert all(isinstance(i, Interface) and len(i.points) == len(i.forces) for i in lower + upper)
    np.testing.assert_allclose(carried(lower), [0, 0, 2 * 9810], atol=1e-6)
    np.testing.assert_allclose(carried(upper), [0, 0, -9810], atol=1e-6)
    assert not assembly.graph.has_edge((1, 2))
    assert all(f["c_np"] >= 0 and f["c_nn"] == 0 for i in lower + upper for f in i.forces)
    # What its viewers draw.
    (line,) = lower[0].resultantforce
    assert line.length == pytest.approx(2 * 9810)
    assert assembly.graph.node_attribute(1, "displacement") == [0.0] * 6
    # Its own file, and through it a remote procedure call.
    again = solve(compas.json_loads(compas.json_dumps(assembly)), friction=0.6, density=1000)
    assert again.attributes["voussoir"]["verdict"] == "stable"


def test_a_mechanism_is_a_displacement() -> None:
    pytest.importorskip("compas_assembly", reason="compas_assembly is not installed")
    from compas.geometry import Box, Frame
    from compas_assembly.datastructures import Assembly, Block
    from voussoir.compas import from_assembly, to_assembly

    assembly = Assembly()
    for k, x in enumerate((0.0, 0.7)):
        box = Box(1, 1, 1, Frame([x, 0, k], [1, 0, 0], [0, 1, 0]))
        assembly.add_block(Block.from_shape(box), node=k, is_support=k == 0)
    answer = voussoir.assess(from_assembly(assembly, friction=0.9, density=1000))
    assert answer.verdict is voussoir.Verdict.UNSTABLE
    to_assembly(answer, assembly, magnify=0.1)
    moved = np.array(assembly.graph.node_attribute(1, "displacement"))
    assert moved[2] < 0 and moved[4] > 0, "down, and about the edge towards x"
    rates = answer.certificate.rates
    np.testing.assert_array_equal(moved, 0.1 * np.hstack([rates.velocity[0], rates.spin[0]]))


@pytest.mark.parametrize("up", ["x", "y", "z", "-x", "-y", "-z"])
def test_answers_come_back_in_the_units_and_axes_of_the_assembly(up: Any) -> None:
    pytest.importorskip("compas_assembly", reason="compas_assembly is not installed")
    from compas.geometry import Box, Frame
    from compas_assembly.datastructures import Assembly, Block
    from voussoir.compas import ROTATIONS, from_assembly, to_assembly

    rotation = np.array(ROTATIONS[up], dtype=float)
    assert np.allclose(rotation @ rotation.T, np.eye(3)) and np.linalg.det(rotation) == 1
    upwards = rotation.T @ [0, 0, 1]
    sideways = rotation.T @ [1, 0, 0]

    def stacked(shift: float) -> Any:
        assembly = Assembly()
        for k in range(2):
            at = 1000 * k * upwards + shift * k * sideways
            box = Box(1000, 1000, 1000, Frame(at.tolist(), [1, 0, 0], [0, 1, 0]))
            assembly.add_block(Block.from_shape(box), node=k, is_support=k == 0)
        return assembly

    assembly = stacked(0)
    scene = from_assembly(assembly, scale=0.001, up=up, friction=0.6, density=1000)
    answer = voussoir.assess(scene)
    to_assembly(answer, assembly, scale=0.001, up=up)
    (interface,) = assembly.graph.edge_attribute((0, 1), "interfaces")
    np.testing.assert_allclose(carried([interface]), 9810 * upwards, atol=1e-6)
    np.testing.assert_allclose(np.mean(interface.points, axis=0), 500 * upwards, atol=1e-6)
    assert interface.size == pytest.approx(1e6)
    # What falls over does so in the axes of the assembly, and in its unit of length.
    assembly = stacked(700)
    falls = voussoir.assess(from_assembly(assembly, scale=0.001, up=up, friction=0.6, density=1000))
    to_assembly(falls, assembly, scale=0.001, up=up)
    moved = np.array(assembly.graph.node_attribute(1, "displacement")[:3])
    assert moved @ upwards < 0
    rates = falls.certificate.rates
    np.testing.assert_allclose(rotation @ moved, 1000 * rates.velocity[0], atol=1e-9)


def test_plain_meshes() -> None:
    from compas.datastructures import Mesh
    from voussoir.compas import from_assembly

    meshes = [Mesh.from_shape(box) for box in column()]
    scene = from_assembly(meshes, supports=[0], friction=0.6, density=1000, name="Meshes")
    assert scene.name == "Meshes" and voussoir.assess(scene).verdict
    with pytest.raises(voussoir.InputError):
        from_assembly(meshes, supports=["nothing"], friction=0.6)


def test_a_block_model_there_and_back() -> None:
    pytest.importorskip("compas_dem", reason="compas_dem is not installed")
    from compas_dem.interactions import FrictionContact
    from compas_dem.models import BlockModel
    from voussoir.compas import from_assembly, to_assembly

    model = BlockModel.from_boxes(column())
    next(iter(model.elements())).is_support = True
    answer = voussoir.assess(from_assembly(model, friction=0.6, density=1000))
    assert answer.verdict is voussoir.Verdict.STABLE
    to_assembly(answer, model)
    contacts = list(model.contacts())
    assert len(contacts) == 2 and all(isinstance(c, FrictionContact) for c in contacts)
    forces = sorted(carried([c])[2] for c in contacts)
    np.testing.assert_allclose(np.abs(forces), [9810, 2 * 9810], rtol=1e-9)


def test_problems_of_compas_dem() -> None:
    pytest.importorskip("compas_dem", reason="compas_dem is not installed")
    from compas_dem.material import Stone
    from compas_dem.models import BlockModel
    from compas_dem.problem import Problem
    from voussoir.compas import from_problem, solve_problem

    model = BlockModel.from_boxes(column())
    next(iter(model.elements())).is_support = True
    stone = Stone(density=1000.0)
    model.add_material(stone)
    model.assign_material(stone, elements=list(model.elements()))
    problem = Problem(model)
    with pytest.raises(voussoir.InputError, match="contact model"):
        solve_problem(problem)
    problem.set_contact_model("MohrCoulomb", mu=0.6)
    weight = solve_problem(problem)
    assert weight.metadata["verdict"] == "stable" and weight.metadata["mu"] == 0.6
    np.testing.assert_allclose(weight.resultant_global((0, 1)), [0, 0, 2 * 9810], atol=1e-6)
    assert weight.resultant_local((0, 1))[2] == pytest.approx(2 * 9810)
    assert weight.face_contact((0, 1)) and weight.displacement(2) == [0, 0, 0]

    # All kinds of loads.
    loads = problem.add_boundary_condition("loads")
    loads.add_point_load(2, [0, 0, -9810])
    mesh = list(model.elements())[2].modelgeometry
    top = max(mesh.faces(), key=lambda face: mesh.face_center(face)[2])
    loads.add_surface_load(2, top, [0, 0, -9810])
    loads.add_global_body_force(0, 0, 1.0)
    np.testing.assert_allclose(
        solve_problem(problem).resultant_global((1, 2)), [0, 0, 3 * 9810 - 1000], atol=1e-6
    )
    push = problem.add_boundary_condition("push")
    push.add_point_load(2, [1000, 0, 0])
    pushed = solve_problem(problem, live=["push"])
    scene = from_problem(problem, live=["push"])
    factor = voussoir.limit(scene).load_factor.value
    assert factor is not None and pushed.metadata["load_factor"] == factor > 0
    with pytest.raises(voussoir.InputError) as caught:
        solve_problem(problem, live=["pull"])
    assert caught.value.path == "live"
    # It survives COMPAS's own files.
    again = compas.json_loads(compas.json_dumps(pushed))
    assert again.metadata["title"] == pushed.metadata["title"]
    assert again.resultant_global((0, 1)) == pushed.resultant_global((0, 1))

    lowered = Problem(model)
    lowered.set_contact_model("MohrCoulomb", mu=0.6)
    settling = lowered.add_boundary_condition("settlement")
    settling.add_displacement(0, 0, 0, -0.1)
    settling.add_rotation(0, [0, 0.5, 0])
    tipped = solve_problem(lowered)
    # It slides, or its joints open, at some share of half a radian.
    assert 0 < tipped.metadata["falls_at"] < 1


def test_the_plugin_is_found() -> None:
    from compas.plugins import plugin_manager

    plugin_manager.load_plugins()
    found = [p.id for listed in plugin_manager.registry.values() for p in listed]
    assert "compas_voussoir.install.installable_rhino_packages" in found


@pytest.mark.filterwarnings("ignore")
def test_the_armadillo_vault() -> None:
    pytest.importorskip("compas_assembly", reason="compas_assembly is not installed")
    from voussoir.compas import from_assembly, to_assembly

    start = time.perf_counter()
    assembly = compas.json_load(DATA / "cra-armadillo.json")
    supports = [*range(8), *range(79, 89), *range(217, 228), *range(328, 332)]
    scene = from_assembly(assembly, friction=0.84, density=2400, supports=supports)
    answer = voussoir.assess(scene, law="associative")
    to_assembly(answer, assembly)
    print(f"Armadillo Vault, from file to forces on edges: {time.perf_counter() - start:.2f} s")
    assert answer.verdict is voussoir.Verdict.STABLE
    edges = [e for e in assembly.graph.edges() if assembly.graph.edge_attribute(e, "interfaces")]
    assert len(edges) > 900
    held = {str(node) for node in supports}
    up = 0.0
    for u, v in edges:
        if (str(u) in held) != (str(v) in held):
            sign = 1.0 if str(u) in held else -1.0
            up += sign * carried(assembly.graph.edge_attribute((u, v), "interfaces"))[2]
    free = ~answer.blocks.supports
    assert up == pytest.approx(answer.blocks.mass[free].sum() * 9.81, rel=1e-6)
