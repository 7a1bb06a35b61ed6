"""Answers as objects with the names of their keys: what the classes of ``_answer_keys`` share."""

from __future__ import annotations

import typing
from collections.abc import Mapping
from enum import Enum
from types import UnionType
from typing import Any, TypeVar


class Verdict(str, Enum):
    """Does it stand? True for ``stable`` alone.

    Examples
    --------
    >>> import voussoir
    >>> scene = voussoir.Scene(friction=0.6, density=2400).box("ground", (2, 2, 1), support=True)
    >>> verdict = voussoir.assess(scene.box("block", (1, 1, 1), at=(0, 0, 1))).verdict
    >>> verdict is voussoir.Verdict.STABLE, bool(verdict), str(verdict)
    (True, True, 'stable')
    """

    STABLE = "stable"
    """Forces inside the friction cones balance every block, and the loads produce them."""
    CONDITIONAL = "conditional"
    """Such forces exist, but they need self-stress. Not safe."""
    UNSTABLE = "unstable"
    """It falls: proved by a mechanism."""
    UNDECIDED = "undecided"
    """Neither proof closes; see ``answer.doubt``."""

    def __str__(self) -> str:
        return self.value

    def __bool__(self) -> bool:
        """Whether it stands: true for ``stable`` alone."""
        return self is Verdict.STABLE


Self = TypeVar("Self", bound="Record")


class Record:
    """Values under the names of their keys: ``record.key`` or ``record["key"]``."""

    # No dataclasses: a hundred of them take longer to make than all else in the package.

    @classmethod
    def _of(cls: type[Self], data: Mapping[str, Any]) -> Self:
        record = cls.__new__(cls)
        for name, kind in _hints(cls).items():
            record.__dict__[name] = _made(kind, data.get(name))
        return record

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"{type(self).__name__} is only read")

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and other.__dict__ == self.__dict__

    def __hash__(self) -> int:
        return hash(repr(self))

    def __repr__(self) -> str:
        inner = ", ".join(f"{key}={value!r}" for key, value in self.__dict__.items())
        return f"{type(self).__name__}({inner})"

    def __getitem__(self, key: str) -> Any:
        if key not in _hints(type(self)):
            raise KeyError(key)
        return getattr(self, key)

    def to_dict(self) -> dict[str, Any]:
        """The same as plain values."""
        return {key: _plain(value) for key, value in self.__dict__.items()}


class Number(Record):
    """A value with its status."""

    status: str
    value: float | None

    def __float__(self) -> float:
        """The value; infinite where there is no limit, not a number where there is none."""
        if self.value is not None:
            return self.value
        return float("inf") if self.status == "unbounded" else float("nan")


def _plain(value: Any) -> Any:
    if isinstance(value, Record):
        return value.to_dict()
    return [_plain(v) for v in value] if isinstance(value, (list, tuple)) else value


_known: dict[type, dict[str, Any]] = {}


def _hints(cls: type) -> dict[str, Any]:
    """The annotations of a class, which are read once."""
    if cls not in _known:
        hints = typing.get_type_hints(cls)
        _known[cls] = {key: kind for key, kind in hints.items() if not key.startswith("_")}
    return _known[cls]


def _made(kind: Any, value: Any) -> Any:
    """A plain value as what its annotation says; what is left out is empty."""
    origin, inner = typing.get_origin(kind), typing.get_args(kind)
    if origin in (typing.Union, UnionType):
        if value is None:
            return None
        (kind, *others) = [i for i in inner if i is not type(None)]
        return value if others else _made(kind, value)
    if value is None:
        return (origin or kind)() if (origin or kind) in (list, dict, bool) else None
    if origin is list:
        return [_made(inner[0], v) for v in value]
    if origin is tuple:
        return tuple(_made(i, v) for i, v in zip(inner, value))
    if isinstance(kind, type) and issubclass(kind, Record):
        return kind._of(value)
    return kind(value) if kind is Verdict else value


class Keys:
    """Part of an answer whose values stand under its keys."""

    _place: str | None = None
    """The key of the answer that holds them, where they do not stand in the answer itself."""


class _Field(property):
    """A key of an answer as an attribute."""

    def __init__(self, doc: str, within: str | None, key: str | None) -> None:
        super().__init__(self._read)
        self.__doc__ = doc
        self._within, self._key = within, key

    def __set_name__(self, owner: type, name: str) -> None:
        self._owner, self._name = owner, name

    def _read(self, answer: Any) -> Any:
        made: dict[str, Any] = answer.__dict__.setdefault("_fields", {})
        if self._name not in made:
            data = answer._answer
            for step in (answer._place, self._within):
                data = data if step is None else data.get(step) or {}
            kind = _hints(self._owner)[self._name]
            made[self._name] = _made(kind, data.get(self._key or self._name))
        return made[self._name]


def field(doc: str, *, within: str | None = None, key: str | None = None) -> Any:
    """A key of an answer, with what it means."""
    return _Field(doc, within, key)
