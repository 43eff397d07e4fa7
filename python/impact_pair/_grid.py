"""Grids of points, each a pure function of the exact scene and its number: in this process or on any ``concurrent.futures.Executor``.

What a sweep and an atlas share. Neither the worker nor the order matters.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import time
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

import numpy as np

from . import _core
from ._exact import Value, doubles_near, options_of, text, whole
from ._progress import Progress, reporting
from .bounds import doubles
from .errors import Error, Interrupted, RangeError

if TYPE_CHECKING:
    from .bounds import Doubles

#: The keys that vary, each with its first value, its last one and their number, or with evenly spaced values.
Over: TypeAlias = "Mapping[str, tuple[Value, Value, int] | Sequence[float] | Doubles]"

Result = TypeVar("Result", bound="GridResult")

#: The largest ratio of a chunk to the last ones: the first ones determine the rate.
GROWTH = 8
#: Chunks that wait for each worker, so that none is idle.
AHEAD = 2
#: The last chunks are smaller, so that workers end together: this number for each.
TAIL = 4
#: Points whose lines are read at a time.
BLOCK = 4096


@dataclass(frozen=True)
class Question:
    """The specification of a sweep or an atlas: everything that its points depend on, as sent to workers; ``options`` are JSON."""

    scene: str
    verb: str
    options: str

    def core(self, path: str | None = None) -> _core.Grid:
        """Return the computation, with points that are kept in a file, or in one that is gone with this process."""
        return _core.Grid(_core.Scene(self.scene), self.verb, self.options, path)

    @property
    def over(self) -> list[str]:
        """What varies, in the words of the command line."""
        over = json.loads(self.options)["over"]
        return [over] if isinstance(over, str) else over

    def key(self) -> str:
        """Return a hash of scene, grid, settings and version: equal keys have the same points."""
        return hashlib.sha256(self.core().head().encode()).hexdigest()[:32]


def compute(question: Question, first: int, last: int, key: str) -> tuple[bytes, float]:
    """Return the lines of the points from first up to last, and the seconds taken: the work of a worker, on one thread.

    ``key`` is that of the question where it is asked; a worker with another version has another one, and raises an ``Error``.
    """
    began = time.perf_counter()
    core = question.core()
    if question.key() != key:
        raise Error(f"a worker has another version, {json.loads(core.head())['program']}: all must have one")
    lines = core.compute(first, last)
    if lines.count(b"\n") < last - first:
        # Ctrl-C in a terminal is sent to the workers as well.
        raise KeyboardInterrupt
    return lines, time.perf_counter() - began


class Rate:
    """The size of the next chunk, such that it takes some seconds."""

    def __init__(self, seconds: float, workers: int) -> None:
        self.seconds, self.workers = seconds, workers
        self.spent, self.done, self.largest = 0.0, 0, 0

    def report(self, points: int, seconds: float) -> None:
        """Take in what a chunk took."""
        # The last measurement counts most: points differ.
        self.spent, self.done = 0.5 * self.spent + seconds, self.done // 2 + points
        self.largest = max(self.largest, points)

    def size(self, left: int) -> int:
        """Return how many points to compute next, of those that are left."""
        if not self.done:
            return 1
        estimate = int(self.seconds * self.done / max(self.spent, 1e-9))
        return max(1, min(estimate, GROWTH * self.largest, -(-left // (TAIL * self.workers))))


def question(scene: str, verb: str, over: Over, options: Mapping[str, Any]) -> Question:
    """Return the question of a sweep or an atlas of a scene, with options by keyword."""
    if not isinstance(over, Mapping):
        raise RangeError(f'over is {over!r}, but must be a dict, such as {{"amplitude": (1, 10, 1000)}}', "over", repr(over))
    return Question(scene, verb, options_of({"over": [axis(key, values) for key, values in over.items()], **options}))


def computed(
    question: Question,
    *,
    executor: Executor | None = None,
    workers: int | None = None,
    resume: str | os.PathLike[str] | None = None,
    seconds: float = 10.0,
    progress: Progress = None,
) -> _core.Grid:
    """Compute all points, or those that are finished when Ctrl-C comes."""
    if executor is not None and not callable(getattr(executor, "submit", None)):
        raise RangeError(f"executor is {executor!r}, but must be a concurrent.futures.Executor", "executor", repr(executor))
    core = question.core()
    core.check()
    if resume is not None:
        Path(resume).mkdir(parents=True, exist_ok=True)
        core = question.core(str(Path(resume) / f"{question.key()}.partial"))
    points = points_of(core)
    # Finished points are kept.
    with reporting(progress, "points", points) as report, contextlib.suppress(KeyboardInterrupt):
        if executor is None:
            core.complete(report)
            if report is not None:
                # Some are finished after the last look.
                report(points - missing(core))
        else:
            Run(question, core, Rate(seconds, workers or workers_of(executor)), report).on(executor)
    return core


def points_of(core: _core.Grid) -> int:
    """Return the number of points of the grid."""
    return int(json.loads(core.head())["points"])


def missing(core: _core.Grid) -> int:
    """Return the number of points that are missing."""
    return sum(last - first for first, last in core.missing())


def spread(key: str, given: Any) -> tuple[Value, Value, int]:
    """Return first value, last value and number of evenly spaced values, such as those of ``np.linspace``."""
    values = doubles_near(f"over of {key}", given)
    evenly = np.linspace(values[0], values[-1], len(values)) if values.ndim == 1 and len(values) > 1 else None
    if evenly is None or not np.allclose(values, evenly, rtol=1e-6 if given_in_singles(given) else 1e-12, atol=0):
        message = f"over of {key} is {given!r}, but must be two or more evenly spaced values, or (low, high, count)"
        raise RangeError(message, key, repr(given))
    # The ends as they are given: a fraction is no double.
    return given[0], given[-1], len(values)


def given_in_singles(values: Any) -> bool:
    """Return whether an array has less than double precision, in which steps are rounded more."""
    return getattr(values, "dtype", np.dtype(float)).itemsize < np.dtype(float).itemsize


def spaced(key: str, values: Any) -> tuple[Value, Value, int]:
    """Return first value, last value and number of what varies: of ``(low, high, count)``, or of an array or a list of values."""
    if isinstance(values, (np.ndarray, list)):
        values = spread(key, values)
    if not isinstance(values, tuple) or len(values) != 3:
        raise RangeError(f"over of {key} is {values!r}, but must be (low, high, count)", key, repr(values))
    low, high, count = values
    return low, high, whole(f"{key} count", count)


def axis(key: str, values: Any) -> str:
    """Return what varies in the words of the command line: exact values from one to another, evenly spread."""
    low, high, count = spaced(key, values)
    return f"{key}={text(key, low)}..{text(key, high)}:{count}"


def workers_of(executor: Executor | None) -> int:
    """Return how many chunks an executor computes at a time."""
    if executor is None:
        return 1
    client = getattr(executor, "_client", None)
    if client is not None and hasattr(client, "ncores"):
        return max(1, sum(map(int, client.ncores().values())))
    return int(getattr(executor, "_max_workers", None) or os.cpu_count() or 1)


class Run:
    """A sweep at work, by an executor."""

    def __init__(self, question: Question, core: _core.Grid, rate: Rate, report: Any) -> None:
        self.question, self.core, self.rate = question, core, rate
        self.gaps, self.left = core.missing(), missing(core)
        self.done, self._report = points_of(core) - self.left, report

    def next(self) -> tuple[int, int]:
        """Take the next points that are left."""
        first, last = self.gaps[0]
        last = min(last, first + self.rate.size(self.left))
        self.gaps[0] = (last, self.gaps[0][1])
        if last == self.gaps[0][1]:
            del self.gaps[0]
        self.left -= last - first
        return first, last

    def keep(self, first: int, last: int, lines: bytes, took: float) -> None:
        """Keep a finished chunk."""
        if lines.count(b"\n") != last - first:
            raise Error(f"a worker answered with {lines.count(10)} lines for the points from {first} up to {last}")
        self.core.add(lines.decode())
        self.rate.report(last - first, took)
        self.done += last - first
        if self._report:
            self._report(self.done)

    def on(self, executor: Executor) -> None:
        """Have it computed by the workers of an executor."""
        running: dict[Future[tuple[bytes, float]], tuple[int, int]] = {}
        key = self.question.key()
        try:
            while self.gaps or running:
                while self.gaps and len(running) < AHEAD * self.rate.workers:
                    first, last = self.next()
                    running[executor.submit(compute, self.question, first, last, key)] = (first, last)
                for future in wait(running, return_when=FIRST_COMPLETED).done:
                    first, last = running.pop(future)
                    self.keep(first, last, *future.result())
        except Error:
            raise
        except Exception as lost:
            # Each library has its own name for it: BrokenProcessPool, KilledWorker, CommClosedError.
            raise Interrupted(f"the executor failed after {self.done} points: {lost!r}") from lost
        finally:
            for future in running:
                future.cancel()


class GridResult:
    """The points of a grid, in order; after Ctrl-C those that are finished."""

    #: The name of its kind, in a word.
    name = "grid"

    def __init__(self, question: Question, core: _core.Grid) -> None:
        self._question, self._core = question, core

    @classmethod
    def of(cls: type[Result], question: Question, **how: Any) -> Result:
        """Return the answer to a question, computed as of :func:`computed`."""
        return cls(question, computed(question, **how))

    @cached_property
    def head(self) -> dict[str, Any]:
        """The first line of its JSON Lines."""
        found: dict[str, Any] = json.loads(self._core.head())
        return found

    @property
    def interrupted(self) -> bool:
        """True if Ctrl-C ended it: some points of the grid are missing."""
        return missing(self._core) > 0

    @property
    def complete(self) -> bool:
        """True if everything requested is proved at every point: the command line's exit code 0."""
        return not self.interrupted and self._core.status()[0]

    @property
    def status(self) -> str:
        """How much is proved, in words: the last line of the command line."""
        return self._core.status()[1]

    def require_whole(self) -> None:
        """Raise :class:`Interrupted` where points are missing.

        Raises
        ------
        Interrupted
            When Ctrl-C ended it.

        """
        if self.interrupted:
            said = f"the {self.name} was interrupted, {missing(self._core)} of {self.points} points are missing"
            raise Interrupted(f"{said}: to_pandas() has the finished ones, and {article(self.name)} with resume= goes on")

    @property
    def points(self) -> int:
        """Number of points of the grid."""
        return int(self.head["points"])

    def __len__(self) -> int:
        return self.points

    def _blocks(self) -> Iterator[tuple[int, int]]:
        """Yield the first point of some at a time, and the one after the last."""
        return ((first, min(first + BLOCK, self.points)) for first in range(0, self.points, BLOCK))

    def lines(self) -> Iterator[bytes]:
        """Yield the records as JSON Lines, some at a time, in the order of the grid."""
        return filter(None, (self._core.lines(*block) for block in self._blocks()))

    def _written(self, rows: str = "") -> Iterator[bytes]:
        """Yield a table as CSV, or without one the JSON Lines."""
        if rows:
            yield from (self._core.csv(*block, rows) for block in self._blocks())
        else:
            yield self._core.head().encode() + b"\n"
            yield from self.lines()

    def __iter__(self) -> Iterator[dict[str, Any]]:
        for lines in self.lines():
            for line in lines.splitlines():
                yield json.loads(line)

    def _summary(self, counts: Mapping[str, int]) -> str:
        said = ", ".join(f"{count} {name}" for name, count in counts.items())
        left = f"; interrupted, {missing(self._core)} of {self.points} points are missing" if self.interrupted else ""
        return f"<{self.name} over {' and '.join(self._question.over)}: {said}{left}>"

    def __reduce__(self) -> tuple[Any, ...]:
        return restored, (type(self), self._question, b"".join(self.lines()))


def restored(kind: type[GridResult], question: Question, lines: bytes) -> GridResult:
    """Return the result that was pickled."""
    core = question.core()
    core.add(lines.decode())
    return kind(question, core)


def article(name: str) -> str:
    """Return a word with its article."""
    return f"an {name}" if name[0] in "aeiou" else f"a {name}"


def arrays(table: dict[str, Any]) -> dict[str, Any]:
    """Return columns as arrays: of bounds doubles (n, 2)."""
    return {name: doubles(column, -1, 2) if isinstance(column, bytes) else np.array(column, dtype=object) for name, column in table.items()}


def flat(table: dict[str, Any]) -> dict[str, Any]:
    """Return columns by name, bounds as two, ``NAME_lower`` and ``NAME_upper``."""
    columns: dict[str, Any] = {}
    for name, column in table.items():
        if column.ndim == 2:
            columns |= {f"{name}_lower": column[:, 0], f"{name}_upper": column[:, 1]}
        else:
            columns[name] = column
    return columns


def arrow(columns: dict[str, Any], name: str, head: str) -> Any:
    """Return a pyarrow Table with these columns, the head as metadata."""
    import pyarrow as pa

    table = pa.table({column: pa.array(list(values)) for column, values in columns.items()})
    return table.replace_schema_metadata({f"impact-pair/{name}": head})
