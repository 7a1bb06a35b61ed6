"""Certified stability analysis of masonry and granular assemblies of rigid blocks.

**A scene** is built of blocks, of templates, or read from a file. Units are SI (m, kg, s, N), z
points up, angles are in degrees where the name says so.

>>> import voussoir
>>> arch = voussoir.Scene("Arch", friction=0.7, density=2400)
>>> arch.add(voussoir.Arch(radius=1, thickness=0.15, depth=1, voussoirs=27))
<voussoir.Scene 'Arch': 0 blocks, 1 template>
>>> table = voussoir.Scene("Table", friction=0.6, density=2400)
>>> table.box("ground", (1, 1, 0.2), support=True).box("block", (0.4, 0.4, 1), at=(0, 0, 0.6))
<voussoir.Scene 'Table': 2 blocks>

:class:`Scene` has ``box``, ``polyhedron``, ``joint``, ``load``, ``member``, ``add``; :func:`load`
reads scene files, :func:`import_file` COMPAS, OBJ, PLY and STL, :mod:`voussoir.compas` assemblies.
What a scene may hold has a class with the keys of its file: :class:`Block`; the templates
:class:`Arch`, :class:`Barrel`, :class:`Bridge`, :class:`Column`, :class:`Dome`, :class:`FlatArch`,
:class:`Groin`, :class:`Lattice`, :class:`Leaves`, :class:`Portal`, :class:`Stack`, :class:`Tower`,
:class:`Wall`; :class:`Member`, :class:`Load`, :class:`Stage`, :class:`Train`, :class:`Site`.

**A question** is a function.

>>> answer = voussoir.assess(arch)                   # does it stand?
>>> answer.verdict.value
'stable'
>>> pushed = voussoir.limit(arch.load("live", weight=(1, 0, 0)))
>>> bool(pushed.load_factor.lower <= pushed.load_factor.value <= pushed.load_factor.upper)
True
>>> round(voussoir.tilt(table, toward=(1, 0)).tilt_deg.value, 3)
21.801

* stability: :func:`assess`, :func:`limit`, :func:`moving`, :func:`tilt`, :func:`critical`,
  :func:`thrust`, :func:`without`, :func:`stages`, :func:`repose`
* what is required: :func:`combinations` of actions, :func:`meet`
* movements: :func:`settle`, :func:`push`, :func:`kinematic`, :func:`state`
* in time, as a second opinion: :func:`simulate`, :func:`shake`
* many scenes: :func:`sweep`, :func:`assess_many`, :class:`Piles`, :func:`heaps`

**An answer** prints as the command prints it and carries its proof. Its values are attributes with
the names of the keys in result files; forces are arrays of numpy.

>>> print(answer.title)
Arch: stands
>>> answer.forces.shape, answer.joints[0]            # N, on the second block of each joint
((112, 3), ('v00', 'v01'))
>>> proof = voussoir.check(answer)                   # verified from the scene alone
>>> bool(proof)
True

``answer.plot()`` draws it with matplotlib, ``answer.show()`` shows its page, ``answer.to_frame()``
is a table of pandas, ``answer.report("page.html")`` and ``answer.save("result.json")`` write files;
:func:`load_answer` reads one.

Errors are :class:`VoussoirError`; those of the input are :class:`InputError` with place and remedy.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ._api import *
    from ._scene_keys import *


def __getattr__(name: str) -> Any:
    """What the package shows, with numpy, once it is asked for: the command needs neither."""
    from importlib import import_module

    api = import_module("._api", __name__)
    try:
        value = getattr(api, name)
    except AttributeError:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}") from None
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    from ._api import __all__

    return sorted(__all__)
