"""Exceptions and warnings."""

from __future__ import annotations


class VoussoirError(Exception):
    """There is no answer: the system refuses, or something cannot be done.

    Examples
    --------
    >>> import voussoir
    >>> scene = voussoir.Scene(friction=0.6, density=2400).box("ground", (1, 1, 1), support=True)
    >>> answer = voussoir.assess(scene.box("block", (1, 1, 1), at=(0, 0, 1)))
    >>> try:
    ...     answer.table("nothing")
    ... except voussoir.VoussoirError as error:
    ...     print(error)
    there is no table nothing; the tables are joints, blocks, members and path
    """


class InputError(VoussoirError, ValueError):
    """A scene, a plan or an option that cannot be used as it is.

    Attributes
    ----------
    message : str
        What is wrong, with the offending value.
    path : str
        The place inside the scene, such as ``blocks[3].density``; empty where it is about the whole.
    remedy : str or None
        What to do.
    file : str or None
        The file, where there is one.
    line, column : int or None
        The place in the file, counted from 1.

    Examples
    --------
    >>> import voussoir
    >>> try:
    ...     voussoir.Scene().box("block", (1, 1, 1), at=(0, 0, float("nan")))
    ... except voussoir.InputError as error:
    ...     print(error.path, "|", error.message)
    blocks[0].at[2] | must be a finite number
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
    """There was no time for any answer within ``time_limit``.

    Mostly a time limit leaves an answer that is ``undecided``, with the best bracket so far.

    Examples
    --------
    >>> import voussoir
    >>> issubclass(voussoir.TimeIsUp, TimeoutError)
    True
    """


class SceneWarning(UserWarning):
    """Numbers, axes or loads that look as if another scene were meant, or contacts that were left
    out and change the answer.

    Examples
    --------
    >>> import voussoir, warnings
    >>> scene = voussoir.Scene(friction=0.6, density=2400, gravity=(0, 0, 9.81))
    >>> scene = scene.box("ground", (1, 1, 1), support=True).box("block", (1, 1, 1), at=(0, 0, 1))
    >>> with warnings.catch_warnings(record=True) as caught:
    ...     warnings.simplefilter("always")
    ...     _ = voussoir.assess(scene)
    >>> caught[0].category.__name__
    'SceneWarning'
    """
