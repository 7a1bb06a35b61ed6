"""Tells whether things made of rigid pieces that only touch stand or fall, and proves it.

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

from ._answers import (
    Answer,
    Assessment,
    Blocks,
    Bound,
    Bracket,
    Certificate,
    Critical,
    CriticalValue,
    Doubt,
    Finding,
    Forces,
    JointMotion,
    Limit,
    LoadFactor,
    Mechanism,
    Packing,
    Path,
    Rates,
    Simulation,
    Thrust,
    Tilt,
    Verdict,
    Verification,
)
from ._ask import (
    assess,
    critical,
    limit,
    load_answer,
    push,
    repose,
    settle,
    simulate,
    thrust,
    tilt,
)
from ._core import __version__
from ._errors import InputError, SceneWarning, TimeIsUp, VoussoirError
from ._many import Heaps, Inspection, Many, Sweep, assess_many, check, heaps, sweep
from ._scene import Scene, load, load_foreign

__all__ = [
    "Answer",
    "Assessment",
    "Blocks",
    "Bound",
    "Bracket",
    "Certificate",
    "Critical",
    "CriticalValue",
    "Doubt",
    "Finding",
    "Forces",
    "Heaps",
    "InputError",
    "Inspection",
    "JointMotion",
    "Limit",
    "LoadFactor",
    "Many",
    "Mechanism",
    "Packing",
    "Path",
    "Rates",
    "Scene",
    "SceneWarning",
    "Simulation",
    "Sweep",
    "Thrust",
    "Tilt",
    "TimeIsUp",
    "Verdict",
    "Verification",
    "VoussoirError",
    "__version__",
    "assess",
    "assess_many",
    "check",
    "critical",
    "heaps",
    "limit",
    "load",
    "load_answer",
    "load_foreign",
    "push",
    "repose",
    "settle",
    "simulate",
    "sweep",
    "thrust",
    "tilt",
]
