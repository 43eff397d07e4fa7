"""Progress of long computations: a callback, or a bar of tqdm if that is installed."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterator
from typing import TypeAlias

#: ``True`` for a bar of tqdm, if it is installed; or a callback that receives the amount done; ``None`` for a
#: bar only where a person may be looking.
Progress: TypeAlias = "bool | Callable[[int], object] | None"


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
