"""Certified stability analysis of masonry and granular assemblies of rigid blocks.

>>> import voussoir
>>> scene = voussoir.Scene("Two boxes", friction=0.6, density=2400)
>>> _ = scene.box("ground", (1, 1, 0.2), support=True).box("block", (0.4, 0.4, 1), at=(0, 0, 0.6))
>>> voussoir.assess(scene).verdict.value
'stable'
>>> round(float(voussoir.tilt(scene, toward=(1, 0)).tilt_deg), 3)
21.801

Units are SI (m, kg, s, N), z points up, angles are in degrees where the name says so. Every answer
carries its proof, and numbers are those of the command ``voussoir`` to the last bit.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ._api import *


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
