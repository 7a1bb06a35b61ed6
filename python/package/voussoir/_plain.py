"""Plain values: what JSON has."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Sequence
from typing import Any, ClassVar, TypeAlias

import numpy as np
import numpy.typing as npt

Vector: TypeAlias = Sequence[float] | npt.NDArray[np.float64]
"""Three numbers, or as many as a key asks for."""


class Value:
    """An object of a scene. Keys that are left out are absent."""

    _tag: ClassVar[str | None] = None
    """Of one kind among several: the key that names it."""
    _under: ClassVar[str | None] = None
    """Where it goes in a scene."""

    def _given(self) -> dict[str, Any]:
        """The keys that do not have their default."""
        listed = dataclasses.fields(self)  # type: ignore[arg-type]
        values = {f.name: getattr(self, f.name) for f in listed}
        return {f.name: values[f.name] for f in listed if values[f.name] is not f.default}

    def to_dict(self) -> dict[str, Any]:
        """What stands in the file of a scene, as plain values."""
        plain: dict[str, Any] = json.loads(text(self))
        return plain

    def __repr__(self) -> str:
        inner = ", ".join(f"{key}={value!r}" for key, value in self._given().items())
        return f"{type(self).__name__}({inner})"

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and text(other) == text(self)

    def __hash__(self) -> int:
        return hash(text(self))


def _one(value: Any) -> Any:
    """What numpy and its like have to say as plain values."""
    if isinstance(value, Value):
        return value._given() if value._tag is None else {value._tag: value._given()}
    if hasattr(value, "tolist"):
        return value.tolist()
    if hasattr(value, "__iter__"):
        return list(value)
    raise TypeError(f"a {type(value).__name__} has no place in a scene")


def text(value: Any) -> str:
    """JSON text of a value; arrays become lists."""
    return json.dumps(value, default=_one)
