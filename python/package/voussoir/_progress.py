"""Progress: a callback, or a bar of tqdm where it is installed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

Tell = Callable[[float, float, str], object]


@contextmanager
def shown(progress: Tell | bool) -> Iterator[Tell | None]:
    """What is called while work goes on."""
    if progress is False:
        yield None
        return
    if progress is not True:
        if not callable(progress):
            raise TypeError(f"progress is a function or a bool, not {progress!r}")
        yield progress
        return
    try:
        from tqdm.auto import tqdm
    except ImportError:
        # Asked for, and there is nothing to show it with.
        yield None
        return
    bar: Any = tqdm(total=1.0, bar_format="{l_bar}{bar}| {postfix}", leave=False)

    def tell(done: float, total: float, words: str) -> None:
        bar.total = total
        bar.n = done
        bar.set_postfix_str(words, refresh=True)

    try:
        yield tell
    finally:
        bar.close()
