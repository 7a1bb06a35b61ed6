"""Exceptions and warnings."""

from __future__ import annotations


class VoussoirError(Exception):
    """There is no answer: the system refuses, or something cannot be done."""


class InputError(VoussoirError, ValueError):
    """A scene, a plan or an option that cannot be used as it is.

    Attributes
    ----------
    message : str
        What is wrong, with the offending value.
    path : str
        The place inside the scene, such as ``blocks[3].density``; empty where it is about the whole.
    remedy : str or None
        What to do about it.
    file : str or None
        The file, where there is one.
    line, column : int or None
        The place in the file, counted from 1.
    """

    def __init__(
        self,
        message: str,
        path: str = "",
        remedy: str | None = None,
        file: str | None = None,
        line: int | None = None,
        column: int | None = None,
    ) -> None:
        super().__init__(message, path, remedy, file, line, column)
        self.message = message
        self.path = path
        self.remedy = remedy
        self.file = file
        self.line = line
        self.column = column

    @property
    def place(self) -> str:
        """``file:line:column``, as far as they are known."""
        parts = [self.file, self.line, self.column]
        return ":".join(str(part) for part in parts if part is not None)

    def __str__(self) -> str:
        words = ": ".join(part for part in (self.place, self.path, self.message) if part)
        return f"{words}; hint: {self.remedy}" if self.remedy else words


class TimeIsUp(VoussoirError, TimeoutError):
    """Nothing came out within ``time_limit``."""


class SceneWarning(UserWarning):
    """Numbers, axes or loads that look as if another scene were meant, or contacts that were left
    out and change the answer. Said once a place in the code, as Python's warnings are."""
