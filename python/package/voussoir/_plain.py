"""Plain values: what JSON has."""

from __future__ import annotations

import json
from typing import Any


def _one(value: Any) -> Any:
    """What numpy and its like have to say as plain values."""
    if hasattr(value, "tolist"):
        return value.tolist()
    if hasattr(value, "__iter__"):
        return list(value)
    raise TypeError(f"a {type(value).__name__} has no place in a scene")


def text(value: Any) -> str:
    """JSON text of a value; arrays become lists."""
    return json.dumps(value, default=_one)


def without_none(**values: Any) -> dict[str, Any]:
    """Those values that are given."""
    return {key: value for key, value in values.items() if value is not None}
