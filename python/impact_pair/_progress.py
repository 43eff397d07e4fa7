"""Progress of long computations: a callback, or a bar of tqdm if that is installed."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterator
from typing import Any, TypeAlias, TypeVar

from .errors import Stopped

#: ``True`` for a bar of tqdm, if it is installed; or a callback that receives the amount done; ``None`` for a
#: bar only where a person may be looking.
Progress: TypeAlias = "bool | Callable[[int], object] | None"


Answer = TypeVar("Answer")


def kept(found: Answer, keep_partial: bool) -> Answer:
    """Return an answer; one that Ctrl-C has cut, or a list with one, only if it is to be kept.

    Raises
    ------
    Stopped
        With the cut answer as ``partial``.

    """
    answers: list[Any] = found if isinstance(found, list) else [found]
    if not keep_partial and any(answer.interrupted for answer in answers):
        raise Stopped(found)
    return found


@contextlib.contextmanager
def reporting(progress: Progress, unit: str, total: int | None = None) -> Iterator[Callable[[int], object] | None]:
    """Yield the function to call with the amount done, or None."""
    if callable(progress):
        yield progress
        return
    if progress is None:
        progress = sys.stderr is not None and sys.stderr.isatty()
    bar = None
    if progress:
        with contextlib.suppress(ImportError):
            from tqdm.auto import tqdm

            bar = tqdm(total=total, unit=unit, leave=False, delay=1)
    if bar is None:
        yield None
        return

    def report(done: int) -> None:
        bar.update(done - bar.n)

    try:
        yield report
    finally:
        bar.close()
