"""What ``install_in_rhino`` makes known to Rhino."""

from __future__ import annotations

from compas.plugins import plugin


@plugin(category="install")  # type: ignore[untyped-decorator]
def installable_rhino_packages() -> list[str]:
    """The packages of this wheel."""
    return ["voussoir", "compas_voussoir"]
