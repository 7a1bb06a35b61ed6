"""What COMPAS finds of voussoir: it looks for plugins in packages of this name.

The functions are in :mod:`voussoir.compas`.
"""

from voussoir import __version__

__all__ = ["__version__"]
__all_plugins__ = ["compas_voussoir.install"]
