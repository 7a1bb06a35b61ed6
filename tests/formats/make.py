"""Write the drawings that the tests of importers read, with a writer that is not ours: ``python make.py``,
with ezdxf installed (1.4)."""

import math
from pathlib import Path

import ezdxf
from ezdxf import units

HERE = Path(__file__).resolve().parent


def drawing(version: str, unit: int):
    doc = ezdxf.new(version)
    doc.units = unit
    for name in ("STONE", "GROUND"):
        doc.layers.add(name)
    return doc, doc.modelspace()


def box(space, x: float, y: float, wide: float, high: float, layer: str, close: bool = True) -> None:
    corners = [(x, y), (x + wide, y), (x + wide, y + high), (x, y + high)]
    attributes = {"layer": layer}
    if space.doc.dxfversion == "AC1009":
        space.add_polyline2d(corners, close=close, dxfattribs=attributes)
    else:
        space.add_lwpolyline(corners, close=close, dxfattribs=attributes)


def wall(space, size: float) -> None:
    """Three courses of bricks of 2 x 1 on a base, half a brick of bond."""
    box(space, 0, -size, 8 * size, size, "GROUND")
    for course in range(3):
        for k in range(3):
            box(space, (course % 2 + 2 * k) * size, course * size, 2 * size, size, "STONE")


def arch(space, voussoirs: int = 9, inner: float = 4.0, outer: float = 5.0) -> None:
    """A semicircular arch whose faces are arcs."""
    step = math.pi / voussoirs
    bulge = math.tan(step / 4)
    for k in range(voussoirs):
        a, b = k * step, (k + 1) * step
        at = lambda r, t: (r * math.cos(t), r * math.sin(t))
        corners = [(*at(inner, b), -bulge), (*at(inner, a), 0), (*at(outer, a), bulge), (*at(outer, b), 0)]
        space.add_lwpolyline(corners, format="xyb", close=True, dxfattribs={"layer": "STONE"})
    for side in (-1, 1):
        box(space, min(side * inner, side * outer), -1, outer - inner, 1, "GROUND")


for name, version, unit, draw in [
    ("wall-2010-mm.dxf", "R2010", units.MM, lambda s: wall(s, 200)),
    ("wall-r12.dxf", "R12", 0, lambda s: wall(s, 0.2)),
    ("arch-2018-m.dxf", "R2018", units.M, arch),
]:
    doc, space = drawing(version, unit)
    draw(space)
    doc.saveas(HERE / name)

# A brick left open, one drawn twice, what is no block.
doc, space = drawing("R2000", units.CM)
wall(space, 20)
box(space, 300, 0, 40, 20, "STONE", close=False)
box(space, 0, 0, 40, 20, "STONE")
space.add_text("section A-A")
space.add_line((0, 0), (160, 0))
space.add_hatch().paths.add_polyline_path([(0, 0), (40, 0), (40, 20)])
doc.saveas(HERE / "faults-2000-cm.dxf")


def cube(x: float, y: float, z: float, size: tuple) -> tuple:
    corners = [
        (x + size[0] * (k & 1), y + size[1] * (k >> 1 & 1), z + size[2] * (k >> 2 & 1)) for k in range(8)
    ]
    rings = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return corners, rings


# A trilithon in space: piers of loose faces, a lintel as a polyface mesh, the ground inserted; binary.
doc, space = drawing("R2013", units.M)
for x in (0, 2):
    corners, rings = cube(x, 0, 0, (0.5, 0.5, 2))
    for ring in rings:
        space.add_3dface([corners[k] for k in ring], dxfattribs={"layer": "STONE"})
corners, rings = cube(0, 0, 2, (2.5, 0.5, 0.5))
mesh = space.add_polyface(dxfattribs={"layer": "STONE"})
mesh.append_faces([[corners[k] for k in ring] for ring in rings])
slab = doc.blocks.new("SLAB", base_point=(0, 0, 0))
corners, rings = cube(0, 0, -1, (1, 1, 1))
for ring in rings:
    slab.add_3dface([corners[k] for k in ring])
space.add_blockref("SLAB", (-0.5, -0.25, 0), dxfattribs={"layer": "GROUND", "xscale": 3.5})
doc.saveas(HERE / "trilithon-2013-m.dxf", fmt="bin")

# A wall of bricks that are all one block, with joints of mortar of 10 mm; the base is mirrored.
doc, space = drawing("R2007", units.MM)
brick = doc.blocks.new("BRICK")
box(brick, 0, 0, 240, 65, "0")
for course in range(3):
    for k in range(3):
        space.add_blockref("BRICK", (125 * (course % 2) + 250 * k, 75 * course), dxfattribs={"layer": "BRICK"})
base = doc.blocks.new("BASE")
box(base, 0, 0, 900, 100, "0")
space.add_blockref("BASE", (900, -10), dxfattribs={"layer": "GROUND", "xscale": -1, "yscale": -1})
doc.saveas(HERE / "mortar-2007-mm.dxf")

# R12, binary; an insert of a block that is not there, a face that is missing.
doc, space = drawing("R12", 0)
for k, (x, faces) in enumerate([(0, 6), (3, 5)]):
    corners, rings = cube(x, 0, 0, (1, 1, 1))
    for ring in rings[:faces]:
        space.add_3dface([corners[k] for k in ring], dxfattribs={"layer": "STONE"})
space.add_blockref("LOST", (0, 0))
doc.saveas(HERE / "faults-r12-binary.dxf", fmt="bin")


def picture(name: str, width: str, height: str, box: str):
    """A drawing of svgwrite with a group a layer."""
    import svgwrite

    page = svgwrite.Drawing(HERE / name, size=(width, height), viewBox=box, profile="full")
    groups = {layer: page.add(page.g(id=layer)) for layer in ("stone", "ground")}
    return page, groups


# Sections in millimetres at 1 : 20, in centimetres, in pixels; each as rectangles, polygons or paths.
page, layers = picture("piers-mm.svg", "200mm", "150mm", "0 0 4000 3000")
for x in (500, 2500):
    layers["stone"].add(page.rect((x, 1000), (500, 1900)))
layers["stone"].add(page.polygon([(500, 1000), (3000, 1000), (3000, 600), (500, 600)]))
layers["ground"].add(page.rect((0, 2900), (4000, 100)))
page.save()

page, layers = picture("arch-cm.svg", "60cm", "40cm", "0 0 60 40")
at = lambda r, t: (30 + r * math.cos(t), 35 - r * math.sin(t))
for k in range(7):
    a, b = k * math.pi / 7, (k + 1) * math.pi / 7
    path = page.path(d=("M", *at(20, a)))
    path.push_arc(at(20, b), 0, 20, large_arc=False, angle_dir="-", absolute=True)
    path.push("L", *at(25, b))
    path.push_arc(at(25, a), 0, 25, large_arc=False, angle_dir="+", absolute=True)
    path.push("Z")
    layers["stone"].add(path)
for x in (5, 50):
    layers["ground"].add(page.rect((x, 35), (5, 5)))
page.save()

page, layers = picture("turned-mm.svg", "100mm", "100mm", "0 0 100 100")
turned = layers["stone"].add(page.g(transform="translate(50 80) rotate(-90) scale(2)"))
turned.add(page.rect((0, -10), (10, 20)))
layers["ground"].add(page.polyline([(10, 80), (90, 80), (90, 95), (10, 95), (10, 80)]))
page.save()

# Without a unit; a path left open, one drawn twice, what is no outline.
page, layers = picture("faults-px.svg", "400", "300", "0 0 400 300")
for _ in range(2):
    layers["stone"].add(page.rect((100, 100), (50, 50)))
layers["stone"].add(page.path(d="M 10 10 L 40 10 L 40 30"))
layers["stone"].add(page.text("A-A", insert=(5, 5)))
layers["ground"].add(page.rect((0, 150), (400, 20)))
page.save()

# Round corners and a hidden layer; a stone that is not where its neighbours are.
page, layers = picture("faults-hidden-mm.svg", "400mm", "300mm", "0 0 400 300")
layers["stone"].add(page.rect((100, 100), (50, 50)))
layers["stone"].add(page.rect((200, 100), (50, 50), rx=5, ry=5))
old = page.add(page.g(id="old", style="display:none"))
old.add(page.rect((100, 100), (60, 60)))
layers["ground"].add(page.rect((0, 150), (400, 20)))
page.save()

page, layers = picture("faults-empty-mm.svg", "400mm", "300mm", "0 0 400 300")
layers["stone"].add(page.line((0, 0), (10, 10)))
page.save()
